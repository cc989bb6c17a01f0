# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces of elements, by meshio's names: local vertices, counter-clockwise seen from outside."""

ELEMENT_FACES = {"tetra": [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
                 "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
                 "wedge": [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
                 "hexahedron": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}
