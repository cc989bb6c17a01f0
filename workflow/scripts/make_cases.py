#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a cohort of synthetic cases: brains, scaled and bent by a seed, each with a tumor and an opening.

  make_cases.py DIRECTORY [--cases 24] [--seed 1] [--broken] [--voxel 4] [--templates DIRECTORY]

Brains are the surface data/brain.off, and images of Debian's package mricron-data if they are there: of a man
(ch2bet.nii.gz) and of a macaque (inia19-t1-brain.nii.gz, scaled to a man's size); images are resampled to
--voxel mm. --broken adds a case whose surface has lost half of its triangles. Writes DIRECTORY/cases.csv.
"""

import argparse
import csv
import pathlib

import nibabel
import numpy as np
from surfaces import write_off

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
TEMPLATES = ("ch2bet.nii.gz", "inia19-t1-brain.nii.gz")
LENGTH = 175.  # of a brain, in mm
TUMOR, OPENING = np.array([28., 18., 28.]), np.array([44., 30., 75.])  # of data/, in a brain of that length


class Bend:
    """A scaling, then three shears along parabolas: each coordinate moves by a function of another one."""

    def __init__(self, random):
        self.scale = random.uniform(0.85, 1.1, 3)
        self.shears = [(i, (i + j) % 3, random.uniform(-0.0012, 0.0012), random.uniform(-30, 30))
                       for i, j in zip(random.permutation(3), random.integers(1, 3, 3))]

    def forward(self, points):
        points = points * self.scale
        for axis, by, strength, middle in self.shears:
            points[:, axis] += strength * (points[:, by] - middle)**2
        return points

    def backward(self, points):
        points = points.copy()
        for axis, by, strength, middle in reversed(self.shears):
            points[:, axis] -= strength * (points[:, by] - middle)**2
        return points / self.scale


def read_off(path):
    words = path.read_text(encoding="utf-8").split()
    n, m = int(words[1]), int(words[2])
    points = np.array(words[4:4 + 3 * n], float).reshape(n, 3)
    return points, np.array(words[4 + 3 * n:4 + 3 * n + 4 * m], int).reshape(m, 4)[:, 1:]


def bent_image(source, bend, voxel, path):
    """The image on voxels around the bent brain, not compressed. The brain's size and place are made those of
    data/; cavities inside become tissue. Returns the threshold of the brain.
    """
    from scipy.ndimage import binary_fill_holes, map_coordinates

    image = nibabel.load(source)
    values = np.squeeze(np.asarray(image.dataobj)).astype(np.float32)
    inside = np.argwhere(values > 0)
    corners = nibabel.affines.apply_affine(image.affine, np.array([inside.min(axis=0), inside.max(axis=0)]))
    low, high = corners.min(axis=0), corners.max(axis=0)
    factor = LENGTH / (high[1] - low[1])
    middle = np.array([0., -17., 10.])  # of data/brain.off
    outline = np.array(np.meshgrid(*([-1, 0, 1],) * 3)).reshape(3, -1).T * (high - low) / 2 * factor + middle
    box = bend.forward(outline)
    start = box.min(axis=0) - 3 * voxel
    size = np.ceil((np.ptp(box, axis=0) + 6 * voxel) / voxel).astype(int)
    world = start + voxel * np.indices(size).reshape(3, -1).T
    original = (bend.backward(world) - middle) / factor + (low + high) / 2
    voxels = nibabel.affines.apply_affine(np.linalg.inv(image.affine), original)
    affine = np.diag([voxel] * 3 + [1.])
    affine[:3, 3] = start
    sampled = map_coordinates(values, voxels.T, order=1, cval=0).reshape(size)
    threshold = 0.2 * float(np.percentile(values[values > 0], 50))
    sampled[binary_fill_holes(sampled >= threshold) & (sampled < threshold)] = np.ceil(threshold)
    bent = nibabel.Nifti1Image(np.round(sampled).astype(np.int16), affine)
    bent.header.set_xyzt_units("mm")
    nibabel.save(bent, path)
    return threshold


def ball(center, radius):
    return " ".join(f"{x:.2f}" for x in (*center, radius))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("--cases", type=int, default=24)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--broken", action="store_true")
    parser.add_argument("--voxel", type=float, default=4)
    parser.add_argument("--templates", type=pathlib.Path, default="/usr/share/mricron/templates")
    given = parser.parse_args()
    given.directory.mkdir(parents=True, exist_ok=True)
    points, triangles = read_off(DATA / "brain.off")
    images = [given.templates / name for name in TEMPLATES if (given.templates / name).is_file()]
    rows = []
    for i in range(given.cases):
        random = np.random.default_rng([given.seed, i])
        bend, threshold, image = Bend(random), "", ""
        which = i % (2 * len(images) or 1)
        if which % 2 == 0:
            brain = f"brain_{i + 1:02}.off"
            write_off(given.directory / brain, bend.forward(points), triangles)
        else:
            brain = image = f"brain_{i + 1:02}.nii"
            threshold = f"{bent_image(images[which // 2], bend, given.voxel, given.directory / brain):.6g}"
        side = np.array([random.choice([-1, 1]), 1, 1])
        tumor, opening = bend.forward(np.array([TUMOR * side, OPENING * side]))
        rows.append({"id": f"case_{i + 1:02}", "brain": brain, "threshold": threshold, "image": image,
                     "tumor": ball(tumor, random.uniform(10, 16)),
                     "opening": ball(opening, random.uniform(16, 24))})
    if given.broken:
        write_off(given.directory / "broken.off", points, triangles[::2])
        rows.insert(len(rows) // 2, {**rows[0], "id": "broken", "brain": "broken.off"})
    with open(given.directory / "cases.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(f"wrote {given.directory / 'cases.csv'}: {len(rows)} cases")


if __name__ == "__main__":
    main()
