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
import errno as _errno
import numbers as _numbers
import operator as _operator
import os as _os
import pathlib as _pathlib
import time as _time
import typing as _typing
import warnings as _warnings

import numpy as _np

from . import _core
from ._core import ElasticityError, Mesh, MeshingError, boundary_faces, boundary_vertices
from ._page import Page, make_page as _make_page

__version__ = "0.1.0"
__all__ = ["Elasticity", "ElasticityError", "KINDS", "Mesh", "MeshingError", "Page", "Patch", "adapt", "boundary_faces",
           "boundary_vertices", "certify", "complete_label", "defects", "example_data", "fit", "from_meshio", "label_surface",
           "mesh", "mesh_labels", "optimize", "quality", "read_image", "read_mesh", "read_surface", "resect", "warp"]

#: The kinds of elements, with the names of meshio: the values of Mesh.kinds are indices of this tuple.
KINDS = _core.KINDS
_SIZES = (4, 5, 6, 8)
_VTK_TYPES = (10, 14, 13, 12)
#: Poisson's ratio of all materials, if not given, as in the programs; and the largest with which adapt() computes.
_POISSON_RATIO = 0.45
_LARGEST_POISSON_RATIO_OF_ADAPTATION = 0.3  # standard elements, which it needs, lock above
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


def _names(self):
    """The names of subdomains, {label: name}, which save() writes and copies keep."""
    return self.__dict__.setdefault("_names", {})


def _set_names(self, names):
    self.__dict__["_names"] = {int(label): str(name) for label, name in names.items()}


class Patch(_typing.NamedTuple):
    """A patch of the boundary: faces are indices of the rows of boundary_faces(), vertices are indices of vertices."""

    faces: _np.ndarray
    vertices: _np.ndarray


def _shape(kind, place):
    """The numbers of a sphere, a box or a plane."""
    form, size = {"sphere": ("((x, y, z), radius)", ()), "box": ("((x0, y0, z0), (x1, y1, z1))", (3,)),
                  "plane": ("((x, y, z), (nx, ny, nz))", (3,))}[kind]
    try:
        parts = [_np.asarray(part, dtype=float) for part in place]
    except (TypeError, ValueError):
        parts = []
    if [part.shape for part in parts] != [(3,), size] or not all(_np.isfinite(part).all() for part in parts):
        raise ValueError(f"{kind}: expected numbers, {form}")
    return _np.hstack(parts)


def _patch(self, *, sphere=None, box=None, plane=None, surface=None):
    """A patch of the boundary, as that of the option --patch of the program: the faces whose center is inside a shape.

    One of: sphere: (center, radius). box: (lower, upper), two corners. plane: (point, normal): faces on the plane or
    beyond, where the normal points to. surface: (points, triangles) of a closed surface, mended as by mesh().

        model.fix(mesh.patch(plane=((0, 0, -20), (0, 0, -1))).vertices)
        mesh.save("brain.inp", patches={"opening": mesh.patch(sphere=((10, -20, 40), 25))})

    Returns a Patch, whose faces are ascending, and whose vertices are those of the faces. Raises ValueError if there is
    no such face.
    """
    given = [(kind, place) for kind, place in (("sphere", sphere), ("box", box), ("plane", plane), ("surface", surface))
             if place is not None]
    if len(given) != 1:
        raise ValueError("patch(): expected one of sphere, box, plane and surface")
    (kind, place), = given
    if kind != "surface":
        return Patch(*_core.patch_in_shape(self, kind, _shape(kind, place)))
    patch, mended = _core.patch_in_surface(self, *_soup("surface", place))
    _warn(mended, 2)
    return Patch(*patch)


def _patches(mesh, patches):
    """Patches as pairs of a name and truth values of the faces of the boundary."""
    size = len(boundary_faces(mesh)) if patches else 0
    return [(str(name), _marks(f"patch {name}", patch.faces if isinstance(patch, Patch) else patch, size))
            for name, patch in (patches or {}).items()]


def _save(self, path, *, order=1, tetrahedra=False, names=None, point_data=None, cell_data=None, patches=None,
          interfaces=True):
    """Writes a file as the program does: .vtu, .msh (Gmsh 4.1), .msh2 (Gmsh 2.2), .mesh, .inp or .feb.

    order: the order of the elements. Elements of order 2 are quadratic and straight-sided, with a node in the middle of
    each edge, numbered after the vertices; not in .mesh, and in .inp without pyramids only. tetrahedra: whether all
    elements are split into tetrahedra. names: {label: name} of subdomains; None: those of the mesh. .msh2 and .mesh have no
    place for them. point_data: {name: values} of vertices, (n,) or (n, components), for .vtu, .msh, .msh2 and .feb;
    cell_data: of elements, for .vtu. patches: {name: patch} of the boundary, each as of Mesh.patch(), or faces by truth
    values or indices of the rows of boundary_faces(): the facet sets and node sets of the program's --patch. interfaces:
    whether the interfaces of several subdomains are facet sets, too, such as interface_brain_tumor and outside_brain. In
    .msh2 and .mesh, no face is in two sets. Raises ValueError with the message of the program.
    """
    _core.save(self, _os.fspath(path), _count("order", order), bool(tetrahedra),
               self.names if names is None else dict(names), _data(point_data), _data(cell_data), _patches(self, patches), bool(interfaces))


def _extract(self, subdomains):
    """The elements of some subdomains, with their vertices, as a mesh of its own: as the program's --extract.

    subdomains: labels or names, in any order, or one of them. Vertices and elements keep their order, elements their
    labels, and subdomains their names: element i of the result is `numpy.flatnonzero(numpy.isin(mesh.labels, labels))[i]`
    of the mesh. Interfaces with what is left out become boundary, which need not be a manifold: see defects(). Raises
    ValueError if there is no element of a subdomain.

        skull = mesh.extract(["skull"])
    """
    chosen = [subdomains] if isinstance(subdomains, (str, _numbers.Integral)) else list(subdomains)
    labels = {_count("extract(): label", _label(self, label)) for label in chosen}
    if not labels:
        raise ValueError("extract(): expected at least one subdomain")
    for label in sorted(labels - set(self.labels.tolist())):
        name = f", {self.names[label]!r}" if label in self.names else ""
        raise ValueError(f"extract(): there is no element with the label {label}{name}")
    result = _core.extract(self, sorted(labels))
    result.names = {label: name for label, name in self.names.items() if label in labels}
    return result


def _data(data):
    return {str(name): _np.asarray(values, dtype=float) for name, values in (data or {}).items()}


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
Mesh.names = property(_names, _set_names)
Mesh.to_meshio = _to_meshio
Mesh.to_pyvista = _to_pyvista
Mesh.patch = _patch
Mesh.extract = _extract
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


def _label(mesh, label):
    """The label of a subdomain that is given by label or name."""
    if not isinstance(label, str):
        return label
    for number, name in mesh.names.items():
        if name == label:
            return number
    raise ValueError(f"there is no subdomain with the name {label!r}, see Mesh.names")


def _materials(mesh, materials, density):
    return {_label(mesh, label): (*m, density)[:3] for label, m in (materials or {}).items()}


def _marks(name, chosen, size):
    """Truth values of all vertices or elements, of which some are chosen: by truth values, or by indices."""
    chosen = _np.asarray(chosen)
    if chosen.dtype == bool or not chosen.size:
        return chosen if chosen.size else _np.zeros(size, bool)
    if chosen.dtype.kind not in "iu" or chosen.ndim != 1:
        raise ValueError(f"{name}: expected {size} truth values, or indices")
    if chosen.min() < 0 or chosen.max() >= size:
        raise ValueError(f"{name}: expected indices from 0 to {size - 1}")
    marks = _np.zeros(size, bool)
    marks[chosen] = True
    if marks.sum() != chosen.size:
        raise ValueError(f"{name}: an index is there twice; truth values are of the type bool")
    return marks


def _ball(name, center, radius):
    """A polyhedron with its 642 vertices on a sphere, as points and triangles."""
    radius = _number(f"{name}: radius", radius, lambda x: 0 < x < _np.inf, "greater than 0")
    center = _np.asarray(center, dtype=float)
    if center.shape != (3,):
        raise ValueError(f"{name}: expected a center of three coordinates, and a radius")
    t = (1 + 5 ** 0.5) / 2
    points = _np.array([[-1, t, 0], [1, t, 0], [-1, -t, 0], [1, -t, 0], [0, -1, t], [0, 1, t],
                        [0, -1, -t], [0, 1, -t], [t, 0, -1], [t, 0, 1], [-t, 0, -1], [-t, 0, 1]])
    triangles = _np.array([[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2],
                           [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5],
                           [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]])
    for _ in range(3):  # each triangle becomes four
        edges, middles = _np.unique(_np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2), axis=0,
                                    return_inverse=True)
        ab, bc, ca = (len(points) + middles.reshape(-1, 3)).T
        a, b, c = triangles.T
        points = _np.concatenate([points, points[edges].mean(axis=1)])
        triangles = _np.concatenate([_np.stack(corners, axis=1)
                                     for corners in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return center + radius * points / _np.linalg.norm(points, axis=1)[:, None], triangles


def _regions(region):
    if region is None:
        return []
    regions = region if isinstance(region, list) else [region]
    result = []
    for r in regions:
        soup, weight = (r[:2], r[2]) if isinstance(r, tuple) and len(r) == 3 else (r, 1.0)
        is_ball = isinstance(soup, tuple) and len(soup) == 2 and isinstance(soup[1], _numbers.Real)
        surface = _ball("region", *soup) if is_ball else _soup("region", soup)
        result.append((*surface, _number("region: weight", weight)))
    return result


def _subdomains(subdomains):
    """The surfaces of subdomains with their labels, and the names of labels: a name gets the next label that is free."""
    labels = {key for key in subdomains if not isinstance(key, str)}
    names, result = {}, []
    free = 2
    for key, surface in subdomains.items():
        label = key
        if isinstance(key, str):
            while free in labels:
                free += 1
            label = free
            labels.add(label)
            names[label] = key
        result.append((*_soup(f"subdomain {key}", surface), label))
    return result, names


def _surfaces(name, surfaces):
    return [_soup(f"{name} {i}", surface) for i, surface in enumerate(surfaces)]


def _warn(texts, stacklevel):
    for text in texts:
        _warnings.warn(text, stacklevel=stacklevel + 1)


def _existing(path):
    path = _os.fspath(path)
    if not _os.path.exists(path):
        raise FileNotFoundError(_errno.ENOENT, _os.strerror(_errno.ENOENT), path)
    return path


def example_data():
    """The bundled brain: a dictionary of (points, triangles), in mm, for "brain", "region", a region of interest between a
    tumor and the opening of the skull, and "tumor"."""
    folder = _pathlib.Path(__file__).parent
    return {name: read_surface(folder / f"{file}.off")
            for name, file in (("brain", "brain"), ("region", "region"), ("tumor", "tumour"))}


def read_surface(path, *, strict=False, wrap=0.0, weld=0.0, largest=False, drop_below=0.0):
    """A closed surface from a file: (points, triangles), in the unit of the file.

    Files: .off, .obj, .stl, .ply, .vtp, .vtk, .gii, or binary surfaces of FreeSurfer. Defects are repaired if possible,
    with a UserWarning; strict: such surfaces are rejected. wrap: the surface is wrapped; openings narrower than this
    diameter are closed. weld: where the surface is not closed, points up to this distance apart are one point; 0: a
    millionth of the surface's diagonal. largest: only the largest component is kept, with its cavities. drop_below:
    components and cavities of less volume are dropped. Raises FileNotFoundError, or ValueError with the file and its
    defect.
    """
    *surface, mended = _core.read_surface(_existing(path), bool(strict), _not_negative("wrap", wrap),
                                          _not_negative("weld", weld), bool(largest),
                                          _not_negative("drop_below", drop_below))
    _warn([f"{path}: {text}" for text in mended], 2)
    return tuple(surface)


def read_image(path):
    """An image of NIfTI (.nii, .nii.gz) or FreeSurfer (.mgh, .mgz): its values, and its affine map from indices to mm,
    (4, 4), as in nibabel."""
    return _core.read_image(_existing(path))


def read_mesh(path):
    """A mesh of linear elements from a file: .vtu, .msh, .mesh, .ele (TetGen) or .vol (Netgen), with its labels and their
    names. Elements of lower dimension are skipped. The mesh is not checked, see defects(). Raises FileNotFoundError, or
    ValueError with the file and its defect."""
    result, names = _core.read_mesh(_existing(path))
    result.names = names
    return result


def from_meshio(mesh):
    """A mesh from a meshio.Mesh: its tetrahedra, pyramids, wedges and hexahedra of order 1; other cells are skipped.

    Labels are those of the cell data "label", "subdomain", "gmsh:physical" or "medit:ref", else 1; they have the names of
    the field data. Raises ValueError if there are no such elements.
    """
    chosen = [(i, block) for i, block in enumerate(mesh.cells) if block.type in KINDS]
    if not chosen:
        raise ValueError(f"from_meshio(): expected cells of the types {', '.join(KINDS)}")
    kinds = _np.concatenate([_np.full(len(block.data), KINDS.index(block.type), _np.uint8) for _, block in chosen])
    connectivity = _np.concatenate([_np.asarray(block.data, dtype=_np.int64).ravel() for _, block in chosen])
    labels = None
    for name in ("label", "subdomain", "gmsh:physical", "medit:ref"):
        if labels is None and name in mesh.cell_data:
            labels = _np.concatenate([_np.asarray(mesh.cell_data[name][i]) for i, _ in chosen]).astype(_np.int64)
    result = Mesh(mesh.points, kinds, connectivity, labels)
    present = set() if labels is None else set(labels.tolist())
    result.names = {int(data[0]): name for name, data in mesh.field_data.items()
                    if len(data) == 2 and data[1] == 3 and int(data[0]) in present}
    return result


def mesh(points, triangles, *, region=None, subdomains=None, cavities=(), sheets=(), vertices=2000, tolerance=0.0,
         grading=0.35, simplification=True, base_level=None, quality_bound=3.2, sharp_angle=50.0, time_limit=None, threads=None,
         progress=None):
    """Meshes the inside of a closed surface, fine in a region of interest.

    region: (points, triangles) of a closed surface, or (center, radius) of a ball, or a list of them, each with an
        optional weight as its third entry; None: the whole domain.
    subdomains: {label: (points, triangles)} or {name: (points, triangles)}: inner parts; where they overlap, the first
        one counts; labels from 2 on, the rest has the label 1, and 0 is a cavity. A name gets the next label that is
        free, see Mesh.names.
    cavities: surfaces, (points, triangles), whose inside is not meshed.
    sheets: surfaces, (points, triangles), that need not be closed: faces of elements are on them. The entry "sheets" of
        the report has these faces.
    vertices: the largest number of vertices; "auto": as few as the tolerance allows, found by five to ten meshes of up
        to 200,000 vertices.
    tolerance: the largest distance between boundary and surface, in mm; 0: a distance that the budget allows.
    simplification: whether the mesh may begin finer and lose vertices by edge collapses; else it has those of an octree.
    quality_bound: the largest aspect-ratio coefficient of an element.
    time_limit: after that number of seconds, the mesh is what there is then, with the status "stopped". None: no limit.
    threads: the largest number of threads; None: as many as there are processors. The mesh is the same.
    progress: called as progress(stage, vertices, budget); an exception of this function ends the run, as Ctrl-C does.

    Returns the mesh and a report: a dictionary with "status", "warnings", "Hausdorff distance", "seconds" and other
    measures. Each of the warnings is a UserWarning, too. Raises ValueError if a surface does not bound a solid and cannot
    be repaired, MeshingError if there is no mesh.
    """
    start = _time.perf_counter()
    if vertices == "auto" and not tolerance > 0:
        raise ValueError('vertices: "auto" needs a tolerance')
    parts, names = _subdomains(subdomains or {})
    result, report = _core.mesh(
        _soup("surface", (points, triangles)), _regions(region),
        [(*surface, 0) for surface in _surfaces("cavity", cavities)] + parts,
        _most_vertices(vertices), vertices == "auto", _not_negative("tolerance", tolerance),
        _not_negative("grading", grading), bool(simplification), base_level,
        _number("quality_bound", quality_bound, lambda x: x == 0 or x >= 1, "of at least 1, or 0 for none"),
        _number("sharp_angle", sharp_angle, lambda x: 0 <= x <= 180, "from 0 to 180"), progress,
        _surfaces("sheet", sheets),
        _np.inf if time_limit is None else _number("time_limit", time_limit, lambda x: x > 0, "greater than 0"),
        None if threads is None else _count("threads", threads))
    report["seconds"] = _time.perf_counter() - start
    result.names = names
    _warn(report["warnings"], 2)
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


def _chosen_labels(image, labels):
    """The values of an image that count as labels, and the numbers of their voxels."""
    values, counts = _np.unique(image[image != 0] if labels is None else image[_np.isin(image, labels)], return_counts=True)
    if not values.size:
        raise ValueError("image: there are no voxels with these labels")
    if (values != _np.floor(values)).any() or (values < 1).any():
        raise ValueError("image: labels are whole numbers from 1 on")
    return values, counts


def mesh_labels(image, affine, labels=None, *, region_labels=None, names=None, hull=False, smoothing=None, vertices=2000,
                **options):
    """Meshes an image of labels.

    labels: the values to mesh; None: all that are not 0. The label with most voxels surrounds the others, and has the
    label 1 in the mesh; the others keep their values (from 2 on). region_labels: the values of the region of interest,
    which is fine. names: {value: name} of labels, for Mesh.names. hull: the solid organ is meshed, as complete_label()
    makes it; what it adds belongs to the label with most voxels. options: as for mesh().
    """
    image = _np.asarray(image)
    values, counts = _chosen_labels(image, labels)
    largest = int(counts.argmax())
    if region_labels is not None:
        if options.get("region") is not None:
            raise ValueError("mesh_labels(): expected region or region_labels, not both")
        options["region"] = label_surface(image, affine, region_labels, smoothing=smoothing)
        if not len(options["region"][0]):
            raise ValueError("region_labels: nothing is left of them after smoothing")
    if hull:
        solid = complete_label(image, affine, values, hull=True) != 0
        image = _np.where(solid, _np.where(_np.isin(image, values), image, values[largest]), 0)
        counts = _np.array([(image == value).sum() for value in values])

    def surface(of, share):  # no finer than the mesh can follow
        finer, least = (3, 1000) if share < 1 else (1, 2000)
        size = max(finer * 20 * (share * _most_vertices(vertices)) ** (2 / 3), least)
        return label_surface(image, affine, of, smoothing=smoothing, vertices=int(size))

    parts = {}
    for i, value in enumerate(values):
        if i == largest:
            continue
        if value == 1:
            raise ValueError("image: label 1 is that of what is around the others; give it to the label with most voxels")
        points, triangles = surface(value, counts[i] / counts.sum())
        if len(points):  # otherwise smoothing has removed the label
            parts[int(value)] = (points, triangles)
    around = surface(values, 1)
    if not len(around[0]):
        raise ValueError("image: nothing is left of the labels after smoothing")
    result, report = mesh(*around, subdomains=parts, vertices=vertices, **options)
    meshed = set(_np.unique(result.labels)) - {1}
    report["labels lost"] = sorted({int(v) for i, v in enumerate(values) if i != largest} - meshed)
    _warn([f"label {label} is lost: too small for the cells, or for smoothing" for label in report["labels lost"]], 2)
    result.names = {1 if value == values[largest] else int(value): name for value, name in (names or {}).items()}
    return result, report


def optimize(mesh, points, triangles, *, tolerance=0.0, quality_bound=3.2, bisections=0, flips=True,
             progress=None):
    """A mesh with its boundary on the surface and better elements, and a report; the given mesh does not change. Without
    flips, the mesh has the same vertices and elements, as for an atlas after fit()."""
    result = _copy.copy(mesh)
    report = _core.optimize(result, _soup("surface", (points, triangles)), _not_negative("tolerance", tolerance),
                            quality_bound, bisections, flips, progress)
    _warn(report["warnings"], 2)
    return result, report


def fit(mesh, points, triangles, *, progress=None):
    """A mesh with its boundary brought onto another surface by elastic relaxation (an atlas to a subject), and a
    report; the given mesh does not change."""
    result = _copy.copy(mesh)
    report = _core.fit(result, _soup("surface", (points, triangles)), progress)
    _warn(report["warnings"], 2)
    return result, report


def certify(mesh):
    """For each element, whether its Jacobian is proved to be positive on the whole element, exactly."""
    return _core.certify(mesh)


def defects(mesh):
    """The defects of a mesh, as a dictionary of numbers: all 0 if there is no defect."""
    return _core.defects(mesh)


def quality(mesh, measure="ARC"):
    """A measure of each element: "ARC", the aspect-ratio coefficient, "scaled Jacobian" or "volume"."""
    return _core.quality(mesh, measure)


def adapt(mesh, cases, *, young_modulus=1.0, poisson_ratio=_POISSON_RATIO, materials=None, quality_bound=3.2,
          solves=20):
    """A mesh whose inner vertices are where elements have less energy, and less error, under the loads to come, and a
    report; the given mesh does not change.

    cases: load cases, each (vertices, displacements): an array of truth values that marks the vertices with prescribed
    displacements, enough to hold rigid motions, and the displacements, (n, 3) in mm, 0 where a vertex is held. Without
    known loads, unit bumps of the boundary around the opening, along its normal and two tangents, are a good choice.
    materials: as for Elasticity. Standard elements lock at a high Poisson's ratio, and the energy would be that of locking:
    as in brain_shift, the ratio is taken as 0.3 if it is larger.
    quality_bound: the largest aspect-ratio coefficient of an element. solves: how often the cases are solved at most.
    """
    def softer(material):
        young, poisson, density = material
        return young, min(poisson, _LARGEST_POISSON_RATIO_OF_ADAPTATION) if poisson < 0.5 else poisson, density

    result = _copy.copy(mesh)
    return result, _core.adapt(
        result, [(_marks("cases: vertices", vertices, len(mesh.points)), _np.asarray(displacements, dtype=float))
                 for vertices, displacements in cases],
        {label: softer(m) for label, m in _materials(mesh, materials, 0.0).items()},
        softer((young_modulus, poisson_ratio, 0.0)),
        _number("quality_bound", quality_bound, lambda x: x == 0 or x >= 1, "of at least 1, or 0 for none"),
        _count("solves", solves))


def resect(mesh, points=None, triangles=None, *, label=None):
    """The elements that a closed surface encloses, or that have a label, or its name, to be removed: an array of truth
    values."""
    if (points is None) == (label is None):
        raise ValueError("resect(): expected points and triangles, or a label")
    return _core.resect_elements(mesh, mesh.labels == _label(mesh, label)) if points is None else _core.resect(mesh, points, triangles)


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
    density as third entry, for labels, or names of labels, with another material. Vertices are chosen by an array of truth
    values, or by indices. order: of displacements in elements, 1 or 2, or "region" for 2 in the region of the mesh and 4 mm
    around, both without contact and finite rotations. With order 2, the middle of edges[i] has the mean displacement of both
    ends plus edge_coefficients[i]. Errors raise ElasticityError, with the reason.
    """

    def __init__(self, mesh, young_modulus=1.0, poisson_ratio=_POISSON_RATIO, density=1e-6, *, materials=None, order=1):
        super().__init__(mesh, _materials(mesh, materials, density), (young_modulus, poisson_ratio, density))
        self._numbers = len(mesh.points), len(mesh.kinds)
        if order == "region":
            self.set_order_2_within(4.0)
        else:
            self.set_order(order)

    def fix(self, vertices):
        """Vertices that stay where they are. Supports are set before the first control points and the first solution, and
        hold the rigid motions that control points leave free."""
        super().fix(_marks("fix()", vertices, self._numbers[0]))

    def slide(self, vertices):
        """Boundary vertices that move along the boundary only: the displacement along its normal there is 0, in both
        directions."""
        super().slide(_marks("slide()", vertices, self._numbers[0]))

    def touch(self, vertices, gap=0.0):
        """Boundary vertices that may leave the skull and slide, but not move outwards by more than the gap, in mm. solve()
        finds which of them are in contact; contact_forces() are positive there."""
        super().touch(_marks("touch()", vertices, self._numbers[0]), gap)

    def remove(self, elements):
        """Elements that are taken away, a resection, for the solutions that follow: truth values, as of resect(), or
        indices."""
        super().remove(_marks("remove()", elements, self._numbers[1]))

    def set_gravity(self, acceleration):
        """The acceleration of gravity in mm/s^2, (3,): the weight acts beside other loads."""
        super().set_gravity(acceleration)

    def set_corotational(self, is_corotational):
        """Whether rotations may be finite: each element turns with its part of the body, and solve() iterates."""
        super().set_corotational(is_corotational)

    def set_control_points(self, points, *, largest_distance=0.0, compliance=0.0, radius=0.0, weights=()):
        """Sets the points at which displacements are given. largest_distance: up to this distance outside, the nearest
        point of the boundary replaces a point. compliance: of the springs at the points, in mm/mN, divided by the weight
        of each point. radius: displacements are means over this radius."""
        super().set_control_points(points, largest_distance, compliance, radius, weights)

    def solve(self, displacements=None):
        """The displacement of each vertex, (n, 3) in mm, for displacements of the control points."""
        return super().solve(_np.empty((0, 3)) if displacements is None else displacements)
