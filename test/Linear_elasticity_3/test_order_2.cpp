// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quadratic displacements of Linear_elasticity_3: shape functions of edges, exact solutions, convergence,
// supports and control points, and zones of order 2.

#include "elasticity_test.h"

#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Recovered_displacement_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_bubbles.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_functions.h>
#include <CGAL/Mixed_mesh_3/internal/elements/with_kind.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Element_nodes.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

namespace test_order_2 {

using namespace elasticity_test;

constexpr int all_kinds = number_of_element_kinds;

// A grid whose elements have affine maps; tetrahedra, which always have, are irregular.
Mesh affine_grid(int n, int kind)
{
  const Mesh mesh = any_grid(n, kind, kind == TETRAHEDRON ? 0.15 : 0);
  std::vector<Test_point> points;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const Vec3 p = position(mesh, v);
    points.emplace_back(p[0] + 0.2 * p[1], 0.9 * p[1] - 0.1 * p[2], 0.3 * p[0] + 1.1 * p[2]);
  }
  Mesh result;
  result.assign(std::move(points), mesh.elements(), mesh.attributes());
  return result;
}

// The same mesh with a part of it as the region.
Mesh with_region(const Mesh& mesh, const std::vector<bool>& is_in_region)
{
  std::vector<Element_attributes> attributes = mesh.attributes();
  for(std::size_t e = 0; e < attributes.size(); ++e)
    attributes[e].is_in_region = is_in_region[e];
  Mesh result;
  result.assign(mesh.points(), mesh.elements(), std::move(attributes));
  return result;
}

Mesh single(Element_kind kind, double noise)
{
  Mesh mesh;
  std::vector<Vertex_index> vertices;
  for(int i = 0; i < reference_elements[kind].number_of_vertices; ++i) {
    const auto& c = reference_elements[kind].coordinates[i];
    vertices.push_back(mesh.add_vertex(
      Test_point(c[0] + noise * c[1] * c[2], c[1] - 2 * noise * c[0], c[2] + noise * c[0] * c[1])));
  }
  mesh.add_element(kind, vertices);
  return mesh;
}

Vec3 middle(const Mesh& mesh, const std::array<Vertex_index, 2>& ends)
{
  return 0.5 * (position(mesh, ends[0]) + position(mesh, ends[1]));
}

Field at_middles(const Elasticity& problem, const Function& f)
{
  Field u;
  for(const auto& ends : problem.quadratic_edges())
    u.push_back(f(middle(problem.mesh(), ends)));
  return u;
}

void prescribe_on_boundary(Elasticity& problem, const Function& f)
{
  problem.prescribe_boundary([&](const Vec3& p) { return std::optional<Vec3>(f(p)); });
}

// The displacement at a point of an element, in reference coordinates.
Vec3 displacement(const Elasticity& problem, const Element_nodes& nodes, Element_index e, const Vec3& r)
{
  const Nodes_of_element element = nodes[e];
  const int vertices = problem.mesh().element(e).size();
  return with_kind(problem.mesh().element(e).kind(), [&](auto kind) {
    const auto of_vertices = Mixed_element_traits_3<kind>::shape_functions(r[0], r[1], r[2]);
    const auto of_edges = edge_functions<kind>(r);
    Vec3 u{};
    for(int i = 0; i < element.size(); ++i)
      u = u
          + (i < vertices ? of_vertices[std::size_t(i)] * problem.displacements()[element[i]]
                          : of_edges[std::size_t(element.function(i) - vertices)].value
                              * problem.edge_coefficients()[element[i] - nodes.number_of_vertices()]);
    return u;
  });
}

// ---- shape functions ---------------------------------------------------------------------------

template <Element_kind Kind>
void test_edge_functions()
{
  const Reference_element& reference = reference_elements[Kind];
  const auto vertex = [&](int i) {
    const auto& c = reference.coordinates[i];
    return Vec3{double(c[0]), double(c[1]), double(c[2])};
  };
  for(int i = 0; i < reference.number_of_vertices; ++i)
    for(const Differentiated& f : edge_functions<Kind>(vertex(i)))
      BOOST_TEST_EQ(f.value, 0);
  for(int i = 0; i < reference.number_of_edges; ++i)
    for(int j = 0; j < reference.number_of_edges; ++j) {
      const Vec3 m = 0.5 * (vertex(reference.edges[j][0]) + vertex(reference.edges[j][1]));
      BOOST_TEST_LT(std::abs(edge_functions<Kind>(m)[std::size_t(i)].value - (i == j)), 1e-15);
    }
  const Vec3 p{0.2, 0.15, 0.3}; // in all kinds
  const auto functions = edge_functions<Kind>(p);
  for(int k = 0; k < 3; ++k) {
    Vec3 d{};
    d[k] = 1e-5;
    const auto before = edge_functions<Kind>(p - d), after = edge_functions<Kind>(p + d);
    for(std::size_t i = 0; i < functions.size(); ++i)
      BOOST_TEST_LT(std::abs((after[i].value - before[i].value) / 2e-5 - functions[i].gradient[k]), 1e-9);
  }
}

// A field of edge functions is one of bubbles.
template <Element_kind Kind>
void test_bubbles()
{
  std::array<Vec3, largest_number_of_edges> coefficients{};
  for(int i = 0; i < reference_elements[Kind].number_of_edges; ++i)
    coefficients[std::size_t(i)] = {0.1 * i + 1, 2 - 0.3 * i * i, 0.7 * i};
  const std::array<Vec3, 8> zeros{};
  const Quadratic_field<Kind> field(zeros.data(), bubbles_of_edges(Kind, coefficients));
  for(const Vec3& p : {Vec3{0.2, 0.15, 0.3}, Vec3{0.5, 0.1, 0.05}, Vec3{0.3, 0, 0.6}}) {
    Vec3 expected{};
    std::array<Vec3, 3> derivatives{};
    for(std::size_t i = 0; i < coefficients.size(); ++i) {
      const Differentiated f = edge_functions<Kind>(p)[i];
      expected = expected + f.value * coefficients[i];
      for(int k = 0; k < 3; ++k)
        derivatives[k] = derivatives[k] + f.gradient[k] * coefficients[i];
    }
    BOOST_TEST_LT(norm(field(p) - expected), 1e-13);
    for(int k = 0; k < 3; ++k)
      BOOST_TEST_LT(norm(field.derivatives(p)[k] - derivatives[k]), 1e-13);
  }
}

// ---- stiffness ---------------------------------------------------------------------------------

// The stiffness of vertices and edges, by the system of quadratic elements.
Eigen::MatrixXd stiffness(const Mesh& mesh, const Elastic_material& material)
{
  const Element_nodes nodes(mesh.elements(), mesh.number_of_vertices(),
                            std::vector<bool>(mesh.number_of_elements(), true));
  const Field points = at_vertices(mesh, [](const Vec3& p) { return p; });
  Elasticity_system system(nodes, std::vector<bool>(nodes.number_of_nodes(), true));
  system.clear();
  for(Element_index e : system.active_elements())
    system.add(e, material, points, points);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(system.number_of_unknowns(), system.number_of_unknowns());
  for(int column = 0; column < system.number_of_unknowns(); ++column)
    for(int i = system.starts()[std::size_t(column)]; i < system.starts()[std::size_t(column) + 1]; ++i)
      k(system.rows()[std::size_t(i)], column) = system.values()[std::size_t(i)];
  return k.selfadjointView<Eigen::Lower>();
}

void test_six_modes()
{
  std::cout << "smallest and largest elastic eigenvalue of an element of order 2\n";
  for(Element_kind kind : element_kinds)
    for(double nu : {0.3, 0.49})
      for(const Mesh& mesh : {single(kind, 0), single(kind, 0.1), any_grid(1, kind, 0.1)}) {
        const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                                              stiffness(mesh, Elastic_material{1, nu}),
                                              Eigen::EigenvaluesOnly)
                                              .eigenvalues();
        const double last = eigenvalues[eigenvalues.size() - 1];
        BOOST_TEST_LT(eigenvalues.head(6).cwiseAbs().maxCoeff(), 1e-13 * last);
        BOOST_TEST_GT(eigenvalues[6], 1e-5 * last); // positive: neither hinges nor hourglasses
        if(mesh.number_of_elements() == 1)
          std::cout << "  " << name_of(kind) << ", nu " << nu << ": " << eigenvalues[6] << " " << last
                    << '\n';
      }
}

// ---- exact solutions ---------------------------------------------------------------------------

void test_quadratic_field(const Mesh& mesh)
{
  const Exact_solution exact = quadratic_solution(false);
  for(double nu : {0., 0.3, 0.45, 0.49}) {
    const Elastic_material material{2, nu};
    Elasticity problem(mesh, material);
    problem.order(2);
    BOOST_TEST_EQ(problem.order(), 2);
    prescribe_on_boundary(problem, exact.displacement);
    BOOST_TEST(is_success(problem.factor()));
    problem.set_body_force(exact.force(material));
    BOOST_TEST(is_success(problem.solve()));
    const Field expected = at_vertices(mesh, exact.displacement);
    BOOST_TEST_LT(difference(problem.displacements(), expected), 1e-10 * largest(expected));
    BOOST_TEST_LT(difference(problem.middle_displacements(), at_middles(problem, exact.displacement)),
                  1e-10 * largest(expected));
  }
}

// The displacement between vertices is the quadratic one, at points of the mesh and of the displaced mesh.
void test_displacement_between_vertices(const Mesh& mesh)
{
  const Exact_solution exact = quadratic_solution(false);
  const Elastic_material material{2, 0.3};
  Elasticity problem(mesh, material);
  problem.order(2);
  constexpr double small = 0.05; // no element turns inside out
  const auto u = [&](const Vec3& p) { return small * exact.displacement(p); };
  prescribe_on_boundary(problem, u);
  BOOST_TEST(is_success(problem.factor()));
  problem.set_body_force(small * exact.force(material));
  BOOST_TEST(is_success(problem.solve()));
  const Recovered_displacement_3<Mesh> between(mesh, problem.displacements(), problem.quadratic_edges(),
                                               problem.edge_coefficients());
  BOOST_TEST_EQ(between.number_of_linear_elements(), 0u);
  const Element_locator_3<Mesh> before(mesh), after(between);
  for(const Vec3& p : {Vec3{0.5, 0.4, 0.6}, Vec3{0.31, 0.42, 0.53}, Vec3{0.6, 0.25, 0.7}}) {
    const auto location = before.locate(p);
    BOOST_TEST(location.has_value());
    BOOST_TEST_LT(norm(problem.displacement(*location) - u(p)), 1e-10);
    BOOST_TEST_LT(norm(between(*location) - u(p)), 1e-10);
    const auto moved = after.locate(p + u(p));
    BOOST_TEST(moved && norm(between(*moved) - u(p)) < 1e-8);
  }
}

// Linear fields, on any elements, with order 2 in a part of the mesh.
void test_zone(int kind)
{
  const Mesh grid = any_grid(4, kind, 0.15);
  const Mesh mesh = with_region(grid, elements_where(grid, [](const Vec3& p) { return p[0] + p[2] < 0.7; }));
  std::size_t before = 0;
  for(double distance : {0., 0.3, 10.}) {
    Elasticity problem(mesh, Elastic_material{2, 0.45});
    problem.order_2_within(distance);
    BOOST_TEST_GT(problem.quadratic_edges().size(), before);
    before = problem.quadratic_edges().size();
    prescribe_on_boundary(problem, linear_field);
    BOOST_TEST(is_success(problem.factor()));
    BOOST_TEST(is_success(problem.solve()));
    const Field expected = at_vertices(mesh, linear_field);
    BOOST_TEST_LT(difference(problem.displacements(), expected), 1e-10 * largest(expected));
    BOOST_TEST_LT(largest(problem.edge_coefficients()), 1e-10 * largest(expected));
  }
  Elasticity all(mesh);
  all.order(2);
  BOOST_TEST_EQ(all.quadratic_edges().size(), before);
}

// ---- convergence -------------------------------------------------------------------------------

// The root mean square of the error, relative to the displacement, at the points of the quadrature.
double error(const Elasticity& problem, const Function& exact)
{
  const Mesh& mesh = problem.mesh();
  const Element_nodes nodes(mesh.elements(), mesh.number_of_vertices(),
                            std::vector<bool>(mesh.number_of_elements(), problem.order() == 2));
  double errors = 0, squares = 0;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const Element_view element = mesh.element(e);
    const auto points = element_points(mesh, element);
    with_kind(element.kind(), [&](auto kind) {
      int q = 0;
      for_each_quadrature_point<kind>(2, [&](double r, double s, double t, double) {
        const auto w = Mixed_element_traits_3<kind>::shape_functions(r, s, t);
        Vec3 p{};
        for(int a = 0; a < element.size(); ++a)
          p = p + w[std::size_t(a)] * position(mesh, element[a]);
        const Vec3 y = exact(p), d = displacement(problem, nodes, e, {r, s, t}) - y;
        const double volume = strain_operator(quadrature_rule(kind, 2), points, q++).volume;
        errors += volume * dot(d, d);
        squares += volume * dot(y, y);
      });
    });
  }
  return std::sqrt(errors / squares);
}

void test_convergence()
{
  std::cout << "errors in % of order 2 with 2^3, 4^3 and 8^3 cells, order\n" << std::setprecision(3);
  const Exact_solution exact = harmonic_solution();
  for(double nu : {0.3, 0.45, 0.49})
    for(int kind = 0; kind <= all_kinds; ++kind) {
      std::vector<double> e;
      for(int n : {2, 4, 8}) {
        if(kind == all_kinds && n == 2)
          continue;
        const Mesh mesh = any_grid(n, kind, kind == TETRAHEDRON ? 0.1 : 0);
        Elasticity problem(mesh, Elastic_material{1, nu});
        problem.order(2);
        prescribe_on_boundary(problem, exact.displacement);
        BOOST_TEST(is_success(problem.factor()));
        BOOST_TEST(is_success(problem.solve()));
        e.push_back(error(problem, exact.displacement));
      }
      const double order = std::log2(e[e.size() - 2] / e.back());
      std::cout << "  nu " << nu << ", " << name_of(kind) << ":";
      for(double x : e)
        std::cout << "  " << 100 * x;
      std::cout << "  " << order << '\n';
      BOOST_TEST_GT(order, 2.7);
    }
}

// ---- supports, control points, removals --------------------------------------------------------

Vec3 zero(const Vec3&) { return {}; }

void test_supports()
{
  const Mesh mesh = any_grid(4, all_kinds, 0.1, Moved::INNER);
  // A patch that ends within faces: middles of edges with a free end are held, too.
  const auto in_patch = [](const Vec3& p) { return p[2] < 0.3 || p[0] + p[1] < 0.4; };
  Elasticity problem(mesh);
  problem.order(2);
  problem.prescribe_boundary([&](const Vec3& p) {
    return in_patch(p) ? std::optional<Vec3>(Vec3{0.1 * p[0] * p[0], 0, 0.2 * p[1] * p[2]}) : std::nullopt;
  });
  BOOST_TEST(is_success(problem.factor()));
  problem.set_body_force({0.2, -0.1, 0.3});
  BOOST_TEST(is_success(problem.solve()));
  const std::vector<bool> on_boundary = is_on_boundary(mesh);
  int held = 0, free = 0, at_free_end = 0;
  const Field middles = problem.middle_displacements();
  std::vector<std::array<Vertex_index, 2>> of_faces;
  for(const Face& face : boundary_faces(mesh))
    for(int i = 0; i < face.vertices().size(); ++i) {
      const auto [a,
                  b] = std::minmax({face.vertices()[i], face.vertices()[(i + 1) % face.vertices().size()]});
      of_faces.push_back({a, b});
    }
  for(std::size_t i = 0; i < middles.size(); ++i) {
    const auto& ends = problem.quadratic_edges()[i];
    const Vec3 m = middle(mesh, ends);
    const bool is_held = std::count(of_faces.begin(), of_faces.end(), ends) > 0 && in_patch(m);
    at_free_end += is_held && !(in_patch(position(mesh, ends[0])) && in_patch(position(mesh, ends[1])));
    const double missed = norm(middles[i] - Vec3{0.1 * m[0] * m[0], 0, 0.2 * m[1] * m[2]});
    if(is_held)
      BOOST_TEST_LT(missed, 1e-15);
    else
      BOOST_TEST_GT(missed, 1e-9);
    ++(is_held ? held : free);
  }
  BOOST_TEST_GT(held, 50);
  BOOST_TEST_GT(free, 50);
  BOOST_TEST_GT(at_free_end, 5);

  // Prescribed vertices hold the edges of their faces straight.
  Elasticity straight(mesh);
  straight.order(2);
  prescribe(straight, vertices_where(mesh, [](const Vec3& p) { return p[2] == 0; }), zero);
  BOOST_TEST(is_success(straight.factor()));
  straight.set_body_force({0.2, -0.1, 0.3});
  BOOST_TEST(is_success(straight.solve()));
  for(std::size_t i = 0; i < straight.quadratic_edges().size(); ++i) {
    const bool is_held = middle(mesh, straight.quadratic_edges()[i])[2] == 0;
    BOOST_TEST_EQ(straight.edge_coefficients()[i] == Vec3{}, is_held);
  }

  // A block that slides on three sides, and is pulled by a displacement of the fourth.
  const double nu = 0.4;
  const auto stretched = [&](const Vec3& p) { return 0.1 * Vec3{p[0], -nu * p[1], -nu * p[2]}; };
  Elasticity block(mesh, Elastic_material{1, nu});
  block.order(2);
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const Vec3 p = position(mesh, v);
    for(int k = 0; k < 3; ++k)
      if(p[k] == 0) {
        Vec3 normal{};
        normal[k] = -1;
        block.slide(v, normal);
      }
  }
  const Vec3 end{1, 0.5, 0.5}, corner{1, 1, 1};
  BOOST_TEST(is_success(block.factor()));
  std::vector<Vec3> pulled;
  for(const Vec3& p : {end, corner, Vec3{0.6, 0.7, 0.5}})
    pulled.push_back(p);
  BOOST_TEST(is_success(block.set_control_points(pulled)));
  std::vector<Vec3> wanted;
  for(const Vec3& p : pulled)
    wanted.push_back(stretched(p));
  BOOST_TEST(is_success(block.solve(wanted)));
  for(std::size_t i = 0; i < block.quadratic_edges().size(); ++i) {
    const Vec3 m = middle(mesh, block.quadratic_edges()[i]);
    for(int k = 0; k < 3; ++k)
      if(m[k] == 0)
        BOOST_TEST_LT(std::abs(block.middle_displacements()[i][k]), 1e-12);
  }
}

// Middles of edges that are prescribed though an end is free: control points have their displacements, and
// the energy is half the work of their forces, or of body forces.
void test_middles_at_free_ends(int kind)
{
  const Mesh mesh = any_grid(4, kind, kind == TETRAHEDRON ? 0.15 : 0);
  const auto fixed = [](const Vec3& p) { return p[2] < 0.4 ? std::optional<Vec3>(Vec3{}) : std::nullopt; };
  // A control point between vertices of edges whose middles are prescribed.
  Elasticity exact(mesh, Elastic_material{1, 0.25});
  exact.order(2);
  exact.prescribe_boundary([&](const Vec3& p) {
    return p[2] < 0.4 || p[2] > 0.9 || p[0] < 0.4 ? std::optional<Vec3>(linear_field(p)) : std::nullopt;
  });
  BOOST_TEST(is_success(exact.factor()));
  const Vec3 inside{0.9, 0.55, 0.42}; // in an element of such an edge
  BOOST_TEST(is_success(exact.set_control_points(std::vector<Vec3>{inside})));
  BOOST_TEST(is_success(exact.solve(std::vector<Vec3>{linear_field(inside) + Vec3{0, 0, 0.1}})));
  const Element_locator_3<Mesh> locator(mesh);
  BOOST_TEST_LT(norm(exact.displacement(locator.nearest(inside)) - linear_field(inside) - Vec3{0, 0, 0.1}),
                1e-12);

  // The energy is half the work of the point's force, as supports do not move.
  const auto solve = [&](Elasticity& problem, double pull) {
    problem.order(2);
    problem.prescribe_boundary(fixed);
    BOOST_TEST(is_success(problem.factor()));
    BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{inside})));
    BOOST_TEST(is_success(problem.solve(std::vector<Vec3>{{pull, 0, pull}})));
  };
  Elasticity pulled(mesh);
  solve(pulled, 0.1);
  const double work = 0.1 * (pulled.control_forces()[0][0] + pulled.control_forces()[0][2]) / 2;
  BOOST_TEST_GT(work, 0);
  BOOST_TEST_LT(std::abs(pulled.energy() / work - 1), 1e-9);
  double mean = 0;
  const auto weights = pulled.control_weights();
  for(const auto& [node, weight] : weights[0])
    mean += weight
            * (node < mesh.number_of_vertices()
                 ? pulled.displacements()[node]
                 : pulled.edge_coefficients()[node - mesh.number_of_vertices()])[0];
  BOOST_TEST_LT(std::abs(mean - 0.1), 1e-12);

  // Body forces: their work, by the exact integral of the displacement, is twice the energy.
  Elasticity heavy(mesh);
  heavy.order(2);
  heavy.prescribe_boundary(fixed);
  BOOST_TEST(is_success(heavy.factor()));
  heavy.set_body_force({0, 0, -1});
  BOOST_TEST(is_success(heavy.solve()));
  double integral = 0;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const auto element = mesh.element(e);
    const auto points = element_points(mesh, element);
    const Quadrature_rule& rule = quadrature_rule(element.kind(), 2);
    for(int q = 0; q < rule.number_of_points; ++q) {
      Vec3 u{};
      for(int a = 0; a < element.size(); ++a)
        u = u + rule.values[std::size_t(q)][std::size_t(a)] * heavy.displacements()[element[a]];
      for(int i = 0; i < element.reference().number_of_edges; ++i) {
        const auto& edge = element.reference().edges[i];
        const auto [a, b] = std::minmax({element[edge[0]], element[edge[1]]});
        const std::array<Vertex_index, 2> ends{a, b};
        const auto place = std::find(heavy.quadratic_edges().begin(), heavy.quadratic_edges().end(), ends);
        u = u
            + rule.values[std::size_t(q)][std::size_t(element.size() + i)]
                * heavy.edge_coefficients()[std::size_t(place - heavy.quadratic_edges().begin())];
      }
      integral -= strain_operator(rule, points, q).volume * u[2];
    }
  }
  BOOST_TEST_GT(integral, 0);
  BOOST_TEST_LT(std::abs(heavy.energy() / (integral / 2) - 1), 1e-9);

  // Middles hold rigid motions where no vertex is held.
  const auto rigid = [](const Vec3& p) { return Vec3{1, 2, 3} + cross(Vec3{0.1, -0.2, 0.3}, p); };
  Elasticity held(mesh);
  held.order(2);
  held.prescribe_boundary([&](const Vec3& p) {
    const double x = 4 * p[0], y = 4 * p[1];
    return p[2] == 0 && (x == std::floor(x)) != (y == std::floor(y)) ? std::optional<Vec3>(rigid(p))
                                                                     : std::nullopt;
  });
  if(kind == HEXAHEDRON) { // whose middles are not vertices
    BOOST_TEST(is_success(held.factor()));
    BOOST_TEST(is_success(held.solve()));
    BOOST_TEST_LT(difference(held.displacements(), at_vertices(mesh, rigid)), 1e-9);
  }
}

void test_control_points(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.1);
  Noise random;
  std::vector<Vec3> points;
  Field wanted;
  for(int i = 0; i < 8; ++i) {
    points.push_back(Vec3{0.5, 0.5, 0.5} + 0.35 * random.vector());
    wanted.push_back(0.05 * random.vector());
  }
  Elasticity problem(mesh);
  problem.order(2);
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.1; }), zero);
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.set_control_points(points)));
  BOOST_TEST(is_success(problem.solve(wanted)));
  const Element_nodes nodes(mesh.elements(), mesh.number_of_vertices(),
                            std::vector<bool>(mesh.number_of_elements(), true));
  const Element_locator_3<Mesh> locator(mesh);
  const auto weights = problem.control_weights();
  double work = 0;
  for(std::size_t i = 0; i < points.size(); ++i) {
    const Element_location_3 location = locator.nearest(points[i]);
    BOOST_TEST_LT(norm(displacement(problem, nodes, location.element, location.coordinates) - wanted[i]),
                  1e-11);
    work += dot(problem.control_forces()[i], wanted[i]) / 2;
    double sum = 0; // of the weights of vertices
    for(const auto& [node, w] : weights[i])
      sum += node < mesh.number_of_vertices() ? w : 0;
    BOOST_TEST_LT(std::abs(sum - 1), 1e-12);
  }
  BOOST_TEST_LT(std::abs(problem.energy() - work), 1e-9 * work);

  // Points alone hold the body.
  Elasticity free(mesh);
  free.order(2);
  BOOST_TEST(is_success(free.factor()));
  BOOST_TEST(is_success(free.set_control_points(points)));
  for(std::size_t i = 0; i < points.size(); ++i)
    wanted[i] = rigid_motion(points[i]);
  BOOST_TEST(is_success(free.solve(wanted)));
  BOOST_TEST_LT(difference(free.displacements(), at_vertices(mesh, rigid_motion)), 1e-9);
  BOOST_TEST_LT(largest(free.edge_coefficients()), 1e-9);
}

// Means over a part of the boundary: edges of triangles have as much weight as vertices, those of
// quadrilaterals 4/3, also at the rim of the part.
void test_means(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.1);
  Elasticity problem(mesh);
  problem.order(2);
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.1; }), zero);
  BOOST_TEST(is_success(problem.factor()));
  for(double radius : {0.4, 0.7, 3.}) {
    BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{{0.5, 0.5, 1}}, 1, 0, radius)));
    const auto weights = problem.control_weights();
    double of_vertices = 0, of_edges = 0;
    for(const auto& [node, w] : weights.front())
      (node < mesh.number_of_vertices() ? of_vertices : of_edges) += w;
    BOOST_TEST_LT(std::abs(of_vertices - 1), 1e-12);
    BOOST_TEST(of_edges > (kind == HEXAHEDRON ? 4. / 3 : 1) - 1e-12);
    BOOST_TEST(of_edges < (kind == TETRAHEDRON ? 1 : 4. / 3) + 1e-12);
  }
}

void test_removal()
{
  const Mesh mesh = any_grid(4, all_kinds, 0.1);
  const std::vector<bool> is_removed = elements_where(mesh, [](const Vec3& p) {
    return norm(p - Vec3{0.5, 0.5, 1}) < 0.4;
  });
  const auto load = [&](Elasticity& problem) {
    problem.order(2);
    prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.1; }), zero);
    BOOST_TEST(is_success(problem.factor()));
    problem.set_body_force({0.01, 0, -0.02});
  };
  Elasticity iterated(mesh), factored(mesh);
  load(iterated);
  load(factored);
  BOOST_TEST(is_success(iterated.solve()));
  iterated.set_iteration_tolerance(1e-10);
  BOOST_TEST(is_success(iterated.remove_elements(is_removed)));
  BOOST_TEST(iterated.is_iterative());
  BOOST_TEST(is_success(iterated.solve()));
  BOOST_TEST(iterated.is_iterative());
  BOOST_TEST(is_success(factored.remove_elements(is_removed)));
  BOOST_TEST(is_success(factored.factor()));
  BOOST_TEST(is_success(factored.solve()));
  std::cout << "  removal with order 2: " << iterated.number_of_iterations() << " iterations\n";
  const double scale = largest(factored.displacements());
  BOOST_TEST_LT(difference(iterated.displacements(), factored.displacements()), 1e-6 * scale);
  BOOST_TEST_LT(difference(iterated.edge_coefficients(), factored.edge_coefficients()), 1e-6 * scale);
}

void test_what_is_refused()
{
  const Mesh mesh = any_grid(2, HEXAHEDRON);
  Elasticity problem(mesh);
  problem.order(2);
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] == 0; }), zero);
  BOOST_TEST(is_success(problem.factor()));
  problem.set_corotational(true);
  BOOST_TEST(problem.solve().status == Status::ORDER_NOT_SUPPORTED);
  BOOST_TEST(problem.factor().status == Status::ORDER_NOT_SUPPORTED);
  problem.set_corotational(false);
  BOOST_TEST(is_success(problem.factor()));
  problem.touch(26, {0, 0, 1});
  BOOST_TEST(problem.solve().status == Status::ORDER_NOT_SUPPORTED);
  problem.order(1);
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.solve()));
}

// Order 1 after order 2 is order 1 from the start.
void test_order_1()
{
  const Mesh mesh = any_grid(4, all_kinds, 0.1);
  const auto solve = [&](Elasticity& problem) {
    prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.1; }), linear_field);
    BOOST_TEST(is_success(problem.factor()));
    problem.set_body_force({0.01, 0, -0.02});
    BOOST_TEST(is_success(problem.solve()));
  };
  Elasticity always(mesh), again(mesh);
  BOOST_TEST_EQ(always.order(), 1);
  solve(always);
  again.order(2);
  solve(again);
  BOOST_TEST(difference(always.displacements(), again.displacements()) > 0);
  again.order(1);
  solve(again);
  BOOST_TEST(always.displacements() == again.displacements());
  BOOST_TEST(again.edge_coefficients().empty());
  BOOST_TEST(always.energy() == again.energy());
}

int run(int, char*[])
{
  for(Element_kind kind : element_kinds)
    with_kind(kind, [](auto k) {
      test_edge_functions<k>();
      test_bubbles<k>();
    });
  test_six_modes();
  for(int kind = 0; kind <= all_kinds; ++kind) {
    test_quadratic_field(affine_grid(4, kind));
    test_displacement_between_vertices(affine_grid(4, kind));
    test_zone(kind);
    test_control_points(kind);
    test_means(kind);
    test_middles_at_free_ends(kind);
  }
  test_convergence();
  test_supports();
  test_removal();
  test_what_is_refused();
  test_order_1();
  return boost::report_errors();
}

} // namespace test_order_2
