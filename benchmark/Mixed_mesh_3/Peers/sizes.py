# SPDX-License-Identifier: GPL-3.0-or-later
"""The sizes that all peers are asked for, and what their formats need: triangles in, a background grid out."""

import argparse
import itertools

import numpy


def argument_parser(description):
    """What the programs that mesh with one peer are called with."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawTextHelpFormatter)
    for name in ("surface", "region", "mesh"):
        parser.add_argument(name)
    parser.add_argument("size", type=float)
    parser.add_argument("--growth", type=float, default=0.4)
    parser.add_argument("--largest", type=float, default=20)
    return parser


def read_off(path):
    """Points and triangles of an OFF file without comments."""
    words = open(path).read().split()
    points, triangles = int(words[1]), int(words[2])
    coordinates = numpy.array(words[4:4 + 3 * points], float).reshape(-1, 3)
    faces = numpy.array(words[4 + 3 * points:4 + 3 * points + 4 * triangles], int).reshape(-1, 4)[:, 1:]
    return coordinates, faces


def write_stl(path, points, triangles):
    with open(path, "w") as out:
        out.write("solid s\n")
        for t in triangles:
            out.write("facet normal 0 0 0\nouter loop\n")
            for v in t:
                out.write("vertex {!r} {!r} {!r}\n".format(*map(float, points[v])))
            out.write("endloop\nendfacet\n")
        out.write("endsolid s\n")


class Sizes:
    """As benchmark_mesh_3 has them: h in the region, growing with the distance from it up to the largest."""

    def __init__(self, surface, region, cells_along_diagonal=24):
        points, _ = read_off(surface)
        low, high = points.min(0), points.max(0)
        step = numpy.linalg.norm(high - low) / cells_along_diagonal
        self.shape = numpy.ceil((high - low) / step).astype(int) + 1 + 2  # one cell more on all sides
        axes = [low[k] + step * (numpy.arange(self.shape[k]) - 1) for k in range(3)]
        self.points = numpy.stack(numpy.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
        self.distances = distances(self.points, *read_off(region))

    def at_points(self, in_region, growth, largest):
        return numpy.minimum(in_region + growth * numpy.maximum(self.distances, 0), largest)

    def tetrahedra(self):
        """Six for each cell, around its diagonal."""
        index = numpy.arange(len(self.points)).reshape(self.shape)
        result = []
        for order in itertools.permutations(range(3)):
            corner, corners = numpy.zeros(3, int), []
            for axis in (None, *order):
                if axis is not None:
                    corner[axis] = 1
                corners.append(index[tuple(slice(c, n - 1 + c) for c, n in zip(corner, self.shape))].ravel())
            # odd permutations are mirror images
            is_odd = numpy.linalg.det(numpy.eye(3)[list(order)]) < 0
            result.append(numpy.stack([corners[i] for i in ((0, 2, 1, 3) if is_odd else (0, 1, 2, 3))], 1))
        return numpy.concatenate(result)


def distances(points, surface_points, triangles):
    """Signed, negative inside."""
    import vtk
    from vtk.util import numpy_support
    data, cells = vtk.vtkPolyData(), vtk.vtkCellArray()
    coordinates = vtk.vtkPoints()
    coordinates.SetData(numpy_support.numpy_to_vtk(surface_points, deep=True))
    for t in triangles:
        cells.InsertNextCell(3, [int(v) for v in t])
    data.SetPoints(coordinates)
    data.SetPolys(cells)
    distance = vtk.vtkImplicitPolyDataDistance()
    distance.SetInput(data)
    return numpy.array([distance.EvaluateFunction(p) for p in points])
