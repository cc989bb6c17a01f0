// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/sheets.h"

#include "core/messages.h"
#include "core/read_surface.h"
#include "mixed_mesh_3/verdict.h"

#include <CGAL/Mixed_mesh_3/sheets.h>
#include <CGAL/Mixed_mesh_3/split_along_faces.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <cstddef>
#include <map>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;
using Domain = CGAL::Labeled_polyhedral_mixed_mesh_domain_3;

namespace {

void warn_of(const Sheet_outcome& s, const Meshing_options& o, std::vector<std::string>& warnings)
{
  const std::string named = "the sheet " + s.name;
  if(s.faces == 0)
    warnings.push_back(named + " has no faces in the mesh: "
                       + (s.area_inside > 0 ? "it is too small for the cells; try more than " + o.budget()
                                            : "it is not inside " + o.surface));
  if(s.bad_edges > 0)
    warnings.push_back(named + " touches itself at " + std::to_string(s.bad_edges) + " edges");
  if(o.fit() != Fit::NONE && s.vertices_off > 0)
    warnings.push_back(std::to_string(s.vertices_off) + " of " + std::to_string(s.vertices) + " vertices of "
                       + named + " are not on its surface, but up to " + rounded(s.largest_distance)
                       + " away");
}

// Slits the mesh along the faces of sets, which become the faces of both sides.
void slit_along(std::vector<mm3::IO::Facet_set>& sets, Mesh& mesh, Outcome& outcome)
{
  std::vector<mm3::Face> faces;
  for(const mm3::IO::Facet_set& set : sets)
    faces.insert(faces.end(), set.faces.begin(), set.faces.end());
  const mm3::Slit slit = mm3::split_along_faces(mesh, faces);
  const mm3::Mesh_defects d = mm3::find_defects(mesh);
  if(!d.conforming() || !d.positive())
    throw Invalid_mesh("the mesh failed a check after --slit");
  if(!d.closed_manifold_boundary())
    outcome.warnings.push_back("--slit: the boundary is no manifold, at "
                               + std::to_string(d.nonmanifold_boundary_edges) + " edges and "
                               + std::to_string(d.nonmanifold_boundary_vertices) + " vertices");
  outcome.slit = Slit_outcome{slit.faces.size(), slit.number_of_faces_left, slit.origins.size()};
  outcome.mesh = facts_of(mesh);

  const std::map<mm3::Face, mm3::Face> opposite_of(slit.faces.begin(), slit.faces.end());
  std::vector<mm3::IO::Facet_set> of_sides;
  for(const mm3::IO::Facet_set& set : sets) {
    mm3::IO::Facet_set front{set.name + "_front", {}}, behind{set.name + "_behind", {}};
    for(const mm3::Face& face : set.faces)
      if(const auto found = opposite_of.find(face); found != opposite_of.end()) {
        front.faces.push_back(found->first);
        behind.faces.push_back(found->second);
      }
    of_sides.push_back(std::move(front));
    of_sides.push_back(std::move(behind));
  }
  sets = std::move(of_sides);
}

} // namespace

std::vector<Sheet> add_sheets(const Input_options& options, Domain& domain,
                              std::vector<std::string>& warnings)
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
                                               const std::vector<Sheet>& sheets,
                                               const Meshing_options& options, Outcome& outcome)
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
      outcome.result.status = mm3::worse_status(outcome.result.status, CGAL::Mixed_mesh_status::PARTS_LOST);
    sets.push_back({sheets[i].name, std::move(s.faces)});
  }
  if(options.slit)
    slit_along(sets, mesh, outcome);
  return sets;
}
