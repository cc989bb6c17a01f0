# SPDX-License-Identifier: GPL-3.0-or-later
"""Mixed-element finite-element meshes from arrays, and computations on these meshes.

Points are (n, 3) arrays in mm, triangles are (m, 3) arrays of indices of points. The meshes are those of
make_mixed_mesh_3() in C++, and of the program mixed_mesh_3; the manual describes guarantees and parameters. Elements
are sorted by kind, as in files.

    import mixed_mesh_3 as mm3
    data = mm3.example_data()
    mesh, report = mm3.mesh(*data["brain"], region=data["region"], vertices=660)
    mm3.certify(mesh).all()
"""

import copy as _copy
import numbers as _numbers
import operator as _operator
import os as _os
import pathlib as _pathlib
import time as _time
import warnings as _warnings

import numpy as _np

from . import _core
from ._core import ElasticityError, Mesh, MeshingError, boundary_vertices
from ._page import Page, make_page as _make_page

__version__ = "0.1.0"
__all__ = ["Elasticity", "ElasticityError", "KINDS", "Mesh", "MeshingError", "Page", "adapt", "boundary_vertices", "certify",
           "complete_label", "defects", "example_data", "fit", "label_surface", "mesh", "mesh_labels", "optimize", "quality", "read_image",
           "read_surface", "resect", "warp"]

#: The kinds of elements, with the names of meshio: the values of Mesh.kinds are indices of this tuple.
KINDS = ("tetra", "pyramid", "wedge", "hexahedron")
_SIZES = (4, 5, 6, 8)
_VTK_TYPES = (10, 14, 13, 12)
_VTK_WEDGE = (0, 2, 1, 3, 5, 4)  # the mirror image of the wedge of meshio, Gmsh and this package


def _cells(self):
    """The elements: for each existing kind, their vertices as an array of shape (n, 4), (n, 5), (n, 6) or (n, 8)."""
    result = {}
    for number, kind in enumerate(KINDS):
        of_kind = _np.flatnonzero(self.kinds == number)
        if of_kind.size:
            result[kind] = self.connectivity[self.offsets[of_kind][:, None] + _np.arange(_SIZES[number])]
    return result


def _vtk_connectivity(self):
    connectivity = self.connectivity.astype(_np.int64)
    wedges = self.offsets[_np.flatnonzero(self.kinds == KINDS.index("wedge"))][:, None]
    connectivity[wedges + _np.arange(6)] = connectivity[wedges + _VTK_WEDGE]
    return connectivity


def _to_meshio(self):
    """The mesh as a meshio.Mesh, with labels; meshio must be installed."""
    import meshio
    cells = self.cells
    labels = [self.labels[self.kinds == KINDS.index(kind)] for kind in cells]
    return meshio.Mesh(_np.array(self.points), list(cells.items()), cell_data={"label": labels})


def _to_pyvista(self):
    """The mesh as a pyvista.UnstructuredGrid, with labels; PyVista must be installed."""
    import pyvista
    starts = self.offsets[:-1]
    cells = _np.insert(_vtk_connectivity(self), starts, _np.diff(self.offsets))
    grid = pyvista.UnstructuredGrid(cells, _np.array(_VTK_TYPES, dtype=_np.uint8)[self.kinds], _np.array(self.points))
    grid.cell_data["label"] = self.labels
    return grid


def _save(self, path, *, order=1, tetrahedra=False):
    """Writes a file as the program does: .vtu, .msh (Gmsh 4.1), .msh2 (Gmsh 2.2), .mesh, .inp or .feb.

    order: the order of the elements. Elements of order 2 are quadratic and straight-sided, with a node in the middle of
    each edge, numbered after the vertices; not in .mesh, and in .inp without pyramids only. tetrahedra: whether all
    elements are split into tetrahedra. Raises ValueError with the message of the program.
    """
    _core.save(self, _os.fspath(path), _count("order", order), bool(tetrahedra))


def _show(self, displacements=None, *, removed=None, report=None, title="mesh", height=620):
    """The mesh in 3D, as a Page: a notebook shows a page in the last line of a cell; save(path) writes a page to a file.

    displacements: displacements of vertices, (n, 3), with which the page deforms the mesh; removed: elements that are
    removed then. report: the report of mesh(), whose status, warnings and measures the page shows. title: the heading of
    the page; height: the height in pixels.
    """
    return _make_page(self, displacements, removed, report, str(title), int(height), __version__)


def _repr(self):
    counts = ", ".join(f"{len(v)} {kind}" for kind, v in self.cells.items())
    return f"<mixed_mesh_3.Mesh: {len(self.points)} vertices, {counts}>"


Mesh.cells = property(_cells)
Mesh.to_meshio = _to_meshio
Mesh.to_pyvista = _to_pyvista
Mesh.save = _save
Mesh.show = _show
Mesh.__repr__ = _repr


def _count(name, value):
    try:
        count = _operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: expected a whole number, not {value!r}") from None
    if count < 1:
        raise ValueError(f"{name}: expected at least 1, not {count}")
    return count


def _most_vertices(vertices):
    return 200000 if vertices == "auto" else _count("vertices", vertices)


def _number(name, value, is_right=lambda x: True, what=""):
    if not isinstance(value, _numbers.Real) or isinstance(value, bool):
        raise TypeError(f"{name}: expected a number, not {value!r}")
    if not is_right(value):
        raise ValueError(f"{name}: expected a number {what}, not {value}")
    return float(value)


def _not_negative(name, value):
    return _number(name, value, lambda x: 0 <= x < _np.inf, "of at least 0")


def _soup(name, soup):
    """Points and triangles of a surface, as arrays for the module."""
    try:
        points, triangles = soup
    except (TypeError, ValueError):
        raise ValueError(f"{name}: expected points and triangles, (points, triangles)") from None
    try:
        points, triangles = _np.asarray(points, dtype=float), _np.asarray(triangles)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: expected arrays of numbers, points of shape (n, 3) and triangles (m, 3)") from None
    if triangles.dtype.kind not in "iu":
        raise ValueError(f"{name}: triangles are numbers of points: expected integers, not {triangles.dtype}")
    return points, triangles


def _materials(materials, density):
    return {label: (*m, density)[:3] for label, m in (materials or {}).items()}


def _regions(region):
    if region is None:
        return []
    regions = region if isinstance(region, list) else [region]
    result = []
    for r in regions:
        soup, weight = (r[:2], r[2]) if isinstance(r, tuple) and len(r) == 3 else (r, 1.0)
        result.append((*_soup("region", soup), _number("region: weight", weight)))
    return result


def example_data():
    """The bundled brain: a dictionary of (points, triangles), in mm, for "brain", "region", a region of interest between a
    tumor and the opening of the skull, and "tumor"."""
    folder = _pathlib.Path(__file__).parent
    return {name: read_surface(folder / f"{file}.off")
            for name, file in (("brain", "brain"), ("region", "region"), ("tumor", "tumour"))}


def read_surface(path, *, strict=False, wrap=0.0):
    """A closed surface from a file: (points, triangles), in the unit of the file.

    Files: .off, .obj, .stl, .ply, .vtp, .vtk, .gii, or binary surfaces of FreeSurfer. Defects are repaired if possible,
    with a UserWarning; strict: such surfaces are rejected. wrap: the surface is wrapped; openings narrower than this
    diameter are closed. Raises ValueError with the file and its defect.
    """
    *surface, mended = _core.read_surface(_os.fspath(path), bool(strict), _not_negative("wrap", wrap))
    for text in mended:
        _warnings.warn(f"{path}: {text}", stacklevel=2)
    return tuple(surface)


def read_image(path):
    """A NIfTI image (.nii, .nii.gz): its values, and its affine map from indices to mm, (4, 4), as in nibabel."""
    return _core.read_image(_os.fspath(path))


def mesh(points, triangles, *, region=None, subdomains=None, vertices=660, tolerance=0.0, grading=0.35, exchange=True,
         base_level=None, quality_bound=3.2, sharp_angle=50.0, progress=None):
    """Meshes the inside of a closed surface, fine in a region of interest.

    region: (points, triangles) of a closed surface, or a list of them, each with an optional weight as its third entry;
        None: the whole domain.
    subdomains: {label: (points, triangles)}: inner parts; where they overlap, the first one counts; labels from 2 on,
        the rest has the label 1, and 0 is a cavity.
    vertices: the largest number of vertices; "auto": as few as the tolerance allows, found by five to ten meshes of up
        to 200,000 vertices.
    tolerance: the largest distance between boundary and surface, in mm; 0: a distance that the budget allows.
    exchange: whether vertices far from the region may be exchanged for vertices in the region, with at most 2,500 vertices.
    quality_bound: the largest aspect-ratio coefficient of an element.
    progress: called as progress(stage, vertices, budget); an exception of this function ends the run, as Ctrl-C does.

    Returns the mesh and a report: a dictionary with "status", "warnings", "Hausdorff distance", "seconds" and other
    measures. Raises ValueError if a surface does not bound a solid and cannot be repaired, MeshingError if there is no
    mesh.
    """
    start = _time.perf_counter()
    if vertices == "auto" and not tolerance > 0:
        raise ValueError('vertices: "auto" needs a tolerance')
    result, report = _core.mesh(
        _soup("surface", (points, triangles)), _regions(region),
        [(*_soup(f"subdomain {label}", s), label) for label, s in (subdomains or {}).items()],
        _most_vertices(vertices), vertices == "auto", _not_negative("tolerance", tolerance),
        _not_negative("grading", grading), bool(exchange), base_level,
        _number("quality_bound", quality_bound, lambda x: x == 0 or x >= 1, "of at least 1, or 0 for none"),
        _number("sharp_angle", sharp_angle, lambda x: 0 <= x <= 180, "from 0 to 180"), progress)
    report["seconds"] = _time.perf_counter() - start
    return result, report


def complete_label(image, affine, labels=None, *, close=None, fill_holes=False, largest=False, drop_below=0, hull=False):
    """The voxels of an image that have one of some labels, completed: an image of 1 and 0, for label_surface().

    labels: None: all values that are not 0. The steps, in their order: close: fills gaps, grooves and openings that a
    ball of this radius in mm does not enter; fill_holes: fills space that the label encloses; largest: keeps only the
    largest component; drop_below: keeps only components of at least this volume, in ml. hull: close, fill_holes and
    largest, by 13 % of the edge of a cube of the label's volume, 15 mm for a brain, if close is not given: the solid
    organ from an atlas.
    """
    image = _np.asarray(image)
    values = _np.unique(image[image != 0]) if labels is None else _np.atleast_1d(labels)
    return _core.complete_label(image, affine, {float(value) for value in values}, close, fill_holes, largest, drop_below,
                                hull).astype(_np.uint8)


def label_surface(image, affine, labels, *, smoothing=None, vertices=20000):
    """The surface of the voxels of an image that have one of some labels: (points, triangles), in mm.

    affine: (4, 4), from indices to mm, as in nibabel. smoothing: standard deviation of the Gaussian in mm; None: a voxel.
    vertices: the number of vertices after simplification.
    """
    return _core.label_surface(image, affine, {float(label) for label in _np.atleast_1d(labels)}, smoothing,
                               _count("vertices", vertices))


def mesh_labels(image, affine, labels=None, *, smoothing=None, vertices=660, **options):
    """Meshes an image of labels.

    labels: the values to mesh; None: all that are not 0. The label with most voxels surrounds the others, and has the
    label 1 in the mesh; the others keep their values (from 2 on). options: as for mesh().
    """
    image = _np.asarray(image)
    values, counts = _np.unique(image[image != 0] if labels is None else image[_np.isin(image, labels)], return_counts=True)
    if not values.size:
        raise ValueError("image: there are no voxels with these labels")
    if (values != _np.floor(values)).any() or (values < 1).any():
        raise ValueError("image: labels are whole numbers from 1 on")
    largest = int(counts.argmax())

    def surface(of, share):  # no finer than the mesh can follow
        finer, least = (3, 1000) if share < 1 else (1, 2000)
        size = max(finer * 20 * (share * _most_vertices(vertices)) ** (2 / 3), least)
        return label_surface(image, affine, of, smoothing=smoothing, vertices=int(size))

    parts = {}
    for value, count in zip(values, counts):
        if value == values[largest]:
            continue
        if value == 1:
            raise ValueError("image: label 1 is that of what is around the others; give it to the label with most voxels")
        points, triangles = surface(value, count / counts.sum())
        if len(points):  # otherwise smoothing has removed the label
            parts[int(value)] = (points, triangles)
    around = surface(values, 1)
    if not len(around[0]):
        raise ValueError("image: nothing is left of the labels after smoothing")
    result, report = mesh(*around, subdomains=parts, vertices=vertices, **options)
    meshed = set(_np.unique(result.labels)) - {1}
    report["labels lost"] = sorted({int(v) for i, v in enumerate(values) if i != largest} - meshed)
    return result, report


def optimize(mesh, points, triangles, *, tolerance=0.0, quality_bound=3.2, bisections=0, flips=True,
             progress=None):
    """A mesh with its boundary on the surface and better elements, and a report; the given mesh does not change. Without
    flips, the mesh has the same vertices and elements, as for an atlas after fit()."""
    result = _copy.copy(mesh)
    return result, _core.optimize(result, _soup("surface", (points, triangles)), _not_negative("tolerance", tolerance),
                                  quality_bound, bisections, flips, progress)


def fit(mesh, points, triangles, *, progress=None):
    """A mesh with its boundary brought onto another surface by elastic relaxation (an atlas to a subject), and a
    report; the given mesh does not change."""
    result = _copy.copy(mesh)
    return result, _core.fit(result, _soup("surface", (points, triangles)), progress)


def certify(mesh):
    """For each element, whether its Jacobian is proved to be positive on the whole element, exactly."""
    return _core.certify(mesh)


def defects(mesh):
    """The defects of a mesh, as a dictionary of numbers: all 0 if there is no defect."""
    return _core.defects(mesh)


def quality(mesh, measure="ARC"):
    """A measure of each element: "ARC", the aspect-ratio coefficient, "scaled Jacobian" or "volume"."""
    return _core.quality(mesh, measure)


def adapt(mesh, cases, *, young_modulus=1.0, poisson_ratio=0.3, materials=None, quality_bound=3.2, solves=20):
    """A mesh whose inner vertices are where elements have less energy, and less error, under the loads to come, and a
    report; the given mesh does not change.

    cases: load cases, each (vertices, displacements): an array of truth values that marks the vertices with prescribed
    displacements, enough to hold rigid motions, and the displacements, (n, 3) in mm, 0 where a vertex is held. Without
    known loads, unit bumps of the boundary around the opening, along its normal and two tangents, are a good choice.
    materials: as for Elasticity. Standard elements lock at a high Poisson's ratio, and the energy would be that of locking.
    quality_bound: the largest aspect-ratio coefficient of an element. solves: how often the cases are solved at most.
    """
    result = _copy.copy(mesh)
    return result, _core.adapt(
        result, [(_np.asarray(vertices), _np.asarray(displacements, dtype=float)) for vertices, displacements in cases],
        _materials(materials, 0.0), (young_modulus, poisson_ratio, 0.0),
        _number("quality_bound", quality_bound, lambda x: x == 0 or x >= 1, "of at least 1, or 0 for none"),
        _count("solves", solves))


def resect(mesh, points=None, triangles=None, *, label=None):
    """The elements that a closed surface encloses, or that have a label, to be removed: an array of truth values."""
    if (points is None) == (label is None):
        raise ValueError("resect(): expected points and triangles, or a label")
    return _core.resect_elements(mesh, mesh.labels == label) if points is None else _core.resect(mesh, points, triangles)


def warp(image, affine, mesh, displacements, *, removed=None, is_of_labels=False, edges=(), edge_coefficients=()):
    """An image that follows the displacements of a mesh's vertices.

    edges, edge_coefficients: those of Elasticity, for displacements of order 2. removed: elements that were resected.
    is_of_labels: values are those of the nearest voxel. Returns the image, the
    forward and backward displacement fields, of shape (i, j, k, 3) in mm, and a mask: 0 outside, 1 tissue, 2 resected.
    """
    warped, *rest = _core.warp(image, affine, mesh, displacements, removed, is_of_labels, edges,
                               _np.reshape(edge_coefficients, (-1, 3)))
    return (warped.astype(_np.asarray(image).dtype) if is_of_labels else warped, *rest)


class Elasticity(_core.Elasticity):
    """Elasticity: computes displacements of a mesh's vertices, in mm, from displacements of control points. Rotations are
    small, or finite after set_corotational(True).

        model = Elasticity(mesh, young_modulus=3.0)
        model.fix(is_fixed)
        model.set_control_points(points)
        displacements = model.solve(displacements_of_points)

    young_modulus is in kPa, density in kg/mm^3. materials: {label: (young_modulus, poisson_ratio)}, with an optional
    density as third entry, for labels with another material. order: of displacements in elements, 1 or 2, or "region" for 2
    in the region of the mesh and 4 mm around, both without contact and finite rotations. With order 2, the middle of
    edges[i] has the mean displacement of both ends plus edge_coefficients[i]. Errors raise ElasticityError, with the reason.
    """

    def __init__(self, mesh, young_modulus=1.0, poisson_ratio=0.45, density=1e-6, *, materials=None, order=1):
        super().__init__(mesh, _materials(materials, density), (young_modulus, poisson_ratio, density))
        if order == "region":
            self.set_order_2_within(4.0)
        else:
            self.set_order(order)

    def set_control_points(self, points, *, largest_distance=0.0, compliance=0.0, radius=0.0, weights=()):
        """Sets the points at which displacements are given. largest_distance: up to this distance outside, the nearest
        point of the boundary replaces a point. compliance: of the springs at the points, in mm/mN, divided by the weight
        of each point. radius: displacements are means over this radius."""
        super().set_control_points(points, largest_distance, compliance, radius, weights)

    def solve(self, displacements=None):
        """The displacement of each vertex, (n, 3) in mm, for displacements of the control points."""
        return super().solve(_np.empty((0, 3)) if displacements is None else displacements)
