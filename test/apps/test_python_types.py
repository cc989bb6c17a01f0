#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The type stubs of the Python package: names, parameters and defaults are those of the package, and calls have types.

  test_python_types.py BUILD FOLDER        BUILD holds python/
"""

import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

if not all(map(importlib.util.find_spec, ("mypy", "numpy"))):
    print("skipped: there is no mypy, or no numpy")
    sys.exit(77)
BUILD, FOLDER = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
if not list((BUILD / "python" / "mixed_mesh_3").glob("_core*")):
    print("skipped: the module was not built, see MIXED_MESH_3_BUILD_PYTHON")
    sys.exit(77)

# A line that ends in "# wrong" has a type that the package refuses.
CALLS = """
import mixed_mesh_3 as mm3
import numpy as np
data = mm3.example_data()
mesh, report = mm3.mesh(*data["brain"], region=data["region"], vertices="auto", tolerance=5)
mesh, report = mm3.mesh(*data["brain"], region=[((0, 0, 0), 20.0), ((0, 0, 0), 20.0, 2.0)], vertices=660, threads=1)
mesh, report = mm3.mesh(*data["brain"], subdomains={"tumor": data["tumor"]}, cavities=[data["tumor"]], time_limit=2.5)
mesh, report = mm3.mesh(*data["brain"], vertices="many")  # wrong
mesh, report = mm3.mesh(*data["brain"], vertices=None)  # wrong
mesh, report = mm3.mesh(*data["brain"], vertexes=660)  # wrong
mesh = mm3.Mesh(np.zeros((4, 3)), [[0, 1, 2, 3]], labels=[2])
mesh = mm3.Mesh(np.zeros((4, 3)), {"tetra": [[0, 1, 2, 3]]})
mesh = mm3.Mesh(np.zeros((4, 3)), [0], [0, 1, 2, 3], [2])
mesh = mm3.Mesh(np.zeros((4, 3)))  # wrong
mesh.names = {2: "tumor"}
mesh.points = np.zeros((4, 3))  # wrong
mesh.save("mesh.vtu", point_data={"u": np.zeros((4, 3))}, order=2)
mesh.save("mesh.vtu", point_data=[1, 2])  # wrong
mesh = mm3.read_mesh("mesh.vtu")
model = mm3.Elasticity(mesh, materials={"tumor": (3, 0.45)})
model.fix([0, 1, 2])
model.touch(mm3.boundary_vertices(mesh), 0.5)
opening = mesh.patch(sphere=((0, 0, 0), 20.0))
model.fix(mesh.patch(plane=(np.zeros(3), (0, 0, 1))).vertices)
mesh.save("mesh.inp", patches={"opening": opening, "skull": mesh.patch(surface=data["tumor"]).faces, "some": [True, False]})
mm3.boundary_faces(mesh)[opening.faces].shape
mesh.patch(sphere=(0, 0, 0))  # wrong
mesh.patch(cone=((0, 0, 0), 20.0))  # wrong
mesh.save("mesh.inp", patches=[opening])  # wrong
mesh.save("mesh.inp", interfaces=False)
opening.elements  # wrong
model.solve().shape
count: str = mesh.labels  # wrong
"""


class Test(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)

    def run_mypy(self, module, *arguments):
        environment = {**os.environ, "MYPYPATH": str(BUILD / "python"), "PYTHONPATH": str(BUILD / "python")}
        return subprocess.run([sys.executable, "-m", module, *arguments], capture_output=True, text=True, cwd=FOLDER,
                              env=environment)

    def test_stubs_are_those_of_the_package(self):
        # Classes of the module have a metaclass of pybind11; their members are compared.
        (FOLDER / "allowed").write_text("mixed_mesh_3.Mesh\nmixed_mesh_3.Elasticity\n", encoding="utf-8")
        run = self.run_mypy("mypy.stubtest", "mixed_mesh_3", "--ignore-missing-stub", "--concise", "--allowlist", "allowed")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_calls(self):
        (FOLDER / "calls.py").write_text(CALLS.lstrip(), encoding="utf-8")
        run = self.run_mypy("mypy", "--strict", "calls.py")
        found = {int(line) for line in re.findall(r"^calls.py:(\d+): error", run.stdout, re.MULTILINE)}
        wrong = {i for i, line in enumerate(CALLS.lstrip().splitlines(), 1) if line.endswith("# wrong")}
        self.assertEqual(found, wrong, run.stdout + run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
