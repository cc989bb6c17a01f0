#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the paper's figure 10: how many elements have which aspect-ratio coefficient.

  /usr/bin/python3 scripts/pictures/plot_quality.py out/brain.json out/brain_quality.png

reads the report of mixed_mesh_3 and draws bars for the mesh written and, as an outline, the mesh before
its boundary was fitted, if the report has it. The first bin has all that is below its upper edge, the last one all that is not
below its lower edge.

Needs what render_mesh.py needs.
"""

import argparse
import json
import math

from render_mesh import INK, Canvas, counted, number, start_display, vtk

PROGRAM = "plot_quality.py"
AFTER_COLOR = (0.42, 0.65, 0.83)
BEFORE_COLOR = (0.83, 0.24, 0.16)
LEFT, RIGHT, BOTTOM, TOP = 170, 60, 150, 190  # margins of the diagram, in pixels of the default size


class Diagram:
    """Bins side by side along x, counts along y."""

    def __init__(self, canvas, edges, highest):
        self.canvas, self.highest = canvas, highest
        # The bins at both ends have no end: they are drawn as wide as their neighbors.
        self.edges = [2 * edges[0] - edges[1]] + edges + [2 * edges[-1] - edges[-2]]
        self.width = canvas.size[0] / canvas.unit - LEFT - RIGHT
        self.height = canvas.size[1] / canvas.unit - BOTTOM - TOP

    def x(self, value):
        return LEFT + self.width * (value - self.edges[0]) / (self.edges[-1] - self.edges[0])

    def y(self, count):
        return BOTTOM + self.height * count / self.highest

    def add_line(self, points, color, width):
        data, cells = vtk.vtkPolyData(), vtk.vtkCellArray()
        data.SetPoints(vtk.vtkPoints())
        for point in points:
            data.GetPoints().InsertNextPoint(*self.canvas.pixels(*point), 0)
        cells.InsertNextCell(len(points), range(len(points)))
        data.SetLines(cells)
        mapper = vtk.vtkPolyDataMapper2D()
        mapper.SetInputData(data)
        actor = vtk.vtkActor2D()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(color)
        actor.GetProperty().SetLineWidth(width * self.canvas.unit)
        self.canvas.renderer.AddActor2D(actor)

    def add_bars(self, counts, color):
        for count, left, right in zip(counts, self.edges, self.edges[1:]):
            x0, x1 = self.x(left) + 1, self.x(right) - 1
            if count > 0:
                self.canvas.add_box(color, x0, BOTTOM, x1 - x0, self.y(count) - BOTTOM)

    def add_outline(self, counts, color):
        points = [(self.x(self.edges[0]), BOTTOM)]
        for count, left, right in zip(counts, self.edges, self.edges[1:]):
            points += [(self.x(left), self.y(count)), (self.x(right), self.y(count))]
        self.add_line(points + [(self.x(self.edges[-1]), BOTTOM)], color, 3)

    def add_axes(self, name):
        edges = self.edges
        self.add_line([(self.x(edges[0]), BOTTOM), (self.x(edges[-1]), BOTTOM)], INK, 2)
        every = math.ceil((len(edges) - 2) / 14)
        for i in range(len(edges) - 2, 0, -every):
            self.add_line([(self.x(edges[i]), BOTTOM), (self.x(edges[i]), BOTTOM - 8)], INK, 2)
            text = ("\u2265 " if i == len(edges) - 2 else "") + "%.4g" % edges[i]
            self.canvas.add_text(text, self.x(edges[i]) - 6 * len(text), BOTTOM - 42, 24)
        self.canvas.add_text(name, self.x(edges[-1]), BOTTOM - 100, 28, right=True)
        step = 10 ** math.floor(math.log10(self.highest))
        step = next(s for s in (step / 5, step / 2, step, 2 * step) if self.highest / s <= 8)
        step = max(1, step)
        for k in range(int(self.highest / step) + 1):
            y = self.y(k * step)
            self.add_line([(LEFT, y), (LEFT + self.width, y)], (0.85, 0.86, 0.88), 1)
            self.canvas.add_text(number(round(k * step)), LEFT - 16, y - 9, 24, right=True)


def fail(message):
    raise SystemExit("%s: error: %s" % (PROGRAM, message))


def read_report(path):
    """The edges; for the mesh after fitting and, if it is there, before: the counts, and a line on it."""
    try:
        with open(path) as file:
            quality = json.load(file)["quality"]
        histogram = quality["histograms"]["ARC"]
        edges, times = histogram["edges"], ["after"] + ["before"] * ("before" in histogram)
        counts = [histogram[when] for when in times]
        if len(edges) < 2 or any(b <= a for a, b in zip(edges, edges[1:])):
            raise ValueError("the edges do not increase")
        if any(len(c) != len(edges) + 1 for c in counts):
            raise ValueError("there must be one count more than edges")
        if any(count < 0 for c in counts for count in c):
            raise ValueError("a count is negative")
        if sum(map(sum, counts)) == 0:
            raise ValueError("there are no elements")
        rows = [quality[when]["all"] for when in times]
        texts = ["%s, mean %s, largest %s" % (counted(row["elements"], "elements"), decimal(row["ARC mean"]),
                                              decimal(row["ARC max"])) for row in rows]
    except OSError as error:
        fail("%s: %s" % (path, error.strerror))
    except KeyError as error:
        fail("%s: not a report with a histogram: there is no %s" % (path, error))
    except (ValueError, TypeError) as error:  # JSON errors are ValueErrors
        fail("%s: not a report with a histogram: %s" % (path, error))
    return edges, counts, texts


def decimal(value):
    return "infinite" if value is None else "%.3g" % value  # JSON has no infinity


def main():
    parser = argparse.ArgumentParser(prog=PROGRAM,
                                     description="Draws the histogram of aspect-ratio coefficients.")
    parser.add_argument("report", metavar="REPORT.json", help="report of mixed_mesh_3")
    parser.add_argument("picture", metavar="PICTURE.png", help="to write")
    options = parser.parse_args()

    vtk.vtkObject.GlobalWarningDisplayOff()  # errors are one line of ours
    edges, counts, texts = read_report(options.report)
    start_display()
    canvas = Canvas((1600, 1000), options.picture)
    canvas.unit = canvas.size[1] / 1000  # text as large as in the other pictures
    canvas.add_title("Aspect-ratio coefficient of all elements (ideal: 1)", "number of elements")
    diagram = Diagram(canvas, edges, max(map(max, counts)) * 1.05)
    diagram.add_axes("ARC")
    diagram.add_bars(counts[0], AFTER_COLOR)
    x = canvas.size[0] / canvas.unit - 840
    canvas.add_box(AFTER_COLOR, x, -122, 34, 26)
    canvas.add_text("the mesh: " + texts[0], x + 50, -118, 26)
    if len(counts) > 1:
        diagram.add_outline(counts[1], BEFORE_COLOR)
        diagram.add_line([(x, -154), (x + 34, -154)], BEFORE_COLOR, 3)
        canvas.add_text("before fitting: " + texts[1], x + 50, -163, 26)
    canvas.write(options.picture)


if __name__ == "__main__":
    main()
