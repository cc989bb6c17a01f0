#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command-line mesher as a user meets it: wrong use, files, signals, progress, determinism.

  test_command_line_use.py MESHER DATA_DIRECTORY WORK_DIRECTORY
"""

import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from command_line_case import DATA, MESHER, NOTHING_WRITTEN, WORK, Case
from cube import CUBE, TRIANGLES, moved, off


def cpu_seconds(process):
    """The processor time that a process has taken, from Linux."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Use(Case):
    def test_bad_budgets(self):
        for n in ("0", "-5", "many", "1.5", "1e4", "0x10", "99999999999999999999999", "1000000001", "5\n\x1b[31m"):
            with self.subTest(n):
                shown = n.replace("\n", "\\x0a").replace("\x1b", "\\x1b")
                self.fails(self.good, "--vertices", n, status=2, names="--vertices: expected a whole number from 1 to "
                           f"1000000000, not {shown}; see --help")
        self.fails(self.good, "--vertices", "", names="--vertices", status=2)
        self.fails(self.good, "--vertices", 1, "--output", self.output, names="--vertices 1",
                   words="has at least 7 vertices")
        self.fails(self.good, "--vertices", 10**9, names="--vertices", words="GiB")
        self.fails(self.good, "--vertices", 100, "--base-level", 5, names="--vertices", words="base level 5")
        self.fails(self.good, "--vertices", 100, "--base-level", 10, names="--vertices", words="at least")
        self.fails(self.good, "--vertices", 100, "--base-level", 11, names="--base-level", status=2)
        self.fails(self.good, "--vertices", 100, "--mode", "fast", names="--mode", status=2)
        self.fails("--vertices", 100, names="SURFACE", status=2)
        run = self.mesher(self.good)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("vertices of 2000, ", run.stdout)

    def test_blanks_around_numbers(self):
        reports = []
        for blank in ("", " ", "\t", "\n"):
            run = self.mesher(self.good, "--vertices", f"{blank}500{blank}", f"--grading={blank}0.5{blank}",
                              "--base-level", f"{blank}2{blank}", "--output", self.output)
            self.assertEqual(run.returncode, 0, run.stderr)
            reports.append(self.output.read_bytes())
        self.assertEqual(1, len(set(reports)))
        for n in (" ", "5 00", " 1.5 ", " many "):
            with self.subTest(n):
                self.fails(self.good, "--vertices", n, names="--vertices", status=2)

    def test_region_off_the_domain(self):
        region = self.file("off_the_domain.off", off(moved(CUBE, 1, (5, 5, 5)), TRIANGLES))
        self.fails(self.good, "--region", region, "--vertices", 500, "--output", self.output,
                   names=region, words="does not meet")

        self.fails(self.good, "--region", region, "--region", region, "--vertices", 500, "--output", self.output,
                   names=self.good, words="none of the regions meets")

    def test_bad_weights(self):
        for weight in ("0", "-1", "2x", "nan", "inf", "1e7", ""):
            with self.subTest(weight):
                self.fails(self.good, "--region", f"{self.good}:{weight}", "--vertices", 500, status=2,
                           names=f"--region {self.good}:{weight}", words="is not a number from")
        self.fails(self.good, "--region", "x" * 5000 + ":2", "--vertices", 500, names="x" * 5000, words="name too long")
        self.fails(self.good, "--region", WORK / "none.off:2", "--vertices", 500,
                   names=WORK / "none.off", words="No such file")

    def test_wrong_use(self):
        for arguments, words in (
                (["--steps", 3], "--steps requires --no-optimize"),
                (["--solver", "ldlt"], "--solver requires --no-optimize"),
                (["--layers", 2], "--layers requires --no-optimize"),
                (["--max-stiffness", 2, "--no-fit"], "--max-stiffness requires --no-optimize"),
                (["--no-fit", "--no-optimize"], "excludes"),
                (["--no-fit", "--tolerance", 1], "excludes"),
                (["--no-optimize", "--tolerance", 1], "excludes"),
                (["--no-optimize", "--steps", 0], "--steps"),
                (["--no-optimize", "--poisson-ratio", 0.5], "--poisson-ratio: expected a number of at least 0"),
                (["--no-optimize", "--poisson-ratio", "nan"], "--poisson-ratio"),
                (["--no-optimize", "--stiffness-factor", 1], "--stiffness-factor"),
                (["--no-optimize", "--max-stiffness", 0.5], "--max-stiffness"),
                (["--no-optimize", "--acceptable-quality", "inf"], "--acceptable-quality"),
                (["--no-optimize", "--layers", -1], "--layers"),
                (["--no-optimize", "--solver", "lu"], "--solver"),
                (["--grading", -0.1], "--grading: expected a number from 0 to 100"),
                (["--grading", "nan"], "--grading: expected a number from 0 to 100"),
                (["--grading", "much"], "--grading"),
                (["--tolerance", 0], "--tolerance: expected a number greater than 0"),
                (["--tolerance", "nan"], "--tolerance"),
                (["--tolerance", "much"], "--tolerance")):
            with self.subTest(arguments):
                self.fails(self.good, "--vertices", 100, *arguments, "--output", self.output, names=words, status=2)

    def test_names(self):
        """What is in names reaches the terminal in one line, without control characters; system errors are ours."""
        odd = WORK / "a\nb\x1b[31m\u009b31m\u00e9.off"
        shown = "a\\x0ab\\x1b[31m\\x9b31m\u00e9.off"
        by_reader = "a?b?[31m\\x9b31m\u00e9.off"
        self.fails(odd, "--vertices", 100, names=by_reader, words="No such file")
        self.fails(self.good, "--vertices", 100, "--output", odd, names=shown, words="unknown extension")
        self.fails(self.good, "--vertices", 100, "--" + odd.name, names=shown, status=2)
        report = WORK / (odd.name + ".json")
        run = self.mesher(self.good, "--vertices", 100, "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(f"wrote {WORK / shown}.json\n", run.stdout)
        long = WORK / ("x" * 300 + ".off")
        self.fails(long, "--vertices", 100, names=f"{long}: cannot be opened: File name too long")
        self.fails(self.good, "--vertices", 100, "--report", long, names=f"{long}: ", words="File name too long")
        loop = WORK / "loop.off"
        loop.symlink_to(loop)
        self.fails(loop, "--vertices", 100, names=f"{loop}: cannot be opened: Too many levels of symbolic links")

    def test_nothing_will_be_written(self):
        run = self.mesher(self.good, "--vertices", 100)
        self.assertEqual((run.returncode, run.stderr), (0, NOTHING_WRITTEN + "\n"))

    def test_outputs_that_cannot_be_written(self):
        for path in (WORK / "none" / "mesh.vtu", WORK / "good.off" / "mesh.vtu", WORK / "mesh.txt"):
            self.fails(self.good, "--vertices", 500, "--output", path, names=path)
        self.fails(self.good, "--vertices", 500, "--report", WORK / "none" / "r.json", names="r.json")
        self.fails(self.good, "--vertices", 500, "--report", self.good, names="good.off", words="twice")
        self.fails(self.good, "--vertices", 500, "--output", self.output, "--output", self.output,
                   names=self.output, words="twice")
        # what is there stays when the run fails
        self.output.write_text("precious")
        self.fails(self.file("open2.off", off(CUBE, TRIANGLES[:-1])), "--strict", "--vertices", 500, "--output",
                   self.output, names="open2.off")
        self.assertEqual(self.output.read_text(), "precious")

    def test_files_that_are_replaced(self):
        """They keep their modes; a link keeps leading where it leads, also to a file that is not there yet."""
        self.output.write_text("old")
        self.output.chmod(0o600)
        link = WORK / "link.msh"
        link.symlink_to("target.msh")
        long = WORK / ("x" * 251 + ".vtu")
        run = self.mesher(self.good, "--vertices", 100, "--output", self.output, "--output", link, "--output", long)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.output.stat().st_mode & 0o777, 0o600)
        self.assertTrue(link.is_symlink())
        self.assertGreater((WORK / "target.msh").stat().st_size, 1000)
        self.assertEqual(self.output.read_bytes(), long.read_bytes())

    def test_page_without_folders(self):
        """A page is to be sent: it has the names of files, without folders."""
        folder = WORK / "Doe, John's"
        folder.mkdir()
        surface, page = folder / "brain.off", folder / "brain.html"
        surface.write_text(self.good.read_text().replace("\n1 1 1\n", "\n1 1 0.2\n"))
        run = self.mesher(surface, "--region", surface, "--vertices", 100, "--output", folder / "brain.vtu", "--page", page)
        self.assertEqual(run.returncode, 0, run.stderr)
        text = page.read_text()
        self.assertNotIn("Doe, John", text)  # three letters may be in what is coded as letters
        self.assertNotIn(str(WORK.resolve()), text)
        self.assertIn("brain.vtu", text)

    def test_interrupted_while_it_writes(self):
        """The signal comes while a pipe waits for its reader: no file appears, and none is left behind."""
        pipe = WORK / "pipe.vtu"
        os.mkfifo(pipe)
        for number in (signal.SIGINT, signal.SIGTERM):
            before = sorted(WORK.iterdir())
            run = subprocess.Popen([MESHER, DATA / "brain.off", "--vertices", "5000", "--output", self.output,
                                    "--output", pipe], stderr=subprocess.PIPE, stdout=subprocess.PIPE)
            reader = os.open(pipe, os.O_RDONLY)
            os.read(reader, 100)
            self.assertEqual(len(sorted(WORK.iterdir())), len(before) + 1)  # the mesh under its hidden name
            run.send_signal(number)
            while os.read(reader, 1 << 16):
                pass
            os.close(reader)
            run.communicate()
            self.assertEqual(run.returncode, -number)
            self.assertEqual(sorted(WORK.iterdir()), before)

    def test_stopped(self):
        """By its own limit, or by a signal, in the middle of the optimization: what there is is valid, and on the surface."""
        arguments = [DATA / "brain.off", "--region", DATA / "region.off", "--vertices", 10000, "--output", self.output]
        report = WORK / "report.json"

        def repeated(f):
            """A time in the middle of the optimization is searched, as the machine may be faster or slower than before:
            stopped earlier, there is no mesh; later, it has ended, or inserted vertices have not arrived yet."""
            time_limit = middle
            for _ in range(20):
                status, out, errors = f(time_limit)
                if status == 4 and "boundary vertices on the surface" not in out:
                    break
                time_limit *= 1.1 if status == 1 else 0.9
            return status, out, errors, time_limit

        def interrupted(seconds):
            run = subprocess.Popen([MESHER, *map(str, arguments)], stderr=subprocess.PIPE, stdout=subprocess.PIPE,
                                   text=True)
            time.sleep(seconds)
            run.send_signal(signal.SIGINT)
            out, errors = run.communicate()
            return run.returncode, out, errors

        def limited(seconds):
            run = self.mesher(*arguments, "--report", report, "--time-limit", seconds)
            return run.returncode, run.stdout, run.stderr

        self.assertEqual(self.mesher(*arguments, "--report", report).returncode, 0)
        stages = {s["stage"]: s["seconds"] for s in json.loads(report.read_text())["stages"]}
        names = list(stages)
        middle = (sum(stages[n] for n in names[:names.index("optimization")]) + stages["quality"]
                  + 0.4 * stages["optimization"])
        whole = self.output.read_bytes()
        status, out, errors, time_limit = repeated(limited)
        self.assertEqual(status, 4, errors)
        self.assertIn("warning: stopped by --time-limit after ", errors)
        told = json.loads(report.read_text())
        self.assertEqual((told["status"], told["options"]["time limit"]), ("stopped", time_limit))
        self.assertTrue(all(told["checks"].values()))
        self.assertTrue(0.9 * 10000 < told["mesh"]["vertices"] <= 10000)
        self.assertNotEqual(self.output.read_bytes(), whole)
        status, out, errors, _ = repeated(interrupted)
        self.assertEqual(status, 4, errors)
        self.assertIn("warning: stopped by a signal after ", errors)
        self.assertNotIn("boundary vertices on the surface", out)
        # after 2 s, whatever it is doing, and with one line
        self.output.unlink()
        command = [MESHER, DATA / "brain.off", "--vertices", "300000", "--output", self.output]
        run = subprocess.Popen(list(map(str, command)), stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        # the surface is read within 1 CPU second, the octree takes 10; another machine may be slow, or have other work
        while run.poll() is None and cpu_seconds(run.pid) < 2.5:
            time.sleep(0.1)
        run.send_signal(signal.SIGINT)
        begin = time.monotonic()
        out, errors = run.communicate()
        self.assertLess(time.monotonic() - begin, 4)
        self.assertEqual((run.returncode, out, len(errors.splitlines())), (1, "", 1), errors)
        self.assertIn("nothing is written", errors)
        self.assertFalse(self.output.exists())
        # before there is a mesh
        self.fails(*arguments, "--time-limit", 1e-9, names="stopped before there was a mesh: nothing is written")
        self.fails(*arguments, "--time-limit", 0, names="--time-limit", status=2)

    def test_progress(self):
        """On a terminal: a share of the work that never falls, and the time that is left."""
        terminal, stderr = os.openpty()
        run = subprocess.Popen([MESHER, DATA / "brain.off", "--vertices", "30000", "--output", self.output], stderr=stderr,
                               stdout=subprocess.DEVNULL)
        os.close(stderr)
        text = b""
        try:
            while piece := os.read(terminal, 1 << 16):
                text += piece
        except OSError:  # the end of a terminal
            pass
        os.close(terminal)
        self.assertEqual(run.wait(), 0)
        # once a second at most, in one line
        lines = text.split(b"\r\x1b[K")
        seconds = [int(line.split()[0]) for line in lines if b" s  " in line and b"MiB" not in line]
        self.assertGreater(len(seconds), 2)
        self.assertTrue(all(a < b + 1 for a, b in zip(seconds, seconds[1:])), seconds)
        self.assertNotIn(b"\n", b"".join(lines[:-1]))
        shares = [int(share) for share in re.findall(rb"about +(\d+) %, \d+ s left: ", text)]
        self.assertGreater(len(shares), 2)
        self.assertEqual(shares, sorted(shares))
        # where the surface is simplified within seconds, the first one is 55 or 61 %
        self.assertTrue(shares[0] < 75 < shares[-1] < 100, shares)

    def test_libraries(self):
        """No BLAS, which is for `brain_shift`: it takes much of the address space when it is loaded."""
        if not shutil.which("ldd"):
            self.skipTest("there is no ldd")
        run = subprocess.run(["ldd", MESHER], capture_output=True, text=True)
        self.assertNotRegex(run.stdout, "blas|cholmod")

    def test_same_bytes(self):
        for arguments in ([], ["--no-optimize"], ["--tolerance", 12], ["--no-fit"]):
            if arguments == ["--no-optimize"] and self.mesher(self.good, "--vertices", 100, *arguments).returncode:
                continue  # built without Eigen
            hashes = set()
            for i, threads in enumerate((1, 5) if "--tolerance" in arguments else (1, 1, 2, 3, 5)):
                path = WORK / f"{i}.vtu"
                run = self.mesher(DATA / "brain.off", "--region", DATA / "region.off", "--vertices",
                                  300 if "--tolerance" in arguments else 660, *arguments, "--threads", threads,
                                  "--output", path)
                self.assertEqual(run.returncode, 0, run.stderr)
                hashes.add(hashlib.sha256(path.read_bytes()).hexdigest())
            self.assertEqual(len(hashes), 1, arguments)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
