// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/subdomains.h"

#include "core/messages.h"

#include <CGAL/Mixed_mesh_3/IO/interface_sets.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;
using Domain = CGAL::Labeled_polyhedral_mixed_mesh_domain_3;

namespace {

constexpr double tolerated_change_of_volume = 0.05;

bool is_near(const Subdomain& s, const Subdomain& t)
{
  return CGAL::do_overlap(s.solid->bbox(), t.solid->bbox());
}

// Whether there are vertices of a surface inside another one, and vertices outside: those where the surfaces
// touch are neither.
std::pair<bool, bool> has_inside_and_outside(const Subdomain& of, const Subdomain& other)
{
  bool has_inside = false, has_outside = false;
  for(const auto& p : of.surface->points()) {
    const CGAL::Bounded_side side = other.solid->bounded_side(p);
    has_inside = has_inside || side == CGAL::ON_BOUNDED_SIDE;
    has_outside = has_outside || side == CGAL::ON_UNBOUNDED_SIDE;
    if(has_inside && has_outside)
      break;
  }
  return {has_inside, has_outside};
}

// Whether the volume is that of the surface, as far as that is known.
bool has_right_volume(const Subdomain_outcome& s)
{
  return s.elements > 0
         && (!s.volume_of_surface
             || std::abs(s.volume / *s.volume_of_surface - 1) <= tolerated_change_of_volume);
}

void warn_of(const Subdomain_outcome& s, bool is_in_mm, const std::string& budget,
             std::vector<std::string>& warnings)
{
  const std::string named = "the subdomain " + s.name;
  if(s.elements == 0)
    warnings.push_back(named + ", of volume "
                       + volume_with_unit(s.volume_of_surface.value_or(s.surface.volume), is_in_mm)
                       + ", is lost: too small for the cells; try more than " + budget);
  else if(!has_right_volume(s))
    warnings.push_back(named + " has a volume of " + volume_with_unit(s.volume, is_in_mm) + ", "
                       + percent(std::abs(s.volume / *s.volume_of_surface - 1))
                       + (s.volume < *s.volume_of_surface ? " less" : " more")
                       + (s.volume_of_voxels ? " than its voxels have" : " than its surface encloses")
                       + "; try more vertices");
}

void warn_of(const std::vector<Interface_outcome>& interfaces, std::vector<std::string>& warnings)
{
  constexpr std::size_t most = 10; // nearly all interfaces have such vertices with many labels
  const auto named = [](const Interface_outcome& i) {
    return "the interface between " + i.first + " and " + i.second;
  };
  std::vector<const Interface_outcome*> off; // inner ones; others have boundary vertices
  for(const Interface_outcome& i : interfaces) {
    if(!i.is_manifold)
      warnings.push_back(named(i) + " is no manifold: " + std::to_string(i.bad_edges) + " edges and "
                         + std::to_string(i.bad_vertices) + " vertices where it touches itself");
    if(!i.is_of_boundary && i.vertices_off > 0)
      off.push_back(&i);
  }
  std::stable_sort(off.begin(), off.end(), [](const Interface_outcome* a, const Interface_outcome* b) {
    return a->vertices_off > b->vertices_off;
  });
  for(std::size_t i = 0; i < (std::min)(most, off.size()); ++i)
    warnings.push_back(std::to_string(off[i]->vertices_off) + " of " + std::to_string(off[i]->vertices)
                       + " vertices of " + named(*off[i]) + " are not on its surface");
  if(off.size() > most)
    warnings.push_back(std::to_string(off.size() - most)
                       + " interfaces more have vertices that are not on their surfaces, see the report");
}

} // namespace

std::string name_of(const std::vector<Subdomain>& subdomains, mm3::Subdomain_index index)
{
  if(index == 0)
    return outside;
  return std::find_if(subdomains.begin(), subdomains.end(),
                      [&](const Subdomain& s) { return s.index == index; })
    ->name;
}

Domain make_domain(const std::vector<Subdomain>& subdomains)
{
  Domain domain;
  for(const Subdomain& s : subdomains)
    if(s.solid)
      domain.add(s.solid, s.index);
    else
      domain.add(*s.surface, s.index);
  return domain;
}

void build_solids(std::vector<Subdomain>& subdomains)
{
  if(subdomains.size() < 2)
    return; // the tree of a large surface is that of the domain only, which can be freed
  for(Subdomain& s : subdomains)
    if(!s.solid)
      s.solid = std::make_shared<const CGAL::Polyhedral_mixed_mesh_domain_3>(*s.surface);
}

void order_by_nesting(std::vector<Subdomain>& subdomains, std::vector<std::string>& warnings)
{
  const auto may_meet = [&](std::size_t i, std::size_t j) {
    return subdomains[i].index != 0 && subdomains[j].index != 0 && is_near(subdomains[i], subdomains[j]);
  };
  const auto is_inside = [&](std::size_t i, std::size_t j) {
    return may_meet(i, j) && has_inside_and_outside(subdomains[i], subdomains[j]) == std::pair(true, false);
  };
  for(std::size_t i = 0; i < subdomains.size(); ++i)
    for(std::size_t j = i + 1; j < subdomains.size(); ++j)
      if(is_inside(j, i)) { // all others stay in their order
        const auto to = std::ptrdiff_t(i), from = std::ptrdiff_t(j);
        std::rotate(subdomains.begin() + to, subdomains.begin() + from, subdomains.begin() + from + 1);
        j = i; // what is inside the new one comes before it
      }
  for(std::size_t i = 0; i < subdomains.size(); ++i)
    for(std::size_t j = i + 1; j < subdomains.size(); ++j) {
      if(!may_meet(i, j))
        continue;
      if(has_inside_and_outside(subdomains[i], subdomains[j]) == std::pair(true, true))
        warnings.push_back("the surfaces of " + subdomains[i].name + " and " + subdomains[j].name
                           + " cross: " + subdomains[i].name + " has what both have inside");
    }
}

void measure_visible_parts(std::vector<Subdomain>& subdomains)
{
  using CGAL::Polygon_mesh_processing::area;
  if(subdomains.size() < 2) { // nothing is asked of one surface, which may be large
    for(Subdomain& s : subdomains)
      s.visible_volume = s.volume;
    return;
  }
  std::vector<std::vector<std::size_t>> inside(subdomains.size()); // earlier ones inside each one
  for(std::size_t i = 0; i < subdomains.size(); ++i) {
    std::optional<double>& volume = subdomains[i].visible_volume = CGAL::Polygon_mesh_processing::volume(
      *subdomains[i].surface);
    subdomains[i].visible_area = area(*subdomains[i].surface);
    const bool are_labels = std::all_of(subdomains.begin(), subdomains.begin() + std::ptrdiff_t(i) + 1,
                                        [](const Subdomain& s) { return s.volume.has_value(); });
    if(are_labels) { // labels do not overlap
      volume = subdomains[i].volume;
      continue;
    }
    for(std::size_t j = i; j-- > 0;) {
      if(!is_near(subdomains[i], subdomains[j]))
        continue;
      const auto [has_inside, has_outside] = has_inside_and_outside(subdomains[j], subdomains[i]);
      if(has_inside_and_outside(subdomains[i], subdomains[j]).first || (has_inside && has_outside)) {
        volume = std::nullopt;
      } else if(has_inside) {
        volume = volume && subdomains[j].visible_volume ? *volume - *subdomains[j].visible_volume
                                                        : std::optional<double>();
        const auto has_j = [&](std::size_t k) {
          return std::find(inside[k].begin(), inside[k].end(), j) != inside[k].end();
        };
        if(std::none_of(inside[i].begin(), inside[i].end(), has_j))
          subdomains[i].visible_area += area(*subdomains[j].surface);
        inside[i].push_back(j);
      }
    }
  }
}

void examine_subdomains(const Mesh& mesh, const Domain& domain, const std::vector<Subdomain>& subdomains,
                        const Meshing_options& options, Outcome& outcome)
{
  if(outcome.has_lost_labels)
    outcome.result.status = mm3::worse_status(outcome.result.status, CGAL::Mixed_mesh_status::PARTS_LOST);
  if(subdomains.size() < 2 && options.label_choice == Label_choice::NONE)
    return; // nobody has named a part
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
  const auto number_lost = std::ptrdiff_t(outcome.subdomains.size());
  for(std::size_t i = 0; i < subdomains.size(); ++i) {
    if(subdomains[i].index == 0)
      continue;
    Subdomain_outcome s = found[subdomains[i].index];
    s.name = subdomains[i].name;
    s.index = subdomains[i].index;
    s.surface = subdomains[i].facts;
    s.voxels = subdomains[i].voxels;
    s.volume_of_surface = subdomains[i].visible_volume;
    s.volume_of_voxels = subdomains[i].volume;
    s.mean_arc = s.elements > 0 ? sums[s.index] / double(s.elements) : 0;
    warn_of(s, options.is_in_patient_space(), options.budget(), outcome.warnings);
    if(s.elements == 0)
      outcome.result.status = mm3::worse_status(outcome.result.status, CGAL::Mixed_mesh_status::PARTS_LOST);
    outcome.subdomains.push_back(std::move(s));
  }
  std::rotate(outcome.subdomains.begin(), outcome.subdomains.begin() + number_lost, outcome.subdomains.end());
  if(options.fit() != Fit::NONE)
    outcome.checks_of_fidelity.push_back(
      {"volume of each subdomain within 5 % of its surface's",
       std::all_of(outcome.subdomains.begin(), outcome.subdomains.end(), has_right_volume)});
  for(const mm3::Subdomain_interface& one : mm3::find_interfaces(mesh)) {
    const Interface_outcome i{name_of(subdomains, one.first),
                              name_of(subdomains, one.second),
                              one.faces.size(),
                              mm3::vertices_of(one.faces).size(),
                              options.fit() == Fit::NONE
                                ? 0
                                : mm3::number_of_vertices_off_interface(mesh, one, domain, on_surface),
                              one.bad_edges.size(),
                              one.bad_vertices.size(),
                              one.area,
                              one.is_manifold(),
                              one.second == 0};
    outcome.interfaces.push_back(i);
  }
  warn_of(outcome.interfaces, outcome.warnings);
}

std::vector<mm3::IO::Facet_set> interfaces_of(const Mesh& mesh, const std::vector<Subdomain>& subdomains)
{
  if(subdomains.size() < 2)
    return {};
  mm3::IO::Subdomain_names names;
  for(const Subdomain& s : subdomains)
    names.emplace(s.index, s.name);
  return mm3::IO::interface_sets(mesh, names);
}
