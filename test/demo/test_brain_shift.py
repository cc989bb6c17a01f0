#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""brain_shift as a user meets it: a run from the mesh to the image, bad input, determinism.

  test_brain_shift.py MESHER BRAIN_SHIFT DATA_DIRECTORY WORK_DIRECTORY
"""

import gzip
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

MESHER, PROGRAM, DATA, WORK = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])

try:
    import nibabel
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

HEADER = "x,y,z,dx,dy,dz\n"
POINTS = (DATA / "control_points.csv").read_text()
ROWS = [line for line in POINTS.splitlines() if line and line[0] not in "#x"]
VALUES = np.array([[float(x) for x in row.split(",")] for row in ROWS])
CUBE = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
TRIANGLES = [t for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2),
                                  (1, 3, 7, 5)) for t in ((a, b, c), (a, c, d))]


def off(points, faces):
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(map(str, p)) for p in points] + [" ".join(map(str, (len(f), *f))) for f in faces]
    return "\n".join(lines) + "\n"


def cube_off(center, width, faces=TRIANGLES):
    return off([tuple(c + width * (x - 0.5) for c, x in zip(center, p)) for p in CUBE], faces)


def with_value(row, column, text):
    """The control points with one number replaced; and its line in the file, from 1."""
    cells = ROWS[row].split(",")
    cells[column] = text
    return HEADER + "\n".join(ROWS[:row] + [",".join(cells)] + ROWS[row + 1:]) + "\n"


def msh(points, elements, labels=()):
    """A mesh of Gmsh: elements by type and vertices, and their labels."""
    groups = sorted(set(labels))
    labels = labels or [0] * len(elements)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    if groups:
        lines += ["$PhysicalNames", str(len(groups)), *(f'3 {i} "subdomain_{i}_rest"' for i in groups),
                  "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(points))]
    lines += [" ".join(map(str, (i + 1, *p))) for i, p in enumerate(points)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [" ".join(map(str, (i + 1, kind, 2, label, 1, *(v + 1 for v in e))))
              for i, ((kind, e), label) in enumerate(zip(elements, labels))]
    return "\n".join(lines + ["$EndElements"]) + "\n"


HEXAHEDRON = (0, 1, 3, 2, 4, 5, 7, 6)  # of CUBE


def lattice(size, width, label_of):
    """A mesh of cubes: how many there are along each axis, their width, and their labels."""
    nodes = lambda axis: range(size[axis] + 1)
    points = {(x, y, z): i for i, (z, y, x) in enumerate(itertools.product(nodes(2), nodes(1), nodes(0)))}
    cells = [(x, y, z) for z, y, x in itertools.product(*map(range, size[::-1]))]
    elements = [(5, [points[tuple(np.add(cell, CUBE[k]))] for k in HEXAHEDRON]) for cell in cells]
    return msh([np.multiply(p, width) for p in points], elements, [label_of(*cell) for cell in cells])

WEIGHTED = HEADER.replace("dz", "dz,weight")

# name of the file, contents, words that the error must have
BAD_POINTS = [
    ("empty.csv", "", "is empty"),
    ("comments_only.csv", "# nothing\n\n", "is empty"),
    ("header_only.csv", HEADER, "has no control points"),
    ("no_header.csv", "\n".join(ROWS) + "\n", "line 1: expected the header x,y,z,dx,dy,dz"),
    ("other_header.csv", "x,y,z,u,v,w\n" + "\n".join(ROWS), "line 1: expected the header"),
    ("colons.csv", POINTS.replace(",", ":"), "expected the header"),
    ("mixed.csv", HEADER + ROWS[0].replace(",", ";") + "\n", "line 2: expected 6 columns, x,y,z,dx,dy,dz, not 1"),
    ("five_columns.csv", HEADER + "\n\n# comment\n1,2,3,4,5\n", "line 5: expected 6 columns, x,y,z,dx,dy,dz, not 5"),
    ("seven_columns.csv", HEADER + ROWS[0] + ",\n", "line 2: expected 6 columns, x,y,z,dx,dy,dz, not 7"),
    ("no_weight.csv", WEIGHTED + ROWS[0] + "\n", "line 2: expected 7 columns, x,y,z,dx,dy,dz,weight, not 6"),
    ("weight_0.csv", WEIGHTED + ROWS[0] + ",0\n", 'line 2: the weight "0" is not from 1e-6 to 1e6'),
    ("weight_negative.csv", WEIGHTED + ROWS[0] + ",-1\n", 'line 2: the weight "-1" is not from 1e-6 to 1e6'),
    ("word.csv", with_value(1, 4, "much"), 'line 3: "much" is not a number'),
    ("two_numbers.csv", with_value(2, 0, "1 2"), 'line 4: "1 2" is not a number'),
    ("hexadecimal.csv", with_value(2, 0, "0x10"), 'line 4: "0x10" is not a number'),
    ("signs.csv", with_value(0, 0, "+-1"), 'line 2: "+-1" is not a number'),
    ("nothing.csv", with_value(0, 5, " "), "line 2: a number is missing"),
    ("nan.csv", with_value(3, 2, "nan"), 'line 5: "nan" is not a finite number'),
    ("infinite.csv", with_value(3, 3, "-inf"), 'line 5: "-inf" is not a finite number'),
    ("overflow.csv", with_value(3, 3, "1e999"), 'line 5: "1e999" is out of range'),
    ("kilometers.csv", with_value(3, 3, "1e7"), "line 5: \"1e7\" mm is more than a kilometer"),
    ("binary.csv", "\x00\x01\x02\xff\r\n\n", "expected the header"),
    ("control_characters.csv", HEADER + "1,2,3,4,5,\x1b[2J\n", 'line 2: "?[2J" is not a number'),
]


class BrainShift(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.mesh, cls.tumor = WORK / "brain.vtu", DATA / "tumour.off"
        subprocess.run([MESHER, DATA / "brain.off", "--region", DATA / "region.off", "--vertices", "660", "--quiet",
                        "--output", cls.mesh], check=True)
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

    def probe(self, grid, points, name):
        """Values of point data of a mesh at points; nan outside."""
        cloud = vtk.vtkPoints()
        for p in points:
            cloud.InsertNextPoint(p)
        data = vtk.vtkPolyData()
        data.SetPoints(cloud)
        probe = vtk.vtkProbeFilter()
        probe.SetInputData(data)
        probe.SetSourceData(grid)
        probe.Update()
        output = probe.GetOutput().GetPointData()
        values = vtk_to_numpy(output.GetArray(name)).copy()
        values[vtk_to_numpy(output.GetArray("vtkValidPointMask")) == 0] = np.nan
        return values

    # Runs from the mesh to the image

    def test_all_of_it(self):
        told, run = self.succeeds(self.mesh, "--control-points", self.points, "--tumor", self.tumor, "--image",
                                  self.image, "--output", WORK / "all.vtu", "--output-deformed", WORK / "left.vtu",
                                  "--output-deformed", WORK / "left.msh", "--output-image", WORK / "all",
                                  "--interpolation", "linear", "--field", "nifti")
        self.assertIn("wrote", run.stdout)
        grid, left = self.read(WORK / "all.vtu"), self.read(WORK / "left.vtu")
        displacement = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
        before = vtk_to_numpy(grid.GetPointData().GetArray("displacement_before_resection"))
        resected = vtk_to_numpy(grid.GetCellData().GetArray("resected"))
        positions = vtk_to_numpy(grid.GetPoints().GetData())
        self.assertEqual(displacement.shape, (told["inputs"]["mesh"]["vertices"], 3))
        self.assertEqual(set(resected), {0, 1})
        for key, field in (("shift", before), ("shift after resection", displacement)):
            self.assertAlmostEqual(told[key]["largest displacement"], np.linalg.norm(field, axis=1).max(), 9)
            self.assertTrue(8 < told[key]["largest displacement"] < 20)
            self.assertGreater(told[key]["energy"], 0)
            for control, value in zip(told[key]["control points"], VALUES):
                self.assertTrue(np.allclose(control["displacement"], value[3:], atol=1e-6))
                self.assertGreater(np.dot(control["force"], value[3:]), 0)
        # fixed: as many as are told, below 30 % of the height
        moved = np.linalg.norm(before, axis=1) > 0
        height = (positions[:, 2] - positions[:, 2].min()) / np.ptp(positions[:, 2])
        self.assertEqual(np.count_nonzero(~moved), told["supports"]["fixed"])
        self.assertLess(height[~moved].max(), 0.3)

        resection = told["resection"]
        self.assertEqual(resection["status"], "success")
        self.assertEqual(resection["elements removed"], np.count_nonzero(resected))
        self.assertEqual(left.GetNumberOfCells(), len(resected) - np.count_nonzero(resected))
        self.assertEqual(left.GetNumberOfPoints(), resection["vertices left"])
        self.assertTrue(0.7 < resection["cavity volume"] / told["inputs"]["tumor"]["volume"] < 1.3)
        self.assertGreater(resection["cavity area"], (36 * np.pi * resection["cavity volume"]**2)**(1 / 3))
        is_left = np.zeros(len(positions), bool)
        for i in np.nonzero(resected == 0)[0]:
            is_left[[grid.GetCell(i).GetPointId(k) for k in range(grid.GetCell(i).GetNumberOfPoints())]] = True
        self.assertTrue(np.allclose(vtk_to_numpy(left.GetPoints().GetData()), (positions + displacement)[is_left],
                                    atol=1e-12))

        # what a programme needs of the report
        stages = {stage["stage"]: stage["ms"] for stage in told["stages"]}
        for name in ("read mesh", "factor", "control points", "solve", "resect", "remove elements",
                     "solve after resection", "warp image"):
            self.assertGreater(stages[name], 0)
        self.assertEqual(told["parameters"]["Young's modulus"], {"value": 1, "unit": "kPa"})
        self.assertEqual(told["inputs"]["image"]["share of the mesh's vertices inside"], 1)
        self.assertEqual([p["line"] for p in told["control points"]], [4, 5, 6, 7])
        self.assertTrue(all(0 <= p["distance to the mesh"] < 5 for p in told["control points"]))
        for warning in told["warnings"]:
            self.assertIn("inverted", warning)
        self.assertEqual(len(run.stderr.splitlines()), len(told["warnings"]))

        # the image moves as the mesh does
        warped, mask = nibabel.load(WORK / "all.nii.gz"), nibabel.load(WORK / "all_mask.nii.gz")
        self.assertTrue(np.allclose(warped.affine, self.affine))
        mask, values = np.asarray(mask.dataobj), warped.get_fdata()
        self.assertEqual(set(np.unique(mask)), {0, 1, 2})
        self.assertEqual(told["image"], {"voxels of tissue": int((mask == 1).sum()),
                                         "voxels resected": int((mask == 2).sum()),
                                         "elements with linear interpolation": 0})
        self.assertEqual(told["parameters"]["interpolation between vertices"], "linear")
        self.assertTrue(np.all(values[mask == 2] == 0))
        voxels = np.argwhere(mask == 1)[::7]
        world = voxels @ self.affine[:3, :3].T + self.affine[:3, 3]
        left_with_data = vtk.vtkUnstructuredGrid()
        left_with_data.DeepCopy(left)
        array = vtk.vtkDoubleArray()
        array.SetName("displacement")
        array.SetNumberOfComponents(3)
        for u in displacement[is_left]:
            array.InsertNextTuple3(*u)
        left_with_data.GetPointData().AddArray(array)
        u = self.probe(left_with_data, world, "displacement")  # VTK finds the voxels in the deformed elements
        found = ~np.isnan(u[:, 0])
        self.assertGreater(np.count_nonzero(found), 0.98 * len(voxels))
        expected = 1000 + (world - u) @ self.gradient
        error = np.abs(values[tuple(voxels.T)] - expected)[found]
        # VTK splits warped faces elsewhere; inverted elements cover a point several times
        self.assertLess(np.quantile(error, 0.99), 0.2)
        self.assertGreater(np.abs(u[found] @ self.gradient).max(), 8)
        # a field takes a voxel where it came from
        backward = np.asarray(nibabel.load(WORK / "all_backward.nii.gz").dataobj)[:, :, :, 0][tuple(voxels.T)]
        self.assertTrue(np.allclose(1000 + (world + backward) @ self.gradient, values[tuple(voxels.T)], atol=1e-2))

    def test_interpolation(self):
        run = lambda name, *more: self.succeeds(self.mesh, "--control-points", self.points, "--control-radius", 8,
                                                "--image", self.image, "--output-image", WORK / name, "--field",
                                                "nifti", *more)[0]
        data = lambda name: np.asarray(nibabel.load(WORK / f"{name}.nii.gz").dataobj)
        told = run("default")
        self.assertEqual(told["parameters"]["interpolation between vertices"], "recovered")
        run("recovered", "--interpolation", "recovered")
        run("linear", "--interpolation", "linear")
        inside = (data("linear_mask") == 1) & (data("recovered_mask") == 1)
        for direction in ("_forward", "_backward"):
            self.assertTrue(np.array_equal(data("default" + direction), data("recovered" + direction)))
            difference = data("default" + direction) - data("linear" + direction)
            largest = np.linalg.norm(difference[inside], axis=-1).max()
            self.assertTrue(0.05 < largest < 0.2 * told["shift"]["largest displacement"], largest)

    def test_fields(self):
        """None unless asked for; and what another program makes of them."""
        arguments = [self.mesh, "--control-points", self.points, "--image", self.image, "--tumor", self.tumor,
                     "--output-image", WORK / "fields"]
        written = lambda: sorted(path.name for path in WORK.glob("fields*"))
        told, _ = self.succeeds(*arguments)
        self.assertEqual(written(), ["fields.nii.gz", "fields_mask.nii.gz"])
        self.assertEqual([pathlib.Path(p).name for p in told["outputs"]][:-1], written())
        told, _ = self.succeeds(*arguments, "--field", "itk", "--field", "nrrd")
        self.assertEqual(written(), ["fields.nii.gz", "fields_backward.nrrd", "fields_backward_itk.nii.gz",
                                     "fields_forward.nrrd", "fields_forward_itk.nii.gz", "fields_mask.nii.gz"])
        self.assertEqual(sorted(pathlib.Path(p).name for p in told["outputs"])[:-1], written())
        if shutil.which("plastimatch") is None:
            self.skipTest("no plastimatch")
        ours, mask = nibabel.load(WORK / "fields.nii.gz").get_fdata(), nibabel.load(WORK / "fields_mask.nii.gz")
        tissue = np.asarray(mask.dataobj) == 1
        self.assertGreater(np.abs(ours - self.values)[tissue].max(), 10)
        for field in ("fields_backward.nrrd", "fields_backward_itk.nii.gz"):
            output = WORK / "by_plastimatch.nii.gz"
            subprocess.run(["plastimatch", "convert", "--input", self.image, "--xf", WORK / field, "--output-img",
                            output, "--output-type", "float", "--algorithm", "itk"], check=True, capture_output=True)
            self.assertLess(np.abs(nibabel.load(output).get_fdata() - ours)[tissue].max(), 0.01)
            output.unlink()

    def test_labels(self):
        """Labels come from the nearest voxel, and keep their type."""
        labels = np.floor(np.indices(self.values.shape).sum(0) / 5).astype(np.int16) % 7 * 100 - 200
        nibabel.save(nibabel.Nifti1Image(labels, self.affine), WORK / "labels.nii.gz")
        arguments = [self.mesh, "--control-points", self.points, "--image", self.image]
        told, _ = self.succeeds(*arguments, "--labels", WORK / "labels.nii.gz", "--tumor", self.tumor, "--field",
                                "nifti", "--output-image", WORK / "labeled")
        self.assertEqual(told["inputs"]["labels"], str(WORK / "labels.nii.gz"))
        self.assertIn(str(WORK / "labeled_labels.nii.gz"), told["outputs"])
        after = nibabel.load(WORK / "labeled_labels.nii.gz")
        mask = np.asarray(nibabel.load(WORK / "labeled_mask.nii.gz").dataobj)
        self.assertEqual(after.get_data_dtype(), np.int16)
        after = np.asarray(after.dataobj)
        self.assertEqual(set(np.unique(after)), set(np.unique(labels)))
        self.assertTrue(np.all(after[mask == 2] == 0))
        vectors = np.asarray(nibabel.load(WORK / "labeled_backward.nii.gz").dataobj)[:, :, :, 0]
        source = np.indices(labels.shape) + np.einsum("ij,xyzj->ixyz", np.linalg.inv(self.affine[:3, :3]), vectors)
        top = np.array(labels.shape).reshape(3, 1, 1, 1) - 1
        nearest = np.clip(np.floor(source + 0.5), 0, top).astype(int)
        sure = (mask != 2) & np.all(np.abs(source - np.floor(source) - 0.5) > 1e-4, axis=0)
        self.assertTrue(np.array_equal(after[sure], labels[tuple(nearest)][sure]))
        self.assertGreater(np.count_nonzero(after[sure] != labels[sure]), 300)
        # bad labels
        nibabel.save(nibabel.Nifti1Image(labels + np.float32(0.5), self.affine), WORK / "halves.nii")
        nibabel.save(nibabel.Nifti1Image(labels[1:], self.affine), WORK / "smaller.nii")
        shifted = self.affine.copy()
        shifted[0, 3] += 0.1
        nibabel.save(nibabel.Nifti1Image(labels, shifted), WORK / "shifted.nii")
        for name, words in (("halves.nii", "is no label; expected integers"),
                            ("smaller.nii", "does not have the voxels of " + str(self.image)),
                            ("shifted.nii", "does not have the voxels of"), ("none.nii", "No such file")):
            with self.subTest(name):
                self.fails(*arguments, "--output-image", WORK / "no", "--labels", WORK / name, names=WORK / name,
                           words=words)

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

    def test_contact(self):
        """The skull stops the brain, and does not hold it: between free and sliding."""
        width, middle = 60, VALUES[:, :3].mean(0)
        opening = self.file("opening_of_contact.off", cube_off(middle, width))
        common = (self.mesh, "--control-points", self.points, "--control-radius", 8, "--fixed-below", 0.05,
                  "--opening", opening)
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

    def test_weights(self):
        """A weight counts a point as often; the error of a point left out is that of a run without it."""
        compliant = ("--control-compliance", 0.05, "--leave-one-out")
        rows = [row + f",{weight}" for row, weight in zip(ROWS, (1, 2, 1, 1))]
        weighted, out = self.succeeds(self.mesh, "--control-points", self.file("weights.csv", WEIGHTED + "\n".join(rows)),
                                      *compliant)
        twice, _ = self.succeeds(self.mesh, "--control-points",
                                 self.file("twice.csv", HEADER + "\n".join([*ROWS, ROWS[1]])), *compliant)
        self.assertAlmostEqual(weighted["shift"]["energy"], twice["shift"]["energy"], 6)
        self.assertEqual([p["weight"] for p in weighted["control points"]], [1, 2, 1, 1])
        controls = weighted["shift"]["control points"]
        errors = [np.linalg.norm(p["error if left out"]) for p in controls]
        root = np.sqrt(np.mean(np.square(errors)))
        self.assertAlmostEqual(weighted["shift"]["root mean square of leave-one-out errors"], root, 9)
        self.assertIn("is predicted by the others to", out.stdout)
        # without the first: what the mesh does there
        light = ",".join(rows[0].split(",")[:6]) + ",1e-6"
        without, _ = self.succeeds(self.mesh, "--control-points",
                                   self.file("without.csv", WEIGHTED + "\n".join([light, *rows[1:]])), *compliant)
        self.assertAlmostEqual(without["shift"]["control points"][0]["missed by"], errors[0], 3)
        exact, _ = self.succeeds(self.mesh, "--control-points", WORK / "weights.csv")
        self.assertIn("weights", exact["warnings"][0])
        plain, _ = self.succeeds(self.mesh, "--control-points", self.points)
        self.assertNotIn("error if left out", plain["shift"]["control points"][0])

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

    # Subdomains

    def column(self):
        """Of four cubes, the upper two of another label; and its upper corners, moved downwards."""
        mesh = self.file("column.msh", lattice((1, 1, 4), 1, lambda x, y, z: 3 if z < 2 else 5))
        move = lambda length: HEADER + "".join(f"{x},{y},4,0,0,{-length}\n" for x, y, z in CUBE if z == 0)
        return mesh, move

    def test_materials(self):
        mesh, move = self.column()
        run = lambda *more, points=move(0.3): self.succeeds(mesh, "--control-points", self.file("top.csv", points),
                                                            "--output", WORK / "column.vtu", *more)[0]
        fixed = ("--fixed-below", 0.1, "--poisson-ratio", 0)
        for materials, moduli in (((), (2, 2)), (("--material", "3=4,0"), (4, 2)),
                                  (("--material", "5=8,0", "--material", "3=0.5,0"), (0.5, 8)),
                                  (("--material", "5= 8 , 0 , 1.1"), (2, 8))):
            told = run("--young-modulus", 2, *fixed, *materials)
            # springs in series: they bear the same force
            force = 0.3 / (2 / moduli[0] + 2 / moduli[1])
            grid = self.read(WORK / "column.vtu")
            z = vtk_to_numpy(grid.GetPoints().GetData())[:, 2]
            wanted = np.interp(z, [0, 2, 4], [0, -force * 2 / moduli[0], -0.3])
            u = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
            self.assertTrue(np.allclose(u, wanted[:, None] * [0, 0, 1], atol=1e-9), materials)
            self.assertTrue(np.allclose(np.sum([p["force"] for p in told["shift"]["control points"]], axis=0),
                                        [0, 0, -force], atol=1e-9))
            self.assertEqual([(s["index"], s["elements"]) for s in told["subdomains"]], [(3, 2), (5, 2)])
            self.assertEqual([s["Young's modulus"] for s in told["subdomains"]],
                             [{"value": modulus, "unit": "kPa"} for modulus in moduli])
            self.assertTrue(np.allclose([s["volume"] for s in told["subdomains"]], 2))
        summary = self.shift(mesh, "--control-points", WORK / "top.csv", *fixed, "--material", "5=8,0.25").stdout
        self.assertIn("subdomain 3: 2 elements, 0.002 ml; Young's modulus 1 kPa, Poisson's ratio 0\n", summary)
        self.assertIn("subdomain 5: 2 elements, 0.002 ml; Young's modulus 8 kPa, Poisson's ratio 0.25\n", summary)
        # other ratios of Poisson make it wider
        told = run("--young-modulus", 2, *fixed, "--material", "5=2,0.4")
        self.assertEqual([s["Poisson's ratio"]["value"] for s in told["subdomains"]], [0, 0.4])
        u = vtk_to_numpy(self.read(WORK / "column.vtu").GetPointData().GetArray("displacement"))
        self.assertGreater(np.ptp(u[np.isclose(z, 3), 0]), 0.01)
        # the weight of two densities, borne by the control points
        told = run("--fixed-below", 0, "--gravity", "0,0,-9810", "--fluid-density", 0, "--density", 2, "--material",
                   "3=7,0.3,5", "--material", "5=9,0.3", points=move(0))
        self.assertTrue(np.allclose([s["density"]["value"] for s in told["subdomains"]], [5, 2]))
        self.assertTrue(np.allclose(np.sum([p["force"] for p in told["shift"]["control points"]], axis=0),
                                    [0, 0, 9810e-6 * (2 * 5 + 2 * 2)], atol=1e-9))

    def test_bad_materials(self):
        mesh, move = self.column()
        arguments = [mesh, "--control-points", self.file("top.csv", move(0.3))]
        for text, words in (("3", "expected LABEL=E,NU or LABEL=E,NU,RHO, not"), ("3=1", "expected LABEL=E,NU"),
                            ("=1,0.3", "expected LABEL=E,NU"), ("3=1,0.3,1,1", "expected LABEL=E,NU"),
                            ("3=,0.3", "Young's modulus: a number is missing"),
                            ("3=much,0.3", "Young's modulus: \"much\" is not a number"),
                            ("3=0,0.3", "Young's modulus: expected a number from 1e-9 to 1e12, not 0"),
                            ("3=1,0.5", "Poisson's ratio: expected a number of at least 0"),
                            ("3=1,nan", "Poisson's ratio: \"nan\" is not a finite number"),
                            ("3=1,0.3,-1", "density: expected a number of at least 0, not -1")):
            with self.subTest(text):
                self.fails(*arguments, "--material", text, names="--material", words=words, status=2)
        for label in ("4", "0", "-3", "03", "tumor"):
            with self.subTest(label):
                self.fails(*arguments, "--material", label + "=1,0.3", names=mesh,
                           words=f'has no subdomain "{label}", but 3, 5')
        self.fails(*arguments, "--material", "3=1,0.3", "--material", "3=1,0.3", names="--material",
                   words='the subdomain "3" is given two materials')

    def resect_label(self, name, label_of, *more):
        """From a block of cubes of 10 mm that does not move."""
        mesh = self.file(name + ".msh", lattice((5, 5, 5), 10, label_of))
        points = self.file("still.csv", HEADER + "25,25,50,0,0,0\n")
        return self.succeeds(mesh, "--control-points", points, "--tumor-label", 2, "--output", WORK / f"{name}.vtu",
                             "--output-deformed", WORK / f"{name}_left.vtu", *more)

    def test_resection_of_a_label(self):
        """Its elements, no other ones, and their voxels."""
        tumor = {(1, 1, 1), (2, 1, 1), (3, 1, 1), (3, 2, 1), (3, 2, 2), (3, 2, 3)}  # a tube with corners
        affine = np.diag([2.5, -2.5, 2.5, 1])
        affine[:3, 3] = -8.1, 58.3, -8.2
        nibabel.save(nibabel.Nifti1Image(np.full((27, 27, 27), 7, np.int16), affine), WORK / "block_image.nii.gz")
        told, run = self.resect_label("block", lambda *cell: 2 if cell in tumor else 1, "--image",
                                      WORK / "block_image.nii.gz", "--output-image", WORK / "block")
        self.assertEqual(run.stderr, "")
        self.assertEqual((told["inputs"]["tumor"], told["inputs"]["label of the tumor"]), (None, "2"))
        cells = self.read(WORK / "block.vtu").GetCellData()
        resected, labels = (vtk_to_numpy(cells.GetArray(name)) for name in ("resected", "subdomain"))
        self.assertEqual(np.count_nonzero(resected), len(tumor))
        self.assertTrue(np.array_equal(resected == 1, labels == 2))
        resection = told["resection"]
        self.assertEqual([resection[key] for key in (
            "status", "elements removed", "elements inside", "of which stay, or a vertex would be pinched",
            "removed besides, as they came loose", "removed besides, or a vertex would be pinched", "elements left")],
            ["success", 6, 6, 0, 0, 0, 119])
        self.assertAlmostEqual(resection["cavity volume"], 6000)
        self.assertAlmostEqual(resection["cavity area"], 2600)  # two ends, four sides of each
        self.assertEqual(self.read(WORK / "block_left.vtu").GetNumberOfCells(), 119)
        mask = np.asarray(nibabel.load(WORK / "block_mask.nii.gz").dataobj)
        voxels = np.indices(mask.shape).reshape(3, -1)
        cell = np.floor((affine[:3, :3] @ voxels + affine[:3, 3:]) / 10).astype(int).T
        wanted = [2 if tuple(c) in tumor else int(np.all((0 <= c) & (c < 5))) for c in cell]
        self.assertTrue(np.array_equal(mask.ravel(), wanted))
        self.assertTrue(np.all(np.asarray(nibabel.load(WORK / "block.nii.gz").dataobj)[mask == 2] == 0))

    def test_labels_that_cannot_be_resected_alone(self):
        # cubes with a common edge, and a hull around a cube
        told, run = self.resect_label("edge", lambda *cell: 2 if cell in ((1, 1, 2), (2, 2, 2)) else 1)
        self.assertIn("subdomain 2: what is left would touch itself at an edge or a vertex", run.stderr)
        self.assertEqual(told["resection"]["elements inside"], 2)
        self.assertNotEqual(told["resection"]["elements removed"], 2)
        around = lambda *cell: 2 if max(abs(x - 2) for x in cell) == 1 else 1
        told, run = self.resect_label("hull", around)
        self.assertIn("subdomain 2: tissue outside comes loose, and is removed: 1 piece", run.stderr)
        self.assertEqual((told["resection"]["elements inside"], told["resection"]["elements removed"]), (26, 27))

    def test_bad_labels_of_tumors(self):
        mesh, move = self.column()
        arguments = [mesh, "--control-points", self.file("top.csv", move(0.3)), "--tumor-label"]
        self.fails(*arguments, 4, names=mesh, words='has no subdomain "4", but 3, 5')
        self.fails(*arguments, 3, "--tumor", self.tumor, names="--tumor", words="excludes", status=2)
        self.fails(self.mesh, "--control-points", self.points, "--tumor-label", 1, names=self.mesh,
                   words="subdomain 1: everything removed: no element is left")

    def test_bad_patches(self):
        arguments = [self.mesh, "--control-points", self.points]
        for option, patch in (("--fixed", "skull"), ("--slide", "base"), ("--opening", "skull"), ("--opening", "base"),
                              ("--fixed", "label:"), ("--slide", "label:0"), ("--opening", "label:3x")):
            with self.subTest(option=option, patch=patch):
                self.fails(*arguments, option, patch, names=option, words="is no patch for this option", status=2)
        far = self.file("far.off", cube_off((500, 0, 0), 10))
        self.fails(*arguments, "--opening", far, names=far, words="has its center inside")
        self.fails(*arguments, "--fixed", WORK / "none.off", names="none.off", words="No such file")
        opened = self.file("opened.off", cube_off((28, 18, 28), 20, TRIANGLES[:4]))
        self.fails(*arguments, "--slide", opened, names=opened, words="not closed")

    def test_harmless_points(self):
        self.succeeds(self.mesh, "--control-points", self.points, "--output", WORK / "plain.vtu")
        wanted = (WORK / "plain.vtu").read_bytes()
        for name, contents in (("crlf.csv", POINTS.replace("\n", "\r\n")),
                               ("blank.csv", "\n \n" + POINTS.replace("\n", "\n\n \t\n")),
                               ("spaces.csv", POINTS.replace(",", " ,\t").replace("\n", "  \n")),
                               ("no_newline.csv", POINTS.rstrip("\n")),
                               ("bom.csv", b"\xef\xbb\xbf" + POINTS.encode()),
                               ("plus.csv", POINTS.replace("\n4", "\n+4").replace("\n3", "\n  +3")),
                               ("comment.csv", POINTS + "# more\n  # and more")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.succeeds(self.mesh, "--control-points", path, "--output", WORK / "same.vtu")
                self.assertEqual((WORK / "same.vtu").read_bytes(), wanted)

    def test_points_in_the_tumor_are_not_used_after_it(self):
        points = self.file("inside.csv", POINTS + "28,18,28,0,0,-3\n")
        told, run = self.succeeds(self.mesh, "--control-points", points, "--tumor", self.tumor)
        self.assertIn("inside.csv: line 8: the control point is in tissue removed", run.stderr)
        self.assertEqual([p["used"] for p in told["shift after resection"]["control points"]], [True] * 4 + [False])
        self.assertEqual([p["used"] for p in told["shift"]["control points"]], [True] * 5)

    def test_same_bytes(self):
        """Also where the environment says that the BLAS shall use several threads."""
        outputs = []
        for name, threads in (("a", "1"), ("b", "1"), ("c", "4")):
            self.succeeds(self.mesh, "--control-points", self.points, "--tumor", self.tumor, "--image", self.image,
                          "--output", WORK / f"{name}.vtu", "--output-deformed", WORK / f"{name}.msh",
                          "--output-image", WORK / f"{name}", "--field", "nifti", "--field", "itk", "--field", "NRRD",
                          OPENBLAS_NUM_THREADS=threads, OMP_NUM_THREADS=threads)
            outputs.append([(WORK / (name + end)).read_bytes() for end in (
                ".vtu", ".msh", ".nii.gz", "_forward.nii.gz", "_backward.nii.gz", "_forward_itk.nii.gz",
                "_backward_itk.nii.gz", "_forward.nrrd", "_backward.nrrd", "_mask.nii.gz")])
        self.assertEqual(outputs[0], outputs[1])
        self.assertEqual(outputs[0], outputs[2])

    def test_pictures(self):
        if shutil.which("Xvfb") is None:
            self.skipTest("no Xvfb")
        self.succeeds(self.mesh, "--control-points", self.points, "--tumor", self.tumor, "--image", self.image,
                      "--output", WORK / "drawn.vtu", "--output-image", WORK / "drawn")
        script = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "pictures" / "render_brain_shift.py"
        subprocess.run(["/usr/bin/python3", script, WORK / "drawn.vtu", "--tumor", self.tumor, "--control-points",
                        self.points, "--image", self.image, "--warped-image", WORK / "drawn.nii.gz", "--output-prefix",
                        WORK / "drawn", "--size", "400x300"], check=True, timeout=120)
        for name, height in (("before", 300), ("shifted", 300), ("resected", 300), ("image", 200)):
            pixels = self.pixels_of(WORK / f"drawn_{name}.png")
            self.assertEqual(pixels.shape, (height, 400, 3))
            self.assertGreater(len(np.unique(pixels.reshape(-1, 3), axis=0)), 200, name)

    def pixels_of(self, path):
        """Rows from below."""
        reader = vtk.vtkPNGReader()
        reader.SetFileName(str(path))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, 3).astype(int)

    def test_lengths_in_pictures(self):
        """The bar below the last slice is as long as it says: slices are 92 mm wide."""
        if shutil.which("Xvfb") is None:
            self.skipTest("no Xvfb")
        grid = self.read(self.mesh)
        subdomain = vtk_to_numpy(grid.GetCellData().GetArray("subdomain"))
        subdomain[::2] = 3
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(WORK / "measured_in.vtu"))
        writer.SetInputData(grid)
        writer.Write()
        pictures = {}
        for name, mesh, world in (("plain", self.mesh, "none"), ("measured", self.mesh, "ras"),
                                  ("labels", WORK / "measured_in.vtu", "ras")):
            self.succeeds(mesh, "--control-points", self.points, "--image", self.image, "--output",
                          WORK / "measured.vtu", "--output-image", WORK / "measured")
            script = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "pictures" / "render_brain_shift.py"
            subprocess.run(["/usr/bin/python3", script, WORK / "measured.vtu", "--tumor", self.tumor,
                            "--control-points", self.points, "--image", self.image, "--warped-image",
                            WORK / "measured.nii.gz", "--output-prefix", WORK / name, "--world", world, "--size",
                            "800x600"], check=True, timeout=120)
            pictures[name] = [self.pixels_of(WORK / f"{name}_{what}.png") for what in ("image", "before")]
        new = np.any(pictures["measured"][0] != pictures["plain"][0], axis=2)
        longest = lambda picture: max(max(len(run) for run in "".join(".x"[int(p)] for p in row).split("."))
                                      for row in picture)  # of pixels side by side
        slice_width = longest(np.all(np.abs(pictures["plain"][0] - 247) <= 1, axis=2))  # light without a difference
        dark = np.all(pictures["measured"][0] < 80, axis=2)
        third = slice(-new.shape[1] // 3, None)
        lowest = np.nonzero(new[:, third].any(axis=1))[0].min()
        bar = longest(dark[lowest:lowest + 10, third])
        self.assertAlmostEqual(bar / slice_width, 20 / 92, delta=0.01)
        for panel in range(3):  # letters at the four sides of each slice, and nothing new in the middle
            columns = new[:, panel * new.shape[1] // 3:(panel + 1) * new.shape[1] // 3]
            rows = np.nonzero(columns.any(axis=1))[0]
            self.assertGreater(np.ptp(rows), 0.85 * slice_width)
            self.assertGreater(np.ptp(np.nonzero(columns.any(axis=0))[0]), 0.85 * slice_width)
        # below on the right of the mesh: a bar and a cross
        new = np.any(pictures["measured"][1] != pictures["plain"][1], axis=2)
        rows, columns = np.nonzero(new)
        self.assertTrue(rows.max() < 200 and columns.min() > 650 and np.count_nonzero(new) > 150)
        # the colors of subdomains, in the sections and in the list
        for i in range(2):
            self.assertGreater(np.count_nonzero(np.any(pictures["labels"][i] != pictures["measured"][i], axis=2)), 1200)

    def test_image_beside_the_mesh(self):
        affine = self.affine.copy()
        affine[2, 3] += 60
        nibabel.save(nibabel.Nifti1Image(self.values, affine), WORK / "partial.nii")
        told, run = self.succeeds(self.mesh, "--control-points", self.points, "--image", WORK / "partial.nii",
                                  "--output-image", WORK / "partial_after")
        self.assertIn("partial.nii: only ", run.stderr)
        self.assertTrue(0 < told["inputs"]["image"]["share of the mesh's vertices inside"] < 1)

    # Bad input

    def test_formats_of_points(self):
        """Tables with other separators, and fiducials of 3D Slicer: the same points."""
        before, after = VALUES[:, :3], VALUES[:, :3] + VALUES[:, 3:]
        flip = np.array([-1, -1, 1])

        def fcsv(points, system):
            return "\n".join(["# Markups fiducial file version = 4.11", f"# CoordinateSystem = {system}",
                              "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID",
                              *(f"{i},{x},{y},{z},0,0,0,1,1,1,0,F-{i},," for i, (x, y, z) in enumerate(points))])

        def markups(points, system):
            return json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": system, "controlPoints": [
                {"id": str(i), "label": f"F-{i}", "position": list(p)} for i, p in enumerate(points)]}]})

        inputs = [[self.file(f"points{i}.csv", POINTS.replace(",", separator))]
                  for i, separator in enumerate((",", ";", " ; ", "\t", " ", "   "))]
        for system, points, others in (("RAS", before, after), ("0", before, after),
                                       ("LPS", before * flip, after * flip), ("1", before * flip, after * flip)):
            inputs.append([self.file(f"before{system}.fcsv", fcsv(points, system)), "--control-points-after",
                           self.file(f"after{system}.fcsv", fcsv(others, system))])
        inputs.append([self.file("before.mrk.json", markups(before, "RAS")), "--control-points-after",
                       self.file("after.mrk.json", markups(after * flip, "LPS"))])
        largest = []
        for arguments in inputs:
            report = WORK / "points.json"
            run = self.shift(self.mesh, "--control-points", *arguments, "--report", report)
            self.assertEqual(run.returncode, 0, run.stderr)
            told = json.loads(report.read_text())
            np.testing.assert_allclose([p["position"] for p in told["control points"]], before, atol=1e-12)
            np.testing.assert_allclose([p["displacement"] for p in told["control points"]], VALUES[:, 3:], atol=1e-12)
            largest.append(told["shift"]["largest displacement"])
        np.testing.assert_allclose(largest, largest[0], rtol=1e-9)

    def test_bad_fiducials(self):
        good = self.file("good.fcsv", "a,1,2,3\nb,4,5,6\n")
        for name, contents, words in (
                ("empty.fcsv", "# nothing\n", "has no points"),
                ("one.fcsv", "a,1,2,3\n", "has 1 points, but"),
                ("columns.fcsv", "a,1,2\n", "line 1: expected a name and three numbers, not 3 columns"),
                ("word.fcsv", "# c\na,1,much,3\n", 'line 2: "much" is not a number'),
                ("system.fcsv", "# CoordinateSystem = IJK\na,1,2,3\n", 'unknown coordinate system "IJK"'),
                ("far.fcsv", "a,1,2,3\nb,1,2,3e7\n", "point 2 is more than a kilometer away"),
                ("text.mrk.json", "hello", "is no list of markups"),
                ("empty.mrk.json", '{"markups": []}', "has 0 lists of points"),
                ("two.mrk.json", '{"markups": [{"controlPoints": [{"position": [1, 2]}]}]}', "is no list of markups"),
                ("table.csv", POINTS, "unknown format")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--control-points", good, "--control-points-after", path, names=path, words=words)
        self.fails(self.mesh, "--control-points", good, names="--control-points-after", words="before and after", status=2)
        self.fails(self.mesh, "--control-points", self.file("t.csv", POINTS), "--control-points-after", good,
                   names="--control-points-after", words="is for fiducials", status=2)

    def test_bad_points(self):
        for name, contents, words in BAD_POINTS:
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--control-points", path, names=path, words=words)
        self.fails(self.mesh, "--control-points", WORK / "none.csv", names="none.csv", words="No such file")
        self.fails(self.mesh, "--control-points", WORK, names=WORK, words="is a directory")

    def test_points_that_cannot_be_used(self):
        far = with_value(2, 2, "157")
        self.fails_with(far, words="line 4: the control point is 86.")
        self.fails_with(far, "--max-distance", 86, words="; --max-distance is 86 mm")
        self.fails_with(POINTS, "--max-distance", 0, words="the control point is 0.")
        twice = HEADER + ROWS[0] + "\n" + ",".join(ROWS[0].split(",")[:3]) + ",0,0,0\n"
        self.fails_with(twice, words="contradicts")
        self.fails_with(twice, words="line ")
        self.fails_with(POINTS, "--fixed-below", 1, words="contradicts")

    def test_points_in_another_space_or_unit(self):
        """At the back of the brain, which is longer there: negated, they are outside."""
        back = "20,-85,0,0,0,1"
        for factors, words in (((-1, -1, 1), "x and y negated"), ((1e-3,) * 3, "1,000 times smaller")):
            rows = [",".join([repr(f * float(x)) for f, x in zip(factors, row.split(","))] + row.split(",")[3:])
                    for row in ([back] if words.startswith("x") else ROWS)]
            path = self.file("elsewhere.csv", HEADER + "\n".join(rows) + "\n")
            run = self.shift(self.mesh, "--control-points", path, "--report", WORK / "report.json")
            self.assertIn(words, run.stderr)

    def test_free_rigid_motion(self):
        self.fails_with(HEADER + ROWS[0] + "\n", "--fixed-below", 0, names=self.mesh,
                        words="leave 3 rigid motions free, among them rotation about the axis through")
        self.fails_with(HEADER + "\n".join(ROWS[:2]) + "\n", "--fixed-below", 0, names=self.mesh,
                        words="1 rigid motion free: rotation about the axis through")

    def test_bad_tumors(self):
        for name, contents, words in (
                ("outside.off", cube_off((200, 200, 200), 5), "nothing removed: no element is inside"),
                ("tiny.off", cube_off((28, 18, 28), 1e-3), "nothing removed: no element is inside"),
                ("all.off", cube_off((0, 0, 0), 1000), "everything removed: no element is left"),
                ("open.off", cube_off((28, 18, 28), 20, TRIANGLES[:4]), "not closed: 8 border edges"),
                ("empty.off", "", "is empty"),
                ("tumor.txt", cube_off((28, 18, 28), 20), "unknown format")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(self.mesh, "--control-points", self.points, "--tumor", path, names=path, words=words)
        self.fails(self.mesh, "--control-points", self.points, "--tumor", WORK / "none.off", names="none.off",
                   words="No such file")
        turned = self.file("turned.off", cube_off((-20, 85, 0), 18))  # at the back of the brain, in LPS
        self.fails(self.mesh, "--control-points", self.points, "--tumor", turned, names=turned, words="x and y negated")
        self.assertEqual(self.shift(self.mesh, "--control-points", self.points, "--tumor", turned, "--space",
                                    "LPS").returncode, 0)
        with open(self.tumor) as file:
            lines = file.read().split("\n")
        n = int(lines[1].split()[0])
        points = [" ".join(repr(1e-3 * float(x)) for x in line.split()) for line in lines[2:2 + n]]
        meters = self.file("meters.off", "\n".join(lines[:2] + points + lines[2 + n:]))
        self.fails(self.mesh, "--control-points", self.points, "--tumor", meters, names=meters)
        # what is above the plane goes, with all that control points hold
        self.fails(self.mesh, "--control-points", self.points, "--fixed-below", 0, "--tumor",
                   self.file("above.off", cube_off((0, 0, 500 + 45), 1000)), names=self.mesh, words="free")

    def test_bad_meshes(self):
        with open(self.mesh, "rb") as file:
            bytes_of_mesh = file.read()
        inverted = msh(CUBE, [(5, HEXAHEDRON[4:] + HEXAHEDRON[:4])])
        second = [(x + 1, y + 1, z) for x, y, z in CUBE]  # has an edge of the first cube
        two = CUBE + [p for p in second if p not in CUBE]
        for name, contents, words in (
                ("empty.vtu", "", ""),
                ("truncated.vtu", bytes_of_mesh[:len(bytes_of_mesh) // 2], ""),
                ("text.msh", "no mesh\n", ""),
                ("mesh.off", cube_off((0, 0, 0), 1), "unknown format"),
                ("inverted.msh", inverted, "1 element is inverted, the first is element 0"),
                ("flat.msh", msh([(x, y, 0) for x, y, _ in CUBE], [(5, HEXAHEDRON)]), "1 element is inverted"),
                ("hinge.msh", msh(two, [(5, HEXAHEDRON), (5, [two.index(second[v]) for v in HEXAHEDRON])]),
                 "not a manifold")):
            with self.subTest(name):
                path = self.file(name, contents)
                self.fails(path, "--control-points", self.points, names=path, words=words)
        self.fails(WORK / "none.vtu", "--control-points", self.points, names="none.vtu")

    def test_bad_images(self):
        far = self.affine.copy()
        far[0, 3] += 1000
        nibabel.save(nibabel.Nifti1Image(self.values, far), WORK / "far.nii")
        whole = self.image.read_bytes()
        nan = self.values.copy()
        nan[1, 2, 3] = np.nan
        nibabel.save(nibabel.Nifti1Image(nan, self.affine), WORK / "nan.nii")
        self.file("truncated.nii.gz", whole[:len(whole) // 2])
        self.file("text.nii", "no image")
        self.file("damaged.nii", gzip.decompress(whole)[:1000])
        for name, words in (("far.nii", "does not overlap the mesh " + str(self.mesh)),
                            ("nan.nii", "voxel (1, 2, 3) is not a finite number"), ("truncated.nii.gz", ""),
                            ("text.nii", ""), ("damaged.nii", ""), ("none.nii", ""), ("points.csv", "unknown format"),
                            ("brain.mgz", "mri_convert")):
            with self.subTest(name):
                self.fails(self.mesh, "--control-points", self.points, "--image", WORK / name, "--output-image",
                           WORK / "no", names=WORK / name, words=words)

    def test_outputs_that_cannot_be_written(self):
        arguments = [self.mesh, "--control-points", self.points]
        (WORK / "directory.vtu").mkdir(exist_ok=True)
        for option, path, words in (("--output", WORK / "none" / "a.vtu", "No such file"),
                                    ("--output", WORK / "directory.vtu", "is a directory"),
                                    ("--output", WORK / "a.inp", ".vtu, .msh and .feb only"),
                                    ("--output", WORK / "no.vtu", "twice"),
                                    ("--output", self.mesh, "twice"),
                                    ("--output-deformed", WORK / "a.txt", "unknown extension"),
                                    ("--output-deformed", WORK / "none" / "a.msh", "No such file"),
                                    ("--output-deformed", self.points, "")):
            with self.subTest(option=option, path=path):
                self.fails(*arguments, option, path, names=path, words=words)
        self.fails(*arguments, "--image", self.image, "--output-image", WORK / "none" / "a", names="a.nii.gz",
                   words="No such file")
        self.fails(*arguments, "--image", self.image, "--output-image", WORK / "image", names=self.image,
                   words="twice")

    def test_wrong_use(self):
        arguments = [self.mesh, "--control-points", self.points]
        for more, words in (([], "--control-points"),
                            (["--fixed-below", 1.1], "--fixed-below"), (["--fixed-below", "nan"], "--fixed-below"),
                            (["--slide-below", -1], "--slide-below"),
                            (["--slide-below", 0.5, "--slide-beyond", 10], "excludes"),
                            (["--young-modulus", 0], "--young-modulus: expected a number from 1e-9 to 1e12"),
                            (["--young-modulus", 1e308], "--young-modulus: expected a number from 1e-9 to 1e12"),
                            (["--young-modulus", "inf"], "--young-modulus"),
                            (["--poisson-ratio", 0.5], "--poisson-ratio: expected a number of at least 0"),
                            (["--poisson-ratio", 0.49999999999999994], "--poisson-ratio: expected a number"),
                            (["--density", -1], "--density"), (["--fluid-density", "nan"], "--fluid-density"),
                            (["--gravity", "0,0,-9810", "--fluid-level", "inf"], "--fluid-level"),
                            (["--fluid-level", 10], "--gravity"),
                            (["--gravity", "1,2"], "--gravity: expected three numbers"),
                            (["--gravity", "0,0,nan"], "--gravity"), (["--up", "w"], "--up"),
                            (["--up", "0,0,0"], "--up"),
                            (["--interpolation", "cubic"], "--interpolation"), (["--max-distance", -1], "--max-distance"),
                            (["--control-compliance", -1], "--control-compliance"),
                            (["--image", self.image], "--output-image"),
                            (["--output-image", WORK / "no"], "--image"), (["--field", "itk"], "--output-image"),
                            (["--image", self.image, "--output-image", WORK / "no", "--field", "dicom"], "--field"),
                            (["--labels", self.image], "--image")):
            with self.subTest(more):
                self.fails(*(arguments if more else arguments[:1]), *more, names=words, status=2)
        run = self.shift("--version")
        self.assertEqual((run.returncode, run.stdout[:11]), (0, "brain_shift"))
        quiet = self.shift(*arguments, "--quiet")
        self.assertEqual((quiet.returncode, quiet.stdout), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
