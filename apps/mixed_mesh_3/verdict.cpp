// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/verdict.h"

#include "core/messages.h"

#include <CGAL/Mixed_mesh_criteria_3.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

// The inputs and options as the user gave them.
Input_names names_of(const Meshing_options& o)
{
  std::vector<std::string> regions;
  for(const Region_option& r : o.regions)
    regions.push_back(r.file);
  const bool may_help = o.fit() == Fit::OPTIMIZATION && o.tolerance == 0;
  return {o.surface,      o.budget(),
          "--base-level", may_help ? "--tolerance" : "",
          regions,        o.has_quality_bound() ? "--max-arc" : ""};
}

// Whether a surface is full of gaps, like that of an atlas, and unlike that of an organ.
bool is_full_of_gaps(const Topology& topology, const Input_options& o)
{
  constexpr std::size_t many = 5;
  const Solid& s = topology.surface;
  return is_image(o.surface) && !o.completion.is_needed() && s.bodies + s.handles + s.cavities > many
         && !topology.differences.empty();
}

// Adds the largest differences: a surface may have thousands of specks.
void add_differences(const Topology& topology, const Input_options& o, std::vector<std::string>& warnings)
{
  const bool has_gaps = is_full_of_gaps(topology, o);
  if(has_gaps)
    warnings.insert(warnings.begin(), o.surface + ": its voxels have gaps ("
                                        + counted(topology.surface.bodies, "body", "bodies") + ", "
                                        + counted(topology.surface.handles, "handle", "handles") + ", "
                                        + counted(topology.surface.cavities, "cavity", "cavities")
                                        + "): --hull closes them, if the solid organ is wanted");
  const std::size_t most = has_gaps ? 0 : 8;
  const std::size_t n = topology.differences.size(), shown = (std::min)(n, most);
  for(std::size_t i = 0; i < shown; ++i)
    warnings.push_back(o.surface + ": " + topology.differences[i].sentence);
  if(n > shown)
    warnings.push_back(o.surface + ": " + counted(n - shown, "difference", "differences")
                       + (shown == 0 ? "" : " more") + " in topology or volume, see the report");
}

} // namespace

void refuse(const CGAL::Mixed_mesh_result_3& result, const Meshing_options& o)
{
  using Status = CGAL::Mixed_mesh_status;
  if(o.fewest_vertices && result.status > Status::BUDGET_NOT_FILLED && result.status != Status::STOPPED)
    throw std::runtime_error("--vertices auto: not even a mesh of " + std::to_string(result.vertex_budget)
                             + " vertices is within a tolerance of " + rounded(o.tolerance) + " of "
                             + o.surface + ": " + CGAL::Mixed_meshes_3::description(result.status)
                             + ", farthest " + rounded(result.optimization.largest_distance));
  const std::string reason = reason_for_no_mesh(result, names_of(o));
  if(result.status == Status::BOUNDARY_NOT_MANIFOLD)
    throw Invalid_mesh(reason);
  if(!reason.empty())
    throw std::runtime_error(reason);
}

void require_all(const std::vector<Check>& checks, std::size_t self_intersections)
{
  for(const Check& check : checks)
    if(!check.holds)
      throw Invalid_mesh(std::string("the mesh failed the check: ") + check.name
                         + (self_intersections != 0
                              ? ": " + std::to_string(self_intersections)
                                  + " pairs of faces; "
                                    "try more vertices, a larger --base-level, or --no-fit"
                              : ""));
}

void require_volume(const Meshing_options& o, const Outcome& outcome)
{
  if(o.fit() == Fit::NONE || outcome.is_stopped)
    return;
  const std::string reason = reason_for_no_likeness(outcome.fidelity, names_of(o));
  if(!reason.empty())
    throw std::runtime_error(reason);
}

void add_warnings(const Meshing_options& o, Outcome& outcome)
{
  std::vector<std::string>& warnings = outcome.warnings;
  const Fidelity& f = outcome.fidelity;
  const bool has_nodes = o.nodes > 0;
  const std::size_t used = has_nodes ? outcome.nodes : outcome.mesh.vertices,
                    budget = has_nodes ? o.nodes : o.vertices;
  const bool is_not_filled = outcome.result.status == CGAL::Mixed_mesh_status::BUDGET_NOT_FILLED;
  if((double(used) < CGAL::Mixed_mesh_criteria_3::full_share * double(budget)
      && !outcome.result.is_lattice_on_surface)
     || is_not_filled) {
    std::string reason = o.regions.empty() ? "the mesh" : "the region";
    reason += " cannot be refined further, or each further cell tried would exceed the budget";
    if(has_nodes && !is_not_filled)
      reason = "the other meshes tried have fewer, or too many";
    warnings.push_back("only " + std::to_string(used) + " of " + std::to_string(budget)
                       + (has_nodes ? " nodes" : " vertices") + " used: " + reason);
  }
  if(outcome.result.number_of_lost_cells != 0)
    warnings.push_back(sentence_on_lost_parts(outcome.result, names_of(o))
                       + (outcome.surface.components > 1 ? ", or --drop-below, if they are specks" : ""));
  if(o.fit() != Fit::NONE && f.vertices_off != 0)
    warnings.push_back(sentence_on_vertices_off(f, names_of(o)));
  if(outcome.elements_above_bound != 0)
    warnings.push_back("--max-arc " + rounded(o.largest_arc) + ": "
                       + counted(outcome.elements_above_bound, "element is", "elements are") + " above it"
                       + (outcome.result.quality_bound > o.largest_arc
                            ? ", none above " + rounded(outcome.result.quality_bound)
                                + ": thin walls have room for flatter elements only"
                            : ""));
  if(const std::string cut_off = sentence_on_sharp_edges(outcome.result, names_of(o));
     o.fit() != Fit::NONE && !cut_off.empty())
    warnings.push_back(cut_off);
  if(const double tolerance = outcome.result.tolerance; o.fit() == Fit::OPTIMIZATION && f.misses(tolerance))
    warnings.push_back(
      sentence_on_tolerance(f, (o.tolerance > 0 ? "--tolerance " : "default tolerance ") + rounded(tolerance),
                            names_of(o)));
  // The cells around the boundary add some volume before it is fitted; corners cut off take some.
  const bool is_fitted = o.fit() != Fit::NONE;
  const double ratio = f.ratio_of_volumes();
  if(is_fitted ? !f.has_right_volume() : ratio < 0.9 || ratio > 4)
    warnings.push_back(sentence_on_volume(ratio, names_of(o)));
  add_differences(outcome.topology, o, warnings);
}
