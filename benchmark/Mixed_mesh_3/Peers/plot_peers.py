#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what compare_with_peers.py has saved: worst element, distance from the surface, and time.

  plot_peers.py PEERS.json PLOT.png
"""

import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from results import load_json  # noqa: E402

PANELS = (("ARC max", "worst aspect-ratio coefficient"), ("Hausdorff", "Hausdorff distance, mm"),
          ("CPU seconds", "meshing, CPU s"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("peers")
    parser.add_argument("plot")
    options = parser.parse_args()
    rows = [r for r in load_json(options.peers)["rows"] if "failure" not in r]
    names = list(dict.fromkeys(r["mesher"] for r in rows))
    figure, axes = pyplot.subplots(1, len(PANELS), figsize=(15, 4.5), constrained_layout=True)
    for axis, (key, title) in zip(axes, PANELS):
        for i, name in enumerate(names):
            points = [(r["vertices"], r[key]) for r in rows if r["mesher"] == name and r[key] is not None]
            is_ours = name == "Mixed_mesh_3"
            if points:
                axis.plot(*zip(*points), "o-" if is_ours else "o--", color="black" if is_ours else f"C{i}",
                          linewidth=2.5 if is_ours else 1, label=name)
        axis.set(xscale="log", yscale="log", xlabel="vertices", title=title)
        axis.grid(which="both", alpha=0.25)
    axes[0].legend(fontsize=8)
    figure.savefig(options.plot, dpi=110)


if __name__ == "__main__":
    main()
