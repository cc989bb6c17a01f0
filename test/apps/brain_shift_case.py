# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of brain_shift share: inputs and calls.

Their arguments are MESH BRAIN_SHIFT DATA_DIRECTORY WORK_DIRECTORY, MESH being one of the brain with 660 vertices.
Without the packages that they read files with, they are skipped.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from cube import CUBE, TRIANGLES, off

MESH, PROGRAM, DATA, WORK = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])

try:
    import nibabel
    import numpy as np
    import vtk
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

HEADER = "x,y,z,dx,dy,dz\n"
POINTS = (DATA / "control_points.csv").read_text()
ROWS = [line for line in POINTS.splitlines() if line and line[0] not in "#x"]
VALUES = np.array([[float(x) for x in row.split(",")] for row in ROWS])


def cube_off(center, width, faces=TRIANGLES):
    return off([tuple(c + width * (x - 0.5) for c, x in zip(center, p)) for p in CUBE], faces)


def with_value(row, column, text):
    """The control points with one number replaced; and its line in the file, from 1."""
    cells = ROWS[row].split(",")
    cells[column] = text
    return HEADER + "\n".join(ROWS[:row] + [",".join(cells)] + ROWS[row + 1:]) + "\n"


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.mesh, cls.tumor = shutil.copy(MESH, WORK / "brain.vtu"), DATA / "tumour.off"
        cls.points = cls.file("points.csv", POINTS)
        # A synthetic image, linear in space, of 3 mm: not along the axes, first index to the left.
        cls.affine = np.array([[-3, 0, 0, 90], [0, 3, 0, -126], [0, 0, 3, -72], [0, 0, 0, 1.]])
        cls.gradient = np.array([1.5, -0.5, 2.])
        world = cls.affine[:3, :3] @ np.indices((61, 73, 61)).reshape(3, -1) + cls.affine[:3, 3:]
        cls.values = (1000 + cls.gradient @ world).reshape(61, 73, 61).astype(np.float32)
        cls.image = WORK / "image.nii.gz"
        image = nibabel.Nifti1Image(cls.values, cls.affine)
        image.header.set_xyzt_units("mm")
        nibabel.save(image, cls.image)

    @classmethod
    def file(cls, name, contents):
        path = WORK / name
        path.write_bytes(contents if isinstance(contents, bytes) else contents.encode("latin-1"))
        return path

    def shift(self, *arguments, **environment):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              env={**os.environ, **environment})

    def fails(self, *arguments, names, status=1, words=""):
        """One line on stderr that names the culprit, no output, nothing left behind."""
        before = sorted(WORK.iterdir())
        run = self.shift(*arguments, "--output", WORK / "no.vtu", "--report", WORK / "no.json")
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertTrue(run.stderr.startswith("brain_shift: error: "), run.stderr)
        self.assertIn(str(names), run.stderr)
        self.assertIn(words, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertEqual(sorted(WORK.iterdir()), before)

    def fails_with(self, points, *arguments, words, names=None):
        path = self.file("these.csv", points)
        self.fails(self.mesh, "--control-points", path, *arguments, names=names or path, words=words)

    def succeeds(self, *arguments, **environment):
        """The report, and what was printed."""
        run = self.shift(*arguments, "--report", WORK / "report.json", **environment)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads((WORK / "report.json").read_text()), run

    def read(self, path):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        return reader.GetOutput()
