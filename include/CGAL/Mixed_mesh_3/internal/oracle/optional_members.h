// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Optional functions that a model of MixedMeshSurface_3 or MixedMeshDomain_3 may have.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_OPTIONAL_MEMBERS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_OPTIONAL_MEMBERS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <type_traits>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

template <class Domain, class = void>
struct Has_bbox : std::false_type
{
};
/// Models that have a box.
template <class Domain>
struct Has_bbox<Domain, std::void_t<decltype(std::declval<const Domain&>().bbox())>> : std::true_type
{
};

template <class Domain, class = void>
struct Has_shells : std::false_type
{
};
/// Models that have the number of their shells.
template <class Domain>
struct Has_shells<Domain, std::void_t<decltype(std::declval<const Domain&>().shells())>> : std::true_type
{
};

template <class Domain, class = void>
struct Has_volume : std::false_type
{
};
/// Models that have their volume.
template <class Domain>
struct Has_volume<Domain, std::void_t<decltype(std::declval<const Domain&>().volume())>> : std::true_type
{
};

template <class Domain, class = void>
struct Has_sharp_edges : std::false_type
{
};
/// Models that have sharp edges.
template <class Domain>
struct Has_sharp_edges<Domain, std::void_t<decltype(std::declval<const Domain&>().sharp_edges(0.))>>
  : std::true_type
{
};

template <class Domain, class = void>
struct Has_axis_parallel_planes : std::false_type
{
};
/// Models that have the planes that their surface lies in.
template <class Domain>
struct Has_axis_parallel_planes<Domain,
                                std::void_t<decltype(std::declval<const Domain&>().axis_parallel_planes())>>
  : std::true_type
{
};

template <class Visitor, class Mesh, class = void>
struct Has_before_fitting : std::false_type
{
};
/// Visitors that want to see the mesh before its boundary is fitted.
template <class Visitor, class Mesh>
struct Has_before_fitting<
  Visitor, Mesh, std::void_t<decltype(std::declval<Visitor&>().before_fitting(std::declval<const Mesh&>()))>>
  : std::true_type
{
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_OPTIONAL_MEMBERS_H
