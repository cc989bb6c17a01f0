#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Debian packages hold what they should, each file once, and what they hold runs; manual pages have all options.

  test_packages.py CPACK BUILD DATA WORK PACKAGE...

PACKAGE are the names of the packages. `scripts/package.sh --try` installs them in a bare Debian.
"""

import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys

cpack, build, data, work = sys.argv[1], *map(pathlib.Path, sys.argv[2:5])
names = set(sys.argv[5:])
LIBRARIES = {"mixed-mesh-3": "libgmp10", "python3-mixed-mesh-3": "python3-numpy", "libmixed-mesh-3-dev": "libcgal-dev"}


def run(*command, **options):
    done = subprocess.run([*map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                          **options)
    assert done.returncode == 0, f"{command}\n{done.stdout}"
    return done.stdout


has_pages = shutil.which("man") and "HELP2MAN_PROGRAM:FILEPATH=/" in (build / "CMakeCache.txt").read_text()
for tool in ("dpkg-shlibdeps", "file"):
    if not shutil.which(tool):
        print(f"skipped: there is no {tool}")
        sys.exit(77)
shutil.rmtree(work, ignore_errors=True)
root = work / "root"
root.mkdir(parents=True)
run(cpack, "-G", "DEB", "-B", work, cwd=build)
packages = {run("dpkg-deb", "--field", file, "Package").strip(): file for file in sorted(work.glob("*.deb"))}
assert packages.keys() == names, packages.keys()
owner = {}
for name, file in packages.items():
    depends = run("dpkg-deb", "--field", file, "Depends")
    assert LIBRARIES.get(name, "") in depends, (name, depends)
    for line in run("dpkg-deb", "--contents", file).splitlines():
        path = line.split()[5]
        if path.endswith("/"):
            assert line.startswith("drwxr-xr-x"), line
            continue
        assert path.startswith("./usr/") and path not in owner, (name, path, owner.get(path))
        owner[path] = name
    for part in ("copyright", "changelog.gz"):
        assert owner.get(f"./usr/share/doc/{name}/{part}") == name, (name, part)
    run("dpkg-deb", "--extract", file, root)
if shutil.which("lintian"):
    told = run("lintian", "--fail-on", "error", "--allow-root", *packages.values())
    assert "no-manual-page" not in told or not has_pages, told

for program in sorted((root / "usr/bin").iterdir()) if has_pages else []:
    page = root / f"usr/share/man/man1/{program.name}.1.gz"
    if page.is_symlink():  # of a program that has the options of another one
        assert page.resolve().exists(), page
        continue
    options = re.findall(r"^  (?:-\w,)?(--[\w-]+)", run(program, "--help"), re.MULTILINE)
    shown = subprocess.run(["man", "--warnings", "-l", page], capture_output=True, text=True, check=True,
                           env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "100"})
    assert not shown.stderr, shown.stderr
    assert re.findall(r"^ {7}(?:-\w,)?(--[\w-]+)", shown.stdout, re.MULTILINE) == options, shown.stdout
    assert ".HP" not in gzip.decompress(page.read_bytes()).decode(), "help2man takes a description for a part of its option"

assert owner["./usr/bin/mixed_mesh_3"] == "mixed-mesh-3"
assert owner["./usr/include/CGAL/make_mixed_mesh_3.h"] == "libmixed-mesh-3-dev"
run(root / "usr/bin/mixed_mesh_3", data / "brain.off", "--vertices", "300", "--output", work / "brain.vtu")
assert (work / "brain.vtu").stat().st_size > 10000
if "python3-mixed-mesh-3" in names:
    folder = root / "usr/lib/python3/dist-packages"
    told = run("/usr/bin/python3", "-c", "import mixed_mesh_3 as m; print(m.__file__, *m.example_data())",
               env={"PYTHONPATH": str(folder), "PATH": "/usr/bin:/bin"})
    assert told.startswith(str(folder)) and "brain" in told, told
print(f"{len(packages)} packages with {len(owner)} files")
