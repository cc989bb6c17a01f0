#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the instructions that mixed_mesh_3 takes, which no other work on the machine changes, and compares them.

  count_instructions.py PROGRAM [--cases brain_660 torus ...] [--update]

PROGRAM is a release build. valgrind counts (Debian: valgrind), some fifty times as slowly as the program runs. The
counts are compared with those of benchmark/results/instructions.json: what takes over 3 % more is named, and over
10 % more, or a case that is not there, makes the exit status 1. --update writes the counts of now, for a commit whose
message says why they changed.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

from compare_programs import cases
from results import load_json, save_json

RECORD = pathlib.Path(__file__).resolve().parent / "results" / "instructions.json"
USUAL = ("brain_660", "cube", "torus")
NAMED, TOO_MUCH = 0.03, 0.10


def count(program, budget, arguments, work):
    out = work / "callgrind.out"
    process = subprocess.run(
        [str(a) for a in ("valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", program, *arguments,
                          "--vertices", budget, "--threads", 1, "--quiet", "--output", work / "mesh.vtu")],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if process.returncode != 0:
        sys.exit(f"count_instructions.py: error: exit status {process.returncode}\n{process.stderr[-500:]}")
    return next(int(line.split()[1]) for line in out.read_text().splitlines() if line.startswith("totals:"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--cases", nargs="+", default=USUAL)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    record = load_json(RECORD) if RECORD.exists() else {}
    is_too_much = False
    print("| case | instructions, millions: recorded | now | change | |\n|---|--:|--:|--:|---|")
    with tempfile.TemporaryDirectory() as folder:
        every = cases(pathlib.Path(folder))
        for name in options.cases:
            now, old = count(options.program.resolve(), *every[name], pathlib.Path(folder)), record.get(name)
            change = now / old - 1 if old else float("inf")
            word = "not recorded" if not old else "too much" if change > TOO_MUCH else "more" if change > NAMED else ""
            is_too_much = is_too_much or change > TOO_MUCH
            cells = (name, f"{old / 1e6:.0f}" if old else "", f"{now / 1e6:.0f}", f"{change:+.1%}" if old else "", word)
            print("| " + " | ".join(cells) + " |", flush=True)
            record[name] = now
    if options.update:
        save_json(RECORD, dict(sorted(record.items())))
    elif is_too_much:
        sys.exit("count_instructions.py: error: over 10 % more than recorded: say why, and run it with --update")


if __name__ == "__main__":
    main()
