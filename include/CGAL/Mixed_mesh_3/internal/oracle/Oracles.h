// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ORACLES_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ORACLES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/oracle/Any_cell_traits.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_domain.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_region.h>

#include <memory>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The domain, region and cell traits that an octree asks.
struct Oracles
{
  std::shared_ptr<const Any_domain> domain;
  std::shared_ptr<const Any_region> region;
  std::shared_ptr<const Any_cell_traits> cell_traits;
};

/// The oracles of models of the concepts, which the caller keeps.
template <class Domain, class Region, class CellTraits>
Oracles oracles_of(const Domain& domain, const Region& region, const CellTraits& traits)
{
  return {std::make_shared<const Domain_reference<Domain, CellTraits>>(domain, traits),
          std::make_shared<const Region_reference<Region, CellTraits>>(region, traits),
          std::make_shared<const Cell_traits_reference<CellTraits>>(traits)};
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ORACLES_H
