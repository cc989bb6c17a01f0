// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_SHELL_COUNTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_SHELL_COUNTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The share of the volume of a solid below which a part is a speck: whether a mesh has the part does not
/// matter. It is a hundredth in each direction: 0.01^3.
constexpr double volume_share_of_speck = 1e-6;

/// The shells of a closed surface: for each vertex, the number of its shell.
struct Shells_of_vertices
{
  static constexpr std::size_t unused = std::size_t(-1);

  Shell_counts counts;               ///< number of shells, without cavities
  std::vector<std::size_t> shell_of; ///< shell of each vertex, or unused
};

/// \param polygons ranges of vertex indices; if some edge does not belong to two polygons, the Euler
/// characteristic means nothing
/// \par Complexity
/// Nearly linear
template <class Polygons>
Shells_of_vertices find_shells(const Polygons& polygons, std::size_t number_of_vertices)
{
  constexpr std::size_t unused = Shells_of_vertices::unused;
  Disjoint_sets sets(number_of_vertices);
  std::vector<std::uint8_t> is_used(number_of_vertices, 0);
  Shells_of_vertices shells;
  Shell_counts& counts = shells.counts;
  std::size_t number_of_halfedges = 0, number_of_faces = 0;
  for(const auto& polygon : polygons) {
    for(const std::size_t v : polygon)
      if(std::exchange(is_used[v], 1) == 0)
        ++counts.euler_characteristic;
    for(const std::size_t v : polygon)
      sets.unite(*polygon.begin(), v);
    number_of_halfedges += polygon.size();
    ++number_of_faces;
  }
  counts.euler_characteristic += std::ptrdiff_t(number_of_faces) - std::ptrdiff_t(number_of_halfedges / 2);
  shells.shell_of.assign(number_of_vertices, unused);
  for(std::size_t v = 0; v < number_of_vertices; ++v)
    if(is_used[v]) {
      const std::size_t least = sets.least(v);
      shells.shell_of[v] = least == v ? counts.number_of_shells++ : shells.shell_of[least];
    }
  return shells;
}

/// Signed volumes of shells, positive where polygons are seen counterclockwise from outside.
/// \param point `Vec3` of a vertex
template <class Polygons, class Point>
std::vector<double> volumes_of_shells(const Shells_of_vertices& shells, const Polygons& polygons,
                                      const Point& point)
{
  std::vector<double> volumes(shells.counts.number_of_shells, 0);
  std::vector<Vec3> origins(volumes.size()); // on the shells: rounding errors are relative to their size
  std::vector<std::uint8_t> has_origin(volumes.size(), 0);
  for(const auto& polygon : polygons) {
    const auto v = polygon.begin();
    const std::size_t shell = shells.shell_of[*v];
    if(!has_origin[shell]) {
      has_origin[shell] = 1;
      origins[shell] = point(*v);
    }
    const Vec3 a = point(*v) - origins[shell];
    for(auto w = std::next(v, 2); w != polygon.end(); ++w)
      volumes[shell] += dot(a, cross(point(*std::prev(w)) - origins[shell], point(*w) - origins[shell])) / 6;
  }
  return volumes;
}

/// For each shell the mean chord of what it encloses, or is enclosed by: four times the volume by the area
/// (Cauchy).
template <class Polygons, class Point>
std::vector<double> mean_chords_of_shells(const Shells_of_vertices& shells, const Polygons& polygons,
                                          const Point& point)
{
  std::vector<double> chords = volumes_of_shells(shells, polygons, point), areas(chords.size(), 0);
  for(const auto& polygon : polygons) {
    const auto v = polygon.begin();
    for(auto w = std::next(v, 2); w != polygon.end(); ++w)
      areas[shells.shell_of[*v]] += norm(cross(point(*std::prev(w)) - point(*v), point(*w) - point(*v))) / 2;
  }
  for(std::size_t i = 0; i < chords.size(); ++i)
    chords[i] = 4 * std::abs(chords[i]) / areas[i];
  return chords;
}

/*!
For each shell a weight of its volume, so that a small one has vertices enough. Polyhedra with n vertices on a
shell of size r lack a volume in proportion to r^3 / n: with one weight, n is in proportion to r^1.5, and it
is to the square root of a weight. The largest shells have vertices first; those that there are none left for,
and specks, have the weight 1.

\param chords mean chords of shells
\param number_of_vertices of the mesh; about as many are inside as on shells
*/
inline std::vector<double> weights_of_shells(const std::vector<double>& chords, double number_of_vertices)
{
  // With 120, which lack a twentieth of the volume on a sphere, cavities of 2,000 vertices still lack more.
  constexpr double enough = 200;
  std::vector<std::pair<double, std::size_t>> by_chord;
  double sum = 0;
  for(std::size_t i = 0; i < chords.size(); ++i) {
    by_chord.emplace_back(-chords[i], i);
    sum += std::pow(chords[i], 1.5);
  }
  std::sort(by_chord.begin(), by_chord.end());
  std::vector<double> weights(chords.size(), 1);
  const double speck = std::cbrt(volume_share_of_speck) * -by_chord.front().first;
  for(std::size_t k = 1; k < by_chord.size() && enough * double(k) <= number_of_vertices / 2; ++k) {
    const std::size_t i = by_chord[k].second;
    const double expected = number_of_vertices / 2 * std::pow(chords[i], 1.5) / sum;
    if(expected < enough && chords[i] > speck)
      weights[i] = enough * enough / (expected * expected);
  }
  return weights;
}

/// The shells of faces of a mesh, with the thickness and the weight of each.
struct Weighted_shells
{
  std::vector<std::size_t> shell_of; ///< shell of each vertex
  std::vector<double> chords, weights;
};

/// \param number_of_vertices for `weights_of_shells()`
template <class Mesh>
Weighted_shells weigh_shells(const Mesh& mesh, const std::vector<Face>& faces, double number_of_vertices)
{
  std::vector<Face_vertices> polygons;
  for(const Face& face : faces)
    polygons.push_back(face.vertices());
  Shells_of_vertices shells = find_shells(polygons, mesh.number_of_vertices());
  const auto point = [&](std::size_t v) { return to_vec3(mesh.point(Vertex_index(v))); };
  std::vector<double> chords = mean_chords_of_shells(shells, polygons, point),
                      weights = weights_of_shells(chords, number_of_vertices);
  return {std::move(shells.shell_of), std::move(chords), std::move(weights)};
}

/// Sets signed volumes of shells, if there are several.
inline void set_volumes(Shell_counts& counts, std::vector<double> volumes)
{
  if(volumes.size() < 2)
    return;
  std::sort(volumes.begin(), volumes.end());
  counts.volumes = std::move(volumes);
}

/// The shells of the boundary of a mesh. \pre the boundary is a manifold, except where it is pinched
template <class Mesh>
Shell_counts shells_of_boundary(const Mesh& mesh)
{
  std::vector<Face_vertices> polygons;
  for(const Face& face : boundary_faces(mesh))
    polygons.push_back(face.vertices());
  const Shells_of_vertices shells = find_shells(polygons, mesh.number_of_vertices());
  std::vector<double> volumes = volumes_of_shells(shells, polygons, [&](std::size_t v) {
    return to_vec3(mesh.point(Vertex_index(v)));
  });
  Shell_counts counts = shells.counts;
  counts.number_of_cavities = std::size_t(
    std::count_if(volumes.begin(), volumes.end(), [](double v) { return v < 0; }));
  set_volumes(counts, std::move(volumes));
  return counts;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_SHELL_COUNTS_H
