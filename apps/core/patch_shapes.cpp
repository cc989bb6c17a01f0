// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/patch_shapes.h"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <vector>

namespace {

// The numbers in a text, separated by commas; empty if the text is anything else.
std::vector<double> numbers_in(const std::string& text)
{
  std::vector<double> numbers;
  for(const std::string& word : CLI::detail::split(text + ',', ',')) // which ends at the last comma
    if(!CLI::detail::lexical_cast(word, numbers.emplace_back()))
      return {};
  return numbers;
}

} // namespace

std::optional<Patch_shape> patch_shape(const std::string& text)
{
  const std::size_t colon = text.find(':');
  if(colon == std::string::npos)
    return std::nullopt;
  return patch_shape(text.substr(0, colon), numbers_in(text.substr(colon + 1)));
}
