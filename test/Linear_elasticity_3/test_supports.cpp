// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Supports and loads of Linear_elasticity_3: uniaxial stress, shear, layers of materials, gravity; and the
// rigid motions that supports leave free.

#include "elasticity_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace test_supports {

using namespace elasticity_test;

// Makes the cube's sides x = 0, y = 0 and z = 0 slide, and the requested opposite sides.
void slide_on_sides(Elasticity& problem, bool x_at_1, bool y_at_1)
{
  for(Vertex_index v = 0; v < problem.mesh().number_of_vertices(); ++v) {
    const Vec3 p = position(problem.mesh(), v);
    for(int k = 0; k < 3; ++k)
      if(p[k] == 0 || (p[k] == 1 && (k == 0 ? x_at_1 : k == 1 && y_at_1))) {
        Vec3 normal{};
        normal[k] = k == 1 ? -2 : 3; // of any length
        problem.slide(v, normal);
      }
  }
}

bool is_on_top(const Vec3& p) { return p[2] == 1; }

void test_supports(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.15, Moved::INNER);
  const double nu = 0.45;

  // Plates without friction cause uniaxial stress.
  const auto compressed = [&](const Vec3& p) { return Vec3{0.1 * nu * p[0], 0.1 * nu * p[1], -0.1 * p[2]}; };
  Elasticity problem(mesh, Elastic_material{3, nu});
  slide_on_sides(problem, false, false);
  prescribe(problem, vertices_where(mesh, is_on_top), compressed);
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.solve()));
  BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, compressed)), 1e-10);
  BOOST_TEST_LT(std::abs(problem.energy() - 3 * 0.1 * 0.1 / 2), 1e-10);

  // Vertices slide on sheared planes that are not parallel to the axes.
  const auto turned = [](const Vec3& p) { return p[0] == 0 ? cross(Vec3{1, 2, 3}, p) : Vec3{}; };
  Elasticity sheared(mesh, Elastic_material{3, nu});
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const Vec3 n = turned(position(mesh, v));
    if(norm(n) > 0)
      sheared.slide(v, n);
  }
  prescribe(sheared, vertices_where(mesh, [](const Vec3& p) { return p[0] == 1; }), linear_field);
  BOOST_TEST(is_success(sheared.factor()));
  BOOST_TEST(is_success(sheared.solve()));
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    BOOST_TEST_LT(std::abs(dot(sheared.displacements()[v], turned(position(mesh, v)))), 1e-12);

  // Supports get other displacements, without another factorization.
  for(double factor : {2., -0.5}) {
    Elasticity fresh(mesh, Elastic_material{3, nu});
    slide_on_sides(fresh, true, false);
    const Field u = at_vertices(mesh, [&](const Vec3& p) { return factor * rigid_motion(p); });
    prescribe(fresh, vertices_where(mesh, is_on_top), u);
    BOOST_TEST(is_success(fresh.factor()));
    BOOST_TEST(is_success(fresh.solve()));
    Elasticity again(mesh, Elastic_material{3, nu});
    slide_on_sides(again, true, false);
    prescribe(again, vertices_where(mesh, is_on_top), linear_field);
    BOOST_TEST(is_success(again.factor()));
    BOOST_TEST(is_success(again.solve()));
    BOOST_TEST_GT(difference(again.displacements(), fresh.displacements()), 0.1);
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(is_on_top(position(mesh, v)))
        again.set_support_displacement(v, u[v]);
    BOOST_TEST(is_success(again.solve()));
    BOOST_TEST_LT(difference(again.displacements(), fresh.displacements()), 1e-12);
  }

  // Two layers in series are confined at the sides: the stress is the same in both.
  std::vector<Elastic_material> layers;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    double z = 0;
    for(Vertex_index v : mesh.element(e))
      z += position(mesh, v)[2] / mesh.element(e).size();
    layers.push_back(z < 0.5 ? Elastic_material{1, 0.3, 2e-6} : Elastic_material{4, 0.45, 5e-6});
  }
  const auto modulus = [](const Elastic_material& m) { return m.lambda() + 2 * m.mu(); };
  const double below = modulus({1, 0.3}), above = modulus({4, 0.45}),
               stress = 0.1 / (0.5 / below + 0.5 / above);
  const auto in_series = [&](const Vec3& p) {
    return Vec3{0, 0, -stress * ((std::min)(p[2], 0.5) / below + (std::max)(p[2] - 0.5, 0.) / above)};
  };
  // The vertices between the layers have to be in a plane.
  Mesh layered = mesh;
  {
    const Mesh regular = any_grid(4, kind);
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(position(regular, v)[2] == 0.5)
        layered.points()[v] = regular.point(v);
  }
  BOOST_TEST(find_defects(layered).positive());
  for(Element_index e = 0; e < layered.number_of_elements(); ++e)
    layered.set_subdomain_index(e, layers[e].young_modulus == 1 ? 1 : 2);
  Elasticity bar(layered, materials_of_elements(layered, {{1, {1, 0.3, 2e-6}}, {2, {4, 0.45, 5e-6}}}));
  slide_on_sides(bar, true, true);
  prescribe(bar, vertices_where(layered, is_on_top), in_series);
  BOOST_TEST(is_success(bar.factor()));
  BOOST_TEST(is_success(bar.solve()));
  BOOST_TEST_LT(difference(bar.displacements(), at_vertices(layered, in_series)), 1e-10);

  // The displacement under the weight is a parabola, exact at vertices of regular hexahedra and prisms.
  const double g = 9810;
  const auto weighed = [&](const Vec3& p) {
    return Vec3{0, 0, -2e-5 * g / modulus({3, nu}) * (p[2] - p[2] * p[2] / 2)};
  };
  const bool is_exact = kind == HEXAHEDRON || kind == PRISM;
  double last = 0;
  for(int n : {4, 12}) {
    const Mesh column = any_grid(n, kind);
    Elasticity heavy(column, Elastic_material{3, nu, 2e-5});
    slide_on_sides(heavy, true, true);
    BOOST_TEST(is_success(heavy.factor()));
    heavy.set_gravity({0, 0, -g});
    BOOST_TEST(is_success(heavy.solve()));
    const Field expected = at_vertices(column, weighed);
    const double error = difference(heavy.displacements(), expected) / largest(expected);
    std::cout << "  column of " << n << "^3 cells, " << name_of(kind) << ": largest error " << 100 * error
              << " %\n";
    if(is_exact)
      BOOST_TEST_LT(error, 1e-10);
    else if(n == 4)
      last = error;
    else
      BOOST_TEST_LT(error, 0.5 * last);
    // Gravity equals a force by volume; and both together are twice that.
    const Field by_gravity = heavy.displacements();
    heavy.set_body_force({0, 0, -2e-5 * g});
    BOOST_TEST(is_success(heavy.solve()));
    for(Vertex_index v = 0; v < by_gravity.size(); ++v)
      BOOST_TEST_LT(norm(heavy.displacements()[v] - 2 * by_gravity[v]), 1e-12);
    heavy.set_gravity({});
    BOOST_TEST(is_success(heavy.solve()));
    BOOST_TEST_LT(difference(heavy.displacements(), by_gravity), 1e-12);
  }

  // Control points bear the weight, which is different in each layer, and its moment.
  Elasticity hung(layered, layers);
  BOOST_TEST(is_success(hung.factor()));
  hung.set_gravity({0, 0, -g});
  const std::vector<Vec3> points{{0.1, 0.2, 0.9}, {0.8, 0.1, 0.7}, {0.4, 0.9, 0.6}, {0.3, 0.5, 0.2}};
  BOOST_TEST(is_success(hung.set_control_points(points)));
  BOOST_TEST(is_success(hung.solve(Field(4, Vec3{}))));
  Vec3 force{}, moment{};
  for(std::size_t i = 0; i < points.size(); ++i) {
    force = force + hung.control_forces()[i];
    moment = moment + cross(points[i] - Vec3{0.5, 0.5, 0}, hung.control_forces()[i]);
  }
  const double weight = g * (0.5 * 2e-6 + 0.5 * 5e-6);
  BOOST_TEST_LT(norm(force - Vec3{0, 0, weight}), 1e-9 * weight);
  BOOST_TEST_LT(norm(moment), 1e-9 * weight);
}

// The share of a tetrahedron below a height, compared with the share of points, and by symmetries.
void test_share_below()
{
  Noise random;
  for(int trial = 0; trial < 200; ++trial) {
    std::array<double, 4> h{};
    for(double& x : h)
      x = trial % 4 == 0 ? std::floor(3 * random()) : random(); // equal heights, too
    const int n = 40;
    double below = 0, all = 0;
    for(int i = 0; i < n; ++i)
      for(int j = 0; i + j < n; ++j)
        for(int k = 0; i + j + k < n; ++k) {
          const double a = (i + 0.25) / n, b = (j + 0.25) / n, c = (k + 0.25) / n;
          const double height = a * h[0] + b * h[1] + c * h[2] + (1 - a - b - c) * h[3];
          below += height < 0 ? 1 : height == 0 ? 0.5 : 0;
          ++all;
        }
    const double share = share_below(h);
    BOOST_TEST_LT(std::abs(share - below / all), 0.06);
    BOOST_TEST(share >= 0 && share <= 1);
    std::array<double, 4> mirrored{-h[2], -h[0], -h[3], -h[1]};
    const bool is_flat = h == std::array<double, 4>{};
    if(!is_flat)
      BOOST_TEST_LT(std::abs(share + share_below(mirrored) - 1), 1e-12);
  }
  // Simple cases with one, two or three vertices below, computed by hand.
  BOOST_TEST_LT(std::abs(share_below({-1, 1, 1, 1}) - 0.125), 1e-15);
  BOOST_TEST_LT(std::abs(share_below({-1, -1, 1, 1}) - 0.5), 1e-15);
  BOOST_TEST_LT(std::abs(share_below({-3, 1, 1, 1}) - 27. / 64), 1e-15);
}

// A body in a fluid, up to a level: a column with the weight of the difference below, and the whole weight
// above.
void test_fluid(int kind)
{
  const double g = 9810, density = 1.04e-6, fluid = 1e-6, nu = 0.3;
  const Elastic_material material{3, nu, density};
  const Vec3 acceleration{0, 0, -g};
  const Mesh column = any_grid(4, kind);
  Elasticity problem(column, material);
  slide_on_sides(problem, true, true);
  BOOST_TEST(is_success(problem.factor()));
  problem.set_gravity(acceleration);
  BOOST_TEST(is_success(problem.solve()));
  const Field dry = problem.displacements();

  // The whole body in the fluid bears the difference of the densities, as a share of the weight; outside it
  // bears the weight.
  problem.set_body_forces(buoyant_forces(column, acceleration, fluid));
  BOOST_TEST(is_success(problem.solve()));
  for(Vertex_index v = 0; v < dry.size(); ++v)
    BOOST_TEST_LT(norm(problem.displacements()[v] - (1 - fluid / density) * dry[v]), 1e-12 * largest(dry));
  for(double level : {-1e-9, -std::numeric_limits<double>::infinity()}) {
    problem.set_body_forces(buoyant_forces(column, acceleration, fluid, level));
    BOOST_TEST(is_success(problem.solve()));
    BOOST_TEST_LT(difference(problem.displacements(), dry), 1e-12 * largest(dry));
  }
  // A body as heavy as the fluid does not move in the fluid.
  problem.set_body_forces(buoyant_forces(column, acceleration, density, 1));
  BOOST_TEST(is_success(problem.solve()));
  BOOST_TEST_LT(largest(problem.displacements()), 1e-12 * largest(dry));

  // The stress in a half immersed body is the weight above, and exact at vertices of regular hexahedra and
  // prisms.
  const double modulus = material.lambda() + 2 * material.mu(), level = 0.5;
  const auto sunk = [&](const Vec3& p) {
    const double z = p[2], low = (std::min)(z, level);
    const double u = density * (z - z * z / 2) - fluid * (level * low - low * low / 2);
    return Vec3{0, 0, -g * u / modulus};
  };
  problem.set_body_forces(buoyant_forces(column, acceleration, fluid, level));
  BOOST_TEST(is_success(problem.solve()));
  const Field expected = at_vertices(column, sunk);
  const bool is_exact = kind == HEXAHEDRON || kind == PRISM;
  BOOST_TEST_LT(difference(problem.displacements(), expected), (is_exact ? 1e-10 : 0.1) * largest(expected));

  // Control points bear the difference, for any level and direction; elements are cut, and warped.
  const Mesh mesh = any_grid(4, kind, 0.15, Moved::INNER);
  double volume_of_mesh = 0;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    volume_of_mesh += volume(mesh, e);
  BOOST_TEST_LT(std::abs(volume_of_mesh - 1), 1e-12);
  Elasticity hung(mesh, material);
  BOOST_TEST(is_success(hung.factor()));
  BOOST_TEST(is_success(hung.set_control_points(
    std::vector<Vec3>{{0.1, 0.2, 0.9}, {0.8, 0.1, 0.7}, {0.4, 0.9, 0.6}, {0.3, 0.5, 0.2}})));
  for(const Vec3& direction : {Vec3{0, 0, -1}, Vec3{0.6, 0, -0.8}})
    for(double height : {0.1, 0.37, 0.625}) {
      hung.set_gravity(g * direction);
      hung.set_body_forces(buoyant_forces(mesh, g * direction, fluid, height));
      BOOST_TEST(is_success(hung.solve(Field(4, Vec3{}))));
      Vec3 force{};
      for(const Vec3& f : hung.control_forces())
        force = force + f;
      // The part of the cube below has unit width along y, and a polygon as its section.
      const int n = 2000;
      double below = 0;
      for(int i = 0; i < n; ++i) {
        const double x = (i + 0.5) / n;
        const double z = (height + x * direction[0]) / -direction[2];
        below += (std::min)(1., (std::max)(0., z)) / n;
      }
      const Vec3 wanted = -g * (density - below * fluid) * direction;
      BOOST_TEST_LT(norm(force - wanted), 2e-3 * norm(wanted));
    }
  BOOST_TEST(buoyant_forces(mesh, Vec3{}, fluid, 0.5) == Field(mesh.number_of_elements(), Vec3{}));
}

// Rotations about the center are free if every vertex of the boundary slides around it.
void test_free_motions()
{
  const Vec3 center{0.5, 0.5, 0.5};
  const Mesh mesh = any_grid(4, number_of_element_kinds, 0.1);
  const std::vector<bool> is_boundary = is_on_boundary(mesh);
  Elasticity problem(mesh);
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_boundary[v])
      problem.slide(v, position(mesh, v) - center);
  BOOST_TEST(is_success(problem.factor()));
  auto result = problem.solve();
  BOOST_TEST(result.status == Status::FREE_RIGID_MOTION);
  BOOST_TEST_EQ(result.number_of_free_motions, 3);
  BOOST_TEST(result.description().find("3 rigid motions free, among them rotation about the axis")
             != std::string::npos);
  const auto motion = [&](const Vec3& p) {
    return result.motion.translation + cross(result.motion.rotation, p - result.motion.center);
  };
  BOOST_TEST_LT(norm(motion(center)), 1e-6 * norm(result.motion.rotation));
  // A point on the boundary leaves one rotation; two hold all three. The body turns as the points do.
  const auto turn = [&](const Vec3& p) { return cross(Vec3{0.1, -0.2, 0.3}, p - center); };
  const Vec3 a = position(mesh, 0), b = position(mesh, 4);
  BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{a})));
  result = problem.solve(Field{turn(a)});
  BOOST_TEST(result.status == Status::FREE_RIGID_MOTION);
  BOOST_TEST_EQ(result.number_of_free_motions, 1);
  BOOST_TEST_LT(norm(cross(result.motion.rotation, a - center)), 1e-6 * norm(result.motion.rotation));
  BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{a, b})));
  BOOST_TEST(is_success(problem.solve(Field{turn(a), turn(b)})));
  BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, turn)), 1e-9);
  BOOST_TEST_LT(problem.energy(), 1e-14);

  // A plane leaves two translations and a rotation; a fixed vertex leaves three rotations; an edge of fixed
  // vertices one.
  const Mesh block = any_grid(4, number_of_element_kinds, 0.1, Moved::INNER);
  const auto free_motions = [&](const std::function<void(Elasticity&)>& support) {
    Elasticity held(block);
    support(held);
    BOOST_TEST(is_success(held.factor()));
    const auto r = held.solve();
    BOOST_TEST_EQ(r.status == Status::FREE_RIGID_MOTION, r.number_of_free_motions > 0);
    return r.number_of_free_motions;
  };
  const auto fixed = [&](const std::function<bool(const Vec3&)>& where) {
    return [&block, where](Elasticity& held) {
      prescribe(held, vertices_where(block, where), [](const Vec3&) { return Vec3{}; });
    };
  };
  BOOST_TEST_EQ(free_motions([](Elasticity&) {}), 6);
  BOOST_TEST_EQ(free_motions(fixed([](const Vec3& p) { return norm(p) == 0; })), 3);
  BOOST_TEST_EQ(free_motions(fixed([](const Vec3& p) { return p[0] == 0 && p[1] == 0; })), 1);
  BOOST_TEST_EQ(free_motions(fixed(is_on_top)), 0);
  BOOST_TEST_EQ(free_motions([&](Elasticity& held) {
                  for(Vertex_index v = 0; v < block.number_of_vertices(); ++v)
                    if(is_on_top(position(block, v)))
                      held.slide(v, {0, 0, 1});
                }),
                3);
  BOOST_TEST_EQ(free_motions([&](Elasticity& held) { slide_on_sides(held, false, false); }), 0);
  BOOST_TEST_EQ(free_motions(
                  [](Elasticity& held) { held.slide_along_boundary([](Vertex_index) { return true; }); }),
                0);

  // Vertices slide along the boundary: the volume stays, to first order, in whatever direction vertices move.
  Elasticity sliding(mesh);
  sliding.slide_along_boundary([](Vertex_index) { return true; });
  BOOST_TEST(is_success(sliding.factor()));
  sliding.set_body_force({0.1, 0.2, -1});
  BOOST_TEST(is_success(sliding.solve()));
  BOOST_TEST_GT(largest(sliding.displacements()), 1e-3);
  const double step = 1e-3;
  double volumes[2] = {0, 0};
  for(int side = 0; side < 2; ++side) {
    Mesh moved = mesh;
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
      const Vec3 p = position(mesh, v) + (side == 0 ? -step : step) * sliding.displacements()[v];
      moved.points()[v] = Test_point(p[0], p[1], p[2]);
    }
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      volumes[side] += volume(moved, e);
  }
  BOOST_TEST_LT(std::abs(volumes[1] - volumes[0]), 1e-12); // of third order in the step
}

// The constraints of supports and control points, as other programs can query them.
void test_constraints()
{
  const Mesh mesh = any_grid(3, 0, 0, Moved::INNER);
  Elasticity problem(mesh);
  problem.prescribe(0);
  problem.slide(1, {0, 0, -2});
  problem.slide(2, {3, 4, 0});
  problem.slide(2, {0, 1, 0});
  BOOST_TEST_EQ(problem.held_directions(0).size(), 3u);
  BOOST_TEST(problem.held_directions(1) == std::vector<Vec3>({{0, 0, -1}}));
  BOOST_TEST_EQ(problem.held_directions(2).size(), 2u);
  for(const Vec3& d : problem.held_directions(2))
    BOOST_TEST_LT(std::abs(norm(d) - 1) + std::abs(d[2]), 1e-12);
  BOOST_TEST(problem.held_directions(3).empty());
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(problem.control_weights().empty());
  const Vec3 places[] = {{0.4, 0.3, 0.7}, {0.5, 0.5, 1}};
  for(double radius : {0., 0.6}) { // with 0.6, both have the mean of the boundary's vertices
    BOOST_TEST(is_success(problem.set_control_points(places, 0, 0, radius)));
    const auto weights = problem.control_weights();
    BOOST_TEST_EQ(weights.size(), 2u);
    for(std::size_t i = 0; i < weights.size(); ++i) {
      double sum = 0;
      Vec3 mean{};
      for(const auto& [v, weight] : weights[i]) {
        sum += weight;
        mean = mean + weight * position(mesh, v);
        BOOST_TEST(radius == 0 || norm(position(mesh, v) - places[i]) <= radius);
      }
      BOOST_TEST_LT(std::abs(sum - 1), 1e-12);
      BOOST_TEST(radius > 0 || norm(mean - places[i]) < 1e-12);
    }
  }
}

int run(int, char*[])
{
  test_constraints();
  for(int kind = 0; kind <= number_of_element_kinds; ++kind)
    test_supports(kind);
  test_share_below();
  for(int kind = 0; kind <= number_of_element_kinds; ++kind)
    test_fluid(kind);
  test_free_motions();
  return boost::report_errors();
}

} // namespace test_supports
