// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/misfit.h"

#include <algorithm>
#include <cstddef>

namespace {

using Point = std::array<double, 3>;

// The share of points inside, estimated by some hundred points, if there are more.
double share_inside(const std::vector<Point>& points, const Point& factors,
                    const std::function<bool(const Point&)>& contains)
{
  const std::size_t step = (points.size() + 299) / 300;
  std::size_t inside = 0, all = 0;
  for(std::size_t i = 0; i < points.size(); i += step, ++all) {
    const Point& p = points[i];
    inside += contains({factors[0] * p[0], factors[1] * p[1], factors[2] * p[2]});
  }
  return double(inside) / double(all);
}

double extent(const CGAL::Bbox_3& b) { return (std::max)({b.x_span(), b.y_span(), b.z_span()}); }

} // namespace

CGAL::Bbox_3 box_of(const std::vector<Point>& points)
{
  CGAL::Bbox_3 box;
  for(const Point& p : points)
    box += CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
  return box;
}

std::string misfit(const std::vector<Point>& points, const CGAL::Bbox_3& domain,
                   const std::function<bool(const Point&)>& contains)
{
  if(points.empty())
    return "";
  // A brain is 200 mm long: no meshed or measured part is shorter than 0.7 mm, and few parts are shorter than
  // 6 mm.
  constexpr double unit = 1000, least = 1. / 300, small = 1. / 30;
  const double ratio = extent(box_of(points)) / extent(domain);
  if(ratio > 0 && ratio < least && ratio * unit < 2
     && share_inside(points, {unit, unit, unit}, contains) > 0.5)
    return "is about 1,000 times smaller: is it in m, not in mm?";
  if(ratio > unit * small && ratio < 2 * unit
     && share_inside(points, {1 / unit, 1 / unit, 1 / unit}, contains) > 0.5)
    return "is about 1,000 times larger: is it in mm, not in m?";
  const double given = share_inside(points, {1, 1, 1}, contains);
  if(given < 0.5 && share_inside(points, {-1, -1, 1}, contains) > (std::max)(0.8, given + 0.4))
    return "would fit with x and y negated: is one of the two in LPS, the other in RAS?";
  return "";
}
