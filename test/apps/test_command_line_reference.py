#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command-line reference of the manual has each option that a program tells by --help.

  test_command_line_reference.py SOURCE PROGRAM...
"""

import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path(sys.argv[1]) / "doc" / "guides" / "command_line.txt"


def section_of(text, program):
    """The part of the page that is about a program."""
    return re.search(rf"\\section \w+ {program}\n(.*?)\\section", text, re.DOTALL)[1]


def main():
    text = PAGE.read_text()
    missing = []
    for path in map(pathlib.Path, sys.argv[2:]):
        told = subprocess.run([path, "--help"], capture_output=True, text=True, check=True).stdout
        options = {option for line in re.findall(r"^  (-[^ ]*)", told, re.MULTILINE)
                   for option in line.split(",") if option.startswith("--")}
        assert len(options) > 20, path
        listed = {option for row in re.findall(r"^\| (.*?) \|", section_of(text, path.name), re.MULTILINE)
                  for option in re.findall(r"`(--[\w-]+)", row)}
        listed |= {"--no-sharp", "--tumour", "--tumour-label"}  # other names of options
        missing += [f"{PAGE.name}: {path.name} {option} is missing" for option in sorted(options - listed)]
    sys.exit("\n".join(missing) or 0)


if __name__ == "__main__":
    main()
