# SPDX-License-Identifier: GPL-3.0-or-later
"""Simple surfaces, and what is read from meshes of the mesher."""

import numpy as np
from text_files import write_text


def write_off(path, points, triangles):
    lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
    lines += [" ".join(f"{x:.6f}" for x in p) for p in points]
    lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
    write_text(path, "\n".join(lines) + "\n")


def read_off_points(path):
    """The vertices of a surface .off."""
    with open(path, encoding="utf-8") as file:
        words = " ".join(line.split("#")[0] for line in file).split()
    if not words or words[0] != "OFF":
        raise SystemExit(f"error: {path}: expected a surface .off")
    try:
        n = int(words[1])
        return np.array([float(x) for x in words[4:4 + 3 * n]]).reshape(n, 3)
    except (ValueError, IndexError):
        raise SystemExit(f"error: {path}: expected the numbers of a surface .off") from None


def sphere(center, radius, divisions=3):
    """Points and triangles of an octahedron that is divided, outward."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    points = [np.array(p, float) for p in points]
    triangles = [(x, y, z) if (x + y + z) % 2 else (y, x, z) for x in (0, 1) for y in (2, 3) for z in (4, 5)]
    for _ in range(divisions):
        middles, finer = {}, []
        for triangle in triangles:
            edges = []
            for a, b in zip(triangle, triangle[1:] + triangle[:1]):
                key = min(a, b), max(a, b)
                if key not in middles:
                    middles[key] = len(points)
                    middle = points[a] + points[b]
                    points.append(middle / np.linalg.norm(middle))
                edges.append(middles[key])
            (a, b, c), (ab, bc, ca) = triangle, edges
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    oriented = [t if np.linalg.det([points[i] for i in t]) > 0 else (t[1], t[0], t[2]) for t in triangles]
    return np.asarray(center) + radius * np.array(points), oriented


def read_medit(path):
    """Points, faces of the boundary, and centroids of the elements of a mesh .mesh."""
    with open(path, encoding="utf-8") as file:
        words = file.read().split()
    sizes = {"Triangles": 3, "Quadrilaterals": 4, "Tetrahedra": 4, "Pyramids": 5, "Prisms": 6, "Hexahedra": 8}
    points, faces, centroids, i = None, [], [], 0
    while i < len(words):
        if words[i] == "Vertices":
            n = int(words[i + 1])
            points = np.array(words[i + 2:i + 2 + 4 * n], float).reshape(n, 4)[:, :3]
            i += 2 + 4 * n
        elif words[i] in sizes:
            n, size = int(words[i + 1]), sizes[words[i]]
            table = np.array(words[i + 2:i + 2 + (size + 1) * n], int).reshape(n, size + 1)[:, :-1] - 1
            if words[i] in ("Triangles", "Quadrilaterals"):
                faces += [tuple(row) for row in table]
            else:
                centroids.append(points[table].mean(axis=1))
            i += 2 + (size + 1) * n
        else:
            i += 1
    return points, faces, np.concatenate(centroids)
