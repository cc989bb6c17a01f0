// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_WRITE_OPTIONS_H
#define CGAL_MIXED_MESH_3_IO_WRITE_OPTIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>

#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// The formats that can be written.
enum class Format {
  VTU,     ///< VTK's unstructured grid, in XML
  MSH_4_1, ///< Gmsh, now
  MSH_2_2, ///< Gmsh, the older format
  MEDIT,   ///< Medit
  INP,     ///< Abaqus
  FEB      ///< FEBio
};

/// \ingroup PkgMixedMesh3IO
/// How `write_mixed_mesh()` writes, and what besides the mesh.
struct Write_options
{
  /// Whether to write `split_to_tetrahedra(mesh)` instead of the mesh.
  bool tetrahedra = false;
  /// Whether `.msh` means Gmsh's format 2.2 instead of 4.1.
  bool msh_2_2 = false;
  /// Values to write with the mesh: `Format::VTU`; of one or three components, also Gmsh's formats and
  /// `Format::FEB`.
  std::vector<Data_array> vertex_data;
  /// Values to write with the mesh; `Format::VTU` only.
  std::vector<Data_array> element_data;
  /// Named faces of elements, in all formats. `Format::MSH_2_2` and `Format::MEDIT` take no face in two sets.
  std::vector<Facet_set> facet_sets = {};
  /// In all formats but `Format::MEDIT`, which has no place for them.
  Subdomain_names subdomain_names = {};
  /// The order of the elements, 1 or 2. With 2, they are quadratic and straight-sided: each edge has one node
  /// more, at its rounded midpoint, numbered after the vertices in the order in which elements have the edges
  /// first; faces have those of their edges. Such elements have the map of the linear ones, up to the
  /// rounding of the middle nodes: what the certificate proves of those holds for them. Values at the
  /// vertices are interpolated linearly, unless there are values for all nodes: those of the vertices, then
  /// those of the edges, in the order of `Linear_elasticity_3::quadratic_edges()` with order 2 everywhere.
  /// All formats but `Format::MEDIT` have them, `Format::INP` without pyramids.
  int order = 1;
};

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_WRITE_OPTIONS_H
