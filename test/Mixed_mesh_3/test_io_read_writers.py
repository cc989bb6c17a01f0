#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Writes a mesh by other programs, VTK and Gmsh, in all their encodings, and has test_io_read read it.

Usage: test_io_read_writers.py test_io_read [directory for the files]

Exit code 77 (skipped) if a module is missing: python3-vtk9, python3-gmsh.
"""

import itertools
import json
import os
import subprocess
import sys

try:
    import gmsh
    import vtk
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

# In Gmsh's order, which is ours. A hexahedron, a pyramid on top, a prism and a tetrahedron beside them.
POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1),
          (0.5, 0.5, 2), (2, 0, 0), (2, 1, 0), (2, 0.5, 2)]
ELEMENTS = [("hexahedron", 5, vtk.VTK_HEXAHEDRON, [0, 1, 2, 3, 4, 5, 6, 7], 1, 1),
            ("pyramid", 7, vtk.VTK_PYRAMID, [4, 5, 6, 7, 8], 1 / 3, 1),
            ("prism", 6, vtk.VTK_WEDGE, [1, 5, 9, 2, 6, 10], 1 / 2, 0),
            ("tetrahedron", 4, vtk.VTK_TETRA, [5, 11, 6, 8], 0.25, 0)]
BOUNDARY = [(vtk.VTK_QUAD, 3, [0, 3, 2, 1]), (vtk.VTK_TRIANGLE, 2, [4, 5, 8]), (vtk.VTK_LINE, 1, [0, 1]),
            (vtk.VTK_VERTEX, 15, [0])]
# VTK's documented wedge is ours with the triangles turned around.
VTK_WEDGE_ORDER = [0, 2, 1, 3, 5, 4]

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "common"))
from checks import check, exit_code  # noqa: E402


def vtk_grid(point_type):
    grid, points, region = vtk.vtkUnstructuredGrid(), vtk.vtkPoints(), vtk.vtkUnsignedCharArray()
    points.SetDataType(point_type)
    for p in POINTS:
        points.InsertNextPoint(p)
    grid.SetPoints(points)
    region.SetName("in_region")
    cells = [(t, v, r) for _, _, t, v, _, r in ELEMENTS]
    for cell_type, _, v in BOUNDARY:
        cells.insert(1, (cell_type, v, 1))
    for cell_type, v, in_region in cells:
        if cell_type == vtk.VTK_WEDGE:
            v = [v[i] for i in VTK_WEDGE_ORDER]
        grid.InsertNextCell(cell_type, len(v), v)
        region.InsertNextValue(in_region)
    grid.GetCellData().AddArray(region)
    return grid


def write_vtk(directory):
    """Yields path and error expected."""
    encodings = itertools.product([("ascii", 0, 0), ("binary", 1, 0), ("base64", 2, 1), ("raw", 2, 0)],
                                  ["None", "ZLib", "LZ4", "LZMA"], [32, 64], [vtk.VTK_FLOAT, vtk.VTK_DOUBLE])
    for (name, mode, encode), compressor, header, point_type in encodings:
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetInputData(vtk_grid(point_type))
        writer.SetDataMode(mode)
        writer.SetEncodeAppendedData(encode)
        getattr(writer, "SetCompressorTypeTo" + compressor)()
        getattr(writer, "SetHeaderTypeToUInt%d" % header)()
        # In several blocks.
        writer.SetBlockSize(64)
        if header == 32:
            writer.SetIdTypeToInt32()
        path = os.path.join(directory, "vtk_%s_%s_%d_%d.vtu" % (name, compressor, header, point_type))
        writer.SetFileName(path)
        writer.Write()
        is_compressed = 'compressor="' in open(path, "rb").read(1000).decode("latin-1")
        yield path, "compressed by" if is_compressed and compressor in ("LZ4", "LZMA") else None

    # Second order.
    grid = vtk_grid(vtk.VTK_DOUBLE)
    grid.InsertNextCell(vtk.VTK_QUADRATIC_TETRA, 10, list(range(10)))
    grid.GetCellData().RemoveArray("in_region")
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetCompressorTypeToNone()
    path = os.path.join(directory, "vtk_quadratic.vtu")
    writer.SetFileName(path)
    writer.Write()
    yield path, "higher order (VTK's type 24)"


def write_gmsh(directory):
    """Yields path and error expected. Node tags have gaps."""
    tag = [10 * i + 7 for i in range(len(POINTS))]
    mesh = gmsh.model.mesh
    for entity in ((0, 1), (1, 1), (2, 1), (3, 1), (3, 2)):
        gmsh.model.addDiscreteEntity(*entity)
    mesh.addNodes(2, 1, tag[:4], [x for p in POINTS[:4] for x in p])
    mesh.addNodes(3, 2, tag[4:], [x for p in POINTS[4:] for x in p])
    for number, (_, gmsh_type, v) in enumerate(BOUNDARY):
        dimension = {15: 0, 1: 1, 2: 2, 3: 2}[gmsh_type]
        mesh.addElements(dimension, 1, [gmsh_type], [[50 - number]], [[tag[i] for i in v]])
    for number, (_, gmsh_type, _, v, _, in_region) in enumerate(ELEMENTS):
        mesh.addElements(3, 1 if in_region else 2, [gmsh_type], [[100 + 3 * number]], [[tag[i] for i in v]])
    gmsh.model.addPhysicalGroup(3, [1], 5)
    gmsh.model.setPhysicalName(3, 5, "region")
    gmsh.model.addPhysicalGroup(3, [2], 6)
    gmsh.model.setPhysicalName(3, 6, "the rest")
    gmsh.model.addPhysicalGroup(2, [1], 5)

    def write(name, version, binary):
        path = os.path.join(directory, name)
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        # Format 2.2 has no groups if all is saved.
        gmsh.option.setNumber("Mesh.SaveAll", version == 4.1)
        gmsh.write(path)
        return path

    for version, binary in itertools.product((2.2, 4.1), (0, 1)):
        yield write("gmsh_%s_%d.msh" % (version, binary), version, binary), None
    yield write("gmsh_4.0.msh", 4.0, 0), "unknown version"
    gmsh.clear()
    # Meshed by Gmsh: parametric nodes, first and second order.
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.SaveParametric", 1)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.4)
    mesh.generate(3)
    for binary in (0, 1):
        yield write("gmsh_box_%d.msh" % binary, 4.1, binary), "box"
    mesh.setOrder(2)
    gmsh.option.setNumber("Mesh.SaveParametric", 0)
    for version, binary in itertools.product((2.2, 4.1), (0, 1)):
        yield write("gmsh_quadratic_%s_%d.msh" % (version, binary), version, binary), "of higher order"


def main():
    program, directory = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "."
    os.makedirs(directory, exist_ok=True)
    gmsh.initialize(["gmsh"])
    gmsh.option.setNumber("General.Terminal", 0)
    files = list(write_vtk(directory)) + list(write_gmsh(directory))
    gmsh.finalize()
    run = subprocess.run([program, "test_io_read", "--files"] + [path for path, _ in files], stdout=subprocess.PIPE,
                         universal_newlines=True, check=False)
    check(run.returncode == 0, "exit status", run.returncode)
    lines = run.stdout.splitlines()
    check(len(lines) == len(files), "number of answers")
    without_zlib = 0
    for (path, expected), line in zip(files, lines):
        if not line.startswith("{"):
            if "without zlib" in line and "ZLib" in path:
                without_zlib += 1
            else:
                check(expected and expected in line, line)
            continue
        check(expected in (None, "box"), path, "is read")
        read = json.loads(line)
        if expected == "box":
            volumes = [volume for _, volume, _ in read["elements"]]
            check(min(volumes) > 0 and abs(sum(volumes) - 1) < 1e-9, path, "volumes", sum(volumes))
            continue
        check(read["vertices"] == len(POINTS), path, "vertices")
        check(read["boundary_faces"] == 14, path, "boundary", read["boundary_faces"])
        check(len(read["elements"]) == len(ELEMENTS), path, "elements")
        # Gmsh sorts by type for format 2.2, and numbers anew.
        is_sorted = "gmsh_2.2" in path
        wanted = sorted(ELEMENTS, key=lambda e: e[1] if is_sorted else 0)
        for (kind, volume, in_region), element in zip(read["elements"], wanted):
            check(kind == element[0], path, kind, element[0])
            check(abs(volume - element[4]) < 1e-12, path, kind, "volume", volume)
            check(in_region == element[5], path, kind, "in region")
    check(without_zlib in (0, 16), "compressed files that were not read:", without_zlib)
    return exit_code(f"{len(files)} files")


if __name__ == "__main__":
    sys.exit(main())
