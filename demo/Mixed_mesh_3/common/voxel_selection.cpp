// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/voxel_selection.h"

#include "common/messages.h"
#include "common/resources.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>
#include <sstream>
#include <system_error>

namespace {

// The whole text as a number that is not negative.
std::optional<double> label(const std::string& text)
{
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if(error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

} // namespace

bool is_image(const std::string& path) { return ends_with(path, ".nii") || ends_with(path, ".nii.gz"); }

bool Voxel_selection::operator()(float value) const
{
  if(ranges.empty())
    return value != 0;
  return std::any_of(ranges.begin(), ranges.end(), [&](const std::pair<double, double>& r) {
    return r.first <= double(value) && double(value) <= r.second;
  });
}

std::optional<Voxel_selection> labels_selection(const std::string& text)
{
  Voxel_selection selection{{}, "with the labels " + text};
  std::istringstream list(text);
  for(std::string item; std::getline(list, item, ',');) {
    const std::size_t dash = item.find('-');
    const std::optional<double> first = label(item.substr(0, dash)),
                                last = dash == std::string::npos ? first : label(item.substr(dash + 1));
    if(!first || !last || *first > *last)
      return std::nullopt;
    selection.ranges.emplace_back(*first, *last);
  }
  if(selection.ranges.empty() || text.back() == ',')
    return std::nullopt;
  return selection;
}

Voxel_selection threshold_selection(double threshold)
{
  return {{{threshold, std::numeric_limits<double>::infinity()}}, "of at least " + rounded(threshold)};
}
