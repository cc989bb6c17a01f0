// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names of the arrays that the writer of VTK's format makes itself.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_VTU_NAMES_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_VTU_NAMES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

constexpr std::string_view VTU_prefix_of_nodes = "nodes_", VTU_prefix_of_facets = "facets_";

/// Whether an array at vertices, or of elements, is made of the mesh itself or of a facet set: data of the
/// user have other names.
inline bool is_own_VTU_name(std::string_view name, bool is_vertex_data)
{
  constexpr std::string_view of_elements[] = {"kind", "ARC", "in_region", "subdomain", "compartment"};
  const std::string_view prefix = is_vertex_data ? VTU_prefix_of_nodes : VTU_prefix_of_facets;
  return name.substr(0, prefix.size()) == prefix
         || (!is_vertex_data
             && std::find(std::begin(of_elements), std::end(of_elements), name) != std::end(of_elements));
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_VTU_NAMES_H
