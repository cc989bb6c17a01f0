// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

namespace mm3 = CGAL::Mixed_meshes_3;

// Eight voxels come back from a compressed file.
int main()
{
  mm3::Voxel_image_3 image;
  image.grid.size = {2, 2, 2};
  image.values = {1, 2, 3, 4, 5, 6, 7, 8};
  mm3::Voxel_image_3 read;
  return mm3::IO::write_NIFTI("image.nii.gz", image) && mm3::IO::read_NIFTI("image.nii.gz", read)
             && read.values == image.values
           ? 0
           : 1;
}
