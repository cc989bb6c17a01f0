// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_FEB_H
#define CGAL_MIXED_MESH_3_IO_FEB_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/FEB_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <ostream>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMesh3IO

\brief Writes a mesh as model of FEBio (`.feb`), version 4.0.

The mesh: node set `all`, parts such as `region_hex8` and `rest_tet4` (of other subdomains than 1
`subdomain_2_rest_tet4` and so on), surface `boundary` (counter-clockwise seen from outside) and a surface for
each facet set, and node sets with the names of these surfaces and their nodes, with order 2 also the middle
ones. Where a subdomain has a name, say tumor, its parts are `tumor.region_hex8`, `tumor.rest_tet4`
and so on, and all of its elements are the element set `tumor`. FEBio takes no mesh without materials: there
is one for each subdomain with a name, which is also its own, and `region` and `rest`, or
`subdomain_2_region` and so on, for the others. Their numbers are to be replaced (neo-Hookean, Young's modulus
1, Poisson's ratio 0.45). There are no boundary conditions, loads or steps; `write_FEB_model()` writes them.
The numbers of nodes and elements are the indices plus 1.

Quadratic elements, of order 2, are tet10, pyra13, penta15 and hex20, and faces tri6 and quad8: FEBio has no
pyramid and no prism with more nodes.

Values at the vertices become mesh data, `NodeData` on the set `all`, which a prescribed displacement of the
model can refer to, for example.

\param stream the stream
\param mesh the mesh
\param facet_sets named faces
\param vertex_data of one or three components, as many as vertices
\param subdomain_names of those that have one
\param order of the elements, 1 or 2: see `Write_options::order`

\return whether the stream took everything.
*/
template <class Mesh>
bool write_FEB(std::ostream& stream, const Mesh& mesh, const std::vector<Facet_set>& facet_sets = {},
               const std::vector<Data_array>& vertex_data = {}, const Subdomain_names& subdomain_names = {},
               int order = 1)
{
  using namespace internal;
  const FEB_output<Mesh> output(mesh, subdomain_names, order);
  const Node_data node_data(output.nodes(), vertex_data);
  Buffered_output out(stream);
  output.write_head(out);
  output.write_materials(out, [&out](Subdomain_index) {
    out << "type=\"neo-Hookean\">\n      <density>1</density>\n      <E>1</E>\n      <v>0.45</v>\n";
  });
  std::vector<FEB_node_set> node_sets{{"boundary", output.nodes().of(boundary_faces(mesh))}};
  for(const Facet_set& set : facet_sets)
    node_sets.push_back({set.name, output.nodes().of(set.faces)});
  output.write_mesh(out, node_sets, facet_sets);
  std::vector<FEB_node_data> data;
  if(!mesh.is_empty())
    for(const Data_array& array : node_data.arrays())
      data.push_back({array, "all"});
  output.write_node_data(out, data);
  output.write_foot(out);
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_FEB_H
