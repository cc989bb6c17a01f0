// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/read_landmarks.h"

#include "core/messages.h"
#include "core/resources.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string_view>

using namespace control_points;

namespace {

// Sets coordinate i of a pair: of the point before for i < 3, and of the point after for the others, which
// become the displacement when the pair is complete.
void set_coordinate(Control_point& pair, std::size_t i, std::string_view text, const Refuse_line& refuse_line)
{
  const std::string defect = read_coordinate(text, i < 3 ? pair.position[i] : pair.displacement[i - 3]);
  if(!defect.empty())
    refuse_line(defect);
}

std::vector<Control_point> read_landmark_table(const std::string& path)
{
  std::vector<Control_point> pairs;
  const std::string positions = "x,y,z,x_after,y_after,z_after", displacements = "x,y,z,dx,dy,dz";
  const std::string header = read_table(path, {positions, positions + ",name", displacements},
                                        [&](const auto& cells, std::size_t number,
                                            const Refuse_line& refuse_line) {
                                          Control_point pair;
                                          pair.number = number;
                                          for(std::size_t i = 0; i < 6; ++i)
                                            set_coordinate(pair, i, cells[i], refuse_line);
                                          if(cells.size() > 6)
                                            pair.name = cells[6];
                                          pairs.push_back(pair);
                                        });
  if(header != displacements)
    for(Control_point& pair : pairs)
      pair.displacement = difference(pair.displacement, pair.position);
  return pairs;
}

// The pair of a line: six coordinates; then, optionally, a weight and the numbers of structure and patient,
// which are ignored; and a label in quotes.
Control_point pair_of_tag(std::string_view line, std::size_t number, const Refuse_line& refuse_line)
{
  Control_point pair;
  pair.number = number;
  const std::size_t quote = line.find('"');
  if(quote != line.npos) {
    const std::size_t end = line.find('"', quote + 1);
    if(end == line.npos || end + 1 != line.size())
      refuse_line("expected a label in quotes at the end, not " + quoted(line.substr(quote)));
    pair.name = line.substr(quote + 1, end - quote - 1);
  }
  std::string numbers(trimmed(line.substr(0, quote)));
  std::replace(numbers.begin(), numbers.end(), '\t', ' ');
  const std::vector<std::string_view> cells = columns(numbers, ' ');
  for(std::size_t i = 0; i < cells.size(); ++i) {
    double ignored = 0;
    const std::string defect = read_number(cells[i], ignored);
    if(!defect.empty())
      refuse_line(defect);
  }
  if(cells.size() != 6 && cells.size() != 9)
    refuse_line("expected six numbers, before and after, or nine, with a weight and two indices, not "
                + std::to_string(cells.size()));
  for(std::size_t i = 0; i < 6; ++i)
    set_coordinate(pair, i, cells[i], refuse_line);
  pair.displacement = difference(pair.displacement, pair.position);
  return pair;
}

// Reads a file of tag points line by line.
class Tag_points
{
  std::vector<Control_point> m_pairs;
  bool m_has_title = false, m_has_volumes = false, m_is_in_points = false, m_has_ended = false;

public:
  void add_line(std::string_view line, std::size_t number, const Refuse_line& refuse_line)
  {
    line = trimmed(line);
    if(line.empty() || line[0] == '%' || line[0] == '#')
      return;
    if(!m_has_title) {
      if(line != "MNI Tag Point File")
        refuse_line("expected MNI Tag Point File, not " + quoted(line));
      m_has_title = true;
      return;
    }
    if(!m_is_in_points)
      line = after_header(line, refuse_line);
    if(line.empty())
      return;
    if(m_has_ended)
      refuse_line("expected nothing after the ; that ends the points, not " + quoted(line));
    m_has_ended = line.back() == ';';
    if(m_has_ended)
      line = trimmed(line.substr(0, line.size() - 1));
    if(!line.empty())
      m_pairs.push_back(pair_of_tag(line, number, refuse_line));
  }

  // The pairs. Throws if points are missing: a file that was cut off is not a shorter file.
  std::vector<Control_point> pairs(const std::string& path) const
  {
    if(!m_has_title)
      refuse(path, "is empty: expected MNI Tag Point File");
    if(!m_is_in_points)
      refuse(path, "has no points: expected a line Points =");
    if(!m_has_ended)
      refuse(path, "is cut short: expected a ; after the last point");
    return m_pairs;
  }

private:
  // The rest of the line after the words that come before the points.
  std::string_view after_header(std::string_view line, const Refuse_line& refuse_line)
  {
    const std::size_t equal = (std::min)(line.find('='), line.size());
    const std::string_view key = trimmed(line.substr(0, equal)),
                           value = trimmed(line.substr((std::min)(equal + 1, line.size())));
    if(key == "Volumes") {
      if(value != "2;" && value != "2 ;")
        refuse_line("expected Volumes = 2; for the points before and after, not " + quoted(line));
      m_has_volumes = true;
      return {};
    }
    if(key != "Points" || !m_has_volumes)
      refuse_line("expected " + std::string(m_has_volumes ? "Points =" : "Volumes = 2;") + ", not "
                  + quoted(line));
    m_is_in_points = true;
    return value;
  }
};

std::vector<Control_point> read_tags(const std::string& path)
{
  std::ifstream file = opened(path);
  Tag_points tags;
  std::string line;
  for(std::size_t number = 1; std::getline(file, line); ++number)
    tags.add_line(line, number, [&](const std::string& defect) {
      refuse(path, "line " + std::to_string(number) + ": " + defect);
    });
  if(file.bad())
    refuse(path, "cannot be read");
  return tags.pairs(path);
}

} // namespace

std::vector<Control_point> read_landmarks(const std::string& path, const std::string& after)
{
  const bool has_tags = boost::algorithm::ends_with(path, ".tag");
  const std::vector<Control_point> landmarks = is_fiducials(path) ? read_fiducials(path, after)
                                               : has_tags         ? read_tags(path)
                                                                  : read_landmark_table(path);
  if(landmarks.size() < least_number_of_landmarks)
    refuse(path, "has " + counted(landmarks.size(), "landmark", "landmarks") + ", expected at least "
                   + std::to_string(least_number_of_landmarks));
  std::map<std::array<double, 3>, const Control_point*> places;
  for(const Control_point& landmark : landmarks) {
    const auto [place, is_new] = places.emplace(landmark.position, &landmark);
    if(!is_new)
      refuse(path, landmark.place() + " is at the same place before as " + place->second->place());
  }
  return landmarks;
}
