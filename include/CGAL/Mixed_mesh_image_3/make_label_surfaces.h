// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion of a segmentation with several labels to closed surfaces that have their triangles in common
// where labels touch.

#ifndef CGAL_MIXED_MESH_IMAGE_3_MAKE_LABEL_SURFACES_H
#define CGAL_MIXED_MESH_IMAGE_3_MAKE_LABEL_SURFACES_H

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_image_3/Label_change_3.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Label_network.h>
#include <CGAL/Mixed_mesh_image_3/internal/Label_scores.h>
#include <CGAL/Mixed_mesh_image_3/internal/Network_simplifier.h>
#include <CGAL/Mixed_mesh_image_3/internal/find_label_changes.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMeshImage3Ref

\brief The closed surfaces around the voxels of several labels, with common triangles where labels touch.

The indicator of each label is smoothed by a Gaussian, as by `make_label_surface()`. A point is inside where
the sum of all is large enough, and belongs to the label with the largest value then (Stalling, Z&ouml;ckler,
Hege: Segmentation of 3D medical images with subvoxel accuracy, 1998), after the values have been multiplied
by a weight of each label such that it has the volume of its voxels: so a layer of one voxel keeps its
thickness, and a ball its volume, beside larger ones. Each cube between eight centers of voxels is split into
six tetrahedra, in which labels are separated at places of equal values; where three or more meet, at a point
in the tetrahedron. Labels do not touch where they have no common face of voxels: a layer of one voxel has no
holes. Of a label of very few voxels nothing is left.

So each surface is a closed oriented 2-manifold, and no two triangles of any surfaces meet in more than their
common vertices and edges: `Labeled_polyhedral_mixed_mesh_domain_3` has neither gaps nor overlaps then, and
brings interfaces onto the common triangles. All surfaces are simplified together, by quadric errors (Garland,
Heckbert, 1997), and keep their topology and that of the curves in which they meet. They are smooth: meshes of
them should have `Mixed_mesh_criteria_3::sharp_angle(0)`, as their sharp edges are noise.

\tparam HasLabel `bool(float)`, of which at most one is true for each value
\tparam Surface_mesh_ a `CGAL::Surface_mesh` with points that can be made of three `double`
\param image segmentation. Its `index_to_world` may be oblique, or mirror
\param has_label whether voxels of a value have the first label, the second, and so on. \pre at most 65,534
\param extents box of voxels of each label, with their number, as from `label_extents()`
\param smoothing standard deviation of the Gaussian, in millimeters; with 0, the surfaces have the steps of
the voxels. The largest spacing of voxels is a good choice
\param number_of_vertices number of vertices of all surfaces together, approximately, each counted once; 0:
the surfaces are not simplified
\param changes if not null, the changes of topology between the voxels and the surfaces: bodies of a label
that are lost, parted, joined or added, and handles; of all labels together, cavities as well. Where voxels of
a label have only an edge or a corner in common, they may be connected or not: neither is a change. The
changes of all labels together come first, then those of each
\tparam ConcurrencyTag enables sequential versus parallel computation. The result does not depend on it.
        Possible values are `Sequential_tag`, `Parallel_tag`, and `Parallel_if_available_tag`
\return the surface around all labels, then that of each label, in millimeters, outward oriented; an empty one
if nothing is left of a label
\pre `smoothing >= 0`, the determinant of `image.grid.index_to_world` is not 0

\par Complexity
Linear in the number of voxels of the boxes, times the width of the Gaussian in voxels; and O(n log n) for n
voxels at interfaces. The changes are linear in the number of voxels of the boxes, and O(r log r) for r
rows of voxels of a label
*/
template <class Surface_mesh_, class ConcurrencyTag = Sequential_tag, class HasLabel>
std::vector<Surface_mesh_>
make_label_surfaces(const Voxel_image_3& image, const std::vector<HasLabel>& has_label,
                    const std::vector<Label_extent_3>& extents, double smoothing,
                    std::size_t number_of_vertices = 0, std::vector<Label_change_3>* changes = nullptr)
{
  CGAL_precondition(smoothing >= 0 && determinant(image.grid.index_to_world) != 0);
  CGAL_precondition(has_label.size() == extents.size());
  CGAL_precondition(has_label.size() < std::numeric_limits<internal::Label_number>::max());
  const unsigned threads = internal::number_of_threads<ConcurrencyTag>();
  std::vector<Surface_mesh_> surfaces(has_label.size() + 1);
  std::array<double, 3> deviations = voxel_spacing(image.grid);
  for(double& d : deviations)
    d = smoothing / d;
  if(changes != nullptr)
    changes->clear();
  internal::Label_scores scores(image, has_label, extents, deviations, threads);
  if(scores.is_empty())
    return surfaces;
  internal::Label_network network = internal::balanced_network(scores, extents, deviations);
  if(changes != nullptr)
    *changes = internal::find_label_changes(scores, has_label.size(), image.grid.index_to_world, threads);
  for(Vec3& p : network.points) {
    const std::array<double, 3> q = transform(image.grid.index_to_world, {p[0], p[1], p[2]});
    p = {q[0], q[1], q[2]};
  }
  if(determinant(image.grid.index_to_world) < 0)
    for(auto& t : network.triangles)
      std::swap(t.vertices[1], t.vertices[2]);
  if(number_of_vertices > 0)
    network = internal::Network_simplifier(std::move(network), threads)(number_of_vertices);

  using Vertex = typename Surface_mesh_::Vertex_index;
  std::vector<std::unordered_map<std::uint32_t, Vertex>> vertices(surfaces.size());
  const auto add = [&](std::size_t label, const std::array<std::uint32_t, 3>& t) {
    std::array<Vertex, 3> v;
    for(std::size_t i = 0; i < 3; ++i) {
      const auto [vertex, is_new] = vertices[label].try_emplace(t[i]);
      if(is_new) {
        const Vec3& p = network.points[t[i]];
        vertex->second = surfaces[label].add_vertex(typename Surface_mesh_::Point(p[0], p[1], p[2]));
      }
      v[i] = vertex->second;
    }
    const auto face = surfaces[label].add_face(v[0], v[1], v[2]);
    CGAL_assertion(face != Surface_mesh_::null_face());
    CGAL_USE(face);
  };
  for(const auto& t : network.triangles) {
    const std::array<std::uint32_t, 3> turned{t.vertices[0], t.vertices[2], t.vertices[1]};
    if(t.labels[0] == 0)
      add(0, turned);
    else
      add(t.labels[0], t.vertices);
    add(t.labels[1], turned);
  }
  return surfaces;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_MAKE_LABEL_SURFACES_H
