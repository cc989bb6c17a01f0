// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The comparison of a mesh with its surface, and the verdict on it: the same for the program and for Python.

#ifndef MIXED_MESH_3_APPS_CORE_COMPARISON_H
#define MIXED_MESH_3_APPS_CORE_COMPARISON_H

#include "core/read_surface.h"
#include "core/types.h"

#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace CGAL::Mixed_meshes_3::internal {
class Triangle_tree;
struct Triangle_soup;
} // namespace CGAL::Mixed_meshes_3::internal

/// Largest relative difference of the volume of a body from its right volume.
constexpr double volume_tolerance = 0.05;
constexpr double on_surface = 1e-9; // share of the diagonal of the surface's box

constexpr double least_share_of_sharp_edges = 0.95; // of their length; the rest is cut off

/// The share of the length of sharp edges that edges of the mesh follow; 1 if there are none.
double share_of_sharp_edges(const CGAL::Mixed_mesh_result_3& result);

/// The distance of a surface, at its farthest point, from another one.
struct Distance
{
  double distance = 0, error = 0;
  std::array<double, 3> from{}, to{};
};

/// The distances of the boundary of the mesh and the surface.
struct Fidelity
{
  Distance from_mesh, from_surface;
  double volume_of_mesh = 0, volume_of_surface = 0;
  std::size_t vertices = 0;     // on the boundary
  std::size_t vertices_off = 0; // vertices that are not on the surface
  std::size_t self_intersections = 0;

  double distance() const { return (std::max)(from_mesh.distance, from_surface.distance); }
  double ratio_of_volumes() const { return volume_of_mesh / volume_of_surface; }
  bool has_right_volume() const { return std::abs(ratio_of_volumes() - 1) <= volume_tolerance; }
  // \param tolerance 0 if none was given
  bool misses(double tolerance) const { return tolerance > 0 && distance() > tolerance; }
};

/// The topology of a solid.
struct Solid
{
  std::size_t bodies = 0, handles = 0, cavities = 0;
  double volume = 0;
};

/// A difference between the solids, at a place.
struct Difference
{
  std::string sentence;
  std::array<double, 3> at;
};

/// The topology of the solid of the surface, and of that of the mesh.
struct Topology
{
  Solid surface, mesh;
  std::vector<Difference> differences;
  bool is_same = true;
};

/// The triangles of the boundary of a mesh.
using Boundary = CGAL::Mixed_meshes_3::internal::Triangle_soup;

/// The tree of the points of a surface that are closest to given ones.
using Surface_tree = std::shared_ptr<const CGAL::Mixed_meshes_3::internal::Triangle_tree>;

/// Measures the fidelity but for self-intersections. \pre the boundary is a closed manifold
/// \param boundary boundary of the mesh
/// \param tree tree of the surface; if null, it is built. The tree is released if no other owner is left
Fidelity fidelity_of(const Mesh& mesh, const Boundary& boundary, const Surface& surface,
                     double volume_of_surface, Surface_tree tree = nullptr);

/// Compares the topology, and the volumes of bodies and cavities if the boundary is fitted: before that, the
/// cells around it add some volume. \pre the boundary is a closed manifold
Topology topology_of(const Boundary& boundary, const Surface& surface, bool is_fitted,
                     CGAL::Mixed_mesh_status& status);

/// The status of a mesh that is compared with its surface: a tolerance may be missed between the points that
/// the library tested. \param tolerance 0 if none was given
CGAL::Mixed_mesh_status checked_status(CGAL::Mixed_mesh_status status, const Fidelity& fidelity,
                                       double tolerance);

/// Inputs and options as messages name them.
struct Input_names
{
  std::string surface;              // a file
  std::string budget, base_level;   // options, the first with its value
  std::string tolerance;            // the option that would help, or empty
  std::vector<std::string> regions; // files
  std::string quality_bound = {};   // the option, or empty if there is no bound
};

/// The reason why there is no mesh; empty if there is one.
std::string reason_for_no_mesh(const CGAL::Mixed_mesh_result_3& result, const Input_names& names);

/// The reason why a fitted mesh does not represent its surface: it has less than half the volume, or half
/// more. Empty if it may.
std::string reason_for_no_likeness(const Fidelity& fidelity, const Input_names& names);

/// A sentence on a volume that differs.
std::string sentence_on_volume(double ratio, const Input_names& names);

/// What is told if edges of the mesh do not follow the sharp edges; empty if they do, nearly.
std::string sentence_on_sharp_edges(const CGAL::Mixed_mesh_result_3& result, const Input_names& names);

/// A sentence on boundary vertices that are not on the surface, of which there are some.
std::string sentence_on_vertices_off(const Fidelity& fidelity, const Input_names& names);

/// A sentence on parts thinner than a cell, of which there are some.
std::string sentence_on_lost_parts(const CGAL::Mixed_mesh_result_3& result, const Input_names& names);

/// A sentence on a tolerance that is missed.
/// \param option the tolerance as the user gave it
std::string sentence_on_tolerance(const Fidelity& fidelity, const std::string& option,
                                  const Input_names& names);

#endif // MIXED_MESH_3_APPS_CORE_COMPARISON_H
