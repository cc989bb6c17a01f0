// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_FOLLOWED_FEATURES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_FOLLOWED_FEATURES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The sharp features of a surface, and the vertices and edges of a mesh that follow them: they are chosen
/// once, when the mesh is first fitted, and are handed on to later stages.
struct Followed_features
{
  Sharp_features features;
  Sharp_strata strata; ///< empty: not chosen yet
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_FOLLOWED_FEATURES_H
