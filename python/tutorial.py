#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A tutorial of the Python package: from surfaces to a brain after a shift and the resection of its tumor.

Each part can be pasted into a notebook."""

# %% Surfaces are arrays: here those of the bundled brain, otherwise from read_surface() or any other reader
import numpy as np

import mixed_mesh_3 as mm3

brain, region, tumor = mm3.example_data().values()

# %% A mesh of 660 vertices, fine between the tumor and the opening of the skull
mesh, report = mm3.mesh(*brain, region=region, vertices=660)
print(mesh, report["status"])
assert mm3.certify(mesh).all(), "each element is proved to be valid"
print("aspect-ratio coefficients: mean %.2f, largest %.2f" % (mm3.quality(mesh).mean(), mm3.quality(mesh).max()))

# %% The brain shifts: the lowest fifth is fixed, and 20 measured points of the surface sink by 5 mm
boundary = mm3.boundary_vertices(mesh)
height = mesh.points[:, 2]
is_low = height < height.min() + 0.2 * (height.max() - height.min())
model = mm3.Elasticity(mesh, young_modulus=3.0)
model.fix(boundary & is_low)
top = np.flatnonzero(boundary)[np.argsort(height[boundary])[-20:]]
model.set_control_points(mesh.points[top])
measured = np.tile([0.0, 0.0, -5.0], (len(top), 1))
shift = model.solve(measured)
assert np.abs(shift[top] - measured).max() < 1e-6
print("largest displacement: %.2f mm" % np.linalg.norm(shift, axis=1).max())

# %% The tumor is resected, and the shift is computed again
removed = mm3.resect(mesh, *tumor)
model.remove(removed)
after = model.solve(measured)
print("resected: %.1f cm3" % (mm3.quality(mesh, "volume")[removed].sum() / 1000))

# %% An image is deformed with the mesh: here an image of stripes, with voxels 2 mm wide
lower, upper = mesh.points.min(axis=0) - 10, mesh.points.max(axis=0) + 10
affine = np.diag([2.0, 2.0, 2.0, 1.0])
affine[:3, 3] = lower
size = ((upper - lower) / 2).astype(int)
image = np.indices(size).sum(axis=0) % 10 * 100.0
warped, forward, backward, mask = mm3.warp(image, affine, mesh, after, removed=removed)
print("voxels of tissue: %d, resected: %d" % ((mask == 1).sum(), (mask == 2).sum()))
