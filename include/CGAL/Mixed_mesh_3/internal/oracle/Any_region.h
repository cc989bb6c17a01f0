// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A region whose type is not known: the method is compiled once for all.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_REGION_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_REGION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Lattice_point.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Surface_part.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/weight_in_region.h>

#include <CGAL/enum.h>

#include <cstdint>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A model of `MixedMeshRegion_3`, asked for the cells of an octree by their positions on the lattice.
class Any_region
{
public:
  using Point_3 = Predicates_kernel::Point_3;

  virtual ~Any_region() = default;
  virtual Surface_part surface_part() const = 0;
  /// \param parent the part of a cell that contains this one
  /// \param part becomes the part of the cell if the answer is `ON_BOUNDARY`, else null
  virtual Bounded_side locate(const Lattice_point& corner, std::uint32_t side, const Surface_part& parent,
                              Surface_part& part) const = 0;
  virtual double depth(const Point_3& p) const = 0;
  /// The weight of an error at a point, without the factor for the distance from the region.
  virtual double weight(const Point_3& p, double reach) const = 0;
};

/// A region and cell traits that the caller keeps.
template <class Region, class CellTraits>
class Region_reference final : public Any_region
{
  const Region& m_region;
  const CellTraits& m_traits;

public:
  Region_reference(const Region& region, const CellTraits& traits) : m_region(region), m_traits(traits) {}

  Surface_part surface_part() const override { return make_surface_part(m_region.surface_part()); }

  Bounded_side locate(const Lattice_point& corner, std::uint32_t side, const Surface_part& parent,
                      Surface_part& part) const override
  {
    return locate_cell(m_region, m_traits.cell(corner, side), parent, part, false);
  }

  double depth(const Point_3& p) const override { return m_region.depth(p); }
  double weight(const Point_3& p, double reach) const override
  {
    return weight_in_region(m_region, p, reach);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_REGION_H
