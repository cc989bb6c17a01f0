#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of subdomains: what mixed_mesh_3 writes, VTK and Gmsh read, and brain_shift understands.

meshio is not needed: what it demands of a file of VTK is checked on the file (`strict_arrays()`).

  test_subdomain_names.py MESHER SHIFT WORK_DIRECTORY
"""

import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree
import zlib

MESHER, SHIFT, WORK = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])

try:
    import gmsh
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

NAMES = {1: "box", 2: "tumor", 3: "Left-Ventricle"}
FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def box(name, low, high):
    """Its file, with triangles."""
    corners = [[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)]
    triangles = [(f[0], f[i], f[i + 1]) for f in FACES for i in (1, 2)]
    lines = ["OFF", f"8 {len(triangles)} 0", *(" ".join(map(str, p)) for p in corners),
             *("3 %d %d %d" % t for t in triangles)]
    (WORK / name).write_text("\n".join(lines) + "\n")
    return WORK / name


def strict_arrays(path):
    """The arrays of a file, read as meshio 5.0 does: it knows no type but those of numbers, no elements but
    these, and finds appended arrays one behind the other, at the offsets that are declared."""
    types = {"Float64": "f8", "Int32": "i4", "Int64": "i8", "UInt8": "u1"}
    raw = path.read_bytes()
    begin = re.search(b'<AppendedData[^>]+">', raw).end()
    end = raw.find(b"</AppendedData>")
    root = ElementTree.fromstring(raw[:begin] + raw[end:])
    assert root.get("header_type") == "UInt64" and root.get("compressor") == "vtkZLibDataCompressor"
    assert [child.tag for child in root] == ["UnstructuredGrid", "AppendedData"]
    assert {child.tag for child in root[0]} <= {"FieldData", "Piece"}
    assert {child.tag for child in root[0].find("Piece")} <= {"Points", "Cells", "PointData", "CellData"}
    data = raw[begin:end].split(b"_", 1)[1].rsplit(b"\n", 1)[0]
    declared = {int(a.get("offset")): a for a in root.iter() if a.get("format") == "appended"}
    found = {}
    for a in root.iter():
        if a.get("format") == "ascii":
            found[a.get("Name")] = np.array(a.text.split(), types[a.get("type")])
    place = 0
    while place < len(data):
        a = declared.pop(place)
        number, size, last = struct.unpack_from("<3Q", data, place)
        sizes = struct.unpack_from(f"<{number}Q", data, place + 24)
        place += 24 + 8 * number
        blocks = []
        for n in sizes:
            blocks.append(zlib.decompress(data[place:place + n]))
            place += n
        assert [len(b) for b in blocks] == [size] * (number - 1) + [last or size] * (number > 0)
        found[a.get("Name")] = np.frombuffer(b"".join(blocks), types[a.get("type")])
    assert place == len(data) and not declared
    return found


class Test(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.files = {end: WORK / f"mesh.{end}" for end in ("vtu", "msh", "inp", "feb", "mesh")}
        outputs = [word for file in cls.files.values() for word in ("--output", file)]
        subprocess.run([MESHER, box("box.off", (0, 0, 0), (60, 50, 40)), "--subdomain",
                        f"tumor={box('a.off', (8, 8, 8), (22, 22, 22))}", "--subdomain",
                        f"Left-Ventricle={box('b.off', (35, 20, 10), (52, 40, 30))}", "--vertices", "500",
                        "--report", WORK / "mesh.json", *outputs], check=True, capture_output=True)
        told = json.loads((WORK / "mesh.json").read_text())
        cls.elements = {s["index"]: s["elements"] for s in told["subdomains"]}
        (WORK / "points.csv").write_text("x,y,z,dx,dy,dz\n30,25,40,0,0,-0.5\n")

    def numbers_in_vtu(self, path):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        names = bytes(vtk_to_numpy(grid.GetFieldData().GetArray("subdomain_names"))).decode().split("\0")[:-1]
        indices = vtk_to_numpy(grid.GetFieldData().GetArray("subdomain_indices"))
        subdomain = vtk_to_numpy(grid.GetCellData().GetArray("subdomain"))
        self.assertEqual(len(names), len(indices))
        self.assertEqual({int(n): names[i] for i, n in enumerate(indices)}, NAMES)
        return grid, {n: np.count_nonzero(subdomain == n) for n in NAMES}

    def test_vtk(self):
        self.assertEqual(self.numbers_in_vtu(self.files["vtu"])[1], self.elements)

    def test_meshio(self):
        """Its rules lead to the same arrays as VTK; they are smaller than their numbers."""
        arrays = strict_arrays(self.files["vtu"])
        grid, _ = self.numbers_in_vtu(self.files["vtu"])
        self.assertEqual(bytes(arrays.pop("subdomain_names")), b"".join(n.encode() + b"\0" for n in NAMES.values()))
        self.assertEqual(list(arrays.pop("subdomain_indices")), list(NAMES))
        cells = {"types": grid.GetCellTypesArray(), "connectivity": grid.GetCells().GetConnectivityArray()}
        size = 0
        for name, values in arrays.items():
            size += values.nbytes
            if name == "Points":
                other = vtk_to_numpy(grid.GetPoints().GetData()).ravel()
            elif name == "offsets":
                other = vtk_to_numpy(grid.GetCells().GetOffsetsArray())[1:]
            else:
                data = grid.GetPointData() if name.startswith("nodes_") else grid.GetCellData()
                other = vtk_to_numpy(cells.get(name) or data.GetArray(name))
            self.assertTrue(np.array_equal(values, other), name)
        self.assertLess(self.files["vtu"].stat().st_size, 0.8 * size)

    def test_gmsh(self):
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(self.files["msh"]))
        found = {}
        for dimension, tag in gmsh.model.getPhysicalGroups(3):
            name = gmsh.model.getPhysicalName(dimension, tag)
            found[name] = sum(len(numbers) for entity in gmsh.model.getEntitiesForPhysicalGroup(3, tag)
                              for numbers in gmsh.model.mesh.getElements(3, entity)[1])
        gmsh.finalize()
        self.assertEqual(found, {name: self.elements[index] for index, name in NAMES.items()})

    def test_abaqus(self):
        """Sets of sets."""
        sets, now = {}, None
        for line in self.files["inp"].read_text().splitlines():
            if line.startswith("*"):
                name = re.search("ELSET=([^,]*)$", line)
                now = sets.setdefault(name[1], []) if name else None
            elif now is not None:
                now.append(line)
        size = lambda name: sum(size(x) if x in sets else 1 for x in sets[name])
        for index, name in NAMES.items():
            self.assertEqual(size(name.upper()), self.elements[index])

    def test_febio(self):
        root = ElementTree.parse(self.files["feb"]).getroot()
        mesh = root.find("Mesh")
        materials = {d.get("name"): d.get("mat") for d in root.find("MeshDomains")}
        self.assertEqual({m.get("name") for m in root.find("Material")}, set(NAMES.values()))
        elements = {e.get("id"): block.get("name") for block in mesh.iter("Elements") for e in block.iter("elem")}
        sets = {s.get("name"): s.text.split(",") for s in mesh.iter("ElementSet")}
        self.assertEqual(set(sets), set(NAMES.values()))
        for index, name in NAMES.items():
            self.assertEqual(len(set(sets[name])), self.elements[index])
            for part in {elements[e] for e in sets[name]}:
                self.assertRegex(part, f"^{name}.(region|rest)_(tet4|pyra5|penta6|hex8)$")
                self.assertEqual(materials[part], name)

    def shift(self, file, *more):
        command = [SHIFT, file, "--control-points", WORK / "points.csv", "--report", WORK / "shift.json", *more]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True)

    def test_by_name(self):
        """As by number, from each format that has names; files written anew have them, too."""
        told = {}
        again = WORK / "again.vtu"
        # as other programs save them
        grid, _ = self.numbers_in_vtu(self.files["vtu"])
        copies = {}
        for mode in ("Ascii", "Binary", "Appended"):
            writer = vtk.vtkXMLUnstructuredGridWriter()
            copies[mode] = WORK / f"{mode}.vtu"
            writer.SetFileName(str(copies[mode]))
            writer.SetInputData(grid)
            getattr(writer, f"SetDataModeTo{mode}")()
            writer.Write()
        # strings of VTK, as files had them before
        copies["strings"] = WORK / "strings.vtu"
        text = copies["Ascii"].read_text()
        old = re.search(r'<DataArray type="UInt8" Name="subdomain_names"[^>]*>([^<]*)</DataArray>', text)
        copies["strings"].write_text(text.replace(old[0], '<Array type="String" Name="subdomain_names" NumberOfTuples="3" '
                                                  f'format="ascii">{old[1]}</Array>'))
        for label, file in ((2, self.files["vtu"]), ("tumor", self.files["vtu"]), ("tumor", self.files["msh"]),
                            *(("tumor", copy) for copy in copies.values())):
            with self.subTest(label=label, file=file):
                run = self.shift(file, "--material", f"{label}=3000,0.45", "--tumor-label", label, "--output", again)
                self.assertEqual(run.returncode, 0, run.stderr)
                report = json.loads((WORK / "shift.json").read_text())
                told[str(label) + file.name] = [(s["index"], s["name"], s["elements"], s["Young's modulus"])
                                                for s in report["subdomains"]] + [report["resection"]["cavity volume"]]
                self.assertEqual(self.numbers_in_vtu(again)[1], self.elements)
        first = next(iter(told.values()))
        self.assertEqual([s[1] for s in first[:3]], list(NAMES.values()))
        self.assertEqual([s[3]["value"] for s in first[:3]], [1, 3000, 1])
        for values in told.values():
            self.assertEqual([v[:3] for v in values[:3]], [v[:3] for v in first[:3]])
            self.assertAlmostEqual(values[3], first[3], delta=1e-9 * first[3])

    def test_extract(self):
        """All formats have the elements of the chosen subdomains, the same as in the whole mesh, and the facets that were
        interfaces with what is left out as boundary."""
        files = {end: WORK / f"part.{end}" for end in ("vtu", "msh", "inp", "feb", "mesh")}
        second = {end: WORK / f"second.{end}" for end in ("vtu", "msh", "feb")}
        surfaces = [WORK / "box.off", "--subdomain", f"tumor={WORK / 'a.off'}", "--subdomain",
                    f"Left-Ventricle={WORK / 'b.off'}", "--vertices", "500", "--report", WORK / "part.json"]
        hole = ["--patch", "hole=box:34,19,9,53,41,31", "--order", "2"]
        for more, outputs in (([], files), (hole, second)):
            run = subprocess.run([MESHER, *surfaces, "--extract", "tumor", "--extract", "BOX", *more, "--page",
                                  WORK / "part.html", *(w for f in outputs.values() for w in ("--output", f))],
                                 capture_output=True, text=True)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("written of that: tumor, box, ", run.stdout)
        told = json.loads((WORK / "part.json").read_text())
        part = told["extracted"]
        volumes = {s["name"]: s["volume"] for s in told["subdomains"]}
        self.assertEqual(part["subdomains"], ["tumor", "box"])
        self.assertEqual(part["elements"], self.elements[1] + self.elements[2])
        self.assertAlmostEqual(part["volume"], volumes["tumor"] + volumes["box"], delta=1e-9 * part["volume"])
        self.assertEqual((part["nonmanifold boundary edges"], part["nonmanifold boundary vertices"]), (0, 0))

        # what VTK reads: the cells of the whole file, and a closed surface
        def cells(path):
            reader = vtk.vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(path))
            reader.Update()
            grid = reader.GetOutput()
            labels = vtk_to_numpy(grid.GetCellData().GetArray("subdomain"))
            points = vtk_to_numpy(grid.GetPoints().GetData())
            ends = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
            vertices = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
            return grid, [(int(label), points[vertices[a:b]].tolist()) for label, a, b in zip(labels, ends, ends[1:])]
        _, whole = cells(self.files["vtu"])
        grid, found = cells(files["vtu"])
        self.assertEqual(found, [cell for cell in whole if cell[0] != 3])
        self.assertEqual(grid.GetNumberOfPoints(), part["vertices"])
        self.assertEqual(grid.GetNumberOfPoints(), len({tuple(p) for _, points in found for p in points}))
        surface = vtk.vtkDataSetSurfaceFilter()
        surface.SetInputData(grid)
        edges = vtk.vtkFeatureEdges()
        edges.SetInputConnection(surface.GetOutputPort())
        edges.FeatureEdgesOff()
        edges.Update()
        self.assertEqual(surface.GetOutput().GetNumberOfCells(), part["boundary faces"])
        self.assertEqual(edges.GetOutput().GetNumberOfCells(), 0)  # neither open nor of more than two faces
        grid, _ = cells(second["vtu"])
        self.assertEqual(grid.GetNumberOfPoints(), told["extracted"]["nodes"])

        def groups(path, dimension):
            gmsh.initialize()
            gmsh.option.setNumber("General.Terminal", 0)
            gmsh.open(str(path))
            result = {gmsh.model.getPhysicalName(d, tag):
                      sum(len(numbers) for entity in gmsh.model.getEntitiesForPhysicalGroup(d, tag)
                          for numbers in gmsh.model.mesh.getElements(d, entity)[1])
                      for d, tag in gmsh.model.getPhysicalGroups(dimension)}
            gmsh.finalize()
            return result
        before = groups(self.files["msh"], 2)
        hole_faces = before["interface_box_Left-Ventricle"]
        self.assertEqual(groups(files["msh"], 3), {"box": self.elements[1], "tumor": self.elements[2]})
        outside = before["outside_box"] + hole_faces
        after = {"boundary": outside, "outside_box": outside, "interface_box_tumor": before["interface_box_tumor"]}
        self.assertEqual(groups(files["msh"], 2), after)
        self.assertEqual(groups(second["msh"], 2)["hole"], hole_faces)
        self.assertEqual({tuple(i["between"]): i["faces"] for i in part["interfaces"]},
                         {("box", "outside"): after["outside_box"], ("box", "tumor"): after["interface_box_tumor"]})
        self.assertEqual(told["patches"][0]["faces"], hole_faces)
        for path in (files["feb"], second["feb"]):
            sets = {s.get("name"): s.text.split(",") for s in ElementTree.parse(path).getroot().iter("ElementSet")}
            self.assertEqual({n: len(set(s)) for n, s in sets.items()}, {"box": self.elements[1], "tumor": self.elements[2]})
        self.assertNotIn("LEFT-VENTRICLE", files["inp"].read_text().upper())
        lines = files["mesh"].read_text().splitlines()
        number = sum(int(lines[i + 1]) for i, line in enumerate(lines) if line in
                     ("Tetrahedra", "Pyramids", "Prisms", "Hexahedra"))
        self.assertEqual(number, part["elements"])

    def test_bad_names(self):
        run = self.shift(self.files["vtu"], "--material", "lesion=3,0.45")
        self.assertEqual(run.returncode, 1)
        self.assertIn('has no subdomain "lesion", but 1 (box), 2 (tumor), 3 (Left-Ventricle)', run.stderr)
        run = self.shift(self.files["msh"], "--material", "tumor=3,0.45", "--material", "2=3,0.45")
        self.assertEqual(run.returncode, 1)
        self.assertIn("is given two materials", run.stderr)
        run = self.shift(self.files["mesh"], "--tumor-label", "tumor")  # Medit has no names, but numbers of its own
        self.assertEqual(run.returncode, 1)
        self.assertIn('has no subdomain "tumor", but 1, ', run.stderr)
        for names in (["Tumor=", "tumor="], ["region="], ["BOX="], ["subdomain_2="]):
            options = [word for name in names for word in ("--subdomain", name + str(WORK / "a.off"))]
            run = subprocess.run([MESHER, WORK / "box.off", "--vertices", "500", *options], capture_output=True,
                                 text=True)
            self.assertEqual(run.returncode, 2, run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
