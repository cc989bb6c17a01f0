// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces of several labels: closed, manifold, with all triangles in common, for random labels, also after
// they are simplified, which keeps their topology; a layer of one voxel; volumes.

#include "test_images.h"
#include "test_labels.h"

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace test_label_surfaces {

using namespace CGAL::Mixed_meshes_3;
namespace PMP = CGAL::Polygon_mesh_processing;
using Point_3 = Predicates_kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point_3>;
using Voxel = std::array<double, 3>;

std::vector<Surface> surfaces_of(const Voxel_image_3& image, int n, double smoothing,
                                 std::size_t vertices = 0)
{
  return surfaces_of_labels<Surface>(image, n, smoothing, vertices);
}

bool is_manifold(const Surface& s)
{
  std::vector<std::size_t> number_of_faces(s.number_of_vertices());
  for(auto f : s.faces())
    for(auto v : s.vertices_around_face(s.halfedge(f)))
      ++number_of_faces[v];
  return CGAL::is_closed(s) && std::all_of(s.vertices().begin(), s.vertices().end(), [&](auto v) {
           return number_of_faces[v] >= 3 && s.degree(v) == number_of_faces[v];
         });
}

std::pair<std::ptrdiff_t, std::size_t> topology(const Surface& s)
{
  Surface copy = s;
  auto component = copy.add_property_map<Surface::Face_index, std::size_t>("f:component", 0).first;
  const auto euler = std::ptrdiff_t(s.number_of_vertices()) - std::ptrdiff_t(s.number_of_edges())
                     + std::ptrdiff_t(s.number_of_faces());
  return {euler, PMP::connected_components(copy, component)};
}

// Checks that surfaces are closed manifolds, that each triangle is on two of them, turned, and that no two
// meet in more than common vertices and edges.
void check_network(const std::vector<Surface>& surfaces)
{
  std::map<Point_3, std::size_t> numbers;
  std::vector<Vec3> points;
  std::map<std::array<std::size_t, 3>, int> uses; // of triangles, which begin with their first vertex
  for(std::size_t l = 0; l < surfaces.size(); ++l) {
    const Surface& s = surfaces[l];
    BOOST_TEST(is_manifold(s));
    for(auto f : s.faces()) {
      std::array<std::size_t, 3> t;
      std::size_t n = 0;
      for(auto v : s.vertices_around_face(s.halfedge(f))) {
        const auto [number, is_new] = numbers.emplace(s.point(v), points.size());
        if(is_new)
          points.push_back(to_vec3(s.point(v)));
        t[n++] = number->second;
      }
      if(l == 0) // the outside is behind
        std::swap(t[1], t[2]);
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      ++uses[t];
    }
  }
  std::vector<std::array<Vertex_index, 3>> triangles;
  for(const auto& [t, number] : uses) {
    BOOST_TEST_EQ(number, 1);
    BOOST_TEST_EQ(uses.count({t[0], t[2], t[1]}), 1u);
    if(t[1] < t[2])
      triangles.push_back({Vertex_index(std::uint32_t(t[0])), Vertex_index(std::uint32_t(t[1])),
                           Vertex_index(std::uint32_t(t[2]))});
  }
  BOOST_TEST(internal::vertices_of_self_intersections(points, triangles).empty());
}

double common_area(const Surface& first, const Surface& second)
{
  const auto corners = [](const Surface& s, Surface::Face_index f) {
    std::vector<Point_3> points;
    for(auto v : s.vertices_around_face(s.halfedge(f)))
      points.push_back(s.point(v));
    std::sort(points.begin(), points.end());
    return points;
  };
  std::set<std::vector<Point_3>> faces;
  for(auto f : first.faces())
    faces.insert(corners(first, f));
  double area = 0;
  for(auto f : second.faces())
    area += faces.count(corners(second, f)) > 0 ? PMP::face_area(f, second) : 0;
  return area;
}

void test_random_labels()
{
  std::mt19937 random(5);
  std::size_t number_of_collapsed = 0;
  for(int i = 0; i < 120; ++i) {
    const int n = 1 + i % 6;
    const unsigned block = 1 + unsigned(i % 3);
    const std::array<std::size_t, 3> size{3 + random() % 8, 3 + random() % 8, 1 + random() % 8};
    std::map<std::array<int, 3>, int> labels;
    const Voxel_image_3 image = image_of(
      size, oblique({0.7, 1.1, 1.3}, {-100, 20, 3000}, i % 2 == 0), [&](const Voxel& p) {
        std::array<int, 3> b;
        for(std::size_t k = 0; k < 3; ++k)
          b[k] = int(p[k]) / int(block);
        return labels.try_emplace(b, int(random() % unsigned(n + 1))).first->second;
      });
    const double smoothing = i % 4 == 0 ? 0 : 0.3 * (i % 4);
    const std::vector<Surface> surfaces = surfaces_of(image, n, smoothing);
    check_network(surfaces);
    double volume = 0;
    for(std::size_t l = 1; l < surfaces.size(); ++l)
      volume += PMP::volume(surfaces[l]);
    BOOST_TEST_LE(std::abs(volume - PMP::volume(surfaces[0])), 1e-8 * std::abs(volume));
    const std::vector<Surface> simplified = surfaces_of(image, n, smoothing, 50);
    check_network(simplified);
    for(std::size_t l = 0; l < surfaces.size(); ++l) {
      BOOST_TEST(topology(surfaces[l]) == topology(simplified[l]));
      number_of_collapsed += surfaces[l].number_of_vertices() - simplified[l].number_of_vertices();
    }
  }
  BOOST_TEST_GT(number_of_collapsed, 50000u);
}

// A body, a layer of one voxel around it, and a thick one: the thin one keeps its volume, and has no hole.
void test_layer()
{
  constexpr double n = 40, middle = (n - 1) / 2;
  std::array<std::size_t, 3> number{};
  std::map<Voxel, int> labels;
  const auto ball = [&](const Voxel& p) { // two balls, in fact: there are furrows between them
    return std::hypot(p[0] - middle, p[1] - middle, p[2] - middle) < 10
           || std::hypot(p[0] - middle - 7, p[1] - middle - 3, p[2] - middle + 2) < 6.3;
  };
  Voxel_image_3 image = image_of({40, 40, 40}, identity, [&](const Voxel& p) {
    if(ball(p))
      return 1;
    for(std::size_t k = 0; k < 3; ++k)
      for(double step : {-1., 1.}) {
        Voxel q = p;
        q[k] += step;
        if(ball(q))
          return 2;
      }
    return std::hypot(p[0] - middle, p[1] - middle, p[2] - middle) < 17 ? 3 : 0;
  });
  for(float value : image.values)
    if(value > 0)
      ++number[std::size_t(value) - 1];
  for(std::size_t vertices : {0, 4000}) {
    const std::vector<Surface> surfaces = surfaces_of(image, 3, 1, vertices);
    for(std::size_t l = 0; l < 3; ++l)
      BOOST_TEST_LE(std::abs(PMP::volume(surfaces[l + 1]) / double(number[l]) - 1), 0.015);
    BOOST_TEST(topology(surfaces[1]) == (std::pair<std::ptrdiff_t, std::size_t>(2, 1)));
    BOOST_TEST(topology(surfaces[3]) == (std::pair<std::ptrdiff_t, std::size_t>(4, 2)));
    BOOST_TEST_EQ(common_area(surfaces[1], surfaces[3]), 0);
  }
}

// Few thin layers around each other, in voxels that are no cubes: none is lost, though the smallest one has
// to reach farther into its neighbor than others.
void test_small_layers()
{
  constexpr std::array<std::array<double, 3>, 3> radii{{{2.15, 4.52, 6.6}, {2.2, 4., 6.4}, {1.8, 4.6, 5.9}}};
  const Affine_map_3 map{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1.5, 0}}};
  for(const std::array<double, 3>& r : radii) {
    std::array<std::size_t, 3> number{};
    const Voxel_image_3 image = image_of({21, 17, 17}, map, [&](const Voxel& p) {
      const double distance = std::hypot(p[0] - 10.3, p[1] - 8.2, p[2] - 8.4);
      const auto label = std::size_t(
        std::count_if(r.begin(), r.end(), [&](double x) { return distance < x; }));
      if(label > 0)
        ++number[label - 1];
      return label;
    });
    const std::vector<Surface> surfaces = surfaces_of(image, 3, 1.5);
    check_network(surfaces);
    for(std::size_t l = 0; l < 3; ++l)
      BOOST_TEST_LE(std::abs(PMP::volume(surfaces[l + 1]) / (1.5 * double(number[l])) - 1), 0.02);
  }
}

// The halves of a ball: interfaces of the domain are the common triangles, and the others.
void test_interfaces_of_domain()
{
  const Voxel_image_3 image = image_of({24, 24, 24}, identity, [](const Voxel& p) {
    return std::hypot(p[0] - 11.5, p[1] - 11.5, p[2] - 11.5) < 9 ? (p[0] < 11.5 ? 1 : 2) : 0;
  });
  const std::vector<Surface> surfaces = surfaces_of(image, 2, 1, 800);
  CGAL::Labeled_polyhedral_mixed_mesh_domain_3 domain;
  domain.add(surfaces[1], 1);
  domain.add(surfaces[2], 2);
  const Point_3 p(11, 12, 13), far(11.5, 40, 12);
  const auto radius = [](const Point_3& q) {
    return std::sqrt(CGAL::squared_distance(q, Point_3(11.5, 11.5, 11.5)));
  };
  BOOST_TEST_LE(std::abs(domain.closest_point(p, 1, 2).x() - 11.5), 0.1);
  BOOST_TEST_LE(std::abs(radius(domain.closest_point(far, 1, 2)) - 9), 0.3); // where both meet the outside
  for(int label : {1, 2}) {
    const Point_3 q = domain.closest_point(p, label, 0);
    BOOST_TEST_LE(std::abs(radius(q) - 9), 0.4);
    BOOST_TEST(domain.closest_point(p, q, label, 0) == q);
    BOOST_TEST(label == 1 ? q.x() < 12 : q.x() > 11);
  }
}

// Balls of different sizes that do not touch keep their volumes, too: each meets the outside at a level of
// its own. Of a voxel alone nothing is left.
void test_separate_labels()
{
  constexpr std::array<std::array<double, 4>, 4> balls{
    {{8, 8, 8, 5.2}, {20, 8, 9, 3.1}, {9, 20, 10, 2.6}, {22, 22, 12, 0.5}}}; // center, radius
  std::array<std::size_t, 4> number{};
  const Voxel_image_3 image = image_of({30, 30, 20}, identity, [&](const Voxel& p) {
    for(std::size_t l = 0; l < 4; ++l)
      if(std::hypot(p[0] - balls[l][0], p[1] - balls[l][1], p[2] - balls[l][2]) <= balls[l][3]) {
        ++number[l];
        return float(l + 1);
      }
    return 0.f;
  });
  const std::vector<Surface> surfaces = surfaces_of(image, 4, 1);
  for(std::size_t l = 0; l < 3; ++l) {
    BOOST_TEST(is_manifold(surfaces[l + 1]));
    BOOST_TEST_LE(std::abs(PMP::volume(surfaces[l + 1]) / double(number[l]) - 1), 0.015);
  }
  BOOST_TEST_EQ(number[3], 1u);
  BOOST_TEST(surfaces[4].is_empty());
}

// A small ball in a large one, near its surface: it is one ball, and has nothing of what is just outside of
// the large one, though it has to reach farther into its neighbor than other labels, to keep its volume.
void test_ball_near_outside()
{
  for(double radius : {2.5, 3., 4.}) {
    const double to_center = 16.8 - radius;
    std::size_t number = 0;
    const Voxel_image_3 image = image_of({44, 44, 44}, identity, [&](const Voxel& p) {
      const Voxel q{p[0] - 21.5, p[1] - 21.5, p[2] - 21.5};
      if(std::hypot(q[0], q[1], q[2]) >= 18)
        return 0.f;
      const bool is_small = std::hypot(q[0] - 0.6 * to_center, q[1] - 0.64 * to_center,
                                       q[2] - 0.48 * to_center)
                            < radius;
      number += is_small;
      return is_small ? 2.f : 1.f;
    });
    for(std::size_t vertices : {0, 4000}) {
      const std::vector<Surface> surfaces = surfaces_of(image, 2, 1, vertices);
      check_network(surfaces);
      BOOST_TEST(topology(surfaces[2]) == (std::pair<std::ptrdiff_t, std::size_t>(2, 1)));
      BOOST_TEST_LE(std::abs(PMP::volume(surfaces[2]) / double(number) - 1), 0.02);
    }
  }
}

// Folded layers with so many vertices that the first steps are taken cube by cube: topology is kept, and
// nothing cuts anything.
void test_layers_in_cubes()
{
  constexpr std::size_t n = 60, wanted = 6000, vertices_of_cubes = 100000;
  const Voxel_image_3 image = image_of({n, n, n}, oblique({1, 1.1, 0.9}, {-10, 20, 30}, true),
                                       [](const Voxel& p) {
                                         if(std::hypot(p[0] - 29.5, p[1] - 29.5, p[2] - 29.5) > 27)
                                           return 0;
                                         const auto wave = [](double x) { return x / 4; };
                                         const double gyroid = std::sin(wave(p[0])) * std::cos(wave(p[1]))
                                                               + std::sin(wave(p[1])) * std::cos(wave(p[2]))
                                                               + std::sin(wave(p[2])) * std::cos(wave(p[0]));
                                         return gyroid < -0.4 ? 1 : gyroid < 0.4 ? 2 : 3;
                                       });
  const std::vector<Surface> surfaces = surfaces_of(image, 3, 1),
                             simplified = surfaces_of(image, 3, 1, wanted);
  std::size_t number = 0, number_left = 0;
  for(std::size_t l = 1; l <= 3; ++l) {
    number += surfaces[l].number_of_vertices();
    number_left += simplified[l].number_of_vertices();
  }
  BOOST_TEST_GT(number, vertices_of_cubes);
  BOOST_TEST_LT(number_left, 3 * wanted);
  check_network(simplified);
  for(std::size_t l = 0; l < surfaces.size(); ++l) {
    BOOST_TEST(topology(surfaces[l]) == topology(simplified[l]));
    BOOST_TEST_LE(std::abs(PMP::volume(simplified[l]) / PMP::volume(surfaces[l]) - 1), 0.01);
  }
}

int run(int, char*[])
{
  test_random_labels();
  test_layer();
  test_small_layers();
  test_separate_labels();
  test_ball_near_outside();
  test_interfaces_of_domain();
  test_layers_in_cubes();
  return boost::report_errors();
}

} // namespace test_label_surfaces
