// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves of vertices that keep elements valid and within a bound of quality: moves of the vertices of other
// elements are halved.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDED_MOVES_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDED_MOVES_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/aspect_ratio.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

class Bounded_moves
{
  static constexpr int largest_number_of_halvings = 8; // of a move: less than 1/256 of it is none

  const Element_list& m_elements;
  std::vector<double> m_bounds; // of the aspect-ratio coefficient of each element

public:
  /// \param elements kept by reference: must outlive the object
  /// \param bound of the aspect-ratio coefficient (ARC); that of an element above it may not grow.
  /// Infinity: none
  Bounded_moves(const Element_list& elements, const std::vector<Vec3>& points, double bound)
    : m_elements(elements)
  {
    for(Element_index e = 0; e < elements.size(); ++e)
      m_bounds.push_back((std::max)(bound, aspect_ratio(e, points)));
  }

  bool is_positive(Element_index e, const std::vector<Vec3>& points) const
  {
    return jacobian_sign(m_elements[e].kind(), positions(e, points)) == Jacobian_sign::POSITIVE;
  }

  /// The largest ARC.
  double worst_aspect_ratio(const std::vector<Vec3>& points) const
  {
    double worst = 0;
    for(Element_index e = 0; e < m_elements.size(); ++e)
      worst = (std::max)(worst, aspect_ratio(e, points));
    return worst;
  }

  /// The points after as much of the moves as is possible.
  /// \pre elements are positive and within their bounds at `points`
  std::vector<Vec3> moved(const std::vector<Vec3>& points, std::vector<Vec3> moves) const
  {
    std::vector<Vec3> result = points;
    std::vector<int> halvings(points.size(), 0);
    std::vector<bool> is_changed(points.size(), true); // since its elements were looked at
    for(bool is_done = false; !is_done;) {
      for(std::size_t v = 0; v < points.size(); ++v)
        if(is_changed[v])
          result[v] = points[v] + moves[v];
      std::vector<bool> is_bad(points.size(), false); // whether an element of the vertex is
      is_done = true;
      for(Element_index e = 0; e < m_elements.size(); ++e) {
        const Element_view element = m_elements[e];
        const auto any = [&element](const auto& f) { return std::any_of(element.begin(), element.end(), f); };
        if(any([&](Vertex_index v) { return is_changed[v]; })
           && any([&](Vertex_index v) { return result[v] != points[v]; }) && !is_good(e, result)) {
          is_done = false;
          for(Vertex_index v : element)
            is_bad[v] = true;
        }
      }
      for(std::size_t v = 0; v < points.size(); ++v) {
        is_changed[v] = is_bad[v] && moves[v] != Vec3{};
        if(is_changed[v])
          moves[v] = ++halvings[v] > largest_number_of_halvings ? Vec3{} : 0.5 * moves[v];
      }
    }
    return result;
  }

private:
  std::array<std::array<double, 3>, 8> positions(Element_index e, const std::vector<Vec3>& points) const
  {
    std::array<std::array<double, 3>, 8> result{};
    for(int a = 0; a < m_elements[e].size(); ++a)
      result[std::size_t(a)] = points[m_elements[e][a]];
    return result;
  }

  double aspect_ratio(Element_index e, const std::vector<Vec3>& points) const
  {
    return aspect_ratio_coefficient(m_elements[e].kind(), relative_points(m_elements[e], [&](Vertex_index v) {
                                      return points[v];
                                    }));
  }

  bool is_good(Element_index e, const std::vector<Vec3>& points) const
  {
    return is_positive(e, points)
           && (!std::isfinite(m_bounds[e])
               || is_aspect_ratio_at_most(m_elements[e].kind(), positions(e, points), m_bounds[e]));
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDED_MOVES_H
