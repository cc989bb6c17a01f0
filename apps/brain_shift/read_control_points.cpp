// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/read_control_points.h"

#include "core/resources.h"

#include <boost/algorithm/string/predicate.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
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

static constexpr double largest_coordinate = 1e6; // mm

void refuse(const std::string& path, const std::string& defect)
{
  throw std::runtime_error(path + ": " + defect);
}

std::ifstream opened(const std::string& path)
{
  std::error_code ignored; // the attempt to open the file says more
  if(std::filesystem::is_directory(path, ignored))
    refuse(path, "is a directory");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if(!file)
    refuse(path, std::string("cannot be opened: ") + std::strerror(errno));
  return file;
}

std::string_view trimmed(std::string_view text)
{
  const char* const blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == text.npos ? std::string_view()
                            : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::vector<std::string_view> columns(std::string_view line, char separator)
{
  std::vector<std::string_view> result;
  for(std::size_t end; (end = line.find(separator)) != line.npos; line.remove_prefix(end + 1))
    if(separator != ' ' || end > 0)
      result.push_back(trimmed(line.substr(0, end)));
  result.push_back(trimmed(line));
  return result;
}

// The first separator that a line has.
static char separator_of(std::string_view line)
{
  for(char c : {',', ';', '\t'})
    if(line.find(c) != line.npos)
      return c;
  return ' ';
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

std::array<double, 3> difference(const std::array<double, 3>& p, const std::array<double, 3>& q)
{
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

std::string read_coordinate(std::string_view text, double& x)
{
  const std::string defect = read_number(text, x);
  return defect.empty() && std::abs(x) > largest_coordinate ? quoted(text) + " mm is more than a kilometer"
                                                            : defect;
}

static std::string joined(const std::vector<std::string>& headers)
{
  std::string result = headers.front();
  for(std::size_t i = 1; i < headers.size(); ++i)
    result += (i + 1 < headers.size() ? "; " : " or ") + headers[i];
  return result;
}

// The header that a line is.
static std::string header_of(const std::vector<std::string_view>& cells, std::string_view line,
                             const std::vector<std::string>& headers, const Refuse_line& refuse_line)
{
  for(const std::string& header : headers)
    if(cells == columns(header))
      return header;
  refuse_line("expected the header " + joined(headers) + ", not " + quoted(line));
  return std::string();
}

std::string read_table(
  const std::string& path, const std::vector<std::string>& headers,
  const std::function<void(const std::vector<std::string_view>&, std::size_t, const Refuse_line&)>& add_row)
{
  std::ifstream file = opened(path);
  std::string header, text;
  std::size_t width = 0;
  char separator = ',';
  for(std::size_t number = 1; std::getline(file, text); ++number) {
    std::string_view line = text;
    if(number == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") // the byte-order mark that spreadsheets write
      line.remove_prefix(3);
    line = trimmed(line);
    if(line.empty() || line[0] == '#')
      continue;
    const auto refuse_line = [&](const std::string& defect) {
      refuse(path, "line " + std::to_string(number) + ": " + defect);
    };
    if(header.empty())
      separator = separator_of(line);
    const std::vector<std::string_view> cells = columns(line, separator);
    if(header.empty()) {
      header = header_of(cells, line, headers, refuse_line);
      width = cells.size();
      continue;
    }
    if(cells.size() != width)
      refuse_line("expected " + std::to_string(width) + " columns, " + header + ", not "
                  + std::to_string(cells.size()));
    add_row(cells, number, refuse_line);
  }
  if(file.bad())
    refuse(path, "cannot be read");
  if(header.empty())
    refuse(path, "is empty: expected the header " + headers.front());
  return header;
}

} // namespace control_points

using namespace control_points;

// The point of a line of the table.
static Control_point point_of(const std::vector<std::string_view>& cells, std::size_t line,
                              const Refuse_line& refuse_line)
{
  constexpr double least_weight = 1e-6;
  Control_point point;
  point.number = line;
  for(std::size_t i = 0; i < cells.size(); ++i) {
    double& x = i < 3 ? point.position[i] : i < 6 ? point.displacement[i - 3] : point.weight;
    const std::string defect = i < 6 ? read_coordinate(cells[i], x) : read_number(cells[i], x);
    if(!defect.empty())
      refuse_line(defect);
  }
  if(!(point.weight >= least_weight && point.weight <= 1 / least_weight))
    refuse_line("the weight " + quoted(cells[6]) + " is not from 1e-6 to 1e6");
  return point;
}

std::vector<Control_point> read_control_points(const std::string& path)
{
  std::vector<Control_point> points;
  read_table(path, {"x,y,z,dx,dy,dz", "x,y,z,dx,dy,dz,weight"},
             [&](const auto& cells, std::size_t number, const Refuse_line& refuse_line) {
               points.push_back(point_of(cells, number, refuse_line));
             });
  if(points.empty())
    refuse(path, "has no control points");
  return points;
}

bool is_fiducials(const std::string& path)
{
  return boost::algorithm::ends_with(path, ".fcsv") || boost::algorithm::ends_with(path, ".mrk.json");
}

namespace {

using Point = std::array<double, 3>;

// Whether a coordinate system is LPS. Versions of 3D Slicer write RAS, LPS, or 0 and 1 for these.
bool is_lps(const std::string& path, const std::string& system)
{
  const bool is_lps = system == "LPS" || system == "1";
  if(!is_lps && system != "RAS" && system != "0")
    refuse(path, "unknown coordinate system " + control_points::quoted(system) + ": expected RAS or LPS");
  return is_lps;
}

struct Fiducial
{
  Point position;
  std::string name;
};

std::vector<Fiducial> read_fcsv(const std::string& path, std::istream& file, bool& has_lps)
{
  std::vector<Fiducial> points;
  std::string text;
  std::size_t label = std::string::npos; // column of the label
  for(std::size_t number = 1; std::getline(file, text); ++number) {
    const std::string_view line = trimmed(text), system = "# CoordinateSystem =", names = "# columns =";
    if(line.substr(0, system.size()) == system)
      has_lps = is_lps(path, std::string(trimmed(line.substr(system.size()))));
    if(line.substr(0, names.size()) == names) {
      const std::vector<std::string_view> all = columns(line.substr(names.size()));
      label = std::size_t(std::find(all.begin(), all.end(), "label") - all.begin());
    }
    if(line.empty() || line[0] == '#')
      continue;
    const std::vector<std::string_view> cells = columns(line); // a name, then x, y, z
    const auto refuse_line = [&](const std::string& defect) {
      refuse(path, "line " + std::to_string(number) + ": " + defect);
    };
    if(cells.size() < 4)
      refuse_line("expected a name and three numbers, not " + std::to_string(cells.size()) + " columns");
    Fiducial p;
    for(std::size_t i = 0; i < 3; ++i) {
      const std::string defect = read_number(cells[i + 1], p.position[i]);
      if(!defect.empty())
        refuse_line(defect);
    }
    if(label < cells.size())
      p.name = cells[label];
    points.push_back(p);
  }
  return points;
}

std::vector<Fiducial> read_markups(const std::string& path, std::istream& file, bool& has_lps)
{
  std::vector<Fiducial> points;
  try {
    const nlohmann::json markups = nlohmann::json::parse(file).at("markups");
    if(markups.size() != 1)
      refuse(path, "has " + std::to_string(markups.size()) + " lists of points, expected one");
    has_lps = is_lps(path, markups[0].value("coordinateSystem", "RAS"));
    for(const auto& point : markups[0].at("controlPoints"))
      points.push_back({point.at("position").get<Point>(), point.value("label", "")});
  } catch(const nlohmann::json::exception& e) {
    refuse(path, std::string("is no list of markups: ") + e.what());
  }
  return points;
}

std::vector<Fiducial> read_points(const std::string& path)
{
  if(!is_fiducials(path))
    refuse(path, "unknown format; expected fiducials, .fcsv or .mrk.json, as the points before");
  std::ifstream file = opened(path);
  bool has_lps = false;
  std::vector<Fiducial> points = path.back() == 'v' ? read_fcsv(path, file, has_lps)
                                                    : read_markups(path, file, has_lps);
  if(points.empty())
    refuse(path, "has no points");
  for(std::size_t i = 0; i < points.size(); ++i)
    for(int k = 0; k < 3; ++k) {
      double& x = points[i].position[k];
      x *= has_lps && k < 2 ? -1 : 1;
      if(!(std::abs(x) <= largest_coordinate))
        refuse(path, "point " + std::to_string(i + 1) + " is more than a kilometer away");
    }
  return points;
}

} // namespace

std::vector<Control_point> read_fiducials(const std::string& before, const std::string& after)
{
  const std::vector<Fiducial> p = read_points(before), q = read_points(after);
  if(p.size() != q.size())
    refuse(after,
           "has " + std::to_string(q.size()) + " points, but " + before + " has " + std::to_string(p.size()));
  std::vector<Control_point> points;
  for(std::size_t i = 0; i < p.size(); ++i)
    points.push_back({p[i].position, difference(q[i].position, p[i].position), i + 1, "point", 1, p[i].name});
  return points;
}
