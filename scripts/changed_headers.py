#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the headers that a change may have broken, a line each: public ones that include, at any depth, a header
that changed, and internal ones that changed themselves.

  scripts/changed_headers.py [BASE]      BASE is a branch or commit, origin/main by default

Changed is what differs from the commit at which HEAD left BASE, and what is not in git yet; of main itself, what its
last 20 commits changed. All public ones are printed if what tells how to compile them changed, and all there are if
no such commit is known.
"""

import pathlib
import subprocess
import sys

from check_layers import chains_from, own_includes

TOP = "include/CGAL/"
BUILD = ("CMakeLists.txt", "cmake", "test/headers")


def git(*arguments):
    """The lines that git prints, or None if it fails."""
    process = subprocess.run(["git", *arguments], capture_output=True, text=True)
    return process.stdout.splitlines() if process.returncode == 0 else None


def changed_files(base):
    """What changed, or None if that is not known."""
    fork = git("merge-base", base, "HEAD")
    if not fork or fork == git("rev-parse", "HEAD"):
        fork = git("rev-parse", "--verify", "--quiet", "HEAD~20")
    if not fork:
        return None
    differing = git("diff", "--name-only", "--no-renames", fork[0], "--", "include", *BUILD)
    added = git("ls-files", "--others", "--exclude-standard", "include", *BUILD)
    return None if differing is None or added is None else set(differing + added)


def main():
    if len(sys.argv) > 2 or sys.argv[1:2] == ["--help"]:
        sys.exit(__doc__)
    headers = sorted(pathlib.Path(TOP).rglob("*.h"))
    includes = {str(path.relative_to(TOP)): own_includes(path) for path in headers}
    changed = changed_files(sys.argv[1] if len(sys.argv) > 1 else "origin/main")
    builds_otherwise = changed is not None and any(not file.startswith("include/") for file in changed)

    def may_be_broken(header):
        if changed is None:
            return True
        if "internal" in pathlib.PurePath(header).parts:
            return TOP + header in changed
        return builds_otherwise or any(TOP + other in changed for other in chains_from(header, includes))

    for header in filter(may_be_broken, includes):
        print("CGAL/" + header)


if __name__ == "__main__":
    main()
