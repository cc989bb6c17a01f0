#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions, subdomains and sheets on the command line of the mesher.

  test_command_line_regions.py MESHER DATA_DIRECTORY WORK_DIRECTORY
"""

import json
import math
import struct
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from command_line_case import DATA, WORK, Case
from cube import CUBE, TRIANGLES, grid_box, moved, off
from sphere import sphere


class Regions(Case):
    def test_several_regions(self):
        """A light region gets fewer of the vertices, a heavy one leaves fewer to the other."""
        low, edge = (-42, -32, 18), 24
        box = self.file("box.off", off(moved(CUBE, edge, low), TRIANGLES))
        output = WORK / "regions.mesh"
        numbers, others = [], []
        for weight in ("", ":1", ":0.01", ":100"):
            told, _ = self.brain("--region", f"{box}{weight}", "--output", output, vertices=2000)
            self.assertEqual([r["weight"] for r in told["inputs"]["regions"]], [1, float(weight[1:] or 1)])
            lines = output.read_text().split("\n")
            first = lines.index("Vertices") + 2
            points = [[float(x) for x in line.split()[:3]] for line in lines[first:first + told["mesh"]["vertices"]]]
            numbers.append(sum(all(l <= x <= l + edge for l, x in zip(low, p)) for p in points))
            others.append(told["mesh"]["vertices in region"] - numbers[-1])
        self.assertEqual((numbers[0], others[0]), (numbers[1], others[1]))
        self.assertLess(2 * numbers[2], numbers[1])
        self.assertLess(1.25 * others[3], others[1])

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

    def test_layers_in_any_order(self):
        """Layers half as thick as cells are as thick as their surfaces say, whatever the order they are named in."""
        for radius in (90, 84, 76):
            (WORK / f"sphere_{radius}.off").write_text(off(*sphere(radius, 4)))
        report, told = WORK / "layers.json", []
        for order in ((90, 84, 76), (90, 76, 84), (76, 90, 84)):
            surface, *parts = (WORK / f"sphere_{radius}.off" for radius in order)
            options = [x for part in parts for x in ("--subdomain", f"{part.stem}={part}")]
            run = self.mesher(surface, *options, "--vertices", 1500, "--output", WORK / "layers.vtu", "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            told.append(json.loads(report.read_text()))
            self.assertIn("all checks hold", run.stdout)
            self.assertEqual(len(told[-1]["interfaces"]), 3)  # no layer has a hole
            self.assertTrue(all(i["manifold"] for i in told[-1]["interfaces"]))
            for s in told[-1]["subdomains"]:
                self.assertAlmostEqual(s["volume"] / s["volume of surface"], 1, delta=0.05)
        volumes = [{s["name"]: s["volume"] for s in one["subdomains"]} for one in told]
        self.assertEqual(volumes[0], volumes[1])
        self.assertEqual(volumes[0], volumes[2])

    def test_parts_that_stick_out(self):
        """The domain is the union of all surfaces; where they cross, the earlier one counts, and a warning says so."""
        surfaces = [WORK / name for name in ("ball.off", "nose.off")]
        for path, ball in zip(surfaces, (sphere(50, 3), sphere(40, 3, (45, 0, 0)))):
            path.write_text(off(*ball))
        report = WORK / "union.json"
        run = self.mesher(surfaces[0], "--subdomain", f"nose={surfaces[1]}", "--vertices", 1000, "--output", WORK / "union.vtu",
                     "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        told = json.loads(report.read_text())
        self.assertIn("the surfaces of nose and ball cross: nose has what both have inside", run.stderr)
        self.assertAlmostEqual(told["surface"]["ratio of volumes"], 1, delta=0.05)
        common = math.pi * (90 - 45) ** 2 * (45 ** 2 + 2 * 45 * 90 - 3 * 10 ** 2) / (12 * 45)  # of two balls
        union = 4 / 3 * math.pi * (50 ** 3 + 40 ** 3) - common
        self.assertAlmostEqual(told["mesh"]["volume"] / union, 1, delta=0.05)

    def test_parts_that_touch(self):
        """Where boxes touch, in whatever triangles, they have an interface; where they overlap, the earlier one counts.
        The volume of the union, and the numbers of its bodies, are exact."""
        report = WORK / "touch.json"
        whole = self.file("whole.off", off(*grid_box(2, (0, 0, 0), (10, 10, 10))))
        float32 = 10 * (1 + 2 ** -20)  # ten times the last digit of 10 as a float is 10 * 2 ** -20
        for name, n, low, high, union, bodies, area in (
                ("equal face", 2, (10, 0, 0), (20, 10, 10), 2000, 1, 100),
                ("other triangles", 3, (10, 0, 0), (20, 10, 10), 2000, 1, 100),
                ("rounded", 3, (float32, 0, 0), (20, 10, 10), 2000, 1, 100),
                ("part of a face", 3, (10, 2, 2), (16, 8, 8), 1216, 1, 36),
                ("nested with a shared face", 2, (5, 2, 2), (10, 8, 8), 1000, 1, 156),
                ("edge", 2, (10, 10, 0), (20, 20, 10), 2000, 2, None),
                ("vertex", 2, (10, 10, 10), (20, 20, 20), 2000, 2, None),
                ("equal", 3, (0, 0, 0), (10, 10, 10), 1000, 1, None),
                ("crossing", 2, (5, 5, 5), (15, 15, 15), 1875, 1, 75)):
            with self.subTest(name):
                part = self.file("part.off", off(*grid_box(n, low, high)))
                run = self.mesher(whole, "--subdomain", f"part={part}", "--vertices", 1500, "--report", report)
                self.assertEqual(run.returncode, 0, run.stderr)
                told = json.loads(report.read_text())
                self.assertAlmostEqual(told["surface"]["volume of surface"] / union, 1, delta=1e-5)
                self.assertEqual((told["topology"]["surface"]["bodies"], told["topology"]["surface"]["cavities"]), (bodies, 0))
                self.assertEqual("nothing is left of it" in run.stderr, name == "equal")
                if area is None:
                    continue
                areas = {tuple(i["between"]): i["area"] for i in told["interfaces"]}
                self.assertAlmostEqual(areas["whole", "part"] / area, 1, delta=0.1)
                for s in told["subdomains"]:
                    self.assertAlmostEqual(s["ratio of volumes"], 1, delta=0.03)
                if name in ("equal face", "other triangles", "rounded", "nested with a shared face"):
                    self.assertIn("all checks hold", run.stdout)

    def test_parts_that_touch_obliquely(self):
        """Rounding makes the faces of turned boxes uneven; where they touch, they have an interface nevertheless."""
        def turned(points):
            for angle in (0.3, 0.7):
                c, s = math.cos(angle), math.sin(angle)
                points = [(c * x - s * y, s * x + c * y, z) for x, y, z in points]
                points = [(x, c * y - s * z, s * y + c * z) for x, y, z in points]
            return points

        def file(name, n, low, high, is_float):
            points, triangles = grid_box(n, low, high)
            points = turned(points)
            if is_float:
                points = [struct.unpack("3f", struct.pack("3f", *p)) for p in points]
            return self.file(name, off(points, triangles))

        report = WORK / "oblique.json"
        for name, n, low, high, union, bodies, area in (
                ("other diagonals", 2, (10, 0, 0), (20, 10, 10), 2000, 1, 100),
                ("other triangles", 3, (10, 0, 0), (20, 10, 10), 2000, 1, 100),
                ("part of a face", 3, (10, 3, 3), (14, 7, 7), 1064, 1, 16),
                ("at the rim", 2, (10, 3, 0), (14, 7, 4), 1064, 1, 16),
                ("nested with a shared face", 2, (5, 2, 2), (10, 8, 8), 1000, 1, 156),
                ("edge", 3, (10, 10, 0), (20, 20, 10), 2000, 2, None)):
            for is_float in (False, True):
                with self.subTest(name, is_float=is_float):
                    whole = file("whole.off", 2, (0, 0, 0), (10, 10, 10), is_float)
                    part = file("part.off", n, low, high, is_float)
                    run = self.mesher(whole, "--subdomain", f"part={part}", "--vertices", 1500, "--report", report)
                    self.assertEqual(run.returncode, 0, run.stderr)
                    told = json.loads(report.read_text())
                    self.assertAlmostEqual(told["surface"]["volume of surface"] / union, 1, delta=1e-6)
                    surface = told["topology"]["surface"]
                    self.assertEqual((surface["bodies"], surface["cavities"], surface["handles"]), (bodies, 0, 0))
                    for s in told["subdomains"]:
                        self.assertAlmostEqual(s["ratio of volumes"], 1, delta=0.05)
                    if area is not None:
                        areas = {tuple(i["between"]): i["area"] for i in told["interfaces"]}
                        self.assertAlmostEqual(areas["whole", "part"] / area, 1, delta=0.1)

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

    def test_wrong_extract(self):
        """Names are refused before the surfaces are read, or, of each label, before there is a mesh."""
        tumor = f"tumor={DATA / 'tumour.off'}"
        brain = (DATA / "brain.off", "--vertices", 500, "--output", self.output)
        for names in ("tumour", "tumor,", "tumor,skull", "outside", ""):
            run = self.fails(*brain, "--subdomain", tumor, "--extract", names, status=2, names="--extract",
                             words="there is no subdomain of that name, but tumor, brain; see")
        self.assertNotIn("tumor:", run.stderr)
        self.fails(*brain, "--extract", "brain", status=2, names="--extract: needs --subdomain, or --labels with names")
        self.fails(*brain, "--cavity", DATA / "tumour.off", "--extract", "cavity", status=2, names="--extract: needs")
        self.fails(*brain, "--merge", "a=b+c", status=2, names="--merge: needs --labels with names")

    def test_extract_of_a_lost_subdomain(self):
        """What the cells are too coarse for is told after meshing, and nothing is written."""
        speck = self.file("speck.off", off(moved(CUBE, 1e-3, (10, 20, 30)), TRIANGLES))
        arguments = (DATA / "brain.off", "--subdomain", speck, "--vertices", 300, "--no-fit", "--quiet", "--output",
                     self.output, "--extract")
        self.fails(*arguments, "brain,speck", names="--extract speck: the mesh has no element of this subdomain")
        run = self.mesher(*arguments, "brain")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_extract_with_sheet(self):
        """Each part has the faces of the sheet that are in it, slit or not."""
        outer, inner = self.file("outer.off", off(moved(CUBE, 40, (0, 0, 0)), TRIANGLES)), WORK / "inner.off"
        inner.write_text(off(moved(CUBE, 20, (10, 10, 10)), TRIANGLES))
        wall = self.file("wall.off", "OFF\n4 2 0\n-5 -5 20\n45 -5 20\n45 45 20\n-5 45 20\n3 0 1 2\n3 0 2 3\n")
        report, faces = WORK / "sheet.json", {}
        for names in ("outer,inner", "outer", "inner"):
            for slit in ((), ("--slit",)):
                path = WORK / "sheet.feb"
                run = self.mesher(outer, "--subdomain", inner, "--sheet", wall, *slit, "--vertices", 800, "--extract",
                                  names, "--output", path, "--report", report)
                self.assertEqual(run.returncode, 0, run.stderr)
                sets = {s.get("name"): len(s) for s in ElementTree.parse(path).getroot().iter("Surface")}
                told = json.loads(report.read_text())
                sheet = told["sheets"][0]
                faces[names, slit] = [sets[name] for name in (("wall_front", "wall_behind") if slit else ("wall",))]
                self.assertEqual(told["sheets"][0]["faces"], sheet["faces"])  # it is described on the whole mesh
        for slit, number in (((), 1), (("--slit",), 2)):
            self.assertEqual(faces["outer,inner", slit], [sheet["faces"]] * number)
            self.assertEqual([sum(parts) for parts in zip(faces["outer", slit], faces["inner", slit])],
                             [sheet["faces"]] * number)
            self.assertEqual(len(set(faces["inner", slit])), 1)

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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
