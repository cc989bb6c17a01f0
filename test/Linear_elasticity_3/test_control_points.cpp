// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Control points of Linear_elasticity_3: their displacements, and the absence of other constraints.

#include "elasticity_test.h"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace test_control_points {

using namespace elasticity_test;

// A point in an element, by its vertices' weights.
Vec3 point_in(const Mesh& mesh, Element_index e, int q)
{
  const Element_view element = mesh.element(e);
  Vec3 p{};
  for(int a = 0; a < element.size(); ++a)
    p = p
        + quadrature_rule(element.kind()).values[std::size_t(q)][std::size_t(a)] * position(mesh, element[a]);
  return p;
}

double bilinear(Energy& energy, const Field& u, const Field& v)
{
  Field sum = u;
  for(std::size_t i = 0; i < u.size(); ++i)
    sum[i] = u[i] + v[i];
  return energy(sum) - energy(u) - energy(v);
}

void test_control_points(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.1);
  const Element_locator_3<Mesh> locator(mesh);
  Noise random;

  // The points are in elements, on faces inside and on the boundary, and at vertices.
  std::vector<Vec3> points;
  const std::uint32_t last = std::uint32_t(mesh.number_of_elements() - 1);
  for(Element_index e : {last / 5, 2 * last / 5, 3 * last / 5, 4 * last / 5, last})
    points.push_back(point_in(mesh, e, 0));
  for(Element_index e : {last / 3, 2 * last / 3}) {
    const Face_vertices face = Face(mesh.elements(), e, 0).vertices();
    Vec3 p{};
    for(Vertex_index v : face)
      p = p + (1. / face.size()) * position(mesh, v);
    points.push_back(p);
  }
  const Face_vertices polygon = boundary_faces(mesh).back().vertices();
  Vec3 on_boundary{};
  for(Vertex_index v : polygon)
    on_boundary = on_boundary + (1. / polygon.size()) * position(mesh, v);
  points.push_back(on_boundary);
  points.push_back(position(mesh, 70));
  Field wanted;
  for(std::size_t i = 0; i < points.size(); ++i)
    wanted.push_back(0.05 * random.vector());

  Elasticity problem(mesh);
  const std::vector<bool> is_fixed = vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.1; });
  prescribe(problem, is_fixed, [](const Vec3&) { return Vec3{}; });
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.set_control_points(points)));
  BOOST_TEST_EQ(problem.number_of_control_points(), points.size());
  BOOST_TEST(is_success(problem.solve(wanted)));
  const Field u = problem.displacements();
  for(std::size_t i = 0; i < points.size(); ++i)
    BOOST_TEST_LT(norm(interpolated(mesh, u, points[i]) - wanted[i]), 1e-9 * 0.05);

  // The energy is minimal: supports and control points do no other work; and the forces do the work of the
  // moved points.
  Energy energy(mesh);
  BOOST_TEST_LT(std::abs(problem.energy() - energy(u)), 1e-12 * energy(u));
  for(int trial = 0; trial < 5; ++trial) {
    Field d(mesh.number_of_vertices());
    for(Vertex_index v = 0; v < d.size(); ++v)
      d[v] = is_fixed[v] ? Vec3{} : 0.05 * random.vector();
    double work = 0;
    for(std::size_t i = 0; i < points.size(); ++i)
      work += dot(problem.control_forces()[i], interpolated(mesh, d, points[i]));
    const double scale = std::sqrt(energy(u) * energy(d));
    BOOST_TEST_LT(std::abs(bilinear(energy, u, d) - work), 1e-9 * scale);
    for(const Vec3& p : points)
      for(Vertex_index v : mesh.element(locator.nearest(p).element))
        d[v] = Vec3{};
    BOOST_TEST_GT(largest(d), 0);
    BOOST_TEST_LT(std::abs(bilinear(energy, u, d)), 1e-9 * scale);
  }

  // Springs of vanishing compliance.
  double distance = 1;
  for(double compliance : {1e-1, 1e-3, 1e-5, 1e-7}) {
    BOOST_TEST(is_success(problem.set_control_points(points, 0, compliance)));
    BOOST_TEST(is_success(problem.solve(wanted)));
    const double now = difference(problem.displacements(), u);
    BOOST_TEST_LT(now, 0.5 * distance);
    distance = now;
  }
  BOOST_TEST_LT(distance, 1e-4 * largest(u));

  // Vertices as control points act like prescribed vertices.
  std::vector<Vec3> corners;
  std::vector<bool> is_prescribed(mesh.number_of_vertices(), false);
  Field given(mesh.number_of_vertices(), Vec3{}), displacements;
  for(Vertex_index v : {0u, 4u, 24u, 31u, 62u, 100u, 124u}) {
    is_prescribed[v] = true;
    given[v] = 0.05 * random.vector();
    corners.push_back(position(mesh, v));
    displacements.push_back(given[v]);
  }
  Elasticity as_supports(mesh), as_controls(mesh);
  prescribe(as_supports, is_prescribed, given);
  BOOST_TEST(is_success(as_supports.factor()));
  BOOST_TEST(is_success(as_supports.solve()));
  BOOST_TEST(is_success(as_controls.factor()));
  BOOST_TEST(is_success(as_controls.set_control_points(corners)));
  BOOST_TEST(is_success(as_controls.solve(displacements)));
  BOOST_TEST_LT(difference(as_controls.displacements(), as_supports.displacements()), 1e-9 * largest(given));
  Vec3 force{}, moment{}; // in equilibrium
  double size = 0;
  for(std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 f = as_controls.control_forces()[i];
    force = force + f;
    moment = moment + cross(corners[i], f);
    size += norm(f);
  }
  BOOST_TEST_LT(norm(force), 1e-9 * size);
  BOOST_TEST_LT(norm(moment), 1e-9 * size);

  // A body held by control points alone makes a rigid motion; springs of any compliance give the same motion.
  for(double compliance : {0., 1e-2, 10.}) {
    displacements.clear();
    for(const Vec3& p : points)
      displacements.push_back(rigid_motion(p));
    BOOST_TEST(is_success(as_controls.set_control_points(points, 0, compliance)));
    BOOST_TEST(is_success(as_controls.solve(displacements)));
    BOOST_TEST_LT(difference(as_controls.displacements(), at_vertices(mesh, rigid_motion)), 1e-9);
    BOOST_TEST_LT(as_controls.energy(), 1e-14);
  }

  // Too few points leave rigid motions free.
  const Vec3 a = points[0], b = points[1], c = 0.5 * (a + b);
  const auto free_motions = [&](const std::vector<Vec3>& some) {
    BOOST_TEST(is_success(as_controls.set_control_points(some)));
    const Field before = as_controls.displacements();
    const auto result = as_controls.solve(Field(some.size(), Vec3{}));
    BOOST_TEST(result.status == Status::FREE_RIGID_MOTION);
    BOOST_TEST(as_controls.displacements() == before);
    const double turn = norm(result.motion.rotation);
    for(const Vec3& p : some)
      BOOST_TEST_LT(norm(result.motion.translation + cross(result.motion.rotation, p - result.motion.center)),
                    1e-6 * turn);
    return result;
  };
  BOOST_TEST_EQ(free_motions({}).number_of_free_motions, 6);
  BOOST_TEST_EQ(free_motions({a}).number_of_free_motions, 3);
  for(const std::vector<Vec3>& some : {std::vector<Vec3>{a, b}, {a, b, c}}) {
    const auto result = free_motions(some);
    BOOST_TEST_EQ(result.number_of_free_motions, 1);
    BOOST_TEST_LT(norm(cross(result.motion.rotation, b - a)),
                  1e-6 * norm(result.motion.rotation) * norm(b - a));
    BOOST_TEST(result.description().find("1 rigid motion") == std::string::npos
               || result.description().find("rotation about the axis through") != std::string::npos);
  }

  // The mean is over the boundary around a point, by area; around a point with few neighbors, it is that of
  // the point.
  for(double radius : {0.8, 1e-9}) {
    const std::vector<Vec3> middle{{0.5, 0.5, 1}};
    BOOST_TEST(is_success(problem.set_control_points(middle, 0.2, 0, radius)));
    BOOST_TEST(is_success(problem.solve(Field{{0, 0.01, -0.02}})));
    Vec3 mean{};
    double area = 0;
    for(const Face& face : boundary_faces(mesh)) {
      const Face_vertices& v = face.vertices();
      const int n = v.size();
      const auto at = [&](int i) { return to_vec3(mesh.point(v[i])); };
      const auto triangle = [&](int i, int j, int k) {
        return norm(cross(at(j) - at(i), at(k) - at(i))) / 2;
      };
      // The area of a warped quadrilateral is the mean of its two triangulations.
      const double area_of_face = n == 3 ? triangle(0, 1, 2)
                                         : (triangle(0, 1, 2) + triangle(2, 3, 0) + triangle(1, 2, 3)
                                            + triangle(3, 0, 1))
                                             / 2;
      for(int i = 0; i < n; ++i)
        if(norm(at(i) - middle[0]) <= radius) {
          const double share = area_of_face / n;
          mean = mean + share * problem.displacements()[v[i]];
          area += share;
        }
    }
    if(radius > 1e-3)
      BOOST_TEST_LT(norm((1 / area) * mean - Vec3{0, 0.01, -0.02}), 1e-12);
    else
      BOOST_TEST_LT(norm(interpolated(mesh, problem.displacements(), middle[0]) - Vec3{0, 0.01, -0.02}),
                    1e-9);
  }

  // A point outside is refused.
  auto result = problem.set_control_points(std::vector<Vec3>{a, {0.5, 0.5, 2}});
  BOOST_TEST(result.status == Status::CONTROL_POINT_OUTSIDE);
  BOOST_TEST_EQ(result.control_point, 1u);
  BOOST_TEST_GT(result.distance, 0.8);
  BOOST_TEST_LT(result.distance, 1.2);
  BOOST_TEST_EQ(problem.number_of_control_points(), 0u);
  BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{{0.5, 0.5, 2}}, 1.2)));
  BOOST_TEST(is_success(problem.solve(Field{{0, 0, 0.1}})));

  // The same point twice, and more points in an element than it has vertices, are tested.
  for(double compliance : {0., 1e-3}) {
    BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{a, b, a}, 0, compliance)));
    BOOST_TEST(is_success(problem.solve(Field{wanted[0], wanted[1], wanted[0]})));
    const Field twice = problem.displacements();
    result = problem.solve(Field{wanted[0], wanted[1], wanted[0] + Vec3{0, 0, 0.02}});
    BOOST_TEST(result.status == (compliance > 0 ? Status::SUCCESS : Status::CONTRADICTORY_CONTROL_POINTS));
    if(compliance == 0) {
      BOOST_TEST(result.control_point == 0 || result.control_point == 2);
      BOOST_TEST_LT(std::abs(result.distance - 0.02), 1e-9);
      BOOST_TEST(problem.displacements() == twice);
      BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{a, b})));
      BOOST_TEST(is_success(problem.solve(Field{wanted[0], wanted[1]})));
      BOOST_TEST_LT(difference(problem.displacements(), twice), 1e-9);
    }
  }
  const Element_index e = last;
  const Element_view element = mesh.element(e);
  std::vector<Vec3> many;
  for(int i = 0; i < 12; ++i) {
    Vec3 p{};
    double sum = 0;
    for(Vertex_index v : element) {
      const double w = 0.2 + (1 + random()) / 2;
      p = p + w * position(mesh, v);
      sum += w;
    }
    many.push_back((1 / sum) * p);
  }
  Field consistent, contradictory;
  for(const Vec3& p : many) {
    consistent.push_back(0.1 * linear_field(p));
    contradictory.push_back(0.1 * linear_field(p) + 0.01 * random.vector());
  }
  BOOST_TEST(is_success(problem.set_control_points(many)));
  BOOST_TEST(is_success(problem.solve(consistent)));
  for(std::size_t i = 0; i < many.size(); ++i)
    BOOST_TEST_LT(norm(interpolated(mesh, problem.displacements(), many[i]) - consistent[i]), 1e-7);
  BOOST_TEST(problem.solve(contradictory).status == Status::CONTRADICTORY_CONTROL_POINTS);
  BOOST_TEST(is_success(problem.set_control_points(many, 0, 1e-3)));
  BOOST_TEST(is_success(problem.solve(contradictory)));
}

// Compares a weight of two with the same point twice, and points left out with solutions without them.
void test_weights(int kind)
{
  const Mesh mesh = any_grid(3, kind, 0.1);
  Noise random;
  std::vector<Vec3> points;
  Field wanted;
  const std::size_t step = mesh.number_of_elements() / 8;
  for(std::size_t e = 0; e < mesh.number_of_elements() && points.size() < 8; e += step) {
    points.push_back(point_in(mesh, Element_index(std::uint32_t(e)), 0));
    wanted.push_back(0.05 * random.vector());
  }
  const std::vector<double> weights{1, 2, 0.5, 10, 3, 1, 1, 0.1};
  const std::vector<bool> is_fixed = vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.1; });
  for(bool is_supported : {true, false}) {
    Elasticity problem(mesh);
    if(is_supported)
      prescribe(problem, is_fixed, [](const Vec3&) { return Vec3{}; });
    BOOST_TEST(is_success(problem.factor()));
    if(is_supported)
      problem.set_body_force({0.01, 0, -0.03});
    std::vector<Vec3> twice = points;
    Field wanted_twice = wanted;
    twice.push_back(points[1]);
    wanted_twice.push_back(wanted[1]);
    std::vector<double> ones(twice.size(), 1);
    BOOST_TEST(is_success(problem.set_control_points(twice, 0, 0.01, 0, ones)));
    BOOST_TEST(is_success(problem.solve(wanted_twice)));
    const Field expected = problem.displacements();
    ones.assign(points.size(), 1);
    ones[1] = 2;
    BOOST_TEST(is_success(problem.set_control_points(points, 0, 0.01, 0, ones)));
    BOOST_TEST(is_success(problem.solve(wanted)));
    BOOST_TEST_LT(difference(problem.displacements(), expected), 1e-12);

    for(double compliance : {0., 0.01}) {
      BOOST_TEST(is_success(problem.set_control_points(points, 0, compliance, 0, weights)));
      BOOST_TEST(is_success(problem.solve(wanted)));
      const Field errors = problem.leave_one_out_errors(), residuals = problem.control_residuals();
      for(std::size_t i = 0; i < points.size(); ++i) {
        BOOST_TEST_LT(norm(residuals[i]
                           - (wanted[i] - interpolated(mesh, problem.displacements(), points[i]))),
                      1e-9);
        BOOST_TEST_LT(norm(residuals[i] - (compliance / weights[i]) * problem.control_forces()[i]), 1e-9);
      }
      for(std::size_t i = 0; i < points.size(); ++i) {
        std::vector<Vec3> others = points;
        Field wanted_of_others = wanted;
        std::vector<double> weights_of_others = weights;
        others.erase(others.begin() + std::ptrdiff_t(i));
        wanted_of_others.erase(wanted_of_others.begin() + std::ptrdiff_t(i));
        weights_of_others.erase(weights_of_others.begin() + std::ptrdiff_t(i));
        BOOST_TEST(is_success(problem.set_control_points(others, 0, compliance, 0, weights_of_others)));
        BOOST_TEST(is_success(problem.solve(wanted_of_others)));
        const Vec3 left_out = wanted[i] - interpolated(mesh, problem.displacements(), points[i]);
        BOOST_TEST_LT(norm(errors[i] - left_out), 1e-4 * largest(wanted));
        BOOST_TEST_GT(norm(left_out), norm(residuals[i]));
      }
    }

    // A repeated point predicts itself without one of the two; three points hold a body, two do not.
    std::vector<Vec3> some{points[0], points[3], points[6], points[3]};
    Field wanted_of_some{wanted[0], wanted[3], wanted[6], wanted[3]};
    BOOST_TEST(is_success(problem.set_control_points(some)));
    BOOST_TEST(is_success(problem.solve(wanted_of_some)));
    const Field errors = problem.leave_one_out_errors();
    for(std::size_t i : {1u, 3u})
      BOOST_TEST_LT(norm(errors[i]), 1e-4 * norm(wanted[3]));
    for(std::size_t i : {0u, 2u})
      BOOST_TEST_EQ(std::isinf(errors[i][0]), !is_supported);
  }
}

// Solver whose solutions fail when told to.
struct Failing_solver_traits : Simplicial_solver_traits
{
  bool fails = false;
  bool linear_solver(const Eigen::MatrixXd& b, Eigen::MatrixXd& x)
  {
    return !fails && Simplicial_solver_traits::linear_solver(b, x);
  }
};

// Control points that cannot be solved for do not exist afterwards.
void test_failing_solver()
{
  const Mesh mesh = any_grid(2, HEXAHEDRON);
  const std::vector<Vec3> points{{0.3, 0.4, 0.8}};
  CGAL::Linear_elasticity_3<Mesh, Failing_solver_traits> problem(mesh);
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] == 0; }),
            Field(mesh.number_of_vertices(), Vec3{}));
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.set_control_points(points)));
  BOOST_TEST_EQ(problem.number_of_control_points(), 1u);
  problem.solver().fails = true;
  BOOST_TEST(problem.set_control_points(points).status == Status::SOLVER_FAILED);
  BOOST_TEST_EQ(problem.number_of_control_points(), 0u);
  problem.set_gravity({0, 0, -9810});
  BOOST_TEST(problem.solve().status == Status::SOLVER_FAILED);
  problem.solver().fails = false;
  BOOST_TEST(is_success(problem.solve()));
  BOOST_TEST_GT(largest(problem.displacements()), 0);
  BOOST_TEST(is_success(problem.set_control_points(points)));
  BOOST_TEST(is_success(problem.solve(Field{{0, 0, 0.1}})));
}

int run(int, char*[])
{
  for(int kind = 0; kind <= number_of_element_kinds; ++kind)
    test_control_points(kind);
  for(int kind = 0; kind <= number_of_element_kinds; ++kind)
    test_weights(kind);
  test_failing_solver();
  return boost::report_errors();
}

} // namespace test_control_points
