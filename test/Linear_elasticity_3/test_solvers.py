#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Runs examples/solvers: a pushed brain, solved by CalculiX, FreeFem++ and dolfinx, has the displacements that we compute.

Usage: test_solvers.py build_directory source_directory work_directory        the build directory has python/

CalculiX prints seven digits. Exit code 77 (skipped) if there is no ccx or FreeFem++, after the others have been compared;
dolfinx is left out where it is missing: scripts/setup.sh does not install it, because that takes more than a minute.
"""

import os
import pathlib
import shutil
import subprocess
import sys

try:
    import numpy as np
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

BUILD, SOURCE, WORK = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
EXAMPLES = SOURCE / "examples" / "solvers"
sys.path.insert(0, str(SOURCE / "test" / "common"))
from checks import check, exit_code  # noqa: E402


def run(*command):
    """Runs a command in the work folder; what it writes elsewhere, caches, is there as well."""
    environment = {**os.environ, "PYTHONPATH": str(BUILD / "python"), "OMP_NUM_THREADS": "1", "XDG_CACHE_HOME": str(WORK)}
    done = subprocess.run(list(map(str, command)), cwd=WORK, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=environment)
    check(done.returncode == 0, *command, done.stdout[-2000:])


def by_ccx():
    run(sys.executable, EXAMPLES / "brain_ccx.py")
    run("ccx", "pushed_brain")
    rows = (line.split() for line in open(WORK / "pushed_brain.dat"))
    return np.array([[float(x) for x in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()])


def by_freefem():
    run("FreeFem++", "-nw", EXAMPLES / "brain.edp")
    return np.loadtxt(WORK / "freefem.txt")


def by_dolfinx():
    run(sys.executable, EXAMPLES / "brain_dolfinx.py")
    return np.loadtxt(WORK / "dolfinx.txt")


def has_dolfinx():
    return subprocess.run([sys.executable, "-c", "import dolfinx, meshio"], stderr=subprocess.DEVNULL).returncode == 0


def main():
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    run(sys.executable, EXAMPLES / "brain.py")
    ours = np.loadtxt(WORK / "brain_shift.txt")
    check(np.abs(ours).max() > 5, "the brain is not pushed", np.abs(ours).max())
    is_skipped = False
    for name, is_there, solve, most in (("CalculiX", shutil.which("ccx"), by_ccx, 1e-6),
                                        ("FreeFem++", shutil.which("FreeFem++"), by_freefem, 1e-12),
                                        ("dolfinx", has_dolfinx(), by_dolfinx, 1e-12)):
        if not is_there:
            print("there is no", name)
            is_skipped |= name != "dolfinx"
            continue
        theirs = solve()
        check(theirs.shape == ours.shape, name, theirs.shape)
        difference = np.abs(theirs - ours).max() / np.abs(ours).max()
        print(f"{name}: largest difference relative to the largest displacement {difference:.1e}")
        check(difference < most, name, difference)
    failed = exit_code()
    return failed or (77 if is_skipped else 0)


if __name__ == "__main__":
    sys.exit(main())
