#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what brain_shift writes into PNG files: the mesh before, shifted and resected, and the image.

  /usr/bin/python3 scripts/pictures/render_brain_shift.py out/shift.vtu --tumor data/tumour.off \\
      --control-points data/control_points.csv --image IMAGE.nii.gz --warped-image out/shift.nii.gz \\
      --output-prefix out/brain_shift

writes out/brain_shift_before.png, out/brain_shift_shifted.png and out/brain_shift_resected.png (the mesh cut
open along the way from the control points to the tumor), and, if images are given,
out/brain_shift_image.png (a slice of the image there, before and after, and their difference). Elements have the color
of their subdomain if there are several.

Bars are lengths in mm. Letters are directions: R, L, A, P, S and I for right, left, front (anterior), back (posterior),
top (superior) and bottom (inferior); the nearest one comes first.

Needs what render_mesh.py beside it needs.
"""

import argparse
import math
import os
import sys

sys.dont_write_bytecode = True  # no files beside the scripts
import render_mesh
from render_mesh import (GREY, INK, WORLDS, Canvas, cells, counted, direction_name, label_table, labels_of, mesh_title,
                         number, read_off, skin_of, start_display, vtk)

TISSUE_COLOR = (0.93, 0.86, 0.80)
TUMOR_COLOR = (0.80, 0.10, 0.16)
POINT_COLOR = (0.05, 0.35, 0.75)
AFTER_COLOR = (1.0, 0.78, 0.10)
SHIFT_COLORS = [(0.97, 0.96, 0.92), (0.99, 0.85, 0.52), (0.95, 0.52, 0.27), (0.75, 0.18, 0.32), (0.32, 0.05, 0.32)]


def fail(message):
    sys.exit("render_brain_shift.py: error: " + message)


render_mesh.fail = fail


# Input

def read_shift(path):
    mesh = render_mesh.read_mesh(path)
    if mesh.GetPointData().GetArray("displacement") is None or mesh.GetCellData().GetArray("resected") is None:
        fail("%s: no point data 'displacement', or no cell data 'resected'" % path)
    return mesh


def read_control_points(path):
    """Pairs of a position and a displacement; brain_shift has checked the file."""
    try:
        with open(path, encoding="utf-8-sig") as file:
            rows = [line for line in (line.strip() for line in file) if line and not line.startswith("#")]
        values = [[float(x) for x in row.split(",")] for row in rows[1:]]
        return [(row[:3], row[3:6]) for row in values]
    except (OSError, ValueError) as error:
        fail("%s: %s" % (path, getattr(error, "strerror", None) or error))


def read_image(path):
    """The image, and the transformation from the world to its coordinates."""
    if not os.path.isfile(path):
        fail("%s: no such file" % path)
    reader = vtk.vtkNIFTIImageReader()
    reader.SetFileName(path)
    reader.Update()
    to_world = reader.GetSFormMatrix() or reader.GetQFormMatrix()
    if reader.GetErrorCode() != 0 or to_world is None:
        fail("%s: not a NIfTI image with an orientation" % path)
    from_world = vtk.vtkTransform()
    from_world.SetMatrix(to_world)
    from_world.Inverse()
    return reader.GetOutput(), from_world


# Vectors

def add(a, b, scale=1):
    return [x + scale * y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def mean(points):
    return [sum(p[k] for p in points) / len(points) for k in range(3)]


# Geometry

class View:
    """Where the pictures are cut, facing forwards or to a side.

    In the plane through the tumor and the control points: `right` and `up` span it, `normal` looks at the
    reader."""

    def __init__(self, tumor, points, mesh, world):
        self.world = world
        self.origin = list(tumor.GetCenter())
        axis = unit(add(mean([p for p, _ in points]), self.origin, -1))
        k = min(range(3), key=lambda i: abs(axis[i]))
        center = mesh.GetCenter()
        sign = 1 if self.origin[k] > center[k] else -1  # the smaller part is removed
        normal = [sign if i == k else 0 for i in range(3)]
        self.normal = unit(add(normal, axis, -dot(normal, axis)))
        upwards = [0, 0, 1] if abs(self.normal[2]) < 0.7 else [0, 1, 0]
        self.up = unit(add(upwards, self.normal, -dot(upwards, self.normal)))
        self.right = cross(self.up, self.normal)
        self.plane = vtk.vtkPlane()
        self.plane.SetOrigin(self.origin)
        self.plane.SetNormal(self.normal)


def displaced(mesh, array):
    """The mesh moved by an array of its points."""
    moved = vtk.vtkUnstructuredGrid()
    moved.ShallowCopy(mesh)
    moved.GetPointData().SetActiveVectors(array)
    warp = vtk.vtkWarpVector()
    warp.SetInputData(moved)
    warp.Update()
    return warp.GetOutput()


def cut_open(mesh, plane):
    """What is to be seen of the part of a mesh behind a plane: its skin, and the polygons in the plane."""
    clip = vtk.vtkClipPolyData()
    clip.SetInputData(skin_of(mesh))
    clip.SetClipFunction(plane)
    clip.InsideOutOn()
    cutter = vtk.vtkCutter()
    cutter.SetInputData(mesh)
    cutter.SetCutFunction(plane)
    cutter.GenerateTrianglesOff()
    both = vtk.vtkAppendPolyData()
    both.AddInputConnection(clip.GetOutputPort())
    both.AddInputConnection(cutter.GetOutputPort())
    both.Update()
    return both.GetOutput()


def cut_lines(data, plane):
    """The lines in which a plane cuts a surface, or the edges of the polygons in which it cuts elements."""
    cutter = vtk.vtkCutter()
    cutter.SetInputData(data)
    cutter.SetCutFunction(plane)
    cutter.GenerateTrianglesOff()
    cutter.Update()
    if cutter.GetOutput().GetNumberOfLines() != 0:
        return cutter.GetOutput()
    edges = vtk.vtkExtractEdges()
    edges.SetInputConnection(cutter.GetOutputPort())
    edges.Update()
    return edges.GetOutput()


def is_resected(mesh):
    resected = mesh.GetCellData().GetArray("resected")
    return lambda i: resected.GetTuple1(i) != 0


def lengths(mesh, array):
    """Adds the lengths of a vector array to the points, as `mm`; returns the largest."""
    vectors = mesh.GetPointData().GetArray(array)
    mm = vtk.vtkDoubleArray()
    mm.SetName("mm")
    for i in range(mesh.GetNumberOfPoints()):
        mm.InsertNextValue(math.sqrt(sum(x * x for x in vectors.GetTuple3(i))))
    mesh.GetPointData().AddArray(mm)
    return mm.GetRange()[1]


# The mesh

def add_mesh(canvas, skin, table=None, array="mm"):
    """Adds flat faces with their edges, of one color, or colored by the point data `mm` or by other cell data."""
    mapper = canvas.mapper(skin)
    if table is not None:
        mapper.ScalarVisibilityOn()
        if array == "mm":
            mapper.SetScalarModeToUsePointFieldData()
        else:
            mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray(array)
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
        mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(TISSUE_COLOR)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetAmbient(0.4)
    actor.GetProperty().SetDiffuse(0.75)
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(INK)
    actor.GetProperty().SetLineWidth(0.9 * canvas.unit)
    canvas.renderer.AddActor(actor)


def add_arrows(canvas, points):
    """Adds the control points, and arrows to where they go; nothing hides them."""
    for position, displacement in points:
        ball = vtk.vtkSphereSource()
        ball.SetCenter(position)
        ball.SetRadius(1.5)
        ball.SetThetaResolution(24)
        ball.SetPhiResolution(24)
        tip = add(position, displacement)
        length = math.sqrt(dot(displacement, displacement))
        shaft = vtk.vtkLineSource()
        shaft.SetPoint1(position)
        shaft.SetPoint2(add(tip, displacement, -min(1, 3 / length) if length > 0 else 0))
        tube = vtk.vtkTubeFilter()
        tube.SetInputConnection(shaft.GetOutputPort())
        tube.SetRadius(0.55)
        tube.SetNumberOfSides(16)
        cone = vtk.vtkConeSource()
        cone.SetDirection(displacement)
        cone.SetHeight(4)
        cone.SetRadius(1.4)
        cone.SetResolution(24)
        cone.SetCenter(add(tip, displacement, -2 / length if length > 0 else 0))
        for source in (ball, tube, cone)[:3 if length > 0 else 1]:
            source.Update()
            actor = vtk.vtkActor()
            actor.SetMapper(canvas.mapper(source.GetOutput()))
            actor.GetProperty().SetColor(POINT_COLOR)
            actor.GetProperty().SetAmbient(0.4)
            canvas.overlay.AddActor(actor)


def add_lines(canvas, lines, color, width):
    actor = vtk.vtkActor()
    actor.SetMapper(canvas.mapper(lines))
    actor.GetProperty().SetColor(color)
    actor.GetProperty().SetLineWidth(width * canvas.unit)
    actor.GetProperty().LightingOff()
    canvas.overlay.AddActor(actor)


def shift_table(canvas, top):
    """A table of colors from 0 to `top` mm; draws its bar."""
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(150)
    table.SetTableRange(0, top)
    for i in range(150):
        t = i / 149 * (len(SHIFT_COLORS) - 1)
        k = min(int(t), len(SHIFT_COLORS) - 2)
        color = [a + (t - k) * (b - a) for a, b in zip(SHIFT_COLORS[k], SHIFT_COLORS[k + 1])]
        table.SetTableValue(i, *color, 1)
        canvas.add_box(color, 48, 60 + 3 * i, 34, 3)
    canvas.add_box(None, 48, 60, 34, 450)
    step = next(s for s in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 1e9) if top / s <= 7)
    for i in range(int(top / step + 1e-9) + 1):
        canvas.add_text("%g" % (i * step), 96, 48 + 450 * i * step / top, 26)
    canvas.add_text("displacement, mm", 48, 535, 28, bold=True)
    return table


def draw_mesh(size, path, title, subtitle, view, whole, tumor, skin, points=(), top=None, outline=None, labels=()):
    """\\param whole skin of the cut mesh before: all pictures have its camera"""
    canvas = Canvas(size, path)
    if top:
        add_mesh(canvas, skin, shift_table(canvas, top))
    elif len(labels) > 1:
        add_mesh(canvas, skin, label_table(labels), "subdomain")
        canvas.add_labels(labels, 170)
    else:
        add_mesh(canvas, skin)
    if not top:
        canvas.add_surface(tumor, TUMOR_COLOR)
        canvas.add_box(TUMOR_COLOR, 48, 110, 34, 34)
        canvas.add_box(None, 48, 110, 34, 34)
        canvas.add_text("tumor", 96, 117, 26)
        canvas.add_box(POINT_COLOR, 48, 60, 34, 34)
        canvas.add_box(None, 48, 60, 34, 34)
        canvas.add_text("control points", 96, 67, 26)
    if outline is not None:
        for row, (lines, color, name) in enumerate(((outline, POINT_COLOR, "before"),
                                                    (cut_lines(tumor, view.plane), TUMOR_COLOR, "tumor before"))):
            add_lines(canvas, lines, color, 2.5)
            canvas.add_box(color, 48, -211 - 44 * row, 34, 4)
            canvas.add_text(name, 96, -220 - 44 * row, 26)
    add_arrows(canvas, points)
    canvas.add_title(title, subtitle)
    canvas.look_at(whole, tumor, view.plane)
    canvas.add_measures(view.world)
    canvas.write(path)


def draw_meshes(size, mesh, tumor, points, view, prefix):
    resected = is_resected(mesh)
    left = cells(mesh, lambda i: not resected(i))
    removed = mesh.GetNumberOfCells() - left.GetNumberOfCells()
    first = "displacement_before_resection"
    if mesh.GetPointData().GetArray(first) is None:
        first = "displacement"
    before, after = lengths(mesh, first), lengths(left, "displacement")
    top = max(1, math.ceil(max(before, after)))
    whole = cut_open(mesh, view.plane)
    outline = cut_lines(skin_of(mesh), view.plane)

    # The elements of the tumor are left out of the first picture: it is shown itself.
    draw_mesh(size, prefix + "_before.png", "Before the shift", mesh_title(mesh), view, whole, tumor,
              cut_open(left, view.plane), points, labels=labels_of(mesh))
    draw_mesh(size, prefix + "_shifted.png", "Brain shift", "%s; displacement up to %.1f mm"
              % (counted(len(points), "control points"), before), view, whole, tumor,
              cut_open(displaced(mesh, first), view.plane), (), top, outline)
    if removed:
        draw_mesh(size, prefix + "_resected.png", "Brain shift after resection",
                  "%s of %s elements removed; displacement up to %.1f mm"
                  % (number(removed), number(mesh.GetNumberOfCells()), after), view, whole, tumor,
                  cut_open(displaced(left, "displacement"), view.plane), (), top, outline)


# The image

class Panels:
    """Slices beside each other: one unit is a millimeter."""

    GAP = 4

    def __init__(self, canvas, view, center, width, height):
        self.canvas, self.view, self.center, self.width, self.height = canvas, view, center, width, height

    def offset(self, panel):
        return panel * (self.width + self.GAP)

    def slice(self, image, from_world):
        axes = vtk.vtkMatrix4x4()
        for k in range(3):
            for column, vector in enumerate((self.view.right, self.view.up, self.view.normal, self.center)):
                axes.SetElement(k, column, vector[k])
        reslice = vtk.vtkImageReslice()
        reslice.SetInputData(image)
        reslice.SetResliceAxes(axes)
        reslice.SetResliceTransform(from_world)
        reslice.SetOutputDimensionality(2)
        reslice.SetInterpolationModeToCubic()
        reslice.SetOutputScalarType(vtk.VTK_FLOAT)
        step = 0.25
        nx, ny = int(self.width / step), int(self.height / step)
        reslice.SetOutputSpacing(step, step, 1)
        reslice.SetOutputOrigin(-self.width / 2, -self.height / 2, 0)
        reslice.SetOutputExtent(0, nx - 1, 0, ny - 1, 0, 0)
        reslice.Update()
        return reslice.GetOutput()

    def add_slice(self, panel, data, table):
        colors = vtk.vtkImageMapToColors()
        colors.SetInputData(data)
        colors.SetLookupTable(table)
        colors.SetOutputFormatToRGB()
        colors.Update()
        actor = vtk.vtkImageActor()
        actor.GetMapper().SetInputData(colors.GetOutput())
        actor.SetPosition(self.offset(panel), 0, 0)
        self.canvas.renderer.AddActor(actor)

    def flat(self, data):
        """What is in the plane, in the coordinates of the panel, and as far as it is in it."""
        points = vtk.vtkPoints()
        for i in range(data.GetNumberOfPoints()):
            p = add(data.GetPoint(i), self.center, -1)
            points.InsertNextPoint(dot(p, self.view.right), dot(p, self.view.up), 0)
        flat = vtk.vtkPolyData()
        flat.ShallowCopy(data)
        flat.SetPoints(points)
        for k, half in ((0, self.width / 2), (1, self.height / 2)):
            for sign in (1, -1):  # a box would be clipped at inexactly, its function is not linear
                plane = vtk.vtkPlane()
                plane.SetOrigin([sign * half if i == k else 0 for i in range(3)])
                plane.SetNormal([-sign if i == k else 0 for i in range(3)])
                clip = vtk.vtkClipPolyData()
                clip.SetInputData(flat)
                clip.SetClipFunction(plane)
                clip.Update()
                flat = clip.GetOutput()
        return flat

    def add_labels(self, panel, mesh, labels):
        """The elements in the plane, translucent, in the color of their subdomain; nothing if there is one only."""
        if len(labels) < 2:
            return
        cutter = vtk.vtkCutter()
        cutter.SetInputData(mesh)
        cutter.SetCutFunction(self.view.plane)
        cutter.Update()
        mapper = self.canvas.mapper(self.flat(cutter.GetOutput()))
        mapper.ScalarVisibilityOn()
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("subdomain")
        mapper.SetLookupTable(label_table(labels))
        mapper.UseLookupTableScalarRangeOn()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.SetPosition(self.offset(panel), 0, 0.05)
        actor.GetProperty().SetOpacity(0.4)
        actor.GetProperty().LightingOff()
        self.canvas.renderer.AddActor(actor)

    def add_letters(self, panel, place, color, paper):
        """Names of the directions at the edges; `place` leads from coordinates of the panel to pixels."""
        for across, along in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            direction = [across * a + along * b for a, b in zip(self.view.right, self.view.up)]
            name = direction_name(self.view.world, direction)
            x, y = place(panel, 0.46 * across * self.width, 0.46 * along * self.height)
            self.canvas.add_text(name, x - 8 * len(name), y - 9, 24, color, bold=True, paper=paper)

    def add_lines(self, panel, lines, color, width, opacity=1.0):
        """Lines of the plane, as far as they are in the panel."""
        actor = vtk.vtkActor()
        actor.SetMapper(self.canvas.mapper(self.flat(lines)))
        actor.SetPosition(self.offset(panel), 0, 0.1)
        actor.GetProperty().SetColor(color)
        actor.GetProperty().SetOpacity(opacity)
        actor.GetProperty().SetLineWidth(width * self.canvas.unit)
        actor.GetProperty().LightingOff()
        self.canvas.renderer.AddActor(actor)


def table_of(low, high, colors):
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetTableRange(low, high)
    for i in range(256):
        t = i / 255 * (len(colors) - 1)
        k = min(int(t), len(colors) - 2)
        table.SetTableValue(i, *[a + (t - k) * (b - a) for a, b in zip(colors[k], colors[k + 1])], 1)
    return table


def draw_image(size, mesh, tumor, view, image, warped, path):
    canvas = Canvas(size, path)
    panels = Panels(canvas, view, add(view.origin, view.up, 6), 92, 92)

    before, after = (panels.slice(*read_image(name)) for name in (image, warped))
    difference = vtk.vtkImageMathematics()
    difference.SetOperationToSubtract()
    difference.SetInput1Data(after)
    difference.SetInput2Data(before)
    difference.Update()
    top = before.GetScalarRange()[1]
    gray = table_of(0, top, [(0, 0, 0), (1, 1, 1)])
    signed = table_of(-top, top, [(0.10, 0.30, 0.70), (0.97, 0.97, 0.97), (0.75, 0.12, 0.15)])
    panels.add_slice(0, before, gray)
    panels.add_slice(1, after, gray)
    panels.add_slice(2, difference.GetOutput(), signed)

    resected = is_resected(mesh)
    left = cells(mesh, lambda i: not resected(i))
    has_resection = left.GetNumberOfCells() < mesh.GetNumberOfCells()
    moved = displaced(left, "displacement")
    mesh_before, mesh_after = cut_lines(mesh, view.plane), cut_lines(moved, view.plane)
    border_before, border_after = cut_lines(skin_of(mesh), view.plane), cut_lines(skin_of(moved), view.plane)
    tumor_lines = cut_lines(tumor, view.plane)
    panels.add_labels(0, mesh, labels_of(mesh))
    panels.add_labels(1, moved, labels_of(mesh))
    panels.add_lines(0, mesh_before, AFTER_COLOR, 1.6, 0.8)
    panels.add_lines(0, tumor_lines, TUMOR_COLOR, 4)
    panels.add_lines(1, mesh_after, AFTER_COLOR, 1.6, 0.8)
    panels.add_lines(1, border_after, AFTER_COLOR, 4)
    panels.add_lines(2, border_before, GREY, 2.5)
    panels.add_lines(2, border_after, INK, 3.5)

    canvas.add_title("The image before and after" + (" shift and resection" if has_resection else " the shift"),
                     "slice along the way from the control points to the tumor; %.0f x %.0f mm"
                     % (panels.width, panels.height))
    camera = canvas.renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    total = 3 * panels.width + 2 * panels.GAP
    width, height = canvas.size
    margin, above, below = [canvas.unit * x for x in (48, 150, 100)]
    world = max(total / (width - 2 * margin), panels.height / (height - above - below))
    center = (total / 2 - panels.width / 2, (above - below) / 2 * world)
    camera.SetFocalPoint(*center, 0)
    camera.SetPosition(*center, 100)
    camera.SetViewUp(0, 1, 0)
    camera.SetParallelScale(world * height / 2)
    texts = (("before", "mesh, and tumor (red)"),
             ("after", "mesh that is left, deformed; %s" % ("black: resected" if has_resection else "")),
             ("after minus before", "red: brighter, blue: darker; gray, black: outlines"))

    def place(panel, x, y):
        """Where a point of a panel is, in pixels of the default size."""
        return [((a - b) / world + pixels / 2) / canvas.unit
                for a, b, pixels in ((panels.offset(panel) + x, center[0], width), (y, center[1], height))]

    for panel, (name, text) in enumerate(texts):
        x, y = place(panel, -panels.width / 2, -panels.height / 2)
        canvas.add_text(name, x, y - 44, 28, bold=True)
        canvas.add_text(text.strip("; "), x, y - 84, 22, GREY)
        color, paper = ((1, 1, 1), INK) if panel < 2 else (INK, (0.97, 0.97, 0.97))
        if WORLDS[view.world] is not None:
            panels.add_letters(panel, place, color, paper)
            canvas.add_scale_bar(1 / world / canvas.unit, x + 20, y + 20, color, most=200, paper=paper)
    canvas.write(path)


def main():
    parser = argparse.ArgumentParser(description="Draws what brain_shift writes.")
    parser.add_argument("mesh", metavar="MESH.vtu", help="mesh with point data `displacement`, cell data `resected`")
    parser.add_argument("--tumor", required=True, metavar="T.off", help="the tumor")
    parser.add_argument("--control-points", required=True, metavar="FILE.csv", help="the control points")
    parser.add_argument("--image", metavar="IMAGE", help="the image before")
    parser.add_argument("--warped-image", metavar="IMAGE", help="the image that brain_shift wrote")
    options, size = render_mesh.parse(parser)
    if (options.image is None) != (options.warped_image is None):
        parser.error("--image and --warped-image need each other")

    vtk.vtkObject.GlobalWarningDisplayOff()  # errors are one line of ours
    mesh, tumor = read_shift(options.mesh), read_off(options.tumor)
    points = read_control_points(options.control_points)
    view = View(tumor, points, mesh, options.world)
    start_display()
    draw_meshes(size, mesh, tumor, points, view, options.output_prefix)
    if options.image is not None:
        draw_image([size[0], size[0] // 2], mesh, tumor, view, options.image, options.warped_image,
                   options.output_prefix + "_image.png")


if __name__ == "__main__":
    main()
