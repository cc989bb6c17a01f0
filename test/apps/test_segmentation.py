#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""mixed_mesh_3 on images of labels: the mesh covers the voxels, in the world of the image; bad input.

  test_segmentation.py MESHER WORK_DIRECTORY
"""

import gzip
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import unittest

MESHER, WORK = sys.argv[1], pathlib.Path(sys.argv[2])

try:
    import nibabel
    import numpy as np
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

SIZE = (60, 50, 40)
HEAD, LESION = 7, 200  # labels


def rotation(a, b):
    turn_x = [[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]]
    turn_z = [[np.cos(b), -np.sin(b), 0], [np.sin(b), np.cos(b), 0], [0, 0, 1]]
    return np.array(turn_x) @ np.array(turn_z)


def affine(spacing, turn=np.eye(3), origin=(20, -30, 40)):
    result = np.eye(4)
    result[:3, :3] = turn @ np.diag(spacing)
    result[:3, 3] = origin
    return result


AFFINES = {"oblique": affine((2, 2.4, 3), rotation(0.4, -0.7)), "x negated": affine((-2, 2.4, 3))}


def labels():
    """A bent ellipsoid with a ball in it."""
    x, y, z = np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij")
    x, y, z = (2 * x - 60) / 48, (2.4 * y - 60) / 45, (3 * z - 60) / 42
    values = np.where(x**2 + (y + 0.3 * x**2)**2 + z**2 < 1, HEAD, 0)
    values[(x - 0.3)**2 + (y + 0.1)**2 + (z - 0.2)**2 < 0.04] = LESION
    return values.astype(np.int16)


def centers(to_world):
    indices = np.stack(np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij"), -1).reshape(-1, 3)
    return indices @ to_world[:3, :3].T + to_world[:3, 3]


def is_in_mesh(path, points):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputConnection(reader.GetOutputPort())
    surface.Update()
    coordinates = vtk.vtkPoints()
    coordinates.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    cloud = vtk.vtkPolyData()
    cloud.SetPoints(coordinates)
    enclosed = vtk.vtkSelectEnclosedPoints()
    enclosed.SetInputData(cloud)
    enclosed.SetSurfaceData(surface.GetOutput())
    enclosed.Update()
    return vtk_to_numpy(enclosed.GetOutput().GetPointData().GetArray("SelectedPoints")) != 0


class Test_segmentation(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        self.output, self.report = WORK / "mesh.vtu", WORK / "mesh.json"

    def image(self, name, values, to_world):
        path = WORK / name
        image = nibabel.Nifti1Image(values, to_world)
        image.set_sform(to_world, 1)
        nibabel.save(image, str(path))
        return path

    def mesh(self, *arguments):
        run = subprocess.run([MESHER, *map(str, arguments), "--output", self.output, "--report", self.report],
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(self.report.read_text()), run

    def fails(self, *arguments, words, status=1):
        run = subprocess.run([MESHER, *map(str, arguments), "--output", self.output], capture_output=True, text=True)
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertIn(words, run.stderr)
        self.assertFalse(self.output.exists())
        return run

    def dice(self, is_label, to_world):
        is_in = is_in_mesh(self.output, centers(to_world)).reshape(SIZE)
        return 2 * np.count_nonzero(is_in & is_label) / (np.count_nonzero(is_in) + np.count_nonzero(is_label))

    def test_mesh_covers_labels(self):
        values = labels()
        for name, to_world in AFFINES.items():
            for vertices, least in ((660, 0.95), (10000, 0.98)):
                with self.subTest(name, vertices=vertices):
                    path = self.image("labels.nii.gz", values, to_world)
                    told, run = self.mesh(path, "--labels", f"1-9,{LESION}", "--region-labels", f"{LESION}:2",
                                          "--vertices", vertices)
                    self.assertEqual(run.stderr, "")
                    self.assertEqual(told["status"], "success")
                    self.assertGreater(self.dice(values != 0, to_world), least)
                    self.assertEqual(told["inputs"]["regions"][0]["weight"], 2)
                    self.assertEqual(told["inputs"]["regions"][0]["voxels"], f"with the labels {LESION}")
                    self.assertEqual(told["inputs"]["surface"]["voxels"], f"with the labels 1-9,{LESION}")
                    volume = np.count_nonzero(values) * 2 * 2.4 * 3
                    self.assertAlmostEqual(told["inputs"]["surface"]["volume"] / volume, 1, delta=0.02)

    def test_selections(self):
        """One label, a threshold and all that is not 0 say the same of the images for it."""
        values = labels()
        to_world = AFFINES["oblique"]
        all_labels = self.image("all.nii", values, to_world)
        one = self.image("one.nii", np.where(values == LESION, LESION, 0).astype(np.int16), to_world)
        intensities = self.image("float.nii.gz", np.where(values == LESION, 3.5, -1 + values / 4).astype(np.float32),
                                 to_world)
        contents = []
        for arguments in ((all_labels, "--labels", LESION), (one,), (intensities, "--threshold", 3.25)):
            told, _ = self.mesh(*arguments, "--vertices", 500)
            self.assertEqual(told["inputs"]["surface"]["file"], str(arguments[0]))
            contents.append(self.output.read_bytes())
        self.assertTrue(contents[0] == contents[1] == contents[2])
        # without smoothing there are steps, and more surface
        smooth, _ = self.mesh(one, "--vertices", 500)
        steps, _ = self.mesh(one, "--vertices", 500, "--smoothing", 0)
        self.assertNotEqual(smooth["inputs"]["surface"], steps["inputs"]["surface"])

    def test_region_image(self):
        """A region may be an image of its own, with another grid."""
        values = labels()
        path = self.image("labels.nii", values, AFFINES["oblique"])
        mask = self.image("mask.nii.gz", (values == LESION).astype(np.uint8), AFFINES["oblique"])
        first, _ = self.mesh(path, "--vertices", 800, "--region", mask)
        content = self.output.read_bytes()
        second, _ = self.mesh(path, "--vertices", 800, "--region-labels", LESION)
        self.assertEqual(content, self.output.read_bytes())
        self.assertGreater(first["mesh"]["elements in region"], 50)

    def test_images_of_freesurfer(self):
        """An image of FreeSurfer and its conversion to NIfTI, by another program, have the same mesh."""
        random = np.random.default_rng(11)
        to_world = affine((4, 4.8, 6), rotation(*random.uniform(-1, 1, 2)), random.uniform(-50, 50, 3))
        values = labels()[::2, ::2, ::2]
        for number_type in (np.uint8, np.int16, np.int32, np.float32, np.uint16):
            with self.subTest(number_type.__name__):
                # nibabel does not write uint16, number 10 of the format: the bytes of small numbers are those of int16.
                is_known = number_type != np.uint16
                path = WORK / "aseg.mgz"
                nibabel.save(nibabel.MGHImage(values.astype(number_type if is_known else np.int16), to_world), str(path))
                source = nibabel.load(str(path))
                self.assertTrue(np.allclose(source.affine, to_world, atol=1e-4))
                if not is_known:
                    whole = gzip.decompress(path.read_bytes())
                    path.write_bytes(gzip.compress(whole[:20] + struct.pack(">i", 10) + whole[24:]))
                converted = self.image("aseg.nii.gz", values.astype(number_type), source.affine)
                contents = []
                for image in (path, converted):
                    told, run = self.mesh(image, "--labels", f"1-9,{LESION}", "--region", f"{image}:2", "--vertices", 300)
                    self.assertEqual(run.stderr, "")
                    contents.append(self.output.read_bytes())
                self.assertEqual(told["inputs"]["surface"]["voxels"], f"with the labels 1-9,{LESION}")
                self.assertTrue(contents[0] == contents[1])
        # The ending may be in capital letters, and the file not compressed.
        path = WORK / "ASEG.MGH"
        path.write_bytes(gzip.decompress((WORK / "aseg.mgz").read_bytes()))
        self.mesh(path, "--labels", f"1-9,{LESION}", "--region", f"{path}:2", "--vertices", 300)
        self.assertTrue(self.output.read_bytes() == contents[0])

    def test_bad_images_of_freesurfer(self):
        image = nibabel.MGHImage(labels(), AFFINES["oblique"])
        nibabel.save(image, str(WORK / "good.mgz"))
        compressed = (WORK / "good.mgz").read_bytes()
        whole = gzip.decompress(compressed)
        nibabel.save(nibabel.MGHImage(np.stack([labels(), labels()], 3), AFFINES["oblique"]), str(WORK / "frames.mgz"))
        for name, contents, words in (
                ("truncated.mgz", compressed[:len(compressed) // 2], "is truncated: 60 x 50 x 40 voxels expected"),
                ("truncated.mgh", whole[:200000], "is truncated: 60 x 50 x 40 voxels expected"),
                ("header.mgh", whole[:90], "not an image of FreeSurfer, or truncated"),
                ("version.mgz", gzip.compress(struct.pack(">i", 2) + whole[4:]), "not an image of FreeSurfer of version 1"),
                ("size.mgh", whole[:4] + struct.pack(">3i", *[10**9] * 3) + whole[16:], "is truncated: 1000000000 x"),
                ("type.mgh", whole[:20] + struct.pack(">i", 9) + whole[24:], "has voxels of type 9"),
                ("frames.mgz", None, "is a 4-D image of 60 x 50 x 40 x 2 values; expected three dimensions")):
            with self.subTest(name):
                path = WORK / name
                if contents is not None:
                    path.write_bytes(contents)
                run = self.fails(path, "--labels", "7", "--vertices", 300, words=f"{path}: ")
                self.assertIn(words, run.stderr)
                self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.fails(WORK / "good.mgz", "--region", path, "--vertices", 300, words=f"{path}: {words}")

    def test_several_components(self):
        values = labels()
        values[2:6, 2:6, 2:6] = HEAD
        path = self.image("two.nii", values, AFFINES["x negated"])
        told, run = self.mesh(path, "--vertices", 1000)
        self.assertIn("warning: " + str(path) + ": the voxels that are not 0 have a surface of 2 components", run.stderr)
        self.assertEqual(told["inputs"]["surface"]["components"], 2)

    def test_named_labels(self):
        """Each list of labels is a subdomain: elements, volumes, an interface in the files."""
        values = labels()
        for name, to_world in AFFINES.items():
            with self.subTest(name):
                path = self.image("labels.nii.gz", values, to_world)
                gmsh = WORK / "mesh.msh"
                told, run = self.mesh(path, "--labels", f"head=1-9,lesion={LESION}", "--vertices", 3000, "--output", gmsh)
                self.assertEqual([(s["name"], s["index"]) for s in told["subdomains"]], [("head", 1), ("lesion", 2)])
                for subdomain, label in zip(told["subdomains"], (HEAD, LESION)):
                    expected = np.count_nonzero(values == label) * 2 * 2.4 * 3
                    self.assertAlmostEqual(subdomain["volume"] / expected, 1, delta=0.06)
                    self.assertLessEqual(subdomain["ARC max"], 3.2)
                self.assertEqual([i["between"] for i in told["interfaces"]], [["head", "outside"], ["head", "lesion"]])
                self.assertTrue(all(i["manifold"] for i in told["interfaces"]))
                self.assertEqual(told["interfaces"][0]["vertices not on surface"], 0)
                self.assertIn('"interface_head_lesion"', gmsh.read_text(errors="replace"))
                # the label of the voxel around the center of each element
                reader = vtk.vtkXMLUnstructuredGridReader()
                reader.SetFileName(str(self.output))
                centers_of = vtk.vtkCellCenters()
                centers_of.SetInputConnection(reader.GetOutputPort())
                centers_of.Update()
                points = vtk_to_numpy(centers_of.GetOutput().GetPoints().GetData())
                voxels = np.rint((points - to_world[:3, 3]) @ np.linalg.inv(to_world[:3, :3]).T).astype(int)
                found = values[tuple(np.clip(voxels, 0, np.array(SIZE) - 1).T)]
                subdomains = vtk_to_numpy(reader.GetOutput().GetCellData().GetArray("subdomain"))
                agree = np.where(found == LESION, 2, 1) == subdomains
                self.assertGreater(np.count_nonzero(agree[found != 0]) / np.count_nonzero(found), 0.95)
        first = self.output.read_bytes()
        self.mesh(path, "--labels", f"head=1-9,lesion={LESION}", "--vertices", 3000, "--threads", 4)
        self.assertEqual(first, self.output.read_bytes())

    def test_changes_by_smoothing(self):
        """A bridge of a voxel is told as lost, with its place; a thick one is none."""
        x, y, z = np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij")
        for width in 1, 9:
            values = np.where(np.hypot(np.hypot(x - 15, y - 20), z - 20) < 11, 1, 0)
            values[np.hypot(np.hypot(x - 43, y - 20), z - 20) < 11] = 1
            values[15:43, 20 - width // 2:21 + width // 2, 20 - width // 2:21 + width // 2] = 1
            values[np.hypot(np.hypot(x - 15, y - 20), z - 20) < 6] = 2
            path = self.image("bridge.nii", values.astype(np.int16), affine((2, 2, 2)))
            told, run = self.mesh(path, "--labels", "a=1,b=2", "--vertices", 1500)
            changes = told["inputs"]["surface"].get("changes by smoothing", [])
            self.assertEqual(len(changes), 1 if width == 1 else 0)
            self.assertEqual(run.stderr.count("smoothing changes"), len(changes))
            for change in changes:
                words = "smoothing changes the subdomain a: 1 body of its voxels becomes 2: a bridge or a neck is lost"
                self.assertIn(words, change["text"])
                self.assertIn(words, run.stderr)
                self.assertLess(np.linalg.norm(np.subtract(change["at"], (20 + 2 * 29, -30 + 2 * 20, 40 + 2 * 20))), 3)

    def atlas(self):
        """Regions with gaps between them and nothing in the middle, open to one side, and a speck; and the whole."""
        whole = labels() != 0
        i, j, k = np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij")
        x, y, z = 2 * (i - 30), 2.4 * (j - 25), 3 * (k - 20)
        values = np.where(whole, 1 + i // 8 + 10 * (j // 8), 0)
        values[(i % 8 == 0) | (j % 8 == 0)] = 0
        values[(x**2 + y**2 + z**2 < 15**2) | ((np.hypot(x, y) < 5) & (z > 0))] = 0
        values[0, 0, 0] = 99
        return values.astype(np.int16), whole

    def test_hull(self):
        """Of an atlas with gaps, the solid organ; without, it is named what would help."""
        values, whole = self.atlas()
        to_world = AFFINES["oblique"]
        path = self.image("atlas.nii.gz", values, to_world)
        told, run = self.mesh(path, "--vertices", 1000, "--hull", "--close", 9)
        self.assertEqual((run.stderr, told["status"]), ("", "success"))
        self.assertRegex(run.stdout, r"image: closed by 9 mm, [0-9]+ voxels added \([0-9.]+ % of its voxels\); "
                                     r"[0-9]+ voxels filled in \([0-9.]+ % of its voxels\); "
                                     "1 component of 1 voxel dropped\n")
        self.assertEqual(told["topology"]["surface"]["bodies"], 1)
        self.assertEqual(told["topology"]["surface"]["handles"] + told["topology"]["surface"]["cavities"], 0)
        self.assertTrue(all(told["checks of fidelity"].values()))
        self.assertGreater(self.dice(whole, to_world), 0.97)
        done = told["inputs"]["surface"]["completion"]
        self.assertEqual((done["closing radius"], done["voxels"], done["components dropped"]),
                         (9, np.count_nonzero(values), 1))
        # each step alone; by default, the radius follows from the volume
        steps, run = self.mesh(path, "--vertices", 1000, "--close", 9, "--fill-holes", "--drop-below", 1)
        self.assertEqual(steps["inputs"]["surface"], told["inputs"]["surface"])
        default, run = self.mesh(path, "--vertices", 1000, "--hull")
        volume = np.count_nonzero(values) * 2 * 2.4 * 3
        self.assertAlmostEqual(default["inputs"]["surface"]["completion"]["closing radius"], 0.13 * volume**(1 / 3),
                               delta=0.051)
        # what is added to labels with names is of that with most voxels
        named, run = self.mesh(path, "--labels", "left=1-40,right=41-98", "--vertices", 800, "--hull", "--close", 9)
        volumes = {s["name"]: s["volume"] / 14.4 for s in named["subdomains"]}
        self.assertAlmostEqual(sum(volumes.values()) / np.count_nonzero(whole), 1, delta=0.07)
        counts = {"left": np.count_nonzero((0 < values) & (values <= 40)),
                  "right": np.count_nonzero((40 < values) & (values < 99))}
        larger, smaller = sorted(counts, key=counts.get, reverse=True)
        self.assertGreater(volumes[larger] - counts[larger], np.count_nonzero(whole) - sum(counts.values()) - 2000)
        # without: the first warning names the option, and the differences are counted only
        told, run = self.mesh(path, "--vertices", 1000, "--no-fit")
        first, *rest = run.stderr.splitlines()
        self.assertRegex(first, f"^warning: {path}: its voxels have gaps .* --hull closes them")
        self.assertFalse(all(told["checks of fidelity"].values()))
        self.assertNotIn("all checks hold", run.stdout)
        self.assertIn("valid, but not: same topology as the surface", run.stdout)
        self.assertLess(len(rest), 8)

    def test_bad_completions(self):
        path = self.image("labels.nii", labels(), AFFINES["oblique"])
        for option in ("--close", "--drop-below"):
            for text in ("-1", "0", "nan", "much"):
                self.fails(path, option, text, "--vertices", 500, words=option, status=2)
        self.fails(path, "--close", 1e6, "--vertices", 500, words="is more than 100 voxels wide, see --close")
        self.fails(path, "--drop-below", 1e6, "--vertices", 500,
                   words=f"{path}: no component of the voxels that are not 0 has 1e+06 ml, see --drop-below")
        self.fails(path, "--labels", 4, "--hull", "--vertices", 500, words="there are no voxels with the labels 4")
        surface = WORK / "surface.off"
        surface.write_text("OFF\n")
        self.fails(surface, "--hull", "--vertices", 500, words="need an image", status=2)

    def test_wrap(self):
        """An image is wrapped, too."""
        values, whole = self.atlas()
        path = self.image("atlas.nii.gz", values, AFFINES["oblique"])
        told, run = self.mesh(path, "--labels", "1-98", "--vertices", 500, "--wrap", 12)
        self.assertIn("wrapped it, closing what is narrower than 12", told["inputs"]["surface"]["repairs"][0])
        self.assertEqual(told["topology"]["surface"]["bodies"], 1)
        self.assertGreater(self.dice(whole, AFFINES["oblique"]), 0.9)

    def test_lost_label(self):
        values = labels()
        values[30, 25, 12] = 11
        path = self.image("labels.nii", values, AFFINES["oblique"])
        told, run = self.mesh(path, "--labels", "head=1-9,200,speck=11", "--vertices", 300, "--base-level", 2)
        self.assertEqual(told["status"], "parts lost")
        self.assertRegex(run.stderr, r"the subdomain speck, of volume [0-9.]+ mm\^3, is lost: smoothing leaves nothing")
        self.assertEqual({s["name"]: s["elements"] > 0 for s in told["subdomains"]}, {"speck": False, "head": True})
        self.assertEqual(told["subdomains"][1]["volume"], 0)
        self.assertIn("speck (2): 0 elements", run.stdout)

    def test_lost_labels(self):
        """Nothing is left of two voxels: there is no domain, and no mesh."""
        values = np.zeros((12, 12, 12), np.int16)
        values[5, 5, 5], values[8, 8, 8] = 1, 2
        path = self.image("voxels.nii", values, affine((1, 1, 1)))
        self.fails(path, "--labels", "each", "--smoothing", 20, "--vertices", 300, words="nothing is left of the voxels")

    def test_touching_labels(self):
        """Gray matter around white matter around ventricles: each has its volume, all vertices are on interfaces."""
        x, y, z = np.meshgrid(*(3 * np.arange(n) - 1.5 * (n - 1) for n in (48, 56, 46)), indexing="ij")
        radius = np.sqrt((x / 60)**2 + (y / 72)**2 + (z / 56)**2)
        fold = 0.03 * np.sin(6 * np.arctan2(y, x)) * np.cos(z / 12)
        values = np.select([((np.abs(x) - 12) / 10)**2 + (y / 25)**2 + (z / 12)**2 < 1, radius < 0.75 + fold, radius < 0.95],
                           [3, 1, 2], 0).astype(np.int16)
        path = self.image("brain.nii.gz", values, affine((3, 3, 3)))
        told, run = self.mesh(path, "--labels", "white=1,gray=2,ventricles=3", "--vertices", 4500)
        self.assertIn("all checks hold", run.stdout)
        for subdomain, label in zip(told["subdomains"], (1, 2, 3)):
            expected = np.count_nonzero(values == label) * 27
            self.assertAlmostEqual(subdomain["volume"] / expected, 1, delta=0.06)
            self.assertLessEqual(subdomain["ARC max"], 3.2)
        self.assertEqual([i["between"] for i in told["interfaces"]],
                         [["white", "gray"], ["white", "ventricles"], ["gray", "outside"]])
        self.assertEqual([i["vertices not on surface"] for i in told["interfaces"]], [0, 0, 0])
        self.output.unlink()
        self.fails(path, "--labels", "white=1,gray=2", "--wrap", 5, "--vertices", 500, words="--wrap would tear")

    def test_folded_layers(self):
        """Layers that fill a ball, as a cortex does: vertices are removed and the rest is fitted in turn until there are few
        enough, which within the quality bound alone they never are."""
        x, y, z = np.meshgrid(*(np.arange(32) - 15.5,) * 3, indexing="ij")
        k = np.pi / 10
        gyroid = np.sin(k * x) * np.cos(k * y) + np.sin(k * y) * np.cos(k * z) + np.sin(k * z) * np.cos(k * x)
        values = np.where(x**2 + y**2 + z**2 < 14.4**2, np.select([gyroid > 0.55, gyroid > -0.55], [1, 2], 3), 0)
        path = self.image("folds.nii", values.astype(np.int16), affine((1, 1, 1)))
        told, _ = self.mesh(path, "--labels", "white=1,gray=2,fluid=3", "--vertices", 1000, "--best-effort")
        self.assertGreater(told["mesh"]["vertices"], 950)
        for subdomain, label in zip(told["subdomains"], (1, 2, 3)):
            self.assertAlmostEqual(subdomain["volume"] / np.count_nonzero(values == label), 1, delta=0.2)

    def table(self, name, *lines):
        path = WORK / name
        path.write_text("\n".join(lines) + "\n")
        return path

    def test_label_tables(self):
        """Names of a table of any of three programs say the same as numbers."""
        path = self.image("labels.nii", labels(), AFFINES["oblique"])
        tables = (
            self.table("FreeSurferColorLUT.txt", "#No. Label Name:      R   G   B   A", "", "0   Unknown  0 0 0 0",
                       f"{HEAD}   Left-Head   245 245 245 0", f"\t{LESION}  Lesion-1-2  1 2 3 0\r"),
            self.table("slicer.ctbl", "# Color table file slicer.ctbl", f"{HEAD} left-head 1 2 3 255",
                       f'{LESION} "LESION-1-2" 4 5 6 255'),
            self.table("snap.label", "################", "# IDX -R- -G- -B- -A-- VIS MSH LABEL",
                       '    0     0    0    0        0  0  0    "Clear Label"',
                       f'    {LESION}   255    0    0        0.5  1  1    "Lesion-1-2"',
                       f'    {HEAD}   255    0    0        1  1  1    "Left-Head"'))
        by_numbers, run = self.mesh(path, "--labels", f"brain={HEAD},1-3,tumor={LESION}", "--region-labels", f"{LESION}:2",
                                    "--vertices", 400)
        content = self.output.read_bytes()
        for table in tables:
            with self.subTest(table.name):
                told, run = self.mesh(path, "--label-table", table, "--labels", "brain=left-HEAD,1-3,tumor=lesion-1-2",
                                      "--region-labels", "Lesion-1-2:2", "--vertices", 400)
                self.assertEqual(told["warnings"], by_numbers["warnings"])
                self.assertEqual(content, self.output.read_bytes())
                self.assertEqual([s["voxels"] for s in told["subdomains"]],
                                 ["with the labels left-HEAD,1-3", "with the labels lesion-1-2"])
        # The place of the option does not matter; the lists of numbers mean the same with a table.
        self.mesh(path, "--labels", "brain=Left-Head,tumor=200", "--region-labels", "Lesion-1-2:2", "--vertices", 400,
                  "--label-table", tables[0])
        self.assertEqual(content, self.output.read_bytes())

    def test_names_of_each(self):
        """Names of a table are made valid for files, and unique in upper and lower case."""
        values = labels()
        x, y, z = np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij")
        values[values == HEAD] = 1 + (x // 20 + 3 * (y // 25))[values == HEAD]
        path = self.image("labels.nii.gz", values, AFFINES["oblique"])
        self.assertEqual(set(np.unique(values)), {0, 1, 2, 3, 4, 5, 6, LESION})
        table = self.table("table.txt", "1 3rd-Ventricle 0 0 0 0", "2 tumor 0 0 0 0", "3 Outside 0 0 0 0", "4 all 0 0 0 0",
                           f'5 "{"long (name) " * 5}" 0 0 0 0', f'6 "{"Long_[name]_" * 5}" 0 0 0 0')
        told, run = self.mesh(path, "--labels", "each", "--label-table", table, "--vertices", 1500, "--subdomain",
                              f"Tumor={self.ball()}", "--output", WORK / "mesh.msh", "--output", WORK / "mesh.inp")
        self.assertEqual({s["index"]: s["name"] for s in told["subdomains"] if s["name"] != "Tumor"},
                         {1: "label_3rd-Ventricle", 2: "tumor_2", 3: "Outside_2", 4: "label_all",
                          5: "long__name__long__name__", 6: "Long__name__Long__name_2", LESION: f"label_{LESION}"})

    def test_vertices_for_layers(self):
        """The vertices that a thin layer takes are told before it is meshed, and are enough; few are refused."""
        x, y, z = np.meshgrid(*(2 * (np.arange(36) - 17.3),) * 3, indexing="ij")
        r = np.sqrt(x**2 + y**2 + z**2)
        image = self.image("shell.nii.gz", np.select([r < 25, r < 28.5], [1, 2], 0).astype(np.int16), affine((2, 2, 2)))
        layers = (image, "--labels", "core=1,shell=2", "--vertices")
        words = "shell is 3.5"
        told = self.fails(*layers, 50, words=words).stderr
        self.assertIn("--merge", told)
        needed = int(told.split("about ")[1].split()[0])
        self.fails(*layers, needed // 5, words=words)
        told, run = self.mesh(*layers, needed // 5, "--best-effort")
        self.assertIn(words, run.stderr)
        self.assertTrue(told["options"]["best effort"])
        _, run = self.mesh(*layers, needed // 2)
        self.assertIn(words, run.stderr)
        told, run = self.mesh(*layers, 3 * needed // 2)
        self.assertEqual(run.stderr, "")
        self.assertEqual(told["status"], "success")
        for s in told["subdomains"]:
            self.assertAlmostEqual(s["ratio of volumes"], 1, delta=0.05)

    def test_merge(self):
        """Merged labels are the same as one list of these labels, and only what is chosen is written."""
        values = labels()
        x, y, _ = np.meshgrid(*(np.arange(n) for n in SIZE), indexing="ij")
        values[values == HEAD] = 1 + (x // 20 + 3 * (y // 25))[values == HEAD]
        path = self.image("labels.nii.gz", values, AFFINES["oblique"])
        meshes = []
        for options in (("--labels", f"half=1-3,other=4-6,{LESION}"),
                        ("--labels", f"half=1-3,b=4,c=5-6,d={LESION}", "--merge", "x=b+C", "--merge", "other=X+d"),
                        ("--labels", f"half=1-2,b=4-6,c={LESION},d=3", "--merge", "other=c+b", "--merge", "half=d+half")):
            self.mesh(path, *options, "--vertices", 1000)
            meshes.append(self.output.read_bytes())
        self.assertEqual(meshes[0], meshes[1])
        self.assertEqual(meshes[0], meshes[2])
        told, run = self.mesh(path, "--labels", "each", "--merge", "half=label_1+label_2+label_3", "--extract", "HALF,label_6",
                              "--vertices", 1000)
        voxel = abs(np.linalg.det(AFFINES["oblique"][:3, :3]))
        for s in told["subdomains"]:
            number = np.isin(values, {"half": (1, 2, 3)}.get(s["name"], (s["index"],))).sum()
            self.assertAlmostEqual(s["volume of voxels"], number * voxel, delta=1e-6 * number * voxel)
            self.assertAlmostEqual(s["ratio of volumes"], s["volume"] / s["volume of voxels"])
            self.assertIn(f"{s['name']} ({s['index']}): ", run.stdout)
        self.assertIn("that of its voxels, ", run.stdout)
        self.assertEqual({s["name"]: s["index"] for s in told["subdomains"] if s["index"] < 7},
                         {"half": 1, "label_4": 4, "label_5": 5, "label_6": 6})
        self.assertEqual(told["extracted"]["subdomains"], ["half", "label_6"])
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.output))
        reader.Update()
        self.assertEqual(set(vtk_to_numpy(reader.GetOutput().GetCellData().GetArray("subdomain"))), {1, 6})
        self.output.unlink()
        for text, status, words in (("a=label_1", 2, "expected NAME=A+B"), ("all=label_1+label_2", 2, "a name has"),
                                    ("a=label_1+label_8", 1, "label_8: there is no subdomain of that name, but label_1, label_2"),
                                    ("a=label_1+label_1", 1, "label_1: there is no"),
                                    ("label_3=label_1+label_2", 1, "the name is taken")):
            self.fails(path, "--labels", "each", "--merge", text, words=words, status=status)
        self.fails(path, "--labels", "a=1,b=2,c=3", "--merge", "c=a+b", words="the name is taken", status=2)
        self.fails(path, "--labels", "a=1,b=2,c=3", "--merge", "d=a+b", "--extract", "a", status=2,
                   words="--extract a: there is no subdomain of that name, but c, d")
        self.fails(path, "--labels", "each", "--extract", "label_8", words="--extract label_8: there is no subdomain")
        self.fails(path, "--labels", "freesurfer", "--merge", "t=wm+gm", words="wm: there is no subdomain", status=2)

    def ball(self):
        """A small closed surface in the middle."""
        center = centers(AFFINES["oblique"]).mean(axis=0)
        corners = [center + 5 * np.array(c) for c in ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))]
        path = WORK / "ball.off"
        path.write_text("OFF\n4 4 0\n" + "".join("%g %g %g\n" % tuple(c) for c in corners)
                        + "3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n")
        return path

    def test_bad_label_tables(self):
        path = self.image("labels.nii", labels(), AFFINES["oblique"])
        table = self.table("table.txt", "17 Left-Hippocampus 0 0 0 0", "53 Right-Hippocampus 0 0 0 0", "7 Left-Head 0 0 0 0",
                           "4 Left-Lateral-Ventricle 0 0 0 0")
        for option in ("--labels", "--region-labels"):
            run = self.fails(path, "--label-table", table, option, "hippocampus", words=f"{table}: has no label 'hippocampus'",
                             status=2)
            self.assertIn("Left-Hippocampus, Right-Hippocampus, Left-Head", run.stderr)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.fails(path, "--label-table", table, "--labels", "a=Left-Haed,17", words="closest names are Left-Head,", status=2)
        for text in ("", "1,", "a=1,", "=1"):
            self.fails(path, "--label-table", table, "--labels", text, words="--labels", status=2)
        for lines, words in ((("# n", "1 a 0 0 0 0", "1 b 0 0 0 0"), "line 3: the label 1 is there twice"),
                             (("1 a 0 0 0",), "line 1: expected number, name and color"),
                             (("1 a 0 0 0 x",), "line 1: expected"), (("-1 a 0 0 0 0",), "line 1: expected"),
                             (('1 "a 0 0 0 0',), "line 1: expected"), (('1 0 0 0 1 1 1 ""',), "line 1: expected"),
                             (("1 a 0 0 0 0", "\0\1\2"), "line 2: expected"), (("# nothing",), "has no labels")):
            bad = self.table("bad.txt", *lines)
            run = self.fails(path, "--label-table", bad, "--labels", "a=1", words=f"{bad}: {words}")
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        for missing in (WORK / "none.txt", WORK):
            self.fails(path, "--label-table", missing, "--labels", "a=1", words=f"{missing}: cannot be read")

    def test_labels_of_freesurfer(self):
        """Groups have fixed numbers; labels in no group are named, and left out."""
        x, y, z = np.meshgrid(*(2 * np.arange(n) - n + 1. for n in (40, 44, 36)), indexing="ij")
        radius = np.sqrt((x / 34)**2 + (y / 38)**2 + (z / 30)**2)
        values = np.select([radius < 0.3, radius < 0.7, radius < 0.95, radius < 1], [4, 2, 3, 258], 0).astype(np.int16)
        values[x > 0] = np.select([values[x > 0] == v for v in (4, 2, 3)], [43, 41, 2007], values[x > 0])
        values[(values == 2) & (z < -14)] = 251
        values[(values == 3) & (z < -22)] = 16
        path = self.image("aseg.nii.gz", values, affine((2, 2, 2)))
        table = self.table("lut.txt", "258 Head 0 0 0 0")
        told, run = self.mesh(path, "--labels", "freesurfer", "--label-table", table, "--vertices", 3000)
        self.assertIn(f"warning: {path}: labels that --labels freesurfer has in no group are left out: 258 (Head)\n",
                      run.stderr)
        groups = {"white_matter": (1, (2, 41, 251)), "gray_matter": (2, (3, 2007)), "ventricles": (3, (4, 43)),
                  "brain_stem": (5, (16,))}
        self.assertEqual([s["name"] for s in told["subdomains"]], list(groups))
        for subdomain in told["subdomains"]:
            index, numbers = groups[subdomain["name"]]
            self.assertEqual(subdomain["index"], index)
            self.assertEqual(subdomain["voxels"], "with the labels " + ",".join(map(str, numbers)))
            volume = 8 * np.count_nonzero(np.isin(values, numbers))
            self.assertAlmostEqual(subdomain["volume of surface"] / volume, 1, delta=0.03)
        one = self.image("one.nii", np.where((values == 2) | (values == 251), values, 0), affine((2, 2, 2)))
        told, run = self.mesh(one, "--labels", "freesurfer", "--vertices", 500)
        self.assertEqual(told["inputs"]["surface"]["voxels"], "with the labels 2,251")
        self.assertEqual([s["name"] for s in told["subdomains"]], ["white_matter"])
        self.assertAlmostEqual(told["subdomains"][0]["ratio of volumes"], 1, delta=0.05)
        other = self.image("other.nii", np.where(values == 258, 258, 0).astype(np.int16), affine((2, 2, 2)))
        self.output.unlink()
        self.fails(other, "--labels", "freesurfer", words=f"{other}: has no labels of --labels freesurfer, only 258")

    def small_brain(self):
        """White matter with two holes, gray matter at one side of it, a label that is not meshed, and its image."""
        spacing = np.array((2, 2.4, 3))
        x, y, z = np.meshgrid(*(s * (np.arange(n) - (n - 1) / 2) for s, n in zip(spacing, (34, 30, 24))), indexing="ij")
        radius = np.sqrt(x**2 + y**2 + z**2)
        values = np.where(radius < 22, np.where(x > 6, 2, 1), 0).astype(np.int16)
        values[np.sqrt((x + 8)**2 + y**2 + z**2) < 8] = 0
        values[(np.abs(y) < 3) & (np.abs(z) < 4) & (x > 0)] = 0  # is open
        values[(np.abs(z) > 20) & (np.abs(z) < 26) & (radius < 30)] = 9
        return values, self.image("brain.nii.gz", values, affine(spacing, rotation(0.3, 0.5))), spacing

    @staticmethod
    def near(mask, spacing, distance):
        """The voxels up to a distance from a mask, by brute force."""
        result = np.zeros_like(mask)
        reach = [int(distance / s) for s in spacing]
        for i, j, k in np.ndindex(*(2 * r + 1 for r in reach)):
            step = np.array((i, j, k)) - reach
            if np.linalg.norm(step * spacing) > distance * (1 + 1e-9):
                continue
            to = tuple(slice(max(s, 0), n + min(s, 0)) for s, n in zip(step, mask.shape))
            source = tuple(slice(max(-s, 0), n + min(-s, 0)) for s, n in zip(step, mask.shape))
            result[to] |= mask[source]
        return result

    @staticmethod
    def enclosed(mask):
        """The voxels outside of a mask that no way leads to from the border, by brute force."""
        outside = np.zeros(np.add(mask.shape, 2), bool)
        walls = np.pad(mask, 1)
        outside[0], outside[-1], outside[:, 0], outside[:, -1], outside[:, :, 0], outside[:, :, -1] = (True,) * 6
        while True:
            grown = outside.copy()
            for step in np.ndindex(2, 2, 2):
                for sign in (1, -1):
                    grown |= np.roll(outside, sign * np.array(step), (0, 1, 2)) & ~walls
            if (grown == outside).all():
                return ~(outside | walls)[1:-1, 1:-1, 1:-1]
            outside = grown

    def test_layers(self):
        """Labels grow into what is 0, first those of the first option; holes are filled afterwards."""
        values, path, spacing = self.small_brain()
        volume_of_voxel, coarse = np.prod(spacing), ("--vertices", 800, "--no-fit")
        expected = values.copy()
        expected[(expected == 0) & self.near(expected == 2, spacing, 4)] = 2
        grown = np.count_nonzero(expected == 2) - np.count_nonzero(values == 2)
        fluid = (expected == 0) & self.near(np.isin(expected, (1, 2)), spacing, 5)
        expected[fluid] = 3
        holes = (expected == 0) & self.enclosed(np.isin(expected, (1, 2, 3)))
        self.assertTrue(grown > 100 and fluid.sum() > 1000 and holes.sum() > 5, (grown, fluid.sum(), holes.sum()))
        expected[holes] = 4
        told, run = self.mesh(path, "--labels", "white=1,gray=2", "--fill", "csf", "--grow", "GRAY=4", "--grow", "fluid=5",
                              "--vertices", 2000)
        self.assertEqual(told["inputs"]["surface"]["layers"],
                         [{"name": "gray", "distance": 4, "voxels": grown, "new": False},
                          {"name": "fluid", "distance": 5, "voxels": int(fluid.sum()), "new": True},
                          {"name": "csf", "distance": None, "voxels": int(holes.sum()), "new": True}])
        self.assertIn(f"image: fluid, around all labels by 5 mm: {fluid.sum()} voxels\n", run.stdout)
        self.assertNotIn("cut off", run.stderr)
        for subdomain in told["subdomains"]:
            volume = np.count_nonzero(expected == subdomain["index"]) * volume_of_voxel
            self.assertAlmostEqual(subdomain["volume of surface"] / volume, 1, delta=0.03, msg=subdomain["name"])
        self.assertEqual([s["name"] for s in told["subdomains"]][:3], ["white", "gray", "fluid"])
        # a hole becomes a label that there is, and a new name with 'each' gets the next number
        told, run = self.mesh(path, "--labels", "each", "--fill", "LABEL_2", "--grow", "skin=3", *coarse)
        self.assertEqual({s["name"]: s["index"] for s in told["subdomains"]},
                         {"label_1": 1, "label_2": 2, "label_9": 9, "skin": 10})
        skin = (values == 0) & self.near(values != 0, spacing, 3)
        all_filled = self.enclosed((values != 0) | skin)
        self.assertEqual([layer["voxels"] for layer in told["inputs"]["surface"]["layers"]], [skin.sum(), all_filled.sum()])
        # after completion: a layer around the hull
        told, run = self.mesh(path, "--labels", "white=1,gray=2", "--hull", "--close", 6, "--grow", "fluid=3", *coarse)
        layer, = told["inputs"]["surface"]["layers"]
        self.assertLess(layer["voxels"], skin.sum())
        # the border of the image
        told, run = self.mesh(path, "--labels", "white=1,gray=2", "--grow", "fluid=20", *coarse)
        self.assertIn(f"warning: {path}: fluid, grown by 20 mm, is cut off at the border of the image\n", run.stderr)

    def test_bad_layers(self):
        values, path, spacing = self.small_brain()
        for text in ("fluid", "fluid=", "fluid=0", "fluid=-1", "fluid=nan", "=2", "all=2", "a b=2"):
            self.fails(path, "--labels", "each", "--grow", text, words=f"--grow {text}: ", status=2)
        self.fails(path, "--labels", "each", "--fill", "3", words="--fill 3: a name has", status=2)
        for labels_option in ((), ("--labels", "1-2"), ("--threshold", "1")):
            self.fails(path, *labels_option, "--grow", "a=2", words="--grow: needs --labels with names", status=2)
            self.fails(path, *labels_option, "--fill", "a", words="--fill: needs --labels with names", status=2)
        self.fails(path, "--labels", "a=1", "--sheet", f"b={path}", "--grow", "B=2", words="the name is taken", status=2)
        self.fails(path, "--labels", "a=1", "--grow", "b=1000", words="is more than 100 voxels wide, see --grow")
        self.fails(path, "--labels", "a=1", "--grow", "b=1.9", words=f"{path}: --grow b: there are no voxels of 0 that near")
        self.fails(path, "--labels", "a=9", "--fill", "b", words=f"{path}: --fill b: there are no voxels of 0 that the labels")

    def test_bad_input(self):
        path = self.image("labels.nii", labels(), AFFINES["oblique"])
        for text in ("", "a", "1-", "-1", "3-1", "1,,2", "1,", "1.5", "99999999999"):
            self.fails(path, "--labels", text, "--vertices", 500, words="--labels", status=2)
            self.fails(path, "--region-labels", text, "--vertices", 500, words="--region-labels", status=2)
        self.fails(path, "--region-labels", f"{LESION}:0", "--vertices", 500, words="is not a number from", status=2)
        for text in ("a=", "=1", "a=1,b", "a=1,b=", "1,a=2", "a=1,"):
            self.fails(path, "--labels", text, "--vertices", 500, words="--labels", status=2)
        self.fails(path, "--labels", "a b=1", "--vertices", 500, words="a name has up to 24", status=2)
        self.fails(path, "--labels", "a=1,a=2", "--vertices", 500, words="the name is taken", status=2)
        self.fails(path, "--labels", "a=7,b=5", "--vertices", 500, words="there are no voxels with the labels 5")
        self.fails(path, "--labels", 1, "--threshold", 1, "--vertices", 500, words="--threshold", status=2)
        self.fails(path, "--threshold", "nan", "--vertices", 500, words="--threshold", status=2)
        self.fails(path, "--smoothing", -1, "--vertices", 500, words="--smoothing", status=2)
        self.fails(path, "--smoothing", 1e9, "--vertices", 500, words="is more than 100 voxels wide, see --smoothing")
        needles = self.image("needles.nii", labels(), affine((1e-5, 1, 1)))
        self.fails(needles, "--vertices", 500, words=f"{needles}: smoothing by 1 mm is more than 100 voxels")
        self.fails(path, "--labels", 4, "--vertices", 500, words=f"{path}: there are no voxels with the labels 4")
        surface = WORK / "surface.off"
        surface.write_text("OFF\n")
        self.fails(surface, "--labels", 1, "--vertices", 500, words="need an image", status=2)
        truncated = WORK / "truncated.nii"
        truncated.write_bytes(path.read_bytes()[:1000])
        self.fails(truncated, "--vertices", 500, words=str(truncated))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
