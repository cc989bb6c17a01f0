// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_SUBDOMAIN_NAMES_H
#define CGAL_MIXED_MESH_3_IO_SUBDOMAIN_NAMES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>

#include <map>
#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMesh3IO

\brief Names of subdomains in files, for example "tumor".

Names have the form of those of a `Facet_set`, and each name belongs to one subdomain or facet set only. Names
of subdomains that a mesh lacks are not written. Subdomains need not have names.
*/
using Subdomain_names = std::map<Subdomain_index, std::string>;

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_SUBDOMAIN_NAMES_H
