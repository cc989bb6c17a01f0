// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elements around a vertex that moves, with their costs at any place of the vertex.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_STAR_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_STAR_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
A tetrahedron one vertex of which moves by x. The volume is linear in x, and the sum of the squared edges is
quadratic: with their coefficients, the aspect-ratio coefficient takes a third of the operations that it takes
with four points.
*/
class Moving_tetrahedron
{
  double m_volume; // six times, as in what follows
  Vec3 m_area;     // its gradient
  double m_squares;
  Vec3 m_opposite; // sum of the other vertices, seen from where the vertex was

public:
  Element_index element;
  double squared_cost; // where it was computed last

  /// \param u, v, w the other vertices, seen from where the vertex is; (vertex, u, v, w) is positive
  Moving_tetrahedron(Element_index e, const Vec3& u, const Vec3& v, const Vec3& w) : element(e)
  {
    const Vec3 uv = v - u, uw = w - u, vw = w - v;
    m_area = cross(uw, uv);
    m_volume = -dot(u, m_area);
    m_squares = dot(u, u) + dot(v, v) + dot(w, w) + dot(uv, uv) + dot(uw, uw) + dot(vw, vw);
    m_opposite = u + v + w;
    squared_cost = at({}, 0);
  }

  /// The squared aspect-ratio coefficient after a move by x; infinity if the volume is not positive.
  double at(const Vec3& x, double xx) const
  {
    const double volume = m_volume + dot(m_area, x);
    return volume > 0 ? squared_tetrahedron_arc(squared_edges(x, xx), volume)
                      : std::numeric_limits<double>::infinity();
  }

  /// The gradient of the logarithm of the coefficient, where the vertex was.
  Vec3 logarithmic_gradient() const { return (-3 / m_squares) * m_opposite - (1 / m_volume) * m_area; }

  /*!
  Whether a cost as computed proves that the volume is positive after a move by x. With positions of at most
  h, seen from where the vertex was, the rounding error of the volume is less than 1000 units of roundoff
  times h^3. A cost below 10^4 and squared edges of more than h^2 / 100 in all make the volume 10^4 times as
  large. Without underflow and overflow, for which h must not be extreme.
  */
  bool proves_positive(const Vec3& x, double xx) const
  {
    const double most = (std::max)(m_squares, xx);
    return squared_cost < 1e8 && 100 * squared_edges(x, xx) > most && 1e-60 < most && most < 1e60;
  }

private:
  double squared_edges(const Vec3& x, double xx) const { return m_squares + 3 * xx - 2 * dot(m_opposite, x); }
};

/// What the cost of an element keeps while one of its vertices moves: nothing, if the quality is a user's.
template <class Quality>
struct Fixed_parts
{
  double cost(const Quality& quality, Element_kind kind, const Element_points& p, int v, Vec3& gradient)
  {
    return quality(kind, p, v, gradient);
  }
  double cost_after_move(const Quality& quality, Element_kind kind, const Element_points& p, int)
  {
    return quality(kind, p);
  }
};

/// The aspect-ratio coefficient keeps the corners and the faces that the vertex does not touch: half of those
/// of a hexahedron.
template <>
struct Fixed_parts<Aspect_ratio_quality_3>
{
  Aspect_ratio_parts parts;

  double cost(const Aspect_ratio_quality_3& quality, Element_kind kind, const Element_points& p, int v,
              Vec3& gradient)
  {
    return quality(kind, p, v, gradient, parts);
  }
  double cost_after_move(const Aspect_ratio_quality_3& quality, Element_kind kind, const Element_points& p,
                         int v)
  {
    return quality.cost_after_move(kind, p, v, parts);
  }
};

/*!
The elements around a vertex that moves. Positions are copied once, as a vertex is tried at several places.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Vertex_star
{
  // An element with the positions of its vertices, as seen from the first one.
  struct Other
  {
    Element_index element;
    Element_kind kind;
    std::uint8_t position; // position of the vertex that moves
    double cost;
    Element_points points;
    Fixed_parts<Quality> fixed;
  };

  const Working_mesh& m_mesh;
  const Quality& m_quality;
  const Vec3 m_start;
  Vec3 m_place;
  boost::container::small_vector<Moving_tetrahedron, 40> m_tetrahedra;
  boost::container::small_vector<Other, 12> m_others;

  static constexpr bool has_aspect_ratio = std::is_same_v<Quality, Aspect_ratio_quality_3>;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  static double power_of_square(double square, double exponent)
  {
    return exponent == 4 ? square * square : power(square, exponent / 2);
  }

public:
  Vertex_star(const Working_mesh& mesh, const Quality& quality, Vertex_index v)
    : m_mesh(mesh), m_quality(quality), m_start(mesh.points[v]), m_place(m_start)
  {
    for(Element_index e : mesh.incident[v]) {
      const Working_mesh::Element& element = mesh.elements[e];
      const int position = element.position(v);
      if(has_aspect_ratio && element.kind == TETRAHEDRON) {
        const int(&o)[4] = even_permutations[position];
        const auto seen = [&](int i) { return mesh.points[element.vertices[std::size_t(o[i])]] - m_start; };
        m_tetrahedra.emplace_back(e, seen(1), seen(2), seen(3));
      } else {
        Other& other = m_others.emplace_back();
        other.element = e;
        other.kind = element.kind;
        other.position = std::uint8_t(position);
        other.points = mesh.relative_points(element);
      }
    }
  }

  /// The sum of the powers of the costs where the vertex was.
  /// \param gradient to which the gradient of the sum is added
  double energy(double exponent, Vec3& gradient)
  {
    double sum = 0;
    for(const Moving_tetrahedron& t : m_tetrahedra) {
      const double e = power_of_square(t.squared_cost, exponent);
      sum += e;
      gradient = gradient + (exponent * e) * t.logarithmic_gradient();
    }
    for(Other& other : m_others) {
      Vec3 g{};
      other.cost = other.fixed.cost(m_quality, other.kind, other.points, other.position, g);
      const double e = power(other.cost, exponent);
      sum += e;
      gradient = gradient + (exponent * e / other.cost) * g;
    }
    return sum;
  }

  /// The sum of the powers of the costs with the vertex at another place; infinity if the sum is not less
  /// than the limit, or if an element costs more than `most`. \pre `energy()` was called
  /// \param place the position of the vertex in the mesh now
  /// \param sum what is added to the costs
  double energy_at(const Vec3& place, double exponent, double sum, double limit, double most)
  {
    m_place = place;
    const Vec3 x = place - m_start;
    const double xx = dot(x, x), most_squared = most * most;
    for(Moving_tetrahedron& t : m_tetrahedra) {
      t.squared_cost = t.at(x, xx);
      sum += power_of_square(t.squared_cost, exponent);
      if(!(sum < limit && t.squared_cost <= most_squared))
        return infinity;
    }
    for(Other& other : m_others) {
      move(other, place);
      other.cost = other.fixed.cost_after_move(m_quality, other.kind, other.points, other.position);
      sum += power(other.cost, exponent);
      if(!(sum < limit && other.cost <= most))
        return infinity;
    }
    return sum;
  }

  /// Whether all elements are proved positive with the vertex at the place tried last.
  bool is_positive() const
  {
    const Vec3 x = m_place - m_start;
    const double xx = dot(x, x);
    return std::all_of(m_tetrahedra.begin(), m_tetrahedra.end(),
                       [&](const Moving_tetrahedron& t) {
                         return t.proves_positive(x, xx) || m_mesh.is_positive(m_mesh.elements[t.element]);
                       })
           && std::all_of(m_others.begin(), m_others.end(), [&](const Other& other) {
                return m_mesh.is_positive(m_mesh.elements[other.element]);
              });
  }

  /// Calls `f(element, cost)` with the costs at the place tried last.
  template <class F>
  void for_each_cost(const F& f) const
  {
    for(const Moving_tetrahedron& t : m_tetrahedra)
      f(t.element, std::sqrt(t.squared_cost));
    for(const Other& other : m_others)
      f(other.element, other.cost);
  }

private:
  void move(Other& other, const Vec3& place) const
  {
    const Working_mesh::Element& element = m_mesh.elements[other.element];
    if(other.position == 0) // the vertex from which the others are seen
      other.points = m_mesh.relative_points(element);
    else
      other.points[other.position] = place - m_mesh.points[element.vertices[0]];
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_STAR_H
