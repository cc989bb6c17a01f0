// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/read_control_points.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <system_error>

namespace control_points {

static std::string_view trimmed(std::string_view text)
{
  const char* const blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == text.npos ? std::string_view()
                            : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::vector<std::string_view> columns(std::string_view line)
{
  std::vector<std::string_view> result;
  for(std::size_t comma; (comma = line.find(',')) != line.npos; line.remove_prefix(comma + 1))
    result.push_back(trimmed(line.substr(0, comma)));
  result.push_back(trimmed(line));
  return result;
}

std::string quoted(std::string_view text)
{
  std::string result = "\"";
  for(char c : text.substr(0, 30))
    result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > 30 ? "...\"" : "\"");
}

std::string read_number(std::string_view text, double& x)
{
  const std::string_view digits = text.substr(!text.empty() && text[0] == '+');
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
  if(error == std::errc::result_out_of_range)
    return quoted(text) + " is out of range";
  if(error != std::errc() || end != digits.data() + digits.size() || (digits != text && digits[0] == '-'))
    return text.empty() ? "a number is missing" : quoted(text) + " is not a number";
  if(!std::isfinite(x))
    return quoted(text) + " is not a finite number";
  return std::string();
}

} // namespace control_points

// The point of a line of the table.
static Control_point point_of(const std::vector<std::string_view>& cells, std::size_t line,
                              const std::function<void(const std::string&)>& refuse)
{
  using namespace control_points;
  constexpr double largest = 1e6; // mm: nothing in a body is a kilometer away
  Control_point point;
  point.line = line;
  for(std::size_t i = 0; i < 6; ++i) {
    double& x = i < 3 ? point.position[i] : point.displacement[i - 3];
    const std::string defect = read_number(cells[i], x);
    if(!defect.empty())
      refuse(defect);
    if(std::abs(x) > largest)
      refuse(quoted(cells[i]) + " mm is more than a kilometer");
  }
  return point;
}

std::vector<Control_point> read_control_points(const std::string& path)
{
  using namespace control_points;
  const auto refuse = [&path](const std::string& defect) { throw std::runtime_error(path + ": " + defect); };
  if(std::filesystem::is_directory(path))
    refuse("is a directory");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if(!file)
    refuse(std::string("cannot be opened: ") + std::strerror(errno));

  const std::string header = "x,y,z,dx,dy,dz";
  std::vector<Control_point> points;
  bool has_header = false;
  std::string text;
  for(std::size_t number = 1; std::getline(file, text); ++number) {
    std::string_view line = text;
    if(number == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") // the byte-order mark that spreadsheets write
      line.remove_prefix(3);
    line = trimmed(line);
    if(line.empty() || line[0] == '#')
      continue;
    const auto refuse_line = [&](const std::string& defect) {
      refuse("line " + std::to_string(number) + ": " + defect);
    };
    const std::vector<std::string_view> cells = columns(line);
    if(!has_header) {
      if(cells != columns(header))
        refuse_line("expected the header " + header + ", not " + quoted(line));
      has_header = true;
      continue;
    }
    if(cells.size() != 6)
      refuse_line("expected 6 columns, " + header + ", not " + std::to_string(cells.size()));
    points.push_back(point_of(cells, number, refuse_line));
  }
  if(file.bad())
    refuse("cannot be read");
  if(!has_header)
    refuse("is empty: expected the header " + header);
  if(points.empty())
    refuse("has no control points");
  return points;
}
