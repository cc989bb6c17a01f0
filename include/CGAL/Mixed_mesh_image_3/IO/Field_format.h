// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_FIELD_FORMAT_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_FIELD_FORMAT_H

#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMeshImage3Ref
/// Formats of files of a field of displacements. All have floats in millimeters, one vector for each voxel;
/// programs differ in the first two directions.
enum class Field_format {
  NIFTI, ///< NIfTI, `NIFTI_INTENT_DISPVECT`: right, front, top (RAS), as NIfTI has it; nibabel, FSL
  ITK,   ///< NIfTI, `NIFTI_INTENT_VECTOR`: left, back, top (LPS), as ITK has it; ANTs, plastimatch
  NRRD   ///< NRRD in the space left-posterior-superior (LPS): 3D Slicer, ITK
};

/// \ingroup PkgMixedMeshImage3Ref
/// The end of the name of a field's file, after `_forward` or `_backward`.
/// \param format format of the field
/// \param extension extension of the image that the field belongs to: `.nii` or `.nii.gz`
inline std::string end_of_field_name(Field_format format, const std::string& extension = ".nii.gz")
{
  switch(format) {
  case Field_format::NIFTI: return extension;
  case Field_format::ITK: return "_itk" + extension;
  case Field_format::NRRD: return ".nrrd";
  }
  return std::string();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_FIELD_FORMAT_H
