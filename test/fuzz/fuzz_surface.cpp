// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed surfaces, in the format that the first byte chooses: read and closed, or refused.

#include "fuzz_file.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_image_3/IO/read_anatomical_surface.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  namespace IO = CGAL::Mixed_meshes_3::IO;
  static const Fuzz_file off(".off"), obj(".obj"), stl(".stl"), ply(".ply"), gii(".gii"), pial(".pial");
  if(size == 0)
    return 0;
  const Fuzz_file& file = data[0] == 'O'    ? off
                          : data[0] == 'p'  ? ply
                          : data[0] == 's'  ? stl
                          : data[0] == '<'  ? gii
                          : data[0] == 0xff ? pial
                                            : obj;
  file.write(data, size);
  CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> surface;
  std::string error;
  if(IO::read_anatomical_surface(file.path(), {}, surface, &error))
    require(CGAL::is_closed(surface) && CGAL::is_triangle_mesh(surface));
  else
    require_line(file.path(), error);
  return 0;
}
