#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines of README, one after the other, as a reader meets them: shell, C++, and Python in the same folder.

  test_readme.py BUILD SOURCE PROGRAM FOLDER        BUILD holds bin/ and python/, PROGRAM is that in C++

Not run are the two commands and what needs a network, or builds all again: scripts/, cmake, pip, and g++. What these
make is that of BUILD: the programs, and the module.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

BUILD, SOURCE, PROGRAM, FOLDER = (pathlib.Path(a).resolve() for a in sys.argv[1:5])
if not list((BUILD / "python" / "mixed_mesh_3").glob("_core*")):
    print("skipped: the module was not built, see MIXED_MESH_3_BUILD_PYTHON")
    sys.exit(77)

# A block of lines with four spaces, or between fences with a language.
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$|((?:^    [^\n]+\n)+)", re.MULTILINE | re.DOTALL)
NOT_RUN = re.compile(r"\s*(\./)?(scripts/|cmake |ENV/bin/pip )")


def blocks():
    """The language of each block, "sh" for commands, and its text."""
    for language, fenced, indented in BLOCK.findall((SOURCE / "README.md").read_text(encoding="utf-8")):
        yield (language, fenced) if language else ("sh", re.sub("^    ", "", indented, flags=re.MULTILINE))


def commands(text):
    """The commands of a block that are run."""
    for line in text.splitlines():
        parts = [part for part in line.split(" && ") if not NOT_RUN.match(part) and "venv" not in part]
        if parts:
            yield " && ".join(parts)


class Test(unittest.TestCase):
    def setUp(self):
        """A folder that looks like the repository, with what the two commands build."""
        shutil.rmtree(FOLDER, ignore_errors=True)
        (FOLDER / "build").mkdir(parents=True)
        for name in ("data", "include"):
            (FOLDER / name).symlink_to(SOURCE / name)
        (FOLDER / "build" / "release").symlink_to(BUILD)
        (FOLDER / "ENV" / "bin").mkdir(parents=True)
        python = FOLDER / "ENV" / "bin" / "python"
        python.write_text(f'#!/bin/sh\nPYTHONPATH="{BUILD}/python" exec "{sys.executable}" "$@"\n')
        python.chmod(0o755)
        self.environment = {**os.environ, "PATH": "/usr/bin:/bin"}

    def run_all(self, lines):
        run = subprocess.run(["bash", "-euo", "pipefail", "-c", "\n".join(lines)], cwd=FOLDER, env=self.environment,
                             capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual(run.returncode, 0, f"{lines}\n{run.stdout}\n{run.stderr}")
        return run.stdout

    def test_lines(self):
        lines, languages = [], []
        for language, text in blocks():
            languages.append(language)
            if language == "sh":
                lines += commands(text)
            elif language == "python":  # the file is what is typed after Python is started
                (FOLDER / "program.py").write_text(text, encoding="utf-8")
                lines.append("ENV/bin/python program.py")
        self.assertTrue({"sh", "cpp", "python"} == set(languages), languages)
        lines = [line for line in lines if line != "ENV/bin/python"]
        for expected in ("export PATH", "mixed_mesh_3 data/brain.off", "g++ ", "ENV/bin/python program.py"):
            self.assertEqual(sum(line.startswith(expected) for line in lines), 1, (expected, lines))
        self.assertEqual(len(lines), 4, lines)
        # The program is compiled already.
        lines = [re.sub(r"^g\+\+ .* program\.cpp .*&& \./a\.out$", f"'{PROGRAM}'", line) for line in lines]
        self.assertIn(f"'{PROGRAM}'", lines)
        # A command at a time, so that each has its own files.
        start = [lines[0]]
        for line in lines[1:]:
            for name in ("brain.vtu", "brain.html"):
                (FOLDER / name).unlink(missing_ok=True)
            self.run_all([*start, line])
            self.assertGreater((FOLDER / "brain.vtu").stat().st_size, 10000, line)
            self.assertEqual((FOLDER / "brain.html").exists(), "--page" in line, line)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
