// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walls and gaps that are thinner than the cells of a budget spent evenly: wrong without, right with them
// first.

#include "test_meshing.h"

#include <CGAL/Mixed_mesh_3/fidelity.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <boost/core/lightweight_test.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace test_meshing_thin {

Surface torus(double radius, double small_radius, int n, int m)
{
  Surface s;
  std::vector<Surface::Vertex_index> v;
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < m; ++j) {
      const double a = 2 * M_PI * i / n, b = 2 * M_PI * j / m, r = radius + small_radius * std::cos(b);
      v.push_back(s.add_vertex(Point_3(r * std::cos(a), r * std::sin(a), small_radius * std::sin(b))));
    }
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < m; ++j) {
      const int k = (i + 1) % n, l = (j + 1) % m;
      s.add_face(v[i * m + j], v[k * m + j], v[k * m + l]);
      s.add_face(v[i * m + j], v[k * m + l], v[i * m + l]);
    }
  return s;
}

// Not parallel to the axes.
Surface turned(const Surface& s)
{
  return transformed(s, [](const Point_3& p) {
    const double x = 0.8 * p.x() - 0.6 * p.y(), y = 0.6 * p.x() + 0.8 * p.y();
    return Point_3(x, 0.96 * y - 0.28 * p.z(), 0.28 * y + 0.96 * p.z());
  });
}

// What a mesh is like by `compare_with_surface()`, and that it is valid.
Solid_comparison mesh_and_compare(const std::string& name, const Surface& surface, std::size_t budget,
                                  Thin_parts thin_parts, Mixed_mesh_result_3& result)
{
  Mesh mesh;
  result = make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(surface),
                             Mixed_mesh_criteria_3(budget).thin_parts(thin_parts), mesh);
  BOOST_TEST(result.has_mesh());
  BOOST_TEST_LE(mesh.number_of_vertices(), budget);
  BOOST_TEST(find_defects(mesh).none());
  Solid_comparison c = compare_with_surface(mesh, surface);
  std::cout << name << ": " << mesh.number_of_vertices() << " vertices, status " << int(result.status)
            << ", volume " << c.ratio_of_volumes() << ", about " << result.number_of_vertices_for_thin_parts
            << " vertices for thin parts";
  for(const Solid_difference& d : c.differences)
    std::cout << "; " << d.sentence;
  std::cout << std::endl;
  return c;
}

void test_becomes_right(const std::string& name, const Surface& surface, std::size_t budget)
{
  Mixed_mesh_result_3 result;
  const Solid_comparison before = mesh_and_compare(name + ", like others", surface, budget,
                                                   Thin_parts::LIKE_OTHERS, result);
  BOOST_TEST(!before.has_same_topology());
  BOOST_TEST_EQ(result.number_of_vertices_for_thin_parts, 0u);
  const Solid_comparison after = mesh_and_compare(name, surface, budget, Thin_parts::WHERE_NEEDED, result);
  BOOST_TEST(after.has_same_topology());
  BOOST_TEST_LE(std::abs(after.ratio_of_volumes() - 1), 0.05);
  BOOST_TEST_GT(result.number_of_vertices_for_thin_parts, 0u);
}

// Nothing changes where all is right already, and it costs nothing: no octree more.
void test_untouched()
{
  const Surface ball = sphere(Point_3(0, 0, 0), 1, 16);
  Mixed_mesh_result_3 plain, result;
  mesh_and_compare("ball", ball, 600, Thin_parts::LIKE_OTHERS, plain);
  mesh_and_compare("ball", ball, 600, Thin_parts::WHERE_NEEDED, result);
  BOOST_TEST_EQ(plain.number_of_trials, result.number_of_trials);
  BOOST_TEST_EQ(result.number_of_vertices_for_thin_parts, 0u);
}

// Where cells as thin as a pane are too many, a mesh of those is coarsened. Where even they are too few, it
// is no success, and it is told that more vertices are needed.
void test_pane()
{
  Mixed_mesh_result_3 result;
  const auto pane = [](double thickness) { return turned(box(Point_3(0, 0, 0), Point_3(1, 1, thickness))); };
  const Solid_comparison c = mesh_and_compare("pane", pane(0.04), 600, Thin_parts::WHERE_NEEDED, result);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST(c.has_same_topology());
  BOOST_TEST_LE(std::abs(c.ratio_of_volumes() - 1), 0.05);
  BOOST_TEST_GT(result.number_of_collapsed_vertices, 0u);

  mesh_and_compare("film", pane(0.004), 600, Thin_parts::WHERE_NEEDED, result);
  BOOST_TEST(result.status != Status::SUCCESS);
  BOOST_TEST_GT(result.number_of_vertices_for_thin_parts, 10000u);
}

// A visitor that stops the run is not asked again, at whatever trial or round.
void test_stopped()
{
  struct Stopping : Default_visitor
  {
    std::size_t stop_at = std::size_t(-1), questions = 0;
    bool go_on() { return questions++ != stop_at; }
  };
  const Polyhedral_mixed_mesh_domain_3 domain(turned(box(Point_3(0, 0, 0), Point_3(1, 1, 0.04))));
  const auto criteria = Mixed_mesh_criteria_3(600).keep_mesh_if_stopped(true);
  const auto run = [&](Stopping& visitor, Mesh& mesh) {
    return make_mixed_mesh_3(domain, criteria, mesh, CGAL::parameters::visitor(std::ref(visitor)));
  };
  Mesh mesh;
  Stopping all;
  run(all, mesh);
  for(std::size_t i = 0; i < all.questions; i += all.questions / 6) {
    Stopping visitor;
    visitor.stop_at = i;
    const Mixed_mesh_result_3 result = run(visitor, mesh);
    BOOST_TEST(result.status == Status::STOPPED);
    BOOST_TEST_EQ(visitor.questions, i + 1);
    BOOST_TEST_EQ(result.has_mesh(), !mesh.is_empty());
    BOOST_TEST_LE(mesh.number_of_vertices(), 600u);
    if(result.has_mesh())
      BOOST_TEST(find_defects(mesh).none());
  }
}

void test_shell_counts()
{
  using CGAL::Mixed_meshes_3::internal::shell_counts;
  using Triangles = std::vector<std::array<std::size_t, 3>>;
  const Triangles tetrahedron = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  BOOST_TEST_EQ(shell_counts(tetrahedron, 4).number_of_shells, 1u);
  BOOST_TEST_EQ(shell_counts(tetrahedron, 4).euler_characteristic, 2);
  Triangles two = tetrahedron;
  for(const auto& t : tetrahedron)
    two.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  BOOST_TEST_EQ(shell_counts(two, 9).number_of_shells, 2u); // one vertex is of no polygon
  BOOST_TEST_EQ(shell_counts(two, 9).euler_characteristic, 4);
  const Polyhedral_mixed_mesh_domain_3 ring(torus(1, 0.4, 12, 9));
  BOOST_TEST_EQ(ring.shells().number_of_shells, 1u);
  BOOST_TEST_EQ(ring.shells().euler_characteristic, 0);
}

int run(int, char*[])
{
  test_shell_counts();
  test_untouched();
  Surface balls = sphere(Point_3(-0.55, 0.07, 0.03), 0.5, 24);
  add_sphere(balls, Point_3(0.55, 0.07, 0.03), 0.5, 24);
  test_becomes_right("two balls", balls, 2000);
  test_becomes_right("ring with a narrow hole", torus(0.45, 0.4, 32, 16), 2000);
  Surface hollow = sphere(Point_3(0, 0, 0), 1, 16);
  Surface cavity = sphere(Point_3(0, 0, 0), 0.12, 8);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(cavity);
  hollow += cavity;
  test_becomes_right("ball with a void", hollow, 1000);
  test_pane();
  test_stopped();
  return boost::report_errors();
}

} // namespace test_meshing_thin
