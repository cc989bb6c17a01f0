#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts what was measured into the tables of README and manual.

  fill_tables.py [FOLDER]     takes over the results in FOLDER (out/benchmark of scripts/benchmark.sh) first
  fill_tables.py --check      changes nothing, and fails if a table is not what benchmark/results says, or if a file
                              there is not as results.py writes it, a row in a line

A table stands between <!-- table NAME --> and <!-- end of table -->; TABLES says what is in each. In a section
that has one, there is no other table with numbers.
"""

import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
RESULTS = ROOT / "benchmark" / "results"
sys.path.insert(0, str(RESULTS.parent))
from results import json_text, load_json, markdown, save_json  # noqa: E402

TEXTS = ("README.md", "doc/Mixed_mesh_3/Performance.txt")
BLOCK = re.compile(r"(<!-- table ([a-z_]+) -->\n)(.*?)(<!-- end of table -->\n)", re.DOTALL)
SECTION = re.compile(r"^(?=## |\\(?:page|section) )", re.MULTILINE)
NUMBERS = re.compile(r"^\|.*\d.*\|$", re.MULTILINE)


def load(name):
    return load_json(RESULTS / f"{name}.json")


def number(value, form):
    return "-" if value is None else format(value, form)


def peers(rows):
    """All meshers with as many vertices; without those that were not there."""
    for r in rows:
        if r.get("failure", "").startswith("no build given"):
            continue
        if "failure" in r:
            yield {"mesher": r["mesher"], "N": f"{r['wanted']:,}", "vertices": "-"}
            continue
        yield {"mesher": r["mesher"], "N": f"{r['wanted']:,}", "vertices": f"{r['vertices']:,}",
               "ARC mean": number(r["ARC mean"], ".2f"), "ARC max": number(r["ARC max"], ".3g"),
               "dihedral angles": f"{r['smallest dihedral angle']:.0f} to {r['largest dihedral angle']:.0f}",
               "Hausdorff": number(max(r["Hausdorff surface to mesh"], r["Hausdorff mesh to surface"]), ".2f"),
               "volume": f"{r['volume ratio'] - 1:+.1%}", "in region": f"{r['share of vertices in region']:.0%}",
               "edge there": f"{r['mean edge in region']:.2f}", "CPU s": number(r["CPU seconds"], ".2f")}


def without(columns, rows):
    for r in rows:
        yield {name: value for name, value in r.items() if name not in columns}


def scale(rows):
    """The default path, by one thread, and the time by two."""
    with_two = {r["budget"]: r["seconds"] for r in rows if r["threads"] == 2}
    for r in rows:
        if r["threads"] == 1:
            yield {"N": f"{r['budget']:,}", "vertices": f"{r['vertices']:,}", "CPU s": f"{r['CPU seconds']:.2f}",
                   "of it optimization": f"{r['stages']['optimization']:.2f}",
                   "two threads, wall s": number(with_two.get(r["budget"]), ".2f"),
                   "bytes/vertex": f"{r['bytes per vertex']:,.0f}", "ARC mean": f"{r['ARC mean']:.3f}",
                   "ARC max": f"{r['ARC max']:.2f}"}


def kernels(results):
    """Nanoseconds of each kernel for each kind of element."""
    rows = {}
    for b in results["benchmarks"]:
        kernel, kind = b["name"].split("/")
        rows.setdefault(kernel, {"kernel": kernel})[kind] = f"{b['cpu_time']:.0f}"
    yield from rows.values()


TABLES = {
    "peers": lambda: peers(load("peers")["rows"]),
    "peers_of_one_size": lambda: without(("N",), peers(r for r in load("peers")["rows"] if r["wanted"] == 2000)),
    "paper": lambda: load("paper")["rows"],
    "scale": lambda: scale(load("scale")["rows"]),
    "kernels": lambda: kernels(load("kernels")),
    "threads": lambda: load("threads")["rows"],
}


def filled(text):
    """With the tables as they are measured."""
    return BLOCK.sub(lambda block: block[1] + markdown(list(TABLES[block[2]]())) + block[4], text)


def defects(name, text):
    if filled(text) != text:
        yield f"{name}: a table is not what benchmark/results says; run benchmark/fill_tables.py"
    for section in SECTION.split(text):
        if BLOCK.search(section):
            for line in NUMBERS.findall(BLOCK.sub("", section)):
                yield f"{name}: numbers from nowhere: {line}"


def main():
    arguments = sys.argv[1:]
    if len(arguments) > 1 or arguments[:1] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    texts = {name: (ROOT / name).read_text() for name in TEXTS}
    if arguments == ["--check"]:
        found = [defect for name, text in texts.items() for defect in defects(name, text)]
        tables = {block[2] for text in texts.values() for block in BLOCK.finditer(text)}
        found += [f"{file.name} is not as results.py writes it" for file in sorted(RESULTS.glob("*.json"))
                  if file.read_text(encoding="utf-8") != json_text(load_json(file))]
        found += [f"no text has the table {name}" for name in TABLES if name not in tables]
        sys.exit("\n".join(found) or 0)
    if arguments:
        RESULTS.mkdir(exist_ok=True)
        for name in TABLES:
            for file in pathlib.Path(arguments[0]).glob(f"{name}.*"):
                if file.suffix == ".json":
                    save_json(RESULTS / file.name, load_json(file))  # kernels.json is of Google Benchmark
                else:
                    shutil.copy(file, RESULTS)
    for name, text in texts.items():
        (ROOT / name).write_text(filled(text))


if __name__ == "__main__":
    main()
