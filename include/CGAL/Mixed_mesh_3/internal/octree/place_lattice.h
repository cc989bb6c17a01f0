// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Octree lattices that lie on the surface: if all of the surface is parallel to planes of the axes, cells are
// placed and shaped such that the planes of the surface are lattice planes.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_PLACE_LATTICE_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_PLACE_LATTICE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/optional_members.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Finds cells for a domain whose surface lies in planes perpendicular to the axes.
class Lattice_placement
{
  // Bounds: cells are boxes of at most that ratio of edge lengths; planes are on the lattice up to rounding.
  static constexpr double largest_ratio = 1.25, accuracy = 1e-9;
  // Share of the largest number of vertices within the budget from which uniform cells are candidates: the
  // candidate nearest to a cube is taken.
  static constexpr double share_of_most = 0.7, margin = 1.05;
  // The share of the budget that the coarsest cells may take where others are split.
  static constexpr double share_of_coarsest = 0.25;

  using Numbers = std::array<std::uint32_t, 3>; // numbers of cells along each axis

  struct Choice
  {
    Numbers numbers;
    double ratio, vertices;
  };

  const Axis_parallel_planes& m_planes;
  const double m_volume;
  std::array<double, 3> m_extents, m_areas;

public:
  /// \param planes at least two for each axis
  Lattice_placement(const Axis_parallel_planes& planes, double volume) : m_planes(planes), m_volume(volume)
  {
    for(std::size_t k = 0; k < 3; ++k) {
      m_extents[k] = planes[k].rbegin()->first - planes[k].begin()->first;
      m_areas[k] = 0;
      for(const auto& [coordinate, area] : planes[k])
        m_areas[k] += area;
    }
  }

  /// Uniform cells that fill a budget of vertices as far as possible, or the coarsest ones.
  std::optional<Axis_aligned_octree_cell_traits_3> operator()(std::size_t budget, bool is_uniform) const
  {
    std::vector<Choice> choices;
    const double limit = double(budget) * (is_uniform ? 1 : share_of_coarsest);
    const double longest = (std::max)({m_extents[0], m_extents[1], m_extents[2]});
    double most = 0;
    for(std::uint32_t n = 1; estimate({longest / n, longest / n, longest / n}) <= 2 * limit; ++n)
      if(const auto choice = choose(longest / n); choice && choice->vertices <= limit) {
        choices.push_back(*choice);
        most = (std::max)(most, choice->vertices);
      }
    if(is_uniform)
      choices.erase(std::remove_if(choices.begin(), choices.end(),
                                   [&](const Choice& c) { return c.vertices < share_of_most * most; }),
                    choices.end());
    const auto best = std::min_element(choices.begin(), choices.end(), [&](const Choice& a, const Choice& b) {
      if(std::abs(a.ratio - b.ratio) > accuracy)
        return a.ratio < b.ratio;
      return is_uniform ? a.vertices > b.vertices : a.vertices < b.vertices;
    });
    if(best == choices.end())
      return {};
    return traits(best->numbers, is_uniform);
  }

private:
  // Number of vertices, exact for a box, and near enough for other shapes.
  double estimate(const std::array<double, 3>& h) const
  {
    double sum = 1 + m_volume / (h[0] * h[1] * h[2]);
    for(std::size_t k = 0; k < 3; ++k)
      sum += m_areas[k] * h[k] / (2 * h[0] * h[1] * h[2]) + m_extents[k] / h[k];
    const bool is_box = m_planes[0].size() + m_planes[1].size() + m_planes[2].size() == 6;
    return is_box ? std::round(sum) : margin * sum;
  }

  std::uint32_t position(std::size_t k, double coordinate, std::uint32_t n) const
  {
    return std::uint32_t(std::lround((coordinate - m_planes[k].begin()->first) / m_extents[k] * n));
  }

  bool are_on_lattice(std::size_t k, std::uint32_t n) const
  {
    return std::all_of(m_planes[k].begin(), m_planes[k].end(), [&](const auto& plane) {
      const double x = (plane.first - m_planes[k].begin()->first) / m_extents[k] * n;
      return std::abs(x - std::round(x)) <= accuracy * n;
    });
  }

  // The numbers of cells that are nearest to cubes of that side.
  std::optional<Choice> choose(double side) const
  {
    Choice choice{{0, 0, 0}, 1, 0};
    std::array<double, 3> h;
    for(std::size_t k = 0; k < 3; ++k) {
      double least = largest_ratio;
      for(const double n : {std::floor(m_extents[k] / side * (1 + accuracy)), std::ceil(m_extents[k] / side)})
        if(n >= 1 && are_on_lattice(k, std::uint32_t(n))) {
          const double r = m_extents[k] / (n * side), ratio = (std::max)(r, 1 / r);
          if(ratio <= least) {
            least = ratio;
            choice.numbers[k] = std::uint32_t(n);
          }
        }
      if(choice.numbers[k] == 0)
        return {};
      h[k] = m_extents[k] / choice.numbers[k];
    }
    choice.ratio = (std::max)({h[0], h[1], h[2]}) / (std::min)({h[0], h[1], h[2]});
    choice.vertices = estimate(h);
    if(choice.ratio > largest_ratio)
      return {};
    return choice;
  }

  std::optional<Axis_aligned_octree_cell_traits_3> traits(const Numbers& numbers, bool is_uniform) const
  {
    int level = 0;
    while((std::max)({numbers[0], numbers[1], numbers[2]}) > std::uint32_t(1) << level)
      ++level;
    const std::uint32_t side = lattice_root_side >> level;
    std::array<Axis_aligned_octree_cell_traits_3::Lattice_planes, 3> axes;
    for(std::size_t k = 0; k < 3; ++k)
      for(const auto& [coordinate, area] : m_planes[k]) {
        axes[k].emplace_back(side * position(k, coordinate, numbers[k]), coordinate);
        if(axes[k].size() > 1 && axes[k].back().first == axes[k][axes[k].size() - 2].first)
          return {}; // two planes are too near to each other to be told apart
      }
    return Axis_aligned_octree_cell_traits_3(axes, level, is_uniform);
  }
};

/// Cells whose planes lie on the surface if possible, else cells around the domain as the criteria say.
template <class Domain, class Region, class Criteria>
Axis_aligned_octree_cell_traits_3 cell_traits_of(const Domain& domain, const Region& region,
                                                 const Criteria& criteria)
{
  const Axis_aligned_octree_cell_traits_3 around(domain.bbox(), criteria.root_cell());
  if constexpr(Has_axis_parallel_planes<Domain>::value && Has_volume<Domain>::value) {
    const bool is_wanted = criteria.sharp_angle() > 0 && criteria.root_cell() == Root_cell::CUBE
                           && criteria.boundary_mode() == Boundary_mode::VERTEX_ORDER;
    const Axis_parallel_planes planes = is_wanted ? domain.axis_parallel_planes() : Axis_parallel_planes();
    const bool has_planes = planes[0].size() > 1 && planes[1].size() > 1 && planes[2].size() > 1;
    if(const double volume = has_planes ? domain.volume() : 0; volume > 0) {
      constexpr std::uint32_t side = lattice_root_side;
      auto part = region.surface_part();
      const bool is_everywhere = region.locate(around.cell({0, 0, 0}, side), region.surface_part(), part)
                                 == ON_BOUNDED_SIDE;
      const bool is_uniform = is_everywhere && criteria.base_level() == Criteria::automatic;
      if(const auto on_surface = Lattice_placement(planes, volume)(criteria.maximal_number_of_vertices(),
                                                                   is_uniform))
        return *on_surface;
    }
  }
  return around;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_PLACE_LATTICE_H
