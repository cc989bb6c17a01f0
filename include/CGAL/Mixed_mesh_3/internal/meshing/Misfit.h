// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_MISFIT_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_MISFIT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_domain.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The difference of a mesh from its domain, as far as simple numbers tell: equal numbers make a large
/// difference unlikely, different numbers prove one. `compare_with_surface()` is complete.
class Misfit
{
  bool m_is_mesh = true;
  std::size_t m_topology = 0, m_number_of_lost_cells = 0, m_number_not_arrived = 0,
              m_number_of_lost_edges = 0;
  double m_volume = 0, m_distance = 0; // relative excess over the tolerated values
  double m_volume_of_small_shells = 0; // the same, of shells that no other mesh would represent better
  std::optional<Shell_counts> m_shells_of_domain, m_shells;

  // What the status calls another volume. With half of it, one of 18 meshes has another volume, a knot with
  // 0.96 (constants.md).
  static constexpr double tolerated_volume = 0.05;
  // The volume of a small shell, in mean cells of a mesh with as many vertices. With half and twice of it, 18
  // meshes are the same.
  static constexpr double small = 16;

public:
  static Misfit without_mesh()
  {
    Misfit m;
    m.m_is_mesh = false;
    return m;
  }

  /// \param mesh mesh whose boundary is a manifold, except where it is pinched
  /// \param is_fitted whether its volume should be that of the domain
  /// \param number_of_lost_edges the length of sharp edges that the mesh cuts off, in mean edges
  /// \param distance relative excess of the distance from the surface over the tolerance
  Misfit(const Core_mesh& mesh, const Any_domain& domain, bool is_fitted, std::size_t number_of_lost_cells,
         std::size_t number_not_arrived, std::size_t number_of_lost_edges, double distance)
    : m_number_of_lost_cells(number_of_lost_cells), m_number_not_arrived(number_not_arrived),
      m_number_of_lost_edges(number_of_lost_edges), m_distance((std::max)(0., distance))
  {
    m_shells_of_domain = domain.shells();
    if(!m_shells_of_domain)
      return;
    m_shells = shells_of_boundary(mesh);
    m_topology = difference(m_shells->number_of_shells, m_shells_of_domain->number_of_shells)
                 + difference(m_shells->euler_characteristic, m_shells_of_domain->euler_characteristic);
    if(m_shells->number_of_cavities && m_shells_of_domain->number_of_cavities)
      m_topology += difference(*m_shells->number_of_cavities, *m_shells_of_domain->number_of_cavities);
    if(!is_fitted)
      return;
    const double volume = Mixed_meshes_3::volume(mesh), cell = volume / double(mesh.number_of_vertices());
    if(const std::optional<double> of_domain = domain.volume())
      m_volume = (std::max)(m_volume, excess(volume, *of_domain));
    const std::vector<double>&volumes = m_shells->volumes, &wanted = m_shells_of_domain->volumes;
    for(std::size_t i = 0; i < wanted.size() && volumes.size() == wanted.size(); ++i) {
      double& worst = std::abs(wanted[i]) < small * cell ? m_volume_of_small_shells : m_volume;
      worst = (std::max)(worst, excess(volumes[i], wanted[i]));
    }
  }

  bool is_none() const
  {
    return m_is_mesh && m_topology == 0 && m_number_of_lost_cells == 0 && m_volume == 0;
  }

  /// The shells of the domain's surface, as the domain tells, and the shells of the boundary of the mesh.
  const std::optional<Shell_counts>& shells_of_domain() const { return m_shells_of_domain; }
  const std::optional<Shell_counts>& shells() const { return m_shells; }

  /// Whether sharp edges are kept, and at most that many vertices are not on the surface, while nothing else
  /// is wrong.
  bool is_nearly_right(std::size_t most_not_arrived) const
  {
    return is_none() && m_volume_of_small_shells == 0 && m_distance == 0 && m_number_of_lost_edges == 0
           && m_number_not_arrived <= most_not_arrived;
  }

  bool is_topology_wrong() const { return m_topology > 0; }
  /// Whether the volume of the whole or of some shell is wrong, however small the shell is.
  bool is_some_volume_wrong() const { return m_volume > 0 || m_volume_of_small_shells > 0; }

  bool operator<(const Misfit& m) const { return key() < m.key(); }

private:
  Misfit() = default;

  static double excess(double volume, double wanted)
  {
    return wanted == 0 ? 0 : (std::max)(0., std::abs(volume / wanted - 1) - tolerated_volume);
  }

  template <class Number>
  static std::size_t difference(Number a, Number b)
  {
    return std::size_t(a < b ? b - a : a - b);
  }

  std::tuple<bool, std::size_t, bool, double, std::size_t, double, std::size_t, double> key() const
  {
    return {!m_is_mesh,
            m_topology,
            m_number_of_lost_cells > 0,
            m_volume,
            m_number_not_arrived + m_number_of_lost_edges,
            m_distance,
            m_number_of_lost_cells,
            m_volume_of_small_shells};
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_MISFIT_H
