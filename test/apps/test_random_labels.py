#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""mixed_mesh_3 on random images of labels: each label is meshed, or named as lost, or the budget is refused
with the number of vertices that the labels take; no invalid mesh, and interfaces that are manifolds.

  test_random_labels.py MESHER WORK_DIRECTORY [NUMBER_OF_IMAGES]

Prints a table, by the kind of the image. 0 is not a label.
"""

import collections
import json
import pathlib
import shutil
import subprocess
import sys

MESHER, WORK = sys.argv[1], pathlib.Path(sys.argv[2])
NUMBER = int(sys.argv[3]) if len(sys.argv) > 3 else 6
VERTICES = 600

try:
    import nibabel
    import numpy as np
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)


def grid(size):
    return np.meshgrid(*(np.arange(n) for n in size), indexing="ij")


def blob(random, size, radius):
    """An ellipsoid at any place."""
    center = [random.uniform(0.25, 0.75) * n for n in size]
    radii = random.uniform(0.6, 1.4, 3) * radius
    return sum(((x - c) / r)**2 for x, c, r in zip(grid(size), center, radii)) < 1


def blobs(random, size):
    values = np.zeros(size, np.int16)
    for label in range(1, random.integers(2, 6)):
        values[blob(random, size, random.uniform(2, 7))] = label
    return values


def touching(random, size):
    """A body that planes cut into parts."""
    values = np.where(blob(random, size, min(size) / 2.5), 1, 0).astype(np.int16)
    for label in (1, 2, 4):
        normal, x = random.normal(size=3), grid(size)
        values[(sum(n * (c - s / 2) for n, c, s in zip(normal, x, size)) > 0) & (values > 0)] += label
    return values


def nested(random, size):
    values = np.zeros(size, np.int16)
    center = [s / 2 + random.uniform(-1, 1) for s in size]
    distance = np.sqrt(sum((x - c)**2 for x, c in zip(grid(size), center)))
    for label, radius in enumerate(np.cumsum(random.uniform(1, 4, 3))[::-1], 1):
        values[distance < radius] = label
    return values


def thin(random, size):
    """A body with plates and needles of one or two voxels."""
    values = np.where(blob(random, size, min(size) / 2.5), 1, 0).astype(np.int16)
    for label in (2, 3):
        at, axis, thickness = random.integers(4, min(size) - 4), random.integers(3), random.integers(1, 3)
        plate = np.zeros(size, bool)
        plate[tuple(slice(at, at + thickness) if i == axis else slice(None) for i in range(3))] = True
        values[plate & (values > 0)] = label
    needle = tuple(slice(2, -2) if i == random.integers(3) else int(s // 2) for i, s in enumerate(size))
    values[needle] = 4
    return values


def one_voxel(random, size):
    values = np.where(blob(random, size, min(size) / 3), 1, 0).astype(np.int16)
    for label in range(2, 5):
        values[tuple(random.integers(2, s - 2) for s in size)] = label
    return values


def checkerboard(random, size):
    step = int(random.integers(1, 5))
    x, y, z = grid(size)
    return (1 + (x // step + y // step + z // step) % 2).astype(np.int16)


KINDS = [blobs, touching, nested, thin, one_voxel, checkerboard]


def examine(path, values):
    """What is wrong, and what is to be counted."""
    output, report = WORK / "mesh.vtu", WORK / "mesh.json"
    run = subprocess.run([MESHER, path, "--labels", "each", "--vertices", str(VERTICES), "--output", output, "--report",
                          report], capture_output=True, text=True, timeout=600)
    if run.returncode == 1 and any(words in run.stderr for words in (": too small, the coarsest mesh", ": few for the layers")):
        return [], collections.Counter(refused=1)
    if run.returncode != 0:
        return ["exit status %d: %s" % (run.returncode, run.stderr)], collections.Counter(refused=1)
    told = json.loads(report.read_text())
    labels = [int(label) for label in np.unique(values) if label != 0]
    meshed = [s["index"] for s in told["subdomains"] if s["elements"] > 0]
    defects = []
    for label in labels:
        if label not in meshed and f"the subdomain label_{label}, of volume" not in run.stderr:
            defects.append(f"label {label} is neither meshed nor named as lost")
    if not all(told["checks"].values()):
        defects.append("a check fails")
    if told["surface"]["boundary self-intersections"] > 0:
        defects.append("the boundary cuts itself")
    for interface in told.get("interfaces", []):
        if not interface["manifold"]:
            defects.append("the interface between %s and %s is no manifold" % tuple(interface["between"]))
    counts = collections.Counter(labels=len(labels), lost=len(labels) - len(meshed))
    counts["interfaces"] = len(told.get("interfaces", []))
    counts["vertices off"] = sum(i["vertices not on surface"] for i in told.get("interfaces", []))
    return defects, counts


def main():
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    sums = collections.defaultdict(collections.Counter)
    has_failed = False
    for seed in range(NUMBER):
        kind, random = KINDS[seed % len(KINDS)], np.random.default_rng(seed)
        values = kind(random, tuple(int(n) for n in random.integers(14, 25, 3)))
        path = WORK / f"{kind.__name__}_{seed}.nii"
        nibabel.save(nibabel.Nifti1Image(values, np.diag([1, 1, random.choice([1, 1.5]), 1])), str(path))
        if not values.any():
            continue
        defects, counts = examine(path, values)
        sums[kind.__name__].update(counts)
        sums[kind.__name__].update(images=1, invalid=len(defects) > 0)
        for defect in defects:
            print(f"{path}: {defect}")
            has_failed = True
    columns = ["images", "invalid", "refused", "labels", "lost", "interfaces", "vertices off"]
    print(" | ".join(["kind"] + columns))
    for kind, counts in sums.items():
        print(" | ".join([kind] + [str(counts[c]) for c in columns]))
    return 1 if has_failed else 0


if __name__ == "__main__":
    sys.exit(main())
