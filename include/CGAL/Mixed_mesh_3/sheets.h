// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets inside a mesh, such as the falx of a brain: faces that have an element on both sides.

#ifndef CGAL_MIXED_MESH_3_SHEETS_H
#define CGAL_MIXED_MESH_3_SHEETS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

/// The faces between compartments, from both sides: first the side of the smaller compartment.
template <class Mesh>
std::vector<std::pair<Face, Face>> faces_between_compartments(const Mesh& mesh)
{
  std::vector<std::pair<Face, Face>> faces;
  for_each_face(mesh.elements(), mesh.number_of_vertices(), [&](const auto& group) {
    if(group.size() != 2)
      return;
    const Element_attributes &a = mesh.attributes(group.element(0)), &b = mesh.attributes(group.element(1));
    if(!are_beside_sheet(a, b) || a.subdomain_index != b.subdomain_index)
      return;
    const std::size_t first = a.compartment < b.compartment ? 0 : 1;
    faces.emplace_back(group[first], group[1 - first]);
  });
  std::sort(faces.begin(), faces.end());
  return faces;
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3Validity

The faces between two elements of different compartments, which are the faces on sheets, seen from the element
of the smaller compartment; in the order of the elements.

A mesh has compartments if its domain has sheets, see `Labeled_polyhedral_mixed_mesh_domain_3::add_sheet()`.
All functions of this package that make a mesh out of another mesh keep compartments, and flips of tetrahedra
keep the faces between them. A face between subdomains is on their interface, and not on a sheet.

\param mesh a conforming mesh
\par Complexity
Linear in the number of elements, if the number of elements at a vertex is bounded
*/
template <class Mesh>
std::vector<Face> find_sheet_faces(const Mesh& mesh)
{
  std::vector<Face> faces;
  for(const auto& [first, second] : internal::faces_between_compartments(mesh))
    faces.push_back(first);
  return faces;
}

/// \ingroup PkgMixedMesh3Validity
/// The faces of a mesh on a sheet.
struct Sheet_in_mesh
{
  std::vector<Face> faces; ///< faces of the elements in front of the sheet
  /// The sum of the areas of the faces, in the square of the mesh's unit.
  double area = 0;
  /// The number of vertices of the faces.
  std::size_t number_of_vertices = 0;
  std::size_t number_of_vertices_off = 0; ///< vertices that are not on the sheet
  double largest_distance = 0;            ///< largest distance of a vertex from the sheet
  std::size_t number_of_bad_edges = 0;    ///< edges of more than two of the faces
};

/*!
\ingroup PkgMixedMesh3Validity

The faces of a mesh on each sheet of its domain. A face belongs to the sheet that is nearest to its vertices.

\tparam Domain a model of `MixedMeshDomainWithSheets_3`
\param mesh a mesh of the domain
\param domain the domain, with its sheets
\param share_of_diagonal largest distance from the sheet of a vertex that counts as on the sheet, as a share
of the diagonal of the domain's box
*/
template <class Mesh, class Domain>
std::vector<Sheet_in_mesh> find_sheets(const Mesh& mesh, const Domain& domain,
                                       double share_of_diagonal = 1e-9)
{
  using Point_3 = typename Domain::Point_3;
  const auto& box = domain.bbox();
  const double most = share_of_diagonal * norm({box.x_span(), box.y_span(), box.z_span()});
  const auto distance = [&](Vertex_index v, std::size_t i) {
    const Vec3 p = to_vec3(mesh.point(v));
    return norm(to_vec3(domain.sheets()[i]->closest_point(Point_3(p[0], p[1], p[2]))) - p);
  };
  std::vector<Sheet_in_mesh> sheets(domain.sheets().size());
  if(sheets.empty())
    return sheets;
  const auto height = [&](const Face& face, std::size_t i) { // height of the middle of the element
    const Element_view element = mesh.element(face.element());
    Vec3 sum{};
    for(Vertex_index v : element)
      sum = sum + to_vec3(mesh.point(v));
    const Vec3 p = (1. / element.size()) * sum;
    return domain.sheets()[i]->locate(Point_3(p[0], p[1], p[2])).height;
  };
  for(const auto& [face, opposite] : internal::faces_between_compartments(mesh)) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for(std::size_t i = 0; sheets.size() > 1 && i < sheets.size(); ++i) {
      double sum = 0;
      for(Vertex_index v : face.vertices())
        sum += distance(v, i);
      if(sum < least) {
        least = sum;
        nearest = i;
      }
    }
    const bool is_in_front = height(face, nearest) >= height(opposite, nearest);
    sheets[nearest].faces.push_back(is_in_front ? face : opposite);
  }
  for(std::size_t i = 0; i < sheets.size(); ++i) {
    Sheet_in_mesh& s = sheets[i];
    std::map<std::pair<Vertex_index, Vertex_index>, int> edges;
    for(const Face& face : s.faces) {
      const Face_vertices& v = face.vertices();
      s.area += area(mesh, face);
      for(int k = 0; k < v.size(); ++k)
        s.number_of_bad_edges += ++edges[std::minmax(v[k], v[(k + 1) % v.size()])] == 3;
    }
    for(Vertex_index v : vertices_of(s.faces)) {
      const double d = distance(v, i);
      ++s.number_of_vertices;
      s.number_of_vertices_off += d > most;
      s.largest_distance = (std::max)(s.largest_distance, d);
    }
  }
  return sheets;
}

/// \ingroup PkgMixedMesh3Validity
/// The area of a sheet inside a domain, by approximately the given number of samples.
/// \tparam Domain class with `subdomain_index(point)` for any point, such as
/// `Labeled_polyhedral_mixed_mesh_domain_3`
template <class Sheet, class Domain>
double area_inside(const Sheet& sheet, const Domain& domain, std::size_t number_of_samples = 20000)
{
  double sum = 0;
  for(const auto& [p, area] : sheet.area_samples(number_of_samples))
    if(domain.subdomain_index(p) != 0)
      sum += area;
  return sum;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SHEETS_H
