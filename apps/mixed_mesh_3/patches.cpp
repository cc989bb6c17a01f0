// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/patches.h"

#include "core/Closed_surface.h"
#include "core/patch_shapes.h"

#include <CGAL/Mixed_mesh_3/IO/interface_sets.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// Names of sets in the files, other than those of patches.
std::vector<std::string> names_in_files(const std::vector<Subdomain_option>& sheets,
                                        const std::vector<Subdomain>& subdomains)
{
  std::vector<std::string> names;
  for(const Subdomain_option& sheet : sheets)
    for(const char* side : {"", "_front", "_behind"})
      names.push_back(sheet.name + side);
  for(std::size_t i = 0; subdomains.size() > 1 && i < subdomains.size(); ++i) {
    names.push_back(subdomains[i].name);
    names.push_back(mm3::IO::interface_set_name(subdomains[i].name));
    for(const Subdomain& other : subdomains)
      names.push_back(mm3::IO::interface_set_name(subdomains[i].name, other.name));
  }
  return names;
}

// Checks that no face is certain to be in two sets, where a file has one set for each face. Other patches may
// have faces in common as well, which the writer finds.
void check_overlaps(const Output_options& o, const std::vector<Subdomain>& subdomains)
{
  const auto is_exclusive = [&o](const std::string& path) {
    const auto format = mm3::IO::format_of(path);
    return format
           && !mm3::IO::has_overlapping_facet_sets(
             o.msh2 && *format == mm3::IO::Format::MSH_4_1 ? mm3::IO::Format::MSH_2_2 : *format);
  };
  const auto file = std::find_if(o.outputs.begin(), o.outputs.end(), is_exclusive);
  if(file == o.outputs.end() || o.patches.empty())
    return;
  const std::string reason = *file + ": two facet sets share a face, which this format cannot hold: ";
  if(subdomains.size() > 1)
    throw std::runtime_error(reason + o.patches.front().text() + ", and that of a subdomain");
  for(auto p = o.patches.begin(); p != o.patches.end(); ++p)
    for(auto other = o.patches.begin(); other != p; ++other)
      if(other->place == p->place)
        throw std::runtime_error(reason + other->text() + ", and " + p->text());
}

} // namespace

std::vector<Patch> read_patches(const Input_options& inputs, const Output_options& o,
                                const std::vector<Subdomain>& subdomains, std::vector<std::string>& warnings)
{
  check_overlaps(o, subdomains);
  const std::vector<std::string> names = names_in_files(inputs.sheets, subdomains);
  std::vector<Patch> patches;
  for(const Patch_option& p : o.patches) {
    if(std::any_of(names.begin(), names.end(),
                   [&p](const std::string& name) { return boost::iequals(name, p.name); }))
      throw std::runtime_error(p.text() + ": the name is that of another set of the files");
    if(auto shape = patch_shape(p.place)) {
      patches.push_back({p, std::move(shape->contains)});
      continue;
    }
    Surface_facts facts;
    const auto surface = std::make_shared<const Closed_surface>(p.place, inputs.surface_options, facts,
                                                                warnings);
    patches.push_back(
      {p, [surface](const std::array<double, 3>& point, double) { return surface->contains(point); }});
  }
  return patches;
}

std::vector<mm3::IO::Facet_set> examine_patches(const Mesh& mesh, const std::vector<Patch>& patches,
                                                Outcome& outcome)
{
  std::vector<mm3::IO::Facet_set> sets;
  if(patches.empty())
    return sets;
  const std::vector<mm3::Face> boundary = mm3::boundary_faces(mesh);
  for(const Patch& patch : patches) {
    sets.push_back({patch.option.name, {}});
    double area = 0;
    for(std::size_t i : faces_in_patch(mesh, boundary, patch.contains)) {
      sets.back().faces.push_back(boundary[i]);
      area += mm3::area(mesh, boundary[i]);
    }
    if(sets.back().faces.empty())
      throw std::runtime_error(patch.option.text() + ": " + sentence_on_empty_patch(mesh));
    outcome.patches.push_back({patch.option.name, patch.option.place, sets.back().faces.size(), area});
  }
  return sets;
}
