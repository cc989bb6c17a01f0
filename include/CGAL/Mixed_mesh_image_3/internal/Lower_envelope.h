// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances along a line of voxels.

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LOWER_ENVELOPE_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LOWER_ENVELOPE_H

#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
The place q with the least `(spacing (i - q))^2 + g(q)`, for each line of values g: the lower envelope of
parabolas (Felzenszwalb, Huttenlocher: "Distance transforms of sampled functions", 2012).
*/
class Lower_envelope
{
  std::vector<std::ptrdiff_t> m_places;
  std::vector<double> m_values, m_starts; // parabola n is lowest from m_starts[n] on
  double m_squared_spacing;

public:
  explicit Lower_envelope(double spacing) : m_squared_spacing(spacing * spacing) {}

  void clear()
  {
    m_places.clear();
    m_values.clear();
    m_starts.clear();
  }

  bool is_empty() const { return m_places.empty(); }

  // Adds a parabola, in ascending order of places.
  void add(std::ptrdiff_t place, double value)
  {
    double start = -std::numeric_limits<double>::infinity();
    while(!m_places.empty()) {
      const double last = double(m_places.back()), p = double(place);
      start = (p + last) / 2 + (value - m_values.back()) / (2 * m_squared_spacing * (p - last));
      if(start > m_starts.back())
        break;
      m_places.pop_back();
      m_values.pop_back();
      m_starts.pop_back();
      start = -std::numeric_limits<double>::infinity();
    }
    m_places.push_back(place);
    m_values.push_back(value);
    m_starts.push_back(start);
  }

  /// Calls `visit(i, place, value)` for `first <= i < last` with the least value.
  template <class Visitor>
  void for_each(std::ptrdiff_t first, std::ptrdiff_t last, const Visitor& visit) const
  {
    std::size_t n = 0;
    for(std::ptrdiff_t i = first; i < last; ++i) {
      while(n + 1 < m_starts.size() && m_starts[n + 1] < double(i))
        ++n;
      const double d = double(i - m_places[n]);
      visit(i, m_places[n], m_squared_spacing * d * d + m_values[n]);
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_LOWER_ENVELOPE_H
