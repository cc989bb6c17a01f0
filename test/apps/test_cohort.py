#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cohorts: a broken case and the rest, loads that are drawn, killed and restarted, Slurm, bad tables.

  test_cohort.py MESHER SOURCE_DIRECTORY WORK_DIRECTORY

brain_shift is beside MESHER. Slurm is a stand-in here, which runs each job that it is given at once.
"""

import csv
import hashlib
import html.parser
import importlib.util
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

MESHER, SOURCE, WORK = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
SNAKEMAKE = "/usr/bin/snakemake"  # Debian's

for module in ("nibabel", "numpy", "scipy"):
    if not importlib.util.find_spec(module):
        print("skipped: no", module)
        sys.exit(77)
if not os.access(SNAKEMAKE, os.X_OK):
    print("skipped: no", SNAKEMAKE)
    sys.exit(77)

DATA, WORKFLOW = SOURCE / "data", SOURCE / "workflow"
TABLE = f"""# Of two brains and a broken one.
id,brain,tumor,opening,control_points,vertices
ball,{DATA}/brain.off,28 18 28 14,44 30 75 20,{DATA}/control_points.csv,350
file,{DATA}/brain.off,{DATA}/tumour.off,,,400
broken,broken.off,,,,350
"""
SBATCH = """#!/usr/bin/python3
import subprocess, sys
with open("slurm/calls", "a") as file:
    print(*sys.argv[1:], file=file)
print(len(open("slurm/calls").readlines()))
failed = subprocess.run(["sh", sys.argv[-1]], capture_output=True).returncode
with open("slurm/states", "a") as file:
    print("FAILED" if failed else "COMPLETED", file=file)
"""
SACCT = """#!/bin/sh
for job; do :; done
sed -n "${job}p" slurm/states
"""


class Text_of_cells(html.parser.HTMLParser):
    """The rows of the first table of a page, and what it refers to."""

    def __init__(self, page):
        super().__init__()
        self.rows, self.links, self.tables, self.is_cell = [], [], 0, False
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        self.links += [value for name, value in attributes if name in ("href", "src")]
        self.tables += tag == "table"
        if self.tables == 1 and tag == "tr":
            self.rows.append([])
        elif self.tables == 1 and tag in ("td", "th"):
            self.rows[-1].append("")
            self.is_cell = True

    def handle_endtag(self, tag):
        self.is_cell = self.is_cell and tag not in ("td", "th")

    def handle_data(self, data):
        if self.is_cell:
            self.rows[-1][-1] += data


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def bytes_of(folder):
    """What each file has, but those that tell of a run: logs, times, and what snakemake keeps."""
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob("*")) if path.is_file()
            and path.relative_to(folder).parts[0] not in (".snakemake", "logs", "slurm", "times")}


class Cohort(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        (WORK / "cases.csv").write_text(TABLE)
        lines = (DATA / "brain.off").read_text().split("\n")
        (WORK / "broken.off").write_text("\n".join(lines[:len(lines) // 2]) + "\n")
        cls.by_slurm = cls.start_slurm()  # which waits most of the time

    @classmethod
    def start_slurm(cls):
        programs = WORK / "slurm_programs"
        programs.mkdir()
        for name, text in (("sbatch", SBATCH), ("sacct", SACCT), ("scancel", "#!/bin/sh\n")):
            (programs / name).write_text(text)
            (programs / name).chmod(0o755)
        (WORK / "two.csv").write_text("id,brain,control_points,vertices\n"
                                      f"whole,{DATA}/brain.off,{DATA}/control_points.csv,300\n"
                                      f"broken,broken.off,{DATA}/control_points.csv,300\n")
        options = ["--profile", WORKFLOW / "profiles" / "slurm", "--latency-wait", "5"]
        return subprocess.Popen(cls.command("by_slurm", *options, cases=WORK / "two.csv", config=["loads=0"]),
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"})

    @classmethod
    def command(cls, folder, *options, cases=WORK / "cases.csv", config=("loads=1", "grid=10")):
        return [SNAKEMAKE, "--snakefile", WORKFLOW / "Snakefile", "--directory", WORK / folder, *options,
                "--config", f"cases={cases}", f"programs={MESHER.parent}", *config]

    def run_all(self, folder, *options, **more):
        return subprocess.run(self.command(folder, *(options or ("--cores", "2", "--keep-going"))),
                              capture_output=True, text=True, timeout=120, env={**os.environ, **more})

    def check(self, folder, run):
        """One case is told as broken, the rest is done."""
        self.assertEqual(run.returncode, 1, run.stderr)
        rows = table(WORK / folder / "cohort.csv")
        self.assertEqual([(r["id"], r["status"], r["loads done"], r["loads"]) for r in rows],
                         [("ball", "done", "2", "2"), ("file", "done", "1", "1"),
                          ("broken", "failed", "0", "1")])
        self.assertIn("mixed_mesh_3: error: ", rows[2]["message"])
        self.assertIn("broken.off", rows[2]["message"])
        self.assertEqual([r["message"] for r in rows[:2]], ["", ""])
        for row, vertices in zip(rows, (350, 400)):
            self.assertTrue(0.9 * vertices <= int(row["vertices"]) <= vertices)
        self.assertIn("cohort: failed: broken: " + rows[2]["message"], run.stdout + run.stderr)
        page = Text_of_cells((WORK / folder / "cohort.html").read_text())
        self.assertEqual(page.rows, [list(rows[0])] + [list(r.values()) for r in rows])
        done = table(WORK / folder / "loads.csv")
        expected = [f"{r['id']}/mesh.{ending}" for r in rows[:2] for ending in ("vtu", "json")]
        expected += [f"{r['id']}/{r['load']}/shift.{ending}" for r in done if r["status"] == "done"
                     for ending in ("json", "vtu")]
        self.assertEqual(page.links, expected)
        self.assertTrue(all((WORK / folder / link).is_file() for link in page.links))
        self.assertIn(rows[2]["message"], (WORK / folder / "cohort.md").read_text())

    def test_cohort(self):
        """Once as it is, and once killed."""
        self.check("whole", self.run_all("whole"))
        loads = table(WORK / "whole" / "loads.csv")
        self.assertEqual([(r["id"], r["load"], r["status"]) for r in loads],
                         [("ball", "measured", "done"), ("ball", "load_001", "done"),
                          ("file", "load_001", "done"), ("broken", "load_001", "missing")])
        import nibabel
        import numpy as np
        for row in loads[:3]:
            folder = (WORK / "whole" / row["displacements"]).parent
            report = json.loads((folder / "shift.json").read_text())
            after = report.get("shift after resection") or report["shift"]
            self.assertEqual(f"{after['largest displacement']:.3f}", row["largest shift mm"])
            self.assertGreater(float(row["largest shift mm"]), 0.01)
            grid = nibabel.load(folder.parent / "grid.nii")
            mask = np.asarray(nibabel.load(folder / "warped_mask.nii.gz").dataobj)
            self.assertEqual(mask.shape, grid.shape)
            volume = (mask == 1).sum() * 1000
            self.assertTrue(1.5e6 < volume < 2.1e6, volume)
            self.assertTrue((folder / "warped_forward.nrrd").read_bytes().startswith(b"NRRD"))
        # Where the opening was drawn is where the table has it; its control points move along one direction.
        drawn = json.loads((WORK / "whole" / "ball" / "load_001" / "load.json").read_text())["drawn"]
        center = [float(x) for x in drawn["opening"].split(",")]
        self.assertLess(np.linalg.norm(np.array(center) - (44, 30, 75)), 45)
        points = np.array([[float(x) for x in r.values()] for r in
                           table(WORK / "whole" / "ball" / "load_001" / "control_points.csv")])
        self.assertEqual(np.linalg.matrix_rank(points[:, 3:], tol=1e-4), 1)
        self.assertAlmostEqual(np.linalg.norm(points[0, 3:]), abs(float(drawn["depth"])), places=4)

        # Killed with all that it runs, when there is a mesh.
        with open(WORK / "killed.log", "w") as log:
            process = subprocess.Popen(self.command("killed", "--cores", "2", "--keep-going"), stdout=log,
                                       stderr=log, start_new_session=True)
            deadline = time.time() + 60
            while not list((WORK / "killed").glob("*/mesh.json")) and time.time() < deadline:
                time.sleep(0.02)
            os.killpg(process.pid, signal.SIGKILL)
            self.assertEqual(process.wait(), -signal.SIGKILL)
        self.assertFalse((WORK / "killed" / "cohort.csv").exists())
        self.assertEqual(self.run_all("killed", "--unlock").returncode, 0)
        again = self.run_all("killed", "--cores", "2", "--keep-going", "--rerun-incomplete")
        self.check("killed", again)
        self.assertEqual(bytes_of(WORK / "killed"), bytes_of(WORK / "whole"))

        # Mended: only that case runs, and the rest stays.
        before = (WORK / "killed" / "ball" / "mesh.vtu").stat().st_mtime_ns
        shutil.copy(WORK / "broken.off", WORK / "kept.off")
        try:
            shutil.copy(DATA / "brain.off", WORK / "broken.off")
            mended = self.run_all("killed")
        finally:
            shutil.move(WORK / "kept.off", WORK / "broken.off")
        self.assertEqual(mended.returncode, 0, mended.stderr)
        self.assertEqual({r["status"] for r in table(WORK / "killed" / "cohort.csv")}, {"done"})
        self.assertEqual((WORK / "killed" / "ball" / "mesh.vtu").stat().st_mtime_ns, before)

    def test_slurm(self):
        """The profile, with programs in the place of Slurm's."""
        output, _ = self.by_slurm.communicate(timeout=120)
        self.assertEqual(self.by_slurm.returncode, 1, output)
        told = [r["status"] for r in table(WORK / "by_slurm" / "cohort.csv")]
        self.assertEqual(told, ["done", "failed"], output)
        calls = (WORK / "by_slurm" / "slurm" / "calls").read_text().splitlines()
        states = (WORK / "by_slurm" / "slurm" / "states").read_text().split()
        # two meshes, of which one fails, and a shift
        self.assertEqual((len(calls), sorted(states)), (3, ["COMPLETED", "COMPLETED", "FAILED"]))
        self.assertTrue(all("--cpus-per-task=1 --mem=2000 --time=30" in call for call in calls), calls)

    def test_bad_tables(self):
        """One line, and nothing runs."""
        brain = DATA / "brain.off"
        for text, words in (("id,brain,color\na,b.off,red\n", 'line 1: unknown column "color"'),
                            ("id,brain\na,none.off\n", "line 2: brain: there is no file"),
                            (f"id,brain\n# one\na,{brain}\na,{brain}\n", 'line 4: id "a" is there twice'),
                            (f"id,brain\na/b,{brain}\n", 'line 2: id "a/b": expected letters'),
                            (f"id,brain,vertices\na,{brain},many\n", 'vertices: "many" is not a number'),
                            (f"id,brain,opening\na,{brain},1 2 3\n", "opening: expected x y z radius"),
                            (f"id,brain\na,{brain},3\n", "line 2: expected 2 cells, not 3"),
                            ("id,brain\n", "there are no cases"), ("", "there are no cases")):
            with self.subTest(words):
                (WORK / "bad.csv").write_text(text)
                run = subprocess.run(self.command("bad", "--cores", "1", cases=WORK / "bad.csv"),
                                     capture_output=True, text=True, timeout=60)
                told = [line for line in run.stderr.splitlines() if not line.startswith("Creating specified")]
                self.assertEqual((run.returncode, len(told)), (2, 1), run.stderr)
                self.assertTrue(told[0].startswith("cohort: error: "), told)
                self.assertIn(words, told[0])
                self.assertEqual([p.name for p in (WORK / "bad").iterdir() if p.name != ".snakemake"], [])

    def test_bad_settings(self):
        for config, words in (("loads=-1", '--config loads: "-1"'), ("load=1", '--config: unknown "load"'),
                              ("field=dicom", '--config field: "dicom"'),
                              ("programs=/none", "there is no program /none/mixed_mesh_3")):
            with self.subTest(config):
                run = subprocess.run(self.command("bad", "--cores", "1", config=[config]),
                                     capture_output=True, text=True, timeout=60)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertIn(words, run.stderr.splitlines()[-1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
