#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the folders of include/CGAL, and which includes which, into ARCHITECTURE.md, as a graph of Mermaid.

  scripts/draw_architecture.py             writes the graph between the markers in ARCHITECTURE.md
  scripts/draw_architecture.py --check     changes nothing, and fails if the graph is not that of the includes

An arrow from A to B: a header of A includes one of B, or reaches it through public headers. Arrows that follow from
others are left out (transitive reduction), and so are those to public headers.
"""

import pathlib
import re
import sys

from check_layers import ENTRY, MEASURES, MODELS, SERVICES, VOCABULARY, chains_from, folder_of, read_includes

ROOT = pathlib.Path(__file__).resolve().parent.parent
TEXT = ROOT / "ARCHITECTURE.md"
BLOCK = re.compile(r"(<!-- graph of the includes -->\n)(.*?)(<!-- end of graph -->\n)", re.DOTALL)

# What a folder or a group of public headers is for.
PURPOSES = {
    "base": "vectors, lattice points, threads",
    "elements": "measures of elements and faces",
    "oracle": "domain and region without templates",
    "surface": "exact queries, distances",
    "octree": "which cells are split",
    "transitions": "templates for hanging vertices",
    "boundary": "boundary stage, assembly of the mesh",
    "fem": "element matrices",
    "moves": "flips, edge collapses",
    "fitting": "onto the surface, optimization",
    "meshing": "the list of stages",
    "resection": "elements removed",
    "repair": "the solid that triangles enclose",
    "IO": "files",
    "Linear_elasticity_3": "displacements",
    "Mixed_mesh_image_3": "images",
    "Mixed_mesh_petsc": "a solver for many processes",
    SERVICES: "validation, fidelity, resect()",
    ENTRY: "make_mixed_mesh_3() and others",
}
# Groups of public headers that are not drawn: arrows lead through them.
NOT_DRAWN = {VOCABULARY, MEASURES, MODELS}


def arrows_between_folders(includes):
    """For each folder, the others that its headers reach with nothing but public headers between."""
    arrows = {folder: set() for folder in PURPOSES}
    for header in includes:
        for other, chain in chains_from(header, includes).items():
            if {folder_of(name) for name in chain[1:-1]} <= NOT_DRAWN and folder_of(header) not in NOT_DRAWN:
                arrows[folder_of(header)].add(folder_of(other))
    return {folder: others - {folder, *NOT_DRAWN} for folder, others in arrows.items()}


def reduced(arrows):
    """Without arrows that follow from others; the arrows have no circle."""
    def reached_from(folder):
        return arrows[folder].union(*map(reached_from, arrows[folder]))

    return {folder: {other for other in others
                     if not any(other in reached_from(between) for between in others - {other})}
            for folder, others in arrows.items()}


def graph():
    arrows = reduced(arrows_between_folders(read_includes(ROOT)))
    names = {folder: folder.replace(" ", "_") for folder in PURPOSES}
    lines = ["```mermaid", "flowchart TD"]
    lines += [f'  {names[folder]}["<b>{folder}</b><br>{PURPOSES[folder]}"]' for folder in PURPOSES]
    lines += [f"  {names[folder]} --> {names[other]}" for folder in PURPOSES for other in PURPOSES
              if other in arrows[folder]]
    return "\n".join([*lines, "```", ""])


def main():
    arguments = sys.argv[1:]
    if arguments not in ([], ["--check"]):
        sys.exit(__doc__)
    text = TEXT.read_text()
    if len(BLOCK.findall(text)) != 1:
        sys.exit("ARCHITECTURE.md: no place for the graph: expected its two markers, once")
    drawn = BLOCK.sub(lambda block: block[1] + graph() + block[3], text)
    if not arguments:
        TEXT.write_text(drawn)
    elif drawn != text:
        sys.exit("ARCHITECTURE.md: the graph is not that of the includes; run scripts/draw_architecture.py")


if __name__ == "__main__":
    main()
