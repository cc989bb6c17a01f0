#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the reference manual's list of names, PackageDescription.txt, names what is documented.

  scripts/check_reference.py PACKAGE_DESCRIPTION TAGFILE      the tag file is doxygen's

Doxygen does not look into code spans, so a name that has changed would stay there.
"""

import re
import sys
import xml.etree.ElementTree


def documented_names(tagfile):
    names = set()
    for compound in xml.etree.ElementTree.parse(tagfile).getroot():
        scope = compound.findtext("name")
        if compound.get("kind") in ("class", "struct", "concept", "namespace"):
            names.add(scope)
            names.update(f"{scope}::{member.findtext('name')}" for member in compound.findall("member"))
    return names


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    description, tagfile = sys.argv[1:]
    names = documented_names(tagfile)
    missing = 0
    with open(description, encoding="utf-8") as lines:
        for number, line in enumerate(lines, 1):
            for name in re.findall(r"^- `([\w:]+)(?:\(\))?`$", line.rstrip()):
                if name not in names:
                    print(f"{description}:{number}: {name} is not documented")
                    missing += 1
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
