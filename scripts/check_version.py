#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists the places of the version number, and fails if they differ.

  scripts/check_version.py
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Files, and what stands before the number there; in CHANGES.md the first section is that of this version.
PLACES = {
    "CMakeLists.txt": r"^project\(Mixed_mesh_3 VERSION ",
    "CITATION.cff": r"^version: ",
    "CHANGES.md": r"^## ",
    "python/pyproject.toml": r'^version = "',
    "python/build_wheel.py": r'^NAME, VERSION = "mixed_mesh_3", "',
    "python/src/mixed_mesh_3/__init__.py": r'^__version__ = "',
}


def main():
    if len(sys.argv) > 1:
        sys.exit(__doc__)
    versions = set()
    for name, before in PLACES.items():
        text = (ROOT / name).read_text(encoding="utf-8")
        found = re.search(before + r"(\d+\.\d+\.\d+)\b", text, re.MULTILINE)
        if not found:
            sys.exit(f"{name}: no version number after {before}")
        print(f"{name}:{text.count(chr(10), 0, found.start()) + 1}: {found[1]}")
        versions.add(found[1])
    sys.exit("the version numbers differ" if len(versions) > 1 else 0)


if __name__ == "__main__":
    main()
