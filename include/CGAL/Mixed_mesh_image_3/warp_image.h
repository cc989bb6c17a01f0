// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The image after the deformation: section 6.2 of Lobos, Bucki, Hitschfeld, Payan: "Mixed-element mesh for an
// intra-operative modeling of the brain tumor extraction".

#ifndef CGAL_MIXED_MESH_IMAGE_3_WARP_IMAGE_H
#define CGAL_MIXED_MESH_IMAGE_3_WARP_IMAGE_H

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Recovered_displacement_3.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/fade_displacement.h>
#include <CGAL/Mixed_mesh_image_3/internal/rasterize_displacement.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMeshImage3Ref
/// The value of an image between the centers of voxels.
enum class Image_interpolation {
  LINEAR, ///< `interpolate()`
  NEAREST ///< `nearest_value()`: for labels, which have no values in between
};

/// \ingroup PkgMixedMeshImage3Ref
/// The options of `warp_image()` and `resample_image()`.
struct Warp_options
{
  /// The distance in millimeters over which displacements fade outside the mesh: a voxel outside has the
  /// displacement of the nearest voxel of the mesh, times a factor that falls smoothly to zero over this
  /// distance. 0: no voxel outside moves. Default: twice the largest displacement of a vertex; below 1.5
  /// times, space outside can fold. The field is continuous up to a voxel, except at points that are equally
  /// near to different parts of the mesh.
  std::optional<double> fade_distance;
  /// The way in which displacements between vertices are computed from the displacements of the vertices.
  Displacement_interpolation interpolation = Displacement_interpolation::RECOVERED;
  /// Both ends of each edge with a coefficient, in elements of order 2: see
  /// `Linear_elasticity_3::quadratic_edges()`. If there are any, displacements of elements of order 2 take
  /// the place of `RECOVERED` ones.
  std::vector<std::array<Vertex_index, 2>> quadratic_edges;
  /// The coefficient of each of `quadratic_edges`, in millimeters.
  std::vector<Vec3> edge_coefficients;
  /// The way in which values between the voxels of the image are computed from the values of voxels.
  Image_interpolation image_interpolation = Image_interpolation::LINEAR;
  /// Elements that have been removed, true for each; empty: none. The displacements of vertices that only
  /// removed elements have do not matter.
  std::vector<bool> resected_elements;
  /// The test whether a point, in millimeters before the deformation, has been removed; empty: none.
  std::function<bool(const std::array<double, 3>&)> is_resected;
  /// The value of the warped image where tissue has been removed.
  float resected_value = 0;
};

/// \ingroup PkgMixedMeshImage3Ref
/// The results of `warp_image()`; all on the grid of the image.
struct Warped_image_3
{
  /// The warped image.
  Voxel_image_3 image;
  Displacement_field_3 forward;  ///< at points before the deformation: the displacement of the point
  Displacement_field_3 backward; ///< at points after the deformation: the vector to the former place
  Voxel_image_3 mask;            ///< after the deformation: 0 outside, 1 tissue, 2 resected
  /// The value of `Recovered_displacement_3::number_of_linear_elements()`, with `RECOVERED`.
  std::size_t number_of_linear_elements = 0;
};

namespace internal {

/// A mesh and its displacement, in the indices of a grid; input is checked.
struct Mesh_in_grid : Displaced_vertices
{
  double largest_displacement = 0;

  template <class Mesh, class Displacements>
  Mesh_in_grid(const Voxel_grid_3& grid, const Mesh& mesh, const Displacements& vectors,
               const Warp_options& options)
  {
    CGAL_precondition(std::size_t(std::size(vectors)) == mesh.number_of_vertices());
    CGAL_precondition(options.resected_elements.empty()
                      || options.resected_elements.size() == mesh.number_of_elements());
    std::vector<bool> is_used(mesh.number_of_vertices(), false);
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      if(options.resected_elements.empty() || !options.resected_elements[e])
        for(Vertex_index v : mesh.element(e))
          is_used[v] = true;

    const Affine_map_3 to_index = inverse(grid.index_to_world);
    Vec3 lower, upper;
    lower.fill(std::numeric_limits<double>::infinity());
    upper.fill(-std::numeric_limits<double>::infinity());
    for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v) {
      const Vec3 p = to_vec3(mesh.points()[v]);
      const Vec3 u = is_used[v] ? components(vectors[v]) : Vec3{};
      if(!std::isfinite(norm(p)) || !std::isfinite(norm(u)))
        throw std::runtime_error("vertex " + std::to_string(v)
                                 + " of the mesh does not have a finite position and displacement");
      displacements.push_back(u);
      before.push_back(transform(to_index, p));
      after.push_back(transform(to_index, p + u));
      largest_displacement = (std::max)(largest_displacement, norm(u));
      for(int k = 0; k < 3; ++k) {
        lower[k] = (std::min)(lower[k], before.back()[k]);
        upper[k] = (std::max)(upper[k], before.back()[k]);
      }
    }
    bool is_overlapping = mesh.number_of_elements() != 0;
    for(int k = 0; k < 3; ++k)
      is_overlapping = is_overlapping && upper[k] >= -0.5 && lower[k] <= double(grid.size[k]) - 0.5;
    if(!is_overlapping)
      throw std::runtime_error("the image and the mesh do not overlap: the image's center is at "
                               + center(grid) + ", the mesh's at " + center(mesh) + " (millimeters)");
  }

private:
  static std::string text(const Vec3& p)
  {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(6);
    out << "(" << p[0] << ", " << p[1] << ", " << p[2] << ")";
    return out.str();
  }

  static std::string center(const Voxel_grid_3& grid)
  {
    Vec3 middle;
    for(int k = 0; k < 3; ++k)
      middle[k] = 0.5 * double(grid.size[k] - 1);
    return text(transform(grid.index_to_world, middle));
  }

  template <class Mesh>
  static std::string center(const Mesh& mesh)
  {
    if(mesh.number_of_vertices() == 0)
      return "nowhere";
    Vec3 lower = to_vec3(mesh.points()[0]), upper = lower;
    for(const auto& point : mesh.points()) {
      const Vec3 p = to_vec3(point);
      for(int k = 0; k < 3; ++k) {
        lower[k] = (std::min)(lower[k], p[k]);
        upper[k] = (std::max)(upper[k], p[k]);
      }
    }
    return text(0.5 * (lower + upper));
  }
};

// The field at the voxels that are in the mesh (before or after the deformation), and near the mesh.
template <class Bubbles_of>
Displacement_field_3 displacement_field(const Voxel_grid_3& grid, const Element_list& elements,
                                        const Mesh_in_grid& mesh, const Bubbles_of& bubbles_of,
                                        const Warp_options& options, bool is_forward)
{
  Displacement_field_3 field;
  field.grid = grid;
  field.vectors.resize(grid.number_of_voxels());
  field.is_in_mesh.resize(grid.number_of_voxels());
  const std::vector<bool>& resected = options.resected_elements;
  rasterize_displacement(
    elements, [&resected](Element_index e) { return resected.empty() || !resected[e]; }, mesh, bubbles_of,
    is_forward, field);
  fade_displacement(options.fade_distance ? *options.fade_distance : 2 * mesh.largest_displacement, field);
  return field;
}

// Calls `visit(offset, p)` for the voxels, with the point in indices to which a field moves the voxel; or
// `visit_fixed(offset)` for voxels that stay.
template <class Visitor, class Visitor_of_fixed>
void for_each_displaced_voxel(const Displacement_field_3& field, const Visitor& visit,
                              const Visitor_of_fixed& visit_fixed)
{
  const Affine_map_3 to_index = inverse(field.grid.index_to_world);
  std::size_t offset = 0;
  for(std::size_t k = 0; k < field.grid.size[2]; ++k)
    for(std::size_t j = 0; j < field.grid.size[1]; ++j)
      for(std::size_t i = 0; i < field.grid.size[0]; ++i, ++offset) {
        const std::array<float, 3>& u = field.vectors[offset];
        if(u[0] == 0 && u[1] == 0 && u[2] == 0) {
          visit_fixed(offset);
          continue;
        }
        Vec3 p{double(i), double(j), double(k)};
        for(int a = 0; a < 3; ++a)
          p[a] += dot({to_index[a][0], to_index[a][1], to_index[a][2]},
                      {double(u[0]), double(u[1]), double(u[2])});
        visit(offset, p);
      }
}

} // namespace internal

/*!
\ingroup PkgMixedMeshImage3Ref

Resamples an image: the value of a voxel of the result is the image's value at the point to which the field
moves the voxel, linear between voxels or the value of the nearest voxel. Voxels that stay keep their value
exactly.

The backward field deforms an image like the mesh; the forward field undoes the deformation.

\param image image
\param field field that leads from voxels of the result to their origin. \pre on the same grid
\param interpolation interpolation between voxels
\return the image, of the same type
\par Complexity
Linear in the number of voxels
*/
inline Voxel_image_3 resample_image(const Voxel_image_3& image, const Displacement_field_3& field,
                                    Image_interpolation interpolation = Image_interpolation::LINEAR)
{
  CGAL_precondition(image.grid.size == field.grid.size);
  Voxel_image_3 result = image;
  internal::for_each_displaced_voxel(
    field,
    [&](std::size_t offset, const Vec3& p) {
      result.values[offset] = interpolation == Image_interpolation::LINEAR ? interpolate(image, p)
                                                                           : nearest_value(image, p);
    },
    [](std::size_t) {});
  return result;
}

/*!
\ingroup PkgMixedMeshImage3Ref

\brief Deforms an image with a mesh.

The element of the deformed mesh that contains the center of a voxel tells the point of the tissue that is now
at the center; the value is the image's value at that point, linear between voxels by default. For points
outside the mesh see `Warp_options::fade_distance`. The mesh and the image are in the same world: millimeters,
x to the right, y to the front, z upwards.

The fields in the mesh are those of the elements at the centers of the voxels, up to the rounding to floats,
and inverse to each other; outside, they agree at the surface only. Voxels of resected tissue are voxels that
would show removed tissue after the deformation: points of tissue for which `is_resected` holds, and points
outside the remaining mesh that come from a resected element.

\tparam Mesh a `Mixed_mesh_3`
\tparam Displacements an array with components `[0]`, `[1]`, `[2]` for each vertex
\param image the image before the deformation
\param mesh the mesh before the deformation
\param displacements displacements of the vertices, in millimeters
\param options removed elements and points, and treatment of the outside
\pre there is a displacement for each vertex, and a coefficient for each of the quadratic edges
\return the image, both fields, and the mask
\throw std::runtime_error a line, if the image and the mesh do not overlap, or if a displacement is not finite
\par Complexity
Linear in the number of voxels, and of elements
*/
template <class Mesh, class Displacements>
Warped_image_3 warp_image(const Voxel_image_3& image, const Mesh& mesh, const Displacements& displacements,
                          const Warp_options& options = Warp_options())
{
  const Voxel_grid_3& grid = image.grid;
  CGAL_precondition(image.values.size() == grid.number_of_voxels());
  const internal::Mesh_in_grid mesh_in_grid(grid, mesh, displacements, options);
  std::optional<Recovered_displacement_3<Mesh>> recovered;
  if(options.interpolation == Displacement_interpolation::RECOVERED) {
    if(options.quadratic_edges.empty())
      recovered.emplace(mesh, mesh_in_grid.displacements, options.resected_elements);
    else
      recovered.emplace(mesh, mesh_in_grid.displacements, options.quadratic_edges, options.edge_coefficients,
                        options.resected_elements);
  }
  const auto bubbles_of = [&recovered](const Element_view& element) {
    return recovered ? recovered->bubbles(element) : std::nullopt;
  };
  const auto field = [&](bool is_forward) {
    return internal::displacement_field(grid, mesh.elements(), mesh_in_grid, bubbles_of, options, is_forward);
  };
  Warped_image_3 warped;
  if(recovered)
    warped.number_of_linear_elements = recovered->number_of_linear_elements();
  warped.backward = field(false);
  warped.forward = field(true);
  warped.image = resample_image(image, warped.backward, options.image_interpolation);
  warped.mask.grid = grid;
  warped.mask.type = Voxel_type::UINT8;
  warped.mask.values.assign(warped.backward.is_in_mesh.begin(), warped.backward.is_in_mesh.end());
  if(options.resected_elements.empty() && !options.is_resected)
    return warped;

  // The resected elements, before the deformation: a mesh of their own.
  Mesh resected;
  for(const auto& p : mesh.points())
    resected.add_vertex(p);
  for(std::size_t e = 0; e < options.resected_elements.size(); ++e)
    if(options.resected_elements[e])
      resected.add_element(mesh.element(e).kind(), mesh.element(e).begin());
  const Element_locator_3<Mesh> locator(resected);
  const auto mark = [&](std::size_t offset, const Vec3& p) {
    const Vec3 x = transform(grid.index_to_world, p);
    const bool is_tissue = warped.backward.is_in_mesh[offset] != 0;
    if(is_tissue ? options.is_resected && options.is_resected(x) : locator.locate(x).has_value()) {
      warped.mask.values[offset] = 2;
      warped.image.values[offset] = options.resected_value;
    }
  };
  internal::for_each_displaced_voxel(warped.backward, mark, [&](std::size_t offset) {
    const std::size_t row = offset / grid.size[0];
    mark(offset, {double(offset % grid.size[0]), double(row % grid.size[1]), double(row / grid.size[1])});
  });
  return warped;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_WARP_IMAGE_H
