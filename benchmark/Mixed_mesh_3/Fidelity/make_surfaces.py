#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes closed surfaces that are hard to mesh with few vertices, named after what is hard.

  make_surfaces.py FOLDER

Each file is FOLDER/NAME.off: closed, a manifold, free of self-intersections, oriented outwards; and
FOLDER/surfaces.json says how many bodies, handles and cavities each one has. Lengths are about 1. Needs numpy.
"""

import argparse
import json
import math
import pathlib

import numpy as np

SURFACES = {}


def surface(name, bodies=1, handles=0, cavities=0):
    """Registers a function that returns points and triangles."""

    def register(make):
        assert name not in SURFACES
        SURFACES[name] = (make, {"bodies": bodies, "handles": handles, "cavities": cavities})
        return make

    return register


# ---- what surfaces are made of: pairs of points (n x 3) and triangles (m x 3)


def united(*parts):
    """Surfaces that do not meet, as one."""
    offsets = np.cumsum([0] + [len(p) for p, _ in parts[:-1]])
    return (np.vstack([p for p, _ in parts]),
            np.vstack([np.asarray(t) + o for (_, t), o in zip(parts, offsets)]))


def reversed_(part):
    """The same with its inside outside: a cavity."""
    return part[0], np.asarray(part[1])[:, ::-1]


def moved(part, by):
    return part[0] + np.asarray(by, float), part[1]


def scaled(part, by):
    return part[0] * np.asarray(by, float), part[1]


def turned(part, angles=(0.31, 0.47, 0.73)):
    """About x, y and z; no axis is parallel to anything then."""
    points = part[0]
    for k, a in enumerate(angles):
        i, j = (k + 1) % 3, (k + 2) % 3
        rotation = np.eye(3)
        rotation[i, i] = rotation[j, j] = math.cos(a)
        rotation[i, j], rotation[j, i] = -math.sin(a), math.sin(a)
        points = points @ rotation.T
    return points, part[1]


def bent(part, radius):
    """x becomes the angle around an axis parallel to y."""
    x, y, z = part[0].T
    r = radius + z
    return np.column_stack([r * np.sin(x / radius), y, r * np.cos(x / radius)]), part[1]


def twisted(part, turns_by_length):
    x, y, z = part[0].T
    a = 2 * math.pi * turns_by_length * z
    return np.column_stack([x * np.cos(a) - y * np.sin(a), x * np.sin(a) + y * np.cos(a), z]), part[1]


def blocks(xs, ys, zs, is_solid):
    """The boundary of some cells of a grid: `is_solid(i, j, k)`."""
    n = (len(xs) - 1, len(ys) - 1, len(zs) - 1)
    solid = np.zeros([k + 2 for k in n], bool)
    for i in range(n[0]):
        for j in range(n[1]):
            for k in range(n[2]):
                solid[i + 1, j + 1, k + 1] = is_solid(i, j, k)
    points, index, triangles = [], {}, []

    def vertex(c):
        if c not in index:
            index[c] = len(points)
            points.append((xs[c[0]], ys[c[1]], zs[c[2]]))
        return index[c]

    for cell in zip(*np.nonzero(solid)):
        for axis in range(3):
            for side in (-1, 1):
                other = list(cell)
                other[axis] += side
                if solid[tuple(other)]:
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                base = [int(c) - 1 for c in cell]
                base[axis] += side > 0
                corners = []
                for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    c = list(base)
                    c[u] += a
                    c[v] += b
                    corners.append(vertex(tuple(c)))
                if side < 0:
                    corners.reverse()
                triangles += [corners[:3], [corners[0], corners[2], corners[3]]]
    return np.array(points, float), np.array(triangles)


def box(size, center=(0, 0, 0), pieces=(1, 1, 1)):
    lines = [c + s * np.linspace(-0.5, 0.5, n + 1) for s, c, n in zip(size, center, pieces)]
    return blocks(*lines, lambda i, j, k: True)


def ball(radius, center=(0, 0, 0), n=24):
    """By meridians and parallels."""
    points = [(0, 0, radius)]
    for i in range(1, n):
        a = math.pi * i / n
        for j in range(2 * n):
            b = math.pi * j / n
            points.append((radius * math.sin(a) * math.cos(b), radius * math.sin(a) * math.sin(b),
                           radius * math.cos(a)))
    points.append((0, 0, -radius))
    m = 2 * n
    triangles = []
    for j in range(m):
        k = (j + 1) % m
        triangles.append((0, 1 + j, 1 + k))
        for i in range(n - 2):
            a, b = 1 + i * m, 1 + (i + 1) * m
            triangles += [(a + j, b + j, b + k), (a + j, b + k, a + k)]
        triangles.append((1 + (n - 2) * m + j, len(points) - 1, 1 + (n - 2) * m + k))
    return np.array(points) + np.asarray(center, float), np.array(triangles)


def tube(line, radius, n=16, closed=False):
    """Around a curve; `radius` may be a number or one for each point. The frame is carried along."""
    line = np.asarray(line, float)
    m = len(line)
    radius = np.broadcast_to(radius, (m,))
    ahead = np.roll(line, -1, 0) - np.roll(line, 1, 0)
    if not closed:
        ahead[0], ahead[-1] = line[1] - line[0], line[-1] - line[-2]
    ahead /= np.linalg.norm(ahead, axis=1)[:, None]
    normal = np.cross(ahead[0], [0.3, 0.5, 0.8])
    normals = []
    for t in ahead:
        normal = normal - t * (normal @ t)
        normal /= np.linalg.norm(normal)
        normals.append(normal)
    normals = np.array(normals)
    if closed:  # what the frame has turned by is spread over the curve
        last = normals[-1] - ahead[0] * (normals[-1] @ ahead[0])
        turn = math.atan2(np.cross(last, normals[0]) @ ahead[0], last @ normals[0])
    else:
        turn = 0
    points = []
    for i in range(m):
        binormal = np.cross(ahead[i], normals[i])
        for j in range(n):
            a = 2 * math.pi * j / n + turn * i / (m - 1 if m > 1 else 1)
            points.append(line[i] + radius[i] * (math.cos(a) * normals[i] + math.sin(a) * binormal))
    triangles = []
    for i in range(m if closed else m - 1):
        for j in range(n):
            a, b = i * n + j, i * n + (j + 1) % n
            c, d = (i + 1) % m * n + j, (i + 1) % m * n + (j + 1) % n
            triangles += [(a, b, d), (a, d, c)]
    if not closed:
        points += [line[0], line[-1]]
        first, last = len(points) - 2, len(points) - 1
        for j in range(n):
            k = (j + 1) % n
            triangles += [(first, k, j), (last, (m - 1) * n + j, (m - 1) * n + k)]
    return np.array(points), np.array(triangles)


def circle(radius, n=64, center=(0, 0, 0)):
    a = 2 * np.pi * np.arange(n) / n
    return np.column_stack([radius * np.cos(a), radius * np.sin(a), 0 * a]) + np.asarray(center, float)


def torus(radius, small, n=64, m=24):
    return tube(circle(radius, n), small, m, closed=True)


def helix(radius, pitch, turns, radius_of_wire, n_turn=32, m=12):
    a = np.linspace(0, 2 * np.pi * turns, int(n_turn * turns) + 1)
    return tube(np.column_stack([radius * np.cos(a), radius * np.sin(a), pitch * a / (2 * np.pi)]), radius_of_wire, m)


def knot(p, q, radius_of_wire, n=160, m=12):
    a = 2 * np.pi * np.arange(n) / n
    r = 1 + 0.45 * np.cos(q * a)
    return tube(np.column_stack([r * np.cos(p * a), r * np.sin(p * a), 0.45 * np.sin(q * a)]), radius_of_wire, m,
                closed=True)


def turned_profile(profile, n=48):
    """Of a closed polygon of (radius, height), counter-clockwise, off the axis; a ring."""
    profile = np.asarray(profile, float)
    m = len(profile)
    points = [(r * math.cos(2 * math.pi * j / n), r * math.sin(2 * math.pi * j / n), z)
              for j in range(n) for r, z in profile]
    triangles = []
    for j in range(n):
        for i in range(m):
            a, b = j * m + i, j * m + (i + 1) % m
            c, d = (j + 1) % n * m + i, (j + 1) % n * m + (i + 1) % m
            triangles += [(a, d, b), (a, c, d)]
    return np.array(points), np.array(triangles)


def lathe(profile, n=48):
    """Of an open polygon of (radius, height) that starts and ends on the axis, counter-clockwise."""
    inner = profile[1:-1]
    m = len(inner)
    points = [(r * math.cos(2 * math.pi * j / n), r * math.sin(2 * math.pi * j / n), z)
              for j in range(n) for r, z in inner]
    points += [(0, 0, profile[0][1]), (0, 0, profile[-1][1])]
    first, last = len(points) - 2, len(points) - 1
    triangles = []
    for j in range(n):
        k = (j + 1) % n
        for i in range(m - 1):
            a, b, c, d = j * m + i, j * m + i + 1, k * m + i, k * m + i + 1
            triangles += [(a, d, b), (a, c, d)]
        triangles += [(first, k * m, j * m), (last, j * m + m - 1, k * m + m - 1)]
    return np.array(points, float), np.array(triangles)


def ring_of(outline, height, hole=None):
    """A prism over a polygon around the origin, star-shaped; with a hole of as many vertices."""
    outline = np.asarray(outline, float)
    n = len(outline)
    if hole is None:
        points = np.vstack([np.column_stack([outline, np.full(n, z)]) for z in (0, height)]
                           + [[[0, 0, 0], [0, 0, height]]])
        low, high = 2 * n, 2 * n + 1
        triangles = []
        for i in range(n):
            j = (i + 1) % n
            triangles += [(i, j, n + j), (i, n + j, n + i), (low, j, i), (high, n + i, n + j)]
        return points, np.array(triangles)
    points = np.vstack([np.column_stack([p, np.full(n, z)]) for p in (outline, np.asarray(hole, float))
                        for z in (0, height)])
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        for a, b in ((0, n), (n, 3 * n), (3 * n, 2 * n), (2 * n, 0)):
            triangles += [(a + i, a + j, b + j), (a + i, b + j, b + i)]
    return points, np.array(triangles)


def gear(teeth, depth, height, hole=None):
    angles, radii = [], []
    for i in range(teeth):
        for share, r in ((0, 1 - depth), (0.25, 1 - depth), (0.35, 1), (0.65, 1), (0.75, 1 - depth)):
            angles.append(2 * math.pi * (i + share) / teeth)
            radii.append(r)
    a, r = np.array(angles), np.array(radii)
    outline = np.column_stack([r * np.cos(a), r * np.sin(a)])
    return ring_of(outline, height, None if hole is None else hole * np.column_stack([np.cos(a), np.sin(a)]))


def lines(*steps):
    return np.concatenate([[0], np.cumsum(steps)])


def perforated(nx, ny, bar, hole, thickness):
    """A plate with nx times ny square holes."""
    x = lines(bar, *([hole, bar] * nx))
    y = lines(bar, *([hole, bar] * ny))
    return blocks(x, y, [0, thickness], lambda i, j, k: i % 2 == 0 or j % 2 == 0)


def tunnels(n, bar, hole):
    """A cube with n times n square tunnels along each axis, which meet."""
    x = lines(bar, *([hole, bar] * n))
    return blocks(x, x, x, lambda i, j, k: (i % 2) + (j % 2) + (k % 2) < 2)


def comb(teeth, width, gap, height, back, depth):
    x = lines(width, *([gap, width] * (teeth - 1)))
    return blocks(x, [0, depth], [0, back, back + height], lambda i, j, k: k == 0 or i % 2 == 0)


def clamp(gap, size=1.0, wall=0.3):
    """A block with a slot."""
    return blocks([0, wall, size], [0, size], lines(wall, gap, wall), lambda i, j, k: i == 0 or k != 1)


# ---- thin walls

for _thickness in (0.2, 0.1, 0.05, 0.02):
    surface(f"plate_{_thickness}")(lambda t=_thickness: box((1, 1, t)))
    surface(f"plate_turned_{_thickness}")(lambda t=_thickness: turned(box((1, 1, t))))
for _thickness in (0.1, 0.05, 0.025):
    surface(f"shell_open_{_thickness}")(lambda t=_thickness: lathe(
        [(0, -1)] + [(math.sin(a), -math.cos(a)) for a in np.linspace(0, 1.9, 24)[1:]]
        + [((1 - t) * math.sin(a), -(1 - t) * math.cos(a)) for a in np.linspace(1.9, 0, 24)[:-1]] + [(0, t - 1)]))
    surface(f"shell_closed_{_thickness}", cavities=1)(
        lambda t=_thickness: united(ball(1), reversed_(ball(1 - t))))
    surface(f"pipe_{_thickness}", handles=1)(lambda t=_thickness: turned(turned_profile(
        [(0.4 - t, -1), (0.4, -1), (0.4, 1), (0.4 - t, 1)])))
for _thickness in (0.08, 0.04):
    surface(f"box_open_{_thickness}")(lambda t=_thickness: turned(blocks(
        lines(t, 1 - 2 * t, t), lines(t, 1 - 2 * t, t), lines(t, 1 - t),
        lambda i, j, k: k == 0 or i != 1 or j != 1)))
    surface(f"sheet_bent_{_thickness}")(lambda t=_thickness: turned(bent(
        moved(box((2.4, 1, t), pieces=(32, 1, 1)), (0, 0, 0)), 0.8)))
    surface(f"cross_of_plates_{_thickness}")(lambda t=_thickness: turned(blocks(
        lines(0.5, t, 0.5), lines(0.5, t, 0.5), [0, 1], lambda i, j, k: i == 1 or j == 1)))
surface("ribbon_twisted")(lambda: twisted(box((0.6, 0.06, 2), pieces=(1, 1, 40)), 0.5))
surface("wedge_to_nothing")(lambda: (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, .3], [0, 1, .3]], float),
                                     np.array([[0, 3, 1], [0, 2, 3], [0, 1, 4], [2, 5, 3], [0, 4, 5], [0, 5, 2],
                                               [1, 3, 5], [1, 5, 4]])))
surface("disk_lens")(lambda: scaled(ball(1), (1, 1, 0.08)))
surface("bowl_rim")(lambda: lathe([(0, 0), (0.5, 0.02), (0.9, 0.35), (1, 0.8), (0.96, 0.8), (0.85, 0.4), (0.48, 0.1),
                                   (0, 0.08)]))
surface("i_beam")(lambda: turned(blocks(lines(0.22, 0.06, 0.22), [0, 2], lines(0.06, 0.5, 0.06),
                                        lambda i, j, k: i == 1 or k != 1)))
surface("stairs_thin")(lambda: turned(blocks(np.linspace(0, 1, 7), [0, 0.5], np.linspace(0, 1, 7),
                                             lambda i, j, k: k in (i, i + 1) or k + 1 == i)))

# ---- hair, needles

for _radius in (0.1, 0.05, 0.02):
    surface(f"rod_{_radius}")(lambda r=_radius: turned(tube([(0, 0, z) for z in np.linspace(-1, 1, 20)], r)))
for _radius in (0.06, 0.03):
    surface(f"hair_on_ball_{_radius}")(lambda r=_radius: turned(lathe(
        [(0, -0.5)] + [(0.5 * math.sin(a), -0.5 * math.cos(a)) for a in np.linspace(0, math.pi - 1.05 * math.asin(r / 0.5), 24)[1:]]
        + [(r, z) for z in np.linspace(0.5, 1.4, 12)] + [(0, 1.4)])))
surface("needle_cone")(lambda: turned(lathe([(0, 0), (0.12, 0)] + [(0.12 * (1 - s), 2 * s) for s in np.linspace(0.05, 0.95, 18)]
                                            + [(0, 2)])))
surface("ellipsoid_needle")(lambda: turned(scaled(ball(1), (0.06, 0.06, 1))))
surface("dumbbell_thin_handle")(lambda: turned(lathe(
    [(0, -1)] + [(0.4 * math.sin(a), -0.6 - 0.4 * math.cos(a)) for a in np.linspace(0.1, 3.0, 20)]
    + [(0.05, z) for z in np.linspace(-0.15, 0.15, 6)]
    + [(0.4 * math.sin(a), 0.6 - 0.4 * math.cos(a)) for a in np.linspace(0.14, 3.04, 20)] + [(0, 1)])))
surface("frame_of_rods", handles=5)(lambda: blocks(
    lines(0.08, 0.84, 0.08), lines(0.08, 0.84, 0.08), lines(0.08, 0.84, 0.08),
    lambda i, j, k: (i == 1) + (j == 1) + (k == 1) < 2))
surface("star_of_spikes")(lambda: spikes())
surface("tripod")(lambda: turned(blocks(lines(0.1, 0.8, 0.1), lines(0.1, 0.8, 0.1), lines(0.8, 0.1),
                                        lambda i, j, k: k == 1 or (i, j) in ((0, 0), (2, 0), (0, 2)))))


def spikes():
    """Twelve spikes on a ball: vertices of a fine ball move out."""
    points, triangles = ball(0.4, n=32)
    directions = np.array([(s * a, t * b, 0) for s in (1, -1) for t in (1, -1) for a, b in ((1, 1.618),)])
    directions = np.vstack([np.roll(directions, k, 1) for k in range(3)])
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    unit = points / 0.4
    closest = (unit @ directions.T).max(1)
    r = 0.4 + 0.6 * np.maximum(0, (closest - 0.97) / 0.03)
    return unit * r[:, None], triangles


# ---- gaps

for _gap in (0.2, 0.1, 0.05, 0.02):
    surface(f"balls_apart_{_gap}", bodies=2)(
        lambda g=_gap: united(ball(0.5, (-0.5 - g / 2, 0.07, 0.03)), ball(0.5, (0.5 + g / 2, 0.07, 0.03))))
for _gap in (0.1, 0.05, 0.02):
    surface(f"blocks_apart_{_gap}", bodies=2)(
        lambda g=_gap: turned(united(box((1, 1, 0.5), (0, 0, -0.25 - g / 2)), box((1, 1, 0.5), (0, 0, 0.25 + g / 2)))))
    surface(f"slot_{_gap}")(lambda g=_gap: turned(clamp(g)))
for _gap in (0.08, 0.04):
    surface(f"c_ring_{_gap}")(lambda g=_gap: turned(bent(
        box((2 * math.pi - g / 0.6, 0.4, 0.35), pieces=(48, 1, 1)), 1.0)))
    surface(f"pin_in_hole_{_gap}", bodies=2, handles=1)(lambda g=_gap: turned(united(
        turned_profile([(0.3, -0.3), (0.8, -0.3), (0.8, 0.3), (0.3, 0.3)]),
        lathe([(0, -0.5), (0.3 - g, -0.5), (0.3 - g, 0.5), (0, 0.5)]))))
    surface(f"comb_{_gap}")(lambda g=_gap: turned(comb(5, 0.15, g, 0.6, 0.2, 0.4)))
surface("fork_two_prongs")(lambda: turned(comb(2, 0.1, 0.1, 1.2, 0.2, 0.1)))
surface("four_balls_near", bodies=4)(lambda: united(*[ball(0.4, (0.43 * s, 0.43 * t, 0.43 * u), 16) for s, t, u in
                                                      ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))]))
surface("rolled_sheet")(lambda: rolled())
surface("chain_of_two_links", bodies=2, handles=2)(lambda: united(
    torus(0.6, 0.15), moved((torus(0.6, 0.15)[0][:, [0, 2, 1]], torus(0.6, 0.15)[1][:, ::-1]), (0.6, 0, 0))))


def rolled():
    """A sheet in a spiral, with gaps as wide as it is thick."""
    part = box((1, 0.8, 0.1), pieces=(72, 1, 1))
    s = part[0][:, 0] + 0.5
    a = 2 * math.pi * 2.2 * s
    r = 0.35 + 0.2 / (2 * math.pi) * a + part[0][:, 2]
    return np.column_stack([r * np.sin(a), part[0][:, 1], r * np.cos(a)]), part[1]


# ---- holes

for _hole in (0.2, 0.1, 0.05):
    surface(f"torus_narrow_hole_{_hole}", handles=1)(lambda h=_hole: torus(0.4 + h / 2, 0.4))
    surface(f"block_drilled_{_hole}", handles=1)(lambda h=_hole: turned(turned_profile(
        [(h / 2, -0.3), (0.5, -0.3), (0.5, 0.3), (h / 2, 0.3)])))
surface("torus_thin", handles=1)(lambda: turned(torus(1, 0.06)))
surface("plate_9_holes", handles=9)(lambda: perforated(3, 3, 0.15, 0.15, 0.15))
surface("plate_25_holes", handles=25)(lambda: turned(perforated(5, 5, 0.12, 0.1, 0.12)))
surface("plate_64_holes", handles=64)(lambda: perforated(8, 8, 0.07, 0.07, 0.07))
surface("cube_3_tunnels", handles=5)(lambda: turned(tunnels(1, 0.35, 0.3)))
surface("cube_3_narrow_tunnels", handles=5)(lambda: turned(tunnels(1, 0.45, 0.1)))
surface("cube_12_tunnels", handles=28)(lambda: tunnels(2, 0.2, 0.2))
surface("ladder", handles=6)(lambda: turned(perforated(1, 6, 0.08, 0.3, 0.08)))
surface("pretzel", handles=3)(lambda: turned(perforated(3, 1, 0.2, 0.2, 0.2)))
surface("knot_2_3", handles=1)(lambda: knot(2, 3, 0.15))
surface("knot_2_3_thin", handles=1)(lambda: knot(2, 3, 0.06))
surface("knot_3_5", handles=1)(lambda: knot(3, 5, 0.1, 240))
surface("bead_on_a_ring", bodies=2, handles=2)(lambda: united(
    torus(0.8, 0.1), moved((torus(0.25, 0.1)[0][:, [0, 2, 1]], torus(0.25, 0.1)[1][:, ::-1]), (0.8, 0, 0))))

# ---- springs

for _radius in (0.15, 0.08, 0.05):
    surface(f"spring_{_radius}")(lambda r=_radius: helix(0.5, max(0.35, 3 * r), 3, r))
surface("spring_tight")(lambda: helix(0.5, 0.25, 4, 0.1))
surface("spiral_flat")(lambda: tube([((0.1 + 0.05 * a) * math.cos(a), (0.1 + 0.05 * a) * math.sin(a), 0)
                                     for a in np.linspace(0, 16, 120)], 0.08))

# ---- gears and stars

surface("gear_12")(lambda: gear(12, 0.2, 0.3))
surface("gear_24_hole", handles=1)(lambda: turned(gear(24, 0.12, 0.2, 0.3)))
surface("gear_40_thin", handles=1)(lambda: turned(gear(40, 0.08, 0.1, 0.5)))
surface("star_sharp")(lambda: turned(ring_of([((1 if i % 2 else 0.35) * math.cos(math.pi * i / 7),
                                               (1 if i % 2 else 0.35) * math.sin(math.pi * i / 7)) for i in range(14)], 0.25)))

# ---- nested

surface("balls_nested", bodies=2, cavities=1)(lambda: united(ball(1), reversed_(ball(0.8)), ball(0.6)))
surface("balls_nested_narrow", bodies=2, cavities=1)(lambda: united(ball(1), reversed_(ball(0.7)), ball(0.64)))
surface("balls_nested_4", bodies=2, cavities=2)(
    lambda: united(ball(1), reversed_(ball(0.8)), ball(0.6), reversed_(ball(0.4))))
surface("void_small", cavities=1)(lambda: united(ball(1), reversed_(ball(0.12, (0.31, 0.2, 0.1), 12))))
surface("void_near_wall", cavities=1)(lambda: united(ball(1), reversed_(ball(0.3, (0.62, 0, 0.1), 16))))
surface("voids_8", cavities=8)(lambda: united(box((1, 1, 1)), *[
    reversed_(ball(0.12, (0.23 * s, 0.23 * t, 0.23 * u), 12)) for s in (1, -1) for t in (1, -1) for u in (1, -1)]))
surface("void_flat", cavities=1)(lambda: united(box((1, 1, 1)), reversed_(turned(box((0.6, 0.6, 0.08))))))
surface("torus_void", handles=2, cavities=1)(lambda: united(torus(0.7, 0.3), reversed_(torus(0.7, 0.2))))
surface("speck_beside_ball", bodies=2)(lambda: united(ball(1), ball(0.06, (1.3, 0.2, 0.1), 10)))
surface("specks_20", bodies=20)(lambda: united(*[
    ball(0.05 + 0.004 * i, (math.cos(2.4 * i) * math.sqrt(0.1 * i + 0.02), math.sin(2.4 * i) * math.sqrt(0.1 * i + 0.02),
                            0.15 * math.sin(5 * i)), 10) for i in range(20)]))

# ---- nearly touching themselves

surface("horseshoe_tips")(lambda: tube([(0.6 * math.cos(a), 0.6 * math.sin(a), 0) for a in
                                        np.linspace(0.35, 2 * math.pi - 0.35, 48)], 0.18))
surface("pinched_waist")(lambda: turned(lathe([(0, -1)] + [(0.06 + 0.44 * abs(math.sin(a)) ** 1.5, -math.cos(a)) for a in
                                                           np.linspace(0.15, math.pi - 0.15, 9)][:1] + [
    (0.05 + 0.5 * (z * z) * math.sqrt(max(0, 1.15 - z * z)), z) for z in np.linspace(-0.95, 0.95, 39)] + [(0, 1)])))
surface("spheres_bridge")(lambda: turned(lathe(
    [(0, -1.05)] + [(0.5 * math.sin(a), -0.55 - 0.5 * math.cos(a)) for a in np.linspace(0.1, 2.94, 24)]
    + [(0.5 * math.sin(a), 0.55 - 0.5 * math.cos(a)) for a in np.linspace(0.2, 3.04, 24)] + [(0, 1.05)])))
surface("finger_in_cup")(lambda: turned(lathe([(0, 0), (0.6, 0), (0.6, 1), (0.45, 1), (0.45, 0.15), (0.3, 0.15), (0.3, 1),
                                               (0, 1)])))
surface("maze")(lambda: turned(blocks(np.arange(8.) / 7, [0, 0.2], np.arange(8.) / 7, lambda i, j, k: (i, k) in MAZE)))
MAZE = {(i, k) for i in range(7) for k in range(7) if i % 2 == 0 or k == (0 if i % 4 == 1 else 6)}


def problems(points, triangles):
    """What is wrong: no closed oriented manifold, or not oriented outwards."""
    directed = {}
    for t in triangles:
        for i in range(3):
            e = (int(t[i]), int(t[(i + 1) % 3]))
            directed[e] = directed.get(e, 0) + 1
    found = []
    if any(n != 1 for n in directed.values()) or any((b, a) not in directed for a, b in directed):
        found.append("not a closed oriented manifold")
    p = points[triangles]
    if np.einsum("ij,ij->", p[:, 0], np.cross(p[:, 1], p[:, 2])) <= 0:
        found.append("not oriented outwards")
    euler = len(np.unique(triangles)) - len(triangles) // 2
    return found, euler


def write_off(path, points, triangles):
    with open(path, "w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines(f"{x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in points)
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    for name, (make, topology) in SURFACES.items():
        points, triangles = make()
        found, euler = problems(points, triangles)
        expected = 2 * (topology["bodies"] + topology["cavities"] - topology["handles"])
        if found or euler != expected:
            raise SystemExit(f"{name}: {found}, Euler characteristic {euler} instead of {expected}")
        write_off(folder / f"{name}.off", points, triangles)
    with open(folder / "surfaces.json", "w") as out:
        json.dump({name: topology for name, (_, topology) in SURFACES.items()}, out, indent=1)
    print(f"{len(SURFACES)} surfaces in {folder}")


if __name__ == "__main__":
    main()
