// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/Label_table.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/lexical_cast/try_lexical_convert.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <tuple>

namespace {

// The words of a line; a word may be in quotes.
std::vector<std::string> words_of(const std::string& line)
{
  std::istringstream in(line);
  std::vector<std::string> words;
  for(std::string word; in >> std::quoted(word);)
    words.push_back(word);
  return words;
}

// The name in the words of a line; empty if the line has none of the forms.
std::string name_in(const std::vector<std::string>& words)
{
  const auto are_numbers = [&words](std::size_t first, std::size_t last) {
    return std::all_of(words.begin() + std::ptrdiff_t(first), words.begin() + std::ptrdiff_t(last),
                       [](const std::string& word) {
                         double x;
                         return boost::conversion::try_lexical_convert(word, x);
                       });
  };
  const std::size_t n = words.size();
  if((n == 6 || n == 7) && are_numbers(2, n)) // FreeSurfer may have a type of tissue after the color
    return words[1];
  if(n == 8 && are_numbers(1, 7)) // ITK-SNAP: color, visibility and mesh before the name
    return words[7];
  return {};
}

// The least number of letters to be inserted, removed or replaced that makes one word of the other.
std::size_t edit_distance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for(std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for(std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = (std::min)({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row[b.size()];
}

} // namespace

std::optional<std::uint32_t> label_number(const std::string& text)
{
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if(error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

Label_table::Label_table(const std::string& path) : m_path(path)
{
  std::ifstream in(path);
  std::string line;
  for(std::size_t number = 1; std::getline(in, line); ++number) {
    const auto refuse = [&](const std::string& defect) {
      throw std::runtime_error(path + ": line " + std::to_string(number) + ": " + defect);
    };
    const std::vector<std::string> words = words_of(line);
    if(line.find_first_not_of(" \t\r") == std::string::npos || line[line.find_first_not_of(" \t")] == '#')
      continue;
    const std::optional<std::uint32_t> label = words.empty() ? std::nullopt : label_number(words[0]);
    const std::string name = name_in(words);
    if(!label || name.empty())
      refuse("expected number, name and color (FreeSurfer, Slicer), or number, color, two numbers and "
             "\"name\" (ITK-SNAP)");
    if(!m_names.emplace(*label, name).second)
      refuse("the label " + words[0] + " is there twice");
  }
  if(!in.eof())
    throw std::runtime_error(path + ": cannot be read");
  if(m_names.empty())
    throw std::runtime_error(path + ": has no labels");
}

std::string Label_table::name(std::uint32_t label) const
{
  const auto found = m_names.find(label);
  return found == m_names.end() ? std::string() : found->second;
}

std::vector<std::uint32_t> Label_table::labels(const std::string& name) const
{
  std::vector<std::uint32_t> labels;
  for(const auto& [label, known] : m_names)
    if(boost::iequals(known, name))
      labels.push_back(label);
  return labels;
}

std::string Label_table::closest_in_words(const std::string& name) const
{
  const std::string wanted = boost::to_lower_copy(name);
  std::vector<std::tuple<bool, std::size_t, std::string>> found; // names that contain the word come first
  for(const auto& [label, known] : m_names) {
    const std::string lower = boost::to_lower_copy(known);
    found.emplace_back(lower.find(wanted) == std::string::npos, edit_distance(lower, wanted), known);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  constexpr std::size_t most = 3;
  std::string text;
  for(std::size_t i = 0; i < (std::min)(most, found.size()); ++i)
    text += (i > 0 ? ", " : "") + std::get<2>(found[i]);
  return text;
}
