#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes a surface with Netgen; prints CPU seconds.

  mesh_with_netgen.py SURFACE.off REGION.off MESH.vol SIZE_IN_REGION [--growth G] [--largest L]
"""

import json
import pathlib
import time

import netgen.meshing
import netgen.stl

from sizes import Sizes, argument_parser, distances, read_off, write_stl


def main():
    parser = argument_parser(__doc__)
    o = parser.parse_args()
    stl, size_file = (str(pathlib.Path(o.mesh).with_suffix(s)) for s in (".stl", ".msz"))
    surface = read_off(o.surface)
    write_stl(stl, *surface)
    sizes = Sizes(o.surface, o.region)
    is_near = distances(sizes.points, *surface) < 0
    with open(size_file, "w") as out:
        lines = ["{} {} {} {}\n".format(*p, h)
                 for p, h in zip(sizes.points[is_near], sizes.at_points(o.size, o.growth, o.largest)[is_near])]
        out.write(f"{len(lines)}\n" + "".join(lines) + "0\n")

    netgen.meshing.SetMessageImportance(0)
    start = time.process_time()
    geometry = netgen.stl.LoadSTLGeometry(stl)
    mesh = netgen.stl.GenerateMesh(geometry, netgen.meshing.MeshingParameters(
        maxh=o.largest, meshsizefilename=size_file, grading=o.growth))
    seconds = time.process_time() - start
    mesh.Save(o.mesh)
    print(json.dumps({"CPU seconds": seconds}))


if __name__ == "__main__":
    main()
