#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the lists of names in the reference manual name what is documented.

  scripts/check_reference.py TAGFILE PACKAGE_DESCRIPTION...      the tag file is doxygen's

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
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    names = documented_names(sys.argv[1])
    missing = 0
    for description in sys.argv[2:]:
        with open(description, encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                for name in re.findall(r"^- `([\w:]+)(?:\(\))?`$", line.rstrip()):
                    if name not in names:
                        print(f"{description}:{number}: {name} is not documented")
                        missing += 1
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
