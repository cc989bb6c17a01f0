#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command-line mesher as a user meets it: bad input, warnings, outputs, determinism.

  test_command_line.py MESHER DATA_DIRECTORY WORK_DIRECTORY
"""

import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

MESHER, DATA, WORK = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])

CUBE = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]
# The projective plane with six vertices: closed, but not orientable.
PROJECTIVE_PLANE = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 1), (1, 2, 4), (2, 3, 5), (3, 4, 1),
                    (4, 5, 2), (5, 1, 3)]


def off(points, faces):
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(map(str, p)) for p in points]
    lines += [" ".join(map(str, (len(f), *f))) for f in faces]
    return "\n".join(lines) + "\n"


def moved(points, scale=1, shift=(0, 0, 0)):
    return [tuple(scale * x + s for x, s in zip(p, shift)) for p in points]


def shifted(faces, n):
    return [tuple(v + n for v in f) for f in faces]


def stl(points, faces):
    lines = ["facet normal 0 0 0\nouter loop\n" + "".join("vertex {} {} {}\n".format(*points[v]) for v in f)
             + "endloop\nendfacet" for f in faces]
    return "\n".join(["solid x", *lines, "endsolid x"]) + "\n"


CUBE_OFF = off(CUBE, TRIANGLES)
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


NOTHING_WRITTEN = "note: nothing will be written, without --output, --report and --page"


class CommandLine(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        self.good = self.file("good.off", CUBE_OFF)
        self.output = WORK / "mesh.vtu"

    def file(self, name, contents):
        path = WORK / name
        path.write_bytes(contents.encode("latin-1"))
        return path

    def mesher(self, *arguments):
        return subprocess.run([MESHER, *map(str, arguments)], capture_output=True, text=True, timeout=120)

    def fails(self, *arguments, names, status=1, words=""):
        """One line on stderr that names the culprit, no output, nothing left behind."""
        before = sorted(WORK.iterdir())
        run = self.mesher(*arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        errors = [line for line in run.stderr.splitlines() if line != NOTHING_WRITTEN]
        self.assertEqual(len(errors), 1, run.stderr)
        self.assertTrue(errors[0].startswith("mixed_mesh_3: error: "), run.stderr)
        self.assertIn(str(names), run.stderr)
        self.assertIn(words, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertEqual(sorted(WORK.iterdir()), before)
        return run

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

    def test_bad_budgets(self):
        for n in ("0", "-5", "many", "1.5", "1e4", "0x10", "99999999999999999999999", "1000000001", "5\n\x1b[31m"):
            with self.subTest(n):
                shown = n.replace("\n", "\\x0a").replace("\x1b", "\\x1b")
                self.fails(self.good, "--vertices", n, status=2, names="--vertices: expected a whole number from 1 to "
                           f"1000000000, not {shown}; see --help")
        self.fails(self.good, "--vertices", "", names="--vertices", status=2)
        self.fails(self.good, "--vertices", 1, "--output", self.output, names="--vertices 1",
                   words="has at least 7 vertices")
        self.fails(self.good, "--vertices", 10**9, names="--vertices", words="GiB")
        self.fails(self.good, "--vertices", 100, "--base-level", 5, names="--vertices", words="base level 5")
        self.fails(self.good, "--vertices", 100, "--base-level", 10, names="--vertices", words="at least")
        self.fails(self.good, "--vertices", 100, "--base-level", 11, names="--base-level", status=2)
        self.fails(self.good, "--vertices", 100, "--mode", "fast", names="--mode", status=2)
        self.fails("--vertices", 100, names="SURFACE", status=2)
        self.fails(self.good, names="--vertices", status=2)

    def test_region_off_the_domain(self):
        region = self.file("off_the_domain.off", off(moved(CUBE, 1, (5, 5, 5)), TRIANGLES))
        self.fails(self.good, "--region", region, "--vertices", 500, "--output", self.output,
                   names=region, words="does not meet")

        self.fails(self.good, "--region", region, "--region", region, "--vertices", 500, "--output", self.output,
                   names=self.good, words="none of the regions meets")

    def test_bad_weights(self):
        for weight in ("0", "-1", "2x", "nan", "inf", "1e7", ""):
            with self.subTest(weight):
                self.fails(self.good, "--region", f"{self.good}:{weight}", "--vertices", 500, status=2,
                           names=f"--region {self.good}:{weight}", words="is not a number from")
        self.fails(self.good, "--region", "x" * 5000 + ":2", "--vertices", 500, names="x" * 5000, words="name too long")
        self.fails(self.good, "--region", WORK / "none.off:2", "--vertices", 500,
                   names=WORK / "none.off", words="No such file")

    def test_outputs_that_cannot_be_written(self):
        for path in (WORK / "none" / "mesh.vtu", WORK / "good.off" / "mesh.vtu", WORK / "mesh.txt"):
            self.fails(self.good, "--vertices", 500, "--output", path, names=path)
        self.fails(self.good, "--vertices", 500, "--report", WORK / "none" / "r.json", names="r.json")
        self.fails(self.good, "--vertices", 500, "--report", self.good, names="good.off", words="twice")
        self.fails(self.good, "--vertices", 500, "--output", self.output, "--output", self.output,
                   names=self.output, words="twice")
        # what is there stays when the run fails
        self.output.write_text("precious")
        self.fails(self.file("open2.off", off(CUBE, TRIANGLES[:-1])), "--strict", "--vertices", 500, "--output",
                   self.output, names="open2.off")
        self.assertEqual(self.output.read_text(), "precious")

    def test_names(self):
        """What is in names reaches the terminal in one line, without control characters; system errors are ours."""
        odd = WORK / "a\nb\x1b[31m\u009b31m\u00e9.off"
        shown = "a\\x0ab\\x1b[31m\\x9b31m\u00e9.off"
        by_reader = "a?b?[31m\\x9b31m\u00e9.off"
        self.fails(odd, "--vertices", 100, names=by_reader, words="No such file")
        self.fails(self.good, "--vertices", 100, "--output", odd, names=shown, words="unknown extension")
        self.fails(self.good, "--vertices", 100, "--" + odd.name, names=shown, status=2)
        report = WORK / (odd.name + ".json")
        run = self.mesher(self.good, "--vertices", 100, "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(f"wrote {WORK / shown}.json\n", run.stdout)
        long = WORK / ("x" * 300 + ".off")
        self.fails(long, "--vertices", 100, names=f"{long}: cannot be opened: File name too long")
        self.fails(self.good, "--vertices", 100, "--report", long, names=f"{long}: ", words="File name too long")
        loop = WORK / "loop.off"
        loop.symlink_to(loop)
        self.fails(loop, "--vertices", 100, names=f"{loop}: cannot be opened: Too many levels of symbolic links")

    def test_nothing_will_be_written(self):
        run = self.mesher(self.good, "--vertices", 100)
        self.assertEqual((run.returncode, run.stderr), (0, NOTHING_WRITTEN + "\n"))

    def test_files_that_are_replaced(self):
        """They keep their modes; a link keeps leading where it leads, also to a file that is not there yet."""
        self.output.write_text("old")
        self.output.chmod(0o600)
        link = WORK / "link.msh"
        link.symlink_to("target.msh")
        long = WORK / ("x" * 251 + ".vtu")
        run = self.mesher(self.good, "--vertices", 100, "--output", self.output, "--output", link, "--output", long)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.output.stat().st_mode & 0o777, 0o600)
        self.assertTrue(link.is_symlink())
        self.assertGreater((WORK / "target.msh").stat().st_size, 1000)
        self.assertEqual(self.output.read_bytes(), long.read_bytes())

    def test_interrupted_while_it_writes(self):
        """The signal comes while a pipe waits for its reader: no file appears, and none is left behind."""
        pipe = WORK / "pipe.vtu"
        os.mkfifo(pipe)
        for number in (signal.SIGINT, signal.SIGTERM):
            before = sorted(WORK.iterdir())
            run = subprocess.Popen([MESHER, DATA / "brain.off", "--vertices", "5000", "--output", self.output,
                                    "--output", pipe], stderr=subprocess.PIPE, stdout=subprocess.PIPE)
            reader = os.open(pipe, os.O_RDONLY)
            os.read(reader, 100)
            self.assertEqual(len(sorted(WORK.iterdir())), len(before) + 1)  # the mesh under its hidden name
            run.send_signal(number)
            while os.read(reader, 1 << 16):
                pass
            os.close(reader)
            run.communicate()
            self.assertEqual(run.returncode, -number)
            self.assertEqual(sorted(WORK.iterdir()), before)

    def test_stopped(self):
        """By its own limit, or by a signal, in the middle of the optimization: what there is passes all checks."""
        arguments = [DATA / "brain.off", "--region", DATA / "region.off", "--vertices", 10000, "--output", self.output]
        report = WORK / "report.json"

        def repeated(f):
            """Where the machine is suddenly faster or slower than before, the middle is missed."""
            for _ in range(5):
                result = f()
                if result[0] == 4:
                    break
            return result

        def interrupted():
            run = subprocess.Popen([MESHER, *map(str, arguments)], stderr=subprocess.PIPE, stdout=subprocess.PIPE,
                                   text=True)
            time.sleep(middle)
            run.send_signal(signal.SIGINT)
            out, errors = run.communicate()
            return run.returncode, out, errors

        def limited():
            run = self.mesher(*arguments, "--report", report, "--time-limit", middle)
            return run.returncode, run.stdout, run.stderr

        self.assertEqual(self.mesher(*arguments, "--report", report).returncode, 0)
        stages = {s["stage"]: s["seconds"] for s in json.loads(report.read_text())["stages"]}
        names = list(stages)
        middle = (sum(stages[n] for n in names[:names.index("optimization")]) + stages["quality"]
                  + 0.4 * stages["optimization"])
        whole = self.output.read_bytes()
        status, out, errors = repeated(limited)
        self.assertEqual(status, 4, errors)
        self.assertIn("warning: stopped by --time-limit after ", errors)
        told = json.loads(report.read_text())
        self.assertEqual((told["status"], told["options"]["time limit"]), ("stopped", middle))
        self.assertTrue(all(told["checks"].values()))
        self.assertTrue(0.9 * 10000 < told["mesh"]["vertices"] <= 10000)
        self.assertNotEqual(self.output.read_bytes(), whole)
        status, out, errors = repeated(interrupted)
        self.assertEqual(status, 4, errors)
        self.assertIn("warning: stopped by a signal after ", errors)
        self.assertIn("all checks hold", out)
        # before there is a mesh
        self.fails(*arguments, "--time-limit", 1e-9, names="stopped before there was a mesh: nothing is written")
        self.fails(*arguments, "--time-limit", 0, names="--time-limit", status=2)

    def test_progress(self):
        """On a terminal: a share of the work that never falls, and the time that is left."""
        terminal, stderr = os.openpty()
        run = subprocess.Popen([MESHER, DATA / "brain.off", "--vertices", "2000", "--output", self.output], stderr=stderr,
                               stdout=subprocess.DEVNULL)
        os.close(stderr)
        text = b""
        try:
            while piece := os.read(terminal, 1 << 16):
                text += piece
        except OSError:  # the end of a terminal
            pass
        os.close(terminal)
        self.assertEqual(run.wait(), 0)
        shares = [int(share) for share in re.findall(rb"about +(\d+) %, \d+ s left: ", text)]
        self.assertGreater(len(shares), 10)
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(shares[0] < 15 and 85 < shares[-1] < 100)

    def test_spike(self):
        """A vertex far away: no cell is small enough, however many there are."""
        path = self.file("spike.off", off([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1e5)],
                                          [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]))
        self.fails(path, "--vertices", 60, names=path, words="too thin for this budget")
    def test_space_and_unit(self):
        long = [(10 * x + 2, 20 * y + 3, 30 * z) for x, y, z in CUBE]  # beside the axis
        surface = self.file("surface.off", off(long, TRIANGLES))
        comment = "SPACE=LPS"
        report = WORK / "report.json"

        def told(region, *arguments):
            run = self.mesher(surface, "--region", region, "--vertices", 500, "--no-sharp", "--report", report,
                              *arguments)
            self.assertEqual(run.returncode, 0, run.stderr)
            return json.loads(report.read_text())["warnings"]

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
        self.assertEqual(["is read as LPS" in w for w in told_of_both["warnings"]], [True, True])
        meters = self.file("meters.off", off(moved(inside, 1e-3), TRIANGLES))
        self.fails(surface, "--region", meters, "--vertices", 500, names=meters, words="1,000 times smaller")
        self.fails(self.file("surface_in_meters.off", off(moved(long, 1e-3), TRIANGLES)), "--region",
                   self.file("inside.off", off(inside, TRIANGLES)), "--vertices", 500, names="inside.off",
                   words="1,000 times larger")
        # of several regions one may be elsewhere
        warnings = told(self.file("inside.off", off(inside, TRIANGLES)), "--region", meters)
        self.assertEqual([w for w in warnings if "1,000 times smaller" not in w], [])
        self.assertEqual(self.mesher(surface, "--vertices", 500, "--space", "LAS").returncode, 2)

    def test_files_of_freesurfer(self):
        self.fails(self.file("aseg.mgz", "x"), "--vertices", 500, names="aseg.mgz", words="mri_convert")
        self.fails(self.file("aseg.mgz", "x"), "--labels", "1", "--vertices", 500, names="aseg.mgz",
                   words="mri_convert", status=2)
        self.fails(self.file("surface.xyz", "x"), "--vertices", 500, names="surface.xyz", words="convert it")

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
        # what is a solid stays what it is
        self.assertEqual(self.mesher(self.good, "--vertices", 500, "--wrap", 0.1, "--report", report).returncode, 0)
        self.assertEqual(json.loads(report.read_text())["inputs"]["surface"]["repairs"], [])
        self.fails(path, "--vertices", 500, "--wrap", 1e-5, names=path, words="more than a million triangles")
        self.fails(path, "--vertices", 500, "--wrap", 0, names="--wrap", words="greater than 0", status=2)
        self.fails(path, "--vertices", 500, "--wrap", 1, "--strict", names="--wrap", words="--strict", status=2)

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
        run = self.mesher(path, "--vertices", 500, "--output", self.output, "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("parts thinner than a cell are lost", run.stderr)
        self.assertGreater(json.loads(report.read_text())["octree"]["cells lost"], 0)
        # alone, in the middle plane of the octree, its cells are much thicker
        path = self.file("plate_alone.off", off([(100 * x, 100 * y, z) for x, y, z in plate], TRIANGLES))
        run = self.mesher(path, "--vertices", 100, "--no-fit", "--output", self.output)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("times the surface's volume", run.stderr)

    def brain(self, *arguments, vertices=660):
        """The report on a mesh of the brain, and what was printed."""
        report = WORK / "brain.json"
        run = self.mesher(DATA / "brain.off", "--region", DATA / "region.off", "--vertices", vertices, *arguments,
                          "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(report.read_text()), run

    def test_all_outputs_and_report(self):
        outputs = [WORK / ("brain" + e) for e in (".vtu", ".msh", ".mesh", ".inp", ".feb", ".msh2")]
        told, run = self.brain(*(x for path in outputs for x in ("--output", path)))
        self.assertEqual(run.stderr, "")
        for words in ("vertices of 660", "ARC mean", "Hausdorff distance", "times the surface's volume",
                      "all checks hold"):
            self.assertIn(words, run.stdout)
        self.assertTrue(all(path.stat().st_size > 10000 for path in outputs))
        self.assertEqual(told["status"], "success")
        self.assertTrue(640 <= told["mesh"]["vertices"] <= 660)
        self.assertTrue(0 < told["mesh"]["vertices in region"] < 660)
        self.assertEqual(told["vertices inserted"]["by boundary stage"], 0)
        self.assertTrue(all(told["checks"].values()) and len(told["checks"]) == 7)
        kinds = ("tetrahedra", "pyramids", "prisms", "hexahedra")
        self.assertEqual(sum(told["mesh"][k] for k in kinds), told["mesh"]["elements"])
        stages = [s["stage"] for s in told["stages"]]
        for stage in ("read surface", "octree", "transitions", "boundary", "assembly", "optimization", "checks"):
            self.assertIn(stage, stages)
        quiet = self.mesher(DATA / "brain.off", "--vertices", 660, "--quiet")
        self.assertEqual((quiet.returncode, quiet.stdout, quiet.stderr), (0, "", ""))

    def test_topology(self):
        """Two cubes with a gap: a coarse mesh joins them, and a fine one does not."""
        cubes = self.file("gap.off", off(CUBE + moved(CUBE, 1, (1.3, 0, 0)), TRIANGLES + shifted(TRIANGLES, 8)))
        report = WORK / "report.json"
        for vertices, level, bodies in (300, 3, 1), (2500, 4, 2):
            run = self.mesher(cubes, "--vertices", vertices, "--base-level", level, "--output", self.output,
                              "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            told = json.loads(report.read_text())
            topology = told["topology"]
            self.assertAlmostEqual(topology["surface"].pop("volume"), 2)
            self.assertEqual(topology["surface"], {"bodies": 2, "handles": 0, "cavities": 0})
            self.assertEqual(topology["mesh"]["bodies"], bodies)
            self.assertEqual(topology["same topology"], bodies == 2)
            words = r"warning: .*gap.off: 2 bodies are joined near \(1\.15, "
            if bodies == 1:
                self.assertEqual(told["status"], "topology differs")
                self.assertRegex(run.stderr, words)
                self.assertRegex(topology["differences"][0]["text"], "^2 bodies are joined near ")
                self.assertAlmostEqual(topology["differences"][0]["at"][0], 1.15)
            else:
                self.assertEqual(told["status"], "success")
                self.assertNotIn("joined", run.stderr)

    def test_volume(self):
        """Success and a volume beyond 5 % exclude each other, and an absurd volume is refused."""
        told, run = self.brain(vertices=150)
        ratio = told["surface"]["ratio of volumes"]
        self.assertFalse(0.95 <= ratio <= 1.05)
        self.assertEqual(told["status"], "volume differs")
        self.assertRegex(run.stderr, r"a body near \(.*\) has .* % (less|more) volume")
        told, run = self.brain()
        self.assertTrue(0.95 <= told["surface"]["ratio of volumes"] <= 1.05)
        self.assertEqual((told["status"], told["topology"]["differences"]), ("success", []))
        points = [(4 * x, 4 * y, 0.2 * i + 0.05 * z) for i in range(10) for x, y, z in CUBE]
        plates = self.file("stack.off", off(points, [f for i in range(10) for f in shifted(TRIANGLES, 8 * i)]))
        self.fails(plates, "--vertices", 1000, "--base-level", 3, "--output", self.output, names=plates,
                   words="times the surface's volume")
        self.assertFalse(self.output.exists())

    def test_quality_bound(self):
        # thin plates: some vertices would need bad elements to get onto them
        points = [(x, y, 0.3 * i + 0.05 * z) for i in range(4) for x, y, z in CUBE]
        plates = self.file("plates.off", off(points, [f for i in range(4) for f in shifted(TRIANGLES, 8 * i)]))
        report = WORK / "report.json"
        for bound, largest in ((), 3.2), (("--max-arc", 4), 4), (("--max-arc", "none"), None):
            run = self.mesher(plates, "--vertices", 2000, "--output", self.output, "--report", report, *bound)
            self.assertEqual(run.returncode, 0, run.stderr)
            told = json.loads(report.read_text())
            quality = told["quality"]
            self.assertEqual(told["options"]["max ARC"], largest)
            self.assertEqual(told["status"], "topology differs")  # some plates are joined, which weighs more
            self.assertLess(told["topology"]["mesh"]["bodies"], 4)
            self.assertLess(told["fitting"]["arrived"], told["fitting"]["boundary vertices"])
            if largest is None:
                self.assertGreater(quality["after"]["all"]["ARC max"], 5)
                self.assertNotIn("quality bound", quality)
                continue
            self.assertIn("worse than --max-arc allows", run.stderr)
            self.assertLessEqual(quality["after"]["all"]["ARC max"], largest)
            proof = quality["quality bound"]
            self.assertEqual((proof["ARC"], proof["elements above"]), (largest, 0))
            smallest_angle, largest_angle = proof["dihedral angles of tetrahedra within it"]
            self.assertGreaterEqual(quality["smallest dihedral angle"]["tetrahedra"]["min"], smallest_angle)
            self.assertLessEqual(quality["largest dihedral angle"]["tetrahedra"]["max"], largest_angle)
        for bad in "0.5", "-1", "nan", "much":
            self.assertEqual(self.mesher(plates, "--vertices", 2000, "--max-arc", bad).returncode, 2)
        self.assertEqual(self.mesher(plates, "--vertices", 2000, "--max-arc", 4, "--no-fit").returncode, 2)
        # with a bound that no mesh can have, what is above it is told
        told, run = self.brain("--max-arc", 1.1)
        self.assertGreater(told["quality"]["quality bound"]["elements above"], 100)
        self.assertIn("elements are above it", run.stderr)

    def test_quality(self):
        told, _ = self.brain()
        quality = told["quality"]
        before, after = quality["before"], quality["after"]
        self.assertLessEqual(after["all"]["ARC mean"], 1.5)
        self.assertLessEqual(after["all"]["ARC max"], 2.6)
        self.assertEqual(after["all"]["share of ARC <= 7"], 1)
        self.assertGreater(before["all"]["ARC mean"], after["all"]["ARC mean"])
        self.assertEqual(before["hexahedra"]["elements"], after["hexahedra"]["elements"])
        histogram = quality["histograms"]["ARC"]
        for when in ("before", "after"):
            self.assertEqual(len(histogram[when]), len(histogram["edges"]) + 1)
            self.assertEqual(sum(histogram[when]), quality[when]["all"]["elements"])
            self.assertEqual(sum(quality[when][k]["elements"] for k in quality[when]),
                             2 * quality[when]["all"]["elements"])
            for row in quality[when].values():
                if row["elements"] == 0:
                    self.assertIsNone(row["ARC mean"])
                else:
                    self.assertTrue(1 <= row["ARC min"] <= row["ARC mean"] <= row["ARC max"])
        self.assertTrue(0 < quality["scaled Jacobian"]["all"]["min"] < quality["scaled Jacobian"]["all"]["max"] <= 1)
        self.assertTrue(0 < quality["smallest dihedral angle"]["all"]["min"] < 60)
        self.assertTrue(90 < quality["largest dihedral angle"]["all"]["max"] < 180)
        self.assertTrue(0 < quality["quad warp"]["hexahedra"]["max"] <= quality["quad warp"]["all"]["max"] < 20)

    def test_surface(self):
        told, _ = self.brain()
        surface = told["surface"]
        self.assertEqual(surface["boundary vertices not on surface"], 0)
        self.assertEqual(surface["boundary self-intersections"], 0)
        self.assertTrue(0.95 < surface["ratio of volumes"] < 1.05)
        self.assertAlmostEqual(surface["volume of mesh"] / surface["volume of surface"], surface["ratio of volumes"])
        distance = surface["Hausdorff distance"]
        for way in ("from mesh to surface", "from surface to mesh"):
            self.assertTrue(0 < distance[way]["distance"] <= distance["distance"] < 20)
            apart = sum((a - b) ** 2 for a, b in zip(distance[way]["at"], distance[way]["nearest"])) ** 0.5
            self.assertAlmostEqual(apart, distance[way]["distance"])
        self.assertEqual(told["fitting"]["method"], "optimization")
        self.assertEqual(told["fitting"]["arrived"], told["fitting"]["boundary vertices"])
        self.assertEqual(told["fitting"]["boundary vertices"], surface["boundary vertices"])

    def test_no_fit(self):
        told, _ = self.brain("--no-fit")
        self.assertEqual((told["status"], told["fitting"]), ("success", {"method": "none"}))
        self.assertGreater(told["surface"]["boundary vertices not on surface"], 100)
        self.assertNotIn("before", told["quality"])
        self.assertEqual(told["vertices inserted"]["by bisection of boundary edges"], 0)
        # fitted by the optimization, part of the budget is left to bisections; the octree is another
        fitted, _ = self.brain()
        bisections = fitted["vertices inserted"]["by bisection of boundary edges"]
        self.assertGreater(bisections, 20)
        self.assertLess(fitted["mesh"]["vertices"] - bisections, told["mesh"]["vertices"])
        if "without Eigen" not in self.mesher(self.good, "--vertices", 100, "--no-optimize").stderr:
            fitted, _ = self.brain("--no-optimize")
            self.assertEqual(told["quality"]["after"], fitted["quality"]["before"])

    def test_no_optimize(self):
        if "without Eigen" in self.mesher(self.good, "--vertices", 100, "--no-optimize").stderr:
            self.fails(self.good, "--vertices", 100, "--no-optimize", names="--no-optimize", status=2)
            self.skipTest("the mesher was built without Eigen")
        told, run = self.brain("--no-optimize")
        self.assertEqual(told["status"], "success")
        # few elements, if any, resist to be stiffened, and that is told
        bad = told["fitting"]["elements not acceptable at the cap"]
        self.assertLessEqual(bad, 3)
        self.assertEqual((told["fitting"]["method"], told["fitting"]["status"]),
                         ("Algorithm 1", "cap reached" if bad else "success"))
        warnings = [f"{bad} elements have an aspect-ratio coefficient above 7"] if bad else []
        self.assertEqual(len(run.stderr.splitlines()), len(warnings))
        for words in warnings:
            self.assertIn(words, run.stderr)
        self.assertEqual(told["fitting"]["arrived"], told["fitting"]["boundary vertices"])
        self.assertGreaterEqual(told["fitting"]["solves"], 4)
        self.assertEqual(told["surface"]["boundary vertices not on surface"], 0)
        self.assertEqual(told["quality"]["before"]["all"]["elements"], told["quality"]["after"]["all"]["elements"])
        self.assertEqual(told["options"]["Algorithm 1"]["solver"], "cg")
        for arguments in (["--steps", 2], ["--poisson-ratio", 0.45], ["--layers", 1], ["--solver", "ldlt"],
                          ["--acceptable-quality", 1.5, "--stiffness-factor", 4], ["--tetrahedra"],
                          ["--mode", "paper"]):
            with self.subTest(arguments):
                other, _ = self.brain("--no-optimize", *arguments)
                self.assertEqual(other["surface"]["boundary vertices not on surface"], 0)
                self.assertNotEqual(other["quality"]["after"], told["quality"]["after"])
        # an element is not acceptable, and may not be stiffened
        told, run = self.brain("--no-optimize", "--acceptable-quality", 2, "--max-stiffness", 1)
        self.assertEqual((told["status"], told["fitting"]["status"]), ("success", "cap reached"))
        self.assertGreater(told["fitting"]["elements not acceptable at the cap"], 0)
        self.assertIn("elements have an aspect-ratio coefficient above 2", run.stderr)

    def test_tolerance(self):
        # by default as the budget allows, and no more than a wish
        wished, run = self.brain()
        self.assertEqual((wished["status"], run.stderr), ("success", ""))
        self.assertEqual(wished["options"]["tolerance"], "automatic")
        self.assertTrue(0 < wished["tolerance"]["tolerance"] < 8)
        self.assertLess(wished["surface"]["Hausdorff distance"]["distance"], 8)
        told, run = self.brain("--tolerance", 8)
        self.assertEqual(told["options"]["tolerance"], 8)
        self.assertEqual(told["tolerance"]["tolerance"], 8)
        self.assertEqual((told["status"], run.stderr), ("success", ""))
        self.assertTrue(told["tolerance"]["reached"])
        self.assertTrue(0 < told["tolerance"]["largest distance"] <= 8)
        self.assertEqual(told["tolerance"]["largest distance"], told["surface"]["Hausdorff distance"]["distance"])
        self.assertTrue(0 < told["tolerance"]["vertices of the mesh as coarse as it allows"] <= 660)
        told, run = self.brain("--tolerance", 1, vertices=300)
        self.assertEqual(told["status"], "tolerance not reached")
        self.assertFalse(told["tolerance"]["reached"])
        self.assertRegex(run.stderr, r"^warning: --tolerance 1: not reached, .*\(.*, .*, .*\) is .* away from .*")
        self.fails(DATA / "brain.off", "--vertices", 660, "--tolerance", 1e-6, "--output", self.output,
                   names="--tolerance 1e-06", words="too small")

    def test_grading(self):
        told = {grading: self.brain("--grading", grading)[0] for grading in (0, 0.35, 2)}
        for grading, t in told.items():
            self.assertEqual(t["options"]["grading"], grading)
            self.assertEqual(t["status"], "success")
        default, _ = self.brain()
        self.assertEqual(default["quality"], told[0.35]["quality"])
        # the gentler, the fewer vertices are left for the region
        self.assertGreater(told[0]["mesh"]["vertices in region"], told[2]["mesh"]["vertices in region"])

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

    def test_several_regions(self):
        """A light region gets fewer of the vertices, a heavy one leaves fewer to the other."""
        low, edge = (-42, -32, 18), 24
        box = self.file("box.off", off(moved(CUBE, edge, low), TRIANGLES))
        output = WORK / "regions.mesh"
        numbers, others = [], []
        for weight in ("", ":1", ":0.01", ":100"):
            told, _ = self.brain("--region", f"{box}{weight}", "--output", output, vertices=1500)
            self.assertEqual([r["weight"] for r in told["inputs"]["regions"]], [1, float(weight[1:] or 1)])
            lines = output.read_text().split("\n")
            first = lines.index("Vertices") + 2
            points = [[float(x) for x in line.split()[:3]] for line in lines[first:first + told["mesh"]["vertices"]]]
            numbers.append(sum(all(l <= x <= l + edge for l, x in zip(low, p)) for p in points))
            others.append(told["mesh"]["vertices in region"] - numbers[-1])
        self.assertEqual((numbers[0], others[0]), (numbers[1], others[1]))
        self.assertLess(2 * numbers[2], numbers[1])
        self.assertLess(2 * others[3], others[1])

    def test_subdomains(self):
        """A tumor with a label and an interface, or as a cavity."""
        report, mesh = WORK / "subdomains.json", WORK / "subdomains.vtu"
        tumor = DATA / "tumour.off"
        run = self.mesher(DATA / "brain.off", "--subdomain", f"tumor={tumor}", "--region", DATA / "region.off",
                     "--vertices", 1500, "--output", mesh, "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        told = json.loads(report.read_text())
        self.assertTrue(all(told["checks"].values()))
        self.assertEqual([(s["name"], s["index"]) for s in told["subdomains"]], [("tumor", 2), ("brain", 1)])
        for s in told["subdomains"]:
            self.assertAlmostEqual(s["volume"] / s["volume of surface"], 1, delta=0.08)
            self.assertLessEqual(s["ARC max"], 3.2)
        self.assertAlmostEqual(sum(s["volume"] for s in told["subdomains"]), told["mesh"]["volume"], delta=1)
        self.assertEqual([i["between"] for i in told["interfaces"]], [["brain", "outside"], ["brain", "tumor"]])
        self.assertTrue(all(i["manifold"] for i in told["interfaces"]))
        self.assertIn("tumor (2): ", run.stdout)

        run = self.mesher(DATA / "brain.off", "--cavity", tumor, "--region", DATA / "region.off", "--vertices", 1500,
                     "--output", mesh, "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        told = json.loads(report.read_text())
        self.assertEqual(len([s for s in told["subdomains"] if s["elements"] > 0]), 1)
        self.assertAlmostEqual(told["surface"]["ratio of volumes"], 1, delta=0.04)

    def test_wrong_subdomains(self):
        tumor = DATA / "tumour.off"
        for options, words in ((["--subdomain", f"brain={tumor}"], "the name is taken"),
                               (["--subdomain", f"a={tumor}", "--subdomain", f"a={tumor}"], "the name is taken"),
                               (["--subdomain", f"outside={tumor}"], "the name is taken"),
                               (["--subdomain", f"1={tumor}"], "a name has up to 24"),
                               (["--subdomain", tumor, "--no-optimize"], "knows neither"),
                               (["--cavity", tumor, "--mode", "paper"], "knows neither")):
            run = self.mesher(DATA / "brain.off", "--vertices", 1500, *options)
            self.assertEqual(run.returncode, 2)
            self.assertIn(words, run.stderr)
        run = self.mesher(DATA / "brain.off", "--vertices", 1500, "--subdomain", "a=nothing.off")
        self.assertEqual(run.returncode, 1)
        self.assertIn("nothing.off", run.stderr)

    def test_sheets(self):
        """A plane through half of the brain: a facet set, and a slit."""
        sheet = self.file("falx.off", off([(0, -120, 10), (0, 90, 10), (0, 90, 100), (0, -120, 100)],
                                          [(0, 1, 2, 3)]))
        far = self.file("far.off", off([(0, 0, 500), (0, 9, 500), (0, 9, 510)], [(0, 1, 2)]))
        mesh = WORK / "falx.vtu"
        told, run = self.brain("--sheet", sheet, "--output", mesh, "--output", WORK / "falx.msh", vertices=1500)
        self.assertEqual(len(told["sheets"]), 1)
        falx = told["sheets"][0]
        self.assertEqual(falx["name"], "falx")
        self.assertGreater(falx["faces"], 50)
        self.assertAlmostEqual(falx["area"] / falx["area of surface inside the domain"], 1, delta=0.15)
        self.assertLessEqual(falx["vertices not on surface"], 0.05 * falx["vertices"])
        self.assertTrue(all(told["checks"].values()))
        self.assertIn("falx: ", run.stdout)
        self.assertIn(b"facets_falx", mesh.read_bytes())
        self.assertIn(b'"compartment"', mesh.read_bytes())
        self.assertIn(b'"falx"', (WORK / "falx.msh").read_bytes())

        slit, run = self.brain("--sheet", sheet, "--slit", "--output", mesh, vertices=1500)
        self.assertEqual(slit["sheets"][0]["faces"], falx["faces"])
        self.assertGreater(slit["slit"]["vertices doubled"], 20)
        self.assertEqual(slit["mesh"]["vertices"], told["mesh"]["vertices"] + slit["slit"]["vertices doubled"])
        self.assertIn(b"facets_falx_front", mesh.read_bytes())

        told, run = self.brain("--sheet", far)
        self.assertIn("warning: the sheet far has no faces in the mesh", run.stderr)
        for options, status, words in ((["--sheet", sheet, "--sheet", sheet], 2, "the name is taken"),
                                       (["--sheet", sheet, "--no-optimize"], 2, "knows no sheets"),
                                       (["--slit"], 2, "needs --sheet"), (["--sheet", "a=nothing.off"], 1, "nothing.off"),
                                       (["--sheet", self.file("m.off", off(CUBE, [(0, 1, 2), (0, 1, 4), (0, 1, 6)]))], 1,
                                        "not a manifold")):
            run = self.mesher(DATA / "brain.off", "--vertices", 660, *options)
            self.assertEqual(run.returncode, status)
            self.assertIn(words, run.stderr)

    def test_wrong_use(self):
        for arguments, words in (
                (["--steps", 3], "--steps requires --no-optimize"),
                (["--solver", "ldlt"], "--solver requires --no-optimize"),
                (["--layers", 2], "--layers requires --no-optimize"),
                (["--max-stiffness", 2, "--no-fit"], "--max-stiffness requires --no-optimize"),
                (["--no-fit", "--no-optimize"], "excludes"),
                (["--no-fit", "--tolerance", 1], "excludes"),
                (["--no-optimize", "--tolerance", 1], "excludes"),
                (["--no-optimize", "--steps", 0], "--steps"),
                (["--no-optimize", "--poisson-ratio", 0.5], "--poisson-ratio: expected a number of at least 0"),
                (["--no-optimize", "--poisson-ratio", "nan"], "--poisson-ratio"),
                (["--no-optimize", "--stiffness-factor", 1], "--stiffness-factor"),
                (["--no-optimize", "--max-stiffness", 0.5], "--max-stiffness"),
                (["--no-optimize", "--acceptable-quality", "inf"], "--acceptable-quality"),
                (["--no-optimize", "--layers", -1], "--layers"),
                (["--no-optimize", "--solver", "lu"], "--solver"),
                (["--grading", -0.1], "--grading: expected a number from 0 to 100"),
                (["--grading", "nan"], "--grading: expected a number from 0 to 100"),
                (["--grading", "much"], "--grading"),
                (["--tolerance", 0], "--tolerance: expected a number greater than 0"),
                (["--tolerance", "nan"], "--tolerance"),
                (["--tolerance", "much"], "--tolerance")):
            with self.subTest(arguments):
                self.fails(self.good, "--vertices", 100, *arguments, "--output", self.output, names=words, status=2)

    def test_libraries(self):
        """No BLAS, which is for `brain_shift`: it takes much of the address space when it is loaded."""
        if not shutil.which("ldd"):
            self.skipTest("there is no ldd")
        run = subprocess.run(["ldd", MESHER], capture_output=True, text=True)
        self.assertNotRegex(run.stdout, "blas|cholmod")

    def test_same_bytes(self):
        for arguments in ([], ["--no-optimize"], ["--tolerance", 12], ["--no-fit"]):
            if arguments == ["--no-optimize"] and self.mesher(self.good, "--vertices", 100, *arguments).returncode:
                continue  # built without Eigen
            hashes = set()
            for i, threads in enumerate((1, 5) if "--tolerance" in arguments else (1, 1, 1, 2, 5)):
                path = WORK / f"{i}.vtu"
                run = self.mesher(DATA / "brain.off", "--region", DATA / "region.off", "--vertices",
                                  300 if "--tolerance" in arguments else 660, *arguments, "--threads", threads,
                                  "--output", path)
                self.assertEqual(run.returncode, 0, run.stderr)
                hashes.add(hashlib.sha256(path.read_bytes()).hexdigest())
            self.assertEqual(len(hashes), 1, arguments)

    def test_modes(self):
        for arguments in (["--mode", "paper"], ["--root", "box"], ["--templates", "centered"], ["--no-fit"],
                          ["--tetrahedra"], ["--base-level", "2"], ["--msh2"]):
            with self.subTest(arguments):
                run = self.mesher(DATA / "brain.off", "--region", DATA / "region.off", "--vertices", 1000,
                                  *arguments, "--output", WORK / "mesh.msh")
                self.assertEqual((run.returncode, run.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
