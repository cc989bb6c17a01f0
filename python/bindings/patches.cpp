// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of the boundary.

#include "arrays.h"
#include "core/boundary_patches.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

template <class Index>
py::array_t<std::int64_t> array_of_indices(const std::vector<Index>& indices)
{
  py::array_t<std::int64_t> array(py::ssize_t(indices.size()));
  std::copy(indices.begin(), indices.end(), array.mutable_data());
  return array;
}

// The faces of a patch, as positions in the boundary, and their vertices.
py::tuple patch_of(const Mesh& mesh, const std::string& name, const Patch_test& contains)
{
  std::vector<std::size_t> positions;
  std::vector<mm3::Face> faces;
  {
    const py::gil_scoped_release release;
    const std::vector<mm3::Face> boundary = mm3::boundary_faces(mesh);
    positions = faces_in_patch(mesh, boundary, contains);
    for(std::size_t i : positions)
      faces.push_back(boundary[i]);
  }
  if(faces.empty())
    throw std::invalid_argument(name + ": " + sentence_on_empty_patch(mesh));
  return py::make_tuple(array_of_indices(positions), array_of_indices(mm3::vertices_of(faces)));
}

py::tuple patch_in_shape(const Mesh& mesh, const std::string& kind, const std::vector<double>& numbers)
{
  const std::optional<Patch_shape> shape = patch_shape(kind, numbers);
  if(!shape || !shape->defect.empty())
    throw std::invalid_argument(kind + ": " + (shape ? shape->defect : "there is no such shape"));
  return patch_of(mesh, kind, shape->contains);
}

// The patch in a closed surface, and repairs of the surface.
py::tuple patch_in_surface(const Mesh& mesh, const Doubles& points, const Integers& triangles)
{
  std::vector<std::string> warnings;
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface_of(points, triangles, "surface", warnings));
  const py::tuple patch = patch_of(mesh, "surface", [&domain](const std::array<double, 3>& p, double) {
    return domain.bounded_side(Kernel::Point_3(p[0], p[1], p[2])) == CGAL::ON_BOUNDED_SIDE;
  });
  return py::make_tuple(patch, warnings);
}

} // namespace

void add_patches(py::module_& module)
{
  module.def(
    "boundary_faces", [](const Mesh& mesh) { return array_of(mm3::boundary_faces(mesh)); },
    "The faces of the boundary in the order of the elements: their vertices, (n, 4), counter-clockwise seen "
    "from outside, "
    "the last one -1 of triangles.");
  module.def("patch_in_shape", &patch_in_shape);
  module.def("patch_in_surface", &patch_in_surface);
}
