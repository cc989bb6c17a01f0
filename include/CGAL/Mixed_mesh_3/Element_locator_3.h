// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_ELEMENT_LOCATOR_3_H
#define CGAL_MIXED_MESH_3_ELEMENT_LOCATOR_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Element_location_3.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/Recovered_displacement_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Isoparametric_map_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Quadratic_field.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

/// Positions of a mesh's vertices, displaced. \pre a displacement for each vertex
template <class Mesh, class Displacements>
std::vector<Vec3> displaced_points(const Mesh& mesh, const Displacements& displacements)
{
  CGAL_precondition(std::size_t(std::size(displacements)) == mesh.number_of_vertices());
  std::vector<Vec3> points;
  points.reserve(mesh.number_of_vertices());
  for(const auto& p : mesh.points())
    points.push_back(to_vec3(p) + components(displacements[points.size()]));
  return points;
}

// The point of a triangle or bilinear quadrilateral nearest to the origin, as weights of its corners. The
// patch is a segment in u for fixed v, and conversely: descends in u and v alternately.
inline std::array<double, 4> nearest_weights_on_quadrilateral(const Vec3* p, double u, double v)
{
  const auto on_segment = [](const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double length = dot(d, d);
    return length > 0 ? (std::max)(0., (std::min)(1., -dot(a, d) / length)) : 0.;
  };
  constexpr int largest_number_of_turns = 200; // limit for warped faces, where steps gain little
  constexpr double settled = 1e-14;            // some tens of roundings of weights, which are at most 1
  for(int i = 0; i < largest_number_of_turns; ++i) {
    const double new_u = on_segment((1 - v) * p[0] + v * p[3], (1 - v) * p[1] + v * p[2]);
    const double new_v = on_segment((1 - new_u) * p[0] + new_u * p[1], (1 - new_u) * p[3] + new_u * p[2]);
    const double change = (std::max)(std::abs(new_u - u), std::abs(new_v - v));
    u = new_u;
    v = new_v;
    if(change < settled)
      break;
  }
  return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

inline std::array<double, 4> nearest_weights_on_triangle(const Vec3* p)
{
  const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
  const double area = dot(n, n);
  std::array<double, 4> best{};
  if(area > 0) {
    best = {dot(n, cross(p[1], p[2])) / area, dot(n, cross(p[2], p[0])) / area,
            dot(n, cross(p[0], p[1])) / area, 0};
    if(best[0] >= 0 && best[1] >= 0 && best[2] >= 0)
      return best;
  }
  double least = std::numeric_limits<double>::infinity();
  for(int i = 0; i < 3; ++i) { // on an edge
    const int j = (i + 1) % 3;
    const Vec3 d = p[j] - p[i];
    const double length = dot(d, d);
    const double t = length > 0 ? (std::max)(0., (std::min)(1., -dot(p[i], d) / length)) : 0.;
    const Vec3 q = p[i] + t * d;
    if(dot(q, q) < least) {
      least = dot(q, q);
      best = {};
      best[i] = 1 - t;
      best[j] = t;
    }
  }
  return best;
}

inline std::array<double, 4> nearest_weights(const Vec3* p, int size)
{
  if(size == 3)
    return nearest_weights_on_triangle(p);
  // The search starts at each corner and at the middle: a warped patch may have several local minima.
  std::array<double, 4> best{};
  double least = std::numeric_limits<double>::infinity();
  for(const auto& start : {std::array<double, 2>{0.5, 0.5}, {0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    const auto w = nearest_weights_on_quadrilateral(p, start[0], start[1]);
    const double distance = norm(w[0] * p[0] + w[1] * p[1] + w[2] * p[2] + w[3] * p[3]);
    if(distance < least) {
      least = distance;
      best = w;
    }
  }
  return best;
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3Fields

\brief Finds the element of a mesh that contains a point, and the point's coordinates in the element.

The mesh may be as it is, or displaced: by the shape functions, or by a `Recovered_displacement_3`. If several
elements contain a point (on common faces, edges and vertices), the result is the one with the smallest index.
Points that are outside by less than 1e-9 in reference coordinates count as inside, so that no point is lost
between elements.

The mesh must outlive the locator and not change. Points may be of any type that has `p[0]`, `p[1]`, `p[2]`.

\tparam Mesh a `Mixed_mesh_3`
*/
template <class Mesh>
class Element_locator_3
{
  struct Box
  {
    Vec3 lower, upper;
    bool contains(const Vec3& p) const
    {
      return lower[0] <= p[0] && p[0] <= upper[0] && lower[1] <= p[1] && p[1] <= upper[1] && lower[2] <= p[2]
             && p[2] <= upper[2];
    }
    double squared_distance(const Vec3& p) const
    {
      double sum = 0;
      for(int i = 0; i < 3; ++i) {
        const double d = (std::max)({lower[i] - p[i], p[i] - upper[i], 0.});
        sum += d * d;
      }
      return sum;
    }
  };

  const Mesh* m_mesh;
  std::vector<Vec3> m_points;
  std::optional<Recovered_displacement_3<Mesh>> m_displacement; // none: shape functions
  std::vector<Face> m_boundary;
  // A uniform grid: the elements whose boxes meet cell c are
  // m_elements[m_ends[c]] ... m_elements[m_ends[c + 1] - 1], in ascending order.
  Box m_box{{1, 1, 1}, {0, 0, 0}}; // box of all elements; of none if there are none
  Vec3 m_cells_per_unit{};
  std::array<std::size_t, 3> m_size{1, 1, 1};
  std::vector<std::size_t> m_ends;
  std::vector<Element_index> m_elements;

  // The box of some vertices, widened by the tolerance inside which points count as inside.
  template <class Vertices>
  Box box(const Vertices& vertices, int size) const
  {
    Box b{m_points[vertices[0]], m_points[vertices[0]]};
    for(int i = 1; i < size; ++i)
      for(int k = 0; k < 3; ++k) {
        b.lower[k] = (std::min)(b.lower[k], m_points[vertices[i]][k]);
        b.upper[k] = (std::max)(b.upper[k], m_points[vertices[i]][k]);
      }
    // The margin is ten times that tolerance, in reference coordinates; a wider box costs time only.
    const double margin = 1e-8 * norm(b.upper - b.lower);
    for(int k = 0; k < 3; ++k) {
      b.lower[k] -= margin;
      b.upper[k] += margin;
    }
    return b;
  }

  bool is_removed(Element_index e) const { return m_displacement && m_displacement->is_removed(e); }

  std::optional<internal::Bubbles> bubbles_of(const Element_view& element) const
  {
    return m_displacement ? m_displacement->bubbles(element) : std::nullopt;
  }

  // The box of an element: displacements that are not linear leave the box of the vertices.
  Box box_of_element(Element_index e) const
  {
    const Element_view element = m_mesh->element(e);
    Box b = box(element, element.size());
    if(const auto bubbles = bubbles_of(element)) {
      const Vec3 r = internal::bubble_extent(element.kind(), *bubbles);
      b.lower = b.lower - r;
      b.upper = b.upper + r;
    }
    return b;
  }

  std::array<std::size_t, 3> cell(const Vec3& p) const
  {
    std::array<std::size_t, 3> c;
    for(int k = 0; k < 3; ++k) {
      const double x = (p[k] - m_box.lower[k]) * m_cells_per_unit[k];
      // The limit 1e9 is more than the number of cells in a row, so that the conversion does not overflow.
      c[k] = x > 0 ? (std::min)(std::size_t((std::min)(x, 1e9)), m_size[k] - 1) : 0;
    }
    return c;
  }

  std::size_t cell_index(std::size_t i, std::size_t j, std::size_t k) const
  {
    return i + m_size[0] * (j + m_size[1] * k);
  }

  template <class F>
  void for_each_cell(const Box& b, const F& f) const
  {
    const auto lower = cell(b.lower), upper = cell(b.upper);
    for(std::size_t k = lower[2]; k <= upper[2]; ++k)
      for(std::size_t j = lower[1]; j <= upper[1]; ++j)
        for(std::size_t i = lower[0]; i <= upper[0]; ++i)
          f(cell_index(i, j, k));
  }

  void make_grid()
  {
    const std::size_t n = m_mesh->number_of_elements();
    std::vector<Element_index> elements;
    std::vector<Box> boxes;
    boxes.reserve(n);
    for(std::size_t e = 0; e < n; ++e)
      if(!is_removed(Element_index(e))) {
        elements.push_back(Element_index(e));
        boxes.push_back(box_of_element(Element_index(e)));
      }
    Vec3 extent{};
    if(!boxes.empty()) {
      m_box = boxes.front();
      for(const Box& b : boxes)
        for(int k = 0; k < 3; ++k) {
          m_box.lower[k] = (std::min)(m_box.lower[k], b.lower[k]);
          m_box.upper[k] = (std::max)(m_box.upper[k], b.upper[k]);
        }
      for(int k = 0; k < 3; ++k)
        extent[k] = m_box.upper[k] - m_box.lower[k];
    }
    // There are about as many cubic cells as elements; not more than 1000 in a row, for meshes that are
    // nearly flat. The number of cells costs time or memory, and changes no result.
    const double width = std::cbrt(extent[0] * extent[1] * extent[2] / double(n + 1));
    for(int k = 0; k < 3; ++k) {
      m_size[k] = width > 0 ? std::size_t((std::min)(extent[k] / width, 1000.)) + 1 : 1;
      m_cells_per_unit[k] = extent[k] > 0 ? double(m_size[k]) / extent[k] : 0;
    }
    m_ends.assign(m_size[0] * m_size[1] * m_size[2] + 2, 0);
    for(const Box& b : boxes)
      for_each_cell(b, [&](std::size_t c) { ++m_ends[c + 2]; });
    for(std::size_t c = 2; c < m_ends.size(); ++c)
      m_ends[c] += m_ends[c - 1];
    m_elements.resize(m_ends.back());
    for(std::size_t i = 0; i < boxes.size(); ++i)
      for_each_cell(boxes[i], [&](std::size_t c) { m_elements[m_ends[c + 1]++] = elements[i]; });
  }

  std::optional<Element_location_3> locate_in(Element_index e, const Vec3& p) const
  {
    const Element_view element = m_mesh->element(e);
    Vec3 points[8];
    for(int i = 0; i < element.size(); ++i)
      points[i] = m_points[element[i]];
    return internal::with_kind(element.kind(), [&](auto kind) -> std::optional<Element_location_3> {
      using Recovered_map = internal::Isoparametric_map_3<kind.value, internal::Quadratic_field<kind.value>>;
      const auto bubbles = bubbles_of(element);
      const auto r = bubbles ? Recovered_map(points, *bubbles).inverse(p)
                             : internal::Isoparametric_map_3<kind.value>(points).inverse(p);
      if(!r)
        return std::nullopt;
      Element_location_3 location;
      location.element = e;
      location.coordinates = *r;
      const auto weights = Mixed_element_traits_3<kind.value>::shape_functions((*r)[0], (*r)[1], (*r)[2]);
      std::copy(weights.begin(), weights.end(), location.weights.begin());
      return location;
    });
  }

  void prepare()
  {
    make_grid();
    internal::for_each_face(m_mesh->elements(), m_points.size(), [&](const auto& group) {
      int number = 0;
      std::size_t last = 0;
      for(std::size_t i = 0; i < group.size(); ++i)
        if(!is_removed(group.element(i))) {
          ++number;
          last = i;
        }
      if(number == 1)
        m_boundary.push_back(group[last]);
    });
    std::sort(m_boundary.begin(), m_boundary.end());
  }

public:
  /// Constructs a locator of the mesh as it is.
  /// \par Complexity
  /// O(n log n) in the number of elements
  explicit Element_locator_3(const Mesh& mesh) : m_mesh(&mesh)
  {
    m_points.reserve(mesh.number_of_vertices());
    for(const auto& p : mesh.points())
      m_points.push_back(to_vec3(p));
    prepare();
  }

  /// Constructs a locator of the displaced mesh. \param mesh mesh
  /// \param displacements vector for each vertex, with components `[0]`, `[1]`, `[2]`
  template <class Displacements>
  Element_locator_3(const Mesh& mesh, const Displacements& displacements)
    : m_mesh(&mesh), m_points(internal::displaced_points(mesh, displacements))
  {
    prepare();
  }

  /// Constructs a locator of a mesh displaced by a field, which also holds between vertices; without the
  /// elements that the field has as removed. The location of a point is a point of the mesh before the
  /// displacement: the field moves that point to the given one, exactly up to rounding.
  /// \par Complexity
  /// O(n log n) in the number of elements
  explicit Element_locator_3(const Recovered_displacement_3<Mesh>& displacement)
    : m_mesh(&displacement.mesh()),
      m_points(internal::displaced_points(displacement.mesh(), displacement.displacements())),
      m_displacement(displacement)
  {
    prepare();
  }

  /// The element that contains a point, or none.
  /// \par Complexity
  /// Proportional to the number of elements whose boxes are near: constant unless sizes differ much
  template <class Point>
  std::optional<Element_location_3> locate(const Point& point) const
  {
    const Vec3 p = internal::components(point);
    if(!m_box.contains(p))
      return std::nullopt;
    const auto c = cell(p);
    const std::size_t index = cell_index(c[0], c[1], c[2]);
    for(std::size_t i = m_ends[index]; i < m_ends[index + 1]; ++i)
      if(const auto location = locate_in(m_elements[i], p))
        return location;
    return std::nullopt;
  }

  /*!
  The element that contains a point, or else the point of the boundary nearest to the given point; of equally
  near points the one in the element with the smallest index. The boundary of a mesh with a
  `Recovered_displacement_3` is considered to consist of the faces between displaced vertices, from which it
  differs little.

  \pre the mesh is not empty
  \par Complexity
  Complexity of `locate()`; also linear in the number of boundary faces for a point outside
  */
  template <class Point>
  Element_location_3 nearest(const Point& point) const
  {
    CGAL_precondition(!m_mesh->is_empty());
    if(const auto location = locate(point))
      return *location;
    const Vec3 p = internal::components(point);
    Element_location_3 best;
    best.distance = std::numeric_limits<double>::infinity();
    for(const Face& boundary_face : m_boundary) {
      const Element_view element = m_mesh->element(boundary_face.element());
      const Element_face& face = element.reference().faces[boundary_face.local_index()];
      const Face_vertices& vertices = boundary_face.vertices();
      if(box(vertices, face.size).squared_distance(p) > best.distance * best.distance)
        continue;
      Vec3 corners[4];
      for(int i = 0; i < face.size; ++i)
        corners[i] = m_points[vertices[i]] - p;
      const auto weights = internal::nearest_weights(corners, face.size);
      Vec3 offset{};
      for(int i = 0; i < face.size; ++i)
        offset = offset + weights[i] * corners[i];
      const double distance = norm(offset);
      if(!(distance < best.distance))
        continue;
      // Only the vertices of a face count for a point on the face, with the weights of the face.
      best = {};
      best.element = boundary_face.element();
      best.distance = distance;
      for(int i = 0; i < face.size; ++i) {
        const int v = face.vertices[i];
        best.weights[v] = weights[i];
        for(int k = 0; k < 3; ++k)
          best.coordinates[k] += weights[i] * element.reference().coordinates[v][k];
      }
    }
    return best;
  }
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_ELEMENT_LOCATOR_3_H
