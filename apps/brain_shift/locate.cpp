// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/locate.h"

#include "core/messages.h"
#include "core/misfit.h"

#include <CGAL/Mixed_mesh_3/Element_locator_3.h>

#include <array>
#include <stdexcept>

std::vector<Vector> Controls::displacements() const
{
  std::vector<Vector> displacements;
  for(const Control_point& point : points)
    displacements.push_back(point.displacement);
  return displacements;
}

void refuse_outside(const Controls& controls, const Control_point& point, double distance)
{
  throw std::runtime_error(controls.options.file + ": " + point.place() + ": the control point is "
                           + rounded(distance) + " mm outside " + controls.mesh + "; --max-distance is "
                           + rounded(controls.options.max_distance) + " mm");
}

Locations locate(const Mesh& mesh, const Controls& controls, std::vector<std::string>& warnings)
{
  const Point_options& o = controls.options;
  const CGAL::Mixed_meshes_3::Element_locator_3<Mesh> locator(mesh);
  std::vector<std::array<double, 3>> positions;
  for(const Control_point& point : controls.points)
    positions.push_back(point.position);
  const std::string defect = misfit(positions, box_of(coordinates_of(mesh.points())),
                                    [&](const std::array<double, 3>& p) {
                                      return locator.nearest(Vector(p)).distance <= o.max_distance;
                                    });
  const std::string hint = defect.empty() ? "" : "beside " + controls.mesh + ", the list of points " + defect;
  if(!hint.empty())
    warnings.push_back(o.file + ": " + hint);
  Locations locations;
  for(const Control_point& point : controls.points) {
    locations.push_back(locator.nearest(point.position));
    if(locations.back().distance <= o.max_distance)
      continue;
    if(!hint.empty())
      throw std::runtime_error(o.file + ": " + hint);
    refuse_outside(controls, point, locations.back().distance);
  }
  return locations;
}
