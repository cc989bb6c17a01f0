#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Writes a surface by other programs, nibabel and VTK, in all their encodings, and has test_anatomical_surface read it.

Usage: test_anatomical_surface_writers.py test_images [directory for the files]

Exit code 77 (skipped) if a module is missing: python3-nibabel, python3-vtk9.
"""

import itertools
import json
import os
import subprocess
import sys

try:
    import nibabel
    import numpy
    import vtk
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

# The box from (0, 0, 0) to (1, 2, 3), and quadrilaterals that are its faces.
POINTS = numpy.array([(x, y, z) for z in (0, 3) for y in (0, 2) for x in (0, 1)], float)
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = numpy.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])
VOLUME, FACES, VERTICES = 6, 12, 8
C_RAS = numpy.array([5.5, -17.25, 18])


def freesurfer(directory):
    """Yields path, translation expected, and words of a warning."""
    def write(name, **volume):
        path = os.path.join(directory, name)
        nibabel.freesurfer.write_geometry(path, POINTS, TRIANGLES, **volume)
        return path

    volume = {"head": [2, 0, 20], "valid": "1  # volume info valid", "filename": "../mri/filled.mgz",
              "volume": [256, 256, 256], "voxelsize": [1, 1, 1], "xras": [-1, 0, 0], "yras": [0, 0, -1],
              "zras": [0, 1, 0], "cras": C_RAS}
    yield write("lh.pial", volume_info=volume), C_RAS, None
    yield write("rh.white", volume_info=dict(volume, head=[20])), C_RAS, None
    yield write("lh.inflated", volume_info=dict(volume, valid="0  # volume info invalid")), 0 * C_RAS, "c_ras"
    yield write("lh.orig"), 0 * C_RAS, "c_ras"


def gifti(directory):
    from nibabel.gifti import GiftiCoordSystem, GiftiDataArray, GiftiImage, GiftiMetaData
    shift = numpy.eye(4)
    shift[:3, 3] = C_RAS
    unknown, scanner, talairach = 0, 1, 3
    axes = {"X": (-1, 0, 0), "Y": (0, 0, -1), "Z": (0, 1, 0), "C": C_RAS}
    geometry = {f"VolGeom{axis}_{letter}": "%f" % x for axis, v in axes.items() for letter, x in zip("RAS", v)}
    systems = [("plain", GiftiCoordSystem(unknown, unknown, numpy.eye(4)), {}, 0 * C_RAS),
               ("talairach", GiftiCoordSystem(unknown, talairach, shift), {}, 0 * C_RAS),
               ("to_scanner", GiftiCoordSystem(unknown, scanner, shift), {}, C_RAS),
               ("in_scanner", GiftiCoordSystem(scanner, talairach, shift), geometry, 0 * C_RAS),
               ("freesurfer", GiftiCoordSystem(unknown, talairach, numpy.eye(4)), geometry, C_RAS)]
    encodings = ["GIFTI_ENCODING_ASCII", "GIFTI_ENCODING_B64BIN", "GIFTI_ENCODING_B64GZ"]
    for (name, system, data, translation), encoding, order, big in itertools.product(
            systems, encodings, ("C", "F"), (False, True)):
        if encoding == "GIFTI_ENCODING_ASCII" and (big or order == "F"): # nibabel writes text by rows
            continue
        arrays = []
        for values, intent, kind in ((POINTS, "NIFTI_INTENT_POINTSET", "float32"),
                                     (TRIANGLES, "NIFTI_INTENT_TRIANGLE", "int32")):
            array = GiftiDataArray(values.astype((">" if big else "<") + kind[0] + "4"), intent=intent,
                                   datatype="NIFTI_TYPE_" + kind.upper(), encoding=encoding, ordering=order,
                                   endian="big" if big else "little", coordsys=system,
                                   meta=GiftiMetaData(dict(data, Description="a > b")))
            arrays.append(array)
        path = os.path.join(directory, "%s_%s_%s_%d.gii" % (name, encoding[15:], order, big))
        nibabel.save(GiftiImage(darrays=arrays), path)
        yield path, translation, None


def vtk_surface(point_type, with_strips):
    points = vtk.vtkPoints()
    points.SetDataType(point_type)
    for p in POINTS:
        points.InsertNextPoint(p)
    polygons, strips, lines = vtk.vtkCellArray(), vtk.vtkCellArray(), vtk.vtkCellArray()
    lines.InsertNextCell(2, [0, 1])
    for i, (a, b, c, d) in enumerate(QUADS):
        if with_strips and i % 2 == 0:
            strips.InsertNextCell(4, [a, b, d, c])
        elif i == 1:
            polygons.InsertNextCell(3, [a, b, c])
            polygons.InsertNextCell(3, [a, c, d])
        else:
            polygons.InsertNextCell(4, [a, b, c, d])
    surface = vtk.vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(polygons)
    surface.SetLines(lines)
    if with_strips:
        surface.SetStrips(strips)
    data = vtk.vtkDoubleArray()
    data.SetName("data")
    for i in range(len(POINTS)):
        data.InsertNextValue(i)
    surface.GetPointData().SetScalars(data)
    return surface


def xml(directory):
    encodings = itertools.product([("ascii", 0, 0), ("binary", 1, 0), ("base64", 2, 1), ("raw", 2, 0)],
                                  ["None", "ZLib"], [32, 64], [vtk.VTK_FLOAT, vtk.VTK_DOUBLE])
    for (name, mode, encode), compressor, header, point_type in encodings:
        writer = vtk.vtkXMLPolyDataWriter()
        writer.SetInputData(vtk_surface(point_type, header == 64))
        writer.SetDataMode(mode)
        writer.SetEncodeAppendedData(encode)
        getattr(writer, "SetCompressorTypeTo" + compressor)()
        getattr(writer, "SetHeaderTypeToUInt%d" % header)()
        if header == 32:
            writer.SetIdTypeToInt32()
        path = os.path.join(directory, "vtk_%s_%s_%d_%d.vtp" % (name, compressor, header, point_type))
        writer.SetFileName(path)
        writer.Write()
        yield path, None, None

        # As 3D Slicer writes it: three letters in a field.
        surface = vtk_surface(point_type, False)
        surface.GetFieldData().AddArray(text_array("SPACE", "LPS"))
        writer.SetInputData(surface)
        path = path.replace("vtk_", "slicer_")
        writer.SetFileName(path)
        writer.Write()
        yield path, "LPS", "says that it is in LPS"


def text_array(name, text):
    array = vtk.vtkStringArray()
    array.SetName(name)
    array.InsertNextValue(text)
    return array


def legacy(directory):
    for binary, version, strips, header in itertools.product((False, True), (42, 51), (False, True),
                                                             ("by VTK", "3D Slicer output. SPACE=LPS")):
        writer = vtk.vtkPolyDataWriter()
        surface = vtk_surface(vtk.VTK_DOUBLE if strips else vtk.VTK_FLOAT, strips)
        data = vtk.vtkIntArray()
        data.SetName("some data")
        data.InsertNextValue(7)
        surface.GetFieldData().AddArray(data)
        if not binary:
            surface.GetFieldData().AddArray(text_array("text", "of two words"))
        writer.SetInputData(surface)
        writer.SetHeader(header)
        writer.SetFileVersion(version)
        if binary:
            writer.SetFileTypeToBinary()
        is_lps = header != "by VTK"
        path = os.path.join(directory, "legacy_%d_%d_%d_%d.vtk" % (binary, version, strips, is_lps))
        writer.SetFileName(path)
        writer.Write()
        yield path, "LPS" if is_lps else None, "says that it is in LPS" if is_lps else None


def stl_and_ply(directory):
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(vtk_surface(vtk.VTK_FLOAT, False))
    for kind, binary in itertools.product(("STL", "PLY"), (False, True)):
        writer = getattr(vtk, "vtk%sWriter" % kind)()
        writer.SetInputConnection(triangles.GetOutputPort())
        getattr(writer, "SetFileTypeTo" + ("Binary" if binary else "ASCII"))()
        path = os.path.join(directory, "vtk_%d.%s" % (binary, kind.lower()))
        for is_lps in (False, True):
            if is_lps and kind == "STL":
                writer.SetHeader("3D Slicer output. SPACE=LPS")
            elif is_lps:
                writer.AddComment("3D Slicer output. SPACE=LPS")
            path = path.replace("vtk_", "slicer_") if is_lps else path
            writer.SetFileName(path)
            writer.Write()
            yield path, "LPS" if is_lps else None, "says that it is in LPS" if is_lps else None


def check(case, result):
    path, moved, words = case
    assert isinstance(result, dict), result
    assert (result["vertices"], result["faces"]) == (VERTICES, FACES), result
    assert abs(result["volume"] - VOLUME) < 1e-5, result
    points = POINTS * (-1, -1, 1) if isinstance(moved, str) else POINTS if moved is None else POINTS + moved
    assert numpy.allclose(result["box"], [*points.min(axis=0), *points.max(axis=0)], atol=1e-5), result
    assert words is None or any(words in w for w in result["warnings"]), result
    assert words is not None or not any("LPS" in w or "c_ras" in w for w in result["warnings"]), result


def main():
    program, directory = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "."
    os.makedirs(directory, exist_ok=True)
    cases = [case for writer in (freesurfer, gifti, xml, legacy, stl_and_ply) for case in writer(directory)]
    run = subprocess.run([program, "test_anatomical_surface", "--files", *(path for path, _, _ in cases)], capture_output=True, text=True)
    lines = run.stdout.splitlines()
    failures = 0 if run.returncode == 0 and run.stderr in ("", "No errors detected.\n") else 1
    if failures:
        print(run.stderr)
    assert len(lines) == len(cases), (len(lines), len(cases))
    for case, line in zip(cases, lines):
        try:
            check(case, json.loads(line))
        except (AssertionError, ValueError) as error:
            failures += 1
            print(case[0], error)
    print(len(cases), "files,", failures, "failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
