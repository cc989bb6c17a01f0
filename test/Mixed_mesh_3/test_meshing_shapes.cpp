// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// make_mixed_mesh_3() on awkward domains, and each outcome.

#include "test_meshing.h"

#include <CGAL/Implicit_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace test_meshing_shapes {

using CGAL::Ball_mixed_mesh_region_3;
using CGAL::Everywhere_mixed_mesh_region_3;
using CGAL::Polyhedral_mixed_mesh_region_3;

// ---- awkward domains ---------------------------------------------------------------------------

// Checks that cells are lost if the status says so, or a status of precedence.
void check_lost(const Mixed_mesh_result_3& result)
{
  BOOST_TEST(result.status != Status::PARTS_LOST || result.number_of_lost_cells > 0);
  BOOST_TEST(result.number_of_lost_cells == 0 || result.status >= Status::PARTS_LOST);
  BOOST_TEST_EQ(result.number_of_lost_cells > 0, result.lost_cells != CGAL::Bbox_3());
}

// Returns the volume of the mesh that is not fitted; the fitted mesh is valid, too, and nearer.
// expected: outcome of the mesh that is not fitted, with a cube and with a box as root
// fitted: outcome after fitting, without more vertices; convex surfaces and small budgets only, to save time
double mesh_shape(const std::string& name, const Surface& surface, std::size_t budget,
                  const std::array<Status, 2>& expected, const std::vector<Status>& fitted_status = {})
{
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  const Everywhere_mixed_mesh_region_3 everywhere;
  double first_volume = 0;
  for(Root_cell root : {Root_cell::CUBE, Root_cell::BOX}) {
    const std::string shape = name + (root == Root_cell::BOX ? " (box)" : "");
    const auto plain = Mixed_mesh_criteria_3(budget).root_cell(root).tolerance(0).share_of_bisections(0);
    Mesh mesh, fitted, bisected;
    const auto result = run(domain, everywhere, Mixed_mesh_criteria_3(plain).fit_to_surface(false), mesh);
    if(!BOOST_TEST_EQ(int(result.status), int(expected[root == Root_cell::BOX])))
      std::cout << shape << ": needed " << result.number_of_vertices_needed << std::endl;
    check_lost(result);
    check_sides(mesh, result, domain);
    if(root == Root_cell::CUBE && !mesh.is_empty())
      first_volume = volume(mesh);

    if(fitted_status.empty())
      continue;
    const auto with = run(domain, everywhere, plain, fitted);
    BOOST_TEST_EQ(int(with.status), int(fitted_status[root == Root_cell::BOX]));
    BOOST_TEST(with.status == result.status || with.status >= Status::NOT_ALL_ARRIVED
               || result.status == Status::PARTS_LOST);
    BOOST_TEST_LE(fitted.number_of_vertices(), budget);
    if(with.number_of_collapsed_vertices == 0)
      BOOST_TEST_EQ(fitted.number_of_vertices(), mesh.number_of_vertices());
    const auto by_default = run(domain, everywhere, Mixed_mesh_criteria_3(budget).root_cell(root), bisected);
    check_lost(by_default);
    for(const auto& [m, r] : {std::make_pair(&fitted, &with), std::make_pair(&bisected, &by_default)}) {
      const std::size_t off = number_of_vertices_off_surface(*m, surface);
      BOOST_TEST_LE(off,
                    r->optimization.number_of_boundary_vertices - r->optimization.number_of_arrived_vertices);
      BOOST_TEST(r->status >= Status::NOT_ALL_ARRIVED || off == 0);
      // The chords of a convex surface are inside.
      const double exact = CGAL::to_double(CGAL::Polygon_mesh_processing::volume(surface));
      BOOST_TEST(r->status >= Status::NOT_ALL_ARRIVED || volume(*m) < exact * (1 + 1e-9));
      const auto rows = quality_statistics(*m);
      std::cout << shape << ": status " << int(r->status) << ", " << m->number_of_vertices() << " vertices, "
                << off << " off, ARC " << rows[number_of_element_kinds].mean << ", at most "
                << rows[number_of_element_kinds].maximum << std::endl;
    }
  }
  return first_volume;
}

void test_shapes()
{
  // The mesh contains the vertices inside; its volume is near that of the domain.
  const auto is_near = [](double volume, double exact) {
    return volume > 0.8 * exact && volume < 2.5 * exact;
  };

  double volume_of_mesh;
  Surface cube;
  add_box(cube, {0, 0, 0}, {1, 1, 1});
  volume_of_mesh = mesh_shape("cube", cube, 1000, {Status::SUCCESS, Status::SUCCESS},
                              {Status::SUCCESS, Status::SUCCESS});
  BOOST_TEST(is_near(volume_of_mesh, 1));

  Surface tetrahedron;
  tetrahedron.add_vertex({0, 0, 0});
  tetrahedron.add_vertex({3, 0, 0});
  tetrahedron.add_vertex({0, 3, 0});
  tetrahedron.add_vertex({0, 0, 3});
  using V = Surface::Vertex_index;
  for(const auto& f : {std::array<int, 3>{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}})
    tetrahedron.add_face(V(f[0]), V(f[1]), V(f[2]));
  volume_of_mesh = mesh_shape("tetrahedron", tetrahedron, 2000, {Status::SUCCESS, Status::PARTS_LOST},
                              {Status::SUCCESS, Status::SUCCESS}); // a vertex arrives at its tip
  BOOST_TEST(is_near(volume_of_mesh, 4.5));

  Surface plate;
  add_box(plate, {0, 0, 0}, {100, 100, 1});
  mesh_shape("plate", plate, 20000, {Status::SUCCESS, Status::SUCCESS});
  mesh_shape("plate, few", plate, 300, {Status::SUCCESS, Status::SUCCESS},
             {Status::SUCCESS, Status::SUCCESS}); // with elements as flat as the plate
  const auto tilt = [](const Point_3& p) {        // a rotation
    const double c = 0.8, s = 0.6;
    const Point_3 q(c * p.x() - s * p.z(), p.y(), s * p.x() + c * p.z());
    return Point_3(q.x(), c * q.y() - s * q.z(), s * q.y() + c * q.z());
  };
  mesh_shape("tilted plate", transformed(plate, tilt), 8000, {Status::SUCCESS, Status::SUCCESS});

  Surface needle;
  add_box(needle, {0, 0, 0}, {100, 1, 1});
  mesh_shape("needle", needle, 2000, {Status::SUCCESS, Status::SUCCESS});
  mesh_shape("tilted needle", transformed(needle, tilt), 2000, {Status::SUCCESS, Status::SUCCESS});

  Surface two;
  add_sphere(two, {0, 0, 0}, 1, 8);
  add_sphere(two, {5, 0.3, 0.1}, 1, 8);
  const double sphere = 4 * CGAL_PI / 3;
  volume_of_mesh = mesh_shape("two spheres", two, 4000, {Status::SUCCESS, Status::SUCCESS});
  BOOST_TEST(is_near(volume_of_mesh, 2 * sphere));

  // Two plates between the planes of the coarse octree: the default base level would lose one of them. One
  // vertex is not in their planes: else boxes between these planes would do.
  Surface plates;
  add_box(plates, {0, 0, 0}, {100, 100, 4});
  add_box(plates, {0, 0, 56.3}, {100, 100, 60.3});
  plates.point(*plates.vertices().begin()) = Point_3(0, 0, -1e-9);
  const CGAL::Polyhedral_mixed_mesh_domain_3 plates_domain(plates);
  Mesh mesh;
  for(std::size_t n : {100, 500, 20000}) {
    const auto result = make_mixed_mesh_3(plates_domain, CGAL::Everywhere_mixed_mesh_region_3(), unfitted(n),
                                          mesh);
    double lower = 100, upper = 0; // how far the mesh reaches
    for(const auto& p : mesh.points())
      lower = (std::min)(lower, p.z()), upper = (std::max)(upper, p.z());
    const bool has_both = lower < 4 && upper > 56.3;
    BOOST_TEST(has_both);
    BOOST_TEST(result.status == (n < 20000 ? Status::PARTS_LOST : Status::SUCCESS));
    check_lost(result);
  }

  // The spheres almost touch: the mesh would be pinched without the repair.
  Surface touching;
  add_sphere(touching, {0, 0, 0}, 1, 8);
  add_sphere(touching, {1.3, 1.3, 1.2}, 1, 8);
  volume_of_mesh = mesh_shape("touching spheres", touching, 4000, {Status::SUCCESS, Status::SUCCESS});
  BOOST_TEST(is_near(volume_of_mesh, 2 * sphere));

  Surface cavity;
  add_sphere(cavity, {0, 0, 0}, 1, 10);
  add_sphere(cavity, {0.1, 0, 0}, 0.5, 8);
  volume_of_mesh = mesh_shape("cavity", cavity, 4000, {Status::SUCCESS, Status::SUCCESS});
  BOOST_TEST(is_near(volume_of_mesh, sphere * 7 / 8));

  // The sphere is inside out, and symmetric, so that many cells are equally deep, except for rounding.
  Surface reversed;
  add_sphere(reversed, {0, 0, 0}, 1, 8);
  Mesh a, b;
  const auto make = [&](Mesh& mesh) {
    make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(reversed), Polyhedral_mixed_mesh_region_3(reversed),
                      unfitted(500), mesh);
  };
  make(a);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(reversed);
  make(b);
  BOOST_TEST(!a.is_empty() && content(a) == content(b));
}

// ---- each way to end ---------------------------------------------------------------------------

// A ball whose closest points are all at one place.
struct Pinched_domain : Analytic_domain
{
  using Analytic_domain::Analytic_domain;
  Point_3 closest_point(const Point_3& p, const Surface_part&) const { return closest_point(p); }
  Point_3 closest_point(const Point_3& p, const Point_3&) const { return closest_point(p); }
  Point_3 closest_point(const Point_3&) const { return {0.5, 0.5, 0.5}; }
};

void test_statuses()
{
  const Everywhere_mixed_mesh_region_3 everywhere;
  Surface surface;
  add_sphere(surface, {0, 0, 0}, 1, 12);
  const Polyhedral_mixed_mesh_domain_3 sphere(surface);
  Mesh mesh;
  const auto status = [&](const Mixed_mesh_criteria_3& criteria) {
    return run(sphere, everywhere, criteria, mesh).status;
  };
  BOOST_TEST(status(Mixed_mesh_criteria_3(1000)) == Status::SUCCESS);
  const Mixed_mesh_criteria_3 boxed = Mixed_mesh_criteria_3(300).root_cell(Root_cell::BOX);
  BOOST_TEST(status(Mixed_mesh_criteria_3(boxed).tolerance(1)) == Status::SUCCESS);
  BOOST_TEST(status(Mixed_mesh_criteria_3(boxed).tolerance(1e-4)) == Status::TOLERANCE_NOT_REACHED);
  BOOST_TEST(find_defects(mesh).none());
  BOOST_TEST(status(Mixed_mesh_criteria_3(1000).base_level(6)) == Status::BUDGET_TOO_SMALL);
  // One more cell is worth so many vertices of a small mesh that some budgets cannot be filled.
  // Bisections fill more of these budgets.
  std::size_t number_not_filled = 0, number_bisected_not_filled = 0;
  for(std::size_t n = 30; n < 60; n += 3) {
    const auto is_filled = [&] { return double(mesh.number_of_vertices()) >= 0.97 * double(n); };
    status(Mixed_mesh_criteria_3(n));
    number_bisected_not_filled += !is_filled();
    status(Mixed_mesh_criteria_3(n).share_of_bisections(0));
    number_not_filled += !is_filled();
  }
  BOOST_TEST_LE(number_bisected_not_filled, number_not_filled);

  BOOST_TEST(run(sphere, Ball_mixed_mesh_region_3({9, 9, 9}, 1), Mixed_mesh_criteria_3(1000), mesh).status
             == Status::REGION_NOT_MET);
  Recording_visitor visitor;
  visitor.stop_at = 0;
  BOOST_TEST(make_mixed_mesh_3(sphere, everywhere, Mixed_mesh_criteria_3(1000), mesh,
                               CGAL::parameters::visitor(std::ref(visitor)))
               .status
             == Status::STOPPED);

  Surface plate; // between the planes of a coarse octree, which has no vertex inside
  add_box(plate, {0, 0, 0.3}, {1, 1, 0.31});
  add_box(plate, {0, 0, 0.9}, {1, 1, 0.91});
  const Ball_mixed_mesh_region_3 away({9, 9, 9}, 1); // the octree stays coarse
  BOOST_TEST(
    run(Polyhedral_mixed_mesh_domain_3(plate), away, Mixed_mesh_criteria_3(1000).base_level(2), mesh).status
    == Status::EMPTY);
  add_sphere(plate, {0.5, 0.5, 1}, 0.45, 8);
  const auto with_parts_lost = run(Polyhedral_mixed_mesh_domain_3(plate), everywhere,
                                   Mixed_mesh_criteria_3(1000).base_level(3).fit_to_surface(false), mesh);
  BOOST_TEST(with_parts_lost.status == Status::PARTS_LOST);
  BOOST_TEST(
    run(Polyhedral_mixed_mesh_domain_3(plate), everywhere, Mixed_mesh_criteria_3(1000).base_level(3), mesh)
      .status
    == Status::TOPOLOGY_DIFFERS);

  // Balls are at two corners of the root, which is too small for them: the part in the root meets in a
  // vertex.
  const Axis_aligned_octree_cell_traits_3 small_root({0, 0, 0, 1, 1, 1});
  const std::uint32_t side = internal::lattice_root_side;
  const Analytic_domain corners(
    united(ball(small_root.point({0, 0, 0}), 0.01), ball(small_root.point({side, 0, 0}), 0.01)));
  const Mixed_mesh_criteria_3 one_level = unfitted(7).base_level(1);
  const auto pinched_result = make_mixed_mesh_3(corners, everywhere, one_level, small_root, mesh);
  check(mesh, pinched_result, 7);
  BOOST_TEST(pinched_result.status == Status::BOUNDARY_NOT_MANIFOLD);
  BOOST_TEST(pinched_result.has_mesh());
  BOOST_TEST_EQ(mesh.number_of_vertices(), 7u);
  BOOST_TEST_EQ(find_defects(mesh).nonmanifold_boundary_vertices, 1u);

  const Pinched_domain pinched(ball({0.5, 0.5, 0.5}, 0.4));
  const auto result = run(pinched, everywhere, Mixed_mesh_criteria_3(200), mesh);
  BOOST_TEST(result.status == Status::NOT_ALL_ARRIVED);
  BOOST_TEST(result.optimization.status == CGAL::Mixed_mesh_optimization_status::NOT_ALL_ARRIVED);
  BOOST_TEST_LT(result.optimization.number_of_arrived_vertices,
                result.optimization.number_of_boundary_vertices);
}

// The last one of several statuses in their order counts; each status has words of its own.
void test_precedence()
{
  std::vector<std::string> words;
  for(int a = 0; a <= int(Status::STOPPED); ++a) {
    words.push_back(CGAL::Mixed_meshes_3::description(Status(a)));
    BOOST_TEST(!words.back().empty());
    BOOST_TEST_EQ(std::count(words.begin(), words.end(), words.back()), 1);
    for(int b = 0; b <= int(Status::STOPPED); ++b)
      BOOST_TEST_EQ(int(CGAL::Mixed_meshes_3::worse_status(Status(a), Status(b))), (std::max)(a, b));
    Mixed_mesh_result_3 result;
    result.status = Status(a);
    BOOST_TEST_EQ(result.has_mesh(), a <= int(Status::BOUNDARY_NOT_MANIFOLD));
  }
}

// A function as domain, with and without a region, compared with the surface of the same ball.
void test_implicit_domain()
{
  const Point_3 center(0.1, -0.2, 0.3);
  const CGAL::Implicit_mixed_mesh_domain_3 domain(
    [&](const Point_3& p) { return 1 - std::sqrt(CGAL::squared_distance(p, center)); },
    CGAL::Bbox_3(-0.9, -1.2, -0.7, 1.1, 0.8, 1.3));
  Mesh mesh;
  for(double tolerance : {0., 0.03}) {
    const Mixed_mesh_criteria_3 criteria = Mixed_mesh_criteria_3(800).tolerance(tolerance);
    for(const auto& result :
        {CGAL::make_mixed_mesh_3(domain, criteria, mesh),
         CGAL::make_mixed_mesh_3(domain, Ball_mixed_mesh_region_3({0.1, -0.2, 1.2}, 0.5), criteria, mesh)})
      BOOST_TEST(result.status == Status::SUCCESS);
    BOOST_TEST(find_defects(mesh).none());
    double farthest = 0;
    for(Vertex_index v : boundary_vertices(mesh))
      farthest = (std::max)(farthest, std::abs(domain.depth(mesh.point(v))));
    BOOST_TEST_LT(farthest, 1e-10);
  }
  // The direction of the closest point does not matter from the center.
  BOOST_TEST_LT(std::abs(domain.depth(domain.closest_point(center))), 1e-10);
  BOOST_TEST_GT(domain.surface_samples(0.1).size(), 400u);

  // A surface, and a number as criteria.
  Mesh of_surface;
  BOOST_TEST(CGAL::make_mixed_mesh_3(sphere({0.1, -0.2, 0.3}, 1, 24), 800, of_surface).status
             == Status::SUCCESS);
  BOOST_TEST_LT(std::abs(volume(of_surface) - volume(mesh)), 0.05 * volume(mesh));
}

int run(int, char*[])
{
  test_precedence();
  test_implicit_domain();
  test_statuses();
  test_shapes();
  return boost::report_errors();
}

} // namespace test_meshing_shapes
