// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/meshing_options.h"

#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <filesystem>

namespace mm3 = CGAL::Mixed_meshes_3;

std::string Merge_option::text() const
{
  std::string text = "--merge " + name;
  for(std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? '=' : '+') + parts[i];
  return text;
}

bool is_subdomain_name(const std::string& name)
{
  return name.size() <= longest_subdomain_name && mm3::IO::is_facet_set_name(name);
}

bool Input_options::is_in_patient_space() const
{
  const auto silent = {".off", ".obj", ".stl", ".ply", ".vtp", ".vtk"}; // endings of files that do not tell
  return surface_options.space || std::none_of(silent.begin(), silent.end(), [this](const char* ending) {
           return boost::algorithm::iends_with(surface, ending);
         });
}

std::string surrounding_name(const Input_options& o)
{
  const std::string file = std::filesystem::path(o.surface).filename().string(),
                    name = file.substr(0, file.find('.'));
  return is_subdomain_name(name) ? name : "domain";
}

std::string sentence_on_no_subdomain(const std::vector<std::string>& names)
{
  constexpr std::size_t most = 20; // an atlas has hundreds
  std::string text = "there is no subdomain of that name, but ";
  for(std::size_t i = 0; i < (std::min)(most, names.size()); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  return text + (names.size() > most ? ", and " + std::to_string(names.size() - most) + " more" : "");
}
