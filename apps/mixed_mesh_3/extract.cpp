// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/extract.h"

#include "core/messages.h"
#include "mixed_mesh_3/nodes.h"
#include "mixed_mesh_3/verdict.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/extract_subdomains.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// The subdomain of a name, upper or lower case, or null.
const Subdomain* subdomain_named(const std::string& name, const std::vector<Subdomain>& subdomains)
{
  const auto found = std::find_if(subdomains.begin(), subdomains.end(), [&name](const Subdomain& s) {
    return s.index != 0 && boost::iequals(s.name, name);
  });
  return found == subdomains.end() ? nullptr : &*found;
}

// Faces of a mesh in a part of the mesh.
class Faces_of_part
{
  using Key = std::array<mm3::Vertex_index, 4>;

  const Mesh& m_part;
  std::map<mm3::Element_index, mm3::Element_index> m_elements;
  std::map<Key, mm3::Face> m_boundary; // by the vertices of the mesh

  static Key key(Key vertices)
  {
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  }

public:
  Faces_of_part(const Mesh& part, const std::vector<mm3::Vertex_index>& vertices,
                const std::vector<mm3::Element_index>& elements)
    : m_part(part)
  {
    for(mm3::Element_index e = 0; e < elements.size(); ++e)
      m_elements.emplace_hint(m_elements.end(), elements[e], e);
    for(const mm3::Face& face : mm3::boundary_faces(part)) {
      mm3::Face_vertices in_mesh = face.vertices();
      for(int i = 0; i < in_mesh.size(); ++i)
        in_mesh[i] = vertices[in_mesh[i]];
      m_boundary.emplace(key(in_mesh.padded()), face);
    }
  }

  // The face of the same element, or of the one beyond the face if only that one is in the part.
  std::optional<mm3::Face> operator()(const mm3::Face& face) const
  {
    if(const auto same = m_elements.find(face.element()); same != m_elements.end())
      return mm3::Face(m_part.elements(), same->second, face.local_index());
    if(const auto beyond = m_boundary.find(key(face.vertices().padded())); beyond != m_boundary.end())
      return beyond->second;
    return std::nullopt;
  }
};

// Keeps the faces that a part of the mesh has.
void reduce(mm3::IO::Facet_set& set, const Faces_of_part& faces)
{
  std::vector<mm3::Face> in_part;
  for(const mm3::Face& face : set.faces)
    if(const auto found = faces(face))
      in_part.push_back(*found);
  set.faces = std::move(in_part);
}

} // namespace

void check_names_to_extract(const std::vector<std::string>& names, const std::vector<Subdomain>& subdomains)
{
  for(const std::string& name : names)
    if(subdomain_named(name, subdomains) == nullptr) {
      std::vector<std::string> known;
      for(const Subdomain& s : subdomains)
        if(s.index != 0)
          known.push_back(s.name);
      throw std::runtime_error("--extract " + name + ": " + sentence_on_no_subdomain(known)
                               + "; smoothing or completion may leave nothing of others");
    }
}

void extract(const std::vector<std::string>& names, int order, const std::string& budget,
             const std::vector<Subdomain>& subdomains, Mesh& mesh,
             std::vector<mm3::IO::Facet_set>& facet_sets, Outcome& outcome)
{
  if(names.empty())
    return;
  const std::map<mm3::Subdomain_index, double> volumes = mm3::volumes_of_subdomains(mesh);
  Extract_outcome result;
  std::vector<mm3::Subdomain_index> indices;
  for(const Subdomain& s : subdomains) { // in their order
    if(std::none_of(names.begin(), names.end(),
                    [&s](const std::string& name) { return boost::iequals(s.name, name); })
       || s.index == 0)
      continue;
    const auto volume = volumes.find(s.index);
    if(volume == volumes.end())
      throw std::runtime_error("--extract " + s.name
                               + ": the mesh has no element of this subdomain, which is too small for its "
                                 "cells; try more than "
                               + budget);
    indices.push_back(s.index);
    result.subdomains.push_back(s.name);
    result.volume += volume->second;
  }
  std::vector<mm3::Vertex_index> vertices;
  std::vector<mm3::Element_index> elements;
  Mesh part = mm3::extract_subdomains(mesh, indices, &vertices, &elements);
  const mm3::Mesh_defects defects = mm3::find_defects(part);
  if(!defects.conforming() || !defects.positive())
    throw Invalid_mesh("the mesh failed a check after --extract");
  const Faces_of_part faces(part, vertices, elements);
  for(mm3::IO::Facet_set& set : facet_sets)
    reduce(set, faces);
  mesh = std::move(part);
  result.mesh = facts_of(mesh);
  result.nodes = number_of_nodes(mesh, order);
  result.boundary_faces = mm3::boundary_faces(mesh).size();
  result.bad_edges = defects.nonmanifold_boundary_edges;
  result.bad_vertices = defects.nonmanifold_boundary_vertices;
  if(!defects.closed_manifold_boundary())
    outcome.warnings.push_back("--extract: the boundary of what is written is no manifold, at "
                               + counted(result.bad_edges, "edge", "edges") + " and "
                               + counted(result.bad_vertices, "vertex", "vertices")
                               + ", where elements meet without a common face");
  for(const mm3::Subdomain_interface& one : mm3::find_interfaces(mesh)) {
    Interface_outcome i;
    i.first = name_of(subdomains, one.first);
    i.second = name_of(subdomains, one.second);
    i.faces = one.faces.size();
    i.area = one.area;
    i.is_manifold = one.is_manifold();
    result.interfaces.push_back(std::move(i));
  }
  outcome.extract = std::move(result);
}
