// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/subdomains.h"

#include "common/messages.h"

#include <CGAL/Mixed_mesh_3/interfaces.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;
using Domain = CGAL::Labeled_polyhedral_mixed_mesh_domain_3;

namespace {

constexpr double tolerated_change_of_volume = 0.05;

std::string name_of(const std::vector<Subdomain>& subdomains, mm3::Subdomain_index index)
{
  if(index == 0)
    return "outside";
  return std::find_if(subdomains.begin(), subdomains.end(),
                      [&](const Subdomain& s) { return s.index == index; })
    ->name;
}

// How many vertices of a surface are inside another one.
std::size_t number_inside(const Surface& surface, const Domain& around)
{
  return std::size_t(std::count_if(surface.points().begin(), surface.points().end(),
                                   [&](const auto& p) { return around.subdomain_index(p) != 0; }));
}

// Volumes without what earlier ones take. None where surfaces cross.
std::vector<std::optional<double>> expected_volumes(const std::vector<Subdomain>& subdomains)
{
  std::vector<std::optional<double>> volumes;
  for(std::size_t i = 0; i < subdomains.size(); ++i) {
    volumes.emplace_back(subdomains[i].facts.volume);
    Domain mine;
    mine.add(*subdomains[i].surface, 1);
    for(std::size_t j = 0; j < i && volumes[i]; ++j) {
      Domain earlier;
      earlier.add(*subdomains[j].surface, 1);
      const std::size_t inside = number_inside(*subdomains[j].surface, mine),
                        around = number_inside(*subdomains[i].surface, earlier);
      if(around > 0 || (inside > 0 && inside < subdomains[j].surface->number_of_vertices()))
        volumes[i] = std::nullopt;
      else if(inside > 0 && volumes[j])
        *volumes[i] -= *volumes[j];
      else if(inside > 0)
        volumes[i] = std::nullopt;
    }
  }
  return volumes;
}

std::string percent(double share) { return rounded(std::round(1000 * share) / 10) + " %"; }

void warn_of(const Subdomain_outcome& s, const Options& o, std::vector<std::string>& warnings)
{
  const std::string named = "the subdomain " + s.name;
  if(s.elements == 0)
    warnings.push_back(named + ", of volume " + rounded(s.volume_of_surface.value_or(s.surface.volume))
                       + ", is lost: too small for the cells; try more vertices than "
                       + std::to_string(o.vertices));
  else if(s.volume_of_surface && std::abs(s.volume / *s.volume_of_surface - 1) > tolerated_change_of_volume)
    warnings.push_back(named + " has a volume of " + rounded(s.volume) + ", "
                       + percent(std::abs(s.volume / *s.volume_of_surface - 1))
                       + (s.volume < *s.volume_of_surface ? " less" : " more")
                       + " than its surface encloses; try more vertices");
}

void warn_of(const Interface_outcome& i, std::vector<std::string>& warnings)
{
  const std::string named = "the interface between " + i.first + " and " + i.second;
  if(!i.is_manifold)
    warnings.push_back(named + " is no manifold: " + std::to_string(i.bad_edges) + " edges and "
                       + std::to_string(i.bad_vertices) + " vertices where it touches itself");
  if(i.vertices_off > 0)
    warnings.push_back(std::to_string(i.vertices_off) + " of " + std::to_string(i.vertices) + " vertices of "
                       + named + " are not on its surface");
}

} // namespace

Domain make_domain(const std::vector<Subdomain>& subdomains)
{
  Domain domain;
  for(const Subdomain& s : subdomains)
    domain.add(*s.surface, s.index);
  return domain;
}

Surface boundary_of(const std::vector<Subdomain>& subdomains)
{
  Surface boundary = *subdomains.back().surface;
  for(const Subdomain& s : subdomains)
    if(s.index == 0)
      CGAL::copy_face_graph(*s.surface, boundary);
  return boundary;
}

void examine_subdomains(const Mesh& mesh, const Domain& domain, const std::vector<Subdomain>& subdomains,
                        const Options& options, Outcome& outcome)
{
  if(subdomains.size() < 2)
    return;
  std::map<mm3::Subdomain_index, Subdomain_outcome> found;
  std::map<mm3::Subdomain_index, double> sums;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    Subdomain_outcome& s = found[mesh.subdomain_index(e)];
    const double arc = mm3::aspect_ratio_coefficient(mesh, e);
    ++s.elements;
    s.volume += mm3::volume(mesh, e);
    s.largest_arc = (std::max)(s.largest_arc, arc);
    sums[mesh.subdomain_index(e)] += arc;
  }
  const std::vector<std::optional<double>> expected = expected_volumes(subdomains);
  for(std::size_t i = 0; i < subdomains.size(); ++i) {
    if(subdomains[i].index == 0)
      continue;
    Subdomain_outcome s = found[subdomains[i].index];
    s.name = subdomains[i].name;
    s.index = subdomains[i].index;
    s.surface = subdomains[i].facts;
    s.volume_of_surface = expected[i];
    s.mean_arc = s.elements > 0 ? sums[s.index] / double(s.elements) : 0;
    warn_of(s, options, outcome.warnings);
    if(s.elements == 0)
      outcome.result.status = worse(outcome.result.status, CGAL::Mixed_mesh_status::PARTS_LOST);
    outcome.subdomains.push_back(std::move(s));
  }
  for(const mm3::Subdomain_interface& one : mm3::find_interfaces(mesh)) {
    const Interface_outcome i{name_of(subdomains, one.first),
                              name_of(subdomains, one.second),
                              one.faces.size(),
                              mm3::vertices_of(one.faces).size(),
                              options.fit() == Fit::NONE
                                ? 0
                                : mm3::number_of_vertices_off_interface(mesh, one, domain, on_surface),
                              one.number_of_bad_edges,
                              one.number_of_bad_vertices,
                              one.area,
                              one.is_manifold()};
    if(one.second != 0 || !i.is_manifold)
      warn_of(i, outcome.warnings);
    outcome.interfaces.push_back(i);
  }
}

std::vector<mm3::IO::Facet_set> interfaces_of(const Mesh& mesh, const std::vector<Subdomain>& subdomains)
{
  std::vector<mm3::IO::Facet_set> sets;
  if(subdomains.size() < 2)
    return sets;
  for(mm3::Subdomain_interface& one : mm3::find_interfaces(mesh)) {
    const std::string first = name_of(subdomains, one.first), second = name_of(subdomains, one.second);
    sets.push_back(
      {one.second == 0 ? "outside_" + first : "interface_" + first + "_" + second, std::move(one.faces)});
  }
  return sets;
}
