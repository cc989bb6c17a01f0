// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results of the program for its report and its messages: plain data.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_OUTCOME_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_OUTCOME_H

#include "brain_shift/read_control_points.h"
#include "core/facts.h"

#include <CGAL/Linear_elasticity_3/Mixed_mesh_adaptation_result_3.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Index.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using Vector = CGAL::Mixed_meshes_3::Vec3;

/// Locations of control points in the mesh.
using Locations = std::vector<CGAL::Mixed_meshes_3::Element_location_3>;

struct Subdomain_facts
{
  CGAL::Mixed_meshes_3::Subdomain_index index = 0;
  std::string name; // empty: the file has none
  std::size_t elements = 0;
  double volume = 0;
  CGAL::Mixed_meshes_3::Elastic_material material;
};

/// A label of an image, most of whose voxels are resected.
struct Rim_facts
{
  double label = 0;
  std::size_t resected = 0, left = 0; // voxels
};

struct Image_facts
{
  std::array<std::size_t, 3> voxels{};
  double volume_of_voxel = 0;
  int world = 0; // NIfTI's number
  double smallest = 0, largest = 0, share_inside = 0;
  std::size_t voxels_of_tissue = 0, voxels_resected = 0, linear_elements = 0; // numbers of the warped image
  std::vector<Rim_facts> rims;                                                // empty without labels
};

enum class Support { FREE, TOUCHING, SLIDING, FIXED };

struct Supports
{
  std::size_t boundary_vertices = 0, fixed = 0, sliding = 0, touching = 0;
  std::vector<Support> of_vertices; // all of the mesh
};

/// The result at a control point.
struct Control
{
  bool is_used = false;
  Vector displacement{}, force{};
  double miss = 0;
  std::optional<Vector> left_out; // error if it is not used; none if the others do not hold the mesh
};

/// The order of displacements, and its cost.
struct Order_facts
{
  std::string order = "1"; // as the option has it
  std::string reason;      // why it is 1, if it could be 2 by default
  std::vector<std::array<CGAL::Mixed_meshes_3::Vertex_index, 2>> edges; // ends of those with coefficients
  std::size_t nodes = 0, unknowns = 0;
};

/// A displacement of the mesh, and its measures.
struct Shift
{
  std::vector<Vector> displacements;     // displacements of vertices
  std::vector<Vector> edge_coefficients; // coefficients of `Order_facts::edges`
  double largest = 0;
  Vector at{}; // place of the largest one
  double energy = 0;
  std::size_t inverted_elements = 0;
  std::vector<Control> controls;
  double largest_miss = 0, root_mean_square_miss = 0;
  std::optional<double> left_out; // root of the mean square
  std::size_t closed_contacts = 0;
  double contact_force = 0; // sum of all
  // Results of finite rotations: residuals before each step of Newton's method, and at the end; the number of
  // all iterations of conjugate gradients.
  std::vector<double> residuals;
  int iterations = 0;
};

/// Constraints that hold and move the nodes, which are vertices and then the edges of order 2: the equations
/// of supports and control points. The value of an edge is its coefficient.
struct Motion_constraints
{
  using Weights = std::vector<std::pair<CGAL::Mixed_meshes_3::Vertex_index, double>>;
  std::vector<std::vector<Vector>> held_directions; // orthonormal, for each node: its value is zero there
  std::vector<Weights> weights;                     // weights of the nodes averaged at each control point
  std::vector<Vector> means;                        // mean displacements, at each control point
  std::vector<std::array<CGAL::Mixed_meshes_3::Vertex_index, 2>> edges; // ends of the edges
};

/// Numbers of the removed and of the remaining elements.
struct Resection_facts
{
  struct Piece
  {
    std::size_t elements;
    double volume;
  };
  std::string status;
  std::size_t removed = 0, asked = 0, restored = 0, floating = 0, pinch = 0; // elements
  std::vector<Piece> floating_pieces;
  double volume = 0, area = 0; // volume and area of the cavity
  Mesh_facts left;
};

/// Points that were measured before and after, and the errors of methods that predict the points, in mm: the
/// point after minus its predicted place.
struct Landmark_facts
{
  static constexpr const char* model = "model";
  struct Errors
  {
    std::string method;
    std::vector<std::optional<Vector>> left_out; // errors by all other landmarks; none if undetermined
    std::vector<std::optional<Vector>> given;    // errors by the given landmarks; not at these
  };
  std::vector<Control_point> points;
  Locations locations;
  std::vector<double> depths; // distances from the boundary, negative outside
  std::size_t number_given = 0;
  std::vector<bool> is_given;
  std::vector<Errors> errors;                  // the model comes last
  std::optional<std::vector<Vector>> of_shift; // errors by control points that are not the landmarks
};

/// Statistics of PETSc.
struct Petsc_facts
{
  int processes = 0, iterations = 0; // largest number of iterations of a solution
};

struct Outcome
{
  Mesh_facts mesh;
  double volume = 0; // volume of the mesh
  std::vector<Subdomain_facts> subdomains;
  std::vector<Control_point> points;
  Locations locations;
  std::optional<Surface_facts> tumor;
  std::optional<Image_facts> image;
  std::optional<CGAL::Mixed_mesh_adaptation_result_3> adaptation;
  std::optional<Landmark_facts> landmarks;
  Order_facts order;
  Supports supports;
  std::optional<Petsc_facts> petsc;
  Shift before; // the resection
  std::optional<Resection_facts> resection;
  std::optional<Shift> after;
  Motion_constraints constraints; // constraints of the last shift; if it is written as a model
  std::vector<std::string> warnings;
  double seconds = 0;
  std::size_t peak_bytes = 0;

  const Shift& last() const { return after ? *after : before; }
};

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_OUTCOME_H
