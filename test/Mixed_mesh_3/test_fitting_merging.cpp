// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Merging of boundary vertices, one after the other until no vertex is left to merge: after each merge, the
// mesh and each of its subdomains are without defects, with the topology of the start. Removal of boundary
// vertices with their elements, against brute force.

#include "test_cells.h"
#include "test_fitting.h"
#include "test_strata.h"

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/merge_boundary_vertices.h>
#include <CGAL/Mixed_mesh_3/internal/moves/remove_vertex.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace test_fitting_merging {

using namespace CGAL::Mixed_meshes_3;
using internal::Boundary_vertex_merger;
using internal::Working_mesh;
using internal::no_vertex;
using cells::Cell;
using cells::cells_of_grid;

constexpr double infinity = std::numeric_limits<double>::infinity();

Mesh part(const Mesh& mesh, Subdomain_index index)
{
  Mesh result;
  std::vector<Vertex_index> numbers(mesh.number_of_vertices(), no_vertex);
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    if(mesh.attributes(e).subdomain_index != index)
      continue;
    std::vector<Vertex_index> v;
    for(Vertex_index u : mesh.element(e)) {
      if(numbers[u] == no_vertex)
        numbers[u] = result.add_vertex(mesh.point(u));
      v.push_back(numbers[u]);
    }
    result.add_element(mesh.element(e).kind(), v);
  }
  return result;
}

// \return the number of vertices that were merged
std::size_t test_merging(const Mesh& start, unsigned seed, double worst = infinity)
{
  std::vector<Subdomain_index> indices;
  for(Element_index e = 0; e < start.number_of_elements(); ++e)
    indices.push_back(start.attributes(e).subdomain_index);
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());

  const Aspect_ratio_quality_3 quality;
  Working_mesh working = working_mesh(start, boundary_faces(start));
  Boundary_vertex_merger merger(working, quality, worst);
  std::vector<Vertex_index> order(start.number_of_vertices());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  for(Vertex_index v : order) {
    if(!working.is_on_boundary(v))
      continue;
    const std::size_t before = working.merged.size();
    const Vertex_index w = merger(v, working.points[v], [](Vertex_index) { return true; });
    BOOST_TEST_EQ(working.merged.size(), before + (w != no_vertex));
    if(w == no_vertex)
      continue;
    Mesh mesh = start;
    working.store(mesh);
    BOOST_TEST_EQ(mesh.number_of_vertices(), start.number_of_vertices() - working.merged.size());
    BOOST_TEST(find_defects(mesh).none());
    for(Subdomain_index index : indices) {
      const Mesh before_part = part(start, index), after_part = part(mesh, index);
      BOOST_TEST(find_defects(after_part).none());
      BOOST_TEST_EQ(internal::shells_of_boundary(after_part).number_of_shells,
                    internal::shells_of_boundary(before_part).number_of_shells);
      BOOST_TEST_EQ(internal::shells_of_boundary(after_part).euler_characteristic,
                    internal::shells_of_boundary(before_part).euler_characteristic);
    }
    BOOST_TEST_EQ(internal::shells_of_boundary(mesh).euler_characteristic,
                  internal::shells_of_boundary(start).euler_characteristic);
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      BOOST_TEST(quality(mesh.element(e).kind(), internal::element_points(mesh, mesh.element(e))) <= worst);
  }
  return working.merged.size();
}

void test_cells()
{
  const auto is_in_middle = [](int i) { return i == 1; };
  std::size_t merged = 0;
  for(unsigned seed = 1; seed <= 3; ++seed) {
    merged += test_merging(cells_of_grid(3, seed, [](const Cell&) { return 1; }), seed);
    // The meshes have a tunnel, a cavity, walls and gaps of one cell.
    merged += test_merging(
      cells_of_grid(3, seed, [&](const Cell& c) { return !(is_in_middle(c[0]) && is_in_middle(c[1])); }),
      seed);
    merged += test_merging(
      cells_of_grid(3, seed, [&](const Cell& c) { return !std::all_of(c.begin(), c.end(), is_in_middle); }),
      seed);
    merged += test_merging(cells_of_grid(4, seed, [](const Cell& c) { return c[0] % 2 == 0 || c[2] == 0; }),
                           seed);
    // Subdomains are beside each other, and one within another.
    merged += test_merging(cells_of_grid(4, seed, [](const Cell& c) { return c[0] < 2 ? 1 : 2; }), seed);
    merged += test_merging(
      cells_of_grid(3, seed, [&](const Cell& c) { return is_in_middle(c[0]) && is_in_middle(c[2]) ? 2 : 1; }),
      seed);
  }
  BOOST_TEST(merged > 100);
}

void test_bound()
{
  const Mesh start = cells_of_grid(3, 1, [](const Cell&) { return 1; });
  BOOST_TEST(test_merging(start, 1, 3) < test_merging(start, 1));
}

// Elements that are no tetrahedra may have the vertex, but not the edge.
void test_other_kinds()
{
  for(Element_kind kind : {HEXAHEDRON, PRISM, PYRAMID})
    BOOST_TEST_EQ(test_merging(grid(2, kind), 1), 0u);
  test_merging(four_kinds<Mesh>(1, {0, 0, 0}), 1);
}

// A corner of a cube is nearer to places beyond it than any faces without it.
void test_place()
{
  const Mesh start = cells_of_grid(2, 1, [](const Cell&) { return 1; });
  const Aspect_ratio_quality_3 quality;
  const Vec3 center{0.5, 0.5, 0.5};
  int number_of_corners = 0;
  for(Vertex_index v = 0; v < start.number_of_vertices(); ++v) {
    Working_mesh working = working_mesh(start, boundary_faces(start));
    Boundary_vertex_merger merger(working, quality, infinity);
    const Vec3 p = working.points[v];
    if(norm(p - center) < 0.8)
      continue;
    ++number_of_corners;
    BOOST_TEST_EQ(merger(v, p + 2. * (p - center), [](Vertex_index) { return true; }), no_vertex);
    BOOST_TEST_NE(merger(v, center, [](Vertex_index) { return true; }), no_vertex);
  }
  BOOST_TEST_EQ(number_of_corners, 8);
}

// The mesh without the elements of a vertex, and without vertices that have no element then.
Mesh without(const Mesh& start, Vertex_index v)
{
  Mesh mesh;
  std::vector<Vertex_index> numbers(start.number_of_vertices(), no_vertex);
  for(Element_index e = 0; e < start.number_of_elements(); ++e) {
    const Element_view element = start.element(e);
    if(std::find(element.begin(), element.end(), v) != element.end())
      continue;
    std::vector<Vertex_index> vertices;
    for(Vertex_index u : element) {
      if(numbers[u] == no_vertex)
        numbers[u] = mesh.add_vertex(start.point(u));
      vertices.push_back(numbers[u]);
    }
    mesh.add_element(element.kind(), vertices);
  }
  return mesh;
}

// Each vertex of the boundary may be removed if, and only if, what is left is without defects, has the same
// topology, and no inner vertex of the start on its boundary: by brute force.
// \return the number of vertices that may be removed, and of those that others go with
std::array<std::size_t, 2> test_removal(const Mesh& start)
{
  std::array<std::size_t, 2> numbers{0, 0};
  const Working_mesh whole = working_mesh(start, boundary_faces(start));
  const Shell_counts shells = internal::shells_of_boundary(start);
  const std::size_t inside = start.number_of_vertices() - boundary_vertices(start).size();
  for(Vertex_index v = 0; v < start.number_of_vertices(); ++v) {
    if(!whole.is_on_boundary(v))
      continue;
    const internal::Vertex_removal removal = internal::find_removal(whole, v);
    const Mesh rest = without(start, v);
    bool is_same = !rest.is_empty() && find_defects(rest).none()
                   && rest.number_of_vertices() - boundary_vertices(rest).size() == inside;
    if(is_same) {
      const Shell_counts of_rest = internal::shells_of_boundary(rest);
      is_same = of_rest.number_of_shells == shells.number_of_shells
                && of_rest.euler_characteristic == shells.euler_characteristic;
    }
    BOOST_TEST_EQ(!removal.faces.empty(), is_same);
    if(removal.faces.empty())
      continue;
    ++numbers[0];
    numbers[1] += removal.vertices.size() > 1;
    Working_mesh working = whole;
    internal::remove_vertex(working, v, removal);
    Mesh mesh = start;
    working.store(mesh);
    BOOST_TEST_EQ(mesh.number_of_vertices(), start.number_of_vertices() - removal.vertices.size());
    BOOST_TEST_EQ(mesh.number_of_vertices(), rest.number_of_vertices());
    BOOST_TEST_EQ(mesh.number_of_elements(), rest.number_of_elements());
    BOOST_TEST(find_defects(mesh).none());
  }
  return numbers;
}

// Meshes with spikes, tunnels, cavities and walls: those of cells, of which elements are taken away that
// leave a manifold.
void test_removals()
{
  std::array<std::size_t, 2> sum{0, 0};
  for(unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    Mesh mesh = cells_of_grid(3, seed,
                              [&](const Cell& c) { return seed % 3 == 0 || c[0] != 1 || c[1] == 1; });
    for(int i = 0; i < 60; ++i) {
      const auto v = Vertex_index(
        std::uniform_int_distribution<std::size_t>(0, mesh.number_of_vertices() - 1)(random));
      const Mesh rest = without(mesh, v);
      if(!rest.is_empty() && find_defects(rest).none())
        mesh = rest;
      if(i % 20 != 0)
        continue;
      const std::array<std::size_t, 2> numbers = test_removal(mesh);
      sum = {sum[0] + numbers[0], sum[1] + numbers[1]};
    }
  }
  BOOST_TEST_GT(sum[0], 50u);
  BOOST_TEST_GT(sum[1], 5u);
}

// Where several subdomains meet, interfaces stay: each subdomain is without defects after each removal.
void test_removals_beside_interfaces()
{
  std::size_t number = 0;
  for(unsigned seed = 1; seed <= 6; ++seed) {
    const Mesh start = cells_of_grid(4, seed, [&](const Cell& c) { return c[0] < 2 ? 1 : 2; });
    const Working_mesh whole = working_mesh(start, boundary_faces(start));
    for(Vertex_index v = 0; v < start.number_of_vertices(); ++v) {
      const internal::Vertex_removal removal = whole.is_on_boundary(v) ? internal::find_removal(whole, v)
                                                                       : internal::Vertex_removal();
      if(removal.faces.empty())
        continue;
      ++number;
      Working_mesh working = whole;
      internal::remove_vertex(working, v, removal);
      Mesh mesh = start;
      working.store(mesh);
      BOOST_TEST(find_defects(mesh).none());
      for(Subdomain_index index : {1, 2})
        BOOST_TEST(find_defects(part(mesh, index)).none());
    }
  }
  BOOST_TEST_GT(number, 0u);
}

int run(int, char*[])
{
  test_removals();
  test_removals_beside_interfaces();
  test_cells();
  test_bound();
  test_other_kinds();
  test_place();
  return boost::report_errors();
}

} // namespace test_fitting_merging
