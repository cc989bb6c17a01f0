#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a load for brain_shift: opening, gravity, level of the fluid, resection, and what is fixed.

  draw_load.py MESH.mesh DIRECTORY --seed TEXT [--opening "X Y Z R"] [--tumor FILE] [--ball "X Y Z R"]
    [--tumor-label LABEL] [--up X,Y,Z]

Writes to DIRECTORY control_points.csv, opening.off, tumor.off, and load.json with the arguments of
brain_shift and the numbers drawn. The same text as seed, and the same mesh, make the same load. Units: mm.
"""

import argparse
import hashlib
import json
import pathlib

import numpy as np
from surfaces import read_medit, sphere, write_off
from text_files import write_text

GRAVITY = 9810.  # mm/s^2
NUMBER_OF_CONTROL_POINTS = 6
# Of control points, in mm/mN: they give way by tenths of a millimeter where they ask too much of elements.
COMPLIANCE = 0.005


def random_numbers(text):
    seed = int.from_bytes(hashlib.sha256(text.encode()).digest()[:16], "big")
    return np.random.Generator(np.random.PCG64(seed))


def direction(text):
    if text.lstrip("-") in ("x", "y", "z"):
        return (-1. if text[0] == "-" else 1.) * np.eye(3)["xyz".index(text[-1])]
    vector = np.array([float(x) for x in text.split(",")])
    return vector / np.linalg.norm(vector)


def normal_at(points, faces, center, radius):
    """The mean outward normal of the boundary's faces near a point."""
    total = np.zeros(3)
    for face in faces:
        corners = points[list(face)]
        if np.linalg.norm(corners.mean(axis=0) - center) < radius:
            total += sum(np.cross(corners[i] - corners[0], corners[i + 1] - corners[0])
                         for i in range(1, len(corners) - 1))
    return total / np.linalg.norm(total)


def spread(points, start, number):
    """Indices of points far from each other, from the one given on."""
    chosen, distances = [start], np.linalg.norm(points - points[start], axis=1)
    while len(chosen) < min(number, len(points)):
        chosen.append(int(np.argmax(distances)))
        distances = np.minimum(distances, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return chosen


def draw(given):
    random = random_numbers(given.seed)
    points, faces, centroids = read_medit(given.mesh)
    boundary = points[sorted({v for face in faces for v in face})]
    up = direction(given.up)
    heights = (boundary @ up - (boundary @ up).min()) / np.ptp(boundary @ up)

    # The opening: where the case has it, more or less, or anywhere on the upper part.
    if given.opening:
        *center, radius = map(float, given.opening.split())
        center, radius = center + random.normal(size=3) * 0.2 * radius, radius * random.uniform(0.7, 1.2)
        middle = int(np.argmin(np.linalg.norm(boundary - center, axis=1)))
    else:
        middle, radius = int(random.choice(np.flatnonzero(heights > 0.6))), random.uniform(15, 25)
    center = boundary[middle]
    # On a coarse mesh, an opening of some faces at least.
    beside = {v for face in faces if any((points[v] == center).all() for v in face) for v in face}
    radius = max(radius, 1.5 * float(np.linalg.norm(points[sorted(beside)] - center, axis=1).mean()))
    inwards = -normal_at(points, faces, center, radius)

    # What is seen in it moves inwards, or bulges; most in the middle.
    depth = radius * random.uniform(-0.1, 0.3)
    within = np.flatnonzero(np.linalg.norm(boundary - center, axis=1) < 0.8 * radius)
    seen = boundary[within]
    chosen = spread(seen, int(np.flatnonzero(within == middle)[0]), NUMBER_OF_CONTROL_POINTS)
    moves = [depth * (1 - (np.linalg.norm(seen[i] - center) / radius)**2) * inwards for i in chosen]
    rows = [",".join(f"{x:.6f}" for x in (*seen[i], *move)) for i, move in zip(chosen, moves)]

    # The head lies at any angle up to 40 degrees to its own axis, and some of the fluid has run out.
    tilt = random.normal(size=3)
    tilt -= (tilt @ up) * up
    angle = np.radians(random.uniform(0, 40))
    against = np.cos(angle) * up + np.sin(angle) * tilt / np.linalg.norm(tilt)
    level = random.uniform(0.3, 1)
    extent = points @ against
    fluid = extent.min() + level * np.ptp(extent)

    # Control points must be free.
    fixed = min(random.uniform(0.15, 0.4), 0.8 * float(heights[within[chosen]].min()))

    # A ball around an element of the mesh, in the tumor if there is one, so that something is resected.
    resected = bool(random.uniform() < 0.75)
    if given.ball:
        *tumor, tumor_radius = map(float, given.ball.split())
        tumor_radius *= random.uniform(0.7, 1.1)
    else:
        tumor, tumor_radius = center + random.uniform(15, 30) * inwards, random.uniform(7, 12)
    tumor = centroids[np.argmin(np.linalg.norm(centroids - tumor, axis=1))]

    folder = pathlib.Path(given.directory)
    folder.mkdir(parents=True, exist_ok=True)
    write_text(folder / "control_points.csv", "x,y,z,dx,dy,dz\n" + "\n".join(rows) + "\n")
    # Most of the ball inside, as other places would look like the right one to the program.
    write_off(folder / "opening.off", *sphere(center + 0.4 * radius * inwards, np.hypot(1, 0.4) * radius))
    write_off(folder / "tumor.off", *sphere(tumor, tumor_radius))
    numbers = lambda vector: ",".join(f"{x:.6f}" for x in vector)
    arguments = [f"--control-points={folder / 'control_points.csv'}", f"--control-radius={0.3 * radius:.6f}",
                 f"--control-compliance={COMPLIANCE}", "--slide=skull", f"--opening={folder / 'opening.off'}",
                 "--fixed=base", f"--fixed-below={fixed:.6f}", f"--gravity={numbers(-GRAVITY * against)}",
                 f"--fluid-level={fluid:.6f}"]
    if resected and given.tumor_label:
        arguments.append(f"--tumor-label={given.tumor_label}")
    elif resected:
        arguments.append(f"--tumor={given.tumor or folder / 'tumor.off'}")
    drawn = {"opening": numbers(center), "opening_radius": f"{radius:.6f}", "depth": f"{depth:.6f}",
             "against_gravity": numbers(against), "fluid_level": f"{fluid:.6f}",
             "fixed_below": f"{fixed:.6f}", "resected": arguments[-1].split("=", 1)[1] if resected else ""}
    write_text(folder / "load.json", json.dumps({"arguments": arguments, "drawn": drawn}, indent=2) + "\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mesh")
    parser.add_argument("directory")
    parser.add_argument("--seed", required=True)
    parser.add_argument("--opening")
    parser.add_argument("--tumor")
    parser.add_argument("--ball")
    parser.add_argument("--tumor-label")
    parser.add_argument("--up", default="z")
    draw(parser.parse_args())


if __name__ == "__main__":
    main()
