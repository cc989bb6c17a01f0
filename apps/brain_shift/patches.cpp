// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/patches.h"

#include "core/patch_shapes.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

using Contains = std::function<bool(const mm3::Face&)>;

// The faces of a patch: faces of elements of a label, or faces with their center inside a shape or a surface.
Contains read_patch(const Mesh& mesh, const std::string& place, const Options& o,
                    std::vector<std::string>& warnings)
{
  if(const auto label = label_of(place))
    return [&mesh, label](const mm3::Face& face) { return mesh.subdomain_index(face.element()) == *label; };
  if(const auto shape = patch_shape(place))
    return [&mesh, contains = shape->contains, tolerance = patch_tolerance(mesh)](const mm3::Face& face) {
      return contains(center_of(mesh, face), tolerance);
    };
  Surface_facts facts;
  const std::shared_ptr<const Closed_surface> surface = read_beside_mesh(place, o, mesh, facts, warnings);
  return [&mesh, surface](const mm3::Face& face) { return surface->contains(center_of(mesh, face)); };
}

void mark(const Mesh& mesh, const std::vector<std::string>& places, Patch patch, const Options& o,
          std::vector<std::string>& warnings, Boundary_patches& patches)
{
  for(const std::string& place : places) {
    if(place == base_patch)
      continue; // defined by the height of vertices
    const Contains contains = place == skull_patch ? [](const mm3::Face&) { return true; }
                                                   : read_patch(mesh, place, o, warnings);
    bool is_empty = true;
    for(std::size_t i = 0; i < patches.faces.size(); ++i)
      if(contains(patches.faces[i])) {
        is_empty = false;
        if(patches.of_faces[i] == Patch::NONE)
          patches.of_faces[i] = patch;
      }
    if(is_empty)
      throw std::runtime_error(
        place + ": no face of the boundary of " + o.mesh
        + (label_of(place) ? " has this label" : " has its center inside; " + place_of_mesh(mesh)));
  }
}

using Key = std::array<mm3::Vertex_index, 4>;

// A key that is the same for faces with the same vertices.
Key key_of(const mm3::Face& face, const std::vector<Mesh::Vertex_index>& vertices_before)
{
  Key key = face.vertices().padded();
  if(!vertices_before.empty())
    std::transform(face.vertices().begin(), face.vertices().end(), key.begin(),
                   [&](mm3::Vertex_index v) { return vertices_before[v]; });
  std::sort(key.begin(), key.end());
  return key;
}

} // namespace

Boundary_patches find_patches(const Mesh& mesh, const Options& o, std::vector<std::string>& warnings)
{
  Boundary_patches patches;
  patches.of_vertices.assign(mesh.number_of_vertices(), Patch::NONE);
  if(!o.has_patches())
    return patches;
  patches.faces = mm3::boundary_faces(mesh);
  patches.of_faces.assign(patches.faces.size(), Patch::NONE);
  mark(mesh, o.openings, Patch::OPENING, o, warnings, patches);
  mark(mesh, o.fixed_patches, Patch::FIXED, o, warnings, patches);
  mark(mesh, o.sliding_patches, Patch::SLIDING, o, warnings, patches);
  mark(mesh, o.touching_patches, Patch::TOUCHING, o, warnings, patches);

  // Stronger patches at a vertex come later; an opening has to have all faces of the vertex.
  for(Patch patch : {Patch::OPENING, Patch::NONE, Patch::TOUCHING, Patch::SLIDING, Patch::FIXED})
    for(std::size_t i = 0; i < patches.faces.size(); ++i)
      if(patches.of_faces[i] == patch)
        for(mm3::Vertex_index v : patches.faces[i].vertices())
          patches.of_vertices[v] = patch;
  return patches;
}

std::vector<mm3::IO::Facet_set> facet_sets(const Mesh& mesh,
                                           const std::vector<Mesh::Vertex_index>& vertices_before,
                                           const Boundary_patches& patches, const Supports& supports,
                                           const Options& o)
{
  if(!o.has_patches())
    return {};
  std::map<Key, Patch> patch_of;
  for(std::size_t i = 0; i < patches.faces.size(); ++i)
    patch_of.emplace(key_of(patches.faces[i], {}), patches.of_faces[i]);
  enum { FIXED, SLIDING, TOUCHING, OPENING, CAVITY };
  std::vector<mm3::IO::Facet_set> sets{
    {"fixed", {}}, {"sliding", {}}, {"touching", {}}, {"opening", {}}, {"cavity", {}}};
  for(const mm3::Face& face : mm3::boundary_faces(mesh)) {
    const auto place = patch_of.find(key_of(face, vertices_before));
    int free = 0, sliding = 0, touching = 0;
    for(mm3::Vertex_index v : face.vertices()) {
      const Support support = supports.of_vertices[vertices_before.empty() ? v : vertices_before[v]];
      free += support == Support::FREE;
      sliding += support == Support::SLIDING;
      touching += support == Support::TOUCHING;
    }
    if(place == patch_of.end())
      sets[CAVITY].faces.push_back(face);
    else if(place->second == Patch::OPENING)
      sets[OPENING].faces.push_back(face);
    else if(free == 0)
      sets[touching > 0 ? TOUCHING : sliding > 0 ? SLIDING : FIXED].faces.push_back(face);
  }
  return sets;
}
