// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regions of interest: models of `MixedMeshRegion_3`.

#ifndef CGAL_MIXED_MESH_REGIONS_3_H
#define CGAL_MIXED_MESH_REGIONS_3_H

#include <CGAL/Mixed_mesh_3/internal/surface/Surface_oracle_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

namespace CGAL {

/*!
\brief The region inside a closed triangulated surface.

\cgalModels{MixedMeshRegion_3}
*/
class Polyhedral_mixed_mesh_region_3 : public Mixed_meshes_3::internal::Surface_oracle_3
{
public:
  /*!
  \tparam FaceListGraph a model of `FaceListGraph`, with points of any CGAL kernel
  \param surface the surface. \pre `CGAL::is_triangle_mesh(surface) && CGAL::is_closed(surface)`
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

  \cgalNamedParamsBegin
    \cgalParamNBegin{vertex_point_map}
      \cgalParamDescription{the points of `surface`}
      \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
      \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
    \cgalParamNEnd
  \cgalNamedParamsEnd
  */
  template <class FaceListGraph, class NamedParameters = parameters::Default_named_parameters>
  explicit Polyhedral_mixed_mesh_region_3(const FaceListGraph& surface,
                                          const NamedParameters& np = parameters::default_values())
    : Surface_oracle_3(surface, np)
  {
  }

  /// Depth below the surface; negative outside.
  double depth(const Point_3& p) const
  {
    const double d = std::sqrt(CGAL::squared_distance(p, closest_point(p, Surface_part())));
    return bounded_side(p) == ON_UNBOUNDED_SIDE ? -d : d;
  }
};

/*!
\brief The region where a function is positive.

The function must not change faster than the distance (for example, a signed distance, positive
inside), so that its value at the center of a cell tells where the cell can not be.

\cgalModels{MixedMeshRegion_3}
*/
class Implicit_mixed_mesh_region_3
{
public:
  using Point_3 = Mixed_meshes_3::Predicates_kernel::Point_3;
  struct Surface_part
  {
  };

  /// \param depth a function object `double(Point_3)`, positive inside, of Lipschitz constant 1
  explicit Implicit_mixed_mesh_region_3(std::function<double(const Point_3&)> depth)
    : m_depth(std::move(depth))
  {
  }

  Surface_part surface_part() const { return {}; }

  template <class Cell>
  Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    const Bbox_3 b = cell.bbox();
    const double radius = std::hypot(b.x_span(), b.y_span(), b.z_span()) / 2;
    const double d = depth(cell.center());
    return d > radius ? ON_BOUNDED_SIDE : d < -radius ? ON_UNBOUNDED_SIDE : ON_BOUNDARY;
  }

  double depth(const Point_3& p) const { return m_depth(p); }

private:
  std::function<double(const Point_3&)> m_depth;
};

/*!
\brief A ball.

\cgalModels{MixedMeshRegion_3}
*/
class Ball_mixed_mesh_region_3 : public Implicit_mixed_mesh_region_3
{
public:
  /// \param center,radius in the unit of the domain. \pre `radius > 0`
  Ball_mixed_mesh_region_3(const Point_3& center, double radius)
    : Implicit_mixed_mesh_region_3(
      [center, radius](const Point_3& p) { return radius - std::sqrt(CGAL::squared_distance(p, center)); })
  {
    CGAL_precondition(radius > 0);
  }
};

/// The region that is everywhere: the whole domain is refined.
/// \cgalModels{MixedMeshRegion_3}
class Everywhere_mixed_mesh_region_3
{
public:
  using Point_3 = Mixed_meshes_3::Predicates_kernel::Point_3;
  struct Surface_part
  {
  };
  Surface_part surface_part() const { return {}; }
  template <class Cell>
  Bounded_side locate(const Cell&, const Surface_part&, Surface_part&) const
  {
    return ON_BOUNDED_SIDE;
  }
  double depth(const Point_3&) const { return 0; }
};

/*!
\brief The union of regions.

\tparam Regions models of `MixedMeshRegion_3`
\cgalModels{MixedMeshRegion_3}
*/
template <class... Regions>
class Union_mixed_mesh_region_3
{
public:
  using Point_3 = Mixed_meshes_3::Predicates_kernel::Point_3;
  /// The parts of the regions, and where the cell is relative to each.
  struct Surface_part
  {
    std::tuple<typename Regions::Surface_part...> parts;
    std::array<Bounded_side, sizeof...(Regions)> sides;
  };

  /// Takes the regions over (wrap one in `std::move`: a polyhedral region cannot be copied).
  explicit Union_mixed_mesh_region_3(Regions... regions) : m_regions(std::move(regions)...) {}

  Surface_part surface_part() const
  {
    Surface_part part{std::apply([](const auto&... r) { return std::make_tuple(r.surface_part()...); },
                                 m_regions),
                      {}};
    part.sides.fill(ON_BOUNDARY);
    return part;
  }

  template <class Cell>
  Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part) const
  {
    return locate(cell, parent, part, std::index_sequence_for<Regions...>());
  }

  double depth(const Point_3& p) const
  {
    return std::apply([&](const auto&... r) { return (std::max)({r.depth(p)...}); }, m_regions);
  }

private:
  // Inside one is inside; a boundary may lie within another region, which does no harm. A region whose
  // surface does not meet the parent is not asked.
  template <class Cell, std::size_t... I>
  Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part,
                      std::index_sequence<I...>) const
  {
    ((part.sides[I] = parent.sides[I] != ON_BOUNDARY
                        ? parent.sides[I]
                        : std::get<I>(m_regions).locate(cell, std::get<I>(parent.parts),
                                                        std::get<I>(part.parts))),
     ...);
    return *std::max_element(part.sides.begin(), part.sides.end());
  }

  std::tuple<Regions...> m_regions;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_REGIONS_3_H
