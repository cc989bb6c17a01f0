#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces on the command line of the mesher: refused, repaired, and taken with a warning.

  test_command_line_surfaces.py MESHER DATA_DIRECTORY WORK_DIRECTORY
"""

import json
import random
import struct
import sys
import unittest
from math import cos, pi, sin

from command_line_case import CUBE_OFF, WORK, Case
from cube import CUBE, QUADS, TRIANGLES, moved, off, shifted


def stl(points, faces):
    lines = ["facet normal 0 0 0\nouter loop\n" + "".join("vertex {} {} {}\n".format(*points[v]) for v in f)
             + "endloop\nendfacet" for f in faces]
    return "\n".join(["solid x", *lines, "endsolid x"]) + "\n"


# The projective plane with six vertices: closed, but not orientable.
PROJECTIVE_PLANE = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 1), (1, 2, 4), (2, 3, 5), (3, 4, 1),
                    (4, 5, 2), (5, 1, 3)]
# The edge 0-1 is 0-8-9-1 in the front face; two triangles without area are between them.
NEEDLES = CUBE + [(0.25, 0, 0), (0.5, 0, 0)]
NEEDLE_TRIANGLES = [f for f in TRIANGLES if f != (0, 1, 5)] + [(0, 8, 5), (8, 9, 5), (9, 1, 5), (0, 1, 9),
                                                               (0, 9, 8)]
# Two cubes, with a corner in common.
PINCHED_TRIANGLES = TRIANGLES + [tuple(7 if v == 0 else v + 7 for v in f) for f in TRIANGLES]
PINCHED = CUBE + moved(CUBE, 1, (1, 1, 1))[1:]

# name of the file, contents, words that the error must have
BAD_SURFACES = [
    ("empty.off", "", "is empty"),
    ("header_only.off", "OFF\n", "is truncated"),
    ("no_faces.off", "OFF\n0 0 0\n", "no faces"),
    ("truncated.off", CUBE_OFF[:len(CUBE_OFF) // 2], "too short for so many"),
    ("truncated_last_face.off", "\n".join(CUBE_OFF.split("\n")[:-2]) + "\n", ""),
    ("garbage.off", "\x00\x01garbage\xff" * 50, "cannot be read"),
    ("huge_count.off", "OFF\n99999999999 99999999999 0\n0 0 0\n", "too short for so many"),
    ("not_a_number.off", CUBE_OFF.replace("1 1 1\n", "nan 1 1\n"), ""),
    ("infinite.off", CUBE_OFF.replace("1 1 1\n", "inf 1 1\n"), ""),
    ("overflow.off", CUBE_OFF.replace("1 1 1\n", "1e999 1 1\n"), ""),
    ("index_too_large.off", off(CUBE, TRIANGLES[:-1] + [(1, 7, 99)]), ""),
    ("index_negative.off", off(CUBE, TRIANGLES[:-1] + [(1, 7, -1)]), ""),
    ("face_of_two_vertices.off", off(CUBE, TRIANGLES[:-1] + [(1, 7)]), "fewer than three"),
    ("open.off", off(CUBE, TRIANGLES[:4]), "8 border edges, and 2 holes too large to be filled"),
    ("flat.off", off(CUBE, TRIANGLES).replace(" 1\n", " 0\n"), "is flat"),
    ("zero_volume.off", off([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
                            [(0, 1, 2), (0, 2, 1)]), ""),
    ("large_coordinates.off", off(moved(CUBE, 1e200), TRIANGLES), "overflow"),
    ("small_coordinates.off", off(moved(CUBE, 1e-200), TRIANGLES), "underflow"),
    ("far_away.off", off(moved(CUBE, 1e-6, (1e8, 0, 0)), TRIANGLES), ""),
    ("unknown_format.xyz", CUBE_OFF, "unknown format"),
    ("cut.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0", ""),
    ("cut.ply", "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\n", ""),
    ("empty.obj", "", ""),
]

# name, contents, words of the refusal and of the repair, volume that is enclosed if that is known
REPAIRED_SURFACES = [
    ("hole.off", off(CUBE, TRIANGLES[:-1]), "not closed: 3 border edges", "filled 1 hole", 1),
    ("tent.off", off(CUBE + [(0.5, -1, 0.5)], TRIANGLES + [(0, 1, 8), (0, 8, 5), (1, 8, 5)]),
     "more than two faces", "read as the solid", 1 + 1 / 6),
    ("not_orientable.off", off([(0, 0, 3), (1, 0, 0), (0.3, 1, 0.2), (-0.8, 0.6, 0), (-0.8, -0.6, 0.4),
                                (0.3, -1, 0)], PROJECTIVE_PLANE), "cannot be oriented", "read as the solid", None),
    ("fin.off", off(CUBE + [(0.5, -0.5, -0.5)], TRIANGLES + [(0, 1, 8)]), "not closed", "1 face that stands out", 1),
    ("cut.off", off(CUBE + moved(CUBE, 1, (0.5, 0.4, 0.3)), TRIANGLES + shifted(TRIANGLES, 8)),
     "of faces, for example near (", "read as the solid", 2 - 0.5 * 0.6 * 0.7),
    ("face_to_face.off", off(CUBE + moved(CUBE, 1, (1, 0, 0)), TRIANGLES + shifted(TRIANGLES, 8)),
     "of faces, for example near (", "read as the solid", 2),
    # a corner in common, but the second cube goes into the first
    ("pinched_and_crossing.off", off(CUBE + [(1 - (5 * x + 2 * y + 3 * z) / 10, 1 - (3 * x + 5 * y + 4 * z) / 10,
                                              1 - (2 * x + 3 * y + 20 * z) / 10) for x, y, z in CUBE][1:],
                                     PINCHED_TRIANGLES), "intersects itself", "read as the solid", None),
]

# name, contents, words of the warning
HARMLESS_SURFACES = [
    ("inside_out.off", off(CUBE, [f[::-1] for f in TRIANGLES]), "oriented inwards"),
    ("mixed_orientation.off", off(CUBE, [TRIANGLES[0][::-1]] + TRIANGLES[1:]), "oriented the faces"),
    ("quadrilaterals.off", off(CUBE, QUADS), "triangulated 6 polygons"),
    ("duplicate_points.off", off(CUBE + [CUBE[7]], [tuple(8 if v == 7 and i % 2 else v for v in f)
                                                    for i, f in enumerate(TRIANGLES)]), "merged 1"),
    ("unused_point.off", off(CUBE + [(9, 9, 9)], TRIANGLES), "1 unused point"),
    ("degenerate_face.off", off(CUBE, TRIANGLES + [(0, 1, 1)]), "degenerate"),
    ("needles.off", off(NEEDLES, NEEDLE_TRIANGLES), "removed 2 degenerate faces"),
    ("needles.stl", stl(NEEDLES, NEEDLE_TRIANGLES), "removed 2 degenerate faces"),
    ("pinched.off", off(PINCHED, PINCHED_TRIANGLES), "pinched at 1 point"),
    ("pinched.stl", stl(PINCHED, PINCHED_TRIANGLES), "pinched at 1 point"),
    # they have an edge in common
    ("edge_of_four_faces.off", off(CUBE + moved(CUBE, 1, (1, 1, 0)),
                                   TRIANGLES + shifted(TRIANGLES, 8)), "2 components"),
    ("two_components.off", off(CUBE + moved(CUBE, 1, (3, 0, 0)),
                               TRIANGLES + shifted(TRIANGLES, 8)), "2 components"),
    ("cavity.off", off(CUBE + moved(CUBE, 0.4, (0.3, 0.3, 0.3)),
                       TRIANGLES + shifted(TRIANGLES, 8)), "1 of them inside another: a cavity"),
]


class Surfaces(Case):
    def test_bad_surfaces(self):
        for name, contents, words in BAD_SURFACES:
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(path, "--vertices", 500, "--output", self.output, names=path, words=words)
                self.fails(self.good, "--region", path, "--vertices", 500, "--output", self.output,
                           names=path, words=words)

    def test_files_that_cannot_be_read(self):
        self.fails(WORK / "none.off", "--vertices", 500, names=WORK / "none.off", words="No such file")
        self.fails(self.file("two\nlines\x1b.off", "OFF\n"), "--vertices", 500, names="two?lines?.off: is truncated")
        (WORK / "directory.off").mkdir()
        self.fails(WORK / "directory.off", "--vertices", 500, names="directory.off", words="directory")

    def test_files_of_freesurfer(self):
        image = self.file("aseg.mgz", "x")
        self.fails(image, "--vertices", 500, names="aseg.mgz", words="not an image of FreeSurfer")
        self.fails(self.good, "--sheet", image, "--vertices", 500, names="aseg.mgz",
                   words="is an image; expected a surface")
        self.fails(self.file("surface.xyz", "x"), "--vertices", 500, names="surface.xyz", words="convert it")

    def test_spike(self):
        """A vertex far away: no cell is small enough, however many there are."""
        path = self.file("spike.off", off([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1e5)],
                                          [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]))
        self.fails(path, "--vertices", 60, names=path, words="too thin for this budget")

    def test_repaired_surfaces(self):
        for name, contents, defect, repair, volume in REPAIRED_SURFACES:
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(path, "--vertices", 500, "--strict", names=path, words=defect)
                report = WORK / "report.json"
                run = self.mesher(path, "--vertices", 500, "--report", report)
                self.assertEqual(run.returncode, 0, run.stderr)
                told = json.loads(report.read_text())
                self.assertEqual(len(told["inputs"]["surface"]["repairs"]), 1)
                self.assertIn(repair, told["inputs"]["surface"]["repairs"][0])
                self.assertIn(f"warning: {path}: " + told["inputs"]["surface"]["repairs"][0], run.stderr)
                self.assertTrue(all(told["checks"].values()))
                if volume is not None:
                    self.assertAlmostEqual(told["inputs"]["surface"]["volume"], volume, delta=1e-12)
        # as a region, too
        region = self.file("region.off", REPAIRED_SURFACES[4][1])
        run = self.mesher(self.good, "--region", region, "--vertices", 500)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("region.off: the surface intersects itself", run.stderr)

    def test_wrap(self):
        # half of a cube's faces; the message says what to do, and that does it
        path = self.file("half.off", off(CUBE, TRIANGLES[:6]))
        run = self.fails(path, "--vertices", 500, names=path, words="too large to be filled")
        width = run.stderr.split("; --wrap ")[1].split()[0]
        report = WORK / "report.json"
        run = self.mesher(path, "--vertices", 500, "--wrap", width, "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        told = json.loads(report.read_text())
        self.assertIn("wrapped it", told["inputs"]["surface"]["repairs"][0])
        self.assertGreater(told["inputs"]["surface"]["volume"], 0.2)
        self.assertEqual(told["options"]["wrap"], float(width))
        # what is a solid is wrapped, too
        self.assertEqual(self.mesher(self.good, "--vertices", 500, "--wrap", 0.5, "--report", report).returncode, 0)
        self.assertEqual(json.loads(report.read_text())["inputs"]["surface"]["repairs"],
                         ["wrapped it, closing what is narrower than 0.5"])
        self.fails(path, "--vertices", 500, "--wrap", 1e-5, names=path, words="more than a million triangles")
        self.fails(path, "--vertices", 500, "--wrap", 0, names="--wrap", words="greater than 0", status=2)
        self.fails(path, "--vertices", 500, "--wrap", 1, "--strict", names="--wrap", words="--strict", status=2)

    def stl_box(self, size, width=0.0):
        """A file in binary STL, whose coordinates are off by the last bit of a float, or by up to a width."""
        number = random.Random(1)
        triangles = b""
        for t in TRIANGLES:
            corners = [s * x for v in t for s, x in zip(size, CUBE[v])]
            if width > 0:
                corners = [x + width * number.random() for x in corners]
            bits = [struct.unpack("<i", struct.pack("<f", x))[0] for x in corners]
            triangles += struct.pack("<3f", 0, 0, 0) + struct.pack("<9i", *(b + number.getrandbits(1) for b in bits)) + b"\0\0"
        return self.file("box.stl", (b" " * 80 + struct.pack("<I", len(TRIANGLES)) + triangles).decode("latin-1"))

    def test_weld(self):
        """Points that differ in the last bit are welded: the mesh of a box is exact. Cracks are, if that is wanted."""
        report = WORK / "report.json"
        for more, width in (((), 0), (("--weld", 0.01), 0.005)):
            path = self.stl_box((100, 50, 20), width)
            run = self.mesher(path, "--vertices", 500, *more, "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertRegex(run.stderr, r"warning: .*box.stl: welded \d+ points to others, up to \S+ away")
            told = json.loads(report.read_text())
            self.assertEqual(told["inputs"]["surface"]["vertices"], 8)
            if width == 0:
                self.assertAlmostEqual(told["inputs"]["surface"]["volume"], 100000, delta=1e-9)
            self.assertEqual((told["status"], told["mesh"]["hexahedra"]), ("success", told["mesh"]["elements"]))
            self.assertAlmostEqual(told["surface"]["ratio of volumes"], 1, delta=1e-12)
            self.assertEqual(told["options"]["weld"], more[1] if more else None)
        refused = self.fails(path, "--vertices", 500, names=path, words="not closed")
        self.assertRegex(refused.stderr, "; --weld 0.01 or --wrap [0-9.]+ would close it$")
        self.fails(path, "--vertices", 500, "--weld", 0, names="--weld", status=2)
        self.fails(path, "--vertices", 500, "--strict", names=path, words="not closed: 36 border edges")

    def test_components(self):
        """Components are dropped, and specks are not missed."""
        report = WORK / "report.json"
        points = CUBE + moved(CUBE, 0.005, (1.5, 0, 0)) + moved(CUBE, 0.5, (3, 0, 0))
        path = self.file("three.off", off(points, TRIANGLES + shifted(TRIANGLES, 8) + shifted(TRIANGLES, 16)))
        for options, volume, dropped in ((("--largest",), 1, "2 of 3"), (("--drop-below", 0.01), 1.125, "1 of 3"),
                                         (("--drop-below", 0.5), 1, "2 of 3")):
            run = self.mesher(path, "--vertices", 500, *options, "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn(f"three.off: dropped {dropped} components, the largest of volume ", run.stderr)
            told = json.loads(report.read_text())
            self.assertAlmostEqual(told["inputs"]["surface"]["volume"], volume, delta=1e-12)
            self.assertEqual(told["status"], "success")
        run = self.mesher(path, "--vertices", 500, "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("missing", run.stderr)
        self.assertEqual(json.loads(report.read_text())["topology"]["differences"], [])
        self.fails(path, "--vertices", 500, "--drop-below", 2, names=path, words="no component has a volume of 2")

    def test_harmless_surfaces(self):
        for name, contents, words in HARMLESS_SURFACES:
            with self.subTest(name):
                path = self.file(name, contents)
                report = WORK / "report.json"
                run = self.mesher(path, "--vertices", 2000, "--output", self.output, "--report", report)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertTrue(all(line.startswith("warning: ") for line in run.stderr.splitlines()))
                self.assertIn(words, run.stderr)
                told = json.loads(report.read_text())
                self.assertTrue(any(words in w for w in told["warnings"]))
                self.assertTrue(all(told["checks"].values()))
                self.assertGreaterEqual(told["mesh"]["vertices"], 0.6 * 2000)  # whole layers of cells in boxes
                volume = told["inputs"]["surface"]["volume"]
                self.assertGreater(told["mesh"]["volume"], 0.93 * volume)  # two cubes lose most, at edges
                self.assertLess(told["mesh"]["volume"], 1.05 * volume)
                # where bodies touch, a few stay off
                self.assertLessEqual(told["surface"]["boundary vertices not on surface"],
                                     0.05 * told["surface"]["boundary vertices"])

    def test_lost_parts_are_reported(self):
        # a body, and a plate between two planes of the octree
        plate = [(2 + x, y, 0.55 + 0.01 * z) for x, y, z in CUBE]
        path = self.file("plate.off", off(CUBE + plate, TRIANGLES + shifted(TRIANGLES, 8)))
        report = WORK / "report.json"
        run = self.mesher(path, "--vertices", 500, "--no-simplification", "--output", self.output, "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("parts thinner than a cell are lost", run.stderr)
        self.assertRegex(run.stderr, r"(a piece of volume 0.01 cubic units|a body) near \(2\.")
        self.assertGreater(json.loads(report.read_text())["octree"]["cells lost"], 0)
        # alone, in the middle plane of the octree, its cells are much thicker
        points = [(100 * x, 100 * y, z) for x, y, z in plate]
        points[0] = (*points[0][:2], points[0][2] - 1e-6)  # else boxes between the planes of the surface would do
        path = self.file("plate_alone.off", off(points, TRIANGLES))
        run = self.mesher(path, "--vertices", 100, "--no-fit", "--output", self.output)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("times the surface's volume", run.stderr)

    def test_units_of_length(self):
        """No length is too large or too small for the comparison of topology."""
        points = [(sin(pi * i / 8) * cos(pi * j / 8), sin(pi * i / 8) * sin(pi * j / 8), cos(pi * i / 8))
                  for i in range(1, 8) for j in range(16)] + [(0, 0, 1), (0, 0, -1)]
        faces = [f for j in range(16) for k in ((j + 1) % 16,)
                 for f in ((112, j, k), (113, 96 + k, 96 + j),
                           *((16 * i + j, 16 * i + 16 + j, 16 * i + 16 + k, 16 * i + k) for i in range(6)))]
        for scale in (1e-30, 1e-9, 1, 1e16, 1e30):
            with self.subTest(scale):
                run = self.mesher(self.file("ball.off", off(moved(points, scale), faces)), "--vertices", 300,
                                  "--output", self.output)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual([line for line in run.stderr.splitlines() if "piece" in line], [])

    def test_space_and_unit(self):
        long = [(10 * x + 2, 20 * y + 3, 30 * z) for x, y, z in CUBE]  # beside the axis
        surface = self.file("surface.off", off(long, TRIANGLES))
        comment = "SPACE=LPS"
        report = WORK / "report.json"

        def warnings():  # without sharp edges, those of the box are cut off
            return [w for w in json.loads(report.read_text())["warnings"] if not w.startswith("default tolerance")]

        def told(region, *arguments):
            run = self.mesher(surface, "--region", region, "--vertices", 500, "--no-sharp", "--report", report,
                              *arguments)
            self.assertEqual(run.returncode, 0, run.stderr)
            return warnings()

        inside = moved(CUBE, 3, (4, 8, 10))
        turned = [(-x, -y, z) for x, y, z in inside]
        self.assertEqual(told(self.file("inside.off", off(inside, TRIANGLES))), [])
        lps = self.file("lps.stl", stl(turned, TRIANGLES).replace("solid x", "solid " + comment, 1))
        self.assertIn("says that it is in LPS", told(lps)[0])
        plain = self.file("plain.off", off(turned, TRIANGLES))
        self.fails(surface, "--region", plain, "--vertices", 500, names=plain, words="x and y negated")
        self.fails(surface, "--region", lps, "--vertices", 500, "--space", "RAS", names=lps, words="x and y negated")
        self.fails(surface, "--region", plain, "--region", plain, "--vertices", 500, names=plain,
                   words="x and y negated")
        # both in LPS
        run = self.mesher(self.file("turned.off", off([(-x, -y, z) for x, y, z in long], TRIANGLES)), "--region",
                          plain, "--space", "LPS", "--vertices", 500, "--no-sharp", "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        told_of_both = json.loads(report.read_text())
        self.assertEqual(told_of_both["options"]["space"], "LPS")
        self.assertEqual(["is read as LPS" in w for w in warnings()], [True, True])
        meters = self.file("meters.off", off(moved(inside, 1e-3), TRIANGLES))
        self.fails(surface, "--region", meters, "--vertices", 500, names=meters, words="1,000 times smaller")
        self.fails(self.file("surface_in_meters.off", off(moved(long, 1e-3), TRIANGLES)), "--region",
                   self.file("inside.off", off(inside, TRIANGLES)), "--vertices", 500, names="inside.off",
                   words="1,000 times larger")
        # of several regions one may be elsewhere
        warnings = told(self.file("inside.off", off(inside, TRIANGLES)), "--region", meters)
        self.assertEqual([w for w in warnings if "1,000 times smaller" not in w], [])
        self.assertEqual(self.mesher(surface, "--vertices", 500, "--space", "LAS").returncode, 2)

    def test_far_from_the_origin(self):
        """Volumes are those of the body, wherever it is."""
        ratios = []
        for shift in (0, 1e6, 3e8):
            path = self.file("far.off", off(moved(CUBE, 1, (shift, -shift, shift)), TRIANGLES))
            report = WORK / "far.json"
            run = self.mesher(path, "--vertices", 300, "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            told = json.loads(report.read_text())["surface"]
            self.assertAlmostEqual(told["volume of surface"], 1, 6)
            ratios.append(told["ratio of volumes"])
        self.assertAlmostEqual(ratios[1], ratios[0], 2)
        self.assertAlmostEqual(ratios[2], ratios[0], 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
