#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reads the files of test_io with other programs, VTK and Gmsh, and compares with io_expected.json.

Usage: test_io_readers.py [directory that test_io wrote to]

What counts is the sign of volumes: that is how an element in another program's numbering shows.
Exit code 77 (skipped) if a module is missing: python3-vtk9, python3-gmsh.
"""

import json
import os
import sys
import xml.etree.ElementTree as ElementTree

try:
    import gmsh
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

KINDS = ["tetrahedron", "pyramid", "prism", "hexahedron"]
VTK_TYPES = [vtk.VTK_TETRA, vtk.VTK_PYRAMID, vtk.VTK_WEDGE, vtk.VTK_HEXAHEDRON]
GMSH_TYPES = [4, 7, 6, 5]
GMSH_REFERENCE_VOLUMES = [1 / 6, 4 / 3, 1, 8]
MEDIT_KEYWORDS = {"Tetrahedra": 4, "Pyramids": 5, "Prisms": 6, "Hexahedra": 8, "Triangles": 3,
                  "Quadrilaterals": 4}
ABAQUS_TYPES = ["C3D4", "C3D5", "C3D6", "C3D8"]
# Abaqus, Analysis User's Guide, "Three-dimensional solid element library": faces S1, S2 and so on.
ABAQUS_FACES = {
    "C3D4": [(1, 2, 3), (1, 4, 2), (2, 4, 3), (3, 4, 1)],
    "C3D5": [(1, 2, 3, 4), (1, 5, 2), (2, 5, 3), (3, 5, 4), (4, 5, 1)],
    "C3D6": [(1, 2, 3), (4, 6, 5), (1, 4, 5, 2), (2, 5, 6, 3), (3, 6, 4, 1)],
    "C3D8": [(1, 2, 3, 4), (5, 8, 7, 6), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 8, 4), (4, 8, 5, 1)]}
FEBIO_TYPES = ["tet4", "pyra5", "penta6", "hex8"]

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "common"))
from checks import check, exit_code  # noqa: E402


def close(a, b):
    return bool(np.all(np.abs(np.asarray(a) - np.asarray(b)) <= 1e-12 * (1 + np.abs(b))))


def tet_volume(p):
    return np.linalg.det(np.asarray(p[1:]) - np.asarray(p[0])) / 6


def part_names(expected):
    """The name of the part that each element is in, as the writers' documentation says."""
    return [("" if subdomain == 1 else "subdomain_%d_" % subdomain) + ("region" if in_region else "rest")
            for subdomain, in_region in zip(expected["subdomains"], expected["in_region"])]


def part_tags(expected):
    """The number of each part that has elements: 1, 2, and from 4 on."""
    parts = sorted(set(zip(expected["subdomains"], [1 - r for r in expected["in_region"]])))
    tags, others = {}, 4
    for subdomain, is_rest in parts:
        name = part_names({"subdomains": [subdomain], "in_region": [1 - is_rest]})[0]
        if subdomain == 1:
            tags[name] = 1 + is_rest
        else:
            tags[name], others = others, others + 1
    return tags


def facet_sets(expected):
    """The sets that have faces: of each face its element, whether it is on the boundary, and its vertices."""
    return {name: [(f[0], f[1], f[2:]) for f in faces]
            for name, faces in expected.get("facet_sets", {}).items() if faces}


def facet_set_tags(expected):
    """The number of each set, also of those without faces: after those of parts."""
    first = max([3, *part_tags(expected).values()]) + 1
    return {name: first + i for i, name in enumerate(expected.get("facet_sets", {}))
            if name in facet_sets(expected)}


def set_nodes(expected):
    """The vertices of each set that has faces."""
    return {name: sorted({v for _, _, f in faces for v in f}) for name, faces in facet_sets(expected).items()}


def gmsh_groups(expected):
    """Physical groups of Gmsh: a volume for each subdomain, with its number, the boundary, and sets after it."""
    subdomains, sets = set(expected["subdomains"]), list(expected.get("facet_sets", {}))
    boundary = next(i for i in range(3, 10**9) if not subdomains & set(range(i, i + 1 + len(sets))))
    return {**{(3, s): "subdomain_%d" % s for s in subdomains}, (2, boundary): "boundary",
            **{(2, boundary + 1 + i): name for i, name in enumerate(sets) if name in facet_sets(expected)}}


def gmsh_volumes(expected):
    """The subdomain of each elementary volume of Gmsh, and its number of elements: the region has a number of its own."""
    volumes = {}
    for subdomain, in_region in zip(expected["subdomains"], expected["in_region"]):
        tag = subdomain + in_region * 10**9
        volumes[tag] = subdomain, volumes.get(tag, (0, 0))[1] + 1
    return volumes


def canonical(faces):
    """Faces as lists of vertices, each from its smallest vertex on: orientation counts."""
    return sorted(tuple(f[f.index(min(f)):] + f[:f.index(min(f))]) for f in
                  ([int(v) for v in face] for face in faces))


def check_faces(path, expected, points, groups, has_one_number):
    """Faces by name of their group. A face with one number is in its set, and not in "boundary"."""
    sets = facet_sets(expected)
    check(sorted(groups) == sorted([*sets, "boundary"]), path, "groups of faces", sorted(groups))
    boundary = list(groups["boundary"])
    for name, faces in sets.items():
        check(canonical(groups.get(name, [])) == canonical(f for _, _, f in faces), path, "facet set", name)
        if has_one_number:
            boundary += [f for _, is_on_boundary, f in faces if is_on_boundary]
    check_boundary(path, expected, points, [[f for f in boundary if len(f) == size] for size in (3, 4)])


def check_vtu(path, expected):
    errors = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    reader.AddObserver("WarningEvent", lambda *_: errors.append(1))
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    n = sum(expected["kinds"])
    check(not errors, path, "VTK complains")
    check(grid.GetNumberOfPoints() == expected["vertices"], path, "vertices")
    check(grid.GetNumberOfCells() == n, path, "elements", grid.GetNumberOfCells(), n)
    if grid.GetNumberOfCells() != n:
        return
    points = vtk_to_numpy(grid.GetPoints().GetData())
    check(points.dtype == np.float64, path, "precision")
    check(np.array_equal(points, expected["points"]), path, "coordinates")

    types = vtk_to_numpy(grid.GetCellTypesArray())
    check([int((types == t).sum()) for t in VTK_TYPES] == expected["kinds"], path, "counts")
    order = expected["by_kind"]  # of the elements in the file
    arcs, expected_volumes = np.array(expected["ARC"])[order], np.array(expected["volumes"])[order]
    data = grid.GetCellData()
    kinds = vtk_to_numpy(data.GetArray("kind"))
    check([VTK_TYPES[k] for k in kinds] == list(types), path, "data kind")
    check(vtk_to_numpy(data.GetArray("in_region")).sum() == expected["region"], path, "in_region")
    check(np.array_equal(vtk_to_numpy(data.GetArray("ARC")), arcs), path, "ARC")
    check(list(kinds) == sorted(kinds), path, "elements are sorted by kind")
    check(np.array_equal(vtk_to_numpy(data.GetArray("subdomain")), np.array(expected["subdomains"])[order]), path,
          "subdomain")

    arrays = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    check(sorted(a[7:] for a in arrays if a.startswith("facets_")) == sorted(facet_sets(expected)), path, "facet sets")
    for name, faces in facet_sets(expected).items():
        numbers = np.bincount([face[0] for face in faces], minlength=n)[order]
        check(np.array_equal(vtk_to_numpy(data.GetArray("facets_" + name)), numbers), path, "facets_" + name)
    data_of_points = grid.GetPointData()
    arrays = [data_of_points.GetArrayName(i) for i in range(data_of_points.GetNumberOfArrays())]
    check(sorted(a[6:] for a in arrays if a.startswith("nodes_")) == sorted(facet_sets(expected)), path, "node sets")
    for name, nodes in set_nodes(expected).items():
        array = vtk_to_numpy(data_of_points.GetArray("nodes_" + name))
        check(list(np.nonzero(array)[0]) == nodes and set(array) <= {0, 1}, path, "nodes_" + name)

    # VTK's filter for volumes, which are signed.
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    volumes = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))
    check(close(volumes, expected_volumes), path, "volumes by vtkCellSizeFilter", volumes[:3])
    check(close(volumes.sum(), expected["volume"]), path, "total volume")

    # VTK's tetrahedra and faces of each cell.
    ids, corners = vtk.vtkIdList(), vtk.vtkPoints()
    corners.SetDataTypeToDouble()
    for e in range(n):
        cell = grid.GetCell(e)
        cell.Triangulate(0, ids, corners)
        p = vtk_to_numpy(corners.GetData()).reshape(-1, 4, 3)
        parts = [tet_volume(q) for q in p]
        check(min(parts) > 0, path, "cell", e, KINDS[kinds[e]], "is inside out for VTK")
        check(close(sum(parts), expected_volumes[e]), path, "cell", e, "volume of its tetrahedra")
        q = vtk_to_numpy(cell.GetPoints().GetData())
        for f in range(cell.GetNumberOfFaces()):
            face = vtk_to_numpy(cell.GetFace(f).GetPoints().GetData())
            normal = np.cross(face[1] - face[0], face[2] - face[0])
            check(np.dot(normal, face.mean(0) - q.mean(0)) > 0, path, "cell", e, KINDS[kinds[e]],
                  "face", f, "looks inwards for VTK")

        # The Jacobian of VTK's own shape functions: positive in Gmsh's order, so negative for a
        # wedge in VTK's documented order. If this fails, then VTK has changed its mind on wedges.
        m = cell.GetNumberOfPoints()
        derivatives, center = [0.0] * (3 * m), [0.0] * 3
        cell.GetParametricCenter(center)
        cell.InterpolationDerivs(center, derivatives)
        jacobian = np.linalg.det(np.array(derivatives).reshape(3, m) @ q)
        check(jacobian * (-1 if KINDS[kinds[e]] == "prism" else 1) > 0, path, "cell", e,
              KINDS[kinds[e]], "Jacobian of VTK's shape functions", jacobian)

    if expected["name"] == "io_grid":
        array = grid.GetPointData().GetArray("position & <copy>")
        check(array is not None and np.array_equal(vtk_to_numpy(array), points), path, "vertex data")
        array = data.GetArray("element")
        check(array is not None and np.array_equal(vtk_to_numpy(array), order), path,
              "element data")


def open_in_gmsh(path):
    """Opens a file, which must go without errors and warnings."""
    gmsh.clear()
    gmsh.logger.start()
    gmsh.open(path)
    log = gmsh.logger.get()
    gmsh.logger.stop()
    check(not [line for line in log if line.startswith(("Error", "Warning"))], path, "Gmsh:", log)


def check_msh(path, version, expected):
    open_in_gmsh(path)

    n = expected["vertices"]
    mesh = gmsh.model.mesh
    tags, coordinates, _ = mesh.getNodes()
    order = np.argsort(tags)
    check(np.array_equal(np.asarray(tags)[order], np.arange(1, n + 1)), path, "numbers of vertices")
    points = np.asarray(coordinates).reshape(-1, 3)[order]
    check(np.array_equal(points, expected["points"]), path, "coordinates")

    volume = 0
    for kind, gmsh_type in enumerate(GMSH_TYPES):
        elements, nodes = mesh.getElementsByType(gmsh_type)
        check(len(elements) == expected["kinds"][kind], path, "number of", KINDS[kind])
        if len(elements) == 0:
            continue
        local, weights = mesh.getIntegrationPoints(gmsh_type, "Gauss4")
        _, determinants, _ = mesh.getJacobians(gmsh_type, local)
        determinants = np.asarray(determinants).reshape(len(elements), -1)
        check(determinants.min() > 0, path, KINDS[kind], "is inside out for Gmsh")
        # Gmsh 4.8 gives weights for the pyramid that add up to 16/9.
        weights = np.asarray(weights) * GMSH_REFERENCE_VOLUMES[kind] / np.sum(weights)
        volumes = determinants @ weights
        check(close(volumes, np.array(expected["volumes"])[np.asarray(elements, int) - 1]), path,
              "volumes of", KINDS[kind])
        volume += volumes.sum()
    check(close(volume, expected["volume"]), path, "total volume")

    # Groups: subdomains, whose elements in the region are an entity of their own, the boundary, facet sets. Each of
    # the last two is an entity, but where facet sets share faces with the boundary or with each other.
    groups = {(dim, tag): gmsh.model.getPhysicalName(dim, tag)
              for dim, tag in gmsh.model.getPhysicalGroups()}
    check(groups == gmsh_groups(expected), path, "physical groups", groups)
    volumes, boundary = gmsh_volumes(expected), next(tag for (_, tag), name in groups.items() if name == "boundary")
    entities = gmsh.model.getEntities()
    if not facet_sets(expected):
        check(sorted(entities) == sorted([(2, boundary), *((3, tag) for tag in volumes)]), path, "entities", entities)
    faces = {}
    for (dim, tag), name in groups.items():
        of_group = gmsh.model.getEntitiesForPhysicalGroup(dim, tag)
        if dim == 3:
            check(sorted(of_group) == sorted(v for v, (s, _) in volumes.items() if s == tag), path, "group", tag)
            for volume in of_group:
                number = sum(map(len, mesh.getElements(dim, volume)[1]))
                check(number == volumes[volume][1], path, "number of elements of", name, volume)
                check(list(gmsh.model.getPhysicalGroupsForEntity(3, volume)) == [tag], path, "one group", volume)
        else:
            faces[name] = [face - 1 for entity in of_group for kind, _, nodes in zip(*mesh.getElements(2, entity))
                           for face in np.asarray(nodes, int).reshape(-1, kind + 1)]
    if version == 4.1:
        tags = np.concatenate([mesh.getNodes(*entity)[0] for entity in entities])
        check(sorted(tags) == list(range(1, n + 1)), path, "each vertex is on one entity")
        tags = np.concatenate([mesh.getNodes(*entity)[0] for entity in entities if entity[0] == 2])
        ours = 1 + np.unique([v for some in faces.values() for face in some for v in face])
        check(np.array_equal(np.sort(tags), ours), path, "vertices of the faces")
        if n < 20:  # the volumes know their surface
            for tag in volumes:
                check(list(gmsh.model.getAdjacencies(3, tag)[1]) == [boundary], path, "boundary of", tag)
    check_faces(path, expected, points, faces, has_one_number=version == 2.2)
    views = {gmsh.option.getString("View[%d].Name" % gmsh.view.getIndex(tag)): tag for tag in gmsh.view.getTags()}
    check(list(views) == [expected["vertex_data"]] * bool(expected["vertex_data"]), path, "views", list(views))
    for tag in views.values():
        kind, tags, data, _, components = gmsh.view.getModelData(tag, 0)
        check(kind == "NodeData" and components == 3 and len(tags) == n, path, "view", kind, components)
        check(np.array_equal(np.asarray(data), np.asarray(expected["points"])[np.asarray(tags, int) - 1]), path,
              "values at the vertices")
        gmsh.view.remove(tag)


def check_boundary(path, expected, points, faces):
    """Counts, and the volume that the boundary encloses: its sign is its orientation."""
    check([len(f) for f in faces] == [expected["triangles"], expected["quadrilaterals"]], path,
          "number of boundary faces")
    points = np.asarray(points) - np.mean(points, 0)
    volume = 0
    for face in (f for some in faces for f in some):
        for i in range(1, len(face) - 1):
            volume += np.linalg.det(points[[face[0], face[i], face[i + 1]]]) / 6
    check(close(volume, expected["volume"]), path, "volume enclosed by the boundary", volume)


def check_elements(path, expected, points, elements, parts):
    """Files no reader here understands: elements by kind, in Gmsh's order, and parts ("region")."""
    check(np.array_equal(points, expected["points"]), path, "coordinates")
    check([len(e) for e in elements] == expected["kinds"], path, "counts")
    check(sorted(parts) == sorted(part_names(expected)), path, "parts of elements")
    points = np.asarray(points)
    # The corner at vertex 0.
    neighbors = [(0, 1, 2, 3), (0, 1, 3, 4), (0, 1, 2, 3), (0, 1, 3, 4)]
    for kind, some in enumerate(elements):
        for e in some:
            check(tet_volume(points[np.asarray(e)[list(neighbors[kind])]]) > 0, path, KINDS[kind])


def check_medit(path, expected):
    words = open(path).read().split()
    check(words[:4] == ["MeshVersionFormatted", "2", "Dimension", "3"] and words[-1] == "End", path)
    blocks, i, points = {}, 4, []
    while words[i] != "End":
        keyword, n = words[i], int(words[i + 1])
        width = 4 if keyword == "Vertices" else MEDIT_KEYWORDS[keyword] + 1
        rows = np.array(words[i + 2:i + 2 + n * width], float).reshape(n, width)
        i += 2 + n * width
        if keyword == "Vertices":
            points = rows[:, :3]
        else:
            blocks[keyword] = rows.astype(int)
    none = np.zeros((0, 5), int)
    volumes = [blocks.get(k, none) for k in list(MEDIT_KEYWORDS)[:4]]
    names = {tag: name for name, tag in part_tags(expected).items()}
    parts = [names[r] for b in volumes for r in b[:, -1]]
    check_elements(path, expected, points, [b[:, :-1] - 1 for b in volumes], parts)
    faces = {name: [row[:-1] - 1 for k in ("Triangles", "Quadrilaterals") for row in blocks.get(k, none)
                    if row[-1] == tag] for name, tag in {"boundary": 3, **facet_set_tags(expected)}.items()}
    check_faces(path, expected, points, faces, has_one_number=True)
    check(sum(map(len, faces.values())) == sum(len(blocks.get(k, none)) for k in ("Triangles", "Quadrilaterals")),
          path, "each face has a known number")


def check_inp(path, expected):
    points, elements, sets, members, node_sets, surfaces = [], [[] for _ in KINDS], {}, {}, {}, {}
    vertices, sets_of_faces = {}, {}
    for line in open(path):
        check(len(line) <= 256, path, "long line")
        line = line.strip().rstrip(",")
        if line.startswith("*"):
            words = [w.strip() for w in line.split(",")]
            keyword, values = words[0], dict(w.split("=") for w in words[1:])
        elif keyword == "*NODE":
            points.append([float(w) for w in line.split(",")[1:]])
        elif keyword == "*ELEMENT":
            numbers = [int(w) for w in line.split(",")]
            elements[ABAQUS_TYPES.index(values["TYPE"])].append([v - 1 for v in numbers[1:]])
            vertices[numbers[0]] = values["TYPE"], [v - 1 for v in numbers[1:]]
            sets.setdefault(values["ELSET"], []).append(numbers[0])
        elif keyword == "*ELSET" and line[0].isdigit():
            numbers = [int(w) for w in line.split(",")]
            check(len(numbers) <= 16, path, "numbers on a line")
            sets_of_faces.setdefault(values["ELSET"], []).extend(numbers)
        elif keyword == "*ELSET":
            members.setdefault(values["ELSET"], []).append(line)
        elif keyword == "*NSET":
            numbers = [int(w) for w in line.split(",")]
            check(len(numbers) <= 16, path, "numbers on a line")
            node_sets.setdefault(values["NSET"], []).extend(v - 1 for v in numbers)
        elif keyword == "*SURFACE":
            check(values["TYPE"] == "ELEMENT", path, "type of surface")
            of_set, side = [w.strip() for w in line.split(",")]
            surfaces.setdefault(values["NAME"], []).extend(
                (vertices[e], side) for e in sets_of_faces.pop(of_set))
    check(not sets_of_faces, path, "sets without a surface")
    check(sorted(surfaces) == sorted(node_sets) == sorted(["BOUNDARY", *(s.upper() for s in facet_sets(expected))]),
          path, "surfaces and node sets")
    # Abaqus numbers the vertices of a face as seen from outside in any of two directions.
    found = {name: [[v[i - 1] for i in ABAQUS_FACES[kind][int(side[1:]) - 1]] for (kind, v), side in faces]
             for name, faces in surfaces.items()}
    for name, faces in facet_sets(expected).items():
        check(sorted(map(sorted, found[name.upper()])) == sorted(sorted(f) for _, _, f in faces), path, "surface", name)
    for name, faces in found.items():
        check(node_sets[name] == sorted({v for f in faces for v in f}), path, "node set", name)
    # The boundary by brute force: faces that one element has.
    faces = [tuple(sorted(v[i - 1] for i in face)) for kind, v in vertices.values() for face in ABAQUS_FACES[kind]]
    check(sorted(tuple(sorted(f)) for f in found["BOUNDARY"]) == sorted(f for f in faces if faces.count(f) == 1)
          if len(faces) < 5000 else len(found["BOUNDARY"]) == expected["triangles"] + expected["quadrilaterals"],
          path, "boundary")
    parts = [name.lower() for name, of in members.items() for s in of for _ in sets[s]]
    check_elements(path, expected, points, elements, parts)
    numbers = sorted(i for s in sets.values() for i in s)
    check(numbers == list(range(1, len(numbers) + 1)), path, "numbers of elements")


def check_feb(path, expected):
    root = ElementTree.parse(path).getroot()
    check(root.tag == "febio_spec" and root.get("version") == "4.0", path, "root")
    sections = ["Module", "Material", "Mesh", "MeshDomains"] + ["MeshData"] * bool(expected["vertex_data"])
    check([c.tag for c in root] == sections, path, "sections")
    mesh = root.find("Mesh")
    points = [[float(w) for w in node.text.split(",")] for node in mesh.find("Nodes")]
    domains = {d.get("name"): d.get("mat") for d in root.find("MeshDomains")}
    elements, parts, names = [[] for _ in KINDS], [], []
    for block in mesh.findall("Elements"):
        names.append(block.get("name"))
        for e in block:
            elements[FEBIO_TYPES.index(block.get("type"))].append(
                [int(w) - 1 for w in e.text.split(",")])
            parts.append(domains[block.get("name")])
    check(sorted(names) == sorted(set(domains)), path, "domains")
    check(set(domains.values()) <= {m.get("name") for m in root.find("Material")}, path, "materials")
    check_elements(path, expected, points, elements, parts)
    faces = {}
    for surface in mesh.findall("Surface"):
        check([f.get("id") for f in surface] == [str(i + 1) for i in range(len(surface))], path, "numbers of faces")
        faces[surface.get("name")] = [[int(w) - 1 for w in f.text.split(",")] for f in surface]
        check(all(len(f) == {"tri3": 3, "quad4": 4}[x.tag]
                  for f, x in zip(faces[surface.get("name")], surface)), path, "types of faces")
    check_faces(path, expected, points, faces, has_one_number=False)
    nodes = {s.get("name"): [int(w) - 1 for w in s.text.split(",")] for s in mesh.findall("NodeSet")}
    check(nodes == {name: sorted({v for f in some for v in f}) for name, some in faces.items()}, path, "node sets")
    for data in root.findall("MeshData/NodeData"):
        check(data.attrib == {"name": expected["vertex_data"], "node_set": "all", "data_type": "vec3"}, path, "data")
        check([node.get("lid") for node in data] == [str(i + 1) for i in range(len(points))], path, "lists of nodes")
        check([[float(w) for w in node.text.split(",")] for node in data] == points, path, "values at the vertices")


def main():
    directory = sys.argv[1] if len(sys.argv) > 1 else "."
    with open(os.path.join(directory, "io_expected.json")) as file:
        expectations = json.load(file)
    gmsh.initialize(["gmsh"])
    gmsh.option.setNumber("General.Terminal", 0)
    for expected in expectations:
        path = os.path.join(directory, expected["name"])
        check_vtu(path + ".vtu", expected)
        check_msh(path + ".msh", 4.1, expected)
        if not expected["share_faces"]:
            check_msh(path + ".msh2", 2.2, expected)
            check_medit(path + ".mesh", expected)
        check_inp(path + ".inp", expected)
        check_feb(path + ".feb", expected)
    gmsh.finalize()
    check(len(expectations) == 10, "number of meshes", len(expectations))
    return exit_code(f"{len(expectations)} meshes")


if __name__ == "__main__":
    sys.exit(main())
