// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The octree of a domain: each node knows where it is relative to the domain and to the region.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_LOCATED_OCTREE_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_LOCATED_OCTREE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/balance.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Oracles.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/enum.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
A balanced octree whose nodes are located in the domain and in the region of interest. Children of a node that
does not meet a surface inherit its side; children of a node that meets a surface look at the parent's part of
the surface only.

Copies share the domain, the region and the cell traits.
*/
class Located_octree
{
public:
  using Node_index = Octree::Node_index;
  using Point_3 = Any_cell_traits::Point_3;

  explicit Located_octree(Oracles oracles) : m_oracles(std::move(oracles))
  {
    m_domain_parts.push_back(m_oracles.domain->surface_part());
    m_region_parts.push_back(m_oracles.region->surface_part());
    m_locations.push_back({ON_BOUNDARY, ON_BOUNDARY, 0, 0});
    const Point_3 p = m_oracles.cell_traits->point({0, 0, 0}),
                  q = m_oracles.cell_traits->point({Octree::root_side, Octree::root_side, Octree::root_side});
    m_diagonal = std::hypot(q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
    locate(Octree::root(), m_locations[0]);
  }

  /// Constructs an octree from models of the concepts, which the caller keeps.
  template <class Domain, class Region, class CellTraits>
  Located_octree(const Domain& domain, const Region& region, const CellTraits& traits)
    : Located_octree(oracles_of(domain, region, traits))
  {
  }

  const Octree& octree() const { return m_octree; }
  const Any_domain& domain() const { return *m_oracles.domain; }
  const Any_region& region() const { return *m_oracles.region; }
  const Any_cell_traits& cell_traits() const { return *m_oracles.cell_traits; }

  /// The side of all points of the cell, or `ON_BOUNDARY` if the cell meets the surface of the domain.
  Bounded_side side(Node_index n) const { return Bounded_side(m_locations[n].domain); }
  /// Whether the cell meets the domain. Only such cells are refined or become elements.
  bool meets_domain(Node_index n) const { return side(n) != ON_UNBOUNDED_SIDE; }
  bool is_in_region(Node_index n) const { return m_locations[n].region != ON_UNBOUNDED_SIDE; }
  /// Whether all of the root is inside the region: there is no region then.
  bool is_region_everywhere() const { return m_locations[0].region == ON_BOUNDED_SIDE; }
  /// Whether a lattice point of a leaf is in the region.
  bool is_in_region(const Lattice_point& p, Node_index leaf) const
  {
    return m_locations[leaf].region == ON_BOUNDED_SIDE
           || (m_locations[leaf].region == ON_BOUNDARY
               && m_oracles.region->depth(m_oracles.cell_traits->point(p)) >= 0);
  }
  /// The part of the domain's surface that meets the cell; null if the cell does not meet the surface, unless
  /// the cell is inside a labeled domain.
  const Surface_part& surface_part(Node_index n) const
  {
    const std::uint32_t part = m_locations[n].domain_part;
    return part != 0 ? m_domain_parts[part] : m_no_part;
  }

  /// The rank of the subdomain of a lattice point of a leaf, inside the domain.
  Subdomain_rank subdomain_rank(const Lattice_point& p, Node_index leaf) const
  {
    return subdomain_rank(m_oracles.cell_traits->point(p), leaf);
  }

  Point_3 point(const Lattice_point& p) const { return m_oracles.cell_traits->point(p); }

  /// The number of leaves that meet the domain.
  std::size_t number_of_cells() const
  {
    std::size_t count = 0;
    for(Node_index n = 0; n < m_octree.size(); ++n)
      count += m_octree.is_leaf(n) && meets_domain(n);
    return count;
  }

  /// The number of leaves that are inside the domain and do not meet its surface.
  std::size_t number_of_cells_inside() const
  {
    std::size_t count = 0;
    for(Node_index n = 0; n < m_octree.size(); ++n)
      count += m_octree.is_leaf(n) && side(n) == ON_BOUNDED_SIDE;
    return count;
  }

  /// A length in units of 2^-24 of the root, rounded: lengths that are equal but for rounding rarely
  /// differ, so that symmetric input does not depend on it.
  double quantized(double length) const
  {
    return std::floor(length * (std::ldexp(1., 24) / m_diagonal) + 0.3);
  }

  /// A length rounded like `quantized()`, in its own unit.
  double rounded(double length) const { return quantized(length) * std::ldexp(m_diagonal, -24); }

  /// The leaf around a point of the root.
  Node_index leaf_at(const Point_3& q) const
  {
    Node_index n = Octree::root();
    while(!m_octree.is_leaf(n))
      n = nearest_child(m_octree.child(n, 0), q);
    return n;
  }

  /// The side of any point: the side of its leaf, or the answer to a query if the leaf meets the surface.
  Bounded_side bounded_side(const Vec3& p) const
  {
    const Node_index n = leaf_around(p);
    return n == Octree::no_node     ? ON_UNBOUNDED_SIDE
           : side(n) != ON_BOUNDARY ? side(n)
                                    : domain().bounded_side(Point_3(p[0], p[1], p[2]), surface_part(n));
  }

  /// The rank of the subdomain of any point; that of the outside where no subdomain is.
  Subdomain_rank subdomain_rank(const Vec3& p) const
  {
    if(!domain().is_labeled())
      return bounded_side(p) == ON_BOUNDED_SIDE ? Subdomain_rank(0) : outside_rank;
    const Node_index n = leaf_around(p);
    return n != Octree::no_node && meets_domain(n) ? subdomain_rank(Point_3(p[0], p[1], p[2]), n)
                                                   : outside_rank;
  }

  /// The sibling of eight with the nearest center: the cell around a point, whatever the frame of the cells.
  Node_index nearest_child(Node_index first, const Point_3& q) const
  {
    Node_index nearest = first;
    double least = std::numeric_limits<double>::infinity();
    for(Node_index c = first; c < first + 8; ++c) {
      const double d = CGAL::squared_distance(center(c), q);
      if(d < least) {
        least = d;
        nearest = c;
      }
    }
    return nearest;
  }

  /// Splits leaves, then balances across faces and edges.
  template <class NodeRange>
  void refine(const NodeRange& nodes)
  {
    std::vector<Node_index> refined(std::begin(nodes), std::end(nodes));
    for(Node_index n : refined)
      split(n);
    balance(m_octree, refined, Adjacency::EDGE, [this](Node_index n) { split(n); });
    CGAL_assertion(are_balanced(m_octree, refined, Adjacency::EDGE));
  }

  /// Splits the nodes that are split in another octree with the same root.
  void refine_like(const Located_octree& other)
  {
    for(Node_index n = 0; n < other.m_octree.size(); ++n)
      if(!other.m_octree.is_leaf(n)) {
        const Node_index leaf = leaf_at(other.center(n));
        if(m_octree.level(leaf) <= other.m_octree.level(n))
          refine(std::vector<Node_index>{leaf});
      }
  }

  /// The level of the largest cells that meet both the region and the surface of the domain; the largest
  /// level if there are none.
  int level_of_surface_in_region() const
  {
    int level = Octree::max_level;
    for(Node_index n = 0; n < m_octree.size(); ++n)
      if(m_octree.is_leaf(n) && side(n) == ON_BOUNDARY && is_in_region(n))
        level = (std::min)(level, int(m_octree.level(n)));
    return level;
  }

  /// Undoes all splits but those that made the nodes below `size`.
  void truncate(std::size_t size)
  {
    m_octree.truncate(size);
    m_locations.resize(size);
  }

  /// The leaves of a level that meet the domain, and, with `in_region_only`, the region too.
  std::vector<Node_index> leaves_to_refine(int level, bool in_region_only) const
  {
    std::vector<Node_index> leaves;
    for(Node_index n = 0; n < m_octree.size(); ++n)
      if(m_octree.level(n) == level && m_octree.is_leaf(n) && meets_domain(n)
         && (!in_region_only || is_in_region(n)))
        leaves.push_back(n);
    return leaves;
  }

  /// Depth of the center of a cell in the region; negative outside.
  double depth_in_region(Node_index n) const { return m_oracles.region->depth(center(n)); }

  /// The weight of an error at the center of a cell, without the factor for the distance from the region.
  double weight_in_region(Node_index n, double reach) const
  {
    return m_oracles.region->weight(center(n), reach);
  }

  /// The volume of a cell of a level.
  double cell_volume(int level) const
  {
    const auto at = [this](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      return m_oracles.cell_traits->point({x, y, z});
    };
    constexpr std::uint32_t side = Octree::root_side;
    const auto o = at(0, 0, 0);
    return std::ldexp(std::abs(CGAL::determinant(at(side, 0, 0) - o, at(0, side, 0) - o, at(0, 0, side) - o)),
                      -3 * level);
  }

  /// The edge length of a cell; the root mean square where edges are not equal.
  double edge_length(Node_index n) const
  {
    return std::ldexp(m_diagonal / std::sqrt(3.), -m_octree.level(n));
  }

private:
  // The leaf around any point; none outside the box of the domain.
  Node_index leaf_around(const Vec3& p) const
  {
    const Bbox_3 box = domain().bbox();
    for(int k = 0; k < 3; ++k)
      if(!(box.min(k) <= p[k] && p[k] <= box.max(k)))
        return Octree::no_node;
    return leaf_at(Point_3(p[0], p[1], p[2]));
  }

  Subdomain_rank subdomain_rank(const Point_3& p, Node_index leaf) const
  {
    return domain().is_labeled()
             ? rank_of(domain().subdomain_indices(), domain().subdomain_index(p, surface_part(leaf)))
             : Subdomain_rank(0);
  }

  struct Location
  {
    std::int8_t domain, region;             // Bounded_side
    std::uint32_t domain_part, region_part; // 0: none
  };

  Point_3 center(Node_index n) const
  {
    const Lattice_point& corner = m_octree.corner(n);
    const std::uint32_t half = m_octree.side(n) / 2;
    return m_oracles.cell_traits->point({corner[0] + half, corner[1] + half, corner[2] + half});
  }

  void split(Node_index n)
  {
    const Node_index first = m_octree.split(n);
    for(Node_index c = first; c < first + 8; ++c) {
      m_locations.push_back(m_locations[n]);
      locate(c, m_locations.back());
    }
  }

  // Replaces the location of the parent by that of the cell.
  void locate(Node_index n, Location& l)
  {
    l.domain = locate(*m_oracles.domain, n, l.domain, l.domain_part, m_domain_parts);
    l.region = locate(*m_oracles.region, n, l.region, l.region_part, m_region_parts);
  }

  using Parts = std::vector<Surface_part>;

  template <class Oracle>
  std::int8_t locate(const Oracle& oracle, Node_index n, std::int8_t parent_side, std::uint32_t& part,
                     Parts& parts) const
  {
    if(parent_side != ON_BOUNDARY)
      return parent_side;
    Surface_part mine;
    const Bounded_side side = oracle.locate(m_octree.corner(n), m_octree.side(n), parts[part], mine);
    part = 0;
    if(mine) {
      part = std::uint32_t(parts.size());
      parts.push_back(std::move(mine));
    }
    return std::int8_t(side);
  }

  Oracles m_oracles;
  Octree m_octree;
  double m_diagonal; // diagonal of the root
  std::vector<Location> m_locations;
  Parts m_domain_parts, m_region_parts;
  Surface_part m_no_part;
};

/// The approximate volume of the domain: the cells inside, and half of the cells that meet the surface.
/// \param root the octree with nothing but its root
inline double volume_of_domain(const Located_octree& root)
{
  // With half and twice as many, three and two of seven meshes of 2,000 vertices differ, their largest
  // distances by 11 % at most.
  constexpr std::size_t sufficient_number = 500;
  Located_octree octree = root;
  for(int level = 0;; ++level) {
    const std::size_t inside = octree.number_of_cells_inside(), all = octree.number_of_cells();
    if(all >= sufficient_number || level == Octree::max_level)
      return 0.5 * double(inside + all) * octree.cell_volume(level);
    octree.refine(octree.leaves_to_refine(level, false));
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_LOCATED_OCTREE_H
