#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reads the images of test_image_io with another program, nibabel, and compares with image_expected.json.

Usage: test_image_readers.py [directory that test_image_io wrote to]

Exit code 77 (skipped) if a module is missing: python3-nibabel. With plastimatch, if there, fields are applied.
"""

import gzip
import json
import os
import shutil
import subprocess
import sys

try:
    import nibabel
    import numpy as np
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "common"))
from checks import check, exit_code  # noqa: E402


def affine_of(rows):
    return np.vstack([rows, [0, 0, 0, 1]])


def read_nrrd(path):
    """The header of a NRRD file as a dictionary, and its data as an array with the fastest axis first."""
    with open(path, "rb") as file:
        text, _, data = file.read().partition(b"\n\n")
    lines = text.decode("ascii").splitlines()
    check(lines[0] == "NRRD0004", path, "magic")
    header = dict(line.split(": ", 1) for line in lines[1:])
    if header["encoding"] == "gzip":
        data = gzip.decompress(data)
    sizes = [int(n) for n in header["sizes"].split()]
    return header, np.frombuffer(data, "<f4" if header["endian"] == "little" else ">f4").reshape(sizes, order="F")


def check_fields(directory, load):
    """The formats say the same: components to the left and to the back where ITK reads them."""
    lps = np.array([-1, -1, 1])
    for direction in ("forward", "backward"):
        plain = load(f"image_warped_{direction}.nii.gz")
        itk = load(f"image_warped_{direction}_itk.nii.gz")
        vectors = np.asarray(plain.dataobj)
        check(np.abs(vectors).max() > 1, "a field without displacements")
        check(itk.header["intent_code"] == 1007 and itk.shape == plain.shape, direction, "field for ITK")
        check(np.array_equal(itk.affine, plain.affine), direction, "affine of the field for ITK")
        check(np.array_equal(np.asarray(itk.dataobj), vectors * lps), direction, "vectors for ITK")
        names = [f"image_warped_{direction}.nrrd"] + (["image_raw.nrrd"] if direction == "backward" else [])
        for name in names:
            header, data = read_nrrd(os.path.join(directory, name))
            check(header["kinds"] == "vector domain domain domain" and header["type"] == "float"
                  and header["space"] == "left-posterior-superior" and header["dimension"] == "4", name, header)
            check(np.array_equal(data, np.moveaxis(vectors[:, :, :, 0] * lps, 3, 0)), name, "vectors")
            columns = [c.strip("()").split(",") for c in header["space directions"].split()[1:]]
            columns.append(header["space origin"].strip("()").split(","))
            check(np.allclose(np.array(columns, float).T, lps[:, None] * plain.affine[:3], rtol=1e-6, atol=1e-5), name,
                  "grid")


def check_with_plastimatch(directory, load, mask, backward):
    """Another program, with ITK, resamples the image by the backward field."""
    if shutil.which("plastimatch") is None:
        print("skipped: no plastimatch")
        return
    image, ours = load("image_unwarped.nii.gz"), load("image_warped.nii.gz").get_fdata()
    # Where the image is asked beyond its voxels, programs differ.
    inverse = np.linalg.inv(image.affine)
    ijk = np.indices(image.shape).reshape(3, -1)
    vectors = np.asarray(backward.dataobj)[:, :, :, 0].reshape(-1, 3).T
    source = inverse[:3, :3] @ (image.affine[:3, :3] @ ijk + image.affine[:3, 3:] + vectors) + inverse[:3, 3:]
    inside = np.all((source > 0) & (source < np.array(image.shape)[:, None] - 1), axis=0).reshape(image.shape)
    moved = np.abs(ours - image.get_fdata())[inside].max()
    for field in ("image_warped_backward_itk.nii.gz", "image_warped_backward.nrrd", "image_raw.nrrd"):
        output = os.path.join(directory, "image_by_plastimatch.nii.gz")
        run = subprocess.run(["plastimatch", "convert", "--input", os.path.join(directory, "image_unwarped.nii.gz"),
                              "--xf", os.path.join(directory, field), "--output-img", output, "--output-type",
                              "float", "--algorithm", "itk"], capture_output=True, text=True)
        check(run.returncode == 0 and os.path.exists(output), field, run.stdout, run.stderr)
        if os.path.exists(output):
            difference = np.abs(nibabel.load(output).get_fdata() - ours)[inside].max()
            check(difference < 1e-3 * moved, field, "plastimatch against ours", difference, moved)
            os.remove(output)


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

    check_fields(directory, load)
    check_with_plastimatch(directory, load, mask, backward)
    return exit_code()


if __name__ == "__main__":
    sys.exit(main())
