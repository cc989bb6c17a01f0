# SPDX-License-Identifier: GPL-3.0-or-later
"""A module for 3D Slicer that meshes a brain and shifts it, by the programs mixed_mesh_3 and brain_shift.

Slicer finds the module if the folder of this file is one of Edit > Application Settings > Modules >
Additional module paths. The module has been tested against a stub of Slicer's functions
(test/apps/test_slicer_module.py), and has not been tried inside Slicer.

Files for the programs are written in right, anterior, superior, and millimeters: these are Slicer's
coordinates, and those that the programs assume for a file that names no space.
"""

import csv
import json
import pathlib
import queue
import shutil
import threading
import time

import ctk
import qt
import slicer
import vtk
from slicer.ScriptedLoadableModule import (ScriptedLoadableModule, ScriptedLoadableModuleLogic,
                                           ScriptedLoadableModuleTest, ScriptedLoadableModuleWidget)

HELP = """
Makes a finite-element mesh of a brain, with few vertices, fine in a region of interest, and computes how the
brain moves with points whose displacement is measured. The programs <code>mixed_mesh_3</code> and
<code>brain_shift</code> have to be installed.
<p><b>This module has been tested with a stub of Slicer's functions only. It has not been tried inside
Slicer.</b></p>
<p>Mesh: pick a segment or a model of the brain. A tumor becomes a part of the mesh with its own stiffness;
cells are small in the region.</p>
<p>Shift: pick the landmarks before and after, or a table with the columns x,y,z,dx,dy,dz, in mm and RAS. The
image, if there is one, is deformed, and its displacement field becomes a transform. Put whatever shall follow
the shift under this transform: volumes, models or markups.</p>
"""

# Numbers that brain_shift takes: option, text, default of the program, smallest and largest value, decimals.
SHIFT_NUMBERS = (
    ("--young-modulus", "Young's modulus of the brain (kPa)", 1.0, 0.001, 1e6, 3),
    ("--poisson-ratio", "Poisson's ratio", 0.45, 0.0, 0.499, 3),
    ("--control-radius", "Radius of a control point (mm)", 0.0, 0.0, 100.0, 1),
    ("--fixed-below", "Fixed lower part of the height", 0.3, 0.0, 1.0, 2),
    ("--max-distance", "Largest distance of a point outside the mesh (mm)", 5.0, 0.0, 100.0, 1),
)
VERTICES = 2000  # the default of mixed_mesh_3
FOLDER_SETTING = "MixedMesh3/ProgramFolder"


class MixedMesh3(ScriptedLoadableModule):
    """What Slicer lists."""

    def __init__(self, parent):
        ScriptedLoadableModule.__init__(self, parent)
        parent.title = "Mixed Mesh 3"
        parent.categories = ["Finite Elements"]
        parent.contributors = ["The Mixed_mesh_3 authors"]
        parent.helpText = HELP
        parent.acknowledgementText = "The method is that of Lobos, Bucki, Hitschfeld and Payan, IMR 2007."


class Job:
    """A program that runs beside Slicer. A thread reads its output, because reading would block Slicer."""

    def __init__(self, command):
        # Environment of the program: that which Slicer was started with. With Slicer's own, the program would
        # load Slicer's libraries.
        self._process = slicer.util.launchConsoleProcess([str(part) for part in command])
        self._lines = queue.Queue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        # Bytes, because a path that is not in the encoding of the locale would end the reading of text.
        with self._process.stdout as output:
            for line in output.buffer:
                self._lines.put(line.decode(errors="replace").rstrip())

    def poll(self):
        """The lines printed since the last call, and the exit status: None while the program runs."""
        has_ended = not self._reader.is_alive()  # asked first: no line is added after that
        lines = []
        while not self._lines.empty():
            lines.append(self._lines.get_nowait())
        return lines, self._process.wait() if has_ended else None

    def cancel(self):
        """Ends the program, which leaves no file that is not complete."""
        self._process.terminate()

    def wait(self):
        """All lines and the exit status, for scripts."""
        lines, status = self.poll()
        while status is None:
            time.sleep(0.05)
            more, status = self.poll()
            lines += more
        return lines, status


class MixedMesh3Logic(ScriptedLoadableModuleLogic):
    """Inputs are written to a folder, commands are made, outputs are loaded.

    A *source* of a surface is a pair: a segmentation and the identifier of a segment, or a model or ROI and
    None. Refused input is a ValueError with one line.
    """

    def __init__(self, programs="", folder=None):
        """Takes the folder of the programs, or nothing for those on PATH; and the folder to write to."""
        ScriptedLoadableModuleLogic.__init__(self)
        self.programs = programs
        self.folder = pathlib.Path(folder or slicer.util.tempDirectory("MixedMesh3_"))

    def program(self, name):
        path = shutil.which(name, path=str(self.programs) if self.programs else None)
        if path is None:
            raise ValueError(f"{self.programs or 'PATH'}: there is no program {name}")
        return path

    # Inputs

    def surface_of(self, source):
        """The surface of a source, as triangles in world coordinates."""
        node, segment = source
        polygons = vtk.vtkPolyData()
        if segment:  # takes the transform of the segmentation into account
            logic = slicer.vtkSlicerSegmentationsModuleLogic
            if not logic.GetSegmentClosedSurfaceRepresentation(node, segment, polygons):
                raise ValueError(f"{node.GetName()}: the segment {segment} has no closed surface")
        elif node.IsA("vtkMRMLMarkupsROINode"):
            box, turn, mover = vtk.vtkCubeSource(), vtk.vtkTransform(), vtk.vtkTransformPolyDataFilter()
            for set_length, length in zip((box.SetXLength, box.SetYLength, box.SetZLength), node.GetSize()):
                set_length(length)
            turn.SetMatrix(node.GetObjectToWorldMatrix())
            mover.SetInputConnection(box.GetOutputPort())
            mover.SetTransform(turn)
            mover.Update()
            polygons = mover.GetOutput()
        else:
            if node.GetParentTransformNode() is not None:
                raise ValueError(f"{node.GetName()}: is under a transform; harden the transform first")
            if node.GetPolyData() is None:
                raise ValueError(f"{node.GetName()}: is no surface")
            polygons = node.GetPolyData()
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputData(polygons)
        triangles.PassLinesOff()
        triangles.PassVertsOff()
        triangles.Update()
        return triangles.GetOutput()

    def write_surface(self, source, name):
        writer = vtk.vtkXMLPolyDataWriter()
        writer.SetFileName(str(self.folder / name))
        writer.SetInputData(self.surface_of(source))
        if not writer.Write():
            raise ValueError(f"{self.folder / name}: cannot be written")
        return self.folder / name

    def write_labels(self, segmentation, segments, name):
        """An image with the labels 1, 2, ... for segments; where segments overlap, the later one counts."""
        identifiers = vtk.vtkStringArray()
        for segment in segments:
            identifiers.InsertNextValue(segment)
        labels = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLLabelMapVolumeNode")
        try:
            logic = slicer.modules.segmentations.logic()
            if not logic.ExportSegmentsToLabelmapNode(segmentation, identifiers, labels):
                raise ValueError(f"{segmentation.GetName()}: segments cannot be exported")
            return self.write_volume(labels, name)
        finally:
            if labels.GetDisplayNode():  # Slicer makes a table of colors for the labels
                slicer.mrmlScene.RemoveNode(labels.GetDisplayNode().GetColorNode())
            slicer.mrmlScene.RemoveNode(labels)

    def write_volume(self, volume, name):
        path = self.folder / name
        # Export, because saving would change the file that the scene has for the node. A dictionary is given,
        # because exportNode() changes its default argument.
        if not slicer.util.exportNode(volume, str(path), {}, world=True):
            raise ValueError(f"{path}: cannot be written")
        return path

    def write_points(self, before, after, name="points.csv"):
        """The control points of two lists of fiducials, of the same points in the same order."""
        p, q = (slicer.util.arrayFromMarkupsControlPoints(node, world=True) for node in (before, after))
        if len(p) != len(q):
            raise ValueError(f"{after.GetName()}: has {len(q)} points, but {before.GetName()} has {len(p)}")
        if len(p) == 0:
            raise ValueError(f"{before.GetName()}: has no points")
        with open(self.folder / name, "w", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(["x", "y", "z", "dx", "dy", "dz"])
            table.writerows([*map(float, a), *map(float, b - a)] for a, b in zip(p, q))
        return self.folder / name

    # Commands

    def mesh_command(self, brain, tumor=None, region=None, vertices=VERTICES):
        """Writes the sources, and returns the command that makes mesh.vtu and mesh.json of them.

        The tumor is the subdomain `tumor`. Segments of one segmentation become an image of labels, so that
        their surfaces have common triangles; other sources become a surface each.
        """
        if tumor == brain:
            raise ValueError(f"{brain[0].GetName()}: the same is picked for brain and tumor")
        command = [self.program("mixed_mesh_3")]
        if brain[1] and (tumor is None or (tumor[1] and tumor[0] is brain[0])):
            segments = [source[1] for source in (brain, tumor) if source]
            command += [self.write_labels(brain[0], segments, "labels.nii.gz"), "--labels",
                        "brain=1,tumor=2" if tumor else "brain=1"]
        else:
            command += [self.write_surface(brain, "brain.vtp")]
            if tumor:
                command += ["--subdomain", f"tumor={self.write_surface(tumor, 'tumor.vtp')}"]
        if region:
            command += ["--region", self.write_surface(region, "region.vtp")]
        return command + ["--vertices", vertices, "--output", self.folder / "mesh.vtu", "--report",
                          self.folder / "mesh.json"]

    def shift_command(self, points, image=None, numbers=None, tumor_young_modulus=None, resect=False,
                      name="shift"):
        """The command that moves mesh.vtu with a table of control points.

        The command makes NAME.vtu, NAME_deformed.vtu and NAME.json; with an image also the deformed image
        and the displacement field. `numbers` has values of options of SHIFT_NUMBERS. A stiffness of the
        tumor, and a resection, need a mesh with the subdomain `tumor`.
        """
        mesh = self.folder / "mesh.vtu"
        if not mesh.exists():
            raise ValueError(f"{mesh}: there is no such file; make the mesh first")
        numbers = dict(numbers or {})
        command = [self.program("brain_shift"), mesh, "--control-points", points]
        for option, value in numbers.items():
            command += [option, value]
        if tumor_young_modulus is not None:
            command += ["--material", f"tumor={tumor_young_modulus},{numbers.get('--poisson-ratio', 0.45)}"]
        if resect:
            command += ["--tumor-label", "tumor"]
        if image is not None:
            command += ["--image", image, "--output-image", self.folder / f"{name}_image", "--field", "nrrd"]
        return command + ["--output", self.folder / f"{name}.vtu", "--output-deformed",
                          self.folder / f"{name}_deformed.vtu", "--report", self.folder / f"{name}.json"]

    # Outputs

    def report(self, name):
        """The report on the run of that name."""
        return json.loads((self.folder / f"{name}.json").read_text(encoding="utf-8"))

    def load_results(self, name):
        """Loads what the report of a run lists, and returns the nodes by the names of the files."""
        nodes = {}
        for path in map(pathlib.Path, self.report(name)["outputs"]):
            if path.suffix == ".vtu":
                nodes[path.name] = self.load_mesh(path)
            elif path.name.endswith("_mask.nii.gz"):
                nodes[path.name] = slicer.util.loadLabelVolume(str(path))
            elif path.name.endswith(".nii.gz"):
                nodes[path.name] = slicer.util.loadVolume(str(path))
            elif path.name.endswith("_backward.nrrd"):
                # Field of a file: for Slicer, the transform from parent, here from the deformed place to the
                # one before. Slicer resamples volumes by this transform, and inverts it for points and
                # models, so that the forward field is not needed.
                nodes[path.name] = slicer.util.loadTransform(str(path))
        return nodes

    def load_mesh(self, path):
        # Reader of VTK, because slicer.util.loadModel() takes coordinates for LPS if a file names no space.
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        if reader.GetOutput().GetNumberOfCells() == 0:
            raise ValueError(f"{path}: has no elements")
        node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLModelNode", path.stem)
        node.SetAndObserveMesh(reader.GetOutput())
        node.CreateDefaultDisplayNodes()
        return node


class MixedMesh3Widget(ScriptedLoadableModuleWidget):
    """The panel: what is picked there is given to the logic."""

    def setup(self):
        ScriptedLoadableModuleWidget.setup(self)
        self.job = self.logic = None
        self.has_tumor = False
        self.pickers = {}

        form = self.section("Mesh")
        for name, is_optional in (("brain", False), ("tumor", True), ("region", True)):
            classes = ["vtkMRMLModelNode"] + (["vtkMRMLMarkupsROINode"] if name == "region" else [])
            segments = slicer.qMRMLSegmentSelectorWidget()
            segments.noneEnabled = True
            segments.setMRMLScene(slicer.mrmlScene)
            nodes = self.node_selector(classes)
            optional = ", if there is one" if is_optional else ""
            form.addRow(f"Segment of the {name}{optional}:", segments)
            form.addRow("or model or ROI:" if name == "region" else "or model:", nodes)
            self.pickers[name] = segments, nodes
        self.vertices = qt.QSpinBox()
        self.vertices.setRange(50, 1000000)
        self.vertices.value = VERTICES
        form.addRow("Vertex budget:", self.vertices)
        self.mesh_button = self.button(form, "Mesh", self.on_mesh)

        form = self.section("Shift")
        self.before, self.after = (self.node_selector(["vtkMRMLMarkupsFiducialNode"]) for _ in range(2))
        self.table, self.image = ctk.ctkPathLineEdit(), self.node_selector(["vtkMRMLScalarVolumeNode"])
        form.addRow("Landmarks before:", self.before)
        form.addRow("Landmarks after, in the same order:", self.after)
        form.addRow("or table x,y,z,dx,dy,dz (RAS, mm):", self.table)
        form.addRow("Image before, if there is one:", self.image)
        self.numbers = {option: self.number(form, *rest) for option, *rest in SHIFT_NUMBERS}
        self.tumor_stiffness = self.number(form, "Young's modulus of the tumor (kPa)", 1.0, 0.001, 1e6, 3)
        self.resect = qt.QCheckBox("after the shift")
        form.addRow("Resect the tumor:", self.resect)
        self.shift_button = self.button(form, "Shift", self.on_shift)

        form = self.section("Programs")
        self.programs = ctk.ctkPathLineEdit()
        self.programs.filters = ctk.ctkPathLineEdit.Dirs
        self.programs.currentPath = slicer.util.settingsValue(FOLDER_SETTING, "")
        self.programs.connect("currentPathChanged(QString)",
                              lambda folder: qt.QSettings().setValue(FOLDER_SETTING, folder))
        form.addRow("Folder of the programs (default: PATH):", self.programs)
        self.cancel_button = self.button(form, "Cancel", self.on_cancel)
        self.log = qt.QPlainTextEdit()
        self.log.readOnly = True
        form.addRow(self.log)
        self.timer = qt.QTimer()
        self.timer.setInterval(200)
        self.timer.connect("timeout()", self.on_timer)
        self.set_running(False)

    def section(self, title):
        section = ctk.ctkCollapsibleButton()
        section.text = title
        self.layout.addWidget(section)
        return qt.QFormLayout(section)

    def node_selector(self, classes):
        selector = slicer.qMRMLNodeComboBox()
        selector.nodeTypes = classes
        selector.noneEnabled, selector.addEnabled, selector.removeEnabled = True, False, False
        selector.setMRMLScene(slicer.mrmlScene)
        return selector

    def number(self, form, text, default, smallest, largest, decimals):
        box = qt.QDoubleSpinBox()
        box.setDecimals(decimals)
        box.setRange(smallest, largest)
        box.value = default
        form.addRow(f"{text}:", box)
        return box

    def button(self, form, text, action):
        button = qt.QPushButton(text)
        button.connect("clicked(bool)", lambda _: action())
        form.addRow(button)
        return button

    def source(self, name):
        """What is picked for the brain, the tumor or the region: the segment, else the node, else None."""
        segments, nodes = self.pickers[name]
        if segments.currentNode() and segments.currentSegmentID():
            return segments.currentNode(), segments.currentSegmentID()
        return (nodes.currentNode(), None) if nodes.currentNode() else None

    def on_mesh(self):
        with slicer.util.tryWithErrorDisplay("The mesh cannot be made.", waitCursor=True):
            brain, tumor, region = map(self.source, ("brain", "tumor", "region"))
            if brain is None:
                raise ValueError("Brain: pick a segment or a model")
            # Folder of its own for each mesh, and name of its own for each shift: results in the scene keep
            # their files.
            self.logic, self.shifts = MixedMesh3Logic(self.programs.currentPath), 0
            self.has_tumor = tumor is not None
            self.start("mesh", self.logic.mesh_command(brain, tumor, region, self.vertices.value))

    def on_shift(self):
        with slicer.util.tryWithErrorDisplay("The shift cannot be computed.", waitCursor=True):
            if self.logic is None:
                raise ValueError("Mesh: make the mesh first")
            if self.resect.checked and not self.has_tumor:
                raise ValueError("Tumor: the mesh has no tumor to resect")
            before, after = self.before.currentNode(), self.after.currentNode()
            points = self.table.currentPath
            if before and after:
                points = self.logic.write_points(before, after)
            elif not points:
                raise ValueError("Landmarks: pick those before and after, or a table")
            image = self.image.currentNode()
            self.shifts += 1
            name = f"shift_{self.shifts}"
            self.start(name, self.logic.shift_command(
                points, self.logic.write_volume(image, "image.nii.gz") if image else None,
                {option: box.value for option, box in self.numbers.items()},
                self.tumor_stiffness.value if self.has_tumor else None, self.resect.checked, name))

    def start(self, name, command):
        self.log.appendPlainText(" ".join(map(str, command)))
        self.name, self.job = name, Job(command)
        self.set_running(True)

    def set_running(self, is_running):
        self.mesh_button.enabled = self.shift_button.enabled = not is_running
        self.cancel_button.enabled = is_running
        self.timer.start() if is_running else self.timer.stop()

    def on_timer(self):
        lines, status = self.job.poll()
        for line in lines:
            self.log.appendPlainText(line)
        if status is None:
            return
        self.job = None
        self.set_running(False)
        if status == 0:
            with slicer.util.tryWithErrorDisplay("The results cannot be loaded."):
                self.logic.load_results(self.name)
        else:
            self.log.appendPlainText(f"ended with status {status}: nothing is loaded")

    def on_cancel(self):
        if self.job:
            self.job.cancel()

    def cleanup(self):
        self.on_cancel()
        self.timer.stop()


class MixedMesh3Test(ScriptedLoadableModuleTest):
    """For Reload and Test in Slicer: a ball is meshed, and its mesh is where the ball is."""

    def runTest(self):
        ball = vtk.vtkSphereSource()
        ball.SetCenter(30, 20, 10)
        ball.SetRadius(40)
        ball.SetThetaResolution(32)
        ball.SetPhiResolution(32)
        ball.Update()
        model = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLModelNode", "ball")
        model.SetAndObservePolyData(ball.GetOutput())
        logic = MixedMesh3Logic(slicer.util.settingsValue(FOLDER_SETTING, ""))
        lines, status = Job(logic.mesh_command((model, None), vertices=300)).wait()
        self.assertEqual(status, 0, lines)
        center = logic.load_results("mesh")["mesh.vtu"].GetMesh().GetCenter()
        for x, wanted in zip(center, (30, 20, 10)):
            self.assertAlmostEqual(x, wanted, delta=3)
