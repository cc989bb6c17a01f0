// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields of a mesh on the voxels of an image: in the elements, and fading outside.

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_RASTERIZE_DISPLACEMENT_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_RASTERIZE_DISPLACEMENT_H

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Isoparametric_map_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Quadratic_field.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// The voxels `first <= i < last` in each direction.
struct Voxel_range
{
  std::array<std::ptrdiff_t, 3> first, last;
  bool is_empty() const { return first[0] >= last[0] || first[1] >= last[1] || first[2] >= last[2]; }
};

// Indices between two bounds, wider by `margin`, in the grid.
inline Voxel_range voxel_range(const Voxel_grid_3& grid, const Vec3& lower, const Vec3& upper,
                               const Vec3& margin)
{
  Voxel_range range;
  for(int k = 0; k < 3; ++k) {
    const double size = double(grid.size[k]);
    range.first[k] = std::ptrdiff_t((std::max)(0., (std::min)(size, std::ceil(lower[k] - margin[k]))));
    range.last[k] = std::ptrdiff_t((std::max)(0., (std::min)(size, std::floor(upper[k] + margin[k]) + 1)));
  }
  return range;
}

/// Points of an element one after the other in a row, each found from the points before.
template <class Map>
class Row_of_locations
{
  const Map& m_map;
  std::array<Vec3, 3> m_last{}; // the last points, the nearest first
  int m_number_of_last = 0;
  std::array<Vec3, 3> m_inverse_rows{}; // inverse of the derivative, at one of the last points or before

  // The prediction from the polynomial through the last points.
  Vec3 prediction(const Vec3& start, const Vec3& step) const
  {
    switch(m_number_of_last) {
    case 0: return start;
    case 1: return m_last[0] + step;
    case 2: return 2. * m_last[0] - m_last[1];
    default: return 3. * (m_last[0] - m_last[1]) + m_last[2];
    }
  }

public:
  explicit Row_of_locations(const Map& map) : m_map(map) {}

  /// Forgets the last points: the next point is not next to them.
  void interrupt() { m_number_of_last = 0; }

  /// \param p point
  /// \param start reference coordinates if the map is affine
  /// \param step difference to the next point's
  std::optional<Vec3> locate(const Vec3& p, const Vec3& start, const Vec3& step)
  {
    // The error of reference coordinates is about the square of the last step: fields are floats. The error
    // of the simplified iteration is a part of the last step, a half for strongly curved elements.
    constexpr double accuracy = 1e-4, simplified_accuracy = 1e-6;
    if(m_map.is_affine())
      return m_map.inverse(p, start, accuracy);
    const Vec3 r = prediction(start, step);
    std::optional<Vec3> found = r;
    if(m_number_of_last == 0 || !m_map.improve(m_inverse_rows, p, *found, simplified_accuracy)) {
      found = m_map.inverse(p, r, accuracy);
      if(!found) {
        interrupt();
        return found;
      }
      m_inverse_rows = m_map.inverse_derivatives(*found);
    }
    m_last = {*found, m_last[0], m_last[1]};
    m_number_of_last = (std::min)(m_number_of_last + 1, 3);
    return found;
  }
};

/*!
Calls `visit(offset, p, r)` for the voxels whose centers p are in an element, with reference coordinates.

The voxels are visited row by row: where a row is in all half-spaces that contain the element, the map is
inverted, each voxel starting from the result for the voxel before.
\param map `Isoparametric_map_3` to indices of the grid
\param range voxels near the element
\param is_wanted `bool(offset)`: whether to visit a voxel
*/
template <class Map, class Is_wanted, class Visitor>
void for_each_voxel(const Map& map, const Voxel_range& range, const Voxel_grid_3& grid,
                    const Is_wanted& is_wanted, const Visitor& visit)
{
  const Half_spaces& faces = map.necessary_half_spaces();
  const Vec3 step = map.linear_inverse_of_vector({1, 0, 0});
  double slopes[6];
  for(int f = 0; f < faces.size; ++f)
    slopes[f] = dot(faces.rows[f].b, step);

  for(std::ptrdiff_t k = range.first[2]; k < range.last[2]; ++k)
    for(std::ptrdiff_t j = range.first[1]; j < range.last[1]; ++j) {
      const Vec3 start = map.linear_inverse({0, double(j), double(k)});
      double from = double(range.first[0]), to = double(range.last[0] - 1);
      for(int f = 0; f < faces.size; ++f) {
        const double value = faces.rows[f](start) + reference_tolerance;
        if(slopes[f] > 0)
          from = (std::max)(from, -value / slopes[f]);
        else if(slopes[f] < 0)
          to = (std::min)(to, -value / slopes[f]);
        else if(!(value >= 0))
          to = from - 1;
      }
      if(!(from <= to))
        continue;
      Row_of_locations<Map> row(map);
      for(std::size_t i = std::size_t(std::ceil(from)); double(i) <= to; ++i) {
        const std::size_t offset = grid.offset(i, std::size_t(j), std::size_t(k));
        if(!is_wanted(offset)) {
          row.interrupt();
          continue;
        }
        const Vec3 p{double(i), double(j), double(k)};
        if(const auto found = row.locate(p, start + double(i) * step, step))
          visit(offset, p, *found);
      }
    }
}

/// A vector transformed by the linear part of a map.
inline Vec3 transform_vector(const Affine_map_3& map, const Vec3& v)
{
  Vec3 result;
  for(int k = 0; k < 3; ++k)
    result[k] = dot({map[k][0], map[k][1], map[k][2]}, v);
  return result;
}

/// The voxels near an element: the voxels in the box of its vertices, extended by the displacement by
/// bubbles.
inline Voxel_range voxel_range(const Voxel_grid_3& grid, Element_kind kind, const Vec3* points,
                               const Vec3& extent = Vec3{})
{
  // Points are inside up to 1e-9 times the element (`reference_tolerance`): 1e-7 voxels if it is 100 wide.
  constexpr double margin = 1e-7;
  Vec3 lower = points[0], upper = points[0];
  for(int i = 1; i < reference_elements[kind].number_of_vertices; ++i)
    for(int k = 0; k < 3; ++k) {
      lower[k] = (std::min)(lower[k], points[i][k]);
      upper[k] = (std::max)(upper[k], points[i][k]);
    }
  return voxel_range(grid, lower, upper, extent + Vec3(margin, margin, margin));
}

/// A mesh and its displacement, with positions in indices of a grid.
struct Displaced_vertices
{
  std::vector<Vec3> before, after; // positions of the vertices
  std::vector<Vec3> displacements; // in millimeters
};

/*!
The field of the displacement on the voxels in the mesh, or the field that leads back.

\param elements elements of the mesh
\param is_used `bool(Element_index)`: whether an element is used
\param vertices vertices in indices of the field's grid
\param bubbles_of `std::optional<Bubbles>(Element_view)`: bubbles of the displacement, in millimeters
\param is_forward whether the field is to be the displacement, or the field that leads back
\param field field; the vectors of voxels in an element are set (the first of several elements), and their
`is_in_mesh`
*/
template <class Is_used, class Bubbles_of>
void rasterize_displacement(const Element_list& elements, const Is_used& is_used,
                            const Displaced_vertices& vertices, const Bubbles_of& bubbles_of, bool is_forward,
                            Displacement_field_3& field)
{
  const Affine_map_3 &to_world = field.grid.index_to_world, to_index = inverse(to_world);
  const auto is_free = [&field](std::size_t offset) { return field.is_in_mesh[offset] == 0; };
  for(std::size_t e = 0; e < elements.size(); ++e) {
    if(!is_used(Element_index(e)))
      continue;
    const Element_view element = elements[e];
    Vec3 before[8], after[8], displacements[8];
    for(int i = 0; i < element.size(); ++i) {
      before[i] = vertices.before[element[i]];
      after[i] = vertices.after[element[i]];
      displacements[i] = (is_forward ? 1. : -1.) * vertices.displacements[element[i]];
    }
    const std::optional<Bubbles> bubbles = bubbles_of(element);
    Bubbles in_grid{};
    if(bubbles && !is_forward)
      for(std::size_t i = 0; i < std::size_t(number_of_pairs(element.kind())); ++i)
        in_grid[i] = transform_vector(to_index, (*bubbles)[i]);
    const Voxel_range range = voxel_range(field.grid, element.kind(), is_forward ? before : after,
                                          bubble_extent(element.kind(), in_grid));
    if(range.is_empty())
      continue;
    with_kind(element.kind(), [&](auto kind) {
      using Map = Isoparametric_map_3<kind.value>;
      using Quadratic = Quadratic_field<kind.value>;
      const auto rasterize = [&](const auto& map, const auto& displacement) {
        for_each_voxel(map, range, field.grid, is_free,
                       [&](std::size_t offset, const Vec3& p, const Vec3& r) {
                         const Vec3 u = displacement(p, r);
                         field.vectors[offset] = {float(u[0]), float(u[1]), float(u[2])};
                         field.is_in_mesh[offset] = 1;
                       });
      };
      if(!bubbles) {
        const Element_field<kind.value> linear(displacements);
        rasterize(Map(is_forward ? before : after), [&](const Vec3&, const Vec3& r) { return linear(r); });
      } else if(is_forward) {
        const Quadratic quadratic(displacements, *bubbles);
        rasterize(Map(before), [&](const Vec3&, const Vec3& r) { return quadratic(r); });
      } else {
        const Map back(before); // cheaper than the displacement, which is quadratic
        rasterize(Isoparametric_map_3<kind.value, Quadratic>(after, in_grid),
                  [&](const Vec3& p, const Vec3& r) { return transform_vector(to_world, back(r) - p); });
      }
    });
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_RASTERIZE_DISPLACEMENT_H
