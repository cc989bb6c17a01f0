#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the benchmark for growing budgets and prints medians as a table.

  run.py BENCHMARK [--vertices 660 10000 ...] [--runs 5] [--path relax] [--save FILE.json]
  run.py --compare OLD.json NEW.json      the ratios of two saved runs, for example of two commits

BENCHMARK is the program benchmark_make_mixed_mesh_3; each run is a process of its own. Times are CPU
seconds of one thread, from surfaces in memory to a checked mesh, without files.
"""

import argparse
import json
import pathlib
import statistics
import subprocess

DATA = pathlib.Path(__file__).resolve().parents[3] / "data"
STAGES = ["AABB trees", "octree", "transitions", "boundary", "assembly", "optimization", "Algorithm 1", "checks"]


def measure(program, surface, region, vertices, runs, path):
    """The medians over some runs, after one that does not count."""
    lines = []
    for _ in range(runs + 1):
        out = subprocess.run([program, surface, region, str(vertices), "1", path], check=True, capture_output=True)
        lines.append(json.loads(out.stdout))
    row = dict(lines[-1])
    for key in ("seconds", "CPU seconds", "vertices per CPU second", "bytes per vertex", "peak MiB"):
        row[key] = statistics.median(line[key] for line in lines[1:])
    row["CPU seconds min, max"] = [f(line["CPU seconds"] for line in lines[1:]) for f in (min, max)]
    row["stages"] = {s: statistics.median(line["stages"].get(s, 0) for line in lines[1:]) for s in STAGES}
    return row


def print_table(rows):
    head = ["budget", "vertices", "elements", "CPU s", "min-max", "vertices/s", "bytes/vertex", "ARC mean",
            "ARC max", *STAGES]
    print("| " + " | ".join(head) + " |")
    print("|" + "---:|" * len(head))
    for r in rows:
        low, high = r["CPU seconds min, max"]
        cells = [r["budget"], r["vertices"], r["elements"], f"{r['CPU seconds']:.3f}",
                 f"{low:.3f}-{high:.3f}", f"{r['vertices per CPU second']:.0f}",
                 f"{r['bytes per vertex']:.0f}", f"{r['ARC mean']:.2f}", f"{r['ARC max']:.2f}"]
        cells += [f"{r['stages'][s]:.4f}" for s in STAGES]
        print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def compare(old, new):
    print("| budget | CPU s old | CPU s new | new / old | memory new / old |\n|---:|---:|---:|---:|---:|")
    for a, b in zip(json.load(open(old)), json.load(open(new))):
        print(f"| {a['budget']} | {a['CPU seconds']:.3f} | {b['CPU seconds']:.3f} | "
              f"{b['CPU seconds'] / a['CPU seconds']:.2f} | {b['peak MiB'] / a['peak MiB']:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("--surface", default=DATA / "brain.off")
    parser.add_argument("--region", default=DATA / "region.off")
    parser.add_argument("--vertices", type=int, nargs="+",
                        default=[660, 2000, 10000, 50000, 200000, 500000, 2000000])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--path", choices=["optimize", "relax", "none"], default="optimize",
                        help="how the boundary gets onto the surface: optimization, Algorithm 1, not at all")
    parser.add_argument("--save", help="also write the medians as JSON")
    parser.add_argument("--compare", nargs=2, metavar=("OLD.json", "NEW.json"))
    options = parser.parse_args()
    if options.compare:
        compare(*options.compare)
        return
    if not options.program:
        parser.error("BENCHMARK is missing")
    rows = [measure(options.program, options.surface, options.region, n, options.runs, options.path)
            for n in options.vertices]
    print_table(rows)
    if options.save:
        pathlib.Path(options.save).write_text(json.dumps(rows, indent=2) + "\n")


if __name__ == "__main__":
    main()
