#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of several tissues in brain_shift: materials, resection, and what is no mesh or no tumor.

  test_brain_shift_tissue.py MESH BRAIN_SHIFT DATA_DIRECTORY WORK_DIRECTORY
"""

import itertools
import sys
import unittest

from brain_shift_case import DATA, HEADER, WORK, Case, cube_off
from cube import CUBE, TRIANGLES

import nibabel
import numpy as np
from vtk.util.numpy_support import vtk_to_numpy


def msh(points, elements, labels=()):
    """A mesh of Gmsh: elements by type and vertices, and their labels."""
    groups = sorted(set(labels))
    labels = labels or [0] * len(elements)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    if groups:
        lines += ["$PhysicalNames", str(len(groups)), *(f'3 {i} "subdomain_{i}_rest"' for i in groups),
                  "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(points))]
    lines += [" ".join(map(str, (i + 1, *p))) for i, p in enumerate(points)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [" ".join(map(str, (i + 1, kind, 2, label, 1, *(v + 1 for v in e))))
              for i, ((kind, e), label) in enumerate(zip(elements, labels))]
    return "\n".join(lines + ["$EndElements"]) + "\n"


HEXAHEDRON = (0, 1, 3, 2, 4, 5, 7, 6)  # of CUBE


def lattice(size, width, label_of):
    """A mesh of cubes: how many there are along each axis, their width, and their labels."""
    nodes = lambda axis: range(size[axis] + 1)
    points = {(x, y, z): i for i, (z, y, x) in enumerate(itertools.product(nodes(2), nodes(1), nodes(0)))}
    cells = [(x, y, z) for z, y, x in itertools.product(*map(range, size[::-1]))]
    elements = [(5, [points[tuple(np.add(cell, CUBE[k]))] for k in HEXAHEDRON]) for cell in cells]
    return msh([np.multiply(p, width) for p in points], elements, [label_of(*cell) for cell in cells])


class Tissue(Case):
    def column(self):
        """Of four cubes, the upper two of another label; and its upper corners, moved downwards."""
        mesh = self.file("column.msh", lattice((1, 1, 4), 1, lambda x, y, z: 3 if z < 2 else 5))
        move = lambda length: HEADER + "".join(f"{x},{y},4,0,0,{-length}\n" for x, y, z in CUBE if z == 0)
        return mesh, move

    def test_order(self):
        """Order 2 is the default with a radius, unless what is asked for needs order 1; files have the middles of edges
        if asked."""
        run = lambda *more: self.succeeds(self.mesh, "--control-points", self.points, "--control-radius", 14, *more)
        default, out = run("--output", WORK / "default.vtu")
        quadratic, _ = run("--order", 2, "--output", WORK / "quadratic.vtu", "--output-order", 2)
        linear, told = run("--order", 1, "--output", WORK / "linear.vtu", "--output-order", 2)
        region, _ = run("--order", "region")
        nodes = [r["order"]["nodes"] for r in (linear, region, quadratic)]
        self.assertEqual(nodes[0], linear["inputs"]["mesh"]["vertices"])
        self.assertEqual(nodes, sorted(set(nodes)))
        self.assertEqual([r["order"]["order"] for r in (linear, region, quadratic)], ["1", "region", "2"])
        self.assertEqual(quadratic["order"], {**default["order"], "unknowns": 3 * nodes[2]})
        self.assertEqual(quadratic["shift"], default["shift"])
        self.assertIn(f"order 2: {nodes[2]} nodes, {3 * nodes[2]} unknowns\n", out.stdout)
        self.assertIn(f"order 1: {nodes[0]} nodes, {3 * nodes[0]} unknowns\n", told.stdout)
        # more freedom, less energy
        energies = [r["shift"]["energy"] for r in (quadratic, region, linear)]
        self.assertEqual(energies, sorted(energies))
        files = [self.read(WORK / f"{name}.vtu") for name in ("default", "quadratic", "linear")]
        u = [vtk_to_numpy(f.GetPointData().GetArray("displacement")) for f in files]
        self.assertEqual([len(x) for x in u], [nodes[0], nodes[2], nodes[2]])
        self.assertTrue(np.array_equal(u[0], u[1][:nodes[0]]))
        self.assertGreater(np.abs(u[1] - u[2]).max(), 0.1)
        contact, out = run("--contact", "skull")
        self.assertEqual(contact["order"], {**linear["order"], "because of": "--contact"})
        self.assertIn(f"order 1 because of --contact: {nodes[0]} nodes", out.stdout)
        single, _ = self.succeeds(self.mesh, "--control-points", self.points)
        self.assertEqual(single["order"], {**linear["order"], "because of": "control points without --control-radius"})
        narrow, _ = self.succeeds(self.mesh, "--control-points", self.points, "--control-radius", 4)
        self.assertEqual(narrow["order"], {**linear["order"], "because of": "elements that order 2 would invert"})
        for option in (("--contact", "skull"), ("--corotational",)):
            for order in (2, "region"):
                self.fails(self.mesh, "--control-points", self.points, *option, "--order", order, names="--order", status=2,
                           words="only order 1 can be had with " + option[0])
        self.fails(self.mesh, "--control-points", self.points, "--febio", WORK / "no.feb", "--order", "region",
                   names="--order", status=2, words="elements of a model of FEBio (--febio) have order 1 or 2 everywhere")

    def test_example(self):
        """The example of --help has the default order 2, and inverts no element."""
        line = self.shift("--help").stdout.strip().split("\n")[-1].split()
        self.assertEqual(line[:2], ["brain_shift", "brain.vtu"])
        run = self.shift(*(str(DATA.parent / w) if w.startswith("data/") else str(WORK / w) if w.endswith(".vtu") else w
                           for w in line[1:]))
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertRegex(run.stdout, r"\norder 2: \d+ nodes")

    def test_materials(self):
        mesh, move = self.column()
        run = lambda *more, points=move(0.3): self.succeeds(mesh, "--control-points", self.file("top.csv", points),
                                                            "--order", 1, "--output", WORK / "column.vtu", *more)[0]
        fixed = ("--fixed-below", 0.1, "--poisson-ratio", 0)
        for materials, moduli in (((), (2, 2)), (("--material", "3=4,0"), (4, 2)),
                                  (("--material", "5=8,0", "--material", "3=0.5,0"), (0.5, 8)),
                                  (("--material", "5= 8 , 0 , 1.1"), (2, 8))):
            told = run("--young-modulus", 2, *fixed, *materials)
            # springs in series: they bear the same force
            force = 0.3 / (2 / moduli[0] + 2 / moduli[1])
            grid = self.read(WORK / "column.vtu")
            z = vtk_to_numpy(grid.GetPoints().GetData())[:, 2]
            wanted = np.interp(z, [0, 2, 4], [0, -force * 2 / moduli[0], -0.3])
            u = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
            self.assertTrue(np.allclose(u, wanted[:, None] * [0, 0, 1], atol=1e-9), materials)
            self.assertTrue(np.allclose(np.sum([p["force"] for p in told["shift"]["control points"]], axis=0),
                                        [0, 0, -force], atol=1e-9))
            self.assertEqual([(s["index"], s["elements"]) for s in told["subdomains"]], [(3, 2), (5, 2)])
            self.assertEqual([s["Young's modulus"] for s in told["subdomains"]],
                             [{"value": modulus, "unit": "kPa"} for modulus in moduli])
            self.assertTrue(np.allclose([s["volume"] for s in told["subdomains"]], 2))
        summary = self.shift(mesh, "--control-points", WORK / "top.csv", *fixed, "--material", "5=8,0.25").stdout
        self.assertIn("subdomain 3: 2 elements, 0.002 ml; Young's modulus 1 kPa, Poisson's ratio 0\n", summary)
        self.assertIn("subdomain 5: 2 elements, 0.002 ml; Young's modulus 8 kPa, Poisson's ratio 0.25\n", summary)
        # other ratios of Poisson make it wider
        told = run("--young-modulus", 2, *fixed, "--material", "5=2,0.4")
        self.assertEqual([s["Poisson's ratio"]["value"] for s in told["subdomains"]], [0, 0.4])
        u = vtk_to_numpy(self.read(WORK / "column.vtu").GetPointData().GetArray("displacement"))
        self.assertGreater(np.ptp(u[np.isclose(z, 3), 0]), 0.01)
        # the weight of two densities, borne by the control points
        told = run("--fixed-below", 0, "--gravity", "0,0,-9810", "--fluid-density", 0, "--density", 2, "--material",
                   "3=7,0.3,5", "--material", "5=9,0.3", points=move(0))
        self.assertTrue(np.allclose([s["density"]["value"] for s in told["subdomains"]], [5, 2]))
        self.assertTrue(np.allclose(np.sum([p["force"] for p in told["shift"]["control points"]], axis=0),
                                    [0, 0, 9810e-6 * (2 * 5 + 2 * 2)], atol=1e-9))

    def test_adapt(self):
        """Inner vertices move, where they have less energy; those of the boundary and between labels stay."""
        n = 5
        mesh = self.file("block.msh", lattice((n, n, n), 2, lambda x, y, z: 3 if z < 2 else 5))
        indent = HEADER + "".join(f"{x},{y},{2 * n},0,0,-0.2\n" for x in (4, 6) for y in (4, 6))
        points = self.file("indent.csv", indent)
        run = lambda name, *more: self.succeeds(mesh, "--control-points", points, "--fixed-below", 0.1,
                                                "--output", WORK / name, *more)
        before, adapted = run("before.vtu")[0], run("adapted.vtu", "--adapt")
        self.assertIsNone(before["adaptation"])
        told = adapted[0]["adaptation"]
        self.assertGreater(told["steps"], 0)
        self.assertLess(told["mean energy, after / before"], 1)
        self.assertLessEqual(told["worst ARC after"], 3.2)
        self.assertIn("adaptation: energies of unit bumps", adapted[1].stdout)
        p, q = (vtk_to_numpy(self.read(WORK / name).GetPoints().GetData()) for name in ("before.vtu", "adapted.vtu"))
        moved = np.any(p != q, axis=1)
        stays = np.any((p == 0) | (p == 2 * n), axis=1) | (p[:, 2] == 4)
        self.assertTrue(moved.any())
        self.assertFalse(moved[stays].any())
        # Vertices of elements at the border of supports stay as well.
        self.assertLessEqual(int(moved.sum()), told["vertices that may move"])
        self.assertLess(told["vertices that may move"], int((~stays).sum()))
        for before_guard, after in zip(told["energies of guard loads before"], told["energies of guard loads after"]):
            self.assertLessEqual(after, before_guard)
        alone = self.file("alone.csv", HEADER + f"4,4,{2 * n},0,0,-0.2\n")
        self.fails(mesh, "--control-points", alone, "--fixed-below", 0.1, "--adapt", names="--adapt",
                   words="nothing to adapt to")

    def test_bad_materials(self):
        mesh, move = self.column()
        arguments = [mesh, "--control-points", self.file("top.csv", move(0.3))]
        for text, words in (("3", "expected LABEL=E,NU or LABEL=E,NU,RHO, not"), ("3=1", "expected LABEL=E,NU"),
                            ("=1,0.3", "expected LABEL=E,NU"), ("3=1,0.3,1,1", "expected LABEL=E,NU"),
                            ("3=,0.3", "Young's modulus: a number is missing"),
                            ("3=much,0.3", "Young's modulus: \"much\" is not a number"),
                            ("3=0,0.3", "Young's modulus: expected a number from 1e-9 to 1e12, not 0"),
                            ("3=1,0.5", "Poisson's ratio: expected a number of at least 0"),
                            ("3=1,nan", "Poisson's ratio: \"nan\" is not a finite number"),
                            ("3=1,0.3,-1", "density: expected a number of at least 0, not -1")):
            with self.subTest(text):
                self.fails(*arguments, "--material", text, names="--material", words=words, status=2)
        for label in ("4", "0", "-3", "03", "tumor"):
            with self.subTest(label):
                self.fails(*arguments, "--material", label + "=1,0.3", names=mesh,
                           words=f'has no subdomain "{label}", but 3, 5')
        self.fails(*arguments, "--material", "3=1,0.3", "--material", "3=1,0.3", names="--material",
                   words='the subdomain "3" is given two materials')

    def resect_label(self, name, label_of, *more):
        """From a block of cubes of 10 mm that does not move."""
        mesh = self.file(name + ".msh", lattice((5, 5, 5), 10, label_of))
        points = self.file("still.csv", HEADER + "25,25,50,0,0,0\n")
        return self.succeeds(mesh, "--control-points", points, "--tumor-label", 2, "--output", WORK / f"{name}.vtu",
                             "--output-deformed", WORK / f"{name}_left.vtu", *more)

    def test_resection_of_a_label(self):
        """Its elements, no other ones, and their voxels."""
        tumor = {(1, 1, 1), (2, 1, 1), (3, 1, 1), (3, 2, 1), (3, 2, 2), (3, 2, 3)}  # a tube with corners
        affine = np.diag([2.5, -2.5, 2.5, 1])
        affine[:3, 3] = -8.1, 58.3, -8.2
        nibabel.save(nibabel.Nifti1Image(np.full((27, 27, 27), 7, np.int16), affine), WORK / "block_image.nii.gz")
        told, run = self.resect_label("block", lambda *cell: 2 if cell in tumor else 1, "--image",
                                      WORK / "block_image.nii.gz", "--output-image", WORK / "block")
        self.assertEqual(run.stderr, "")
        self.assertEqual((told["inputs"]["tumor"], told["inputs"]["label of the tumor"]), (None, "2"))
        cells = self.read(WORK / "block.vtu").GetCellData()
        resected, labels = (vtk_to_numpy(cells.GetArray(name)) for name in ("resected", "subdomain"))
        self.assertEqual(np.count_nonzero(resected), len(tumor))
        self.assertTrue(np.array_equal(resected == 1, labels == 2))
        resection = told["resection"]
        self.assertEqual([resection[key] for key in (
            "status", "elements removed", "elements inside", "of which stay, or a vertex would be pinched",
            "removed besides, as they came loose", "removed besides, or a vertex would be pinched", "elements left")],
            ["success", 6, 6, 0, 0, 0, 119])
        self.assertAlmostEqual(resection["cavity volume"], 6000)
        self.assertAlmostEqual(resection["cavity area"], 2600)  # two ends, four sides of each
        self.assertEqual(self.read(WORK / "block_left.vtu").GetNumberOfCells(), 119)
        mask = np.asarray(nibabel.load(WORK / "block_mask.nii.gz").dataobj)
        voxels = np.indices(mask.shape).reshape(3, -1)
        cell = np.floor((affine[:3, :3] @ voxels + affine[:3, 3:]) / 10).astype(int).T
        wanted = [2 if tuple(c) in tumor else int(np.all((0 <= c) & (c < 5))) for c in cell]
        self.assertTrue(np.array_equal(mask.ravel(), wanted))
        self.assertTrue(np.all(np.asarray(nibabel.load(WORK / "block.nii.gz").dataobj)[mask == 2] == 0))

    def test_labels_that_cannot_be_resected_alone(self):
        # cubes with a common edge, and a hull around a cube
        told, run = self.resect_label("edge", lambda *cell: 2 if cell in ((1, 1, 2), (2, 2, 2)) else 1)
        self.assertIn("subdomain 2: what is left would touch itself at an edge or a vertex", run.stderr)
        self.assertEqual(told["resection"]["elements inside"], 2)
        self.assertNotEqual(told["resection"]["elements removed"], 2)
        around = lambda *cell: 2 if max(abs(x - 2) for x in cell) == 1 else 1
        told, run = self.resect_label("hull", around)
        self.assertIn("subdomain 2: tissue outside comes loose, and is removed: 1 piece", run.stderr)
        self.assertEqual((told["resection"]["elements inside"], told["resection"]["elements removed"]), (26, 27))

    def test_bad_labels_of_tumors(self):
        mesh, move = self.column()
        arguments = [mesh, "--control-points", self.file("top.csv", move(0.3)), "--tumor-label"]
        self.fails(*arguments, 4, names=mesh, words='has no subdomain "4", but 3, 5')
        self.fails(*arguments, 3, "--tumor", self.tumor, names="--tumor", words="excludes", status=2)
        self.fails(self.mesh, "--control-points", self.points, "--tumor-label", 1, names=self.mesh,
                   words="subdomain 1: everything removed: no element is left")

    def test_bad_tumors(self):
        for name, contents, words in (
                ("outside.off", cube_off((200, 200, 200), 5), "nothing removed: no element is inside"),
                ("tiny.off", cube_off((28, 18, 28), 1e-3), "nothing removed: no element is inside"),
                ("all.off", cube_off((0, 0, 0), 1000), "everything removed: no element is left"),
                ("open.off", cube_off((28, 18, 28), 20, TRIANGLES[:4]), "not closed: 8 border edges"),
                ("empty.off", "", "is empty"),
                ("tumor.txt", cube_off((28, 18, 28), 20), "unknown format")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--control-points", self.points, "--tumor", path, names=path, words=words)
        self.fails(self.mesh, "--control-points", self.points, "--tumor", WORK / "none.off", names="none.off",
                   words="No such file")
        turned = self.file("turned.off", cube_off((10, 85, 8), 22))  # at the back of the brain, in LPS
        self.fails(self.mesh, "--control-points", self.points, "--tumor", turned, names=turned, words="x and y negated")
        self.assertEqual(self.shift(self.mesh, "--control-points", self.points, "--tumor", turned, "--space",
                                    "LPS").returncode, 0)
        with open(self.tumor) as file:
            lines = file.read().split("\n")
        n = int(lines[1].split()[0])
        points = [" ".join(repr(1e-3 * float(x)) for x in line.split()) for line in lines[2:2 + n]]
        meters = self.file("meters.off", "\n".join(lines[:2] + points + lines[2 + n:]))
        self.fails(self.mesh, "--control-points", self.points, "--tumor", meters, names=meters)
        # what is above the plane goes, with all that control points hold
        self.fails(self.mesh, "--control-points", self.points, "--fixed-below", 0, "--tumor",
                   self.file("above.off", cube_off((0, 0, 500 + 45), 1000)), names=self.mesh, words="free")

    def test_bad_meshes(self):
        with open(self.mesh, "rb") as file:
            bytes_of_mesh = file.read()
        inverted = msh(CUBE, [(5, HEXAHEDRON[4:] + HEXAHEDRON[:4])])
        second = [(x + 1, y + 1, z) for x, y, z in CUBE]  # has an edge of the first cube
        two = CUBE + [p for p in second if p not in CUBE]
        for name, contents, words in (
                ("empty.vtu", "", ""),
                ("truncated.vtu", bytes_of_mesh[:len(bytes_of_mesh) // 2], ""),
                ("text.msh", "no mesh\n", ""),
                ("mesh.off", cube_off((0, 0, 0), 1), "unknown format"),
                ("inverted.msh", inverted, "1 element is inverted, the first is element 0"),
                ("flat.msh", msh([(x, y, 0) for x, y, _ in CUBE], [(5, HEXAHEDRON)]), "1 element is inverted"),
                ("hinge.msh", msh(two, [(5, HEXAHEDRON), (5, [two.index(second[v]) for v in HEXAHEDRON])]),
                 "not a manifold")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(path, "--control-points", self.points, names=path, words=words)
        self.fails(WORK / "none.vtu", "--control-points", self.points, names="none.vtu")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
