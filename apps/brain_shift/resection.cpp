// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/resection.h"

#include "core/Closed_surface_domain.h"
#include "core/messages.h"
#include "core/misfit.h"

#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/resect.h>

#include <algorithm>
#include <stdexcept>

namespace mm3 = CGAL::Mixed_meshes_3;

std::unique_ptr<const Closed_surface>
read_beside_mesh(const std::string& path, const mm3::IO::Read_anatomical_surface_options& options,
                 const Mesh& mesh, const std::string& mesh_file, Surface_facts& facts,
                 std::vector<std::string>& warnings)
{
  auto surface = std::make_unique<const Closed_surface>(path, options, facts, warnings);
  const mm3::Element_locator_3<Mesh> locator(mesh);
  const CGAL::Bbox_3 box = box_of(coordinates_of(mesh.points()));
  const std::string defect = misfit(surface->points(), box, [&locator](const std::array<double, 3>& p) {
    return locator.locate(Vector(p)).has_value();
  });
  if(defect.empty())
    return surface;
  const std::string text = path + ": beside " + mesh_file + ", it " + defect;
  if(!CGAL::do_overlap(box, box_of(surface->points())))
    throw std::runtime_error(text); // no element could be resected
  warnings.push_back(text);
  return surface;
}

namespace {

mm3::Resection_3 resect_subdomain(const Mesh& mesh, mm3::Subdomain_index index)
{
  std::vector<bool> is_asked;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
    is_asked.push_back(mesh.subdomain_index(e) == index);
  return mm3::resect(mesh, is_asked);
}

Resection_facts resection_facts(const mm3::Resection_3& r)
{
  Resection_facts facts;
  facts.status = mm3::description(r.status);
  facts.removed = std::size_t(std::count(r.is_removed.begin(), r.is_removed.end(), true));
  facts.asked = r.number_of_asked_elements;
  facts.restored = r.number_of_restored_elements;
  facts.floating = r.number_of_floating_elements;
  facts.pinch = r.number_of_pinch_elements;
  for(const mm3::Floating_piece_3& piece : r.floating)
    facts.floating_pieces.push_back({piece.elements.size(), piece.volume});
  facts.volume = r.volume;
  return facts;
}

} // namespace

std::vector<bool> resect(const Mesh& mesh, const Tumor& tumor, Outcome& outcome)
{
  const mm3::Resection_3 r = tumor.surface != nullptr ? mm3::resect(mesh, tumor.surface->domain())
                                                      : resect_subdomain(mesh, *tumor.subdomain);
  if(r.status != mm3::Resection_status::SUCCESS)
    throw std::runtime_error(tumor.name + ": " + mm3::description(r.status));
  if(!r.floating.empty())
    outcome.warnings.push_back(tumor.name + ": tissue outside comes loose, and is removed: "
                               + counted(r.floating.size(), "piece", "pieces"));
  // The numbers are expected for a surface: no face of the mesh lies on it.
  if(tumor.subdomain && r.number_of_restored_elements + r.number_of_pinch_elements != 0)
    outcome.warnings.push_back(
      tumor.name + ": what is left would touch itself at an edge or a vertex; so "
      + counted(r.number_of_restored_elements, "element stays", "elements stay") + ", and "
      + counted(r.number_of_pinch_elements, "other one is removed", "others are removed"));
  outcome.resection = resection_facts(r);
  return r.is_removed;
}

Remaining_mesh remaining_mesh(const Mesh& mesh, const std::vector<bool>& is_removed, Outcome& outcome)
{
  Remaining_mesh remaining;
  remaining.mesh = mm3::remaining_mesh(mesh, is_removed, &remaining.vertices);
  if(outcome.resection) {
    for(const auto& face : mm3::cavity_faces(mesh, is_removed))
      outcome.resection->area += mm3::area(mesh, face);
    outcome.resection->left = facts_of(remaining.mesh);
  }
  return remaining;
}
