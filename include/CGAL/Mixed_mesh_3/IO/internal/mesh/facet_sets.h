// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facet sets for writers: checked, on tetrahedra, as patches that no two sets share.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_FACET_SETS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_FACET_SETS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// The defect of names of subdomains, beside facet sets; empty if there is none.
inline std::string subdomain_name_defect(const Subdomain_names& subdomain_names,
                                         const std::vector<Facet_set>& sets)
{
  std::set<std::string> names;
  for(const Facet_set& set : sets)
    names.insert(in_upper_case(set.name));
  for(const auto& [index, name] : subdomain_names)
    if(!is_facet_set_name(name) || !names.insert(in_upper_case(name)).second)
      return "the subdomain " + std::to_string(index) + " has the name \"" + name
             + "\", which cannot be written, or is there twice";
  return std::string();
}

/// Whether faces are faces of the mesh, each of them once.
template <class Mesh>
bool are_faces_of(const Mesh& mesh, std::vector<Face> faces)
{
  for(const Face& face : faces) {
    if(face.element() >= mesh.number_of_elements()
       || face.local_index() >= mesh.element(face.element()).reference().number_of_faces)
      return false;
    const Face there(mesh.elements(), face.element(), face.local_index());
    if(there.vertices().padded() != face.vertices().padded())
      return false;
  }
  std::sort(faces.begin(), faces.end());
  return std::adjacent_find(faces.begin(), faces.end()) == faces.end();
}

/// The defect of facet sets; empty if there is none.
/// \param is_disjoint whether no face may be in two sets
template <class Mesh>
std::string facet_set_defect(const Mesh& mesh, const std::vector<Facet_set>& sets, bool is_disjoint)
{
  std::vector<std::string> names;
  std::vector<Face> all_faces;
  for(const Facet_set& set : sets) {
    const std::string place = "the facet set \"" + set.name + "\" ";
    names.push_back(in_upper_case(set.name));
    if(!is_facet_set_name(set.name) || std::count(names.begin(), names.end(), names.back()) != 1)
      return place + "needs another name: of letters, digits, _ and -, and not used otherwise";
    if(!are_faces_of(mesh, set.faces))
      return place + "has something that is not a face of the mesh, or a face twice";
    all_faces.insert(all_faces.end(), set.faces.begin(), set.faces.end());
  }
  std::sort(all_faces.begin(), all_faces.end());
  if(is_disjoint && std::adjacent_find(all_faces.begin(), all_faces.end()) != all_faces.end())
    return "two facet sets share a face, which this format cannot hold";
  return std::string();
}

/// The facet sets of tetrahedra into which the elements of given facet sets are split.
/// \param origins origins of the tetrahedra, ascending
template <class Mesh>
std::vector<Facet_set> split_facet_sets(const Mesh& tetrahedra, const std::vector<Element_index>& origins,
                                        const std::vector<Facet_set>& sets)
{
  std::vector<Facet_set> result;
  for(const Facet_set& set : sets) {
    result.push_back({set.name, {}});
    for(const Face& face : set.faces) {
      const auto [first, last] = std::equal_range(origins.begin(), origins.end(), face.element());
      const auto is_part = [&face](const Face& triangle) {
        return std::all_of(triangle.vertices().begin(), triangle.vertices().end(), [&face](Vertex_index v) {
          return std::count(face.vertices().begin(), face.vertices().end(), v) != 0;
        });
      };
      for(auto origin = first; origin != last; ++origin)
        for(int f = 0; f < reference_elements[TETRAHEDRON].number_of_faces; ++f)
          if(const Face triangle(tetrahedra.elements(), Element_index(origin - origins.begin()), f);
             is_part(triangle))
            result.back().faces.push_back(triangle);
    }
  }
  return result;
}

/// Faces that are in the same sets.
struct Face_patch
{
  std::vector<std::size_t> sets; ///< ascending
  bool is_on_boundary;
};

/// The boundary faces and the faces of sets as patches: each face is in one patch.
/// \par Complexity
/// O(n log n)
class Face_patches
{
  std::vector<Face> m_faces;
  std::vector<std::size_t> m_patch_of;
  std::vector<Face_patch> m_patches;
  int m_boundary_tag, m_first_tag;

public:
  /// \param boundary_tag number of the boundary
  /// \param first_tag number of the first set, and of the first patch beside the boundary
  template <class Mesh>
  Face_patches(const Mesh& mesh, const std::vector<Facet_set>& sets, int boundary_tag, int first_tag)
    : m_faces(boundary_faces(mesh)), m_boundary_tag(boundary_tag), m_first_tag(first_tag)
  {
    const std::size_t boundary_size = m_faces.size();
    std::map<Face, std::vector<std::size_t>> sets_of; // only of faces in sets
    for(std::size_t i = 0; i < sets.size(); ++i)
      for(const Face& face : sets[i].faces)
        sets_of[face].push_back(i);
    for(const auto& [face, of] : sets_of)
      if(!std::binary_search(m_faces.begin(), m_faces.begin() + std::ptrdiff_t(boundary_size), face))
        m_faces.push_back(face);

    using Key = std::pair<std::vector<std::size_t>, bool>; // the sets, and whether inside
    std::map<Key, std::size_t> patches;
    const auto key_of = [&](std::size_t i) {
      const auto place = sets_of.find(m_faces[i]);
      return Key(place == sets_of.end() ? std::vector<std::size_t>() : place->second, i >= boundary_size);
    };
    patches[Key()] = 0; // the boundary without sets, with or without faces
    for(std::size_t i = 0; !sets_of.empty() && i < m_faces.size(); ++i)
      patches[key_of(i)] = 0;
    for(auto& [key, number] : patches) {
      number = m_patches.size();
      m_patches.push_back({key.first, !key.second});
    }
    for(std::size_t i = 0; i < m_faces.size(); ++i)
      m_patch_of.push_back(sets_of.empty() ? 0 : patches.at(key_of(i)));
  }

  /// The boundary faces in the order of the elements, then the other faces in that order.
  const std::vector<Face>& faces() const { return m_faces; }
  std::size_t patch_of(std::size_t face) const { return m_patch_of[face]; }
  /// The patches, of which the first is the boundary without sets.
  const std::vector<Face_patch>& patches() const { return m_patches; }
  int set_tag(std::size_t set) const { return m_first_tag + int(set); }
  int tag(std::size_t patch) const { return patch == 0 ? m_boundary_tag : m_first_tag + int(patch) - 1; }
  /// The number of a face in formats with one number for each face: the number of its first set, else of the
  /// boundary.
  int only_tag(std::size_t face) const
  {
    const Face_patch& patch = m_patches[m_patch_of[face]];
    return patch.sets.empty() ? m_boundary_tag : set_tag(patch.sets.front());
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_FACET_SETS_H
