#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the stages of the method, and the ways through them, for the manual.

  scripts/pictures/draw_stages.py FILE      FILE is doc/Mixed_mesh_3/fig/stages.svg

The stages are those of include/CGAL/Mixed_mesh_3/internal/meshing/run_stages.h. Needs no package.
"""

import html
import pathlib
import sys

WIDTH, MARGIN, GAP = 1120, 10, 12
COLUMN = (WIDTH - 2 * MARGIN - 4 * GAP) / 5
LINE = 15
# As the kinds of elements in draw_manual.py.
BLUE, YELLOW, ORANGE, VIOLET, GRAY = "#d3e4f1", "#fdeecb", "#f7d6c8", "#dfd6ea", "#ececec"

# Rows from top to bottom: height, and boxes with their first and last column, color and lines. A line that begins
# with * is bold.
ROWS = (
    (44, ((0, 4, GRAY, ("*domain, region, budget of N vertices, criteria", "make_mixed_mesh_3()")),)),
    (94, (
        (0, 0, BLUE, ("*lattice planes", "all facets perpendicular", "to the axes,", "no region")),
        (1, 1, BLUE, ("*fine mesh on the lattice", "one subdomain,", "no region")),
        (2, 2, BLUE, ("*fine mesh, cut", "a region, or several", "subdomains, or the", "mesh on the left is wrong")),
        (3, 3, BLUE, ("*octree of the budget", "sheets, base level given,", "grading 0, or", "no simplification,",
                      "or no fine mesh")),
        (4, 4, BLUE, ("*Algorithm 1", "the alternative of the", "paper, with", "fit_to_surface(false)")),
    )),
    (64, (
        (0, 0, YELLOW, ("*layers between planes", "of one width in each slab")),
        (1, 1, YELLOW, ("*octree", "up to 4 N vertices,", "finer at sharp edges")),
        (2, 2, YELLOW, ("*octree", "finer at walls, layers and", "outside the region")),
        (3, 3, YELLOW, ("*octree", "cells split for the", "tolerance; up to 0.92 N")),
        (4, 4, YELLOW, ("*octree", "up to N vertices")),
    )),
    (30, ((1, 4, YELLOW, ("*transition templates",)),)),
    (48, (
        (1, 1, YELLOW, ("*boundary stage", "then tetrahedra only")),
        (2, 2, YELLOW, ("*cut along surfaces", "vertices on interfaces")),
        (3, 4, YELLOW, ("*boundary stage", "by one order of all vertices, or by parity as in the paper; sheets")),
    )),
    (34, ((1, 2, ORANGE, ("*rough fit: boundary onto surface and sharp edges",)),)),
    (48, ((1, 2, ORANGE, ("*edge collapses", "least loss first, down to 0.92 N vertices")),)),
    (64, (
        (1, 3, ORANGE, ("*optimization: optimize_mixed_mesh_3()",
                        "targets, arrival, rounds of moves and flips with bisections up to N vertices,",
                        "vertices of intersecting faces move back, mending, merging")),
        (4, 4, ORANGE, ("*Algorithm 1", "fit_mixed_mesh_", "to_surface()")),
    )),
    (48, ((0, 3, VIOLET, ("*comparison with the domain",
                          "topology, lost parts, volume, arrival, sharp edges, distance, bound on quality; status")),)),
    (34, ((0, 4, GRAY, ("*Mixed_mesh_3, certified; Mixed_mesh_result_3 or Mixed_mesh_fit_result_3",)),)),
)


def left(column):
    return MARGIN + column * (COLUMN + GAP)


def draw_box(first, last, top, height, color, lines):
    x, width = left(first), (last - first) * (COLUMN + GAP) + COLUMN
    yield (f'<rect x="{x:.1f}" y="{top}" width="{width:.1f}" height="{height}" rx="6" fill="{color}" '
           'stroke="#555555"/>')
    y = top + (height - LINE * len(lines)) / 2 + 0.75 * LINE
    for line in lines:
        weight = ' font-weight="bold"' if line.startswith("*") else ""
        yield f'<text x="{x + width / 2:.1f}" y="{y:.1f}"{weight}>{html.escape(line.lstrip("*"))}</text>'
        y += LINE


def arrow(x1, y1, x2, y2):
    return f'<line x1="{x1:.1f}" y1="{y1}" x2="{x2:.1f}" y2="{y2}" stroke="#555555" marker-end="url(#head)"/>'


def draw():
    space = 16
    lines, tops, top = [], [], MARGIN
    for height, boxes in ROWS:
        tops.append(top)
        for first, last, color, text in boxes:
            lines += draw_box(first, last, top, height, color, text)
        top += height + space
    # An arrow in each column from box to box, and between ways: what comes next if a mesh is wrong.
    for column in range(5):
        rows = [i for i, (_, boxes) in enumerate(ROWS) if any(b[0] <= column <= b[1] for b in boxes)]
        for i, j in zip(rows, rows[1:]):
            x = left(column) + COLUMN / 2
            lines.append(arrow(x, tops[i] + ROWS[i][0], x, tops[j]))
    middle = tops[1] + 12
    lines += [arrow(left(column) + COLUMN, middle, left(column + 1), middle) for column in (1, 2)]
    return [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {top - space + MARGIN}" width="{WIDTH}" '
        f'height="{top - space + MARGIN}" font-family="Helvetica, Arial, sans-serif" font-size="12" '
        'text-anchor="middle">',
        "<!-- SPDX-FileCopyrightText: 2026 The Mixed_mesh_3 authors -->",
        "<!-- SPDX-License-Identifier: GPL-3.0-or-later -->",
        '<defs><marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0 L8 4 L0 8 z" fill="#555555"/></marker></defs>',
        '<rect width="100%" height="100%" fill="white"/>',
        *lines,
        "</svg>",
    ]


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    pathlib.Path(sys.argv[1]).write_text("\n".join(draw()) + "\n")


if __name__ == "__main__":
    main()
