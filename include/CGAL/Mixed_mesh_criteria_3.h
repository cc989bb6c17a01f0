// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_CRITERIA_3_H
#define CGAL_MIXED_MESH_CRITERIA_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/options.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>

#include <CGAL/assertions.h>

#include <cstddef>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Mesh

\brief Criteria of a mixed mesh. Each setter returns the object, so that calls can be chained.
*/
class Mixed_mesh_criteria_3
{
public:
  /// Value for the default, where the default depends on other criteria or the domain.
  static constexpr int automatic = -1;
  /// The share of the budget, after bisections, below which the status tells that the budget is not filled.
  /// Single cells take 7 to 20 vertices: with the smallest budgets that make sense, a few hundred, some 3 %
  /// may be left over.
  static constexpr double full_share = 0.97;

  /// Constructs criteria with the default settings; a number converts to its budget.
  /// \param maximal_number_of_vertices vertex budget: the mesh has at most that many vertices, those of
  /// transitions and of the boundary included. \pre at least 1, at most 2^32 - 2
  Mixed_mesh_criteria_3(std::size_t maximal_number_of_vertices)
  {
    this->maximal_number_of_vertices(maximal_number_of_vertices);
  }

  /// Sets the vertex budget. \pre at least 1, at most 2^32 - 2
  Mixed_mesh_criteria_3& maximal_number_of_vertices(std::size_t number)
  {
    CGAL_precondition(number > 0 && number < Mixed_meshes_3::Vertex_index(-1));
    m_maximal_number_of_vertices = number;
    return *this;
  }
  /// The vertex budget.
  std::size_t maximal_number_of_vertices() const { return m_maximal_number_of_vertices; }

  /// Sets whether the mesh shall have as few vertices as its tolerance, and the topology and the volume of
  /// the domain allow, to about a tenth, and at most those of the budget. Meshes with five to ten budgets are
  /// made for that (`Mixed_mesh_result_3::number_of_budgets`). If the whole budget does not suffice, the mesh
  /// is that of the whole budget, and the status tells. Default: no, the budget is filled. \pre a tolerance
  /// is given, and the boundary is fitted, when the mesh is made
  Mixed_mesh_criteria_3& fewest_vertices(bool fewest)
  {
    m_fewest_vertices = fewest;
    return *this;
  }
  /// The value set, or the default.
  bool fewest_vertices() const { return m_fewest_vertices; }

  /// Sets the octree level to which the whole domain is refined at least, in the region or not; cells of
  /// level `l` are 2^l times smaller than the root. Default: 3; coarser, down to 1, if the budget is too
  /// small for 3; finer, up to 6, if no octree vertex would be inside a thin domain, or more than 5 % of its
  /// cells would be lost.
  /// \pre `automatic`, or from 0 to 10
  Mixed_mesh_criteria_3& base_level(int level)
  {
    CGAL_precondition(level == automatic || (level >= 0 && level <= 10));
    m_base_level = level;
    return *this;
  }
  /// The value set, or the default.
  int base_level() const { return m_base_level; }

  /// Sets how slowly cells grow with the distance from the region. A cell is worth (1 + d/r)^-6 h^5, with its
  /// side h and its distance d from the region, and the cell that is worth most is split first; r is the
  /// grading times the region's mean radius, that of a ball with the volume that region and domain have in
  /// common. At the distance r cells are 2.3 times as large as in the region, up to a power of two. 0: only
  /// cells that meet the region are split, the largest cells first, as in the paper. Default: 0.35.
  /// \pre at least 0
  Mixed_mesh_criteria_3& grading(double share_of_radius)
  {
    CGAL_precondition(share_of_radius >= 0);
    m_grading = share_of_radius;
    return *this;
  }
  /// The value set, or the default.
  double grading() const { return m_grading; }

  /// Sets the share of the budget for bisections: vertices on the surface that the optimization inserts at
  /// the middles of boundary edges. Each bisection costs one vertex, where an octree cell costs 8 to 19.
  /// Without `fit_to_surface()`, that share is left over, for a later `optimize_mixed_mesh_3()`. 0: no edge
  /// is bisected, even if the octree leaves vertices over. Default: 0.04, or 0.12 with several
  /// subdomains, as small ones lose most; 0 without `fit_to_surface()`. \pre `automatic`, or in [0, 0.5]
  Mixed_mesh_criteria_3& share_of_bisections(double share)
  {
    CGAL_precondition(share == automatic || (share >= 0 && share <= 0.5));
    m_share_of_bisections = share;
    return *this;
  }
  /// The value set, or the default for one subdomain.
  double share_of_bisections() const { return share_of_bisections_for(1); }
  /// The value set, or the default for a number of subdomains.
  double share_of_bisections_for(std::size_t number_of_subdomains) const
  {
    if(m_share_of_bisections != automatic)
      return m_share_of_bisections;
    // With a region at six places of a brain, largest distances with 0 and 0.08 are larger by 2 and 5 % for
    // 2,000 vertices, by 0 and 15 % for 10,000; without, by 9 and 0 % from 660 to 20,000; with 0.16, by 20 to
    // 110 %. The union of two balls of 1,000 vertices lacks 3.5 % of its volume with 0.12, and 5.3 % with
    // 0.04.
    return !m_fit_to_surface ? 0 : number_of_subdomains > 1 ? 0.12 : 0.04;
  }

  /// Sets whether the mesh may begin with more vertices than the budget, and lose those by edge collapses
  /// whose loss is least (`Mixed_mesh_result_3::number_of_collapsed_vertices`). Elements at the surface, and
  /// without a region all of them, are tetrahedra then. Otherwise the octree has the vertices of the budget,
  /// as it has without `fit_to_surface()`, with a given base level, with a region and a grading of 0, with
  /// sheets, and where there is no simplified mesh. Default: yes.
  Mixed_mesh_criteria_3& simplification(bool simplifies)
  {
    m_simplification = simplifies;
    return *this;
  }
  /// The value set, or the default.
  bool simplification() const { return m_simplification; }

  /// Sets the shape of the root, hence of all cells. Default: a cube.
  Mixed_mesh_criteria_3& root_cell(Mixed_meshes_3::Root_cell root)
  {
    m_root_cell = root;
    return *this;
  }
  /// The value set, or the default.
  Mixed_meshes_3::Root_cell root_cell() const { return m_root_cell; }

  /// Sets the transition templates. Default: those with the fewest vertices.
  Mixed_mesh_criteria_3& transition_templates(Mixed_meshes_3::Transition_templates_choice choice)
  {
    m_transition_templates = choice;
    return *this;
  }
  /// The value set, or the default.
  Mixed_meshes_3::Transition_templates_choice transition_templates() const { return m_transition_templates; }

  /// Sets the way in which elements at the surface are split. Default: by vertex order.
  Mixed_mesh_criteria_3& boundary_mode(Mixed_meshes_3::Boundary_mode mode)
  {
    m_boundary_mode = mode;
    return *this;
  }
  /// The value set, or the default.
  Mixed_meshes_3::Boundary_mode boundary_mode() const { return m_boundary_mode; }

  /// Sets whether the boundary is brought onto the surface and the elements are optimized, as
  /// `optimize_mixed_mesh_3()` does. If not, boundary vertices stay where the octree has them, outside the
  /// domain or on its surface. Default: yes.
  Mixed_mesh_criteria_3& fit_to_surface(bool fit)
  {
    m_fit_to_surface = fit;
    return *this;
  }
  /// The value set, or the default.
  bool fit_to_surface() const { return m_fit_to_surface; }

  /// Sets whether all elements are split into tetrahedra before the boundary is fitted, without further
  /// vertices. Default: no.
  Mixed_mesh_criteria_3& only_tetrahedra(bool only)
  {
    m_only_tetrahedra = only;
    return *this;
  }
  /// The value set, or the default.
  bool only_tetrahedra() const { return m_only_tetrahedra; }

  /// Sets the largest distance between boundary and surface, in the surface's unit. If positive, part of the
  /// budget, at most half of it, is spent on cells outside the region where the boundary would be much
  /// farther, and boundary vertices slide toward places that are farther; the status tells if that did not
  /// suffice. 0: vertices have to be on the surface, without further conditions. Default: 0.42 of the edge of
  /// a cube with the volume that one vertex of the budget has to serve; the default is a wish: the status
  /// does not tell.
  /// \pre `automatic`, or at least 0
  Mixed_mesh_criteria_3& tolerance(double distance)
  {
    CGAL_precondition(distance == automatic || distance >= 0);
    m_tolerance = distance;
    return *this;
  }
  /// The value set, or `automatic` if none is set: see `Mixed_mesh_result_3::tolerance`.
  double tolerance() const { return m_tolerance; }

  /// Sets the largest aspect-ratio coefficient (ARC) of an element, if the boundary is fitted. A bound from
  /// the default on is guaranteed for cubic cells and the default boundary mode, unless only flatter elements
  /// fit into a thin wall: see `strict_quality_bound()`; boundary vertices that would need worse elements do
  /// not arrive on the surface. A smaller bound is not reached by all elements, but no element gets worse
  /// than at the start. 0, or infinity: no bound. Default: 3.2. \pre 0, or at least 1
  Mixed_mesh_criteria_3& quality_bound(double arc)
  {
    m_quality_bound = Mixed_mesh_optimization_criteria_3().quality_bound(arc).quality_bound();
    return *this;
  }
  /// The value set, or the default; infinity if there is no bound.
  double quality_bound() const { return m_quality_bound; }

  /// Sets whether the quality bound is kept even where topology, volume and arrival of the boundary cannot be
  /// right with it. If not, larger bounds are tried then, up to five times as large, and the first bound that
  /// suffices is taken; beyond, elements stay only where no other mesh is nearer to the surface.
  /// `Mixed_mesh_optimization_result_3::number_of_elements_above_bound` counts the elements that exceed the
  /// bound that was asked for. Domains that can be meshed within the bound, such as organs, are not
  /// concerned. Default: no
  Mixed_mesh_criteria_3& strict_quality_bound(bool is_strict)
  {
    m_is_quality_bound_strict = is_strict;
    return *this;
  }
  /// The value set, or the default.
  bool is_quality_bound_strict() const { return m_is_quality_bound_strict; }

  /// Sets the angle between the normals of two facets, in degrees, from which on their edge is sharp: the
  /// mesh has edges along sharp edges, and vertices at their corners. Without long lines of such edges, as on
  /// organs, the angle has no effect. If all of the surface is perpendicular to the axes, cells are placed
  /// such that lattice planes lie on the surface, if possible, and cells stay whole there. 0: neither.
  /// Default: 50. \pre in [0, 180]
  Mixed_mesh_criteria_3& sharp_angle(double degrees)
  {
    m_sharp_angle = Mixed_mesh_optimization_criteria_3().sharp_angle(degrees).sharp_angle();
    return *this;
  }
  /// The value set, or the default.
  double sharp_angle() const { return m_sharp_angle; }

  /// Sets whether the best mesh so far, if there is one, is kept when the visitor stops the run: the mesh is
  /// valid, and within the budget, but its boundary may not have arrived; `Mixed_mesh_result_3::has_mesh()`
  /// tells. Default: no, the mesh is empty then.
  Mixed_mesh_criteria_3& keep_mesh_if_stopped(bool keep)
  {
    m_keep_mesh_if_stopped = keep;
    return *this;
  }
  /// The value set, or the default.
  bool keep_mesh_if_stopped() const { return m_keep_mesh_if_stopped; }

private:
  std::size_t m_maximal_number_of_vertices = 1;
  int m_base_level = automatic;
  Mixed_meshes_3::Root_cell m_root_cell = Mixed_meshes_3::Root_cell::CUBE;
  Mixed_meshes_3::Transition_templates_choice m_transition_templates =
    Mixed_meshes_3::Transition_templates_choice::FEWEST_VERTICES;
  Mixed_meshes_3::Boundary_mode m_boundary_mode = Mixed_meshes_3::Boundary_mode::VERTEX_ORDER;
  bool m_simplification = true, m_fit_to_surface = true, m_only_tetrahedra = false,
       m_keep_mesh_if_stopped = false, m_fewest_vertices = false, m_is_quality_bound_strict = false;
  double m_grading = 0.35;
  double m_share_of_bisections = automatic;
  double m_tolerance = automatic;
  double m_quality_bound = Mixed_mesh_optimization_criteria_3::default_quality_bound;
  double m_sharp_angle = Mixed_mesh_optimization_criteria_3::default_sharp_angle;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_CRITERIA_3_H
