// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/read_label_surface.h"

#include "common/messages.h"
#include "common/resources.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#if MIXED_MESH_3_HAS_NIFTI
#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/make_label_surface.h>
#include <CGAL/Mixed_mesh_image_3/simplify_closed_surface.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#endif

namespace mm3 = CGAL::Mixed_meshes_3;

#if MIXED_MESH_3_HAS_NIFTI

struct Label_image::Data
{
  mm3::Voxel_image_3 image;
  std::map<float, std::size_t> numbers; // of voxels of each value

  explicit Data(mm3::Voxel_image_3 read) : image(std::move(read))
  {
    auto last = numbers.end(); // most voxels have the value of the one before
    for(float value : image.values) {
      if(last == numbers.end() || last->first != value)
        last = numbers.try_emplace(value, 0).first;
      ++last->second;
    }
  }
};

namespace {

mm3::Voxel_image_3 read(const std::string& path)
{
  mm3::Voxel_image_3 image;
  require([&](std::string* error) { return mm3::IO::read_NIFTI(path, image, error); });
  return image;
}

} // namespace

Label_image::Label_image(const std::string& path)
  : m_path(path), m_data(std::make_unique<const Data>(read(path)))
{
}

std::size_t Label_image::number_of_voxels(const Voxel_selection& selection) const
{
  std::size_t sum = 0;
  for(const auto& [value, number] : m_data->numbers)
    sum += selection(value) ? number : 0;
  return sum;
}

double Label_image::volume_of_voxel() const
{
  return std::abs(mm3::determinant(m_data->image.grid.index_to_world));
}

std::vector<int> Label_image::labels() const
{
  constexpr std::size_t most_labels = 60000;
  constexpr float largest = 2e9f;
  std::vector<int> result;
  for(const auto& [value, number] : m_data->numbers) {
    if(value == 0)
      continue;
    if(!(value >= 1 && value <= largest) || value != std::floor(value))
      throw std::runtime_error(m_path + ": has the value " + rounded(value)
                               + ", which is no label: a whole number, not negative");
    result.push_back(int(value));
    if(result.size() > most_labels)
      throw std::runtime_error(m_path + ": has more than " + std::to_string(most_labels)
                               + " values: no image of labels");
  }
  if(result.empty())
    throw std::runtime_error(m_path + ": there are no labels");
  return result;
}

Surface Label_image::surface_of(const Voxel_selection& selection, const Label_surface_options& options,
                                Surface_facts& facts, std::vector<std::string>& warnings) const
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  const mm3::Voxel_image_3& image = m_data->image;
  const auto spacing = mm3::voxel_spacing(image.grid);
  const double smoothing = options.smoothing.value_or(*std::max_element(spacing.begin(), spacing.end()));
  constexpr double most_voxels = 100; // the box around the label grows by three times as many
  if(smoothing > most_voxels * *std::min_element(spacing.begin(), spacing.end()))
    throw std::runtime_error(m_path + ": smoothing by " + rounded(smoothing) + " mm is more than "
                             + rounded(most_voxels) + " voxels wide, see --smoothing");
  Surface surface;
  mm3::make_label_surface(image, selection, smoothing, surface, options.vertices);
  if(surface.is_empty() && number_of_voxels(selection) == 0)
    throw std::runtime_error(m_path + ": there are no voxels " + selection.text);
  if(surface.is_empty())
    return surface;
  const std::size_t vertices = surface.number_of_vertices(), triangles = surface.number_of_faces();
  mm3::simplify_closed_surface(surface, options.vertices);
  auto component = surface.add_property_map<Surface::Face_index, std::size_t>("f:component", 0).first;
  const std::size_t components = PMP::connected_components(surface, component);
  surface.remove_property_map(component);
  if(components > 1)
    warnings.push_back(m_path + ": the voxels " + selection.text + " have a surface of "
                       + std::to_string(components) + " components");
  facts = {m_path,
           vertices,
           triangles,
           surface.number_of_vertices(),
           surface.number_of_faces(),
           components,
           PMP::volume(surface)};
  return surface;
}

#else

struct Label_image::Data
{
};

Label_image::Label_image(const std::string& path)
{
  throw std::runtime_error(path + ": this program was built without nifti_clib");
}

std::size_t Label_image::number_of_voxels(const Voxel_selection&) const { return 0; }
double Label_image::volume_of_voxel() const { return 0; }
std::vector<int> Label_image::labels() const { return {}; }

Surface Label_image::surface_of(const Voxel_selection&, const Label_surface_options&, Surface_facts&,
                                std::vector<std::string>&) const
{
  return {};
}

#endif

Label_image::~Label_image() = default;
