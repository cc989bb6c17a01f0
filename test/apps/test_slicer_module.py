#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The module for 3D Slicer, with the programs as they are and a stub of Slicer: not a test inside Slicer.

  test_slicer_module.py MESHER BRAIN_SHIFT DATA_DIRECTORY WORK_DIRECTORY

The stub has the functions that the module calls, and does what documentation and sources of Slicer tell of
them: a field in a file is the transform from parent, in LPS; the export of segments crops the image to these.
"""

import contextlib
import gzip
import pathlib
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from unittest import mock

try:
    import nibabel
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

MESHER, BRAIN_SHIFT, DATA, WORK = (pathlib.Path(argument).resolve() for argument in sys.argv[1:5])
SOURCE = DATA.parent


class Node:
    """A node of any class: a method GetX() returns the member X."""

    def __init__(self, kind, name="", **members):
        self.kind = kind
        self.members = {"Name": name, "ParentTransformNode": None, "DisplayNode": None, **members}

    def __getattr__(self, method):
        if not method.startswith("Get") or method[3:] not in self.members:
            raise AttributeError(method)
        return lambda: self.members[method[3:]]

    def IsA(self, kind):
        return self.kind == kind

    def SetAndObserveMesh(self, mesh):
        self.members["Mesh"] = self.members["PolyData"] = mesh

    SetAndObservePolyData = SetAndObserveMesh

    def CreateDefaultDisplayNodes(self):
        pass


class Scene(list):
    def AddNewNodeByClass(self, kind, name=""):
        self.append(Node(kind, name))
        return self[-1]

    def RemoveNode(self, node):
        self.remove(node)


def export_segments(segmentation, identifiers, labels):
    merged = np.zeros_like(next(iter(segmentation.voxels.values())), np.uint8)
    for i in range(identifiers.GetNumberOfValues()):
        merged[segmentation.voxels[identifiers.GetValue(i)]] = i + 1
    low, high = np.argwhere(merged).min(0), np.argwhere(merged).max(0) + 1
    labels.voxels = merged[tuple(slice(a, b) for a, b in zip(low, high))]
    labels.affine = segmentation.affine.copy()
    labels.affine[:3, 3] += labels.affine[:3, :3] @ low
    colors = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLColorTableNode")
    labels.members["DisplayNode"] = Node("vtkMRMLLabelMapVolumeDisplayNode", ColorNode=colors)
    return True


def closed_surface(segmentation, identifier, polygons):
    polygons.DeepCopy(segmentation.surfaces[identifier])
    return True


def export_node(node, path, properties, world):
    nibabel.save(nibabel.Nifti1Image(node.voxels, node.affine), path)
    return world


def load_volume(path):
    image = nibabel.load(path)
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLScalarVolumeNode")
    node.voxels, node.affine = np.asarray(image.dataobj), image.affine
    return node


def load_transform(path):
    """The function from parent of a field: points and vectors are LPS in the file, and RAS in Slicer."""
    header, data = pathlib.Path(path).read_bytes().split(b"\n\n", 1)
    entries = dict(line.split(": ", 1) for line in header.decode().splitlines()[1:])
    vector = lambda text: [float(x) for x in text.strip("()").split(",")]
    assert entries["space"] == "left-posterior-superior" and entries["sizes"].startswith("3 ")
    size = [int(n) for n in entries["sizes"].split()][1:]
    field = np.frombuffer(gzip.decompress(data), "<f4").reshape(size[::-1] + [3])
    axes = np.array([vector(text) for text in entries["space directions"].split()[1:]]).T
    lps = np.array([-1, -1, 1])

    def from_parent(points):
        at = np.linalg.solve(axes, (points * lps - vector(entries["space origin"])).T).T
        at = np.clip(at, 0, np.array(size) - 1.001)
        cell, result = np.floor(at).astype(int), np.array(points, float)
        for corner in np.ndindex(2, 2, 2):
            weight = np.prod(np.where(corner, at - cell, 1 - at + cell), axis=1)
            result += lps * weight[:, None] * field[tuple((cell + corner).T[::-1])]
        return result

    return from_parent


def stub():
    """The modules slicer, qt and ctk. Widgets accept everything."""
    widgets = lambda: mock.MagicMock(side_effect=lambda *arguments: mock.MagicMock())
    logic = types.SimpleNamespace(ExportSegmentsToLabelmapNode=export_segments,
                                  GetSegmentClosedSurfaceRepresentation=closed_surface)
    launch = lambda args: subprocess.Popen(args, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    util = types.SimpleNamespace(
        launchConsoleProcess=launch, tempDirectory=lambda key: tempfile.mkdtemp(prefix=key, dir=WORK),
        exportNode=export_node, arrayFromMarkupsControlPoints=lambda node, world: node.points,
        loadTransform=load_transform, loadVolume=load_volume, loadLabelVolume=load_volume,
        settingsValue=lambda key, default: str(MESHER.parent),
        tryWithErrorDisplay=lambda *arguments, **options: contextlib.nullcontext())
    bases = types.ModuleType("slicer.ScriptedLoadableModule")
    members = {"__init__": lambda self, parent=None: None, "setup": lambda self: None}
    for name in ("", "Logic", "Widget"):
        setattr(bases, f"ScriptedLoadableModule{name}", type("Base", (), members))
    bases.ScriptedLoadableModuleTest = unittest.TestCase
    slicer = types.ModuleType("slicer")
    segmentations = types.SimpleNamespace(logic=lambda: logic)
    slicer.__dict__.update(util=util, mrmlScene=Scene(), vtkSlicerSegmentationsModuleLogic=logic,
                           modules=types.SimpleNamespace(segmentations=segmentations),
                           qMRMLNodeComboBox=widgets(), qMRMLSegmentSelectorWidget=widgets())
    qt, ctk = mock.MagicMock(), mock.MagicMock()
    qt.QDoubleSpinBox = widgets()  # several, each with a value of its own
    sys.modules.update({"slicer": slicer, "slicer.ScriptedLoadableModule": bases, "qt": qt, "ctk": ctk})
    return slicer


slicer = stub()
sys.path.insert(0, str(SOURCE / "python" / "slicer"))
import MixedMesh3 as module  # noqa: E402


def read_surface(name):
    words = (DATA / name).read_text().split()
    n, m = int(words[1]), int(words[2])
    points, cells, surface = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
    for p in np.array(words[4:4 + 3 * n], float).reshape(n, 3):
        points.InsertNextPoint(p)
    for face in np.array(words[4 + 3 * n:4 + 3 * n + 4 * m], int).reshape(m, 4):
        cells.InsertNextCell(3, face[1:])
    surface.SetPoints(points)
    surface.SetPolys(cells)
    return surface


def voxels_inside(surface, affine, shape):
    matrix, turn, mover = vtk.vtkMatrix4x4(), vtk.vtkTransform(), vtk.vtkTransformPolyDataFilter()
    matrix.DeepCopy(np.linalg.inv(affine).ravel())
    turn.SetMatrix(matrix)
    mover.SetTransform(turn)
    mover.SetInputData(surface)
    stencil, image = vtk.vtkPolyDataToImageStencil(), vtk.vtkImageStencilToImage()
    stencil.SetInputConnection(mover.GetOutputPort())
    stencil.SetOutputWholeExtent(0, shape[0] - 1, 0, shape[1] - 1, 0, shape[2] - 1)
    image.SetInputConnection(stencil.GetOutputPort())
    image.Update()
    return vtk_to_numpy(image.GetOutput().GetPointData().GetScalars()).reshape(shape[::-1]).T > 0


class SlicerModule(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        surfaces = {name: read_surface(f"{name}.off") for name in ("brain", "tumour", "region")}
        cls.models = {name: Node("vtkMRMLModelNode", name, PolyData=s) for name, s in surfaces.items()}
        # An oblique image around the brain, whose axes are near to those of LPS, as Slicer's are.
        turn = vtk.vtkTransform()
        turn.RotateWXYZ(25, 1, 2, 3)
        rotation = np.array([[turn.GetMatrix().GetElement(i, j) for j in range(3)] for i in range(3)])
        cls.affine, shape = np.eye(4), (54, 54, 52)
        cls.affine[:3, :3] = rotation @ np.diag([-4., -4.2, 4.4])
        cls.affine[:3, 3] = surfaces["brain"].GetCenter() - cls.affine[:3, :3] @ (np.array(shape) / 2)
        cls.segmentation = Node("vtkMRMLSegmentationNode", "Segmentation")
        cls.segmentation.affine, cls.segmentation.surfaces = cls.affine, surfaces
        cls.segmentation.voxels = {name: voxels_inside(s, cls.affine, shape) for name, s in surfaces.items()}
        # Values that tell where a voxel was before, by their gradient.
        cls.gradient = np.array([1.5, -0.5, 2.])
        world = np.einsum("ij,jxyz->xyzi", cls.affine[:3, :3], np.indices(shape)) + cls.affine[:3, 3]
        cls.image = Node("vtkMRMLScalarVolumeNode", "image")
        cls.image.voxels, cls.image.affine = (1000 + world @ cls.gradient).astype(np.float32), cls.affine
        table = np.loadtxt(DATA / "control_points.csv", delimiter=",", comments=("#", "x"))
        cls.before, cls.after = (Node("vtkMRMLMarkupsFiducialNode", name) for name in ("before", "after"))
        cls.before.points, cls.after.points = table[:, :3], table[:, :3] + table[:, 3:]

    def setUp(self):
        slicer.mrmlScene.clear()
        self.logic = module.MixedMesh3Logic(MESHER.parent)

    def run_job(self, command):
        lines, status = module.Job(command).wait()
        self.assertEqual(status, 0, lines)
        return lines

    def test_segments(self):
        """Segments of an oblique image: mesh, shift, image and transform are where Slicer has the brain."""
        command = self.logic.mesh_command((self.segmentation, "brain"), (self.segmentation, "tumour"),
                                          (self.segmentation, "region"), 660)
        self.assertEqual(slicer.mrmlScene, [])  # the image of labels and its colors are gone
        self.run_job(command)
        report = self.logic.report("mesh")
        self.assertEqual([s["name"] for s in report["subdomains"]], ["brain", "tumor"])
        mesh = self.logic.load_results("mesh")["mesh.vtu"].GetMesh()
        self.assertTrue(0.9 * 660 < mesh.GetNumberOfPoints() <= 660)
        brain, tumor = (self.models[name].GetPolyData() for name in ("brain", "tumour"))
        self.assertLess(np.abs(np.subtract(mesh.GetBounds(), brain.GetBounds())).max(), 5)
        labels = vtk_to_numpy(mesh.GetCellData().GetArray("subdomain"))
        bounds = np.array([mesh.GetCell(cell).GetBounds() for cell in np.nonzero(labels == 2)[0]])
        center = np.median(bounds[:, ::2] + bounds[:, 1::2], axis=0) / 2
        self.assertLess(np.linalg.norm(center - tumor.GetCenter()), 6)

        points = self.logic.write_points(self.before, self.after)
        image = self.logic.write_volume(self.image, "image.nii.gz")
        numbers = {"--young-modulus": 2.0, "--control-radius": 12.0}
        self.run_job(self.logic.shift_command(points, image, numbers, 5.0))
        nodes = self.logic.load_results("shift")
        self.assertEqual(sorted(nodes), ["shift.vtu", "shift_deformed.vtu", "shift_image.nii.gz",
                                         "shift_image_backward.nrrd", "shift_image_mask.nii.gz"])
        self.assertEqual(self.logic.report("shift")["parameters"]["Young's modulus"]["value"], 2)
        told = np.array([p["displacement"] for p in self.logic.report("shift")["shift"]["control points"]])
        self.assertLess(np.linalg.norm(self.before.points + told - self.after.points, axis=1).max(), 2.5)

        # The transform from parent takes a displaced vertex to where it was; the other choices do not.
        grid = nodes["shift.vtu"].GetMesh()
        x = vtk_to_numpy(grid.GetPoints().GetData())
        u = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
        moved = np.linalg.norm(u, axis=1) > 3
        x, u = x[moved], u[moved]
        self.assertGreater(len(x), 20)
        error = lambda f: np.median(np.linalg.norm(f(x + u) - x, axis=1))
        from_parent = nodes["shift_image_backward.nrrd"]
        self.assertLess(error(from_parent), 0.3)
        back = from_parent(self.before.points + told)
        self.assertLess(np.linalg.norm(back - self.before.points, axis=1).max(), 2.5)  # of 10 mm, at a dent
        self.assertGreater(error(load_transform(self.logic.folder / "shift_image_forward.nrrd")), 3)
        flip = np.array([-1, -1, 1])
        self.assertGreater(error(lambda p: flip * from_parent(flip * p)), 3)
        # The image that is loaded is the one that Slicer would resample by that transform.
        tissue = np.argwhere(nodes["shift_image_mask.nii.gz"].voxels == 1)
        self.assertTrue(np.allclose(nodes["shift_image.nii.gz"].affine, self.affine, atol=1e-4))
        at = tissue @ self.affine[:3, :3].T + self.affine[:3, 3]
        values = nodes["shift_image.nii.gz"].voxels[tuple(tissue.T)]
        self.assertLess(np.abs(1000 + from_parent(at) @ self.gradient - values).max(), 0.05)
        self.assertGreater(np.abs(1000 + at @ self.gradient - values).max(), 5)

    def test_models(self):
        """Models and a turned box as the region; the tumor is resected, and the mesh is small in the box."""
        matrix, turn = vtk.vtkMatrix4x4(), vtk.vtkTransform()
        turn.Translate(36, 24, 50)
        turn.RotateZ(30)
        matrix.DeepCopy(turn.GetMatrix())
        box = Node("vtkMRMLMarkupsROINode", "R", Size=(30, 20, 40), ObjectToWorldMatrix=matrix)
        bounds = self.logic.surface_of((box, None)).GetBounds()
        for i, half in enumerate((15 * 3**0.5 / 2 + 5, 7.5 + 5 * 3**0.5, 20)):
            self.assertAlmostEqual(bounds[2 * i], (36, 24, 50)[i] - half, 4)
        self.run_job(self.logic.mesh_command((self.models["brain"], None), (self.models["tumour"], None),
                                             (box, None), 660))
        self.assertGreater(self.logic.report("mesh")["mesh"]["share of vertices in region"], 0.15)
        self.run_job(self.logic.shift_command(DATA / "control_points.csv", resect=True))
        self.assertGreater(self.logic.report("shift")["resection"]["elements removed"], 0)
        self.assertEqual(sorted(self.logic.load_results("shift")), ["shift.vtu", "shift_deformed.vtu"])

    def test_refused(self):
        fewer = Node("vtkMRMLMarkupsFiducialNode", "fewer")
        fewer.points = self.before.points[:3]
        under = Node("vtkMRMLModelNode", "under", ParentTransformNode=Node("vtkMRMLTransformNode"))
        elsewhere = module.MixedMesh3Logic(DATA)
        for words, call, *arguments in (
                ("^fewer: has 3 points, but before has 4$", self.logic.write_points, self.before, fewer),
                ("^under: is under a transform", self.logic.mesh_command, (under, None)),
                ("^under: the same is picked", self.logic.mesh_command, (under, None), (under, None)),
                ("mesh.vtu: there is no such file", self.logic.shift_command, "points.csv"),
                ("data: there is no program mixed_mesh_3$", elsewhere.program, "mixed_mesh_3")):
            with self.assertRaisesRegex(ValueError, words):
                call(*arguments)
        # What a program refuses is in the log.
        (self.logic.folder / "mesh.vtu").write_text("nothing")
        lines, status = module.Job(self.logic.shift_command(DATA / "control_points.csv")).wait()
        self.assertEqual((status, len(lines)), (1, 1))
        self.assertIn("mesh.vtu", lines[0])

    def test_cancel(self):
        job = module.Job(self.logic.mesh_command((self.models["brain"], None), vertices=200000))
        self.assertIsNone(job.poll()[1])
        job.cancel()
        self.assertNotEqual(job.wait()[1], 0)
        self.assertFalse((self.logic.folder / "mesh.vtu").exists())

    def test_defaults(self):
        """The numbers of the panel are the defaults that the programs tell."""
        told = lambda program: subprocess.run([program, "--help"], capture_output=True, text=True).stdout
        for option, _, default, *_ in module.SHIFT_NUMBERS:
            self.assertRegex(told(BRAIN_SHIFT), rf"{option} \w+={default:g} ")
        self.assertRegex(told(MESHER), rf"(?s)--vertices N.*?default: {module.VERTICES}\)")

    def test_panel(self):
        """The names in the panel fit together, from the buttons to the results. Widgets accept everything."""
        panel = module.MixedMesh3Widget()
        panel.layout = mock.MagicMock()
        panel.setup()
        for name, (segments, nodes) in panel.pickers.items():
            segments.currentNode.return_value = None
            nodes.currentNode.return_value = self.models["brain"] if name == "brain" else None
        panel.before.currentNode.return_value, panel.after.currentNode.return_value = self.before, self.after
        panel.image.currentNode.return_value = None
        panel.vertices.value, panel.resect.checked = 300, False
        for run, wanted in ((panel.on_mesh, "mesh.vtu"), (panel.on_shift, "shift_1_deformed.vtu")):
            run()
            while panel.job:
                panel.on_timer()
            self.assertEqual(slicer.mrmlScene[-1].GetName() + ".vtu", wanted)
        panel.cleanup()
        module.MixedMesh3(mock.MagicMock())
        module.MixedMesh3Test("runTest").debug()  # what Reload and Test of Slicer runs


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
