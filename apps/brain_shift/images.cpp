// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/images.h"

#include <stdexcept>

namespace mm3 = CGAL::Mixed_meshes_3;

#if MIXED_MESH_3_HAS_NIFTI

#include "core/messages.h"
#include "core/misfit.h"
#include "core/resources.h"

#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/IO/read_voxel_image.h>
#include <CGAL/Mixed_mesh_image_3/IO/write_warped_image.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace {

// The box of an image, which tells whether points are inside.
class Image_box
{
  const mm3::Voxel_grid_3& m_grid;
  mm3::Affine_map_3 m_to_index;

public:
  explicit Image_box(const mm3::Voxel_grid_3& grid)
    : m_grid(grid), m_to_index(mm3::inverse(grid.index_to_world))
  {
  }

  bool contains(const Vector& p) const
  {
    const Vector index = mm3::transform(m_to_index, p);
    bool is_inside = true;
    for(int k = 0; k < 3; ++k)
      is_inside = is_inside && index[k] >= -0.5 && index[k] <= double(m_grid.size[k]) - 0.5;
    return is_inside;
  }

  CGAL::Bbox_3 bbox() const
  {
    std::vector<std::array<double, 3>> corners;
    for(int i = 0; i < 8; ++i) {
      Vector index;
      for(int k = 0; k < 3; ++k)
        index[k] = (i >> k & 1) != 0 ? double(m_grid.size[k]) - 0.5 : -0.5;
      corners.push_back(mm3::transform(m_grid.index_to_world, index));
    }
    return box_of(corners);
  }
};

std::size_t number_of_vertices_inside(const Mesh& mesh, const mm3::Voxel_grid_3& grid)
{
  const Image_box box(grid);
  return std::size_t(std::count_if(mesh.points().begin(), mesh.points().end(),
                                   [&box](const auto& p) { return box.contains(mm3::to_vec3(p)); }));
}

// The reason why the mesh may not be in the image.
std::string hint(const Mesh& mesh, const mm3::Voxel_grid_3& grid)
{
  const Image_box box(grid);
  const std::string defect = misfit(coordinates_of(mesh.points()), box.bbox(),
                                    [&box](const std::array<double, 3>& p) { return box.contains(p); });
  return defect.empty() ? "" : "; the mesh " + defect;
}

[[noreturn]] void refuse(const std::string& file, const Mesh& mesh, const std::string& mesh_file,
                         const mm3::Voxel_grid_3& grid)
{
  Vector middle;
  for(int k = 0; k < 3; ++k)
    middle[k] = 0.5 * double(grid.size[k] - 1);
  CGAL::Bbox_3 box;
  for(const auto& p : mesh.points())
    box += p.bbox();
  throw std::runtime_error(
    file + ": the image does not overlap the mesh " + mesh_file + ": its center is at "
    + place(mm3::transform(grid.index_to_world, middle)) + ", the mesh's at "
    + place({(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2})
    + ", in mm" + hint(mesh, grid));
}

// Whether voxels are at the same places, up to a thousandth of their size.
bool are_same(const mm3::Voxel_grid_3& a, const mm3::Voxel_grid_3& b)
{
  if(a.size != b.size)
    return false;
  const mm3::Affine_map_3 to_index = mm3::inverse(a.index_to_world);
  for(int corner = 0; corner < 8; ++corner) {
    Vector index;
    for(int k = 0; k < 3; ++k)
      index[k] = (corner >> k & 1) * double(a.size[k] - 1);
    const Vector there = mm3::transform(to_index, mm3::transform(b.index_to_world, index));
    if(!(norm(there - index) < 1e-3))
      return false;
  }
  return true;
}

// Labels most of whose voxels are resected, but not all: the cavity ends at faces of the mesh, or at a
// surface that was smoothed, and both cut voxels off.
std::vector<Rim_facts> find_rims(const mm3::Voxel_image_3& labels, const mm3::Voxel_image_3& mask)
{
  std::map<float, Rim_facts> found;
  for(std::size_t i = 0; i < labels.values.size(); ++i) {
    Rim_facts& facts = found[labels.values[i]];
    facts.resected += mask.values[i] == 2;
    facts.left += mask.values[i] == 1;
  }
  std::vector<Rim_facts> rims;
  for(auto& [label, facts] : found)
    if(label != 0 && 0 < facts.left && facts.left < facts.resected) {
      facts.label = label;
      rims.push_back(facts);
    }
  return rims;
}

// The labels after the deformation; labels of removed tissue are 0.
mm3::Voxel_image_3 warp_labels(const mm3::Voxel_image_3& labels, const mm3::Warped_image_3& warped,
                               const std::string& file, Outcome& outcome)
{
  mm3::Voxel_image_3 result = mm3::resample_image(labels, warped.backward, mm3::Image_interpolation::NEAREST);
  outcome.image->rims = find_rims(result, warped.mask);
  for(const Rim_facts& rim : outcome.image->rims)
    outcome.warnings.push_back(
      file + ": of label " + std::to_string(std::llround(rim.label)) + ", "
      + counted(rim.resected, "voxel is", "voxels are") + " resected, and "
      + counted(rim.left, "one is", "others are")
      + " left as a rim: the cavity ends where elements, or the smoothed surface, do");
  for(std::size_t i = 0; i < result.values.size(); ++i)
    if(warped.mask.values[i] == 2)
      result.values[i] = 0;
  return result;
}

} // namespace

mm3::Voxel_image_3 read_labels(const Image_options& o, const mm3::Voxel_grid_3& grid)
{
  mm3::Voxel_image_3 labels;
  require([&](std::string* error) { return mm3::IO::read_voxel_image(o.labels, labels, error); });
  if(!are_same(grid, labels.grid))
    throw std::runtime_error(o.labels + ": the label image does not have the voxels of " + o.file);
  constexpr float largest = 1 << 24; // floats distinguish integers up to there
  for(float value : labels.values)
    if(value != std::floor(value) || std::abs(value) > largest)
      throw std::runtime_error(o.labels + ": " + rounded(double(value))
                               + " is no label; expected integers up to 2^24");
  return labels;
}

mm3::Voxel_image_3 read_image(const std::string& file, const Mesh& mesh, const std::string& mesh_file,
                              Outcome& outcome)
{
  mm3::Voxel_image_3 image;
  require([&](std::string* error) { return mm3::IO::read_voxel_image(file, image, error); });
  const mm3::Voxel_grid_3& grid = image.grid;
  const std::size_t inside = number_of_vertices_inside(mesh, grid);
  if(inside == 0)
    refuse(file, mesh, mesh_file, grid);
  if(inside != mesh.number_of_vertices())
    outcome.warnings.push_back(file + ": only " + std::to_string(inside) + " of "
                               + std::to_string(mesh.number_of_vertices()) + " vertices of " + mesh_file
                               + " are in the image: are both in the same coordinates?" + hint(mesh, grid));
  const auto limits = std::minmax_element(image.values.begin(), image.values.end());
  Image_facts& facts = outcome.image.emplace();
  facts.voxels = grid.size;
  facts.volume_of_voxel = std::abs(mm3::determinant(grid.index_to_world));
  facts.world = grid.world;
  facts.smallest = *limits.first;
  facts.largest = *limits.second;
  facts.share_inside = double(inside) / double(mesh.number_of_vertices());
  return image;
}

void write_images(mm3::IO::Output_files& files, const mm3::Voxel_image_3& image,
                  const mm3::Voxel_image_3& labels, const Mesh& mesh, const Tumor& tumor,
                  const std::vector<bool>& is_removed, const Image_options& o, Stage_log& log,
                  Outcome& outcome)
{
  mm3::Warp_options warp;
  warp.interpolation = o.interpolation;
  warp.quadratic_edges = outcome.order.edges;
  warp.edge_coefficients = outcome.last().edge_coefficients;
  if(tumor.is_given())
    warp.resected_elements = is_removed;
  if(tumor.surface != nullptr) // also the parts that it cuts off the remaining elements
    warp.is_resected = [&tumor](const std::array<double, 3>& p) { return tumor.surface->contains(p); };
  const mm3::Warped_image_3 warped = log("warp image", [&] {
    return mm3::warp_image(image, mesh, outcome.last().displacements, warp);
  });
  const std::vector<float>& mask = warped.mask.values;
  outcome.image->voxels_of_tissue = std::size_t(std::count(mask.begin(), mask.end(), 1.f));
  outcome.image->voxels_resected = std::size_t(std::count(mask.begin(), mask.end(), 2.f));
  outcome.image->linear_elements = warped.number_of_linear_elements;
  if(!o.output.empty())
    log("write images", [&] {
      require([&](std::string* error) {
        return mm3::IO::write_warped_image(files, o.output + ".nii.gz", warped, o.field_formats, error);
      });
      if(!o.labels.empty())
        require([&](std::string* error) {
          return mm3::IO::write_NIFTI(files, o.labels_output(),
                                      warp_labels(labels, warped, o.labels, outcome), error);
        });
    });
}

#else

mm3::Voxel_image_3 read_image(const std::string&, const Mesh&, const std::string&, Outcome&)
{
  throw std::logic_error("checked with the options");
}

mm3::Voxel_image_3 read_labels(const Image_options&, const mm3::Voxel_grid_3&)
{
  throw std::logic_error("checked with the options");
}

void write_images(mm3::IO::Output_files&, const mm3::Voxel_image_3&, const mm3::Voxel_image_3&, const Mesh&,
                  const Tumor&, const std::vector<bool>&, const Image_options&, Stage_log&, Outcome&)
{
}

#endif
