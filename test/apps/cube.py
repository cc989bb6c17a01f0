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
