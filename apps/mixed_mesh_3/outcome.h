// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results of the mesher for its report and its messages: plain data.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_OUTCOME_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_OUTCOME_H

#include "core/comparison.h"
#include "core/facts.h"

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_fit_result_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

using Table = CGAL::Mixed_meshes_3::Quality_table;

/// The aspect-ratio coefficients (ARC): the paper's Table 1, and a histogram.
struct Aspect_ratios
{
  Table up_to_7, from_1_3_to_7; // the interval that shares are of
  std::vector<std::size_t> histogram;
};

/// The ends of the bins of the histogram: the first bin has all values below 1.1, the last one all from 3 on.
inline std::vector<double> histogram_edges()
{
  std::vector<double> edges;
  for(int tenths = 11; tenths <= 30; ++tenths)
    edges.push_back(tenths / 10.);
  return edges;
}

/// The other measures.
struct Shapes
{
  Table scaled_jacobian, smallest_dihedral_angle, largest_dihedral_angle, quad_warp;
};

/// A property of a valid mesh, or of a faithful one, in words.
struct Check
{
  const char* name;
  bool holds;
};

/// A part of the mesh with a label of its own.
struct Subdomain_outcome
{
  std::string name;
  CGAL::Mixed_meshes_3::Subdomain_index index = 1;
  Surface_facts surface;
  std::string voxels; // voxels of an image, in words
  std::size_t elements = 0;
  double volume = 0;
  std::optional<double> volume_of_voxels;  // of a label
  std::optional<double> volume_of_surface; // or of voxels, without inner parts; none where surfaces cross
  double mean_arc = 0, largest_arc = 0;
};

/// The interface between two subdomains, or between a subdomain and the outside.
struct Interface_outcome
{
  std::string first, second;
  std::size_t faces = 0, vertices = 0, vertices_off = 0, bad_edges = 0, bad_vertices = 0;
  double area = 0;
  bool is_manifold = true, is_of_boundary = false;
};

/// A surface inside that need not enclose anything, and the faces of the mesh on it.
struct Sheet_outcome
{
  std::string name;
  Surface_facts surface;
  std::size_t faces = 0, vertices = 0, vertices_off = 0, bad_edges = 0;
  double largest_distance = 0;      // largest distance of a vertex from the sheet
  double area = 0, area_inside = 0; // area of the faces; of the sheet inside the domain
};

/// The boundary faces of a patch.
struct Patch_outcome
{
  std::string name, place;
  std::size_t faces = 0;
  double area = 0;
};

/// The part of the mesh that is written, if the user wants only some subdomains.
struct Extract_outcome
{
  std::vector<std::string> subdomains; // names
  Mesh_facts mesh;
  std::size_t nodes = 0, boundary_faces = 0, bad_edges = 0, bad_vertices = 0;
  double volume = 0;
  std::vector<Interface_outcome> interfaces; // those with what is left out are with the outside
};

/// A layer of an image.
struct Layer_outcome
{
  std::string name;
  std::optional<double> distance; // none: holes
  std::size_t voxels = 0;
  bool is_new = false;
};

/// The result of doubling the vertices of sheets.
struct Slit_outcome
{
  std::size_t faces = 0, faces_left = 0, vertices = 0;
};

struct Outcome
{
  Surface_facts surface;
  std::string voxels;                         // voxels of an image that are the domain, in words
  std::optional<Completion_facts> completion; // completion of the image's label
  std::vector<Layer_outcome> layers;
  std::vector<Difference> changes_by_smoothing; // of the labels of an image
  std::vector<Surface_facts> regions;
  std::vector<Subdomain_outcome> subdomains; // empty for a single subdomain
  std::vector<Interface_outcome> interfaces;
  bool has_lost_labels = false; // lost before there was a mesh
  std::vector<Sheet_outcome> sheets;
  std::vector<Patch_outcome> patches;
  std::optional<Slit_outcome> slit;
  std::optional<Extract_outcome> extract; // else the whole mesh is written
  CGAL::Mixed_mesh_result_3 result;
  CGAL::Mixed_mesh_fit_result_3 algorithm_1;
  bool is_stopped = false; // stopped by a signal or the limit of time
  Mesh_facts mesh;
  std::size_t nodes = 0; // in files: vertices, and middles of edges with order 2
  std::size_t elements_in_region = 0, boundary_faces = 0;
  std::optional<Aspect_ratios> before; // the boundary is fitted
  Aspect_ratios after;
  std::size_t elements_above_bound = 0; // above the bound of the options, proved
  Shapes shapes;
  Fidelity fidelity;
  Topology topology;
  std::vector<Check> checks;             // checks of validity: a mesh that fails is not written
  std::vector<Check> checks_of_fidelity; // whether the mesh represents this surface
  std::vector<std::string> warnings;
  double seconds = 0;
  std::size_t peak_bytes = 0;
};

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_OUTCOME_H
