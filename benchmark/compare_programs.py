#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says what one build of mixed_mesh_3 does worse than another, on a short set; used by scripts/compare_commits.sh.

  compare_programs.py OLD NEW WORK [--runs 5] [--cases brain_660 cube ...]

OLD and NEW are programs, run by turns, OLD twice as often: what differs from OLD to OLD is the noise of times (user
CPU seconds). Meshes have none, the same input gives the same bytes; but any change of the method moves them a
little. What moves without one is measured with OLD and budgets that are 1, 2 and 3 % smaller.

Exit status: 1 if something is worse by more than the noise, 2 if OLD does not mesh a case.
"""

import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys

DATA = pathlib.Path(__file__).resolve().parents[1] / "data"
SMALLER = (0.99, 0.98, 0.97)
# Less is worth no word, and so short a set may not see it: of a time, and of another value.
LEAST_OF_TIME, LEAST = 0.05, 0.005
SHORTEST = 0.02  # seconds: the resolution of CPU time, and what starting a program takes


class Program:
    """Old and new are two, even of one file."""

    def __init__(self, file):
        self.file = file

    def __str__(self):
        return str(self.file)


def write_off(file, points, triangles):
    lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
    lines += [" ".join(map(repr, p)) for p in points] + [" ".join(map(str, (3, *t))) for t in triangles]
    file.write_text("\n".join(lines) + "\n")
    return file


def cube(file):
    points = [(float(x), float(y), float(z)) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    squares = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return write_off(file, points, [t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))])


def torus(file, n=64, m=32):
    def point(i, j):
        u, v = 2 * math.pi * i / n, 2 * math.pi * j / m
        r = 2 + 0.7 * math.cos(v)
        return r * math.cos(u), r * math.sin(u), 0.7 * math.sin(v)
    at = [[i % n * m + j % m for j in range(m + 1)] for i in range(n + 1)]
    return write_off(file, [point(i, j) for i in range(n) for j in range(m)],
                     [t for i in range(n) for j in range(m)
                      for t in ((at[i][j], at[i + 1][j], at[i + 1][j + 1]), (at[i][j], at[i + 1][j + 1], at[i][j + 1]))])


def cases(work):
    """Name: budget, arguments."""
    brain, region = DATA / "brain.off", ("--region", DATA / "region.off")
    return {
        **{f"brain_{n}": (n, (brain, *region)) for n in (660, 2000, 10000)},
        "cube": (1000, (cube(work / "cube.off"),)),
        "torus": (2000, (torus(work / "torus.off"),)),
        "tumor": (2000, (brain, *region, "--subdomain", f"tumor={DATA / 'tumour.off'}")),
    }


def run(program, budget, arguments, report):
    """What is compared; larger is worse, but for the status."""
    report.unlink(missing_ok=True)
    process = subprocess.Popen([str(a) for a in (program, *arguments, "--vertices", budget, "--quiet", "--output",
                                                 report.with_suffix(".vtu"), "--report", report)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if not report.exists():
        return {"status": f"no mesh, exit status {process.returncode}"}
    r = json.loads(report.read_text())
    return {"status": f"{r['status']}, exit status {process.returncode}", "CPU s": usage.ru_utime,
            "unused share of budget": 1 - r["mesh"]["vertices"] / budget,
            "ARC mean": r["quality"]["after"]["all"]["ARC mean"],
            "ARC max": r["quality"]["after"]["all"]["ARC max"],
            "Hausdorff distance": r["surface"]["Hausdorff distance"]["distance"],
            "error of volume": abs(1 - r["surface"]["ratio of volumes"]),
            "vertices off": r["surface"]["boundary vertices not on surface"]}


def scale_of(key, old):
    """What a change is a share of: of the old value; shares are compared as they are, vertices by number."""
    return 1 if key in ("unused share of budget", "error of volume") else max(old, 1) if key == "vertices off" else old


def compare(old, new, work, runs, name, budget, arguments):
    """Rows of key, old, new, change, noise, whether worse."""
    times = {old: [], new: []}
    first = {}
    for _ in range(runs):
        for program in (old, new, old):
            line = run(program, budget, arguments, work / f"{name}_{'old' if program is old else 'new'}.json")
            if "CPU s" not in line and program is old:
                print(f"{name}: OLD: {line['status']}", file=sys.stderr)
                sys.exit(2)
            first.setdefault(program, line)
            times[program].append(line.get("CPU s"))
    a, b = first[old], first[new]
    if a["status"] != b["status"]:
        yield "status", a["status"], b["status"], "", "", not b["status"].startswith("success")
    if "CPU s" not in b:
        return
    middle = statistics.median(times[old])
    noise = max(abs(t - middle) for t in times[old]) / middle
    b["CPU s"], a["CPU s"] = statistics.median(times[new]), middle
    moved = [run(old, round(share * budget), arguments, work / f"{name}_noise.json") for share in SMALLER]
    for key in list(b)[1:]:
        scale = scale_of(key, a[key])
        change = (b[key] - a[key]) / scale if scale else float(b[key] > a[key])
        if key == "CPU s":
            allowed = max(noise, LEAST_OF_TIME, SHORTEST / middle)
        else:
            allowed = max([LEAST] + [abs(m[key] - a[key]) / scale for m in moved if key in m and scale])
        yield key, f"{a[key]:.4g}", f"{b[key]:.4g}", f"{change:+.1%}", f"{allowed:.1%}", change > allowed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--cases", nargs="+")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    every = cases(options.work)
    unknown = [c for c in options.cases or () if c not in every]
    if options.runs < 1 or unknown:
        parser.error(f"no such case: {', '.join(unknown)}" if unknown else "--runs: expected a positive number")
    print("| case | | old | new | change | noise | |\n|---|---|--:|--:|--:|--:|---|")
    is_worse = False
    old, new = Program(options.old.resolve()), Program(options.new.resolve())
    for name in options.cases or every:
        for *row, worse in compare(old, new, options.work, options.runs, name, *every[name]):
            is_worse = is_worse or worse
            print("| " + " | ".join([name, *row, "worse" if worse else ""]) + " |", flush=True)
    sys.exit(int(is_worse))


if __name__ == "__main__":
    main()
