#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of the command-line mesher, and what it reports on them.

  test_command_line_meshes.py MESHER DATA_DIRECTORY WORK_DIRECTORY
"""

import json
import re
import sys
import unittest

from command_line_case import DATA, WORK, Case
from cube import CUBE, TRIANGLES, moved, off, shifted


class Meshes(Case):
    def test_all_outputs_and_report(self):
        outputs = [WORK / ("brain" + e) for e in (".vtu", ".msh", ".mesh", ".inp", ".feb", ".msh2")]
        told, run = self.brain(*(x for path in outputs for x in ("--output", path)))
        self.assertEqual(run.stderr, "")
        for words in ("vertices of 660", "ARC mean", "Hausdorff distance", " % of the surface's volume\n",
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

    def test_order(self):
        """With --order 2 files have a node in the middle of each edge, or one line says why not."""
        outputs = [WORK / ("quadratic" + e) for e in (".vtu", ".msh", ".feb", ".inp", ".msh2")]
        told, run = self.brain("--order", 2, "--tetrahedra", *(x for path in outputs for x in ("--output", path)))
        self.assertEqual(run.stderr, "")
        self.assertEqual(told["options"]["order"], 2)
        text = (WORK / "quadratic.msh2").read_text().split()
        nodes = int(text[text.index("$Nodes") + 1])
        # Euler: of a ball, vertices - edges + faces - tetrahedra = 1; each tetrahedron has 4 faces, shared by two.
        tetrahedra, boundary = told["mesh"]["tetrahedra"], (WORK / "quadratic.feb").read_text().count("<tri6 ")
        edges = told["mesh"]["vertices"] + (4 * tetrahedra + boundary) // 2 - tetrahedra - 1
        self.assertEqual(nodes, told["mesh"]["vertices"] + edges)
        self.assertEqual(nodes, told["mesh"]["nodes"])
        self.assertIn(f"{told['mesh']['vertices']} vertices of 660, {nodes} nodes of order 2, ", run.stdout)
        self.assertIn("TYPE=C3D10,", (WORK / "quadratic.inp").read_text())

        def refused(*words):
            run = self.mesher(DATA / "brain.off", "--region", DATA / "region.off", "--vertices", 660, "--no-simplification", *words)
            return run.returncode, run.stderr.strip().split("\n")[-1]

        for name, words in (("a.mesh", "elements of order 2 can be written to .vtu, .msh, .msh2, .inp and .feb only"),
                            ("a.inp", "Abaqus has no pyramids of order 2: split the mesh to tetrahedra, or write")):
            status, line = refused("--order", 2, "--output", WORK / name, "--output", WORK / "b.vtu")
            self.assertEqual(status, 1)
            self.assertIn(name + ": " + words, line)
            self.assertFalse((WORK / name).exists() or (WORK / "b.vtu").exists())
        for order in (0, 3, "two"):
            status, line = refused("--order", order)
            self.assertEqual(status, 2)
            self.assertIn("--order", line)

    def test_nodes(self):
        """A budget in nodes is nearly filled and never exceeded; with order 1 it is that in vertices."""
        def nodes(*words):
            report = WORK / "nodes.json"
            run = self.mesher(DATA / "brain.off", *words, "--output", self.output, "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            return json.loads(report.read_text()), run.stdout

        region = "--region", DATA / "region.off"
        for budget, words in ((2000, region), (3000, ()), (3000, (*region, "--tetrahedra"))):
            told, said = nodes("--nodes", budget, "--order", 2, *words)
            number = int(re.search(r'NumberOfPoints="(\d+)"', self.output.read_bytes().decode("latin-1"))[1])
            self.assertEqual(told["mesh"]["nodes"], number)
            self.assertTrue(0.95 * budget <= number <= budget, number)
            self.assertEqual(told["mesh"]["share of budget"], number / budget)
            self.assertEqual(told["options"]["nodes"], budget)
            self.assertIn(f"{number} nodes of {budget}, {told['mesh']['vertices']} vertices, ", said)
        nodes("--nodes", 300)
        expected = self.output.read_bytes()
        nodes("--vertices", 300)
        self.assertEqual(self.output.read_bytes(), expected)
        for budget in (1, 20):
            self.fails(DATA / "brain.off", "--nodes", budget, *region, "--order", 2, names=f"--nodes {budget}",
                       words="too small")
        for words in (("--nodes", 0), ("--nodes", "many"), ("--nodes", 300, "--vertices", 300)):
            self.fails(DATA / "brain.off", *words, names="--nodes", status=2)

    def test_topology(self):
        """Two cubes with a gap narrower than cells: the mesh of an octree joins them, one that is cut does not."""
        report = WORK / "report.json"
        cases = ((300, ("--base-level", 3), 0.0001, 1), (300, ("--base-level", 3), 0.3, 1),
                 (2500, ("--base-level", 4), 0.3, 2), (300, (), 0.03, 2), (300, (), 0.3, 2))
        for vertices, options, gap, bodies in cases:
            two = CUBE + moved(CUBE, 1, (1 + gap, 0, 0))
            two[0] = (0, 0, -1e-8)  # else boxes between the planes of the surface would do
            cubes = self.file("gap.off", off(two, TRIANGLES + shifted(TRIANGLES, 8)))
            run = self.mesher(cubes, "--vertices", vertices, *options, "--output", self.output, "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            told = json.loads(report.read_text())
            topology = told["topology"]
            self.assertAlmostEqual(topology["surface"].pop("volume"), 2)
            self.assertEqual(topology["surface"], {"bodies": 2, "handles": 0, "cavities": 0})
            self.assertEqual(topology["mesh"]["bodies"], bodies)
            self.assertEqual(topology["same topology"], bodies == 2)
            if bodies == 1:
                self.assertEqual(told["status"], "other bodies, holes or cavities")
                self.assertRegex(run.stderr, rf"warning: .*gap.off: 2 bodies are joined near \({1 + gap / 2:g}, ")
                self.assertRegex(topology["differences"][0]["text"], "^2 bodies are joined near ")
                self.assertAlmostEqual(topology["differences"][0]["at"][0], 1 + gap / 2)
            else:
                self.assertEqual(told["status"], "success")
                self.assertNotIn("joined", run.stderr)

    def test_volume(self):
        """Success and a volume beyond 5 % exclude each other, and an absurd volume is refused."""
        told, run = self.brain(vertices=60)
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
                   words="times the surface's volume: it is too coarse for the domain")
        self.assertFalse(self.output.exists())

    def test_quality_bound(self):
        # thin plates; the thinner ones have room for flatter elements only
        report = WORK / "report.json"
        bounds = ((), 3.2), (("--max-arc", 4), 4), (("--max-arc", "none"), None)
        for thickness, vertices, (bound, largest) in ((0.05, 2000, bounds[0]), *((0.02, 1500, b) for b in bounds)):
            points = [(x, y, 0.3 * i + thickness * z) for i in range(4) for x, y, z in CUBE]
            points[0] = (0, 0, -1e-6)  # else boxes between the planes of the surface would do
            plates = self.file("plates.off", off(points, [f for i in range(4) for f in shifted(TRIANGLES, 8 * i)]))
            run = self.mesher(plates, "--vertices", vertices, "--output", self.output, "--report", report, *bound)
            self.assertEqual(run.returncode, 0, run.stderr)
            told = json.loads(report.read_text())
            quality = told["quality"]
            self.assertEqual(told["options"]["max ARC"], largest)
            is_flatter = thickness == 0.02 and largest == 3.2
            self.assertEqual(told["status"], "success")
            self.assertEqual(told["fitting"]["arrived"], told["fitting"]["boundary vertices"])
            if largest is None:
                self.assertNotIn("quality bound", quality)
                continue
            proof = quality["quality bound"]
            self.assertEqual((proof["ARC"], proof["elements above"] > 0), (largest, is_flatter))
            self.assertEqual("elements are above it" in run.stderr, is_flatter)
            self.assertLessEqual(quality["after"]["all"]["ARC max"], proof["ARC in force"])
            if is_flatter:
                continue
            smallest_angle, largest_angle = proof["dihedral angles of tetrahedra within it"]
            self.assertGreaterEqual(quality["smallest dihedral angle"]["tetrahedra"]["min"], smallest_angle)
            self.assertLessEqual(quality["largest dihedral angle"]["tetrahedra"]["max"], largest_angle)
        for bad in "0.5", "-1", "nan", "much", "3.2,lax", ",strict":
            self.assertEqual(self.mesher(plates, "--vertices", 2000, "--max-arc", bad).returncode, 2)
        self.assertEqual(self.mesher(plates, "--vertices", 2000, "--max-arc", 4, "--no-fit").returncode, 2)
        run = self.mesher(plates, "--vertices", 2000, "--max-arc", "4,strict", "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        told = json.loads(report.read_text())
        self.assertEqual((told["options"]["max ARC"], told["options"]["max ARC is strict"]), (4, True))
        proof = told["quality"]["quality bound"]
        self.assertEqual((proof["ARC in force"], proof["elements above"]), (4, 0))
        # with a bound that no mesh can have, what is above it is told
        told, run = self.brain("--max-arc", 1.1)
        self.assertGreater(told["quality"]["quality bound"]["elements above"], 100)
        self.assertIn("elements are above it", run.stderr)

    def test_fewest_vertices(self):
        cube = self.file("cube.off", off(CUBE, TRIANGLES))
        self.fails(cube, "--vertices", "auto", "--output", self.output, names="--vertices auto", status=2,
                   words="needs a --tolerance")
        told, run = self.brain("--tolerance", 8, vertices="auto")
        self.assertEqual(told["status"], "success")
        self.assertTrue(told["options"]["fewest vertices"])
        self.assertLess(told["options"]["vertices"], 660)
        self.assertLessEqual(told["mesh"]["vertices"], told["options"]["vertices"])
        self.assertLessEqual(told["surface"]["Hausdorff distance"]["distance"], 8)
        self.assertIn("the smallest budget found that suffices", run.stdout)

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
        told, run = self.brain("--tolerance", 8, "--no-simplification") # the octree has to serve it
        self.assertEqual((told["status"], run.stderr), ("success", ""))
        self.assertTrue(0 < told["tolerance"]["vertices of the mesh as coarse as it allows"] <= 660)
        told, run = self.brain("--tolerance", 1, vertices=300)
        self.assertEqual(told["status"], "tolerance not reached")
        self.assertFalse(told["tolerance"]["reached"])
        self.assertRegex(run.stderr, r"(?m)^warning: --tolerance 1: not reached, .*\(.*, .*, .*\) is .* away from .*")
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
        octree, _ = self.brain("--grading", 2, "--no-simplification")
        self.assertGreater(told[0]["mesh"]["vertices in region"], octree["mesh"]["vertices in region"])
        self.assertGreater(told[2]["mesh"]["vertices in region"], octree["mesh"]["vertices in region"])
        self.assertEqual(octree["octree"]["vertices collapsed"], 0)
        self.assertGreater(told[2]["octree"]["vertices collapsed"], 0)

    def test_modes(self):
        for arguments in (["--mode", "paper"], ["--root", "box"], ["--templates", "centered"], ["--no-fit"],
                          ["--tetrahedra"], ["--base-level", "2"], ["--msh2"]):
            with self.subTest(arguments):
                run = self.mesher(DATA / "brain.off", "--region", DATA / "region.off", "--vertices", 1000,
                                  *arguments, "--output", WORK / "mesh.msh")
                # a tolerance that a mode misses is no failure of the mode
                told = [line for line in run.stderr.splitlines() if not line.startswith("warning: default tolerance")]
                self.assertEqual((run.returncode, told), (0, []))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
