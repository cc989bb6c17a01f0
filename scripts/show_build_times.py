#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints what took longest to build and to test in build directories of Ninja: seconds from start to end.

  scripts/show_build_times.py BUILD_DIRECTORY...      the 20 slowest of each

Of what was built or tested several times, the last time counts. What ran beside others took longer than
alone.
"""

import pathlib
import re
import sys

TEST = re.compile(r"^\d+/\d+ Test: (\S+)$.*?^Test time = +([\d.]+) sec$", re.MULTILINE | re.DOTALL)


def build_steps(directory):
    """Seconds of each step in Ninja's log, by its first output: a step with several has a line for each."""
    first, seconds = {}, {}
    log = directory / ".ninja_log"
    for line in log.read_text().splitlines()[1:] if log.exists() else ():
        start, end, _, output, command = line.split("\t")
        name = first.setdefault((start, end, command), output)
        seconds[name] = (int(end) - int(start)) / 1000
    return seconds


def tests(directory):
    """Seconds of each test of the last run of ctest."""
    log = directory / "Testing" / "Temporary" / "LastTest.log"
    text = log.read_text(errors="replace") if log.exists() else ""
    return {name: float(time) for name, time in TEST.findall(text)}


def short(output):
    """An output without what says nothing: folder/CMakeFiles/target.dir/file.o -> folder/target/file."""
    return re.sub(r"CMakeFiles/([^/]+)\.dir/|\.o$", lambda match: f"{match[1]}/" if match[1] else "", output)


def show(title, times):
    print(f"{title}: {len(times)}, {sum(times.values()) / 60:.1f} min one after the other")
    for name, seconds in sorted(times.items(), key=lambda item: -item[1])[:20]:
        print(f"{seconds:8.1f}  {name}")


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    built, tested = {}, {}
    for directory in map(pathlib.Path, sys.argv[1:]):
        where = directory.name
        built.update({f"{where}: {short(name)}": time for name, time in build_steps(directory).items()})
        tested.update({f"{where}: {name}": time for name, time in tests(directory).items()})
    if built:
        show("steps of the build", built)
    if tested:
        show("tests", tested)


if __name__ == "__main__":
    main()
