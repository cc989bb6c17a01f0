// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A displacement outside of the mesh.

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_FADE_DISPLACEMENT_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_FADE_DISPLACEMENT_H

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Lower_envelope.h>
#include <CGAL/Mixed_mesh_image_3/internal/rasterize_displacement.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The voxels that are at most a distance from a voxel in the mesh along each axis, and maybe more.
inline Voxel_range range_around_mesh(const Displacement_field_3& field, double distance)
{
  const Voxel_grid_3& grid = field.grid;
  Vec3 lower, upper, margin = voxel_spacing(grid);
  for(double& x : margin)
    x = distance / x;
  lower.fill(std::numeric_limits<double>::infinity());
  upper.fill(-std::numeric_limits<double>::infinity());
  const auto extend = [&](int axis, std::size_t i) {
    lower[axis] = (std::min)(lower[axis], double(i));
    upper[axis] = (std::max)(upper[axis], double(i));
  };
  for(std::size_t k = 0; k < grid.size[2]; ++k)
    for(std::size_t j = 0; j < grid.size[1]; ++j) {
      const auto row = field.is_in_mesh.begin() + std::ptrdiff_t(grid.offset(0, j, k));
      const auto end = row + std::ptrdiff_t(grid.size[0]), first = std::find(row, end, 1);
      if(first == end)
        continue;
      auto last = end;
      while(*--last == 0) {
      }
      extend(0, std::size_t(first - row));
      extend(0, std::size_t(last - row));
      extend(1, j);
      extend(2, k);
    }
  return voxel_range(grid, lower, upper, margin);
}

/// The nearest voxel in the mesh of each voxel of a range, as far as it is within a distance: in its row,
/// then in its plane, then anywhere.
class Nearest_voxels_in_mesh
{
public:
  struct Nearest
  {
    float squared_distance;
    std::uint32_t offset; // of the voxel in the mesh
  };

  static constexpr float far = std::numeric_limits<float>::infinity();

  Nearest_voxels_in_mesh(const Displacement_field_3& field, const Voxel_range& range, double distance)
    : m_field(field), m_range(range), m_spacing(voxel_spacing(field.grid)), m_limit(distance * distance)
  {
    for(std::size_t k = 0; k < 3; ++k)
      m_size[k] = range.last[k] - range.first[k];
    m_nearest.assign(std::size_t(m_size[0] * m_size[1] * m_size[2]), Nearest{far, 0});
    for_each_row([this](Nearest* row, std::size_t offset) { scan_row(row, offset); });
    sweep(1);
    sweep(2);
  }

  /// Calls `use(nearest, offset)` for each row: of its first voxel, and the offset of this voxel in the grid.
  template <class Use>
  void for_each_row(const Use& use)
  {
    for(std::ptrdiff_t k = 0; k < m_size[2]; ++k)
      for(std::ptrdiff_t j = 0; j < m_size[1]; ++j)
        use(&at(0, j, k),
            m_field.grid.offset(std::size_t(m_range.first[0]), std::size_t(m_range.first[1] + j),
                                std::size_t(m_range.first[2] + k)));
  }

  std::ptrdiff_t size_of_row() const { return m_size[0]; }

private:
  Nearest& at(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k)
  {
    return m_nearest[std::size_t(i + m_size[0] * (j + m_size[1] * k))];
  }

  void scan_row(Nearest* row, std::size_t offset) const
  {
    for(int direction = 0; direction < 2; ++direction) {
      std::ptrdiff_t seed = -1;
      for(std::ptrdiff_t a = 0; a < m_size[0]; ++a) {
        const std::ptrdiff_t i = direction == 0 ? a : m_size[0] - 1 - a;
        if(m_field.is_in_mesh[offset + std::size_t(i)])
          seed = i;
        const double d = m_spacing[0] * double(i - seed);
        if(seed >= 0 && d * d < row[i].squared_distance && d * d <= m_limit)
          row[i] = {float(d * d), std::uint32_t(offset + std::size_t(seed))};
      }
    }
  }

  // Finds nearer voxels along an axis, 1 or 2, by the lower envelope of the parabolas of a line.
  void sweep(int axis)
  {
    const int other = 3 - axis; // the other one of j and k
    const std::ptrdiff_t stride = axis == 1 ? m_size[0] : m_size[0] * m_size[1];
    const std::ptrdiff_t n = m_size[std::size_t(axis)];
    Lower_envelope envelope(m_spacing[axis]);
    std::vector<Nearest> line(static_cast<std::size_t>(n));
    for(std::ptrdiff_t b = 0; b < m_size[std::size_t(other)]; ++b)
      for(std::ptrdiff_t i = 0; i < m_size[0]; ++i) {
        Nearest* const first = axis == 1 ? &at(i, 0, b) : &at(i, b, 0);
        for(std::ptrdiff_t a = 0; a < n; ++a)
          line[std::size_t(a)] = first[a * stride];
        const auto value = [&line](std::ptrdiff_t a) { return line[std::size_t(a)].squared_distance; };
        // Voxels between voxels of the mesh do not change, and are not nearest to others.
        envelope.clear();
        for(std::ptrdiff_t a = 0; a < n; ++a)
          if(value(a) < far
             && !(value(a) == 0 && a > 0 && a + 1 < n && value(a - 1) == 0 && value(a + 1) == 0))
            envelope.add(a, value(a));
        if(envelope.is_empty())
          continue;
        envelope.for_each(0, n, [&](std::ptrdiff_t a, std::ptrdiff_t place, double d) {
          if(d < value(a))
            first[a * stride] = d <= m_limit ? Nearest{float(d), line[std::size_t(place)].offset}
                                             : Nearest{far, 0};
        });
      }
  }

  const Displacement_field_3& m_field;
  const Voxel_range m_range;
  const Vec3 m_spacing;
  const double m_limit; // of squared distances
  std::array<std::ptrdiff_t, 3> m_size;
  std::vector<Nearest> m_nearest;
};

/*!
Gives each voxel outside the mesh the vector of the nearest voxel in the mesh, times a factor that falls
smoothly from 1 to 0 over a distance.

Distances are measured along the axes of the grid as if these were at right angles.
\pre fewer than 2^32 voxels
\par Complexity
Linear in the number of voxels in a box around the mesh
*/
inline void fade_displacement(double distance, Displacement_field_3& field)
{
  using Nearest = Nearest_voxels_in_mesh::Nearest;
  CGAL_precondition(field.grid.number_of_voxels() <= std::numeric_limits<std::uint32_t>::max());
  const Voxel_range range = range_around_mesh(field, distance);
  if(!(distance > 0) || range.is_empty())
    return;
  Nearest_voxels_in_mesh voxels(field, range, distance);
  voxels.for_each_row([&](const Nearest* row, std::size_t offset) {
    for(std::ptrdiff_t i = 0; i < voxels.size_of_row(); ++i) {
      const Nearest& found = row[i];
      if(found.squared_distance == 0 || found.squared_distance == Nearest_voxels_in_mesh::far)
        continue;
      const double t = (std::min)(1., std::sqrt(double(found.squared_distance)) / distance);
      const float weight = float(1 - t * t * (3 - 2 * t));
      const std::array<float, 3>& u = field.vectors[found.offset];
      field.vectors[offset + std::size_t(i)] = {weight * u[0], weight * u[1], weight * u[2]};
    }
  });
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_FADE_DISPLACEMENT_H
