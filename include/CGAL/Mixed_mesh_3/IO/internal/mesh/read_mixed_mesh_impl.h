// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MIXED_MESH_IMPL_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MIXED_MESH_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/facet_sets.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/mesh_formats.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// Refuses points for which volumes and areas of elements would overflow, and a file without elements.
inline void check_mesh_input(const std::string& file, const Mesh_input& input)
{
  for(std::size_t v = 0; v < input.points.size(); ++v)
    for(double x : input.points[v])
      if(!std::isfinite(x))
        refuse(file, "vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
      else if(std::abs(x) > largest_coordinate)
        refuse(file, "vertex " + std::to_string(v)
                       + " has a coordinate beyond 1e30: volumes and areas of its elements would overflow");
  if(input.elements.empty())
    refuse(file, "has no hexahedra, prisms, pyramids or tetrahedra");
}

// Names as `write_mixed_mesh()` writes them, of which no two differ by case only.
inline Subdomain_names valid_names(const Subdomain_names& names)
{
  Subdomain_names valid;
  for(const auto& named : names) {
    const std::string upper = in_upper_case(named.second);
    const bool is_new = std::none_of(valid.begin(), valid.end(),
                                     [&](const auto& other) { return in_upper_case(other.second) == upper; });
    if(is_new && is_facet_set_name(named.second))
      valid.insert(named);
  }
  return valid;
}

CGAL_MIXED_MESH_3_INLINE Mesh_input read_mesh_input(const std::string& file)
{
  const std::string extension = extension_of(file);
  for(const Mesh_format& f : mesh_formats())
    if(f.read != nullptr && f.extension == extension) {
      Mesh_input input = f.read(file);
      check_mesh_input(file, input);
      input.subdomain_names = valid_names(input.subdomain_names);
      return input;
    }
  const auto is_read = [](const Mesh_format& f) { return f.read != nullptr; };
  refuse(file, "unknown format; expected " + extensions_with(is_read, "or"));
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MIXED_MESH_IMPL_H
