// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_DRAW_MIXED_MESH_3_H
#define CGAL_DRAW_MIXED_MESH_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_to_face_graph.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/draw_surface_mesh.h>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Validity

\brief Shows the boundary of a mesh in a window, and returns when the user closes it.

Like other functions of \cgal with that name, `draw()` needs Qt: the target `CGAL::CGAL_Basic_viewer` (with
\cgal 5.5: `CGAL::CGAL_Qt5` and the macro `CGAL_USE_BASIC_VIEWER`). Without Qt, `draw()` shows nothing.

\tparam GeomTraits a model of `MixedMeshTraits_3`
\param mesh a conforming mesh
\param title title of the window
*/
template <class GeomTraits>
void draw(const Mixed_mesh_3<GeomTraits>& mesh, const char* title = "Mixed mesh")
{
  Surface_mesh<typename GeomTraits::Point_3> boundary;
  boundary_to_face_graph(mesh, boundary);
  draw(boundary, title);
}

} // namespace CGAL

#endif // CGAL_DRAW_MIXED_MESH_3_H
