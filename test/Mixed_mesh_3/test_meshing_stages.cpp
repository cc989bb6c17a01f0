// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stages of the method, each alone on a state of small bodies, and the numbers that decide between meshes.
// Postconditions of the stages, each of which a fault violates.

#include "test_grids.h"
#include "test_meshing.h"

#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Meshing_state.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Misfit.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Tolerance_search.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/arguments.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/fewest_vertices.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/fill_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/fine_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/make_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/mesh_domain.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/meshing_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/run_stages.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/sharp_cells.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/simplify_to_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/unreached_cells.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Oracles.h>
#include <CGAL/Mixed_mesh_regions_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <iterator>
#include <utility>
#include <vector>

namespace test_meshing_stages {

using namespace CGAL::Mixed_meshes_3::internal;
using CGAL::Ball_mixed_mesh_region_3;
using CGAL::Everywhere_mixed_mesh_region_3;
using Traits = Axis_aligned_octree_cell_traits_3;

// A cube around a box, in no special position.
CGAL::Bbox_3 around(const CGAL::Bbox_3& b)
{
  const double side = 1.2 * (std::max)({b.x_span(), b.y_span(), b.z_span()}), x = b.xmin() - 0.03 * side,
               y = b.ymin() - 0.07 * side, z = b.zmin() - 0.11 * side;
  return {x, y, z, x + side, y + side, z + side};
}

// A body as the stages see it, in a root a little larger than its box.
struct Body
{
  Surface surface;
  Polyhedral_mixed_mesh_domain_3 domain;
  Everywhere_mixed_mesh_region_3 region;
  Traits traits;
  Oracles oracles;
  Located_octree root;

  explicit Body(Surface s)
    : surface(std::move(s)), domain(surface), traits(around(domain.bbox())),
      oracles(oracles_of(domain, region, traits)), root(oracles)
  {
  }
};

Surface ball() { return sphere(Point_3(0.5, 0.5, 0.5), 0.5, 24); }
Surface two_boxes()
{
  Surface s = box(Point_3(0, 0, 0), Point_3(0.6, 0.6, 0.6));
  add_box(s, Point_3(1.2, 1.2, 1.2), Point_3(1.8, 1.8, 1.8));
  return s;
}

// A state, and what it refers to.
struct Run
{
  Meshing_criteria criteria;
  Recording_visitor recording;
  Visitor_reference<Recording_visitor> visitor;
  Meshing_state state;

  Run(const Body& body, const Mixed_mesh_criteria_3& c)
    : criteria(c, 1), visitor(recording), state(body.root, criteria, visitor)
  {
    state.result.vertex_budget = criteria.maximal_number_of_vertices();
    state.result.tolerance = chosen_tolerance(state);
  }
};

double distance_from_surface(const Core_mesh& mesh, const Body& body)
{
  double largest = 0;
  for(Vertex_index v : boundary_vertices(mesh)) {
    const auto p = mesh.point(v);
    largest = (std::max)(largest, std::sqrt(CGAL::squared_distance(p, body.domain.closest_point(p))));
  }
  return largest;
}

bool is_on_surface(const Core_mesh& mesh, const Body& body)
{
  return distance_from_surface(mesh, body) < 1e-8;
}

// A box of a grid, as a mesh.
Core_mesh mesh_of_box(const Vec3& corner, double side, int n)
{
  Core_mesh mesh = as_core_mesh(grid(n, HEXAHEDRON));
  for(auto& p : mesh.points())
    p = Core_mesh::Point_3(corner[0] + side * p.x(), corner[1] + side * p.y(), corner[2] + side * p.z());
  return mesh;
}

// ---- arguments and visitors --------------------------------------------------------------------

static_assert(Is_face_graph<Surface>::value && !Is_face_graph<Polyhedral_mixed_mesh_domain_3>::value);
static_assert(Is_surface_model<Polyhedral_mixed_mesh_domain_3>::value && !Is_surface_model<Surface>::value);
static_assert(Is_region_model<Ball_mixed_mesh_region_3>::value
              && Is_region_model<Polyhedral_mixed_mesh_domain_3>::value && !Is_region_model<Surface>::value);
static_assert(!Is_surface_model<int>::value && !Is_face_graph<int>::value && !Is_region_model<int>::value);

void test_arguments()
{
  const auto np = CGAL::parameters::default_values();
  const Body body(ball());
  BOOST_TEST(&as_domain(body.domain, np) == &body.domain); // no copy
  BOOST_TEST(&as_surface(body.domain, np) == &body.domain);
  BOOST_TEST(&as_region(body.region, np) == &body.region);
  const auto made = as_domain(body.surface, np);
  BOOST_TEST(made.bbox() == body.domain.bbox());
  Recording_visitor visitor;
  const auto count = [](auto& v) {
    v.progress(7, 8);
    return v.go_on();
  };
  BOOST_TEST(with_visitor(CGAL::parameters::visitor(std::ref(visitor)), count));
  BOOST_TEST(visitor.sizes == std::vector<std::size_t>{7} && visitor.number_of_questions == 1);
  BOOST_TEST(with_visitor(np, count)); // the default visitor goes on
  BOOST_TEST_EQ(visitor.number_of_questions, 1u);
}

void test_scopes()
{
  Recording_visitor recording;
  Visitor_reference<Recording_visitor> visitor(recording);
  {
    const Stage_scope octree(visitor, Stage::OCTREE);
    BOOST_TEST_EQ(recording.open, int(Stage::OCTREE));
    {
      const Stage_pause pause(visitor, Stage::OCTREE);
      BOOST_TEST_EQ(recording.open, -1);
      const Stage_scope inner(visitor, Stage::TRANSITIONS);
      BOOST_TEST_EQ(recording.open, int(Stage::TRANSITIONS));
    }
    BOOST_TEST_EQ(recording.open, int(Stage::OCTREE));
  }
  BOOST_TEST_EQ(recording.open, -1);
  BOOST_TEST_EQ(recording.number_of_errors, 0u);
  BOOST_TEST(recording.begun == recording.ended);
  BOOST_TEST_EQ(recording.begun[int(Stage::OCTREE)], 2u);
}

// ---- numbers that decide -----------------------------------------------------------------------

void test_misfit()
{
  const Body one(box(Point_3(0, 0, 0), Point_3(1, 1, 1))), two(two_boxes());
  const auto misfit = [](const Core_mesh& mesh, const Body& body, std::size_t lost, std::size_t off,
                         double distance) {
    return Misfit(mesh, body.root.domain(), true, lost, off, 0, distance);
  };
  const Core_mesh cube = mesh_of_box({0, 0, 0}, 1, 3), small = mesh_of_box({0, 0, 0}, 0.9, 3);
  const Misfit none = misfit(cube, one, 0, 0, 0), off = misfit(cube, one, 0, 3, 0),
               far = misfit(cube, one, 0, 0, 0.5), lost = misfit(cube, one, 2, 0, 0),
               volume = misfit(small, one, 0, 0, 0), topology = misfit(cube, two, 0, 0, 0);
  BOOST_TEST(none.is_none() && none.is_nearly_right(0));
  BOOST_TEST(off.is_none() && !off.is_nearly_right(2) && off.is_nearly_right(3));
  BOOST_TEST(!far.is_nearly_right(0) && !lost.is_none());
  BOOST_TEST(volume.is_some_volume_wrong() && !volume.is_topology_wrong()); // 0.9^3 is off by 27 %
  BOOST_TEST(topology.is_topology_wrong());
  // What weighs most decides.
  const Misfit ascending[] = {none, far, off, volume, lost, topology, Misfit::without_mesh()};
  for(std::size_t i = 0; i < std::size(ascending); ++i)
    for(std::size_t j = 0; j < std::size(ascending); ++j)
      BOOST_TEST_EQ(ascending[i] < ascending[j], i < j);
}

void test_decisions()
{
  const Body body(ball());
  const auto begins = [&](const Mixed_mesh_criteria_3& c) { return begins_fine(body.root, c); };
  BOOST_TEST(begins(Mixed_mesh_criteria_3(500)));
  BOOST_TEST(!begins(Mixed_mesh_criteria_3(500).simplification(false)));
  BOOST_TEST(!begins(Mixed_mesh_criteria_3(500).fit_to_surface(false)));
  BOOST_TEST(!begins(Mixed_mesh_criteria_3(500).base_level(3)));
  Mixed_mesh_result_3 r;
  r.status = Status::SUCCESS;
  r.tolerance = 1;
  r.optimization.largest_distance = 0.9 * share_of_tolerance;
  BOOST_TEST(meets_all_criteria(r));
  r.optimization.largest_distance = 1;
  BOOST_TEST(!meets_all_criteria(r));
  r.optimization.largest_distance = 0;
  r.status = Status::TOPOLOGY_DIFFERS;
  BOOST_TEST(!meets_all_criteria(r));
  std::size_t last = 100000;
  for(double tolerance : {0.005, 0.01, 0.02, 0.04, 1.}) { // the larger, the fewer vertices
    const std::size_t n = first_budget(body.root, Mixed_mesh_criteria_3(100000).tolerance(tolerance));
    BOOST_TEST(least_budget <= n && n < last);
    last = n;
  }
  BOOST_TEST_EQ(last, least_budget);

  Core_mesh mesh = mesh_of_box({0, 0, 0}, 1, 2);
  BOOST_TEST_EQ(number_of_vertices_in_region(mesh), 0u);
  std::vector<Element_attributes> attributes(8);
  attributes[0].is_in_region = attributes[1].is_in_region = true;
  mesh.assign(mesh.points(), mesh.elements(), attributes);
  BOOST_TEST_EQ(number_of_vertices_in_region(mesh), 12u); // two cells side by side
}

// Sharp edges of a plate are as near to each other as the plate is thick; those of a cube are not.
void test_narrow_places()
{
  constexpr double thickness = 0.1, reach = 0.3;
  for(double height : {thickness, 1.}) {
    const Body body(box(Point_3(0, 0, 0), Point_3(1, 1, height)));
    const Sharp_edges sharp = body.root.domain().sharp_edges(60);
    const Sharp_features features(sharp, 0.02);
    BOOST_TEST(!features.empty());
    const std::vector<Narrow_place> places = narrow_places(features, reach, 0.02);
    BOOST_TEST_EQ(places.empty(), height == 1);
    for(const Narrow_place& place : places)
      BOOST_TEST(thickness - 1e-9 <= place.width && place.width < reach);
    Located_octree octree = body.root;
    BOOST_TEST(refine_to_level(octree, 2, 1000));
    const auto is_coarse = [&](const Narrow_place& place) {
      const Octree::Node_index n = octree.leaf_at({place.point[0], place.point[1], place.point[2]});
      return octree.side(n) == CGAL::ON_BOUNDARY && octree.edge_length(n) > place.width;
    };
    BOOST_TEST_EQ(std::any_of(places.begin(), places.end(), is_coarse), height != 1);
    split_narrow_cells(octree, places, 0);
    BOOST_TEST(std::none_of(places.begin(), places.end(), is_coarse));
    BOOST_TEST(is_balanced(octree.octree(), Adjacency::EDGE));
  }
}

// Of two boxes, a mesh reaches one: the cells at the surface of the other are not reached.
void test_unreached_cells()
{
  const Body body(two_boxes());
  Located_octree octree = body.root;
  BOOST_TEST(refine_to_level(octree, 4, 100000));
  std::vector<Octree::Node_index> all, other;
  for(Octree::Node_index n = 0; n < octree.octree().size(); ++n)
    if(octree.octree().is_leaf(n) && octree.side(n) == CGAL::ON_BOUNDARY) {
      all.push_back(n);
      if(octree.domain().cell_box(octree.octree().corner(n), octree.octree().side(n)).xmin() > 0.9)
        other.push_back(n);
    }
  BOOST_TEST(!other.empty() && other.size() < all.size());
  BOOST_TEST(unreached_cells(octree, all, mesh_of_box({0, 0, 0}, 0.6, 3), 0.1) == other);
  BOOST_TEST(unreached_cells(octree, all, Core_mesh(), 0.1) == all);
}

// ---- stages ------------------------------------------------------------------------------------

void test_fill()
{
  const Body body(ball());
  Run run(body, Mixed_mesh_criteria_3(1000).share_of_bisections(0));
  Meshing_state& s = run.state;
  BOOST_TEST(!fill_lattice(s)); // no planes
  BOOST_TEST_EQ(s.best.number_of_vertices, 0u);
  {
    const Stage_scope scope(s.visitor, Stage::OCTREE);
    fill_budget(s);
  }
  BOOST_TEST(s.best.is_manifold() && s.best.number_of_vertices <= 1000);
  BOOST_TEST_GE(double(s.best.number_of_vertices), 0.97 * 1000);
  BOOST_TEST(is_balanced(s.octree.octree(), Adjacency::EDGE));
  BOOST_TEST(is_valid_lattice_mesh(s.best.mesh));
  BOOST_TEST(is_valid_boundary(s.octree, s.best.mesh, s.best.boundary));
  BOOST_TEST(!s.misfit_on_lattice().is_topology_wrong());
  BOOST_TEST_EQ(run.recording.number_of_errors, 0u);
  BOOST_TEST_EQ(s.result.number_of_trials, run.recording.sizes.size());

  const std::size_t n = s.best.number_of_vertices;
  Core_mesh mesh;
  make_mesh(s, mesh);
  BOOST_TEST(s.result.status == Status::SUCCESS && s.best.is_released());
  BOOST_TEST_EQ(mesh.number_of_vertices(), n);
  BOOST_TEST(is_on_surface(mesh, body) && find_defects(mesh).none());
  BOOST_TEST_EQ(s.number_not_arrived(), 0u);
  BOOST_TEST(s.misfit_of(mesh).is_none());
}

// Cells outside the region are split where a coarse boundary would be too far, and none with a large
// tolerance.
void test_tolerance()
{
  const Body body(ball());
  const Ball_mixed_mesh_region_3 region(Point_3(0.5, 0.5, 0.5), 0.1);
  const Located_octree root(body.domain, region, body.traits);
  for(double tolerance : {0.005, 0.4}) {
    const Meshing_criteria criteria(Mixed_mesh_criteria_3(3000).tolerance(tolerance), 1);
    Recording_visitor recording;
    Visitor_reference<Recording_visitor> visitor(recording);
    Meshing_state s(root, criteria, visitor);
    s.result.tolerance = tolerance;
    {
      const Stage_scope scope(s.visitor, Stage::OCTREE);
      s.tolerance_search.run();
    }
    BOOST_TEST(!s.tolerance_search.is_stopped());
    BOOST_TEST_EQ(s.tolerance_search.has_far_points(), tolerance < 0.1);
    BOOST_TEST(s.result.number_of_vertices_for_tolerance > 0
               && s.result.number_of_vertices_for_tolerance <= 1500); // a half of the budget
    Located_octree octree = s.root;
    BOOST_TEST(refine_to_level(octree, s.coarsest_level(), 3000));
    const std::size_t number = octree.number_of_cells();
    s.tolerance_search.split_far_cells(octree, 0);
    BOOST_TEST_EQ(octree.number_of_cells(), number);
    s.tolerance_search.split_far_cells(octree);
    BOOST_TEST_EQ(octree.number_of_cells() > number, tolerance < 0.1);
  }
}

void test_fine_meshes()
{
  constexpr std::size_t n = 400;
  const Body body(ball());
  BOOST_TEST_EQ(number_of_fine_vertices(n), 4 * n);
  for(bool is_cut : {false, true}) {
    Run run(body, Mixed_mesh_criteria_3(n));
    const Core_mesh fine = is_cut ? cut_fine_mesh(run.state) : fine_mesh_on_lattice(run.state);
    BOOST_TEST_GT(fine.number_of_vertices(), 2 * n);
    BOOST_TEST(find_defects(fine).none());
    std::cout << (is_cut ? "cut" : "lattice") << ": " << distance_from_surface(fine, body)
              << " off the surface" << std::endl;
    BOOST_TEST_EQ(distance_from_surface(fine, body) < 1e-3, is_cut); // cells are 0.05 wide
    BOOST_TEST(shells_of_boundary(fine) == body.domain.shells());
    if(is_cut) {
      BOOST_TEST(lost_cells(run.state.octree, fine).empty());
      BOOST_TEST(!lost_cells(run.state.octree, Core_mesh()).empty());
    }
    Run whole(body, Mixed_mesh_criteria_3(n));
    Core_mesh mesh;
    make_simplified_mesh(whole.state, is_cut, mesh);
    BOOST_TEST(mesh.number_of_vertices() <= n && double(mesh.number_of_vertices()) >= 0.97 * n);
    BOOST_TEST(is_on_surface(mesh, body) && find_defects(mesh).none());
    BOOST_TEST_GT(whole.state.result.number_of_collapsed_vertices, n);
    BOOST_TEST_EQ(whole.recording.number_of_errors, 0u);
  }
}

void test_run()
{
  const Body body(ball());
  const Mixed_mesh_criteria_3 criteria(400);
  Recording_visitor recording;
  Visitor_reference<Recording_visitor> visitor(recording);
  Core_mesh mesh, again, fewest;
  const Mixed_mesh_result_3 result = run_stages(body.root, {criteria, 1}, visitor, mesh);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST(are_numbers_of_mesh(result, criteria, mesh) && is_valid_result(result, mesh));
  BOOST_TEST(mesh_domain(body.oracles, {criteria, 1}, visitor, again).status == Status::SUCCESS);
  BOOST_TEST(mesh.points() == again.points()
             && mesh.elements().connectivity() == again.elements().connectivity());
  BOOST_TEST_EQ(recording.number_of_errors, 0u);

  // The fewest vertices are within the tolerance, and half of them are not.
  constexpr double tolerance = 0.02;
  const auto with_tolerance = Mixed_mesh_criteria_3(4000).tolerance(tolerance).fewest_vertices(true);
  const Mixed_mesh_result_3 f = run_with_fewest_vertices(body.root, {with_tolerance, 1}, visitor, fewest);
  BOOST_TEST(meets_all_criteria(f) && f.number_of_budgets > 1);
  BOOST_TEST(find_defects(fewest).none());
  BOOST_TEST_LE(fewest.number_of_vertices(), f.vertex_budget);
  Core_mesh half;
  const auto with_half = Mixed_mesh_criteria_3(fewest.number_of_vertices() / 2).tolerance(tolerance);
  BOOST_TEST(!meets_all_criteria(run_stages(body.root, {with_half, 1}, visitor, half)));
}

// ---- postconditions ----------------------------------------------------------------------------

// Each postcondition holds for what the stages make, and not with a fault.
void test_postconditions()
{
  const Body body(ball());
  Located_octree octree = body.root;
  BOOST_TEST(refine_to_level(octree, 4, 100000));
  const Meshing_criteria criteria(Mixed_mesh_criteria_3(2000), 1);
  Recording_visitor recording;
  Visitor_reference<Recording_visitor> visitor(recording);
  Candidate c;
  make_lattice_mesh(octree, criteria, visitor, c);
  BOOST_TEST(is_valid_lattice_mesh(c.mesh));
  BOOST_TEST(is_valid_boundary(octree, c.mesh, c.boundary));
  ++c.boundary.number_of_vertices;
  BOOST_TEST(!is_valid_boundary(octree, c.mesh, c.boundary));
  --c.boundary.number_of_vertices;
  std::swap(c.mesh.vertices[0], c.mesh.vertices[1]);
  BOOST_TEST(!is_valid_lattice_mesh(c.mesh));

  const Core_mesh cube = mesh_of_box({0, 0, 0}, 1, 2);
  BOOST_TEST(is_valid_cut(cube) && is_valid_cut(Core_mesh()));
  Core_mesh inverted = cube;
  inverted.points()[13] = Core_mesh::Point_3(3, 3, 3);
  BOOST_TEST(!is_valid_cut(inverted));

  Mixed_mesh_result_3 r;
  r.status = Status::SUCCESS;
  r.vertex_budget = 30;
  r.shells = shells_of_boundary(cube);
  r.shells_of_domain = r.shells;
  const Mixed_mesh_criteria_3 budget(30);
  BOOST_TEST(are_numbers_of_mesh(r, budget, cube) && is_valid_result(r, cube));
  BOOST_TEST(!are_numbers_of_mesh(r, budget, Core_mesh()));             // a mesh, says the status
  BOOST_TEST(!are_numbers_of_mesh(r, Mixed_mesh_criteria_3(29), cube)); // another budget
  BOOST_TEST(!is_valid_result(r, inverted));
  r.optimization.number_of_arrived_vertices = 1; // of none
  BOOST_TEST(!are_numbers_of_mesh(r, budget, cube));
  r.optimization.number_of_arrived_vertices = 0;
  r.vertex_budget = 26;
  BOOST_TEST(!are_numbers_of_mesh(r, budget, cube)); // 27 vertices
  r.vertex_budget = 30;
  ++r.shells_of_domain->number_of_shells;
  BOOST_TEST(!are_numbers_of_mesh(r, budget, cube));
  r.status = Status::TOPOLOGY_DIFFERS;
  BOOST_TEST(are_numbers_of_mesh(r, budget, cube));
  r.status = Status::EMPTY;
  BOOST_TEST(!are_numbers_of_mesh(r, budget, cube));

  // Two cubes that cut each other are positive, and manifold.
  Core_mesh crossing = cube;
  for(const auto& p : cube.points())
    crossing.add_vertex(Core_mesh::Point_3(p.x() + 0.3, p.y() + 0.2, p.z() + 0.1));
  for(Element_index e = 0; e < cube.number_of_elements(); ++e) {
    std::vector<Vertex_index> vertices;
    for(Vertex_index v : cube.element(e))
      vertices.push_back(v + 27);
    crossing.add_element(HEXAHEDRON, vertices);
  }
  r.status = Status::SUCCESS;
  BOOST_TEST(find_defects(crossing).none());
  BOOST_TEST(!is_valid_result(r, crossing));
  r.optimization.is_boundary_simple = false;
  BOOST_TEST(is_valid_result(r, crossing));
}

int run(int, char*[])
{
  test_arguments();
  test_scopes();
  test_misfit();
  test_decisions();
  test_narrow_places();
  test_unreached_cells();
  test_fill();
  test_tolerance();
  test_fine_meshes();
  test_run();
  test_postconditions();
  return boost::report_errors();
}

} // namespace test_meshing_stages
