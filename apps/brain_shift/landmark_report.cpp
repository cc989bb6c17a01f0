// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/landmark_report.h"

#include "core/messages.h"

#include <cstddef>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Errors = std::vector<std::optional<Vector>>;

Json describe(const std::optional<Error_summary>& s)
{
  return s ? Json{{"mean", s->mean}, {"median", s->median}, {"maximum", s->largest}} : Json();
}

// The lengths of the errors at one landmark, of the methods that have an error.
Json lengths_at(std::size_t i, const Landmark_facts& landmarks, Errors Landmark_facts::Errors::*which)
{
  Json lengths = Json::object();
  for(const Landmark_facts::Errors& errors : landmarks.errors)
    if(const std::optional<Vector>& error = (errors.*which)[i])
      lengths[errors.method] = norm(*error);
  return lengths;
}

Json describe_points(const Landmark_facts& landmarks)
{
  Json points = Json::array();
  for(std::size_t i = 0; i < landmarks.points.size(); ++i) {
    const Control_point& p = landmarks.points[i];
    Json point = {{p.unit, p.number},
                  {"name", p.name.empty() ? Json() : Json(p.name)},
                  {"position", p.position},
                  {"displacement", p.displacement},
                  {"distance to the mesh", landmarks.locations[i].distance},
                  {"depth below the boundary", landmarks.depths[i]},
                  {"is given", bool(landmarks.is_given[i])},
                  {"errors if left out", lengths_at(i, landmarks, &Landmark_facts::Errors::left_out)}};
    if(!landmarks.is_given[i])
      point["errors by the outermost"] = lengths_at(i, landmarks, &Landmark_facts::Errors::given);
    if(landmarks.of_shift)
      point["error of the shift"] = norm((*landmarks.of_shift)[i]);
    points.push_back(point);
  }
  return points;
}

std::optional<Error_summary> summary_of_shift(const Landmark_facts& landmarks)
{
  if(!landmarks.of_shift)
    return std::nullopt;
  const Errors errors(landmarks.of_shift->begin(), landmarks.of_shift->end());
  return summary(errors, std::vector<bool>(errors.size(), true));
}

// Errors in hundredths of a millimeter, which no image resolves.
std::string text_of(const std::optional<Error_summary>& s)
{
  if(!s)
    return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << s->mean << " / " << s->median << " / " << s->largest;
  return text.str();
}

} // namespace

Json describe_landmarks(const Landmark_options& o, bool is_corotational, const Landmark_facts& landmarks)
{
  const std::size_t n = landmarks.points.size(), k = landmarks.number_given;
  Json left_out = {{"targets", n}}, given = {{"landmarks given", k}, {"targets", n - k}};
  for(const Landmark_facts::Errors& errors : landmarks.errors) {
    left_out[errors.method] = describe(summary(errors.left_out, std::vector<bool>(n, true)));
    given[errors.method] = describe(summary(errors.given, targets(landmarks)));
  }
  return {{"file", o.file},
          {"file of points after", o.file_after.empty() ? Json() : Json(o.file_after)},
          {"number", n},
          {"are control points", o.are_control_points},
          {"compliance", {{"value", o.compliance}, {"unit", "mm/mN"}}},
          {"leave-one-out errors of the model",
           is_corotational ? "estimated by the stiffness at rest" : "exact"},
          {"target registration errors in mm",
           {{"leave one out", left_out},
            {"by the outermost", given},
            {"shift by the control points", describe(summary_of_shift(landmarks))}}},
          {"points", describe_points(landmarks)}};
}

void print_landmarks(const Landmark_options& o, bool is_corotational, const Landmark_facts& landmarks)
{
  const std::size_t n = landmarks.points.size(), k = landmarks.number_given;
  const auto print_row = [](const std::string& name, const std::string& left_out, const std::string& given) {
    std::cout << "  " << std::left << std::setw(20) << name << std::setw(26) << left_out << given << '\n';
  };
  std::cout << "landmarks: target registration error in mm, mean / median / maximum\n";
  print_row("", "leave one out, " + std::to_string(n),
            std::to_string(n - k) + " by the " + std::to_string(k) + " outermost");
  for(const Landmark_facts::Errors& errors : landmarks.errors)
    print_row(errors.method, text_of(summary(errors.left_out, std::vector<bool>(n, true))),
              text_of(summary(errors.given, targets(landmarks))));
  if(landmarks.of_shift)
    std::cout << "  the shift by the control points, at all landmarks: "
              << text_of(summary_of_shift(landmarks)) << '\n';
  std::cout << "  in the model, landmarks give way to forces: compliance " << rounded(o.compliance)
            << " mm/mN (--control-compliance)\n";
  if(is_corotational)
    std::cout << "  with finite rotations, its leave-one-out errors are an estimate\n";
}
