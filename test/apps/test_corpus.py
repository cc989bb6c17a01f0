#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What once went wrong is right: the rows of test/corpus/rows.json, which test/corpus/README.md describes.

  test_corpus.py MESHER CORPUS_DIRECTORY WORK_DIRECTORY
"""

import json
import pathlib
import shutil
import subprocess
import sys
import unittest

MESHER, CORPUS, WORK = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
ROWS = json.loads((CORPUS / "rows.json").read_text())


def differs(pair, value):
    ratio, tolerance = pair
    return abs(value - ratio) > tolerance


def wrong(right, run, report):
    """What is not as the row says: the name of the entry, and what there is instead."""
    if run.returncode != right["exit"]:
        yield "exit", f"{run.returncode}: {run.stderr}"
    if right.get("message", "") not in run.stderr:
        yield "message", run.stderr
    if not report:
        return
    fidelity, topology = report["surface"], report["topology"]["mesh"]
    for name, value in (("status", report["status"]), ("bodies", topology["bodies"]),
                        ("handles", topology["handles"]),
                        ("vertices off", fidelity["boundary vertices not on surface"]),
                        ("self-intersections", fidelity["boundary self-intersections"])):
        if value != right[name]:
            yield name, value
    if differs(right["volume"], fidelity["ratio of volumes"]):
        yield "volume", fidelity["ratio of volumes"]
    kept = report["fitting"]["sharp edges"]["share kept"]  # null where they are not followed
    if "sharp edges" in right and (kept is None or kept < right["sharp edges"] - 1e-9):
        yield "sharp edges", kept
    ratios = {s["name"]: s["ratio of volumes"] for s in report.get("subdomains") or []}
    others = {name: ratios.get(name) for name, pair in right.get("subdomains", {}).items()
              if name not in ratios or differs(pair, ratios[name])}
    if others:
        yield "subdomains", others


class Corpus(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)

    def test_rows(self):
        path = WORK.resolve() / "report.json"
        for row in ROWS:
            with self.subTest(row["name"]):
                path.unlink(missing_ok=True)
                run = subprocess.run([MESHER, *row["arguments"], "--report", path], cwd=CORPUS, capture_output=True,
                                     text=True, timeout=240)
                report = json.loads(path.read_text()) if path.exists() else None
                self.assertEqual(report is not None, row["right"]["exit"] == 0, run.stderr)
                if report:
                    self.assertTrue(all(report["checks"].values()), report["checks"])
                found, known = dict(wrong(row["right"], run, report)), row.get("known", {})
                unknown = {name: value for name, value in found.items() if name not in known}
                self.assertEqual(unknown, {}, f"not right, it once was: {row['once']}")
                self.assertEqual(set(known) - set(found), set(), "right now: remove it from `known` of the row")

    def test_files(self):
        """Each file is in a row, and all are small."""
        files = [f for f in CORPUS.iterdir() if f.name not in ("rows.json", "README.md")]
        words = {word.split("=")[-1] for row in ROWS for word in row["arguments"]}
        self.assertEqual([f.name for f in files if f.name not in words], [])
        self.assertLess(sum(f.stat().st_size for f in files), 200000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
