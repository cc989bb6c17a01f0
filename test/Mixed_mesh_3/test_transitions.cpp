// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lattice mesh that transition templates make of an octree, checked on integers.

#include "test_lattice.h"

#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace test_transitions {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Mixed_meshes_3::internal::Lattice_mesh;
using CGAL::Mixed_meshes_3::internal::apply_transitions;

using Point_3 = Predicates_kernel::Point_3;

// The leaf that contains the unit cell of the lattice at p.
Octree::Node_index leaf_at(const Octree& octree, const std::array<std::int64_t, 3>& p)
{
  for(std::int64_t c : p)
    if(c < 0 || c >= Octree::root_side)
      return Octree::no_node;
  Octree::Node_index n = Octree::root();
  while(!octree.is_leaf(n)) {
    int child = 0;
    for(int k = 0; k < 3; ++k)
      child |= (p[k] >= std::int64_t(octree.corner(n)[k]) + octree.side(n) / 2) << k;
    n = octree.child(n, child);
  }
  return n;
}
void test_transitions(const Located_octree& located, Transition_templates_choice choice)
{
  const Octree& octree = located.octree();
  BOOST_TEST(is_balanced(octree, Adjacency::EDGE));
  const Lattice_mesh mesh = apply_transitions(located, choice);
  const std::size_t n = mesh.vertices.size();
  BOOST_TEST_EQ(mesh.cells.size(), mesh.elements.size());
  BOOST_TEST_EQ(mesh.sides.size(), n);
  BOOST_TEST_EQ(mesh.leaves.size(), n);
  BOOST_TEST_EQ(mesh.is_on_rim.size(), n);

  // Used leaves meet the domain, or touch a leaf that does (and some more beside refined cells).
  std::vector<Octree::Node_index> leaves, in_domain;
  for(Octree::Node_index m = 0; m < octree.size(); ++m)
    if(octree.is_leaf(m)) {
      leaves.push_back(m);
      if(located.meets_domain(m))
        in_domain.push_back(m);
    }
  const std::set<Octree::Node_index> used(mesh.cells.begin(), mesh.cells.end());
  std::set<Lattice_point> corners;
  Integer volume_of_leaves = 0, volume_of_elements = 0;
  for(Octree::Node_index m : leaves) {
    const bool is_used = std::any_of(in_domain.begin(), in_domain.end(),
                                     [&](Octree::Node_index a) { return touch(octree, a, m); });
    BOOST_TEST(used.count(m) != 0 || !is_used);
    const Integer side = octree.side(m);
    if(used.count(m) != 0)
      volume_of_leaves += 6 * side * side * side;
    for(std::uint32_t i = 0; i < 8; ++i)
      corners.insert({octree.corner(m)[0] + (i & 1) * octree.side(m),
                      octree.corner(m)[1] + (i >> 1 & 1) * octree.side(m),
                      octree.corner(m)[2] + (i >> 2) * octree.side(m)});
  }

  // Elements are in their leaves, positive, and fill them.
  for(Element_index e = 0; e < mesh.elements.size(); ++e) {
    BOOST_TEST(is_positive(mesh.vertices, mesh.elements[e]));
    volume_of_elements += six_volume(mesh.vertices, mesh.elements[e]);
    const Octree::Node_index m = mesh.cells[e];
    for(Vertex_index v : mesh.elements[e])
      for(int k = 0; k < 3; ++k)
        BOOST_TEST(mesh.vertices[v][k] - octree.corner(m)[k] <= octree.side(m));
  }
  BOOST_TEST_EQ(volume_of_elements, volume_of_leaves);

  // The mesh is conforming; faces on the boundary have no used leaf behind them.
  const Faces faces = faces_of(mesh.elements);
  BOOST_TEST_EQ(faces.nonconforming, 0u);
  std::set<Vertex_index> on_boundary;
  for(const Face_vertices& p : faces.boundary) {
    std::array<std::int64_t, 3> sum{};
    int axis = -1;
    for(int k = 0; k < 3; ++k) {
      bool is_flat = true;
      for(int i = 0; i < p.size(); ++i) {
        sum[k] += mesh.vertices[p[i]][k];
        is_flat = is_flat && mesh.vertices[p[i]][k] == mesh.vertices[p[0]][k];
        on_boundary.insert(p[i]);
      }
      sum[k] /= p.size();
      if(is_flat)
        axis = k;
    }
    BOOST_TEST(axis >= 0);
    if(axis < 0)
      continue;
    // Whether the face is outward along the axis.
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const auto x = [&](int i, int k) { return std::int64_t(mesh.vertices[p[i]][k]); };
    const bool is_upper = (x(1, b) - x(0, b)) * (x(2, c) - x(0, c))
                          > (x(1, c) - x(0, c)) * (x(2, b) - x(0, b));
    if(!is_upper)
      --sum[axis];
    const Octree::Node_index behind = leaf_at(octree, sum);
    BOOST_TEST(behind == Octree::no_node || used.count(behind) == 0);
  }

  // Vertices are at different places, on the rim iff on the boundary or beside an unused leaf, and have the
  // sides that the domain says.
  std::size_t n_inserted = 0;
  std::set<Lattice_point> places;
  for(Vertex_index v = 0; v < n; ++v) {
    const Lattice_point& p = mesh.vertices[v];
    BOOST_TEST(places.insert(p).second);
    n_inserted += corners.count(p) == 0;
    bool is_on_rim = false;
    for(int i = 0; i < 8; ++i) {
      std::array<std::int64_t, 3> q;
      for(int k = 0; k < 3; ++k)
        q[k] = std::int64_t(p[k]) - 1 + (i >> k & 1);
      const Octree::Node_index m = leaf_at(octree, q);
      is_on_rim = is_on_rim || m == Octree::no_node || used.count(m) == 0;
    }
    BOOST_TEST_EQ(bool(mesh.is_on_rim[v]), is_on_rim);
    if(on_boundary.count(v) != 0)
      BOOST_TEST(is_on_rim);
    BOOST_TEST_EQ(int(mesh.sides[v]), int(located.domain().bounded_side(located.point(p), nullptr)));
  }
  BOOST_TEST_EQ(n_inserted, mesh.vertices.size() - mesh.first_inserted_vertex);

  const Mesh_defects defects = find_defects(mesh);
  BOOST_TEST(defects.conforming() && defects.positive() && defects.duplicate_vertices == 0);
}

void test_all_transitions()
{
  const Aligned_traits traits({0, 0, 0, 1, 1, 1}), box({0, 0, 0, 1, 1, 0.5}, Root_cell::BOX);
  const std::vector<Analytic_domain> domains = {Analytic_domain(ball({0.45, 0.5, 0.55}, 0.3)),
                                                Analytic_domain(united(ball({0.2, 0.2, 0.2}, 0.15),
                                                                       ball({0.9, 0.9, 0.3}, 0.4))),
                                                Analytic_domain([](const Point_3&) { return 9.; })};
  unsigned seed = 0;
  for(const Analytic_domain& domain : domains)
    for(const Aligned_traits& t : {traits, box})
      for(int base_level : {1, 2}) {
        const Located_octree octree = random_octree(domain, t, ++seed, base_level, 3);
        test_transitions(octree, Transition_templates_choice::FEWEST_VERTICES);
        test_transitions(octree, Transition_templates_choice::CENTERED);
        BOOST_TEST_LT(apply_transitions(octree, Transition_templates_choice::FEWEST_VERTICES).vertices.size(),
                      apply_transitions(octree, Transition_templates_choice::CENTERED).vertices.size());
      }
}

// The center of a face on the border of the root, inserted since its four edges are split, is on the rim like
// the others.
void test_inserted_on_rim()
{
  static const Everywhere_mixed_mesh_region_3 region;
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  for(double f : {9., 0.}) { // all cells inside, or all at the surface
    const Analytic_domain domain([f](const Point_3&) { return f; });
    Located_octree octree(domain, region, traits);
    octree.refine(octree.leaves_to_refine(0, false));
    octree.refine(octree.leaves_to_refine(1, false));
    const std::uint32_t s = Octree::side_at(2);
    std::vector<Octree::Node_index> chosen;
    for(Octree::Node_index n : octree.leaves_to_refine(2, false)) {
      const Lattice_point& c = octree.octree().corner(n);
      if(c[2] == 0 && (c[0] == s) != (c[1] == s) && c[0] <= 2 * s && c[1] <= 2 * s)
        chosen.push_back(n);
    }
    BOOST_TEST_EQ(chosen.size(), 4u);
    octree.refine(chosen);
    test_transitions(octree, Transition_templates_choice::FEWEST_VERTICES);
  }
}

int run(int, char*[])
{
  test_all_transitions();
  test_inserted_on_rim();
  return boost::report_errors();
}

} // namespace test_transitions
