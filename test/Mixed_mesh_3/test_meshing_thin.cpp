// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walls and gaps that are thinner than the cells of a budget spent evenly: wrong without, right with thin
// parts first.

#include "test_lattice.h"
#include "test_meshing.h"

#include <CGAL/Mixed_mesh_3/fidelity.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Gap_widener.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <boost/core/lightweight_test.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
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

// The surface turned, so that it is not parallel to the axes.
Surface turned(const Surface& s)
{
  return transformed(s, [](const Point_3& p) {
    const double x = 0.8 * p.x() - 0.6 * p.y(), y = 0.6 * p.x() + 0.8 * p.y();
    return Point_3(x, 0.96 * y - 0.28 * p.z(), 0.28 * y + 0.96 * p.z());
  });
}

// Meshes and compares by `compare_with_surface()`, and checks that the mesh is valid.
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
  BOOST_TEST_GT(result.number_of_vertices_for_thin_parts + result.number_of_collapsed_vertices, 0u);
}

// A wall with room for flatter elements only: these are taken, and counted, unless the bound is strict.
void test_flatter_elements()
{
  Surface shell;
  add_sphere(shell, Point_3(0, 0, 0), 1, 24);
  Surface inner = sphere(Point_3(0, 0, 0), 0.95, 24);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(inner);
  shell += inner;
  const Mixed_mesh_criteria_3 criteria(500);
  Mesh mesh;
  const auto result = make_mixed_mesh_3(shell, criteria, mesh);
  const auto& fit = result.optimization;
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST(find_defects(mesh).none());
  BOOST_TEST_GT(result.quality_bound, criteria.quality_bound());
  BOOST_TEST_LE(result.quality_bound, 5 * criteria.quality_bound());
  BOOST_TEST_EQ(fit.quality_bound, criteria.quality_bound());
  BOOST_TEST_EQ(fit.number_of_elements_above_bound, number_of_elements_above(mesh, criteria.quality_bound()));
  BOOST_TEST_GT(fit.number_of_elements_above_bound, 0u);
  BOOST_TEST_EQ(number_of_elements_above(mesh, result.quality_bound), 0u);
  const auto strict = make_mixed_mesh_3(shell, Mixed_mesh_criteria_3(criteria).strict_quality_bound(true),
                                        mesh);
  BOOST_TEST(strict.status >= Status::NOT_ALL_ARRIVED);
  BOOST_TEST_EQ(strict.quality_bound, criteria.quality_bound());
  BOOST_TEST_EQ(number_of_elements_above(mesh, criteria.quality_bound()), 0u);
}

// Where all is right already, nothing is done for thin parts.
void test_untouched()
{
  const Surface ball = sphere(Point_3(0, 0, 0), 1, 16);
  Mixed_mesh_result_3 result;
  mesh_and_compare("ball", ball, 600, Thin_parts::WHERE_NEEDED, result);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_EQ(result.number_of_vertices_for_thin_parts, 0u);
}

// A mesh of cells as thin as a pane has too many vertices, and is coarsened. If even that does not suffice,
// the outcome is no success, and the need for more vertices is reported.
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

// A visitor that stops the run is not asked again, at any trial or round.
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
  using CGAL::Mixed_meshes_3::internal::find_shells;
  using Triangles = std::vector<std::array<std::size_t, 3>>;
  const Triangles tetrahedron = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  BOOST_TEST_EQ(find_shells(tetrahedron, 4).counts.number_of_shells, 1u);
  BOOST_TEST_EQ(find_shells(tetrahedron, 4).counts.euler_characteristic, 2);
  Triangles two = tetrahedron;
  for(const auto& t : tetrahedron)
    two.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  BOOST_TEST_EQ(find_shells(two, 9).counts.number_of_shells, 2u); // one vertex is of no polygon
  BOOST_TEST_EQ(find_shells(two, 9).counts.euler_characteristic, 4);
  const Polyhedral_mixed_mesh_domain_3 ring(torus(1, 0.4, 12, 9));
  BOOST_TEST_EQ(ring.shells().number_of_shells, 1u);
  BOOST_TEST_EQ(ring.shells().euler_characteristic, 0);
}

// Two bodies, and a body with a cavity, have the same number of shells; the orientation of faces does not
// matter.
void test_cavities()
{
  const auto reversed = [](Surface s) {
    CGAL::Polygon_mesh_processing::reverse_face_orientations(s);
    return s;
  };
  const Surface ball = sphere(Point_3(0, 0, 0), 1, 8), small = sphere(Point_3(0.1, 0, 0), 0.3, 8),
                smaller = sphere(Point_3(0.1, 0.1, 0), 0.1, 8), beside = sphere(Point_3(3, 0, 0), 0.5, 8);
  const auto cavities = [](std::initializer_list<Surface> shells) {
    Surface all;
    for(const Surface& s : shells)
      all += s;
    const Shell_counts counts = Polyhedral_mixed_mesh_domain_3(all).shells();
    BOOST_TEST_EQ(counts.number_of_shells, shells.size());
    BOOST_TEST_EQ(counts.euler_characteristic, std::ptrdiff_t(2 * shells.size()));
    return *counts.number_of_cavities;
  };
  BOOST_TEST_EQ(cavities({ball}), 0u);
  BOOST_TEST_EQ(cavities({ball, beside}), 0u);
  BOOST_TEST_EQ(cavities({ball, reversed(beside)}), 0u);
  BOOST_TEST_EQ(cavities({ball, reversed(small)}), 1u);
  BOOST_TEST_EQ(cavities({reversed(ball), small, beside}), 1u);
  BOOST_TEST_EQ(cavities({ball, reversed(small), smaller}), 1u); // a body in a cavity

  Mesh mesh; // what is counted of the mesh agrees
  Surface hollow = ball;
  hollow += reversed(sphere(Point_3(0.1, 0, 0), 0.5, 8));
  const auto result = make_mixed_mesh_3(hollow, 1500, mesh);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_EQ(*result.shells->number_of_cavities, 1u);
  BOOST_TEST_EQ(*result.shells_of_domain->number_of_cavities, 1u);
  BOOST_TEST((Shell_counts{2, 4, 1}) == (Shell_counts{2, 4}));
  BOOST_TEST((Shell_counts{2, 4, 1}) != (Shell_counts{2, 4, 0}));
}

// ---- gaps on the lattice ------------------------------------------------------------------------

// Depth in a box with half of these sides and this center, in a turned system: positive inside.
double depth_in_box(const Vec3& p, const Vec3& center, const Vec3& half)
{
  const Vec3 d = p - center;
  const Vec3 q = {std::abs(0.576 * d[0] + 0.768 * d[1] - 0.28 * d[2]) - half[0],
                  std::abs(0.8 * d[0] - 0.6 * d[1]) - half[1],
                  std::abs(0.168 * d[0] + 0.224 * d[1] + 0.96 * d[2]) - half[2]};
  const double outside = std::hypot((std::max)(q[0], 0.), (std::max)(q[1], 0.), (std::max)(q[2], 0.));
  return -outside - (std::min)((std::max)({q[0], q[1], q[2]}), 0.);
}

struct Two_boxes
{
  Vec3 half[2], center[2];

  // Boxes on both sides of a gap at right angles to the first direction of the boxes.
  Two_boxes(double thickness, double other_thickness, double gap)
    : half{{thickness / 2, 0.22, 0.2}, {other_thickness / 2, 0.2, 0.22}}
  {
    const Vec3 direction = {0.576, 0.768, -0.28}, middle = {0.51, 0.49, 0.5};
    center[0] = middle - ((gap + thickness) / 2) * direction;
    center[1] = middle + ((gap + other_thickness) / 2) * direction;
  }

  double depth(const Test_point& p, int i) const { return depth_in_box(to_vec3(p), center[i], half[i]); }
};

// Vertices and elements that join the boxes, and the numbers of vertices inside of each box.
struct Joints
{
  std::size_t count = 0;
  std::array<std::size_t, 2> inside{};
};

Joints joints_of(const Located_octree& octree, const internal::Lattice_mesh& mesh, const Two_boxes& boxes)
{
  Joints joints;
  std::vector<int> own(mesh.vertices.size(), 0), around(mesh.vertices.size(), 0); // bits, one a box
  for(Vertex_index v = 0; v < own.size(); ++v)
    if(mesh.is_inside(v)) {
      const int box = boxes.depth(octree.point(mesh.vertices[v]), 0) > 0 ? 0 : 1;
      own[v] = 1 << box;
      ++joints.inside[box];
    }
  for(Element_index e = 0; e < mesh.elements.size(); ++e) {
    const Element_view element = mesh.elements[e];
    int all = 0;
    for(Vertex_index v : element)
      all |= own[v];
    for(Vertex_index v : element)
      around[v] |= all;
  }
  joints.count = std::size_t(std::count(around.begin(), around.end(), 3));
  return joints;
}

void test_gaps()
{
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const Everywhere_mixed_mesh_region_3 region;
  for(const double gap : {0.08, 0.03, 0.01, 0.004})
    for(const int level : {4, 5}) {
      const double edge = std::ldexp(1., -level);
      const Two_boxes boxes(0.3, 0.25, gap);
      const Analytic_domain domain(
        [&](const Test_point& p) { return (std::max)(boxes.depth(p, 0), boxes.depth(p, 1)); });
      Located_octree octree(domain, region, traits);
      for(int i = 0; i < level; ++i)
        octree.refine(octree.leaves_to_refine(i, false));
      internal::Lattice_mesh mesh = internal::apply_transitions(octree,
                                                                Transition_templates_choice::FEWEST_VERTICES);
      const Joints before = joints_of(octree, mesh, boxes);
      BOOST_TEST(before.count > 0 || gap > edge);
      internal::widen_gaps_by_lines(octree, mesh);
      const Joints after = joints_of(octree, mesh, boxes);
      std::cout << "gap of " << gap / edge << " cells: " << before.count << " joints, then " << after.count
                << "; inside " << before.inside[0] << " and " << before.inside[1] << ", then "
                << after.inside[0] << " and " << after.inside[1] << std::endl;
      BOOST_TEST_EQ(after.count, 0u);
      BOOST_TEST(after.inside[0] > before.inside[0] / 2 && after.inside[1] > before.inside[1] / 2);
    }
}

int run(int, char*[])
{
  test_gaps();
  test_shell_counts();
  test_cavities();
  test_untouched();
  test_flatter_elements();
  Surface balls = sphere(Point_3(-0.55, 0.07, 0.03), 0.5, 24);
  add_sphere(balls, Point_3(0.55, 0.07, 0.03), 0.5, 24);
  test_becomes_right("two balls", balls, 2000);
  Surface blocks = turned(box(Point_3(-1, -0.5, -0.5), Point_3(-0.02, 0.4, 0.4)));
  blocks += turned(box(Point_3(0, -0.4, -0.5), Point_3(1, 0.5, 0.4)));
  test_becomes_right("two blocks", blocks, 2000);
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
