#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Landmarks of brain_shift: their formats, and errors of registrations and of the model, against brute force.

  test_brain_shift_landmarks.py MESH BRAIN_SHIFT DATA_DIRECTORY WORK_DIRECTORY
"""

import json
import pathlib
import subprocess
import sys
import unittest

from brain_shift_case import HEADER, PROGRAM, VALUES, WORK, Case

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

TABLE = "x,y,z,x_after,y_after,z_after\n"
NAMED = TABLE.replace("\n", ",name\n")
TAG = "MNI Tag Point File\nVolumes = 2;\n%a comment\n\nPoints =\n"
SCRIPT = pathlib.Path(__file__).parents[2] / "scripts" / "landmarks.py"
METHODS = ["no registration", "rigid", "affine", "thin-plate spline", "model"]


def rows(before, after, tail=""):
    return "".join(",".join(map(repr, map(float, (*p, *q)))) + tail + "\n" for p, q in zip(before, after))


def rigid(p, q, x):
    """Least squares, by Kabsch's method."""
    u, _, vt = np.linalg.svd((q - q.mean(0)).T @ (p - p.mean(0)))
    turn = u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt
    return (x - p.mean(0)) @ turn.T + q.mean(0)


def affine(p, q, x):
    one = np.ones((len(p), 1))
    return np.hstack([x, np.ones((len(x), 1))]) @ np.linalg.lstsq(np.hstack([p, one]), q, rcond=None)[0]


def thin_plate(p, q, x):
    def radial(a, b):
        return np.linalg.norm(a[:, None] - b[None], axis=2)

    n, terms = len(p), np.hstack([np.ones((len(p), 1)), p])
    matrix = np.block([[radial(p, p), terms], [terms.T, np.zeros((4, 4))]])
    coefficients = np.linalg.solve(matrix, np.vstack([q, np.zeros((4, 3))]))
    return radial(x, p) @ coefficients[:n] + np.hstack([np.ones((len(x), 1)), x]) @ coefficients[n:]


REGISTRATIONS = {"no registration": lambda p, q, x: x, "rigid": rigid, "affine": affine,
                 "thin-plate spline": thin_plate}


def left_out(method, p, q):
    """The registration without each pair: really without it."""
    others = [np.arange(len(p)) != i for i in range(len(p))]
    return np.array([np.linalg.norm(q[i] - method(p[o], q[o], p[i:i + 1])[0]) for i, o in enumerate(others)])


class Landmarks(Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(cls.mesh))
        reader.Update()
        grid = reader.GetOutput()
        cls.vertices = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        surface = vtk.vtkGeometryFilter()
        surface.SetInputData(grid)
        surface.PassThroughPointIdsOn()
        surface.Update()
        boundary = surface.GetOutput()
        cls.boundary = np.unique(vtk_to_numpy(boundary.GetPointData().GetArray("vtkOriginalPointIds")))
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputData(boundary)
        triangles.Update()
        cls.distance = vtk.vtkImplicitPolyDataDistance()
        cls.distance.SetInput(triangles.GetOutput())
        # Fourteen, of which eight are on the boundary, in the upper half, which is not fixed.
        upper = np.flatnonzero(cls.vertices[:, 2] > 10)
        generator = np.random.default_rng(3)
        inner = np.setdiff1d(upper, cls.boundary)
        chosen = [generator.choice(inner, 6, replace=False),
                  generator.choice(np.intersect1d(upper, cls.boundary), 8, replace=False)]
        cls.chosen = np.concatenate(chosen)
        cls.before = cls.vertices[cls.chosen]
        noise = generator.normal(0, 0.5, cls.before.shape)
        cls.after = cls.before + [1, -0.5, -3] + 0.05 * (cls.before - [0, -20, 30])[:, [1, 2, 0]] + noise

    def measured(self, before, after, *arguments, name="landmarks.csv"):
        """What the report says of the landmarks, and what was printed."""
        path = self.file(name, TABLE + rows(before, after))
        told, run = self.succeeds(self.mesh, "--landmarks", path, *arguments)
        return told["landmarks"], run

    def lengths(self, told, method, which="errors if left out"):
        return np.array([p[which][method] for p in told["points"] if which in p])

    def check_summary(self, summary, lengths):
        np.testing.assert_allclose([summary[key] for key in ("mean", "median", "maximum")],
                                   [np.mean(lengths), np.median(lengths), np.max(lengths)], rtol=1e-12)

    def test_registrations_against_brute_force(self):
        told, run = self.measured(self.before, self.after)
        errors = told["target registration errors in mm"]
        given = np.array([p["is given"] for p in told["points"]])
        self.assertEqual([errors["leave one out"]["targets"], errors["by the outermost"]["targets"], given.sum()],
                         [14, 7, 7])
        for name, method in REGISTRATIONS.items():
            with self.subTest(name):
                wanted = left_out(method, self.before, self.after)
                np.testing.assert_allclose(self.lengths(told, name), wanted, rtol=1e-7, atol=1e-9)
                self.check_summary(errors["leave one out"][name], wanted)
                put = method(self.before[given], self.after[given], self.before[~given])
                wanted = np.linalg.norm(self.after[~given] - put, axis=1)
                np.testing.assert_allclose(self.lengths(told, name, "errors by the outermost"), wanted, rtol=1e-7)
                self.check_summary(errors["by the outermost"][name], wanted)
                row = next(line for line in run.stdout.splitlines() if line.startswith("  " + name))
                self.assertIn(f"{np.mean(wanted):.2f} / {np.median(wanted):.2f} / {np.max(wanted):.2f}", row)
        self.assertEqual(list(errors["leave one out"])[1:], METHODS)
        self.check_summary(errors["leave one out"]["model"], self.lengths(told, "model"))

    def test_model_against_brute_force(self):
        """Really without each landmark, and really by the outermost ones, with the compliance by default."""
        for arguments in ((), ("--fixed-below", 0), ("--control-compliance", 0.05, "--slide-below", 0.5)):
            with self.subTest(arguments):
                told, _ = self.measured(self.before, self.after, *arguments)
                given = np.array([p["is given"] for p in told["points"]])

                def at_others(used):
                    path = self.file("used.csv", HEADER + rows(self.before[used], (self.after - self.before)[used]))
                    other, _ = self.measured(self.before, self.after, "--control-points", path,
                                             *(arguments if "--control-compliance" in arguments else
                                               ("--control-compliance", 1, *arguments)))
                    self.assertFalse(other["are control points"])
                    # Other control points change nothing of what landmarks tell by themselves.
                    np.testing.assert_allclose(self.lengths(other, "model"), self.lengths(told, "model"), rtol=1e-9)
                    lengths = np.array([p["error of the shift"] for p in other["points"]])
                    self.check_summary(
                        other["target registration errors in mm"]["shift by the control points"], lengths)
                    return lengths[~used]

                for i in (0, 5, 13):
                    (error,) = at_others(np.arange(14) != i)
                    self.assertAlmostEqual(error, self.lengths(told, "model")[i], 6)
                np.testing.assert_allclose(at_others(given), self.lengths(told, "model", "errors by the outermost"),
                                           atol=1e-6)

    def test_affine_map(self):
        """An affine map is found by the affine registration and the spline; the model comes near, without forces on its
        boundary."""
        linear = np.array([[1.02, 0.03, 0], [-0.01, 0.97, 0.02], [0, 0.04, 1.01]])
        told, _ = self.measured(self.before, self.before @ linear.T + [1, 2, -3], "--fixed-below", 0,
                                "--control-compliance", 0)
        for errors in list(told["target registration errors in mm"].values())[:2]:
            for method in ("affine", "thin-plate spline"):
                self.assertLess(errors[method]["maximum"], 1e-9)
            self.assertGreater(errors["rigid"]["mean"], 0.5)
            self.assertLess(errors["model"]["mean"], 0.8 * errors["no registration"]["mean"])

    def test_rigid_motions(self):
        """A finite one is found by all registrations; the model, free, finds an infinitesimal one."""
        angle = np.radians(20)
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        told, _ = self.measured(self.before, self.before @ turn.T + [3, -4, 5], "--fixed-below", 0)
        for errors in list(told["target registration errors in mm"].values())[:2]:
            for method in METHODS[1:4]:
                self.assertLess(errors[method]["maximum"], 1e-9)
            self.assertGreater(errors["no registration"]["mean"], 5)
        turned = np.cross([0.02, -0.01, 0.03], self.before)
        told, _ = self.measured(self.before, self.before + turned + [1, 0, 2], "--fixed-below", 0)
        for errors in list(told["target registration errors in mm"].values())[:2]:
            self.assertLess(errors["model"]["maximum"], 1e-6)
            self.assertLess(errors["affine"]["maximum"], 1e-9)
            self.assertGreater(errors["rigid"]["maximum"], 1e-3)

    def test_elastic_displacement(self):
        """Landmarks that move as the mesh does by control points: their shift leaves nothing at any of them."""
        _, run = self.succeeds(self.mesh, "--control-points", self.points, "--output", WORK / "moved.vtu")
        u = vtk_to_numpy(self.read(WORK / "moved.vtu").GetPointData().GetArray("displacement"))[self.chosen]
        self.assertGreater(np.linalg.norm(u, axis=1).max(), 1)
        arguments = ["--control-points", self.points]
        told, run = self.measured(self.before, self.before + u, *arguments)
        errors = told["target registration errors in mm"]
        self.assertLess(errors["shift by the control points"]["maximum"], 1e-5)
        self.assertIn("the shift by the control points, at all landmarks: ", run.stdout)
        # Moved away, one has just that error.
        wrong = self.before + u
        wrong[3] += [0, 3, 4]
        told, _ = self.measured(self.before, wrong, *arguments)
        self.assertAlmostEqual(
            told["target registration errors in mm"]["shift by the control points"]["maximum"], 5, 4)

    def test_exact_elastic_solution(self):
        """By the points that move the mesh, as the outermost landmarks, the model is exact; no registration is."""
        _, run = self.succeeds(self.mesh, "--control-points", self.points, "--output", WORK / "moved.vtu")
        inner = self.chosen[:6]
        u = vtk_to_numpy(self.read(WORK / "moved.vtu").GetPointData().GetArray("displacement"))[inner]
        before = np.vstack([VALUES[:, :3], self.vertices[inner]])
        after = before + np.vstack([VALUES[:, 3:], u])
        told, _ = self.measured(before, after, "--landmarks-given", 4, "--control-compliance", 0)
        self.assertEqual([p["is given"] for p in told["points"]], [True] * 4 + [False] * 6)
        errors = told["target registration errors in mm"]["by the outermost"]
        self.assertLess(errors["model"]["maximum"], 1e-5)
        self.assertLess(self.lengths(told, "model")[4:].max(), 1e-5)
        for method in METHODS[:4]:
            self.assertGreater(errors[method]["mean"], 0.1)
        # Exact points are no noisy ones: they should not give way.
        soft, _ = self.measured(before, after, "--landmarks-given", 4)
        self.assertGreater(soft["target registration errors in mm"]["by the outermost"]["model"]["mean"], 0.1)

    def test_outermost(self):
        """Those of least depth: on the boundary 0, inside as VTK measures it, outside negative."""
        top = self.vertices[np.argmax(self.vertices[:, 2])] + [0, 0, 3]
        before = np.vstack([self.before, top])
        told, _ = self.measured(before, np.vstack([self.after, top]), "--landmarks-given", 4)
        depths = np.array([p["depth below the boundary"] for p in told["points"]])
        np.testing.assert_allclose(depths[6:14], 0, atol=1e-9)
        vtk_depths = [-self.distance.EvaluateFunction(p) for p in self.before[:6]]
        self.assertGreater(min(vtk_depths), 1)
        np.testing.assert_allclose(depths[:6], vtk_depths, atol=0.7)  # quadrilaterals are cut along either diagonal
        self.assertLess(depths[14], -2)
        self.assertAlmostEqual(depths[14], -told["points"][14]["distance to the mesh"], 6)
        given = [i for i, p in enumerate(told["points"]) if p["is given"]]
        self.assertEqual(len(given), 4)
        self.assertIn(14, given)
        self.assertLess(max(depths[given]), 1e-9)
        for n, k in ((5, 4), (9, 4), (12, 6), (14, 7)):
            told, _ = self.measured(self.before[-n:], self.after[-n:])
            self.assertEqual(sum(p["is given"] for p in told["points"]), k)

    def test_compliance(self):
        """For measured points, 1 mm/mN by default, for a Young's modulus of 1 kPa; 0 for control points, as before."""
        told, run = self.measured(self.before, self.after)
        self.assertEqual(told["compliance"], {"value": 1, "unit": "mm/mN"})
        self.assertIn("landmarks give way to forces: compliance 1 mm/mN (--control-compliance)", run.stdout)
        self.assertTrue(told["are control points"])
        stiff, _ = self.measured(self.before, self.after, "--young-modulus", 4)
        self.assertEqual(stiff["compliance"]["value"], 0.25)
        np.testing.assert_allclose(self.lengths(stiff, "model"), self.lengths(told, "model"), rtol=1e-6)
        exact, _ = self.measured(self.before, self.after, "--control-compliance", 0)
        self.assertEqual(exact["compliance"]["value"], 0)
        self.assertGreater(np.abs(self.lengths(exact, "model") - self.lengths(told, "model")).max(), 0.01)
        path = self.file("landmarks.csv", TABLE + rows(self.before, self.after))
        report, _ = self.succeeds(self.mesh, "--landmarks", path)
        self.assertEqual(report["parameters"]["compliance of control points"]["value"], 1)
        self.assertGreater(report["shift"]["control points missed by at most"], 0.01)
        self.assertEqual(report["inputs"]["control points"]["file"], str(path))
        report, _ = self.succeeds(self.mesh, "--landmarks", path, "--control-points", self.points)
        self.assertEqual(report["parameters"]["compliance of control points"]["value"], 0)
        self.assertLess(report["shift"]["control points missed by at most"], 1e-6)
        self.assertEqual(report["landmarks"]["compliance"]["value"], 1)
        plain, _ = self.succeeds(self.mesh, "--control-points", self.points)
        self.assertIsNone(plain["landmarks"])
        self.assertEqual(plain["shift"], report["shift"])
        self.assertIn("1.28 mm", " ".join(self.shift("--help").stdout.split()))

    def test_formats(self):
        """The same landmarks in all formats; tags as VTK writes them, too."""
        flip = np.array([-1, -1, 1])
        names = [f"F-{i}" for i in range(14)]

        def fcsv(points, system):
            return "\n".join(["# Markups fiducial file version = 4.11", f"# CoordinateSystem = {system}",
                              "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID",
                              *(f"{i},{x!r},{y!r},{z!r},0,0,0,1,1,1,0,F-{i},,"
                                for i, (x, y, z) in enumerate(points.tolist()))])

        def markups(points, system):
            return json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": system, "controlPoints": [
                {"id": str(i), "label": f"F-{i}", "position": list(p)} for i, p in enumerate(points)]}]})

        def tags(tail, end=";"):
            lines = [" ".join(map(repr, map(float, (*p, *q)))) + tail.format(name)
                     for p, q, name in zip(self.before, self.after, names)]
            return TAG + " " + "\n ".join(lines) + end + "\n"

        table = rows(self.before, self.after)
        displacements = HEADER + rows(self.before, self.after - self.before)
        inputs = [("plain.csv", TABLE + table), ("tabs.txt", (TABLE + table).replace(",", "\t")),
                  ("blanks.csv", "# a comment\n\n" + (TABLE + table).replace(",", " ").replace("\n", "\r\n")),
                  ("bom.csv", b"\xef\xbb\xbf" + (TABLE + table).encode()), ("displacements.csv", displacements),
                  ("named.csv", NAMED + "".join(f"{row},{name}\n" for row, name in zip(table.splitlines(), names))),
                  ("numbers.tag", tags("")), ("labels.tag", tags(' "{}"')), ("nine.tag", tags(' 1 0 -1 "{}"', "\n;")),
                  ("tabs.tag", tags("\t1\t0\t-1\t\"{}\"").replace("\n", "\r\n")),
                  ("same_line.tag", tags(' "{}"').replace("Points =\n", "Points ="))]
        arguments = [[self.file(*each)] for each in inputs] + [[self.tags_of_vtk(names)]]
        for system, factor in (("RAS", 1), ("LPS", flip)):
            arguments += [[self.file(f"before_{system}{end}", text(self.before * factor, system)), "--landmarks-after",
                           self.file(f"after_{system}{end}", text(self.after * factor, system))]
                          for end, text in ((".fcsv", fcsv), (".mrk.json", markups))]
        for each in arguments:
            with self.subTest(each[0].name):
                told, _ = self.succeeds(self.mesh, "--landmarks", *each)
                points = told["landmarks"]["points"]
                np.testing.assert_allclose([p["position"] for p in points], self.before, atol=1e-6)
                np.testing.assert_allclose([p["displacement"] for p in points], self.after - self.before, atol=1e-6)
                has_names = not each[0].name.startswith(("plain", "tabs.txt", "blanks", "bom", "displ", "numbers"))
                self.assertEqual([p["name"] for p in points], names if has_names else [None] * 14)

    def tags_of_vtk(self, names):
        writer = vtk.vtkMNITagPointWriter()
        for port, positions in enumerate((self.before, self.after)):
            points, data, labels = vtk.vtkPoints(), vtk.vtkPolyData(), vtk.vtkStringArray()
            points.SetData(numpy_to_vtk(np.ascontiguousarray(positions), deep=True))
            data.SetPoints(points)
            labels.SetName("LabelText")
            for name in names:
                labels.InsertNextValue(name)
            data.GetPointData().AddArray(labels)
            writer.SetInputData(port, data)
        writer.SetFileName(str(WORK / "vtk.tag"))
        writer.Write()
        return WORK / "vtk.tag"

    def test_bad_tables(self):
        good = rows(self.before, self.after).splitlines()

        def with_line(line, header=TABLE):
            return header + "\n".join([*good[:5], line, *good[6:]]) + "\n"

        for name, contents, words in (
                ("empty.csv", "", "is empty: expected the header x,y,z,x_after"),
                ("header.csv", "x,y,z\n", "line 1: expected the header x,y,z,x_after,y_after,z_after; x,y,z,x_after"),
                ("none.csv", TABLE, "has 0 landmarks, expected at least 5"),
                ("four.csv", TABLE + "\n".join(good[:4]), "has 4 landmarks, expected at least 5"),
                ("five_columns.csv", with_line("1,2,3,4,5"), "line 7: expected 6 columns, x,y,z,x_after,"),
                ("seven_columns.csv", with_line("1,2,3,4,5,6,7"), "line 7: expected 6 columns"),
                ("no_name.csv", with_line("1,2,3,4,5,6", NAMED), "line 2: expected 7 columns"),
                ("nan.csv", with_line("1,2,3,4,nan,6"), 'line 7: "nan" is not a finite number'),
                ("infinite.csv", with_line("1,2,-inf,4,5,6"), 'line 7: "-inf" is not a finite number'),
                ("word.csv", with_line("1,2,3,4,x,6"), 'line 7: "x" is not a number'),
                ("missing.csv", with_line("1,2,3,4,,6"), "line 7: a number is missing"),
                ("far.csv", with_line("1,2,3,4,5,6e6"), 'line 7: "6e6" mm is more than a kilometer'),
                ("twice.csv", with_line(good[2]), "line 7 is at the same place before as line 4"),
                ("weights.csv", "x,y,z,dx,dy,dz,weight\n1,2,3,4,5,6,7\n", "line 1: expected the header"),
                ("outside.csv", with_line("0,0,300,0,0,300"), "line 7: the control point is ")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--landmarks", path, names=path, words=words)
        self.fails(self.mesh, "--landmarks", WORK / "none.tag", names="none.tag", words="No such file")
        self.fails(self.mesh, "--landmarks", WORK, names=WORK, words="is a directory")

    def test_bad_tags(self):
        lines = [" ".join(row.split(",")) for row in rows(self.before, self.after).splitlines()]
        good = TAG + "\n".join(lines) + ";\n"
        self.succeeds(self.mesh, "--landmarks", self.file("good.tag", good))

        def with_line(line):
            return good.replace(lines[3], line)

        for name, contents, words in (
                ("empty.tag", "", "is empty: expected MNI Tag Point File"),
                ("title.tag", good[4:], "line 1: expected MNI Tag Point File, not \"Tag Point File\""),
                ("volumes.tag", good.replace("Volumes = 2", "Volumes = 1"),
                 "line 2: expected Volumes = 2; for the points before and after, not \"Volumes = 1;\""),
                ("no_volumes.tag", good.replace("Volumes = 2;\n", ""), "line 4: expected Volumes = 2;, not \"Points =\""),
                ("no_points.tag", "\n".join(good.splitlines()[:3]), "has no points: expected a line Points ="),
                ("no_header.tag", good.replace("Points =\n", ""), "line 5: expected Points =, not"),
                ("cut.tag", good[:-2] + "\n", "is cut short: expected a ;"),
                ("more.tag", good + lines[0] + "\n", "line 20: expected nothing after the ;"),
                ("five.tag", with_line("1 2 3 4 5"), "line 9: expected six numbers, before and after, or nine"),
                ("seven.tag", with_line("1 2 3 4 5 6 7"), "with a weight and two indices, not 7"),
                ("word.tag", with_line("1 2 3 4 5 x"), 'line 9: "x" is not a number'),
                ("nan.tag", with_line("1 2 3 4 5 nan"), 'line 9: "nan" is not a finite number'),
                ("weight.tag", with_line("1 2 3 4 5 6 inf 0 0"), 'line 9: "inf" is not a finite number'),
                ("far.tag", with_line("1 2 3 4 5 6e6"), 'line 9: "6e6" mm is more than a kilometer'),
                ("label.tag", with_line('1 2 3 4 5 6 "open'), "line 9: expected a label in quotes at the end"),
                ("after_label.tag", with_line('1 2 3 4 5 6 "a" 7'), "line 9: expected a label in quotes at the end"),
                ("few.tag", TAG + "\n".join(lines[:3]) + ";\n", "has 3 landmarks, expected at least 5"),
                ("twice.tag", with_line(lines[0]), "line 9 is at the same place before as line 6"),
                ("binary.tag", b"\x00\xff\x01\n", "line 1: expected MNI Tag Point File")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--landmarks", path, names=path, words=words)

    def test_bad_fiducials(self):
        good = self.file("good.fcsv", "".join(f"a,{x},{y},{z}\n" for x, y, z in self.before))
        for name, contents, words in (
                ("fewer.fcsv", "a,1,2,3\n", "has 1 points, but"),
                ("nan.fcsv", "a,1,2,nan\n", 'line 1: "nan" is not a finite number'),
                ("system.fcsv", "# CoordinateSystem = IJK\na,1,2,3\n", 'unknown coordinate system "IJK"'),
                ("null.mrk.json", '{"markups": [{"controlPoints": [{"position": [1, 2, null]}]}]}', "is no list"),
                ("table.csv", TABLE, "unknown format")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--landmarks", good, "--landmarks-after", path, names=path, words=words)

    def test_too_few_to_predict(self):
        path = self.file("landmarks.csv", TABLE + rows(self.before, self.after))
        self.fails(self.mesh, "--landmarks", path, "--landmarks-given", 14, names=path,
                   words="has 14 landmarks: none is left to predict if 14 are given; see --landmarks-given")

    def test_wrong_use(self):
        table = self.file("landmarks.csv", TABLE + rows(self.before, self.after))
        fiducials = self.file("good.fcsv", "a,1,2,3\n")
        for arguments, words in (((), "--control-points or --landmarks is required"),
                                 (("--landmarks", fiducials), "--landmarks-after: fiducials are needed"),
                                 (("--landmarks", table, "--landmarks-after", fiducials), "--landmarks-after: is for"),
                                 (("--landmarks", table, "--landmarks-given", 3), "--landmarks-given: expected"),
                                 (("--landmarks", table, "--landmarks-given", 4.5), "--landmarks-given"),
                                 (("--control-points", self.points, "--landmarks-given", 5), "--landmarks"),
                                 (("--control-points", self.points, "--landmarks-after", fiducials), "--landmarks")):
            with self.subTest(words):
                self.fails(self.mesh, *arguments, names=words, status=2)
        path = self.file("out.csv", TABLE + rows(self.before, self.after))
        self.fails(self.mesh, "--landmarks", path, "--output-deformed", path, names=path)

    def test_degenerate_landmarks(self):
        """In a plane, or all but one: there is no affine registration, and a warning says so; others are measured."""
        flat = self.before.copy()
        flat[:, 2] = 20
        inside = [self.distance.EvaluateFunction(p) < 3 for p in flat]
        flat = flat[inside]
        self.assertGreater(len(flat), 6)
        moved = flat + [0, 0, -2]
        told, run = self.measured(flat, moved, "--landmarks-given", 4)
        errors = told["target registration errors in mm"]["leave one out"]
        self.assertEqual([errors[m] is None for m in METHODS], [False, False, True, True, False])
        self.assertIn("affine: the landmarks other than line 2 do not determine it", run.stderr)
        self.assertIn("thin-plate spline: the 4 outermost landmarks do not determine it", run.stderr)
        self.assertRegex(run.stdout, r"affine +- +-\n")
        # One out of the plane: without that one, the others do not determine it.
        flat[2, 2] = 25
        told, run = self.measured(flat, moved)
        self.assertIn("affine: the landmarks other than line 4 do not determine it", run.stderr)
        self.assertEqual(["affine" in p["errors if left out"] for p in told["points"]],
                         [i != 2 for i in range(len(flat))])

    def test_supports_that_contradict_landmarks(self):
        """Images that are not aligned: the fixed base is wrong, and a warning says so."""
        _, run = self.measured(self.before, self.before + [6, 0, 0])
        self.assertIn("a rigid registration predicts landmarks to ", run.stderr)
        self.assertIn("see --fixed-below", run.stderr)
        _, run = self.measured(self.before, self.before + [6, 0, 0], "--fixed-below", 0)
        self.assertEqual(run.stderr, "")

    def test_with_a_resection_and_finite_rotations(self):
        path = self.file("landmarks.csv", TABLE + rows(self.before, self.after))
        plain, _ = self.succeeds(self.mesh, "--landmarks", path)
        told, _ = self.succeeds(self.mesh, "--landmarks", path, "--tumor", self.tumor)
        self.assertEqual(told["landmarks"], plain["landmarks"])
        turned, run = self.succeeds(self.mesh, "--landmarks", path, "--corotational")
        self.assertEqual(turned["landmarks"]["leave-one-out errors of the model"],
                         "estimated by the stiffness at rest")
        self.assertIn("its leave-one-out errors are an estimate", run.stdout)
        self.assertEqual(plain["landmarks"]["leave-one-out errors of the model"], "exact")
        again, _ = self.succeeds(self.mesh, "--landmarks", path)
        self.assertEqual(again["landmarks"], plain["landmarks"])

    def script(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], capture_output=True, text=True, timeout=120)

    def test_checksums(self):
        folder = WORK / "public"
        (folder / "case1").mkdir(parents=True)
        self.assertIn("has no files of landmarks", self.script("record", folder).stderr)
        landmarks = folder / "case1" / "a.tag"
        landmarks.write_text("1\n")
        (folder / "image.nii").write_text("not recorded")
        self.assertEqual(self.script("record", folder).returncode, 0)
        known = "4355a46b19d348dc2f57c046f8ef63d4538ebb936000f3c9ee954a27460dd865" # sha256sum of the line 1
        self.assertEqual((folder / "SHA256SUMS").read_text(), known + "  case1/a.tag\n")
        self.assertEqual(self.script("verify", folder).returncode, 0)
        landmarks.write_text("2\n")
        self.assertIn("case1/a.tag: is another one", self.script("verify", folder).stderr)
        landmarks.rename(folder / "b.tag")
        run = self.script("verify", folder)
        self.assertEqual((run.returncode, run.stderr), (1, "case1/a.tag: is missing\nb.tag: is not recorded\n"))

    def test_cases(self):
        """The mean over all landmarks of all cases, not over cases."""
        reports = []
        for name, rows_of in (("one", slice(0, 14)), ("two", slice(5, 14))):
            told, _ = self.measured(self.before[rows_of], self.after[rows_of], "--fixed-below", 0, name=name + ".csv")
            reports.append(told)
        cases = self.file("cases.csv", f"mesh,landmarks\n{self.mesh},one.csv\n{self.mesh},two.csv\n")
        run = self.script("measure", cases, PROGRAM, "--fixed-below", 0)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stdout.splitlines()[0][:7], "2 cases")
        for method, line in zip(METHODS, run.stdout.splitlines()[1:]):
            means = [np.mean(np.concatenate([self.lengths(told, method, which) for told in reports]))
                     for which in ("errors if left out", "errors by the outermost")]
            self.assertEqual(line.split(), f"{method}: leave one out {means[0]:.2f} (23), "
                                           f"by the outermost {means[1]:.2f} (12)".split())
        self.assertIn("expected a header", self.script("measure", WORK / "one.csv", PROGRAM).stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
