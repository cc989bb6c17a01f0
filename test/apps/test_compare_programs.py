#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""compare_programs.py finds what is worse: a program against itself is not, one that does more or less is.

  test_compare_programs.py COMPARE MIXED_MESH_3 WORK
"""

import pathlib
import subprocess
import sys

compare, mesher, work = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
work.mkdir(parents=True, exist_ok=True)


def program(name, line):
    file = work / name
    file.write_text(f"#!/bin/sh\n{line}\n")
    file.chmod(0o755)
    return file


def worse(new):
    """What of the torus is worse than by the mesher itself, and the exit status."""
    process = subprocess.run([sys.executable, compare, mesher, str(new), str(work), "--runs", "1", "--cases", "torus"],
                             capture_output=True, text=True)
    rows = [[cell.strip() for cell in line.split("|")] for line in process.stdout.splitlines()[2:]]
    return {row[2] for row in rows if row[7] == "worse"}, process.returncode


same, _ = worse(mesher)  # but for the time: a busy machine is not a failure
assert same <= {"CPU s"}, same

slow = program("slow", f'"{mesher}" "$@" && "{mesher}" "$@"')
found, status = worse(slow)
assert found == {"CPU s"} and status == 1, (found, status)

found, status = worse(program("off", f'exec "{mesher}" "$@" --no-fit'))
assert status == 1 and {"Hausdorff distance", "vertices off"} <= found, (found, status)

found, status = worse(program("broken", "exit 3"))
assert status == 1 and found == {"status"}, (found, status)

broken = subprocess.run([sys.executable, compare, str(work / "broken"), mesher, str(work), "--runs", "1",
                         "--cases", "torus"], capture_output=True, text=True)
assert broken.returncode == 2 and "OLD" in broken.stderr, broken
