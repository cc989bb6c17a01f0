#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how long large files take to read and to write, beside a plain copy of their bytes.

  large_files.py MIXED_MESH_3 WORK [--triangles 10000000] [--vertices 1000000] [--save BASE]

Surfaces are the bundled brain, each triangle split into four again and again, as binary STL and PLY; the mesher reads
them, checks them and makes a mesh of few vertices. A large mesh of the brain is written in all formats in one run. Times
and memory of the stages are those of the program's report; a plain reading is Python's, after the file was written, so
from memory. WORK gets the files, some gigabytes. Needs NumPy (Debian: python3-numpy).
"""

import argparse
import json
import pathlib
import subprocess
import sys
import time

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
import results  # noqa: E402

DATA = pathlib.Path(__file__).resolve().parents[3] / "data"
MESH_FORMATS = ["vtu", "msh", "mesh", "inp", "feb"]


def read_off(path):
    numbers = path.read_text().split()[1:]
    vertices, faces = int(numbers[0]), int(numbers[1])
    points = numpy.array(numbers[3:3 + 3 * vertices], float).reshape(-1, 3)
    return points, numpy.array(numbers[3 + 3 * vertices:], int).reshape(faces, 4)[:, 1:]


def subdivided(points, triangles):
    """Each triangle split into four by the middles of its edges."""
    edges = numpy.sort(numpy.vstack([triangles[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    edges, numbers = numpy.unique(edges, axis=0, return_inverse=True)
    middles = len(points) + numbers.reshape(3, -1)
    corners = [numpy.column_stack([triangles[:, i], middles[i], middles[i - 1]]) for i in range(3)]
    return (numpy.vstack([points, points[edges].mean(axis=1)]), numpy.vstack([*corners, middles.T]))


def write_stl(path, points, triangles):
    facets = numpy.zeros(len(triangles), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets["corners"] = points[triangles]
    path.write_bytes(bytes(80) + len(triangles).to_bytes(4, "little") + facets.tobytes())


def write_ply(path, points, triangles):
    header = "\n".join(["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}",
                        *(f"property double {axis}" for axis in "xyz"), f"element face {len(triangles)}",
                        "property list uchar int vertex_indices", "end_header", ""])
    faces = numpy.zeros(len(triangles), [("size", "u1"), ("vertices", "<i4", 3)])
    faces["size"], faces["vertices"] = 3, triangles
    path.write_bytes(header.encode() + points.astype("<f8").tobytes() + faces.tobytes())


def stages(program, *arguments, report):
    subprocess.run([program, *map(str, arguments), "--quiet", "--report", report], check=True)
    return {stage["stage"]: stage for stage in json.loads(report.read_text())["stages"]}


def row(what, items, path, stage):
    start = time.process_time()
    size = len(path.read_bytes()) / 1e9
    plain = time.process_time() - start
    return {"file": what, "": items, "GB": f"{size:.2f}", "CPU s": f"{stage['CPU seconds']:.1f}",
            "CPU s a GB": f"{stage['CPU seconds'] / size:.0f}", "peak MB": f"{stage['peak memory MiB'] * 1.048576:.0f}",
            "plain reading, CPU s": f"{plain:.2f}"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--triangles", type=int, default=10000000, help="the surface has a half to twice as many")
    parser.add_argument("--vertices", type=int, default=1000000)
    parser.add_argument("--save", type=pathlib.Path)
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    report = options.work / "report.json"
    points, triangles = read_off(DATA / "brain.off")
    while 2 * len(triangles) < options.triangles:
        points, triangles = subdivided(points, triangles)
    rows = []
    for name, write in (("stl", write_stl), ("ply", write_ply)):
        path = options.work / f"brain.{name}"
        write(path, points, triangles)
        stage = stages(options.program, path, "--vertices", 300, report=report)["read surface"]
        rows.append(row(f"{name.upper()}, binary, read", f"{len(triangles):,} triangles", path, stage))
    meshes = [options.work / f"mesh.{name}" for name in MESH_FORMATS]
    of_names = stages(options.program, DATA / "brain.off", "--region", DATA / "region.off", "--vertices",
                      options.vertices, *(word for path in meshes for word in ("--output", path)), report=report)
    for path in meshes:
        rows.append(row(f"{path.suffix[1:]}, written", f"{options.vertices:,} vertices", path, of_names[f"write {path}"]))
    print(results.markdown(rows), end="")
    if options.save:
        results.save(options.save, rows, rows)


if __name__ == "__main__":
    main()
