#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes a surface with Gmsh; prints CPU seconds.

  mesh_with_gmsh.py SURFACE.off REGION.off MESH.msh SIZE_IN_REGION [--growth G] [--largest L] [--hxt] [--angle A]

The surface is parametrized and meshed anew, with the sizes that the volume has. With --angle, edges between facets
whose normals differ by more than A degrees are kept, and the size is that of the region everywhere.
"""

import json
import math
import pathlib
import time

import gmsh

from sizes import Sizes, argument_parser, read_off, write_stl


def main():
    parser = argument_parser(__doc__)
    parser.add_argument("--hxt", action="store_true")
    parser.add_argument("--angle", type=float, default=0)
    o = parser.parse_args()
    stl = str(pathlib.Path(o.mesh).with_suffix(".stl"))
    write_stl(stl, *read_off(o.surface))
    data = []
    if not o.angle:
        sizes = Sizes(o.surface, o.region)
        values = sizes.at_points(o.size, o.growth, o.largest)
        for t in sizes.tetrahedra():  # of each tetrahedron all x, all y, all z, all values
            data.extend(sizes.points[t].T.ravel())
            data.extend(values[t])

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.option.setNumber("Mesh.Algorithm3D", 10 if o.hxt else 1)
    for option in ("ExtendFromBoundary", "FromPoints", "FromCurvature"):
        gmsh.option.setNumber("Mesh.MeshSize" + option, 0)
    view = gmsh.view.add("sizes")
    gmsh.view.addListData(view, "SS", len(data) // 16, data)
    gmsh.merge(stl)
    if o.angle:
        for bound in ("Min", "Max"):
            gmsh.option.setNumber("Mesh.MeshSize" + bound, o.size)

    angle = math.radians(o.angle) if o.angle else 3.2
    start = time.process_time()
    gmsh.model.mesh.classifySurfaces(angle, True, True, angle)
    gmsh.model.mesh.createGeometry()
    loop = gmsh.model.geo.addSurfaceLoop([tag for _, tag in gmsh.model.getEntities(2)])
    gmsh.model.geo.addVolume([loop])
    gmsh.model.geo.synchronize()
    if not o.angle:
        field = gmsh.model.mesh.field.add("PostView")
        gmsh.model.mesh.field.setNumber(field, "ViewTag", view)
        gmsh.model.mesh.field.setAsBackgroundMesh(field)
    gmsh.model.mesh.generate(3)
    seconds = time.process_time() - start
    gmsh.model.mesh.removeDuplicateNodes()
    gmsh.write(o.mesh)
    gmsh.finalize()
    print(json.dumps({"CPU seconds": seconds}))


if __name__ == "__main__":
    main()
