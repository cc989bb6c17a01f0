# SPDX-License-Identifier: GPL-3.0-or-later
"""Spheres: icosahedra whose triangles are split in four, again and again."""

import math

FACES = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
         (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
GOLDEN = (1 + 5 ** 0.5) / 2
POINTS = [tuple(p[(i + k) % 3] for k in range(3)) for i in (0, 2, 1)
          for p in ((-1, GOLDEN, 0), (1, GOLDEN, 0), (-1, -GOLDEN, 0), (1, -GOLDEN, 0))]


def unit(p):
    return tuple(x / math.hypot(*p) for x in p)


def sphere(radius, splits, center=(0, 0, 0)):
    """Points and triangles, seen from outside."""
    points, faces = [unit(p) for p in POINTS], FACES
    for _ in range(splits):
        middles, finer = {}, []

        def middle(a, b):
            if (min(a, b), max(a, b)) not in middles:
                middles[min(a, b), max(a, b)] = len(points)
                points.append(unit([(x + y) / 2 for x, y in zip(points[a], points[b])]))
            return middles[min(a, b), max(a, b)]

        for a, b, c in faces:
            x, y, z = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, x, z), (b, y, x), (c, z, y), (x, y, z)]
        faces = finer
    return [tuple(c + radius * x for c, x in zip(center, p)) for p in points], faces
