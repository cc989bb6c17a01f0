// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of FreeSurfer: read, or refused.

#include "fuzz_file.h"

#include <CGAL/Mixed_mesh_image_3/IO/MGH.h>

#include <cmath>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  namespace mm3 = CGAL::Mixed_meshes_3;
  static const Fuzz_file file(".mgz"); // zlib reads what is not compressed, too
  file.write(data, size);
  mm3::Voxel_image_3 image;
  std::string error;
  if(!mm3::IO::read_MGH(file.path(), image, &error)) {
    require_line(file.path(), error);
    return 0;
  }
  require(image.values.size() == image.grid.number_of_voxels());
  for(float x : image.values)
    require(std::isfinite(x));
  return 0;
}
