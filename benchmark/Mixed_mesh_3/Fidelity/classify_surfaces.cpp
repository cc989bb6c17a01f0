// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Classifies the defect of each file of a surface, by CGAL alone: a line "FILE<tab>KIND" each. KIND is clean,
// flat, self-intersecting, open, not manifold, or unreadable.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/IO/polygon_soup_io.h>

#include <cstddef>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Points = std::vector<Kernel::Point_3>;
using Polygons = std::vector<std::vector<std::size_t>>;

namespace {

bool is_closed_manifold(Points points, Polygons polygons, Surface& surface)
{
  PMP::remove_isolated_points_in_polygon_soup(points, polygons);
  if(!PMP::orient_polygon_soup(points, polygons) || !PMP::is_polygon_soup_a_polygon_mesh(polygons))
    return false;
  surface.clear();
  PMP::polygon_soup_to_polygon_mesh(points, polygons, surface);
  return CGAL::is_closed(surface);
}

std::string kind_of(const std::string& file)
{
  Points points;
  Polygons polygons;
  if(!CGAL::IO::read_polygon_soup(file, points, polygons, CGAL::parameters::verbose(false))
     || polygons.empty())
    return "unreadable";
  Surface surface;
  if(!is_closed_manifold(points, polygons, surface)) { // STL has points once for each triangle
    PMP::merge_duplicate_points_in_polygon_soup(points, polygons);
    if(!is_closed_manifold(points, polygons, surface))
      return surface.number_of_faces() != 0 ? "open" : "not manifold";
  }
  PMP::triangulate_faces(surface);
  if(PMP::does_self_intersect(surface))
    return "self-intersecting";
  return PMP::volume(surface) == 0 ? "flat" : "clean";
}

} // namespace

int main(int argc, char** argv)
{
  for(int i = 1; i < argc; ++i) {
    std::string kind = "unreadable";
    try {
      kind = kind_of(argv[i]);
    } catch(const std::exception&) {
    }
    std::cout << argv[i] << '\t' << kind << std::endl;
  }
}
