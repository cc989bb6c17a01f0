#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What holds and moves the brain in brain_shift: control points, weight, patches, contact.

  test_brain_shift_supports.py MESH BRAIN_SHIFT DATA_DIRECTORY WORK_DIRECTORY
"""

import sys
import unittest
import xml.etree.ElementTree as ElementTree

from brain_shift_case import HEADER, ROWS, VALUES, WORK, Case, cube_off
from cube import TRIANGLES

import nibabel
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


class Supports(Case):
    def test_rigid_motion_is_exact(self):
        # All control points move alike, nothing is fixed: everything follows.
        points = self.file("translation.csv", HEADER + "".join(
            ",".join(map(str, (*p[:3], 3, -6, 1.5))) + "\n" for p in VALUES))
        told, run = self.succeeds(self.mesh, "--control-points", points, "--fixed-below", 0, "--image", self.image,
                                  "--output-image", WORK / "rigid", "--output", WORK / "rigid.vtu")
        self.assertEqual(run.stderr, "")
        self.assertEqual(told["supports"]["fixed"], 0)
        self.assertIsNone(told["resection"])
        u = vtk_to_numpy(self.read(WORK / "rigid.vtu").GetPointData().GetArray("displacement"))
        self.assertTrue(np.allclose(u, [3, -6, 1.5], atol=1e-8))
        self.assertLess(abs(told["shift"]["energy"]), 1e-8)
        self.assertTrue(np.allclose([p["force"] for p in told["shift"]["control points"]], 0, atol=1e-6))
        mask = np.asarray(nibabel.load(WORK / "rigid_mask.nii.gz").dataobj)
        values = nibabel.load(WORK / "rigid.nii.gz").get_fdata()
        difference = (values - self.values)[mask == 1]
        self.assertTrue(np.allclose(difference, -np.dot(self.gradient, [3, -6, 1.5]), atol=1e-3))

    def test_finite_rotation_is_exact(self):
        # All control points turn by 40 degrees, nothing is fixed: everything turns, and nothing is strained.
        axis, angle, center = np.array([1, 2, -1]) / np.sqrt(6), np.radians(40), np.array([10, -10, 20.])
        skew = np.cross(np.eye(3), -axis)
        turn = np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew
        spread = np.vstack([VALUES[:, :3], [[0, -60, 20], [-30, 0, 30]]])
        points = self.file("rotation.csv", HEADER + "".join(
            ",".join(map(str, (*p, *(turn @ (p - center))))) + "\n" for p in spread))
        arguments = [self.mesh, "--control-points", points, "--fixed-below", 0, "--max-distance", 40, "--output",
                     WORK / "turned.vtu"]
        told, run = self.succeeds(*arguments, "--corotational")
        self.assertEqual(run.stderr, "")
        self.assertEqual(told["parameters"]["rotations"], "finite (corotational elements)")
        self.assertLess(told["shift"]["residuals"][-1], 1e-3)
        self.assertGreater(told["shift"]["iterations"], 0)
        self.assertEqual(told["shift"]["inverted elements"], 0)
        small, _ = self.succeeds(*arguments)
        self.assertEqual(small["parameters"]["rotations"], "small")
        self.assertNotIn("residuals", small["shift"])
        self.assertLess(told["shift"]["energy"], 1e-3 * small["shift"]["energy"])

    def test_free_rigid_motion(self):
        self.fails_with(HEADER + ROWS[0] + "\n", "--fixed-below", 0, names=self.mesh,
                        words="leave 3 rigid motions free, among them rotation about the axis through")
        self.fails_with(HEADER + "\n".join(ROWS[:2]) + "\n", "--fixed-below", 0, names=self.mesh,
                        words="1 rigid motion free: rotation about the axis through")

    def test_supports_and_loads(self):
        base, _ = self.succeeds(self.mesh, "--control-points", self.points)
        at = lambda told: told["shift"]["largest displacement"]
        stiff, _ = self.succeeds(self.mesh, "--control-points", self.points, "--young-modulus", 3)
        self.assertAlmostEqual(at(stiff), at(base), 8)
        forces = [np.array([p["force"] for p in told["shift"]["control points"]]) for told in (base, stiff)]
        self.assertTrue(np.allclose(3 * forces[0], forces[1]))
        told, _ = self.succeeds(self.mesh, "--control-points", self.points, "--slide-beyond", 40)
        self.assertGreater(told["supports"]["sliding"], 0)
        self.assertEqual(told["supports"]["fixed"], base["supports"]["fixed"])
        below, _ = self.succeeds(self.mesh, "--control-points", self.points, "--slide-below", 0.6)
        self.assertTrue(0 < below["supports"]["sliding"] < below["supports"]["boundary vertices"])
        upside_down, _ = self.succeeds(self.mesh, "--control-points", self.points, "--up", "-z", "--fixed-below", 0.05)
        self.assertEqual(upside_down["parameters"]["up"]["value"], [0, 0, -1])
        self.assertNotEqual(upside_down["supports"], base["supports"])
        heavy, _ = self.succeeds(self.mesh, "--control-points", self.points, "--gravity", "0,0,-981")
        self.assertNotEqual(heavy["shift"]["energy"], base["shift"]["energy"])
        self.assertAlmostEqual(heavy["shift"]["control points missed by at most"], 0, 6)
        soft, _ = self.succeeds(self.mesh, "--control-points", self.points, "--control-compliance", 0.02)
        misses = [p["missed by"] for p in soft["shift"]["control points"]]
        expected = [0.02 * np.linalg.norm(p["force"]) for p in soft["shift"]["control points"]]
        self.assertTrue(np.allclose(misses, expected) and max(misses) > 0.01)
        # spread over the boundary, the points move more of it
        spread, run = self.succeeds(self.mesh, "--control-points", self.points, "--control-radius", 8)
        self.assertEqual(spread["shift"]["inverted elements"], 0)
        self.assertGreater(spread["shift"]["energy"], base["shift"]["energy"])
        self.assertEqual(run.stderr, "")
        self.assertIn(f"shift: up to {spread['shift']['largest displacement']:.3g} mm at (", run.stdout)
        self.assertIn(f", more than the {np.linalg.norm(VALUES[:, 3:], axis=1).max():.3g} mm measured: the mean within "
                      "8 mm of a control point is prescribed", run.stdout)
        other, _ = self.succeeds(self.mesh, "--control-points", self.points, "--poisson-ratio", 0.3)
        self.assertNotEqual(at(other), at(base))

    def volume_below(self, level):
        """Of the mesh below a height, by VTK."""
        plane = vtk.vtkPlane()
        plane.SetOrigin(0, 0, level)
        plane.SetNormal(0, 0, -1)
        clip = vtk.vtkTableBasedClipDataSet()
        clip.SetInputData(self.read(self.mesh))
        clip.SetClipFunction(plane)
        sizes = vtk.vtkCellSizeFilter()
        sizes.SetInputConnection(clip.GetOutputPort())
        sizes.Update()
        return np.abs(vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))).sum()

    def test_weight_in_a_fluid(self):
        still = self.file("still.csv", HEADER + "".join(",".join(map(str, (*p[:3], 0, 0, 0))) + "\n" for p in VALUES))
        at = lambda told: told["shift"]["largest displacement"]
        run = lambda *more: self.succeeds(self.mesh, "--control-points", still, "--gravity", "0,0,-9810", *more)[0]
        dry = run("--density", 1, "--fluid-density", 0)
        wet = run()  # brain in cerebrospinal fluid
        self.assertAlmostEqual(at(wet) / at(dry), 0.04, 9)
        self.assertAlmostEqual(at(run("--fluid-level", -1000)) / at(dry), 1.04, 9)
        self.assertAlmostEqual(at(run("--fluid-level", 1000)), at(wet), 9)
        self.assertLess(at(run("--density", 1)), 1e-9)
        drained = run("--fluid-level", 20)
        self.assertTrue(at(wet) < at(drained) < 1.04 * at(dry))
        self.assertEqual(drained["parameters"]["level of the fluid"], {"value": 20, "unit": "mm"})
        self.assertEqual(wet["parameters"]["level of the fluid"], {"value": None, "unit": "mm"})
        self.assertEqual(wet["parameters"]["density"], {"value": 1.04, "unit": "g/cm^3"})
        # Control points alone bear the weight that is left.
        for level in (-20, 20, 45.5):
            told = run("--fluid-level", level, "--fixed-below", 0)
            force = np.sum([p["force"] for p in told["shift"]["control points"]], axis=0)
            below = self.volume_below(level)
            self.assertTrue(0.01 < below / told["inputs"]["mesh"]["volume"] < 0.99)
            wanted = 9810e-6 * (1.04 * told["inputs"]["mesh"]["volume"] - below)
            self.assertTrue(np.allclose(force / wanted, [0, 0, 1], atol=2e-3), (level, force, wanted))

    def surfaces_of(self, path):
        """Of a model of FEBio: the faces of each surface, positions and displacements of nodes, from 0."""
        root = ElementTree.parse(path).getroot()
        vector = lambda node: [float(x) for x in node.text.split(",")]
        surfaces = {s.get("name"): [[int(v) - 1 for v in face.text.split(",")] for face in s]
                    for s in root.findall("Mesh/Surface")}
        data = {d.get("name"): np.array([vector(n) for n in d]) for d in root.findall("MeshData/NodeData")}
        return surfaces, np.array([vector(n) for n in root.find("Mesh/Nodes")]), data

    def test_patches(self):
        """The opening is free, the skull holds the rest, the base is fixed: in the solution, and as facet sets."""
        width, middle = 60, VALUES[:, :3].mean(0)
        opening = self.file("opening.off", cube_off(middle, width))
        outputs = [x for name in ("patches.feb", "patches.msh", "patches.vtu") for x in ("--output", WORK / name)]
        outputs += [x for name in ("left.feb", "left.inp", "left.msh", "left.mesh", "left.msh2")
                    for x in ("--output-deformed", WORK / name)]
        told, _ = self.succeeds(self.mesh, "--control-points", self.points, "--opening", opening, "--slide", "skull",
                                "--fixed", "base", "--tumor", self.tumor, *outputs)
        surfaces, points, data = self.surfaces_of(WORK / "patches.feb")
        self.assertEqual(sorted(surfaces), ["boundary", "fixed", "opening", "sliding"])
        displacement = data["displacement"]
        grid = self.read(WORK / "patches.vtu")
        self.assertTrue(np.array_equal(vtk_to_numpy(grid.GetPointData().GetArray("displacement")), displacement))
        for name in ("fixed", "sliding", "opening"):
            numbers = vtk_to_numpy(grid.GetCellData().GetArray("facets_" + name))
            self.assertEqual(numbers.sum(), len(surfaces[name]))
        is_inside = lambda face: np.all(np.abs(points[face].mean(0) - middle) < width / 2)
        self.assertEqual(sorted(surfaces["opening"]), sorted(f for f in surfaces["boundary"] if is_inside(f)))
        of = {name: {v for face in faces for v in face} for name, faces in surfaces.items()}
        self.assertEqual(len(of["boundary"]), told["supports"]["boundary vertices"])
        self.assertTrue(np.all(displacement[list(of["fixed"])] == 0))
        self.assertEqual(len(of["fixed"] | of["sliding"]), told["supports"]["fixed"] + told["supports"]["sliding"])
        self.assertEqual(len(surfaces["fixed"]) + len(surfaces["sliding"]) + len(surfaces["opening"]),
                         len(surfaces["boundary"]))
        height = np.ptp(points[:, 2]) * 0.3 + points[:, 2].min()
        for face in surfaces["fixed"]:
            self.assertLess(points[face, 2].max(), height)
        # What slides stays in its tangential plane, unless it is on an edge: the displacement has no normal part.
        normals = np.zeros_like(points)
        for face in surfaces["boundary"]:
            p = points[face]
            d, e = (p[2] - p[0], p[3] - p[1]) if len(face) == 4 else (p[1] - p[0], p[2] - p[0])
            normals[face] += np.cross(d, e)
        sliding = sorted(of["sliding"] - of["fixed"])
        normal = np.einsum("ij,ij->i", displacement, normals)[sliding] / np.linalg.norm(normals[sliding], axis=1)
        self.assertLess(np.quantile(np.abs(normal), 0.9), 0.15 * told["shift"]["largest displacement"])
        free = sorted(of["opening"] - of["sliding"] - of["fixed"])
        self.assertGreater(np.linalg.norm(displacement[free], axis=1).max(), 5)
        # After the resection there is a cavity; the other sets are as before, but for what is removed.
        left, _, _ = self.surfaces_of(WORK / "left.feb")
        self.assertEqual(sorted(left), sorted([*surfaces, "cavity"]))
        self.assertEqual(len(left["fixed"]), len(surfaces["fixed"]))
        self.assertTrue(0 < len(left["opening"]) <= len(surfaces["opening"]))
        self.assertEqual(sum(map(len, left.values())), 2 * len(left["boundary"]))
        text = (WORK / "left.inp").read_text()
        for name in ("FIXED", "SLIDING", "OPENING", "CAVITY"):
            self.assertIn(f"*SURFACE, NAME={name}, TYPE=ELEMENT\n", text)
        for name in ("left.msh", "left.msh2", "patches.msh"):
            self.assertIn('"sliding"', (WORK / name).read_text())
        self.assertIn('$NodeData\n1\n"displacement"\n', (WORK / "patches.msh").read_text())
        self.assertEqual(told["parameters"]["openings"], [str(opening)])
        # The same opening as a box.
        box = "box:" + ",".join(str(float(x)) for x in [*(middle - width / 2), *(middle + width / 2)])
        self.succeeds(self.mesh, "--control-points", self.points, "--opening", box, "--slide", "skull", "--fixed", "base",
                      "--tumor", self.tumor, "--output", WORK / "patches.feb")
        self.assertEqual(self.surfaces_of(WORK / "patches.feb")[0], surfaces)

    def test_contact(self):
        """The skull stops the brain, and does not hold it: between free and sliding."""
        width, middle = 60, VALUES[:, :3].mean(0)
        opening = self.file("opening_of_contact.off", cube_off(middle, width))
        common = (self.mesh, "--control-points", self.points, "--control-radius", 8, "--fixed-below", 0.1,
                  "--opening", opening, "--order", 1) # contact needs it
        free, _ = self.succeeds(*common)
        sliding, _ = self.succeeds(*common, "--slide", "skull")
        told, out = self.succeeds(*common, "--contact", "skull", "--output", WORK / "contact.feb")
        energies = [t["shift"]["energy"] for t in (free, told, sliding)]
        self.assertEqual(energies, sorted(energies))
        self.assertLess(energies[0], energies[1])
        self.assertLess(energies[1], energies[2])
        shift, supports = told["shift"], told["supports"]
        self.assertEqual(supports["touching"], sliding["supports"]["sliding"])
        self.assertTrue(0 < shift["vertices in contact"] < supports["touching"])
        self.assertGreater(shift["force of contact"], 0)
        self.assertEqual((free["shift"]["vertices in contact"], free["shift"]["force of contact"]), (0, 0))
        self.assertIn(f"contact: {shift['vertices in contact']} vertices still at the skull", out.stdout)
        self.assertEqual(told["parameters"]["touching patches"], ["skull"])
        surfaces, _, _ = self.surfaces_of(WORK / "contact.feb")
        self.assertEqual(sorted(surfaces), ["boundary", "fixed", "opening", "touching"])
        held, _ = self.succeeds(*common, "--contact", "skull", "--slide", "skull")
        self.assertEqual(held["supports"], sliding["supports"])

    def test_patches_on_top_of_other_options(self):
        report = lambda *more: self.succeeds(self.mesh, "--control-points", self.points, *more)[0]
        plain = report("--output", WORK / "without.feb")
        surfaces, _, data = self.surfaces_of(WORK / "without.feb")
        self.assertEqual((list(surfaces), list(data)), (["boundary"], ["displacement"]))
        # base is what is fixed by default; other patches replace it, unless it is asked for
        self.assertEqual(report("--fixed", "base")["shift"], plain["shift"])
        everything = self.file("everything.off", cube_off((0, 0, 0), 1000))
        low = self.file("low.off", cube_off((0, 0, -1000), 1900))
        self.assertEqual(report("--slide", low)["supports"]["fixed"], plain["supports"]["fixed"])
        only_low = report("--fixed", low)["supports"]
        both = report("--fixed", low, "--fixed", "base")["supports"]
        below = report("--fixed", low, "--fixed-below", 0.3)["supports"]
        self.assertEqual(both, below)
        self.assertTrue(0 < only_low["fixed"] < both["fixed"])
        # an opening comes before all
        free = report("--opening", everything, "--fixed", everything, "--slide", "skull")["supports"]
        self.assertEqual((free["fixed"], free["sliding"]), (0, 0))
        self.assertEqual(report("--opening", everything, "--slide-beyond", 0, "--fixed-below", 0.3)["supports"], free)
        held = report("--fixed", everything, "--slide", "skull", "--control-compliance", 1)["supports"]
        self.assertEqual((held["fixed"], held["sliding"]), (held["boundary vertices"], 0))

    def test_labels_as_patches(self):
        grid = self.read(self.mesh)
        subdomain = vtk_to_numpy(grid.GetCellData().GetArray("subdomain"))
        is_right = np.array([np.mean(vtk_to_numpy(grid.GetCell(i).GetPoints().GetData())[:, 0]) > 30
                             for i in range(grid.GetNumberOfCells())])
        subdomain[is_right] = 4
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(WORK / "labels.vtu"))
        writer.SetInputData(grid)
        writer.SetDataModeToAscii()
        writer.Write()
        points = self.file("left_points.csv", HEADER + "-40,0,50,0,0,-4\n")
        told, _ = self.succeeds(WORK / "labels.vtu", "--control-points", points, "--max-distance", 60, "--fixed",
                                "label:4", "--output", WORK / "labels.feb", "--output", WORK / "labels_out.vtu")
        surfaces, _, data = self.surfaces_of(WORK / "labels.feb")
        fixed = sorted({v for face in surfaces["fixed"] for v in face})
        self.assertEqual(len(fixed), told["supports"]["fixed"])
        self.assertTrue(np.all(data["displacement"][fixed] == 0))
        after = self.read(WORK / "labels_out.vtu").GetCellData()
        # every boundary face of an element of the label is fixed, and those of others only where all vertices are
        has_label, numbers = (vtk_to_numpy(after.GetArray(name)) for name in ("subdomain", "facets_fixed"))
        of_label = numbers[has_label == 4].sum()
        self.assertTrue(10 < of_label <= len(surfaces["fixed"]) < 1.5 * of_label)
        nodes = [frozenset(face) for face in surfaces["boundary"]]
        elements = [{grid.GetCell(i).GetPointId(k) for k in range(grid.GetCell(i).GetNumberOfPoints())}
                    for i in np.nonzero(is_right)[0]]
        faces_of_label = {face for face in nodes if any(face <= element for element in elements)}
        self.assertEqual(len(faces_of_label), of_label)
        self.assertTrue(faces_of_label <= {frozenset(face) for face in surfaces["fixed"]})
        self.fails(WORK / "labels.vtu", "--control-points", points, "--max-distance", 60, "--slide", "label:9",
                   names="label:9", words="no face of the boundary of")

    def test_bad_patches(self):
        arguments = [self.mesh, "--control-points", self.points]
        for option, patch in (("--fixed", "skull"), ("--slide", "base"), ("--opening", "skull"), ("--opening", "base"),
                              ("--fixed", "label:"), ("--slide", "label:0"), ("--opening", "label:3x")):
            with self.subTest(option=option, patch=patch):
                self.fails(*arguments, option, patch, names=option, words="is no patch for this option", status=2)
        far = self.file("far.off", cube_off((500, 0, 0), 10))
        self.fails(*arguments, "--opening", far, names=far, words="has its center inside")
        self.fails(*arguments, "--fixed", WORK / "none.off", names="none.off", words="No such file")
        self.fails(*arguments, "--opening", "sphere:500,0,0,10", names="sphere:500,0,0,10", words="the mesh is in box:")
        self.fails(*arguments, "--slide", "sphere:0,0,0,-1", names="--slide sphere:0,0,0,-1", words="the radius", status=2)
        opened = self.file("opened.off", cube_off((28, 18, 28), 20, TRIANGLES[:4]))
        self.fails(*arguments, "--slide", opened, names=opened, words="not closed")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
