// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// optimize_mixed_mesh_3(): distorted meshes that must stay valid, each outcome, and the brain with all
// guarantees.
//
//   test_fitting_optimize [DATA_DIRECTORY]

#include "test_fitting.h"

#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/Scaled_jacobian_quality_3.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#ifndef MIXED_MESH_3_DATA_DIR
#define MIXED_MESH_3_DATA_DIR "data"
#endif

namespace test_fitting_optimize {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Everywhere_mixed_mesh_region_3;
using CGAL::Mixed_mesh_criteria_3;
using CGAL::Mixed_mesh_optimization_result_3;
using CGAL::Polyhedral_mixed_mesh_domain_3;
using CGAL::Polyhedral_mixed_mesh_region_3;
using CGAL::make_mixed_mesh_3;
using CGAL::optimize_mixed_mesh_3;
using Criteria = CGAL::Mixed_mesh_optimization_criteria_3;
using Status = CGAL::Mixed_mesh_optimization_status;

constexpr double no_sliding = 1e100; // a cost that is never reached

// ---- helpers -----------------------------------------------------------------------------------

template <class Quality>
double worst_cost(const Mesh& mesh, const Quality& quality)
{
  double worst = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    worst = (std::max)(worst,
                       quality(mesh.element(e).kind(), internal::element_points(mesh, mesh.element(e))));
  return worst;
}

// The elements that are no tetrahedra.
std::vector<Polygon> other_elements(const Mesh& mesh)
{
  std::vector<Polygon> result;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    if(mesh.element(e).kind() != TETRAHEDRON)
      result.emplace_back(mesh.element(e).begin(), mesh.element(e).end());
  return result;
}

// Checks conditions that hold for any valid start.
void check(const Mesh& before, const Mesh& after, const Mixed_mesh_optimization_result_3& result,
           const Test_surface& surface)
{
  BOOST_TEST(is_positive(before) && is_positive(after));
  BOOST_TEST_EQ(after.number_of_vertices(), before.number_of_vertices());
  // Flips in flat places beside sharp edges of the surface change the faces.
  BOOST_TEST(result.length_of_sharp_edges > 0 || boundary_of(after) == boundary_of(before));
  BOOST_TEST(other_elements(after) == other_elements(before));
  BOOST_TEST(result.number_of_flips > 0
             || after.elements().connectivity() == before.elements().connectivity());
  const Mesh_defects a = find_defects(before), b = find_defects(after);
  BOOST_TEST(b.none() || !a.none());
  BOOST_TEST_LE(number_of_vertices_off_surface(after, surface),
                result.number_of_boundary_vertices - result.number_of_arrived_vertices);
  const std::vector<bool> is_boundary = is_on_boundary(before);
  BOOST_TEST_EQ(result.number_of_boundary_vertices,
                std::size_t(std::count(is_boundary.begin(), is_boundary.end(), true)));
}

Test_surface unit_cube() { return box({0, 0, 0}, {1, 1, 1}); }

Test_surface ball_surface(double radius = 1) { return sphere({0.1, 0.2, 0.3}, radius, 12); }

// The mesh as the octree makes it, with its boundary outside the surface.
Mesh unfitted(const Test_surface& surface, std::size_t n)
{
  Mesh mesh;
  make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(surface), Everywhere_mixed_mesh_region_3(),
                    Mixed_mesh_criteria_3(n).fit_to_surface(false), mesh);
  BOOST_TEST(!mesh.is_empty());
  return mesh;
}

// ---- distorted meshes --------------------------------------------------------------------------

template <class Quality>
void test_distorted(const Quality& quality)
{
  const Test_surface surface = unit_cube();
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  for(Element_kind kind : element_kinds)
    for(unsigned seed : {1u, 2u, 3u}) {
      Mesh start = grid(3, kind);
      distort(start, 0.3, seed);
      const double worst = worst_cost(start, quality);
      BOOST_TEST_GT(worst, 3);
      for(bool flips : {false, true})
        for(double sliding : {no_sliding, 2.}) {
          Mesh mesh = start;
          const auto result = optimize_mixed_mesh_3(mesh, domain, quality,
                                                    Criteria().flips(flips).sliding_threshold(sliding));
          BOOST_TEST(result.status == Status::SUCCESS);
          BOOST_TEST_EQ(result.number_of_rounds, 4u);
          BOOST_TEST(result.number_of_flips == 0 || (flips && kind == TETRAHEDRON));
          check(start, mesh, result, surface);
          const double now = worst_cost(mesh, quality);
          BOOST_TEST_LT(now, 0.8 * worst);
          if(sliding == no_sliding) { // the cube it was
            BOOST_TEST_LE(std::abs(volume(mesh) - 1), 1e-12);
            const std::vector<bool> is_boundary = is_on_boundary(mesh);
            for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
              BOOST_TEST(!is_boundary[v] || mesh.point(v) == start.point(v));
          } else {
            BOOST_TEST_LE(volume(mesh), 1 + 1e-12);
            BOOST_TEST_GE(volume(mesh), 0.9);
          }
        }
    }
}

// ---- each way to end ---------------------------------------------------------------------------

struct Stopping_visitor : Default_visitor
{
  std::size_t stop_at = std::size_t(-1), number_of_questions = 0;
  bool go_on() { return number_of_questions++ != stop_at; } // says no once
};

void test_statuses()
{
  const Test_surface surface = ball_surface();
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  Mesh empty;
  BOOST_TEST(optimize_mixed_mesh_3(empty, surface).status == Status::EMPTY);
  empty.add_vertex({0, 0, 0});
  BOOST_TEST(optimize_mixed_mesh_3(empty, surface).status == Status::EMPTY);

  // No start is valid.
  for(Element_kind kind : element_kinds) {
    Mesh mesh = grid(2, kind);
    const Vertex_index center = 13;
    for(const Test_point& bad : {Test_point(1.1, 0.5, 0.5), Test_point(1, 0.5, 0.5),
                                 Test_point(std::numeric_limits<double>::quiet_NaN(), 0, 0)}) {
      mesh.points()[center] = bad;
      Mesh after = mesh;
      after.points()[center] = mesh.points()[center] = bad;
      const auto result = optimize_mixed_mesh_3(after, surface);
      BOOST_TEST(result.status == Status::INVALID_MESH);
      BOOST_TEST(after.elements().connectivity() == mesh.elements().connectivity());
      for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
        BOOST_TEST(v == center || after.point(v) == mesh.point(v));
    }
  }
  Mesh nameless = grid(1, HEXAHEDRON);
  nameless.add_element(TETRAHEDRON, {0, 1, 2, 99});
  BOOST_TEST(optimize_mixed_mesh_3(nameless, surface).status == Status::INVALID_MESH);

  // The outcome is a success, with its guarantees.
  const Mesh start = unfitted(surface, 300);
  BOOST_TEST_GT(number_of_vertices_off_surface(start, surface), 50u);
  Mesh mesh = start;
  Stopping_visitor patient;
  auto result = optimize_mixed_mesh_3(mesh, domain, Criteria(), CGAL::parameters::visitor(std::ref(patient)));
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_EQ(result.number_of_arrived_vertices, result.number_of_boundary_vertices);
  BOOST_TEST_EQ(result.largest_distance, 0.);
  check(start, mesh, result, surface);
  Mesh same = start;
  optimize_mixed_mesh_3(same, surface);
  BOOST_TEST(is_same(same, mesh));

  // A run stopped anywhere is valid; a visitor that returned false is obeyed.
  BOOST_TEST_GT(patient.number_of_questions, 4u);
  std::size_t unchanged = 0;
  for(std::size_t i = 0; i < patient.number_of_questions; ++i) {
    Stopping_visitor impatient;
    impatient.stop_at = i;
    Mesh stopped = start;
    result = optimize_mixed_mesh_3(stopped, domain, Criteria(),
                                   CGAL::parameters::visitor(std::ref(impatient)));
    BOOST_TEST(result.status == Status::STOPPED);
    BOOST_TEST_EQ(impatient.number_of_questions, i + 1);
    // Elements that exceed the quality bound on the way come back to it.
    const bool is_unchanged = is_same(stopped, start);
    BOOST_TEST(is_unchanged || i > 0);
    BOOST_TEST(!is_unchanged || result.number_of_arrived_vertices == 0);
    unchanged += is_unchanged;
    check(start, stopped, result, surface);
  }
  BOOST_TEST_LE(unchanged, 2u);

  // The plate is so thin that its elements would be flatter than acceptable.
  Test_surface plate;
  add_box(plate, {-0.1, -0.1, 0.49999}, {1.1, 1.1, 0.50001});
  const Mesh cube = grid(2, HEXAHEDRON);
  mesh = cube;
  result = optimize_mixed_mesh_3(mesh, plate);
  BOOST_TEST(result.status == Status::NOT_ALL_ARRIVED);
  BOOST_TEST_LT(result.number_of_arrived_vertices, result.number_of_boundary_vertices);
  BOOST_TEST_EQ(result.number_of_boundary_vertices, 26u);
  check(cube, mesh, result, plate);

  // The tolerance is positive.
  for(double tolerance : {1., 0.02}) {
    mesh = start;
    result = optimize_mixed_mesh_3(mesh, domain, Criteria().tolerance(tolerance));
    check(start, mesh, result, surface);
    BOOST_TEST(result.status == (tolerance == 1 ? Status::SUCCESS : Status::TOLERANCE_NOT_REACHED));
    BOOST_TEST_EQ(result.largest_distance > tolerance, tolerance < 1);
    BOOST_TEST_EQ(result.number_of_rounds, 12u);
    // The distance at samples is not above the true distance, and not much below that of the surface.
    const auto distance = hausdorff_distance(mesh, surface);
    const auto &from_mesh = distance.from_mesh, &from_surface = distance.from_surface;
    BOOST_TEST_LE(result.largest_distance,
                  (std::max)(from_mesh.distance + from_mesh.error, from_surface.distance + from_surface.error)
                    + 1e-9);
    BOOST_TEST_GE(result.largest_distance + 2 * tolerance, from_surface.distance);
  }
}

void test_criteria()
{
  BOOST_TEST_EQ(Criteria().number_of_rounds(), 4);
  BOOST_TEST_EQ(Criteria().tolerance(1).number_of_rounds(), 12);
  BOOST_TEST_EQ(Criteria().tolerance(1).number_of_rounds(7).number_of_rounds(), 7);
  const Test_surface surface = ball_surface();
  const Mesh start = unfitted(surface, 300);
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  for(int rounds : {1, 2, 7}) {
    Mesh mesh = start;
    const auto result = optimize_mixed_mesh_3(mesh, domain, Criteria().number_of_rounds(rounds));
    BOOST_TEST_EQ(result.number_of_rounds, std::size_t(rounds));
    check(start, mesh, result, surface);
  }
  // Meshes are fitted elsewhere: to a sphere twice as large, and with the other measure.
  const Test_surface larger = ball_surface(1.5);
  for(int model : {0, 1}) {
    Mesh mesh = start;
    const Polyhedral_mixed_mesh_domain_3 larger_domain(larger);
    const auto result = model == 0 ? optimize_mixed_mesh_3(mesh, larger_domain, Criteria())
                                   : optimize_mixed_mesh_3(mesh, larger_domain, Scaled_jacobian_quality_3(),
                                                           Criteria());
    BOOST_TEST(result.status == Status::SUCCESS);
    check(start, mesh, result, larger);
    BOOST_TEST_GE(volume(mesh), 0.8 * 4.19 * 3.375);
    const auto rows = quality_statistics(mesh, scaled_jacobian);
    BOOST_TEST_GE(rows[number_of_element_kinds].minimum, 0.17);
  }
}

// Each bisection adds a vertex on the surface, as many as are allowed; elements that are no tetrahedra stay.
void test_bisections()
{
  const Test_surface surface = ball_surface();
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  const Mesh start = unfitted(surface, 300);
  Mesh plain = start;
  const auto without = optimize_mixed_mesh_3(plain, domain, Criteria());
  BOOST_TEST_EQ(without.number_of_bisections, 0u);
  for(double tolerance : {0., 0.02})
    for(std::size_t number : {1, 7, 40}) {
      Mesh mesh = start, again = start;
      const auto criteria = Criteria().tolerance(tolerance).number_of_bisections(number);
      const auto result = optimize_mixed_mesh_3(mesh, domain, criteria);
      BOOST_TEST(result.status == Status::SUCCESS || tolerance > 0);
      BOOST_TEST_EQ(result.number_of_bisections, number);
      BOOST_TEST_EQ(mesh.number_of_vertices(), start.number_of_vertices() + number);
      BOOST_TEST_EQ(result.number_of_boundary_vertices, without.number_of_boundary_vertices + number);
      BOOST_TEST_EQ(result.number_of_arrived_vertices, result.number_of_boundary_vertices);
      BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, surface), 0u);
      BOOST_TEST(find_defects(mesh).none() && is_positive(mesh));
      BOOST_TEST_EQ(boundary_vertices(mesh).size(), result.number_of_boundary_vertices);
      BOOST_TEST(other_elements(mesh) == other_elements(start));
      BOOST_TEST_GT(volume(mesh), volume(plain)); // of a ball, from inside
      optimize_mixed_mesh_3(again, domain, criteria);
      BOOST_TEST(is_same(mesh, again));
    }
}

// ---- the brain ---------------------------------------------------------------------------------

void test_brain(const Test_surface& brain, const Test_surface& region_surface)
{
  const Polyhedral_mixed_mesh_domain_3 domain(brain);
  const Polyhedral_mixed_mesh_region_3 region(region_surface);
  Mesh before, mesh;
  const auto plain = Mixed_mesh_criteria_3(660).tolerance(0).share_of_bisections(0).simplification(false);
  make_mixed_mesh_3(domain, region, Mixed_mesh_criteria_3(plain).fit_to_surface(false), before);
  const auto made = make_mixed_mesh_3(domain, region, plain, mesh);
  BOOST_TEST(made.status == CGAL::Mixed_mesh_status::SUCCESS);
  check(before, mesh, made.optimization, brain);

  // The vertices were not on the surface before, and are on it after.
  BOOST_TEST_GT(number_of_vertices_off_surface(before, brain), 150u);
  BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, brain), 0u);
  BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
  BOOST_TEST(find_defects(mesh).none());

  // The closest points alone would invert elements.
  Mesh projected = before;
  const std::vector<bool> is_boundary = is_on_boundary(before);
  for(Vertex_index v = 0; v < before.number_of_vertices(); ++v)
    if(is_boundary[v])
      projected.points()[v] = domain.closest_point(before.point(v));
  BOOST_TEST(!is_positive(projected));
  BOOST_TEST_EQ(number_of_vertices_off_surface(projected, brain), 0u);

  const auto rows = quality_statistics(mesh);
  BOOST_TEST_LE(rows[number_of_element_kinds].mean, 1.45);
  BOOST_TEST_LE(rows[number_of_element_kinds].maximum, 2.5);
  BOOST_TEST_EQ(rows[number_of_element_kinds].share, 1.);
  const double warp = quality_statistics(mesh, quad_warp)[number_of_element_kinds].maximum;
  BOOST_TEST_LE(warp, 10);
  std::cout << "brain, 660: ARC " << rows[number_of_element_kinds].mean << ", at most "
            << rows[number_of_element_kinds].maximum << "; warp " << warp << std::endl;

  // The cost of sliding is compared with vertices that stay where they arrive.
  Mesh again = before, stiff = before;
  BOOST_TEST(optimize_mixed_mesh_3(again, brain).status == Status::SUCCESS);
  BOOST_TEST(is_same(again, mesh)); // by itself as in the driver; and repeatable
  const auto result = optimize_mixed_mesh_3(stiff, domain, Criteria().sliding_threshold(no_sliding));
  check(before, stiff, result, brain);
  std::cout << "volume " << volume(mesh) << ", without sliding " << volume(stiff) << std::endl;
  BOOST_TEST_GE(volume(mesh), 0.99 * volume(stiff));
  BOOST_TEST_GE(quality_statistics(stiff)[number_of_element_kinds].maximum,
                rows[number_of_element_kinds].maximum);

  // A tolerance brings both surfaces nearer: with the same elements, and with elements chosen for it.
  Mesh near = before, nearer;
  const auto drawn = optimize_mixed_mesh_3(near, domain, Criteria().tolerance(4));
  check(before, near, drawn, brain);
  const Axis_aligned_octree_cell_traits_3 traits(domain.bbox());
  const auto refined = make_mixed_mesh_3(domain, region,
                                         Mixed_mesh_criteria_3(660).tolerance(4).simplification(false),
                                         traits, nearer);
  BOOST_TEST(refined.has_mesh());
  BOOST_TEST(find_defects(nearer).none());
  BOOST_TEST_EQ(number_of_vertices_off_surface(nearer, brain), 0u);
  BOOST_TEST_GT(refined.number_of_vertices_for_tolerance, 0u);
  BOOST_TEST_LE(nearer.number_of_vertices(), 660u);
  const double far_off = hausdorff_distance(mesh, brain, 1e-3).distance(),
               near_off = hausdorff_distance(near, brain, 1e-3).distance(),
               nearer_off = hausdorff_distance(nearer, brain, 1e-3).distance();
  std::cout << "distances " << far_off << ", drawn " << near_off << ", refined " << nearer_off << std::endl;
  BOOST_TEST_LT(near_off, far_off);
  BOOST_TEST_LT(nearer_off, near_off);
  BOOST_TEST_LE(refined.optimization.largest_distance, 1.01 * nearer_off);
}

int run(int argc, char* argv[])
{
  const std::string data = argc > 1 ? argv[1] : MIXED_MESH_3_DATA_DIR;
  Test_surface brain, region;
  if(!CGAL::IO::read_polygon_mesh(data + "/brain.off", brain)
     || !CGAL::IO::read_polygon_mesh(data + "/region.off", region)) {
    std::cerr << "cannot read brain.off and region.off in " << data << std::endl;
    return 1;
  }
  test_distorted(Aspect_ratio_quality_3());
  test_distorted(Scaled_jacobian_quality_3());
  test_statuses();
  test_criteria();
  test_bisections();
  test_brain(brain, region);
  return boost::report_errors();
}

} // namespace test_fitting_optimize
