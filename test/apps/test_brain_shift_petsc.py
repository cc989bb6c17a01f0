#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""brain_shift --solver petsc: alone, in two processes, and where there is no PETSc.

  test_brain_shift_petsc.py MIXED_MESH_3 BRAIN_SHIFT DATA WORK
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

MESHER, PROGRAM, DATA, WORK = map(pathlib.Path, sys.argv[1:5])
TWO_PROCESSES = ["mpirun", "--oversubscribe", *(["--allow-run-as-root"] if os.getuid() == 0 else []), "-n", "2"]

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

HAS_PETSC = PROGRAM.with_name("brain_shift_petsc").exists()


def displacements(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput().GetPointData()
    return [vtk_to_numpy(data.GetArray(name)).copy() for name in ("displacement", "displacement_before_resection")]


def errors_in(run):
    return [line for line in run.stderr.splitlines() if line.startswith("brain_shift: ")]


class BrainShiftWithPetsc(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.mesh = WORK / "brain.vtu"
        subprocess.run([MESHER, DATA / "brain.off", "--region", DATA / "region.off", "--vertices", "660", "--quiet",
                        "--output", cls.mesh], check=True)

    def shift(self, *arguments, mesh=None, processes=(), program=PROGRAM):
        command = [*processes, program, mesh or self.mesh, "--control-points", DATA / "control_points.csv", "--tumor",
                   DATA / "tumour.off", "--control-radius", "8", *arguments]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=120)

    @unittest.skipUnless(HAS_PETSC, "there is no PETSc")
    def test_same_as_direct(self):
        expected, ways = WORK / "direct.vtu", {"one": []}
        # PETSc has order 1 only.
        self.assertEqual(self.shift("--order", "1", "--output", expected).returncode, 0)
        if shutil.which("mpirun"):
            ways["two"] = TWO_PROCESSES
        else:
            print("SKIPPED: there is no mpirun: two processes are not tested", file=sys.stderr)
        for name, processes in ways.items():
            with self.subTest(name):
                output, report = WORK / f"{name}.vtu", WORK / f"{name}.json"
                run = self.shift("--solver", "petsc", "--output", output, "--report", report, processes=processes)
                self.assertEqual(run.returncode, 0, run.stderr)
                # After the resection both iterate, with preconditioners of different precision.
                for a, b, bound in zip(displacements(expected), displacements(output), (1e-5, 1e-7)):
                    self.assertGreater(abs(a).max(), 5)
                    self.assertLess(abs(a - b).max(), bound * abs(a).max())
                solver = json.loads(report.read_text())["solver"]
                self.assertEqual(solver["processes"], 2 if processes else 1)
                self.assertGreater(solver["largest number of iterations"], 1)
                self.assertEqual(run.stdout.count("PETSc: "), 1, run.stdout) # one process prints
                self.assertEqual(run.stdout.count("wrote "), 2, run.stdout)

    @unittest.skipUnless(HAS_PETSC, "there is no PETSc")
    def test_errors_end_all_processes(self):
        ways = [[], TWO_PROCESSES] if shutil.which("mpirun") else [[]]
        for processes in ways:
            for arguments, mesh, words in ((["--solver", "petsc"], WORK / "none.vtu", "none.vtu"),
                                           (["--solver=petsc", "--output", "no.xyz"], None, "no.xyz"),
                                           (["--solver", "petsc", "--poisson-ratio", "0.7"], None, "0.7"),
                                           # found between factor and solution, with the others waiting
                                           (["--solver", "petsc", "--max-distance", "0"], None, "points.csv: line 4: ")):
                with self.subTest(processes=processes, arguments=arguments):
                    run = self.shift(*arguments, mesh=mesh, processes=processes)
                    self.assertNotEqual(run.returncode, 0)
                    self.assertEqual(len(errors_in(run)), 1, run.stderr)
                    self.assertIn(words, errors_in(run)[0])
                    self.assertEqual(run.stdout, "")

    def test_without_petsc(self):
        alone = WORK / "alone" / "brain_shift"
        alone.parent.mkdir()
        shutil.copy(PROGRAM, alone)
        run = self.shift("--solver", "petsc", "--output", WORK / "no.vtu", program=alone)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertEqual(run.stderr, "brain_shift: error: --solver: this program was built without PETSc; see --help\n")
        self.assertFalse((WORK / "no.vtu").exists())
        self.assertEqual(self.shift("--solver", "direct", program=alone).returncode, 0)
        self.assertEqual(self.shift("--solver", "mumps", program=alone).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
