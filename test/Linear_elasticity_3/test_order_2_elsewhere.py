#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Compares displacements of order 2 with those of GetFEM and CalculiX: tetrahedra of ten nodes, with straight edges.

Usage: test_order_2_elsewhere.py solve_order_2 data_directory work_directory

Both programs read the nodes and elements that we write for Abaqus. CalculiX prints displacements with seven digits only;
so its matrix, which it writes with fourteen, is solved here as well.
Exit code 77 (skipped) if a program is missing: python3-getfem, python3-scipy, calculix-ccx.
"""

import os
import shutil
import subprocess
import sys

try:
    import getfem
    import numpy as np
    import scipy.sparse
    import scipy.sparse.linalg
    import scipy.spatial
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)
if shutil.which("ccx") is None:
    print("skipped: there is no ccx")
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "common"))
from checks import check, exit_code  # noqa: E402

YOUNG = 1


def read_elements(path):
    """Rows of ten nodes, from 0, in Abaqus' order, and the points of the nodes."""
    elements, points, keyword = [], [], ""
    for line in open(path):
        if line.startswith("*"):
            keyword = line.strip()
            check(not keyword.startswith("*ELEMENT") or "C3D10" in keyword, path, keyword)
            continue
        words = line.strip().rstrip(",").split(",")
        if keyword.startswith("*ELEMENT"):
            elements.append([int(w) - 1 for w in words[1:]])
        elif keyword == "*NODE":
            points.append([float(w) for w in words[1:]])
    return np.array(elements), np.array(points)


def solve(stiffness, is_prescribed, given):
    """Displacements of all nodes, from a matrix of unknowns 3 v + k."""
    u = np.where(is_prescribed[:, None], given, 0.).ravel()
    free = np.flatnonzero(np.repeat(~is_prescribed, 3))
    u[free] = scipy.sparse.linalg.spsolve(stiffness[free][:, free].tocsc(), -(stiffness @ u)[free])
    return u.reshape(-1, 3)


def stiffness_of_getfem(points, elements, nu):
    mesh = getfem.Mesh("empty", 3)
    for corners in elements[:, :4]:
        mesh.add_convex(getfem.GeoTrans("GT_PK(3,1)"), points[corners].T)
    displacement, integration = getfem.MeshFem(mesh, 3), getfem.MeshIm(mesh, getfem.Integ("IM_TETRAHEDRON(2)"))
    displacement.set_fem(getfem.Fem("FEM_PK(3,2)"))
    check(displacement.nbdof() == 3 * len(points), "unknowns of GetFEM", displacement.nbdof())
    data = getfem.MeshFem(mesh, 1)
    data.set_fem(getfem.Fem("FEM_PK(3,0)"))
    lame = YOUNG * nu / ((1 + nu) * (1 - 2 * nu)), YOUNG / (2 * (1 + nu))
    matrix = getfem.asm_linear_elasticity(integration, displacement, data, *(np.full(data.nbdof(), x) for x in lame))
    matrix.to_csc()
    starts, rows = matrix.csc_ind()
    size = 3 * len(points)
    theirs = scipy.sparse.csc_matrix((matrix.csc_val(), rows, starts), shape=(size, size))
    distances, node = scipy.spatial.cKDTree(points).query(displacement.basic_dof_nodes()[:, ::3].T)
    check(distances.max() < 1e-9 and len(set(node)) == len(points), "places of unknowns", distances.max())
    place = np.empty(len(points), int)
    place[node] = np.arange(len(points))
    order = (3 * place[:, None] + np.arange(3)).ravel()
    return theirs[order][:, order]


def run_ccx(work, name, text):
    with open(os.path.join(work, name + ".inp"), "w") as file:
        file.write(text)
    run = subprocess.run(["ccx", name], cwd=work, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                         env={**os.environ, "OMP_NUM_THREADS": "1"})
    check(run.returncode == 0, "ccx", name, run.stdout[-2000:])


def deck(mesh, nu, step):
    return (f"*INCLUDE, INPUT={mesh}\n*NSET, NSET=ALL, GENERATE\n1, {{last}}\n*ELSET, ELSET=TISSUE\nREGION, REST\n"
            f"*MATERIAL, NAME=TISSUE\n*ELASTIC\n{YOUNG}, {nu}\n*DENSITY\n1.\n"
            f"*SOLID SECTION, ELSET=TISSUE, MATERIAL=TISSUE\n{step}*END STEP\n")


def displacements_of_ccx(work, mesh, nu, is_prescribed, given):
    # CalculiX reads 20 characters of a number
    boundary = "".join(f"{v + 1}, {k + 1}, {k + 1}, {given[v, k]:.13e}\n"
                       for v in np.flatnonzero(is_prescribed) for k in range(3))
    step = ("*STEP\n*STATIC, SOLVER=SPOOLES\n*BOUNDARY\n" + boundary + "*NODE PRINT, NSET=ALL\nU\n")
    run_ccx(work, "static", deck(mesh, nu, step).replace("{last}", str(len(given))))
    u = np.full(given.shape, np.nan)
    for line in open(os.path.join(work, "static.dat")):
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            u[int(words[0]) - 1] = [float(w) for w in words[1:]]
    return u


def stiffness_of_ccx(work, mesh, nu, number_of_nodes):
    run_ccx(work, "matrix", deck(mesh, nu, "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n")
            .replace("{last}", str(number_of_nodes)))
    unknowns = []
    for line in open(os.path.join(work, "matrix.dof")):  # of a node and an axis, such as 12.3
        node, axis = line.strip().split(".")
        unknowns.append(3 * (int(node) - 1) + int(axis) - 1)
    unknowns = np.array(unknowns)
    size = 3 * number_of_nodes
    check(sorted(unknowns) == list(range(size)), "unknowns of CalculiX", len(unknowns))
    rows, columns, values = np.loadtxt(os.path.join(work, "matrix.sti"), unpack=True)
    rows, columns = unknowns[rows.astype(int) - 1], unknowns[columns.astype(int) - 1]
    half = scipy.sparse.coo_matrix((values, (rows, columns)), (size, size)).tocsr()
    return half + half.T - scipy.sparse.diags(half.diagonal())


def difference(a, b):
    return np.abs(a - b).max() / np.abs(b).max()


def main():
    program, data, work = sys.argv[1:4]
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    getfem.util_trace_level(0)
    for nu in (0.3, 0.45):
        mesh, text = f"brain_{nu}.inp", os.path.join(work, f"brain_{nu}.txt")
        run = subprocess.run([program, data, "300", str(nu), os.path.join(work, mesh), text], stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True)
        check(run.returncode == 0, run.args, run.stdout)
        rows = np.loadtxt(text)
        is_prescribed, places, given, ours = rows[:, 0] == 1, rows[:, 1:4], rows[:, 4:7], rows[:, 7:]
        elements, points = read_elements(os.path.join(work, mesh))
        check(np.abs(points - places).max() < 1e-12, "nodes", np.abs(points - places).max())
        check(np.array_equal(ours[is_prescribed], given[is_prescribed]) or
              difference(ours[is_prescribed], given[is_prescribed]) < 1e-14, "prescribed nodes")
        first_middle = elements[:, :4].max() + 1
        # Those of edges with a free end among them.
        ends_of = {frozenset((e[i], e[j])): e[4 + k] for e in elements
                   for k, (i, j) in enumerate(((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)))}
        at_border = sum(is_prescribed[m] and not all(is_prescribed[list(ends)]) for ends, m in ends_of.items())
        check(at_border > 10, "few middles are prescribed at a free end", at_border)
        held_middles = np.count_nonzero(np.any(given[first_middle:] != 0, axis=1))
        check(held_middles > 10, "the push is at few middles", held_middles)
        by_getfem = difference(solve(stiffness_of_getfem(points, elements, nu), is_prescribed, given), ours)
        by_matrix = difference(solve(stiffness_of_ccx(work, mesh, nu, len(points)), is_prescribed, given), ours)
        printed = difference(displacements_of_ccx(work, mesh, nu, is_prescribed, given), ours)
        print(f"nu {nu}, {len(points)} nodes, largest difference relative to the largest displacement: GetFEM "
              f"{by_getfem:.1e}, matrix of CalculiX {by_matrix:.1e}, displacements as CalculiX prints them {printed:.1e}")
        check(by_getfem < 1e-10, "GetFEM", by_getfem)
        check(by_matrix < 1e-8, "matrix of CalculiX", by_matrix)
        check(printed < 1e-6, "CalculiX", printed)
        # Linear displacements between the vertices are far from these: the middles are not their means.
        ends = elements[:, [0, 1]]
        bend = ours[elements[:, 4]] - (ours[ends[:, 0]] + ours[ends[:, 1]]) / 2
        check(np.abs(bend).max() > 0.01 * np.abs(ours).max(), "displacements are linear", np.abs(bend).max())
    return exit_code()


if __name__ == "__main__":
    sys.exit(main())
