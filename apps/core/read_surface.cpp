// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/read_surface.h"

#include "core/messages.h"
#include "core/resources.h"

#include <CGAL/Mixed_mesh_image_3/IO/read_anatomical_surface.h>

namespace IO = CGAL::Mixed_meshes_3::IO;

namespace {

// Reads with `read(surface, error, input)`, which is one of the library's functions.
template <class Read>
Surface read_with(const Read& read, const std::string& path,
                  const IO::Read_anatomical_surface_options& options, Surface_facts& facts,
                  std::vector<std::string>& warnings)
{
  Surface surface;
  IO::Surface_input input;
  require([&](std::string* error) {
    const bool is_read = read(surface, error, &input);
    const bool weld = input.weld_distance > 0, wrap = input.wrap_diameter > 0 && !options.is_strict;
    if(weld || wrap)
      *error += "; " + (weld ? "--weld " + rounded(input.weld_distance) : "") + (weld && wrap ? " or " : "")
                + (wrap ? "--wrap " + rounded(input.wrap_diameter) : "") + " would close it";
    return is_read;
  });
  for(const std::string& warning : input.warnings)
    warnings.push_back(path + ": " + warning);
  facts = {path,
           input.number_of_points,
           input.number_of_polygons,
           surface.number_of_vertices(),
           surface.number_of_faces(),
           input.number_of_components,
           input.volume,
           input.repairs};
  return surface;
}

} // namespace

Surface read_surface(const std::string& path, const IO::Read_anatomical_surface_options& options,
                     Surface_facts& facts, std::vector<std::string>& warnings)
{
  const auto read = [&](Surface& surface, std::string* error, IO::Surface_input* input) {
    return IO::read_anatomical_surface(path, options, surface, error, input);
  };
  return read_with(read, path, options, facts, warnings);
}

Surface read_sheet(const std::string& path, const IO::Read_anatomical_surface_options& options,
                   Surface_facts& facts, std::vector<std::string>& warnings)
{
  const auto read = [&](Surface& surface, std::string* error, IO::Surface_input* input) {
    return IO::read_anatomical_sheet(path, options, surface, error, input);
  };
  return read_with(read, path, options, facts, warnings);
}
