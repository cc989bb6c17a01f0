// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facts of surfaces and meshes for the reports of both programs: plain data, without CGAL.

#ifndef MIXED_MESH_3_APPS_CORE_FACTS_H
#define MIXED_MESH_3_APPS_CORE_FACTS_H

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

struct Surface_facts
{
  std::string file;
  std::size_t points = 0, polygons = 0; // numbers in the file
  std::size_t vertices = 0, triangles = 0, components = 0;
  double volume = 0;
  std::vector<std::string> repairs = {}; // lines
};

/// The result of the completion of a label, in voxels.
struct Completion_facts
{
  double closing_radius = 0; // in mm
  std::size_t voxels = 0, closed = 0, filled = 0, removed = 0, components_removed = 0;
};

struct Mesh_facts
{
  std::size_t vertices = 0, elements = 0;
  std::array<std::size_t, CGAL::Mixed_meshes_3::number_of_element_kinds> elements_of_kind{};
};

template <class Mesh>
Mesh_facts facts_of(const Mesh& mesh)
{
  return {mesh.number_of_vertices(), mesh.number_of_elements(), mesh.elements().counts()};
}

#endif // MIXED_MESH_3_APPS_CORE_FACTS_H
