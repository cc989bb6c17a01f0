// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact without friction, compared with all choices of closed contacts, and by the conditions of the
// solution.

#include "elasticity_test.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace test_contact {

using namespace elasticity_test;

const auto is_at_bottom = [](const Vec3& p) { return p[2] == 0; };
const auto is_at_top = [](const Vec3& p) { return p[2] == 1; };

std::vector<Vertex_index> top_vertices(const Mesh& mesh)
{
  std::vector<Vertex_index> top;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_at_top(position(mesh, v)))
      top.push_back(v);
  return top;
}

struct Load
{
  std::vector<Vec3> points{{0.3, 0.6, 0.7}, {0.7, 0.3, 0.6}};
  Field displacements;
  Vec3 force{};
};

Load random_load(Noise& random)
{
  Load load;
  for(std::size_t i = 0; i < load.points.size(); ++i)
    load.displacements.push_back(0.05 * random.vector());
  load.force = 0.2 * random.vector();
  return load;
}

// Fixes the bottom, and sets loads.
void prepare(Elasticity& problem, const Load& load)
{
  const Mesh& mesh = problem.mesh();
  prescribe(problem, vertices_where(mesh, is_at_bottom), [](const Vec3&) { return Vec3{}; });
  BOOST_TEST(is_success(problem.factor()));
  problem.set_body_force(load.force);
  BOOST_TEST(is_success(problem.set_control_points(load.points)));
}

// Only one of all choices of held vertices at the top neither pulls nor penetrates.
void test_all_choices(int kind)
{
  constexpr double rounding = 1e-10;
  const Mesh mesh = any_grid(2, kind);
  const std::vector<Vertex_index> top = top_vertices(mesh);
  BOOST_TEST_EQ(top.size(), 9u);
  Noise random;
  int mixed = 0;
  for(int trial = 0; trial < 3; ++trial) {
    const Load load = random_load(random);
    Elasticity problem(mesh);
    for(Vertex_index v : top)
      problem.touch(v, {0, 0, 2});
    prepare(problem, load);
    BOOST_TEST(is_success(problem.solve(load.displacements)));
    int solutions = 0;
    for(unsigned choice = 0; choice < 1u << top.size(); ++choice) {
      Elasticity held(mesh);
      for(std::size_t i = 0; i < top.size(); ++i)
        if(choice >> i & 1)
          held.slide(top[i], {0, 0, 1});
      prepare(held, load);
      BOOST_TEST(is_success(held.solve(load.displacements)));
      bool is_solution = true;
      for(std::size_t i = 0; i < top.size() && is_solution; ++i)
        if(!(choice >> i & 1))
          is_solution = held.displacements()[top[i]][2] <= rounding;
      if(!is_solution)
        continue;
      // A vertex that would pull moves away when it is released.
      for(std::size_t i = 0; i < top.size() && is_solution; ++i)
        if(choice >> i & 1) {
          Elasticity without(mesh);
          for(std::size_t j = 0; j < top.size(); ++j)
            if(j != i && choice >> j & 1)
              without.slide(top[j], {0, 0, 1});
          prepare(without, load);
          BOOST_TEST(is_success(without.solve(load.displacements)));
          is_solution = without.displacements()[top[i]][2] >= -rounding;
        }
      if(!is_solution)
        continue;
      ++solutions;
      mixed += choice != 0 && choice + 1 != 1u << top.size();
      BOOST_TEST_LT(difference(problem.displacements(), held.displacements()), 1e-9);
      for(std::size_t i = 0; i < top.size(); ++i)
        BOOST_TEST_EQ(problem.contact_forces()[top[i]] > 0, (choice >> i & 1) == 1);
    }
    BOOST_TEST_EQ(solutions, 1);
  }
  BOOST_TEST_GT(mixed, 0);
}

// Walls around a body, at a distance: no penetration, no pull, forces only in contact, and these forces keep
// the body in equilibrium.
void test_conditions(int kind, bool is_corotational)
{
  constexpr double gap = 0.004;
  const Mesh mesh = any_grid(4, kind, 0.1, Moved::INNER);
  Energy energy(mesh);
  Elasticity problem(mesh);
  const std::vector<bool> is_boundary = is_on_boundary(mesh);
  problem.touch_along_boundary([](Vertex_index) { return true; }, gap);
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) { // normals are known except at edges
    const Vec3 p = position(mesh, v);
    for(int k = 0; k < 2 && is_boundary[v]; ++k)
      if(p[k] == 0 || p[k] == 1)
        problem.touch(v, {k == 0 ? 2 * p[0] - 1 : 0, k == 1 ? 2 * p[1] - 1 : 0, 0}, gap);
    if(is_at_top(p))
      problem.touch(v, {0, 0, 1}, gap);
  }
  const std::vector<bool> is_fixed = vertices_where(mesh, is_at_bottom);
  prescribe(problem, is_fixed, [](const Vec3&) { return Vec3{}; });
  BOOST_TEST(is_success(problem.factor()));
  problem.set_corotational(is_corotational);
  const std::vector<Vec3> points{{0.5, 0.5, 0.6}};
  BOOST_TEST(is_success(problem.set_control_points(points)));
  Field first;
  for(const Vec3& wanted :
      {Vec3{0.02, 0.01, 0.03}, Vec3{-0.04, 0, 0.01}, Vec3{0, 0.03, -0.03}, Vec3{0.02, 0.01, 0.03}}) {
    BOOST_TEST(is_success(problem.solve(Field{wanted})));
    const Field& u = problem.displacements();
    const std::vector<double>& forces = problem.contact_forces();
    int closed = 0, open = 0;
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
      BOOST_TEST_GE(forces[v], 0);
      if(!is_boundary[v] || is_fixed[v]) {
        BOOST_TEST_EQ(forces[v], 0);
        continue;
      }
      const Vec3 p = position(mesh, v);
      Vec3 normal{0, 0, 1};
      for(int k = 1; k >= 0; --k) // the last call counts
        if(!is_at_top(p) && (p[k] == 0 || p[k] == 1) && normal[2] == 1) {
          normal = Vec3{};
          normal[k] = 2 * p[k] - 1;
        }
      const double way = dot(u[v], normal);
      BOOST_TEST_LT(way, gap + (is_corotational ? 1e-6 : 1e-8));
      if(forces[v] > 0) {
        BOOST_TEST_LT(std::abs(way - gap), 1e-9);
        ++closed;
      } else {
        ++open;
      }
      if(!is_corotational) { // the force is the increase of the energy
        Field d(mesh.number_of_vertices(), Vec3{});
        d[v] = normal;
        Field both = u;
        both[v] = both[v] + normal;
        const double rise = energy(both) - energy(u) - energy(d);
        const Vec3 force = problem.control_forces()[0];
        const double work = dot(force, interpolated(mesh, d, points[0])) - forces[v];
        BOOST_TEST_LT(std::abs(rise - work), 1e-8 * norm(force));
      }
    }
    BOOST_TEST_GT(closed, 0);
    BOOST_TEST_GT(open, closed);
    if(first.empty())
      first = u;
    else if(wanted == Vec3{0.02, 0.01, 0.03}) // independent of solutions in between
      BOOST_TEST_LT(difference(u, first), is_corotational ? 1e-6 : 1e-12);
  }
  // The tolerance of the removal does not keep a wall from releasing a vertex.
  problem.set_iteration_tolerance(1e-10);
  BOOST_TEST(is_success(problem.solve(Field{{0.02, 0.01, 0.03}})));
  BOOST_TEST_LT(difference(problem.displacements(), first), 1e-6);
}

void test_limits()
{
  const Mesh mesh = any_grid(3, number_of_element_kinds - 1);
  const auto solve = [&](const std::function<void(Elasticity&, Vertex_index)>& hold, double way, Field& u) {
    Elasticity problem(mesh);
    for(Vertex_index v : top_vertices(mesh))
      hold(problem, v);
    prescribe(problem, vertices_where(mesh, is_at_bottom), [](const Vec3&) { return Vec3{}; });
    BOOST_TEST(is_success(problem.factor()));
    BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{{0.5, 0.5, 0.5}})));
    BOOST_TEST(is_success(problem.solve(Field{{0, 0, way}})));
    u = problem.displacements();
    return problem.contact_forces();
  };
  const auto touch = [](Elasticity& problem, Vertex_index v) { problem.touch(v, {0, 0, 1}); };
  Field u, expected;
  // The body slides if pressed against the wall, and is free if pulled away.
  const std::vector<double> pressed = solve(touch, 0.02, u);
  for(Vertex_index v : top_vertices(mesh))
    BOOST_TEST_GT(pressed[v], 0);
  solve([](Elasticity& problem, Vertex_index v) { problem.slide(v, {0, 0, 1}); }, 0.02, expected);
  BOOST_TEST_LT(difference(u, expected), 1e-12);
  BOOST_TEST(solve(touch, -0.02, u) == std::vector<double>(mesh.number_of_vertices(), 0.));
  solve([](Elasticity&, Vertex_index) {}, -0.02, expected);
  BOOST_TEST_LT(difference(u, expected), 1e-12);
  // A point of the wall can be pulled off the wall again and again, but not pushed into it.
  Elasticity held(mesh);
  for(Vertex_index v : top_vertices(mesh))
    held.touch(v, {0, 0, 1});
  prescribe(held, vertices_where(mesh, is_at_bottom), [](const Vec3&) { return Vec3{}; });
  BOOST_TEST(is_success(held.factor()));
  BOOST_TEST(is_success(held.set_control_points(std::vector<Vec3>{{1. / 3, 1. / 3, 1}})));
  for(double way : {-0.02, 0., 0.02, -0.01, 0.01, 0.}) {
    const auto result = held.solve(Field{{0.01, 0, way}});
    BOOST_TEST(result.status == (way > 0 ? Status::CONTRADICTORY_CONTROL_POINTS : Status::SUCCESS));
    if(way <= 0)
      BOOST_TEST_LT(norm(interpolated(mesh, held.displacements(), {1. / 3, 1. / 3, 1}) - Vec3{0.01, 0, way}),
                    1e-9);
  }
  // A support that holds a vertex anyway leaves no contact force.
  BOOST_TEST(solve(
               [](Elasticity& problem, Vertex_index v) {
                 problem.slide(v, {0, 0, 1});
                 problem.touch(v, {0, 0, 1});
               },
               -0.02, u)
             == std::vector<double>(mesh.number_of_vertices(), 0.));

  // Only the weight holds a body that rests on a table: the body could slide; and lifted, it could turn.
  Elasticity problem(mesh);
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_at_bottom(position(mesh, v)))
      problem.touch(v, {0, 0, -1});
  BOOST_TEST(is_success(problem.factor()));
  problem.set_gravity({0, 0, -9810});
  BOOST_TEST(problem.solve().status == Status::FREE_RIGID_MOTION);
  // The body rests with a corner held. The table bears the rest, half of the weight by the balance of
  // moments.
  BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{{0, 0, 1}, {0, 1, 1}})));
  BOOST_TEST(is_success(problem.solve(Field(2, Vec3{}))));
  double table = 0, corner = 0;
  for(double force : problem.contact_forces())
    table += force;
  for(const Vec3& force : problem.control_forces())
    corner += force[2];
  const double weight = 9810 * 1e-6;
  BOOST_TEST_LT(std::abs(table + corner - weight), 1e-9 * weight);
  BOOST_TEST_GT(table, 0.3 * weight);

  // The body turns about the points when lifted. Released, it rests again, whatever the contacts were.
  problem.set_gravity({0, 0, 9810});
  BOOST_TEST(problem.solve(Field(2, Vec3{})).status == Status::FREE_RIGID_MOTION);
  problem.set_gravity({0, 0, -9810});
  const Field rest = problem.displacements();
  BOOST_TEST(is_success(problem.solve(Field(2, Vec3{}))));
  BOOST_TEST_LT(difference(rest, problem.displacements()), 1e-12);

  // After a removal, contacts change as before.
  std::vector<bool> is_removed(mesh.number_of_elements(), false);
  is_removed.back() = true;
  BOOST_TEST(is_success(problem.remove_elements(is_removed)));
  BOOST_TEST(problem.is_iterative());
  BOOST_TEST(is_success(problem.solve(Field(2, Vec3{0, 0, 0.1}))));
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_at_bottom(position(mesh, v)))
      BOOST_TEST_GT(problem.displacements()[v][2], -1e-9);
}

int run(int, char*[])
{
  for(int kind = 0; kind < number_of_element_kinds; ++kind)
    test_all_choices(kind);
  for(int kind = 0; kind <= number_of_element_kinds; ++kind)
    test_conditions(kind, false);
  test_conditions(HEXAHEDRON, true);
  test_limits();
  return boost::report_errors();
}

} // namespace test_contact
