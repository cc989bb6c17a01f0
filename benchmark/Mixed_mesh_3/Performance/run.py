#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the benchmark for growing budgets and prints medians as a table.

  run.py BENCHMARK [--vertices 660 10000 ...] [--runs 5] [--path relax] [--threads 1 2] [--save BASE]
  run.py --compare OLD.json NEW.json      the ratios of two saved runs, for example of two commits

BENCHMARK is the program benchmark_make_mixed_mesh_3; each run is a process of its own. Times are CPU
seconds of all threads, and wall seconds, from surfaces in memory to a checked mesh, without files; large budgets, which take minutes, are run once.
BASE.md, BASE.csv and BASE.json get the table.
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
ONCE = 300000
STAGES = ["AABB trees", "octree", "transitions", "boundary", "assembly", "optimization", "Algorithm 1", "checks"]


def measure(program, surface, region, vertices, runs, path, threads):
    """The medians over some runs, after one that does not count; of what takes minutes, one run."""
    lines = []
    for _ in range(runs + 1 if vertices <= ONCE else 1):
        out = subprocess.run([program, surface, region, str(vertices), str(threads), path], check=True, capture_output=True)
        lines.append(json.loads(out.stdout))
    row = {**lines[-1], "threads": threads}
    counted = lines[1:] or lines
    for key in ("seconds", "CPU seconds", "vertices per CPU second", "bytes per vertex", "peak MiB"):
        row[key] = statistics.median(line[key] for line in counted)
    row["CPU seconds min, max"] = [f(line["CPU seconds"] for line in counted) for f in (min, max)]
    row["stages"] = {s: statistics.median(line["stages"].get(s, 0) for line in counted) for s in STAGES}
    return row


def cells(r):
    low, high = r["CPU seconds min, max"]
    return {"budget": r["budget"], "vertices": r["vertices"], "elements": r["elements"], "threads": r["threads"],
            "CPU s": f"{r['CPU seconds']:.3f}", "min-max": f"{low:.3f}-{high:.3f}", "wall s": f"{r['seconds']:.3f}",
            "vertices/s": f"{r['vertices per CPU second']:.0f}", "bytes/vertex": f"{r['bytes per vertex']:.0f}",
            "ARC mean": f"{r['ARC mean']:.2f}", "ARC max": f"{r['ARC max']:.2f}",
            **{s: f"{r['stages'][s]:.4f}" for s in STAGES}}


def compare(old, new):
    print("| budget | CPU s old | CPU s new | new / old | memory new / old |\n|---:|---:|---:|---:|---:|")
    for a, b in zip(*(results.load_json(file)["rows"] for file in (old, new))):
        print(f"| {a['budget']} | {a['CPU seconds']:.3f} | {b['CPU seconds']:.3f} | "
              f"{b['CPU seconds'] / a['CPU seconds']:.2f} | {b['peak MiB'] / a['peak MiB']:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("--surface", default=DATA / "brain.off")
    parser.add_argument("--region", default=DATA / "region.off")
    parser.add_argument("--vertices", type=int, nargs="+",
                        default=[660, 2000, 10000, 50000, 200000, 1000000, 5000000])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--path", choices=["optimize", "relax", "none"], default="optimize",
                        help="how the boundary gets onto the surface: optimization, Algorithm 1, not at all")
    parser.add_argument("--threads", type=int, nargs="+", default=[1])
    parser.add_argument("--save", type=pathlib.Path, help="base of the names of the tables")
    parser.add_argument("--compare", nargs=2, metavar=("OLD.json", "NEW.json"))
    options = parser.parse_args()
    if options.compare:
        compare(*options.compare)
        return
    if not options.program:
        parser.error("BENCHMARK is missing")
    rows = []
    for n in options.vertices:
        for threads in options.threads:
            rows.append(measure(options.program, options.surface, options.region, n, options.runs, options.path,
                                threads))
            if options.save:
                results.save(options.save, [cells(r) for r in rows], rows)
    print(results.markdown([cells(r) for r in rows]), end="")


if __name__ == "__main__":
    main()
