#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of FEBio that brain_shift writes: read back, assembled and solved here, they give what brain_shift computed.

  test_brain_shift_febio.py MESHER SHIFT DATA_DIRECTORY WORK_DIRECTORY
"""

import pathlib
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from cube import CUBE, TRIANGLES, moved, off

MESHER, SHIFT, DATA, WORK = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])

try:
    import numpy as np
    from scipy.sparse import coo_matrix
    from scipy.sparse.linalg import spsolve
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

HEADER = "x,y,z,dx,dy,dz\n"
# The largest Poisson's ratio with which brain_shift's tetrahedra are standard elements is 2/7.
TISSUE = ["--poisson-ratio", "0.28"]
SIZES = {"tet4": 4, "pyra5": 5, "penta6": 6, "hex8": 8}
QUADRATIC_SIZES = {"tet10": 10, "pyra13": 13, "penta15": 15, "hex20": 20}
EDGES = (0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)  # of tet10, in the order of its middle nodes


def shape_of_tet10(w, gradients):
    """Values and gradients of the functions of ten nodes, at a point with barycentric coordinates w."""
    values = [x * (2 * x - 1) for x in w] + [4 * w[i] * w[j] for i, j in EDGES]
    of_edges = [4 * (w[i] * gradients[j] + w[j] * gradients[i]) for i, j in EDGES]
    return np.array(values), np.vstack([(4 * w[:, None] - 1) * gradients, of_edges])


class Model:
    """What FEBio reads. Numbers of nodes are from 0, those of components 3 times that plus the axis."""

    def __init__(self, path):
        self.root = root = ElementTree.parse(path).getroot()
        numbers = lambda text: [int(x) - 1 for x in text.split(",")]
        vector = lambda text: np.array([float(x) for x in text.split(",")])
        self.points = np.array([vector(n.text) for n in root.find("Mesh/Nodes")])
        self.node_sets = {s.get("name"): numbers(s.text) for s in root.findall("Mesh/NodeSet")}
        self.element_sets = {s.get("name"): numbers(s.text) for s in root.findall("Mesh/ElementSet")}
        self.surfaces = [s.get("name") for s in root.findall("Mesh/Surface")]
        self.materials = {m.get("name"): {x.tag: float(x.text) for x in m} for m in root.find("Material")}
        self.parts = {b.get("name"): {int(e.get("id")) - 1: numbers(e.text) for e in b}
                      for b in root.findall("Mesh/Elements")}
        self.kinds = {b.get("name"): b.get("type") for b in root.findall("Mesh/Elements")}
        self.material_of = {d.get("name"): d.get("mat") for d in root.find("MeshDomains")}
        self.data = {d.get("name"): (d.get("node_set"), [vector(n.text) for n in d])
                     for d in root.findall("MeshData/NodeData")}
        self.forces = {b.get("elem_set"): vector(b.find("force").text) for b in root.findall("Loads/body_load")}
        self.read_boundary()

    def read_boundary(self):
        """Components that are told: by a value, or by others."""
        component = lambda tag: 3 * (int(tag.find("node").text) - 1) + "xyz".index(tag.find("dof").text)
        self.values, self.links = {}, {}
        for bc in self.root.findall("Boundary/bc"):
            if bc.get("type") == "zero displacement":
                told = {3 * v + k: 0. for v in self.node_sets[bc.get("node_set")] for k in range(3)
                        if bc.find("xyz"[k] + "_dof").text == "1"}
            elif bc.get("type") == "prescribed displacement":
                assert bc.find("value").attrib == {"lc": "1", "type": "map"} and bc.find("relative").text == "0"
                on, values = self.data[bc.find("value").text]
                assert on == bc.get("node_set")
                k = "xyz".index(bc.find("dof").text)
                told = {3 * v + k: x[0] for v, x in zip(self.node_sets[on], values, strict=True)}
            else:
                assert bc.attrib == {"type": "linear constraint"}
                offset = bc.find("offset")
                assert offset is None or offset.get("lc") == "1"
                told = {component(bc): 0. if offset is None else float(offset.text)}
                self.links[component(bc)] = {component(c): float(c.find("value").text) for c in bc.findall("child_dof")}
            assert not set(told) & set(self.values), "a component is told twice"
            self.values.update(told)
        assert not any(c in self.values for terms in self.links.values() for c in terms), "FEBio refuses chains"

    def solve(self):
        """Displacements of linear elasticity on tetrahedra of order 1 or 2, standard elements."""
        n, rows, columns, entries, load = self.points.size, [], [], [], np.zeros(self.points.size)
        for name, elements in self.parts.items():
            assert self.kinds[name] in ("tet4", "tet10")
            size = QUADRATIC_SIZES.get(self.kinds[name], 4)
            # Points that are exact for products of two strains.
            weights = np.full((1, 4), 0.25) if size == 4 else np.full((4, 4), (5 - 5 ** 0.5) / 20) + np.eye(4) / 5 ** 0.5
            m = self.materials[self.material_of[name]]
            mu, nu = m["E"] / 2 / (1 + m["v"]), m["v"]
            law = np.diag([2 * mu] * 3 + [mu] * 3)
            law[:3, :3] += 2 * mu * nu / (1 - 2 * nu)
            for nodes in elements.values():
                corners = nodes[:4]
                linear = np.linalg.inv(np.hstack([np.ones((4, 1)), self.points[corners]]))[1:].T  # gradients
                volume = np.linalg.det(self.points[corners[1:]] - self.points[corners[0]]) / 6 / len(weights)
                components = (3 * np.array(nodes)[:, None] + np.arange(3)).ravel()
                rows.append(np.repeat(components, 3 * size))
                columns.append(np.tile(components, 3 * size))
                stiffness = np.zeros((3 * size, 3 * size))
                for w in weights:
                    values, shape = (w, linear) if size == 4 else shape_of_tet10(w, linear)
                    strain = np.zeros((6, 3 * size))
                    for a, (x, y, z) in enumerate(shape):
                        strain[:, 3 * a:3 * a + 3] = [[x, 0, 0], [0, y, 0], [0, 0, z], [y, x, 0], [0, z, y], [z, 0, x]]
                    stiffness += volume * strain.T @ law @ strain
                    # FEBio's force by mass is what the body resists.
                    force = -m["density"] * self.forces.get(name, np.zeros(3))
                    load[components] += np.outer(volume * values, force).ravel()
                entries.append(stiffness.ravel())
        stiffness = coo_matrix((np.concatenate(entries), (np.concatenate(rows), np.concatenate(columns))), (n, n))
        free = sorted(set(range(n)) - set(self.values))
        number = {c: i for i, c in enumerate(free)}
        triples = [(c, i, 1.) for c, i in number.items()]
        triples += [(c, number[d], f) for c, terms in self.links.items() for d, f in terms.items()]
        at, of, factors = map(np.array, zip(*triples))
        from_free, given = coo_matrix((factors, (at, of)), (n, len(free))).tocsc(), np.zeros(n)
        for c, value in self.values.items():
            given[c] = value
        stiffness = stiffness.tocsc()
        u = spsolve(from_free.T @ stiffness @ from_free, from_free.T @ (load - stiffness @ given))
        return (from_free @ u + given).reshape(-1, 3)


class Febio(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.tetrahedra, cls.mixed = WORK / "tetrahedra.vtu", WORK / "mixed.vtu"
        cls.mesh(DATA / "brain.off", "--region", DATA / "region.off", "--vertices", 300, "--no-simplification",
                 "--tetrahedra", "--output", cls.tetrahedra)
        cls.box, cls.tumor = cls.file("box.off", off(moved(CUBE, 60), TRIANGLES)), cls.cube("tumor.off", 14, 8)
        cls.mesh(cls.box, "--subdomain", f"tumor={cls.tumor}", "--region", cls.cube("region.off", 20, 5), "--vertices",
                 600, "--no-simplification", "--output", cls.mixed)
        cls.points = DATA / "control_points.csv"
        cls.point = cls.file("point.csv", HEADER + "40,40,60,0.2,0,-0.5\n")
        cls.small = cls.times(0.05, "small.csv")  # inverts no element of order 2

    @classmethod
    def times(cls, factor, name):
        """The control points, with displacements times a factor."""
        rows = [row.split(",") for row in cls.points.read_text().splitlines() if row and row[0] not in "#x"]
        return cls.file(name, HEADER + "".join(
            ",".join(row[:3] + [repr(factor * float(x)) for x in row[3:6]]) + "\n" for row in rows))

    @staticmethod
    def mesh(*words):
        subprocess.run([MESHER, *map(str, words), "--quiet"], check=True, capture_output=True)

    @staticmethod
    def file(name, text):
        (WORK / name).write_text(text)
        return WORK / name

    @classmethod
    def cube(cls, name, width, low):
        return cls.file(name, off(moved(CUBE, width, (low, low, low)), TRIANGLES))

    def run_shift(self, *words):
        return subprocess.run([SHIFT, *map(str, words)], capture_output=True, text=True, timeout=120)

    def model(self, mesh, *words, points=None):
        """The model, and the displacements that brain_shift has for its nodes."""
        run = self.run_shift(mesh, "--control-points", points or self.points, *words, "--quiet", "--febio",
                             WORK / "model.feb", "--output", WORK / "shift.feb")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        values = Model(WORK / "shift.feb").data["displacement"][1]
        return Model(WORK / "model.feb"), np.array(values)

    def check_solution(self, *words, mesh=None, points=None, tolerance=1e-6):
        defaults = (TISSUE if "--poisson-ratio" not in words else []) + (["--order", 1] if "--order" not in words else [])
        model, u = self.model(mesh or self.tetrahedra, *defaults, *words, points=points)
        self.assertEqual(len(u), len(model.points))
        error = np.abs(model.solve() - u).max()
        self.assertGreater(np.abs(u).max(), 0.1)
        self.assertLess(error, tolerance * np.abs(u).max())
        return model

    def test_solution(self):
        """Control points in faces: each component of each is a linear constraint."""
        model = self.check_solution()
        self.assertTrue(model.node_sets["fixed"] and len(model.links) > 0)
        self.assertEqual(set(model.kinds.values()), {"tet4"})

    def test_points_at_vertices(self):
        """One set and one map for each axis."""
        model, _ = self.model(self.tetrahedra)
        top = np.argsort(model.points[:, 2])[-40::8]
        rows = [[*model.points[v], 0.5, 0, -2 - 0.1 * i] for i, v in enumerate(top)]
        points = self.file("vertices.csv", HEADER + "".join(",".join(map(repr, map(float, r))) + "\n" for r in rows))
        model = self.check_solution(points=points)
        self.assertEqual(model.links, {})
        for k, axis in enumerate("xyz"):
            self.assertEqual(model.node_sets["controlled_" + axis], sorted(top))
            given = dict(zip(model.node_sets["controlled_" + axis], model.data["controlled_" + axis][1]))
            for v, row in zip(top, rows):
                self.assertAlmostEqual(given[v][0], row[3 + k], 12)

    def test_sliding_means_and_materials(self):
        """Oblique supports, and means that have vertices in common with these and with each other."""
        model = self.check_solution("--slide-below", "0.7", "--control-radius", "25")
        self.assertGreater(len(model.links), 50)
        offsets = [c for c in model.links if model.values[c] != 0]
        self.assertGreater(max(len(model.links[c]) for c in offsets), 9)
        self.check_solution("--slide-beyond", "30", "--fixed-below", "0", "--material", "1=3,0.2,1.1")
        self.check_solution("--control-compliance", "0.1", "--control-radius", "10")

    def test_order_2(self):
        """Ten nodes: control points in faces, means, oblique supports, weight; with any ratio of Poisson, as elements of
        order 2 are standard ones."""
        order_2 = "--order", "2", "--output-order", "2"
        for words in ((), ("--poisson-ratio", "0.45"), ("--slide-below", "0.7", "--control-radius", "25"),
                      ("--slide-beyond", "30", "--fixed-below", "0", "--material", "1=3,0.2,1.1"),
                      ("--control-compliance", "0.1", "--control-radius", "10"), ("--gravity", "0,-3000,-9810")):
            with self.subTest(words=words):
                model = self.check_solution(*order_2, *words, points=self.small)
                self.assertEqual(set(model.kinds.values()), {"tet10"})
                vertices = max(max(e[:4]) for elements in model.parts.values() for e in elements.values()) + 1
                self.assertGreater(len(model.points), 4 * vertices)
                self.assertTrue(any(v >= vertices for nodes in model.node_sets.values() for v in nodes)
                                or "--fixed-below" in words)
                if "--control-radius" in words:
                    self.assertTrue(any(c >= 3 * vertices for terms in model.links.values() for c in terms))

    def test_order_2_by_default(self):
        model, _ = self.model(self.tetrahedra, *TISSUE, "--control-radius", "16", "--output-order", "2",
                              points=self.small)
        self.assertEqual(set(model.kinds.values()), {"tet10"})

    def test_order_2_after_resection(self):
        """Middle nodes of what is left have numbers of their own."""
        model, _ = self.model(self.tetrahedra, *TISSUE, "--order", "2", "--tumor", DATA / "tumour.off",
                              "--output-deformed", WORK / "left.feb", points=self.small)
        left = Model(WORK / "left.feb")
        corners = lambda m: {name.split("_")[0]: {e: nodes[:4] for e, nodes in elements.items()}
                             for name, elements in m.parts.items()}
        self.assertEqual(corners(model), corners(left))
        u = left.points - model.points[:len(left.points)]
        self.assertLess(np.abs(model.solve()[:len(u)] - u).max(), 2e-3 * np.abs(u).max())

    def test_order_2_mixed(self):
        model, u = self.model(self.mixed, "--order", "2", "--output-order", "2", points=self.point)
        self.assertEqual(set(model.kinds.values()), set(QUADRATIC_SIZES))
        for name, elements in model.parts.items():
            self.assertEqual({len(e) for e in elements.values()}, {QUADRATIC_SIZES[model.kinds[name]]})
        # What is told is what came out.
        for told, terms in model.links.items():
            sum_of_terms = model.values[told] + sum(f * u.flat[c] for c, f in terms.items())
            self.assertAlmostEqual(sum_of_terms, u.flat[told], 9)
        for told, value in model.values.items():
            self.assertTrue(told in model.links or abs(u.flat[told] - value) < 1e-9)

    def test_weight(self):
        still = self.times(0, "still.csv")
        model = self.check_solution("--gravity", "0,-3000,-9810", points=still)
        for force in model.forces.values():  # of 1.04 g/cm^3 in 1 g/cm^3
            self.assertTrue(np.allclose(force, np.array([0, 3000, 9810]) * (1 - 1 / 1.04)))
        self.assertEqual({m["density"] for m in model.materials.values()}, {1.04e-6})
        self.check_solution("--gravity", "0,-100,-981", "--fluid-density", "0", points=still)

    def test_axis_parallel_supports_and_subdomains(self):
        """On a box, supports that slide on a face are zero along an axis; on an edge, along an oblique one."""
        mesh = WORK / "box.vtu"
        self.mesh(self.box, "--subdomain", f"tumor={self.tumor}", "--vertices", 300, "--tetrahedra", "--output", mesh)
        model = self.check_solution("--slide-below", "0.9", "--fixed-below", "0.1", "--material", "tumor=9,0.25,1.2",
                                    "--gravity", "0,0,-9810", mesh=mesh, points=self.point)
        # Not those in which the elimination found no other component to be told.
        for axis in "xy":
            inside = model.points[model.node_sets["sliding_" + axis]][:, "xyz".index(axis)]
            self.assertTrue(np.all((np.abs(inside) < 1e-9) | (np.abs(inside - 60) < 1e-9)))
        self.assertEqual(model.materials["tumor"], {"E": 9, "v": 0.25, "density": 1.2e-6})
        self.assertEqual(model.materials["box"], {"E": 1, "v": 0.28, "density": 1.04e-6})
        self.assertEqual(set(model.forces), set(model.parts))

    def test_resection(self):
        """What is left, with numbers of its own."""
        model, _ = self.model(self.tetrahedra, *TISSUE, "--tumor", DATA / "tumour.off", "--output-deformed",
                              WORK / "left.feb")
        left = Model(WORK / "left.feb")
        self.assertEqual([model.parts, model.kinds], [left.parts, left.kinds])
        u = left.points - model.points
        self.assertLess(np.abs(model.solve() - u).max(), 1e-3 * np.abs(u).max())  # which is brain_shift's tolerance

    def test_mixed(self):
        """All four kinds, names, numbers and sections."""
        patch = self.cube("patch.off", 50, 15)
        model, _ = self.model(self.mixed, "--material", "tumor=3,0.4,1.1", "--opening", patch, "--slide", "skull",
                              "--fixed", "base", points=self.point)
        root = model.root
        self.assertEqual([c.tag for c in root], ["Module", "Control", "Material", "Mesh", "MeshDomains", "Boundary",
                                                 "LoadData", "Output"])
        self.assertEqual(set(model.kinds.values()), set(SIZES))
        self.assertTrue(any(name.startswith("tumor.region_") for name in model.parts), model.parts.keys())
        self.assertEqual(set(model.parts), set(model.material_of))
        for name, elements in model.parts.items():
            self.assertEqual({len(e) for e in elements.values()}, {SIZES[model.kinds[name]]})
            self.assertEqual(model.material_of[name], name.split(".")[0])
            self.assertEqual(sorted(elements), list(elements))
        ids = sorted(e for elements in model.parts.values() for e in elements)
        self.assertEqual(ids, list(range(len(ids))))
        used = {v for elements in model.parts.values() for e in elements.values() for v in e}
        self.assertEqual(used, set(range(len(model.points))))
        self.assertEqual([int(n.get("id")) for n in root.find("Mesh/Nodes")], list(range(1, len(model.points) + 1)))
        of_tumor = [e for name, elements in model.parts.items() if name.startswith("tumor.") for e in elements]
        self.assertEqual(sorted(model.element_sets["tumor"]), sorted(of_tumor))
        self.assertEqual(list(model.element_sets), ["box", "tumor"])
        self.assertEqual(model.materials, {"box": {"density": 1.04e-6, "E": 1, "v": 0.45},
                                           "tumor": {"density": 1.1e-6, "E": 3, "v": 0.4}})
        self.assertEqual({m.get("type") for m in root.find("Material")}, {"isotropic elastic"})
        self.assertEqual(model.surfaces, ["boundary", "fixed", "sliding", "opening"])
        for name, nodes in model.node_sets.items():
            self.assertTrue(set(nodes) <= used and len(set(nodes)) == len(nodes), name)
        low = model.points[model.node_sets["fixed"]][:, 2]
        self.assertLess(low.max(), 0.3 * 60)
        self.assertEqual([root.find("Control/" + tag).text for tag in ("analysis", "time_steps", "step_size")],
                         ["STATIC", "10", "0.1"])
        curve = root.find("LoadData/load_controller")
        self.assertEqual([curve.get("id"), *(p.text for p in curve.find("points"))], ["1", "0,0", "1,1"])
        log = root.find("Output/logfile/node_data")
        self.assertEqual((log.get("data"), log.get("file")), ("ux;uy;uz", "model_displacements.csv"))
        self.assertIn("Units: mm, kPa, kg, s.", (WORK / "model.feb").read_text())

    def test_names(self):
        """Without names, parts and materials are region and rest, or those of a number."""
        model, _ = self.model(self.tetrahedra, *TISSUE)
        self.assertEqual(set(model.parts), {"region_tet4", "rest_tet4"})
        self.assertEqual((set(model.materials), model.element_sets), ({"region", "rest"}, {}))
        unnamed = WORK / "unnamed.mesh"
        self.mesh(self.box, "--subdomain", f"tumor={self.tumor}", "--vertices", 300, "--output", unnamed)
        run = self.run_shift(unnamed, "--control-points", self.point, "--febio", WORK / "unnamed.feb")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(Model(WORK / "unnamed.feb").material_of), len(Model(WORK / "unnamed.feb").parts))

    def test_refusals(self):
        before = sorted(WORK.iterdir())
        for words, names in ((["--contact", "skull"], "--contact: "),
                             (["--gravity", "0,0,-9810", "--fluid-level", "10"], "--fluid-level: "),
                             (["--gravity", "0,0,-9810", "--density", "0"], "--density: "),
                             (["--gravity", "0,0,-9810", "--material", "1=1,0.3,0"], "--density: "),
                             (["--febio", WORK / "model.vtu"], "--febio: ")):
            with self.subTest(words=words):
                febio = [] if words[0] == "--febio" else ["--febio", WORK / "no.feb"]
                run = self.run_shift(self.tetrahedra, "--control-points", self.points, *febio, *words, "--report",
                                     WORK / "no.json")
                self.assertEqual((run.returncode, run.stdout), (2, ""))
                self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
                self.assertIn("brain_shift: error: " + names, run.stderr)
        run = self.run_shift(self.tetrahedra, "--control-points", self.points, "--febio", WORK / "none" / "a.feb")
        self.assertEqual(run.returncode, 1)
        self.assertIn("none", run.stderr)
        self.assertEqual(sorted(WORK.iterdir()), before)
        # What does not keep a model from being written.
        self.model(self.tetrahedra, "--gravity", "0,0,-9810", "--density", "0", "--fluid-density", "0")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
