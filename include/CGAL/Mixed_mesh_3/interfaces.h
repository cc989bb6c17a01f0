// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERFACES_H
#define CGAL_MIXED_MESH_3_INTERFACES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Validity
/// The interface of two subdomains of a mesh, or of a subdomain and the outside.
struct Subdomain_interface
{
  Subdomain_index first = 1;  ///< positive, less than the second one
  Subdomain_index second = 0; ///< 0: the outside
  std::vector<Face> faces;    ///< faces of elements of the first subdomain, in the order of the elements
  /// The sum of the areas of the faces, in the square of the mesh's unit.
  double area = 0;
  /// Edges that are not between two faces of the interface, although no third subdomain meets there.
  std::vector<std::pair<Vertex_index, Vertex_index>> bad_edges = {};
  /// Vertices with more than one fan of faces of the interface.
  std::vector<Vertex_index> bad_vertices = {};

  /// Whether the interface is an oriented 2-manifold whose border is where three subdomains meet, which may
  /// include the outside.
  bool is_manifold() const { return bad_edges.empty() && bad_vertices.empty(); }
};

namespace internal {

class Interface_checker
{
  using Edge = std::pair<Vertex_index, Vertex_index>;

  std::map<Edge, std::size_t> m_faces_at_edges; // number of faces of all interfaces at each edge

  static Edge edge(const Face_vertices& v, int i) { return std::minmax(v[i], v[(i + 1) % v.size()]); }

public:
  explicit Interface_checker(const std::vector<Subdomain_interface>& interfaces)
  {
    for(const Subdomain_interface& one : interfaces)
      for(const Face& face : one.faces)
        for(int i = 0; i < face.vertices().size(); ++i)
          ++m_faces_at_edges[edge(face.vertices(), i)];
  }

  void operator()(Subdomain_interface& one) const
  {
    std::map<Edge, std::array<int, 2>> edges; // number of uses in each direction
    std::vector<Face_vertices> polygons;
    for(const Face& face : one.faces) {
      const Face_vertices& v = polygons.emplace_back(face.vertices());
      for(int i = 0; i < v.size(); ++i)
        ++edges[edge(v, i)][v[i] < v[(i + 1) % v.size()] ? 0 : 1];
    }
    for(const auto& [e, times] : edges) {
      const bool is_inside = times[0] == 1 && times[1] == 1,
                 is_border = times[0] + times[1] == 1 && m_faces_at_edges.at(e) > 2;
      if(!is_inside && !is_border)
        one.bad_edges.push_back(e);
    }
    one.bad_vertices = vertices_with_several_fans(polygons);
  }
};

} // namespace internal

/*!
\ingroup PkgMixedMesh3Validity

The interfaces between the subdomains of a mesh, and the interfaces to the outside, which are the boundary;
sorted by their subdomains.

\param mesh a conforming mesh
\par Complexity
O(n log n) for n elements
*/
template <class Mesh>
std::vector<Subdomain_interface> find_interfaces(const Mesh& mesh)
{
  std::map<std::pair<Subdomain_index, Subdomain_index>, std::vector<Face>> faces;
  internal::for_each_face(mesh.elements(), mesh.number_of_vertices(), [&](const auto& group) {
    const Subdomain_index a = mesh.subdomain_index(group.element(0)),
                          b = group.size() > 1 ? mesh.subdomain_index(group.element(1)) : 0;
    if(b == 0 || a < b)
      faces[{a, b}].push_back(group[0]);
    else if(b < a)
      faces[{b, a}].push_back(group[1]);
  });
  std::vector<Subdomain_interface> interfaces;
  for(auto& [subdomains, of_one] : faces) {
    std::sort(of_one.begin(), of_one.end());
    interfaces.push_back({subdomains.first, subdomains.second, std::move(of_one)});
    for(const Face& face : interfaces.back().faces)
      interfaces.back().area += area(mesh, face);
  }
  const internal::Interface_checker check(interfaces);
  for(Subdomain_interface& one : interfaces)
    check(one);
  return interfaces;
}

/*!
\ingroup PkgMixedMesh3Validity

The number of vertices of an interface that are farther from its surface than a share of the diagonal of the
domain's box.

\tparam Domain a model of `MixedMeshLabeledDomain_3`
*/
template <class Mesh, class Domain>
std::size_t number_of_vertices_off_interface(const Mesh& mesh, const Subdomain_interface& interface,
                                             const Domain& domain, double share_of_diagonal = 1e-9)
{
  using Point_3 = typename Domain::Point_3;
  const auto& box = domain.bbox();
  const double most = share_of_diagonal * norm({box.x_span(), box.y_span(), box.z_span()});
  const std::vector<Subdomain_index> order(domain.subdomain_indices().begin(),
                                           domain.subdomain_indices().end());
  Subdomain_index first = interface.first, second = interface.second;
  if(second != 0 && internal::rank_of(order, second) < internal::rank_of(order, first))
    std::swap(first, second);
  const std::vector<Vertex_index> vertices = vertices_of(interface.faces);
  return std::size_t(std::count_if(vertices.begin(), vertices.end(), [&](Vertex_index v) {
    const Vec3 p = to_vec3(mesh.point(v));
    return norm(to_vec3(domain.closest_point(Point_3(p[0], p[1], p[2]), first, second)) - p) > most;
  }));
}

/// \ingroup PkgMixedMesh3Validity
/// The volume of each subdomain.
template <class Mesh>
std::map<Subdomain_index, double> volumes_of_subdomains(const Mesh& mesh)
{
  std::map<Subdomain_index, double> volumes;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    volumes[mesh.subdomain_index(e)] += volume(mesh, e);
  return volumes;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERFACES_H
