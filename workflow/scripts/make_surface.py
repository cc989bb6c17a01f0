#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a sphere, or a region of interest: the convex hull of a tumor and of the opening of the skull.

  make_surface.py OUTPUT.off --ball "X Y Z R"
  make_surface.py OUTPUT.off --tumor TUMOR.off --opening "X Y Z R"

The opening is a disk that faces the tumor. Units: mm.
"""

import argparse
import sys

import numpy as np
from surfaces import read_off_points, sphere, write_off


def disk(center, radius, axis, corners=64):
    """Points on the rim of a disk with that axis."""
    axis = axis / np.linalg.norm(axis)
    first = np.cross(axis, np.eye(3)[np.argmin(abs(axis))])
    first /= np.linalg.norm(first)
    angles = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    second = np.cross(axis, first)
    return center + radius * (np.outer(np.cos(angles), first) + np.outer(np.sin(angles), second))


def hull(points):
    """Points and triangles, outward, of the convex hull."""
    from scipy.spatial import ConvexHull

    found = ConvexHull(points)
    used = np.unique(found.simplices)
    triangles = np.searchsorted(used, found.simplices)
    points, middle = points[used], points[used].mean(axis=0)
    corners = points[triangles] - middle
    inward = np.einsum("ij,ij->i", np.cross(corners[:, 0], corners[:, 1]), corners[:, 2]) < 0
    triangles[inward] = triangles[inward][:, [1, 0, 2]]
    return points, triangles


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("output")
    parser.add_argument("--ball")
    parser.add_argument("--tumor")
    parser.add_argument("--opening")
    given = parser.parse_args()
    if given.ball:
        *center, radius = map(float, given.ball.split())
        points, triangles = sphere(center, radius)
    else:
        tumor = read_off_points(given.tumor)
        *center, radius = map(float, given.opening.split())
        axis = np.array(center) - tumor.mean(axis=0)
        if np.linalg.norm(axis) < 1e-6:
            sys.exit("error: the opening is in the middle of the tumor")
        points, triangles = hull(np.concatenate([tumor, disk(np.array(center), radius, axis)]))
    write_off(given.output, points, triangles)


if __name__ == "__main__":
    main()
