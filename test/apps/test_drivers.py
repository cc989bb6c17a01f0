#!/usr/bin/env python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""One input has one mesh, and one status: by the program, by Python, and by a program that calls make_mixed_mesh_3().

  test_drivers.py BUILD SOURCE MESH_SURFACE FOLDER        BUILD holds bin/ and python/

The surfaces are those of benchmark/Mixed_mesh_3/Fidelity that take least time: thin walls, narrow gaps, knots, several
bodies, and shapes that are lost with so few vertices.
"""

import importlib.util
import json
import pathlib
import subprocess
import sys
import unittest
import warnings

BUILD, SOURCE, MESH_SURFACE, FOLDER = (pathlib.Path(a).resolve() for a in sys.argv[1:5])
if not importlib.util.find_spec("numpy"):
    print("skipped: there is no numpy")
    sys.exit(77)
if not list((BUILD / "python" / "mixed_mesh_3").glob("_core*")):
    print("skipped: the module was not built, see MIXED_MESH_3_BUILD_PYTHON")
    sys.exit(77)
sys.path.insert(0, str(BUILD / "python"))
import mixed_mesh_3 as mm3  # noqa: E402

VERTICES = 200
NAMES = """
    balls_apart_0.1 block_drilled_0.1 block_drilled_0.2 blocks_apart_0.05 box_open_0.04 c_ring_0.04 c_ring_0.08
    comb_0.08 cross_of_plates_0.08 cube_12_tunnels cube_3_narrow_tunnels cube_3_tunnels fork_two_prongs gear_12
    gear_24_hole gear_40_thin hair_on_ball_0.06 horseshoe_tips plate_0.05 plate_0.1 plate_0.2 plate_25_holes
    plate_64_holes plate_9_holes plate_turned_0.02 plate_turned_0.2 pretzel rolled_sheet shell_closed_0.05
    shell_closed_0.1 shell_open_0.05 speck_beside_ball stairs_thin star_sharp torus_narrow_hole_0.05
    torus_narrow_hole_0.1 torus_narrow_hole_0.2 void_flat voids_8 wedge_to_nothing
""".split()
NO_MESH = "none"


def write_surfaces():
    path = SOURCE / "benchmark" / "Mixed_mesh_3" / "Fidelity" / "make_surfaces.py"
    spec = importlib.util.spec_from_file_location("make_surfaces", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name in NAMES:
        points, triangles = module.SURFACES[name][0]()
        module.write_off(FOLDER / f"{name}.off", points, triangles)


def by_program(name):
    """The status, and the file of the mesh if there is one."""
    mesh, report = FOLDER / f"{name}_program.vtu", FOLDER / f"{name}.json"
    run = subprocess.run([BUILD / "bin" / "mixed_mesh_3", FOLDER / f"{name}.off", "--vertices", str(VERTICES), "--quiet",
                          "--output", mesh, "--report", report], capture_output=True, text=True)
    return json.loads(report.read_text())["status"] if run.returncode == 0 else NO_MESH, mesh, run.stderr


def by_python(name):
    try:
        mesh, report = mm3.mesh(*mm3.read_surface(FOLDER / f"{name}.off"), vertices=VERTICES)
    except mm3.MeshingError as error:
        return NO_MESH, None, str(error)
    path = FOLDER / f"{name}_python.vtu"
    mesh.save(path)
    return report["status"], path, ""


class Drivers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        FOLDER.mkdir(parents=True, exist_ok=True)
        for old in FOLDER.iterdir():
            old.unlink()
        write_surfaces()
        run = subprocess.run([MESH_SURFACE, str(VERTICES), FOLDER, *(FOLDER / f"{name}.off" for name in NAMES)],
                             check=True, capture_output=True, text=True)
        cls.by_library = dict(line.split(": ") for line in run.stdout.splitlines())

    def test_same(self):
        statuses = []
        for name in NAMES:
            with self.subTest(name):
                status, mesh, words = by_program(name)
                python_status, python_mesh, error = by_python(name)
                statuses.append(status)
                self.assertEqual(python_status, status)
                if status == NO_MESH:
                    # The reasons are the same, with the names of files and options.
                    self.assertIn(error.partition(": ")[2].replace("base_level", "--base-level")
                                  .replace("tolerance", "--tolerance"), words)
                    continue
                self.assertEqual(self.by_library[name], status)
                self.assertEqual(python_mesh.read_bytes(), mesh.read_bytes())
                self.assertEqual((FOLDER / f"{name}.vtu").read_bytes(), mesh.read_bytes())
        self.assertGreater(len(set(statuses)), 2)
        self.assertIn("success", statuses)


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main(argv=sys.argv[:1])
