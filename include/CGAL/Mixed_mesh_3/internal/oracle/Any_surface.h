// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface whose type is not known: the method is compiled once for all. Functions of refinements
// that a model lacks have a default here.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_SURFACE_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_SURFACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/refinements.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A sheet of a model of `MixedMeshDomainWithSheets_3`.
class Any_sheet
{
public:
  using Point_3 = Predicates_kernel::Point_3;

  virtual ~Any_sheet() = default;
  virtual bool may_intersect(const Bbox_3& box) const = 0;
  virtual bool do_intersect(const Point_3& p, const Point_3& q) const = 0;
  virtual Point_3 closest_point(const Point_3& p) const = 0;
  virtual Point_3 closest_point(const Point_3& p, const Point_3& hint) const = 0;
  virtual Sheet_location locate(const Point_3& p) const = 0;
};

/// A sheet that the caller keeps.
template <class Sheet>
class Sheet_reference final : public Any_sheet
{
  const Sheet& m_sheet;

public:
  explicit Sheet_reference(const Sheet& sheet) : m_sheet(sheet) {}

  bool may_intersect(const Bbox_3& box) const override { return m_sheet.may_intersect(box); }
  bool do_intersect(const Point_3& p, const Point_3& q) const override { return m_sheet.do_intersect(p, q); }
  Point_3 closest_point(const Point_3& p) const override { return m_sheet.closest_point(p); }
  Point_3 closest_point(const Point_3& p, const Point_3& hint) const override
  {
    return m_sheet.closest_point(p, hint);
  }
  Sheet_location locate(const Point_3& p) const override { return m_sheet.locate(p); }
};

/// A model of `MixedMeshSurface_3`, of `MixedMeshLabeledDomain_3` or of `MixedMeshDomainWithSheets_3`.
class Any_surface
{
public:
  using Point_3 = Predicates_kernel::Point_3;

  Any_surface(const Any_surface&) = delete;
  Any_surface& operator=(const Any_surface&) = delete;
  virtual ~Any_surface() = default;

  /// Whether subdomains have labels.
  bool is_labeled() const { return m_is_labeled; }
  /// The subdomains in their order; the only subdomain of a domain without labels is 1.
  const std::vector<Subdomain_index>& subdomain_indices() const { return m_subdomain_indices; }
  const std::vector<std::unique_ptr<const Any_sheet>>& sheets() const { return m_sheets; }
  bool has_sheets() const { return !m_sheets.empty(); }

  virtual Point_3 closest_point(const Point_3& p) const = 0;
  virtual Point_3 closest_point(const Point_3& p, const Point_3& hint) const = 0;
  virtual std::vector<Point_3> surface_samples(double spacing) const = 0;
  /// The sharp edges; none if the angle is not positive.
  virtual Sharp_edges sharp_edges(double angle) const = 0;
  virtual Bbox_3 bbox() const = 0;

  /// \name Functions of surfaces with labels
  /// @{
  virtual Point_3 closest_point(const Point_3& p, Subdomain_index first, Subdomain_index second) const = 0;
  virtual Point_3 closest_point(const Point_3& p, const Point_3& hint, Subdomain_index first,
                                Subdomain_index second) const = 0;
  /// \param most where there are more samples, one more than `most` is enough, which is faster
  virtual std::vector<Point_3>
  surface_samples(double spacing, Subdomain_index index,
                  std::size_t most = (std::numeric_limits<std::size_t>::max)()) const = 0;
  virtual double mean_chord_length(Subdomain_index index) const = 0;
  /// @}

protected:
  Any_surface() = default;

  bool m_is_labeled = false;
  std::vector<Subdomain_index> m_subdomain_indices = {1};
  std::vector<std::unique_ptr<const Any_sheet>> m_sheets;
};

/// A surface that the caller keeps.
/// \tparam Base `Any_surface`, or a class derived from it
template <class Surface, class Base = Any_surface>
class Surface_reference : public Base
{
  using User_point = typename Surface::Point_3;
  static constexpr bool has_labels = has_subdomains<Surface>();
  template <class S>
  using Limited_samples = decltype(std::declval<const S&>().surface_samples(0., Subdomain_index(),
                                                                            std::size_t()));

protected:
  const Surface& m_surface;

public:
  using Point_3 = Any_surface::Point_3;
  using Base::closest_point;

  explicit Surface_reference(const Surface& surface) : m_surface(surface)
  {
    if constexpr(has_labels) {
      this->m_is_labeled = true;
      const auto& indices = surface.subdomain_indices(); // a reference, or a copy
      this->m_subdomain_indices.assign(indices.begin(), indices.end());
    }
    if constexpr(has_sheets<Surface>())
      for(const auto& sheet : surface.sheets())
        this->m_sheets.push_back(std::make_unique<Sheet_reference<std::decay_t<decltype(*sheet)>>>(*sheet));
  }

  Point_3 closest_point(const Point_3& p) const override
  {
    return converted_point(m_surface.closest_point(to_user_point(p)));
  }
  Point_3 closest_point(const Point_3& p, const Point_3& hint) const override
  {
    return converted_point(m_surface.closest_point(to_user_point(p), to_user_point(hint)));
  }
  std::vector<Point_3> surface_samples(double spacing) const override
  {
    return converted_points(m_surface.surface_samples(spacing));
  }
  Sharp_edges sharp_edges([[maybe_unused]] double angle) const override
  {
    if constexpr(has_features<Surface>())
      if(angle > 0)
        return m_surface.sharp_edges(angle);
    return {};
  }
  Bbox_3 bbox() const override { return m_surface.bbox(); }

  Point_3 closest_point(const Point_3& p, [[maybe_unused]] Subdomain_index first,
                        [[maybe_unused]] Subdomain_index second) const override
  {
    if constexpr(has_labels)
      return converted_point(m_surface.closest_point(to_user_point(p), first, second));
    else
      return closest_point(p);
  }
  Point_3 closest_point(const Point_3& p, const Point_3& hint, [[maybe_unused]] Subdomain_index first,
                        [[maybe_unused]] Subdomain_index second) const override
  {
    if constexpr(has_labels)
      return converted_point(m_surface.closest_point(to_user_point(p), to_user_point(hint), first, second));
    else
      return closest_point(p, hint);
  }
  std::vector<Point_3> surface_samples(double spacing, [[maybe_unused]] Subdomain_index index,
                                       [[maybe_unused]] std::size_t most) const override
  {
    if constexpr(compiles<Limited_samples, Surface>)
      return converted_points(m_surface.surface_samples(spacing, index, most));
    else if constexpr(has_labels)
      return converted_points(m_surface.surface_samples(spacing, index));
    else
      return surface_samples(spacing);
  }
  double mean_chord_length([[maybe_unused]] Subdomain_index index) const override
  {
    if constexpr(has_labels)
      return m_surface.mean_chord_length(index);
    else
      return 0;
  }

protected:
  static User_point to_user_point(const Point_3& p)
  {
    if constexpr(std::is_same_v<User_point, Point_3>)
      return p;
    else
      return User_point(p.x(), p.y(), p.z());
  }

  template <class Point>
  static Point_3 converted_point(const Point& p)
  {
    if constexpr(std::is_same_v<Point, Point_3>)
      return p;
    else
      return Point_3(p.x(), p.y(), p.z());
  }

  template <class Range>
  static std::vector<Point_3> converted_points(Range&& points)
  {
    if constexpr(std::is_same_v<std::decay_t<Range>, std::vector<Point_3>>) {
      return std::forward<Range>(points);
    } else {
      std::vector<Point_3> result;
      for(const auto& p : points)
        result.push_back(converted_point(p));
      return result;
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_SURFACE_H
