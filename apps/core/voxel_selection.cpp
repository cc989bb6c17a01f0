// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/voxel_selection.h"

#include "core/messages.h"
#include "core/resources.h"

#include <CGAL/Mixed_mesh_image_3/IO/internal/image_format_of.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace mm3 = CGAL::Mixed_meshes_3;

const char* const image_endings = mm3::IO::internal::image_endings;

bool is_image(const std::string& path) { return mm3::IO::internal::image_format_of(path).has_value(); }

bool Voxel_selection::operator()(float value) const
{
  if(ranges.empty())
    return value != 0;
  return std::any_of(ranges.begin(), ranges.end(), [&](const std::pair<double, double>& r) {
    return r.first <= double(value) && double(value) <= r.second;
  });
}

Voxel_selection labels_selection(const std::vector<std::uint32_t>& labels)
{
  Voxel_selection selection{{}, "with the labels "};
  for(std::uint32_t label : labels) {
    selection.text += (selection.ranges.empty() ? "" : ",") + std::to_string(label);
    selection.ranges.emplace_back(label, label);
  }
  return selection;
}

Voxel_selection labels_selection(const std::string& text, const Label_table& table)
{
  Voxel_selection selection{{}, "with the labels " + text};
  std::istringstream list(text);
  for(std::string item; std::getline(list, item, ',');) {
    const std::size_t dash = item.find('-');
    const std::optional<std::uint32_t> first = label_number(item.substr(0, dash)),
                                       last = dash == std::string::npos ? first
                                                                        : label_number(item.substr(dash + 1));
    if(first && last && *first <= *last) {
      selection.ranges.emplace_back(*first, *last);
      continue;
    }
    const std::vector<std::uint32_t> labels = table.labels(item);
    if(labels.empty() && !table.path().empty() && !item.empty())
      throw std::invalid_argument(table.path() + ": has no label '" + item + "'; the closest names are "
                                  + table.closest_in_words(item));
    if(labels.empty())
      throw std::invalid_argument("expected labels as in 1-189,200");
    for(std::uint32_t label : labels)
      selection.ranges.emplace_back(label, label);
  }
  if(selection.ranges.empty() || text.back() == ',')
    throw std::invalid_argument("expected labels as in 1-189,200");
  return selection;
}

std::vector<std::pair<std::string, Voxel_selection>> named_labels(const std::string& text,
                                                                  const Label_table& table)
{
  const char* const form = "expected labels as in brain=1-189,tumor=200";
  std::vector<std::pair<std::string, std::string>> lists;
  std::istringstream items(text);
  for(std::string item; std::getline(items, item, ',');) {
    const std::size_t equals = item.find('=');
    if(equals != std::string::npos)
      lists.emplace_back(item.substr(0, equals), item.substr(equals + 1));
    else if(lists.empty())
      throw std::invalid_argument(form);
    else
      lists.back().second += ',' + item;
  }
  if(lists.empty() || text.back() == ',')
    throw std::invalid_argument(form);
  std::vector<std::pair<std::string, Voxel_selection>> labels;
  for(const auto& [name, list] : lists)
    labels.emplace_back(name, labels_selection(list, table));
  return labels;
}

Voxel_selection united(const std::vector<Voxel_selection>& selections)
{
  Voxel_selection all{{}, "of all labels"};
  for(const Voxel_selection& s : selections)
    all.ranges.insert(all.ranges.end(), s.ranges.begin(), s.ranges.end());
  // Successive labels are one range, so that a voxel is not compared with each of hundreds.
  std::sort(all.ranges.begin(), all.ranges.end());
  std::vector<std::pair<double, double>> joined;
  for(const auto& [first, last] : all.ranges)
    if(!joined.empty() && first <= joined.back().second + 1)
      joined.back().second = (std::max)(joined.back().second, last);
    else
      joined.emplace_back(first, last);
  all.ranges = std::move(joined);
  return all;
}

Voxel_selection threshold_selection(double threshold)
{
  return {{{threshold, std::numeric_limits<double>::infinity()}}, "of at least " + rounded(threshold)};
}
