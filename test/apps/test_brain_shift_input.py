#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The input of brain_shift: formats of control points, bad ones, wrong use.

  test_brain_shift_input.py MESH BRAIN_SHIFT DATA_DIRECTORY WORK_DIRECTORY
"""

import json
import sys
import unittest

from brain_shift_case import HEADER, POINTS, ROWS, VALUES, WORK, Case, with_value

import numpy as np

WEIGHTED = HEADER.replace("dz", "dz,weight")

# name of the file, contents, words that the error must have
BAD_POINTS = [
    ("empty.csv", "", "is empty"),
    ("comments_only.csv", "# nothing\n\n", "is empty"),
    ("header_only.csv", HEADER, "has no control points"),
    ("no_header.csv", "\n".join(ROWS) + "\n", "line 1: expected the header x,y,z,dx,dy,dz"),
    ("other_header.csv", "x,y,z,u,v,w\n" + "\n".join(ROWS), "line 1: expected the header"),
    ("colons.csv", POINTS.replace(",", ":"), "expected the header"),
    ("mixed.csv", HEADER + ROWS[0].replace(",", ";") + "\n", "line 2: expected 6 columns, x,y,z,dx,dy,dz, not 1"),
    ("five_columns.csv", HEADER + "\n\n# comment\n1,2,3,4,5\n", "line 5: expected 6 columns, x,y,z,dx,dy,dz, not 5"),
    ("seven_columns.csv", HEADER + ROWS[0] + ",\n", "line 2: expected 6 columns, x,y,z,dx,dy,dz, not 7"),
    ("no_weight.csv", WEIGHTED + ROWS[0] + "\n", "line 2: expected 7 columns, x,y,z,dx,dy,dz,weight, not 6"),
    ("weight_0.csv", WEIGHTED + ROWS[0] + ",0\n", 'line 2: the weight "0" is not from 1e-6 to 1e6'),
    ("weight_negative.csv", WEIGHTED + ROWS[0] + ",-1\n", 'line 2: the weight "-1" is not from 1e-6 to 1e6'),
    ("word.csv", with_value(1, 4, "much"), 'line 3: "much" is not a number'),
    ("two_numbers.csv", with_value(2, 0, "1 2"), 'line 4: "1 2" is not a number'),
    ("hexadecimal.csv", with_value(2, 0, "0x10"), 'line 4: "0x10" is not a number'),
    ("signs.csv", with_value(0, 0, "+-1"), 'line 2: "+-1" is not a number'),
    ("nothing.csv", with_value(0, 5, " "), "line 2: a number is missing"),
    ("nan.csv", with_value(3, 2, "nan"), 'line 5: "nan" is not a finite number'),
    ("infinite.csv", with_value(3, 3, "-inf"), 'line 5: "-inf" is not a finite number'),
    ("overflow.csv", with_value(3, 3, "1e999"), 'line 5: "1e999" is out of range'),
    ("kilometers.csv", with_value(3, 3, "1e7"), "line 5: \"1e7\" mm is more than a kilometer"),
    ("binary.csv", "\x00\x01\x02\xff\r\n\n", "expected the header"),
    ("control_characters.csv", HEADER + "1,2,3,4,5,\x1b[2J\n", 'line 2: "?[2J" is not a number'),
]


class Input(Case):
    def test_formats_of_points(self):
        """Tables with other separators, and fiducials of 3D Slicer: the same points."""
        before, after = VALUES[:, :3], VALUES[:, :3] + VALUES[:, 3:]
        flip = np.array([-1, -1, 1])

        def fcsv(points, system):
            return "\n".join(["# Markups fiducial file version = 4.11", f"# CoordinateSystem = {system}",
                              "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID",
                              *(f"{i},{x},{y},{z},0,0,0,1,1,1,0,F-{i},," for i, (x, y, z) in enumerate(points))])

        def markups(points, system):
            return json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": system, "controlPoints": [
                {"id": str(i), "label": f"F-{i}", "position": list(p)} for i, p in enumerate(points)]}]})

        inputs = [[self.file(f"points{i}.csv", POINTS.replace(",", separator))]
                  for i, separator in enumerate((",", ";", " ; ", "\t", " ", "   "))]
        for system, points, others in (("RAS", before, after), ("0", before, after),
                                       ("LPS", before * flip, after * flip), ("1", before * flip, after * flip)):
            inputs.append([self.file(f"before{system}.fcsv", fcsv(points, system)), "--control-points-after",
                           self.file(f"after{system}.fcsv", fcsv(others, system))])
        inputs.append([self.file("before.mrk.json", markups(before, "RAS")), "--control-points-after",
                       self.file("after.mrk.json", markups(after * flip, "LPS"))])
        largest = []
        for arguments in inputs:
            report = WORK / "points.json"
            run = self.shift(self.mesh, "--control-points", *arguments, "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            told = json.loads(report.read_text())
            np.testing.assert_allclose([p["position"] for p in told["control points"]], before, atol=1e-12)
            np.testing.assert_allclose([p["displacement"] for p in told["control points"]], VALUES[:, 3:], atol=1e-12)
            largest.append(told["shift"]["largest displacement"])
        np.testing.assert_allclose(largest, largest[0], rtol=1e-9)

    def test_harmless_points(self):
        self.succeeds(self.mesh, "--control-points", self.points, "--output", WORK / "plain.vtu")
        wanted = (WORK / "plain.vtu").read_bytes()
        for name, contents in (("crlf.csv", POINTS.replace("\n", "\r\n")),
                               ("blank.csv", "\n \n" + POINTS.replace("\n", "\n\n \t\n")),
                               ("spaces.csv", POINTS.replace(",", " ,\t").replace("\n", "  \n")),
                               ("no_newline.csv", POINTS.rstrip("\n")),
                               ("bom.csv", b"\xef\xbb\xbf" + POINTS.encode()),
                               ("plus.csv", POINTS.replace("\n4", "\n+4").replace("\n3", "\n  +3")),
                               ("comment.csv", POINTS + "# more\n  # and more")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.succeeds(self.mesh, "--control-points", path, "--output", WORK / "same.vtu")
                self.assertEqual((WORK / "same.vtu").read_bytes(), wanted)

    def test_weights(self):
        """A weight counts a point as often; the error of a point left out is that of a run without it."""
        compliant = ("--control-compliance", 0.05, "--leave-one-out")
        rows = [row + f",{weight}" for row, weight in zip(ROWS, (1, 2, 1, 1))]
        weighted, out = self.succeeds(self.mesh, "--control-points", self.file("weights.csv", WEIGHTED + "\n".join(rows)),
                                      *compliant)
        twice, _ = self.succeeds(self.mesh, "--control-points",
                                 self.file("twice.csv", HEADER + "\n".join([*ROWS, ROWS[1]])), *compliant)
        self.assertAlmostEqual(weighted["shift"]["energy"], twice["shift"]["energy"], 6)
        self.assertEqual([p["weight"] for p in weighted["control points"]], [1, 2, 1, 1])
        controls = weighted["shift"]["control points"]
        errors = [np.linalg.norm(p["error if left out"]) for p in controls]
        root = np.sqrt(np.mean(np.square(errors)))
        self.assertAlmostEqual(weighted["shift"]["root mean square of leave-one-out errors"], root, 9)
        self.assertIn("is predicted by the others to", out.stdout)
        # without the first: what the mesh does there
        light = ",".join(rows[0].split(",")[:6]) + ",1e-6"
        without, _ = self.succeeds(self.mesh, "--control-points",
                                   self.file("without.csv", WEIGHTED + "\n".join([light, *rows[1:]])), *compliant)
        self.assertAlmostEqual(without["shift"]["control points"][0]["missed by"], errors[0], 3)
        exact, _ = self.succeeds(self.mesh, "--control-points", WORK / "weights.csv")
        self.assertIn("weights", exact["warnings"][0])
        plain, _ = self.succeeds(self.mesh, "--control-points", self.points)
        self.assertNotIn("error if left out", plain["shift"]["control points"][0])

    def test_points_in_the_tumor_are_not_used_after_it(self):
        points = self.file("inside.csv", POINTS + "28,18,28,0,0,-3\n")
        told, run = self.succeeds(self.mesh, "--control-points", points, "--tumor", self.tumor)
        self.assertIn("inside.csv: line 8: the control point is in tissue removed", run.stderr)
        self.assertEqual([p["used"] for p in told["shift after resection"]["control points"]], [True] * 4 + [False])
        self.assertEqual([p["used"] for p in told["shift"]["control points"]], [True] * 5)

    def test_bad_points(self):
        for name, contents, words in BAD_POINTS:
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--control-points", path, names=path, words=words)
        self.fails(self.mesh, "--control-points", WORK / "none.csv", names="none.csv", words="No such file")
        self.fails(self.mesh, "--control-points", WORK, names=WORK, words="is a directory")

    def test_bad_fiducials(self):
        good = self.file("good.fcsv", "a,1,2,3\nb,4,5,6\n")
        for name, contents, words in (
                ("empty.fcsv", "# nothing\n", "has no points"),
                ("one.fcsv", "a,1,2,3\n", "has 1 points, but"),
                ("columns.fcsv", "a,1,2\n", "line 1: expected a name and three numbers, not 3 columns"),
                ("word.fcsv", "# c\na,1,much,3\n", 'line 2: "much" is not a number'),
                ("system.fcsv", "# CoordinateSystem = IJK\na,1,2,3\n", 'unknown coordinate system "IJK"'),
                ("far.fcsv", "a,1,2,3\nb,1,2,3e7\n", "point 2 is more than a kilometer away"),
                ("text.mrk.json", "hello", "is no list of markups"),
                ("empty.mrk.json", '{"markups": []}', "has 0 lists of points"),
                ("two.mrk.json", '{"markups": [{"controlPoints": [{"position": [1, 2]}]}]}', "is no list of markups"),
                ("table.csv", POINTS, "unknown format")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--control-points", good, "--control-points-after", path, names=path, words=words)
        self.fails(self.mesh, "--control-points", good, names="--control-points-after", words="before and after", status=2)
        self.fails(self.mesh, "--control-points", self.file("t.csv", POINTS), "--control-points-after", good,
                   names="--control-points-after", words="is for fiducials", status=2)

    def test_points_that_cannot_be_used(self):
        far = with_value(2, 2, "158")
        self.fails_with(far, words="line 4: the control point is 86")
        self.fails_with(far, "--max-distance", 85, words="; --max-distance is 85 mm")
        self.fails_with(POINTS, "--max-distance", 0, words="the control point is 0.")
        twice = HEADER + ROWS[0] + "\n" + ",".join(ROWS[0].split(",")[:3]) + ",0,0,0\n"
        self.fails_with(twice, words="contradicts")
        self.fails_with(twice, words="line ")
        self.fails_with(POINTS, "--fixed-below", 1, words="contradicts")

    def test_points_in_another_space_or_unit(self):
        """At the back of the brain, which is longer there: negated, they are outside."""
        back = "20,-85,0,0,0,1"
        for factors, words in (((-1, -1, 1), "x and y negated"), ((1e-3,) * 3, "1,000 times smaller")):
            rows = [",".join([repr(f * float(x)) for f, x in zip(factors, row.split(","))] + row.split(",")[3:])
                    for row in ([back] if words.startswith("x") else ROWS)]
            path = self.file("elsewhere.csv", HEADER + "\n".join(rows) + "\n")
            run = self.shift(self.mesh, "--control-points", path, "--report", WORK / "report.json")
            self.assertIn(words, run.stderr)

    def test_outputs_that_cannot_be_written(self):
        arguments = [self.mesh, "--control-points", self.points]
        (WORK / "directory.vtu").mkdir(exist_ok=True)
        for option, path, words in (("--output", WORK / "none" / "a.vtu", "No such file"),
                                    ("--output", WORK / "directory.vtu", "is a directory"),
                                    ("--output", WORK / "a.inp", ".vtu, .msh and .feb only"),
                                    ("--output", WORK / "no.vtu", "twice"),
                                    ("--output", self.mesh, "twice"),
                                    ("--output-deformed", WORK / "a.txt", "unknown extension"),
                                    ("--output-deformed", WORK / "none" / "a.msh", "No such file"),
                                    ("--output-deformed", self.points, "")):
            with self.subTest(option=option, path=path):
                self.fails(*arguments, option, path, names=path, words=words)
        self.fails(*arguments, "--image", self.image, "--output-image", WORK / "none" / "a", names="a.nii.gz",
                   words="No such file")
        self.fails(*arguments, "--image", self.image, "--output-image", WORK / "image", names=self.image,
                   words="twice")

    def test_wrong_use(self):
        arguments = [self.mesh, "--control-points", self.points]
        for more, words in (([], "--control-points"),
                            (["--fixed-below", 1.1], "--fixed-below"), (["--fixed-below", "nan"], "--fixed-below"),
                            (["--slide-below", -1], "--slide-below"),
                            (["--slide-below", 0.5, "--slide-beyond", 10], "excludes"),
                            (["--young-modulus", 0], "--young-modulus: expected a number from 1e-9 to 1e12"),
                            (["--young-modulus", 1e308], "--young-modulus: expected a number from 1e-9 to 1e12"),
                            (["--young-modulus", "inf"], "--young-modulus"),
                            (["--poisson-ratio", 0.5], "--poisson-ratio: expected a number of at least 0"),
                            (["--poisson-ratio", 0.49999999999999994], "--poisson-ratio: expected a number"),
                            (["--density", -1], "--density"), (["--fluid-density", "nan"], "--fluid-density"),
                            (["--gravity", "0,0,-9810", "--fluid-level", "inf"], "--fluid-level"),
                            (["--fluid-level", 10], "--gravity"),
                            (["--gravity", "1,2"], "--gravity: expected three numbers"),
                            (["--gravity", "0,0,nan"], "--gravity"), (["--up", "w"], "--up"),
                            (["--up", "0,0,0"], "--up"),
                            (["--interpolation", "cubic"], "--interpolation"), (["--max-distance", -1], "--max-distance"),
                            (["--control-compliance", -1], "--control-compliance"),
                            (["--image", self.image], "--output-image"),
                            (["--output-image", WORK / "no"], "--image"), (["--field", "itk"], "--output-image"),
                            (["--image", self.image, "--output-image", WORK / "no", "--field", "dicom"], "--field"),
                            (["--labels", self.image], "--image")):
            with self.subTest(more):
                self.fails(*(arguments if more else arguments[:1]), *more, names=words, status=2)
        run = self.shift("--version")
        self.assertEqual((run.returncode, run.stdout[:11]), (0, "brain_shift"))
        quiet = self.shift(*arguments, "--quiet")
        self.assertEqual((quiet.returncode, quiet.stdout), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
