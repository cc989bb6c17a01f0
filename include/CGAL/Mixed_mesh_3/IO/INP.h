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
#include <CGAL/Mixed_mesh_3/IO/internal/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/IO/internal/facet_sets.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <cstddef>
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

/// A surface is made of sets of elements, one for each number that the face has in its element.
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
  const auto name_of = [&name](int i) { return name + "_S" + std::to_string(i + 1); };
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
`REGION_C3D8`. Node set: `BOUNDARY`, the vertices of the boundary faces. For each facet set a surface of
elements with its name in upper case, of element sets such as `NAME_S1`: the elements with their face S1 in
the set. Subdomains with names are element sets with these in upper case, too. The numbers of nodes and
elements are the indices plus 1.

\note CalculiX has no pyramids, and Gmsh 4.8 drops them when it reads this format: see
`split_to_tetrahedra()`.

\return whether the stream took everything.
*/
template <class Mesh>
bool write_INP(std::ostream& stream, const Mesh& mesh, const std::vector<Facet_set>& facet_sets = {},
               const Subdomain_names& subdomain_names = {})
{
  using namespace internal;
  const Element_blocks blocks(mesh);
  const auto set_name = [&blocks](std::size_t part) { return in_upper_case(blocks.parts()[part].name()); };

  Buffered_output out(stream);
  out << "*HEADING\nMixed-element mesh written by Mixed_mesh_3\n*NODE\n";
  for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v) {
    out << v + 1 << ", ";
    write_point(out, Mixed_meshes_3::to_vec3(mesh.points()[v]), ", ");
    out << '\n';
  }

  for(const Element_block& block : blocks) {
    out << "*ELEMENT, TYPE=" << block.names().abaqus_type << ", ELSET=" << set_name(block.part) << '_'
        << block.names().abaqus_type << '\n';
    for(Element_index e : block) {
      out << e + 1 << ',';
      write_vertices(out, mesh.element(e), ',');
      out << '\n';
    }
  }

  // A set of sets: no second list of all elements.
  for(std::size_t part = 0; part < blocks.parts().size(); ++part) {
    out << "*ELSET, ELSET=" << set_name(part) << '\n';
    for(const Element_block& block : blocks)
      if(block.part == part)
        out << set_name(part) << '_' << block.names().abaqus_type << '\n';
  }

  for(const auto& [name, parts] : blocks.named_parts(subdomain_names)) {
    out << "*ELSET, ELSET=" << in_upper_case(name) << '\n';
    for(std::size_t part : parts)
      out << set_name(part) << '\n';
  }

  write_INP_set(out, "*NSET, NSET=BOUNDARY", boundary_vertices(mesh));
  for(const Facet_set& set : facet_sets)
    write_INP_surface(out, mesh, set);
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INP_H
