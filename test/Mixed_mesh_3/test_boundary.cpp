// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary stage: one element by itself, meshes of balls that almost touch, and of noise; defects that
// the stage cannot repair, and lost parts.

#include "test_lattice.h"

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/Boundary_stage.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/lost_cells.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <random>
#include <set>
#include <vector>

namespace test_boundary {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Mixed_meshes_3::internal::Boundary_pieces;
using CGAL::Mixed_meshes_3::internal::Lattice_mesh;
using CGAL::Mixed_meshes_3::internal::apply_transitions;
using CGAL::Mixed_meshes_3::internal::assemble_mesh;
using CGAL::Mixed_meshes_3::internal::lost_cells;
using CGAL::Mixed_meshes_3::internal::manifold_defects;
using CGAL::Mixed_meshes_3::internal::split_boundary;
using CGAL::Mixed_meshes_3::internal::split_element;

using Kernel = Predicates_kernel;
using Point_3 = Kernel::Point_3;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

Element_list kept_elements(const Lattice_mesh& mesh, const Boundary_pieces& boundary)
{
  Element_list kept;
  for(std::size_t e = 0; e < mesh.elements.size(); ++e)
    if(!boundary.is_replaced[e])
      kept.add(mesh.elements[e].kind(), mesh.elements[e].begin());
  for(std::size_t i = 0; i < boundary.pieces.size(); ++i)
    kept.add(boundary.pieces[i].kind(), boundary.pieces[i].begin());
  return kept;
}

// One element by itself: all labels, random orders.
void test_split_element()
{
  std::mt19937 random(37);
  for(Element_kind kind : element_kinds) {
    const Reference_element& r = reference_elements[kind];
    std::vector<Lattice_point> points;
    std::vector<Vertex_index> vertices;
    for(int i = 0; i < r.number_of_vertices; ++i) {
      points.push_back({std::uint32_t(r.coordinates[i][0] + 1), std::uint32_t(r.coordinates[i][1] + 1),
                        std::uint32_t(r.coordinates[i][2] + 1)});
      vertices.push_back(Vertex_index(i));
    }
    const Element_view element(kind, vertices.data());
    const Integer volume = six_volume(points, element);
    for(int labels = 0; labels < (1 << r.number_of_vertices) - 1; ++labels)
      for(int repeat = 0; repeat < 4; ++repeat) {
        const auto is_inside = [&](Vertex_index v) { return (labels >> v & 1) != 0; };
        std::vector<int> rank(vertices.size());
        for(std::size_t i = 0; i < rank.size(); ++i)
          rank[i] = int(i);
        std::shuffle(rank.begin(), rank.end(), random);
        for(Vertex_index v : vertices)
          if(is_inside(v))
            rank[v] = 99;
        Element_list pieces;
        split_element(
          element, [&](Vertex_index v) { return rank[v]; }, is_inside,
          [&](Element_kind k, std::initializer_list<Vertex_index> v) { pieces.add(k, v); });
        Integer sum = 0;
        for(std::size_t i = 0; i < pieces.size(); ++i) {
          BOOST_TEST(is_positive(points, pieces[i]));
          sum += six_volume(points, pieces[i]);
        }
        BOOST_TEST_EQ(sum, volume);
        const Faces faces = faces_of(pieces);
        BOOST_TEST_EQ(faces.nonconforming, 0u);
        for(const Face_vertices& p : faces.boundary)
          if(p.size() == 4) // as it was, and all inside
            BOOST_TEST(std::all_of(p.begin(), p.end(), is_inside));
        BOOST_TEST(manifold_defects(faces.boundary).empty());
      }
  }
}

std::size_t number_reaching_out = 0, number_with_first_defects = 0, number_of_repaired = 0,
            number_unrepaired = 0;

// Runs the stage and checks all its guarantees. `margin` tells that the rim can not be reached.
void test_boundary(const Located_octree& located, Transition_templates_choice choice, Boundary_mode mode,
                   bool has_margin)
{
  Lattice_mesh mesh = apply_transitions(located, choice);
  const Lattice_mesh before = mesh;

  // Before: elements that reach out and are not tetrahedra. With every vertex on the rim no vertex can be
  // relabeled: the pinched places of the first round are left.
  std::size_t n_reaching_out = 0;
  for(std::size_t e = 0; e < before.elements.size(); ++e) {
    const Element_view element = before.elements[e];
    const auto n = std::count_if(element.begin(), element.end(),
                                 [&](Vertex_index v) { return before.is_inside(v); });
    n_reaching_out += n > 0 && n < element.size() && element.kind() != TETRAHEDRON;
  }
  number_reaching_out += n_reaching_out;
  Lattice_mesh fixed = before;
  std::fill(fixed.is_on_rim.begin(), fixed.is_on_rim.end(), std::uint8_t(1));
  const Boundary_pieces first = split_boundary(located, fixed, mode);
  BOOST_TEST_EQ(first.number_of_relabeled_vertices, 0u);
  BOOST_TEST(fixed.sides.size() >= before.sides.size()
             && std::equal(before.sides.begin(), before.sides.end(), fixed.sides.begin()));
  const Element_list first_kept = kept_elements(fixed, first);
  BOOST_TEST_EQ(first.defects.empty(), manifold_defects(faces_of(first_kept).boundary).empty());

  const Boundary_pieces boundary = split_boundary(located, mesh, mode);
  const Boundary_pieces again = split_boundary(
    located,
    [&]() -> Lattice_mesh& {
      fixed = before;
      return fixed;
    }(),
    mode, 3);
  BOOST_TEST(again.pieces.connectivity() == boundary.pieces.connectivity());

  // Relabeled vertices were outside, and are inside now.
  std::size_t n_relabeled = 0;
  for(std::size_t v = 0; v < before.sides.size(); ++v)
    if(mesh.sides[v] != before.sides[v]) {
      BOOST_TEST(before.sides[v] != 1 && mesh.sides[v] == 1);
      ++n_relabeled;
    }
  BOOST_TEST_EQ(boundary.number_of_relabeled_vertices, n_relabeled);
  BOOST_TEST(n_relabeled == 0 || !first.defects.empty());
  BOOST_TEST(n_relabeled > 0 || first.defects.empty() || !has_margin);
  number_with_first_defects += !first.defects.empty();
  number_of_repaired += !first.defects.empty() && boundary.defects.empty();
  number_unrepaired += !boundary.defects.empty();

  const Element_list kept = kept_elements(mesh, boundary);
  BOOST_TEST_EQ(boundary.number_of_inserted_vertices, mesh.vertices.size() - before.vertices.size());
  if(mode == Boundary_mode::VERTEX_ORDER)
    BOOST_TEST_EQ(boundary.number_of_inserted_vertices, 0u);
  if(has_margin) {
    BOOST_TEST(boundary.defects.empty());
  }
  for(const auto& e : boundary.defects.edges)
    BOOST_TEST(mesh.is_on_rim[e[0]] && mesh.is_on_rim[e[1]]);
  for(Vertex_index v : boundary.defects.vertices)
    BOOST_TEST(mesh.is_on_rim[v]);

  // Kept elements have a vertex inside. Elements in pieces have another vertex, too.
  std::set<Vertex_index> used;
  std::vector<Integer> volume_of_pieces(mesh.elements.size(), 0);
  for(std::size_t i = 0; i < boundary.pieces.size(); ++i)
    volume_of_pieces[boundary.origins[i]] += six_volume(mesh.vertices, boundary.pieces[i]);
  BOOST_TEST(std::is_sorted(boundary.origins.begin(), boundary.origins.end()));
  const auto is_inside = [&](Vertex_index v) { return mesh.is_inside(v); };
  for(std::size_t e = 0; e < kept.size(); ++e) {
    const Element_view element = kept[e];
    BOOST_TEST(std::any_of(element.begin(), element.end(), is_inside));
    BOOST_TEST(is_positive(mesh.vertices, element));
    used.insert(element.begin(), element.end());
  }
  for(std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Element_view element = mesh.elements[e];
    const bool has_inside = std::any_of(element.begin(), element.end(), is_inside);
    const bool all_inside = std::all_of(element.begin(), element.end(), is_inside);
    if(!all_inside)
      BOOST_TEST(boundary.is_replaced[e]);
    if(mode == Boundary_mode::VERTEX_ORDER)
      BOOST_TEST_EQ(bool(boundary.is_replaced[e]), !all_inside);
    const Integer volume = six_volume(mesh.vertices, element);
    BOOST_TEST(has_inside && boundary.is_replaced[e]
                 ? volume_of_pieces[e] > 0 && volume_of_pieces[e] <= volume
                 : volume_of_pieces[e] == 0);
    if(all_inside && boundary.is_replaced[e])
      BOOST_TEST_EQ(volume_of_pieces[e], volume);
  }
  if(mode == Boundary_mode::PAPER)
    for(std::size_t i = 0; i < boundary.pieces.size(); ++i)
      if(located.side(mesh.cells[boundary.origins[i]]) == CGAL::ON_BOUNDARY)
        BOOST_TEST_EQ(boundary.pieces[i].kind(), TETRAHEDRON);
  BOOST_TEST_EQ(boundary.number_of_vertices, used.size());
  for(Vertex_index v = 0; v < mesh.vertices.size(); ++v)
    BOOST_TEST_EQ(bool(boundary.is_used[v]), used.count(v) != 0);

  // Conforming; the boundary outside, triangles, closed and manifold if the stage says so.
  const Faces faces = faces_of(kept);
  BOOST_TEST_EQ(faces.nonconforming, 0u);
  bool is_outside = true;
  for(const Face_vertices& p : faces.boundary) {
    BOOST_TEST_EQ(p.size(), 3);
    is_outside = is_outside && std::none_of(p.begin(), p.end(), is_inside);
  }
  BOOST_TEST(is_outside);
  BOOST_TEST_EQ(manifold_defects(faces.boundary).empty(), boundary.defects.empty());

  Mesh result;
  assemble_mesh(located, mesh, boundary, result);
  BOOST_TEST_EQ(result.number_of_vertices(), boundary.number_of_vertices);
  BOOST_TEST_EQ(result.number_of_elements(), kept.size());
  BOOST_TEST_EQ(boundary_faces(result).size(), faces.boundary.size());
  const Mesh_defects defects = find_defects(result);
  BOOST_TEST(defects.conforming() && defects.positive() && defects.unused_vertices == 0
             && defects.duplicate_vertices == 0);
  BOOST_TEST_EQ(defects.none(), boundary.defects.empty());
}

void test_boundary_stage()
{
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const double c = 1. / 8;
  struct Case
  {
    Analytic_domain domain;
    int base_level, rounds;
  };
  std::vector<Case> cases = {
    {Analytic_domain(ball({0.5, 0.5, 0.5}, 0.33)), 3, 0},
    {Analytic_domain(ball({0.47, 0.52, 0.5}, 0.3)), 2, 3},
    {Analytic_domain(united(ball({0.3, 0.3, 0.5}, 0.13), ball({0.7, 0.7, 0.4}, 0.21))), 2, 3}};
  // almost touching, in all relative positions on the lattice
  for(double d : {1 * c, 1.25 * c, 1.5 * c, 2 * c})
    for(const Kernel::Vector_3& v : {Kernel::Vector_3(1, 0, 0), Kernel::Vector_3(1, 1, 0),
                                     Kernel::Vector_3(1, 1, 1), Kernel::Vector_3(1, 0.5, 0)})
      cases.push_back({Analytic_domain(united(ball(Point_3(0.5, 0.5, 0.5) - d * v, d),
                                              ball(Point_3(0.5, 0.5, 0.5) + d * v, d))),
                       3, 0});
  unsigned seed = 100;
  for(const Case& one : cases) {
    const Located_octree octree = random_octree(one.domain, traits, ++seed, one.base_level, one.rounds);
    for(Boundary_mode mode : {Boundary_mode::VERTEX_ORDER, Boundary_mode::PAPER})
      test_boundary(octree, Transition_templates_choice::FEWEST_VERTICES, mode, true);
    test_boundary(octree, Transition_templates_choice::CENTERED, Boundary_mode::VERTEX_ORDER, true);
  }
  BOOST_TEST_GT(number_of_repaired, 5u);

  // Noise with a margin is repaired completely, without a margin the status tells the remaining defects.
  for(double margin : {0.3, 0.01})
    for(int share : {3, 10, 30, 60})
      for(int repeat = 0; repeat < 4; ++repeat) {
        const Analytic_domain domain(noise(++seed, share, margin));
        const Located_octree octree = repeat == 0  ? random_octree(domain, traits, seed, 3, 0)
                                      : repeat < 3 ? random_octree(domain, traits, seed, 2, repeat)
                                                   : random_octree(domain, traits, seed, 2, 1, 2);
        for(Boundary_mode mode : {Boundary_mode::VERTEX_ORDER, Boundary_mode::PAPER})
          test_boundary(octree, Transition_templates_choice::FEWEST_VERTICES, mode, false);
      }
  BOOST_TEST_GT(number_reaching_out, 5000u);
  BOOST_TEST_GT(number_with_first_defects, 40u);
  BOOST_TEST_GT(number_unrepaired, 2u);
  std::cout << "boundary stage: pinched at first " << number_with_first_defects << ", repaired "
            << number_of_repaired << ", left " << number_unrepaired << std::endl;
}

// ---- what cannot be repaired -------------------------------------------------------------------

// A domain that reaches the border of a root of eight cells: two of the lattice's 27 vertices are inside. A
// pinched vertex on the border is left, and reported.
void test_unrepaired()
{
  static const Everywhere_mixed_mesh_region_3 region;
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const auto place = [&](std::uint32_t i) {
    const std::uint32_t s = Octree::side_at(1);
    return traits.point({i % 3 * s, i / 3 % 3 * s, i / 9 * s});
  };
  std::size_t number_pinched = 0;
  for(std::uint32_t i = 0; i < 27; ++i)
    for(std::uint32_t j = 0; j < i; ++j) {
      const Analytic_domain domain(united(ball(place(i), 0.01), ball(place(j), 0.01)));
      Located_octree octree(domain, region, traits);
      octree.refine(octree.leaves_to_refine(0, false));
      Lattice_mesh lattice = apply_transitions(octree, Transition_templates_choice::FEWEST_VERTICES);
      const Boundary_pieces boundary = split_boundary(octree, lattice, Boundary_mode::VERTEX_ORDER);
      Mesh mesh;
      assemble_mesh(octree, lattice, boundary, mesh);
      const Mesh_defects defects = find_defects(mesh);
      BOOST_TEST(defects.conforming() && defects.positive());
      if(defects.closed_manifold_boundary())
        continue;
      ++number_pinched;
      BOOST_TEST(!boundary.defects.empty());
      const auto is_on_rim = [&](Vertex_index v) { return lattice.is_on_rim[v] != 0; };
      BOOST_TEST(std::all_of(boundary.defects.vertices.begin(), boundary.defects.vertices.end(), is_on_rim));
      if(i == 2 && j == 0) { // at both ends of an edge of the root: tetrahedra meet in the middle of the edge
        BOOST_TEST_EQ(mesh.number_of_vertices(), 7u);
        BOOST_TEST_EQ(mesh.number_of_elements(), 2u);
        BOOST_TEST_EQ(mesh.elements().counts()[TETRAHEDRON], 2u);
        BOOST_TEST_EQ(defects.nonmanifold_boundary_vertices, 1u);
        BOOST_TEST_EQ(defects.nonmanifold_boundary_edges, 0u);
      }
    }
  BOOST_TEST_GT(number_pinched, 50u);
}

// ---- what is lost ------------------------------------------------------------------------------

// Lost cells by all pairs of leaves: leaves that meet the domain, have no elements, and meet no leaf with
// elements, not even one that is as near as a cell of their size beside them.
std::vector<Octree::Node_index> expected_lost_cells(const Located_octree& located, const Lattice_mesh& mesh,
                                                    const Boundary_pieces& boundary)
{
  const Octree& octree = located.octree();
  std::set<Octree::Node_index> meshed;
  for(std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const bool has_pieces = std::count(boundary.origins.begin(), boundary.origins.end(), e) != 0;
    if(!boundary.is_replaced[e] || has_pieces)
      meshed.insert(mesh.cells[e]);
  }
  std::vector<Octree::Node_index> lost;
  for(Octree::Node_index n = 0; n < octree.size(); ++n) {
    if(!octree.is_leaf(n) || !located.meets_domain(n))
      continue;
    const std::int64_t side = octree.side(n);
    bool is_lost = true;
    for(Octree::Node_index m : meshed) {
      bool is_near = true; // the open boxes meet, if that of n is three times as large
      for(int k = 0; k < 3; ++k) {
        const std::int64_t a = octree.corner(n)[k], b = octree.corner(m)[k];
        is_near = is_near && b < a + 2 * side && a - side < b + std::int64_t(octree.side(m));
      }
      is_lost = is_lost && !is_near;
    }
    if(is_lost)
      lost.push_back(n);
  }
  return lost;
}

// Plates between the planes of a coarse octree, with a ball that is not lost.
void test_lost_cells()
{
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const auto plate = [](double z, double thickness) {
    return [=](const Test_point& p) { return thickness / 2 - std::abs(p.z() - z); };
  };
  std::size_t number_lost = 0, number_with_none = 0;
  unsigned seed = 500;
  for(const Analytic_domain& domain : {Analytic_domain(plate(0.19, 0.01)), Analytic_domain(plate(0.5, 0.4)),
                                       Analytic_domain(united(plate(0.19, 0.01), ball({0.5, 0.5, 0.7}, 0.2))),
                                       Analytic_domain(united(plate(0.71, 0.03), ball({0.4, 0.5, 0.6}, 0.3))),
                                       Analytic_domain(noise(9, 2, 0.1))})
    for(int base_level : {2, 3})
      for(int rounds : {0, 2}) {
        const Located_octree octree = random_octree(domain, traits, ++seed, base_level, rounds);
        Lattice_mesh mesh = apply_transitions(octree, Transition_templates_choice::FEWEST_VERTICES);
        const Boundary_pieces boundary = split_boundary(octree, mesh, Boundary_mode::VERTEX_ORDER);
        const std::vector<Octree::Node_index> lost = lost_cells(octree, mesh, boundary);
        BOOST_TEST(lost == expected_lost_cells(octree, mesh, boundary));
        number_lost += lost.size();
        number_with_none += lost.empty();
      }
  BOOST_TEST_GT(number_lost, 100u);
  BOOST_TEST_GT(number_with_none, 2u);
}

int run(int, char*[])
{
  test_split_element();
  test_boundary_stage();
  test_unrepaired();
  test_lost_cells();
  return boost::report_errors();
}

} // namespace test_boundary
