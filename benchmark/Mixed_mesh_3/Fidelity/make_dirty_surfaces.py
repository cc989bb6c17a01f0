#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes surfaces that are not the surface of a solid as they are, but enclose one, named after what is wrong.

  make_dirty_surfaces.py FOLDER [SURFACE.off...]

Each file is FOLDER/NAME.off. FOLDER/surfaces.json has for each the volume that it encloses, within a relative
tolerance; or null for both, if that is not known. They are made from boxes, balls and tori, and from the clean
closed surfaces that are given, triangles only. Needs numpy.
"""

import argparse
import itertools
import json
import math
import pathlib

import numpy as np

from make_surfaces import moved, scaled, turned, united

EXACT = 1e-9  # tolerance of volumes that are known


# ---- what surfaces are made of: pairs of points (n x 3) and triangles (m x 3)


def box(low=(0, 0, 0), high=(1, 1, 1)):
    points = np.array([[(low, high)[b][k] for k, b in enumerate(bits[::-1])]
                       for bits in itertools.product((0, 1), repeat=3)], float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def torus(large, small, n=32, m=16):
    """Around z; a self-intersecting spindle if the small radius is the larger one."""
    u, v = np.meshgrid(np.arange(n) * 2 * math.pi / n, np.arange(m) * 2 * math.pi / m, indexing="ij")
    r = large + small * np.cos(v)
    points = np.stack([r * np.cos(u), r * np.sin(u), small * np.sin(v)], -1).reshape(-1, 3)
    faces = []
    for i, j in itertools.product(range(n), range(m)):
        a, b, c, d = (x % n * m + y % m for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
        faces += [(a, b, c), (a, c, d)]
    return points, np.array(faces)


def ball(n=16):
    """Poles on z."""
    points = [(0, 0, 1)]
    for i, j in itertools.product(range(1, n), range(2 * n)):
        t, p = math.pi * i / n, math.pi * j / n
        points.append((math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t)))
    points.append((0, 0, -1))
    at = lambda i, j: 1 + (i - 1) * 2 * n + j % (2 * n)
    faces = [(0, at(1, j), at(1, j + 1)) for j in range(2 * n)]
    for i, j in itertools.product(range(1, n - 1), range(2 * n)):
        faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    faces += [(len(points) - 1, at(n - 1, j + 1), at(n - 1, j)) for j in range(2 * n)]
    return np.array(points, float), np.array(faces)


def merged(part):
    """Points at the same place become one."""
    points, index = np.unique(part[0], axis=0, return_inverse=True)
    return points, index.reshape(-1)[part[1]]


def volume(part):
    p = part[0] - part[0].mean(axis=0)
    a, b, c = (p[part[1][:, k]] for k in range(3))
    return float((np.cross(a, b) * c).sum() / 6)


def extent(part):
    return np.ptp(part[0], axis=0)


# ---- what can be wrong


def without_star(part, vertex, rings=1):
    """A hole: the faces around a vertex, in so many rings, are gone."""
    inside = {vertex}
    for _ in range(rings - 1):
        inside.update(np.unique(part[1][np.isin(part[1], list(inside)).any(axis=1)]).tolist())
    return part[0], part[1][~np.isin(part[1], list(inside)).any(axis=1)]


def flipped(part, every):
    faces = part[1].copy()
    faces[::every] = faces[::every, ::-1]
    return part[0], faces


def pushed(part, every, far):
    """Vertices moved through the surface, by a share of its extent."""
    points = part[0].copy()
    points[::every] += far * extent(part) * np.array([1, 0.7, -0.4])
    return points, part[1]


def cracked(part, every):
    """Faces whose first edge has a vertex in its middle that the neighbor does not have."""
    points, faces = [tuple(p) for p in part[0]], []
    for n, (a, b, c) in enumerate(part[1].tolist()):
        if n % every:
            faces.append((a, b, c))
            continue
        points.append(tuple((part[0][a] + part[0][b]) / 2))
        faces += [(a, len(points) - 1, c), (len(points) - 1, b, c)]
    return np.array(points), np.array(faces)


def doubled(part, every):
    return part[0], np.vstack([part[1], part[1][::every]])


def fin(part):
    """Faces that stand out of an edge."""
    points = np.vstack([part[0], part[0].max(axis=0) + 0.1 * extent(part)])
    a, b = part[1][0][:2]
    return points, np.vstack([part[1], [(a, b, len(part[0]))]])


def sheet(part):
    """A triangle beside."""
    far = part[0].max(axis=0) + 0.05 * extent(part)
    points = np.vstack([part[0], far + 0.1 * extent(part) * np.array([[0, 0, 0], [1, 0, 0.2], [0, 1, 0.1]])])
    n = len(part[0])
    return points, np.vstack([part[1], [(n, n + 1, n + 2)]])


def copies(part, shift):
    return united(part, moved(part, shift * extent(part)))


def spoiled(name, part, tolerance):
    """Names, surfaces and their volumes, from a clean one."""
    v, n = volume(part), len(part[0])
    far = int(np.argmax(part[0][:, 2]))
    yield f"{name}_hole", without_star(part, far), v, tolerance
    holes = without_star(without_star(part, far), int(np.argmin(part[0][:, 2])))
    yield f"{name}_two_holes", holes, v, 2 * tolerance
    yield f"{name}_large_hole", without_star(part, far, 3), v, 0.3
    yield f"{name}_flipped", flipped(part, 3), v, EXACT
    yield f"{name}_pushed", pushed(part, max(n // 5, 2), 0.15), None, None
    yield f"{name}_copies", copies(part, 0.3), None, None
    yield f"{name}_nearly_same_copies", copies(part, 0.001), v, 0.1
    yield f"{name}_cracked", cracked(part, 7), v, EXACT
    yield f"{name}_doubled", doubled(part, 2), v, EXACT
    yield f"{name}_fin", fin(part), v, EXACT
    yield f"{name}_sheet", sheet(part), v, EXACT


def by_hand():
    cube = box()
    yield "cube_without_face", (cube[0], cube[1][2:]), 1, EXACT
    yield "cube_without_two_triangles", (cube[0], cube[1][[0, 2, 4, 5, 6, 7, 8, 9, 10, 11]]), 1, 0.35
    yield "cubes_edge", merged(united(cube, moved(cube, (1, 1, 0)))), 2, EXACT
    yield "cubes_vertex", merged(united(cube, moved(cube, (1, 1, 1)))), 2, EXACT
    wall = merged(united(cube, moved(cube, (1, 0, 0))))
    yield "cubes_two_walls", wall, 2, EXACT
    keys = [tuple(sorted(t)) for t in wall[1].tolist()]
    yield "cubes_wall", (wall[0], wall[1][[i for i, k in enumerate(keys) if k not in keys[:i]]]), 2, EXACT
    yield "cubes_face_to_face", united(cube, moved(cube, (1, 0, 0))), 2, EXACT
    yield "cubes_part_of_face", united(cube, moved(cube, (1, 0.25, 0.5))), 2, EXACT
    yield "cubes_in_plane", united(cube, moved(cube, (0.5, 0, 0))), 1.5, EXACT
    yield "cubes_cut", united(cube, moved(cube, (0.5, 0.25, 0.125))), 2 - 0.5 * 0.75 * 0.875, EXACT
    yield "cubes_turned", turned(united(cube, moved(cube, (0.5, 0.25, 0.125)))), 2 - 0.5 * 0.75 * 0.875, EXACT
    cross = [box((-1.5 * (k == 0) - 0.5, -1.5 * (k == 1) - 0.5, -1.5 * (k == 2) - 0.5),
                 (1.5 * (k == 0) + 0.5, 1.5 * (k == 1) + 0.5, 1.5 * (k == 2) + 0.5)) for k in range(3)]
    yield "cross_of_beams", united(*cross), 10, EXACT
    yield "cross_of_beams_turned", turned(united(*cross)), 10, EXACT
    yield "row_of_cubes", united(*[moved(cube, (0.75 * i, 0, 0)) for i in range(6)]), 1 + 5 * 0.75, EXACT
    yield "spindle_torus", torus(0.4, 0.6), None, None
    yield "two_tori_linked_cut", united(torus(1, 0.4), moved(turned(torus(1, 0.4), (math.pi / 2, 0, 0)), (0.5, 0, 0))), \
        None, None
    yield "balls", united(ball(), moved(ball(), (0.9, 0.1, 0.2)), moved(ball(), (0.3, 0.8, 0))), None, None
    yield "ball_and_cavity_cut", united(scaled(ball(), (2, 2, 2)), moved(scaled(box(), (9, 1, 1)), (0, 0, 0))), None, None
    yield "one_inside_out", united(cube, moved((cube[0], cube[1][:, ::-1]), (0.5, 0.25, 0.125))), \
        2 - 0.5 * 0.75 * 0.875, EXACT
    flat = (cube[0] * np.array([1, 1, 1e-3]), cube[1])
    yield "plates_crossing", united(moved(flat, (0, 0, 0.5)), moved((flat[0][:, [2, 0, 1]], cube[1]), (0.5, 0, 0))), \
        2e-3 - 1e-6, EXACT


def read_off(path):
    words = path.read_text().split("\n", 1)[1].split()
    n, m = int(words[0]), int(words[1])
    points = np.array(words[3:3 + 3 * n], float).reshape(-1, 3)
    faces = np.array(words[3 + 3 * n:3 + 3 * n + 4 * m], int).reshape(-1, 4)
    assert (faces[:, 0] == 3).all(), f"{path}: not all faces are triangles"
    return points, faces[:, 1:]


def write_off(path, part):
    lines = ["OFF", f"{len(part[0])} {len(part[1])} 0"]
    lines += [" ".join(map(repr, map(float, p))) for p in part[0]]
    lines += ["3 " + " ".join(map(str, t)) for t in np.asarray(part[1]).tolist()]
    path.write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("surfaces", nargs="*", type=pathlib.Path, metavar="SURFACE.off")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    made = [by_hand(), spoiled("ball", ball(), 0.02), spoiled("torus", torus(1, 0.4), 0.02)]
    made += [spoiled(path.stem, read_off(path), 0.02) for path in args.surfaces]
    facts = {}
    for name, part, v, tolerance in itertools.chain(*made):
        write_off(args.folder / f"{name}.off", part)
        facts[name] = {"volume": v, "tolerance": tolerance}
    (args.folder / "surfaces.json").write_text(json.dumps(facts, indent=1) + "\n")
    print(f"{len(facts)} surfaces in {args.folder}")


if __name__ == "__main__":
    main()
