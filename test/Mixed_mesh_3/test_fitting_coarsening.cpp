// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edge collapses, thousands of them on meshes of any topology: after each collapse, Betti numbers of the mesh
// and of its boundary are those of the start, by brute force, and no element is inverted, by rationals.
// Self-intersections are compared with those of all pairs of faces. And simplification of a whole mesh.

#include "test_cells.h"
#include "test_fitting.h"
#include "test_strata.h"
#include "test_surfaces.h"
#include "test_topology.h"

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/simplify.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Boundary_triangles.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Edge_collapser.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <random>
#include <vector>

namespace test_fitting_coarsening {

using namespace CGAL::Mixed_meshes_3;
using cells::Cell;
using brute_force::topology;
using cells::cells_of_grid;
using internal::Boundary_triangles;
using internal::Edge_collapser;
using internal::Working_mesh;

struct Counts
{
  std::size_t collapsed = 0, refused_and_harmful = 0, cuts = 0, cuts_found = 0;
};

std::vector<std::vector<Vertex_index>> sorted_elements(const Mesh& mesh)
{
  std::vector<std::vector<Vertex_index>> elements;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    elements.emplace_back(mesh.element(e).begin(), mesh.element(e).end());
  std::sort(elements.begin(), elements.end());
  return elements;
}

// Collapses random edges, until `most` are collapsed or none is left to try. Collapses of boundary edges may
// be refused because the boundary would cut itself.
void collapse_at_random(const Mesh& start, unsigned seed, std::size_t most, Counts& counts)
{
  const auto before = topology(start);
  const Aspect_ratio_quality_3 quality;
  Working_mesh working = working_mesh(start, boundary_faces(start));
  Edge_collapser<Aspect_ratio_quality_3> collapser(working, quality);
  Boundary_triangles triangles(working.points, boundary_faces(start), 50);
  std::mt19937 random(seed);
  for(std::size_t trial = 0, collapsed = 0; trial < 30 * most && collapsed < most; ++trial) {
    const Vertex_index v = random() % working.points.size();
    if(working.incident[v].empty())
      continue;
    const auto& element = working.elements[working.incident[v][random() % working.incident[v].size()]];
    const Vertex_index w = element.vertices[random() % 4];
    if(w == v || collapser.worst_after(v, w, 1e6) > 1e6)
      continue;
    const auto faces = collapser.boundary_faces_at(v);
    const auto ends = collapser.ends_of_edges(v, faces);
    const bool is_allowed = (faces.empty() || std::binary_search(ends.begin(), ends.end(), w))
                            && collapser.keeps_topology(v, w, faces);
    Working_mesh changed = working;
    BOOST_TEST(Edge_collapser<Aspect_ratio_quality_3>(changed, quality)(v, w, 1e6));
    Mesh mesh = start;
    changed.store(mesh);
    Working_mesh in_place = working;
    in_place.collapse(v, w);
    Mesh other = start;
    in_place.store(other);
    BOOST_TEST((sorted_elements(other) == sorted_elements(mesh)));
    if(!is_allowed) { // the collapse is done to see its effect
      counts.refused_and_harmful += topology(mesh) != before || !find_defects(mesh).none();
      continue;
    }
    const bool would_cut = !faces.empty() && triangles.would_cross(v, w);
    std::vector<Vec3> points;
    for(const auto& p : mesh.points())
      points.push_back(to_vec3(p));
    const bool cuts = !internal::vertices_of_self_intersections(points, boundary_faces(mesh)).empty();
    BOOST_TEST_EQ(would_cut, cuts);
    counts.cuts += cuts;
    BOOST_TEST(topology(mesh) == before);
    BOOST_TEST(find_defects(mesh).none());
    BOOST_TEST(brute_force::has_positive_corners(mesh));
    if(would_cut)
      continue;
    BOOST_TEST(collapser(v, w, 1e6));
    if(!faces.empty())
      triangles.collapse(v, w);
    ++collapsed;
    ++counts.collapsed;
  }
}

void test_collapses()
{
  Counts counts;
  std::mt19937 random(1);
  for(unsigned seed = 1; seed <= 40; ++seed) {
    const Mesh start = cells::random_cells(seed, random);
    if(find_defects(start).none())
      collapse_at_random(start, seed, 60, counts);
  }
  // The meshes have a hole, and a cavity.
  for(unsigned seed = 1; seed <= 5; ++seed) {
    collapse_at_random(cells_of_grid(3, seed, [](const Cell& c) { return c[0] == 1 && c[1] == 1 ? 0 : 1; }),
                       seed, 60, counts);
    collapse_at_random(
      cells_of_grid(3, seed, [](const Cell& c) { return c[0] == 1 && c[1] == 1 && c[2] == 1 ? 0 : 1; }), seed,
      60, counts);
  }
  std::cout << counts.collapsed << " edges collapsed, " << counts.refused_and_harmful
            << " refused that would have changed the topology, " << counts.cuts
            << " that would have cut the boundary" << std::endl;
  BOOST_TEST_GT(counts.collapsed, 1000u);
  BOOST_TEST_GT(counts.refused_and_harmful, 100u);
}

bool simplify(internal::Core_mesh& mesh, const internal::Any_surface& surface, std::size_t number,
              double radius)
{
  internal::Followed_features followed;
  double bound = 3.2;
  return internal::simplify(mesh, followed, surface, Aspect_ratio_quality_3(), number, radius, 1, bound,
                            {true, true, 1, bound, true}, [] { return true; });
}

// A cube loses none of its volume, nor its corners: its faces are flat.
void test_simplification()
{
  const Test_surface cube = box(Test_point(0, 0, 0), Test_point(1, 1, 1));
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(cube);
  const internal::Surface_reference<CGAL::Polyhedral_mixed_mesh_domain_3> surface(domain);
  Mesh start = grid(10, TETRAHEDRON);
  distort(start, 0.01, 1);
  std::size_t last = start.number_of_vertices();
  for(std::size_t n : {600, 300, 200}) {
    internal::Core_mesh mesh = internal::as_core_mesh(start), again = mesh;
    BOOST_TEST(simplify(mesh, surface, n, 0));
    BOOST_TEST_EQ(mesh.number_of_vertices(), n);
    BOOST_TEST_LT(mesh.number_of_vertices(), last);
    last = mesh.number_of_vertices();
    BOOST_TEST(find_defects(mesh).none());
    BOOST_TEST_LE(std::abs(volume(mesh) - 1), 1e-12);
    std::size_t corners = 0;
    for(const auto& p : mesh.points())
      corners += (p.x() == 0 || p.x() == 1) && (p.y() == 0 || p.y() == 1) && (p.z() == 0 || p.z() == 1);
    BOOST_TEST_EQ(corners, 8u);
    BOOST_TEST(simplify(again, surface, n, 0));
    BOOST_TEST(again.points() == mesh.points());
  }
  // No mesh has so few vertices.
  internal::Core_mesh mesh = internal::as_core_mesh(start);
  BOOST_TEST(!simplify(mesh, surface, 3, 0));
  BOOST_TEST(find_defects(mesh).none());
}

// More vertices remain near elements in a region.
void test_weights()
{
  const Mesh all = grid(10, TETRAHEDRON);
  Mesh start;
  start.points() = all.points();
  for(Element_index e = 0; e < all.number_of_elements(); ++e) {
    Element_attributes attributes;
    attributes.is_in_region = all.point(all.element(e)[0]).x() < 0.3;
    start.add_element(TETRAHEDRON, std::vector<Vertex_index>(all.element(e).begin(), all.element(e).end()),
                      attributes);
  }
  const Test_surface cube = box(Test_point(0, 0, 0), Test_point(1, 1, 1));
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(cube);
  const internal::Surface_reference<CGAL::Polyhedral_mixed_mesh_domain_3> surface(domain);
  std::array<std::size_t, 2> near_region{};
  for(int i = 0; i < 2; ++i) {
    internal::Core_mesh mesh = internal::as_core_mesh(start);
    BOOST_TEST(simplify(mesh, surface, 300, i == 0 ? 0 : 0.2));
    for(const auto& p : mesh.points())
      near_region[std::size_t(i)] += p.x() < 0.45;
  }
  BOOST_TEST_GT(double(near_region[1]), 1.3 * double(near_region[0]));
}

int run(int, char*[])
{
  test_collapses();
  test_simplification();
  test_weights();
  return boost::report_errors();
}

} // namespace test_fitting_coarsening
