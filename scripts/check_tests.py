#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that a test in C++ includes each header of internal/meshing and internal/fitting itself: a header that tests
reach only through other headers has no test that is about it.

A header of definitions, NAME_impl.h, has the test of NAME.h. WITHOUT_TEST lists the headers that have no test yet; the list may
only get shorter: a header that is tested has to leave it. Exits with status 1 and a line for each violation.

  scripts/check_tests.py [ROOT]
"""

import pathlib
import sys

from check_layers import own_includes, report

INTERNAL = "Mixed_mesh_3/internal/"
FOLDERS = ("meshing", "fitting")
# The headers without a test, without the folder internal and their endings. usual_models has nothing but declarations of
# what the library instantiates, which the linker checks.
WITHOUT_TEST = """
    meshing/usual_models
""".split()


def headers_of_folders(root):
    """The headers that need a test, relative to internal/ and without their endings."""
    top = root / "include/CGAL" / INTERNAL
    names = [path.relative_to(top).with_suffix("").as_posix() for folder in FOLDERS for path in (top / folder).glob("*.h")]
    return sorted(name for name in names if not name.endswith("_impl"))


def included_by_tests(root):
    """The headers that tests include, named as those of headers_of_folders()."""
    tests = [path for folder in ("Mixed_mesh_3", "common") for path in (root / "test" / folder).glob("*")
             if path.suffix in (".cpp", ".h")]
    return {pathlib.PurePath(name[len(INTERNAL):]).with_suffix("").as_posix()
            for path in tests for name in own_includes(path) if name.startswith(INTERNAL)}


def find_violations(root):
    headers, tested = headers_of_folders(root), included_by_tests(root)
    violations = [f"{INTERNAL}{name}.h: no test includes it" for name in headers
                  if name not in tested and name not in WITHOUT_TEST]
    for name in WITHOUT_TEST:
        if name in tested or name not in headers:
            what = "a test includes it" if name in tested else "there is no such header"
            violations.append(f"{INTERNAL}{name}.h: {what}: remove it from the list of scripts/check_tests.py")
    return violations


if __name__ == "__main__":
    sys.exit(report(find_violations))
