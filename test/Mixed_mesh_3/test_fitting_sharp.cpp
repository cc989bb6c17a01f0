// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sharp edges: boxes between lattice planes, detection of features, and meshes that keep features.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <random>
#include <utility>
#include <vector>

namespace test_fitting_sharp {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
namespace mm3 = CGAL::Mixed_meshes_3;

using Polygon = std::vector<std::array<double, 2>>;

// A prism over a counter-clockwise polygon, all of which is visible from its first vertex.
Surface prism(const Polygon& base, double height)
{
  Surface s;
  const std::size_t n = base.size();
  std::vector<Surface::Vertex_index> v;
  for(double z : {0., height})
    for(const auto& p : base)
      v.push_back(s.add_vertex(Point(p[0], p[1], z)));
  for(std::size_t i = 1; i + 1 < n; ++i) {
    s.add_face(v[0], v[i + 1], v[i]);
    s.add_face(v[n], v[n + i], v[n + i + 1]);
  }
  for(std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    s.add_face(v[i], v[j], v[n + j]);
    s.add_face(v[i], v[n + j], v[n + i]);
  }
  return s;
}

Surface box(const Point& corner, double a, double b, double c)
{
  Surface s = prism({{0, 0}, {a, 0}, {a, b}, {0, b}}, c);
  for(const auto v : s.vertices())
    s.point(v) = s.point(v) + (corner - CGAL::ORIGIN);
  return s;
}

// The surface turned about axes by odd angles.
Surface turned(Surface s)
{
  for(const auto v : s.vertices()) {
    std::array<double, 3> p{s.point(v).x(), s.point(v).y(), s.point(v).z()};
    int k = 0;
    for(double angle : {0.37, 0.61, 0.23}) {
      double &x = p[std::size_t(k)], &y = p[std::size_t((k + 1) % 3)];
      const double new_x = std::cos(angle) * x - std::sin(angle) * y;
      y = std::sin(angle) * x + std::cos(angle) * y;
      x = new_x;
      ++k;
    }
    s.point(v) = Point(p[0], p[1], p[2]);
  }
  return s;
}

Polygon circle(std::size_t n)
{
  Polygon p;
  for(std::size_t i = 0; i < n; ++i)
    p.push_back({std::cos(2 * M_PI * double(i) / double(n)), std::sin(2 * M_PI * double(i) / double(n))});
  return p;
}

double volume(const Mesh& mesh)
{
  double sum = 0;
  for(const mm3::Face& face : mm3::boundary_faces(mesh)) {
    const auto& v = face.vertices();
    for(int i = 2; i < v.size(); ++i)
      sum += CGAL::volume(mesh.point(0), mesh.point(v[0]), mesh.point(v[i - 1]), mesh.point(v[i]));
  }
  return sum;
}

bool is_hexahedral(const Mesh& mesh)
{
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    if(mesh.element(mm3::Element_index(e)).kind() != mm3::HEXAHEDRON)
      return false;
  return true;
}

bool has_vertex(const Mesh& mesh, const Point& p)
{
  return std::find(mesh.points().begin(), mesh.points().end(), p) != mesh.points().end();
}

// The length of the segment that edges of the boundary cover, from 0 to 1.
double covered(const Mesh& mesh, const Point& a, const Point& b)
{
  const double whole = CGAL::squared_distance(a, b);
  const auto is_on = [&](const Point& p) {
    return CGAL::squared_distance(p, Kernel::Segment_3(a, b)) < 1e-20 * whole;
  };
  double sum = 0; // of both faces of each edge
  for(const mm3::Face& face : mm3::boundary_faces(mesh)) {
    const auto& v = face.vertices();
    for(int i = 0; i < v.size(); ++i) {
      const Point &p = mesh.point(v[i]), &q = mesh.point(v[(i + 1) % v.size()]);
      if(is_on(p) && is_on(q))
        sum += std::sqrt(CGAL::squared_distance(p, q) / whole) / 2;
    }
  }
  return sum;
}

void test_boxes()
{
  struct Case
  {
    Point corner;
    double a, b, c;
    double largest_ratio;
  };
  for(const Case& t :
      {Case{Point(0, 0, 0), 1, 1, 1, 1}, Case{Point(10.3, -7.7, 1000.1), 3, 2, 1, 1},
       Case{Point(0.1, 0.2, 0.3), 1, 0.77, 0.53, 1.25}, Case{Point(-1, 0, 2), 20, 15, 1, 1}}) {
    const Surface s = box(t.corner, t.a, t.b, t.c);
    for(std::size_t n : {500, 2000}) {
      Mesh mesh;
      const auto result = CGAL::make_mixed_mesh_3(s, n, mesh);
      BOOST_TEST(result.status == CGAL::Mixed_mesh_status::SUCCESS);
      BOOST_TEST(result.is_lattice_on_surface);
      BOOST_TEST(is_hexahedral(mesh));
      BOOST_TEST(mesh.number_of_vertices() <= n && mesh.number_of_vertices() >= n / 3);
      BOOST_TEST(std::abs(volume(mesh) - t.a * t.b * t.c) < 1e-12 * 1000 * t.a * t.b * t.c);
      for(const auto v : s.vertices())
        BOOST_TEST(has_vertex(mesh, s.point(v)));
    }
  }
}

// Cells that are no cubes: walls thinner than the cubes of the budget, and planes on no common lattice.
void test_flat_cells()
{
  struct Case
  {
    Polygon outline;
    double height, largest_ratio;
    std::size_t number_of_vertices;
  };
  const Polygon angle{{0, 0}, {1.9, 0}, {1.9, 0.119}, {0.137, 0.119}, {0.137, 1.31}, {0, 1.31}},
    thin_angle{{0, 0}, {1, 0}, {1, 0.03}, {0.04, 0.03}, {0.04, 0.7}, {0, 0.7}};
  for(const Case& t : {Case{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.02, 1.7, 2000}, Case{angle, 2.71, 1.2, 2000},
                       Case{thin_angle, 3.3, 3, 2000}, Case{thin_angle, 3.3, 7, 500},
                       Case{{{0, 0}, {2, 0}, {2, 3}, {0, 3}}, 0.003, 40, 1000}}) {
    const Surface s = prism(t.outline, t.height);
    Mesh mesh;
    const auto result = CGAL::make_mixed_mesh_3(s, t.number_of_vertices, mesh);
    BOOST_TEST(result.status == CGAL::Mixed_mesh_status::SUCCESS);
    BOOST_TEST(result.is_lattice_on_surface && is_hexahedral(mesh));
    BOOST_TEST(mesh.number_of_vertices() <= t.number_of_vertices);
    BOOST_TEST(mesh.number_of_vertices() >= 0.6 * double(t.number_of_vertices));
    const double exact = CGAL::Polygon_mesh_processing::volume(s);
    BOOST_TEST_LT(std::abs(volume(mesh) / exact - 1), 1e-12);
    for(const auto v : s.vertices())
      BOOST_TEST(has_vertex(mesh, s.point(v)));
    const double arc = mm3::quality_statistics(mesh).back().maximum;
    BOOST_TEST_LE(arc, t.largest_ratio);
    // A bound that cannot be met is told.
    const bool is_flat = arc > CGAL::Mixed_mesh_criteria_3(1).quality_bound();
    BOOST_TEST_EQ(is_flat, t.largest_ratio > 3.2);
    BOOST_TEST_EQ(result.optimization.number_of_elements_above_bound,
                  mm3::number_of_elements_above(mesh, result.optimization.quality_bound));
    BOOST_TEST_EQ(result.optimization.number_of_elements_above_bound > 0, is_flat);
    BOOST_TEST(is_flat ? result.quality_bound >= arc
                       : result.quality_bound == result.optimization.quality_bound);
  }
  // A bound that is to be kept has no flat cells, with whatever result.
  Mesh mesh;
  const auto strict = CGAL::make_mixed_mesh_3(prism({{0, 0}, {2, 0}, {2, 3}, {0, 3}}, 0.03),
                                              CGAL::Mixed_mesh_criteria_3(200).strict_quality_bound(true),
                                              mesh);
  BOOST_TEST(!strict.is_lattice_on_surface);
  BOOST_TEST_EQ(strict.optimization.number_of_elements_above_bound, 0u);
}

// A lattice in several planes, and with a finer part.
void test_lattice_with_region()
{
  const Surface l = prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1);
  Mesh mesh;
  BOOST_TEST(CGAL::make_mixed_mesh_3(l, 2000, mesh).is_lattice_on_surface);
  BOOST_TEST(is_hexahedral(mesh));
  BOOST_TEST(std::abs(volume(mesh) - 3) < 1e-12);

  const Surface cube = box(Point(0, 0, 0), 1, 1, 1);
  const CGAL::Ball_mixed_mesh_region_3 ball(Point(1, 1, 1), 0.3);
  const auto result = CGAL::make_mixed_mesh_3(CGAL::Polyhedral_mixed_mesh_domain_3(cube), ball,
                                              CGAL::Mixed_mesh_criteria_3(1500), mesh);
  BOOST_TEST(!result.is_lattice_on_surface && result.has_mesh());
  BOOST_TEST(mesh.number_of_vertices() > 1200);
  BOOST_TEST(std::abs(volume(mesh) - 1) < 1e-12);

  // The edges are cut off without sharp features.
  CGAL::make_mixed_mesh_3(cube, CGAL::Mixed_mesh_criteria_3(1500).sharp_angle(0), mesh);
  BOOST_TEST(!is_hexahedral(mesh) && volume(mesh) < 1 - 1e-4);
}

void test_turned_cube()
{
  const Surface s = turned(box(Point(0, 0, 0), 1, 1, 1));
  Mesh mesh;
  const auto result = CGAL::make_mixed_mesh_3(s, 1500, mesh);
  BOOST_TEST(result.has_mesh() && mm3::find_defects(mesh).none());
  BOOST_TEST_EQ(result.optimization.number_of_corners, 8u);
  BOOST_TEST_EQ(result.optimization.number_of_corners_kept, 8u);
  BOOST_TEST(std::abs(result.optimization.length_of_sharp_edges - 12) < 1e-9);
  BOOST_TEST(result.optimization.length_of_sharp_edges_kept > 0.95 * 12);
  BOOST_TEST(std::abs(volume(mesh) - 1) < 1e-3);
  double length = 0;
  for(const auto e : s.edges()) {
    const Point &p = s.point(s.vertex(e, 0)), &q = s.point(s.vertex(e, 1));
    if(std::abs(CGAL::squared_distance(p, q) - 1) < 1e-9) // no diagonal
      length += covered(mesh, p, q);
  }
  BOOST_TEST(std::abs(length - result.optimization.length_of_sharp_edges_kept) < 0.01);
}

// Edges and corners of acute angles: flips let vertices reach them, and the vertex nearest to an acute corner
// is several edges away.
void test_acute_angles()
{
  const std::array<std::array<Point, 4>, 2> tetrahedra{
    {{Point(0, 0, 0), Point(1, 1, 0), Point(0, 1, 0), Point(0, 0, 1)},
     {Point(1, 1, 1), Point(-1, 1, -1), Point(1, -1, -1), Point(-1, -1, 1)}}};
  double kept = 0, length = 0;
  std::size_t corners = 0;
  for(const auto& p : tetrahedra)
    for(bool is_turned : {false, true}) {
      Surface s;
      std::array<Surface::Vertex_index, 4> v;
      for(std::size_t i = 0; i < 4; ++i)
        v[i] = s.add_vertex(p[i]);
      for(const auto& f : {std::array<std::size_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
        s.add_face(v[f[0]], v[f[1]], v[f[2]]);
      if(CGAL::Polygon_mesh_processing::volume(s) < 0)
        CGAL::Polygon_mesh_processing::reverse_face_orientations(s);
      Mesh mesh;
      const auto result = CGAL::make_mixed_mesh_3(is_turned ? turned(s) : s, 1500, mesh);
      const auto& o = result.optimization;
      BOOST_TEST(result.status == CGAL::Mixed_mesh_status::SUCCESS);
      BOOST_TEST_EQ(o.number_of_corners, 4u);
      std::cout << "tetrahedron" << (is_turned ? ", turned" : "") << ": "
                << o.length_of_sharp_edges_kept / o.length_of_sharp_edges << " of the edges, "
                << o.number_of_corners_kept << " corners" << std::endl;
      double lost = 0;
      for(const auto& part : o.lost_sharp_edges)
        for(std::size_t i = 1; i < part.size(); ++i)
          lost += mm3::norm(part[i] - part[i - 1]);
      BOOST_TEST_LT(std::abs(o.length_of_sharp_edges_kept + lost - o.length_of_sharp_edges), 1e-5);
      kept += o.length_of_sharp_edges_kept;
      length += o.length_of_sharp_edges;
      corners += o.number_of_corners_kept;
    }
  BOOST_TEST_GT(kept, 0.9 * length); // 0.7 without flips
  BOOST_TEST_GE(corners, 13u);
}

void test_cylinder()
{
  const Surface s = prism(circle(60), 2);
  Mesh mesh;
  const auto result = CGAL::make_mixed_mesh_3(s, 1200, mesh);
  BOOST_TEST(result.has_mesh());
  BOOST_TEST_EQ(result.optimization.number_of_corners, 0u);
  BOOST_TEST(result.optimization.length_of_sharp_edges_kept
             > 0.9 * result.optimization.length_of_sharp_edges);
}

// Triangles of a sphere, with noise.
Surface ball(int n, double noise)
{
  Surface s;
  std::mt19937 random(1);
  std::vector<std::vector<Surface::Vertex_index>> v;
  const auto point = [&](double theta, double phi) {
    const double r = 1 + noise * (double(random()) / double(random.max()) - 0.5);
    return s.add_vertex(
      Point(r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)));
  };
  for(int i = 1; i < n; ++i) {
    v.emplace_back();
    for(int j = 0; j < 2 * n; ++j)
      v.back().push_back(point(M_PI * i / n, M_PI * j / n));
  }
  const auto top = point(0, 0), bottom = point(M_PI, 0);
  for(std::size_t j = 0; j < 2 * std::size_t(n); ++j) {
    const std::size_t k = (j + 1) % (2 * std::size_t(n));
    s.add_face(top, v[0][j], v[0][k]);
    s.add_face(bottom, v.back()[k], v.back()[j]);
    for(std::size_t i = 0; i + 1 < v.size(); ++i) {
      s.add_face(v[i][j], v[i + 1][j], v[i + 1][k]);
      s.add_face(v[i][j], v[i + 1][k], v[i][k]);
    }
  }
  return s;
}

void test_detection()
{
  const auto features = [](const Surface& s, double size) {
    return mm3::internal::Sharp_features(CGAL::Polyhedral_mixed_mesh_domain_3(s).sharp_edges(50), size);
  };
  const auto cube = features(box(Point(0, 0, 0), 1, 1, 1), 0.1);
  BOOST_TEST_EQ(cube.polylines().size(), 12u);
  BOOST_TEST_EQ(cube.corners().size(), 8u);
  BOOST_TEST(std::abs(cube.length() - 12) < 1e-12);
  const auto cylinder = features(prism(circle(60), 2), 0.1);
  BOOST_TEST_EQ(cylinder.polylines().size(), 6u); // two circles, cut into three
  BOOST_TEST_EQ(std::count_if(cylinder.polylines().begin(), cylinder.polylines().end(),
                              [](const auto& p) { return std::abs(p.length() - 2 * M_PI / 3) < 0.01; }),
                6);
  // Too coarse elements follow no features.
  BOOST_TEST(features(box(Point(0, 0, 0), 1, 1, 1), 10).empty());
  // Surfaces that resemble organs have few sharp edges, or very many, here and there.
  for(double noise : {0., 0.02, 0.05, 0.1, 0.2})
    for(double size : {0.1, 0.2})
      BOOST_TEST(features(ball(40, noise), size).empty());
}

int run(int, char*[])
{
  test_detection();
  test_boxes();
  test_flat_cells();
  test_lattice_with_region();
  test_turned_cube();
  test_acute_angles();
  test_cylinder();
  return boost::report_errors();
}

} // namespace test_fitting_sharp
