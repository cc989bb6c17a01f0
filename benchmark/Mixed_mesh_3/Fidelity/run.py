#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes all surfaces of folders, and prints how faithful the meshes are, as a Markdown table.

  run.py BUILD FOLDER... [--vertices 2000 5000] [--timeout 60] [--only NAME...] [--save FILE.json] [--csv FILE.csv]
  run.py --compare OLD.json NEW.json      two saved runs side by side

BUILD holds the programs mixed_mesh_3 and classify_surfaces. FOLDER is one of make_surfaces.py, or any with
.off, .stl, .ply, .obj files, searched with its subfolders: CGAL's own are in data.tar.gz and demo.tar.gz of
/usr/share/doc/libcgal-dev. What is said of a mesh is what the report of mixed_mesh_3 says, which compares it with the
surface; classify_surfaces, which uses CGAL only, says whether a surface is clean. No region is given.
"""

import argparse
import csv
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
import results  # noqa: E402

ENDINGS = (".off", ".stl", ".ply", ".obj")
ROWS = {
    "valid, volume within 5 %": lambda r: r["exit"] == 0 and abs(r["volume"] - 1) <= 0.05,
    "... and all boundary vertices on the surface":
        lambda r: ROWS["valid, volume within 5 %"](r) and r["vertices off"] == 0,
    "valid, volume within 5 %, topology right, nothing lost":
        lambda r: ROWS["valid, volume within 5 %"](r) and r["same topology"] and r["cells lost"] == 0,
    "... and status success":
        lambda r: ROWS["valid, volume within 5 %, topology right, nothing lost"](r) and r["status"] == "success",
    "status success, but topology or volume wrong":
        lambda r: r["exit"] == 0 and r["status"] == "success"
        and not (r["same topology"] and abs(r["volume"] - 1) <= 0.05),
    "exit 3": lambda r: r["exit"] == 3,
    "refused (exit 1)": lambda r: r["exit"] == 1,
    "crash, or out of time": lambda r: r["exit"] not in (0, 1, 3, 4),
}


def surfaces_of(folders, classify):
    """The files with what they are; equal files once."""
    files, seen = [], set()
    for folder in folders:
        for file in sorted(pathlib.Path(folder).rglob("*")):
            if file.is_file() and file.suffix in ENDINGS:
                content = file.read_bytes()
                if content not in seen:
                    seen.add(content)
                    files.append(str(file))
    kinds = {}
    for file in files:  # one at a time: what makes one crash concerns no other
        out = subprocess.run([classify, file], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        kinds[file] = out.stdout.rstrip("\n").split("\t")[-1] or "unreadable"
    return {f: k for f, k in kinds.items() if k not in ("unreadable", "flat")}


def measure(program, file, vertices, timeout, report):
    row = {"file": file, "name": pathlib.Path(file).stem, "vertices": vertices, "exit": -1, "status": "",
           "volume": 0, "same topology": False, "vertices off": 0, "cells lost": 0, "message": "", "needed": None}
    report.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    try:
        out = subprocess.run([program, file, "--vertices", str(vertices), "--report", str(report), "--quiet"],
                             timeout=timeout, capture_output=True, text=True, errors="replace")
        row["exit"] = out.returncode
        row["message"] = out.stderr.strip().replace(file, row["name"])
    except subprocess.TimeoutExpired:
        row["message"] = "out of time"
    row["seconds"] = round(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 3)
    if row["exit"] == 0:
        r = json.loads(report.read_text())
        row.update({"status": r["status"], "volume": r["surface"]["ratio of volumes"],
                    "same topology": r["topology"]["same topology"],
                    "vertices off": r["surface"]["boundary vertices not on surface"],
                    "cells lost": r["octree"]["cells lost"], "ARC": r["quality"]["ARC"]["all"]["max"]
                    if "ARC" in r["quality"] and "all" in r["quality"]["ARC"] else None,
                    "differences": [d["text"] for d in r["topology"]["differences"]]})
    return row


def print_table(title, runs):
    """`runs`: pairs of a head and rows."""
    print(f"\n| {title} | " + " | ".join(head for head, _ in runs) + " |")
    print("|---|" + "---:|" * len(runs))
    for name, holds in ROWS.items():
        print(f"| {name} | " + " | ".join(f"{sum(map(holds, rows))}" for _, rows in runs) + " |")
    print("| of | " + " | ".join(str(len(rows)) for _, rows in runs) + " |")
    print("| CPU seconds | " + " | ".join(f"{sum(r['seconds'] for r in rows):.0f}" for _, rows in runs) + " |")


def print_tables(saved):
    """`saved`: pairs of a name and rows."""
    budgets = sorted({r["vertices"] for _, rows in saved for r in rows})

    def runs(chosen):
        return [(f"{n}, {name}".rstrip(", "), [r for r in rows if r["vertices"] == n and chosen(r)])
                for n in budgets for name, rows in saved]

    print_table("clean surfaces", runs(lambda r: r["kind"] == "clean"))
    if any(r["kind"] != "clean" for _, rows in saved for r in rows):
        dirty = runs(lambda r: r["kind"] != "clean")
        print("\n| surfaces with holes, or that cut themselves | " + " | ".join(head for head, _ in dirty) + " |")
        print("|---|" + "---:|" * len(dirty))
        for name, holds in (("meshed", lambda r: r["exit"] == 0), ("refused", lambda r: r["exit"] == 1),
                            ("else", lambda r: r["exit"] not in (0, 1))):
            print(f"| {name} | " + " | ".join(str(sum(map(holds, rows))) for _, rows in dirty) + " |")


def print_failures(rows):
    right = ROWS["... and status success"]
    failures = [r for r in rows if r["kind"] == "clean" and not right(r)]
    if failures:
        print("\n| not a success | vertices | exit | status | volume | what is said |\n|---|--:|--:|---|--:|---|")
    for r in failures:
        said = r["message"].replace("|", "/").replace("\n", "; ")
        print(f"| {r['name']} | {r['vertices']} | {r['exit']} | {r['status']} | {r['volume']:.3f} | {said[:400]} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, nargs="?")
    parser.add_argument("folders", nargs="*")
    parser.add_argument("--vertices", type=int, nargs="+", default=[2000, 5000])
    parser.add_argument("--timeout", type=float, default=60)
    parser.add_argument("--only", nargs="+", help="names of surfaces, without folder and ending")
    parser.add_argument("--save", metavar="FILE.json")
    parser.add_argument("--csv", metavar="FILE.csv")
    parser.add_argument("--compare", nargs="+", metavar="FILE.json")
    a = parser.parse_args()
    if a.compare:
        print_tables([(pathlib.Path(f).stem, results.load_json(f)) for f in a.compare])
        return
    if a.build is None or not a.folders:
        parser.error("a build and folders are needed")
    programs = {p.name: p for p in a.build.rglob("*") if p.name in ("mixed_mesh_3", "classify_surfaces")
                and p.is_file() and p.stat().st_mode & 0o100}
    kinds = surfaces_of(a.folders, programs["classify_surfaces"])
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for n in a.vertices:
            for file, kind in kinds.items():
                if not a.only or pathlib.Path(file).stem in a.only:
                    rows.append({"kind": kind, **measure(programs["mixed_mesh_3"], file, n, a.timeout,
                                                         pathlib.Path(folder) / "report.json")})
                    if a.save:  # what there is, if it is stopped
                        results.save_json(a.save, rows)
    if a.csv:
        with open(a.csv, "w", newline="") as out:
            writer = csv.DictWriter(out, sorted({k for r in rows for k in r}))
            writer.writeheader()
            writer.writerows(rows)
    print_tables([("", rows)])
    print_failures(rows)


if __name__ == "__main__":
    main()
