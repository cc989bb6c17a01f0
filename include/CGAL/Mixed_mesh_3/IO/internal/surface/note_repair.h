// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_NOTE_REPAIR_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_NOTE_REPAIR_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>

#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Notes that the surface is not that of the file any more.
inline void note_repair(const std::string& text, Surface_input& input)
{
  input.warnings.push_back(text);
  input.repairs.push_back(text);
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_NOTE_REPAIR_H
