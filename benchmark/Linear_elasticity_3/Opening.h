// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_BENCHMARK_OPENING_H
#define MIXED_MESH_3_BENCHMARK_OPENING_H

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

/// A tumor and the opening of the skull to reach it; millimeters.
struct Opening
{
  using Vector = CGAL::Mixed_meshes_3::Vec3;

  std::string name;
  Vector tumor, center; // of a ball; of a disk
  double tumor_radius, radius;
  Vector axis;   // normal of the disk: of length 1, towards the tumor
  double length; // from center to center
};

/// Reads openings. \param file file in the form of openings.json
inline std::vector<Opening> read_openings(const std::string& file)
{
  using namespace CGAL::Mixed_meshes_3;
  std::ifstream in(file);
  if(!in)
    throw std::runtime_error(file + ": cannot be read");
  std::vector<Opening> openings;
  for(const auto& json : nlohmann::json::parse(in)) {
    Opening o;
    o.name = json.at("name");
    o.tumor = json.at("tumor").get<std::array<double, 3>>();
    o.center = json.at("opening").get<std::array<double, 3>>();
    o.tumor_radius = json.at("tumor radius");
    o.radius = json.at("opening radius");
    o.length = norm(o.tumor - o.center);
    o.axis = (1 / o.length) * (o.tumor - o.center);
    openings.push_back(o);
  }
  return openings;
}

inline Opening find_opening(const std::vector<Opening>& openings, const std::string& name)
{
  for(const Opening& o : openings)
    if(o.name == name)
      return o;
  throw std::runtime_error("no opening is called " + name);
}

#endif // MIXED_MESH_3_BENCHMARK_OPENING_H
