// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that are finer than the budget, before vertices are removed: made on the lattice, or cut along the
// surface.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_FINE_MESH_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_FINE_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/boundary/lost_cells.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Interface_curves.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/cut_by_interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/fill_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/layer_cells.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/make_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/meshing_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/sharp_cells.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The number of vertices of the fine mesh, for a budget.
inline std::size_t number_of_fine_vertices(std::size_t budget)
{
  // With 3 times the budget, mean distances of parts with edges are larger by a tenth to a half, with 4 the
  // time is that of as many moves as the optimization of the whole. Beyond some number, the surface of a fine
  // mesh has vertices enough, and removing more would take more time than all other stages.
  constexpr double multiple = 4, most_removed = 30000;
  return budget + std::size_t((std::min)((multiple - 1) * double(budget), most_removed));
}

/// The width of places at small subdomains and shells, in mean chords, which are 4/3 of the radius of a ball:
/// edges of two thirds of it are as long as 0.27 of the radius, and the polyhedron lacks some hundredths of
/// the volume.
constexpr double width_of_chord = 0.3;

/// How many times the budget cells may have that are split for narrow places and for the topology.
constexpr std::size_t most_cells_for_narrow_places = 8, most_cells_for_topology = 16;

/// Splits cells that are too large for sharp edges that are near to each other, and for curved ones, as far
/// as the number of cells allows.
/// \param size edge of the cells that there are anyway
/// \return whether cells were split
inline bool split_cells_at_narrow_edges(Located_octree& octree, const Meshing_criteria& criteria, double size,
                                        std::size_t most)
{
  // Wider places are resolved by the cells that there are anyway. With half and twice of it, largest
  // distances of seven meshes are 0.91 and 1.03 times as large in the median (constants.md).
  constexpr double reach = 2;
  constexpr double samples = 8; // in a cell
  // Share of these cells. With half of it, two of 18 surfaces keep 0.03 and 0.05 less of their sharp edges.
  constexpr double smallest = 1. / 8;
  const Sharp_edges edges = octree.domain().sharp_edges(criteria.sharp_angle());
  if(edges.edges.empty())
    return false;
  const std::vector<Narrow_place> places = narrow_places(Sharp_features(edges, size), reach * size,
                                                         size / samples);
  for(double share = smallest; !places.empty() && share < reach; share *= 2) {
    Located_octree trial = octree;
    split_narrow_cells(trial, places, share * size);
    if(trial.number_of_cells() <= most) {
      octree = std::move(trial);
      return true;
    }
  }
  return false;
}

/// Lets the octree begin with cells that are small enough for sharp edges.
/// \param size edge of the cells that the fine mesh has anyway
inline void resolve_sharp_edges(Meshing_state& s, double size)
{
  Located_octree octree = s.root;
  if(refine_to_level(octree, s.coarsest_level(), s.budget())
     && split_cells_at_narrow_edges(octree, s.criteria, size,
                                    most_cells_for_narrow_places * s.criteria.maximal_number_of_vertices()))
    s.start = std::move(octree);
}

/// Splits cells at shells that these cells would not be round enough for, as far as the budget allows: at the
/// boundary of the best mesh, as often as that of the finer one is denser.
inline void resolve_small_shells(Meshing_state& s)
{
  const std::size_t budget = s.criteria.maximal_number_of_vertices();
  while(s.best.number_of_vertices > 0 && s.best.is_manifold() && s.go_on()) {
    const Core_mesh mesh = assembled_mesh(s.octree, s.best);
    const std::vector<Face> faces = boundary_faces(mesh);
    const Weighted_shells shells = weigh_shells(mesh, faces, double(budget));
    std::vector<Narrow_place> places;
    const auto add = [&](const Vec3& p, double chord) {
      const Any_domain::Point_3 q = s.root.domain().closest_point({p[0], p[1], p[2]});
      places.push_back({to_vec3(q), width_of_chord * chord});
    };
    for(const Face& face : faces) {
      const Face_vertices& polygon = face.vertices();
      const std::size_t shell = shells.shell_of[*polygon.begin()];
      if(shells.weights[shell] == 1)
        continue;
      Vec3 sum{};
      for(Vertex_index v : polygon) {
        add(to_vec3(mesh.points()[v]), shells.chords[shell]);
        sum = sum + to_vec3(mesh.points()[v]);
      }
      add((1. / polygon.size()) * sum, shells.chords[shell]);
    }
    if(places.empty())
      return;
    Located_octree trial = s.octree;
    split_narrow_cells(trial, places, 0);
    if(trial.number_of_cells() == s.octree.number_of_cells()
       || trial.number_of_cells() > most_cells_for_narrow_places * budget)
      return;
    Candidate candidate = s.try_octree(trial);
    if(candidate.is_stopped || !candidate.is_manifold())
      return;
    s.take(std::move(trial), std::move(candidate));
  }
}

/// Refines the octree for the fine mesh: until it has its number of vertices, and sharp edges and topology
/// are resolved.
inline void fill_fine_octree(Meshing_state& s)
{
  const Stage_scope scope(s.visitor, Stage::OCTREE);
  if(fill_lattice(s))
    return;
  const std::size_t budget = s.criteria.maximal_number_of_vertices();
  std::size_t number = number_of_fine_vertices(budget);
  resolve_sharp_edges(s, std::cbrt(s.volume() / double(number)));
  if(s.start) // what is beside these places needs cells as well
    number += s.try_octree(*s.start).number_of_vertices;
  s.number_beyond_budget = number - s.budget();
  fill_budget(s);
  s.number_beyond_budget = 0;
  resolve_small_shells(s);
}

/// Makes the fine mesh of one subdomain, without a region, on the lattice: it follows sharp edges best.
/// \return an empty mesh if there is none, or if the octree is the mesh
inline Core_mesh fine_mesh_on_lattice(Meshing_state& s)
{
  fill_fine_octree(s);
  if(s.is_stopped || s.result.is_lattice_on_surface)
    return {};
  s.make_best_again();
  if(s.misfit_on_lattice().is_topology_wrong()) {
    s.result.status = Mixed_mesh_status::TOPOLOGY_DIFFERS;
    return {};
  }
  s.result.number_of_vertices_needed = 0; // it is simplified
  describe_octree(s);
  if(!s.result.has_mesh())
    return {};
  Core_mesh fine = split_to_tetrahedra(assembled_mesh(s.octree, s.best));
  s.best.release();
  return fine;
}

/// Splits cells at the surface outside the region, the largest first, those of a level in the order of their
/// distance from the region, until there is a number of cells, nearly.
inline void split_cells_outside_region(Located_octree& octree, int coarsest_level, std::size_t most)
{
  // One of the parts may be missing. With half and twice as many, 16 and 17 of 18 meshes are the same.
  constexpr std::size_t parts_of_level = 64;
  for(int level = coarsest_level; level < Octree::max_level; ++level) {
    std::vector<std::pair<double, Octree::Node_index>> leaves; // with the distance from the region
    const auto is_outside = [&](Octree::Node_index n) { return !octree.is_in_region(n); };
    for(Octree::Node_index n : leaves_at_surface(octree, level, is_outside))
      leaves.emplace_back(octree.quantized(-octree.depth_in_region(n)), n);
    std::sort(leaves.begin(), leaves.end());
    const auto refined = [&](std::size_t number) {
      std::vector<Octree::Node_index> first;
      for(std::size_t i = 0; i < number; ++i)
        first.push_back(leaves[i].second);
      Located_octree result = octree;
      result.refine(first);
      return result;
    };
    std::size_t low = 0, high = leaves.size() + 1; // so many are not too many; are too many
    Located_octree largest = octree;
    for(std::size_t i = leaves.size(); high - low > 1 + leaves.size() / parts_of_level;
        i = (low + high) / 2) {
      Located_octree trial = refined(i);
      if(trial.number_of_cells() > most) {
        high = i;
      } else {
        low = i;
        largest = std::move(trial);
      }
    }
    octree = std::move(largest);
    if(low < leaves.size())
      return;
  }
}

/// Refines an octree by the sequence of the octree of the budget, until it has a number of vertices, nearly.
inline void refine_in_region(Meshing_state& s, Located_octree& octree, double number_of_vertices)
{
  // Of 2,000 vertices, without those at the surface; 1.21 of 10,000: so there is a second step. In walls that
  // are thinner than cells there are few vertices, whatever the number of cells.
  constexpr double vertices_per_cell = 1.27, least_vertices_per_cell = 0.5;
  Refinement_sequence sequence(octree, s.graded_radius());
  const auto with_cells = [&](double number) {
    while(double(sequence.number_of_cells(sequence.number_of_steps())) < number && sequence.extend()) {
    }
    return sequence.octree(sequence.first_step_with(number));
  };
  octree = with_cells(number_of_vertices / vertices_per_cell);
  const double rate = double(s.try_octree(octree).number_of_vertices) / double(octree.number_of_cells());
  octree = with_cells(number_of_vertices / (std::max)(rate, least_vertices_per_cell));
}

/// Splits cells at the surfaces of subdomains that these cells would not be round enough for, as long as
/// there are not too many cells.
inline void split_cells_at_small_subdomains(Located_octree& octree, std::size_t most)
{
  constexpr double samples = 2; // in a width
  const Any_domain& domain = octree.domain();
  for(Subdomain_index index : domain.subdomain_indices()) {
    const double width = width_of_chord * domain.mean_chord_length(index);
    std::vector<Narrow_place> places;
    for(const auto& p : domain.surface_samples(width / samples, index, most))
      places.push_back({to_vec3(p), width});
    Located_octree trial = octree;
    if(places.size() <= most)
      split_narrow_cells(trial, places, 0);
    if(trial.number_of_cells() <= most)
      octree = std::move(trial);
  }
}

/// Refines the octree for a mesh that is cut along its surfaces.
/// \return the number of nodes whose cells may stay hexahedra: with a region, those of an octree that could
/// be the mesh, before cells at the surface are split for it
inline std::size_t fill_octree_to_cut(Meshing_state& s)
{
  // Vertices in a mesh that is cut, for each cell, about.
  constexpr std::size_t vertices_per_cell = 2;
  // Cells for each vertex of the budget, for layers, and for walls and gaps. With four times as many, a head
  // of five labels has half as many corners and takes twice as long; three spherical layers need no more.
  constexpr std::size_t most_cells_for_layers = 2, most_cells_for_walls = 4;
  // With a region, the octree has fewer vertices than the budget by a share, as others are inserted at the
  // surface; but base level and balance take more of few: it has 670 of 660, 1,770 of 2,000, 7,880 of 10,000.
  // With 1,800 of 2,000 the boundary is farther from the surface by a third, with 1,500 errors of a bump are
  // larger by an eighth. Beyond some number, the surface has vertices enough.
  constexpr double share_inserted = 0.29, times_root = 7.8, most_inserted = 15000;
  // Cells at the surface that are split, for each vertex of the budget. With twice as many, meshes of 2,000
  // and 10,000 vertices take a quarter more time, and are no better.
  constexpr double cells_at_surface = 0.8;
  const Stage_scope scope(s.visitor, Stage::OCTREE);
  const std::size_t budget = s.criteria.maximal_number_of_vertices();
  const double n = double(budget);
  std::size_t number_kept = 0, number_at_edges = 0;
  Located_octree octree = s.root;
  if(!refine_to_level(octree, s.coarsest_level(), s.budget()))
    return 0;
  if(s.root.is_region_everywhere()) {
    Refinement_sequence sequence(octree, s.graded_radius());
    while(vertices_per_cell * sequence.number_of_cells(sequence.number_of_steps())
            < number_of_fine_vertices(budget)
          && sequence.extend()) {
    }
    octree = sequence.octree(sequence.number_of_steps());
    // Cells at sharp edges are not taken from those for walls. Without them, rotors and pipes of 2,000
    // vertices keep 0.6 of their sharp edges, open shells none, instead of 0.99.
    const std::size_t number = octree.number_of_cells();
    split_cells_at_narrow_edges(octree, s.criteria,
                                std::cbrt(s.volume() / double(number_of_fine_vertices(budget))),
                                most_cells_for_narrow_places * budget);
    number_at_edges = octree.number_of_cells() - number;
  } else {
    refine_in_region(s, octree,
                     n - (std::min)(share_inserted * n - times_root * std::sqrt(n), most_inserted));
    number_kept = s.criteria.only_tetrahedra() ? 0 : octree.octree().size();
    const std::size_t most = octree.number_of_cells()
                             + std::size_t((std::min)(cells_at_surface * n, most_inserted));
    split_cells_at_narrow_edges(octree, s.criteria, std::cbrt(s.volume() / n), most);
    split_cells_outside_region(octree, s.coarsest_level(), most);
  }
  if(s.has_several_subdomains() && s.root.is_region_everywhere()) // with one, that is where cells are small
    split_cells_at_small_subdomains(octree, octree.number_of_cells() + budget);
  if(s.has_several_subdomains())
    split_layer_cells(octree, most_cells_for_layers * budget);
  else if(s.root.is_region_everywhere())
    split_layer_cells(octree, most_cells_for_walls * budget + number_at_edges);
  s.octree = std::move(octree);
  return number_kept;
}

/// The number of vertices where interfaces meet in such a way that none of them can be removed.
inline std::size_t number_of_corners(const Core_mesh& mesh, const Any_surface& domain)
{
  const Interface_curves curves(Strata(domain).sorted_faces(mesh).faces, mesh.number_of_vertices());
  std::size_t number = 0;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    number += curves.is_corner(v);
  return number;
}

/// The lost cells of a mesh that is cut: a leaf has the elements whose center it contains.
inline std::vector<Octree::Node_index> lost_cells(const Located_octree& octree, const Core_mesh& mesh)
{
  std::vector<std::uint8_t> is_meshed(octree.octree().size(), 0);
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    Vec3 sum{};
    for(Vertex_index v : mesh.element(e))
      sum = sum + to_vec3(mesh.points()[v]);
    const Vec3 center = (1. / mesh.element(e).size()) * sum;
    is_meshed[octree.leaf_at({center[0], center[1], center[2]})] = 1;
  }
  return lost_cells(octree, std::move(is_meshed));
}

/// Splits the leaves that contain points, as long as there are not too many cells.
inline bool split_cells_at(Located_octree& octree, const std::vector<Vec3>& points, std::size_t most)
{
  std::vector<Octree::Node_index> leaves;
  for(const Vec3& p : points)
    leaves.push_back(octree.leaf_at({p[0], p[1], p[2]}));
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  Located_octree trial = octree;
  trial.refine(leaves);
  if(leaves.empty() || trial.number_of_cells() > most)
    return false;
  octree = std::move(trial);
  return true;
}

/// Cuts the octree's mesh along the surfaces. Cells are split where subdomains would meet that do not, as
/// long as that leaves fewer such places: holes in a layer between them would be full of curves and corners,
/// at which elements are flat.
/// \param most number of cells
/// \param known edges of meshes that were cut before; those of this one are added
/// \return an empty mesh if the surfaces do not fit together, or an interface would be no manifold
inline Core_mesh cut_mesh(Meshing_state& s, std::size_t number_kept, bool keeps_thin_parts, std::size_t most,
                          Known_edges& known)
{
  for(std::size_t fewest = std::size_t(-1);;) {
    Lattice_mesh lattice;
    {
      const Stage_scope scope(s.visitor, Stage::TRANSITIONS);
      CGAL_assertion(is_balanced(s.octree.octree(), Adjacency::EDGE));
      lattice = apply_transitions(s.octree, s.criteria.transition_templates(), s.criteria.number_of_threads);
      CGAL_expensive_postcondition(is_valid_lattice_mesh(lattice));
    }
    const Stage_scope scope(s.visitor, Stage::BOUNDARY);
    const Interface_cutter cutter(
      s.octree, lattice, [&](Octree::Node_index n) { return n < number_kept; }, known);
    if(!cutter.is_clear())
      return {};
    const std::vector<Vec3> places = s.has_several_subdomains() ? cutter.places_without_contact()
                                                                : std::vector<Vec3>();
    if(places.size() >= fewest || !s.go_on() || !split_cells_at(s.octree, places, most))
      return cut_by_interfaces(cutter, keeps_thin_parts);
    fewest = places.size();
  }
}

/// Splits the largest cells at the surface, and what is too large for layers, walls and gaps then.
/// \return whether there are not too many cells; otherwise none is split
inline bool split_largest_cells_at_surface(Located_octree& octree, int coarsest_level, std::size_t most)
{
  std::vector<Octree::Node_index> leaves;
  for(int level = coarsest_level; leaves.empty() && level < Octree::max_level; ++level)
    leaves = leaves_at_surface(octree, level, [](Octree::Node_index) { return true; });
  Located_octree trial = octree;
  trial.refine(leaves);
  if(leaves.empty() || trial.number_of_cells() > most)
    return false;
  split_layer_cells(trial, (std::min)(most, 2 * trial.number_of_cells()));
  octree = std::move(trial);
  return true;
}

/// Makes the fine mesh of several subdomains, or with a region, or of what is too thin for a mesh on the
/// lattice: its vertices on interfaces and on the boundary are there, but for curves where interfaces meet,
/// and sharp edges.
/// \return an empty mesh if there is none, or if the surfaces do not fit together: where they should be one,
/// and cut each other all over, there would be too many vertices that have to stay; so there are where layers
/// are too thin for the cells, which are split for that
inline Core_mesh cut_fine_mesh(Meshing_state& s)
{
  constexpr std::size_t vertices_per_corner = 10; // of the budget; half and twice: meshes are the same
  const std::size_t number_kept = fill_octree_to_cut(s),
                    most = most_cells_for_topology * s.criteria.maximal_number_of_vertices();
  s.result.status = Mixed_mesh_status::SUCCESS;
  s.result.base_level = s.coarsest_level();
  if(!describe_cells(s))
    s.result.status = Mixed_mesh_status::REGION_NOT_MET;
  if(!s.go_on() || !s.result.has_mesh())
    return {};
  // Furrows outside a region that are thinner than cells would take vertices from it, for a distance that
  // nobody asked for: errors of a bump of 1,000 vertices are larger by two thirds.
  bool keeps_thin_parts = !s.has_several_subdomains()
                          && (s.root.is_region_everywhere() || !is_tolerance_wished(s.criteria));
  Core_mesh fine;
  Known_edges known;
  const auto cut = [&] { // whether something is wrong
    fine = cut_mesh(s, number_kept, keeps_thin_parts, most, known);
    return fine.is_empty() || Misfit(fine, s.root.domain(), false, 0, 0, 0, 0).is_topology_wrong()
           || (s.has_several_subdomains()
               && vertices_per_corner * number_of_corners(fine, s.root.domain())
                    > s.criteria.maximal_number_of_vertices());
  };
  bool is_wrong = cut();
  while(is_wrong && s.go_on()) {
    if((keeps_thin_parts || s.has_several_subdomains())
       && !split_largest_cells_at_surface(s.octree, s.coarsest_level(), most))
      break;
    describe_cells(s);
    keeps_thin_parts = !s.has_several_subdomains();
    is_wrong = cut();
  }
  const Stage_scope scope(s.visitor, Stage::ASSEMBLY);
  s.lost = lost_cells(s.octree, fine);
  if(is_wrong) { // and would stay so
    s.result.status = fine.is_empty() || s.has_several_subdomains() ? Mixed_mesh_status::EMPTY
                                                                    : Mixed_mesh_status::TOPOLOGY_DIFFERS;
    fine.clear();
  }
  return fine;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_FINE_MESH_H
