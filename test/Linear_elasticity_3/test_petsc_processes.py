#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a program in two processes, by mpirun; its last argument says so. Skipped without mpirun.

  test_petsc_processes.py PROGRAM
"""

import os
import shutil
import subprocess
import sys


def main():
    if not shutil.which("mpirun"):
        print("SKIPPED: there is no mpirun: two processes are not tested")
        return 77
    as_root = ["--allow-run-as-root"] if os.getuid() == 0 else []
    command = ["mpirun", "--oversubscribe", *as_root, "-n", "2", sys.argv[1], "2"]
    return subprocess.run(command, timeout=300).returncode


if __name__ == "__main__":
    sys.exit(main())
