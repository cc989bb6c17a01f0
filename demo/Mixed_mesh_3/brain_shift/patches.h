// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of the boundary by name: those of --fixed, --slide, --contact and --opening.

#ifndef MIXED_MESH_3_DEMO_BRAIN_SHIFT_PATCHES_H
#define MIXED_MESH_3_DEMO_BRAIN_SHIFT_PATCHES_H

#include "brain_shift/options.h"
#include "brain_shift/outcome.h"
#include "brain_shift/resection.h"
#include "common/types.h"

#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>

#include <string>
#include <vector>

/// What is asked for a face or a vertex of the boundary; nothing says that other options decide.
enum class Patch { NONE, OPENING, FIXED, SLIDING, TOUCHING };

struct Boundary_patches
{
  std::vector<CGAL::Mixed_meshes_3::Face> faces; // of the boundary
  std::vector<Patch> of_faces, of_vertices;      // of the faces above; of all vertices of the mesh
};

/// Reads the surfaces that patches are given by. Openings come before what is fixed, and that before what
/// slides, and that before what touches a wall. A vertex is fixed if one of its faces is, else it slides if
/// one of them does, else it touches the wall if one of them does; it is of an opening if all are.
/// \throw std::runtime_error if a surface cannot be read, or if nothing of the boundary is in a patch
Boundary_patches find_patches(const Mesh& mesh, const Options& options, std::vector<std::string>& warnings);

/// The facet sets "fixed", "sliding", "touching", "opening", and "cavity" after a resection; none if no
/// patches are asked for. A face is fixed if all its vertices are, slides if its vertices are fixed or slide,
/// and touches the wall if its vertices are fixed, slide or touch it.
/// \param mesh what is left
/// \param vertices_before the numbers that its vertices have in the mesh of the patches; empty: the same
std::vector<CGAL::Mixed_meshes_3::IO::Facet_set>
facet_sets(const Mesh& mesh, const std::vector<Mesh::Vertex_index>& vertices_before,
           const Boundary_patches& patches, const Supports& supports, const Options& options);

#endif // MIXED_MESH_3_DEMO_BRAIN_SHIFT_PATCHES_H
