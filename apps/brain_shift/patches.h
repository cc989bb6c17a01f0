// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of the boundary by name: those of --fixed, --slide, --contact and --opening.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_PATCHES_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_PATCHES_H

#include "brain_shift/outcome.h"
#include "brain_shift/resection.h"
#include "core/types.h"

#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>

#include <optional>
#include <string>
#include <vector>

/// Names of patches: the lower part of the height, and all of the boundary.
inline constexpr const char *base_patch = "base", *skull_patch = "skull";

/// The start of a patch that is a label.
inline constexpr const char* label_prefix = "label:";

/// The label of a patch such as "label:3"; nothing if the patch is no label.
std::optional<int> label_of(const std::string& patch);

/// Patches of the boundary: closed surfaces, labels, and the names above.
struct Patch_options
{
  std::vector<std::string> fixed, sliding, touching, openings;

  bool are_given() const
  {
    return !fixed.empty() || !sliding.empty() || !touching.empty() || !openings.empty();
  }
};

/// The patch of a face or a vertex of the boundary; `NONE` means that other options decide.
enum class Patch { NONE, OPENING, FIXED, SLIDING, TOUCHING };

struct Boundary_patches
{
  std::vector<CGAL::Mixed_meshes_3::Face> faces; // faces of the boundary
  std::vector<Patch> of_faces, of_vertices;      // patches of the faces above; of all vertices of the mesh
};

/// Reads the surfaces of the patches. The order of precedence is: openings, fixed, sliding, touching. A
/// vertex is fixed if one of its faces is, else it slides if one of its faces does, else it touches the wall
/// if one of its faces does; a vertex belongs to an opening if all its faces do.
/// \throw std::runtime_error if a surface cannot be read, or if no face of the boundary is in a patch
/// \param surface_options way in which the surfaces are read
Boundary_patches
find_patches(const Mesh& mesh, const std::string& mesh_file, const Patch_options& options,
             const CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& surface_options,
             std::vector<std::string>& warnings);

/// The facet sets "fixed", "sliding", "touching", "opening", and "cavity" after a resection; none if no
/// patches are requested. A face is fixed if all its vertices are, slides if its vertices are fixed or slide,
/// and touches the wall if its vertices are fixed, slide or touch the wall.
/// \param mesh remaining mesh
/// \param vertices_before numbers of its vertices in the mesh of the patches; empty: the same numbers
std::vector<CGAL::Mixed_meshes_3::IO::Facet_set>
facet_sets(const Mesh& mesh, const std::vector<Mesh::Vertex_index>& vertices_before,
           const Boundary_patches& patches, const Supports& supports);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_PATCHES_H
