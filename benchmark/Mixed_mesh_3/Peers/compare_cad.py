#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes surfaces of mechanical parts, with sharp edges, with as many vertices by four meshers, and measures all.

  compare_cad.py PROGRAMS SURFACES WORK [--vertices 2000] [--surfaces joint ...] [--meshers gmsh ...] [--save BASE]

PROGRAMS holds measure_mesh, benchmark_mesh_3 and coarsen_surface; tetgen must be on the path, and the module gmsh be
installed for /usr/bin/python3. SURFACES is the folder data/meshes of libcgal-dev's data.tar.gz
(/usr/share/doc/libcgal-dev). WORK gets the meshes. BASE.md, BASE.csv and BASE.json get the table.

Surfaces are scaled: the diagonal of their box is 100, and distances are per cent of it. There is no region: sizes
are the same everywhere. Edges are sharp from 50 degrees between normals on. TetGen keeps the surface: it gets it as it
is if it has less than a third of the vertices, a coarsened one otherwise, and coarsening is in its time. Its bound on
the radius-edge ratio is 1.4 (option q1.4); where that takes more vertices whatever the size, 2, 3 or 9, or at last
it must not split the triangles (option Y). Mesh_3's bound on the facets' distance is a tenth of the size; it perturbs
and exudes. Gmsh parametrizes the surface, cut along edges that are sharp by 50 degrees, or 60 if it
fails, and meshes by its Delaunay algorithm. Sizes of the
peers are scaled until the number of vertices is within 2 % of the wanted one, in at most 12 trials, which are not
timed; benchmark_mesh_3 has a search of its own, and the trials for TetGen's option come before.

All meshes are measured by measure_mesh, from their files. Topology is right if the boundary is a manifold with as many
shells as the surface and its Euler characteristic. "invalid" are elements not proved valid and pairs of triangles of
the boundary that intersect. Times are CPU seconds from a surface in memory to a mesh, of one run; those of TetGen are
what it prints, without output. A row that fails says so, and the rest goes on.
"""

import argparse
import pathlib
import statistics
import sys

from compare_with_peers import (HERE, Failure, Meshers, last_json, number, run, search, seconds_of_tetgen,
                                write_results, write_smesh)
from compare_programs import write_off
from results import markdown

SURFACES = ("anchor_dense", "couplingdown", "cross", "cube-meshed", "fandisk", "joint", "part", "pinion_small", "rotor",
            "spool")
ANGLE = 50
START = 8  # per cent of the diagonal
CLOSE = 0.02
TRIALS = 12


def prepare(file, scaled):
    """Writes the surface with a diagonal of 100; returns its number of vertices."""
    import numpy
    from sizes import read_off
    points, triangles = read_off(file)
    points = (points - points.min(0)) * 100 / numpy.linalg.norm(points.max(0) - points.min(0))
    write_off(scaled, points.tolist(), triangles.tolist())
    return len(points)


def measure(mesh, *options):
    return last_json(run(Meshers.programs / "measure_mesh", Meshers.surface, Meshers.surface, "--mesh", mesh, *options))


def own(base, wanted):
    mesh = base.with_suffix(".vtu")
    out = run(Meshers.programs / "measure_mesh", Meshers.surface, Meshers.surface, wanted, "--regular", "--only-time",
              "--output", mesh)
    return mesh, last_json(out)["CPU seconds"]


def mesh_3(base, wanted):
    mesh = base.with_suffix(".vtu")
    command = (Meshers.programs / "benchmark_mesh_3", Meshers.surface, Meshers.surface, wanted, "--features", ANGLE,
               "--growth", 0, "--largest", 20, "--facet-distance", 0.1, "--only-time")
    size = last_json(run(*command, "--no-perturb-exude"))["size in region"]
    return mesh, last_json(run(*command, "--size-in-region", repr(size), "--output", mesh))["CPU seconds"]


def searched(make):
    """A mesher of a size instead of a number."""
    def mesher(base, wanted):
        scale = search(lambda s: vertices(make(base, wanted, START * s)[0]), wanted, TRIALS, CLOSE, 1.15)
        return make(base, wanted, START * scale)
    return mesher


def vertices(mesh):
    return measure(mesh, "--only-time")["vertices"]


def tetgen(base, wanted):
    """With the first of some bounds on the radius-edge ratio that can have so few vertices, or the triangles kept."""
    for option in ("q1.4", "q2", "q3", "q9", "Yq1.4"):
        def make(base, wanted, size):
            surface, seconds = Meshers.surface, 0
            if 3 * Meshers.vertices >= wanted:
                surface, seconds = Meshers.coarse(base.name, wanted / 3, "--keep-normals")
            write_smesh(surface, base.with_suffix(".smesh"))
            volume = size ** 3 / 72 ** 0.5  # of a regular tetrahedron, in full: TetGen reads no exponents
            out = run("tetgen", f"-p{option}a{volume:.9f}O7/7", base.with_suffix(".smesh"))
            return base.with_name(base.name + ".1.ele"), seconds + seconds_of_tetgen(out)

        if "Y" in option or vertices(make(base, wanted, 100)[0]) <= wanted:
            return *searched(make)(base, wanted), option


def gmsh(base, wanted):
    """Sharp from a larger angle on, if it cannot parametrize the surface otherwise."""
    for angle in (ANGLE, ANGLE + 10):
        def make(base, wanted, size):
            out = run("/usr/bin/python3", HERE / "mesh_with_gmsh.py", Meshers.surface, Meshers.surface,
                      base.with_suffix(".msh"), size, "--angle", angle)
            return base.with_suffix(".msh"), last_json(out)["CPU seconds"]
        try:
            return *searched(make)(base, wanted), f"{angle} degrees"
        except Failure as e:
            failure = e
    raise failure


ROWS = {"Mixed_mesh_3": own, "TetGen": tetgen, "Mesh_3": mesh_3, "Gmsh": gmsh}


def is_far(line, wanted):
    return abs(line["vertices"] / wanted - 1) > CLOSE


def cells(line):
    row = {"surface": line["surface"], "mesher": line["mesher"] + (f", {line['remark']}" if line.get("remark") else "")}
    if "failure" in line:
        return {**row, "vertices": line["failure"]}
    return {
        **row,
        "vertices": f"{line['vertices']}{' (not reached)' if is_far(line, line['wanted']) else ''}",
        "elements": line["elements"],
        "topology": "yes" if line["same topology"] else "no",
        "invalid": f"{line['elements not proved valid']} + {number(line['self-intersections'], 'd')}",
        "volume, %": f"{100 * (line['volume ratio'] - 1):+.2f}",
        "surface to mesh, %": f"{line['Hausdorff surface to mesh']:.2f}",
        "mesh to surface, %": f"{line['Hausdorff mesh to surface']:.2f}",
        "ARC mean": number(line["ARC mean"], ".3g"),
        "ARC max": number(line["ARC max"], ".3g"),
        "CPU s": number(line["CPU seconds"], ".2f"),
    }


def summary(lines):
    """A row for each mesher: how many are right, and medians of the meshes made."""
    table = []
    for name in dict.fromkeys(line["mesher"] for line in lines):
        all_lines = [line for line in lines if line["mesher"] == name]
        made = [line for line in all_lines if "failure" not in line]
        right = {
            "topology": lambda m: m["same topology"],
            "volume within 5 %": lambda m: abs(m["volume ratio"] - 1) <= 0.05,
            "valid": lambda m: m["elements not proved valid"] == 0 and m["self-intersections"] == 0}
        row = {"mesher": name, "surfaces": len(all_lines), "meshes": len(made),
               "number reached": sum(not is_far(m, m["wanted"]) for m in made)}
        row.update({head: sum(map(holds, made)) for head, holds in right.items()})
        row["these three"] = sum(all(holds(m) for holds in right.values()) for m in made)
        for head, key in (("surface to mesh, %", "Hausdorff surface to mesh"),
                          ("mesh to surface, %", "Hausdorff mesh to surface"), ("ARC max", "ARC max"),
                          ("CPU s", "CPU seconds")):
            values = [float("inf") if m[key] is None else m[key] for m in made]
            row["median of " + head] = f"{statistics.median(values):.3g}" if values else "-"
        table.append(row)
    return table


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    for name in ("programs", "folder", "work"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--vertices", type=int, default=2000)
    parser.add_argument("--surfaces", nargs="+", default=SURFACES)
    parser.add_argument("--meshers", nargs="+", default=[""], help="those whose names contain one of these")
    parser.add_argument("--save", type=pathlib.Path, help="base of the names of the tables")
    o = parser.parse_args()
    o.work.mkdir(parents=True, exist_ok=True)
    Meshers.programs, Meshers.work = o.programs.resolve(), o.work.resolve()
    lines = []
    for surface in o.surfaces:
        Meshers.surface = Meshers.work / f"{surface}.scaled.off"
        Meshers.vertices = prepare(o.folder / f"{surface}.off", Meshers.surface)
        for name, mesher in ROWS.items():
            if not any(part.lower() in name.lower() for part in o.meshers):
                continue
            try:
                mesh, seconds, *remark = mesher(Meshers.work / f"{surface}_{name}", o.vertices)
                line = {**measure(mesh, "--step", 0.25), "CPU seconds": seconds, "remark": "".join(remark)}
            except Failure as failure:
                line = {"failure": str(failure)}
            lines.append({**line, "surface": surface, "mesher": name, "wanted": o.vertices})
            print(*cells(lines[-1]).values(), sep=", ", file=sys.stderr, flush=True)
            if o.save:
                write_results(o.save, [cells(line) for line in lines], lines)
    print(markdown(summary(lines)) + "\n" + markdown([cells(line) for line in lines]), end="")


if __name__ == "__main__":
    main()
