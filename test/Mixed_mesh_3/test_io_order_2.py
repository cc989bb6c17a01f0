#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reads the quadratic elements of test_io with other programs, VTK, Gmsh and meshio; FEBio's file as XML. GetFEM solves.

Usage: test_io_order_2.py [directory that test_io wrote to]

The order of nodes is that of the manuals of the programs. It shows twice: each middle node is the rounded mean of the
ends of the edge that the manual names, and the volume by quadratic shape functions is that of the linear element.
Exit code 77 (skipped) if a module is missing: python3-getfem, python3-gmsh, python3-meshio, python3-vtk9.
"""

import itertools
import json
import os
import sys
import xml.etree.ElementTree as ElementTree

# The import ends the program, as skipped, without VTK and Gmsh.
from test_io_readers import KINDS, canonical, check, close, exit_code, facet_sets, open_in_gmsh

try:
    import getfem
    import gmsh
    import meshio
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)
from element_faces import ELEMENT_FACES  # in the folder of checks, which the readers have added

# The edges of the nodes behind the corners, by kind. First: VTK (headers of vtkQuadraticTetra, Pyramid, Wedge and
# Hexahedron), Abaqus ("Three-dimensional solid element library"), FEBio (FESolidElementShape.cpp) and meshio.
EDGES = [[(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
         [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
         [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
         [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]]
# Gmsh's manual, "Node ordering".
GMSH_EDGES = [[(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)],
              [(0, 1), (0, 3), (0, 4), (1, 2), (1, 4), (2, 3), (2, 4), (3, 4)],
              [(0, 1), (0, 2), (0, 3), (1, 2), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5)],
              [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]]
FACES = list(ELEMENT_FACES.values())
SIZES = [4, 5, 6, 8]
CORNERS = [[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
           [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 1)],
           [(0, 0, -1), (1, 0, -1), (0, 1, -1), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
           [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]]
VTK_TYPES = [vtk.VTK_QUADRATIC_TETRA, vtk.VTK_QUADRATIC_PYRAMID, vtk.VTK_QUADRATIC_WEDGE,
             vtk.VTK_QUADRATIC_HEXAHEDRON]
GMSH_TYPES, GMSH_FACES = [11, 19, 18, 17], {3: 9, 4: 16}
GMSH_REFERENCE_VOLUMES = [1 / 6, 4 / 3, 1, 8]
MESHIO_TYPES = ["tetra10", "pyramid13", "wedge15", "hexahedron20"]
# Of GetFEM: map, elements, quadrature (collapsed, so exact for pyramids), and where the reference element is.
HALF = np.array([0.5, 0.5, 0.5])
GETFEM = [("GT_PK(3,2)", "FEM_PK(3,2)", "IM_TETRAHEDRON(6)", (1, 0)),
          ("GT_PYRAMID_Q2_INCOMPLETE", "FEM_PYRAMID_Q2_INCOMPLETE", "IM_PYRAMID(IM_GAUSS_PARALLELEPIPED(3,8))",
           (1, 0)),
          ("GT_PRISM_INCOMPLETE_P2", "FEM_PRISM_INCOMPLETE_P2", "IM_PRODUCT(IM_TRIANGLE(7),IM_GAUSS1D(6))",
           (np.array([1, 1, 0.5]), np.array([0, 0, 0.5]))),
          ("GT_Q2_INCOMPLETE(3)", "FEM_Q2_INCOMPLETE(3)", "IM_HEXAHEDRON(9)", (HALF, HALF))]
FEBIO_TYPES = ["tet10", "pyra13", "penta15", "hex20"]
PRISM = KINDS.index("prism")


def shape_functions(kind, edges, r, s, t):
    """Those of quadratic elements with nodes at corners and in the middles of edges, at one point."""
    corners = CORNERS[kind]
    values = []
    if kind == 0:
        b = (1 - r - s - t, r, s, t)
        values = [x * (2 * x - 1) for x in b] + [4 * b[i] * b[j] for i, j in edges]
    elif kind == 1:  # Bedrosian, 1992
        for x, y, _ in corners[:4]:
            values.append((x * r + y * s - 1) * ((1 + x * r) * (1 + y * s) - t + x * y * r * s * t / (1 - t)) / 4)
        values.append(t * (2 * t - 1))
        for i, j in edges:
            x, y, z = (np.array(corners[i]) + corners[j]) / 2
            if z > 0:
                x, y = 2 * x, 2 * y
                values.append(t * (1 + x * r - t) * (1 + y * s - t) / (1 - t))
            elif x == 0:
                values.append((1 + r - t) * (1 - r - t) * (1 + y * s - t) / (2 * (1 - t)))
            else:
                values.append((1 + s - t) * (1 - s - t) * (1 + x * r - t) / (2 * (1 - t)))
    elif kind == 2:
        b = (1 - r - s, r, s)
        for i in range(6):
            z = 1 + corners[i][2] * t
            values.append(b[i % 3] * z * (2 * b[i % 3] - 2 + corners[i][2] * t) / 2)
        for i, j in edges:
            z = (corners[i][2] + corners[j][2]) / 2
            values.append(b[i % 3] * (1 - t * t) if z == 0 else 2 * b[i % 3] * b[j % 3] * (1 + z * t))
    else:
        for x, y, z in corners:
            values.append((1 + x * r) * (1 + y * s) * (1 + z * t) * (x * r + y * s + z * t - 2) / 8)
        for i, j in edges:
            value = 1 / 4
            for x, u in zip((np.array(corners[i]) + corners[j]) / 2, (r, s, t)):
                value = value * (1 - u * u if x == 0 else 1 + x * u)
            values.append(value)
    return np.array(values)


def quadrature(kind, n=5):
    """Points and weights: Gauss on the cube, collapsed to the element. Exact for what is integrated here."""
    x, w = np.polynomial.legendre.leggauss(n)
    points, weights = [], []
    for (a, u), (b, v), (c, z) in itertools.product(zip(x, w), repeat=3):
        p, q, h = (1 + a) / 2, (1 + b) / 2, (1 + c) / 2
        if kind == 0:
            points.append((p * (1 - q) * (1 - h), q * (1 - h), h))
            weights.append(u * v * z / 8 * (1 - q) * (1 - h) ** 2)
        elif kind == 1:
            points.append((a * (1 - h), b * (1 - h), h))
            weights.append(u * v * z / 2 * (1 - h) ** 2)
        elif kind == 2:
            points.append((p * (1 - q), q, c))
            weights.append(u * v * z / 4 * (1 - q))
        else:
            points.append((a, b, c))
            weights.append(u * v * z)
    return points, np.array(weights)


def gradients_of(kind, edges):
    """Of the shape functions at the points of the quadrature, by an imaginary step: exact to rounding."""
    step = 1e-30
    return np.array([[shape_functions(kind, edges, *(np.array(p) + 1j * step * np.eye(3)[i])).imag / step
                      for i in range(3)] for p in quadrature(kind)[0]])


GRADIENTS = {(kind, name): gradients_of(kind, edges[kind])
             for kind in range(4) for name, edges in (("", EDGES), ("gmsh", GMSH_EDGES))}


def volumes_of(kind, points, elements, order=""):
    jacobians = np.einsum("qin,enj->eqij", GRADIENTS[kind, order], points[elements])
    return np.linalg.det(jacobians) @ quadrature(kind)[1]


def check_shape_functions():
    """They are 1 at their nodes, 0 at the others; and a wrong order of nodes is found."""
    random = np.random.default_rng(1)
    for kind in range(4):
        corners = np.array(CORNERS[kind], float)
        nodes = np.vstack([corners, [(corners[i] + corners[j]) / 2 for i, j in EDGES[kind]]])
        for i, node in enumerate(nodes):
            if kind != 1 or node[2] < 1:  # not at the apex
                check(close(shape_functions(kind, EDGES[kind], *node), np.eye(len(nodes))[i]), KINDS[kind], "node", i)
        points = nodes @ (np.eye(3) + random.uniform(-0.2, 0.2, (3, 3)))
        size, row = SIZES[kind], np.arange(len(nodes))
        volume = volumes_of(kind, points, row[None, :])[0]
        check(volume > 0, KINDS[kind], "volume")
        for i in range(size, len(nodes)):
            for j in range(size, i):
                wrong = row.copy()
                wrong[[i, j]] = wrong[[j, i]]
                other = volumes_of(kind, points, wrong[None, :])[0]
                check(abs(other - volume) > 1e-3 * volume, KINDS[kind], "nodes", i, j, "exchanged:", other, volume)


def check_points(path, expected, points, edges):
    """The vertices are the first nodes. Those behind them are as many as edges, counted by brute force, and each is
    the rounded midpoint of its edge. \\param edges: of each node of each element, behind its corners"""
    n = expected["vertices"]
    check(np.array_equal(points[:n], expected["points"]), path, "vertices")
    ends = {}
    for middle, i, j in edges:
        check(ends.setdefault(int(middle), {int(i), int(j)}) == {int(i), int(j)}, path, "node of two edges", middle)
    check(len({frozenset(edge) for edge in ends.values()}) == len(ends), path, "edge of two nodes")
    check(sorted(ends) == list(range(n, len(points))), path, "numbers of middle nodes", len(ends), len(points), n)
    for middle, edge in ends.items():
        a, b = edge
        check(a < n and b < n and np.array_equal(points[middle], (points[a] + points[b]) / 2), path, "node", middle)


def check_elements(path, expected, points, elements, table=None, mirrored=()):
    """\\param elements: by kind, arrays of nodes in the order of `table`; the volumes of `mirrored` kinds are negative"""
    order, table = ("gmsh", table) if table is GMSH_EDGES else ("", EDGES)
    check([len(e) for e in elements] == expected["kinds"], path, "counts", [len(e) for e in elements])
    check_points(path, expected, points, [
        (e[SIZES[kind] + i], e[edge[0]], e[edge[1]]) for kind in range(4) for e in elements[kind]
        for i, edge in enumerate(table[kind])])
    # Euler: of a ball, vertices - edges + faces - elements = 1.
    faces = {tuple(sorted(e[list(f)])) for kind in range(4) for e in elements[kind] for f in FACES[kind]}
    middle = len(points) - expected["vertices"]
    check(expected["vertices"] - middle + len(faces) - sum(expected["kinds"]) == 1, path, "Euler's number")
    volumes = np.concatenate([volumes_of(kind, points, e, order) * (-1 if kind in mirrored else 1)
                              for kind, e in enumerate(elements) if len(e)])
    check(volumes.min() > 0, path, "volume of an element", volumes.min())
    check(close(np.sort(volumes), np.sort(expected["volumes"])), path, "volumes of elements")
    check(close(volumes.sum(), expected["volume"]), path, "volume", volumes.sum(), expected["volume"])


def check_faces(path, expected, points, groups, has_one_number, elements):
    """Faces by name of their group, with middle nodes: those between corners, from the first one on."""
    sets = facet_sets(expected)
    check(sorted(groups) == sorted([*sets, "boundary"]), path, "groups of faces", sorted(groups))
    n = expected["vertices"]
    for name, faces in groups.items():
        for face in faces:
            size = len(face) // 2
            check(len(face) in (6, 8) and max(face[:size]) < n, path, "nodes of a face of", name)
            for i in range(size):
                middle = (points[face[i]] + points[face[(i + 1) % size]]) / 2
                check(np.array_equal(points[face[size + i]], middle), path, "middle node of a face of", name)
    corners = {name: [[int(v) for v in f[:len(f) // 2]] for f in faces] for name, faces in groups.items()}
    boundary = corners["boundary"]
    for name, faces in sets.items():
        check(canonical(corners[name]) == canonical(f for _, _, f in faces), path, "facet set", name)
        if has_one_number:
            boundary = boundary + [f for _, is_on_boundary, f in faces if is_on_boundary]
    check(canonical(boundary) == canonical(boundary_of(elements)), path, "boundary")


def boundary_of(elements):
    """The faces that occur once, as lists of corners."""
    faces = {}
    for kind, some in enumerate(elements):
        for e in some:
            for f in FACES[kind]:
                faces.setdefault(tuple(sorted(e[list(f)])), []).append([int(v) for v in e[list(f)]])
    return [same[0] for same in faces.values() if len(same) == 1]


def check_vtk(path, expected):
    errors = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: errors.append(1))
    reader.SetFileName(path)
    reader.Update()
    check(not errors, path, "VTK complains")
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets, types = vtk_to_numpy(grid.GetCells().GetOffsetsArray()), vtk_to_numpy(grid.GetCellTypesArray())
    elements = [np.array([connectivity[offsets[e]:offsets[e + 1]] for e in np.flatnonzero(types == kind)], int)
                for kind in VTK_TYPES]
    check_elements(path, expected, points, elements, mirrored=[PRISM])
    data = grid.GetPointData()
    arrays = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    check_node_sets(path, expected, points, {name[6:]: np.flatnonzero(vtk_to_numpy(data.GetArray(name)))
                                             for name in arrays if name.startswith("nodes_")})
    # VTK's own volumes, of the pieces of quadratic cells, and its faces.
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    volumes = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))
    check(volumes.min() > 0, path, "volumes by vtkCellSizeFilter")
    for e in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(e)
        center = points[connectivity[offsets[e]:offsets[e + 1]]].mean(0)
        for f in range(cell.GetNumberOfFaces()):
            face = vtk_to_numpy(cell.GetFace(f).GetPoints().GetData())
            normal = np.cross(face[1] - face[0], face[2] - face[0])
            check(np.dot(normal, face.mean(0) - center) > 0, path, "cell", e, "face", f, "looks inwards for VTK")
        derivatives, middle = [0.0] * (3 * len(cell_nodes(cell))), [0.0] * 3
        cell.GetParametricCenter(middle)
        cell.InterpolateDerivs(middle, derivatives)
        jacobian = np.linalg.det(np.array(derivatives).reshape(3, -1) @ cell_nodes(cell))
        check(jacobian * (-1 if types[e] == VTK_TYPES[PRISM] else 1) > 0, path, "cell", e, "Jacobian of VTK", jacobian)
    if expected["vertex_data"]:
        array = grid.GetPointData().GetArray(expected["vertex_data"])
        check(array is not None and np.array_equal(vtk_to_numpy(array), points), path, "values at the nodes")


def cell_nodes(cell):
    return vtk_to_numpy(cell.GetPoints().GetData())


def check_gmsh(path, version, expected):
    open_in_gmsh(path)
    mesh = gmsh.model.mesh
    tags, coordinates, _ = mesh.getNodes()
    order = np.argsort(tags)
    check(np.array_equal(np.asarray(tags)[order], np.arange(1, len(tags) + 1)), path, "numbers of nodes")
    points = np.asarray(coordinates).reshape(-1, 3)[order]
    elements = []
    for kind, gmsh_type in enumerate(GMSH_TYPES):
        numbers, nodes = mesh.getElementsByType(gmsh_type)
        elements.append(np.asarray(nodes, int).reshape(len(numbers), SIZES[kind] + len(EDGES[kind])) - 1)
        if len(numbers) == 0:
            continue
        local, weights = mesh.getIntegrationPoints(gmsh_type, "Gauss4")
        determinants = np.asarray(mesh.getJacobians(gmsh_type, local)[1]).reshape(len(numbers), -1)
        check(determinants.min() > 0, path, KINDS[kind], "is inside out for Gmsh")
        # Gmsh 4.8 gives weights for the pyramid that add up to 16/9.
        weights = np.asarray(weights) * GMSH_REFERENCE_VOLUMES[kind] / np.sum(weights)
        check(close(determinants @ weights, np.array(expected["volumes"])[np.asarray(numbers, int) - 1]), path,
              "volumes of", KINDS[kind], "by Gmsh")
    check_elements(path, expected, points, elements, GMSH_EDGES)
    groups = {}
    for dim, tag in gmsh.model.getPhysicalGroups(2):
        groups[gmsh.model.getPhysicalName(dim, tag)] = [
            face for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, tag)
            for kind, _, nodes in zip(*mesh.getElements(2, entity))
            for face in np.asarray(nodes, int).reshape(-1, {9: 6, 16: 8}[kind]) - 1]
    check_faces(path, expected, points, groups, version == 2.2, elements)
    if expected["name"] == "io_grid":
        check_patch(path, expected, points, elements)
    for tag in gmsh.view.getTags():
        _, tags, data, _, _ = gmsh.view.getModelData(tag, 0)
        check(np.array_equal(np.asarray(data), points[np.asarray(tags, int) - 1]), path, "values at the nodes")
        gmsh.view.remove(tag)


def read_meshio(path):
    # meshio 5.0 knows pyramids with 13 nodes and wedges with 15, but not their dimension: it would refuse them.
    for name in MESHIO_TYPES:
        meshio._mesh.topological_dimension.setdefault(name, 3)
    return meshio.read(path, file_format="gmsh" if path.endswith(".msh2") else None)


def check_meshio(path, expected, mirrored=()):
    """meshio does not mirror the quadratic wedge of VTK, as it does the linear one."""
    mesh = read_meshio(path)
    elements = []
    for kind, name in enumerate(MESHIO_TYPES):
        blocks = [np.asarray(block.data, int) for block in mesh.cells if block.type == name]
        empty = np.zeros((0, SIZES[kind] + len(EDGES[kind])), int)
        elements.append(np.concatenate([empty, *blocks]))
    points, numbers = vertices_first(expected, np.asarray(mesh.points), elements)
    check_elements(path, expected, points, [numbers[e] for e in elements], mirrored=mirrored)


def vertices_first(expected, points, elements):
    """Points with vertices numbered as ours, and the new numbers: meshio numbers as the file lists nodes, by entity."""
    ours = {tuple(p): v for v, p in enumerate(expected["points"])}
    corners = np.unique(np.concatenate([e[:, :SIZES[kind]].ravel() for kind, e in enumerate(elements)]))
    numbers = np.full(len(points), -1)
    for v in corners:
        numbers[v] = ours.get(tuple(points[v]), -1)
    numbers[numbers < 0] = np.arange(len(ours), len(ours) + np.sum(numbers < 0))
    result = np.zeros((numbers.max() + 1, 3))
    result[numbers] = points
    return result, numbers


def check_patch(path, expected, points, elements):
    """For GetFEM, a linear displacement takes no forces within: elements of different kinds fit together. Its nodes are
    found by their places in the reference element, since its order is its own. GetFEM 5.4 errs by 1e-6 in gradients on
    pyramids, whatever the quadrature, and by 1e-14 on other kinds."""
    mesh = getfem.Mesh("empty", 3)
    rules = {}
    for kind, some in enumerate(elements):
        map_name, fem, rule, (scale, shift) = GETFEM[kind]
        transformation = getfem.GeoTrans(map_name)
        corners = np.array(CORNERS[kind]) * scale + shift
        nodes = np.vstack([corners, [(corners[i] + corners[j]) / 2 for i, j in GMSH_EDGES[kind]]])
        order = [int(np.argmin(np.abs(nodes - p).sum(1))) for p in transformation.pts().T]
        check(sorted(order) == list(range(len(nodes))), path, "GetFEM's nodes of", KINDS[kind])
        rules[kind] = [int(mesh.add_convex(transformation, points[e[order]].T)[0]) for e in some], fem, rule
    displacement, integration = getfem.MeshFem(mesh, 3), getfem.MeshIm(mesh)
    for ids, fem, rule in rules.values():
        displacement.set_fem(getfem.Fem(fem), ids)
        integration.set_integ(getfem.Integ(rule), ids)
    check(displacement.nbdof() == 3 * len(points), path, "nodes for GetFEM", displacement.nbdof() / 3, len(points))
    check(close(getfem.asm_generic(integration, 0, "1", -1), expected["volume"]), path, "volume by GetFEM")
    boundary = 1
    mesh.set_region(boundary, mesh.outer_faces())
    gradient = np.array([[0.1, 0.2, -0.3], [0.05, -0.1, 0.4], [0.3, 0.1, 0.2]])
    places = displacement.basic_dof_nodes()
    exact = np.array([gradient[i % 3] @ places[:, i] for i in range(places.shape[1])])
    model = getfem.Model("real")
    model.add_fem_variable("u", displacement)
    model.add_initialized_data("lambda", 1.2)
    model.add_initialized_data("mu", 0.8)
    model.add_isotropic_linearized_elasticity_brick(integration, "u", "lambda", "mu")
    model.assembly()
    inner = np.setdiff1d(np.arange(displacement.nbdof()), displacement.basic_dof_on_region(boundary))
    matrix = model.tangent_matrix()
    forces = np.abs(matrix.mult(exact))
    error = forces[inner].max() / forces.max()
    check(len(inner) > 1000 and error < 1e-4, path, "patch test of GetFEM", len(inner), error)


def check_node_sets(path, expected, points, sets):
    """The nodes of each facet set are those at the vertices of its faces, and in the middles of the edges of these."""
    faces_of = {name: [f[2:] for f in faces] for name, faces in expected.get("facet_sets", {}).items() if faces}
    check(sorted(sets) == sorted(faces_of), path, "node sets", sorted(sets))
    vertices = np.array(expected["points"])
    for name, faces in faces_of.items():
        places = {tuple((vertices[f[i]] + vertices[f[j]]) / 2) for f in faces for i in range(len(f)) for j in (i - 1, i)}
        found = [tuple(points[node]) for node in sets.get(name, [])]
        check(len(found) == len(places) and set(found) == places, path, "nodes of", name, len(found), len(places))


def check_inp(path, expected):
    """What meshio does not tell: lines are not too long, and BOUNDARY has all nodes of boundary faces."""
    sets, keyword = {}, ""
    for line in open(path):
        if line.startswith("*"):
            keyword = line.strip()
        else:
            check(len(line.strip().rstrip(",").split(",")) <= 16 and len(line) <= 256, path, "long line")
            if keyword.startswith("*NSET"):
                name = keyword.split("=")[1]
                sets.setdefault(name, []).extend(int(v) - 1 for v in line.strip().rstrip(",").split(","))
    mesh, boundary = read_meshio(path), sets.pop("BOUNDARY")
    check_node_sets(path, expected, np.asarray(mesh.points),
                    {name: sets.get(name.upper(), []) for name in expected.get("facet_sets", {}) if name.upper() in sets})
    faces = {frozenset(f) for f in boundary_of([
        np.concatenate([np.zeros((0, SIZES[k]), int)] + [b.data[:, :SIZES[k]] for b in mesh.cells if b.type == name])
        for k, name in enumerate(MESHIO_TYPES)])}
    wanted = {int(v) for f in faces for v in f}
    for block in mesh.cells:
        kind = MESHIO_TYPES.index(block.type)
        for e in block.data:
            for i, edge in enumerate(EDGES[kind]):
                for f in FACES[kind]:
                    if set(edge) <= set(f) and frozenset(int(e[v]) for v in f) in faces \
                            and f.index(edge[0]) - f.index(edge[1]) in (1, -1, len(f) - 1, 1 - len(f)):
                        wanted.add(int(e[SIZES[kind] + i]))
    check(sorted(boundary) == sorted(wanted), path, "boundary nodes", len(boundary), len(wanted))


def check_feb(path, expected):
    root = ElementTree.parse(path).getroot()
    mesh = root.find("Mesh")
    points = np.array([[float(w) for w in node.text.split(",")] for node in mesh.find("Nodes")])
    elements = [[] for _ in KINDS]
    for block in mesh.findall("Elements"):
        check(block.get("name").endswith("_" + block.get("type")), path, "name of a part")
        elements[FEBIO_TYPES.index(block.get("type"))] += [[int(w) - 1 for w in e.text.split(",")] for e in block]
    elements = [np.array(e, int).reshape(-1, SIZES[k] + len(EDGES[k])) for k, e in enumerate(elements)]
    check_elements(path, expected, points, elements)
    groups = {}
    for surface in mesh.findall("Surface"):
        groups[surface.get("name")] = [[int(w) - 1 for w in f.text.split(",")] for f in surface]
        check(all(len(f) == {"tri6": 6, "quad8": 8}[x.tag] for f, x in zip(groups[surface.get("name")], surface)),
              path, "types of faces")
    check_faces(path, expected, points, groups, False, elements)
    sets = {s.get("name"): [int(w) - 1 for w in s.text.split(",")] for s in mesh.findall("NodeSet")}
    check(sets.pop("boundary") == sorted({v for f in groups["boundary"] for v in f}), path, "boundary nodes")
    check_node_sets(path, expected, points, sets)
    for data in root.findall("MeshData/NodeData"):
        check([[float(w) for w in node.text.split(",")] for node in data] == points.tolist(), path,
              "values at the nodes")


def main():
    directory = sys.argv[1] if len(sys.argv) > 1 else "."
    with open(os.path.join(directory, "io_expected.json")) as file:
        expectations = json.load(file)
    check_shape_functions()
    getfem.util_trace_level(0)
    gmsh.initialize(["gmsh"])
    gmsh.option.setNumber("General.Terminal", 0)
    number_of_inp = 0
    for expected in expectations:
        path = os.path.join(directory, expected["name"] + "_order_2")
        check_vtk(path + ".vtu", expected)
        check_meshio(path + ".vtu", expected, mirrored=[PRISM])
        check_gmsh(path + ".msh", 4.1, expected)
        check_meshio(path + ".msh", expected)
        if not expected["share_faces"]:
            check_gmsh(path + ".msh2", 2.2, expected)
            check_meshio(path + ".msh2", expected)
        check_feb(path + ".feb", expected)
        check(os.path.exists(path + ".inp") == (expected["kinds"][1] == 0), path, "pyramids in .inp")
        if os.path.exists(path + ".inp"):
            number_of_inp += 1
            check_meshio(path + ".inp", expected)
            check_inp(path + ".inp", expected)
    gmsh.finalize()
    check(len(expectations) == 10 and number_of_inp == 5, "number of meshes", len(expectations), number_of_inp)
    return exit_code("%d meshes" % len(expectations))


if __name__ == "__main__":
    sys.exit(main())
