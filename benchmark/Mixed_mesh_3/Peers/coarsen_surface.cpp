// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed surface with fewer vertices, for meshers that keep the given triangles. Prints the CPU seconds as
// JSON.
//
//   coarsen_surface SURFACE.off COARSE.off VERTICES

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
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
  if(argc != 4 || !CGAL::IO::read_OFF(argv[1], surface)) {
    std::cerr << "usage: coarsen_surface SURFACE.off COARSE.off VERTICES\n";
    return EXIT_FAILURE;
  }
  const std::clock_t start = std::clock();
  // A closed surface of genus 0 has three edges for each vertex, minus six.
  SMS::edge_collapse(surface, SMS::Count_stop_predicate<Surface>(3 * std::stoul(argv[3])));
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  surface.collect_garbage();
  if(!CGAL::IO::write_OFF(argv[2], surface, CGAL::parameters::stream_precision(17)))
    return EXIT_FAILURE;
  std::cout << "{\"CPU seconds\": " << seconds << "}\n";
  return EXIT_SUCCESS;
}
