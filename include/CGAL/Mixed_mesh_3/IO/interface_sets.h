// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INTERFACE_SETS_H
#define CGAL_MIXED_MESH_3_IO_INTERFACE_SETS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>

#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// The name of the facet set between two subdomains, or, if the second one has no name, between a subdomain
/// and the outside: `interface_skull_brain`, `outside_skull`.
inline std::string interface_set_name(const std::string& first, const std::string& second = {})
{
  return second.empty() ? "outside_" + first : "interface_" + first + '_' + second;
}

/*!
\ingroup PkgMixedMesh3IO

\brief Returns the interfaces of subdomains, and of subdomains and the outside, as facet sets to be written
with the mesh.

Faces are those of the subdomain that comes first in the name, which has the smaller index.

\param mesh a `Mixed_mesh_3`
\param names names of subdomains; those without are called `subdomain_2` and so on

\par Complexity
O(n log n) for n elements
*/
template <class Mesh>
std::vector<Facet_set> interface_sets(const Mesh& mesh, const Subdomain_names& names = {})
{
  const auto name_of = [&names](Subdomain_index index) {
    const auto found = names.find(index);
    return found != names.end() ? found->second : "subdomain_" + std::to_string(index);
  };
  std::vector<Facet_set> sets;
  for(Subdomain_interface& one : find_interfaces(mesh))
    sets.push_back({one.second == 0 ? interface_set_name(name_of(one.first))
                                    : interface_set_name(name_of(one.first), name_of(one.second)),
                    std::move(one.faces)});
  return sets;
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERFACE_SETS_H
