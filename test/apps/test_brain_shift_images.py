#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""brain_shift from the mesh to the image: a run with all of it, fields, labels, pictures, determinism.

  test_brain_shift_images.py MESH BRAIN_SHIFT DATA_DIRECTORY WORK_DIRECTORY
"""

import gzip
import pathlib
import shutil
import subprocess
import sys
import unittest

from brain_shift_case import VALUES, WORK, Case

import nibabel
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


class Images(Case):
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

    def test_all_of_it(self):
        told, run = self.succeeds(self.mesh, "--control-points", self.points, "--tumor", self.tumor, "--image",
                                  self.image, "--output", WORK / "all.vtu", "--output-deformed", WORK / "left.vtu",
                                  "--output-deformed", WORK / "left.msh", "--output-image", WORK / "all",
                                  "--interpolation", "linear", "--field", "nifti")
        self.assertIn("wrote", run.stdout)
        self.assertRegex(run.stdout, r"factor [0-9.]+ m?s, control points [0-9.]+ m?s\n")
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
        arguments = [self.mesh, "--control-points", self.points, "--image", self.image, "--order", 1]
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
        # a label that is mostly resected, and how much is left around the cavity
        rim = labels.astype(np.int32)
        corners = np.array([[float(x) for x in line.split()] for line in self.tumor.read_text().splitlines()
                            if len(line.split()) == 3 and "." in line])
        world = np.einsum("ij,jxyz->ixyz", self.affine[:3, :3], np.indices(labels.shape)) + self.affine[:3, 3].reshape(
            3, 1, 1, 1)
        middle = corners.mean(0)
        radius = np.linalg.norm(corners - middle, axis=1).max()
        rim[np.linalg.norm(world - middle.reshape(3, 1, 1, 1), axis=0) < 1.05 * radius] = 7777
        nibabel.save(nibabel.Nifti1Image(rim.astype(np.int16), self.affine), WORK / "rim.nii")
        told, run = self.succeeds(*arguments, "--labels", WORK / "rim.nii", "--tumor", self.tumor, "--output-image",
                                  WORK / "rim")
        there = rim[tuple(nearest)] == 7777
        resected, left = (np.count_nonzero(there & (mask == m)) for m in (2, 1))
        self.assertTrue(0 < left < resected)
        facts, = told["image"]["labels with a rim"]
        self.assertEqual(facts["label"], 7777)
        self.assertAlmostEqual(facts["voxels resected"], resected, delta=2)
        self.assertAlmostEqual(facts["voxels left as a rim"], left, delta=2)
        self.assertIn(f"of label 7777, {facts['voxels resected']} voxels are resected, and "
                      f"{facts['voxels left as a rim']} others are left as a rim", run.stderr)
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

    def test_images_of_freesurfer(self):
        """T1.mgz and aseg.mgz are deformed as their conversions to NIfTI are."""
        labels = (np.indices(self.values.shape).sum(0) // 20 % 5).astype(np.uint8)
        results = []
        for ending, kind in ((".mgz", nibabel.MGHImage), (".nii.gz", nibabel.Nifti1Image)):
            nibabel.save(kind(self.values, self.affine), WORK / ("T1" + ending))
            nibabel.save(kind(labels, self.affine), WORK / ("aseg" + ending))
            told, _ = self.succeeds(self.mesh, "--control-points", self.points, "--image", WORK / ("T1" + ending),
                                    "--labels", WORK / ("aseg" + ending), "--output-image", WORK / "warped")
            self.assertEqual(told["inputs"]["image"]["voxels"], [61, 73, 61])
            results.append([nibabel.load(WORK / f"warped{end}.nii.gz") for end in ("", "_mask", "_labels")])
            results[-1] = [(image.affine, image.get_data_dtype(), np.array(image.dataobj)) for image in results[-1]]
        for (affine, number_type, values), (other_affine, other_type, others) in zip(*results):
            self.assertTrue(np.array_equal(affine, other_affine))
            self.assertEqual(number_type, other_type)
            self.assertTrue(np.array_equal(values, others))
        self.assertFalse(np.array_equal(results[0][0][2], self.values))

    def test_image_beside_the_mesh(self):
        affine = self.affine.copy()
        affine[2, 3] += 60
        nibabel.save(nibabel.Nifti1Image(self.values, affine), WORK / "partial.nii")
        told, run = self.succeeds(self.mesh, "--control-points", self.points, "--image", WORK / "partial.nii",
                                  "--output-image", WORK / "partial_after")
        self.assertIn("partial.nii: only ", run.stderr)
        self.assertTrue(0 < told["inputs"]["image"]["share of the mesh's vertices inside"] < 1)

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
        nibabel.save(nibabel.MGHImage(self.values, self.affine), WORK / "whole.mgz")
        self.file("truncated.mgz", (WORK / "whole.mgz").read_bytes()[:10000])
        self.file("text.mgz", "no image")
        nibabel.save(nibabel.MGHImage(np.stack([self.values] * 2, 3), self.affine), WORK / "frames.mgz")
        for name, words in (("far.nii", "does not overlap the mesh " + str(self.mesh)),
                            ("nan.nii", "voxel (1, 2, 3) is not a finite number"), ("truncated.nii.gz", ""),
                            ("text.nii", ""), ("damaged.nii", ""), ("none.nii", ""), ("points.csv", "unknown format"),
                            ("none.mgz", "No such file"), ("truncated.mgz", "is truncated: 61 x 73 x 61 voxels"),
                            ("text.mgz", "not an image of FreeSurfer"), ("frames.mgz", "expected three dimensions")):
            with self.subTest(name):
                self.fails(self.mesh, "--control-points", self.points, "--image", WORK / name, "--output-image",
                           WORK / "no", names=WORK / name, words=words)

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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
