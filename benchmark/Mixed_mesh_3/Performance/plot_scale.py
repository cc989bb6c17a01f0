#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what run.py has saved: time and memory for growing budgets, with the straight lines that fit best.

  plot_scale.py SCALE.json PLOT.png
"""

import argparse
import pathlib
import sys

import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from results import load_json  # noqa: E402

STAGES = ("octree", "transitions", "boundary", "optimization", "checks")


def add_with_line(axis, vertices, values, label, **style):
    """The exponent is that of the line: 1 is linear."""
    exponent, factor = numpy.polyfit(numpy.log(vertices), numpy.log(values), 1)
    axis.plot(vertices, values, "o", label=f"{label}, exponent {exponent:.2f}", **style)
    axis.plot(vertices, numpy.exp(factor) * numpy.array(vertices, float) ** exponent, "-", linewidth=1, **style)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("scale")
    parser.add_argument("plot")
    options = parser.parse_args()
    rows = load_json(options.scale)["rows"]
    figure, (times, stages, memory) = pyplot.subplots(1, 3, figsize=(15, 4.5), constrained_layout=True)
    for i, threads in enumerate(sorted({r["threads"] for r in rows})):
        those = [r for r in rows if r["threads"] == threads]
        add_with_line(times, [r["vertices"] for r in those], [r["seconds"] for r in those],
                      f"{threads} thread{'s' if threads > 1 else ''}", color=f"C{i}")
    single = [r for r in rows if r["threads"] == 1]
    vertices = [r["vertices"] for r in single]
    for i, stage in enumerate(STAGES):
        add_with_line(stages, vertices, [r["stages"][stage] for r in single], stage, color=f"C{i}")
    add_with_line(memory, vertices, [r["peak MiB"] for r in single], "peak", color="C0")
    for axis, title in ((times, "wall seconds"), (stages, "CPU seconds by stage, 1 thread"), (memory, "memory, MiB")):
        axis.set(xscale="log", yscale="log", xlabel="vertices", title=title)
        axis.grid(which="both", alpha=0.25)
        axis.legend(fontsize=8)
    figure.savefig(options.plot, dpi=110)


if __name__ == "__main__":
    main()
