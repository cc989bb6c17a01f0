// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices that move by colors or by levels: no two vertices of an element move at the same time, and the
// result is the same with any number of threads.

#include "test_fitting.h"
#include "test_strata.h"

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_coloring.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_optimizer.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Transaction.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace test_fitting_colors {

using namespace CGAL::Mixed_meshes_3;
using internal::Vertex_coloring;
using internal::Working_mesh;

// A grid of cubes whose vertices were moved a little, boundary vertices as well.
Mesh shaken_grid(int n)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  Mesh mesh;
  const auto vertex = [n](int i, int j, int k) {
    return Vertex_index(std::size_t(i + (n + 1) * (j + (n + 1) * k)));
  };
  for(int k = 0; k <= n; ++k)
    for(int j = 0; j <= n; ++j)
      for(int i = 0; i <= n; ++i) {
        const double x = i + uniform(random), y = j + uniform(random), z = k + uniform(random);
        mesh.add_vertex(Mesh::Point_3(x, y, z));
      }
  for(int k = 0; k < n; ++k)
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
        mesh.add_element(HEXAHEDRON, {vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j + 1, k),
                                      vertex(i, j + 1, k), vertex(i, j, k + 1), vertex(i + 1, j, k + 1),
                                      vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1)});
  return mesh;
}

Working_mesh shaken_cubes(int n)
{
  const Mesh mesh = shaken_grid(n);
  return working_mesh(mesh, boundary_faces(mesh));
}

// Checks that each vertex has one color, and no two vertices of an element have the same.
void check_colors(const Working_mesh& mesh, const Vertex_coloring& coloring)
{
  std::vector<std::size_t> color_of(mesh.points.size(), coloring.vertices().size());
  for(std::size_t color = 0; color < coloring.vertices().size(); ++color) {
    const std::vector<Vertex_index>& vertices = coloring.vertices()[color];
    BOOST_TEST(!vertices.empty() && std::is_sorted(vertices.begin(), vertices.end()));
    for(Vertex_index v : vertices) {
      BOOST_TEST_EQ(color_of[v], coloring.vertices().size());
      color_of[v] = color;
    }
  }
  for(const Working_mesh::Element& element : mesh.elements)
    if(!element.is_removed)
      for(const Vertex_index* v = element.begin(); v != element.end(); ++v)
        BOOST_TEST(
          color_of[*v] < coloring.vertices().size()
          && std::none_of(element.begin(), v, [&](Vertex_index u) { return color_of[u] == color_of[*v]; }));
}

void test_coloring()
{
  Working_mesh mesh = shaken_cubes(5);
  Vertex_coloring coloring;
  coloring.update(mesh);
  check_colors(mesh, coloring);
  BOOST_TEST_EQ(coloring.vertices().size(), 8u); // every other one in three directions

  // New elements are between vertices of the same color, and there is a new vertex.
  internal::Transaction transaction(mesh);
  const Vertex_index middle = transaction.add_vertex({2.5, 2.5, 2.5}, internal::free_stratum, {0, 1});
  std::size_t i = 0;
  for(const std::vector<Vertex_index>& same : std::vector(coloring.vertices())) {
    transaction.add({TETRAHEDRON, false, {}, {same[0], same[1], same[2], middle}});
    transaction.remove(Element_index(i++));
  }
  coloring.update(mesh);
  check_colors(mesh, coloring);
}

double largest_cost(const Working_mesh& mesh)
{
  double largest = 0;
  for(const Working_mesh::Element& element : mesh.elements)
    largest = (std::max)(largest, Aspect_ratio_quality_3()(element.kind, mesh.relative_points(element)));
  return largest;
}

void test_threads(bool by_colors)
{
  const Working_mesh start = shaken_cubes(13);
  const Aspect_ratio_quality_3 quality;
  const Test_projection project{[](const Vec3& p, const Vec3&) { return p; }};
  std::vector<Vec3> first;
  for(unsigned threads : {1, 2, 3, 7, 2}) {
    Working_mesh mesh = start;
    internal::Vertex_optimizer optimizer(mesh, quality, project, 1., 1000.);
    optimizer.use_threads(threads);
    if(by_colors)
      optimizer.use_colors();
    optimizer.activate_all();
    optimizer.run(4, 1, 6);
    for(const Working_mesh::Element& element : mesh.elements)
      BOOST_TEST(mesh.is_positive(element));
    BOOST_TEST_LT(largest_cost(mesh), largest_cost(start));
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      BOOST_TEST(!mesh.is_on_boundary(v) || mesh.points[v] == start.points[v]);
    if(first.empty())
      first = mesh.points;
    BOOST_TEST(mesh.points == first);
  }
  BOOST_TEST(first != start.points);
}

// Whether a vertex is in the layers at the sides of a grid, in each direction.
bool is_in_layers(Vertex_index v, int n, int layers)
{
  int i = int(v);
  for(int k = 0; k < 3; ++k, i /= n + 1)
    if((std::min)(i % (n + 1), n - i % (n + 1)) <= layers)
      return true;
  return false;
}

// Vertices far from the boundary move only if an element is bad, or if all elements are tetrahedra.
void test_inside()
{
  constexpr int n = 9, layers = 2;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Aspect_ratio_quality_3 quality;
  const Test_projection project{[](const Vec3& p, const Vec3&) { return p; }};
  const auto moved = [&](const Working_mesh& start, double good_enough_inside) {
    Working_mesh mesh = start;
    internal::Vertex_optimizer optimizer(mesh, quality, project, 1., 1000.);
    optimizer.set_good_enough_inside(good_enough_inside, layers);
    optimizer.activate_all();
    optimizer.run(4, 1, 3);
    return mesh.points;
  };
  for(const bool is_of_tetrahedra : {false, true}) {
    const Mesh grid = is_of_tetrahedra ? split_to_tetrahedra(shaken_grid(n)) : shaken_grid(n);
    const Working_mesh start = working_mesh(grid, boundary_faces(grid));
    const std::vector<Vec3> all = moved(start, 1), near = moved(start, infinity), bad = moved(start, 2);
    std::size_t number[2] = {0, 0}; // of vertices that moved: at the boundary, inside
    for(Vertex_index v = 0; v < start.points.size(); ++v)
      number[!is_in_layers(v, n, layers)] += near[v] != start.points[v];
    BOOST_TEST_GT(number[0], 100u);
    BOOST_TEST_EQ(number[1] > 0, is_of_tetrahedra);
    BOOST_TEST_EQ(all == near, is_of_tetrahedra);
    BOOST_TEST_EQ(bad == near, is_of_tetrahedra);
    BOOST_TEST_EQ(all == bad, is_of_tetrahedra);
  }
}

int run(int, char*[])
{
  test_coloring();
  test_inside();
  for(const bool by_colors : {true, false})
    test_threads(by_colors);
  return boost::report_errors();
}

} // namespace test_fitting_colors
