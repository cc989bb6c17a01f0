// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/patches.h"

#include "core/patch_shapes.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

using Contains = std::function<bool(const mm3::Face&)>;

// The faces of a patch: faces of elements of a label, or faces with their center inside a shape or a surface.
Contains read_patch(const Mesh& mesh, const std::string& mesh_file, const std::string& place,
                    const mm3::IO::Read_anatomical_surface_options& options,
                    std::vector<std::string>& warnings)
{
  if(const auto label = label_of(place))
    return [&mesh, label](const mm3::Face& face) { return mesh.subdomain_index(face.element()) == *label; };
  if(const auto shape = patch_shape(place))
    return [&mesh, contains = shape->contains, tolerance = patch_tolerance(mesh)](const mm3::Face& face) {
      return contains(center_of(mesh, face), tolerance);
    };
  Surface_facts facts;
  const std::shared_ptr<const Closed_surface> surface = read_beside_mesh(place, options, mesh, mesh_file,
                                                                         facts, warnings);
  return [&mesh, surface](const mm3::Face& face) { return surface->contains(center_of(mesh, face)); };
}

void mark(const Mesh& mesh, const std::string& mesh_file, const std::vector<std::string>& places, Patch patch,
          const mm3::IO::Read_anatomical_surface_options& options, std::vector<std::string>& warnings,
          Boundary_patches& patches)
{
  for(const std::string& place : places) {
    if(place == base_patch)
      continue; // defined by the height of vertices
    const Contains contains = place == skull_patch ? [](const mm3::Face&) { return true; }
                                                   : read_patch(mesh, mesh_file, place, options, warnings);
    bool is_empty = true;
    for(std::size_t i = 0; i < patches.faces.size(); ++i)
      if(contains(patches.faces[i])) {
        is_empty = false;
        if(patches.of_faces[i] == Patch::NONE)
          patches.of_faces[i] = patch;
      }
    if(is_empty)
      throw std::runtime_error(
        place + ": no face of the boundary of " + mesh_file
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

std::optional<int> label_of(const std::string& patch)
{
  int label = 0;
  const std::string prefix = label_prefix;
  const char* const end = patch.data() + patch.size();
  if(patch.rfind(prefix, 0) != 0)
    return std::nullopt;
  const auto [rest, error] = std::from_chars(patch.data() + prefix.size(), end, label);
  return error == std::errc() && rest == end && label > 0 ? std::optional<int>(label) : std::nullopt;
}

Boundary_patches find_patches(const Mesh& mesh, const std::string& mesh_file, const Patch_options& o,
                              const mm3::IO::Read_anatomical_surface_options& surface_options,
                              std::vector<std::string>& warnings)
{
  Boundary_patches patches;
  patches.of_vertices.assign(mesh.number_of_vertices(), Patch::NONE);
  if(!o.are_given())
    return patches;
  patches.faces = mm3::boundary_faces(mesh);
  patches.of_faces.assign(patches.faces.size(), Patch::NONE);
  mark(mesh, mesh_file, o.openings, Patch::OPENING, surface_options, warnings, patches);
  mark(mesh, mesh_file, o.fixed, Patch::FIXED, surface_options, warnings, patches);
  mark(mesh, mesh_file, o.sliding, Patch::SLIDING, surface_options, warnings, patches);
  mark(mesh, mesh_file, o.touching, Patch::TOUCHING, surface_options, warnings, patches);

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
                                           const Boundary_patches& patches, const Supports& supports)
{
  if(patches.faces.empty())
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
