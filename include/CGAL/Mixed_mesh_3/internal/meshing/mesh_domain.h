// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The core works on doubles: one driver for all kernels of the user's mesh, and for domains and regions
// inside polyhedra one that can be compiled in advance.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Any_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Driver.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Core_mesh = Mixed_mesh_3<Predicates_kernel>;

/// Runs the driver.
template <class Domain, class Region, class CellTraits>
Mixed_mesh_result_3 mesh_domain(const Domain& domain, const Region& region,
                                const Mixed_mesh_criteria_3& criteria, const CellTraits& cell_traits,
                                Any_visitor& visitor, Core_mesh& mesh)
{
  return Driver<Domain, Region, CellTraits, Core_mesh, Any_visitor>(domain, region, criteria, cell_traits,
                                                                    visitor)(mesh);
}

/// As above: the case of nearly all users, to which those that follow lead.
Mixed_mesh_result_3 mesh_domain(const Labeled_polyhedral_mixed_mesh_domain_3& domain,
                                const Polyhedral_mixed_mesh_regions_3& regions,
                                const Mixed_mesh_criteria_3& criteria,
                                const Axis_aligned_octree_cell_traits_3& cell_traits, Any_visitor& visitor,
                                Core_mesh& mesh);

/// What the caller keeps.
template <class T>
std::shared_ptr<const T> without_owner(const T& t)
{
  return {&t, [](const T*) {}};
}

template <class T>
using Is_polyhedral_domain = std::disjunction<std::is_same<T, Polyhedral_mixed_mesh_domain_3>,
                                              std::is_same<T, Labeled_polyhedral_mixed_mesh_domain_3>>;
template <class T>
using Is_polyhedral_region = std::disjunction<std::is_same<T, Everywhere_mixed_mesh_region_3>,
                                              std::is_same<T, Polyhedral_mixed_mesh_region_3>,
                                              std::is_same<T, Polyhedral_mixed_mesh_regions_3>>;

inline Labeled_polyhedral_mixed_mesh_domain_3 as_labeled_domain(const Polyhedral_mixed_mesh_domain_3& domain)
{
  Labeled_polyhedral_mixed_mesh_domain_3 labeled;
  labeled.add(without_owner(domain), 1);
  return labeled;
}
inline const Labeled_polyhedral_mixed_mesh_domain_3&
as_labeled_domain(const Labeled_polyhedral_mixed_mesh_domain_3& domain)
{
  return domain;
}

inline Polyhedral_mixed_mesh_regions_3 as_regions(const Everywhere_mixed_mesh_region_3&) { return {}; }
inline Polyhedral_mixed_mesh_regions_3 as_regions(const Polyhedral_mixed_mesh_region_3& region)
{
  Polyhedral_mixed_mesh_regions_3 regions;
  regions.add(without_owner(region));
  return regions;
}
inline const Polyhedral_mixed_mesh_regions_3& as_regions(const Polyhedral_mixed_mesh_regions_3& regions)
{
  return regions;
}

/// Runs the driver, and hands the mesh over in the kernel of the user.
template <class Domain, class Region, class CellTraits, class Visitor, class GeomTraits>
Mixed_mesh_result_3 mesh_domain_as(const Domain& domain, const Region& region,
                                   const Mixed_mesh_criteria_3& criteria, const CellTraits& cell_traits,
                                   Visitor& visitor, Mixed_mesh_3<GeomTraits>& mesh)
{
  constexpr bool is_usual = Is_polyhedral_domain<Domain>::value && Is_polyhedral_region<Region>::value
                            && std::is_same_v<CellTraits, Axis_aligned_octree_cell_traits_3>;
  if constexpr(is_usual && !std::is_same_v<Domain, Labeled_polyhedral_mixed_mesh_domain_3>) {
    return mesh_domain_as(as_labeled_domain(domain), region, criteria, cell_traits, visitor, mesh);
  } else if constexpr(is_usual && !std::is_same_v<Region, Polyhedral_mixed_mesh_regions_3>) {
    return mesh_domain_as(domain, as_regions(region), criteria, cell_traits, visitor, mesh);
  } else if constexpr(std::is_same_v<Mixed_mesh_3<GeomTraits>, Core_mesh>) {
    Visitor_reference<Visitor> any_visitor(visitor);
    return mesh_domain(domain, region, criteria, cell_traits, any_visitor, mesh);
  } else {
    Core_mesh core;
    const Mixed_mesh_result_3 result = mesh_domain_as(domain, region, criteria, cell_traits, visitor, core);
    std::vector<typename GeomTraits::Point_3> points;
    points.reserve(core.number_of_vertices());
    for(const auto& p : core.points())
      points.emplace_back(p.x(), p.y(), p.z());
    mesh.assign(std::move(points), core.elements(), core.attributes());
    return result;
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/meshing/mesh_domain_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_H
