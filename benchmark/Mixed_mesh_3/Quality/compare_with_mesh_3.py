#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes the same input with as many vertices by Mesh_3 and by Mixed_mesh_3; prints a Markdown table.

  compare_with_mesh_3.py DIRECTORY [--vertices 660 2000 10000] [--runs 5] [--save FILE.json]

DIRECTORY holds the programs benchmark_mesh_3 and measure_mesh. Times are CPU seconds of one thread, from
surfaces in memory to a mesh; medians of runs that are processes of their own, the meshers taking turns.
Mesh_3's search for the size that gives the wanted number of vertices is not timed. Lengths are in the
unit of the surface (the bundled brain: millimeters).
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
import results  # noqa: E402

DATA = pathlib.Path(__file__).resolve().parents[3] / "data"
MIXED = "Mixed_mesh_3"
PERTURBED = "Mesh_3, perturb and exude"
REFINED = "Mesh_3"
TIMES = ("CPU seconds", "CPU seconds of refinement", "CPU seconds of perturbation",
         "CPU seconds of exudation")


def column(line):
    """Heads and cells of the table, of what a program printed."""
    kinds = line["kinds"]

    def arc(kind):
        row = kinds.get(kind)
        return f"{row['count']}: {row['ARC mean']:.2f}/{row['ARC max']:.3g}" if row else "-"

    return {
        "mesher": line["name"],
        "wanted": line["wanted vertices"],
        "vertices": line["vertices"],
        "elements": line["elements"],
        "in region": f"{line['share of vertices in region']:.0%}",
        "edge there": f"{line['mean edge in region']:.2f}",
        "Hausdorff": f"{line['Hausdorff']:.2f}",
        "to mesh": f"{line['Hausdorff surface to mesh']:.2f}",
        "to surface": f"{line['Hausdorff mesh to surface']:.2f}",
        "mean distance outside region": f"{line['mean distance outside region']:.2f}",
        "volume": f"{line['volume ratio']:.3f}",
        "ARC mean/max": f"{line['ARC mean']:.2f}/{line['ARC max']:.3g}",
        "tetrahedra": arc("tetrahedra"),
        "pyramids": arc("pyramids"),
        "prisms": arc("prisms"),
        "hexahedra": arc("hexahedra"),
        "dihedral angles": f"{line['smallest dihedral angle']:.0f}-{line['largest dihedral angle']:.0f}",
        "CPU s": f"{line['CPU seconds']:.3f}",
        "min-max": "-".join(f"{t:.3f}" for t in line["CPU seconds min, max"]),
    }


def run(program, files, vertices, *arguments):
    out = subprocess.run([program, *map(str, files), str(vertices), *map(str, arguments)], check=True,
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return json.loads(out.stdout)


def compare(options, vertices):
    """The lines of all meshers for a number of vertices, with the medians of the times."""
    files = options.surface, options.region
    ours, peer = options.directory / "measure_mesh", options.directory / "benchmark_mesh_3"
    found = run(peer, files, vertices, "--no-perturb-exude", *options.mesh_3)
    size = ["--size-in-region", repr(found["size in region"]), *options.mesh_3]
    commands = {MIXED: [ours, *options.mixed_mesh_3], PERTURBED: [peer, *size],
                REFINED: [peer, "--no-perturb-exude", *size]}
    lines = {name: run(program, files, vertices, *arguments) if name != REFINED else found
             for name, (program, *arguments) in commands.items()}
    timed = {name: [] for name in commands}
    for _ in range(options.runs):
        for name, (program, *arguments) in commands.items():
            timed[name].append(run(program, files, vertices, "--only-time", *arguments))
    for name, line in lines.items():
        line["name"] = name
        for key in TIMES:
            if key in line:
                line[key] = statistics.median(t[key] for t in timed[name])
        line["CPU seconds min, max"] = [f(t["CPU seconds"] for t in timed[name]) for f in (min, max)]
    return list(lines.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--surface", default=DATA / "brain.off")
    parser.add_argument("--region", default=DATA / "region.off")
    parser.add_argument("--vertices", type=int, nargs="+", default=[660, 2000, 10000])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--mesh_3", nargs=1, action="extend", default=[], metavar="=OPTION",
                        help="passed to benchmark_mesh_3, for example --mesh_3=--growth=0.3")
    parser.add_argument("--mixed_mesh_3", nargs=1, action="extend", default=[], metavar="=OPTION",
                        help="passed to measure_mesh")
    parser.add_argument("--save", help="also write what was measured as JSON")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error("--runs: expected a positive number")
    rows = []
    for vertices in options.vertices:
        for line in compare(options, vertices):
            cells = column(line)
            if not rows:
                print("| " + " | ".join(cells) + " |")
                print("|---|" + "---:|" * (len(cells) - 1))
            print("| " + " | ".join(map(str, cells.values())) + " |", flush=True)
            rows.append(line)
    if options.save:
        results.save_json(options.save, rows)


if __name__ == "__main__":
    main()
