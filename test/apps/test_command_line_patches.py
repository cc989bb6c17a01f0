#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches of the boundary: faces and nodes in the files, as Gmsh, meshio, VTK and CalculiX read them, and faces found
by brute force.

  test_command_line_patches.py MESHER DATA_DIRECTORY WORK_DIRECTORY
"""

import json
import os
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from collections import Counter

from command_line_case import WORK, Case
from cube import CUBE, TRIANGLES, moved, off

try:
    import gmsh
    import meshio
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)
if shutil.which("ccx") is None:
    print("skipped: there is no ccx")
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "common"))
from element_faces import ELEMENT_FACES  # noqa: E402

# The unit cube is the domain.
PLACES = {"Top": ("plane:0.5,0.5,1,0,0,2", lambda c: c[2] > 1 - 1e-6),
          "base": ("box:0,0,0,1,1,0", lambda c: c[2] < 1e-6),
          "ball": ("sphere:1,1,1,0.6", lambda c: np.linalg.norm(c - 1) < 0.6),
          "slab_S1": ("FILE", lambda c: abs(c[0] - 0.5) < 0.301 and 0 < c[1] + 0.5 < 2 and c[2] > 0.45)}


def boundary_of(mesh):
    """Faces that one element has, by their vertices."""
    faces = [tuple(int(v) for v in element[list(side)]) for block in mesh.cells if block.type in ELEMENT_FACES
             for element in block.data for side in ELEMENT_FACES[block.type]]
    numbers = Counter(frozenset(f) for f in faces)
    return [f for f in faces if numbers[frozenset(f)] == 1]


class Patches(Case):
    def patches(self):
        slab = self.file("slab.off", off([(0.199 + 0.602 * x, -0.5 + 2 * y, 0.45 + z) for x, y, z in CUBE], TRIANGLES))
        return [x for name, (place, _) in PLACES.items()
                for x in ("--patch", f"{name}={place.replace('FILE', str(slab))}")]

    def run_mesher(self, *arguments):
        """The report, what was printed, and the files that were written."""
        files = {end: WORK / f"cube.{end}" for end in ("inp", "feb", "msh", "vtu")}
        run = self.mesher(self.good, "--vertices", 300, *self.patches(), *arguments, "--report", WORK / "cube.json",
                          *(x for path in files.values() for x in ("--output", path)))
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads((WORK / "cube.json").read_text()), run, files

    def test_order_1(self):
        told, run, files = self.run_mesher()
        msh = meshio.read(files["msh"])
        places = {tuple(p): i for i, p in enumerate(msh.points)}  # meshio numbers by entity
        faces = boundary_of(msh)
        center = {f: msh.points[list(f)].mean(0) for f in faces}
        wanted = {name: {frozenset(f) for f in faces if is_inside(center[f])} for name, (_, is_inside) in PLACES.items()}
        self.assertEqual([p["name"] for p in told["patches"]], list(PLACES))
        for p in told["patches"]:
            self.assertEqual(p["faces"], len(wanted[p["name"]]))
            self.assertTrue(0 < p["faces"] < len(faces))
            self.assertIn(f"{p['name']}: {p['faces']} faces of the boundary, area ", run.stdout)
        for name in ("Top", "base"):
            self.assertAlmostEqual(told["patches"][list(PLACES).index(name)]["area"], 1, places=9)

        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(files["msh"]))
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        ours = {int(tag): places[tuple(p)] for tag, p in zip(tags, np.reshape(coordinates, (-1, 3)))}
        found = {gmsh.model.getPhysicalName(2, group): {
            frozenset(ours[int(v)] for v in f) for entity in gmsh.model.getEntitiesForPhysicalGroup(2, group)
            for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2, entity)) for f in np.reshape(nodes, (-1, kind + 1))}
            for _, group in gmsh.model.getPhysicalGroups(2)}
        volumes = [gmsh.model.getPhysicalName(3, group) for _, group in gmsh.model.getPhysicalGroups(3)]
        gmsh.finalize()
        self.assertEqual(volumes, ["subdomain_1"])
        self.assertEqual(found, {**wanted, "boundary": {frozenset(f) for f in faces}})

        mesh = ElementTree.parse(files["feb"]).getroot().find("Mesh")
        numbers = [places[tuple(float(x) for x in node.text.split(","))] for node in mesh.find("Nodes")]
        for surface in mesh.findall("Surface"):
            self.assertEqual({frozenset(numbers[int(v) - 1] for v in f.text.split(",")) for f in surface},
                             found[surface.get("name")])
        nodes = {s.get("name"): {numbers[int(v) - 1] for v in s.text.split(",")} for s in mesh.findall("NodeSet")}
        self.assertEqual(nodes, {name: frozenset().union(*some) for name, some in found.items()})
        sets = meshio.read(files["inp"]).point_sets
        self.assertEqual({name: {numbers[int(v)] for v in some} for name, some in sets.items()},
                         {name.upper(): some for name, some in nodes.items()})
        data = self.vtu(files["vtu"])
        for name in PLACES:
            self.assertEqual({numbers[v] for v in np.flatnonzero(data("Point", "nodes_" + name))}, nodes[name])
            self.assertEqual(data("Cell", "facets_" + name).sum(), len(wanted[name]))
        self.check_forces(files["inp"], told, "base")

    def vtu(self, path):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        return lambda kind, name: vtk_to_numpy(getattr(reader.GetOutput(), f"Get{kind}Data")().GetArray(name))

    def check_forces(self, path, told, name):
        """The base bears what presses on the top: CalculiX understands node sets and surfaces."""
        (WORK / "press.inp").write_text(
            f"*INCLUDE, INPUT={path.name}\n*ELSET, ELSET=TISSUE, GENERATE\n1, {told['mesh']['elements']}\n"
            "*MATERIAL, NAME=TISSUE\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=TISSUE, MATERIAL=TISSUE\n"
            "*STEP\n*STATIC, SOLVER=SPOOLES\n"
            f"*BOUNDARY\n{name.upper()}, 1, 3\n*DSLOAD\nTOP, P, 5.\n*NODE PRINT, NSET={name.upper()}, TOTALS=ONLY\nRF\n"
            "*END STEP\n")
        run = subprocess.run(["ccx", "press"], cwd=WORK, capture_output=True, text=True,
                             env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False)
        self.assertEqual(run.returncode, 0, run.stdout[-2000:])
        force = [float(x) for x in (WORK / "press.dat").read_text().split()[-3:]]
        for x, wanted in zip(force, (0, 0, 5 * told["patches"][0]["area"])):
            self.assertAlmostEqual(x, wanted, places=4)

    def test_order_2(self):
        """Node sets have the nodes in the middle of edges."""
        told, _, files = self.run_mesher("--order", 2, "--tetrahedra")
        mesh = meshio.read(files["inp"])
        points = mesh.points
        for name, flag in (("Top", lambda p: p[2] > 1 - 1e-9), ("base", lambda p: p[2] < 1e-9)):
            wanted = {i for i, p in enumerate(points) if flag(p)}
            self.assertEqual({int(v) for v in mesh.point_sets[name.upper()]}, wanted)
            self.assertEqual(set(np.flatnonzero(self.vtu(files["vtu"])("Point", "nodes_" + name))), wanted)
        self.check_forces(files["inp"], told, "base")

    def test_subdomains(self):
        """One physical volume a subdomain, in both versions, although a region is in both: the region is an entity of its
        own."""
        inner = self.file("inner.off", off(moved(CUBE, 0.5, (0.25, 0.25, 0.25)), TRIANGLES))
        region = self.file("region.off", off(moved(CUBE, 0.3, (0.05, 0.05, 0.05)), TRIANGLES))
        for version in ([], ["--msh2"]):
            run = self.mesher(self.good, "--vertices", 800, "--subdomain", f"tumor={inner}", "--region", region, *version,
                              "--output", WORK / "two.msh", "--output", WORK / "two.vtu")
            self.assertEqual(run.returncode, 0, run.stderr)
            mesh = meshio.read(WORK / "two.msh", file_format="gmsh")
            volumes = {name: int(tag) for name, (tag, dimension) in mesh.field_data.items() if dimension == 3}
            self.assertEqual(volumes, {"good": 1, "tumor": 2})
            kinds = [i for i, block in enumerate(mesh.cells) if block.type in ELEMENT_FACES]
            group, entity = ([np.asarray(mesh.cell_data[f"gmsh:{name}"][i]) for i in kinds]
                             for name in ("physical", "geometrical"))
            data = self.vtu(WORK / "two.vtu")
            subdomain, in_region = data("Cell", "subdomain"), data("Cell", "in_region")
            entities = subdomain + 10**9 * in_region.astype(int)
            self.assertTrue(0 < in_region.sum() < len(in_region) and len(set(entities)) == 4)
            self.assertEqual(Counter(np.concatenate(group).tolist()), Counter(subdomain.tolist()))
            self.assertEqual(Counter(np.concatenate(entity).tolist()), Counter(entities.tolist()))

    def test_bad_input(self):
        output = ("--vertices", 100, "--output", self.output)
        for patch, words in (("a=sphere:0,0,0,0", "the radius"), ("a=sphere:0,0,0,-1", "the radius"),
                             ("a=sphere:0,0,0", "expected numbers as in sphere:X,Y,Z,R"),
                             ("a=sphere:0,0,0,nan", "expected numbers"), ("a=sphere:0,0,0,1,", "expected numbers"),
                             ("a=box:0,0,0,1,1", "expected numbers"), ("a=box:0,0,x,1,1,1", "expected numbers"),
                             ("a=box:0,0,1,1,1,0", "the corners"),
                             ("a=plane:0,0,0,0,0,0", "the normal"), ("a=plane:", "expected numbers"),
                             ("sphere:0,0,0,1", "NAME=WHERE"), ("a=", "NAME=WHERE"), ("=plane:0,0,0,0,0,1", "a name"),
                             ("1=plane:0,0,0,0,0,1", "a name"), ("Boundary=plane:0,0,0,0,0,1", "a name")):
            with self.subTest(patch=patch):
                self.fails(self.good, *output, "--patch", patch, names=f"--patch {patch}", words=words, status=2)
        top = "top=plane:0,0,1,0,0,1"
        self.fails(self.good, *output, "--patch", top, "--patch", "TOP=plane:0,0,0,0,0,-1", names="--patch TOP",
                   words="the name is taken", status=2)
        self.fails(self.good, *output, "--patch", "far=sphere:9,9,9,1", names="--patch far=sphere:9,9,9,1",
                   words="no face of the boundary has its center inside; the mesh is in box:0,0,0,1,1,1")
        self.fails(self.good, *output, "--patch", "a=none.off", names="none.off")
        for path, *more in ((WORK / "mesh.mesh",), (WORK / "mesh.msh", "--msh2")):
            self.fails(self.good, *output, "--output", path, *more, "--patch", top, "--patch", "half=box:0.5,0,1,1,1,1",
                       names=path, words="two facet sets share a face")
        inner = self.file("inner.off", off(moved(CUBE, 0.5, (0.25, 0.25, 0.25)), TRIANGLES))
        # What is certain is refused before meshing, which would show that there are no faces.
        for path, *more in ((WORK / "mesh.mesh",), (WORK / "mesh.msh", "--msh2"), (WORK / "mesh.msh2",)):
            one, two = "one=sphere:9,9,9,1", "two=sphere:9,9,9,1"
            run = self.fails(self.good, *output, "--output", path, *more, "--patch", one, "--patch", two, names=path,
                             words="two facet sets share a face")
            self.assertIn(f"--patch {one}, and --patch {two}", run.stderr)
            self.fails(self.good, *output, "--output", path, *more, "--patch", one, "--subdomain", f"tumor={inner}",
                       names=path, words=f"share a face, which this format cannot hold: --patch {one}, and that of a subdomain")
        for name in ("tumor", "outside_good", "interface_tumor_good"):
            self.fails(self.good, *output, "--subdomain", f"tumor={inner}", "--patch", f"{name}=plane:0,0,1,0,0,1",
                       names=f"--patch {name}", words="another set")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
