// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_DATA_ARRAY_H
#define CGAL_MIXED_MESH_3_IO_DATA_ARRAY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// Values at the vertices or at the elements, to be written with a mesh. The array does not own the values:
/// they must stay until the mesh is written.
struct Data_array
{
  /// The name in the file.
  std::string name;
  const std::vector<double>* values; ///< the components of the first vertex or element, and so on
  /// The number of values for each vertex or element.
  int number_of_components = 1;

  /// Whether there are values for `n` vertices or elements.
  bool has_size(std::size_t n) const
  {
    return values != nullptr && number_of_components > 0
           && values->size() == n * std::size_t(number_of_components);
  }
};

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_DATA_ARRAY_H
