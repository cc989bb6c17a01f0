// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/sheets.h"

#include "common/messages.h"
#include "common/read_surface.h"

#include <CGAL/Mixed_mesh_3/sheets.h>

#include <cstddef>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;
using Domain = CGAL::Labeled_polyhedral_mixed_mesh_domain_3;

namespace {

void warn_of(const Sheet_outcome& s, const Options& o, std::vector<std::string>& warnings)
{
  const std::string named = "the sheet " + s.name;
  if(s.faces == 0)
    warnings.push_back(named + " has no faces in the mesh: "
                       + (s.area_inside > 0 ? "it is too small for the cells; try more vertices than "
                                                + std::to_string(o.vertices)
                                            : "it is not inside " + o.surface));
  if(s.bad_edges > 0)
    warnings.push_back(named + " touches itself at " + std::to_string(s.bad_edges) + " edges");
  if(o.fit() != Fit::NONE && s.vertices_off > 0)
    warnings.push_back(std::to_string(s.vertices_off) + " of " + std::to_string(s.vertices) + " vertices of "
                       + named + " are not on its surface, but up to " + rounded(s.largest_distance)
                       + " away");
}

} // namespace

std::vector<Sheet> add_sheets(const Options& options, Domain& domain, std::vector<std::string>& warnings)
{
  std::vector<Sheet> sheets;
  for(const Subdomain_option& s : options.sheets) {
    Surface_facts facts;
    const Surface surface = read_sheet(s.file, options.surface_options, facts, warnings);
    sheets.push_back({s.name, std::make_shared<const CGAL::Mixed_mesh_sheet_3>(surface), facts});
    domain.add_sheet(sheets.back().surface);
  }
  return sheets;
}

std::vector<mm3::IO::Facet_set> examine_sheets(Mesh& mesh, const Domain& domain,
                                               const std::vector<Sheet>& sheets, const Options& options,
                                               Outcome& outcome)
{
  std::vector<mm3::IO::Facet_set> sets;
  std::vector<mm3::Sheet_in_mesh> found = mm3::find_sheets(mesh, domain, on_surface);
  for(std::size_t i = 0; i < sheets.size(); ++i) {
    mm3::Sheet_in_mesh& s = found[i];
    outcome.sheets.push_back({sheets[i].name, sheets[i].facts, s.faces.size(), s.number_of_vertices,
                              s.number_of_vertices_off, s.number_of_bad_edges, s.largest_distance, s.area,
                              mm3::area_inside(*sheets[i].surface, domain)});
    warn_of(outcome.sheets.back(), options, outcome.warnings);
    if(s.faces.empty())
      outcome.result.status = worse(outcome.result.status, CGAL::Mixed_mesh_status::PARTS_LOST);
    sets.push_back({sheets[i].name, std::move(s.faces)});
  }
  return sets;
}
