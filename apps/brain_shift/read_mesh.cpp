// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/read_mesh.h"

#include "core/messages.h"
#include "core/resources.h"

#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <cstddef>
#include <stdexcept>

namespace mm3 = CGAL::Mixed_meshes_3;

Mesh read_mesh(const std::string& path, mm3::IO::Subdomain_names& subdomain_names,
               std::vector<std::string>& warnings)
{
  Mesh mesh;
  require([&](std::string* error) { return mm3::IO::read_mixed_mesh(path, mesh, subdomain_names, error); });
  const mm3::Mesh_defects d = mm3::find_defects(mesh);
  const auto refuse = [&path](const std::string& defect) { throw std::runtime_error(path + ": " + defect); };
  if(d.invalid_elements != 0)
    refuse(counted(d.invalid_elements, "element has", "elements have")
           + " a vertex twice, or one that does not exist");
  if(!d.positive()) {
    mm3::Element_index first = 0;
    while(mm3::jacobian_sign(mesh, first) == mm3::Jacobian_sign::POSITIVE)
      ++first;
    refuse(counted(d.nonpositive_elements + d.undecided_elements, "element is", "elements are")
           + " inverted, the first is element " + std::to_string(first));
  }
  if(!d.conforming())
    refuse(counted(d.nonconforming_faces, "face does", "faces do") + " not fit together");
  if(!d.closed_manifold_boundary())
    refuse("its boundary is not a manifold: " + counted(d.nonmanifold_boundary_edges, "edge", "edges")
           + " and " + counted(d.nonmanifold_boundary_vertices, "vertex", "vertices")
           + " where it touches itself; parts would hang on by a hinge");
  if(d.unused_vertices != 0)
    warnings.push_back(path + ": " + counted(d.unused_vertices, "vertex is", "vertices are")
                       + " in no element");
  if(d.duplicate_vertices != 0)
    warnings.push_back(path + ": " + counted(d.duplicate_vertices, "vertex is", "vertices are")
                       + " at the place of another one: elements are not joined there");
  return mesh;
}
