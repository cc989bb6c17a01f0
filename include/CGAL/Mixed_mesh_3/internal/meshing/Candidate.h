// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_CANDIDATE_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_CANDIDATE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/Boundary_stage.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/meshing_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Mixed_mesh_criteria_3.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Meshing_criteria = With_threads<Mixed_mesh_criteria_3>;

/// Whether nobody asked for a tolerance: the default one is only wished.
inline bool is_tolerance_wished(const Mixed_mesh_criteria_3& criteria)
{
  return criteria.tolerance() == Mixed_mesh_criteria_3::automatic;
}

/// The mesh of one octree on the way to the budget, on the lattice. Once the mesh is assembled, the lattice
/// mesh is released, as it would take a tenth of the memory while the boundary is fitted; the few steps that
/// need it afterwards make it again.
struct Candidate
{
  std::size_t number_of_vertices = 0;
  bool is_stopped = false; // the visitor stopped the run
  Lattice_mesh mesh;
  Boundary_pieces boundary;

  bool is_manifold() const { return boundary.defects.empty(); }

  bool is_released() const { return number_of_vertices > 0 && mesh.vertices.empty(); }
  /// Releases the lattice mesh and its boundary, except for defects of the boundary.
  void release()
  {
    mesh = {};
    Boundary_pieces rest;
    rest.defects = std::move(boundary.defects);
    boundary = std::move(rest);
  }
};

/// The mesh of an octree, on the lattice.
inline Core_mesh assembled_mesh(const Located_octree& octree, const Candidate& candidate)
{
  Core_mesh mesh;
  assemble_mesh(octree, candidate.mesh, candidate.boundary, mesh);
  CGAL_postcondition(mesh.number_of_vertices() == candidate.number_of_vertices);
  return mesh;
}

/// Makes the lattice mesh of a candidate and its boundary, by the stages that follow the octree.
inline void make_lattice_mesh(const Located_octree& octree, const Meshing_criteria& criteria,
                              Any_visitor& visitor, Candidate& c)
{
  CGAL_assertion(is_balanced(octree.octree(), Adjacency::EDGE));
  {
    const Stage_scope scope(visitor, Stage::TRANSITIONS);
    c.mesh = apply_transitions(octree, criteria.transition_templates(), criteria.number_of_threads);
    CGAL_expensive_postcondition(is_valid_lattice_mesh(c.mesh));
  }
  {
    const Stage_scope scope(visitor, Stage::BOUNDARY);
    c.boundary = split_boundary(octree, c.mesh, criteria.boundary_mode(), criteria.number_of_threads);
    CGAL_expensive_postcondition(is_valid_boundary(octree, c.mesh, c.boundary));
  }
  c.number_of_vertices = c.boundary.number_of_vertices;
}

/// Runs the stages that follow the octree. To be called in the stage `OCTREE`.
inline Candidate make_candidate(const Located_octree& octree, const Meshing_criteria& criteria,
                                Any_visitor& visitor)
{
  Candidate c;
  const Stage_pause pause(visitor, Stage::OCTREE);
  c.is_stopped = !visitor.go_on();
  if(c.is_stopped)
    return c;
  make_lattice_mesh(octree, criteria, visitor, c);
  visitor.progress(c.number_of_vertices, criteria.maximal_number_of_vertices());
  return c;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_CANDIDATE_H
