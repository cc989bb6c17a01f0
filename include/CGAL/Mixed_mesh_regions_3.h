// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regions of interest without a surface: models of `MixedMeshRegion_3`.

#ifndef CGAL_MIXED_MESH_REGIONS_3_H
#define CGAL_MIXED_MESH_REGIONS_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/oracle/weight_in_region.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/squared_distance_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Domains

\brief The region where a function is positive.

The function must not change faster than the distance (for example, a signed distance, positive inside), so
that its value at the center of a cell limits where the cell can be.

\cgalModels{MixedMeshRegion_3}
*/
class Implicit_mixed_mesh_region_3
{
public:
  /// The type of points.
  using Point_3 = Mixed_meshes_3::Predicates_kernel::Point_3;
  /// Empty: the function can be evaluated anywhere.
  struct Surface_part
  {
  };

  /// \param depth function object `double(Point_3)`, positive inside, of Lipschitz constant 1
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
\ingroup PkgMixedMesh3Domains

\brief A ball.

\cgalModels{MixedMeshRegion_3}
*/
class Ball_mixed_mesh_region_3 : public Implicit_mixed_mesh_region_3
{
public:
  /// \param center,radius center and radius in the unit of the domain. \pre `radius > 0`
  Ball_mixed_mesh_region_3(const Point_3& center, double radius)
    : Implicit_mixed_mesh_region_3(
      [center, radius](const Point_3& p) { return radius - std::sqrt(CGAL::squared_distance(p, center)); })
  {
    CGAL_precondition(radius > 0);
  }

  /// Constructs a ball with a center of another kernel, which is rounded to doubles.
  template <class Kernel>
  Ball_mixed_mesh_region_3(const CGAL::Point_3<Kernel>& center, double radius)
    : Ball_mixed_mesh_region_3(Point_3(Mixed_meshes_3::rounded(center.x()),
                                       Mixed_meshes_3::rounded(center.y()),
                                       Mixed_meshes_3::rounded(center.z())),
                               radius)
  {
  }
};

/// \ingroup PkgMixedMesh3Domains
/// The region that is everywhere: the whole domain is refined.
/// \cgalModels{MixedMeshRegion_3}
class Everywhere_mixed_mesh_region_3
{
public:
  /// The type of points.
  using Point_3 = Mixed_meshes_3::Predicates_kernel::Point_3;
  /// Empty: there is no surface.
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
\ingroup PkgMixedMesh3Domains

\brief A region with a weight: the factor by which an error counts more there.

Cells become smaller by a factor of about \f$ w^{1/5} \f$ where the weight is \f$ w \f$. Weights are relative
to the weights of other places, and to 1, for which the share of the budget that serves the volume is set.

\tparam Region a model of `MixedMeshRegion_3`
\cgalModels{MixedMeshRegionWithWeights_3}
*/
template <class Region>
class Weighted_mixed_mesh_region_3 : public Region
{
public:
  /// The type of points.
  using Point_3 = Mixed_meshes_3::Predicates_kernel::Point_3;
  using Has_weights = Tag_true;

  /// Takes the region over (wrap it in `std::move` if it cannot be copied).
  /// \param region region
  /// \param weight weight, the same everywhere. \pre positive and finite
  Weighted_mixed_mesh_region_3(Region region, double weight)
    : Weighted_mixed_mesh_region_3(std::move(region), [weight](const Point_3&) { return weight; })
  {
    CGAL_precondition(weight > 0 && std::isfinite(weight));
  }

  /// Takes the region over, with a weight that depends on the point.
  /// \param region region
  /// \param weight function of the point, inside the region or not: finite, and not negative. Where the
  /// weight is 0 no cell is split for the sake of the region
  Weighted_mixed_mesh_region_3(Region region, std::function<double(const Point_3&)> weight)
    : Region(std::move(region)), m_weight(std::move(weight))
  {
  }

  double weight(const Point_3& p, double reach) const
  {
    const Region& region = *this;
    return m_weight(p) * Mixed_meshes_3::internal::weight_in_region(region, p, reach);
  }

private:
  std::function<double(const Point_3&)> m_weight;
};

/*!
\ingroup PkgMixedMesh3Domains

\brief The union of regions.

An error counts as in the region in which it counts most.

\tparam Regions models of `MixedMeshRegion_3`
\cgalModels{MixedMeshRegionWithWeights_3}
*/
template <class... Regions>
class Union_mixed_mesh_region_3
{
public:
  /// The type of points.
  using Point_3 = Mixed_meshes_3::Predicates_kernel::Point_3;
  /// Whether one of the regions has weights.
  using Has_weights = Boolean_tag<(Mixed_meshes_3::internal::has_weights<Regions>() || ...)>;
  /// The parts of the regions, and the side of the cell relative to each region.
  struct Surface_part
  {
    /// A part of each region.
    std::tuple<typename Regions::Surface_part...> parts;
    /// The side of the cell relative to each region.
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

  double weight(const Point_3& p, double reach) const
  {
    using namespace Mixed_meshes_3::internal;
    const auto of = [&](const auto& r) { return std::pair(r.depth(p), weight_in_region(r, p, reach)); };
    return std::apply([&](const auto&... r) { return weight_in_union(std::array{of(r)...}, reach); },
                      m_regions);
  }

private:
  // The location of a cell: inside one region is inside; a boundary may lie within another region, which does
  // no harm. A region whose surface does not meet the parent is not queried.
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
