#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of the paper beside ours: Lobos, Bucki, Hitschfeld, Payan: "Mixed-element mesh for an
intra-operative modeling of the brain tumor extraction" (2007), as a Markdown table.

  reproduce_paper.py PROGRAMS WORK [--save BASE]

PROGRAMS holds mixed_mesh_3, brain_shift and make_region. The paper's brain and regions are not public: ours are
others, of like size. "As the paper": --mode paper --grading 0 --no-optimize, only the region is refined and
Algorithm 1 carries the boundary onto the surface. Times: the paper's are of its machine of 2007.
"""

import argparse
import json
import pathlib
import subprocess
import sys

BENCHMARK = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(BENCHMARK))
import results  # noqa: E402

DATA = BENCHMARK.parent / "data"
OPENINGS = BENCHMARK / "Linear_elasticity_3" / "openings.json"
AS_PAPER = ("--mode", "paper", "--grading", "0", "--no-optimize")
KINDS = ("hexahedra", "prisms", "pyramids", "tetrahedra", "all")
TABLE_1 = {  # kind: number, mean ARC before and after
    "hexahedra": (72, 1.27056, 1.35187), "prisms": (0, 0, 0), "pyramids": (386, 2.1387, 1.7168),
    "tetrahedra": (1418, 1.58253, 3.27791), "all": (1876, 1.68499, 2.88278)}
FIGURE_13 = {"back": (628, 2.52882), "middle": (617, 2.9747)}  # vertices, mean ARC with other regions


class Reports:
    def __init__(self, programs, work):
        self.programs, self.work = programs, work
        work.mkdir(parents=True, exist_ok=True)

    def run(self, program, *arguments):
        subprocess.run([self.programs / program, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)

    def mesh(self, name, region, vertices, *options):
        """The report of a mesh; the mesh is NAME.vtu in the work folder."""
        report, regions = self.work / f"{name}.json", [] if region is None else ["--region", region]
        self.run("mixed_mesh_3", DATA / "brain.off", *regions, "--vertices", vertices, *options, "--quiet",
                 "--output", self.work / f"{name}.vtu", "--report", report)
        return json.loads(report.read_text())

    def shift(self, name):
        report = self.work / f"{name}_shift.json"
        self.run("brain_shift", self.work / f"{name}.vtu", "--control-points", DATA / "control_points.csv",
                 "--control-radius", 8, "--tumor", DATA / "tumour.off", "--quiet", "--report", report)
        return {s["stage"]: s["CPU ms"] for s in json.loads(report.read_text())["stages"]}

    def region(self, name):
        file = self.work / f"region_{name}.off"
        self.run("make_region", OPENINGS, file, name)
        return file


def mean_arc(report, when, kind="all"):
    row = report["quality"][when][kind]
    return f"{row['ARC mean']:.2f}" if row["elements"] else "-"


def share_up_to_7(report):
    return f"{report['quality']['after']['all']['share of ARC <= 7']:.1%}"


def rows(reports):
    """What, the paper's, ours as the paper, ours by default."""
    paper = reports.mesh("paper", DATA / "region.off", 660, *AS_PAPER)
    own = reports.mesh("own", DATA / "region.off", 660)
    both = (paper, own)
    yield "vertices", 660, *(r["mesh"]["vertices"] for r in both)
    for kind in KINDS:
        number, before, after = TABLE_1[kind]
        yield (f"Table 1, {kind}: number", number,
               *(r["mesh"]["elements" if kind == "all" else kind] for r in both))
        yield (f"Table 1, {kind}: mean ARC before, after", f"{before:.2f}, {after:.2f}" if number else "-",
               *(f"{mean_arc(r, 'before', kind)}, {mean_arc(r, 'after', kind)}" for r in both))
    yield "Figure 10, share of ARC up to 7", "97 %", *map(share_up_to_7, both)
    yield ("largest ARC", "not given", *(f"{r['quality']['after']['all']['ARC max']:.2f}" for r in both))
    regular = reports.mesh("regular", None, 20000, *AS_PAPER)
    yield ("Figure 3, regular octree: vertices, mean ARC", "20,000, not given",
           f"{regular['mesh']['vertices']:,}, {mean_arc(regular, 'after')}", "-")
    for name, (vertices, arc) in FIGURE_13.items():
        region = reports.region(name)
        others = [reports.mesh(f"{kind}_{name}", region, vertices, *options)
                  for kind, options in (("paper", AS_PAPER), ("own", ()))]
        yield (f"Figure 13, another region ({name}): vertices, mean ARC", f"{vertices}, {arc:.2f}",
               *(f"{r['mesh']['vertices']}, {mean_arc(r, 'after')}" for r in others))
    times = [reports.shift(name) for name in ("paper", "own")]
    yield ("Section 6.2, displacements of four control points: CPU ms", "100",
           *(f"{t['solve']:.2g}" for t in times))
    yield ("Section 6.2, after a resection: CPU ms", "12,000",
           *(f"{t['remove elements'] + t['solve after resection']:.1f}" for t in times))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--save", type=pathlib.Path, help="base of the names of the tables")
    options = parser.parse_args()
    heads = ("", "paper", "ours, as the paper", "ours")
    table = [dict(zip(heads, row)) for row in rows(Reports(options.programs.resolve(), options.work.resolve()))]
    print(results.markdown(table), end="")
    if options.save:
        results.save(options.save, table, table)


if __name__ == "__main__":
    main()
