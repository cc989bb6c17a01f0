// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// make_mixed_mesh_3() from end to end: its guarantees, on the brain.
//
//   test_meshing [DATA_DIRECTORY]

#include "test_meshing.h"

#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Candidate.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/base_level.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/fill_vertex_budget.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#ifndef MIXED_MESH_3_DATA_DIR
#define MIXED_MESH_3_DATA_DIR "data"
#endif

namespace test_meshing {

using CGAL::Ball_mixed_mesh_region_3;
using CGAL::Everywhere_mixed_mesh_region_3;
using CGAL::Implicit_mixed_mesh_region_3;
using CGAL::Polyhedral_mixed_mesh_region_3;
using CGAL::Union_mixed_mesh_region_3;
using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Simple_kernel = CGAL::Simple_cartesian<double>;
using Vector_3 = Kernel::Vector_3;

// ---- the brain ---------------------------------------------------------------------------------

void test_budgets(const Surface& brain, const Polyhedral_mixed_mesh_domain_3& domain,
                  const Polyhedral_mixed_mesh_region_3& region)
{
  for(std::size_t n : {660, 2000, 10000}) {
    Mesh mesh, fitted;
    const Mixed_mesh_result_3 result = run(domain, region, unfitted(n), mesh);
    BOOST_TEST(result.status == Status::SUCCESS);
    BOOST_TEST_GE(double(mesh.number_of_vertices()), 0.97 * double(n));
    BOOST_TEST(find_defects(mesh).none());
    BOOST_TEST_EQ(result.number_of_boundary_vertices_inserted, 0u);
    BOOST_TEST_EQ(result.base_level, 3);
    BOOST_TEST(result.optimization.status == CGAL::Mixed_mesh_optimization_status::EMPTY);
    BOOST_TEST_EQ(result.number_of_vertices_needed, mesh.number_of_vertices());
    BOOST_TEST_GT(result.tolerance, 0);
    BOOST_TEST(result.number_of_vertices_for_tolerance > 0
               && 2 * result.number_of_vertices_for_tolerance <= n);
    check_sides(mesh, result, domain);
    if(n == 660) {
      const auto rows = quality_statistics(mesh);
      BOOST_TEST_LE(rows[number_of_element_kinds].mean, 1.55);
      BOOST_TEST_LE(rows[number_of_element_kinds].maximum, 3.2);
    }
    for(const auto& row : quality_statistics(mesh))
      BOOST_TEST(n < 10000 || row.count > 0); // all four kinds
    std::cout << n << ": " << mesh.number_of_vertices() << " vertices, " << result.number_of_trials
              << " trials, " << result.number_of_relabeled_vertices << " relabeled" << std::endl;

    // The same vertices, moved onto the surface.
    if(n > 2000) // see test_optimize
      continue;
    const auto criteria = Mixed_mesh_criteria_3(n).share_of_bisections(0).simplification(false);
    const Mixed_mesh_result_3 with = run(domain, region, criteria, fitted);
    BOOST_TEST(with.status == Status::SUCCESS);
    BOOST_TEST_EQ(with.tolerance, result.tolerance);
    BOOST_TEST(with.optimization.status
               == (with.optimization.largest_distance > with.tolerance
                     ? CGAL::Mixed_mesh_optimization_status::TOLERANCE_NOT_REACHED
                     : CGAL::Mixed_mesh_optimization_status::SUCCESS));
    BOOST_TEST_EQ(with.optimization.number_of_bisections, 0u);
    BOOST_TEST_EQ(fitted.number_of_vertices(), mesh.number_of_vertices());
    BOOST_TEST_EQ(with.number_of_vertices_in_region, result.number_of_vertices_in_region);
    BOOST_TEST_GT(number_of_vertices_off_surface(mesh, brain), 100u);
    BOOST_TEST_EQ(number_of_vertices_off_surface(fitted, brain), 0u);
    BOOST_TEST(find_defects(fitted).none());
    const auto rows = quality_statistics(fitted);
    BOOST_TEST_LE(rows[number_of_element_kinds].mean, 1.47);
    BOOST_TEST_LE(rows[number_of_element_kinds].maximum, Mixed_mesh_criteria_3(n).quality_bound());
    BOOST_TEST_LT(volume(fitted), volume(mesh));
  }
}

// The octree leaves a share of the budget, and bisections fill it.
void test_bisections(const Surface& brain, const Polyhedral_mixed_mesh_domain_3& domain,
                     const Polyhedral_mixed_mesh_region_3& region)
{
  for(std::size_t n : {300, 660, 2000})
    for(double share : {double(Mixed_mesh_criteria_3::automatic), 0.03, 0.2}) {
      Mesh mesh;
      const auto criteria = Mixed_mesh_criteria_3(n).share_of_bisections(share);
      const double used = criteria.share_of_bisections();
      BOOST_TEST(share >= 0 ? used == share : used > 0);
      const auto result = run(domain, region, criteria, mesh);
      const bool is_volume_right = std::abs(volume(mesh) / domain.volume() - 1) <= 0.05;
      BOOST_TEST(result.status == (is_volume_right ? Status::SUCCESS : Status::VOLUME_DIFFERS));
      BOOST_TEST(is_volume_right || n == 300);
      BOOST_TEST_GE(double(mesh.number_of_vertices()), 0.97 * double(n));
      BOOST_TEST_LE(double(result.number_of_vertices_needed), (1 - used) * double(n) + 1);
      BOOST_TEST_EQ(result.number_of_vertices_needed + result.optimization.number_of_bisections
                      - result.optimization.number_of_merged_vertices,
                    mesh.number_of_vertices());
      BOOST_TEST_GT(result.optimization.number_of_bisections, 0u);
      BOOST_TEST_EQ(result.optimization.number_of_boundary_vertices, boundary_vertices(mesh).size());
      BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, brain), 0u);

      // Vertices are left over without fitting.
      Mesh before;
      const auto rest = make_mixed_mesh_3(domain, region, unfitted(n).share_of_bisections(used), before);
      check(before, rest, n - std::size_t(used * double(n)));
      BOOST_TEST(rest.status == Status::SUCCESS);
      if(result.number_of_collapsed_vertices == 0)
        BOOST_TEST_EQ(before.number_of_vertices(), result.number_of_vertices_needed);
    }
  BOOST_TEST_EQ(unfitted(660).share_of_bisections(), 0);
  BOOST_TEST_EQ(Mixed_mesh_criteria_3(660).share_of_bisections(0).share_of_bisections(), 0);
}

// The octree of the paper: no cell is deeper than the base level except in the region, or for the balance.
// The mesh is that of an octree made here, which is checked.
void test_paper(const Polyhedral_mixed_mesh_domain_3& domain, const Polyhedral_mixed_mesh_region_3& region)
{
  const Axis_aligned_octree_cell_traits_3 traits(domain.bbox());
  for(int base_level : {2, 3}) {
    const auto criteria = unfitted(1500).base_level(base_level).grading(0).tolerance(0);
    Mesh mesh, expected;
    const auto result = run(domain, region, criteria, mesh);
    BOOST_TEST(result.status == Status::SUCCESS);
    BOOST_TEST_EQ(result.tolerance, 0);
    BOOST_TEST_EQ(result.number_of_vertices_for_tolerance, 0u);

    internal::Located_octree octree(domain, region, traits);
    BOOST_TEST(internal::refine_to_level(octree, base_level, 1500));
    Default_visitor default_visitor;
    internal::Visitor_reference<Default_visitor> visitor(default_visitor);
    const auto candidate = internal::fill_vertex_budget(
      octree, 1500, 0, [&](const internal::Located_octree& o) {
        return internal::make_candidate(o, {criteria, 1}, visitor);
      });
    internal::assemble_mesh(octree, candidate.mesh, candidate.boundary, expected);
    BOOST_TEST(content(mesh) == content(expected));

    const internal::Octree& nodes = octree.octree();
    const auto touches = [&](internal::Octree::Node_index a, internal::Octree::Node_index b) {
      for(int k = 0; k < 3; ++k)
        if(nodes.corner(a)[k] > nodes.corner(b)[k] + nodes.side(b)
           || nodes.corner(b)[k] > nodes.corner(a)[k] + nodes.side(a))
          return false;
      return true;
    };
    std::size_t in_region = 0, for_balance = 0;
    for(internal::Octree::Node_index n = 0; n < nodes.size(); ++n) {
      if(nodes.is_leaf(n) || nodes.level(n) < base_level)
        continue;
      if(octree.is_in_region(n)) {
        ++in_region;
        continue;
      }
      ++for_balance;
      bool has_reason = false; // a smaller cell beside it that is split, too
      for(internal::Octree::Node_index m = 0; m < nodes.size() && !has_reason; ++m)
        has_reason = !nodes.is_leaf(m) && nodes.level(m) == nodes.level(n) + 1 && touches(n, m);
      BOOST_TEST(has_reason);
    }
    BOOST_TEST(in_region > 20 && for_balance > 0);

    // Grading splits more cells than these.
    Mesh graded;
    run(domain, region, unfitted(1500).base_level(base_level).tolerance(0), graded);
    BOOST_TEST(!(content(graded) == content(mesh)));
  }
}

// The smallest budget that suffices: it does, half of it does not, and too small a limit is reported.
void test_fewest_vertices(const Surface& brain, const Polyhedral_mixed_mesh_domain_3& domain,
                          const Polyhedral_mixed_mesh_region_3& region)
{
  for(double tolerance : {5., 8.}) {
    const auto criteria = Mixed_mesh_criteria_3(5000).tolerance(tolerance);
    Mesh mesh, same, coarse;
    const auto result = make_mixed_mesh_3(domain, region,
                                          Mixed_mesh_criteria_3(criteria).fewest_vertices(true), mesh);
    BOOST_TEST(result.status == Status::SUCCESS || result.status == Status::BUDGET_NOT_FILLED);
    BOOST_TEST_LE(result.optimization.largest_distance, 0.9 * tolerance);
    BOOST_TEST_LE(hausdorff_distance(mesh, brain, 1e-3).distance(), 1.02 * tolerance); // CGAL 6.1: 1.005
    BOOST_TEST(result.vertex_budget > 60 && result.vertex_budget < 5000);
    BOOST_TEST(result.number_of_budgets > 2 && result.number_of_budgets <= 10);
    BOOST_TEST_LE(mesh.number_of_vertices(), result.vertex_budget);
    check(mesh, result, result.vertex_budget);
    BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, brain), 0u);
    run(domain, region, Mixed_mesh_criteria_3(criteria).maximal_number_of_vertices(result.vertex_budget),
        same);
    BOOST_TEST(content(same) == content(mesh));
    const auto half = run(domain, region,
                          Mixed_mesh_criteria_3(criteria).maximal_number_of_vertices(result.vertex_budget
                                                                                     / 2),
                          coarse);
    BOOST_TEST(half.status >= Status::TOLERANCE_NOT_REACHED
               || half.optimization.largest_distance > 0.9 * tolerance);
    const auto limited = run(
      domain, region,
      Mixed_mesh_criteria_3(result.vertex_budget / 2).tolerance(tolerance).fewest_vertices(true), same);
    BOOST_TEST(limited.status == half.status && limited.vertex_budget == result.vertex_budget / 2);
    BOOST_TEST(content(same) == content(coarse));
    std::cout << "tolerance " << tolerance << ": " << result.vertex_budget << " vertices, "
              << result.number_of_budgets << " budgets, " << mesh.number_of_vertices() << " vertices"
              << std::endl;
  }
}

// The search for a tolerance, with the root given. A tolerance that is not given is a wish.
void test_tolerance(const Surface& brain, const Polyhedral_mixed_mesh_domain_3& domain,
                    const Polyhedral_mixed_mesh_region_3& region)
{
  const Axis_aligned_octree_cell_traits_3 traits(domain.bbox());
  Mesh mesh;
  double last = std::numeric_limits<double>::infinity();
  for(double tolerance : {0., 8.}) {
    const auto criteria = Mixed_mesh_criteria_3(660).tolerance(tolerance).simplification(false);
    const auto result = make_mixed_mesh_3(domain, region, criteria, traits, mesh);
    check(mesh, result, 660);
    BOOST_TEST(result.status == Status::SUCCESS);
    BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, brain), 0u);
    const double distance = hausdorff_distance(mesh, brain, 1e-3).distance();
    BOOST_TEST_LT(distance, last);
    BOOST_TEST_EQ(result.tolerance, tolerance);
    BOOST_TEST_EQ(result.number_of_vertices_for_tolerance > 0, tolerance > 0);
    BOOST_TEST_EQ(result.optimization.largest_distance > 0, tolerance > 0);
    if(result.status == Status::SUCCESS && tolerance > 0)
      BOOST_TEST_LE(distance, 1.5 * tolerance); // farther only between samples
    std::cout << "tolerance " << tolerance << ": distance " << distance << ", "
              << result.number_of_vertices_in_region << " vertices in the region" << std::endl;
    last = distance;
    Mesh again;
    const Thread_limit limit(3);
    make_mixed_mesh_3<CGAL::Parallel_if_available_tag>(domain, region, criteria, traits, again);
    BOOST_TEST(content(again) == content(mesh));
  }
  last = std::numeric_limits<double>::infinity();
  for(std::size_t n : {150, 300, 1000}) {
    const auto result = run(domain, region, Mixed_mesh_criteria_3(n), mesh);
    BOOST_TEST(result.tolerance > 0 && result.tolerance < last); // finer with more vertices
    last = result.tolerance;
    BOOST_TEST(result.status != Status::TOLERANCE_NOT_REACHED);
    Mesh asked; // the status tells about a requested tolerance
    const auto same = run(domain, region, Mixed_mesh_criteria_3(n).tolerance(last), asked);
    BOOST_TEST_EQ(same.status == Status::TOLERANCE_NOT_REACHED,
                  same.status < Status::PARTS_LOST
                    && same.optimization.status
                         == CGAL::Mixed_mesh_optimization_status::TOLERANCE_NOT_REACHED);
  }
}

// A wished tolerance takes no level of the octree from the surface in the region; a requested one may.
void test_region_before_wish(const Polyhedral_mixed_mesh_domain_3& domain)
{
  const Ball_mixed_mesh_region_3 opening({-25, -20, 66}, 24);
  const auto number_in_opening = [&](Mixed_mesh_criteria_3 criteria) {
    Mesh mesh;
    const auto result = run(domain, opening, criteria.simplification(false), mesh);
    check(mesh, result, 2000);
    std::size_t n = 0;
    for(Vertex_index v : CGAL::Mixed_meshes_3::boundary_vertices(mesh))
      n += opening.depth(mesh.point(v)) > 0;
    std::cout << "tolerance " << result.tolerance << ": " << n << " boundary vertices in the opening\n";
    return double(n);
  };
  const double without = number_in_opening(Mixed_mesh_criteria_3(2000).tolerance(0)),
               wished = number_in_opening(Mixed_mesh_criteria_3(2000)),
               asked = number_in_opening(Mixed_mesh_criteria_3(2000).tolerance(4.12445));
  BOOST_TEST_GT(wished, 0.65 * without);
  BOOST_TEST_GT(wished, 1.1 * asked);
}

void test_repeatability(const Polyhedral_mixed_mesh_domain_3& domain,
                        const Polyhedral_mixed_mesh_region_3& region)
{
  Content first;
  using Tag = CGAL::Parallel_if_available_tag;
  Mesh sequential;
  run(domain, region, Mixed_mesh_criteria_3(1000), sequential);
  first = content(sequential);
  for(unsigned threads : {2, 5, 1}) {
    const Thread_limit limit(threads);
    Mesh mesh;
    run<Tag>(domain, region, Mixed_mesh_criteria_3(1000), mesh);
    BOOST_TEST(content(mesh) == first);
  }
  // The mesh is so large that vertices move by colors; cells are without bisections, so that more are moved
  // at a time.
  first = {};
  for(unsigned threads : {1, 3}) {
    const Thread_limit limit(threads);
    Mesh mesh;
    run<Tag>(domain, region, Mixed_mesh_criteria_3(22000).share_of_bisections(0), mesh);
    if(first.points.empty())
      first = content(mesh);
    BOOST_TEST(content(mesh) == first);
  }
}

template <class MeshKernel, class AnySurface>
void test_same(const AnySurface& surface, const AnySurface& region, const Mixed_mesh_criteria_3& criteria,
               const Content& expected)
{
  CGAL::Mixed_mesh_3<MeshKernel> mesh;
  const Mixed_mesh_result_3 result = make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(surface),
                                                       Polyhedral_mixed_mesh_region_3(region), criteria,
                                                       mesh);
  check(mesh, result, 660);
  BOOST_TEST(content(mesh) == expected);
}

template <class AnySurface>
AnySurface copy(const Surface& surface)
{
  AnySurface result;
  CGAL::copy_face_graph(surface, result);
  return result;
}

void test_kernels(const Surface& brain, const Surface& region)
{
  Mesh mesh;
  make_mixed_mesh_3(brain, region, 660, mesh);
  const Content expected = content(mesh);
  BOOST_TEST(!expected.points.empty());
  const Mixed_mesh_criteria_3 fitted(660);
  test_same<Exact_kernel>(brain, region, fitted, expected);
  test_same<Simple_kernel>(brain, region, fitted, expected);
  // A copy has its faces in another order: the closest points are rounded differently.
  make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(brain), Polyhedral_mixed_mesh_region_3(region),
                    unfitted(660), mesh);
  const Content by_octree = content(mesh);
  using Exact_surface = CGAL::Surface_mesh<Exact_kernel::Point_3>;
  test_same<Exact_kernel>(copy<Exact_surface>(brain), copy<Exact_surface>(region), unfitted(660), by_octree);
  using Simple_polyhedron = CGAL::Polyhedron_3<Simple_kernel>;
  test_same<Simple_kernel>(copy<Simple_polyhedron>(brain), copy<Simple_polyhedron>(region), unfitted(660),
                           by_octree);
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  test_same<Kernel>(copy<Polyhedron>(brain), copy<Polyhedron>(region), unfitted(660), by_octree);
}

void test_criteria(const Surface& brain, const Polyhedral_mixed_mesh_domain_3& domain,
                   const Polyhedral_mixed_mesh_region_3& region)
{
  Mesh plain, mesh;
  const auto expected = run(domain, region, unfitted(1500), plain);

  auto result = run(domain, region, unfitted(1500).root_cell(Root_cell::BOX), mesh);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST(!(content(mesh) == content(plain)));
  check_sides(mesh, result, domain);

  result = run(domain, region, unfitted(1500).transition_templates(Transition_templates_choice::CENTERED),
               mesh);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_GT(result.number_of_transition_vertices, expected.number_of_transition_vertices);
  check_sides(mesh, result, domain);

  // The kept elements are the same in the paper's mode; there are fewer of them for the same budget.
  result = run(domain, region, unfitted(1500).boundary_mode(Boundary_mode::PAPER), mesh);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_GT(result.number_of_boundary_vertices_inserted, 0u);
  BOOST_TEST_LE(result.number_of_cells, expected.number_of_cells);

  for(int level = 0; level <= 5; ++level) {
    result = run(domain, region, unfitted(1500).base_level(level), mesh);
    BOOST_TEST_EQ(result.base_level, level);
    BOOST_TEST(result.status
               == (level <= 3                                ? Status::SUCCESS
                   : result.number_of_vertices_needed > 1500 ? Status::BUDGET_TOO_SMALL
                                                             : Status::SUCCESS));
    BOOST_TEST_GE(result.deepest_level, level);
  }
  BOOST_TEST(result.status == Status::BUDGET_TOO_SMALL);
  // The needed number of vertices is sufficient.
  const std::size_t needed = result.number_of_vertices_needed;
  result = run(domain, region, unfitted(needed).base_level(5), mesh);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_EQ(mesh.number_of_vertices(), needed);
  result = run(domain, region, unfitted(needed - 1).base_level(5), mesh);
  BOOST_TEST(result.status == Status::BUDGET_TOO_SMALL);

  for(const Vector_3& axis : {Vector_3(1, 2, 3), Vector_3(0, 0, -1), Vector_3(-1, 0.3, 0.1)}) {
    const Rotated_octree_cell_traits_3 traits(brain.points(), axis);
    const Mixed_mesh_criteria_3 criteria = unfitted(1500);
    result = make_mixed_mesh_3(domain, region, criteria, traits, mesh, CGAL::parameters::default_values());
    check(mesh, result, 1500);
    BOOST_TEST(result.status == Status::SUCCESS);
    check_sides(mesh, result, domain);
  }
}

void test_regions(const Polyhedral_mixed_mesh_domain_3& domain, const Surface& region_surface)
{
  const CGAL::Bbox_3 b = domain.bbox();
  const Point_3 center((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
  const Mixed_mesh_criteria_3 criteria = unfitted(1500);
  Mesh ball, same, everywhere, united;
  const double radius = 15;
  BOOST_TEST(run(domain, Ball_mixed_mesh_region_3(center, radius), criteria, ball).status == Status::SUCCESS);
  run(domain, Implicit_mixed_mesh_region_3([=](const Point_3& p) {
        return radius - std::sqrt(CGAL::squared_distance(p, center));
      }),
      criteria, same);
  BOOST_TEST(content(ball) == content(same));

  BOOST_TEST(run(domain, Everywhere_mixed_mesh_region_3(), criteria, everywhere).status == Status::SUCCESS);
  for(std::size_t e = 0; e < everywhere.number_of_elements(); ++e)
    BOOST_TEST(everywhere.is_in_region(e));

  // Any number of surfaces gives the same as one, or none.
  CGAL::Polyhedral_mixed_mesh_regions_3 regions;
  run(domain, regions, criteria, same);
  BOOST_TEST(content(everywhere) == content(same));
  regions.add(region_surface);
  Mesh one;
  run(domain, Polyhedral_mixed_mesh_region_3(region_surface), criteria, one);
  run(domain, regions, criteria, same);
  BOOST_TEST(content(one) == content(same));

  using Union = Union_mixed_mesh_region_3<Polyhedral_mixed_mesh_region_3, Ball_mixed_mesh_region_3>;
  const auto result = run(domain,
                          Union(Polyhedral_mixed_mesh_region_3(region_surface),
                                Ball_mixed_mesh_region_3(center, radius)),
                          criteria, united);
  BOOST_TEST(result.status == Status::SUCCESS);
  const Polyhedral_mixed_mesh_region_3 alone(region_surface);
  // Elements of the union belong to one of the two regions.
  bool has_first = false, has_second = false;
  for(std::size_t e = 0; e < united.number_of_elements(); ++e)
    if(united.is_in_region(e))
      for(Vertex_index v : united.element(e)) {
        has_first = has_first || alone.depth(united.point(v)) > 0;
        has_second = has_second || CGAL::squared_distance(united.point(v), center) < radius * radius;
      }
  BOOST_TEST(has_first && has_second);

  // The region is away from the domain.
  Mesh none;
  none.add_vertex(center);
  const Point_3 away(b.xmax() + 1000, 0, 0);
  BOOST_TEST(run(domain, Ball_mixed_mesh_region_3(away, 10), criteria, none).status
             == Status::REGION_NOT_MET);
}

// Position and unit do not matter, except for the rounding of the input.
void test_invariance(const Surface& brain, const Surface& region)
{
  Mesh mesh;
  const auto make = [&](const Surface& surface, const Surface& region_surface, bool fit) {
    const auto result = make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(surface),
                                          Polyhedral_mixed_mesh_region_3(region_surface),
                                          Mixed_mesh_criteria_3(660).fit_to_surface(fit), mesh);
    check(mesh, result, 660);
    BOOST_TEST(result.status == Status::SUCCESS);
    return content(mesh);
  };
  const Content expected = make(brain, region, false), fitted = make(brain, region, true);
  const double mean = quality_statistics(mesh)[number_of_element_kinds].mean;
  for(double scale : {std::ldexp(1., 20), std::ldexp(1., -20), 1e6, 1e-6, 1e12, 25.4}) {
    const auto f = [&](const Point_3& p) { return Point_3(scale * p.x(), scale * p.y(), scale * p.z()); };
    const Surface surface = transformed(brain, f), region_surface = transformed(region, f);
    const Content scaled = make(surface, region_surface, false);
    // The side of a cell is rounded to 20 bits: other factors move vertices by up to 2e-6 of the root
    // relative to the surface, which can swap two vertices that are almost equally far from it.
    int exponent;
    if(std::frexp(scale, &exponent) == 0.5) {
      BOOST_TEST(scaled.has_same_topology(expected));
      BOOST_TEST(make(surface, region_surface, true).has_same_topology(fitted));
    } else {
      BOOST_TEST_EQ(mesh.number_of_vertices(), expected.points.size());
    }
  }
  for(double offset : {1000., 1e8}) {
    const auto f = [&](const Point_3& p) { return p + Vector_3(offset, -offset, offset); };
    const Surface surface = transformed(brain, f), region_surface = transformed(region, f);
    // The lattice has so few digits left at 1e8 that the root is a little larger.
    BOOST_TEST(make(surface, region_surface, false).has_same_topology(expected) || offset > 1e6);
    // Flips may differ, by the rounding of the closest points; the elements are as good.
    make(surface, region_surface, true);
    BOOST_TEST_LE(std::abs(quality_statistics(mesh)[number_of_element_kinds].mean - mean), 0.02);
    BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, surface), 0u);
  }
  Surface inside_out = brain, region_inside_out = region;
  CGAL::Polygon_mesh_processing::reverse_face_orientations(inside_out);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(region_inside_out);
  BOOST_TEST(make(inside_out, region_inside_out, false) == expected);
}

void test_small_budgets(const Polyhedral_mixed_mesh_domain_3& domain,
                        const Polyhedral_mixed_mesh_region_3& region)
{
  Mesh mesh;
  std::size_t smallest = 0; // that gives a mesh
  for(std::size_t n : {1, 4, 8, 9, 20, 27, 35, 50, 80, 125, 200, 300, 400, 500}) {
    mesh.add_vertex({0, 0, 0}); // to be cleared
    const auto result = run(domain, region, Mixed_mesh_criteria_3(n), mesh);
    BOOST_TEST(result.has_mesh() || result.status == Status::BUDGET_TOO_SMALL);
    if(!result.has_mesh())
      BOOST_TEST_GT(result.number_of_vertices_needed, n);
    if(n <= 4) // a vertex inside has at least four around
      BOOST_TEST(!result.has_mesh());
    if(result.has_mesh() && smallest == 0)
      smallest = n;
    BOOST_TEST(smallest == 0 || result.has_mesh()); // a larger budget is never too small
  }
  BOOST_TEST(smallest > 4 && smallest <= 200);
}

void test_visitor(const Surface& brain, const Surface& region)
{
  Mesh expected, mesh;
  const auto criteria = Mixed_mesh_criteria_3(660).simplification(false);
  make_mixed_mesh_3(brain, region, criteria, expected);
  Recording_visitor all;
  const auto result = make_mixed_mesh_3(brain, region, criteria, mesh,
                                        CGAL::parameters::visitor(std::ref(all)));
  BOOST_TEST(content(mesh) == content(expected));
  BOOST_TEST_EQ(all.number_of_errors, 0u);
  BOOST_TEST_EQ(all.open, -1);
  BOOST_TEST(all.begun == all.ended);
  for(std::size_t n : all.begun)
    BOOST_TEST_GT(n, 0u);
  BOOST_TEST_EQ(all.begun[int(Stage::ASSEMBLY)], 1u);
  BOOST_TEST_EQ(all.number_of_trials, result.number_of_trials);
  const std::size_t octree_budget = 660 - std::size_t(criteria.share_of_bisections() * 660);
  std::size_t largest_accepted = 0;
  for(std::size_t n : all.sizes)
    if(n <= octree_budget)
      largest_accepted = (std::max)(largest_accepted, n);
  BOOST_TEST_EQ(largest_accepted, result.number_of_vertices_needed);
  BOOST_TEST_EQ(largest_accepted + result.optimization.number_of_bisections
                  - result.optimization.number_of_merged_vertices,
                mesh.number_of_vertices());
  BOOST_TEST_EQ(all.begun[int(Stage::OPTIMIZATION)], 1u);
  BOOST_TEST_GT(all.number_of_questions, all.number_of_trials + 2);

  bool is_in_search = true;
  for(std::size_t i = 0; i < all.number_of_questions; i += 2) {
    Recording_visitor visitor;
    visitor.stop_at = i;
    const auto stopped = make_mixed_mesh_3(brain, region, criteria, mesh,
                                           CGAL::parameters::visitor(std::ref(visitor)));
    BOOST_TEST(stopped.status == Status::STOPPED);
    check(mesh, stopped, 660);
    BOOST_TEST_EQ(visitor.number_of_errors, 0u);
    BOOST_TEST(visitor.begun == visitor.ended);
    BOOST_TEST_EQ(visitor.number_of_questions, i + 1); // not asked again
    // The search asks at least once in each trial.
    is_in_search = is_in_search && visitor.begun[int(Stage::ASSEMBLY)] == 0;
    BOOST_TEST(is_in_search || i + 1 > result.number_of_trials);
    BOOST_TEST_EQ(visitor.begun[int(Stage::ASSEMBLY)], is_in_search ? 0u : 1u);
    BOOST_TEST_EQ(visitor.begun[int(Stage::OPTIMIZATION)], is_in_search ? 0u : 1u);
  }
  BOOST_TEST(!is_in_search);

  // The mesh so far can be kept: valid, and with more vertices the later the run is stopped.
  std::size_t last = 0, first_kept = 0;
  Recording_visitor usual;
  make_mixed_mesh_3(brain, region, 660, mesh, CGAL::parameters::visitor(std::ref(usual)));
  BOOST_TEST_GT(usual.number_of_questions, 10u);
  for(std::size_t i = 0; i < usual.number_of_questions; i += 3) {
    Recording_visitor visitor;
    visitor.stop_at = i;
    const auto stopped = make_mixed_mesh_3(brain, region,
                                           Mixed_mesh_criteria_3(660).keep_mesh_if_stopped(true), mesh,
                                           CGAL::parameters::visitor(std::ref(visitor)));
    BOOST_TEST(stopped.status == Status::STOPPED);
    BOOST_TEST_EQ(stopped.has_mesh(), stopped.is_kept);
    BOOST_TEST_EQ(stopped.has_mesh(), !mesh.is_empty());
    BOOST_TEST_EQ(visitor.number_of_questions, i + 1);
    BOOST_TEST(visitor.begun == visitor.ended);
    BOOST_TEST(last == 0 || stopped.has_mesh());
    BOOST_TEST_LE(mesh.number_of_vertices(), 660u);
    first_kept += !stopped.has_mesh();
    if(stopped.has_mesh()) {
      const Mesh_defects defects = find_defects(mesh);
      BOOST_TEST(defects.none());
      last = mesh.number_of_vertices();
    }
  }
  BOOST_TEST(last > 500 && first_kept < result.number_of_trials);
}

// The number of vertices of elements in the region.
std::size_t number_in_region(const Mesh& mesh)
{
  std::vector<bool> is_in_region(mesh.number_of_vertices(), false);
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(mesh.attributes(e).is_in_region)
      for(Vertex_index v : mesh.element(e))
        is_in_region[v] = true;
  return std::size_t(std::count(is_in_region.begin(), is_in_region.end(), true));
}

// The mesh begins finer than the budget and loses vertices: the region stays, and nothing is lost for that.
void test_simplification(const Surface& brain, const Polyhedral_mixed_mesh_domain_3& domain,
                         const Polyhedral_mixed_mesh_region_3& front)
{
  double sum_with = 0, sum_without = 0; // of largest distances, each of which is that of one place
  const auto check_region = [&](const auto& region, std::size_t n, double share_in_region = 1.05) {
    Mesh with, again, without;
    const auto criteria = Mixed_mesh_criteria_3(n);
    const Mixed_mesh_result_3 result = run(domain, region, criteria, with);
    const Mixed_mesh_result_3 plain = run(domain, region, Mixed_mesh_criteria_3(n).simplification(false),
                                          without);
    BOOST_TEST(result.status == Status::SUCCESS && plain.status == Status::SUCCESS);
    BOOST_TEST_EQ(plain.number_of_collapsed_vertices, 0u);
    BOOST_TEST_GT(result.number_of_collapsed_vertices, n / 2);
    BOOST_TEST_EQ(with.number_of_vertices() + result.optimization.number_of_merged_vertices, n);
    BOOST_TEST_GE(double(with.number_of_vertices()), 0.99 * double(n));
    BOOST_TEST(find_defects(with).none());
    BOOST_TEST_EQ(number_of_vertices_off_surface(with, brain), 0u);
    BOOST_TEST(result.shells == plain.shells);
    const auto rows = quality_statistics(with);
    BOOST_TEST_LE(rows[number_of_element_kinds].maximum, criteria.quality_bound());
    BOOST_TEST_LE(rows[number_of_element_kinds].mean,
                  quality_statistics(without)[number_of_element_kinds].mean);
    BOOST_TEST_GT(rows[HEXAHEDRON].count, 0u);
    BOOST_TEST_GT(volume(with), 0.99 * volume(without));
    BOOST_TEST_GT(double(number_in_region(with)), share_in_region * double(number_in_region(without)));
    const auto distance = [&](const Mesh& mesh) { return hausdorff_distance(mesh, brain).distance(); };
    std::cout << n << ": " << distance(with) << " from the surface, " << distance(without) << " without\n";
    BOOST_TEST_LE(distance(with), 1.6 * distance(without));
    sum_with += distance(with);
    sum_without += distance(without);
    run(domain, region, criteria, again);
    BOOST_TEST(content(again) == content(with));
  };
  for(std::size_t n : {400, 660, 1500})
    check_region(front, n);
  check_region(front, 4000, 0.88); // base level and balance take less of it
  check_region(Ball_mixed_mesh_region_3(Kernel::Point_3(-30, -60, 40), 20), 1000);
  BOOST_TEST_LE(sum_with, 0.9 * sum_without);

  // Whatever vertices are removed for, the region stays.
  Mesh usual, near;
  run(domain, front, Mixed_mesh_criteria_3(660), usual);
  run(domain, front, Mixed_mesh_criteria_3(660).tolerance(2), near);
  BOOST_TEST_GT(double(number_in_region(near)), 0.4 * double(number_in_region(usual)));
  BOOST_TEST_GT(quality_statistics(near)[HEXAHEDRON].count, 0u);

  // where it is not done
  const std::vector<Mixed_mesh_criteria_3> others = {Mixed_mesh_criteria_3(660).grading(0),
                                                     Mixed_mesh_criteria_3(660).base_level(3), unfitted(660)};
  for(const Mixed_mesh_criteria_3& criteria : others) {
    Mesh mesh;
    BOOST_TEST_EQ(run(domain, front, criteria, mesh).number_of_collapsed_vertices, 0u);
  }
}

// The number of cells without vertices, of which a spike may have any number, is bounded.
void test_spikes()
{
  for(double length : {1e3, 1e5, 1e9})
    for(std::size_t n : {60, 600}) {
      Surface spike;
      CGAL::make_tetrahedron(Kernel::Point_3(0, 0, 0), Kernel::Point_3(1, 0, 0), Kernel::Point_3(0, 1, 0),
                             Kernel::Point_3(0, 0, length), spike);
      Mesh mesh;
      const auto result = make_mixed_mesh_3(spike, n, mesh);
      BOOST_TEST(result.status == Status::EMPTY || result.status >= Status::PARTS_LOST);
      BOOST_TEST_LE(result.number_of_cells, 9 * n + 2000);
    }
}

int run(int argc, char* argv[])
{
  const std::string data = argc > 1 ? argv[1] : MIXED_MESH_3_DATA_DIR;
  Surface brain, region_surface;
  if(!CGAL::IO::read_polygon_mesh(data + "/brain.off", brain)
     || !CGAL::IO::read_polygon_mesh(data + "/region.off", region_surface)) {
    std::cerr << "cannot read brain.off and region.off in " << data << std::endl;
    return 1;
  }
  const Polyhedral_mixed_mesh_domain_3 domain(brain);
  const Polyhedral_mixed_mesh_region_3 region(region_surface);

  auto last = std::chrono::steady_clock::now();
  const auto timed = [&](const char* name, const std::function<void()>& f) {
    f();
    const auto now = std::chrono::steady_clock::now();
    std::cout << name << ": " << std::chrono::duration<double>(now - last).count() << " s" << std::endl;
    last = now;
  };
  timed("budgets", [&] { test_budgets(brain, domain, region); });
  timed("bisections", [&] { test_bisections(brain, domain, region); });
  timed("paper", [&] { test_paper(domain, region); });
  timed("tolerance", [&] { test_tolerance(brain, domain, region); });
  timed("fewest vertices", [&] { test_fewest_vertices(brain, domain, region); });
  timed("region before wish", [&] { test_region_before_wish(domain); });
  timed("repeatability", [&] { test_repeatability(domain, region); });
  timed("kernels", [&] { test_kernels(brain, region_surface); });
  timed("criteria", [&] { test_criteria(brain, domain, region); });
  timed("regions", [&] { test_regions(domain, region_surface); });
  timed("invariance", [&] { test_invariance(brain, region_surface); });
  timed("small budgets", [&] { test_small_budgets(domain, region); });
  timed("spikes", test_spikes);
  timed("simplification", [&] { test_simplification(brain, domain, region); });
  timed("visitor", [&] { test_visitor(brain, region_surface); });
  return boost::report_errors();
}

} // namespace test_meshing
