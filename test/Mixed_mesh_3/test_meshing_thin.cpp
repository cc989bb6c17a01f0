// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walls and gaps that are thinner than the cells of the octree: lost or filled by its own mesh, kept by one
// that is cut along the surface.

#include "test_lattice.h"
#include "test_meshing.h"

#include <CGAL/Mixed_mesh_3/fidelity.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/cut_by_interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/layer_cells.h>
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
#include <utility>
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
                                  bool simplification, Mixed_mesh_result_3& result)
{
  Mesh mesh;
  result = make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(surface),
                             Mixed_mesh_criteria_3(budget).simplification(simplification), mesh);
  BOOST_TEST(result.has_mesh());
  BOOST_TEST_LE(mesh.number_of_vertices(), budget);
  BOOST_TEST(find_defects(mesh).none());
  Solid_comparison c = compare_with_surface(mesh, surface);
  std::cout << name << ": " << mesh.number_of_vertices() << " vertices, status " << int(result.status)
            << ", volume " << c.ratio_of_volumes();
  for(const Solid_difference& d : c.differences)
    std::cout << "; " << d.sentence;
  std::cout << std::endl;
  return c;
}

void test_becomes_right(const std::string& name, const Surface& surface, std::size_t budget)
{
  Mixed_mesh_result_3 result;
  const Solid_comparison before = mesh_and_compare(name + ", the octree's", surface, budget, false, result);
  BOOST_TEST(!before.has_same_topology());
  BOOST_TEST_EQ(result.number_of_collapsed_vertices, 0u);
  const Solid_comparison after = mesh_and_compare(name, surface, budget, true, result);
  BOOST_TEST(after.has_same_topology());
  BOOST_TEST_LE(std::abs(after.ratio_of_volumes() - 1), 0.05);
  BOOST_TEST_GT(result.number_of_collapsed_vertices, 0u);
}

// A wall with room for flatter elements only: these are taken, and counted, unless the bound is strict.
void test_flatter_elements()
{
  Surface shell;
  add_sphere(shell, Point_3(0, 0, 0), 1, 24);
  Surface inner = sphere(Point_3(0, 0, 0), 0.95, 24);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(inner);
  shell += inner;
  const Mixed_mesh_criteria_3 criteria(1500);
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

// A pane gets elements that are as flat as it asks for; where these would be too flat, the outcome is no
// success.
void test_pane()
{
  Mixed_mesh_result_3 result;
  const auto pane = [](double thickness) { return turned(box(Point_3(0, 0, 0), Point_3(1, 1, thickness))); };
  const Solid_comparison c = mesh_and_compare("pane", pane(0.04), 600, true, result);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST(c.has_same_topology());
  BOOST_TEST_LE(std::abs(c.ratio_of_volumes() - 1), 0.05);
  BOOST_TEST_GT(result.number_of_collapsed_vertices, 0u);

  mesh_and_compare("film", pane(0.004), 600, true, result);
  BOOST_TEST(result.status != Status::SUCCESS);
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

// With the weights, a few small shells get vertices enough by the rule that is stated there; where there are
// too few for all, the largest shells do.
void test_weights_of_shells()
{
  using CGAL::Mixed_meshes_3::internal::weights_of_shells;
  const std::vector<double> ones(3, 1);
  BOOST_TEST(weights_of_shells({1}, 2000) == std::vector<double>{1});
  BOOST_TEST(weights_of_shells({0.9, 1, 1.1}, 2000) == ones);  // each has its share
  BOOST_TEST(weights_of_shells({0.1, 1, 0.001}, 300) == ones); // no vertices are left
  const std::vector<double> few = weights_of_shells({0.1, 1, 0.001}, 2000);
  BOOST_TEST_GT(few[0], 1);
  BOOST_TEST_EQ(few[1], 1);
  BOOST_TEST_EQ(few[2], 1); // a speck
  const double share = std::sqrt(few[0]) * std::pow(0.1, 1.5);
  BOOST_TEST_GT(1000 * share / (share + 1), 120);
  const std::vector<double> many = weights_of_shells(std::vector<double>(100, 0.1), 2000);
  BOOST_TEST_EQ(std::count(many.begin(), many.end(), 1), 95); // the largest, and those that none are left for
}

// Small shells whose volume is not right where cells and vertices are as large as beside them.
void test_small_shells()
{
  const auto check = [](const char* name, const Surface& surface) {
    Mesh mesh;
    const auto result = make_mixed_mesh_3(surface, 2000, mesh);
    std::cout << name << ":";
    for(std::size_t i = 0; i < result.shells->volumes.size(); ++i)
      std::cout << ' ' << result.shells->volumes[i] / result.shells_of_domain->volumes[i];
    std::cout << " of the volumes" << std::endl;
    BOOST_TEST(result.status == Status::SUCCESS);
  };
  Surface hollow = sphere(Point_3(0, 0, 0), 1, 24), cavity = sphere(Point_3(0.31, 0.2, 0.1), 0.12, 12);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(cavity);
  hollow += cavity;
  check("small cavity", hollow);
  Surface beside = sphere(Point_3(0, 0, 0), 1, 24);
  beside += sphere(Point_3(1.3, 0.2, 0.1), 0.06, 10);
  check("small body", beside);
}

// Plates, and gaps between boxes, in a lattice of cells of one size: cut along the surface, they are there,
// though they are thinner than the cells; and whatever their thickness, the elements are valid, and their
// boundary is a manifold that does not cut itself.
void test_cuts()
{
  const Aligned_traits traits({-1, -1, -1, 2, 2, 2});
  const Everywhere_mixed_mesh_region_3 region;
  for(const bool is_gap : {false, true})
    for(const double share : {2., 1., 0.6, 0.3, 0.1, 0.01}) // of the edge of a cell
      for(const int level : {3, 4}) {
        const double thickness = share * 3 * std::ldexp(1., -level);
        Surface surface = box(Point_3(0, 0, 0), Point_3(1, 1, is_gap ? 0.5 : thickness));
        if(is_gap)
          surface += box(Point_3(0, 0, 0.5 + thickness), Point_3(1, 1, 1 + thickness));
        const Polyhedral_mixed_mesh_domain_3 domain(turned(surface));
        Located_octree octree(domain, region, traits);
        for(int i = 0; i < level; ++i)
          octree.refine(octree.leaves_to_refine(i, false));
        internal::Known_edges known;
        const internal::Core_mesh mesh = internal::cut_by_interfaces(
          {octree, internal::apply_transitions(octree, Transition_templates_choice::FEWEST_VERTICES),
           [](internal::Octree::Node_index) { return false; }, known},
          true);
        const bool is_right = !mesh.is_empty() && internal::shells_of_boundary(mesh) == domain.shells();
        const double ratio = volume(mesh) / domain.volume();
        std::cout << (is_gap ? "gap" : "plate") << " of " << share << " cells, level " << level << ": "
                  << mesh.number_of_vertices() << " vertices, " << ratio << " of the volume"
                  << (is_right ? "" : ", another topology") << std::endl;
        if(!mesh.is_empty()) {
          BOOST_TEST(find_defects(mesh).none());
          BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
        }
        BOOST_TEST(is_right || share < 0.5);
        BOOST_TEST(std::abs(ratio - 1) < 0.1 || share < 0.5 || level == 3);
      }
}

// A prism over a triangle with an angle of 80 degrees in front, where a line at right angles to one face soon
// leads out of the other one.
Surface wedge()
{
  const double slope = 0.5 * std::tan(80 * M_PI / 360);
  Surface s;
  const Point_3 triangle[] = {{0, 0.5, 0}, {0.5, 0.5 - slope, 0}, {0.5, 0.5 + slope, 0}};
  std::vector<Surface::Vertex_index> v;
  for(double z : {0., 1.})
    for(const Point_3& p : triangle)
      v.push_back(s.add_vertex(Point_3(p.x(), p.y(), z)));
  s.add_face(v[0], v[2], v[1]);
  s.add_face(v[3], v[4], v[5]);
  for(std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    s.add_face(v[i], v[j], v[j + 3]);
    s.add_face(v[i], v[j + 3], v[i + 3]);
  }
  return turned(s);
}

// Cells are split for a plate, and for a gap between two blocks, but not for a wedge, which no cell is small
// enough for.
void test_layers()
{
  const Aligned_traits traits({-1, -1, -1, 2, 2, 2});
  const Everywhere_mixed_mesh_region_3 region;
  const double thickness = 0.3 * 3 / 16;
  Surface blocks = box(Point_3(0, 0, 0), Point_3(1, 1, 0.4));
  blocks += box(Point_3(0, 0, 0.4 + thickness), Point_3(1, 1, 1));
  const std::pair<Surface, bool> cases[] = {{turned(box(Point_3(0, 0, 0), Point_3(1, 1, thickness))), true},
                                            {turned(blocks), true},
                                            {wedge(), false}};
  for(const auto& [surface, has_layer] : cases) {
    const Polyhedral_mixed_mesh_domain_3 domain(surface);
    Located_octree octree(domain, region, traits);
    for(int level = 0; level < 4; ++level)
      octree.refine(octree.leaves_to_refine(level, false));
    const std::size_t number = octree.number_of_cells();
    BOOST_TEST(internal::split_layer_cells(octree, 100 * number));
    std::cout << "layers: " << number << " cells, then " << octree.number_of_cells() << std::endl;
    BOOST_TEST(has_layer ? octree.number_of_cells() > 2 * number : octree.number_of_cells() == number);
  }
}

int run(int, char*[])
{
  test_layers();
  test_cuts();
  test_shell_counts();
  test_weights_of_shells();
  test_small_shells();
  test_cavities();
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
