# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the command-line mesher share: arguments, MESHER DATA_DIRECTORY WORK_DIRECTORY, and calls."""

import json
import pathlib
import shutil
import subprocess
import sys
import unittest

from cube import CUBE, TRIANGLES, off

MESHER, DATA, WORK = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
CUBE_OFF = off(CUBE, TRIANGLES)
NOTHING_WRITTEN = "note: nothing will be written, without --output, --report and --page"


class Case(unittest.TestCase):
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

    def brain(self, *arguments, vertices=660):
        """The report on a mesh of the brain, and what was printed."""
        report = WORK / "brain.json"
        run = self.mesher(DATA / "brain.off", "--region", DATA / "region.off", "--vertices", vertices, *arguments,
                          "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(report.read_text()), run
