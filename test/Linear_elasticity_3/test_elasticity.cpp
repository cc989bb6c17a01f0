// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear_elasticity_3 against exact solutions: linear fields, rigid motions, polynomials and harmonic fields
// with their order of convergence, bending that locks other elements; supports, loads, control points, removal
// of elements, solvers, and each way to end.
//
//   test_elasticity [DATA_DIRECTORY]

#include "standard_elasticity.h"
#include "test_meshes.h"
#include "test_surfaces.h"

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/resect.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <boost/core/lightweight_test.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#ifndef MIXED_MESH_3_DATA_DIR
#define MIXED_MESH_3_DATA_DIR "data"
#endif

namespace {

using namespace CGAL::Mixed_meshes_3;
using namespace CGAL::Mixed_meshes_3::internal;
using CGAL::Linear_elasticity_result_3;
using Status = CGAL::Linear_elasticity_status;

using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;
using Elasticity = CGAL::Linear_elasticity_3<Mesh>;
using Field = std::vector<Vec3>; // of the vertices
using Function = std::function<Vec3(const Vec3&)>;

// ---- helpers -----------------------------------------------------------------------------------

// Numbers in [-1,1], the same everywhere.
class Noise
{
  std::uint32_t m_state = 1;

public:
  double operator()()
  {
    m_state = m_state * 1664525u + 1013904223u;
    return double(m_state >> 8) / double(1 << 23) - 1;
  }
  Vec3 vector()
  {
    const double x = (*this)(), y = (*this)(), z = (*this)(); // in this order
    return {x, y, z};
  }
};

enum class Moved { ALL, INNER }; // which vertices of a grid are displaced

// From coordinates in cells to [0,1]^3, vertices moved by up to `noise` cells.
auto placed(int n, double noise, Moved moved)
{
  return [n, noise, moved, random = Noise()](double x, double y, double z) mutable {
    Vec3 d = noise * random.vector();
    const Vec3 p{x, y, z};
    for(int k = 0; k < 3 && moved == Moved::INNER; ++k)
      if(p[k] == 0 || p[k] == n)
        d[k] = 0;
    return Test_point((x + d[0]) / n, (y + d[1]) / n, (z + d[2]) / n);
  };
}

// n^3 cells, of elements of one kind. \param moved INNER: the sides of the cube stay plane
Mesh grid(int n, Element_kind kind, double noise = 0, Moved moved = Moved::ALL)
{
  auto place = placed(n, noise, moved);
  return grid_of_cells<Mesh>(n, kind, [&](double x, double y, double z) { return place(x, y, z); });
}

// n^3 cells, from below: hexahedra; cells divided from their centers; tetrahedra; prisms. \pre 4 divides n
Mesh mixed_grid(int n, double noise = 0, Moved moved = Moved::ALL)
{
  auto place = placed(n, noise, moved);
  Mesh mesh;
  for(int z = 0; z <= n; ++z)
    for(int y = 0; y <= n; ++y)
      for(int x = 0; x <= n; ++x)
        mesh.add_vertex(place(x, y, z));
  for(int z = 0; z < n; ++z)
    for(int y = 0; y < n; ++y)
      for(int x = 0; x < n; ++x) {
        std::array<Vertex_index, 8> v{};
        for(int i = 0; i < 8; ++i) {
          const auto& c = reference_elements[HEXAHEDRON].coordinates[i];
          v[i] = Vertex_index(x + (c[0] + 1) / 2 + (n + 1) * (y + (c[1] + 1) / 2 + (n + 1) * (z + (c[2] + 1) / 2)));
        }
        const int layer = 4 * z / n;
        if(layer == 0) {
          mesh.add_element(HEXAHEDRON, v);
        } else if(layer == 1) {
          const Vertex_index center = mesh.add_vertex(place(x + 0.5, y + 0.5, z + 0.5));
          for(int f = 0; f < 6; ++f) {
            const auto& w = reference_elements[HEXAHEDRON].faces[f].vertices;
            if(f == 5 && 4 * (z + 1) / n == 2) { // to the tetrahedra: along their diagonal
              mesh.add_element(TETRAHEDRON, {v[6], v[5], v[4], center});
              mesh.add_element(TETRAHEDRON, {v[7], v[6], v[4], center});
            } else {
              mesh.add_element(PYRAMID, {v[w[3]], v[w[2]], v[w[1]], v[w[0]], center});
            }
          }
        } else if(layer == 2) {
          static constexpr int path[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
          for(const auto& p : path)
            mesh.add_element(TETRAHEDRON, {v[0], v[p[0]], v[p[1]], v[6]});
        } else {
          mesh.add_element(PRISM, {v[0], v[1], v[2], v[4], v[5], v[6]});
          mesh.add_element(PRISM, {v[0], v[2], v[3], v[4], v[6], v[7]});
        }
      }
  return mesh;
}

// A grid of a kind, or the mixed one.
Mesh any_grid(int n, int kind, double noise = 0, Moved moved = Moved::ALL)
{
  Mesh mesh = kind == number_of_element_kinds ? mixed_grid(n, noise, moved)
                                              : grid(n, Element_kind(kind), noise, moved);
  BOOST_TEST(find_defects(mesh).positive());
  mesh.set_boundary_faces(boundary_faces(mesh));
  return mesh;
}

const char* name_of(int kind)
{
  return kind == number_of_element_kinds ? "all kinds" : reference_elements[kind].plural;
}

Vec3 position(const Mesh& mesh, Vertex_index v) { return to_vec3(mesh.point(v)); }

Field at_vertices(const Mesh& mesh, const Function& f)
{
  Field u;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    u.push_back(f(position(mesh, v)));
  return u;
}

std::vector<bool> is_on_boundary(const Mesh& mesh)
{
  std::vector<bool> result(mesh.number_of_vertices());
  for(const Boundary_polygon& p : boundary_polygons(mesh))
    for(int i = 0; i < p.size; ++i)
      result[p.vertices[i]] = true;
  return result;
}

std::vector<bool> vertices_where(const Mesh& mesh, const std::function<bool(const Vec3&)>& f)
{
  std::vector<bool> result;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    result.push_back(f(position(mesh, v)));
  return result;
}

double largest(const Field& u)
{
  double result = 0;
  for(const Vec3& x : u)
    result = (std::max)(result, norm(x));
  return result;
}

double difference(const Field& a, const Field& b)
{
  BOOST_TEST_EQ(a.size(), b.size());
  double result = 0;
  for(std::size_t v = 0; v < a.size(); ++v)
    result = (std::max)(result, norm(a[v] - b[v]));
  return result;
}

template <class Problem>
void prescribe(Problem& problem, const std::vector<bool>& is_prescribed, const Field& u)
{
  for(Vertex_index v = 0; v < u.size(); ++v)
    if(is_prescribed[v])
      problem.prescribe(v, u[v]);
}

void prescribe(Elasticity& problem, const std::vector<bool>& is_prescribed, const Function& f)
{
  prescribe(problem, is_prescribed, at_vertices(problem.mesh(), f));
}

// Says what went wrong.
bool is_success(const Linear_elasticity_result_3& result)
{
  if(!result.is_success())
    std::cout << result.description() << '\n';
  return result.is_success();
}

// The elastic energy of any displacement: every vertex is prescribed.
class Energy
{
  Elasticity m_problem;

public:
  Energy(const Mesh& mesh, const Elastic_material& material = Elastic_material())
    : m_problem(mesh, material)
  {
    prescribe(m_problem, std::vector<bool>(mesh.number_of_vertices(), true), [](const Vec3& p) { return p; });
    BOOST_TEST(is_success(m_problem.factor()));
  }

  double operator()(const Field& u)
  {
    for(Vertex_index v = 0; v < u.size(); ++v)
      m_problem.set_support_displacement(v, u[v]);
    BOOST_TEST(is_success(m_problem.solve()));
    BOOST_TEST(m_problem.displacements() == u);
    return m_problem.energy();
  }
};

Vec3 linear_field(const Vec3& p)
{
  return {0.1 + 0.3 * p[0] - 0.2 * p[1], -0.2 + 0.5 * p[2] + 0.1 * p[1], 0.4 * p[0] - 0.1 * p[2]};
}

Vec3 rigid_motion(const Vec3& p) { return Vec3{0.3, 0.1, -0.2} + cross(Vec3{0.2, -0.5, 0.7}, p); }

Mesh brain(const std::string& data, std::size_t budget)
{
  Test_surface surface, region;
  BOOST_TEST(CGAL::IO::read_polygon_mesh(data + "/brain.off", surface));
  BOOST_TEST(CGAL::IO::read_polygon_mesh(data + "/region.off", region));
  Mesh mesh;
  BOOST_TEST(CGAL::make_mixed_mesh_3(surface, region, budget, mesh).has_mesh());
  return mesh;
}

// ---- patch test --------------------------------------------------------------------------------

void test_linear_field(const Mesh& mesh)
{
  const Field expected = at_vertices(mesh, linear_field);
  for(double nu : {0., 0.3, 0.45, 0.49}) {
    Elasticity problem(mesh, Elastic_material{2, nu});
    prescribe(problem, is_on_boundary(mesh), expected);
    BOOST_TEST(is_success(problem.factor()));
    BOOST_TEST(is_success(problem.solve()));
    BOOST_TEST_LT(difference(problem.displacements(), expected), 1e-10 * largest(expected));
  }
}

void test_patch(const std::string& data)
{
  for(Element_kind kind : element_kinds)
    test_linear_field(any_grid(3, kind, 0.15));
  test_linear_field(any_grid(4, number_of_element_kinds, 0.15));
  test_linear_field(brain(data, 660));
}

// ---- rigid motions -----------------------------------------------------------------------------

// By polarization of the energy.
Eigen::MatrixXd stiffness(const Mesh& mesh, const Elastic_material& material)
{
  Energy energy(mesh, material);
  const Eigen::Index n = 3 * Eigen::Index(mesh.number_of_vertices());
  Field u(mesh.number_of_vertices(), Vec3{});
  Eigen::MatrixXd k(n, n);
  for(Eigen::Index i = 0; i < n; ++i) {
    u[std::size_t(i / 3)][std::size_t(i % 3)] += 1;
    k(i, i) = 2 * energy(u);
    for(Eigen::Index j = 0; j < i; ++j) {
      u[std::size_t(j / 3)][std::size_t(j % 3)] += 1;
      k(i, j) = k(j, i) = energy(u) - (k(i, i) + k(j, j)) / 2;
      u[std::size_t(j / 3)][std::size_t(j % 3)] -= 1;
    }
    u[std::size_t(i / 3)][std::size_t(i % 3)] -= 1;
  }
  return k;
}

void test_six_modes(const Mesh& mesh)
{
  for(double nu : {0.3, 0.49}) {
    const Elastic_material material{1, nu};
    const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness(mesh, material), Eigen::EigenvaluesOnly)
        .eigenvalues();
    const double last = eigenvalues[eigenvalues.size() - 1];
    BOOST_TEST_LT(eigenvalues.head(6).cwiseAbs().maxCoeff(), 1e-12 * last);
    BOOST_TEST_GT(eigenvalues[6], 1e-4 * last); // no hourglass
  }
  Energy energy(mesh);
  const double some = energy(at_vertices(mesh, linear_field));
  for(int k = 0; k < 3; ++k) {
    Vec3 axis{};
    axis[k] = 1;
    BOOST_TEST_LT(energy(at_vertices(mesh, [&](const Vec3&) { return axis; })), 1e-14 * some);
    BOOST_TEST_LT(energy(at_vertices(mesh, [&](const Vec3& p) { return cross(axis, p); })), 1e-14 * some);
  }
}

void test_rigid_motions()
{
  for(Element_kind kind : element_kinds) {
    Mesh one;
    for(int i = 0; i < reference_elements[kind].number_of_vertices; ++i) {
      const auto& c = reference_elements[kind].coordinates[i];
      one.add_vertex(Test_point(c[0] + 0.1 * c[1] * c[2], c[1] - 0.2 * c[0], c[2] + 0.1 * c[0] * c[1]));
    }
    std::vector<Vertex_index> vertices;
    for(Vertex_index v = 0; v < one.number_of_vertices(); ++v)
      vertices.push_back(v);
    one.add_element(kind, vertices);
    test_six_modes(one);
    test_six_modes(any_grid(kind == PYRAMID ? 1 : 2, kind, 0.15));
  }
}

// ---- convergence -------------------------------------------------------------------------------

struct Exact_solution
{
  const char* name;
  Function displacement;
  std::function<Vec3(const Elastic_material&)> force; // by volume, constant
};

// u_i = 1/2 p^T q_i p: the divergence of the stress is constant.
// \param is_incompressible a field without change of volume; else the force grows with the bulk modulus
Exact_solution quadratic_solution(bool is_incompressible)
{
  using Forms = std::array<std::array<Vec3, 3>, 3>;
  Forms q = {{{{{0.8, 0.3, -0.4}, {0.3, -0.6, 0.5}, {-0.4, 0.5, 0.7}}},
              {{{-0.5, 0.6, 0.2}, {0.6, 0.9, -0.3}, {0.2, -0.3, 0.4}}},
              {{{0.3, -0.7, 0.5}, {-0.7, 0.2, 0.6}, {0.5, 0.6, -0.8}}}}};
  for(int i = 0; i < 3 && is_incompressible; ++i) { // in the entries q_kki where k and i differ
    const int k = (i + 1) % 3;
    const double divergence = q[0][0][i] + q[1][1][i] + q[2][2][i];
    q[k][k][i] -= divergence;
    q[k][i][k] -= divergence;
  }
  return {is_incompressible ? "quadratic, incompressible" : "quadratic",
          [q](const Vec3& p) {
            Vec3 u{};
            for(int i = 0; i < 3; ++i)
              for(int j = 0; j < 3; ++j)
                u[i] += p[j] * dot(q[i][j], p) / 2;
            return u;
          },
          [q](const Elastic_material& m) {
            Vec3 f{};
            for(int i = 0; i < 3; ++i)
              for(int k = 0; k < 3; ++k)
                f[i] -= (m.lambda() + m.mu()) * q[k][k][i] + m.mu() * q[i][k][k];
            return f;
          }};
}

// The gradient of a harmonic function: in equilibrium and without change of volume for any material.
Exact_solution harmonic_solution()
{
  return {"harmonic",
          [](const Vec3& p) {
            const double e = std::exp(1.5 * p[0]) / 3;
            const double s = std::sin(0.9 * p[1]), cs = std::cos(0.9 * p[1]);
            const double t = std::sin(1.2 * p[2]), ct = std::cos(1.2 * p[2]);
            return Vec3{1.5 * e * s * t, 0.9 * e * cs * t, 1.2 * e * s * ct};
          },
          [](const Elastic_material&) { return Vec3{}; }};
}

// A bar bent by moments at its ends, its sides free of stress.
Exact_solution bending_solution(double nu)
{
  return {"bending",
          [nu](const Vec3& q) {
            const Vec3 p = q - Vec3{0.5, 0.5, 0.5};
            return Vec3{p[0] * p[1], -(p[0] * p[0] + nu * (p[1] * p[1] - p[2] * p[2])) / 2, -nu * p[1] * p[2]};
          },
          [](const Elastic_material&) { return Vec3{}; }};
}

struct Errors
{
  double inside, at_vertices; // root mean square, relative to that of the displacement
};

Errors errors(const Mesh& mesh, const Field& u, const Function& exact)
{
  double inside = 0, volume = 0, vertices = 0, square = 0;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const Element_view element = mesh.element(e);
    const auto points = element_points(mesh, element);
    const Quadrature_rule& rule = quadrature_rule(element.kind());
    for(int q = 0; q < rule.number_of_points; ++q) {
      Vec3 p{}, x{};
      for(int a = 0; a < element.size(); ++a) {
        p = p + rule.values[q][a] * position(mesh, element[a]);
        x = x + rule.values[q][a] * u[element[a]];
      }
      const double w = strain_operator(element.kind(), points, q).volume;
      const Vec3 y = exact(p);
      volume += w;
      inside += w * dot(x - y, x - y);
      square += w * dot(y, y);
    }
  }
  for(Vertex_index v = 0; v < u.size(); ++v) {
    const Vec3 d = u[v] - exact(position(mesh, v));
    vertices += dot(d, d);
  }
  return {std::sqrt(inside / square), std::sqrt(vertices / double(u.size()) * volume / square)};
}

Field solved(const Mesh& mesh, const Elastic_material& material, const Exact_solution& exact,
             const std::vector<bool>& is_prescribed)
{
  Elasticity problem(mesh, material);
  prescribe(problem, is_prescribed, exact.displacement);
  BOOST_TEST(is_success(problem.factor()));
  problem.set_body_force(exact.force(material));
  BOOST_TEST(is_success(problem.solve()));
  return problem.displacements();
}

// The standard elements, that lock. Without force.
Field solved_pointwise(const Mesh& mesh, const Elastic_material& material, const Exact_solution& exact,
                       const std::vector<bool>& is_prescribed)
{
  return standard_solution(mesh, material, is_prescribed, at_vertices(mesh, exact.displacement));
}

void test_convergence()
{
  std::cout << "errors in % inside and at vertices with 4^3, 8^3 and 12^3 cells, order\n" << std::setprecision(3);
  constexpr int sizes[3] = {4, 8, 12};
  const std::pair<Exact_solution, double> cases[] = {{quadratic_solution(false), 0.3},
                                                     {quadratic_solution(true), 0.45},
                                                     {quadratic_solution(true), 0.49},
                                                     {harmonic_solution(), 0.45},
                                                     {harmonic_solution(), 0.49}};
  for(const auto& [exact, nu] : cases)
    for(int kind = 0; kind <= number_of_element_kinds; ++kind) {
      Errors e[3];
      for(int i = 0; i < 3; ++i) {
        const Mesh mesh = any_grid(sizes[i], kind, 0.1);
        e[i] = errors(mesh, solved(mesh, Elastic_material{1, nu}, exact, is_on_boundary(mesh)), exact.displacement);
      }
      std::cout << "  " << exact.name << ", nu " << nu << ", " << name_of(kind) << ":";
      for(const Errors& x : e)
        std::cout << "  " << 100 * x.inside << " " << 100 * x.at_vertices;
      const auto order = [&](int i, double Errors::*x) {
        return std::log(e[i - 1].*x / e[i].*x) / std::log(double(sizes[i]) / sizes[i - 1]);
      };
      std::cout << "  " << order(1, &Errors::inside) << " " << order(1, &Errors::at_vertices) << "  "
                << order(2, &Errors::inside) << " " << order(2, &Errors::at_vertices) << '\n';
      // Vertices of coarse meshes are nearer than the order says: almost all of them are given.
      BOOST_TEST_GE(order(1, &Errors::inside), nu == 0.3 ? 1.5 : 1.8);
      BOOST_TEST_GE(order(2, &Errors::inside), 1.8);
      BOOST_TEST_GE(order(2, &Errors::at_vertices), 1.7);
    }
}

void test_locking()
{
  std::cout << "errors in % in a bent bar of 8^3 cells, with standard elements in brackets\n";
  for(int kind = 0; kind <= number_of_element_kinds; ++kind) {
    const Mesh mesh = any_grid(8, kind, 0.1, Moved::INNER);
    const std::vector<bool> ends = vertices_where(mesh, [](const Vec3& p) { return p[0] == 0 || p[0] == 1; });
    std::cout << "  " << name_of(kind) << ":";
    double reference = 0, standard_reference = 0;
    for(double nu : {0.3, 0.45, 0.49, 0.499}) {
      const Elastic_material material{1, nu};
      const Exact_solution exact = bending_solution(nu);
      const double ours = errors(mesh, solved(mesh, material, exact, ends), exact.displacement).inside;
      const double standard = errors(mesh, solved_pointwise(mesh, material, exact, ends), exact.displacement).inside;
      std::cout << "  nu " << nu << " " << 100 * ours << " (" << 100 * standard << ")";
      if(nu == 0.3) {
        reference = ours;
        standard_reference = standard;
      } else {
        BOOST_TEST_LT(ours, 3 * reference);
      }
      if(nu == 0.499) {
        BOOST_TEST_GT(standard, 3 * ours);
        BOOST_TEST_GT(standard, 3 * standard_reference);
      }
    }
    std::cout << '\n';
  }
}

// ---- supports and loads ------------------------------------------------------------------------

// The cube's sides x = 0, y = 0 and z = 0 slide; so do the opposite ones that are asked for.
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

  // Between plates without friction: uniaxial stress.
  const auto compressed = [&](const Vec3& p) { return Vec3{0.1 * nu * p[0], 0.1 * nu * p[1], -0.1 * p[2]}; };
  Elasticity problem(mesh, Elastic_material{3, nu});
  slide_on_sides(problem, false, false);
  prescribe(problem, vertices_where(mesh, is_on_top), compressed);
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.solve()));
  BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, compressed)), 1e-10);
  BOOST_TEST_LT(std::abs(problem.energy() - 3 * 0.1 * 0.1 / 2), 1e-10);

  // Sheared planes: vertices slide on planes that are not parallel to the axes.
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

  // Other displacements of the supports, without another factorization.
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

  // Two layers in series, confined at the sides: the stress is the same in both.
  std::vector<Elastic_material> layers;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    double z = 0;
    for(Vertex_index v : mesh.element(e))
      z += position(mesh, v)[2] / mesh.element(e).size();
    layers.push_back(z < 0.5 ? Elastic_material{1, 0.3, 2e-6} : Elastic_material{4, 0.45, 5e-6});
  }
  const auto modulus = [](const Elastic_material& m) { return m.lambda() + 2 * m.mu(); };
  const double below = modulus({1, 0.3}), above = modulus({4, 0.45}), stress = 0.1 / (0.5 / below + 0.5 / above);
  const auto in_series = [&](const Vec3& p) {
    return Vec3{0, 0, -stress * ((std::min)(p[2], 0.5) / below + (std::max)(p[2] - 0.5, 0.) / above)};
  };
  // the vertices between the layers have to be in a plane
  Mesh layered = mesh;
  {
    const Mesh regular = any_grid(4, kind);
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(position(regular, v)[2] == 0.5)
        layered.points()[v] = regular.point(v);
  }
  BOOST_TEST(find_defects(layered).positive());
  Elasticity bar(layered, layers);
  slide_on_sides(bar, true, true);
  prescribe(bar, vertices_where(layered, is_on_top), in_series);
  BOOST_TEST(is_success(bar.factor()));
  BOOST_TEST(is_success(bar.solve()));
  BOOST_TEST_LT(difference(bar.displacements(), at_vertices(layered, in_series)), 1e-10);

  // Under its weight: a parabola; at vertices of regular hexahedra and prisms it is exact.
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
    std::cout << "  column of " << n << "^3 cells, " << name_of(kind) << ": largest error " << 100 * error << " %\n";
    if(is_exact)
      BOOST_TEST_LT(error, 1e-10);
    else if(n == 4)
      last = error;
    else
      BOOST_TEST_LT(error, 0.5 * last);
    // The same as a force by volume; and both together are twice that.
    const Field by_gravity = heavy.displacements();
    heavy.set_body_force({0, 0, -2e-5 * g});
    BOOST_TEST(is_success(heavy.solve()));
    for(Vertex_index v = 0; v < by_gravity.size(); ++v)
      BOOST_TEST_LT(norm(heavy.displacements()[v] - 2 * by_gravity[v]), 1e-12);
    heavy.set_gravity({});
    BOOST_TEST(is_success(heavy.solve()));
    BOOST_TEST_LT(difference(heavy.displacements(), by_gravity), 1e-12);
  }

  // Control points bear the weight, each layer's its own, and its moment.
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
  BOOST_TEST(result.description().find("3 rigid motions free, among them rotation about the axis") != std::string::npos);
  const auto motion = [&](const Vec3& p) {
    return result.motion.translation + cross(result.motion.rotation, p - result.motion.center);
  };
  BOOST_TEST_LT(norm(motion(center)), 1e-6 * norm(result.motion.rotation));
  // A point on the boundary leaves one rotation; two hold all three. Both turn as the points do.
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

  // A plane leaves two translations and a rotation; a fixed vertex three rotations; an edge of fixed vertices one.
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
  }), 3);
  BOOST_TEST_EQ(free_motions([&](Elasticity& held) { slide_on_sides(held, false, false); }), 0);
  BOOST_TEST_EQ(free_motions([](Elasticity& held) { held.slide_along_boundary([](Vertex_index) { return true; }); }),
                0);

  // Along the boundary: the volume stays, to first order, in whatever direction vertices move.
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

// ---- control points ----------------------------------------------------------------------------

// A point in an element, by its vertices' weights.
Vec3 point_in(const Mesh& mesh, Element_index e, int q)
{
  const Element_view element = mesh.element(e);
  Vec3 p{};
  for(int a = 0; a < element.size(); ++a)
    p = p + quadrature_rule(element.kind()).values[std::size_t(q)][std::size_t(a)] * position(mesh, element[a]);
  return p;
}

Vec3 interpolated(const Mesh& mesh, const Field& u, const Vec3& p)
{
  const Element_location_3 location = Element_locator_3<Mesh>(mesh).nearest(p);
  const Element_view element = mesh.element(location.element);
  Vec3 result{};
  for(int a = 0; a < element.size(); ++a)
    result = result + location.weights[std::size_t(a)] * u[element[a]];
  return result;
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

  // In elements, on faces inside and on the boundary, at vertices.
  std::vector<Vec3> points;
  const Element_index last = Element_index(mesh.number_of_elements() - 1);
  for(Element_index e : {last / 5, 2 * last / 5, 3 * last / 5, 4 * last / 5, last})
    points.push_back(point_in(mesh, e, 0));
  for(Element_index e : {last / 3, 2 * last / 3}) {
    const auto face = face_vertices(mesh.element(e), 0);
    const int n = face[3] == no_vertex ? 3 : 4;
    Vec3 p{};
    for(int i = 0; i < n; ++i)
      p = p + (1. / n) * position(mesh, face[std::size_t(i)]);
    points.push_back(p);
  }
  const Boundary_polygon polygon = boundary_polygons(mesh).back();
  Vec3 on_boundary{};
  for(int i = 0; i < polygon.size; ++i)
    on_boundary = on_boundary + (1. / polygon.size) * position(mesh, polygon.vertices[i]);
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

  // Minimal energy: no work against whatever keeps supports and control points; and the forces do the work of
  // whatever moves the points.
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

  // Vertices: as if these were prescribed.
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

  // Held by control points alone: a rigid motion; the same with the springs of any compliance.
  for(double compliance : {0., 1e-2, 10.}) {
    displacements.clear();
    for(const Vec3& p : points)
      displacements.push_back(rigid_motion(p));
    BOOST_TEST(is_success(as_controls.set_control_points(points, 0, compliance)));
    BOOST_TEST(is_success(as_controls.solve(displacements)));
    BOOST_TEST_LT(difference(as_controls.displacements(), at_vertices(mesh, rigid_motion)), 1e-9);
    BOOST_TEST_LT(as_controls.energy(), 1e-14);
  }

  // Too few of them.
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
    BOOST_TEST_LT(norm(cross(result.motion.rotation, b - a)), 1e-6 * norm(result.motion.rotation) * norm(b - a));
    BOOST_TEST(result.description().find("1 rigid motion") == std::string::npos
               || result.description().find("rotation about the axis through") != std::string::npos);
  }

  // The mean over the boundary around a point, by area; around a point with few neighbors, that of the point.
  for(double radius : {0.8, 1e-9}) {
    const std::vector<Vec3> middle{{0.5, 0.5, 1}};
    BOOST_TEST(is_success(problem.set_control_points(middle, 0.2, 0, radius)));
    BOOST_TEST(is_success(problem.solve(Field{{0, 0.01, -0.02}})));
    Vec3 mean{};
    double area = 0;
    for(const auto& face : boundary_faces(mesh)) {
      const auto v = face_vertices(mesh.element(face.element), face.local_face);
      const int n = v[3] == no_vertex ? 3 : 4;
      const auto at = [&](int i) { return to_vec3(mesh.point(v[i])); };
      const auto triangle = [&](int i, int j) { return norm(cross(at(i) - at(0), at(j) - at(0))) / 2; };
      for(int i = 0; i < n; ++i)
        if(norm(at(i) - middle[0]) <= radius) {
          const double share = (triangle(1, 2) + (n == 4 ? triangle(2, 3) : 0)) / n;
          mean = mean + share * problem.displacements()[v[i]];
          area += share;
        }
    }
    if(radius > 1e-3)
      BOOST_TEST_LT(norm((1 / area) * mean - Vec3{0, 0.01, -0.02}), 1e-12);
    else
      BOOST_TEST_LT(norm(interpolated(mesh, problem.displacements(), middle[0]) - Vec3{0, 0.01, -0.02}), 1e-9);
  }

  // Outside.
  auto result = problem.set_control_points(std::vector<Vec3>{a, {0.5, 0.5, 2}});
  BOOST_TEST(result.status == Status::CONTROL_POINT_OUTSIDE);
  BOOST_TEST_EQ(result.control_point, 1u);
  BOOST_TEST_GT(result.distance, 0.8);
  BOOST_TEST_LT(result.distance, 1.2);
  BOOST_TEST_EQ(problem.number_of_control_points(), 0u);
  BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{{0.5, 0.5, 2}}, 1.2)));
  BOOST_TEST(is_success(problem.solve(Field{{0, 0, 0.1}})));

  // Twice the same point; more points in an element than it has vertices.
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

// ---- removal -----------------------------------------------------------------------------------

std::vector<bool> elements_where(const Mesh& mesh, const std::function<bool(const Vec3&)>& f)
{
  std::vector<bool> result;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    Vec3 center{};
    for(Vertex_index v : mesh.element(e))
      center = center + (1. / mesh.element(e).size()) * position(mesh, v);
    result.push_back(f(center));
  }
  return result;
}

void test_removal(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.1);
  const std::vector<Vec3> points{{0.2, 0.3, 0.3}, {0.8, 0.2, 0.4}, {0.3, 0.3, 0.12}};
  const Field wanted{{0.1, 0, 0}, {0, 0.05, 0.05}, {0, 0, -0.1}};
  const auto prepared = [&](Elasticity& problem) {
    const Mesh& m = problem.mesh();
    prescribe(problem, vertices_where(m, [](const Vec3& p) { return p[0] < 0.08; }), linear_field);
    for(Vertex_index v = 0; v < m.number_of_vertices(); ++v)
      if(position(m, v)[1] < 0.08)
        problem.slide(v, {0.1, 1, 0.2});
    BOOST_TEST(is_success(problem.factor()));
    problem.set_gravity({0, 1e4, -1e5});
    BOOST_TEST(is_success(problem.set_control_points(points)));
  };
  const std::vector<bool> first = elements_where(mesh, [](const Vec3& p) { return p[2] > 0.75 && p[0] > 0.3; });
  const std::vector<bool> second = elements_where(mesh, [](const Vec3& p) { return p[2] > 0.55 && p[1] > 0.5; });
  std::vector<bool> both = first;
  for(Element_index e = 0; e < both.size(); ++e)
    both[e] = first[e] || second[e];
  const auto removed = [&](std::initializer_list<std::vector<bool>> steps, double tolerance = 1e-8) {
    Elasticity problem(mesh);
    prepared(problem);
    problem.set_iteration_tolerance(tolerance);
    BOOST_TEST(is_success(problem.solve(wanted)));
    for(const std::vector<bool>& step : steps) {
      BOOST_TEST(is_success(problem.remove_elements(step)));
      BOOST_TEST_EQ(problem.number_of_control_points(), points.size());
      BOOST_TEST(is_success(problem.solve(wanted)));
      if(tolerance > 1e-6)
        BOOST_TEST(problem.is_iterative() && problem.number_of_iterations() > 0);
      for(std::size_t i = 0; i < points.size(); ++i)
        BOOST_TEST_LT(norm(interpolated(mesh, problem.displacements(), points[i]) - wanted[i]), 1e-9);
    }
    BOOST_TEST(problem.removed_elements() == both);
    return problem.displacements();
  };
  const Field u = removed({both});
  BOOST_TEST_LT(difference(removed({first, second}), u), 1e-6 * largest(u));
  BOOST_TEST_LT(difference(removed({second, first}), u), 1e-6 * largest(u));
  BOOST_TEST_LT(difference(removed({first, second, both, first}), u), 1e-6 * largest(u));

  BOOST_TEST_LT(difference(removed({first, second}, 1e-3), u), 1e-2 * largest(u)); // the default

  // Another problem with what is left. Patches keep their tetrahedra and prisms, while those of another problem
  // are cut anew.
  std::vector<Vertex_index> vertices;
  const Mesh rest = remaining_mesh(mesh, both, &vertices);
  Elasticity fresh(rest);
  prepared(fresh);
  BOOST_TEST(is_success(fresh.solve(wanted)));
  Field expected(mesh.number_of_vertices(), Vec3{});
  for(Vertex_index v = 0; v < vertices.size(); ++v)
    expected[vertices[v]] = fresh.displacements()[v];
  const double error = difference(u, expected) / largest(expected);
  std::cout << "  removal, " << name_of(kind) << ": relative difference " << error << '\n';
  BOOST_TEST_LT(error, kind == HEXAHEDRON || kind == PYRAMID ? 1e-6 : 0.2);

  // Factored again with what is left, everything is as in another problem.
  Elasticity again(mesh);
  prepared(again);
  again.set_iteration_tolerance(1e-8);
  BOOST_TEST(is_success(again.remove_elements(both)));
  prepared(again);
  BOOST_TEST(!again.is_iterative());
  BOOST_TEST(is_success(again.solve(wanted)));
  BOOST_TEST_LT(difference(again.displacements(), expected), 1e-9 * largest(expected));

  // Nothing changes if nothing is removed; a control point in what is removed is outside.
  BOOST_TEST(is_success(again.remove_elements(std::vector<bool>(mesh.number_of_elements(), false))));
  BOOST_TEST(is_success(again.solve(wanted)));
  BOOST_TEST_LT(difference(again.displacements(), expected), 1e-9 * largest(expected));
  const auto outside = again.remove_elements(elements_where(mesh, [](const Vec3& p) { return p[2] < 0.25; }));
  BOOST_TEST(outside.status == Status::CONTROL_POINT_OUTSIDE);
  BOOST_TEST_EQ(outside.control_point, 2u);
  BOOST_TEST(again.is_factored());

  const auto nothing_left = again.remove_elements(std::vector<bool>(mesh.number_of_elements(), true));
  BOOST_TEST(nothing_left.status == Status::NO_ELEMENTS);
  BOOST_TEST(!again.is_factored());
  BOOST_TEST(again.factor().status == Status::NO_ELEMENTS);
}

void test_pieces()
{
  const Mesh nothing;
  BOOST_TEST(Elasticity(nothing).factor().status == Status::NO_ELEMENTS);

  // Two pieces, of which one is not held: named, and held by control points.
  const Mesh mesh = any_grid(4, HEXAHEDRON, 0.1);
  Elasticity problem(mesh);
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.1; }), rigid_motion);
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.solve()));
  BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, rigid_motion)), 1e-9);
  BOOST_TEST(is_success(
    problem.remove_elements(elements_where(mesh, [](const Vec3& p) { return p[2] > 0.5 && p[2] < 0.75; }))));
  const auto result = problem.solve();
  BOOST_TEST(result.status == Status::FREE_RIGID_MOTION);
  BOOST_TEST_EQ(result.number_of_free_motions, 6);
  const std::vector<Vec3> points{{0.2, 0.3, 0.9}, {0.8, 0.2, 0.85}, {0.3, 0.7, 0.9}};
  BOOST_TEST(is_success(problem.set_control_points(points)));
  Field wanted;
  for(const Vec3& p : points)
    wanted.push_back(rigid_motion(p));
  BOOST_TEST(is_success(problem.solve(wanted)));
  BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, rigid_motion)), 1e-9);

  // A hinge: two cubes with a common edge, or a common vertex. The stiffness is singular but for rounding: factors
  // of it may exist.
  for(double z : {0., 1.}) {
    Mesh hinge;
    for(const Vec3& origin : {Vec3{0, 0, 0}, Vec3{1, 1, z}}) {
      std::array<Vertex_index, 8> v{};
      for(int i = 0; i < 8; ++i) {
        const auto& c = reference_elements[HEXAHEDRON].coordinates[i];
        const Test_point p(origin[0] + (c[0] + 1) / 2, origin[1] + (c[1] + 1) / 2, origin[2] + (c[2] + 1) / 2);
        const auto found = std::find(hinge.points().begin(), hinge.points().end(), p);
        v[i] = found == hinge.points().end() ? hinge.add_vertex(p) : Vertex_index(found - hinge.points().begin());
      }
      hinge.add_element(HEXAHEDRON, v);
    }
    BOOST_TEST_EQ(hinge.number_of_vertices(), z == 0 ? 14u : 15u);
    const auto result_with = [&](auto problem) {
      prescribe(problem, vertices_where(hinge, [](const Vec3& p) { return p[0] == 0; }),
                Field(hinge.number_of_vertices(), Vec3{}));
      return problem.factor().status;
    };
    BOOST_TEST(result_with(Elasticity(hinge)) == Status::SOLVER_FAILED);
    BOOST_TEST(result_with(CGAL::Linear_elasticity_3<Mesh, Simplicial_solver_traits>(hinge))
               == Status::SOLVER_FAILED);
  }

  // An inverted element is named.
  Mesh inverted = any_grid(2, TETRAHEDRON);
  std::array<Vertex_index, 4> v;
  std::copy(inverted.element(7).begin(), inverted.element(7).end(), v.begin());
  std::swap(v[0], v[1]);
  Mesh bad;
  bad.points() = inverted.points();
  for(Element_index e = 0; e < inverted.number_of_elements(); ++e)
    if(e == 7)
      bad.add_element(TETRAHEDRON, v);
    else
      bad.add_element(TETRAHEDRON, inverted.element(e).begin());
  Elasticity of_bad(bad);
  const auto found = of_bad.factor();
  BOOST_TEST(found.status == Status::INVERTED_ELEMENT);
  BOOST_TEST_EQ(found.element, 7u);
  BOOST_TEST(!of_bad.is_factored());
}

// ---- solvers -----------------------------------------------------------------------------------

template <class Solver>
Field solved_with(const Mesh& mesh)
{
  CGAL::Linear_elasticity_3<Mesh, Solver> problem(mesh);
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[0] < 0.1; }), at_vertices(mesh, linear_field));
  BOOST_TEST(is_success(problem.factor()));
  problem.set_gravity({0, 0, -9810});
  BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{{0.7, 0.6, 0.5}, {0.4, 0.3, 0.8}})));
  BOOST_TEST(is_success(problem.solve(Field{{0.1, 0, 0}, {0, 0.1, 0.1}})));
  problem.set_iteration_tolerance(1e-8);
  BOOST_TEST(is_success(problem.remove_elements(elements_where(mesh, [](const Vec3& p) { return p[2] < 0.25; }))));
  BOOST_TEST(is_success(problem.solve(Field{{0.1, 0, 0}, {0, 0.1, 0.1}})));
  return problem.displacements();
}

void test_solvers()
{
  const Mesh mesh = any_grid(4, number_of_element_kinds, 0.1);
  const Field u = solved_with<Simplicial_solver_traits>(mesh);
  const double bound = 1e-7 * largest(u); // after a removal, which iterates
  BOOST_TEST(solved_with<Simplicial_solver_traits>(mesh) == u);
  using Matrix = Eigen::SparseMatrix<double>;
  BOOST_TEST_LT(difference(solved_with<CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Matrix>>>(mesh), u), bound);
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
  const Field v = solved_with<Cholmod_solver_traits>(mesh);
  BOOST_TEST_LT(difference(v, u), bound);
  BOOST_TEST(solved_with<Cholmod_solver_traits>(mesh) == v);
#endif
}

} // namespace

int main(int argc, char** argv)
{
  const std::string data = argc > 1 ? argv[1] : MIXED_MESH_3_DATA_DIR;
  test_patch(data);
  test_rigid_motions();
  test_convergence();
  test_locking();
  for(int kind = 0; kind <= number_of_element_kinds; ++kind) {
    test_supports(kind);
    test_control_points(kind);
    test_removal(kind);
  }
  test_free_motions();
  test_pieces();
  test_solvers();
  return boost::report_errors();
}
