// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/inputs.h"

#include "core/messages.h"
#include "core/read_label_surface.h"

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// A part of the domain that has labels of an image.
struct Part_of_image
{
  Subdomain_option option;
  mm3::Subdomain_index index;
  double number_of_voxels;
  double share; // share of the voxels of the domain
};

// Surfaces of files, each image read once.
class Surface_reader
{
  const Input_options& m_options;
  Stage_log& m_log;
  std::vector<std::string>& m_warnings;
  std::map<std::string, Label_image> m_images;
  std::optional<Label_image> m_domain; // completed

public:
  Surface_reader(const Input_options& o, Stage_log& log, std::vector<std::string>& warnings)
    : m_options(o), m_log(log), m_warnings(warnings)
  {
  }

  const Label_image& image(const std::string& file) { return m_images.try_emplace(file, file).first->second; }

  Surface operator()(const std::string& file, const Voxel_selection& voxels, Surface_facts& facts)
  {
    return is_image(file) ? surface_of(image(file), file, voxels, facts, m_warnings)
                          : read_surface(file, m_options.surface_options, facts, m_warnings);
  }

  // The image of the domain, completed according to the options.
  // \param filling labels for filled voxels
  const Label_image& domain(const Voxel_selection& voxels, const Voxel_selection& filling, Outcome& outcome)
  {
    const Label_image& whole = image(m_options.surface);
    if(!m_options.completion.is_needed())
      return whole;
    m_domain.emplace(whole.completed(voxels, filling, m_options.completion, outcome.completion.emplace()));
    return *m_domain;
  }

  // The surface of the domain from a file, without components that the options drop.
  Subdomain whole(const Subdomain_option& s, mm3::Subdomain_index index)
  {
    auto options = m_options.surface_options;
    options.keep_largest = m_options.completion.keep_largest;
    options.least_volume = m_options.completion.least_volume;
    return subdomain(s, index,
                     [&](Surface_facts& facts) { return read_surface(s.file, options, facts, m_warnings); });
  }

  // The surface of the domain, or of the part around other parts, from its image.
  Subdomain whole(const Subdomain_option& s, const Label_image& image, mm3::Subdomain_index index)
  {
    return subdomain(s, index, [&](Surface_facts& facts) {
      return surface_of(image, s.file, s.voxels, facts, m_warnings);
    });
  }

  // Parts of the domain from its image, several at a time: the surface of a part does not depend on other
  // parts.
  std::vector<Subdomain> parts(const Label_image& image, const std::vector<Part_of_image>& parts,
                               std::size_t number_of_parts)
  {
    struct Result
    {
      Subdomain subdomain;
      std::vector<std::string> warnings;
      std::exception_ptr error;
    };
    std::vector<Result> results(parts.size());
    std::atomic<std::size_t> number_of_results = 0;
    const auto make = [&](std::size_t i) {
      const Part_of_image& part = parts[i];
      Result& result = results[i];
      try {
        result.subdomain = subdomain(part.option, part.index, [&](Surface_facts& facts) {
          return surface_of(image, part.option.file, part.option.voxels, facts, result.warnings, part.share,
                            number_of_parts);
        });
        result.subdomain.volume = part.number_of_voxels * image.volume_of_voxel();
      } catch(...) {
        result.error = std::current_exception();
      }
      m_log.tell("label " + std::to_string(++number_of_results) + " of " + std::to_string(parts.size()));
    };
    mm3::internal::parallel_for(parts.size(),
                                mm3::internal::number_of_threads<CGAL::Parallel_if_available_tag>(), make, 1);
    std::vector<Subdomain> subdomains;
    for(Result& result : results) {
      if(result.error)
        std::rethrow_exception(result.error);
      m_warnings.insert(m_warnings.end(), result.warnings.begin(), result.warnings.end());
      subdomains.push_back(std::move(result.subdomain));
    }
    return subdomains;
  }

  Subdomain operator()(const Subdomain_option& s, mm3::Subdomain_index index)
  {
    return subdomain(s, index, [&](Surface_facts& facts) { return (*this)(s.file, s.voxels, facts); });
  }

  // The options of all labels of an image.
  std::vector<Subdomain_option> each_label(const std::string& file)
  {
    std::vector<Subdomain_option> labels;
    for(int label : image(file).labels())
      labels.push_back({"label_" + std::to_string(label), file, *labels_selection(std::to_string(label))});
    return labels;
  }

private:
  template <class Read>
  static Subdomain subdomain(const Subdomain_option& s, mm3::Subdomain_index index, const Read& read)
  {
    Surface_facts facts;
    auto surface = std::make_shared<const Surface>(read(facts));
    return {s.name, index, std::move(surface), facts, std::nullopt};
  }

  // \param share share of the domain
  // \param number_of_parts number of parts of the domain that have surfaces
  Surface surface_of(const Label_image& image, const std::string& file, const Voxel_selection& voxels,
                     Surface_facts& facts, std::vector<std::string>& warnings, double share = 1,
                     std::size_t number_of_parts = 1) const
  {
    // The number is several times that of the mesh's boundary; for parts more, as parts are finer.
    const double finer = share < 1 ? 3 : 1, least = share < 1 ? 1000 : 2000;
    double vertices = (std::max)(finer * 20 * std::pow(share * double(m_options.vertices), 2. / 3), least);
    // The number for many parts is bounded together: surfaces that are much finer than the mesh only cost
    // time.
    constexpr double many = 2e4, times_budget = 2, least_of_one = 100;
    if(share < 1)
      vertices = (std::min)(vertices, (std::max)((std::max)(many, times_budget * double(m_options.vertices))
                                                   / double(number_of_parts),
                                                 least_of_one));
    Surface surface = image.surface_of(voxels,
                                       {m_options.smoothing, std::size_t(vertices),
                                        m_options.surface_options.wrap_diameter},
                                       facts, warnings);
    if(surface.is_empty() && share == 1)
      throw std::runtime_error(file + ": nothing is left of the voxels " + voxels.text
                               + " after smoothing, see --smoothing");
    return surface;
  }
};

// Reads the surfaces of labels. The label with most voxels is around the others: its surface is that of all,
// so that there are no gaps where other labels meet. Labels of which smoothing leaves nothing are lost.
std::vector<Subdomain> read_labels(const Input_options& o, Surface_reader& read, Outcome& outcome)
{
  const std::vector<Subdomain_option> labels = o.has_each_label ? read.each_label(o.surface) : o.labels;
  const auto index_of = [&](std::size_t i) {
    return o.has_each_label ? mm3::Subdomain_index(labels[i].voxels.ranges[0].first)
                            : mm3::Subdomain_index(i + 1);
  };
  std::vector<std::pair<std::size_t, std::size_t>> sizes; // sizes with the numbers of labels
  std::vector<Voxel_selection> all;
  for(const Subdomain_option& label : labels) {
    sizes.emplace_back(read.image(o.surface).number_of_voxels(label.voxels), all.size());
    all.push_back(label.voxels);
  }
  const std::size_t largest = std::max_element(sizes.begin(), sizes.end())->second;
  const Voxel_selection whole = united(all);
  const Label_image& image = read.domain(whole, all[largest], outcome);
  const auto number_of = [&image](const Voxel_selection& v) { return double(image.number_of_voxels(v)); };
  const double number_of_all = number_of(whole);
  const auto lose = [&outcome](const std::string& what) {
    outcome.has_lost_labels = true;
    outcome.warnings.push_back("the subdomain " + what);
  };
  std::vector<Part_of_image> parts;
  for(std::size_t i = 0; i < all.size(); ++i) {
    if(i == largest)
      continue;
    const double number = number_of(all[i]);
    if(number == 0 && sizes[i].first > 0)
      lose(labels[i].name + " is lost: its component of the domain is dropped");
    else
      parts.push_back({{labels[i].name, o.surface, all[i]}, index_of(i), number, number / number_of_all});
  }
  std::vector<Subdomain> subdomains;
  for(Subdomain& s : read.parts(image, parts, all.size() - 1))
    if(s.surface->is_empty())
      lose(s.name + ", of volume " + volume_with_unit(*s.volume, o.is_in_patient_space())
           + ", is lost: smoothing leaves nothing of it, see --smoothing");
    else
      subdomains.push_back(std::move(s));
  subdomains.push_back(read.whole({labels[largest].name, o.surface, whole}, image, index_of(largest)));
  subdomains.back().volume = number_of(all[largest]) * image.volume_of_voxel();
  return subdomains;
}

std::vector<Subdomain> read_subdomains(const Input_options& o, Surface_reader& read, Outcome& outcome)
{
  const bool has_labels = o.has_each_label || !o.labels.empty();
  const std::vector<Subdomain> labels = has_labels ? read_labels(o, read, outcome) : std::vector<Subdomain>();
  std::vector<Subdomain> subdomains;
  for(const std::string& cavity : o.cavities)
    subdomains.push_back(read({"cavity", cavity}, 0));
  mm3::Subdomain_index index = mm3::Subdomain_index((std::max)(o.labels.size(), std::size_t(1)));
  for(const Subdomain& label : labels)
    index = (std::max)(index, label.index);
  for(const Subdomain_option& s : o.subdomains)
    subdomains.push_back(read(s, ++index));
  const Subdomain_option whole{surrounding_name(o), o.surface, o.voxels};
  if(!has_labels)
    subdomains.push_back(is_image(o.surface) ? read.whole(whole, read.domain(o.voxels, o.voxels, outcome), 1)
                                             : read.whole(whole, 1));
  if(!is_image(o.surface))
    order_by_nesting(subdomains, outcome.warnings);
  subdomains.insert(subdomains.end(), labels.begin(), labels.end());
  return subdomains;
}

} // namespace

Inputs read_inputs(const Input_options& o, Stage_log& log, Outcome& outcome)
{
  Inputs inputs;
  Surface_reader read(o, log, outcome.warnings);
  inputs.subdomains = log("read surface", [&] { return read_subdomains(o, read, outcome); });
  inputs.boundary = boundary_of(inputs.subdomains, is_image(o.surface));
  outcome.surface = inputs.subdomains.back().facts;
  if(inputs.subdomains.size() > 1)
    outcome.surface.volume = CGAL::Polygon_mesh_processing::volume(inputs.boundary);
  for(const Subdomain& s : inputs.subdomains)
    if(s.index == 0)
      outcome.surface.volume -= 2 * s.facts.volume; // surfaces of cavities are not turned inside out there
  for(const Region_option& r : o.regions)
    inputs.regions.push_back(
      log("read region", [&] { return read(r.file, r.voxels, outcome.regions.emplace_back()); }));
  return inputs;
}
