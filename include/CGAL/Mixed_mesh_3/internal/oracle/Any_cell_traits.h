// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cell traits whose type is not known: the method is compiled once for all.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_CELL_TRAITS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_CELL_TRAITS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Lattice_point.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>

#include <type_traits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The coarsest level whose cells have all lattice planes that lie on the surface, and whether all cells
/// shall have that level.
struct Lattice_on_surface
{
  int level = 0;
  bool is_uniform = false;
};

/// A model of `OctreeCellTraits_3` as the octree sees it. Only domain and region see the cells themselves.
class Any_cell_traits
{
public:
  using Point_3 = Predicates_kernel::Point_3;

  virtual ~Any_cell_traits() = default;
  virtual Point_3 point(const Lattice_point& p) const = 0;
  virtual Lattice_on_surface lattice_on_surface() const = 0;
};

/// Cell traits that the caller keeps.
template <class CellTraits>
class Cell_traits_reference final : public Any_cell_traits
{
  const CellTraits& m_traits;

public:
  explicit Cell_traits_reference(const CellTraits& traits) : m_traits(traits) {}

  Point_3 point(const Lattice_point& p) const override { return m_traits.point(p); }

  Lattice_on_surface lattice_on_surface() const override
  {
    if constexpr(std::is_same_v<CellTraits, Axis_aligned_octree_cell_traits_3>)
      return {m_traits.level_on_surface(), m_traits.is_uniform()};
    else
      return {};
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_CELL_TRAITS_H
