// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_STREAM_H
#define CGAL_MIXED_MESH_3_IO_STREAM_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/MEDIT.h>

#include <ostream>

namespace CGAL {

/// \ingroup PkgMixedMesh3IO
/// Writes a mesh as `Mixed_meshes_3::IO::write_MEDIT()` does; `Mixed_meshes_3::IO::read_mixed_mesh()` reads
/// the mesh.
/// \param out stream, whose state tells whether the mesh was written
/// \param mesh mesh
template <class GeomTraits>
std::ostream& operator<<(std::ostream& out, const Mixed_mesh_3<GeomTraits>& mesh)
{
  if(!Mixed_meshes_3::IO::write_MEDIT(out, mesh))
    out.setstate(std::ios_base::failbit);
  return out;
}

} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_STREAM_H
