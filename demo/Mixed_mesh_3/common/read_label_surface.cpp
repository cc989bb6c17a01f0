// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/read_label_surface.h"

#include "common/messages.h"
#include "common/resources.h"

#include <algorithm>
#include <stdexcept>

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
  : m_path(path), m_data(std::make_unique<const Data>(Data{read(path)}))
{
}

std::size_t Label_image::number_of_voxels(const Voxel_selection& selection) const
{
  return std::size_t(std::count_if(m_data->image.values.begin(), m_data->image.values.end(), selection));
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
  mm3::make_label_surface(image, selection, smoothing, surface);
  if(surface.is_empty())
    throw std::runtime_error(
      m_path + ": "
      + (number_of_voxels(selection) > 0
           ? "nothing is left of the voxels " + selection.text + " after smoothing, see --smoothing"
           : "there are no voxels " + selection.text));
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

Surface Label_image::surface_of(const Voxel_selection&, const Label_surface_options&, Surface_facts&,
                                std::vector<std::string>&) const
{
  return {};
}

#endif

Label_image::~Label_image() = default;
