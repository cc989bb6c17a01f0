// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conditions on readers of meshes for any bytes.

#ifndef MIXED_MESH_3_TEST_FUZZ_FUZZ_MESH_H
#define MIXED_MESH_3_TEST_FUZZ_FUZZ_MESH_H

#include "fuzz_file.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/validation.h>

/// Reads a mesh; a mesh that is read can be checked, in a time that the size of the file bounds.
inline int read_and_check(const Fuzz_file& file, const std::uint8_t* data, std::size_t size)
{
  namespace mm3 = CGAL::Mixed_meshes_3;
  file.write(data, size);
  CGAL::Mixed_mesh_3<CGAL::Exact_predicates_inexact_constructions_kernel> mesh;
  std::string error;
  if(!mm3::IO::read_mixed_mesh(file.path(), mesh, &error)) {
    require_line(file.path(), error);
    require(mesh.is_empty());
    return 0;
  }
  require(!mesh.is_empty());
  const mm3::Mesh_defects defects = mm3::find_defects(mesh);
  require(defects.invalid_elements <= mesh.number_of_elements());
  return 0;
}

#endif // MIXED_MESH_3_TEST_FUZZ_FUZZ_MESH_H
