// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INP_H
#define CGAL_MIXED_MESH_3_IO_INP_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/facet_sets.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ios>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

/// Numbers from 1, 16 on a line at most, as Abaqus wants them.
template <class Indices>
void write_INP_set(Buffered_output& out, const std::string& header, const Indices& indices)
{
  int on_line = 0;
  for(auto i : indices) {
    out << (on_line == 0 ? header + '\n' : on_line % 16 == 0 ? ",\n" : ", ") << i + 1;
    ++on_line;
  }
  if(on_line != 0)
    out << '\n';
}

/// An element, 16 numbers on a line at most; a comma at its end tells that the next one goes on.
inline void write_INP_element(Buffered_output& out, Element_index e, const Node_list& nodes)
{
  out << e + 1;
  int on_line = 1;
  for(Vertex_index node : nodes) {
    out << (on_line % 16 == 0 ? ",\n" : ",") << std::uint64_t(node) + 1;
    ++on_line;
  }
  out << '\n';
}

/// A surface is made of sets of elements, one for each number that the face has in its element. Their names
/// begin with an underscore, as those that Abaqus/CAE gives: names of users begin with a letter.
template <class Mesh>
void write_INP_surface(Buffered_output& out, const Mesh& mesh, const Facet_set& set)
{
  constexpr int most_faces = 6;
  const std::string name = in_upper_case(set.name);
  std::vector<Element_index> elements[most_faces];
  for(const Face& face : set.faces) {
    const Element_names& names = element_names[mesh.element(face.element()).kind()];
    elements[names.abaqus_faces[face.local_index()] - 1].push_back(face.element());
  }
  const auto name_of = [&name](int i) { return '_' + name + "_S" + std::to_string(i + 1); };
  for(int i = 0; i < most_faces; ++i)
    write_INP_set(out, "*ELSET, ELSET=" + name_of(i), elements[i]);
  if(!set.faces.empty())
    out << "*SURFACE, NAME=" << name << ", TYPE=ELEMENT\n";
  for(int i = 0; i < most_faces; ++i)
    if(!elements[i].empty())
      out << name_of(i) << ", S" << i + 1 << '\n';
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3IO

\brief Writes a mesh as input of Abaqus (`.inp`): nodes, elements and sets, no analysis.

Element sets: `REGION` and `REST` for the elements of subdomain 1 in the region and the others,
`SUBDOMAIN_2_REGION` and so on for those of other subdomains, each made of one set for each type, such as
`REGION_C3D8`. The boundary is the node set and the surface `BOUNDARY`, and each facet set is a node set and a
surface with its name in upper case. Surfaces are of type `ELEMENT`, made of element sets such as `_NAME_S1`:
the elements with their face S1 in the set. Subdomains with names are element sets with these in upper case,
too. The numbers of nodes and elements are the indices plus 1.

Quadratic elements, of order 2, are C3D10, C3D15 and C3D20, which CalculiX has, too; node sets have the middle
nodes of their faces then. Abaqus has no quadratic pyramid.

\note CalculiX has no pyramids, and Gmsh 4.8 drops them when it reads this format: see
`split_to_tetrahedra()`.

\param stream the stream
\param mesh the mesh
\param facet_sets named faces
\param subdomain_names of those that have one
\param order of the elements, 1 or 2: see `Write_options::order`

\return whether the stream took everything. If the order is 2 and the mesh has pyramids, then nothing is
        written, and the stream's `failbit` is set.
*/
template <class Mesh>
bool write_INP(std::ostream& stream, const Mesh& mesh, const std::vector<Facet_set>& facet_sets = {},
               const Subdomain_names& subdomain_names = {}, int order = 1)
{
  using namespace internal;
  if(!has_all_kinds(mesh, order, &Element_names::abaqus_type)) {
    stream.setstate(std::ios_base::failbit);
    return false;
  }
  const Mesh_nodes<Mesh> nodes(mesh, order);
  const Element_blocks blocks(mesh);
  const auto type = [order](const Element_block& block) { return names_of(block.kind, order).abaqus_type; };
  const auto set_name = [&blocks](std::size_t part) { return in_upper_case(blocks.parts()[part].name()); };

  Buffered_output out(stream);
  out << "*HEADING\nMixed-element mesh written by Mixed_mesh_3\n*NODE\n";
  for(std::size_t node = 0; node < nodes.size(); ++node) {
    out << node + 1 << ", ";
    write_point(out, nodes.point(node), ", ");
    out << '\n';
  }

  for(const Element_block& block : blocks) {
    out << "*ELEMENT, TYPE=" << type(block) << ", ELSET=" << set_name(block.part) << '_' << type(block)
        << '\n';
    for(Element_index e : block)
      write_INP_element(out, e, nodes.of(e, &Element_names::abaqus_edges));
  }

  // A set of sets: no second list of all elements.
  for(std::size_t part = 0; part < blocks.parts().size(); ++part) {
    out << "*ELSET, ELSET=" << set_name(part) << '\n';
    for(const Element_block& block : blocks)
      if(block.part == part)
        out << set_name(part) << '_' << type(block) << '\n';
  }

  for(const auto& [name, parts] : blocks.named_parts(subdomain_names)) {
    out << "*ELSET, ELSET=" << in_upper_case(name) << '\n';
    for(std::size_t part : parts)
      out << set_name(part) << '\n';
  }

  const auto write_set = [&](const Facet_set& set) {
    write_INP_set(out, "*NSET, NSET=" + in_upper_case(set.name), nodes.of(set.faces));
    write_INP_surface(out, mesh, set);
  };
  write_set({"boundary", boundary_faces(mesh)});
  std::for_each(facet_sets.begin(), facet_sets.end(), write_set);
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INP_H
