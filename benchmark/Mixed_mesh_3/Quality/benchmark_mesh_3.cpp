// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The peer: CGAL's Mesh_3 on the same input, with as many vertices. Prints a line of JSON with the
// measures of mesh_measures.h; `--help` tells the options.
//
// Tuning (lengths in the unit of the surface):
// - Sizes bound the circumradii of boundary facets and of tetrahedra alike: by h in the region of interest,
//   by min(h + growth d, largest) at the distance d from it. A search finds the h that gives the wanted
//   number of vertices.
// - Facets are at most `facet_distance` away from the surface (in the sense of Mesh_3: the circumcenter
//   from the center of the surface Delaunay ball); in the region, sizes are far below it.
// - Growth, largest size and facet distance: of some twenty combinations tried with 660 vertices (and exact
//   distances from the region), the one with the smallest Hausdorff distance, 5.1 mm, among those with more
//   than a quarter of the vertices in the region. It varies by half a millimeter between like settings.
// - Facet angles of 25 degrees and a radius-edge ratio of 2: with 660 vertices, 15 to 30 degrees and 1.6 to 3
//   have Hausdorff distances of 5.1 to 8.1 mm, and a mean ARC within 0.01.
// - With `--features`, sharp edges are protected by balls; the facet distance is a share of the size.
// - Perturbation and exudation have no time limit, and go on as long as they improve the worst angle.
//
// Times are those of making the mesh with the h found; the AABB trees and the sizing field are part of it,
// reading files and the search are not.

#include "mesh_measures.h"

#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/cells_in_complex_3_to_mixed_mesh.h>

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/make_mesh_3.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Mesh_measures::Kernel;
using Mesh_measures::Point;
using Mesh_measures::Side_of_surface;
using Mesh_measures::Surface;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

using Domain = CGAL::Polyhedral_mesh_domain_3<Surface, Kernel>;
using Domain_with_features = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Surface>;

/// Sizes, by default for the bundled brain, in millimeters.
struct Sizes
{
  double in_region = 0;
  double growth = 0.4;
  double largest = 20;
  double facet_distance = 4;
  double facet_angle = 25;
  double radius_edge_ratio = 2;
  double features = 0; // the angle between normals from which on edges are sharp, in degrees; 0: none are
};

/*!
\brief The signed distance from the region, negative inside, interpolated in a grid of 48 cells along
the diagonal of the domain's box.

Values are computed when they are first needed. Mesh_3 asks for far more sizes than there are grid points:
with exact distances, refinement to 10,000 vertices took two to three times as long.
*/
class Distance_grid
{
  Mesh_measures::Tree m_tree;
  Side_of_surface m_side;
  Point m_origin;
  double m_step;
  std::array<int, 3> m_sizes;
  std::vector<float> m_values; // NaN: not computed yet

  double value(const std::array<int, 3>& i)
  {
    float& v = m_values[(std::size_t(i[2]) * m_sizes[1] + i[1]) * m_sizes[0] + i[0]];
    if(std::isnan(v)) {
      const Point p = m_origin + m_step * Kernel::Vector_3(i[0], i[1], i[2]);
      v = float(std::sqrt(m_tree.squared_distance(p)));
      if(m_side(p) != CGAL::ON_UNBOUNDED_SIDE)
        v = -v;
    }
    return v;
  }

public:
  Distance_grid(const Surface& region_surface, const CGAL::Bbox_3& box)
    : m_side(Mesh_measures::build(m_tree, region_surface)), m_origin(box.xmin(), box.ymin(), box.zmin())
  {
    const double extents[3] = {box.x_span(), box.y_span(), box.z_span()};
    m_step = std::hypot(extents[0], extents[1], extents[2]) / 48;
    for(int k = 0; k < 3; ++k)
      m_sizes[k] = int(extents[k] / m_step) + 2;
    m_values.assign(std::size_t(m_sizes[0]) * m_sizes[1] * m_sizes[2], std::nanf(""));
  }

  /// The distance at a point; outside the box, at the closest point of the box.
  double operator()(const Point& p)
  {
    std::array<int, 3> i;
    double t[3];
    for(int k = 0; k < 3; ++k) {
      const double x = (std::clamp)((p[k] - m_origin[k]) / m_step, 0., double(m_sizes[k] - 1));
      i[k] = (std::min)(int(x), m_sizes[k] - 2);
      t[k] = x - i[k];
    }
    double sum = 0;
    for(int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::array<int, 3> j = i;
      for(int k = 0; k < 3; ++k) {
        const bool is_upper = (corner >> k & 1) != 0;
        j[k] += is_upper;
        weight *= is_upper ? t[k] : 1 - t[k];
      }
      if(weight > 0)
        sum += weight * value(j);
    }
    return sum;
  }
};

/// Model of `MeshDomainField_3`: the bound on circumradii.
template <class Index_>
class Sizing_field
{
  Distance_grid* m_distance;
  Sizes m_sizes;

public:
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  using Index = Index_;

  Sizing_field(Distance_grid& distance, const Sizes& sizes) : m_distance(&distance), m_sizes(sizes) {}

  FT operator()(const Point_3& p, int, const Index&) const
  {
    if(m_sizes.growth == 0)
      return (std::min)(m_sizes.in_region, m_sizes.largest);
    return (std::min)(m_sizes.in_region + m_sizes.growth * (std::max)(0., (*m_distance)(p)), m_sizes.largest);
  }
};

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Result
{
  Mesh mesh;
  double cpu_seconds_of_refinement = 0, cpu_seconds_of_perturbation = 0, cpu_seconds_of_exudation = 0;
  double cpu_seconds = 0; // of all
};

/// Makes a mesh of a domain; `start` is when the making of the domain began.
template <class D>
Result make_mesh(const D& domain, const Surface& region_surface, const Sizes& sizes, bool with_perturbation,
                 double start)
{
  namespace params = CGAL::parameters;
  using Triangulation = typename CGAL::Mesh_triangulation_3<D>::type;
  using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
  Result result;
  const double first = start;
  const auto lap = [&start] {
    const double last = std::exchange(start, cpu_seconds());
    return start - last;
  };
  Distance_grid distance(region_surface, domain.bbox());
  const Sizing_field<typename D::Index> size(distance, sizes);
  const typename Criteria::Facet_criteria facets(sizes.facet_angle, size,
                                                 sizes.facet_distance
                                                   * (sizes.features > 0 ? sizes.in_region : 1));
  const typename Criteria::Cell_criteria cells(sizes.radius_edge_ratio, size);
  const auto make = [&](auto complex, const Criteria& criteria) {
    complex = CGAL::make_mesh_3<decltype(complex)>(domain, criteria, params::no_perturb(),
                                                   params::no_exude());
    result.cpu_seconds_of_refinement = lap();
    if(with_perturbation) {
      CGAL::perturb_mesh_3(complex, domain);
      result.cpu_seconds_of_perturbation = lap();
      CGAL::exude_mesh_3(complex);
      result.cpu_seconds_of_exudation = lap();
    }
    result.cpu_seconds = cpu_seconds() - first;
    CGAL::cells_in_complex_3_to_mixed_mesh(complex, result.mesh);
  };
  if constexpr(std::is_same_v<D, Domain_with_features>)
    make(CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, typename D::Corner_index,
                                                 typename D::Curve_index>(),
         Criteria(typename Criteria::Edge_criteria(size), facets, cells));
  else
    make(CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>(), Criteria(facets, cells));
  return result;
}

/// Makes a mesh from surfaces in memory; AABB trees are part of the measured time.
Result make_mesh(const Surface& surface, const Surface& region_surface, const Sizes& sizes,
                 bool with_perturbation)
{
  const double start = cpu_seconds();
  CGAL::Random random(0);
  if(sizes.features == 0)
    return make_mesh(Domain(surface, &random), region_surface, sizes, with_perturbation, start);
  Domain_with_features domain(surface, &random);
  domain.detect_features(sizes.features);
  return make_mesh(domain, region_surface, sizes, with_perturbation, start);
}

/// The size in the region for which the number of vertices is closest to the wanted one. The number
/// decreases with the size, but not strictly: a bracketing search, and the best size met.
double find_size_in_region(const Surface& surface, const Surface& region_surface, Sizes sizes,
                           std::size_t wanted)
{
  struct Trial
  {
    double log_size, log_excess; // of vertices over the wanted number
  };
  const auto make = [&](double log_size) {
    sizes.in_region = std::exp(log_size);
    const Mesh mesh = make_mesh(surface, region_surface, sizes, false).mesh;
    std::cerr << "size in region " << sizes.in_region << ": " << mesh.number_of_vertices() << " vertices\n";
    return Trial{log_size, std::log(double(mesh.number_of_vertices()) / double(wanted))};
  };
  Trial few = make(std::log(sizes.largest));
  if(few.log_excess > 0)
    throw std::runtime_error("the largest size gives more vertices than wanted");
  Trial many = few;
  while(many.log_excess < 0) { // in small steps: no trial shall have many more vertices than wanted
    few = many;
    many = make(few.log_size - 0.4);
  }
  const auto better = [](const Trial& a, const Trial& b) {
    return std::abs(a.log_excess) < std::abs(b.log_excess) ? a : b;
  };
  Trial best = better(few, many);
  for(int i = 0; i < 12 && std::abs(best.log_excess) > 0.003; ++i) {
    const double t = (std::clamp)(few.log_excess / (few.log_excess - many.log_excess), 0.1, 0.9);
    const Trial trial = make(few.log_size + t * (many.log_size - few.log_size));
    (trial.log_excess > 0 ? many : few) = trial;
    best = better(trial, best);
  }
  return std::exp(best.log_size);
}

/// A surface scaled about the center of its box.
Surface scaled(Surface surface, double factor)
{
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(surface);
  const Point center = CGAL::midpoint(Point((box.min)(0), (box.min)(1), (box.min)(2)),
                                      Point((box.max)(0), (box.max)(1), (box.max)(2)));
  for(auto v : surface.vertices())
    surface.point(v) = center + factor * (surface.point(v) - center);
  return surface;
}

int main(int argc, char** argv)
try {
  CLI::App app("Makes a mesh of tetrahedra by CGAL's Mesh_3 and measures it.");
  std::string surface_file, region_file, output_file;
  std::size_t number_of_vertices = 0;
  Sizes sizes;
  double region_scale = 1;
  bool no_perturb_exude = false, only_time = false;
  app.add_option("surface", surface_file, "closed surface of the domain")->required();
  app.add_option("region", region_file, "closed surface of the region of interest")->required();
  app.add_option("vertices", number_of_vertices, "vertices wanted")->required()->check(CLI::PositiveNumber);
  app.add_option("--size-in-region", sizes.in_region, "size in the region; found by a search if not given");
  app.add_option("--growth", sizes.growth, "of the size with the distance from the region")
    ->capture_default_str();
  app.add_option("--region-scale", region_scale, "sizes are those of the region scaled about its center")
    ->capture_default_str();
  app.add_option("--largest", sizes.largest, "largest size")->capture_default_str();
  app.add_option("--facet-distance", sizes.facet_distance, "of facets from the surface")
    ->capture_default_str();
  app.add_option("--facet-angle", sizes.facet_angle, "smallest, degrees")->capture_default_str();
  app.add_option("--radius-edge-ratio", sizes.radius_edge_ratio, "largest")->capture_default_str();
  app.add_option("--features", sizes.features,
                 "protect edges between facets whose normals differ by more degrees; --facet-distance is a "
                 "share of the size then");
  app.add_flag("--no-perturb-exude", no_perturb_exude, "leave slivers in the mesh");
  app.add_option("--output", output_file, "also write the mesh, to a .vtu file for example");
  app.add_flag("--only-time", only_time, "measure the time only");
  CLI11_PARSE(app, argc, argv);

  Surface surface, region_surface;
  require([&](std::string* error) { return mm3::IO::read_closed_surface(surface_file, surface, error); });
  require(
    [&](std::string* error) { return mm3::IO::read_closed_surface(region_file, region_surface, error); });

  const Surface fine_surface = scaled(region_surface, region_scale);
  if(sizes.in_region <= 0)
    sizes.in_region = find_size_in_region(surface, fine_surface, sizes, number_of_vertices);
  const Result result = make_mesh(surface, fine_surface, sizes, !no_perturb_exude);
  const Mesh& mesh = result.mesh;

  nlohmann::ordered_json line = {{"mesher", "Mesh_3"},
                                 {"perturb and exude", !no_perturb_exude},
                                 {"wanted vertices", number_of_vertices},
                                 {"vertices", mesh.number_of_vertices()},
                                 {"size in region", sizes.in_region},
                                 {"growth", sizes.growth},
                                 {"region scale", region_scale},
                                 {"largest", sizes.largest},
                                 {"facet distance", sizes.facet_distance},
                                 {"facet angle", sizes.facet_angle},
                                 {"radius-edge ratio", sizes.radius_edge_ratio},
                                 {"CPU seconds", result.cpu_seconds},
                                 {"CPU seconds of refinement", result.cpu_seconds_of_refinement},
                                 {"CPU seconds of perturbation", result.cpu_seconds_of_perturbation},
                                 {"CPU seconds of exudation", result.cpu_seconds_of_exudation}};
  Mesh_measures::finish(line, mesh, surface, region_surface, only_time, output_file);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "benchmark_mesh_3: " << e.what() << '\n';
  return 1;
}
