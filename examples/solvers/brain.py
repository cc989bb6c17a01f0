#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A pushed brain for other solvers: writes mesh, conditions and our displacements, brain_shift.txt, into this folder.

Tetrahedra of order 1 are those of other programs up to a Poisson's ratio of 2/7: here it is 0.25.
"""

import numpy as np

import mixed_mesh_3 as mm3

YOUNG, POISSON = 1.0, 0.25  # kPa, as mm and mN are the other units
OPENING, RADIUS = np.array([37, 25, 55]), 20  # of the skull, mm

data = mm3.example_data()
mesh, _ = mm3.mesh(*data["brain"], region=data["region"], vertices=660)
for name in ("brain.inp", "brain.mesh"):
    mesh.save(name, tetrahedra=True)
mesh = mm3.read_mesh("brain.mesh")  # in tetrahedra

# The lower 30 % of the boundary is fixed, and the boundary around the opening moves inwards by 10 mm, less to the rim.
boundary, height = mm3.boundary_vertices(mesh), mesh.points[:, 2]
is_fixed = boundary & (height < height.min() + 0.3 * np.ptp(height))
distance = np.linalg.norm(mesh.points - OPENING, axis=1) / RADIUS
is_pushed = boundary & (distance < 1)
push = -10 * ((1 - distance**2) ** 2)[:, None] * OPENING / np.linalg.norm(OPENING)

model = mm3.Elasticity(mesh, YOUNG, POISSON)
model.fix(is_fixed)
model.set_control_points(mesh.points[is_pushed])
np.savetxt("brain_shift.txt", model.solve(push[is_pushed]), fmt="%.17g")

# Conditions: their number, then a line for each vertex, from 1, with its displacement.
rows = [(v + 1, *(push[v] if is_pushed[v] else np.zeros(3))) for v in np.flatnonzero(is_fixed | is_pushed)]
np.savetxt("conditions.txt", rows, fmt=["%d"] + 3 * ["%.17g"], header=str(len(rows)), comments="")
