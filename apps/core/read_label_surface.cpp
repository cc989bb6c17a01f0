// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/read_label_surface.h"

#include "core/messages.h"
#include "core/resources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#if MIXED_MESH_3_HAS_NIFTI
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_image_3/IO/read_voxel_image.h>
#include <CGAL/Mixed_mesh_image_3/complete_label.h>
#include <CGAL/Mixed_mesh_image_3/fill_label_holes.h>
#include <CGAL/Mixed_mesh_image_3/grow_label.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>
#include <CGAL/Mixed_mesh_image_3/make_label_surface.h>
#include <CGAL/Mixed_mesh_image_3/make_label_surfaces.h>
#include <CGAL/Mixed_mesh_image_3/simplify_closed_surface.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#endif

namespace mm3 = CGAL::Mixed_meshes_3;

#if MIXED_MESH_3_HAS_NIFTI

struct Label_image::Data
{
  mm3::Voxel_image_3 image;
  std::map<float, mm3::Label_extent_3> extents; // extents of voxels of each value

  explicit Data(mm3::Voxel_image_3 read) : image(std::move(read)), extents(mm3::label_extents(image)) {}

  mm3::Label_extent_3 extent(const Voxel_selection& selection) const
  {
    mm3::Label_extent_3 all;
    for(const auto& [value, extent] : extents)
      if(selection(value))
        all.add(extent);
    return all;
  }

  // The number of the first selection that has a value, of each value that one of them has.
  std::map<float, std::size_t> numbers(const std::vector<Voxel_selection>& selections) const
  {
    std::map<float, std::size_t> number_of_value;
    for(const auto& entry : extents) {
      const auto found = std::find_if(selections.begin(), selections.end(),
                                      [&](const Voxel_selection& one) { return one(entry.first); });
      if(found != selections.end())
        number_of_value[entry.first] = std::size_t(found - selections.begin());
    }
    return number_of_value;
  }
};

namespace {

mm3::Voxel_image_3 read(const std::string& path)
{
  mm3::Voxel_image_3 image;
  require([&](std::string* error) { return mm3::IO::read_voxel_image(path, image, error); });
  return image;
}

constexpr double most_voxels = 100; // voxels of a length: the box of the label grows by several times as many

// Removes components of less than a voxel, which smoothing leaves of specks and of thin gaps, unless there
// are no others.
// \return their number
std::size_t remove_specks(Surface& surface, double volume_of_voxel)
{
  Surface rest = surface;
  const std::size_t number = CGAL::Polygon_mesh_processing::remove_connected_components_of_negligible_size(
    rest, CGAL::parameters::area_threshold(0).volume_threshold(volume_of_voxel));
  if(number == 0 || rest.number_of_faces() == 0)
    return 0;
  surface = std::move(rest);
  surface.collect_garbage();
  return number;
}

Surface_facts facts_of(Surface& surface, const std::string& path)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  const std::size_t vertices = surface.number_of_vertices(), triangles = surface.number_of_faces();
  auto component = surface.add_property_map<Surface::Face_index, std::size_t>("f:component", 0).first;
  const std::size_t components = PMP::connected_components(surface, component);
  surface.remove_property_map(component);
  return {path, vertices, triangles, vertices, triangles, components, PMP::volume(surface)};
}

// The surface wrapped: the mesh generator takes the wrap as the surface.
Surface wrapped(const Surface& surface, double diameter, const std::string& path,
                std::vector<std::string>& repairs)
{
  namespace IO = mm3::IO;
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<std::int64_t>> triangles;
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(surface, points, triangles);
  IO::Read_surface_options options;
  options.wrap_diameter = diameter;
  Surface result;
  IO::Surface_input input;
  require([&](std::string* error) {
    return IO::make_closed_surface(points, triangles, path, options, result, error, &input);
  });
  repairs = input.repairs;
  return result;
}

} // namespace

Label_image::Label_image(const std::string& path)
  : Label_image(path, std::make_unique<const Data>(read(path)))
{
}

Label_image Label_image::completed(const Voxel_selection& selection, const Voxel_selection& filling,
                                   const Label_completion& completion, Completion_facts& facts) const
{
  const mm3::Voxel_image_3& image = m_data->image;
  const double volume = double(number_of_voxels(selection)) * volume_of_voxel();
  mm3::Label_completion_options options;
  if(completion.is_hull)
    options = mm3::hull_completion(volume);
  options.closing_radius = completion.closing_radius.value_or(options.closing_radius);
  options.fill_holes |= completion.fill_holes;
  options.keep_largest |= completion.keep_largest;
  options.least_volume = 1000 * completion.least_volume; // ml
  check_box("closing", "--close", options.closing_radius);
  mm3::Label_completion_result done;
  const mm3::Voxel_image_3 mask = mm3::complete_label(image, selection, options, &done);
  facts = {options.closing_radius,       done.number_of_voxels,         done.number_of_closed_voxels,
           done.number_of_filled_voxels, done.number_of_removed_voxels, done.number_of_removed_components};

  // The value of filled voxels is the commonest of the values selected for filling; no value is taken from
  // the rest.
  const float commonest = commonest_value(filling);
  const float nothing = selection(0) ? -std::numeric_limits<float>::infinity() : 0;
  mm3::Voxel_image_3 result = image;
  bool is_empty = true;
  for(std::size_t v = 0; v < result.values.size(); ++v) {
    float& value = result.values[v];
    const bool is_in = mask.values[v] != 0;
    is_empty = is_empty && !is_in;
    if(is_in != selection(value))
      value = is_in ? commonest : nothing;
  }
  if(is_empty)
    throw std::runtime_error(m_path + ": no component of the voxels " + selection.text + " has "
                             + rounded(completion.least_volume) + " ml, see --drop-below");
  return {m_path, std::make_unique<const Data>(std::move(result))};
}

// Checks the memory for distances, or components, in the box of the image with a radius on each side.
void Label_image::check_box(const std::string& what, const std::string& option, double radius) const
{
  const mm3::Voxel_grid_3& grid = m_data->image.grid;
  const auto spacing = mm3::voxel_spacing(grid);
  if(radius > most_voxels * *std::min_element(spacing.begin(), spacing.end()))
    throw std::runtime_error(m_path + ": " + what + " by " + rounded(radius) + " mm is more than "
                             + rounded(most_voxels) + " voxels wide, see " + option);
  double voxels = 1;
  for(int i = 0; i < 3; ++i)
    voxels *= double(grid.size[i]) + 2 * radius / spacing[i];
  constexpr double bytes_per_voxel = 20; // two of distances, or components and their numbers
  check_memory(m_path + ": " + what + " it", bytes_per_voxel * voxels);
}

Label_image Label_image::with_layer(const Voxel_selection& label, const Voxel_selection& domain,
                                    const std::optional<double>& distance, float value,
                                    std::size_t& number) const
{
  check_box(distance ? "growing" : "filling", distance ? "--grow" : "--fill", distance.value_or(0));
  mm3::Voxel_image_3 image = m_data->image;
  const auto is_background = [&domain](float v) { return v == 0 && !domain(v); };
  number = distance ? mm3::grow_label(image, label, is_background, *distance, value)
                    : mm3::fill_label_holes(image, label, is_background, value);
  return {m_path, std::make_unique<const Data>(std::move(image))};
}

float Label_image::commonest_value(const Voxel_selection& selection) const
{
  const std::pair<const float, mm3::Label_extent_3>* commonest = nullptr;
  for(const auto& value : m_data->extents)
    if(selection(value.first)
       && (commonest == nullptr || value.second.number_of_voxels > commonest->second.number_of_voxels))
      commonest = &value;
  if(commonest == nullptr)
    throw std::runtime_error(m_path + ": there are no voxels " + selection.text);
  return commonest->first;
}

float Label_image::unused_value() const
{
  float value = -1;
  while(m_data->extents.count(value) > 0)
    --value;
  return value;
}

bool Label_image::is_at_border(const Voxel_selection& selection) const
{
  const mm3::Label_extent_3 extent = m_data->extent(selection);
  for(int i = 0; i < 3; ++i)
    if(extent.first[i] == 0 || extent.last[i] == m_data->image.grid.size[i])
      return true;
  return false;
}

std::size_t Label_image::number_of_voxels(const Voxel_selection& selection) const
{
  return m_data->extent(selection).number_of_voxels;
}

double Label_image::volume_of_voxel() const
{
  return std::abs(mm3::determinant(m_data->image.grid.index_to_world));
}

std::vector<std::uint32_t> Label_image::labels() const
{
  constexpr std::size_t most_labels = 60000;
  constexpr float largest = 2e9f;
  std::vector<std::uint32_t> result;
  for(const auto& [value, extent] : m_data->extents) {
    if(value == 0)
      continue;
    if(!(value >= 1 && value <= largest) || value != std::floor(value))
      throw std::runtime_error(m_path + ": has the value " + rounded(value)
                               + ", which is no label: a whole number, not negative");
    result.push_back(std::uint32_t(value));
    if(result.size() > most_labels)
      throw std::runtime_error(m_path + ": has more than " + std::to_string(most_labels)
                               + " values: no image of labels");
  }
  if(result.empty())
    throw std::runtime_error(m_path + ": there are no labels");
  return result;
}

double Label_image::smoothing(const Label_surface_options& options) const
{
  const auto spacing = mm3::voxel_spacing(m_data->image.grid);
  const double smoothing = options.smoothing.value_or(*std::max_element(spacing.begin(), spacing.end()));
  if(smoothing > most_voxels * *std::min_element(spacing.begin(), spacing.end()))
    throw std::runtime_error(m_path + ": smoothing by " + rounded(smoothing) + " mm is more than "
                             + rounded(most_voxels) + " voxels wide, see --smoothing");
  return smoothing;
}

Surface Label_image::surface_of(const Voxel_selection& selection, const Label_surface_options& options,
                                Surface_facts& facts, std::vector<std::string>& warnings) const
{
  Surface surface;
  mm3::make_label_surface<CGAL::Parallel_if_available_tag>(m_data->image, selection, smoothing(options),
                                                           surface, options.vertices,
                                                           m_data->extent(selection));
  if(surface.is_empty() && number_of_voxels(selection) == 0)
    throw std::runtime_error(m_path + ": there are no voxels " + selection.text);
  if(surface.is_empty())
    return surface;
  const std::size_t vertices = surface.number_of_vertices(), triangles = surface.number_of_faces();
  const std::size_t specks = remove_specks(surface, volume_of_voxel());
  if(specks > 0)
    warnings.push_back(m_path + ": " + counted(specks, "component", "components")
                       + " of the surface of the voxels " + selection.text + " of less than a voxel "
                       + (specks == 1 ? "is" : "are") + " left out");
  mm3::simplify_closed_surface(surface, options.vertices);
  std::vector<std::string> repairs;
  if(options.wrap_diameter > 0)
    surface = wrapped(surface, options.wrap_diameter, m_path, repairs);
  facts = facts_of(surface, m_path);
  facts.points = vertices;
  facts.polygons = triangles;
  facts.repairs = repairs;
  if(facts.components > 1)
    warnings.push_back(m_path + ": the voxels " + selection.text + " have a surface of "
                       + std::to_string(facts.components) + " components");
  return surface;
}

std::vector<Surface> Label_image::surfaces_of(const std::vector<Voxel_selection>& selections,
                                              const Label_surface_options& options,
                                              std::vector<Surface_facts>& facts,
                                              std::vector<mm3::Label_change_3>& changes) const
{
  const std::map<float, std::size_t> number_of_value = m_data->numbers(selections);
  std::vector<mm3::Label_extent_3> extents(selections.size());
  for(const auto& [value, number] : number_of_value)
    extents[number].add(m_data->extents.at(value));
  std::vector<std::function<bool(float)>> has_label; // for each voxel: the search in all selections is done
  for(std::size_t i = 0; i < selections.size(); ++i)
    has_label.emplace_back([&number_of_value, i](float value) {
      const auto found = number_of_value.find(value);
      return found != number_of_value.end() && found->second == i;
    });
  std::vector<Surface> surfaces = mm3::make_label_surfaces<Surface, CGAL::Parallel_if_available_tag>(
    m_data->image, has_label, extents, smoothing(options), options.vertices, &changes);
  for(Surface& surface : surfaces)
    facts.push_back(facts_of(surface, m_path));
  return surfaces;
}

std::vector<mm3::Label_thickness_3>
Label_image::thickness_of(const std::vector<Voxel_selection>& selections) const
{
  const std::map<float, std::size_t> number_of_value = m_data->numbers(selections);
  return mm3::label_thickness(m_data->image, selections.size(), [&](float value) {
    const auto found = number_of_value.find(value);
    return found != number_of_value.end() ? found->second + 1 : 0;
  });
}

#else

struct Label_image::Data
{
};

Label_image::Label_image(const std::string& path)
{
  throw std::runtime_error(path + ": this program was built without nifti_clib");
}

Label_image Label_image::completed(const Voxel_selection&, const Voxel_selection&, const Label_completion&,
                                   Completion_facts&) const
{
  return {m_path, nullptr};
}

Label_image Label_image::with_layer(const Voxel_selection&, const Voxel_selection&,
                                    const std::optional<double>&, float, std::size_t&) const
{
  return {m_path, nullptr};
}

void Label_image::check_box(const std::string&, const std::string&, double) const {}
float Label_image::commonest_value(const Voxel_selection&) const { return 0; }
float Label_image::unused_value() const { return 0; }
bool Label_image::is_at_border(const Voxel_selection&) const { return false; }
std::size_t Label_image::number_of_voxels(const Voxel_selection&) const { return 0; }
double Label_image::volume_of_voxel() const { return 0; }
std::vector<std::uint32_t> Label_image::labels() const { return {}; }

Surface Label_image::surface_of(const Voxel_selection&, const Label_surface_options&, Surface_facts&,
                                std::vector<std::string>&) const
{
  return {};
}

std::vector<Surface> Label_image::surfaces_of(const std::vector<Voxel_selection>&,
                                              const Label_surface_options&, std::vector<Surface_facts>&,
                                              std::vector<mm3::Label_change_3>&) const
{
  return {};
}

std::vector<mm3::Label_thickness_3> Label_image::thickness_of(const std::vector<Voxel_selection>&) const
{
  return {};
}

#endif

Label_image::Label_image(const std::string& path, std::unique_ptr<const Data> data)
  : m_path(path), m_data(std::move(data))
{
}

Label_image::Label_image(Label_image&&) = default;
Label_image::~Label_image() = default;
