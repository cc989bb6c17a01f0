#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reads the images of test_image_io with another program, nibabel, and compares with image_expected.json.

Usage: test_image_readers.py [directory that test_image_io wrote to]

Exit code 77 (skipped) if a module is missing: python3-nibabel.
"""

import json
import os
import sys

try:
    import nibabel
    import numpy as np
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

failures = 0


def check(condition, *text):
    global failures
    if not condition:
        failures += 1
        if failures < 40:
            print("FAILED:", *text)


def affine_of(rows):
    return np.vstack([rows, [0, 0, 0, 1]])


def main():
    directory = sys.argv[1] if len(sys.argv) > 1 else "."

    def load(name):
        return nibabel.load(os.path.join(directory, name))

    with open(os.path.join(directory, "image_expected.json"), encoding="ascii") as file:
        expected = json.load(file)
    check(len(expected["images"]) > 0, "no images")
    for image in expected["images"]:
        name, read = image["name"], load(image["name"])
        affine = affine_of(image["affine"])
        check(read.shape == (5, 4, 3), name, "shape", read.shape)
        check(read.header.get_data_dtype() == np.dtype(image["type"]), name, "type")
        check(np.allclose(read.affine, affine, atol=1e-5), name, "affine", read.affine)
        check(np.allclose(read.get_sform(), affine, atol=1e-5), name, "sform")
        check(np.allclose(read.get_qform(), affine, atol=1e-4), name, "qform", read.get_qform())
        code = 4 if "mirrored" in name else 1
        check(read.get_sform(coded=True)[1] == read.get_qform(coded=True)[1] == code, name, "code")
        check(read.header.get_xyzt_units()[0] == "mm", name, "unit")
        values = np.asarray(read.dataobj).astype(np.float32).ravel(order="F")
        check(np.array_equal(values, np.array(image["values"], np.float32)), name, "values", values)

    field = load("image_field.nii.gz")
    check(field.shape == (5, 4, 3, 1, 3), "shape of the field", field.shape)
    check(field.header.get_intent()[0] == "displacement vector", "intent", field.header.get_intent())
    check(field.header.get_data_dtype() == np.float32, "type of the field")
    vectors = np.asarray(field.dataobj).reshape(-1, 3, order="F")
    check(np.array_equal(vectors, np.array(expected["field"], np.float32)), "vectors of the field")

    scaled = load("image_scaled.nii")
    check(np.array_equal(scaled.get_fdata().ravel(), [10, 10.5, 11, 10, 137.5]), "scaled", scaled.get_fdata())
    sheared = load("image_sheared.nii")
    check(sheared.get_qform(coded=True)[1] == 0, "a qform that cannot be right")
    check(np.allclose(sheared.affine[0], [1, 0.3, 0, 5], atol=1e-6), "sheared", sheared.affine)
    # What the C++ test wrote byte by byte for its reader: the same for this reader.
    swapped = load("image_swapped.nii")
    check(np.array_equal(np.asarray(swapped.dataobj).ravel(order="F"), 256 + np.arange(24)), "byte order")
    check(load("image_second.nii").header["sizeof_hdr"] == 540, "NIfTI-2")

    # The files of a warped image belong together.
    image = load("image_warped.nii.gz")
    mask = np.asarray(load("image_warped_mask.nii.gz").dataobj)
    check(mask.dtype == np.uint8 and set(np.unique(mask)) == {0, 1}, "mask", np.unique(mask))
    backward = load("image_warped_backward.nii.gz")
    check(backward.shape == image.shape + (1, 3), "backward field", backward.shape)
    for name in ("image_warped_mask.nii.gz", "image_warped_forward.nii.gz", "image_warped_backward.nii.gz"):
        check(np.array_equal(load(name).affine, image.affine), name, "affine")
    # The image was 100 + 0.7 x - 0.4 y + 0.9 z: the field says which x, y and z are shown now.
    ijk = np.indices(image.shape).reshape(3, -1)[:, mask.ravel() == 1]
    source = image.affine[:3, :3] @ ijk + image.affine[:3, 3:]
    source = source + np.asarray(backward.dataobj)[:, :, :, 0].reshape(-1, 3)[mask.ravel() == 1].T
    shown = image.get_fdata().ravel()[mask.ravel() == 1]
    check(np.allclose(shown, 100 + [0.7, -0.4, 0.9] @ source, atol=1e-4), "warped image against field")

    print(failures, "failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
