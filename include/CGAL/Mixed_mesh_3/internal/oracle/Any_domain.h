// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A domain whose type is not known: the method is compiled once for all.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_DOMAIN_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_DOMAIN_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Lattice_point.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Surface_part.h>

#include <CGAL/enum.h>

#include <cstdint>
#include <optional>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A model of `MixedMeshDomain_3`, asked for the cells of an octree by their positions on the lattice.
class Any_domain : public Any_surface
{
public:
  using Any_surface::closest_point;

  virtual Surface_part surface_part() const = 0;
  /// \param parent the part of a cell that contains this one
  /// \param part becomes the part of the cell if the answer is `ON_BOUNDARY`, or, with labels, if the cell is
  ///        inside; else null
  virtual Bounded_side locate(const Lattice_point& corner, std::uint32_t side, const Surface_part& parent,
                              Surface_part& part) const = 0;
  /// A box around a cell.
  virtual Bbox_3 cell_box(const Lattice_point& corner, std::uint32_t side) const = 0;

  /// \param part part of a cell that contains `p`, or null
  virtual Bounded_side bounded_side(const Point_3& p, const Surface_part& part) const = 0;
  virtual Point_3 closest_point(const Point_3& p, const Surface_part& part) const = 0;
  /// The subdomain of a point, with labels; 0 for a point that is not inside.
  virtual Subdomain_index subdomain_index(const Point_3& p, const Surface_part& part) const = 0;

  /// The number and genus of the shells of the surface; nothing if the domain does not tell.
  virtual std::optional<Shell_counts> shells() const = 0;
  /// The volume; nothing if the domain does not tell.
  virtual std::optional<double> volume() const = 0;
};

/// A domain and cell traits that the caller keeps.
template <class Domain, class CellTraits>
class Domain_reference final : public Surface_reference<Domain, Any_domain>
{
  using Base = Surface_reference<Domain, Any_domain>;
  using Part = typename Domain::Surface_part;
  using Base::m_surface;

  const CellTraits& m_traits;
  const Part m_no_part{};

  const Part& part_or_none(const Surface_part& part) const
  {
    return part ? surface_part_as<Part>(part) : m_no_part;
  }

public:
  using typename Base::Point_3;
  using Base::closest_point;

  Domain_reference(const Domain& domain, const CellTraits& traits) : Base(domain), m_traits(traits) {}

  Surface_part surface_part() const override { return make_surface_part(m_surface.surface_part()); }

  Bounded_side locate(const Lattice_point& corner, std::uint32_t side, const Surface_part& parent,
                      Surface_part& part) const override
  {
    return locate_cell(m_surface, m_traits.cell(corner, side), parent, part, this->is_labeled());
  }

  Bbox_3 cell_box(const Lattice_point& corner, std::uint32_t side) const override
  {
    return m_traits.cell(corner, side).bbox();
  }

  Bounded_side bounded_side(const Point_3& p, const Surface_part& part) const override
  {
    return m_surface.bounded_side(this->to_user_point(p), part_or_none(part));
  }

  Point_3 closest_point(const Point_3& p, const Surface_part& part) const override
  {
    return this->converted_point(m_surface.closest_point(this->to_user_point(p), part_or_none(part)));
  }

  Subdomain_index subdomain_index([[maybe_unused]] const Point_3& p,
                                  [[maybe_unused]] const Surface_part& part) const override
  {
    if constexpr(has_subdomains<Domain>())
      return m_surface.subdomain_index(this->to_user_point(p), part_or_none(part));
    else
      return 1;
  }

  std::optional<Shell_counts> shells() const override
  {
    if constexpr(has_shells<Domain>())
      return m_surface.shells();
    else
      return std::nullopt;
  }

  std::optional<double> volume() const override
  {
    if constexpr(has_shells<Domain>())
      return m_surface.volume();
    else
      return std::nullopt;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_DOMAIN_H
