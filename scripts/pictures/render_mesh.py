#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a mixed mesh, cut open through its region of interest, into PNG files.

  /usr/bin/python3 scripts/pictures/render_mesh.py out/brain.vtu --surface data/brain.off \\
      --region data/region.off --output-prefix out/brain

writes out/brain_surface.png (what was given: the surface, the region inside),
out/brain_kinds.png (the cut mesh colored by kind of element) and
out/brain_ARC.png (the same colored by aspect-ratio coefficient); and if there are
several subdomains out/brain_labels.png (colored by subdomain), if there are
sheets out/brain_sheet.png (the faces on them).

A bar is a length across the view, in mm; a cross has R, L, A, P, S and I for right,
left, front (anterior), back (posterior), top (superior) and bottom (inferior).

Needs Debian's packages python3-vtk9 and xvfb: hence Debian's own Python. No
display is needed: the script starts an Xvfb of its own and ends it.
"""

import argparse
import atexit
import ctypes
import math
import os
import select
import shutil
import signal
import subprocess
import sys

try:
    import vtk
except ImportError:
    sys.exit("render_mesh.py: error: no VTK for %s: install Debian's python3-vtk9 and call /usr/bin/python3"
             % sys.executable)

SUPERSAMPLING = 2  # pictures are drawn this many times larger, then averaged: smooth edges on any driver

INK = (0.13, 0.15, 0.18)
GREY = (0.42, 0.45, 0.49)
SURFACE_COLOR = (0.93, 0.80, 0.76)
REGION_COLOR = (0.76, 0.05, 0.42)
SHEET_COLOR = (0.30, 0.55, 0.75)
KINDS = [  # by value of the cell data `kind`
    ("tetrahedra", (0.97, 0.80, 0.36)),
    ("pyramids", (0.90, 0.45, 0.27)),
    ("prisms", (0.55, 0.42, 0.68)),
    ("hexahedra", (0.42, 0.65, 0.83)),
]
LABEL_COLORS = [(0.93, 0.86, 0.80), (0.36, 0.62, 0.80), (0.95, 0.62, 0.30), (0.45, 0.70, 0.42), (0.72, 0.52, 0.75),
                (0.87, 0.42, 0.42), (0.60, 0.50, 0.42), (0.90, 0.85, 0.40)]  # by turns
WORLDS = {  # for each axis the letters of its two directions, the positive one first
    "ras": (("R", "L"), ("A", "P"), ("S", "I")),
    "lps": (("L", "R"), ("P", "A"), ("S", "I")),
    "none": None}
ARC_COLORS = [(0.55, 0.72, 0.84), (0.97, 0.90, 0.62), (0.96, 0.62, 0.26), (0.83, 0.24, 0.16), (0.45, 0.02, 0.10)]


def fail(message):
    sys.exit("render_mesh.py: error: " + message)


# Display

def start_display():
    """Starts an X server that draws into memory: Debian's VTK opens a display even to render off-screen.

    Not by xvfb-run: that needs xauth, and may wait for ever where no process reaps its children."""
    xvfb = shutil.which("Xvfb")
    if xvfb is None:
        if "DISPLAY" not in os.environ:
            fail("needs an X display or Debian's package xvfb")
        return
    read_end, write_end = os.pipe()
    end_with_parent = lambda: ctypes.CDLL(None).prctl(1, signal.SIGTERM)  # 1: PR_SET_PDEATHSIG
    server = subprocess.Popen(
        [xvfb, "-displayfd", str(write_end), "-screen", "0", "1024x768x24", "-nolisten", "tcp"],
        pass_fds=[write_end], preexec_fn=end_with_parent,
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    atexit.register(server.wait)  # called last first: terminate, then wait
    atexit.register(server.terminate)
    number = b""
    while not number.endswith(b"\n"):
        ready, _, _ = select.select([read_end], [], [], 30)
        some = os.read(read_end, 16) if ready else b""
        if not some:
            fail("Xvfb did not start")
        number += some
    os.close(read_end)
    os.environ["DISPLAY"] = ":" + number.decode().strip()
    os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"


# Input

def read_off(path):
    """Reads the vertices and faces of an OFF file; comments, colors and the number of edges are ignored."""
    try:
        with open(path) as file:
            lines = [line.split("#")[0].split() for line in file]
        lines = [line for line in lines if line]
        if lines[0][0] != "OFF":
            raise ValueError("does not start with OFF")
        lines[0] = lines[0][1:]  # the numbers may follow on the line of the keyword
        lines = lines if lines[0] else lines[1:]
        vertices, faces = int(lines[0][0]), int(lines[0][1])
        points, polygons = vtk.vtkPoints(), vtk.vtkCellArray()
        for line in lines[1:1 + vertices]:
            points.InsertNextPoint([float(x) for x in line[:3]])
        for line in lines[1 + vertices:1 + vertices + faces]:
            size = int(line[0])
            polygons.InsertNextCell(size, [int(i) for i in line[1:1 + size]])
        if points.GetNumberOfPoints() != vertices or polygons.GetNumberOfCells() != faces:
            raise ValueError("truncated")
    except (OSError, ValueError, IndexError, UnicodeDecodeError) as error:
        fail("%s: %s" % (path, getattr(error, "strerror", None) or error))
    surface = vtk.vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(polygons)
    return surface


def read_mesh(path):
    if not os.path.isfile(path):
        fail("%s: no such file" % path)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    if reader.GetErrorCode() != 0 or mesh.GetNumberOfCells() == 0:
        fail("%s: not a VTU file with cells" % path)
    for name in ("kind", "ARC"):
        if mesh.GetCellData().GetArray(name) is None:
            fail("%s: no cell data '%s'" % (path, name))
    lowest, highest = mesh.GetCellData().GetArray("kind").GetRange()
    if lowest < 0 or highest >= len(KINDS):
        fail("%s: cell data 'kind' is not in 0..%d" % (path, len(KINDS) - 1))
    return mesh


# Geometry

def longest_axis(surface):
    """Direction in which the vertices spread most: power iteration on their covariance."""
    points = [surface.GetPoint(i) for i in range(surface.GetNumberOfPoints())]
    mean = [sum(p[k] for p in points) / len(points) for k in range(3)]
    covariance = [[sum((p[i] - mean[i]) * (p[j] - mean[j]) for p in points) for j in range(3)] for i in range(3)]
    axis = [1.0, 1.1, 1.2]
    for _ in range(100):
        axis = [sum(row[k] * axis[k] for k in range(3)) for row in covariance]
        length = math.sqrt(sum(x * x for x in axis)) or 1.0
        axis = [x / length for x in axis]
    return axis


def cut_plane(surface, region):
    """Plane through the region's center, normal to the coordinate axis most nearly normal to the region's axis.

    An axis, because the octree's cells line up with it; oriented towards the smaller part, which is removed."""
    axis, bounds, center = longest_axis(region), surface.GetBounds(), region.GetCenter()
    k = min(range(3), key=lambda i: abs(axis[i]))
    sign = 1 if bounds[2 * k + 1] - center[k] < center[k] - bounds[2 * k] else -1
    plane = vtk.vtkPlane()
    plane.SetOrigin(center)
    plane.SetNormal([sign if i == k else 0 for i in range(3)])
    return plane


def cells(mesh, keep):
    """The cells for which `keep(i)` holds."""
    ids = vtk.vtkIdTypeArray()
    for i in range(mesh.GetNumberOfCells()):
        if keep(i):
            ids.InsertNextValue(i)
    node = vtk.vtkSelectionNode()
    node.SetFieldType(vtk.vtkSelectionNode.CELL)
    node.SetContentType(vtk.vtkSelectionNode.INDICES)
    node.SetSelectionList(ids)
    selection = vtk.vtkSelection()
    selection.AddNode(node)
    extract = vtk.vtkExtractSelection()
    extract.SetInputData(0, mesh)
    extract.SetInputData(1, selection)
    extract.Update()
    return extract.GetOutput()


def skin_of(mesh):
    skin = vtk.vtkDataSetSurfaceFilter()
    skin.SetInputData(mesh)
    skin.Update()
    return skin.GetOutput()


def cells_behind(plane, mesh):
    """Skin of the cells whose center is behind the plane: whole cells only."""
    centers = vtk.vtkCellCenters()
    centers.SetInputData(mesh)
    centers.Update()
    centers = centers.GetOutput()
    return skin_of(cells(mesh, lambda i: plane.EvaluateFunction(centers.GetPoint(i)) < 0))


def labels_of(mesh):
    """The subdomains that the mesh has, ascending; none if the file does not tell."""
    array = mesh.GetCellData().GetArray("subdomain")
    return sorted({int(array.GetTuple1(i)) for i in range(mesh.GetNumberOfCells())}) if array else []


def sheet_of(mesh):
    """The faces between two compartments, as polygons; none if the mesh has no sheets."""
    array = mesh.GetCellData().GetArray("compartment")
    if array is None:
        return None
    faces = {}
    for i in range(mesh.GetNumberOfCells()):
        compartment = int(array.GetTuple1(i))
        if compartment != 0:
            cell = mesh.GetCell(i)
            for f in range(cell.GetNumberOfFaces()):
                ids = cell.GetFace(f).GetPointIds()
                key = frozenset(ids.GetId(k) for k in range(ids.GetNumberOfIds()))
                faces.setdefault(key, set()).add(compartment)
    polygons = vtk.vtkCellArray()
    for face in sorted(sorted(key) for key, compartments in faces.items() if len(compartments) > 1):
        polygons.InsertNextCell(len(face))
        for v in face:
            polygons.InsertCellPoint(v)
    sheet = vtk.vtkPolyData()
    sheet.SetPoints(mesh.GetPoints())
    sheet.SetPolys(polygons)
    return sheet


def label_color(labels, label):
    return LABEL_COLORS[labels.index(label) % len(LABEL_COLORS)]


def label_table(labels):
    """Colors of subdomains, which need not follow each other."""
    table = vtk.vtkLookupTable()
    size = labels[-1] - labels[0] + 1
    table.SetNumberOfTableValues(size)
    table.SetTableRange(labels[0] - 0.5, labels[-1] + 0.5)
    for i in range(size):
        color = label_color(labels, labels[0] + i) if labels[0] + i in labels else GREY
        table.SetTableValue(i, *color, 1)
    return table


def direction_name(world, direction):
    """What a direction of length 1 is called: "R", or "RA" between right and front; empty without a world."""
    if WORLDS[world] is None:
        return ""
    letters = [(abs(x), WORLDS[world][k][0 if x > 0 else 1]) for k, x in enumerate(direction)]
    return "".join(letter for size, letter in sorted(letters, reverse=True) if size > 0.4)


def bar_length(pixels_per_mm, most):
    """The longest length of 1, 2 or 5 times a power of ten that takes so many pixels at most."""
    lengths = [digit * 10.0**power for power in range(-6, 7) for digit in (1, 2, 5)]
    return max([length for length in lengths if length * pixels_per_mm <= most] or lengths[:1])


# Drawing

class Canvas:
    """One picture: a renderer, and texts placed in fractions of the window."""

    def __init__(self, size, name):
        self.name = name
        self.size = [SUPERSAMPLING * x for x in size]
        self.unit = min(self.size[1] / 1200, self.size[0] / 1600)  # a pixel of the default size
        self.renderer = vtk.vtkRenderer()
        self.renderer.SetBackground(1, 1, 1)
        self.overlay = vtk.vtkRenderer()  # what is drawn here is never hidden
        self.overlay.SetLayer(1)
        self.overlay.SetActiveCamera(self.renderer.GetActiveCamera())
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetAlphaBitPlanes(1)
        self.window.SetSize(self.size)
        self.window.SetNumberOfLayers(2)
        self.window.AddRenderer(self.renderer)
        self.window.AddRenderer(self.overlay)

    def mapper(self, data):
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(data)
        mapper.ScalarVisibilityOff()
        return mapper

    def add_surface(self, surface, color, feature_angle=180, opacity=1.0):
        """Adds a surface shaded smoothly but for edges sharper than the feature angle."""
        normals = vtk.vtkPolyDataNormals()
        normals.SetInputData(surface)
        normals.SetFeatureAngle(feature_angle)
        normals.Update()
        actor = vtk.vtkActor()
        actor.SetMapper(self.mapper(normals.GetOutput()))
        actor.GetProperty().SetColor(color)
        actor.GetProperty().SetOpacity(opacity)
        actor.GetProperty().SetAmbient(0.35)
        actor.GetProperty().SetDiffuse(0.8)
        self.renderer.AddActor(actor)
        return actor

    def add_cells(self, skin, array, table):
        mapper = self.mapper(skin)
        mapper.ScalarVisibilityOn()
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray(array)
        mapper.SetColorModeToMapScalars()  # bytes would be taken for colors
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetInterpolationToFlat()
        actor.GetProperty().SetAmbient(0.4)
        actor.GetProperty().SetDiffuse(0.75)
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(INK)
        actor.GetProperty().SetLineWidth(1.1 * self.unit)
        self.renderer.AddActor(actor)

    def add_outline(self, region, plane):
        """Draws where the plane cuts the region, and says so."""
        cutter = vtk.vtkCutter()
        cutter.SetInputData(region)
        cutter.SetCutFunction(plane)
        cutter.Update()
        for paint, width in (((1, 1, 1), 8), (REGION_COLOR, 4)):
            actor = vtk.vtkActor()
            actor.SetMapper(self.mapper(cutter.GetOutput()))
            actor.GetProperty().SetColor(paint)
            actor.GetProperty().SetLineWidth(width * self.unit)
            actor.GetProperty().LightingOff()
            self.overlay.AddActor(actor)
        self.add_box(REGION_COLOR, 48, -211, 34, 5)
        self.add_text("region of interest", 96, -220, 26)

    def add_text(self, text, x, y, size, color=INK, bold=False, right=False, paper=None):
        """Writes at pixels (x, y) of the default size; negative: counted from the right or the top.

        With paper, a color, what is behind may be of any color."""
        actor = vtk.vtkTextActor()
        actor.SetInput(text)
        style = actor.GetTextProperty()
        style.SetFontFamilyToArial()
        style.SetFontSize(round(size * self.unit))
        style.SetColor(color)
        style.SetBold(bold)
        if right:
            style.SetJustificationToRight()
        if paper:
            style.SetBackgroundColor(paper)
            style.SetBackgroundOpacity(1)
        actor.SetPosition(*self.pixels(x, y))
        self.renderer.AddActor2D(actor)

    def add_box(self, color, x, y, width, height):
        """Fills a rectangle, or frames it when the color is None."""
        x, y = self.pixels(x, y)
        width, height = width * self.unit, height * self.unit
        points = vtk.vtkPoints()
        for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1)):
            points.InsertNextPoint(x + dx * width, y + dy * height, 0)
        cells, data = vtk.vtkCellArray(), vtk.vtkPolyData()
        cells.InsertNextCell(4 if color else 5, [0, 1, 2, 3] if color else [0, 1, 2, 3, 0])
        data.SetPoints(points)
        data.SetPolys(cells) if color else data.SetLines(cells)
        mapper = vtk.vtkPolyDataMapper2D()
        mapper.SetInputData(data)
        actor = vtk.vtkActor2D()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(color or INK)
        actor.GetProperty().SetLineWidth(1.2 * self.unit)
        self.renderer.AddActor2D(actor)

    def pixels(self, x, y):
        x, y = x * self.unit, y * self.unit
        return (x if x >= 0 else self.size[0] + x), (y if y >= 0 else self.size[1] + y)

    def add_line(self, color, start, end, width):
        """A line between pixels of the default size."""
        points, cells, data = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
        for x, y in (start, end):
            points.InsertNextPoint(*self.pixels(x, y), 0)
        cells.InsertNextCell(2, [0, 1])
        data.SetPoints(points)
        data.SetLines(cells)
        mapper = vtk.vtkPolyDataMapper2D()
        mapper.SetInputData(data)
        actor = vtk.vtkActor2D()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(color)
        actor.GetProperty().SetLineWidth(width * self.unit)
        self.renderer.AddActor2D(actor)

    def add_scale_bar(self, pixels_per_mm, x, y, color=INK, right=False, most=240, paper=None):
        """A bar from (or, with `right`, to) pixels (x, y) of the default size, with its length."""
        length = bar_length(pixels_per_mm, most)
        width = length * pixels_per_mm
        left = x - width if right else x
        if paper:
            self.add_box(paper, left - 10, y - 10, width + 20, 58)
        self.add_box(color, left, y, width, 5)
        for end in (left, left + width - 3):
            self.add_box(color, end, y - 5, 3, 15)
        self.add_text("%g mm" % length, left, y + 16, 24, color)

    def add_orientation(self, world, x, y):
        """A cross of the axes as they are seen, around pixels (x, y) of the default size."""
        if WORLDS[world] is None:
            return
        view, radius = self.renderer.GetActiveCamera().GetViewTransformMatrix(), 54
        for k in range(3):
            seen = [view.GetElement(row, k) for row in range(2)]
            if math.hypot(*seen) < 0.25:  # towards the reader
                continue
            self.add_line(GREY, [x - radius * seen[0], y - radius * seen[1]], [x + radius * seen[0], y + radius * seen[1]],
                          2.5)
            for sign, letter in zip((1, -1), WORLDS[world][k]):
                reach = sign * (radius + 20 / math.hypot(*seen))
                self.add_text(letter, x + reach * seen[0] - 8, y + reach * seen[1] - 9, 24, bold=True)

    def add_measures(self, world):
        """Below on the right: how long a millimeter is, and where is what. After `look_at`."""
        if WORLDS[world] is None:
            return
        self.add_scale_bar(self.pixels_per_mm / self.unit, -48, 48, right=True)
        self.add_orientation(world, -130, 188)

    def add_labels(self, labels, y=60):
        """The colors of subdomains, from pixel y upwards."""
        for row, label in enumerate(reversed(labels[:12])):
            self.add_box(label_color(labels, label), 48, y + 50 * row, 34, 34)
            self.add_box(None, 48, y + 50 * row, 34, 34)
            self.add_text("subdomain %d" % label, 96, y + 7 + 50 * row, 26)

    def add_title(self, title, subtitle):
        self.add_text(title, 48, -76, 42, bold=True)
        self.add_text(subtitle, 48, -124, 30, GREY)

    def look_at(self, surface, region, plane, skin=None):
        """Three-quarter view onto the cut from the region's side, filling the window below the title."""
        normal = plane.GetNormal()
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(plane.GetOrigin())
        camera.SetPosition([o + 4 * surface.GetLength() * n for o, n in zip(plane.GetOrigin(), normal)])
        camera.SetViewUp((0, 1, 0) if abs(normal[2]) > 0.5 else (0, 0, 1))
        right = [camera.GetViewTransformMatrix().GetElement(0, k) for k in range(3)]
        aside = sum(r * (a - b) for r, a, b in zip(right, region.GetCenter(), surface.GetCenter()))
        side = 1 if aside > 0 else -1
        camera.Azimuth(side * 28)
        camera.Elevation(22)
        camera.OrthogonalizeViewUp()

        view = camera.GetViewTransformMatrix()
        corners = [s.GetPoint(i) for s in filter(None, (surface, region, skin)) for i in range(s.GetNumberOfPoints())]
        seen = [view.MultiplyPoint(corner + (1,)) for corner in corners]
        (x0, x1), (y0, y1) = [(min(p[k] for p in seen), max(p[k] for p in seen)) for k in (0, 1)]
        width, height = self.size
        left, right, top, bottom = [self.unit * margin for margin in (300, 50, 150, 40)]
        world = max((x1 - x0) / (width - left - right), (y1 - y0) / (height - top - bottom))  # length of a pixel
        camera.SetParallelScale(world * height / 2)
        self.pixels_per_mm = 1 / world
        # Window center: of the middle of the window, in half windows from the focal point.
        camera.SetWindowCenter(((x0 + x1) / world + right - left) / width,
                               ((y0 + y1) / world + top - bottom) / height)

        # One light from above, one from the side that the cut faces.
        for position, intensity in (((side * 0.5, 0.8, 1), 0.5), ((-side * 0.5, -0.2, 1), 0.65)):
            light = vtk.vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(position)
            light.SetIntensity(intensity)
            self.renderer.AddLight(light)

    def write(self, path):
        self.renderer.ResetCameraClippingRange()
        self.window.Render()
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.SetInputBufferTypeToRGB()
        grab.ReadFrontBufferOff()
        shrink = vtk.vtkImageShrink3D()
        shrink.SetInputConnection(grab.GetOutputPort())
        shrink.SetShrinkFactors(SUPERSAMPLING, SUPERSAMPLING, 1)
        shrink.AveragingOn()
        writer = vtk.vtkPNGWriter()
        writer.SetInputConnection(shrink.GetOutputPort())
        writer.SetFileName(path)
        writer.Write()
        if writer.GetErrorCode() != 0:
            fail("%s: cannot be written" % path)
        self.window.Finalize()


def number(count):
    return "{:,}".format(count)


def counted(count, name):
    return "%s %s" % (number(count), name)


def mesh_title(mesh):
    return "%s vertices, %s elements" % (number(mesh.GetNumberOfPoints()), number(mesh.GetNumberOfCells()))


def draw_surface(size, surface, region, plane, world, path):
    canvas = Canvas(size, path)
    # The front of the surface translucent, its back solid: the region is seen within a body.
    canvas.add_surface(surface, SURFACE_COLOR).GetProperty().FrontfaceCullingOn()
    canvas.add_surface(surface, SURFACE_COLOR, opacity=0.45).GetProperty().BackfaceCullingOn()
    canvas.add_surface(region, REGION_COLOR, feature_angle=40)
    canvas.renderer.SetUseDepthPeeling(1)
    canvas.renderer.SetMaximumNumberOfPeels(12)
    canvas.renderer.SetOcclusionRatio(0.0)
    canvas.add_title("Domain surface and region of interest",
                     "%s vertices, %s triangles; region %s vertices, %s triangles"
                     % tuple(number(n) for s in (surface, region)
                             for n in (s.GetNumberOfPoints(), s.GetNumberOfCells())))
    canvas.look_at(surface, region, plane)
    canvas.add_measures(world)
    canvas.write(path)


def draw_labels(size, mesh, labels, skin, surface, region, plane, world, path):
    canvas = Canvas(size, path)
    canvas.add_cells(skin, "subdomain", label_table(labels))
    canvas.add_outline(region, plane)
    canvas.add_title("Elements by subdomain", mesh_title(mesh))
    canvas.add_labels(labels)
    canvas.look_at(surface, region, plane, skin)
    canvas.add_measures(world)
    canvas.write(path)


def draw_sheet(size, mesh, sheet, surface, region, plane, world, path):
    canvas = Canvas(size, path)
    canvas.add_surface(surface, SURFACE_COLOR).GetProperty().FrontfaceCullingOn()
    canvas.add_surface(surface, SURFACE_COLOR, opacity=0.35).GetProperty().BackfaceCullingOn()
    faces = canvas.add_surface(sheet, SHEET_COLOR, feature_angle=20)
    faces.GetProperty().EdgeVisibilityOn()
    faces.GetProperty().SetEdgeColor(*INK)
    canvas.renderer.SetUseDepthPeeling(1)
    canvas.renderer.SetMaximumNumberOfPeels(12)
    canvas.renderer.SetOcclusionRatio(0.0)
    canvas.add_title("Faces on sheets", "%s; %s" % (counted(sheet.GetNumberOfPolys(), "faces"), mesh_title(mesh)))
    canvas.look_at(surface, region, plane)
    canvas.add_measures(world)
    canvas.write(path)


def draw_kinds(size, mesh, skin, surface, region, plane, world, path):
    canvas = Canvas(size, path)
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(len(KINDS))
    table.SetTableRange(-0.5, len(KINDS) - 0.5)
    for kind, (_, color) in enumerate(KINDS):
        table.SetTableValue(kind, *color, 1)
    canvas.add_cells(skin, "kind", table)
    canvas.add_outline(region, plane)
    kinds = mesh.GetCellData().GetArray("kind")
    counts = [0] * len(KINDS)
    for i in range(mesh.GetNumberOfCells()):
        counts[int(kinds.GetTuple1(i))] += 1
    canvas.add_title("Elements by kind", mesh_title(mesh))
    for row, kind in enumerate(reversed(range(len(KINDS)))):
        name, color = KINDS[kind]
        canvas.add_box(color, 48, 210 - 50 * row, 34, 34)
        canvas.add_box(None, 48, 210 - 50 * row, 34, 34)
        canvas.add_text(counted(counts[kind], name), 96, 217 - 50 * row, 26)
    canvas.look_at(surface, region, plane, skin)
    canvas.add_measures(world)
    canvas.write(path)


def draw_arc(size, mesh, skin, surface, region, plane, world, path):
    canvas = Canvas(size, path)
    arcs = mesh.GetCellData().GetArray("ARC")
    values = sorted(arcs.GetTuple1(i) for i in range(mesh.GetNumberOfCells()))
    mean = sum(values) / len(values)
    high = values[min(len(values) - 1, math.ceil(0.99 * len(values)))]
    top = 1 + 0.4 * max(2, math.ceil((high - 1) / 0.4)) if math.isfinite(high) else 10.0
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(100)
    table.SetTableRange(1, top)
    for i in range(100):
        t = i / 99 * (len(ARC_COLORS) - 1)
        k = min(int(t), len(ARC_COLORS) - 2)
        color = [a + (t - k) * (b - a) for a, b in zip(ARC_COLORS[k], ARC_COLORS[k + 1])]
        table.SetTableValue(i, *color, 1)
        canvas.add_box(color, 48, 60 + 3 * i, 34, 3)
    canvas.add_box(None, 48, 60, 34, 300)
    for i in range(5):
        more = "\u2265 " if i == 4 and values[-1] > top else ""
        canvas.add_text(more + "%.3g" % (1 + i / 4 * (top - 1)), 96, 50 + 75 * i, 26)
    canvas.add_text("ARC", 48, 385, 28, bold=True)
    canvas.add_cells(skin, "ARC", table)
    canvas.add_outline(region, plane)
    canvas.add_title("Elements by aspect-ratio coefficient (ideal: 1)",
                     "%s; mean %.2f, largest %.3g" % (mesh_title(mesh), mean, values[-1]))
    canvas.look_at(surface, region, plane, skin)
    canvas.add_measures(world)
    canvas.write(path)


def parse(parser):
    """The options of a program that draws, with those that all have, and the size of its pictures."""
    parser.add_argument("--output-prefix", required=True, metavar="PREFIX", help="start of the pictures' names")
    parser.add_argument("--size", default="1600x1200", help="of the pictures, in pixels (default: %(default)s)")
    parser.add_argument("--world", choices=sorted(WORLDS), default="ras",
                        help="coordinates, in mm: ras (to the right, front, top), lps, or none: no bar, no letters "
                             "(default: %(default)s)")
    options = parser.parse_args()
    try:
        size = [int(x) for x in options.size.split("x")]
        assert len(size) == 2 and min(size) >= 100 and max(size) <= 8000
    except (ValueError, AssertionError):
        parser.error("--size: expected WIDTHxHEIGHT, from 100x100 to 8000x8000")
    return options, size


def main():
    parser = argparse.ArgumentParser(description="Draws a mixed mesh, cut open through its region of interest.")
    parser.add_argument("mesh", metavar="MESH.vtu", help="mesh with cell data `kind` and `ARC`")
    parser.add_argument("--surface", required=True, metavar="S.off", help="the surface that was meshed")
    parser.add_argument("--region", required=True, metavar="R.off", help="the region of interest")
    options, size = parse(parser)

    vtk.vtkObject.GlobalWarningDisplayOff()  # errors are one line of ours
    surface, region, mesh = read_off(options.surface), read_off(options.region), read_mesh(options.mesh)
    plane = cut_plane(surface, region)
    skin = cells_behind(plane, mesh)
    start_display()
    world = options.world
    draw_surface(size, surface, region, plane, world, options.output_prefix + "_surface.png")
    draw_kinds(size, mesh, skin, surface, region, plane, world, options.output_prefix + "_kinds.png")
    draw_arc(size, mesh, skin, surface, region, plane, world, options.output_prefix + "_ARC.png")
    sheet = sheet_of(mesh)
    if sheet is not None:
        draw_sheet(size, mesh, sheet, surface, region, plane, world, options.output_prefix + "_sheet.png")
    labels = labels_of(mesh)
    if len(labels) > 1:
        draw_labels(size, mesh, labels, skin, surface, region, plane, world, options.output_prefix + "_labels.png")


if __name__ == "__main__":
    main()
