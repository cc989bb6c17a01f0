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

void refuse_outside(const Options& o, const std::string& file, const Control_point& point, double distance)
{
  throw std::runtime_error(file + ": " + point.place() + ": the control point is " + rounded(distance)
                           + " mm outside " + o.mesh + "; --max-distance is " + rounded(o.max_distance)
                           + " mm");
}

Locations locate(const Mesh& mesh, const Options& o, const std::string& file,
                 const std::vector<Control_point>& points, std::vector<std::string>& warnings)
{
  const CGAL::Mixed_meshes_3::Element_locator_3<Mesh> locator(mesh);
  std::vector<std::array<double, 3>> positions;
  for(const Control_point& point : points)
    positions.push_back(point.position);
  const std::string defect = misfit(positions, box_of(coordinates_of(mesh.points())),
                                    [&](const std::array<double, 3>& p) {
                                      return locator.nearest(Vector(p)).distance <= o.max_distance;
                                    });
  const std::string hint = defect.empty() ? "" : "beside " + o.mesh + ", the list of points " + defect;
  if(!hint.empty())
    warnings.push_back(file + ": " + hint);
  Locations locations;
  for(const Control_point& point : points) {
    locations.push_back(locator.nearest(point.position));
    if(locations.back().distance <= o.max_distance)
      continue;
    if(!hint.empty())
      throw std::runtime_error(file + ": " + hint);
    refuse_outside(o, file, point, locations.back().distance);
  }
  return locations;
}
