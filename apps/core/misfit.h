// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inputs that should be at the same place, but are not in the same coordinates or unit.

#ifndef MIXED_MESH_3_APPS_CORE_MISFIT_H
#define MIXED_MESH_3_APPS_CORE_MISFIT_H

#include <CGAL/Bbox_3.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

/// Tests whether points that should be in a domain, at least in part, would fit much better with x and y
/// negated, or in a unit 1,000 times as large or small.
/// \param domain bounding box of the domain
/// \param contains whether a point is in the domain
/// \return the defect, without the names of the two; empty if there is no plain defect
std::string misfit(const std::vector<std::array<double, 3>>& points, const CGAL::Bbox_3& domain,
                   const std::function<bool(const std::array<double, 3>&)>& contains);

CGAL::Bbox_3 box_of(const std::vector<std::array<double, 3>>& points);

/// The triples of numbers in any objects that have `x()`, `y()` and `z()`.
template <class Range>
std::vector<std::array<double, 3>> coordinates_of(const Range& points)
{
  std::vector<std::array<double, 3>> result;
  for(const auto& p : points)
    result.push_back({p.x(), p.y(), p.z()});
  return result;
}

#endif // MIXED_MESH_3_APPS_CORE_MISFIT_H
