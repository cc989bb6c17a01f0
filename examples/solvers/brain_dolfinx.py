#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Solves by dolfinx (0.5, as Debian 12 has) what brain.py has written into this folder, and writes dolfinx.txt."""

import meshio
import numpy as np
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

YOUNG, POISSON = 1.0, 0.25

brain = meshio.read("brain.mesh")
cells = np.vstack([block.data for block in brain.cells if block.type == "tetra"])
element = ufl.VectorElement("Lagrange", ufl.tetrahedron, 1)
domain = mesh.create_mesh(MPI.COMM_SELF, cells, brain.points, ufl.Mesh(element))
space = fem.VectorFunctionSpace(domain, ("Lagrange", 1))

# The place of each vertex of the file among the nodes of dolfinx, which are sorted otherwise; and of the unknowns.
place = np.empty(len(brain.points), np.int32)
place[domain.geometry.input_global_indices] = np.arange(len(place))
node_of_vertex = np.empty(len(place), np.int32)
tetrahedra = range(len(cells))
node_of_vertex[np.vstack([domain.geometry.dofmap.links(c) for c in tetrahedra])] = np.vstack(
    [space.dofmap.cell_dofs(c) for c in tetrahedra])
unknown = node_of_vertex[place]

conditions = np.loadtxt("conditions.txt", skiprows=1)
given = fem.Function(space)
prescribed = unknown[conditions[:, 0].astype(int) - 1]
given.x.array.reshape(-1, 3)[prescribed] = conditions[:, 1:]

u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
mu, lame = YOUNG / (2 * (1 + POISSON)), YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
stress = lame * ufl.div(u) * ufl.Identity(3) + 2 * mu * ufl.sym(ufl.grad(u))
zero = fem.Constant(domain, PETSc.ScalarType((0, 0, 0)))
problem = fem.petsc.LinearProblem(ufl.inner(stress, ufl.sym(ufl.grad(v))) * ufl.dx, ufl.inner(zero, v) * ufl.dx,
                                  [fem.dirichletbc(given, np.sort(prescribed))],
                                  petsc_options={"ksp_type": "preonly", "pc_type": "lu"})
shift = problem.solve().x.array.reshape(-1, 3)[unknown]
np.savetxt("dolfinx.txt", shift, fmt="%.17g")
