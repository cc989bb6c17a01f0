// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed surface with fewer vertices, for meshers that keep the given triangles. Prints the CPU seconds as
// JSON.
//
//   coarsen_surface SURFACE.off COARSE.off VERTICES [--keep-normals]
//
// With --keep-normals, no edge is collapsed that turns a triangle over.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>

int main(int argc, char** argv)
{
  namespace SMS = CGAL::Surface_mesh_simplification;
  using Surface = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
  Surface surface;
  const bool keeps_normals = argc == 5 && argv[4] == std::string("--keep-normals");
  if(argc != 4 + int(keeps_normals) || !CGAL::IO::read_OFF(argv[1], surface)) {
    std::cerr << "usage: coarsen_surface SURFACE.off COARSE.off VERTICES [--keep-normals]\n";
    return EXIT_FAILURE;
  }
  const std::clock_t start = std::clock();
  // A closed surface of genus 0 has three edges for each vertex, minus six.
  const SMS::Count_stop_predicate<Surface> stop(3 * std::stoul(argv[3]));
  using Placement = SMS::LindstromTurk_placement<Surface>;
  if(keeps_normals)
    SMS::edge_collapse(surface, stop,
                       CGAL::parameters::get_placement(
                         SMS::Bounded_normal_change_placement<Placement>(Placement())));
  else
    SMS::edge_collapse(surface, stop);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  surface.collect_garbage();
  if(!CGAL::IO::write_OFF(argv[2], surface, CGAL::parameters::stream_precision(17)))
    return EXIT_FAILURE;
  std::cout << "{\"CPU seconds\": " << seconds << "}\n";
  return EXIT_SUCCESS;
}
