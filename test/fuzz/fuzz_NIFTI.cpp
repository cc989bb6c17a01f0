// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NIfTI images: read, or refused; what is read can be written, and read back.

#include "fuzz_file.h"

#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>

#include <cmath>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  namespace mm3 = CGAL::Mixed_meshes_3;
  static const Fuzz_file file(".nii.gz"), copy(".copy.nii"); // zlib reads what is not compressed, too
  file.write(data, size);
  mm3::Voxel_image_3 image, again;
  std::string error;
  if(!mm3::IO::read_NIFTI(file.path(), image, &error)) {
    require_line(file.path(), error);
    return 0;
  }
  require(image.values.size() == image.grid.number_of_voxels());
  for(float x : image.values)
    require(std::isfinite(x));
  if(mm3::IO::write_NIFTI(copy.path(), image, &error)) {
    if(mm3::IO::read_NIFTI(copy.path(), again, &error))
      require(again.values.size() == image.values.size());
    else // a scaling that floats do not hold
      require_line(copy.path(), error);
  } else { // a row that is too long for NIfTI-1
    require_line(copy.path(), error);
  }
  return 0;
}
