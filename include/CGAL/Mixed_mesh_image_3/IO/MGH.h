// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of FreeSurfer.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_MGH_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_MGH_H

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/read_MGH.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMeshImage3Ref

Reads an image of FreeSurfer (`.mgh`, `.mgz`).

Positions are those of the scanner, `scanner RAS`, in millimeters, not FreeSurfer's `surface RAS`:
`read_anatomical_surface()` converts FreeSurfer's surfaces to them, too. A file that has no positions
(`goodRASFlag`) has those that the format defines for this case: voxels of 1 mm in coronal slices, centered at
the origin. Values are floats: integers beyond 2^24 lose digits.

\param path file name
\param image the result; unchanged if the file cannot be read, is truncated or damaged, has several frames, a
number in its header that is not finite or not possible (the line names the field), or voxels that are not
finite real numbers
\param error if not null, receives then a line that names the file and the defect
\return whether the image was read
*/
[[nodiscard]] inline bool read_MGH(const std::string& path, Voxel_image_3& image,
                                   std::string* error = nullptr)
{
  return internal::is_read(path, error, [&] { image = internal::read_MGH_image(path); });
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_MGH_H
