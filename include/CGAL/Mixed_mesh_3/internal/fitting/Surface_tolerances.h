// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tolerated distances of the surfaces of a domain from the mesh, and samples of the surfaces for measurement.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_TOLERANCES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_TOLERANCES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

struct Surface_sample
{
  Vec3 point;
  double tolerance;
};

/*!
One tolerance for the outer surface; the tolerances of inner subdomains are smaller, as a tumor or a ventricle
may be no larger than what a brain may lack at its furrows. The volume that a convex body with n vertices
loses is in proportion to its area times \f$ n^{-2/3} \f$, and area by volume is four by the mean chord
(Cauchy): the tolerance is a multiple of the mean chord times \f$ n^{-2/3} \f$.
*/
class Surface_tolerances
{
  double m_tolerance;
  std::size_t m_number_of_vertices;
  std::map<Subdomain_index, double> m_smaller;

  // Multiple of the mean chord: with a smaller one, the parts of a brain would take cells that its surface
  // and the region lack. With half and twice of it, 17 of 18 meshes are the same (constants.md).
  static constexpr double share_of_chord = 3;
  // Number of samples: about ten samples of a face are enough; ordinary surfaces and few subdomains have
  // fewer.
  static constexpr std::size_t samples_per_vertex = 20, least_samples = 50000;

public:
  Surface_tolerances(const Any_surface& domain, double tolerance, std::size_t number_of_vertices)
    : m_tolerance(tolerance), m_number_of_vertices(number_of_vertices)
  {
    if(domain.is_labeled())
      for(Subdomain_index index : domain.subdomain_indices())
        if(index != domain.subdomain_indices().back())
          m_smaller[index] = (std::min)(tolerance, share_of_chord * domain.mean_chord_length(index)
                                                     * std::pow(double(number_of_vertices), -2. / 3));
  }

  /// Enlarges smaller tolerances to at least `double(Subdomain_index)`.
  template <class Least>
  void enlarge(const Least& least)
  {
    for(auto& [index, tolerance] : m_smaller)
      tolerance = (std::min)(m_tolerance, (std::max)(tolerance, least(index)));
  }

  /// \param first the first subdomain of an interface
  double operator()(Subdomain_index first) const
  {
    const auto found = m_smaller.find(first);
    return found == m_smaller.end() ? m_tolerance : found->second;
  }

  /// Weight of a distance, relative to a distance at the outer surface.
  double weight(Subdomain_index first) const { return m_tolerance > 0 ? m_tolerance / (*this)(first) : 1; }

  /// \param least_spacing `double(Subdomain_index)`: closer samples would not serve; else, samples are at a
  ///        distance of twice the tolerance, as closer samples are rarely farther from the mesh
  template <class Spacing>
  std::vector<Surface_sample> samples(const Any_surface& domain, const Spacing& least_spacing) const
  {
    std::vector<Surface_sample> result;
    const auto add = [&](const auto& points, double tolerance) {
      for(const auto& p : points)
        result.push_back({to_vec3(p), tolerance});
    };
    if(domain.is_labeled()) {
      std::vector<Subdomain_index> indices = domain.subdomain_indices();
      indices.push_back(0);
      for(Subdomain_index index : indices)
        add(domain.surface_samples((std::max)(2 * (*this)(index), least_spacing(index)), index),
            (*this)(index));
    } else {
      add(domain.surface_samples((std::max)(2 * m_tolerance, least_spacing(1))), m_tolerance);
    }
    thin_out(result);
    return result;
  }

private:
  using Kernel = CGAL::Simple_cartesian<double>;

  // The point of a sample: a property map, so that the samples themselves are sorted.
  struct Point_of_sample
  {
    using key_type = Surface_sample;
    using value_type = Kernel::Point_3;
    using reference = value_type;
    using category = boost::readable_property_map_tag;
    friend value_type get(const Point_of_sample&, const Surface_sample& s)
    {
      return {s.point[0], s.point[1], s.point[2]};
    }
  };

  // Thins out the samples of many subdomains, and of surfaces much finer than the mesh, evenly, as they are
  // sorted along a curve; queries in succession are faster then, too.
  void thin_out(std::vector<Surface_sample>& samples) const
  {
    const std::size_t most = samples_per_vertex * m_number_of_vertices + least_samples,
                      step = samples.size() / most + 1;
    if(step == 1)
      return;
    sort_along_curve(samples);
    std::size_t n = 0;
    for(std::size_t i = 0; i < samples.size(); i += step)
      samples[n++] = samples[i];
    samples.erase(samples.begin() + std::ptrdiff_t(n), samples.end());
  }

  static void sort_along_curve(std::vector<Surface_sample>& samples)
  {
    CGAL::hilbert_sort(samples.begin(), samples.end(),
                       CGAL::Spatial_sort_traits_adapter_3<Kernel, Point_of_sample>(Point_of_sample()),
                       CGAL::Hilbert_sort_middle_policy());
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_TOLERANCES_H
