#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes pushed_brain.inp from what brain.py has written into this folder. Then

  ccx pushed_brain

includes the mesh brain.inp, and prints the displacements to pushed_brain.dat.
"""

import pathlib

YOUNG, POISSON = 1.0, 0.25

lines = pathlib.Path("conditions.txt").read_text().splitlines()[1:]
conditions = [(v, axis + 1, value) for v, *u in map(str.split, lines) for axis, value in enumerate(u)]
nodes, _, _ = pathlib.Path("brain.inp").read_text().partition("*ELEMENT")
number_of_nodes = int(nodes.splitlines()[-1].split(",")[0])
text = f"""*INCLUDE, INPUT=brain.inp
*ELSET, ELSET=TISSUE
REGION, REST
*NSET, NSET=ALL, GENERATE
1, {number_of_nodes}
*MATERIAL, NAME=TISSUE
*ELASTIC
{YOUNG}, {POISSON}
*SOLID SECTION, ELSET=TISSUE, MATERIAL=TISSUE
*STEP
*STATIC
*BOUNDARY
""" + "".join(f"{v}, {axis}, {axis}, {float(value):.12g}\n" for v, axis, value in conditions) + """*NODE PRINT, NSET=ALL
U
*END STEP
"""
pathlib.Path("pushed_brain.inp").write_text(text)
