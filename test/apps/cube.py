# SPDX-License-Identifier: GPL-3.0-or-later
"""The unit cube, and surfaces made of it, as files in OFF."""

CUBE = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def off(points, faces):
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(map(str, p)) for p in points]
    lines += [" ".join(map(str, (len(f), *f))) for f in faces]
    return "\n".join(lines) + "\n"


def moved(points, scale=1, shift=(0, 0, 0)):
    return [tuple(scale * x + s for x, s in zip(p, shift)) for p in points]


def shifted(faces, n):
    return [tuple(v + n for v in f) for f in faces]


def grid_box(n, low, high):
    """A box from one corner to the opposite one; its faces are grids of n x n squares, each of two triangles."""
    numbers, triangles = {}, []
    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        place = [i + a, j + b]
                        place.insert(axis, side)  # of axis 1, the turn is the other one
                        corners.append(numbers.setdefault(tuple(place), len(numbers)))
                    p, q, r, s = corners if (side == n) != (axis == 1) else corners[::-1]
                    triangles += [(p, q, r), (p, r, s)]
    return [tuple(l + (h - l) * x / n for l, h, x in zip(low, high, place)) for place in numbers], triangles
