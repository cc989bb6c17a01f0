// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Domains whose surface lies in planes perpendicular to the axes: the planes cut space into boxes, each of
// which is inside or outside as a whole.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_BOXES_BETWEEN_PLANES_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_BOXES_BETWEEN_PLANES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
The boxes between planes perpendicular to the axes. A grid divides each slab, which is the space between two
planes that follow each other on an axis, into layers of one width. A cell of the grid is a box, too.
*/
class Boxes_between_planes
{
public:
  using Slab_index = std::array<std::size_t, 3>;            // of a box: its slab on each axis
  using Layers = std::array<std::vector<std::uint32_t>, 3>; // of a grid: number of layers of each slab

  /// \param planes at least two for each axis
  /// \param domain model of `MixedMeshDomain_3`
  template <class Domain>
  Boxes_between_planes(const Axis_parallel_planes& planes, const Domain& domain)
  {
    for(std::size_t k = 0; k < 3; ++k)
      for(const auto& [coordinate, area] : planes[k]) {
        m_planes[k].push_back(coordinate);
        m_area += area;
      }
    m_is_inside.resize(number_of_slabs(0) * number_of_slabs(1) * number_of_slabs(2));
    locate(domain, {0, 0, 0}, {number_of_slabs(0), number_of_slabs(1), number_of_slabs(2)},
           domain.surface_part());
  }

  std::size_t number_of_slabs(std::size_t k) const { return m_planes[k].size() - 1; }
  double plane(std::size_t k, std::size_t i) const { return m_planes[k][i]; }
  double width(std::size_t k, std::size_t slab) const { return m_planes[k][slab + 1] - m_planes[k][slab]; }
  double extent(std::size_t k) const { return m_planes[k].back() - m_planes[k].front(); }

  double volume() const
  {
    double sum = 0;
    for_each_box_inside(
      [&](const Slab_index& b) { sum += width(0, b[0]) * width(1, b[1]) * width(2, b[2]); });
    return sum;
  }

  /// The mean thickness: that of a wide plate of the same volume and area.
  double thickness() const { return 2 * volume() / m_area; }

  /// Whether the boundary of the boxes inside is a manifold: around each vertex of a box, the boxes inside
  /// follow each other by faces, and so do those outside.
  bool is_manifold() const
  {
    for(std::size_t z = 0; z <= number_of_slabs(2); ++z)
      for(std::size_t y = 0; y <= number_of_slabs(1); ++y)
        for(std::size_t x = 0; x <= number_of_slabs(0); ++x)
          if(!is_manifold_at({x, y, z}))
            return false;
    return true;
  }

  /// The number of vertices of the cells inside.
  double number_of_vertices(const Layers& layers) const
  {
    // Vertices are in boxes, and in the faces, edges and vertices of boxes: on each axis, in a slab if the
    // position is odd, else in a plane.
    const auto positions = [&](std::size_t k) { return 2 * number_of_slabs(k) + 1; };
    const auto number = [&](std::size_t k, std::size_t p) { return p % 2 ? layers[k][p / 2] - 1. : 1.; };
    double sum = 0;
    for(std::size_t z = 0; z < positions(2); ++z)
      for(std::size_t y = 0; y < positions(1); ++y)
        for(std::size_t x = 0; x < positions(0); ++x)
          if(const double n = number(0, x) * number(1, y) * number(2, z); n > 0 && meets_inside({x, y, z}))
            sum += n;
    return sum;
  }

  /// The largest ratio of the edges of a cell inside.
  double largest_ratio(const Layers& layers) const
  {
    double ratio = 1;
    for_each_box_inside([&](const Slab_index& b) {
      const auto edge = [&](std::size_t k) { return width(k, b[k]) / layers[k][b[k]]; };
      const auto [least, most] = std::minmax({edge(0), edge(1), edge(2)});
      ratio = (std::max)(ratio, most / least);
    });
    return ratio;
  }

private:
  std::array<std::vector<double>, 3> m_planes;
  std::vector<char> m_is_inside;
  double m_area = 0; // of the surface

  std::size_t number(const Slab_index& b) const
  {
    return b[0] + number_of_slabs(0) * (b[1] + number_of_slabs(1) * b[2]);
  }

  bool is_inside(const Slab_index& b) const { return m_is_inside[number(b)]; }

  template <class F>
  void for_each_box_inside(const F& f) const
  {
    for(std::size_t z = 0; z < number_of_slabs(2); ++z)
      for(std::size_t y = 0; y < number_of_slabs(1); ++y)
        for(std::size_t x = 0; x < number_of_slabs(0); ++x)
          if(is_inside({x, y, z}))
            f({x, y, z});
  }

  // Whether the boxes around a vertex that are inside, and those outside, are connected by faces.
  bool is_manifold_at(const Slab_index& vertex) const
  {
    const auto is_inside_at = [&](unsigned octant) {
      Slab_index b;
      for(std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = vertex[k] + (octant >> k & 1);
        if(i == 0 || i > number_of_slabs(k))
          return false;
        b[k] = i - 1;
      }
      return is_inside(b);
    };
    unsigned sides[2] = {0, 0}; // sets of octants
    for(unsigned octant = 0; octant < 8; ++octant)
      sides[is_inside_at(octant)] |= 1u << octant;
    return is_connected(sides[0]) && is_connected(sides[1]);
  }

  // Whether a set of octants is connected by faces.
  static bool is_connected(unsigned octants)
  {
    unsigned reached = octants & (~octants + 1); // one of them
    for(int round = 0; round < 8; ++round)
      for(unsigned octant = 0; octant < 8; ++octant)
        if(reached >> octant & 1)
          for(unsigned k = 0; k < 3; ++k)
            reached |= octants & 1u << (octant ^ 1u << k);
    return reached == octants;
  }

  // Whether a box around that position is inside.
  bool meets_inside(const Slab_index& position) const
  {
    Slab_index first, last;
    for(std::size_t k = 0; k < 3; ++k) {
      first[k] = position[k] == 0 ? 0 : (position[k] - 1) / 2;
      last[k] = (std::min)(position[k] / 2, number_of_slabs(k) - 1);
    }
    for(std::size_t z = first[2]; z <= last[2]; ++z)
      for(std::size_t y = first[1]; y <= last[1]; ++y)
        for(std::size_t x = first[0]; x <= last[0]; ++x)
          if(is_inside({x, y, z}))
            return true;
    return false;
  }

  // The boxes from begin to end as a cell.
  Axis_aligned_octree_cell_traits_3::Cell cell(const Slab_index& begin, const Slab_index& end) const
  {
    double lower[3], upper[3], center[3];
    for(std::size_t k = 0; k < 3; ++k) {
      lower[k] = m_planes[k][begin[k]];
      upper[k] = m_planes[k][end[k]];
      center[k] = lower[k] + (upper[k] - lower[k]) / 2;
    }
    return {Bbox_3(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]),
            {center[0], center[1], center[2]}};
  }

  // Finds what is inside of the boxes from begin to end: they are halved until they are single ones, as far
  // as the surface meets them.
  template <class Domain>
  void locate(const Domain& domain, const Slab_index& begin, const Slab_index& end,
              const typename Domain::Surface_part& parent)
  {
    Slab_index sizes;
    for(std::size_t k = 0; k < 3; ++k)
      sizes[k] = end[k] - begin[k];
    const std::size_t longest = std::size_t(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    const auto boxes = cell(begin, end);
    typename Domain::Surface_part part;
    Bounded_side side = domain.locate(boxes, parent, part);
    if(side == ON_BOUNDARY && sizes[longest] == 1)
      side = domain.bounded_side(boxes.center(), part);
    if(side == ON_BOUNDARY) {
      Slab_index middle_end = end, middle_begin = begin;
      middle_end[longest] = middle_begin[longest] = begin[longest] + sizes[longest] / 2;
      locate(domain, begin, middle_end, part);
      locate(domain, middle_begin, end, part);
    } else if(side == ON_BOUNDED_SIDE) {
      for(std::size_t z = begin[2]; z < end[2]; ++z)
        for(std::size_t y = begin[1]; y < end[1]; ++y)
          for(std::size_t x = begin[0]; x < end[0]; ++x)
            m_is_inside[number({x, y, z})] = 1;
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_BOXES_BETWEEN_PLANES_H
