// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Configurational forces compared with differences of the energy, and the adaptation of meshes along the
// forces.

#include "elasticity_test.h"
#include "standard_elasticity.h"

#include <CGAL/Linear_elasticity_3/adapt_mixed_mesh_3.h>
#include <CGAL/Linear_elasticity_3/internal/configurational_forces.h>
#include <CGAL/Linear_elasticity_3/internal/guard_loads.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <vector>

namespace test_adapt {

using namespace elasticity_test;
using Criteria = CGAL::Mixed_mesh_adaptation_criteria_3;
using Result = CGAL::Mixed_mesh_adaptation_result_3;
using Adaptation_status = CGAL::Mixed_mesh_adaptation_status;

Prescribed_displacements on_boundary(const Mesh& mesh, const Function& f)
{
  Prescribed_displacements result;
  for(Vertex_index v : boundary_vertices(mesh))
    result[v] = f(position(mesh, v));
  return result;
}

// Displacements that decay fast from a side of the unit cube.
Vec3 steep_field(const Vec3& p)
{
  const double x = p[0] - 0.5, y = p[1] - 0.5;
  return {0, 0, 0.1 * std::exp(-8 * (x * x + y * y)) * p[2] * p[2] * p[2]};
}

double standard_energy(const Mesh& mesh, const Elastic_material& material, const Field& u)
{
  return mesh_energy(mesh.elements(), points_of(mesh), {material}, u).energy;
}

// ---- gradient ----------------------------------------------------------------------------------

void test_gradient(Element_kind kind, double nu)
{
  const Elastic_material material{2, nu};
  const Mesh mesh = any_grid(2, kind, 0.15);
  Noise noise;
  Field u;
  for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v)
    u.push_back(noise.vector());
  std::vector<Vec3> points = points_of(mesh);
  const auto energy = [&] { return mesh_energy(mesh.elements(), points, {material}, u); };
  const Mesh_energy exact = energy();
  double largest = 0, worst = 0;
  const double step = 5e-5;
  const auto compare = [&](double& x, double gradient) {
    const double before = x;
    const auto at = [&](double offset) {
      x = before + offset * step;
      return energy().energy;
    };
    // The difference is of fourth order.
    const double numeric = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
    x = before;
    largest = (std::max)(largest, std::abs(gradient));
    worst = (std::max)(worst, std::abs(numeric - gradient));
  };
  for(std::size_t v = 0; v < points.size(); ++v)
    for(int k = 0; k < 3; ++k) {
      compare(points[v][k], exact.by_positions[v][k]);
      compare(u[v][k], exact.by_displacements[v][k]);
    }
  BOOST_TEST_LT(worst, 1e-6 * largest);
  BOOST_TEST_GT(largest, 0.01);
}

// The energy is that of the stiffness of standard elements, and of those of the package in a linear field.
void test_energy()
{
  const Mesh mesh = any_grid(4, number_of_element_kinds, 0.15);
  const Field u = at_vertices(mesh, linear_field);
  const Elastic_material material{3, 0.3};
  const double expected = Energy(mesh, material)(u);
  BOOST_TEST_LT(std::abs(standard_energy(mesh, material, u) - expected), 1e-12 * expected);
}

// ---- patch test --------------------------------------------------------------------------------

void test_linear_field()
{
  for(int kind = 0; kind <= number_of_element_kinds; ++kind) {
    const Mesh before = any_grid(4, kind, 0.15);
    const Mesh_energy energy = mesh_energy(before.elements(), points_of(before), {Elastic_material()},
                                           at_vertices(before, linear_field));
    const std::vector<bool> is_boundary = is_on_boundary(before);
    for(Vertex_index v = 0; v < before.number_of_vertices(); ++v)
      if(!is_boundary[v])
        BOOST_TEST_LT(norm(energy.by_positions[v]), 1e-12 * energy.energy);
    Mesh mesh = before;
    const Result result = CGAL::adapt_mixed_mesh_3(mesh, {Elastic_material()},
                                                   {on_boundary(mesh, linear_field)});
    BOOST_TEST(result.status == Adaptation_status::CONVERGED);
    BOOST_TEST_EQ(result.number_of_steps, 0);
    BOOST_TEST(mesh.points() == before.points());
  }
}

// ---- steps -------------------------------------------------------------------------------------

// Runs that end after more and more solves are prefixes of the same steps.
void test_steps(int kind)
{
  constexpr double bound = 2.5;
  const Mesh before = any_grid(4, kind, 0.1, Moved::INNER);
  const std::vector<Prescribed_displacements> cases{on_boundary(before, steep_field),
                                                    on_boundary(before, [](const Vec3& p) {
                                                      return Vec3{p[1] * p[1] * p[2], 0, p[0] * p[0]};
                                                    })};
  const std::vector<bool> is_boundary = is_on_boundary(before);
  double last = 1;
  for(int solves : {1, 2, 3, 5, 9}) {
    Mesh mesh = before;
    const Result result = CGAL::adapt_mixed_mesh_3(mesh, {Elastic_material()}, cases,
                                                   Criteria().maximal_number_of_solves(solves).quality_bound(
                                                     bound));
    BOOST_TEST_LE(result.number_of_solves, solves);
    BOOST_TEST_LE(result.functional, last + 1e-14);
    last = result.functional;
    BOOST_TEST(find_defects(mesh).positive());
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      BOOST_TEST_LE(CGAL::Mixed_meshes_3::aspect_ratio_coefficient(mesh, e),
                    (std::max)(bound, CGAL::Mixed_meshes_3::aspect_ratio_coefficient(before, e))
                      * (1 + 1e-12));
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(is_boundary[v])
        BOOST_TEST(mesh.point(v) == before.point(v));
    double ratios = 0;
    for(std::size_t i = 0; i < cases.size(); ++i) {
      Field u(mesh.number_of_vertices(), Vec3{});
      for(const auto& [v, displacement] : cases[i])
        u[v] = displacement;
      const double energy = standard_energy(mesh, Elastic_material(),
                                            standard_solution(mesh, Elastic_material(), is_boundary, u));
      BOOST_TEST_LT(std::abs(energy - result.energies_after[i]), 1e-9 * energy);
      ratios += energy / result.energies_before[i];
    }
    BOOST_TEST_LT(std::abs(ratios / 2 - result.functional), 1e-9);
  }
  std::cout << name_of(kind) << ": energies, mean after / before: " << last << '\n';
  BOOST_TEST_LT(last, 1);
}

// ---- error in energy ---------------------------------------------------------------------------

// The error in energy, half the square of the error in the energy norm, is the excess of the energy over that
// of a fine mesh. The data are the same on all grids whose cells fit into the patch that is pulled.
void test_error_in_energy()
{
  const Elastic_material material{1, 0.3};
  const auto is_at = [](double x, double where) { return std::abs(x - where) < 1e-9; };
  // One side is fixed, a corner of the opposite one is pulled; the rest is free.
  const auto data = [&](const Mesh& mesh) {
    Prescribed_displacements result;
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
      const Vec3 p = position(mesh, v);
      if(is_at(p[2], 0))
        result[v] = Vec3{};
      else if(is_at(p[2], 1) && (std::max)(p[0], p[1]) < 0.25 + 1e-9)
        result[v] = Vec3{0, 0, 0.1};
    }
    return result;
  };
  const auto energy_of = [&](const Mesh& mesh) {
    Mesh copy = mesh;
    return CGAL::adapt_mixed_mesh_3(copy, {material}, {data(mesh)}, Criteria().maximal_number_of_solves(1))
      .energies_before.at(0);
  };
  const double exact = energy_of(grid(24, HEXAHEDRON));
  for(Element_kind kind : {HEXAHEDRON, TETRAHEDRON})
    for(double weight : {0., 0.3}) { // a regular grid is good for guard loads: they leave little to gain
      Mesh mesh = grid(8, kind);
      const double before = energy_of(mesh) - exact;
      const Result result = CGAL::adapt_mixed_mesh_3(mesh, {material}, {data(mesh)},
                                                     Criteria().guard_weight(weight));
      const double after = energy_of(mesh) - exact;
      std::cout << name_of(kind) << ", weight " << weight << ": error in energy " << 100 * before / exact
                << " % -> " << 100 * after / exact << " %, " << result.number_of_solves << " solves\n";
      BOOST_TEST_GT(after, 0);
      BOOST_TEST_LT(after, (weight > 0 ? 1 : 0.98) * before);
    }
}

// ---- guard -------------------------------------------------------------------------------------

// The energies of loads on a mesh.
std::vector<double> energies_of(Mesh mesh, const std::vector<Prescribed_displacements>& loads)
{
  return CGAL::adapt_mixed_mesh_3(mesh, {Elastic_material()}, loads, Criteria().maximal_number_of_solves(1))
    .energies_before;
}

// A patch of the top is pushed, the bottom is fixed: the mesh gets worse for smooth loads unless guard loads
// are in the functional.
void test_guard(Element_kind kind)
{
  const Mesh before = any_grid(6, kind, 0.15, Moved::INNER);
  const auto is_at = [](double x, double where) { return std::abs(x - where) < 1e-9; };
  Prescribed_displacements bump;
  for(Vertex_index v = 0; v < before.number_of_vertices(); ++v) {
    const Vec3 p = position(before, v);
    const double distance = std::hypot(p[0] - 0.5, p[1] - 0.5);
    if(is_at(p[2], 0))
      bump[v] = Vec3{};
    else if(is_at(p[2], 1) && distance < 0.4)
      bump[v] = Vec3{0, 0, -0.05 * (1 + std::cos(M_PI * distance / 0.4))};
  }
  const std::vector<bool> is_boundary = boundary_flags(before.elements(), before.number_of_vertices());
  const std::vector<Prescribed_displacements> guards = guard_loads(points_of(before), is_boundary, {bump});
  BOOST_TEST_EQ(guards.size(), 6u);
  const std::vector<double> guards_before = energies_of(before, guards);
  for(double weight : {0., 0.3}) {
    Mesh mesh = before;
    const Result result = CGAL::adapt_mixed_mesh_3(mesh, {Elastic_material()}, {bump},
                                                   Criteria().guard_weight(weight));
    const std::vector<double> guards_after = energies_of(mesh, guards);
    double worst = 0;
    for(std::size_t i = 0; i < guards.size(); ++i)
      worst = (std::max)(worst, guards_after[i] / guards_before[i]);
    std::cout << name_of(kind) << ", weight " << weight << ": energy of the bump x " << result.functional
              << ", worst guard load x " << worst << '\n';
    BOOST_TEST_LT(result.functional, 0.999);
    BOOST_TEST_EQ(worst <= 1 + 1e-9, weight > 0);
    BOOST_TEST_EQ(result.guard_energies_after.size(), weight > 0 ? guards.size() : 0u);
    for(std::size_t i = 0; i < result.guard_energies_after.size(); ++i) {
      BOOST_TEST_LT(std::abs(result.guard_energies_after[i] - guards_after[i]), 1e-9 * guards_after[i]);
      BOOST_TEST_LE(result.guard_energies_after[i], result.guard_energies_before[i]);
    }
    // Vertices of elements at the border stay, others move.
    const std::vector<bool> is_at_border = vertices_at_borders(before.elements(), is_boundary, {bump});
    std::size_t moved = 0;
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(is_at_border[v])
        BOOST_TEST(mesh.point(v) == before.point(v));
      else
        moved += mesh.point(v) != before.point(v);
    BOOST_TEST_GT(moved, 0u);
    BOOST_TEST(find_defects(mesh).positive());
  }
}

// Loads that displace nothing, or a single vertex, have no guard loads.
void test_no_guard_loads()
{
  const Mesh mesh = grid(2, HEXAHEDRON);
  const std::vector<bool> is_boundary = boundary_flags(mesh.elements(), mesh.number_of_vertices());
  const auto number = [&](const std::vector<Prescribed_displacements>& cases) {
    return guard_loads(points_of(mesh), is_boundary, cases).size();
  };
  BOOST_TEST_EQ(number({}), 0u);
  BOOST_TEST_EQ(number({{{0, Vec3{}}, {1, Vec3{}}}}), 0u);
  BOOST_TEST_EQ(number({{{0, Vec3{1, 0, 0}}, {1, Vec3{}}}}), 0u);
  BOOST_TEST_EQ(number({{{0, Vec3{1, 0, 0}}, {1, Vec3{0, 1, 0}}}}), 6u);
}

// ---- what stays, and what ends it --------------------------------------------------------------

struct Stop_after
{
  int steps;
  bool go_on() { return steps-- > 0; }
};

struct Constrained
{
  using key_type = Vertex_index;
  using value_type = bool;
  using reference = bool;
  using category = boost::readable_property_map_tag;
  const Mesh* mesh;
  friend bool get(const Constrained& map, Vertex_index v) { return position(*map.mesh, v)[2] > 0.6; }
};

void test_what_stays()
{
  Mesh mesh = any_grid(4, HEXAHEDRON);
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    double lowest = 1;
    for(Vertex_index v : mesh.element(e))
      lowest = (std::min)(lowest, position(mesh, v)[2]);
    mesh.set_subdomain_index(e, lowest < 0.4 ? 1 : 2); // the interface is at 1/2
  }
  const Mesh before = mesh;
  const std::vector<Prescribed_displacements> cases{on_boundary(mesh, steep_field)};
  const auto moved = [&](const Mesh& m, const std::function<bool(double)>& is_where) {
    std::size_t count = 0;
    for(Vertex_index v = 0; v < m.number_of_vertices(); ++v)
      count += is_where(position(before, v)[2]) && m.point(v) != before.point(v);
    return count;
  };
  const Criteria criteria = Criteria().guard_weight(0); // the grid is good for guard loads as it is
  const Result result = CGAL::adapt_mixed_mesh_3(mesh, {Elastic_material()}, cases, criteria);
  BOOST_TEST_EQ(result.number_of_inner_vertices, 18u);
  BOOST_TEST_EQ(moved(mesh, [](double z) { return z == 0.5; }), 0u);
  BOOST_TEST_GT(moved(mesh, [](double z) { return z != 0.5; }), 0u);

  Mesh constrained = before;
  CGAL::adapt_mixed_mesh_3(constrained, {Elastic_material()}, cases, criteria,
                           CGAL::parameters::vertex_is_constrained_map(Constrained{&before}));
  BOOST_TEST_EQ(moved(constrained, [](double z) { return z > 0.6; }), 0u);
  BOOST_TEST_GT(moved(constrained, [](double z) { return z < 0.4; }), 0u);

  Mesh stopped = before;
  Stop_after visitor{2};
  const Result two = CGAL::adapt_mixed_mesh_3(stopped, {Elastic_material()}, cases, criteria,
                                              CGAL::parameters::visitor(std::ref(visitor)));
  BOOST_TEST(two.status == Adaptation_status::STOPPED);
  BOOST_TEST_EQ(two.number_of_solves, 3);

  Mesh again = before;
  CGAL::adapt_mixed_mesh_3(again, {Elastic_material()}, cases, criteria);
  BOOST_TEST(again.points() == mesh.points()); // bit by bit
}

void test_statuses()
{
  const auto status = [](Mesh mesh, const std::vector<Prescribed_displacements>& cases) {
    const Mesh before = mesh;
    const Result result = CGAL::adapt_mixed_mesh_3(mesh, {Elastic_material()}, cases);
    BOOST_TEST(mesh.points() == before.points());
    std::cout << CGAL::Mixed_meshes_3::description(result.status) << '\n';
    return result.status;
  };
  const Mesh mesh = any_grid(3, TETRAHEDRON, 0.1);
  BOOST_TEST(status(Mesh(), {}) == Adaptation_status::EMPTY);
  BOOST_TEST(status(mesh, {}) == Adaptation_status::NO_LOAD);
  BOOST_TEST(status(mesh, {on_boundary(mesh, rigid_motion)}) == Adaptation_status::NO_LOAD);
  BOOST_TEST(status(mesh, {{}}) != Adaptation_status::CONVERGED); // free, without a load
  const Mesh one = any_grid(1, HEXAHEDRON);
  BOOST_TEST(status(one, {on_boundary(one, steep_field)}) == Adaptation_status::NO_INNER_VERTEX);
  Mesh inverted = mesh;
  std::swap(inverted.points()[21], inverted.points()[22]);
  BOOST_TEST(status(inverted, {on_boundary(mesh, steep_field)}) == Adaptation_status::INVALID_MESH);
}

int run(int, char*[])
{
  for(Element_kind kind : element_kinds)
    for(double nu : {0., 0.3, 0.45})
      test_gradient(kind, nu);
  test_energy();
  test_linear_field();
  for(int kind = 0; kind <= number_of_element_kinds; ++kind)
    test_steps(kind);
  test_error_in_energy();
  test_guard(HEXAHEDRON);
  test_guard(TETRAHEDRON);
  test_no_guard_loads();
  test_what_stays();
  test_statuses();
  return boost::report_errors();
}

} // namespace test_adapt
