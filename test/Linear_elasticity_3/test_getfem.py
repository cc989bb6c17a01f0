#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Compares displacements of the brain with those of another finite-element program, GetFEM, on the same meshes.

Usage: test_getfem.py solve_brain data_directory work_directory [vertices]...

Differences are root mean squares over all vertices, relative to that of the displacement compared with.
Exit code 77 (skipped) if a module is missing: python3-getfem.
"""

import os
import subprocess
import sys

try:
    import getfem
    import numpy as np
    import scipy.sparse
    import scipy.sparse.linalg
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

# By kind: geometric transformation, finite element, that of materials, our vertex at each of GetFEM's places, and
# integration with our points. For pyramids GetFEM collapses a cube: it takes more points there.
KINDS = [
    ("GT_PK(3,1)", "FEM_PK(3,1)", "FEM_PK(3,0)", [0, 1, 2, 3], "IM_TETRAHEDRON(1)"),
    ("GT_PYRAMID(1)", "FEM_PYRAMID_LAGRANGE(1)", "FEM_PYRAMID_LAGRANGE(0)", [0, 1, 3, 2, 4],
     "IM_PYRAMID(IM_GAUSS_PARALLELEPIPED(3,9))"),
    ("GT_PRISM(3,1)", "FEM_PRISM_PK(3,1)", "FEM_PRISM_PK(3,0)", [0, 1, 2, 3, 4, 5],
     "IM_PRODUCT(IM_TRIANGLE(2),IM_GAUSS1D(3))"),
    ("GT_QK(3,1)", "FEM_QK(3,1)", "FEM_QK(3,0)", [0, 1, 3, 2, 4, 5, 7, 6], "IM_GAUSS_PARALLELEPIPED(3,3)"),
]

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "common"))
from checks import check, exit_code  # noqa: E402


def read(path):
    """Blocks of rows by name; elements as a list by kind."""
    blocks = {}
    with open(path) as file:
        for header in file:
            name, n = header.split()
            rows = [file.readline().split() for _ in range(int(n))]
            if name == "elements":
                blocks[name] = [np.array([r[1:] for r in rows if int(r[0]) == kind], int) for kind in range(4)]
                blocks["kinds"] = np.array([int(r[0]) for r in rows])
            else:
                blocks[name] = np.array(rows, float).reshape(len(rows), -1)
    return blocks


def solve(blocks):
    """GetFEM's displacement of each vertex."""
    points, elements, prescribed = blocks["points"], blocks["elements"], blocks["prescribed"]
    n = len(points)
    mesh = getfem.Mesh("empty", 3)
    check(np.array_equal(mesh.add_point(points.T), np.arange(n)), "vertices are merged")
    convexes = []
    for kind, some in zip(KINDS, elements):
        ids = []
        for e in some:
            id = mesh.add_convex(getfem.GeoTrans(kind[0]), points[e[kind[3]]].T)
            ids += list(np.ravel(id))
        convexes.append(np.array(ids, int))
    check(mesh.nbpts() == n, "number of vertices")
    displacement, data, integration = getfem.MeshFem(mesh, 3), getfem.MeshFem(mesh, 1), getfem.MeshIm(mesh)
    for kind, ids in zip(KINDS, convexes):
        if len(ids):
            displacement.set_fem(getfem.Fem(kind[1]), ids)
            data.set_fem(getfem.Fem(kind[2]), ids)
            integration.set_integ(getfem.Integ(kind[4]), ids)
    check(displacement.nbdof() == 3 * n, "number of unknowns", displacement.nbdof())

    # Degrees of freedom, in the order of our vertices.
    nodes = displacement.basic_dof_nodes()[:, ::3].T
    order = np.lexsort(np.round(nodes, 7).T)
    ours = np.lexsort(np.round(points, 7).T)
    vertex = np.empty(n, int)
    vertex[order] = ours  # of each triple of unknowns
    check(np.abs(nodes - points[vertex]).max() < 1e-6, "positions of unknowns")
    place = np.empty(n, int)
    place[vertex] = np.arange(n)

    # A material for each element: convexes are in the order of our kinds.
    lame = np.empty((2, data.nbdof()))
    check(data.nbdof() == len(blocks["materials"]), "number of materials", data.nbdof())
    for kind, ids in enumerate(convexes):
        for id, (modulus, ratio) in zip(ids, blocks["materials"][blocks["kinds"] == kind]):
            of_element = np.ravel(data.basic_dof_from_cvid(id)[0]).astype(int)
            lame[0, of_element] = modulus * ratio / ((1 + ratio) * (1 - 2 * ratio))
            lame[1, of_element] = modulus / (2 * (1 + ratio))
    matrix = getfem.asm_linear_elasticity(integration, displacement, data, *lame)
    matrix.to_csc()
    starts, rows = matrix.csc_ind()
    stiffness = scipy.sparse.csc_matrix((matrix.csc_val(), rows, starts), shape=(3 * n, 3 * n))

    # The system of the free unknowns, those that are known to the right.
    u, is_free = np.zeros((n, 3)), np.ones(n, bool)
    u[prescribed[:, 0].astype(int)] = prescribed[:, 1:]
    is_free[prescribed[:, 0].astype(int)] = False
    u, free = u[vertex].ravel(), np.flatnonzero(np.repeat(is_free[vertex], 3))
    u[free] = scipy.sparse.linalg.spsolve(stiffness[free][:, free], -(stiffness @ u)[free])
    return u.reshape(n, 3)[place]


def difference(a, b):
    return np.sqrt(((a - b) ** 2).sum() / (b ** 2).sum())


def main():
    program, data, work = sys.argv[1:4]
    os.makedirs(work, exist_ok=True)
    budgets = [int(x) for x in sys.argv[4:]] or [660, 2000]
    print("Differences in %: to GetFEM, of our elements and of standard ones; on the mesh split to tetrahedra to that "
          "on the mixed one,\nof our elements and of standard ones")
    last = {}
    for budget in budgets:
        for ratio, fit in ((0.45, "fitted"), (0.3, "fitted"), (0.45, "unfitted"), (0.3, "tumor")):
            path = os.path.join(work, "brain_%d_%g_%s.txt" % (budget, ratio, fit))
            run = subprocess.run([program, data, str(budget), str(ratio), fit, path], stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True)
            check(run.returncode == 0, run.args, run.stdout)
            blocks = read(path)
            theirs = solve(blocks)
            now = [difference(blocks[name], theirs) for name in ("ours", "standard")]
            for name in ("ours", "standard"):
                check(len(blocks[name + "_on_tetrahedra"]) != 0, path, "inverted tetrahedra")
                now.append(difference(blocks[name + "_on_tetrahedra"], blocks[name]))
            print("%d vertices, nu %g, %s: %.3g %.3g  %.3g %.3g"
                  % (len(blocks["points"]), ratio, fit, *(100 * x for x in now)))
            # Standard elements are the same, but for the integration over distorted pyramids: cells of the octree
            # have hardly any. Ours differ by as much as standard ones lock, and less with each refinement.
            check(now[1] < (1e-5 if fit == "unfitted" else 1e-4), path, "standard elements", now[1])
            check(ratio > 0.3 or now[0] < 0.02, path, "our elements where standard ones do not lock", now[0])
            if fit == "tumor":
                moduli = np.unique(blocks["materials"][:, 0])
                check(np.array_equal(moduli, [1, 10]), path, "subdomains", moduli)
                of_one = difference(blocks["standard_of_one_material"], theirs)
                print("the same with one material, standard elements: %.3g" % (100 * of_one))
                check(of_one > 0.02, path, "the tumor makes no difference", of_one)
            # That to tetrahedra is 1.5 % at both sizes of a mesh with a tumor.
            before = [0.01, 0, 0.02, 0.02] if fit == "tumor" else last.get((ratio, fit), [0.09, 0, 0.06, 0.05])
            for i in (0, 2, 3):
                check(now[i] < before[i], path, "difference", i, now[i], before[i])
            last[ratio, fit] = now
    return exit_code()


if __name__ == "__main__":
    sys.exit(main())
