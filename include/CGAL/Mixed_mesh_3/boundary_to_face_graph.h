// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_BOUNDARY_TO_FACE_GRAPH_H
#define CGAL_MIXED_MESH_3_BOUNDARY_TO_FACE_GRAPH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Some elements of a mesh, with the numbers of its vertices: the part of a mesh that `boundary_faces()`
/// needs.
struct Elements_of_subdomain
{
  Element_list list;
  std::size_t size_of_points = 0;

  template <class Mesh>
  Elements_of_subdomain(const Mesh& mesh, std::optional<Subdomain_index> index)
    : size_of_points(mesh.number_of_vertices())
  {
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      if(!index || mesh.subdomain_index(Element_index(e)) == *index) {
        const Element_view element = mesh.element(Element_index(e));
        list.add(element.kind(), element.begin());
      }
  }
  const Element_list& elements() const { return list; }
  std::size_t number_of_vertices() const { return size_of_points; }
};

template <class Mesh, class FaceGraph, class NamedParameters>
bool boundary_to_face_graph(const Mesh& mesh, std::optional<Subdomain_index> index, FaceGraph& graph,
                            const NamedParameters& np)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  const auto points_of_graph = parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::vertex_point), get_property_map(CGAL::vertex_point, graph));
  using Point = typename boost::property_traits<std::decay_t<decltype(points_of_graph)>>::value_type;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  std::map<Vertex_index, std::size_t> numbers;
  for(const Face& face : boundary_faces(Elements_of_subdomain(mesh, index))) {
    polygons.emplace_back();
    for(const Vertex_index v : face.vertices()) {
      const auto [position, is_new] = numbers.try_emplace(v, points.size());
      if(is_new) {
        const auto& p = mesh.point(v);
        points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
      }
      polygons.back().push_back(position->second);
    }
  }
  if(!PMP::is_polygon_soup_a_polygon_mesh(polygons))
    return false;
  PMP::polygon_soup_to_polygon_mesh(points, polygons, graph, parameters::default_values(),
                                    parameters::vertex_point_map(points_of_graph));
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3

/*!
\ingroup PkgMixedMesh3Validity

\brief Adds the boundary of a mesh to a surface mesh.

The faces are triangles and quadrilaterals, oriented outwards. The vertices are those of the boundary, in the
order in which its faces have them.

\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam FaceGraph a model of `MutableFaceGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
\param mesh a conforming mesh
\param graph graph to which the boundary is added
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of `graph`}
    \cgalParamType{a model of `ReadWritePropertyMap` with the vertices as keys and points as values}
    \cgalParamDefault{`get_property_map(CGAL::vertex_point, graph)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return whether the boundary is a 2-manifold, as a `MutableFaceGraph` has to be; if not, nothing is added
\par Complexity
O(n log n) for n faces on the boundary, and linear in the number of elements
*/
template <class GeomTraits, class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
bool boundary_to_face_graph(const Mixed_mesh_3<GeomTraits>& mesh, FaceGraph& graph,
                            const NamedParameters& np = parameters::default_values())
{
  return Mixed_meshes_3::internal::boundary_to_face_graph(mesh, std::nullopt, graph, np);
}

/*!
\ingroup PkgMixedMesh3Validity

Overload for the boundary of one subdomain: oriented outwards, interfaces to other subdomains included.
Nothing is added if no element has the label.
*/
template <class GeomTraits, class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
bool boundary_to_face_graph(const Mixed_mesh_3<GeomTraits>& mesh, Mixed_meshes_3::Subdomain_index index,
                            FaceGraph& graph, const NamedParameters& np = parameters::default_values())
{
  return Mixed_meshes_3::internal::boundary_to_face_graph(mesh, index, graph, np);
}

} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_BOUNDARY_TO_FACE_GRAPH_H
