// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pass that removes vertices of a fine mesh until a budget is met.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_SIMPLIFY_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_SIMPLIFY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Mesh_simplifier.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/fitting_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/weights_of_vertices.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/mesh_defects.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// For each vertex, why a mesh should be without it.
/// \param quality_bound what an element may cost
template <class Quality>
std::vector<Vertex_defect> vertex_defects(const Working_mesh& mesh, const std::vector<Face>& boundary,
                                          const std::vector<Vec3>& places, const Quality& quality,
                                          double quality_bound)
{
  std::vector<Vertex_defect> defects(places.size(), Vertex_defect::NONE);
  for(const Working_mesh::Element& element : mesh.elements)
    if(quality(element.kind, mesh.relative_points(element)) > quality_bound)
      for(Vertex_index v : element)
        defects[v] = Vertex_defect::ELEMENT;
  for(Vertex_index v : vertices_of_self_intersections(mesh.points, boundary))
    defects[v] = Vertex_defect::PLACE;
  for(Vertex_index v = 0; v < places.size(); ++v)
    if(places[v] != mesh.points[v])
      defects[v] = Vertex_defect::PLACE;
  return defects;
}

/// The weights of the volume at faces: that which a small subdomain, or a small shell, loses or gains is a
/// larger share of its own. The thickness of a subdomain is its mean chord.
/// \param number_of_vertices in the end
inline std::vector<double> weights_of_faces(const Core_mesh& mesh, const Interface_faces& faces,
                                            const Strata& strata, const Any_surface& surface,
                                            std::size_t number_of_vertices)
{
  std::vector<double> weights;
  if(surface.subdomain_indices().size() == 1) {
    const Weighted_shells shells = weigh_shells(mesh, faces.faces, double(number_of_vertices));
    for(const Face& face : faces.faces)
      weights.push_back(shells.weights[shells.shell_of[*face.vertices().begin()]]);
    return weights;
  }
  std::map<Subdomain_index, double> chords;
  double largest = 0;
  for(Subdomain_index index : surface.subdomain_indices())
    largest = (std::max)(largest, chords[index] = surface.mean_chord_length(index));
  for(Stratum of_face : faces.strata) {
    const double chord = chords[strata.interfaces(of_face).front().first];
    weights.push_back(chord > 0 ? largest * largest / (chord * chord) : 1);
  }
  return weights;
}

/// What simplification gives up, in the order of the members, while the mesh has too many vertices.
struct Simplification_concessions
{
  bool curves;          ///< that edges stay near to curved sharp edges
  bool region;          ///< that vertices of the region stay
  double distance;      ///< a smaller distance, for this one
  double quality_bound; ///< a smaller bound, for one of up to this one
  bool any_distance;    ///< the distance, altogether; if not, it is kept for all places that vertices have
                        ///< left, and not only for those that the vertex which goes stands for
};

/// The triangles of the boundary and of interfaces; quadrilaterals are two triangles each.
struct Boundary_to_simplify
{
  std::vector<Face_vertices> triangles;
  std::vector<std::uint8_t> is_on_boundary; ///< whether a triangle is on the boundary of the domain
  std::vector<double> weights;              ///< of the volume at each triangle

  Boundary_to_simplify(const Interface_faces& faces, const Strata& strata,
                       const std::vector<double>& weights_of_faces)
  {
    for(std::size_t f = 0; f < faces.faces.size(); ++f) {
      const Face_vertices& v = faces.faces[f].vertices();
      for(int i = 2; i < v.size(); ++i) {
        triangles.push_back({v[0], v[i - 1], v[i]});
        is_on_boundary.push_back(strata.is_on_boundary(faces.strata[f]));
        weights.push_back(weights_of_faces[f]);
      }
    }
  }
};

/// Holds vertices that no surface of the domain leads: those of sheets, and, if the domain has no labels,
/// those between subdomains of the mesh.
template <class Simplifier>
void hold_vertices_without_surface(const Working_mesh& mesh, const Interface_faces& faces,
                                   const Strata& strata, bool is_labeled, Simplifier& simplifier)
{
  for(std::size_t f = 0; f < faces.faces.size(); ++f)
    if(strata.is_on_sheet(faces.strata[f]))
      for(Vertex_index v : faces.faces[f].vertices())
        simplifier.hold(v);
  if(is_labeled)
    return;
  for(Vertex_index v = 0; v < mesh.points.size(); ++v) {
    const auto around = mesh.incident[v];
    if(std::any_of(around.begin(), around.end(), [&](Element_index e) {
         return mesh.elements[e].attributes.subdomain_index
                != mesh.elements[around.front()].attributes.subdomain_index;
       }))
      simplifier.hold(v);
  }
}

/*!
Removes vertices of a mesh whose boundary, and whose interfaces, are on their surfaces, until it has a given
number.

With sharp edges, bounds of up to twice the quality bound are conceded first, then that these edges of the
mesh stay near to those of the surface; then the other concessions are made.

\param followed sharp features that the mesh follows, which the result follows as well
\param number_of_vertices 0: as few as the limits allow
\param radius of the region, for `weights_of_vertices()`; 0: there is none
\param distance no place that a boundary vertex has left is farther from the boundary
\param quality_bound no new element costs more; becomes a larger one if there would be more vertices otherwise
\return whether the mesh has so few vertices then
\par Complexity
Some 60 microseconds for each vertex that is removed
*/
template <class Quality>
bool simplify(Core_mesh& mesh, Followed_features& followed, const Any_surface& surface,
              const Quality& quality, std::size_t number_of_vertices, double radius, double distance,
              double& quality_bound, const Simplification_concessions& concessions,
              const std::function<bool()>& go_on)
{
  // Bounds that are tried, one after the other, so that elements are no flatter than needed. A step of 2.5
  // makes no difference to seven meshes of 2,000 vertices.
  constexpr double step_of_bound = 1.25;
  // Multiple of the bound before sharp edges are given up. If they are given up first, eight of 38 CAD
  // surfaces of 2,000 vertices keep less of them, a coupling, a turbine and a gear by 14, 5 and 4 %, and two
  // keep more, by 3 % and less; a multiple of 1.25 keeps 2 and 4 % less of two.
  constexpr double largest_multiple_for_curves = 2;
  // Vertices of the start by those of the end, about, where the limits decide: of a ball of 3,000 vertices, a
  // hundredth of its diameter leaves 330. The result depends on it for shells of different sizes only.
  constexpr std::size_t expected_ratio = 10;
  CGAL_expensive_postcondition_code(const Mesh_defects defects_of_start = find_defects(mesh));
  Strata strata(surface);
  const Interface_faces faces = strata.sorted_faces(mesh);
  Working_mesh working(mesh, strata.of_vertices(mesh.number_of_vertices(), faces));
  working.set_sharp_strata(followed.strata);
  Surface_projection project(surface, strata);
  project.set_features(followed.features);
  const std::vector<Vec3> places = project.places(working);
  const std::vector<Vertex_defect> defects = vertex_defects(working, faces.faces, places, quality,
                                                            quality_bound);
  const std::size_t expected = number_of_vertices > 0 ? number_of_vertices
                                                      : mesh.number_of_vertices() / expected_ratio;
  const double share = double(expected) / double(mesh.number_of_vertices());
  const Boundary_to_simplify boundary(faces, strata,
                                      weights_of_faces(mesh, faces, strata, surface, expected));
  Mesh_simplifier<Quality> simplifier(working, quality, boundary.triangles, boundary.is_on_boundary,
                                      boundary.weights, places, defects, followed.features,
                                      std::size_t(share * double(boundary.triangles.size())));
  hold_vertices_without_surface(working, faces, strata, surface.is_labeled(), simplifier);
  if(!concessions.any_distance)
    simplifier.keep_all_places_near();
  const bool has_region = radius > 0;
  if(has_region)
    simplifier.set_weights(weights_of_vertices(working, radius));
  std::size_t n = mesh.number_of_vertices();
  const auto remove = [&](double d, bool follows_curves) {
    if(n > number_of_vertices && go_on())
      n -= simplifier(quality_bound, d, follows_curves, n - number_of_vertices, go_on);
  };
  const auto raise_bound = [&](double largest, bool follows_curves) {
    while(n > number_of_vertices && quality_bound < largest && go_on()) {
      quality_bound = (std::min)(step_of_bound * quality_bound, largest);
      remove(distance, follows_curves);
    }
  };
  remove(distance, true);
  if(!followed.features.polylines().empty())
    raise_bound((std::min)(largest_multiple_for_curves * quality_bound, concessions.quality_bound), true);
  if(concessions.curves)
    remove(distance, false);
  if(has_region && concessions.region) {
    simplifier.give_up_region();
    remove(distance, false);
  }
  if(concessions.distance > distance)
    remove(distance = concessions.distance, false);
  raise_bound(concessions.quality_bound, false);
  if(concessions.any_distance)
    remove(std::numeric_limits<double>::infinity(), false);
  followed.strata = working.sharp_strata();
  working.store(mesh);
  CGAL_postcondition(mesh.number_of_vertices() == n && followed.strata.of_vertices.size() == n);
  CGAL_expensive_postcondition(are_strata_of_faces(working, mesh, strata));
  CGAL_expensive_postcondition(has_no_new_defects(defects_of_start, mesh));
  return n <= number_of_vertices;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_SIMPLIFY_H
