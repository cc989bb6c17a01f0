#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes an image of ones around a mesh, for cases without an image: fields are sampled on its voxels.

  make_grid.py MESH.mesh SPACING OUTPUT.nii
"""

import os
import sys

import nibabel
import numpy as np
from surfaces import read_medit

MARGIN = 12.  # mm; more than the brain is expected to bulge


def main():
    points, _, _ = read_medit(sys.argv[1])
    spacing = float(sys.argv[2])
    low = np.floor((points.min(axis=0) - MARGIN) / spacing) * spacing
    size = np.ceil((points.max(axis=0) + MARGIN - low) / spacing).astype(int) + 1
    affine = np.diag([spacing] * 3 + [1.])
    affine[:3, 3] = low
    image = nibabel.Nifti1Image(np.ones(size, np.uint8), affine)
    image.header.set_xyzt_units("mm")
    partial = sys.argv[3] + ".part.nii"
    nibabel.save(image, partial)
    os.replace(partial, sys.argv[3])


if __name__ == "__main__":
    main()
