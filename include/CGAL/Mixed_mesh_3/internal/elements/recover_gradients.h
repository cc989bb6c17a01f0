// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradients at vertices from values at vertices, by least squares as in Zhang, Naga: "A new finite element
// gradient recovery method: superconvergence property", SIAM Journal on Scientific Computing 26, 2005.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_RECOVER_GRADIENTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_RECOVER_GRADIENTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Isoparametric_map_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>
#include <CGAL/Mixed_mesh_3/internal/elements/with_kind.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Derivatives of a vector field by x, y and z.
using Gradient = std::array<Vec3, 3>;

inline Vec3 product_of_columns(const Gradient& g, const Vec3& v)
{
  return v[0] * g[0] + (v[1] * g[1] + v[2] * g[2]);
}

/// The gradient of a field from the derivatives of field and position by reference coordinates.
inline Gradient gradient_in_space(const std::array<Vec3, 3>& field, const std::array<Vec3, 3>& position)
{
  const std::array<Vec3, 3> inverse = inverse_rows(position);
  Gradient g;
  for(int k = 0; k < 3; ++k)
    g[k] = inverse[0][k] * field[0] + (inverse[1][k] * field[1] + inverse[2][k] * field[2]);
  return g;
}

/// The mean of the vertices of the reference element.
inline Vec3 reference_center(Element_kind kind)
{
  const Reference_element& reference = reference_elements[kind];
  Vec3 center{};
  for(int i = 0; i < reference.number_of_vertices; ++i)
    for(int k = 0; k < 3; ++k)
      center[k] += double(reference.coordinates[i][k]) / reference.number_of_vertices;
  return center;
}

/// The gradient of a field in the middle of an element.
/// \param points positions of its vertices  \param values of the field there
inline Gradient central_gradient(Element_kind kind, const Vec3* points, const Vec3* values)
{
  const Vec3 center = reference_center(kind);
  return with_kind(kind, [&](auto k) {
    return gradient_in_space(Element_field<k.value>(values).derivatives(center),
                             Element_field<k.value>(points).derivatives(center));
  });
}

/*!
Fits the polynomial of degree 2 that is zero at the origin to values at points, by least squares.

QR decomposition by Householder's reflections, of columns of length 1.
*/
class Quadratic_fit
{
  static constexpr std::size_t n = 9; // x, y, z, three squares and three products
  using Row = std::array<double, n>;

  std::vector<Row> m_rows;
  std::vector<Vec3> m_values;
  std::array<double, n> m_scales{};

  // Divides the columns of x, y, z, their squares and their products by their lengths.
  bool normalize()
  {
    for(std::size_t c = 0; c < n; ++c) {
      double square = 0;
      for(const Row& row : m_rows)
        square += row[c] * row[c];
      m_scales[c] = std::sqrt(square);
      if(!(m_scales[c] > 0))
        return false;
      for(Row& row : m_rows)
        row[c] /= m_scales[c];
    }
    return true;
  }

  // Makes column c zero below the diagonal, unless the column is nearly zero from the diagonal on.
  bool reflect(std::size_t c)
  {
    // Least length of the part of a column of length 1 that is independent of the columns before it. On two
    // parallel planes nothing is left of the square of the distance, on three planes at equal distances 0.2;
    // a tenth is between these.
    constexpr double least_pivot = 0.1;
    double square = 0;
    for(std::size_t r = c; r < m_rows.size(); ++r)
      square += m_rows[r][c] * m_rows[r][c];
    const double length = std::sqrt(square);
    if(!(length > least_pivot))
      return false;
    const double pivot = m_rows[c][c] > 0 ? -length : length;
    const double f = 1 / (square - pivot * m_rows[c][c]); // 2 / v^2 for v, the column minus pivot e_c
    m_rows[c][c] -= pivot;
    for(std::size_t d = c + 1; d < n; ++d) {
      double s = 0;
      for(std::size_t r = c; r < m_rows.size(); ++r)
        s += m_rows[r][c] * m_rows[r][d];
      for(std::size_t r = c; r < m_rows.size(); ++r)
        m_rows[r][d] -= f * s * m_rows[r][c];
    }
    Vec3 s{};
    for(std::size_t r = c; r < m_rows.size(); ++r)
      s = s + m_rows[r][c] * m_values[r];
    for(std::size_t r = c; r < m_rows.size(); ++r)
      m_values[r] = m_values[r] - (f * m_rows[r][c]) * s;
    m_rows[c][c] = pivot;
    return true;
  }

public:
  void clear()
  {
    m_rows.clear();
    m_values.clear();
    m_scales = {};
  }

  void add(const Vec3& p, const Vec3& value)
  {
    m_rows.push_back(
      {p[0], p[1], p[2], p[0] * p[0], p[1] * p[1], p[2] * p[2], p[0] * p[1], p[1] * p[2], p[2] * p[0]});
    m_values.push_back(value);
  }

  /// The gradient at the origin, if the points determine the polynomial well. To be called once.
  std::optional<Gradient> gradient()
  {
    if(m_rows.size() < n || !normalize())
      return std::nullopt;
    for(std::size_t c = 0; c < n; ++c)
      if(!reflect(c))
        return std::nullopt;
    for(std::size_t c = n; c-- > 0;) {
      for(std::size_t d = c + 1; d < n; ++d)
        m_values[c] = m_values[c] - m_rows[c][d] * m_values[d];
      m_values[c] = (1 / m_rows[c][c]) * m_values[c];
    }
    return Gradient{(1 / m_scales[0]) * m_values[0], (1 / m_scales[1]) * m_values[1],
                    (1 / m_scales[2]) * m_values[2]};
  }
};

/// Recovers gradients at vertices from values at vertices, for the elements of each subdomain separately.
/// \tparam Is_used `bool(Element_index)`
template <class Mesh, class Is_used>
class Gradient_recoverer
{
  const Mesh& m_mesh;
  const Is_used& m_is_used;
  const std::vector<Vec3>& m_values;
  // The elements of vertex v: m_elements[m_ends[v]] ... m_elements[m_ends[v + 1] - 1], by subdomain.
  std::vector<std::size_t> m_ends;
  std::vector<Element_index> m_elements;
  std::vector<double> m_volumes;
  std::vector<Gradient> m_central_gradients;
  std::vector<Vertex_index> m_ring;
  Quadratic_fit m_fit;

  template <class F>
  void for_each_corner(const F& f) const
  {
    for(Element_index e = 0; e < m_mesh.number_of_elements(); ++e)
      if(m_is_used(e))
        for(Vertex_index v : m_mesh.element(e))
          f(e, v);
  }

  void find_elements_of_vertices()
  {
    m_ends.assign(m_mesh.number_of_vertices() + 2, 0);
    for_each_corner([&](Element_index, Vertex_index v) { ++m_ends[v + 2]; });
    for(std::size_t v = 2; v < m_ends.size(); ++v)
      m_ends[v] += m_ends[v - 1];
    m_elements.resize(m_ends.back());
    for_each_corner([&](Element_index e, Vertex_index v) { m_elements[m_ends[v + 1]++] = e; });
    for(std::size_t v = 0; v < m_mesh.number_of_vertices(); ++v)
      std::stable_sort(m_elements.begin() + std::ptrdiff_t(m_ends[v]),
                       m_elements.begin() + std::ptrdiff_t(m_ends[v + 1]),
                       [this](Element_index a, Element_index b) {
                         return m_mesh.subdomain_index(a) < m_mesh.subdomain_index(b);
                       });
  }

  // Gradients of inverted elements, which files may have, do not count.
  void find_central_gradients()
  {
    m_volumes.assign(m_mesh.number_of_elements(), 0);
    m_central_gradients.resize(m_mesh.number_of_elements());
    for(Element_index e = 0; e < m_mesh.number_of_elements(); ++e) {
      if(!m_is_used(e))
        continue;
      const Element_view element = m_mesh.element(e);
      const Element_points points = element_points(m_mesh, element);
      const Element_points values = relative_points(element, [this](Vertex_index v) { return m_values[v]; });
      const Gradient g = central_gradient(element.kind(), points.data(), values.data());
      const double v = volume(element.kind(), points);
      if(v > 0 && std::isfinite(norm(g[0]) + norm(g[1]) + norm(g[2]))) {
        m_volumes[e] = v;
        m_central_gradients[e] = g;
      }
    }
  }

  void add_ring(Vertex_index v, Subdomain_index subdomain)
  {
    for(std::size_t i = m_ends[v]; i < m_ends[v + 1]; ++i)
      if(m_mesh.subdomain_index(m_elements[i]) == subdomain) {
        const Element_view element = m_mesh.element(m_elements[i]);
        m_ring.insert(m_ring.end(), element.begin(), element.end());
      }
  }

  std::optional<Gradient> fit_ring(Vertex_index v)
  {
    std::sort(m_ring.begin(), m_ring.end());
    m_ring.erase(std::unique(m_ring.begin(), m_ring.end()), m_ring.end());
    m_fit.clear();
    for(Vertex_index w : m_ring)
      if(w != v)
        m_fit.add(to_vec3(m_mesh.point(w)) - to_vec3(m_mesh.point(v)), m_values[w] - m_values[v]);
    return m_fit.gradient();
  }

  // The gradient fitted to the vertices around, or to the two rings of vertices around.
  std::optional<Gradient> fitted(Vertex_index v, Subdomain_index subdomain)
  {
    m_ring.clear();
    add_ring(v, subdomain);
    if(const auto g = fit_ring(v))
      return g;
    const std::vector<Vertex_index> first_ring = m_ring;
    for(Vertex_index w : first_ring)
      add_ring(w, subdomain);
    return fit_ring(v);
  }

public:
  Gradient_recoverer(const Mesh& mesh, const Is_used& is_used, const std::vector<Vec3>& values)
    : m_mesh(mesh), m_is_used(is_used), m_values(values)
  {
    find_elements_of_vertices();
    find_central_gradients();
  }

  /// Calls `f(subdomain, gradient)` for the subdomains around a vertex, in ascending order.
  template <class F>
  void for_each_gradient(Vertex_index v, bool use_least_squares, const F& f)
  {
    for(std::size_t i = m_ends[v]; i < m_ends[v + 1];) {
      const Subdomain_index subdomain = m_mesh.subdomain_index(m_elements[i]);
      double volume = 0;
      Gradient sum{};
      for(; i < m_ends[v + 1] && m_mesh.subdomain_index(m_elements[i]) == subdomain; ++i) {
        const Element_index e = m_elements[i];
        volume += m_volumes[e];
        for(int k = 0; k < 3; ++k)
          sum[k] = sum[k] + m_volumes[e] * m_central_gradients[e][k];
      }
      if(!(volume > 0))
        continue;
      for(Vec3& g : sum)
        g = (1 / volume) * g;
      const std::optional<Gradient> better = use_least_squares ? fitted(v, subdomain) : std::nullopt;
      f(subdomain, better.value_or(sum));
    }
  }
};

/// Gradients at the vertices: one for each subdomain around a vertex.
class Vertex_gradients
{
public:
  struct Entry
  {
    Subdomain_index subdomain;
    Gradient gradient;
  };

private:
  std::vector<std::size_t> m_ends{0}; // entries of vertex v: m_ends[v] to m_ends[v + 1]
  std::vector<Entry> m_entries;       // entries of each vertex, sorted by subdomain

public:
  const Entry* begin(Vertex_index v) const { return m_entries.data() + m_ends[v]; }
  const Entry* end(Vertex_index v) const { return m_entries.data() + m_ends[v + 1]; }

  /// \param is_used `bool(Element_index)`
  /// \param values values at the vertices
  template <class Mesh, class Is_used>
  Vertex_gradients(const Mesh& mesh, const Is_used& is_used, const std::vector<Vec3>& values,
                   bool use_least_squares)
  {
    Gradient_recoverer<Mesh, Is_used> recoverer(mesh, is_used, values);
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
      recoverer.for_each_gradient(v, use_least_squares, [this](Subdomain_index s, const Gradient& g) {
        m_entries.push_back({s, g});
      });
      m_ends.push_back(m_entries.size());
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_RECOVER_GRADIENTS_H
