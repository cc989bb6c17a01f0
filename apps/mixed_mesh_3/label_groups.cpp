// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/label_groups.h"

#include "core/messages.h"
#include "mixed_mesh_3/subdomains.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// Names for files, each used once; formats ignore upper and lower case.
class Unique_names
{
  std::set<std::string> m_used;

public:
  explicit Unique_names(const Input_options& o) : m_used{outside}
  {
    for(const auto& others : {o.subdomains, o.sheets})
      for(const Subdomain_option& s : others)
        m_used.insert(boost::to_lower_copy(s.name));
  }

  // A name for files that is like another name.
  std::string operator()(std::string name)
  {
    for(char& c : name)
      if(!std::isalnum(static_cast<unsigned char>(c)) && c != '-')
        c = '_';
    if(!is_subdomain_name(name.substr(0, longest_subdomain_name)))
      name = "label_" + name;
    for(int number = 1;; ++number) {
      const std::string end = number == 1 ? "" : '_' + std::to_string(number);
      const std::string candidate = name.substr(0, longest_subdomain_name - end.size()) + end;
      if(m_used.insert(boost::to_lower_copy(candidate)).second)
        return candidate;
    }
  }
};

std::vector<Label_group> each_label(const Input_options& o, const Label_image& image)
{
  Unique_names unique(o);
  std::vector<Label_group> groups;
  for(const std::uint32_t label : image.labels()) {
    const std::string name = o.label_table.name(label);
    groups.push_back({unique(name.empty() ? "label_" + std::to_string(label) : name),
                      labels_selection(std::vector{label}), mm3::Subdomain_index(label)});
  }
  return groups;
}

// Groups of the options with the labels that the image has.
std::vector<Label_group> groups_of_image(const Input_options& o, const Label_image& image,
                                         std::vector<std::string>& warnings)
{
  std::vector<std::vector<std::uint32_t>> found(o.labels.size());
  std::string others;
  for(const std::uint32_t label : image.labels()) {
    const auto group = std::find_if(o.labels.begin(), o.labels.end(),
                                    [label](const Subdomain_option& s) { return s.voxels(float(label)); });
    const std::string name = o.label_table.name(label);
    if(group != o.labels.end())
      found[std::size_t(group - o.labels.begin())].push_back(label);
    else
      others += (others.empty() ? "" : ", ") + std::to_string(label)
                + (name.empty() ? "" : " (" + name + ')');
  }
  std::vector<Label_group> groups;
  for(std::size_t i = 0; i < found.size(); ++i)
    if(!found[i].empty())
      groups.push_back({o.labels[i].name, labels_selection(found[i]), mm3::Subdomain_index(i + 1)});
  if(groups.empty())
    throw std::runtime_error(o.surface + ": has no labels of --labels freesurfer, only " + others);
  if(!others.empty())
    warnings.push_back(o.surface
                       + ": labels that --labels freesurfer has in no group are left out: " + others);
  return groups;
}

// The largest index of groups.
mm3::Subdomain_index largest_index(const std::vector<Label_group>& groups)
{
  mm3::Subdomain_index largest = 0;
  for(const Label_group& group : groups)
    largest = (std::max)(largest, group.index);
  return largest;
}

// Makes one group of several, in the place of the first one. An image need not have all of FreeSurfer's.
void merge(const Merge_option& option, const Input_options& o, const Label_image& image,
           std::vector<Label_group>& groups)
{
  const auto is_named = [](const std::string& name) {
    return [&name](const Label_group& g) { return boost::iequals(g.name, name); };
  };
  std::vector<std::string> names;
  for(const Label_group& group : groups)
    names.push_back(group.name);
  std::vector<Label_group> merged;
  std::size_t place = groups.size();
  for(const std::string& part : option.parts) {
    const auto group = std::find_if(groups.begin(), groups.end(), is_named(part));
    if(group == groups.end()) {
      if(o.label_choice == Label_choice::FREESURFER)
        continue;
      throw std::runtime_error(option.text() + ": " + part + ": " + sentence_on_no_subdomain(names));
    }
    place = (std::min)(place, std::size_t(group - groups.begin()));
    merged.push_back(std::move(*group));
    groups.erase(group);
  }
  if(merged.empty())
    throw std::runtime_error(option.text() + ": " + o.surface + " has no labels of these");
  if(std::any_of(groups.begin(), groups.end(), is_named(option.name)))
    throw std::runtime_error(option.text() + ": the name is taken");
  mm3::Subdomain_index index = merged.front().index;
  std::vector<std::uint32_t> labels;
  for(const std::uint32_t label : image.labels())
    for(const Label_group& part : merged)
      if(part.voxels(float(label))) {
        labels.push_back(label);
        index = (std::min)(index, part.index);
      }
  groups.insert(groups.begin() + std::ptrdiff_t(place), {option.name, labels_selection(labels), index});
}

// The groups before merges.
std::vector<Label_group> chosen_groups(const Input_options& o, const Label_image& image,
                                       std::vector<std::string>& warnings)
{
  if(o.label_choice == Label_choice::EACH)
    return each_label(o, image);
  if(o.label_choice == Label_choice::FREESURFER)
    return groups_of_image(o, image, warnings);
  std::vector<Label_group> groups;
  for(const Subdomain_option& s : o.labels) {
    if(image.number_of_voxels(s.voxels) == 0)
      throw std::runtime_error(o.surface + ": there are no voxels " + s.voxels.text);
    groups.push_back({s.name, s.voxels, mm3::Subdomain_index(groups.size() + 1)});
  }
  return groups;
}

} // namespace

std::vector<Label_group> label_groups(const Input_options& o, const Label_image& image,
                                      std::vector<std::string>& warnings)
{
  std::vector<Label_group> groups = chosen_groups(o, image, warnings);
  for(const Merge_option& option : o.merges)
    merge(option, o, image, groups);
  return groups;
}

Voxel_selection united(const std::vector<Label_group>& groups)
{
  std::vector<Voxel_selection> all;
  for(const Label_group& group : groups)
    all.push_back(group.voxels);
  return united(all);
}

std::optional<Label_image> with_layers(const Input_options& o, const Label_image& image,
                                       std::vector<Label_group>& groups, Outcome& outcome)
{
  std::optional<Label_image> result;
  for(const Layer_option& layer : o.label_layers) {
    const Label_image& before = result ? *result : image;
    const Voxel_selection domain = united(groups);
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&layer](const Label_group& g) { return boost::iequals(g.name, layer.name); });
    const bool is_new = group == groups.end();
    const float value = is_new ? before.unused_value() : before.commonest_value(group->voxels);
    std::size_t number = 0;
    result.emplace(before.with_layer(layer.distance && !is_new ? group->voxels : domain, domain,
                                     layer.distance, value, number));
    if(is_new && number == 0)
      throw std::runtime_error(o.surface + (layer.distance ? ": --grow " : ": --fill ") + layer.name
                               + ": there are no voxels of 0 "
                               + (layer.distance ? "that near to the labels" : "that the labels enclose"));
    if(is_new)
      group = groups.insert(groups.end(), {layer.name,
                                           {{{value, value}}, "of the layer " + layer.name},
                                           largest_index(groups) + 1});
    outcome.layers.push_back({group->name, layer.distance, number, is_new});
    if(layer.distance && number > 0 && result->is_at_border(group->voxels))
      outcome.warnings.push_back(o.surface + ": " + group->name + ", grown by " + rounded(*layer.distance)
                                 + " mm, is cut off at the border of the image");
  }
  return result;
}
