// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a surface in a cell, as a domain or a region knows it, whatever the type of the part is.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_SURFACE_PART_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_SURFACE_PART_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/enum.h>

#include <memory>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A part that never changes, and that copies of the octree share; null where there is none.
using Surface_part = std::shared_ptr<const void>;

template <class Part>
Surface_part make_surface_part(Part part)
{
  return std::make_shared<const Part>(std::move(part));
}

/// Returns a part as its type. \pre `part` was made of a `Part`
template <class Part>
const Part& surface_part_as(const Surface_part& part)
{
  return *static_cast<const Part*>(part.get());
}

/// Asks a model of `MixedMeshDomain_3` or `MixedMeshRegion_3` for the location of a cell.
/// \param parent the part of a cell that contains this one
/// \param part becomes the part of the cell if the cell meets the surface, or if the cell is inside and
/// `has_part_inside`; else null
template <class Model, class Cell>
Bounded_side locate_cell(const Model& model, const Cell& cell, const Surface_part& parent, Surface_part& part,
                         bool has_part_inside)
{
  using Part = typename Model::Surface_part;
  Part mine{};
  const Bounded_side side = model.locate(cell, surface_part_as<Part>(parent), mine);
  if(side == ON_BOUNDARY || (side == ON_BOUNDED_SIDE && has_part_inside))
    part = make_surface_part(std::move(mine));
  else
    part.reset();
  return side;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_SURFACE_PART_H
