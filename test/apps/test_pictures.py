#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Peers read the brain's mesh with the same volume, and its pictures are drawn.

  test_pictures.py MESHER REPOSITORY WORK_DIRECTORY
"""

import json
import pathlib
import shutil
import subprocess
import sys

try:
    import gmsh
    import vtk
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

MESHER, REPOSITORY, WORK = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
DATA = REPOSITORY / "data"


def vtk_volume(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputConnection(reader.GetOutputPort())
    sizes.Update()
    grid = sizes.GetOutput()
    volumes = grid.GetCellData().GetArray("Volume")
    cells = [volumes.GetValue(i) for i in range(grid.GetNumberOfCells())]
    assert min(cells) > 0
    for name in ("kind", "ARC", "in_region"):
        assert grid.GetCellData().GetArray(name).GetNumberOfTuples() == len(cells)
    return grid.GetNumberOfPoints(), len(cells), sum(cells)


def gmsh_volume(path):
    """From the determinants at the centers and corners of Gmsh's own elements: all are positive; the
    volume is that of the tetrahedra from the centroid over Gmsh's faces."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(path))
    total, count = 0.0, 0
    for kind in gmsh.model.mesh.getElementTypes(3):
        tags, _ = gmsh.model.mesh.getElementsByType(kind)
        points, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss4")
        _, determinants, _ = gmsh.model.mesh.getJacobians(kind, points)
        assert min(determinants) > 0
        # Gmsh 4.8 has pyramid weights that sum to 16/9 instead of the volume 4/3
        scale = (4 / 3) / sum(weights) if kind == 7 else 1
        n = len(weights)
        total += scale * sum(d * weights[i % n] for i, d in enumerate(determinants))
        count += len(tags)
    gmsh.finalize()
    return count, total


def test_measures():
    """Names of directions, and lengths of bars."""
    sys.path.insert(0, str(REPOSITORY / "scripts" / "pictures"))
    sys.dont_write_bytecode = True
    import render_mesh
    for direction, ras, lps in (((1, 0, 0), "R", "L"), ((-1, 0, 0), "L", "R"), ((0, 1, 0), "A", "P"),
                                ((0, 0, -1), "I", "I"), ((0.6, -0.8, 0), "PR", "AL"), ((0.1, 0.2, 0.97), "S", "S")):
        assert render_mesh.direction_name("ras", direction) == ras
        assert render_mesh.direction_name("lps", direction) == lps
        assert render_mesh.direction_name("none", direction) == ""
    for pixels_per_mm, most, length in ((1, 240, 200), (1, 199, 100), (2.4, 240, 100), (1000, 240, 0.2), (0.01, 100, 1e4)):
        assert abs(render_mesh.bar_length(pixels_per_mm, most) / length - 1) < 1e-12


def main():
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    report = WORK / "brain.json"
    files = [WORK / "brain.vtu", WORK / "brain.msh", WORK / "brain.msh2"]
    # Fitted elements have warped faces: VTK splits them to tetrahedra, and the Gauss points that Gmsh has for
    # pyramids do not integrate the rational Jacobian exactly.
    for arguments, vtk_error, gmsh_error in ((["--no-fit"], 1e-9, 1e-6), ([], 5e-3, 1e-4)):
        subprocess.run([MESHER, DATA / "brain.off", "--region", DATA / "region.off", "--vertices", "660", "--report",
                        report] + arguments + [x for f in files for x in ("--output", f)], check=True)
        mesh = json.loads(report.read_text())["mesh"]
        points, cells, volume = vtk_volume(files[0])
        assert (points, cells) == (mesh["vertices"], mesh["elements"])
        assert abs(volume / mesh["volume"] - 1) < vtk_error, (volume, mesh["volume"])
        for path in files[1:]:
            cells, volume = gmsh_volume(path)
            assert cells == mesh["elements"]
            assert abs(volume / mesh["volume"] - 1) < gmsh_error, (volume, mesh["volume"])

    subprocess.run(["/usr/bin/python3", REPOSITORY / "scripts" / "pictures" / "render_mesh.py", files[0], "--surface",
                    DATA / "brain.off", "--region", DATA / "region.off", "--output-prefix", WORK / "brain",
                    "--size", "800x600"], check=True)
    pictures = {name: (800, 600) for name in ("surface", "kinds", "ARC")}
    assert not (WORK / "brain_labels.png").exists()  # there is one subdomain
    test_measures()
    unfitted = WORK / "unfitted.json"  # has no mesh before fitting
    subprocess.run([MESHER, DATA / "brain.off", "--vertices", "660", "--no-fit", "--report", unfitted], check=True)
    for name, told in (("quality", report), ("unfitted_quality", unfitted)):
        subprocess.run(["/usr/bin/python3", REPOSITORY / "scripts" / "pictures" / "plot_quality.py", told,
                        WORK / f"brain_{name}.png"], check=True)
        pictures[name] = (1600, 1000)
    for name, size in pictures.items():
        reader = vtk.vtkPNGReader()
        reader.SetFileName(str(WORK / f"brain_{name}.png"))
        reader.Update()
        picture = reader.GetOutput()
        assert picture.GetDimensions()[:2] == size
        colors = {tuple(picture.GetScalarComponentAsDouble(x, y, 0, k) for k in range(3))
                   for x in range(0, size[0], 7) for y in range(0, size[1], 7)}
        assert len(colors) > 30, name
    print("no errors detected")


main()
