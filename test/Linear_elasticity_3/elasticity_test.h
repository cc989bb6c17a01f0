// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Common parts of the tests of Linear_elasticity_3: grids of cells, mixed ones among them, fields at their
// vertices, and an elastic energy.

#ifndef MIXED_MESH_3_TEST_ELASTICITY_TEST_H
#define MIXED_MESH_3_TEST_ELASTICITY_TEST_H

#include "test_meshes.h"
#include "test_surfaces.h"

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace elasticity_test {

using namespace CGAL::Mixed_meshes_3;
using namespace CGAL::Mixed_meshes_3::internal;
using CGAL::Linear_elasticity_result_3;
using Status = CGAL::Linear_elasticity_status;

using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;
using Elasticity = CGAL::Linear_elasticity_3<Mesh>;
using Field = std::vector<Vec3>; // of the vertices
using Function = std::function<Vec3(const Vec3&)>;

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

// Places vertices from coordinates in cells in [0,1]^3, moved by up to `noise` cells.
inline auto placed(int n, double noise, Moved moved)
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

// A grid of n^3 cells, of elements of one kind. \param moved INNER: the sides of the cube stay plane
inline Mesh grid(int n, Element_kind kind, double noise = 0, Moved moved = Moved::ALL)
{
  auto place = placed(n, noise, moved);
  return grid_of_cells<Mesh>(n, kind, [&](double x, double y, double z) { return place(x, y, z); });
}

// A grid of n^3 cells, from below: hexahedra; cells divided from their centers; tetrahedra; prisms. \pre 4
// divides n
inline Mesh mixed_grid(int n, double noise = 0, Moved moved = Moved::ALL)
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
          v[i] = Vertex_index(x + (c[0] + 1) / 2
                              + (n + 1) * (y + (c[1] + 1) / 2 + (n + 1) * (z + (c[2] + 1) / 2)));
        }
        const int layer = 4 * z / n;
        if(layer == 0) {
          mesh.add_element(HEXAHEDRON, v);
        } else if(layer == 1) {
          const Vertex_index center = mesh.add_vertex(place(x + 0.5, y + 0.5, z + 0.5));
          for(int f = 0; f < 6; ++f) {
            const auto& w = reference_elements[HEXAHEDRON].faces[f].vertices;
            if(f == 5 && 4 * (z + 1) / n == 2) { // at tetrahedra: along their diagonal
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
inline Mesh any_grid(int n, int kind, double noise = 0, Moved moved = Moved::ALL)
{
  Mesh mesh = kind == number_of_element_kinds ? mixed_grid(n, noise, moved)
                                              : grid(n, Element_kind(kind), noise, moved);
  BOOST_TEST(find_defects(mesh).positive());
  return mesh;
}

inline const char* name_of(int kind)
{
  return kind == number_of_element_kinds ? "all kinds" : reference_elements[kind].plural;
}

inline Vec3 position(const Mesh& mesh, Vertex_index v) { return to_vec3(mesh.point(v)); }

inline Field at_vertices(const Mesh& mesh, const Function& f)
{
  Field u;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    u.push_back(f(position(mesh, v)));
  return u;
}

inline std::vector<bool> is_on_boundary(const Mesh& mesh)
{
  std::vector<bool> result(mesh.number_of_vertices());
  for(Vertex_index v : boundary_vertices(mesh))
    result[v] = true;
  return result;
}

inline std::vector<bool> vertices_where(const Mesh& mesh, const std::function<bool(const Vec3&)>& f)
{
  std::vector<bool> result;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    result.push_back(f(position(mesh, v)));
  return result;
}

inline double largest(const Field& u)
{
  double result = 0;
  for(const Vec3& x : u)
    result = (std::max)(result, norm(x));
  return result;
}

inline double difference(const Field& a, const Field& b)
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

inline void prescribe(Elasticity& problem, const std::vector<bool>& is_prescribed, const Function& f)
{
  prescribe(problem, is_prescribed, at_vertices(problem.mesh(), f));
}

// Whether a result is a success; prints the error otherwise.
inline bool is_success(const Linear_elasticity_result_3& result)
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
  Energy(const Mesh& mesh, const Elastic_material& material = Elastic_material()) : m_problem(mesh, material)
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

inline Vec3 linear_field(const Vec3& p)
{
  return {0.1 + 0.3 * p[0] - 0.2 * p[1], -0.2 + 0.5 * p[2] + 0.1 * p[1], 0.4 * p[0] - 0.1 * p[2]};
}

inline Vec3 rigid_motion(const Vec3& p) { return Vec3{0.3, 0.1, -0.2} + cross(Vec3{0.2, -0.5, 0.7}, p); }

struct Exact_solution
{
  const char* name;
  Function displacement;
  std::function<Vec3(const Elastic_material&)> force; // by volume, constant
};

// The field u_i = 1/2 p^T q_i p: the divergence of the stress is constant.
// \param is_incompressible whether the field has no change of volume; else the force grows with the bulk
// modulus
inline Exact_solution quadratic_solution(bool is_incompressible)
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
inline Exact_solution harmonic_solution()
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

inline Vec3 interpolated(const Mesh& mesh, const Field& u, const Vec3& p)
{
  const Element_location_3 location = Element_locator_3<Mesh>(mesh).nearest(p);
  const Element_view element = mesh.element(location.element);
  Vec3 result{};
  for(int a = 0; a < element.size(); ++a)
    result = result + location.weights[std::size_t(a)] * u[element[a]];
  return result;
}

inline std::vector<bool> elements_where(const Mesh& mesh, const std::function<bool(const Vec3&)>& f)
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

} // namespace elasticity_test

#endif // MIXED_MESH_3_TEST_ELASTICITY_TEST_H
