#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes the same input with as many vertices by all meshers at hand, and measures what they make.

  compare_with_peers.py PROGRAMS WORK [--vertices 660 2000 ...] [--meshers tetgen gmsh ...] [--runs 5]
                        [--save BASE] [--mixed-octree PROGRAM]

PROGRAMS holds measure_mesh, benchmark_mesh_3 and coarsen_surface; tetgen must be on the path, and the Python
modules gmsh and netgen be installed (Debian: tetgen, python3-gmsh, python3-netgen). WORK gets the meshes.
BASE.md, BASE.csv and BASE.json get the table.

All are asked for the same sizes: h in the region, growing by 0.4 of the distance from it, up to a largest
one; both are scaled, by a search that is not timed, to hit the number of vertices. TetGen keeps the surface that
it is given: it gets a coarsened one, with a third of the vertices, and coarsening is in its time. Gmsh and
Netgen mesh the surface anew; Netgen takes some of its edges for features, and does not get below some 1,100
vertices for the bundled brain; of a coarsened one, it takes even more for features, and may not end. Mesh_3 and ours are measured as in
compare_with_mesh_3.py. PROGRAM is a build of MixedOcTree, the public successor of the paper's
(https://github.com/clobosmesher/MixedOcTree); it has levels instead of sizes.

Times are CPU seconds from a surface in memory to a mesh, medians of some runs, one run of what takes longer than
5 s; those of TetGen and MixedOcTree are what they print, without output; TetGen's with the reading of its background mesh. A row that fails says so, and the rest goes on.
"""

import argparse
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))
from results import markdown, save as write_results  # noqa: E402

DATA = HERE.parents[2] / "data"
GROWTH = 0.4
TIMEOUT = 300
LONG = 5


class Failure(Exception):
    pass


def run(*command):
    """What a program prints."""
    try:
        process = subprocess.run([*map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                 timeout=TIMEOUT)
    except FileNotFoundError:
        raise Failure(f"{command[0]} is not installed") from None
    except subprocess.TimeoutExpired:
        raise Failure(f"not finished after {TIMEOUT} s") from None
    if process.returncode != 0:
        last = (process.stderr.strip() or process.stdout.strip() or "no message").splitlines()[-1]
        raise Failure(f"{pathlib.Path(str(command[0])).name}: "
                      + (last[:120] if process.returncode > 0 else f"ended by signal {-process.returncode}"))
    return process.stdout


def last_json(text):
    return json.loads(text.strip().splitlines()[-1])


class Meshers:
    """A function for each: from sizes to a mesh file and CPU seconds; or straight to a line of measures."""
    programs = work = surface = region = mixed_octree = None

    @classmethod
    def coarse(cls, name, vertices, *options):
        """The surface with so many vertices, and the seconds that this takes."""
        file = cls.work / (name + ".off")
        out = run(cls.programs / "coarsen_surface", cls.surface, file, max(100, round(vertices)), *options)
        return file, last_json(out)["CPU seconds"]

    @classmethod
    def tetgen(cls, vertices, size, largest):
        from sizes import Sizes
        base = cls.work / f"tetgen_{vertices}"
        poly = base.with_suffix(".smesh")
        coarse, seconds = cls.coarse(base.name, vertices / 3)
        write_smesh(coarse, poly)
        sizes = Sizes(cls.surface, cls.region)
        write_background(base, sizes.points, sizes.tetrahedra(), sizes.at_points(size, GROWTH, largest))
        out = run("tetgen", "-pq1.4mO7/7", poly)
        return base.with_name(base.name + ".1.ele"), seconds + seconds_of_tetgen(out)

    @classmethod
    def gmsh(cls, vertices, size, largest, *options):
        mesh = cls.work / f"gmsh{''.join(options)}_{vertices}.msh"
        out = run("/usr/bin/python3", HERE / "mesh_with_gmsh.py", cls.surface, cls.region, mesh, size,
                  "--growth", GROWTH, "--largest", largest, *options)
        return mesh, last_json(out)["CPU seconds"]

    @classmethod
    def gmsh_hxt(cls, vertices, size, largest):
        return cls.gmsh(vertices, size, largest, "--hxt")

    @classmethod
    def netgen(cls, vertices, size, largest):
        mesh = cls.work / f"netgen_{vertices}.vol"
        out = run("/usr/bin/python3", HERE / "mesh_with_netgen.py", cls.surface, cls.region, mesh, size,
                  "--growth", GROWTH, "--largest", largest)
        return mesh, last_json(out)["CPU seconds"]


def seconds_of_tetgen(out):
    """From what it prints, without output."""
    times = dict(re.findall(r"^(.*) seconds:\s+(\S+)$", out, re.MULTILINE))
    return sum(float(t) for name, t in times.items() if not name.startswith(("Output", "Total")))


def write_smesh(off, smesh):
    """The input of TetGen: points and triangles."""
    from sizes import read_off
    points, triangles = read_off(off)
    with open(smesh, "w") as out:
        out.write(f"{len(points)} 3 0 0\n")
        out.writelines("{} {!r} {!r} {!r}\n".format(i, *map(float, p)) for i, p in enumerate(points))
        out.write(f"{len(triangles)} 0\n")
        out.writelines("3 {} {} {}\n".format(*t) for t in triangles)
        out.write("0\n0\n")


def write_background(base, points, tetrahedra, sizes):
    """The sizes for TetGen: at the vertices of a mesh."""
    for extension, head, rows in ((".b.node", "{} 3 0 0", points), (".b.ele", "{} 4 0", tetrahedra)):
        with open(str(base) + extension, "w") as out:
            out.write(head.format(len(rows)) + "\n")
            out.writelines(f"{i} " + " ".join(map(str, row)) + "\n" for i, row in enumerate(rows.tolist()))
    with open(str(base) + ".b.mtr", "w") as out:
        out.write(f"{len(sizes)} 1\n" + "".join(f"{h}\n" for h in sizes.tolist()))


def measure(mesh, *options):
    return last_json(run(Meshers.programs / "measure_mesh", Meshers.surface, Meshers.region, "--mesh", mesh, *options))


def repeated(make, runs, seconds=lambda made: made):
    """What some runs make, or the first one if it takes long; and their median time."""
    made = [make()]
    while len(made) < runs and seconds(made[0]) <= LONG:
        made.append(make())
    return made, statistics.median(map(seconds, made))


def search(trial, wanted, trials=10, close=0.01, least=1):
    """The scale of the sizes that gives about so many vertices: the number goes with its inverse cube, about.
    Until there are too many and too few vertices, steps are of a factor `least` at least."""
    scale, best = 1., (math.inf, None)
    low, high = 0., math.inf  # scales with too many and too few vertices
    for _ in range(trials):
        n = trial(scale)
        best = min(best, (abs(math.log(n / wanted)), scale))
        if best[0] < close:
            break
        if n > wanted:
            low = max(low, scale)
        else:
            high = min(high, scale)
        scale *= (n / wanted) ** 0.45
        if high == math.inf:
            scale = max(scale, least * low)
        elif low == 0:
            scale = min(scale, high / least)
        if not low < scale < high:
            scale = (low + high) / 2 if high < math.inf else 1.3 * low
    return best[1]


def peer(mesher):
    def row(wanted, runs):
        start = {"size": 6.5 * (660 / wanted) ** (1 / 2), "largest": 24 * (660 / wanted) ** (1 / 5)}

        def trial(scale):
            mesh, _ = mesher(wanted, scale * start["size"], scale * start["largest"])
            return measure(mesh, "--only-time")["vertices"]

        scale = search(trial, wanted)
        size, largest = scale * start["size"], scale * start["largest"]
        made, seconds = repeated(lambda: mesher(wanted, size, largest), runs, lambda one: one[1])
        return {**measure(made[-1][0]), "CPU seconds": seconds, "size in region": size, "largest": largest}
    return row


def own(*options):
    def row(wanted, runs):
        command = (Meshers.programs / "measure_mesh", Meshers.surface, Meshers.region, wanted, *options)
        _, seconds = repeated(lambda: last_json(run(*command, "--only-time"))["CPU seconds"], runs)
        return {**last_json(run(*command)), "CPU seconds": seconds}
    return row


def mesh_3(*options):
    def row(wanted, runs):
        command = (Meshers.programs / "benchmark_mesh_3", Meshers.surface, Meshers.region, wanted)
        size = last_json(run(*command, "--no-perturb-exude"))["size in region"]
        command += ("--size-in-region", repr(size), *options)
        _, seconds = repeated(lambda: last_json(run(*command, "--only-time"))["CPU seconds"], runs)
        return {**last_json(run(*command)), "CPU seconds": seconds}
    return row


def mixed_octree(wanted, runs):
    """Of all levels, at the surface and in the region, those with about so many vertices."""
    if Meshers.mixed_octree is None:
        raise Failure("no build given, see --mixed-octree")
    region = Meshers.work / "region.mdl"
    write_mdl(Meshers.region, region)

    def make(at_surface, in_region):
        base = Meshers.work / f"mixed_octree_{at_surface}_{in_region}"
        out = run(Meshers.mixed_octree, "-o", Meshers.surface, "-s", at_surface, "-r", region, in_region,
                  "-v", "-u", base)
        seconds = float(re.search(r"Generation done.* in (\d+)", out)[1]) / 1000
        return vtk_to_vtu(base), seconds

    best = None
    for levels in ((s, r) for s in range(2, 6) for r in range(s + 1, s + 5)):
        n = measure(make(*levels)[0], "--only-time")["vertices"]
        if best is None or abs(math.log(n / wanted)) < abs(math.log(best[0] / wanted)):
            best = n, levels
    made, seconds = repeated(lambda: make(*best[1]), runs, lambda one: one[1])
    return {**measure(made[-1][0]), "CPU seconds": seconds,
            "levels at the surface, in the region": best[1]}


def write_mdl(off, mdl):
    """What MixedOcTree reads regions from."""
    from sizes import read_off
    points, triangles = read_off(off)
    with open(mdl, "w") as out:
        out.write(f"[Nodes, ARRAY1<POINT3D>]\n{len(points)}\n")
        out.writelines("{!r} {!r} {!r}\n".format(*map(float, p)) for p in points)
        out.write(f"[Faces, ARRAY1<STRING>]\n{len(triangles)}\n")
        out.writelines("{} {} {} 0 0 0\n".format(*t) for t in triangles)


def vtk_to_vtu(base):
    import vtk
    reader, writer = vtk.vtkUnstructuredGridReader(), vtk.vtkXMLUnstructuredGridWriter()
    reader.SetFileName(str(base) + ".vtk")
    reader.Update()
    writer.SetFileName(str(base) + ".vtu")
    writer.SetInputData(reader.GetOutput())
    writer.SetCompressorTypeToNone()
    writer.Write()
    return str(base) + ".vtu"


ROWS = {
    "Mixed_mesh_3": own(),
    "Mixed_mesh_3, regular octree": own("--regular"),
    "Mixed_mesh_3, as the paper": own("--paper"),
    "Mesh_3": mesh_3("--no-perturb-exude"),
    "Mesh_3, perturb and exude": mesh_3(),
    "TetGen": peer(Meshers.tetgen),
    "Gmsh, Delaunay": peer(Meshers.gmsh),
    "Gmsh, HXT": peer(Meshers.gmsh_hxt),
    "Netgen": peer(Meshers.netgen),
    "MixedOcTree": mixed_octree,
}


def number(value, form):
    """JSON has no infinity: the ARC of an inverted element is null."""
    return "-" if value is None else format(value, form)


def cells(name, wanted, line):
    if "failure" in line:
        return {"mesher": name, "wanted": wanted, "vertices": line["failure"]}
    return {
        "mesher": name,
        "wanted": wanted,
        "vertices": line["vertices"],
        "elements": line["elements"],
        "not proved valid": line["elements not proved valid"],
        "ARC mean": number(line["ARC mean"], ".2f"),
        "ARC max": number(line["ARC max"], ".3g"),
        "above 7": f"{1 - line['ARC share at most 7']:.2%}",
        "dihedral angles": f"{line['smallest dihedral angle']:.0f} to {line['largest dihedral angle']:.0f}",
        "surface to mesh": f"{line['Hausdorff surface to mesh']:.2f}",
        "mesh to surface": f"{line['Hausdorff mesh to surface']:.2f}",
        "volume": f"{line['volume ratio'] - 1:+.1%}",
        "in region": f"{line['share of vertices in region']:.0%}",
        "edge there": f"{line['mean edge in region']:.2f}",
        "nonzeros": line["nonzeros"],
        "factorization, CPU s": number(line.get("CPU seconds of factorization"), ".3f"),
        "meshing, CPU s": number(line["CPU seconds"], ".2f"),
    }


def save(results, base):
    write_results(base, [cells(r["mesher"], r["wanted"], r) for r in results], results)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--surface", default=DATA / "brain.off", type=pathlib.Path)
    parser.add_argument("--region", default=DATA / "region.off", type=pathlib.Path)
    parser.add_argument("--vertices", type=int, nargs="+", default=[660, 2000, 10000, 50000, 200000])
    parser.add_argument("--meshers", nargs="+", default=[""], help="those whose names contain one of these")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--mixed-octree", help="a program of MixedOcTree")
    parser.add_argument("--save", type=pathlib.Path, help="base of the names of the tables")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error("--runs: expected a positive number")
    sys.path.insert(0, str(HERE))
    options.work.mkdir(parents=True, exist_ok=True)
    Meshers.programs, Meshers.work = options.programs.resolve(), options.work.resolve()
    Meshers.surface, Meshers.region = options.surface.resolve(), options.region.resolve()
    Meshers.mixed_octree = options.mixed_octree
    results = []
    for wanted in options.vertices:
        for name, row in ROWS.items():
            if not any(part.lower() in name.lower() for part in options.meshers):
                continue
            try:
                line = row(wanted, options.runs)
            except Failure as failure:
                line = {"failure": str(failure)}
            results.append({**line, "mesher": name, "wanted": wanted})
            print(results[-1].get("failure") or
                  f"{name}, {wanted}: {line['vertices']} vertices, {line['CPU seconds']:.2f} s",
                  file=sys.stderr, flush=True)
            if options.save:
                save(results, options.save)
    print(markdown([cells(r["mesher"], r["wanted"], r) for r in results]), end="")


if __name__ == "__main__":
    main()
