// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/inputs.h"

#include "core/messages.h"
#include "core/read_label_surface.h"
#include "mixed_mesh_3/contacts.h"
#include "mixed_mesh_3/label_groups.h"
#include "mixed_mesh_3/layers.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// Surfaces of files, each image read once.
class Surface_reader
{
  const Input_options& m_options;
  std::vector<std::string>& m_warnings;
  std::map<std::string, Label_image> m_images;
  std::optional<Label_image> m_domain; // completed

public:
  Surface_reader(const Input_options& o, std::vector<std::string>& warnings)
    : m_options(o), m_warnings(warnings)
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

  // The surface of the domain from its image.
  Subdomain whole(const Subdomain_option& s, const Label_image& image, mm3::Subdomain_index index)
  {
    return subdomain(s, index, [&](Surface_facts& facts) {
      return surface_of(image, s.file, s.voxels, facts, m_warnings);
    });
  }

  // The surface around several labels, then that of each.
  std::vector<Surface> labels(const Label_image& image, const std::vector<Voxel_selection>& labels,
                              std::vector<Surface_facts>& facts,
                              std::vector<mm3::Label_change_3>& changes) const
  {
    if(m_options.surface_options.wrap_diameter > 0)
      throw std::runtime_error(m_options.surface
                               + ": --wrap would tear the surfaces of several labels apart, "
                                 "which touch; see --close and --hull");
    // Interfaces have more triangles together than the boundary, and those of small labels have to be fine.
    constexpr double finer = 3;
    return image.surfaces_of(labels, options(finer * number_of_vertices()), facts, changes);
  }

  Subdomain operator()(const Subdomain_option& s, mm3::Subdomain_index index)
  {
    return subdomain(s, index, [&](Surface_facts& facts) { return (*this)(s.file, s.voxels, facts); });
  }

private:
  template <class Read>
  static Subdomain subdomain(const Subdomain_option& s, mm3::Subdomain_index index, const Read& read)
  {
    Surface_facts facts;
    auto surface = std::make_shared<const Surface>(read(facts));
    return {s.name, index, std::move(surface), facts, std::nullopt, {}};
  }

  // The number of vertices of a surface is several times that of the mesh's boundary.
  double number_of_vertices() const
  {
    constexpr double least = 2000;
    return (std::max)(20 * std::pow(double(m_options.vertices), 2. / 3), least);
  }

  Label_surface_options options(double number_of_vertices) const
  {
    return {m_options.smoothing, std::size_t(number_of_vertices), m_options.surface_options.wrap_diameter};
  }

  Surface surface_of(const Label_image& image, const std::string& file, const Voxel_selection& voxels,
                     Surface_facts& facts, std::vector<std::string>& warnings) const
  {
    Surface surface = image.surface_of(voxels, options(number_of_vertices()), facts, warnings);
    if(surface.is_empty())
      throw std::runtime_error(file + ": nothing is left of the voxels " + voxels.text
                               + " after smoothing, see --smoothing");
    return surface;
  }
};

// The subdomains of labels of an image, and the surface around all.
struct Labels
{
  std::vector<Subdomain> subdomains;
  Surface boundary;
  mm3::Subdomain_index largest_index = 1; // also of labels that are lost
};

// A change in words, without the label.
std::string words_for(const mm3::Label_change_3& c)
{
  using Kind = mm3::Label_change_kind;
  const std::size_t before = c.number_before, after = c.number_after;
  const auto bodies = [](std::size_t n) { return counted(n, "body", "bodies"); };
  const auto cavities = [](std::size_t n) { return counted(n, "cavity", "cavities"); };
  const auto become = [](std::size_t n) { return n == 1 ? " becomes " : " become "; };
  const std::string near = " near " + place(c.point);
  switch(c.kind) {
  case Kind::BODIES_LOST:
    return bodies(before) + " of its voxels" + (before == 1 ? " is" : " are") + " lost" + near;
  case Kind::BODIES_PARTED:
    return bodies(before) + " of its voxels" + become(before) + std::to_string(after)
           + (before == 1 && after == 2 ? ": a bridge or a neck is lost" : ": bridges or necks are lost, one")
           + near;
  case Kind::BODIES_JOINED:
    return bodies(before) + " of its voxels" + become(before) + std::to_string(after)
           + (before == 2 ? ": they are joined" : ": they are joined, two of them") + near;
  case Kind::BODIES_ADDED:
    return bodies(after) + (after == 1 ? " is" : " are") + " added where it has no voxels," + near;
  case Kind::CAVITIES_LOST: return cavities(before) + (before == 1 ? " is" : " are") + " filled" + near;
  case Kind::CAVITIES_PARTED:
    return cavities(after - before) + (after - before == 1 ? " is" : " are")
           + " cut off from others, or from the outside," + near;
  case Kind::CAVITIES_JOINED:
    return cavities(before - after) + (before - after == 1 ? " is" : " are")
           + " open to others, or to the outside," + near;
  case Kind::CAVITIES_ADDED: return cavities(after) + (after == 1 ? " is" : " are") + " added" + near;
  case Kind::HANDLES_LOST:
    return counted(before, "handle", "handles") + " of its voxels" + become(before) + std::to_string(after)
           + ": holes are filled, or rings cut, perhaps" + near;
  case Kind::HANDLES_ADDED:
    return counted(before, "handle", "handles") + " of its voxels" + become(before) + std::to_string(after)
           + ": there are new holes, or rings, perhaps" + near;
  }
  return {};
}

// Tells the changes of topology by smoothing. A label of which nothing is left is told already. Changes of
// all labels together are told if they are more than those of each label.
void tell(const std::vector<mm3::Label_change_3>& changes, const std::vector<Label_group>& groups,
          const std::vector<Surface>& surfaces, Outcome& outcome)
{
  const auto number = [](const mm3::Label_change_3& c) {
    return (std::max)(c.number_before, c.number_after) - (std::min)(c.number_before, c.number_after);
  };
  const auto is_told_by_labels = [&](const mm3::Label_change_3& of_all) {
    std::size_t sum = 0;
    for(const mm3::Label_change_3& c : changes)
      sum += c.label > 0 && c.kind == of_all.kind ? number(c) : 0;
    return sum >= number(of_all);
  };
  for(const mm3::Label_change_3& c : changes)
    if(c.label == 0 ? !is_told_by_labels(c) : !surfaces[c.label].is_empty())
      outcome.changes_by_smoothing.push_back(
        {"smoothing changes "
           + (c.label == 0 ? "the whole domain" : "the subdomain " + groups[c.label - 1].name) + ": "
           + words_for(c),
         c.point});
  constexpr std::size_t most = 8;
  const std::size_t n = outcome.changes_by_smoothing.size(), shown = (std::min)(n, most);
  for(std::size_t i = 0; i < shown; ++i)
    outcome.warnings.push_back(outcome.changes_by_smoothing[i].sentence + ", see --smoothing");
  if(n > shown)
    outcome.warnings.push_back("smoothing makes " + counted(n - shown, "change", "changes")
                               + " more in the topology of labels, see the report");
}

// Reads the surfaces of labels. What completion adds to them is of the one with most voxels; then they get
// layers. Labels of which smoothing leaves nothing are lost.
Labels read_labels(const Meshing_options& o, Surface_reader& read, Outcome& outcome)
{
  const Label_image& whole = read.image(o.surface);
  std::vector<Label_group> groups = label_groups(o, whole, outcome.warnings);
  const auto size_of = [&whole](const Label_group& g) { // of equally large groups, the last one counts
    return std::make_pair(whole.number_of_voxels(g.voxels), g.index);
  };
  const auto largest = std::max_element(groups.begin(), groups.end(),
                                        [&](const Label_group& a, const Label_group& b) {
                                          return size_of(a) < size_of(b);
                                        });
  const Label_image& completed = read.domain(united(groups), largest->voxels, outcome);
  const std::optional<Label_image> layered = with_layers(o, completed, groups, outcome);
  const Label_image& image = layered ? *layered : completed;
  std::vector<Voxel_selection> all;
  std::vector<std::string> names;
  for(const Label_group& group : groups) {
    all.push_back(group.voxels);
    names.push_back(group.name);
  }
  if(all.size() > 1)
    check_layers(layers_of(image, all, names), o, outcome.warnings);
  outcome.voxels = (all.size() == 1 ? all[0] : united(all)).text;
  const auto lose = [&outcome](Subdomain_outcome s, const std::string& why) {
    outcome.has_lost_labels = true;
    outcome.warnings.push_back("the subdomain " + s.name + why);
    outcome.subdomains.push_back(std::move(s));
  };
  Labels labels;
  std::vector<Surface_facts> facts;
  std::vector<mm3::Label_change_3> changes;
  std::vector<Surface> surfaces = read.labels(image, all, facts, changes);
  tell(changes, groups, surfaces, outcome);
  for(std::size_t i = 0; i < all.size(); ++i) {
    const auto& [name, voxels, index] = groups[i];
    labels.largest_index = (std::max)(labels.largest_index, index);
    const auto number = double(image.number_of_voxels(all[i]));
    const double volume = number * image.volume_of_voxel();
    Subdomain_outcome lost;
    lost.name = name;
    lost.index = index;
    lost.surface = facts[i + 1];
    lost.voxels = voxels.text;
    lost.volume_of_voxels = volume;
    if(number == 0) {
      lose(std::move(lost), " is lost: its component of the domain is dropped");
    } else if(surfaces[i + 1].is_empty()) {
      lost.volume_of_surface = volume; // that of the voxels, as for other labels
      lose(std::move(lost), ", of volume " + volume_with_unit(volume, o.is_in_patient_space())
                              + ", is lost: smoothing leaves nothing of it, see --smoothing");
    } else {
      labels.subdomains.push_back({name, index, std::make_shared<const Surface>(std::move(surfaces[i + 1])),
                                   facts[i + 1], volume, voxels.text});
    }
  }
  if(labels.subdomains.empty())
    throw std::runtime_error(o.surface + ": nothing is left of the voxels " + outcome.voxels
                             + " after smoothing, see --smoothing");
  labels.boundary = std::move(surfaces[0]);
  outcome.surface = facts[0];
  return labels;
}

void read_domain(const Meshing_options& o, Surface_reader& read, Outcome& outcome, Inputs& inputs)
{
  const bool has_labels = o.label_choice != Label_choice::NONE;
  Labels labels = has_labels ? read_labels(o, read, outcome) : Labels();
  std::vector<Subdomain>& subdomains = inputs.subdomains;
  for(const std::string& cavity : o.cavities)
    subdomains.push_back(read({"cavity", cavity}, 0));
  mm3::Subdomain_index index = labels.largest_index;
  for(const Subdomain_option& s : o.subdomains)
    subdomains.push_back(read(s, ++index));
  const Subdomain_option whole{surrounding_name(o), o.surface, o.voxels};
  if(has_labels) {
    subdomains.insert(subdomains.end(), labels.subdomains.begin(), labels.subdomains.end());
    inputs.boundary = std::make_shared<const Surface>(std::move(labels.boundary));
  } else {
    subdomains.push_back(is_image(o.surface) ? read.whole(whole, read.domain(o.voxels, o.voxels, outcome), 1)
                                             : read.whole(whole, 1));
    if(!is_image(o.surface) && subdomains.size() > 1) {
      join_contacts(subdomains, o.surface_options, outcome.warnings);
      build_solids(subdomains);
      order_by_nesting(subdomains, outcome.warnings);
      take_overlaps(subdomains, outcome.warnings);
    }
    inputs.boundary = is_image(o.surface) || subdomains.size() == 1
                        ? subdomains.back().surface
                        : std::make_shared<const Surface>(union_of(subdomains));
    outcome.surface = subdomains.back().facts;
    outcome.voxels = o.voxels.text;
    if(subdomains.size() > 1)
      outcome.surface.volume = CGAL::Polygon_mesh_processing::volume(*inputs.boundary);
  }
  build_solids(subdomains);
  measure_visible_parts(subdomains);
  for(const Subdomain& s : subdomains)
    if(s.index == 0) {
      auto with_cavity = std::make_shared<Surface>(*inputs.boundary);
      CGAL::copy_face_graph(*s.surface, *with_cavity);
      inputs.boundary = std::move(with_cavity);
      outcome.surface.volume -= s.facts.volume;
    }
}

} // namespace

Inputs read_inputs(const Meshing_options& o, Stage_log& log, Outcome& outcome)
{
  Inputs inputs;
  Surface_reader read(o, outcome.warnings);
  log("read surface", [&] { read_domain(o, read, outcome, inputs); });
  for(const Region_option& r : o.regions)
    inputs.regions.push_back(
      log("read region", [&] { return read(r.file, r.voxels, outcome.regions.emplace_back()); }));
  return inputs;
}
