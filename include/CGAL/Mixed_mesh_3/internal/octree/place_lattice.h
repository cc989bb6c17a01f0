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
#include <CGAL/Mixed_mesh_3/internal/octree/Boxes_between_planes.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/refinements.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Finds cells for a domain whose surface lies in planes perpendicular to the axes: each slab between two
/// planes gets layers of one width.
class Lattice_placement
{
  // Edges whose ratios differ by less are taken as equal: ratios have rounding errors, of 2^-53 times the
  // ratio of coordinates to edges, which may be a million.
  static constexpr double accuracy = 1e-9;
  // Share of the largest number of vertices within the budget from which uniform cells are candidates: the
  // candidate nearest to a cube is taken. Of 17 meshes of surfaces in planes, 0.35 changes none; 0.9 changes
  // two, those of a plate: its cells are 1.1 and 1.15 times as long as wide, not cubes.
  static constexpr double share_of_most = 0.7;
  // The share of the budget that the coarsest cells may take where others are split. Of 15 meshes with base
  // level 3, 0.1 loses one, of a frame; with 0.6, two others change, and a plate with 9 holes gets one more.
  static constexpr double share_of_coarsest = 0.25;

  using Layers = Boxes_between_planes::Layers;

  struct Choice
  {
    Layers layers;
    double ratio, vertices;
  };

  const Boxes_between_planes& m_boxes;

public:
  explicit Lattice_placement(const Boxes_between_planes& boxes) : m_boxes(boxes) {}

  /// Uniform cells that fill a budget of vertices as far as possible, or the coarsest ones.
  /// \param largest_ratio of the edges of a cell
  std::optional<Axis_aligned_octree_cell_traits_3> operator()(std::size_t budget, bool is_uniform,
                                                              double largest_ratio) const
  {
    std::vector<Choice> choices;
    const double limit = double(budget) * (is_uniform ? 1 : share_of_coarsest);
    const double longest = (std::max)({m_boxes.extent(0), m_boxes.extent(1), m_boxes.extent(2)});
    double most = 0;
    for(std::uint32_t n = 1; n < lattice_root_side; ++n) {
      const Choice choice = choose(longest / n);
      if(choice.vertices > limit)
        break;
      if(choice.ratio <= largest_ratio * (1 + accuracy)) {
        choices.push_back(choice);
        most = (std::max)(most, choice.vertices);
      }
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
    return traits(best->layers, is_uniform);
  }

private:
  // The layers that are nearest to those of cubes of that side.
  Choice choose(double side) const
  {
    Choice choice;
    for(std::size_t k = 0; k < 3; ++k)
      for(std::size_t i = 0; i < m_boxes.number_of_slabs(k); ++i) {
        const double exact = m_boxes.width(k, i) / side;
        const double few = (std::max)(std::floor(exact * (1 + accuracy)), 1.);
        // Of n and n + 1 layers, the ratios to the side are the same at the geometric mean.
        choice.layers[k].push_back(std::uint32_t(exact * exact > few * (few + 1) ? few + 1 : few));
      }
    choice.ratio = m_boxes.largest_ratio(choice.layers);
    choice.vertices = m_boxes.number_of_vertices(choice.layers);
    return choice;
  }

  std::optional<Axis_aligned_octree_cell_traits_3> traits(const Layers& layers, bool is_uniform) const
  {
    std::uint32_t most = 0;
    for(const std::vector<std::uint32_t>& l : layers)
      most = (std::max)(most, std::accumulate(l.begin(), l.end(), std::uint32_t(0)));
    int level = 0;
    while(most > std::uint32_t(1) << level)
      ++level;
    if(level > deepest_octree_level)
      return {};
    const std::uint32_t side = lattice_root_side >> level;
    std::array<Axis_aligned_octree_cell_traits_3::Lattice_planes, 3> axes;
    for(std::size_t k = 0; k < 3; ++k) {
      std::uint32_t position = 0;
      axes[k].emplace_back(position, m_boxes.plane(k, 0));
      for(std::size_t i = 0; i < layers[k].size(); ++i)
        axes[k].emplace_back(position += side * layers[k][i], m_boxes.plane(k, i + 1));
    }
    return Axis_aligned_octree_cell_traits_3(axes, level, is_uniform);
  }
};

/// The largest ratio of the edges of cells that are split: templates make elements worse than their cells.
constexpr double largest_ratio_of_split_cells = 1.25;

/// Walls are thin for a budget if the cube that a vertex has to serve has an edge of more than that many
/// times their thickness: then a layer of cells between both sides of a wall is 2.6 times as wide as the wall
/// is thick, and tetrahedra within the usual bounds of quality hardly fit into it.
constexpr double least_edge_of_thin_walls = 1.5;

/// The largest number of boxes between planes that are looked at: 64 layers along each axis.
constexpr std::size_t most_boxes_between_planes = 1 << 18;

/// Cells whose planes lie on the surface if possible, else cells around the domain as the criteria say.
template <class Domain, class Region, class Criteria>
Axis_aligned_octree_cell_traits_3 cell_traits_of(const Domain& domain, const Region& region,
                                                 const Criteria& criteria)
{
  const Axis_aligned_octree_cell_traits_3 around(domain.bbox(), criteria.root_cell());
  if constexpr(has_features<Domain>()) {
    const bool is_wanted = criteria.sharp_angle() > 0 && criteria.root_cell() == Root_cell::CUBE
                           && criteria.boundary_mode() == Boundary_mode::VERTEX_ORDER;
    const Axis_parallel_planes planes = is_wanted ? domain.axis_parallel_planes() : Axis_parallel_planes();
    const bool has_planes = planes[0].size() > 1 && planes[1].size() > 1 && planes[2].size() > 1;
    double number_of_boxes = 1;
    for(const auto& p : planes)
      number_of_boxes *= double(p.size()) - 1;
    if(has_planes && number_of_boxes <= most_boxes_between_planes) {
      constexpr std::uint32_t side = lattice_root_side;
      constexpr double infinity = std::numeric_limits<double>::infinity();
      auto part = region.surface_part();
      const bool is_everywhere = region.locate(around.cell({0, 0, 0}, side), region.surface_part(), part)
                                 == ON_BOUNDED_SIDE;
      const bool is_uniform = is_everywhere && criteria.base_level() == Criteria::automatic;
      // The aspect-ratio coefficient of a box is the ratio of its edges.
      const double largest_ratio = is_uniform
                                     ? (std::min)(criteria.quality_bound(),
                                                  Mixed_mesh_optimization_criteria_3::default_quality_bound)
                                     : largest_ratio_of_split_cells;
      const Boxes_between_planes boxes(planes, domain);
      const double volume = boxes.volume();
      const std::size_t budget = criteria.maximal_number_of_vertices();
      const bool needs_flatter = is_uniform && !criteria.is_quality_bound_strict()
                                 && std::cbrt(volume / double(budget))
                                      > least_edge_of_thin_walls * boxes.thickness();
      if(volume > 0 && boxes.is_manifold())
        for(const double ratio : {largest_ratio, needs_flatter ? infinity : 0})
          if(const auto on_surface = Lattice_placement(boxes)(budget, is_uniform, ratio))
            return *on_surface;
    }
  }
  return around;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_PLACE_LATTICE_H
