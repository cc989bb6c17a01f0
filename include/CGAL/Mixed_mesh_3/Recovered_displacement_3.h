// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_RECOVERED_DISPLACEMENT_3_H
#define CGAL_MIXED_MESH_3_RECOVERED_DISPLACEMENT_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Element_location_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Quadratic_field.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_bubbles.h>
#include <CGAL/Mixed_mesh_3/internal/elements/recover_gradients.h>
#include <CGAL/Mixed_mesh_3/internal/elements/with_kind.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Fields
/// The way in which displacements between vertices are computed from the displacements of the vertices.
enum class Displacement_interpolation {
  LINEAR,   ///< shape functions of the elements
  RECOVERED ///< shape functions and gradients of the displacement, or the functions of edges in elements of
            ///< order 2: see `Recovered_displacement_3`
};

/// \ingroup PkgMixedMesh3Fields
/// The way in which the gradient at a vertex is computed.
enum class Gradient_recovery {
  AVERAGE, ///< mean of the elements' gradients at their centers, weighted by volume
  /// The gradient of the polynomial of degree 2 that fits the vertices around by least squares; `AVERAGE` if
  /// the vertices do not determine the polynomial. Exact for quadratic displacements.
  LEAST_SQUARES
};

namespace internal {

// Points where the orientation of elements is tested: vertices, middles of edges, center, but not a pyramid's
// apex.
template <Element_kind Kind, class F>
bool all_of_test_points(const F& f)
{
  const Reference_element& reference = reference_elements[Kind];
  const Vec3 center = reference_center(Kind);
  const auto vertex = [&](int i) {
    Vec3 r;
    for(int k = 0; k < 3; ++k)
      r[k] = double(reference.coordinates[i][k]);
    const bool is_apex = Kind == PYRAMID && i == 4;
    return is_apex ? 0.999 * r + 0.001 * center : r;
  };
  if(!f(center))
    return false;
  for(int i = 0; i < reference.number_of_vertices; ++i)
    if(!f(vertex(i)))
      return false;
  for(int i = 0; i < reference.number_of_edges; ++i)
    if(!f(0.5 * (vertex(reference.edges[i][0]) + vertex(reference.edges[i][1]))))
      return false;
  return true;
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3Fields

\brief The displacement of a mesh between its vertices, one order better than by the shape functions.

\f[ u(x) = \sum_i N_i(x) \left( u_i + \frac12 G_i (x - x_i) \right) \f]

with the shape functions \f$ N_i \f$ of the element and gradients \f$ G_i \f$ of the displacement at the
vertices, which are recovered from the displacements of the vertices around. The field is continuous, has the
given displacements at the vertices, is linear where these are linear, and quadratic where these are quadratic
and the gradients are exact. No unknown is added. See D. Kraaijpoel, T. van Leeuwen: "Raising the order of
multivariate approximation schemes using supplementary derivative data", Procedia Computer Science 1, 2010.

The formula is a sum over pairs of the element's vertices, as \f$ \sum_i N_i x_i = x \f$,

\f[ u(x) = \sum_i N_i u_i + \sum_{i<j} N_i N_j b_{ij}, \qquad b_{ij} = \frac12 (G_i - G_j) (x_j - x_i), \f]

and so are the exceptions to the formula; all of them keep the field continuous, and linear fields linear:

- *Subdomains* (see `Element_attributes`) may be of different stiffness, and the gradient jumps then. So a
vertex has a gradient for each subdomain around it, and a pair has the mean of its \f$ b_{ij} \f$ in the
subdomains that both vertices have.
- *Removed elements* do not count.
- *Orientation*: where the field would nearly turn an element inside out, pairs of its vertices have \f$
b_{ij} = 0 \f$. The criterion is that at a vertex, the middle of an edge or the center the determinant of \f$
I + \nabla u \f$ is less than a quarter of its value with shape functions only, which leaves room for other
places between these points.

The displacement in elements of order 2 is a sum over pairs of vertices, too. It is given by the coefficients
of edges, `Linear_elasticity_3::edge_coefficients()`, and nothing is recovered then.

The mesh must outlive the object and not change.

\tparam Mesh a `Mixed_mesh_3`
*/
template <class Mesh>
class Recovered_displacement_3
{
public:
  /// Derivatives of the displacement by x, y and z: the columns of its gradient.
  using Gradient = std::array<Vec3, 3>;

private:
  const Mesh* m_mesh;
  std::vector<Vec3> m_displacements;
  std::vector<bool> m_is_removed;
  std::optional<internal::Vertex_gradients> m_gradients; // none if edges have coefficients
  internal::Edge_vectors m_coefficients;
  std::vector<bool> m_is_linear; // vertices: a pair of them has no bubble
  std::size_t m_number_of_linear_elements = 0;

  template <class Displacements>
  static std::vector<Vec3> vectors(const Mesh& mesh, const Displacements& displacements)
  {
    CGAL_precondition(std::size_t(std::size(displacements)) == mesh.number_of_vertices());
    std::vector<Vec3> result;
    result.reserve(mesh.number_of_vertices());
    for(const auto& u : displacements)
      result.push_back({double(u[0]), double(u[1]), double(u[2])});
    return result;
  }

  Vec3 position(Vertex_index v) const { return to_vec3(m_mesh->point(v)); }

  // The bubble b_ij of any two vertices, by their gradients.
  Vec3 bubble(Vertex_index v, Vertex_index w) const
  {
    Vec3 sum{};
    if(m_is_linear[v] && m_is_linear[w])
      return sum;
    const Vec3 edge = position(w) - position(v);
    int n = 0;
    auto j = m_gradients->begin(w);
    for(auto i = m_gradients->begin(v); i != m_gradients->end(v); ++i) {
      while(j != m_gradients->end(w) && j->subdomain < i->subdomain)
        ++j;
      if(j == m_gradients->end(w))
        break;
      if(j->subdomain != i->subdomain)
        continue;
      for(int k = 0; k < 3; ++k)
        sum = sum + edge[k] * (i->gradient[k] - j->gradient[k]);
      ++n;
    }
    return n == 0 ? sum : (0.5 / n) * sum;
  }

  // The bubbles of an element, by the coefficients of its edges.
  internal::Bubbles bubbles_of_edges(const Element_view& element) const
  {
    std::array<Vec3, internal::largest_number_of_edges> coefficients{};
    for(int i = 0; i < element.reference().number_of_edges; ++i) {
      const Vertex_index v = element[element.reference().edges[i][0]],
                         w = element[element.reference().edges[i][1]];
      if(!(m_is_linear[v] && m_is_linear[w]))
        coefficients[std::size_t(i)] = m_coefficients(v, w);
    }
    return internal::bubbles_of_edges(element.kind(), coefficients);
  }

  // Whether the element keeps its orientation at the test points.
  bool is_oriented(const Element_view& element) const
  {
    Vec3 before[8], after[8];
    for(int i = 0; i < element.size(); ++i) {
      before[i] = position(element[i]) - position(element[0]);
      after[i] = before[i] + m_displacements[element[i]] - m_displacements[element[0]];
    }
    const internal::Bubbles b = bubbles(element).value_or(internal::Bubbles{});
    return internal::with_kind(element.kind(), [&](auto kind) {
      const internal::Element_field<kind.value> x(before), plain(after);
      const internal::Quadratic_field<kind.value> recovered(after, b);
      return internal::all_of_test_points<kind.value>([&](const Vec3& r) {
        const auto d0 = x.derivatives(r), d1 = plain.derivatives(r), d2 = recovered.derivatives(r);
        const double volume = determinant(d0[0], d0[1], d0[2]);
        const double change = determinant(d1[0], d1[1], d1[2]) / volume;
        return change > 0 && determinant(d2[0], d2[1], d2[2]) / volume >= 0.25 * change;
      });
    });
  }

  // Finds elements without bubbles. Bubbles that are removed from an element are also missing in its
  // neighbors, so the test is repeated until all elements are oriented.
  void find_linear_elements()
  {
    std::vector<bool> is_linear(m_mesh->number_of_elements(), false);
    for(bool has_changed = true; has_changed;) {
      has_changed = false;
      for(Element_index e = 0; e < is_linear.size(); ++e)
        if(!is_removed(e) && !is_linear[e] && !is_oriented(m_mesh->element(e))) {
          is_linear[e] = has_changed = true;
          ++m_number_of_linear_elements;
          for(Vertex_index v : m_mesh->element(e))
            m_is_linear[v] = true;
        }
    }
  }

public:
  /*!
  Recovers the gradients.

  \param mesh the mesh, before the displacement
  \param displacements vector for each vertex, with components `[0]`, `[1]`, `[2]`; displacements of vertices
  of removed elements only do not matter
  \param removed_elements true for each element that has been removed; empty: none
  \param recovery way in which gradients are computed
  \pre there is a displacement for each vertex; `removed_elements` is empty or has a value for each element
  \par Complexity
  Linear in the number of elements, if the number of elements at a vertex is bounded
  */
  template <class Displacements>
  Recovered_displacement_3(const Mesh& mesh, const Displacements& displacements,
                           std::vector<bool> removed_elements = {},
                           Gradient_recovery recovery = Gradient_recovery::AVERAGE)
    : m_mesh(&mesh), m_displacements(vectors(mesh, displacements)), m_is_removed(std::move(removed_elements)),
      m_is_linear(mesh.number_of_vertices(), false)
  {
    CGAL_precondition(m_is_removed.empty() || m_is_removed.size() == mesh.number_of_elements());
    m_gradients.emplace(
      mesh, [this](Element_index e) { return !is_removed(e); }, m_displacements,
      recovery == Gradient_recovery::LEAST_SQUARES);
    find_linear_elements();
  }

  /*!
  Takes the displacement of elements of order 2.

  \param mesh the mesh, before the displacement
  \param displacements vector for each vertex, with components `[0]`, `[1]`, `[2]`
  \param edges both ends of each edge with a coefficient, the smaller one first
  \param coefficients vector for each of `edges`: the displacement of its middle minus the mean of its ends
  \param removed_elements true for each element that has been removed; empty: none
  \pre there is a displacement for each vertex, and a coefficient for each edge; `removed_elements` is empty
  or has a value for each element
  */
  template <class Displacements>
  Recovered_displacement_3(const Mesh& mesh, const Displacements& displacements,
                           const std::vector<std::array<Vertex_index, 2>>& edges,
                           const std::vector<Vec3>& coefficients, std::vector<bool> removed_elements = {})
    : m_mesh(&mesh), m_displacements(vectors(mesh, displacements)), m_is_removed(std::move(removed_elements)),
      m_coefficients(mesh.number_of_vertices(), edges, coefficients),
      m_is_linear(mesh.number_of_vertices(), false)
  {
    CGAL_precondition(m_is_removed.empty() || m_is_removed.size() == mesh.number_of_elements());
    find_linear_elements();
  }

  /// The displacement at a point of an element, or at the boundary's point nearest to a point outside.
  Vec3 operator()(const Element_location_3& location) const
  {
    const Element_view element = m_mesh->element(location.element);
    internal::Bubbles of_edges{};
    if(!m_gradients)
      of_edges = bubbles_of_edges(element);
    Vec3 u{};
    for(int j = 0; j < element.size(); ++j) {
      const double weight = location.weights[j];
      u = u + weight * m_displacements[element[j]];
      for(int i = 0; i < j; ++i)
        if(weight * location.weights[i] != 0)
          u = u
              + (weight * location.weights[i])
                  * (m_gradients ? bubble(element[i], element[j])
                                 : of_edges[std::size_t(internal::pair_index(i, j))]);
    }
    return u;
  }

  /// The gradient at a point of an element; the gradient jumps between elements. \pre not the apex of a
  /// pyramid
  Gradient gradient(const Element_location_3& location) const
  {
    const Element_view element = m_mesh->element(location.element);
    Vec3 points[8], values[8];
    for(int i = 0; i < element.size(); ++i) {
      points[i] = position(element[i]) - position(element[0]);
      values[i] = m_displacements[element[i]];
    }
    return internal::with_kind(element.kind(), [&](auto kind) {
      const Vec3 r(location.coordinates);
      return internal::gradient_in_space(
        internal::Quadratic_field<kind.value>(values, bubbles(element).value_or(internal::Bubbles{}))
          .derivatives(r),
        internal::Element_field<kind.value>(points).derivatives(r));
    });
  }

  /// The mesh given to the constructor.
  const Mesh& mesh() const { return *m_mesh; }
  /// Displacements of the vertices.
  const std::vector<Vec3>& displacements() const { return m_displacements; }
  /// Whether the element is removed.
  bool is_removed(Element_index e) const { return !m_is_removed.empty() && m_is_removed[e]; }
  /// The number of elements with the displacement of the shape functions, because they would be turned inside
  /// out.
  std::size_t number_of_linear_elements() const { return m_number_of_linear_elements; }

  /// \cond INTERNAL
  // The bubbles of an element; none if the displacement is that of the shape functions.
  std::optional<internal::Bubbles> bubbles(const Element_view& element) const
  {
    internal::Bubbles b{};
    if(m_gradients) {
      for(int j = 1; j < element.size(); ++j)
        for(int i = 0; i < j; ++i)
          b[std::size_t(internal::pair_index(i, j))] = bubble(element[i], element[j]);
    } else {
      b = bubbles_of_edges(element);
    }
    const bool is_any = std::any_of(b.begin(), b.end(), [](const Vec3& c) { return c != Vec3{}; });
    return is_any ? std::optional<internal::Bubbles>(b) : std::nullopt;
  }
  /// \endcond
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_RECOVERED_DISPLACEMENT_3_H
