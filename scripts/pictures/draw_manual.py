#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of the manual that explain: templates, and what each parameter does.

  /usr/bin/python3 scripts/pictures/draw_manual.py MESHER FOLDER      FOLDER is doc/Mixed_mesh_3/fig, for example

Templates come from the table of the package. Parameters are shown by slices of meshes of the bundled brain, along the
axis of the region of interest, which MESHER makes. Needs matplotlib, numpy and VTK; takes two minutes.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import vtk  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402
from vtk.util.numpy_support import vtk_to_numpy  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = ROOT / "include/CGAL/Mixed_mesh_3/internal/transitions/transition_tables.h"
# By kind, as in render_mesh.py, with the faces of each (see Mixed_element_traits_3.h).
NAMES = ("tetrahedron", "pyramid", "prism", "hexahedron")
COLORS = ((0.97, 0.80, 0.36), (0.90, 0.45, 0.27), (0.55, 0.42, 0.68), (0.42, 0.65, 0.83))
SIZES = (4, 5, 6, 8)
FACES = (
    ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)),
    ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
)
# What is drawn, by what the table says of it: the first class with these elements.
TEMPLATES = (
    ("one split edge", "4 pyramids;"),
    ("one refined face\n(the paper's figure 5)", "5 pyramids, 4 tetrahedra;"),
    ("two refined faces, adjacent", "2 prisms, 6 pyramids, 3 tetrahedra;"),
    ("two refined faces, opposite", "4 hexahedra;"),
    ("three refined faces at a corner:\na vertex at the center", "12 pyramids, 12 tetrahedra;"),
    ("all edges split", "8 hexahedra;"),
)
# Name of the picture, and for each slice a caption and options.
BUDGET = ["--vertices", "2000"]
PARAMETERS = (
    ("parameter_budget", [(f"{n:,} vertices", ["--vertices", str(n)]) for n in (660, 2000, 10000)]),
    ("parameter_grading", [(f"grading {g}", ["--vertices", "5000", "--grading", str(g)]) for g in (0, 0.35, 2)]),
    (
        "parameter_tolerance",
        [
            ("tolerance 30 mm: as without", BUDGET + ["--tolerance", "30"]),
            ("default tolerance: 4.1 mm", BUDGET),
            ("tolerance 3 mm", BUDGET + ["--tolerance", "3"]),
        ],
    ),
    (
        "parameter_region",
        [
            ("no region", None),
            ("region", BUDGET),
            ("and another one, of weight 32", BUDGET + ["--region", "SECOND:32"]),
        ],
    ),
    (
        "parameter_base_level",
        [(f"base level {b}", BUDGET + ["--base-level", str(b), "--tolerance", "30"]) for b in (2, 3, 4)],
    ),
    (
        "parameter_fit",
        [
            ("not fitted", BUDGET + ["--no-fit"]),
            ("Algorithm 1", BUDGET + ["--no-optimize"]),
            ("default", BUDGET),
        ],
    ),
    (
        "parameter_templates",
        [
            ("default", ["--vertices", "660"]),
            ("centered templates", ["--vertices", "660", "--templates", "centered"]),
            ("parity mode", ["--vertices", "660", "--mode", "paper"]),
        ],
    ),
    ("parameter_root", [("cubes", BUDGET), ("bounding box", BUDGET + ["--root", "box"])]),
)


def read_templates():
    """(comment, [(kind, vertices)]) of each class, in the order of the table."""
    classes = []
    for match in re.finditer(r"// 0x\w+: ([^\n]+)\n((?:\s+[\dx][^\n]*\n)+)", TABLE.read_text()):
        numbers = [int(n, 0) for n in re.findall(r"0x\w+|\d+", match.group(2))]
        elements, i = [], 2
        while i < len(numbers):
            kind = numbers[i]
            elements.append((kind, numbers[i + 1:i + 1 + SIZES[kind]]))
            i += 1 + SIZES[kind]
        assert len(elements) == numbers[1]
        classes.append((match.group(1), elements))
    return classes


def draw_templates(path):
    classes = read_templates()
    figure = plt.figure(figsize=(11, 7.6))
    lattice = np.array([(i % 3, i // 3 % 3, i // 9) for i in range(27)], float)
    for i, (caption, elements_wanted) in enumerate(TEMPLATES):
        elements = next(e for comment, e in classes if comment.startswith(elements_wanted))
        axes = figure.add_subplot(2, 3, i + 1, projection="3d", proj_type="ortho")
        for kind, vertices in elements:
            points = lattice[vertices]
            center = points.mean(axis=0)
            points = points + 0.35 * (center - 1) # apart from each other
            axes.add_collection3d(
                Poly3DCollection(
                    [points[list(face)] for face in FACES[kind]],
                    facecolor=COLORS[kind], edgecolor="#333333", linewidths=0.7, alpha=0.92,
                )
            )
        axes.set(xlim=(-0.3, 2.3), ylim=(-0.3, 2.3), zlim=(-0.3, 2.3))
        axes.view_init(24, -58)
        axes.set_axis_off()
        counts = [sum(1 for kind, _ in elements if kind == k) for k in range(4)]
        says = ", ".join(
            f"{n} {NAMES[k] if n == 1 else NAMES[k].replace('hedron', 'hedra') + 's' * (k in (1, 2))}"
            for k, n in enumerate(counts) if n
        )
        axes.set_title(f"{caption}\n{says}", fontsize=11, y=0.93)
    for kind, name in enumerate(NAMES):
        figure.text(0.3 + 0.12 * kind, 0.02, name, color="black", fontsize=11, ha="center",
                    bbox={"facecolor": COLORS[kind], "edgecolor": "#333333", "pad": 4})
    figure.subplots_adjust(0.01, 0.05, 0.99, 0.94, 0, 0.12)
    figure.savefig(path, dpi=100)
    plt.close(figure)


def read_surface(path):
    reader = vtk.vtkOFFReader() if hasattr(vtk, "vtkOFFReader") else None
    if reader is not None:
        reader.SetFileName(str(path))
        reader.Update()
        return vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
    numbers = [line.split() for line in path.read_text().splitlines() if line and not line.startswith("#")]
    counts = [int(n) for n in (numbers[0][1:] or numbers[1])]
    rows = numbers[1:] if numbers[0][1:] else numbers[2:]
    return np.array([[float(x) for x in row[:3]] for row in rows[:counts[0]]])


class Plane:
    """The plane of the region's axis that is nearest to a sagittal one, and coordinates in it."""

    def __init__(self, region):
        self.origin = region.mean(axis=0)
        axis = np.linalg.svd(region - self.origin)[2][0]
        self.normal = np.array([1.0, 0, 0]) - axis[0] * axis
        self.normal /= np.linalg.norm(self.normal)
        up = np.array([0, 0, 1.0]) - self.normal[2] * self.normal
        self.up = up / np.linalg.norm(up)
        self.right = np.cross(self.up, self.normal)

    def polygons(self, path):
        """Cuts of the elements, and whether each is in the region."""
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        points = vtk_to_numpy(grid.GetPoints().GetData()) - self.origin
        heights = points @ self.normal
        flat = np.stack([points @ self.right, points @ self.up], axis=1)
        in_region = vtk_to_numpy(grid.GetCellData().GetArray("in_region"))
        polygons, colors = [], []
        ids = vtk.vtkIdList()
        for e in range(grid.GetNumberOfCells()):
            grid.GetCellPoints(e, ids)
            vertices = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
            h = heights[vertices]
            if h.min() >= 0 or h.max() <= 0:
                continue
            cell, cut = grid.GetCell(e), []
            for i in range(cell.GetNumberOfEdges()):
                edge = cell.GetEdge(i)
                a, b = edge.GetPointId(0), edge.GetPointId(1)
                if (heights[a] < 0) != (heights[b] < 0):
                    t = heights[a] / (heights[a] - heights[b])
                    cut.append((1 - t) * flat[a] + t * flat[b])
            cut = np.array(cut)
            from_center = cut - cut.mean(axis=0)
            polygons.append(cut[np.argsort(np.arctan2(from_center[:, 1], from_center[:, 0]))])
            colors.append("#e9a8c6" if in_region[e] else "#dfe6ee")
        return polygons, colors


def draw_parameters(mesher, folder):
    data = ROOT / "data"
    plane = Plane(read_surface(data / "region.off"))
    with tempfile.TemporaryDirectory() as work:
        second = pathlib.Path(work) / "second.off" # an octahedron at the back
        center, r = plane.origin + 60 * plane.right * BACK - 5 * plane.up, 12
        ends = [center + s * r * axis for axis in np.eye(3) for s in (1, -1)]
        second.write_text(
            "OFF\n6 8 0\n" + "".join("%g %g %g\n" % tuple(p) for p in ends)
            + "".join(f"3 {i} {j} {k}\n" if (i + j + k) % 2 == 0 else f"3 {i} {k} {j}\n"
                      for i in (0, 1) for j in (2, 3) for k in (4, 5))
        )
        for name, slices in PARAMETERS:
            figure, all_axes = plt.subplots(1, len(slices), figsize=(4 * len(slices), 3.5))
            for axes, (caption, options) in zip(all_axes, slices):
                mesh = pathlib.Path(work) / "mesh.vtu"
                mesh.unlink(missing_ok=True)
                regions = [] if options is None else ["--region", str(data / "region.off")]
                options = [o.replace("SECOND", str(second)) for o in options or BUDGET]
                command = [mesher, str(data / "brain.off"), *regions, *options, "--quiet", "--output", str(mesh)]
                subprocess.run(command, check=True)
                polygons, colors = plane.polygons(mesh)
                if options == BUDGET and not regions:
                    colors = ["#dfe6ee"] * len(colors) # everywhere is in the region
                axes.add_collection(PolyCollection(polygons, facecolors=colors, edgecolors="#333333", linewidths=0.4))
                corners = np.concatenate(polygons)
                (x0, y0), (x1, y1) = corners.min(axis=0) - 2, corners.max(axis=0) + 2
                axes.set_aspect("equal")
                axes.set_axis_off()
                axes.set_title(caption, fontsize=11)
            for axes in all_axes: # all alike, whatever the boundary is
                axes.set(xlim=(x0, x1), ylim=(y0, y1))
            figure.tight_layout()
            figure.savefig(folder / f"{name}.png", dpi=80, bbox_inches="tight")
            plt.close(figure)


BACK = -1 # the direction of the second region, seen in the plane


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2])
    draw_templates(folder / "templates.png")
    draw_parameters(sys.argv[1], folder)


if __name__ == "__main__":
    main()
