// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells that are too large for the layers that subdomains form.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_LAYER_CELLS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_LAYER_CELLS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Function object that tells whether a leaf that meets a surface is too large for the subdomains there: a line
from the point of the surface that is nearest to a point of the cell, at right angles to the surface, leads
through a layer of a subdomain, or of the outside, within half the length of an edge of the cell. The middle
of a layer is as far from its surfaces as half of it is thick; not so between surfaces that meet at a large
angle, where smaller cells would be too large as well.
*/
class Layer_finder
{
  using Node_index = Octree::Node_index;

  const Located_octree& m_octree;
  std::unordered_map<std::uint64_t, bool> m_is_thin_at; // corners of leaves are mostly common to four leaves

  // Points of a line, in edges: 1/8 apart, up to 1/2. The first one is in the subdomain
  // behind the surface, unless that is thinner than 1/20.
  static constexpr double first_share = 0.05, more_shares[] = {0.125, 0.25, 0.375, 0.5};

public:
  explicit Layer_finder(const Located_octree& octree) : m_octree(octree) {}

  /// \pre all leaves have the same level
  bool operator()(Node_index n)
  {
    const Lattice_point& first = m_octree.octree().corner(n);
    const std::uint32_t half = m_octree.octree().side(n) / 2;
    if(is_thin(n, {first[0] + half, first[1] + half, first[2] + half}))
      return true;
    for(std::uint32_t i = 0; i < 8; ++i) {
      const Lattice_point corner{first[0] + (i & 1) * 2 * half, first[1] + (i >> 1 & 1) * 2 * half,
                                 first[2] + (i >> 2) * 2 * half};
      const auto [known, is_new] = m_is_thin_at.try_emplace(lattice_key(corner), false);
      if(is_new)
        known->second = is_thin(n, corner);
      if(known->second)
        return true;
    }
    return false;
  }

private:
  bool is_thin(Node_index n, const Lattice_point& lattice_point) const
  {
    const auto point = m_octree.point(lattice_point);
    const Vec3 p = to_vec3(point),
               q = to_vec3(m_octree.domain().closest_point(point, m_octree.surface_part(n)));
    const double distance = norm(p - q), edge = m_octree.edge_length(n);
    if(!(distance > 1e-9 * edge && distance < edge))
      return false;
    const Vec3 normal = (edge / distance) * (p - q);
    return leads_through_layer(n, q, normal) || leads_through_layer(n, q, -1 * normal);
  }

  bool leads_through_layer(Node_index n, const Vec3& q, const Vec3& line) const
  {
    // Cosine of 45 degrees: surfaces that meet at a larger angle have no layer between them.
    constexpr double least_ratio = 0.7;
    constexpr int bisections = 4;
    const auto rank = [&](double share) { return m_octree.subdomain_rank(q + share * line); };
    const Subdomain_rank first = rank(first_share);
    const double* end = std::find_if(std::begin(more_shares), std::end(more_shares),
                                     [&](double share) { return rank(share) != first; });
    if(end == std::end(more_shares))
      return false;
    double low = end == std::begin(more_shares) ? first_share : *(end - 1), high = *end;
    for(int i = 0; i < bisections; ++i) {
      const double middle = (low + high) / 2;
      (rank(middle) == first ? low : high) = middle;
    }
    const Vec3 middle = q + low / 2 * line;
    const auto closest = m_octree.domain().closest_point(Any_domain::Point_3(middle[0], middle[1], middle[2]),
                                                         m_octree.surface_part(n));
    return norm(to_vec3(closest) - middle) >= least_ratio * low / 2 * norm(line);
  }
};

/// The leaves of a level that meet a surface and are chosen.
template <class Is_chosen>
std::vector<Octree::Node_index> leaves_at_surface(const Located_octree& octree, int level,
                                                  Is_chosen&& is_chosen)
{
  std::vector<Octree::Node_index> leaves;
  for(Octree::Node_index n : octree.leaves_to_refine(level, false))
    if(octree.side(n) == ON_BOUNDARY && is_chosen(n))
      leaves.push_back(n);
  return leaves;
}

/*!
Splits cells that are too large for layers, the largest first, level by level, as long as there are not too
many cells.

\param most number of cells
\return whether no cell is too large in the end
*/
inline bool split_layer_cells(Located_octree& octree, std::size_t most)
{
  for(int level = 0; level < Octree::max_level; ++level) {
    Layer_finder is_too_large(octree);
    const std::vector<Octree::Node_index> leaves = leaves_at_surface(octree, level, is_too_large);
    if(leaves.empty())
      continue;
    Located_octree trial = octree;
    trial.refine(leaves);
    if(trial.number_of_cells() > most)
      return false;
    octree = std::move(trial);
  }
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_LAYER_CELLS_H
