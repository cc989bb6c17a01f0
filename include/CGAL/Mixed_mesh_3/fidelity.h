// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comparison of a mesh with the solid that its surface bounds: bodies, cavities, handles, volume.

#ifndef CGAL_MIXED_MESH_3_FIDELITY_H
#define CGAL_MIXED_MESH_3_FIDELITY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Nested_shells.h>
#include <CGAL/Mixed_mesh_3/internal/surface/compare_shells.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Validity
/// The topology of a solid, and its volume.
struct Solid_topology
{
  std::size_t number_of_bodies = 0;   ///< connected components of the solid (Betti number 0)
  std::size_t number_of_handles = 0;  ///< sum of the genera of the boundary's components (Betti number 1)
  std::size_t number_of_cavities = 0; ///< closed voids (Betti number 2)
  double volume = 0;                  ///< in the cube of the unit of the points

  /// The Euler characteristic of the boundary: vertices minus edges plus faces.
  std::ptrdiff_t euler_characteristic() const
  {
    return 2 * (std::ptrdiff_t(number_of_bodies + number_of_cavities) - std::ptrdiff_t(number_of_handles));
  }
  /// Whether all numbers are equal.
  bool has_same_topology(const Solid_topology& s) const
  {
    return number_of_bodies == s.number_of_bodies && number_of_handles == s.number_of_handles
           && number_of_cavities == s.number_of_cavities;
  }
};

/// \ingroup PkgMixedMesh3Validity
/// The kinds of differences between a mesh and the solid that the mesh represents.
enum class Solid_difference_kind {
  BODY_MISSING,    ///< no part of a body is meshed
  BODY_ADDED,      ///< there are elements where the solid is not
  BODIES_JOINED,   ///< several bodies are one in the mesh
  BODY_SPLIT,      ///< one body is several in the mesh
  CAVITY_FILLED,   ///< a cavity has elements
  CAVITY_OPENED,   ///< a cavity is connected to the outside of the mesh, or to another void
  CAVITY_ADDED,    ///< the mesh has a cavity where the solid has none
  CAVITIES_JOINED, ///< several cavities are one in the mesh
  CAVITY_SPLIT,    ///< one cavity is several in the mesh
  HANDLES_LOST,    ///< a hole is filled, or a ring cut
  HANDLES_ADDED,   ///< a hole is made, or a gap bridged
  VOLUME           ///< the volume of a body, of a cavity or of all differs by more than the tolerance
};

/// \ingroup PkgMixedMesh3Validity
/// A difference between a mesh and the solid that the mesh represents.
struct Solid_difference
{
  /// The kind of the difference.
  Solid_difference_kind kind;
  Predicates_kernel::Point_3 point; ///< place of the difference, or one of several
  double volume;        ///< volume of the smaller body or cavity concerned, a measure of importance
  std::string sentence; ///< description in English, with the point, without a full stop
};

/// \ingroup PkgMixedMesh3Validity
/// The comparison of a mesh with the solid that the mesh represents.
struct Solid_comparison
{
  Solid_topology surface;                    ///< topology of the solid that the surface bounds
  Solid_topology mesh;                       ///< topology of the mesh
  std::vector<Solid_difference> differences; ///< topology first, then volume; largest volumes first

  /// The ratio of the volume of the mesh to the volume of the surface's solid.
  double ratio_of_volumes() const { return mesh.volume / surface.volume; }
  /// Whether the same bodies, cavities and handles are in the same places.
  bool has_same_topology() const
  {
    return std::all_of(differences.begin(), differences.end(),
                       [](const Solid_difference& d) { return d.kind == Solid_difference_kind::VOLUME; });
  }
};

/// \ingroup PkgMixedMesh3Validity
/// The status of a mesh that follows from a comparison.
inline Mixed_mesh_status status_of(const Solid_comparison& comparison)
{
  return !comparison.has_same_topology()   ? Mixed_mesh_status::TOPOLOGY_DIFFERS
         : !comparison.differences.empty() ? Mixed_mesh_status::VOLUME_DIFFERS
                                           : Mixed_mesh_status::SUCCESS;
}

namespace internal {

inline Solid_topology topology_of(const Nested_shells& shells)
{
  Solid_topology t;
  for(std::size_t r = 0; r < shells.size(); ++r) {
    ++(shells[r].is_cavity() ? t.number_of_cavities : t.number_of_bodies);
    t.number_of_handles += std::size_t(shells[r].genus);
    t.volume += shells[r].is_cavity() ? 0 : shells[r].volume;
  }
  return t;
}

/// Finds the differences between two solids, and describes them in words.
class Solid_comparer
{
  using Kind = Solid_difference_kind;
  using Point_3 = Predicates_kernel::Point_3;
  using Regions = std::vector<std::size_t>;

  const Nested_shells& m_surface;
  const Nested_shells& m_mesh;
  const double m_volume_tolerance, m_least_volume;
  const std::vector<Region_location> m_in_mesh, m_in_surface; // regions of each in the other
  std::vector<Solid_difference> m_differences;

public:
  Solid_comparer(const Nested_shells& surface, const Nested_shells& mesh, double volume_tolerance)
    : m_surface(surface), m_mesh(mesh), m_volume_tolerance(volume_tolerance),
      m_least_volume(volume_share_of_speck * topology_of(surface).volume),
      m_in_mesh(locate_regions(surface, mesh)), m_in_surface(locate_regions(mesh, surface))
  {
  }

  std::vector<Solid_difference> operator()()
  {
    const auto in_surface = indices_at(m_in_surface, m_surface.size());
    for(std::size_t r = 0; r < m_surface.size(); ++r)
      compare_region_of_surface(r, in_surface[r]);
    const auto in_mesh = indices_at(m_in_mesh, m_mesh.size());
    for(std::size_t r = 0; r < m_mesh.size(); ++r)
      compare_region_of_mesh(r, in_mesh[r]);
    std::size_t number_of_pairs = 0;
    for(const Region_group& g : groups(m_in_mesh, m_in_surface))
      if(!g.in_a.empty() && !g.in_b.empty()) {
        compare_handles(g);
        compare_volumes(g);
        ++number_of_pairs;
      }
    compare_all(number_of_pairs);
    std::stable_sort(m_differences.begin(), m_differences.end(), [](const auto& d, const auto& e) {
      return (d.kind == Kind::VOLUME) != (e.kind == Kind::VOLUME) ? e.kind == Kind::VOLUME
                                                                  : d.volume > e.volume;
    });
    return std::move(m_differences);
  }

private:
  static std::string text(double x, int digits)
  {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(digits);
    out << x;
    return out.str();
  }

  static std::string near(const Point_3& p)
  {
    return " near (" + text(p.x(), 6) + ", " + text(p.y(), 6) + ", " + text(p.z(), 6) + ")";
  }

  // The volume in words; nothing is known of the unit of length.
  static std::string of_volume(double volume) { return " of volume " + text(volume, 3) + " cubic units"; }

  static std::string counted(std::size_t n, const char* one, const char* many)
  {
    return std::to_string(n) + " " + (n == 1 ? one : many);
  }

  void add(Kind kind, const Point_3& p, double volume, const std::string& sentence)
  {
    if(volume >= m_least_volume)
      m_differences.push_back({kind, p, volume, sentence});
  }

  static double least_volume(const Nested_shells& shells, const Regions& regions)
  {
    double least = std::numeric_limits<double>::infinity();
    for(std::size_t r : regions)
      least = (std::min)(least, shells[r].volume);
    return least;
  }

  // The point where the first of some regions is nearest to another one.
  static Point_3 smallest_gap(const Nested_shells& shells, const Regions& regions)
  {
    std::pair<Point_3, double> best = shells.gap(regions[1], regions[0]);
    for(std::size_t i = 2; i < regions.size(); ++i) {
      const auto gap = shells.gap(regions[i], regions[0]);
      if(gap.second < best.second)
        best = gap;
    }
    return best.first;
  }

  void compare_region_of_surface(std::size_t r, const Regions& of_mesh)
  {
    const bool is_cavity = m_surface[r].is_cavity();
    if(of_mesh.size() > 1) {
      const Point_3 p = smallest_gap(m_mesh, of_mesh);
      add(is_cavity ? Kind::CAVITY_SPLIT : Kind::BODY_SPLIT, p, least_volume(m_mesh, of_mesh),
          std::string(is_cavity ? "a cavity" : "a body") + " falls into " + std::to_string(of_mesh.size())
            + " pieces" + near(p));
    } else if(of_mesh.empty() && m_in_mesh[r].same == Nested_shells::outside) {
      const Point_3 p = m_in_mesh[r].middle;
      const std::string what = of_volume(m_surface[r].volume) + near(p);
      if(!is_cavity)
        add(Kind::BODY_MISSING, p, m_surface[r].volume, "a piece" + what + " is missing");
      else if(m_in_mesh[r].share_in_solid >= 0.5)
        add(Kind::CAVITY_FILLED, p, m_surface[r].volume, "a cavity" + what + " is filled");
      else
        add(Kind::CAVITY_OPENED, p, m_surface[r].volume, "a cavity" + what + " is open");
    }
  }

  void compare_region_of_mesh(std::size_t r, const Regions& of_surface)
  {
    const bool is_cavity = m_mesh[r].is_cavity();
    if(of_surface.size() > 1) {
      const Point_3 p = smallest_gap(m_surface, of_surface);
      add(is_cavity ? Kind::CAVITIES_JOINED : Kind::BODIES_JOINED, p, least_volume(m_surface, of_surface),
          std::to_string(of_surface.size()) + (is_cavity ? " cavities" : " bodies") + " are joined"
            + near(p));
    } else if(of_surface.empty() && m_in_surface[r].same == Nested_shells::outside) {
      const Point_3 p = m_in_surface[r].middle;
      const std::string what = of_volume(m_mesh[r].volume) + near(p) + " is added";
      add(is_cavity ? Kind::CAVITY_ADDED : Kind::BODY_ADDED, p, m_mesh[r].volume,
          (is_cavity ? "a cavity" : "a piece") + what);
    }
  }

  static std::ptrdiff_t genus(const Nested_shells& shells, const Regions& regions)
  {
    std::ptrdiff_t sum = 0;
    for(std::size_t r : regions)
      sum += shells[r].genus;
    return sum;
  }

  static double volume(const Nested_shells& shells, const Regions& regions)
  {
    double sum = 0;
    for(std::size_t r : regions)
      sum += shells[r].volume;
    return sum;
  }

  // The point where most of the solid is missing or added.
  Point_3 largest_error(const Region_group& g) const
  {
    const Nested_shells::Sample* worst = &m_in_mesh[g.in_a.front()].elsewhere;
    for(std::size_t r : g.in_a)
      if(m_in_mesh[r].elsewhere.length > worst->length)
        worst = &m_in_mesh[r].elsewhere;
    for(std::size_t r : g.in_b)
      if(m_in_surface[r].elsewhere.length > worst->length)
        worst = &m_in_surface[r].elsewhere;
    return worst->length > 0 ? worst->point : m_in_mesh[g.in_a.front()].middle;
  }

  void compare_handles(const Region_group& g)
  {
    const std::ptrdiff_t lost = genus(m_surface, g.in_a) - genus(m_mesh, g.in_b);
    if(lost == 0)
      return;
    const Point_3 p = largest_error(g);
    add(lost > 0 ? Kind::HANDLES_LOST : Kind::HANDLES_ADDED, p, volume(m_surface, g.in_a),
        counted(std::size_t(std::abs(lost)), "handle", "handles")
          + (lost == 1 || lost == -1 ? " is " : " are ") + (lost > 0 ? "lost" : "added") + near(p));
  }

  bool is_beyond_tolerance(double ratio) const { return !(std::abs(ratio - 1) <= m_volume_tolerance); }

  static std::string change(double ratio)
  {
    return text(100 * std::abs(ratio - 1), 3) + " % " + (ratio < 1 ? "less" : "more");
  }

  void compare_volumes(const Region_group& g)
  {
    const double of_surface = volume(m_surface, g.in_a);
    const double ratio = volume(m_mesh, g.in_b) / of_surface;
    if(!is_beyond_tolerance(ratio))
      return;
    const bool is_cavity = m_surface[g.in_a.front()].is_cavity();
    const Point_3 p = largest_error(g);
    add(Kind::VOLUME, p, of_surface,
        std::string(is_cavity ? "a cavity" : "a body") + near(p) + " has " + change(ratio) + " volume");
  }

  // Compares the whole solids, unless there is only one body, which has been compared already.
  void compare_all(std::size_t number_of_pairs)
  {
    const Solid_topology surface = topology_of(m_surface), mesh = topology_of(m_mesh);
    const double ratio = mesh.volume / surface.volume;
    if(!is_beyond_tolerance(ratio) || (number_of_pairs == 1 && m_surface.size() == 1 && m_mesh.size() == 1))
      return;
    const auto farther = [](const Region_location& l, const Region_location& m) {
      return l.elsewhere.length < m.elsewhere.length;
    };
    const Region_location& lost = *std::max_element(m_in_mesh.begin(), m_in_mesh.end(), farther);
    const Region_location& added = *std::max_element(m_in_surface.begin(), m_in_surface.end(), farther);
    const Region_location& worst = farther(lost, added) ? added : lost;
    const Point_3 p = worst.elsewhere.length > 0 ? worst.elsewhere.point : worst.middle;
    add(Kind::VOLUME, p, surface.volume,
        "the volume of all bodies is " + change(ratio) + ", for example" + near(p));
  }
};

/// As `compare_with_surface()`.
/// \param boundary boundary of the mesh
template <class FaceListGraph, class NamedParameters = parameters::Default_named_parameters>
Solid_comparison compare_boundary(const Triangle_soup& boundary, const FaceListGraph& surface,
                                  double volume_tolerance,
                                  const NamedParameters& np = parameters::default_values())
{
  CGAL_precondition(volume_tolerance > 0);
  const Nested_shells of_surface(surface_triangles(surface, np)), of_mesh(boundary);
  return {topology_of(of_surface), topology_of(of_mesh),
          Solid_comparer(of_surface, of_mesh, volume_tolerance)()};
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3Validity

\brief Compares a mesh with the solid that a closed surface bounds: bodies, cavities, handles, volumes.

The boundary of the mesh and the surface are cut into connected components, their *shells*. A shell inside an
even number of others bounds a body, a shell inside an odd number bounds a cavity; the orientation of faces
does not matter. Handles are the genera of shells, by their Euler characteristics. So the numbers of both
sides are exact. The correspondence of bodies, and of cavities, of the mesh and of the surface is found by
point location: points in the middle of chords, at right angles to each shell, about 2,000 for all, are
located in the solid of the other side. A body, or cavity, belongs to the body or cavity that most of it is
in. The correspondence is reliable for parts that are thicker than the distance between the surface and the
boundary of the mesh; bodies that are nowhere so thick may be called missing and added instead.

Specks, parts of less than 10^-6 of the volume, are counted, but are no differences. Equal numbers do not hide
differences: a missing body and another body that falls into two are both reported.
Not detected are the loss of a part of a body without a change of topology, unless the volume tells (see
`hausdorff_distance()`), and knots: a ring that is tied differently has the same handles.

Quadrilaterals on the boundary are split into two triangles, through their vertex of smallest index.

\tparam Mesh a `Mixed_mesh_3`
\tparam FaceListGraph a model of `FaceListGraph`, with points of any CGAL kernel
\param mesh the mesh. \pre not empty, and its boundary is a closed 2-manifold
       (`Mesh_defects::closed_manifold_boundary()`)
\param surface the surface. \pre triangulated, closed, not empty, and free of self-intersections; shells may
       touch in vertices
\param volume_tolerance tolerated difference of the volumes of the solids, and of the bodies and cavities that
belong to each other, relative to the volumes of the surface
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of `surface`}
    \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
    \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\par Complexity
O(n log n) for n triangles, and O(s^2) comparisons of boxes for s shells
*/
template <class Mesh, class FaceListGraph, class NamedParameters = parameters::Default_named_parameters>
Solid_comparison compare_with_surface(const Mesh& mesh, const FaceListGraph& surface,
                                      double volume_tolerance = 0.05,
                                      const NamedParameters& np = parameters::default_values())
{
  return internal::compare_boundary(internal::boundary_triangles(mesh), surface, volume_tolerance, np);
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_FIDELITY_H
