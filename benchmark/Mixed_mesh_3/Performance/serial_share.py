#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the share of the CPU time that one thread has to work alone, and predicts the time of several threads.

  serial_share.py [--vertices 10000 50000 200000] [--runs 3] [--build DIRECTORY] [--save FILE.json]

The program mixed_mesh_3 is built with counted/.../parallel_for.h in place of the parallel loop: it runs what
--threads 2 runs, but in one thread, and counts CPU seconds in and outside of the loops. So other work on the machine
hardly matters. A loop with n threads is assumed to take the n-th part, or as long as its longest block; starting
threads, and their contention for memory, is not counted. The whole process counts: reading, mesh, checks, report.
"""

import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
import results  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
LOOP = pathlib.Path(__file__).resolve().parent / "counted/CGAL/Mixed_mesh_3/internal/base/parallel_for.h"


def build(directory):
    subprocess.run(["cmake", "--preset", "release", "-B", directory,
                    f"-DCMAKE_CXX_FLAGS=-include {LOOP}"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", directory, "--target", "mixed_mesh_3"], check=True, stdout=subprocess.DEVNULL)
    return pathlib.Path(directory) / "bin/mixed_mesh_3"


def counted(program, vertices):
    """CPU seconds of the process and of its loops, and what the loops would take with 2 and 16 threads."""
    with tempfile.TemporaryDirectory() as folder:
        out = subprocess.run([program, ROOT / "data/brain.off", "--region", ROOT / "data/region.off", "--vertices",
                              str(vertices), "--threads", "2", "--report", f"{folder}/report.json", "--quiet"],
                             check=True, capture_output=True, text=True)
    line = next(text for text in out.stderr.splitlines() if text.startswith("counted:"))
    return [float(word) for word in line.split()[1:]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--vertices", type=int, nargs="+", default=[10000, 50000, 200000])
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--build", default=str(ROOT / "build/counted"))
    parser.add_argument("--save", type=pathlib.Path)
    options = parser.parse_args()
    program = build(options.build)
    rows = []
    for vertices in options.vertices:
        whole, loops, with_2, with_16 = (statistics.median(column) for column in
                                         zip(*(counted(program, vertices) for _ in range(options.runs))))
        rows.append({"N": f"{vertices:,}", "CPU s": f"{whole:.2f}", "serial share": f"{100 * (1 - loops / whole):.0f} %",
                     "2 threads, at most": f"{whole / (whole - loops + with_2):.2f}",
                     "16 threads, at most": f"{whole / (whole - loops + with_16):.1f}"})
    print(results.markdown(rows), end="")
    if options.save:
        results.save_json(options.save, {"rows": rows})


if __name__ == "__main__":
    main()
