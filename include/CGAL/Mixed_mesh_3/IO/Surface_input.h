// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_SURFACE_INPUT_H
#define CGAL_MIXED_MESH_3_IO_SURFACE_INPUT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// The content of a surface file, and the repairs.
struct Surface_input
{
  /// Points of the surface.
  std::size_t number_of_points = 0, number_of_polygons = 0; ///< numbers in the file
  /// Connected parts of the surface.
  std::size_t number_of_components = 0;
  double volume = 0;                 ///< enclosed volume, in the cube of the unit
  std::vector<std::string> warnings; ///< one line each, without the file's name
  std::vector<std::string> repairs;  ///< warnings of a surface other than that of the file
  double wrap_diameter = 0;          ///< diameter with which a refused surface can be wrapped; 0: none
  double weld_distance = 0;          ///< distance at which welding closes a refused surface; 0: none
};

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_SURFACE_INPUT_H
