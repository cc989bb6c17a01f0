// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LABELED_POLYHEDRAL_MIXED_MESH_DOMAIN_3_H
#define CGAL_LABELED_POLYHEDRAL_MIXED_MESH_DOMAIN_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_tree.h>
#include <CGAL/Mixed_mesh_3/internal/surface/visible_sharp_edges.h>
#include <CGAL/Mixed_mesh_sheet_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>
#include <CGAL/squared_distance_3.h>
#include <CGAL/tags.h>

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Domains

\brief The domain inside one or more closed triangulated surfaces, each of which encloses a subdomain.

The surface that was added first counts where surfaces overlap: a tumor, then the ventricles, then the brain
around both. So surfaces may be nested, disjoint, touch, or cross each other; each interface lies on the
surface of the subdomain that was added first. The subdomain with index 0 is a cavity: it belongs to the
outside.

Where the surfaces of two subdomains have facets in common, with equal points, these are their interface, and
those that a surface has alone are its interface to the outside: so it is for the surfaces of
`Mixed_meshes_3::make_label_surfaces()`, and for parts of an assembly whose common faces have common
triangles.

All answers are exact on the coordinates of the surfaces, rounded to double, as for
`Polyhedral_mixed_mesh_domain_3`.

\cgalModels{MixedMeshDomainWithSheets_3}
\cgalModels{MixedMeshDomainWithFeatures_3}
\cgalModels{MixedMeshDomainWithShells_3}
*/
class Labeled_polyhedral_mixed_mesh_domain_3
{
  using Surface = Polyhedral_mixed_mesh_domain_3;

public:
  using Point_3 = Surface::Point_3;
  /// The label of a subdomain.
  using Subdomain_index = Mixed_meshes_3::Subdomain_index;
  using Has_subdomains = Tag_true;
  using Has_sheets = Tag_true;
  using Has_features = Tag_true;
  using Has_shells = Tag_true;

  /// The surfaces that are visible in a cell: those that meet the cell and are not hidden inside an earlier
  /// one.
  struct Surface_part
  {
    std::vector<std::pair<std::size_t, Surface::Surface_part>> parts; ///< by numbers of surfaces
    std::size_t background = std::size_t(-1); ///< the first surface around the whole cell, if there is one
  };

  /// Adds a subdomain, behind those that were added before.
  /// \param surface surface, which copies share
  /// \param index label, not negative; 0 is a cavity. \pre surfaces of the same index are added one after the
  /// other
  void add(std::shared_ptr<const Polyhedral_mixed_mesh_domain_3> surface, Subdomain_index index)
  {
    CGAL_precondition(index >= 0);
    CGAL_precondition(index == 0 || std::find(m_indices.begin(), m_indices.end(), index) == m_indices.end()
                      || m_surfaces.back().index == index);
    if(index == 0) {
      m_cavities.push_back(surface.get());
      for(Subdomain_index i : m_indices)
        m_surfaces_of[{i, true}].push_back(surface.get());
    } else {
      if(m_indices.empty() || m_indices.back() != index) {
        m_indices.push_back(index);
        m_surfaces_of[{index, true}] = m_cavities;
      }
      for(bool is_to_outside : {false, true})
        m_surfaces_of[{index, is_to_outside}].push_back(surface.get());
    }
    m_bbox += surface->bbox();
    m_surfaces.push_back({std::move(surface), index, {}});
    find_common_facets();
  }

  /// Adds the subdomain inside a surface.
  /// \param surface,np parameters of `Polyhedral_mixed_mesh_domain_3`
  /// \param index label as above
  template <class FaceListGraph, class NamedParameters = parameters::Default_named_parameters,
            std::enable_if_t<!std::is_convertible_v<
              FaceListGraph, std::shared_ptr<const Polyhedral_mixed_mesh_domain_3>>>* = nullptr>
  void add(const FaceListGraph& surface, Subdomain_index index,
           const NamedParameters& np = parameters::default_values())
  {
    add(std::make_shared<const Polyhedral_mixed_mesh_domain_3>(surface, np), index);
  }

  /// Adds a sheet: faces of the mesh are brought onto the sheet, as `find_sheet_faces()` tells.
  /// \param sheet sheet, which copies share
  void add_sheet(std::shared_ptr<const Mixed_mesh_sheet_3> sheet) { m_sheets.push_back(std::move(sheet)); }

  /// Adds a sheet.
  /// \param surface,np parameters of `Mixed_mesh_sheet_3`
  template <class FaceListGraph, class NamedParameters = parameters::Default_named_parameters,
            std::enable_if_t<
              !std::is_convertible_v<FaceListGraph, std::shared_ptr<const Mixed_mesh_sheet_3>>>* = nullptr>
  void add_sheet(const FaceListGraph& surface, const NamedParameters& np = parameters::default_values())
  {
    add_sheet(std::make_shared<const Mixed_mesh_sheet_3>(surface, np));
  }

  /// The sheets in the order in which they were added.
  const std::vector<std::shared_ptr<const Mixed_mesh_sheet_3>>& sheets() const { return m_sheets; }

  /// The indices of subdomains that are not 0, in the order in which they were added.
  const std::vector<Subdomain_index>& subdomain_indices() const { return m_indices; }

  const Bbox_3& bbox() const { return m_bbox; }

  Surface_part surface_part() const
  {
    Surface_part part;
    for(std::size_t i = 0; i < m_surfaces.size(); ++i)
      part.parts.emplace_back(i, m_surfaces[i].surface->surface_part());
    return part;
  }

  template <class Cell>
  Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part) const
  {
    part.parts.clear();
    part.background = parent.background;
    for(const auto& [i, of_parent] : parent.parts) {
      part.parts.emplace_back(i, Surface::Surface_part());
      const Bounded_side side = m_surfaces[i].surface->locate(cell, of_parent, part.parts.back().second);
      if(side != ON_BOUNDARY)
        part.parts.pop_back();
      if(side == ON_BOUNDED_SIDE) { // later surfaces are hidden
        part.background = i;
        break;
      }
    }
    return !part.parts.empty()              ? ON_BOUNDARY
           : index_of(part.background) != 0 ? ON_BOUNDED_SIDE
                                            : ON_UNBOUNDED_SIDE;
  }

  Bounded_side bounded_side(const Point_3& p, const Surface_part& part) const
  {
    bool is_on_surface = false; // the boundary if the outside is behind
    for(const auto& [i, of_surface] : part.parts) {
      const Bounded_side side = m_surfaces[i].surface->bounded_side(p, of_surface);
      is_on_surface = is_on_surface || side == ON_BOUNDARY;
      if(side != ON_UNBOUNDED_SIDE && m_surfaces[i].index == 0)
        return is_on_surface ? ON_BOUNDARY : ON_UNBOUNDED_SIDE;
      if(side == ON_BOUNDED_SIDE)
        return ON_BOUNDED_SIDE;
    }
    return index_of(part.background) != 0 ? ON_BOUNDED_SIDE : is_on_surface ? ON_BOUNDARY : ON_UNBOUNDED_SIDE;
  }

  /// The subdomain of a point inside the domain; 0 for others. A point on an interface belongs to the later
  /// subdomain.
  /// \param p point
  /// \param part part as for `bounded_side()`, or as `locate()` filled it for a cell in the interior
  Subdomain_index subdomain_index(const Point_3& p, const Surface_part& part) const
  {
    for(const auto& [i, of_surface] : part.parts) {
      const Bounded_side side = m_surfaces[i].surface->bounded_side(p, of_surface);
      const bool is_on_cavity = side == ON_BOUNDARY && m_surfaces[i].index == 0;
      if(side == ON_BOUNDED_SIDE || is_on_cavity)
        return m_surfaces[i].index;
    }
    return index_of(part.background);
  }

  /// The subdomain of any point; 0 outside.
  /// \par Complexity
  /// A ray through the AABB tree of each surface, until one has the point inside
  Subdomain_index subdomain_index(const Point_3& p) const
  {
    const auto around = std::find_if(m_surfaces.begin(), m_surfaces.end(), [&](const Labeled& s) {
      return s.surface->bounded_side(p) == ON_BOUNDED_SIDE;
    });
    return around == m_surfaces.end() ? 0 : around->index;
  }

  Point_3 closest_point(const Point_3& p, const Surface_part& part) const
  {
    if(part.parts.empty())
      return closest_point(p);
    return nearest(p, part.parts, [&](const auto& one) {
      return m_surfaces[one.first].surface->closest_point(p, one.second);
    });
  }

  Point_3 closest_point(const Point_3& p) const
  {
    return nearest(p, m_surfaces, [&](const Labeled& s) { return s.surface->closest_point(p); });
  }

  Point_3 closest_point(const Point_3& p, const Point_3& hint) const
  {
    return m_surfaces.size() == 1 ? m_surfaces.front().surface->closest_point(p, hint) : closest_point(p);
  }

  /// A point as near as any of the interface between two subdomains, of which the first was added first; or
  /// between a subdomain and the outside, 0. The point is on the surface of the first subdomain, or on that
  /// of a cavity.
  /// \pre `first` is one of `subdomain_indices()`
  Point_3 closest_point(const Point_3& p, Subdomain_index first, Subdomain_index second) const
  {
    if(const Tree* facets = facets_of_interface(first, second))
      return to_point(facets->closest(Mixed_meshes_3::to_vec3(p)));
    return nearest(p, surfaces_of(first, second), [&](const Surface* s) { return s->closest_point(p); });
  }

  /// The closest point of an interface; faster if `hint`, a point of that interface, is near.
  Point_3 closest_point(const Point_3& p, const Point_3& hint, Subdomain_index first,
                        Subdomain_index second) const
  {
    if(const Tree* facets = facets_of_interface(first, second))
      return to_point(facets->closest(Mixed_meshes_3::to_vec3(p), {Mixed_meshes_3::to_vec3(hint), 0}));
    // The hint is on only one of several surfaces.
    const std::vector<const Surface*>& surfaces = surfaces_of(first, second);
    return surfaces.size() == 1 ? surfaces.front()->closest_point(p, hint) : closest_point(p, first, second);
  }

  /// Points of the visible surfaces, like those of `Polyhedral_mixed_mesh_domain_3`.
  std::vector<Point_3> surface_samples(double spacing) const
  {
    std::vector<Point_3> samples;
    for(std::size_t i = 0; i < m_surfaces.size(); ++i)
      add_samples(i, spacing, samples, (std::numeric_limits<std::size_t>::max)());
    return samples;
  }

  /// Points of the visible surfaces of one subdomain, or of the cavities, 0. If they are more than `most`,
  /// only one more than that is found, in less time.
  std::vector<Point_3> surface_samples(double spacing, Subdomain_index index,
                                       std::size_t most = (std::numeric_limits<std::size_t>::max)()) const
  {
    std::vector<Point_3> samples;
    for(std::size_t i = 0; i < m_surfaces.size(); ++i)
      if(m_surfaces[i].index == index)
        add_samples(i, spacing, samples, most);
    return samples;
  }

  /// The shells of the whole surface; nothing if there are several surfaces.
  std::optional<Mixed_meshes_3::Shell_counts> shells() const
  {
    if(m_surfaces.size() != 1)
      return std::nullopt;
    return m_surfaces.front().surface->shells();
  }

  /// The volume inside the surfaces, minus that of cavities. The result is the volume of the domain if no two
  /// surfaces overlap, and cavities are inside.
  double volume() const
  {
    double sum = 0;
    for(const Labeled& s : m_surfaces)
      sum += s.index == 0 ? -s.surface->volume() : s.surface->volume();
    return sum;
  }

  /// Four times the volume divided by the area of the surfaces of a subdomain: for a convex body, the mean
  /// length of the segments that lines have inside.
  double mean_chord_length(Subdomain_index index) const
  {
    double area = 0, volume = 0;
    for(const Labeled& s : m_surfaces)
      if(s.index == index) {
        area += s.surface->area();
        volume += s.surface->volume();
      }
    return 4 * volume / area;
  }

  /// The sharp edges of the surfaces, like those of `Polyhedral_mixed_mesh_domain_3`, where they are between
  /// subdomains or at the boundary, with points where they cross other surfaces and sheets.
  Mixed_meshes_3::Sharp_edges sharp_edges(double angle) const
  {
    if(m_surfaces.size() == 1 && m_sheets.empty())
      return m_surfaces.front().surface->sharp_edges(angle);
    const auto subdomain_at = [this](const Vec3& p) { return subdomain_index(Point_3(p[0], p[1], p[2])); };
    Mixed_meshes_3::internal::Visible_sharp_edges all(subdomain_at);
    for(const Labeled& s : m_surfaces)
      all.add(
        s.surface->surface_edges(angle),
        [&](const Vec3& p, const Vec3& q) {
          return crossings(p, q, m_surfaces, [&](const Labeled& other) {
            return other.surface == s.surface ? nullptr : other.surface.get();
          });
        },
        [&](const Vec3& p, const Vec3& q) {
          return crossings(p, q, m_sheets, [](const auto& sheet) { return sheet.get(); });
        });
    return std::move(all)();
  }

  /// The planes that the surfaces lie in, like those of `Polyhedral_mixed_mesh_domain_3`; nothing if there
  /// are several subdomains.
  Mixed_meshes_3::Axis_parallel_planes axis_parallel_planes() const
  {
    Mixed_meshes_3::Axis_parallel_planes planes;
    for(const Labeled& s : m_surfaces) {
      const Mixed_meshes_3::Axis_parallel_planes more = s.surface->axis_parallel_planes();
      if(more[0].empty() || m_indices.size() > 1)
        return {};
      for(std::size_t k = 0; k < 3; ++k)
        for(const auto& [coordinate, area] : more[k])
          planes[k][coordinate] += area;
    }
    return planes;
  }

  /// \cond SKIP_IN_MANUAL
  // The tree of the surface's closest points; null if there are several surfaces.
  std::shared_ptr<const Mixed_meshes_3::internal::Triangle_tree> tree_of_closest_points() const
  {
    return m_surfaces.size() == 1 ? m_surfaces.front().surface->tree_of_closest_points() : nullptr;
  }
  /// \endcond

private:
  using Tree = Mixed_meshes_3::internal::Triangle_tree;
  using Vec3 = Mixed_meshes_3::Vec3;
  using Corners = std::array<Vec3, 3>;
  using Pair = std::pair<Subdomain_index, Subdomain_index>; // the second one is 0 for the outside

  struct Labeled
  {
    std::shared_ptr<const Polyhedral_mixed_mesh_domain_3> surface;
    Subdomain_index index;
    std::vector<Subdomain_index> behind; // each facet, or 0; empty if no facet is on another surface, too
  };

  struct Hash_of_corners
  {
    std::size_t operator()(const Corners& corners) const
    {
      std::size_t hash = 0;
      for(const Vec3& p : corners)
        for(std::size_t i = 0; i < 3; ++i)
          boost::hash_combine(hash, p[i]);
      return hash;
    }
  };

  static Point_3 to_point(const Tree::Closest& closest)
  {
    return Point_3(closest.point[0], closest.point[1], closest.point[2]);
  }

  // The facets of an interface, if they are common ones of surfaces, or the others of a surface that has
  // such.
  const Tree* facets_of_interface(Subdomain_index first, Subdomain_index second) const
  {
    const auto found = m_interfaces.find({first, second});
    const bool is_elsewhere_as_well = second == 0 && !m_cavities.empty();
    return found == m_interfaces.end() || is_elsewhere_as_well ? nullptr : found->second.get();
  }

  // Finds the facets that the last surface has in common with others.
  void find_common_facets()
  {
    Labeled& last = m_surfaces.back();
    std::unordered_map<Corners, std::size_t, Hash_of_corners> numbers;
    std::set<Subdomain_index> changed;
    for(Labeled& other : m_surfaces) {
      if(other.index == 0 || last.index == 0 || other.index == last.index
         || !CGAL::do_overlap(other.surface->bbox(), last.surface->bbox()))
        continue;
      if(numbers.empty())
        for(std::size_t f = 0; f < last.surface->number_of_facets(); ++f)
          numbers.emplace(sorted_corners(last, f), f);
      for(std::size_t f = 0; f < other.surface->number_of_facets(); ++f) {
        const auto found = numbers.find(sorted_corners(other, f));
        if(found == numbers.end())
          continue;
        for(Labeled* one : {&other, &last})
          one->behind.resize(one->surface->number_of_facets(), 0);
        other.behind[f] = last.index;
        last.behind[found->second] = other.index;
        changed.insert({other.index, last.index});
      }
    }
    std::map<Pair, std::vector<Corners>> interfaces;
    for(const Labeled& one : m_surfaces)
      if(changed.count(one.index) > 0)
        for(std::size_t f = 0; f < one.behind.size(); ++f)
          if(one.behind[f] == 0 || one.behind[f] == last.index)
            interfaces[{one.index, one.behind[f]}].push_back(corners(one, f));
    for(Subdomain_index index : changed)
      m_interfaces.erase({index, 0}); // there may be none left
    for(const auto& [pair, triangles] : interfaces)
      m_interfaces[pair] = std::make_shared<const Tree>(triangles);
  }

  static Corners corners(const Labeled& one, std::size_t facet)
  {
    const auto t = one.surface->facet(facet);
    return {Mixed_meshes_3::to_vec3(t[0]), Mixed_meshes_3::to_vec3(t[1]), Mixed_meshes_3::to_vec3(t[2])};
  }

  static Corners sorted_corners(const Labeled& one, std::size_t facet)
  {
    Corners result = corners(one, facet);
    std::sort(result.begin(), result.end(), [](const Vec3& a, const Vec3& b) {
      return std::lexicographical_compare(&a[0], &a[0] + 3, &b[0], &b[0] + 3);
    });
    return result;
  }

  // The shares of a segment at which it crosses surfaces. \param surface_of returns none for the surface of
  // the segment
  template <class Range, class Surface_of>
  static std::vector<double> crossings(const Vec3& p, const Vec3& q, const Range& range,
                                       const Surface_of& surface_of)
  {
    const Bbox_3 box = Point_3(p[0], p[1], p[2]).bbox() + Point_3(q[0], q[1], q[2]).bbox();
    std::vector<double> all;
    for(const auto& one : range)
      if(const auto* surface = surface_of(one);
         surface != nullptr && CGAL::do_overlap(box, surface->bbox())) {
        const std::vector<double> more = surface->crossings(p, q);
        all.insert(all.end(), more.begin(), more.end());
      }
    return all;
  }

  Subdomain_index index_of(std::size_t surface) const
  {
    return surface < m_surfaces.size() ? m_surfaces[surface].index : 0;
  }

  // Adds the samples of a surface, without samples inside earlier surfaces, until there are more than `most`.
  void add_samples(std::size_t number, double spacing, std::vector<Point_3>& samples, std::size_t most) const
  {
    for(const Point_3& p : m_surfaces[number].surface->surface_samples(spacing)) {
      if(samples.size() > most)
        return;
      if(std::none_of(m_surfaces.begin(), m_surfaces.begin() + std::ptrdiff_t(number), [&](const Labeled& s) {
           return CGAL::do_overlap(p.bbox(), s.surface->bbox())
                  && s.surface->bounded_side(p) == ON_BOUNDED_SIDE;
         }))
        samples.push_back(p);
    }
  }

  template <class Range, class Closest>
  static Point_3 nearest(const Point_3& p, const Range& range, const Closest& closest)
  {
    CGAL_precondition(!range.empty());
    auto one = range.begin();
    Point_3 best = closest(*one);
    while(++one != range.end()) {
      const Point_3 q = closest(*one);
      if(CGAL::compare_squared_distance(p, q, CGAL::squared_distance(p, best)) == SMALLER)
        best = q;
    }
    return best;
  }

  // The surfaces of the interface between a subdomain and a later one, or the outside.
  const std::vector<const Surface*>& surfaces_of(Subdomain_index first, Subdomain_index second) const
  {
    const auto found = m_surfaces_of.find({first, second == 0});
    CGAL_precondition(found != m_surfaces_of.end());
    return found->second;
  }

  std::vector<Labeled> m_surfaces;
  std::map<std::pair<Subdomain_index, bool>, std::vector<const Surface*>> m_surfaces_of; // to the outside?
  std::map<Pair, std::shared_ptr<const Tree>> m_interfaces; // of surfaces with common facets
  std::vector<const Surface*> m_cavities;
  std::vector<Subdomain_index> m_indices;
  std::vector<std::shared_ptr<const Mixed_mesh_sheet_3>> m_sheets;
  Bbox_3 m_bbox;
};

} // namespace CGAL

#endif // CGAL_LABELED_POLYHEDRAL_MIXED_MESH_DOMAIN_3_H
