// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/subdomains.h"

#include "brain_shift/read_control_points.h"
#include "core/messages.h"

#include <CGAL/Mixed_mesh_3/quality.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// A list of the subdomains of the mesh for a message on a missing label; segmentations may have many.
std::string list(const std::vector<Subdomain_facts>& subdomains)
{
  constexpr std::size_t many = 10;
  std::string text;
  for(std::size_t i = 0; i < (std::min)(many, subdomains.size()); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(subdomains[i].index)
            + (subdomains[i].name.empty() ? "" : " (" + subdomains[i].name + ")");
  return text + (subdomains.size() > many ? ", ..." : "");
}

} // namespace

std::vector<Subdomain_facts> find_subdomains(const Mesh& mesh, const std::string& mesh_file,
                                             const mm3::IO::Subdomain_names& names,
                                             const mm3::Elastic_material& material,
                                             const std::vector<Labeled_material>& materials)
{
  std::map<mm3::Subdomain_index, Subdomain_facts> of_index;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    Subdomain_facts& facts = of_index[mesh.subdomain_index(e)];
    ++facts.elements;
    facts.volume += mm3::volume(mesh, e);
  }
  std::vector<Subdomain_facts> subdomains;
  for(auto& [index, facts] : of_index) {
    facts.index = index;
    if(const auto named = names.find(index); named != names.end())
      facts.name = named->second;
    facts.material = material;
    subdomains.push_back(facts);
  }
  std::set<mm3::Subdomain_index> given;
  for(const auto& [label, own] : materials) {
    const mm3::Subdomain_index index = find_subdomain(subdomains, label, mesh_file).index;
    if(!given.insert(index).second)
      throw std::runtime_error("--material: the subdomain " + control_points::quoted(label)
                               + " is given two materials");
    const auto has_index = [index](const Subdomain_facts& facts) { return facts.index == index; };
    std::find_if(subdomains.begin(), subdomains.end(), has_index)->material = own;
  }
  return subdomains;
}

const Subdomain_facts& find_subdomain(const std::vector<Subdomain_facts>& subdomains,
                                      const std::string& label, const std::string& mesh_file)
{
  const auto has_label = [&label](const Subdomain_facts& s) { // no name begins with a digit
    return std::to_string(s.index) == label || (!s.name.empty() && s.name == label);
  };
  const auto place = std::find_if(subdomains.begin(), subdomains.end(), has_label);
  if(place == subdomains.end())
    throw std::runtime_error(mesh_file + ": has no subdomain " + control_points::quoted(label) + ", but "
                             + list(subdomains));
  return *place;
}

std::vector<mm3::Elastic_material> materials_of_elements(const Mesh& mesh,
                                                         const std::vector<Subdomain_facts>& subdomains)
{
  std::map<mm3::Subdomain_index, mm3::Elastic_material> materials;
  for(const Subdomain_facts& facts : subdomains)
    materials.emplace(facts.index, facts.material);
  return mm3::materials_of_elements(mesh, materials);
}
