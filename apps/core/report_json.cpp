// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/report_json.h"

#include <CGAL/version.h>

#include <boost/version.hpp>

namespace mm3 = CGAL::Mixed_meshes_3;

Json describe_program(const char* name)
{
  return {{"name", name}, {"version", "0.1"}, {"CGAL", CGAL_VERSION_STR}, {"Boost", BOOST_LIB_VERSION}};
}

void add_kinds(const Mesh_facts& mesh, Json& report)
{
  for(int k = 0; k < mm3::number_of_element_kinds; ++k)
    report[mm3::reference_elements[k].plural] = mesh.elements_of_kind[std::size_t(k)];
}

Json describe_stages(const Stage_log& log, const std::string& unit, double per_second)
{
  Json stages = Json::array();
  for(const Stage_cost& c : log.costs())
    stages.push_back({{"stage", c.name},
                      {unit, per_second * c.seconds},
                      {"CPU " + unit, per_second * c.cpu_seconds},
                      {"peak memory MiB", mebibytes(c.peak_bytes)}});
  return stages;
}

double mebibytes(std::size_t bytes) { return double(bytes) / (1 << 20); }

Json space_of(const mm3::IO::Read_anatomical_surface_options& options)
{
  return options.space ? Json(*options.space == mm3::IO::Anatomical_space::LPS ? "LPS" : "RAS") : Json();
}

std::string text_of(const Json& report, int indent)
{
  // File names need not be UTF-8.
  return report.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}
