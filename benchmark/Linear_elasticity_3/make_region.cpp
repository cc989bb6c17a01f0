// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The region of interest of an opening: the convex hull of the tumor's sphere and the opening's disk. Several
// openings give a surface of several parts.

#include "Opening.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/convex_hull_3.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Vector = Opening::Vector;

Point to_point(const Vector& p) { return Point(p[0], p[1], p[2]); }

/// Points on the sphere, evenly on a spiral, and on the circle around the disk.
std::vector<Point> points_of_region(const Opening& o)
{
  using namespace CGAL::Mixed_meshes_3;
  constexpr int on_sphere = 400, on_circle = 48;
  std::vector<Point> points;
  for(int i = 0; i < on_sphere; ++i) {
    const double z = (2 * i + 1.) / on_sphere - 1, r = std::sqrt(1 - z * z);
    const double angle = M_PI * (3 - std::sqrt(5.)) * i;
    points.push_back(
      to_point(o.tumor + o.tumor_radius * Vector{r * std::cos(angle), r * std::sin(angle), z}));
  }
  const Vector other = std::abs(o.axis[0]) < 0.5 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  const Vector u = cross(o.axis, other), v = cross(o.axis, u);
  const double scale = o.radius / norm(u);
  for(int i = 0; i < on_circle; ++i) {
    const double angle = 2 * M_PI * i / on_circle;
    points.push_back(to_point(o.center + (scale * std::cos(angle)) * u + (scale * std::sin(angle)) * v));
  }
  return points;
}

} // namespace

int main(int argc, char* argv[])
{
  if(argc < 4) {
    std::cerr << "Usage: make_region OPENINGS.json REGION.off NAME...\n";
    return EXIT_FAILURE;
  }
  try {
    const std::vector<Opening> openings = read_openings(argv[1]);
    CGAL::Surface_mesh<Point> region;
    for(int i = 3; i < argc; ++i) {
      const std::vector<Point> points = points_of_region(find_opening(openings, argv[i]));
      CGAL::Surface_mesh<Point> hull;
      CGAL::convex_hull_3(points.begin(), points.end(), hull);
      CGAL::copy_face_graph(hull, region);
    }
    std::ofstream out(argv[2]);
    out.precision(17);
    if(!CGAL::IO::write_OFF(out, region))
      throw std::runtime_error(std::string(argv[2]) + ": cannot be written");
  } catch(const std::exception& e) {
    std::cerr << "make_region: error: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
