// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_LABEL_CHANGE_3_H
#define CGAL_MIXED_MESH_IMAGE_3_LABEL_CHANGE_3_H

#include <array>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMeshImage3Ref
/// The kinds of changes of topology between the voxels of a label and its surface.
enum class Label_change_kind {
  BODIES_LOST,     ///< nothing is left of bodies
  BODIES_PARTED,   ///< bodies fall into pieces: a bridge or a neck is lost
  BODIES_JOINED,   ///< bodies are joined by a bridge
  BODIES_ADDED,    ///< there are bodies where the label has no voxel
  CAVITIES_LOST,   ///< cavities are filled
  CAVITIES_PARTED, ///< cavities, or the outside, fall into pieces: a cavity is cut off
  CAVITIES_JOINED, ///< cavities are joined, or open to the outside
  CAVITIES_ADDED,  ///< there are cavities where there was nothing but the label
  HANDLES_LOST,    ///< holes are filled, or rings are cut
  HANDLES_ADDED    ///< there are new holes, or rings
};

/// \ingroup PkgMixedMeshImage3Ref
/// A change of topology between the voxels of a label and its surface.
struct Label_change_3
{
  std::size_t label = 0; ///< number of the label from 1 on, or 0: all labels together
  Label_change_kind kind = Label_change_kind::BODIES_LOST; ///< kind of the change
  /// The number of bodies, or cavities, that are concerned; of handles, all. The outside counts as a cavity.
  std::size_t number_before = 0;
  std::size_t number_after = 0;  ///< number of those that they become
  std::array<double, 3> point{}; ///< place of the change, or of one of several, in millimeters
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_LABEL_CHANGE_3_H
