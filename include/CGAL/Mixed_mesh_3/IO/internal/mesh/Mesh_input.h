// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh as given in a file. A file may have any content: memory is allocated only after its size is found to
// fit the size of the file.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_INPUT_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_INPUT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Data_columns.h>
#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// A mesh as given in a file: indices are in range, all other conditions have to be checked.
struct Mesh_input
{
  std::vector<Mixed_meshes_3::Vec3> points;
  Element_list elements;
  std::vector<Element_attributes> attributes;
  Data_columns vertex_data, element_data; // columns with a row for each, or none
  Subdomain_names subdomain_names;
};

// The product of eight lengths has to be a double: squares of quantities of elements, and of their inverses.
constexpr double largest_coordinate = 1e30;

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_INPUT_H
