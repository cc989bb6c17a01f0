#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package: arrays against the files of the programs, errors, interruption, and the wheel.

  test_python.py BUILD SOURCE FOLDER        BUILD holds bin/ and python/
"""

import base64
import copy
import ctypes
import json
import os
import pathlib
import pickle
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

BUILD, SOURCE, FOLDER = (pathlib.Path(a).resolve() for a in sys.argv[1:4])
if not list((BUILD / "python" / "mixed_mesh_3").glob("_core*")):
    print("skipped: the module was not built, see MIXED_MESH_3_BUILD_PYTHON")
    sys.exit(77)
sys.path.insert(0, str(BUILD / "python"))
import browser  # noqa: E402
from cube import off  # noqa: E402
import mixed_mesh_3 as mm3  # noqa: E402

DATA = SOURCE / "data"
GUIDE = SOURCE / "doc" / "guides" / "python_user.txt"


def read_off(path):
    words = path.read_text().split()
    n, m = int(words[1]), int(words[2])
    points = np.array(words[4:4 + 3 * n], dtype=float).reshape(n, 3)
    return points, np.array(words[4 + 3 * n:4 + 3 * n + 4 * m], dtype=int).reshape(m, 4)[:, 1:]


BRAIN, REGION, TUMOR = (read_off(DATA / f"{name}.off") for name in ("brain", "region", "tumour"))
CUBE = (np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float),
        np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                  [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]))


def blas_threads():
    """The functions of OpenBLAS that tell and set how many threads NumPy has there; None with another BLAS."""
    for line in pathlib.Path("/proc/self/maps").read_text().splitlines():
        if "libopenblas" in line:
            library = ctypes.CDLL(line.split(maxsplit=5)[5])
            return library.openblas_get_num_threads, library.openblas_set_num_threads
    return None


def read_vtu(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    cells = {}
    for i in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(i)
        ids = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
        cells.setdefault(cell.GetCellType(), []).append(ids)
    return vtk_to_numpy(grid.GetPoints().GetData()), {kind: np.array(v) for kind, v in cells.items()}


def star(points):
    """A prism over a star with points that are too sharp for few vertices."""
    n = 2 * points
    angles, radii = np.arange(n) * np.pi / points, np.where(np.arange(n) % 2, 0.3, 1)
    ring = np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])
    corners = [(*p, z) for z in (0, 0.5) for p in ring] + [(0, 0, 0), (0, 0, 0.5)]
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        triangles += [(i, j, n + j), (i, n + j, n + i), (j, i, 2 * n), (n + i, n + j, 2 * n + 1)]
    return np.array(corners), np.array(triangles)


class Test(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        cls.mesh, cls.report = mm3.mesh(*BRAIN, region=REGION, vertices=660)

    def run_program(self, name, *arguments):
        subprocess.run([BUILD / "bin" / name, *map(str, arguments)], check=True, cwd=FOLDER,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def brain_file(self):
        if not (FOLDER / "brain.vtu").exists():
            self.run_program("mixed_mesh_3", DATA / "brain.off", "--region", DATA / "region.off", "--vertices", 660,
                             "--output", "brain.vtu", "--report", "brain.json")
        return FOLDER / "brain.vtu"

    def test_same_bytes_as_program(self):
        points, cells = read_vtu(self.brain_file())
        self.assertEqual(points.tobytes(), np.array(self.mesh.points).tobytes())
        vtk_types = {"tetra": 10, "pyramid": 14, "wedge": 13, "hexahedron": 12}
        self.assertEqual({vtk_types[k] for k in self.mesh.cells}, set(cells))
        for kind, v in self.mesh.cells.items():
            v = v[:, [0, 2, 1, 3, 5, 4]] if kind == "wedge" else v
            np.testing.assert_array_equal(v, cells[vtk_types[kind]])
        report = json.loads((FOLDER / "brain.json").read_text())
        self.assertEqual(self.report["status"], report["status"])
        arc = mm3.quality(self.mesh)
        for kind, name in (("tetra", "tetrahedra"), ("hexahedron", "hexahedra")):
            self.assertAlmostEqual(arc[self.mesh.kinds == mm3.KINDS.index(kind)].mean(),
                                   report["quality"]["after"][name]["ARC mean"])

    def test_mesh_is_certified(self):
        self.assertTrue(mm3.certify(self.mesh).all())
        self.assertEqual(set(mm3.defects(self.mesh).values()), {0})
        self.assertEqual(self.report["status"], "success")
        self.assertLessEqual(mm3.quality(self.mesh).max(), 3.2)
        self.assertAlmostEqual(mm3.quality(self.mesh, "volume").sum(), self.report["volume"], delta=1)
        self.assertTrue(self.mesh.in_region.any() and not self.mesh.in_region.all())

    def test_arrays_live_as_long_as_they_are_used(self):
        mesh, _ = mm3.mesh(*CUBE, vertices=100)
        points = mesh.points
        copy = points.copy()
        del mesh
        mm3.mesh(*CUBE, vertices=200)
        np.testing.assert_array_equal(points, copy)
        with self.assertRaises(ValueError):
            points[0, 0] = 1

    def test_arrays_make_a_mesh(self):
        m = self.mesh
        again = mm3.Mesh(m.points, m.kinds, m.connectivity, m.labels)
        np.testing.assert_array_equal(again.points, m.points)
        np.testing.assert_array_equal(again.connectivity, m.connectivity)
        swapped = m.connectivity.copy()
        first = m.offsets[np.flatnonzero(m.kinds == 0)[0]]
        swapped[[first, first + 1]] = swapped[[first + 1, first]]
        inverted = mm3.Mesh(m.points, m.kinds, swapped)
        self.assertEqual((~mm3.certify(inverted)).sum(), 1)
        self.assertGreater(mm3.defects(inverted)["nonpositive elements"], 0)
        with self.assertRaisesRegex(ValueError, "inverted"):
            mm3.optimize(inverted, *BRAIN)
        with self.assertRaisesRegex(ValueError, "element 0 has the vertex 99999, which does not exist"):
            mm3.Mesh(m.points, [0], [0, 1, 2, 99999])
        with self.assertRaisesRegex(ValueError, "ends before"):
            mm3.Mesh(m.points, [0], [0, 1, 2])

        # Of cells: a dictionary of kinds, as a mesh has it, or elements of one kind.
        again = mm3.Mesh(m.points, m.cells, labels=m.labels, in_region=m.in_region)
        for name in ("points", "kinds", "connectivity", "offsets", "labels", "in_region"):
            np.testing.assert_array_equal(getattr(again, name), getattr(m, name))
        for kind, cells in m.cells.items():
            one = mm3.Mesh(m.points, cells.tolist(), labels=np.full(len(cells), 5))
            self.assertEqual((list(one.cells), set(one.labels)), ([kind], {5}))
            np.testing.assert_array_equal(one.cells[kind], cells)
        for cells, text in (([[0, 1, 2]], r"shape \(n, 4\), \(n, 5\), \(n, 6\) or \(n, 8\)"), ([0, 1, 2, 3], "shape"),
                            ({"tetra": [[0] * 8]}, "a tetra does not have 8 vertices"), ({"quad": [[0] * 4]}, "'quad'")):
            with self.assertRaisesRegex(ValueError, text):
                mm3.Mesh(m.points, cells)
        with self.assertRaisesRegex(ValueError, "and labels="):
            mm3.Mesh(m.points, m.cells["tetra"], np.ones(len(m.cells["tetra"]), int))

    def test_read_mesh(self):
        """What is saved is read back, with labels, names and data."""
        labels = np.arange(len(self.mesh.kinds)) % 2 + 1
        mesh = mm3.Mesh(self.mesh.points, self.mesh.cells, labels=labels)
        mesh.names = {2: "tumor"}
        self.assertEqual(pickle.loads(pickle.dumps(mesh)).names, {2: "tumor"})
        copied = copy.copy(mesh)
        copied.names = {2: "other"}
        self.assertEqual(mesh.names, {2: "tumor"})
        shift = np.random.default_rng(1).random((len(mesh.points), 3))
        for name in ("named.vtu", "named.msh"):
            data = {"cell_data": {"size": mm3.quality(mesh, "volume")}} if name.endswith("vtu") else {}
            mesh.save(FOLDER / name, point_data={"shift": shift, "height": mesh.points[:, 2]}, **data)
            again = mm3.read_mesh(FOLDER / name)
            self.assertEqual(again.names, {2: "tumor"})
            np.testing.assert_array_equal(again.points, mesh.points)
            self.assertEqual(np.bincount(again.labels).tolist(), np.bincount(labels).tolist())
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(FOLDER / "named.vtu"))
        reader.Update()
        grid = reader.GetOutput()
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetPointData().GetArray("shift")), shift)
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetPointData().GetArray("height")), mesh.points[:, 2])
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetCellData().GetArray("size")), mm3.quality(mesh, "volume"))
        mesh.save(FOLDER / "renamed.vtu", names={1: "brain"})
        self.assertEqual(mm3.read_mesh(FOLDER / "renamed.vtu").names, {1: "brain"})
        for name, data, text in (("a.inp", {"u": shift}, 'data "u" can be written to'),
                                 ("a.vtu", {"u": shift[1:]}, 'data "u" does not have the size')):
            with self.assertRaisesRegex(ValueError, text):
                mesh.save(FOLDER / name, point_data=data)
        (FOLDER / "bad.vtu").write_text("no mesh")
        with self.assertRaisesRegex(ValueError, "bad.vtu: "):
            mm3.read_mesh(FOLDER / "bad.vtu")

    def test_from_meshio(self):
        try:
            import meshio
        except ImportError as missing:
            self.skipTest(missing)
        m = self.mesh
        labels = [m.labels[m.kinds == mm3.KINDS.index(kind)] + 6 for kind in m.cells]
        triangles = ("triangle", np.zeros((2, 3), int))
        there = meshio.Mesh(m.points, [triangles, *m.cells.items()],
                            cell_data={"gmsh:physical": [np.array([1, 1]), *labels]},
                            field_data={"tissue": np.array([7, 3]), "skin": np.array([1, 2])})
        again = mm3.from_meshio(there)
        for name in ("points", "kinds", "connectivity"):
            np.testing.assert_array_equal(getattr(again, name), getattr(m, name))
        self.assertEqual((set(again.labels), again.names), ({7}, {7: "tissue"}))
        again = mm3.from_meshio(m.to_meshio())
        np.testing.assert_array_equal(again.labels, m.labels)
        with self.assertRaisesRegex(ValueError, "expected cells of the types"):
            mm3.from_meshio(meshio.Mesh(m.points, [triangles]))

    def test_errors_are_those_of_the_program(self):
        points, triangles = CUBE
        for text, arguments, options, error in [
            ("surface: face 2 has a vertex that does not exist", (points, np.where(triangles == 6, 99, triangles)),
             {}, ValueError),
            ("surface: vertex 2 has a coordinate that is not a finite number",
             (np.where(np.arange(8)[:, None] == 2, np.nan, points), triangles), {}, ValueError),
            ("surface: the surface is flat", (points * [1, 1, 0], triangles), {}, ValueError),
            ("too small, the coarsest mesh of surface", CUBE, {"vertices": 4, "base_level": 3}, mm3.MeshingError),
            ("the region does not meet the domain", CUBE, {"region": (points + 10, triangles)}, mm3.MeshingError),
            ("region: the weight is not positive", CUBE, {"region": (points, triangles, 0)}, ValueError),
            (r"surface: expected an array of shape \(n, 3\)", (points[:, :2], triangles), {}, ValueError),
        ]:
            with self.assertRaisesRegex(error, text):
                mm3.mesh(*arguments, **options)

    def test_progress_and_interruption(self):
        calls = []
        mm3.mesh(*CUBE, vertices=300, progress=lambda *c: calls.append(c))
        self.assertTrue({stage for stage, _, _ in calls} >= {"octree", "optimization"})

        def fail(*_):
            raise KeyError("enough")
        with self.assertRaisesRegex(KeyError, "enough"):
            mm3.mesh(*CUBE, vertices=300, progress=fail)
        threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        start = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            mm3.mesh(*BRAIN, vertices=300000)
        self.assertLess(time.monotonic() - start, 60)

    def test_warnings(self):
        """What a report warns of is a warning: a boundary off the surface, and a surface that is mended."""
        inner = {label: (CUBE[0] * 0.3 + shift, CUBE[1]) for label, shift in ((2, 0.6), (3, 0.1))}
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh, report = mm3.mesh(*CUBE, subdomains=inner, region=((0.5, 0.5, 0.5), 0.2), vertices=2000,
                                    simplification=False)
        self.assertGreater(report["boundary vertices not on surface"], 0)
        self.assertEqual([str(w.message) for w in caught], report["warnings"])
        self.assertEqual({w.filename for w in caught}, {__file__})
        self.assertRegex("\n".join(report["warnings"]), r"\d+ of \d+ boundary vertices are not on surface: elements would be "
                         "worse than quality_bound allows, or inverted")
        with self.assertWarnsRegex(UserWarning, "surface: .*filled 1 hole"):
            mm3.mesh(CUBE[0], CUBE[1][1:], vertices=100)
        with self.assertWarnsRegex(UserWarning, "surface: .*filled 1 hole"):
            mm3.optimize(mm3.mesh(*CUBE, vertices=100)[0], CUBE[0], CUBE[1][1:])
        with self.assertWarnsRegex(UserWarning, "only .* % of the length of the sharp edges of surface is kept"):
            mm3.mesh(*star(8), region=((0, 0, 0.25), 0.3), vertices=300)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            mm3.mesh(*CUBE, vertices=100)

    def test_parts(self):
        """Names of subdomains, a ball as region, cavities, sheets, and threads."""
        points, triangles = CUBE
        inner = lambda size, shift: (points * size + shift, triangles)
        mesh, _ = mm3.mesh(*CUBE, subdomains={"left": inner(0.3, 0.1), 2: inner(0.3, 0.6)}, vertices=2000)
        self.assertEqual((set(mesh.labels), mesh.names), ({1, 2, 3}, {3: "left"}))
        centers = {label: np.mean([mesh.points[mesh.connectivity[a:b]].mean(axis=0) for a, b, l in
                                   zip(mesh.offsets, mesh.offsets[1:], mesh.labels) if l == label]) for label in (2, 3)}
        self.assertAlmostEqual(centers[3], 0.25, delta=0.05)
        self.assertAlmostEqual(centers[2], 0.75, delta=0.05)
        np.testing.assert_array_equal(mm3.resect(mesh, label="left"), mesh.labels == 3)
        for chosen, labels in ((["left"], {3}), ("left", {3}), (1, {1}), ([1, "left"], {1, 3}), (np.array([3, 2, 3]), {2, 3}),
                               ([1, 2, 3], {1, 2, 3})):
            part = mesh.extract(chosen)
            of_mesh = np.flatnonzero(np.isin(mesh.labels, list(labels)))
            self.assertEqual((set(part.labels), part.names), (labels, {3: "left"} if 3 in labels else {}))
            np.testing.assert_array_equal(part.kinds, mesh.kinds[of_mesh])
            np.testing.assert_array_equal(part.points[part.connectivity],
                                          mesh.points[np.hstack([mesh.connectivity[mesh.offsets[e]:mesh.offsets[e + 1]]
                                                                 for e in of_mesh])])
            self.assertAlmostEqual(mm3.quality(part, "volume").sum(), mm3.quality(mesh, "volume")[of_mesh].sum())
            self.assertEqual(sum(mm3.defects(part).values()), 0)  # also a closed manifold
        for chosen, text in ((["right"], "no subdomain with the name 'right'"), ([2, 4], "no element with the label 4"),
                             ([], "at least one"), ([0], "at least 1")):
            with self.assertRaisesRegex(ValueError, text):
                mesh.extract(chosen)
        self.assertIn('[[3, "left"]]', mesh.extract(["left"]).show().html)
        model = mm3.Elasticity(mesh, materials={"left": (10, 0.3)})
        model.fix(np.flatnonzero(mesh.points[:, 2] == 0))
        with self.assertRaisesRegex(ValueError, "no subdomain with the name 'right'"):
            mm3.Elasticity(mesh, materials={"right": (10, 0.3)})
        for vertices, text in (([0, 0], "twice"), ([-1], "from 0 to"), ([0.5], "truth values, or indices")):
            with self.assertRaisesRegex(ValueError, text):
                model.fix(vertices)

        ball, _ = mm3.mesh(*BRAIN, region=((0, 0, 0), 20), vertices=660)
        weighted, _ = mm3.mesh(*BRAIN, region=[((0, 0, 0), 20, 1.0)], vertices=660)
        np.testing.assert_array_equal(ball.points, weighted.points)
        in_ball = np.linalg.norm(ball.points[np.unique(np.concatenate(
            [ball.connectivity[a:b] for a, b, is_in in zip(ball.offsets, ball.offsets[1:], ball.in_region) if is_in]))],
            axis=1)
        self.assertLess(in_ball.min(), 20)
        self.assertLess(in_ball.max(), 20 + 35)  # elements at the ball reach out of it by an edge
        for region, text in ((((0, 0, 0), -1), "radius"), (((0, 0), 1), "three coordinates")):
            with self.assertRaisesRegex(ValueError, text):
                mm3.mesh(*CUBE, region=region)

        hollow, _ = mm3.mesh(*CUBE, cavities=[inner(0.25, 0.25)], vertices=1000)
        self.assertAlmostEqual(mm3.quality(hollow, "volume").sum(), 1 - 1 / 64, delta=1e-3)
        square = (np.array([[0.5, -1, -1], [0.5, 2, -1], [0.5, 2, 2], [0.5, -1, 2]]), np.array([[0, 1, 2], [0, 2, 3]]))
        cut, report = mm3.mesh(*CUBE, sheets=[square], vertices=500)
        sheet, = report["sheets"]
        self.assertAlmostEqual(sheet["area"], 1, delta=0.05)
        self.assertEqual(len(np.unique(sheet["faces"][sheet["faces"] >= 0])), sheet["vertices"])
        np.testing.assert_allclose(cut.points[sheet["faces"][sheet["faces"] >= 0], 0], 0.5,
                                   atol=sheet["largest distance"] + 1e-9)
        with self.assertWarnsRegex(UserWarning, "sheet 0: has no faces"):
            mm3.mesh(*CUBE, sheets=[(square[0] + [3, 0, 0], square[1])], vertices=100)

        one, _ = mm3.mesh(*BRAIN, region=REGION, vertices=660, threads=1)
        np.testing.assert_array_equal(one.points, self.mesh.points)

    def test_patches(self):
        """Patches are those of the program, in files byte for byte; by brute force; as supports. The module has elements sorted
        by kind: with several kinds, elements and nodes of order 2 have other numbers, which .vtu of order 1 has not."""
        points, triangles = CUBE
        slab, region = ((points * size + shift, triangles) for size, shift in ((0.602, [0.199, -0.5, 0.45]), (0.3, 0.6)))
        for name, surface in (("cube", CUBE), ("slab", slab), ("region", region)):
            (FOLDER / f"{name}.off").write_text(off(surface[0].tolist(), triangles.tolist()))
        places = {"Top": ("plane:0.5,0.5,1,0,0,2", {"plane": ((0.5, 0.5, 1), (0, 0, 2))}, lambda c: c[:, 2] > 1 - 1e-6),
                  "base": ("box:0,0,0,1,1,0", {"box": ((0, 0, 0), (1, 1, 0))}, lambda c: c[:, 2] < 1e-6),
                  "ball": ("sphere:1,1,1,0.6", {"sphere": ((1, 1, 1), 0.6)},
                           lambda c: np.linalg.norm(c - 1, axis=1) < 0.6),
                  "slab": (FOLDER / "slab.off", {"surface": slab},
                           lambda c: (np.abs(c[:, 0] - 0.5) < 0.301) & (c[:, 1] < 0.102) & (c[:, 2] > 0.45))}
        for has_one_kind in (True, False):
            mesh, _ = mm3.mesh(*CUBE, vertices=400, **({} if has_one_kind else {"region": region, "simplification": False}))
            self.assertEqual(len(mesh.cells) == 1, has_one_kind)
            faces = mm3.boundary_faces(mesh)
            self.assertEqual(set(np.unique(faces[faces >= 0])), set(np.flatnonzero(mm3.boundary_vertices(mesh))))
            centers = np.array([mesh.points[f[f >= 0]].mean(axis=0) for f in faces])
            patches = {name: mesh.patch(**shape) for name, (_, shape, _) in places.items()}
            for name, patch in patches.items():
                np.testing.assert_array_equal(patch.faces, np.flatnonzero(places[name][2](centers)), name)
                self.assertTrue(0 < len(patch.faces) < len(faces))
                np.testing.assert_array_equal(patch.vertices, np.setdiff1d(faces[patch.faces], [-1]), name)
            files = [(["vtu"], list(places), 1)]
            if has_one_kind:
                files += [(["inp", "feb", "msh"], list(places), 1), (["inp", "feb", "msh", "vtu"], list(places), 2),
                          (["mesh", "msh2"], ["Top", "base"], 1)]
            for endings, names, order in files:
                self.run_program("mixed_mesh_3", "cube.off", "--vertices", 400, "--order", order,
                                 *([] if has_one_kind else ["--region", "region.off", "--no-simplification"]),
                                 *(x for name in names for x in ("--patch", f"{name}={places[name][0]}")),
                                 *(x for ending in endings for x in ("--output", f"patches.{ending}")))
                for ending in endings:
                    saved = FOLDER / f"saved.{ending}"
                    mesh.save(saved, patches={name: patches[name] for name in names}, order=order)
                    self.assertEqual(saved.read_bytes(), (FOLDER / f"patches.{ending}").read_bytes(), (ending, order))
        marks = np.zeros(len(faces), bool)
        marks[patches["Top"].faces] = True
        for top in (marks, patches["Top"].faces, patches["Top"].faces.tolist()):
            mesh.save(FOLDER / "saved.inp", patches={"Top": top})
            self.assertIn("*NSET, NSET=TOP", (FOLDER / "saved.inp").read_text())
        model = mm3.Elasticity(mesh)
        model.fix(patches["base"].vertices)
        model.set_control_points([[0.5, 0.5, 1]])
        self.assertEqual(abs(model.solve([[0, 0, 0.1]])[patches["base"].vertices]).max(), 0)

        with self.assertWarnsRegex(UserWarning, "surface: .*filled 1 hole"):
            np.testing.assert_array_equal(mesh.patch(surface=(slab[0], triangles[1:])).faces, patches["slab"].faces)
        far = "no face of the boundary has its center inside; the mesh is in box:0,0,0,1,1,1$"
        for shape, text in (({"sphere": ((9, 9, 9), 1)}, "^sphere: " + far),
                            ({"surface": (points + 9, triangles)}, "^surface: " + far),
                            ({"sphere": ((0, 0, 0), -1)}, "sphere: the radius of the sphere is not positive"),
                            ({"box": ((0, 0, 1), (1, 1, 0))}, "box: the corners"),
                            ({"plane": ((0, 0, 0), (0, 0, 0))}, "plane: the normal"),
                            ({"sphere": (0, 0, 0, 1)}, r"sphere: expected numbers, \(\(x, y, z\), radius\)"),
                            ({"sphere": ((0, 0, np.nan), 1)}, "sphere: expected"), ({"box": 1}, "box: expected"),
                            ({"plane": ((0, 0, 0), "up")}, "plane: expected"), ({}, "expected one of sphere, box, plane"),
                            ({"sphere": ((0, 0, 0), 1), "box": ((0, 0, 0), (1, 1, 1))}, "expected one of sphere")):
            with self.assertRaisesRegex(ValueError, text):
                mesh.patch(**shape)
        for sets, text in (({"a": []}, "patch a: has no face"), ({"a": [len(faces)]}, "patch a: expected indices from 0 to"),
                           ({"a": marks[1:]}, f"patch a: expected {len(faces)} truth values"),
                           ({"boundary": marks}, '"boundary" needs another name'),
                           ({"a": marks, "A": marks}, '"A" needs another name')):
            with self.assertRaisesRegex(ValueError, text):
                mesh.save(FOLDER / "saved.inp", patches=sets)
        with self.assertRaisesRegex(ValueError, "saved.mesh: two facet sets share a face"):
            mesh.save(FOLDER / "saved.mesh", patches={"a": marks, "b": marks})

    def test_time_limit(self):
        start = time.monotonic()
        with self.assertWarnsRegex(UserWarning, "stopped by time_limit after"):
            mesh, report = mm3.mesh(*BRAIN, vertices=20000, time_limit=2)
        self.assertLess(time.monotonic() - start, 30)
        self.assertEqual(report["status"], "stopped")
        self.assertTrue(mm3.certify(mesh).all())
        with self.assertRaisesRegex(mm3.MeshingError, "stopped before there was a mesh"):
            mm3.mesh(*BRAIN, vertices=20000, time_limit=1e-6)

    def test_subdomains(self):
        mesh, report = mm3.mesh(*BRAIN, region=REGION, subdomains={2: TUMOR}, vertices=1000)
        self.assertEqual(set(mesh.labels), {1, 2})
        self.assertTrue(mm3.certify(mesh).all())
        removed = mm3.resect(mesh, label=2)
        np.testing.assert_array_equal(removed, mesh.labels == 2)

    def test_interfaces_in_files(self):
        """Interfaces are facet sets with the bytes of the program."""
        subprocess.run([BUILD / "bin" / "mixed_mesh_3", DATA / "brain.off", "--subdomain", f"tumor={DATA / 'tumour.off'}",
                        "--vertices", "800", "--quiet", *(x for ending in ("inp", "msh") for x in
                                                          ("--output", FOLDER / f"told.{ending}"))], check=True)
        mesh, _ = mm3.mesh(*BRAIN, subdomains={"tumor": TUMOR}, vertices=800)
        mesh.names = {1: "brain", **mesh.names}
        for ending in ("inp", "msh"):
            saved = FOLDER / f"saved.{ending}"
            mesh.save(saved)
            self.assertEqual(saved.read_bytes(), (FOLDER / f"told.{ending}").read_bytes(), ending)
        self.assertIn("interface_brain_tumor", saved.read_text())
        mesh.save(saved, interfaces=False)
        self.assertNotIn("interface_", saved.read_text())

    def test_labels_of_an_image(self):
        n, affine = 24, np.diag([-2.0, 2.0, 2.0, 1.0])
        affine[:3, 3] = [20, -30, 5]
        x = np.indices((n, n, n)) - (n - 1) / 2
        image = np.where((x ** 2).sum(axis=0) < 100, 1, 0)
        image[(x[0] - 3) ** 2 + x[1] ** 2 + x[2] ** 2 < 16] = 7
        mesh, report = mm3.mesh_labels(image, affine, vertices=800)
        self.assertEqual(set(mesh.labels), {1, 7})
        self.assertEqual(report["labels lost"], [])
        self.assertTrue(mm3.certify(mesh).all())
        volumes = mm3.quality(mesh, "volume")
        self.assertAlmostEqual(volumes.sum() / ((image > 0).sum() * 8), 1, delta=0.05)
        center = affine @ [(n - 1) / 2 + 3, (n - 1) / 2, (n - 1) / 2, 1]
        inner = mesh.points[np.unique(np.concatenate(
            [mesh.connectivity[a:b] for a, b, label in zip(mesh.offsets, mesh.offsets[1:], mesh.labels) if label == 7]))]
        np.testing.assert_allclose(inner.mean(axis=0), center[:3], atol=1)
        mesh, _ = mm3.mesh_labels(image, affine, vertices=800, region_labels=[7], names={1: "brain", 7: "tumor"})
        self.assertEqual(mesh.names, {1: "brain", 7: "tumor"})
        self.assertTrue(0 < mesh.in_region.mean() < 1)
        hollow = np.where((x ** 2).sum(axis=0) < 16, 0, image)  # what the hull fills belongs to the label around
        whole, _ = mm3.mesh_labels(hollow, affine, vertices=800, hull=True)
        self.assertAlmostEqual(mm3.quality(whole, "volume").sum() / ((image > 0).sum() * 8), 1, delta=0.1)
        self.assertEqual(set(whole.labels), {1, 7})
        with self.assertRaisesRegex(ValueError, "region or region_labels, not both"):
            mm3.mesh_labels(image, affine, region_labels=[7], region=CUBE)
        with self.assertRaisesRegex(ValueError, "no voxels"):
            mm3.mesh_labels(image, affine, labels=[3])
        with self.assertRaisesRegex(ValueError, "no inverse"):
            mm3.label_surface(image, np.zeros((4, 4)), 1)

    def test_files(self):
        """Surfaces and images are those of the files, and the bundled ones those of the repository."""
        data = mm3.example_data()
        for name, soup in (("brain", BRAIN), ("region", REGION), ("tumor", TUMOR)):
            for found, expected in zip(data[name], soup):
                np.testing.assert_array_equal(found, expected)
        mesh, report = mm3.mesh(*data["brain"], region=data["region"], vertices=660)
        np.testing.assert_array_equal(mesh.points, self.mesh.points)
        path = FOLDER / "open.off"
        faces = "".join("3 %d %d %d\n" % tuple(t) for t in CUBE[1][1:])
        path.write_text("OFF\n8 11 0\n" + "".join("%r %r %r\n" % tuple(map(float, p)) for p in CUBE[0]) + faces)
        with self.assertWarnsRegex(UserWarning, "open.off: .*filled 1 hole"):
            points, triangles = mm3.read_surface(path)
        self.assertEqual((points.shape, triangles.shape), ((8, 3), (12, 3)))
        with self.assertWarnsRegex(UserWarning, "wrapped it"):
            self.assertGreater(len(mm3.read_surface(path, wrap=0.5)[0]), 100)
        with self.assertRaisesRegex(ValueError, "open.off: .*not closed"):
            mm3.read_surface(path, strict=True)
        cracks = FOLDER / "cracks.off"  # triangles with points of their own, the first one 1e-3 to the side
        points = CUBE[0][CUBE[1]].reshape(-1, 3).astype(float)
        points[:3] += 1e-3
        far = points + 3
        cracks.write_text("OFF\n72 24 0\n" + "".join("%r %r %r\n" % tuple(map(float, p)) for p in [*points, *0.5 * far])
                          + "".join(f"3 {3 * i} {3 * i + 1} {3 * i + 2}\n" for i in range(24)))
        with self.assertWarnsRegex(UserWarning, "cracks.off: welded [0-9]+ points"):
            self.assertEqual(mm3.read_surface(cracks, weld=0.01)[0].shape, (16, 3))
        for options in ({"largest": True}, {"drop_below": 0.5}):
            with self.assertWarnsRegex(UserWarning, "dropped 1 of 2 components, the largest of volume 0.125"):
                self.assertEqual(mm3.read_surface(cracks, weld=0.01, **options)[0].shape, (8, 3))
        for read, name in ((mm3.read_surface, "missing.stl"), (mm3.read_image, "missing.nii"),
                           (mm3.read_mesh, "missing.vtu")):
            with self.assertRaisesRegex(FileNotFoundError, name):
                read(name)
        try:
            import nibabel
        except ImportError as missing:
            self.skipTest(missing)
        values = np.random.default_rng(3).integers(0, 9, (4, 5, 6)).astype(np.int16)
        affine = np.array([[0, 2, 0, 5], [-1.5, 0, 0, 6], [0, 0, 3, -7], [0, 0, 0, 1.0]])
        nibabel.save(nibabel.Nifti1Image(values, affine), str(FOLDER / "image.nii.gz"))
        found, found_affine = mm3.read_image(FOLDER / "image.nii.gz")
        np.testing.assert_array_equal(found, values)
        np.testing.assert_array_equal(found_affine, affine)
        nibabel.save(nibabel.MGHImage(values, affine), str(FOLDER / "image.mgz"))
        found, found_affine = mm3.read_image(FOLDER / "image.mgz")
        np.testing.assert_array_equal(found, values)
        np.testing.assert_allclose(found_affine, affine, atol=1e-6)

    def test_save(self):
        """Files are those of the program, of order 2, too; so is what it refuses."""
        mesh = FOLDER / "saved.vtu"
        self.mesh.save(mesh)
        points, cells = read_vtu(mesh)
        np.testing.assert_array_equal(points, self.mesh.points)
        self.assertEqual(sum(map(len, cells.values())), len(self.mesh.kinds))
        edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))  # of Abaqus, and of FEBio
        for name in ("saved.inp", "saved.feb"):
            self.mesh.save(str(FOLDER / name), order=2, tetrahedra=True)
            text = (FOLDER / name).read_text()
            if name.endswith(".inp"):
                sections = re.split(r"\*(.*)\n", text)
                nodes = sections[sections.index("NODE") + 1]
                elements = "".join(b for a, b in zip(sections[1::2], sections[2::2]) if a.startswith("ELEMENT, TYPE=C3D10"))
                nodes, elements = (np.array([line.split(",") for line in s.split("\n")[:-1]], float)[:, 1:]
                                   for s in (nodes, elements))
            else:
                nodes = np.array([t.split(",") for t in re.findall("<node id=.*>(.*)</node>", text)], float)
                elements = np.array([t.split(",") for t in re.findall("<elem id=.*>(.*)</elem>", text)], int)
            elements = elements.astype(int) - 1
            self.assertEqual(elements.shape[1], 10)
            ends = np.sort(elements[:, edges], axis=2).reshape(-1, 2)
            middle = elements[:, 4:].ravel()
            self.assertEqual(len(np.unique(ends, axis=0)), len(nodes) - len(self.mesh.points))
            np.testing.assert_array_equal(nodes[:len(self.mesh.points)], self.mesh.points)
            np.testing.assert_array_equal(nodes[middle], nodes[ends].mean(1))
        for name, order, error in (("a.mesh", 2, "a.mesh: elements of order 2 can be written to .vtu, .msh, .msh2, .inp and"),
                                   ("a.inp", 2, "a.inp: Abaqus has no pyramids of order 2"),
                                   ("a.vtu", 3, "a.vtu: the order of elements is 1 or 2, not 3"),
                                   ("a.vtu", 0, "order: expected at least 1, not 0"), ("a.stl", 1, "unknown extension")):
            with self.assertRaisesRegex(ValueError, error):
                self.mesh.save(FOLDER / name, order=order)
            self.assertFalse((FOLDER / name).exists())

    def test_copies(self):
        labels = np.arange(len(self.mesh.kinds)) % 3 + 1
        mesh = mm3.Mesh(self.mesh.points, self.mesh.kinds, self.mesh.connectivity.astype(int), labels, self.mesh.in_region)
        for other in (pickle.loads(pickle.dumps(mesh)), copy.copy(mesh), copy.deepcopy(mesh)):
            self.assertIsNot(other, mesh)
            for name in ("points", "kinds", "connectivity", "offsets", "labels", "in_region"):
                np.testing.assert_array_equal(getattr(other, name), getattr(mesh, name))
        self.assertTrue(0 < mesh.in_region.sum() < len(labels))
        for name in ("Mesh", "Elasticity", "mesh", "read_surface"):
            self.assertGreater(len(getattr(mm3, name).__doc__), 50)
        for name in vars(mm3.Elasticity):
            self.assertTrue(name.startswith("_") or getattr(mm3.Elasticity, name).__doc__, name)
        self.assertRegex(mm3.__version__, "^[0-9.]+$")
        self.assertTrue(all(hasattr(mm3, name) for name in mm3.__all__))

    def test_slips(self):
        """Wrong arguments are named, in one line."""
        points, triangles = CUBE
        for error, text, arguments in (
                (TypeError, "vertices: expected a whole number, not '600'", {"vertices": "600"}),
                (TypeError, "vertices: expected a whole number, not 600.5", {"vertices": 600.5}),
                (ValueError, "vertices: expected at least 1", {"vertices": 0}),
                (ValueError, "tolerance: expected a number of at least 0", {"tolerance": -1}),
                (ValueError, "tolerance: expected a number of at least 0", {"tolerance": float("nan")}),
                (TypeError, "tolerance: expected a number, not None", {"tolerance": None}),
                (ValueError, "quality_bound: expected", {"quality_bound": 0.5}),
                (ValueError, "sharp_angle: expected", {"sharp_angle": 200}),
                (ValueError, "region: expected points and triangles", {"region": (points,)}),
                (TypeError, "region: weight: expected a number, not '2'", {"region": (*CUBE, "2")}),
                (ValueError, "region: triangles are numbers of points", {"region": (points, triangles * 1.0)}),
                (ValueError, "subdomain 2: expected points", {"subdomains": {2: points}})):
            with self.subTest(text), self.assertRaises(error) as caught:
                mm3.mesh(points, triangles, **{"vertices": 100, **arguments})
            self.assertIn(text, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
        with self.assertRaisesRegex(ValueError, "surface: triangles are numbers of points: expected integers, not float64"):
            mm3.mesh(points, triangles * 1.0)

    def test_report_as_program(self):
        """Distance and topology as the program has them, with a cavity, too."""
        report_file = FOLDER / "report.json"
        subprocess.run([BUILD / "bin" / "mixed_mesh_3", DATA / "brain.off", "--cavity", DATA / "tumour.off", "--vertices", "800",
                        "--quiet", "--report", report_file], check=True)
        told = json.loads(report_file.read_text())
        mesh, report = mm3.mesh(*BRAIN, subdomains={0: TUMOR}, vertices=800)
        self.assertEqual(report["Hausdorff distance"], told["surface"]["Hausdorff distance"]["distance"])
        self.assertEqual((report["status"], report["same topology"]),
                         (told["status"], told["topology"]["same topology"]))
        self.assertTrue(0 < report["seconds"] < 600)

    def test_complete_label(self):
        """Beside scipy: a closing by distances, holes filled, components by Kuhn's neighbors."""
        try:
            from scipy import ndimage
        except ImportError as missing:
            self.skipTest(missing)
        random = np.random.default_rng(5)
        spacing = np.array((1.0, 2.0, 1.5))
        affine = np.diag((*spacing, 1.0))
        edges = np.zeros((3, 3, 3), bool)
        for step in np.ndindex(2, 2, 2):
            edges[tuple(1 + np.array(step))] = edges[tuple(1 - np.array(step))] = True
        for share in (0.05, 0.3, 0.7):
            image = np.where(random.random((17, 12, 14)) < share, 5, 3)
            mask = np.pad(image == 5, 8)
            near = ndimage.distance_transform_edt(~mask, sampling=spacing) <= 3
            closed = ndimage.distance_transform_edt(near, sampling=spacing) > 3
            filled = ndimage.binary_fill_holes(closed, edges)
            names, number = ndimage.label(filled, edges)
            sizes = np.bincount(names.ravel())[1:]
            inner = (slice(8, -8),) * 3
            largest = names == 1 + sizes.argmax()
            for expected, options in ((mask, {}), (closed, {"close": 3}), (filled, {"close": 3, "fill_holes": True}),
                                      (largest, {"close": 3, "hull": True}),
                                      (np.isin(names, 1 + np.flatnonzero(sizes >= 20)),
                                       {"close": 3, "fill_holes": True, "drop_below": 20 * 3e-3 - 1e-9})):
                found = mm3.complete_label(image, affine, 5, **options)
                np.testing.assert_array_equal(found, expected[inner], str((share, options)))
        hull = mm3.complete_label(np.pad(np.ones((20, 20, 20)), 1), affine, hull=True)
        self.assertEqual(hull.sum(), 8000)
        for bad in ({"close": -1}, {"close": 1e6}, {"close": np.nan}, {"drop_below": -1}):
            with self.assertRaisesRegex(ValueError, next(iter(bad))):
                mm3.complete_label(image, affine, 5, **bad)

    def test_optimize_and_fit(self):
        wider = (BRAIN[0] * [1.05, 1, 1], BRAIN[1])
        optimized, report = mm3.optimize(self.mesh, *wider)
        self.assertTrue(mm3.certify(optimized).all())
        self.assertLess(report["boundary vertices not on surface"], 20)
        self.assertGreater(np.ptp(optimized.points[:, 0]), 1.03 * np.ptp(self.mesh.points[:, 0]))
        fitted, report = mm3.fit(self.mesh, *wider)
        self.assertTrue(mm3.certify(fitted).all())
        np.testing.assert_array_equal(fitted.connectivity, self.mesh.connectivity)
        improved, report = mm3.optimize(fitted, *wider, flips=False)
        self.assertTrue(report["success"])
        np.testing.assert_array_equal(improved.connectivity, self.mesh.connectivity)
        self.assertLess(mm3.quality(improved).max(), mm3.quality(fitted).max())

    def test_elasticity_as_program(self):
        boundary = np.flatnonzero(mm3.boundary_vertices(self.mesh))
        z = self.mesh.points[:, 2]
        top = boundary[np.argsort(z[boundary])[-5:]]
        with open(FOLDER / "points.csv", "w", encoding="ascii") as file:
            file.write("x,y,z,dx,dy,dz\n")
            for v in top:
                file.write(",".join(repr(float(c)) for c in self.mesh.points[v]) + ",0,0,-3\n")
        self.run_program("brain_shift", self.brain_file(), "--control-points", "points.csv", "--output", "shifted.vtu",
                         "--fixed-below", 0.2)
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(FOLDER / "shifted.vtu"))
        reader.Update()
        data = reader.GetOutput().GetPointData()
        expected = vtk_to_numpy(data.GetArray("displacement"))
        model = mm3.Elasticity(self.mesh)
        is_boundary = mm3.boundary_vertices(self.mesh)
        lowest, highest = z[is_boundary].min(), z[is_boundary].max()
        model.fix(is_boundary & (z < lowest + 0.2 * (highest - lowest)))
        model.set_control_points(self.mesh.points[top])
        shift = model.solve(np.tile([0, 0, -3.0], (5, 1)))
        np.testing.assert_array_equal(shift, expected)
        self.assertGreater(model.energy, 0)
        self.assertEqual((model.order, len(model.edges)), (1, 0))
        quadratic = mm3.Elasticity(self.mesh, order=2)
        quadratic.fix(is_boundary & (z < lowest + 0.2 * (highest - lowest)))
        quadratic.set_control_points(self.mesh.points[top])
        quadratic.solve(np.tile([0, 0, -3.0], (5, 1)))
        self.assertEqual((quadratic.order, len(quadratic.edge_coefficients)), (2, len(quadratic.edges)))
        self.assertTrue(0 < quadratic.energy < model.energy)
        model.set_corotational(True)
        np.testing.assert_allclose(model.solve(np.tile([0, 0, -1e-3], (5, 1))), shift * 1e-3 / 3, atol=1e-6)
        model.set_corotational(False)
        with self.assertRaisesRegex(ValueError, "not negative"):
            model.set_control_points(self.mesh.points[top], compliance=-1)
        model.set_control_points(self.mesh.points[top])
        with self.assertRaisesRegex(mm3.ElasticityError, "supports are set before"):
            model.fix(is_boundary)
        with self.assertRaisesRegex(mm3.ElasticityError, "outside the mesh"):
            model.set_control_points([[1e4, 0, 0]])
        with self.assertRaisesRegex(mm3.ElasticityError, "rigid motions"):
            mm3.Elasticity(self.mesh).solve()
        with self.assertRaisesRegex(ValueError, "Poisson"):
            mm3.Elasticity(self.mesh, poisson_ratio=0.5)
        with self.assertRaisesRegex(ValueError, "positive"):
            model.set_control_points(self.mesh.points[top], weights=[1, 1, 1, 1, 0])

        # Measurements that give way: what is left, and how well the others predict each.
        model.set_control_points(self.mesh.points[top], compliance=0.1, weights=[1, 1, 2, 1, 1])
        with self.assertRaisesRegex(mm3.ElasticityError, "solve"):
            model.leave_one_out_errors()
        shift = model.solve(np.tile([0, 0, -3.0], (5, 1)))
        wanted = np.tile([0, 0, -3.0], (5, 1))
        np.testing.assert_allclose(model.control_residuals(), wanted - shift[top], atol=1e-9)
        others = np.arange(5) != 2
        left_out = model.leave_one_out_errors()[2]
        model.set_control_points(self.mesh.points[top][others], compliance=0.1)
        np.testing.assert_allclose(wanted[2] - model.solve(wanted[others])[top[2]], left_out, atol=1e-6)

        # Pulled down, the top leaves the skull; pulled up, it is stopped.
        model = mm3.Elasticity(self.mesh)
        model.fix(is_boundary & (z < lowest + 0.2 * (highest - lowest)))
        model.touch(is_boundary)
        model.set_control_points(self.mesh.points[top])
        model.solve(wanted)
        self.assertTrue((model.contact_forces()[top] == 0).all())
        self.assertTrue((model.contact_forces() >= 0).all())
        self.assertTrue((model.contact_forces() > 0).any())

    def adaptation_cases(self, m):
        """Bumps of the top of the brain along z and x, with the lower part held: vertices and displacements."""
        z = m.points[:, 2]
        boundary = mm3.boundary_vertices(m)
        is_held = boundary & (z < z.min() + 0.3 * np.ptp(z))
        top = m.points[boundary & (z == z[boundary].max())][0]
        r = np.linalg.norm(m.points - top, axis=1)
        is_loaded = boundary & (r < 25)
        height = np.where(is_loaded, (1 + np.cos(np.pi * r / 25)) / 2, 0)
        return [(is_held | is_loaded, height[:, None] * np.array(direction)) for direction in ([0, 0, 1.0], [1.0, 0, 0])]

    def test_adapt(self):
        """Energies of the solution fall, which Elasticity with few steps would see as well; and the mesh stays valid."""
        m, _ = mm3.mesh(*BRAIN, region=REGION, vertices=400)
        cases = self.adaptation_cases(m)
        adapted, report = mm3.adapt(m, cases, solves=8)
        self.assertLess(report["energy after / before"], 0.9995)  # few vertices are not at the border of supports
        self.assertEqual(report["solves"], 8)
        self.assertAlmostEqual(report["energy after / before"],
                               np.mean(np.divide(report["energies after"], report["energies before"])))
        self.assertLessEqual(report["worst ARC after"], max(3.2, report["worst ARC before"]))
        self.assertTrue(mm3.certify(adapted).all())
        boundary = mm3.boundary_vertices(m)
        np.testing.assert_array_equal(adapted.points[boundary], m.points[boundary])
        self.assertGreater(np.abs(adapted.points - m.points).max(), 0.1)
        # The energy that another object finds on both meshes, of elements that do not lock, falls, too.
        energies = []
        for mesh in (m, adapted):
            model = mm3.Elasticity(mesh, poisson_ratio=0.3)
            vertices, displacements = cases[0]
            model.fix(vertices & ~displacements.any(axis=1))
            marked = vertices & displacements.any(axis=1)
            model.set_control_points(mesh.points[marked])
            model.solve(displacements[marked])
            energies.append(model.energy)
        self.assertLess(energies[1], energies[0])
        with self.assertRaisesRegex(ValueError, "cases: expected a displacement for each of"):
            mm3.adapt(m, [(boundary, np.zeros((3, 3)))])
        with self.assertRaisesRegex(ValueError, "is not finite"):
            mm3.adapt(m, [(boundary, np.full((len(m.points), 3), np.nan))])
        with self.assertRaisesRegex(mm3.ElasticityError, "no load"):
            mm3.adapt(m, [(boundary, np.zeros((len(m.points), 3)))])
        with self.assertRaisesRegex(mm3.ElasticityError, "solver failed"):
            mm3.adapt(m, [(np.arange(len(m.points)) == 0, np.ones((len(m.points), 3)))])

    def test_threads_of_numpy(self):
        """The solver takes one thread of the BLAS, and gives back those that NumPy had, also if two solve at once."""
        functions = blas_threads()
        if functions is None or os.cpu_count() == 1:
            self.skipTest("no BLAS that tells how many threads it uses, or one processor")
        threads, set_threads = functions
        self.addCleanup(set_threads, threads())
        z = self.mesh.points[:, 2]
        top = self.mesh.points[np.argsort(z)[-5:]]

        def solve():
            model = mm3.Elasticity(self.mesh)
            model.fix(z < np.quantile(z, 0.2))
            model.set_control_points(top)
            shift = model.solve(np.tile([0, 0, -3.0], (5, 1)))
            with self.assertRaises(mm3.ElasticityError):
                model.set_control_points([[1e4, 0, 0]])
            return shift

        set_threads(1)
        expected = solve()
        set_threads(2)
        wanted = threads()  # 1 where OpenBLAS was built without threads
        np.testing.assert_array_equal(solve(), expected)
        self.assertEqual(threads(), wanted)
        found = []
        for _ in range(20):
            both = [threading.Thread(target=lambda: found.append(solve())) for _ in range(2)]
            for thread in both:
                thread.start()
            for thread in both:
                thread.join()
        self.assertEqual(threads(), wanted)
        np.testing.assert_array_equal(found, 40 * [expected])

    def test_warp(self):
        affine = np.diag([4.0, 4.0, 4.0, 1.0])
        affine[:3, 3] = self.mesh.points.min(axis=0) - 20
        size = ((np.ptp(self.mesh.points, axis=0) + 40) / 4).astype(int)
        image = np.random.default_rng(1).integers(0, 5, size).astype(np.int16)
        shift = np.tile([4.0, 0, 0], (len(self.mesh.points), 1))  # a voxel
        warped, forward, backward, mask = mm3.warp(image, affine, self.mesh, shift, is_of_labels=True)
        self.assertEqual(warped.dtype, np.int16)
        inside = mask == 1
        np.testing.assert_array_equal(warped[1:][inside[1:]], image[:-1][inside[1:]])
        np.testing.assert_allclose(backward[inside], np.tile([-4, 0, 0], (inside.sum(), 1)), atol=1e-4)

    def test_other_packages(self):
        class Meshio:
            def __init__(self, points, cells, cell_data):
                self.points, self.cells, self.cell_data = points, dict(cells), cell_data
        sys.modules["meshio"] = type(sys)("meshio")
        sys.modules["meshio"].Mesh = Meshio
        mesh, _ = mm3.mesh(*BRAIN, region=REGION, vertices=660, simplification=False)
        result = mesh.to_meshio()
        self.assertEqual(sum(map(len, result.cells.values())), len(mesh.kinds))
        self.assertEqual([len(v) for v in result.cell_data["label"]], [len(v) for v in result.cells.values()])
        np.testing.assert_array_equal(result.cells["wedge"], mesh.cells["wedge"])  # both as Gmsh has them

        class Grid:
            def __init__(self, cells, types, points):
                self.cells, self.types, self.points, self.cell_data = cells, types, points, {}
        sys.modules["pyvista"] = type(sys)("pyvista")
        sys.modules["pyvista"].UnstructuredGrid = Grid
        grid = self.mesh.to_pyvista()
        _, cells = read_vtu(self.brain_file())
        at = 0
        expected = {kind: iter(v) for kind, v in cells.items()}
        for vtk_type in grid.types:
            size = grid.cells[at]
            np.testing.assert_array_equal(grid.cells[at + 1:at + 1 + size], next(expected[vtk_type]))
            at += size + 1
        self.assertEqual(at, len(grid.cells))

    def test_show(self):
        """The page is that of the program; a notebook has it in a frame, where it draws."""
        def data_of(text):
            return json.loads(text.split('<script type="application/json" id="data">')[1].split("</script>")[0])
        self.run_program("mixed_mesh_3", DATA / "brain.off", "--region", DATA / "region.off", "--vertices", 660, "--page",
                         "program.html")
        report = {**self.report, "warnings": ["</script>"]}
        page = self.mesh.show(report=report, title="<!--<script>&ü")
        expected, got = data_of((FOLDER / "program.html").read_text(encoding="utf-8")), data_of(page.html)
        for key in ("kinds", "center", "points"):
            self.assertEqual(got[key], expected[key], key)
        unpacked = lambda data, key, dtype: np.frombuffer(base64.b64decode(data[key]), dtype)
        kinds = unpacked(expected, "element kinds", "u1")
        order = np.argsort(kinds, kind="stable")  # elements of the module are sorted by kind
        for key, dtype in (("element kinds", "u1"), ("labels", "<u4"), ("in region", "u1"), ("ARC", "<f4")):
            np.testing.assert_array_equal(unpacked(got, key, dtype), unpacked(expected, key, dtype)[order], key)
        ends = np.cumsum([expected["kinds"][kind]["size"] for kind in kinds])
        elements = np.split(unpacked(expected, "element vertices", "<u4"), ends[:-1])
        np.testing.assert_array_equal(unpacked(got, "element vertices", "<u4"), np.concatenate([elements[i] for i in order]))
        self.assertEqual(page.html, self.mesh.show(report={**report, "seconds": 7}, title="<!--<script>&ü").html)
        self.assertEqual(page.html.count("</script>"), 3)
        page.save(FOLDER / "python.html")
        self.assertEqual((FOLDER / "python.html").read_text(encoding="utf-8"), page.html)
        self.assertIn("save(path)", repr(page))
        for arguments in ({"displacements": np.zeros((2, 3))}, {"removed": np.zeros(len(self.mesh.kinds), bool)},
                          {"displacements": np.full_like(self.mesh.points, np.nan)}):
            with self.assertRaises(ValueError):
                self.mesh.show(**arguments)
        if not browser.is_there():
            self.skipTest("no chromium, the page is not drawn")
        shifted = self.mesh.show(np.full_like(self.mesh.points, 2), title="shifted", height=500)
        (FOLDER / "notebook.html").write_text(f"<!DOCTYPE html><meta charset=utf-8>{page._repr_html_()}"
                                              f"{shifted._repr_html_()}", encoding="utf-8")
        with browser.Browser() as view:
            view.open(FOLDER / "notebook.html")
            self.assertEqual(view.run("""return [...document.querySelectorAll('iframe')].map(frame => {
              frame.contentWindow.mixedMeshPage.frame();
              const text = id => frame.contentDocument.getElementById(id).textContent, shown = text('shown');
              return [text('title'), text('subtitle'), shown.startsWith('0 '), shown.includes('elements shown')]; })"""),
                             [["<!--<script>&ü", "Mixed-element mesh: success", False, True],
                              ["shifted", "Mixed-element mesh", False, True]])
            view.screenshot(FOLDER / "notebook.png")
            self.assertEqual(view.messages(), [])

    def test_packages_of_wheel(self):
        """The manual names each package of Debian that has a library the module needs, but for what each system has."""
        module, = (BUILD / "python" / "mixed_mesh_3").glob("_core*.so")
        run = lambda *command: subprocess.run(command, capture_output=True, text=True, check=True).stdout
        if not all(map(shutil.which, ("readelf", "ldd", "dpkg"))):
            self.skipTest("no readelf, ldd or dpkg")
        needed = re.findall(r"NEEDED.*\[(.*)\]", run("readelf", "-d", module))
        paths = dict(re.findall(r"(\S+) => (\S+)", run("ldd", module)))
        line, = (line for line in GUIDE.read_text().splitlines() if "install python3-numpy" in line)
        there = [name for name in needed if not re.match(r"(libc|libm|libgcc_s|ld-linux.*)\.so", name)]
        self.assertGreater(len(there), 5)
        for name in there:
            owner = run("dpkg", "-S", os.path.basename(os.path.realpath(paths[name])))
            self.assertTrue({row.split(":")[0] for row in owner.splitlines()} & set(line.split()), (name, owner))

    def test_wheel(self):
        shutil.rmtree(FOLDER / "wheel", ignore_errors=True)
        (FOLDER / "wheel").mkdir()
        name = subprocess.run([sys.executable, SOURCE / "python" / "build_wheel.py", FOLDER / "wheel", BUILD], check=True,
                              capture_output=True, text=True).stdout.strip()
        environment = FOLDER / "wheel" / "environment"
        made = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", environment],
                              capture_output=True, text=True)
        if made.returncode != 0:
            self.skipTest("python3-venv is not installed")
        python = environment / "bin" / "python"
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-index", FOLDER / "wheel" / name], check=True)
        clean = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
        out = subprocess.run([python, SOURCE / "python" / "tutorial.py"], check=True, capture_output=True,
                             text=True, cwd=FOLDER, env=clean).stdout
        self.assertIn("success", out)
        start = "import time; t = time.time(); import numpy; u = time.time(); import mixed_mesh_3; print(time.time() - u)"
        seconds = float(subprocess.run([python, "-c", start], check=True, capture_output=True, text=True, env=clean).stdout)
        print(f"import, beside NumPy's: {seconds:.3f} s", file=sys.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
