#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs mixed_mesh_3 or brain_shift, and splits its report: what is the same in each run; times and memory.

  run_program.py REPORT.json TIMES.json [--load LOAD.json] PROGRAM [ARGUMENT...]

LOAD.json has more arguments. Exit status is the program's; what it says goes where it would. What killed runs
have left beside the report is removed.
"""

import json
import os
import pathlib
import subprocess
import sys

from text_files import write_text

VOLATILE = ("stages", "seconds", "ms", "peak memory MiB")


def main():
    report, times, *command = sys.argv[1:]
    if command[0] == "--load":
        command = command[2:] + json.loads(pathlib.Path(command[1]).read_text())["arguments"]
    for left in pathlib.Path(report).parent.glob(".*.tmp*"):
        left.unlink(missing_ok=True)
    whole = str(pathlib.Path(report).parent / f".{os.getpid()}.tmp.json")
    try:
        status = subprocess.run([*command, f"--report={whole}"]).returncode
        if status:
            if status < 0:
                print(f"error: {command[0]}: ended by signal {-status}", file=sys.stderr)
            sys.exit(status if status > 0 else 128 - status)
        content = json.loads(pathlib.Path(whole).read_text())
    except OSError as error:
        sys.exit(f"error: {command[0]}: {error.strerror}")
    finally:
        pathlib.Path(whole).unlink(missing_ok=True)
    content["outputs"] = [report if name == whole else name for name in content["outputs"]]
    pathlib.Path(times).parent.mkdir(parents=True, exist_ok=True)
    write_text(times, json.dumps({k: v for k, v in content.items() if k in VOLATILE}, indent=2) + "\n")
    write_text(report, json.dumps({k: v for k, v in content.items() if k not in VOLATILE}, indent=2) + "\n")


if __name__ == "__main__":
    main()
