// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Passes of the optimization, each alone on a state: what a pass promises does not hold before, and holds
// after the pass. Postconditions of the stage, each of which a fault violates.

#include "test_fitting.h"

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Bounded_optimization.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Optimization_effort.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_levels.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/arrive.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/bisect_boundary.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/bound_for_doubles.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/feature_paths.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/find_followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/fitting_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/follow_sharp_edges.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/improve.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/mend.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/merge_unarrived_vertices.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_surface.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/retreat.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/return_to_surface.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/simplify_within_limits.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/split_flat_elements.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/weights_of_vertices.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>
#include <CGAL/Mixed_mesh_3/mesh_defects.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace test_fitting_passes {

using namespace CGAL::Mixed_meshes_3;
using namespace CGAL::Mixed_meshes_3::internal;
using Domain = CGAL::Polyhedral_mixed_mesh_domain_3;
using Criteria = CGAL::Mixed_mesh_optimization_criteria_3;
using Status = CGAL::Mixed_mesh_optimization_status;
using Result = CGAL::Mixed_mesh_optimization_result_3;
using State = Fitting_state<Aspect_ratio_quality_3>;

constexpr double angle = 60; // of sharp edges
const auto always = [] { return true; };
const auto never = [] { return false; };

// A surface, as the passes see it.
struct Body
{
  Test_surface surface;
  Domain domain;
  Surface_reference<Domain> any;

  explicit Body(Test_surface s) : surface(std::move(s)), domain(surface), any(domain) {}
};

Test_surface cube() { return box(Test_point(0, 0, 0), Test_point(1, 1, 1)); }

// A state, and what it refers to.
struct Start
{
  Core_mesh mesh;
  State::Criteria criteria;
  Aspect_ratio_quality_3 quality;
  State state;

  Start(const Mesh& m, const Body& body, const Criteria& c, const Fitting_mode& mode = {})
    : mesh(as_core_mesh(m)), criteria{c, 1}, state(mesh, body.any, criteria, quality, mode)
  {
  }
};

// The grid of a cube, scaled about the center of the cube.
Mesh scaled_grid(int n, double scale)
{
  Mesh mesh = grid(n, TETRAHEDRON);
  const Test_point center(0.5, 0.5, 0.5);
  for(auto& p : mesh.points())
    p = center + scale * (p - center);
  return mesh;
}

double distance_from_cube(const Vec3& p)
{
  double inside = std::numeric_limits<double>::infinity(), outside = 0;
  for(double x : p) {
    inside = (std::min)(inside, (std::min)(x, 1 - x));
    const double beyond = (std::max)({-x, x - 1, 0.});
    outside += beyond * beyond;
  }
  return outside > 0 ? std::sqrt(outside) : inside;
}

std::size_t number_off_cube(const State& s)
{
  std::size_t number = 0;
  for(Vertex_index v = 0; v < s.mesh.points.size(); ++v)
    number += s.mesh.is_on_boundary(v) && distance_from_cube(s.mesh.points[v]) > 1e-9;
  return number;
}

bool is_valid(const State& s, const Core_mesh& start)
{
  return find_defects(s.mesh.changed(start)).none() && are_counts_of_mesh(s.result, s.mesh, s.is_arrived);
}

// ---- small parts -------------------------------------------------------------------------------

void test_levels()
{
  const Mesh start = grid(4, HEXAHEDRON);
  const Working_mesh mesh(start, std::vector<Stratum>(start.number_of_vertices(), free_stratum));
  Vertex_levels levels;
  levels.update(mesh);
  std::vector<std::size_t> level_of(start.number_of_vertices(), std::size_t(-1));
  std::size_t number = 0;
  for(std::size_t l = 0; l < levels.vertices().size(); ++l) {
    BOOST_TEST(std::is_sorted(levels.vertices()[l].begin(), levels.vertices()[l].end()));
    for(Vertex_index v : levels.vertices()[l]) {
      level_of[v] = l;
      ++number;
    }
  }
  BOOST_TEST_EQ(number, start.number_of_vertices()); // each once, as level_of[] has all
  BOOST_TEST(std::count(level_of.begin(), level_of.end(), std::size_t(-1)) == 0);
  for(Vertex_index v = 0; v < start.number_of_vertices(); ++v) {
    std::size_t expected = 0;
    for(Element_index e = 0; e < start.number_of_elements(); ++e) {
      const Element_view element = start.element(e);
      if(std::count(element.begin(), element.end(), v) > 0)
        for(Vertex_index u : element)
          if(u < v)
            expected = (std::max)(expected, level_of[u] + 1);
    }
    BOOST_TEST_EQ(level_of[v], expected);
  }
}

// The more vertices, the less effort for each.
void test_effort()
{
  const std::size_t numbers[] = {100, Optimization_effort::large_number + 1,
                                 Optimization_effort::very_large_number + 1};
  for(int i = 0; i < 2; ++i) {
    const Optimization_effort few(numbers[i]), many(numbers[i + 1]);
    BOOST_TEST_GE(few.sweeps_to_arrive, many.sweeps_to_arrive);
    BOOST_TEST_LT(few.good_enough_to_arrive, many.good_enough_to_arrive);
    for(int k : {0, 1}) {
      BOOST_TEST_GE(few.sweeps[k], many.sweeps[k]);
      BOOST_TEST_LE(few.good_enough[k], many.good_enough[k]);
    }
    BOOST_TEST(many.moves_by_colors);
  }
}

void test_bound()
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for(double bound : {1., 3.2, 100.}) {
    BOOST_TEST_LT(bound_for_doubles(bound), bound);
    BOOST_TEST_GT(bound_for_doubles(bound), (1 - 1e-9) * bound);
  }
  BOOST_TEST_EQ(bound_for_doubles(infinity), infinity);
}

// Distances along edges, by relaxation until none gets shorter.
void test_weights()
{
  const Mesh all = grid(5, TETRAHEDRON, 0.1);
  Mesh start;
  start.points() = all.points();
  for(Element_index e = 0; e < all.number_of_elements(); ++e) {
    Element_attributes attributes;
    attributes.is_in_region = e % 200 == 7;
    start.add_element(TETRAHEDRON, std::vector<Vertex_index>(all.element(e).begin(), all.element(e).end()),
                      attributes);
  }
  std::vector<double> distances(start.number_of_vertices(), std::numeric_limits<double>::infinity());
  for(Element_index e = 0; e < start.number_of_elements(); ++e)
    if(start.is_in_region(e))
      for(Vertex_index v : start.element(e))
        distances[v] = 0;
  for(bool is_shorter = true; is_shorter;) {
    is_shorter = false;
    for(Element_index e = 0; e < start.number_of_elements(); ++e)
      for(Vertex_index a : start.element(e))
        for(Vertex_index b : start.element(e)) {
          const double d = distances[a] + norm(position(start, b) - position(start, a));
          if(d < distances[b]) {
            distances[b] = d;
            is_shorter = true;
          }
        }
  }
  const Working_mesh mesh(start, std::vector<Stratum>(start.number_of_vertices(), free_stratum));
  const std::vector<double> weights = weights_of_vertices(mesh, 0.3);
  for(Vertex_index v = 0; v < weights.size(); ++v)
    BOOST_TEST_LT(std::abs(weights[v] - std::pow(1 + distances[v] / 0.3, -3.6)), 1e-12);
  for(double weight : weights_of_vertices(mesh, 0))
    BOOST_TEST_EQ(weight, 1);
}

// ---- arrival -----------------------------------------------------------------------------------

void test_arrival()
{
  const Body body(cube());
  const Mesh mesh = scaled_grid(4, 0.9);
  const std::size_t boundary = 5 * 5 * 5 - 3 * 3 * 3;
  {
    Start start(mesh, body, Criteria());
    State& s = start.state;
    BOOST_TEST_EQ(number_off_cube(s), boundary);
    BOOST_TEST(arrive(s, always));
    BOOST_TEST_EQ(s.result.number_of_boundary_vertices, boundary);
    BOOST_TEST_EQ(s.result.number_of_arrived_vertices, boundary);
    BOOST_TEST_EQ(number_off_cube(s), 0u);
    BOOST_TEST(s.underway.empty() && s.vertices_not_arrived().empty());
    BOOST_TEST(is_valid(s, start.mesh));
    BOOST_TEST(are_arrived_on_surfaces(s.mesh, s.is_arrived, s.project));
  }
  { // a stop leaves all as it was
    Start start(mesh, body, Criteria());
    BOOST_TEST(!arrive(start.state, never));
    BOOST_TEST(start.state.mesh.changed(start.mesh).points() == start.mesh.points());
    BOOST_TEST_EQ(start.state.vertices_not_arrived().size(), boundary);
  }
  { // held vertices stay where they are, the others arrive
    Start start(mesh, body, Criteria());
    State& s = start.state;
    s.is_held[0] = s.is_held[7] = 1;
    const Vec3 p = s.mesh.points[0], q = s.mesh.points[7];
    set_targets(s);
    BOOST_TEST_EQ(s.underway.size(), boundary - 2);
    s.underway.clear();
    BOOST_TEST(arrive(s, always));
    BOOST_TEST(s.mesh.points[0] == p && s.mesh.points[7] == q);
    BOOST_TEST(s.vertices_not_arrived() == (std::vector<Vertex_index>{0, 7}));
    BOOST_TEST(is_valid(s, start.mesh));
  }
}

// A vertex that was left behind comes back.
void test_return()
{
  const Body body(cube());
  Start start(scaled_grid(4, 0.95), body, Criteria());
  State& s = start.state;
  BOOST_TEST(arrive(s, always));
  const Vertex_index v = 12; // in the middle of the face z = 0
  s.is_arrived[v] = 0;
  --s.result.number_of_arrived_vertices;
  s.mesh.points[v][2] += 0.05;
  s.moves.forget_costs();
  BOOST_TEST_EQ(number_off_cube(s), 1u);
  return_to_surface(s);
  BOOST_TEST_EQ(number_off_cube(s), 0u);
  BOOST_TEST(s.is_arrived[v] != 0);
  BOOST_TEST(is_valid(s, start.mesh));
}

// Two cubes of n^3 cells, 0.1 apart, with their surface.
struct Two_cubes
{
  Body body;
  Mesh mesh;
  std::size_t number_of_first; // vertices of the first cube

  explicit Two_cubes(int n)
    : body(surface()), mesh(grid(n, TETRAHEDRON)), number_of_first(mesh.number_of_vertices())
  {
    const Mesh other = mesh;
    for(const auto& p : other.points())
      mesh.add_vertex(p + Test_kernel::Vector_3(1.1, 0, 0));
    for(Element_index e = 0; e < other.number_of_elements(); ++e) {
      std::vector<Vertex_index> vertices;
      for(Vertex_index v : other.element(e))
        vertices.push_back(v + Vertex_index(other.number_of_vertices()));
      mesh.add_element(TETRAHEDRON, vertices);
    }
  }

  static Test_surface surface()
  {
    Test_surface both = cube();
    add_box(both, Test_point(1.1, 0, 0), Test_point(2.1, 1, 1));
    return both;
  }
};

// Faces of one body that are inside the other go back.
void test_retreat()
{
  const Two_cubes two(3);
  Start start(two.mesh, two.body, Criteria());
  State& s = start.state;
  for(Vertex_index v = 0; v < two.number_of_first; ++v)
    if(s.mesh.points[v][0] == 1 && std::abs(s.mesh.points[v][1] - 0.5) < 0.2)
      s.mesh.points[v][0] += 0.2;
  s.moves.forget_costs();
  BOOST_TEST(!s.crossing_vertices().empty());
  BOOST_TEST(cuts_itself(s.mesh.changed(start.mesh)));
  BOOST_TEST(retreat_from_self_intersections(s).empty());
  BOOST_TEST(s.result.is_boundary_simple);
  BOOST_TEST(!cuts_itself(s.mesh.changed(start.mesh)));
  BOOST_TEST(find_defects(s.mesh.changed(start.mesh)).none());
}

// Vertices of faces that cut others go back with the neighbors that are in their way, and these are underway
// again; others stay where they came to.
void test_going_back()
{
  const Two_cubes two(8);
  Start start(two.mesh, two.body, Criteria());
  State& s = start.state;
  const auto is_moved = [](const Vec3& p) { // a block of the first cube, at the second one, and another face
    return (p[0] >= 0.75 && p[0] <= 1 && std::abs(p[1] - 0.5) < 0.3 && std::abs(p[2] - 0.5) < 0.3)
           || p[0] == 0;
  };
  std::vector<Vertex_index> moved;
  for(Vertex_index v = 0; v < s.mesh.points.size(); ++v)
    s.result.number_of_boundary_vertices += s.mesh.is_on_boundary(v);
  for(Vertex_index v = 0; v < two.number_of_first; ++v)
    if(is_moved(s.saved_points[v])) {
      s.mesh.points[v][0] += s.saved_points[v][0] == 0 ? -0.05 : 0.13;
      moved.push_back(v);
      if(s.mesh.is_on_boundary(v)) {
        s.is_arrived[v] = 1;
        ++s.result.number_of_arrived_vertices;
      }
    }
  s.moves.forget_costs();
  BOOST_TEST(find_defects(s.mesh.changed(start.mesh)).none());
  BOOST_TEST(!s.crossing_vertices().empty());
  const std::vector<Vec3> before = s.mesh.points;
  BOOST_TEST(go_back_until_simple(s).empty());
  BOOST_TEST(!cuts_itself(s.mesh.changed(start.mesh)));
  BOOST_TEST(is_valid(s, start.mesh));
  std::size_t number_back = 0, number_arrived = 0;
  for(Vertex_index v : moved) {
    const bool is_back = s.mesh.points[v] == s.saved_points[v];
    BOOST_TEST(is_back || s.mesh.points[v] == before[v]);
    BOOST_TEST(!(is_back && s.saved_points[v][0] == 0));
    BOOST_TEST_EQ(s.is_arrived[v] != 0, s.mesh.is_on_boundary(v) && !is_back);
    number_back += is_back;
    number_arrived += s.is_arrived[v];
  }
  BOOST_TEST(number_back > 0 && number_arrived > 0);
  for(const auto& [v, target] : s.underway)
    BOOST_TEST(target == before[v] && !s.is_arrived[v]);
  // All of them go back where neighbors are no neighbors of what is wrong.
  BOOST_TEST(go_back(s, moved));
  BOOST_TEST(s.mesh.points == s.saved_points);
  BOOST_TEST_EQ(s.result.number_of_arrived_vertices, 0u);
  // None where elements would be inverted.
  s.saved_points[moved.front()][0] += 1;
  BOOST_TEST(!go_back(s, moved));
  BOOST_TEST(find_defects(s.mesh.changed(start.mesh)).none());
}

// ---- quality -----------------------------------------------------------------------------------

double mean_cost(const State& s)
{
  double sum = 0;
  std::size_t number = 0;
  for(const Working_mesh::Element& element : s.mesh.elements)
    if(!element.is_removed) {
      sum += s.quality(element.kind, s.mesh.relative_points(element));
      ++number;
    }
  return sum / double(number);
}

void test_improvement()
{
  const Body body(cube());
  Mesh mesh = grid(5, TETRAHEDRON);
  distort(mesh, 0.05, 1);
  Start start(mesh, body, Criteria().number_of_rounds(4));
  State& s = start.state;
  BOOST_TEST(arrive(s, always));
  const double before = mean_cost(s);
  BOOST_TEST(improve(s, always));
  BOOST_TEST_LT(mean_cost(s), 0.95 * before);
  BOOST_TEST_EQ(s.result.number_of_rounds, 4u);
  BOOST_TEST_EQ(number_off_cube(s), 0u);
  BOOST_TEST(is_valid(s, start.mesh));
  BOOST_TEST(!improve(s, never));
}

void test_mending()
{
  const Body body(cube());
  Mesh mesh = grid(6, TETRAHEDRON);
  const double bound = 4;
  const Vertex_index v = 3 + 7 * (3 + 7 * 3); // in the middle
  mesh.points()[v] = mesh.point(v) + Test_kernel::Vector_3(0.93 / 6, 0, 0);
  Start start(mesh, body, Criteria().quality_bound(bound));
  State& s = start.state;
  BOOST_TEST(!s.moves.vertices_above(bound).empty());
  s.result.number_of_boundary_vertices = s.result.number_of_arrived_vertices = boundary_vertices(mesh).size();
  for(Vertex_index u = 0; u < s.is_arrived.size(); ++u)
    s.is_arrived[u] = s.mesh.is_on_boundary(u);
  BOOST_TEST(mend(s));
  BOOST_TEST(s.moves.vertices_above(bound).empty());
  BOOST_TEST(is_valid(s, start.mesh));
  BOOST_TEST(!mend(s)); // nothing to do
}

// A vertex on a flat face that has not arrived is merged with a neighbor, or arrives: no volume is lost.
void test_merges()
{
  const Body body(cube());
  Start start(grid(4, TETRAHEDRON), body, Criteria());
  State& s = start.state;
  BOOST_TEST(arrive(s, always));
  const Vertex_index v = 12;
  s.is_arrived[v] = 0;
  --s.result.number_of_arrived_vertices;
  BOOST_TEST_EQ(s.vertices_not_arrived().size(), 1u);
  BOOST_TEST(merge_unarrived_vertices(s, always));
  BOOST_TEST(s.vertices_not_arrived().empty());
  const Core_mesh merged = s.mesh.changed(start.mesh);
  BOOST_TEST_EQ(s.result.number_of_merged_vertices, 1u);
  BOOST_TEST_EQ(merged.number_of_vertices(), start.mesh.number_of_vertices() - 1);
  BOOST_TEST_LT(std::abs(volume(merged) - 1), 1e-12);
  BOOST_TEST(is_valid(s, start.mesh));
  BOOST_TEST(are_strata_of_faces(s.mesh, s.mesh.changed(start.mesh), s.strata));
}

// ---- sharp edges -------------------------------------------------------------------------------

void test_paths()
{
  constexpr int n = 4;
  const Body body(cube());
  const Sharp_edges sharp = body.any.sharp_edges(angle);
  const Sharp_features features(sharp, 1. / n);
  BOOST_TEST_EQ(features.number_of_real_corners(), 8u);
  Start start(scaled_grid(n, 0.95), body, Criteria().number_of_bisections(20));
  State& s = start.state;
  s.project.set_features(features);
  s.features = &features;
  BOOST_TEST(s.mesh.sharp_edges.empty());
  choose_feature_paths(s);
  BOOST_TEST_EQ(s.mesh.sharp_edges.size(), std::size_t(12 * n));
  BOOST_TEST_EQ(s.result.number_of_bisections, 0u);
  std::set<Stratum> corners;
  for(Stratum stratum : s.mesh.strata)
    if(stratum >= first_sharp_stratum + features.polylines().size())
      corners.insert(stratum);
  BOOST_TEST_EQ(corners.size(), 8u);
  measure_features(s);
  BOOST_TEST_EQ(s.result.length_of_sharp_edges_kept, 0); // none has arrived
  BOOST_TEST_EQ(s.result.lost_sharp_edges.size(), 12u);
  BOOST_TEST(arrive(s, always));
  measure_features(s);
  BOOST_TEST_LT(std::abs(s.result.length_of_sharp_edges - 12), 1e-9);
  BOOST_TEST_LT(std::abs(s.result.length_of_sharp_edges_kept - 12), 1e-9);
  BOOST_TEST_EQ(s.result.number_of_corners_kept, 8u);
  BOOST_TEST(s.result.lost_sharp_edges.empty());
  BOOST_TEST_EQ(number_off_cube(s), 0u);
  BOOST_TEST(is_valid(s, start.mesh));
  BOOST_TEST(are_strata_of_faces(s.mesh, s.mesh.changed(start.mesh), s.strata));
}

// Parts of a polyline of length 1 between arcs.
void test_parts_between()
{
  const Feature_polyline line({{0, 0, 0}, {1, 0, 0}}, {0, 1});
  const auto parts = parts_between(line, {{0.5, 0.75}, {0, 0.25}, {0.1, 0.2}});
  BOOST_TEST_EQ(parts.size(), 2u);
  const double ends[2][2] = {{0.25, 0.5}, {0.75, 1}};
  for(std::size_t i = 0; i < parts.size(); ++i) {
    BOOST_TEST_LT(norm(parts[i].front() - Vec3{ends[i][0], 0, 0}), 1e-12);
    BOOST_TEST_LT(norm(parts[i].back() - Vec3{ends[i][1], 0, 0}), 1e-12);
  }
  BOOST_TEST(parts_between(line, {{0, 0.5}, {0.5, 1}}).empty());
  BOOST_TEST_EQ(parts_between(line, {}).size(), 1u);
}

// A tetrahedron on the boundary that would be flat at its targets gets a vertex that is free to move.
void test_flat_elements()
{
  const Body body(cube());
  const Sharp_edges sharp = body.any.sharp_edges(angle);
  const Sharp_features features(sharp, 1. / 3);
  BOOST_TEST(!features.empty());
  Start start(grid(3, TETRAHEDRON), body, Criteria().number_of_bisections(20).quality_bound(20));
  State& s = start.state;
  s.project.set_features(features);
  s.features = &features;
  choose_feature_paths(s);
  s.underway.clear();
  split_flat_elements(s);
  BOOST_TEST_EQ(s.result.number_of_bisections, 0u); // none is flat
  const std::size_t number = s.mesh.points.size();
  // The targets of the vertices of one face of the cube are on the plane of the vertices inside.
  for(Vertex_index v = 0; v < number; ++v)
    if(s.mesh.is_on_boundary(v)) {
      Vec3 target = s.mesh.points[v];
      target[2] = (std::max)(target[2], 0.5);
      s.underway.emplace_back(v, target);
    }
  std::vector<Vec3> targets = s.mesh.points;
  for(const auto& [v, target] : s.underway)
    targets[v] = target;
  std::size_t bad = 0;
  for(const Working_mesh::Element& element : s.mesh.elements)
    bad += would_be_bad(s, element, targets);
  BOOST_TEST_GT(bad, 0u);
  split_flat_elements(s);
  BOOST_TEST_GT(s.result.number_of_bisections, 0u);
  BOOST_TEST_EQ(s.mesh.points.size(), number + s.result.number_of_bisections);
  for(std::size_t v = number; v < s.mesh.points.size(); ++v)
    BOOST_TEST_EQ(s.mesh.strata[v], free_stratum);
  BOOST_TEST_EQ(s.is_arrived.size(), s.mesh.points.size());
  BOOST_TEST_EQ(s.saved_points.size(), s.mesh.points.size());
  const Core_mesh split = s.mesh.changed(start.mesh);
  BOOST_TEST(find_defects(split).none());
  BOOST_TEST_LT(std::abs(volume(split) - 1), 1e-12);
}

// The edges of the grid of a cube follow the edges of the cube; a vertex beside one follows none.
void test_followed_features()
{
  constexpr int n = 4;
  const Body body(cube());
  Core_mesh mesh = as_core_mesh(grid(n, TETRAHEDRON));
  const auto length = [&] {
    const Followed_features followed = find_followed_features(mesh, body.any, angle);
    double sum = 0;
    for(const auto& [edge, stratum] : followed.strata.edges)
      sum += norm(to_vec3(mesh.point(edge.second)) - to_vec3(mesh.point(edge.first)));
    return sum;
  };
  BOOST_TEST_LT(std::abs(length() - 12), 1e-12);
  BOOST_TEST_LT(std::abs(mean_edge_length_of_boundary(mesh) - (2 + std::sqrt(2.)) / 3 / n), 1e-12);
  mesh.points()[2] = Core_mesh::Point_3(0.5, 0.05, 0);
  BOOST_TEST_LT(std::abs(length() - (12 - 2. / n)), 1e-12);
  mesh.points()[0] = Core_mesh::Point_3(0.02, 0.02, 0.02); // a corner, of three edges
  BOOST_TEST_LT(std::abs(length() - (12 - 5. / n)), 1e-12);
}

// ---- bisections --------------------------------------------------------------------------------

// A ball of the mesher that is not fitted, whose boundary vertices arrive.
Mesh rough_ball(const Body& body, std::size_t n)
{
  Mesh mesh;
  make_mixed_mesh_3(body.domain, CGAL::Mixed_mesh_criteria_3(n).fit_to_surface(false), mesh);
  return mesh;
}

// The largest distance of the middle of an edge of the boundary from a sphere of radius 0.5.
double largest_distance_of_middles(const State& s)
{
  double largest = 0;
  for(const Face& face : s.boundary.faces) {
    const Face_vertices& v = face.vertices();
    for(int i = 0; i < v.size(); ++i)
      largest = (std::max)(largest,
                           std::abs(
                             0.5 - norm(0.5 * (s.mesh.points[v[i]] + s.mesh.points[v[(i + 1) % v.size()]]))));
  }
  return largest;
}

void test_bisections()
{
  constexpr std::size_t number = 30;
  const Body body(sphere(Test_point(0, 0, 0), 0.5, 40));
  Start start(rough_ball(body, 300), body, Criteria().tolerance(0.01).number_of_bisections(number));
  State& s = start.state;
  BOOST_TEST(arrive(s, always));
  BOOST_TEST(is_valid(s, start.mesh));
  const std::size_t boundary = s.result.number_of_boundary_vertices, vertices = s.mesh.points.size();
  s.attraction.measure();
  const double before = largest_distance_of_middles(s);
  bisect_far_edges(s, number, 4);
  const std::size_t bisections = s.result.number_of_bisections;
  BOOST_TEST(bisections > 0 && bisections <= number);
  BOOST_TEST_EQ(s.mesh.points.size(), vertices + bisections);
  BOOST_TEST_EQ(s.result.number_of_boundary_vertices, boundary + bisections);
  BOOST_TEST_LT(largest_distance_of_middles(s), before);
  BOOST_TEST(is_valid(s, start.mesh));
  BOOST_TEST(are_strata_of_faces(s.mesh, s.mesh.changed(start.mesh), s.strata));
  s.advance(10);
  BOOST_TEST(is_valid(s, start.mesh));
  BOOST_TEST(are_arrived_on_surfaces(s.mesh, s.is_arrived, s.project));
}

// ---- the list of passes ------------------------------------------------------------------------

void test_optimization()
{
  const Body body(sphere(Test_point(0, 0, 0), 0.5, 40));
  const Core_mesh start = as_core_mesh(rough_ball(body, 300));
  const State::Criteria criteria{Criteria().number_of_rounds(2), 1};
  const std::vector<std::uint8_t> held(start.number_of_vertices(), 0);
  const Sharp_features none;
  const Fitting_outcome outcome = optimize_surface(start, body.any, criteria, Aspect_ratio_quality_3(), {},
                                                   none, {}, held, always);
  BOOST_TEST(outcome.result.status == Status::SUCCESS);
  BOOST_TEST(outcome.crossing.empty() && outcome.result.is_boundary_simple);
  BOOST_TEST(has_no_new_defects(find_defects(start), outcome.mesh));
  for(Vertex_index v : boundary_vertices(outcome.mesh)) {
    const Core_mesh::Point_3 p = outcome.mesh.point(v);
    BOOST_TEST_LT(CGAL::squared_distance(p, body.domain.closest_point(p)), 1e-18);
  }
  Core_mesh mesh = start;
  Bounded_optimization<Aspect_ratio_quality_3> run(mesh, body.any, criteria, Aspect_ratio_quality_3(), {});
  const Result bounded = run(always);
  BOOST_TEST(bounded.status == Status::SUCCESS);
  BOOST_TEST_EQ(bounded.number_of_elements_above_bound, 0u);
  BOOST_TEST_LE(quality_statistics(mesh).back().maximum, Criteria::default_quality_bound);
  BOOST_TEST(find_defects(mesh).none());
  Core_mesh stopped = start;
  Bounded_optimization<Aspect_ratio_quality_3> stopped_run(stopped, body.any, criteria,
                                                           Aspect_ratio_quality_3(), {});
  BOOST_TEST(stopped_run(never).status == Status::STOPPED);
  BOOST_TEST(stopped.points() == start.points());
}

void test_simplification()
{
  using Simplification_criteria = CGAL::Mixed_mesh_simplification_criteria_3;
  using Simplification_status = CGAL::Mixed_mesh_simplification_status;
  const Body body(cube());
  const Core_mesh start = as_core_mesh(grid(6, TETRAHEDRON));
  const auto run = [&](const Simplification_criteria& criteria, Core_mesh& mesh, bool goes_on) {
    mesh = start;
    return simplify_within_limits(mesh, body.any, Aspect_ratio_quality_3(), criteria,
                                  [goes_on] { return goes_on; });
  };
  Core_mesh mesh;
  const auto result = run(Simplification_criteria(200).distance(0.1), mesh, true);
  BOOST_TEST(result.status == Simplification_status::SUCCESS);
  BOOST_TEST_EQ(mesh.number_of_vertices(), 200u);
  BOOST_TEST_EQ(result.number_of_vertices + result.number_of_collapses, start.number_of_vertices());
  BOOST_TEST_LT(std::abs(result.length_of_sharp_edges_followed - 12), 1e-9);
  BOOST_TEST(result.is_boundary_simple && find_defects(mesh).none());
  BOOST_TEST_LT(std::abs(volume(mesh) - 1), 1e-12);
  BOOST_TEST(run(Simplification_criteria(2).distance(0.1), mesh, true).status
             == Simplification_status::NUMBER_NOT_REACHED);
  BOOST_TEST(find_defects(mesh).none());
  BOOST_TEST(run(Simplification_criteria(200).distance(0.1), mesh, false).status
             == Simplification_status::STOPPED);
  BOOST_TEST_EQ(mesh.number_of_vertices(), start.number_of_vertices());
}

// ---- postconditions ----------------------------------------------------------------------------

// Each postcondition holds for a state as it is, and not with a fault.
void test_postconditions()
{
  const Body body(cube());
  Start start(scaled_grid(3, 0.95), body, Criteria());
  State& s = start.state;
  BOOST_TEST(arrive(s, always));

  BOOST_TEST(are_counts_of_mesh(s.result, s.mesh, s.is_arrived));
  ++s.result.number_of_boundary_vertices;
  BOOST_TEST(!are_counts_of_mesh(s.result, s.mesh, s.is_arrived));
  --s.result.number_of_boundary_vertices;
  s.is_arrived[0] = 0;
  BOOST_TEST(!are_counts_of_mesh(s.result, s.mesh, s.is_arrived));
  s.is_arrived[0] = 1;

  BOOST_TEST(are_arrived_on_surfaces(s.mesh, s.is_arrived, s.project));
  BOOST_TEST(are_all_on_surfaces(s.mesh.points, s.mesh.strata, s.project));
  const Vec3 p = s.mesh.points[5];
  s.mesh.points[5] = p + Vec3{0, 0, 1e-6};
  BOOST_TEST(!are_arrived_on_surfaces(s.mesh, s.is_arrived, s.project));
  BOOST_TEST(!are_all_on_surfaces(s.mesh.points, s.mesh.strata, s.project));
  s.is_arrived[5] = 0;
  BOOST_TEST(are_arrived_on_surfaces(s.mesh, s.is_arrived, s.project));
  s.mesh.points[5] = p;

  BOOST_TEST(are_strata_of_faces(s.mesh, s.mesh.changed(start.mesh), s.strata));
  const Vertex_index inner = 1 + 4 * (1 + 4 * 1), outer = 5;
  s.mesh.strata[inner] = boundary_stratum;
  BOOST_TEST(!are_strata_of_faces(s.mesh, s.mesh.changed(start.mesh), s.strata));
  s.mesh.strata[inner] = first_sharp_stratum;
  BOOST_TEST(!are_strata_of_faces(s.mesh, s.mesh.changed(start.mesh), s.strata));
  s.mesh.strata[inner] = free_stratum;
  s.mesh.strata[outer] = free_stratum;
  BOOST_TEST(!are_strata_of_faces(s.mesh, s.mesh.changed(start.mesh), s.strata));
  s.mesh.strata[outer] = first_sharp_stratum;
  BOOST_TEST(are_strata_of_faces(s.mesh, s.mesh.changed(start.mesh), s.strata));

  CGAL::Mixed_mesh_fit_result_3 fit;
  const std::vector<Stratum> strata{boundary_stratum, free_stratum, boundary_stratum};
  fit.status = CGAL::Mixed_mesh_fit_status::SUCCESS;
  fit.number_of_boundary_vertices = fit.number_of_arrived_vertices = 2;
  BOOST_TEST(are_counts_of_strata(fit, strata));
  fit.number_of_arrived_vertices = 1;
  BOOST_TEST(!are_counts_of_strata(fit, strata));
  fit.status = CGAL::Mixed_mesh_fit_status::NOT_ALL_ARRIVED;
  BOOST_TEST(are_counts_of_strata(fit, strata));
  fit.number_of_boundary_vertices = 3;
  BOOST_TEST(!are_counts_of_strata(fit, strata));

  const Core_mesh good = as_core_mesh(grid(2, TETRAHEDRON));
  const Mesh_defects none = find_defects(good);
  BOOST_TEST(has_no_new_defects(none, good));
  Core_mesh bad = good;
  bad.add_vertex(Core_mesh::Point_3(5, 5, 5)); // unused
  BOOST_TEST(!has_no_new_defects(none, bad));
  BOOST_TEST(has_no_new_defects(find_defects(bad), bad));
  bad.add_element(TETRAHEDRON, {0, 1, 2, 27}); // a third element at a face, or an inverted one
  BOOST_TEST(!has_no_new_defects(none, bad));
  Core_mesh inverted = good;
  inverted.points()[13] = Core_mesh::Point_3(5, 5, 5);
  BOOST_TEST(!has_no_new_defects(find_defects(inverted), inverted)); // never, whatever the start
}

int run(int, char*[])
{
  test_levels();
  test_effort();
  test_bound();
  test_weights();
  test_arrival();
  test_return();
  test_retreat();
  test_going_back();
  test_improvement();
  test_mending();
  test_merges();
  test_paths();
  test_parts_between();
  test_flat_elements();
  test_followed_features();
  test_bisections();
  test_optimization();
  test_simplification();
  test_postconditions();
  return boost::report_errors();
}

} // namespace test_fitting_passes
