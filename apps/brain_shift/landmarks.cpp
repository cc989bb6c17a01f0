// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/landmarks.h"

#include "brain_shift/read_landmarks.h"
#include "brain_shift/registration.h"
#include "core/messages.h"

#include <CGAL/Mixed_mesh_3/surface_distance.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// Number of given landmarks when models were compared on public cases, which have 15 landmarks in the mean.
// At least as many are left to be predicted, but an affine map needs four.
std::size_t default_number_given(std::size_t n)
{
  constexpr std::size_t usual = 8, least = least_number_of_landmarks - 1;
  return (std::max)(least, (std::min)(usual, n / 2));
}

// The distance of each landmark from the boundary of the mesh; negative outside.
std::vector<double> depths_of(const Mesh& mesh, const Landmark_facts& landmarks)
{
  const mm3::internal::Nearest_triangle boundary(mm3::internal::boundary_triangles(mesh));
  std::vector<double> depths;
  for(std::size_t i = 0; i < landmarks.points.size(); ++i) {
    const auto& [x, y, z] = landmarks.points[i].position;
    const double distance = boundary({x, y, z}).distance;
    depths.push_back(landmarks.locations[i].distance > 0 ? -distance : distance);
  }
  return depths;
}

// The k landmarks nearest to the outside; at the same depth, the first ones in the file.
std::vector<bool> outermost(const std::vector<double>& depths, std::size_t k)
{
  std::vector<std::size_t> order(depths.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return depths[i] < depths[j]; });
  std::vector<bool> is_outermost(depths.size(), false);
  for(std::size_t i = 0; i < k; ++i)
    is_outermost[order[i]] = true;
  return is_outermost;
}

struct Pairs
{
  Points before, after;
};

// The pairs of given landmarks, or of the others.
Pairs pairs_of(const Landmark_facts& landmarks, bool are_given)
{
  const auto n = std::count(landmarks.is_given.begin(), landmarks.is_given.end(), are_given);
  Pairs pairs{Points(3, n), Points(3, n)};
  Eigen::Index column = 0;
  for(std::size_t i = 0; i < landmarks.points.size(); ++i)
    if(landmarks.is_given[i] == are_given) {
      const Control_point& point = landmarks.points[i];
      for(int k = 0; k < 3; ++k) {
        pairs.before(k, column) = point.position[k];
        pairs.after(k, column) = point.position[k] + point.displacement[k];
      }
      ++column;
    }
  return pairs;
}

Vector vector_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

std::vector<std::optional<Vector>> errors_left_out(Registration registration, const Landmark_facts& landmarks)
{
  Landmark_facts all;
  all.points = landmarks.points;
  all.is_given.assign(all.points.size(), true);
  const Pairs pairs = pairs_of(all, true);
  std::vector<std::optional<Vector>> errors;
  for(const auto& error : leave_one_out_errors(registration, pairs.before, pairs.after))
    errors.push_back(error ? std::optional<Vector>(vector_of(*error)) : std::nullopt);
  return errors;
}

std::vector<std::optional<Vector>> errors_of_targets(Registration registration,
                                                     const Landmark_facts& landmarks)
{
  const Pairs given = pairs_of(landmarks, true), others = pairs_of(landmarks, false);
  const std::optional<Points> put = registered(registration, given.before, given.after, others.before);
  std::vector<std::optional<Vector>> errors(landmarks.points.size());
  Eigen::Index column = 0;
  for(std::size_t i = 0; put && i < errors.size(); ++i)
    if(!landmarks.is_given[i]) {
      errors[i] = vector_of(others.after.col(column) - put->col(column));
      ++column;
    }
  return errors;
}

} // namespace

Landmark_facts read_landmarks(const Landmark_options& o)
{
  Landmark_facts landmarks;
  landmarks.points = read_landmarks(o.file, o.file_after);
  const std::size_t n = landmarks.points.size();
  landmarks.number_given = o.number_given > 0 ? o.number_given : default_number_given(n);
  if(landmarks.number_given >= n)
    control_points::refuse(o.file, "has " + std::to_string(n) + " landmarks: none is left to predict if "
                                     + std::to_string(landmarks.number_given)
                                     + " are given; see --landmarks-given");
  return landmarks;
}

void place_landmarks(const Mesh& mesh, const std::string& mesh_file, const Landmark_options& o,
                     Outcome& outcome)
{
  Landmark_facts& landmarks = *outcome.landmarks;
  if(o.are_control_points)
    landmarks.locations = outcome.locations;
  else
    landmarks.locations = locate(mesh, {mesh_file, o, landmarks.points}, outcome.warnings);
  landmarks.depths = depths_of(mesh, landmarks);
  landmarks.is_given = outermost(landmarks.depths, landmarks.number_given);
}

void compare_registrations(Landmark_facts& landmarks)
{
  for(Registration registration : registrations)
    landmarks.errors.push_back({name_of(registration), errors_left_out(registration, landmarks),
                                errors_of_targets(registration, landmarks)});
}

void warn_of_landmarks(const std::string& file, Outcome& outcome)
{
  const Landmark_facts& landmarks = *outcome.landmarks;
  const std::vector<bool> all(landmarks.points.size(), true);
  for(const Landmark_facts::Errors& errors : landmarks.errors) {
    const auto missing = std::find(errors.left_out.begin(), errors.left_out.end(), std::nullopt);
    if(missing != errors.left_out.end())
      outcome.warnings.push_back(file + ": " + errors.method + ": the landmarks other than "
                                 + landmarks.points[std::size_t(missing - errors.left_out.begin())].place()
                                 + " do not determine it: there is no error of leave one out");
    if(!summary(errors.given, targets(landmarks)))
      outcome.warnings.push_back(file + ": " + errors.method + ": the "
                                 + std::to_string(landmarks.number_given)
                                 + " outermost landmarks do not determine it; see --landmarks-given");
  }
  const auto summary_of = [&](const std::string& method) -> std::optional<Error_summary> {
    for(const Landmark_facts::Errors& errors : landmarks.errors)
      if(errors.method == method)
        return summary(errors.left_out, all);
    return std::nullopt;
  };
  const auto rigid = summary_of(name_of(Registration::RIGID)), model = summary_of(Landmark_facts::model);
  const Supports& supports = outcome.supports;
  if(rigid && model && model->mean > rigid->mean && supports.fixed + supports.sliding + supports.touching > 0)
    outcome.warnings.push_back(
      file + ": a rigid registration predicts landmarks to " + rounded(rigid->mean)
      + " mm in the mean, the model to " + rounded(model->mean)
      + " mm: either landmarks give way too much beside the supports of the model, see --control-compliance, "
        "or images that are not aligned contradict these, see --fixed-below");
}

std::optional<Error_summary> summary(const std::vector<std::optional<Vector>>& errors,
                                     const std::vector<bool>& is_target)
{
  std::vector<double> lengths;
  for(std::size_t i = 0; i < errors.size(); ++i)
    if(is_target[i]) {
      if(!errors[i])
        return std::nullopt;
      lengths.push_back(norm(*errors[i]));
    }
  if(lengths.empty())
    return std::nullopt;
  std::sort(lengths.begin(), lengths.end());
  const std::size_t n = lengths.size();
  const double median = (lengths[(n - 1) / 2] + lengths[n / 2]) / 2;
  return Error_summary{std::accumulate(lengths.begin(), lengths.end(), 0.) / double(n), median,
                       lengths.back()};
}

std::vector<bool> targets(const Landmark_facts& landmarks)
{
  std::vector<bool> are_targets = landmarks.is_given;
  are_targets.flip();
  return are_targets;
}
