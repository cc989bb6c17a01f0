// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Usage: test_image [directory]. Writes images there (default: the current directory), and what is in them
// to image_expected.json, for test_image_readers.py.

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Mixed_meshes_3;
namespace IO = CGAL::Mixed_meshes_3::IO;
namespace fs = std::filesystem;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using CGAL::Mixed_meshes_3::Vec3;
using norm;

fs::path directory;

std::string file(const std::string& name) { return (directory / name).string(); }

bool is_close(const Vec3& a, const Vec3& b, double tolerance) { return norm(a - b) <= tolerance; }

Vec3 to_doubles(const std::array<float, 3>& v) { return {double(v[0]), double(v[1]), double(v[2])}; }

// A rotation about no special axis, times sizes; `mirror` flips the first axis.
Affine_map_3 oblique(const Vec3& sizes, const Vec3& origin, bool mirror)
{
  const double a = 0.3, b = -0.5, c = 0.2;
  const double r[3][3] = {
    {std::cos(b) * std::cos(c), -std::cos(b) * std::sin(c), std::sin(b)},
    {std::cos(a) * std::sin(c) + std::sin(a) * std::sin(b) * std::cos(c),
     std::cos(a) * std::cos(c) - std::sin(a) * std::sin(b) * std::sin(c), -std::sin(a) * std::cos(b)},
    {std::sin(a) * std::sin(c) - std::cos(a) * std::sin(b) * std::cos(c),
     std::sin(a) * std::cos(c) + std::cos(a) * std::sin(b) * std::sin(c), std::cos(a) * std::cos(b)}};
  Affine_map_3 map;
  for(int i = 0; i < 3; ++i) {
    for(int j = 0; j < 3; ++j)
      map[i][j] = r[i][j] * sizes[j] * (mirror && j == 0 ? -1 : 1);
    map[i][3] = origin[i];
  }
  return map;
}

double difference(const Affine_map_3& a, const Affine_map_3& b)
{
  double d = 0;
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 4; ++j)
      d = (std::max)(d, std::abs(a[i][j] - b[i][j]));
  return d;
}

void test_affine_maps()
{
  for(bool mirror : {false, true}) {
    const Affine_map_3 map = oblique({1, 2, 3}, {10, -20, 30}, mirror);
    BOOST_TEST(std::abs(CGAL::Mixed_meshes_3::determinant(map) - (mirror ? -6 : 6)) < 1e-12);
    const Vec3 p{3, 5, -7};
    BOOST_TEST(is_close(transform(inverse(map), transform(map, p)), p, 1e-13));
  }
}

// ---- meshes ------------------------------------------------------------------------------------

// A conforming mesh with an element of each kind, in [0, 2] x [0, 1] x [0, 2].
Mesh four_kinds(double scale, const Vec3& origin, double perturbation = 0)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-perturbation, perturbation);
  Mesh mesh;
  for(const Vec3& p : {Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
                       {0, 1, 1}, {0.5, 0.5, 2}, {2, 0, 0}, {2, 1, 0}, {1.7, 0.5, 1.8}}) {
    const Vec3 q = origin + scale * (p + Vec3{uniform(random), uniform(random), uniform(random)});
    mesh.add_vertex({q[0], q[1], q[2]});
  }
  mesh.add_element(HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7});
  mesh.add_element(PRISM, {2, 10, 6, 1, 9, 5});
  mesh.add_element(PYRAMID, {4, 5, 6, 7, 8});
  mesh.add_element(TETRAHEDRON, {5, 6, 8, 11});
  for(std::size_t e = 0; e < 4; ++e)
    BOOST_TEST(volume(mesh, e) > 0);
  return mesh;
}

Vec3 position(const Mesh& mesh, const std::vector<Vec3>& displacements, const Element_location_3& l)
{
  Vec3 x{};
  for(int i = 0; i < mesh.element(l.element).size(); ++i) {
    const Vertex_index v = mesh.element(l.element)[i];
    x = x + l.weights[i] * (to_vec3(mesh.point(v)) + displacements[v]);
  }
  return x;
}

// Reference coordinates: vertices, midpoints of edges, points of faces, of the interior.
std::vector<Vec3> sample_points(Element_kind kind)
{
  const Reference_element& reference = reference_elements[kind];
  std::vector<Vec3> samples;
  const auto vertex = [&](int i) {
    return Vec3{double(reference.coordinates[i][0]), double(reference.coordinates[i][1]),
                double(reference.coordinates[i][2])};
  };
  for(int i = 0; i < reference.number_of_vertices; ++i)
    samples.push_back(vertex(i));
  for(int i = 0; i < reference.number_of_edges; ++i)
    for(double t : {0.1, 0.5, 1 - 1e-7})
      samples.push_back((1 - t) * vertex(reference.edges[i][0]) + t * vertex(reference.edges[i][1]));
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto add_mixture = [&](const std::uint8_t* vertices, int n) {
    double sum = 0;
    Vec3 p{};
    for(int i = 0; i < n; ++i) {
      const double w = uniform(random);
      p = p + w * vertex(vertices ? vertices[i] : i);
      sum += w;
    }
    samples.push_back((1 / sum) * p);
  };
  for(int f = 0; f < reference.number_of_faces; ++f)
    for(int i = 0; i < 20; ++i)
      add_mixture(reference.faces[f].vertices, reference.faces[f].size);
  for(int i = 0; i < 100; ++i)
    add_mixture(nullptr, reference.number_of_vertices);
  return samples;
}

void test_locator()
{
  const std::vector<Vec3> none(12, Vec3{});
  std::vector<Vec3> moved;
  for(int i = 0; i < 12; ++i)
    moved.push_back({0.1 * std::sin(i), 0.1 * std::cos(2 * i), 0.05 * i});
  for(double scale : {1e-6, 1., 1e3})
    for(double perturbation : {0., 0.15})
      for(bool is_moved : {false, true}) {
        const Vec3 origin{7 * scale, -300 * scale, 50 * scale};
        const Mesh mesh = four_kinds(scale, origin, perturbation);
        std::vector<Vec3> u = is_moved ? moved : none;
        for(Vec3& v : u)
          v = scale * v;
        const Element_locator_3<Mesh> plain(mesh), displaced(mesh, u);
        const Element_locator_3<Mesh>& locator = is_moved ? displaced : plain;
        std::vector<Vec3> points;
        for(Element_index e = 0; e < 4; ++e)
          for(const Vec3& r : sample_points(mesh.element(e).kind())) {
            Element_location_3 l;
            l.element = e;
            internal::with_kind(mesh.element(e).kind(), [&](auto kind) {
              const auto n = Mixed_element_traits_3<kind.value>::shape_functions(r[0], r[1], r[2]);
              std::copy(n.begin(), n.end(), l.weights.begin());
            });
            const Vec3 p = position(mesh, u, l);
            points.push_back(p);
            const auto found = locator.locate(p);
            if(!BOOST_TEST(found.has_value()))
              continue;
            BOOST_TEST_LE(found->element, e);
            BOOST_TEST(is_close(position(mesh, u, *found), p, 1e-8 * scale));
            if(found->element == e)
              BOOST_TEST(is_close(found->coordinates, r, 1e-6));
            BOOST_TEST_EQ(locator.nearest(p).distance, 0.);
          }
        // Brute force: the first element into whose reference element the point is mapped.
        std::mt19937 random(17);
        std::uniform_real_distribution<double> uniform(-0.5, 2.5);
        for(int i = 0; i < 500; ++i)
          points.push_back(origin + scale * Vec3{uniform(random), uniform(random) / 2, uniform(random)});
        for(const Vec3& p : points) {
          Element_index first = 4;
          for(Element_index e = 0; e < 4 && first == 4; ++e) {
            Vec3 corners[8];
            for(int i = 0; i < mesh.element(e).size(); ++i)
              corners[i] = to_vec3(mesh.point(mesh.element(e)[i])) + u[mesh.element(e)[i]];
            internal::with_kind(mesh.element(e).kind(), [&](auto kind) {
              if(internal::Isoparametric_map_3<kind.value>(corners).inverse(p))
                first = e;
            });
          }
          const auto found = locator.locate(p);
          BOOST_TEST_EQ(found ? found->element : 4, first);
        }
        // Nearest: against a sampling of the boundary.
        std::vector<Vec3> surface;
        for(const auto& f : boundary_faces(mesh)) {
          const Element_face& face = mesh.element(f.element).reference().faces[f.local_face];
          const auto v = internal::face_vertices(mesh.element(f.element), f.local_face);
          Vec3 c[4];
          for(int i = 0; i < face.size; ++i)
            c[i] = to_vec3(mesh.point(v[i])) + u[v[i]];
          for(int i = 0; i <= 40; ++i)
            for(int j = 0; j <= 40; ++j) {
              const double a = i / 40., b = j / 40.;
              if(face.size == 4)
                surface.push_back((1 - a) * ((1 - b) * c[0] + b * c[3]) + a * ((1 - b) * c[1] + b * c[2]));
              else if(i + j <= 40)
                surface.push_back((1 - a - b) * c[0] + a * c[1] + b * c[2]);
            }
        }
        for(std::size_t i = points.size() - 100; i < points.size(); ++i) {
          const Element_location_3 l = locator.nearest(points[i]);
          if(locator.locate(points[i]))
            continue;
          double least = std::numeric_limits<double>::infinity();
          for(const Vec3& q : surface)
            least = (std::min)(least, norm(q - points[i]));
          BOOST_TEST_LE(l.distance, least + 1e-9 * scale);
          BOOST_TEST_LE(least, l.distance + 0.03 * scale);
          BOOST_TEST(std::abs(norm(position(mesh, u, l) - points[i]) - l.distance) < 1e-12 * 1e3 * scale);
          double sum = 0, smallest = 0;
          for(double w : l.weights) {
            sum += w;
            smallest = (std::min)(smallest, w);
          }
          BOOST_TEST(std::abs(sum - 1) < 1e-12 && smallest > -1e-12);
          internal::with_kind(mesh.element(l.element).kind(), [&](auto kind) {
            const auto n = Mixed_element_traits_3<kind.value>::shape_functions(
              l.coordinates[0], l.coordinates[1], l.coordinates[2]);
            for(std::size_t k = 0; k < n.size(); ++k)
              BOOST_TEST(std::abs(n[k] - l.weights[k]) < 1e-9);
          });
        }
      }
  const Mesh empty;
  BOOST_TEST(!Element_locator_3<Mesh>(empty).locate(Vec3{0, 0, 0}));
}

// Elements of one kind, as distorted as they can be while their Jacobian is positive.
template <Element_kind Kind>
void test_inverse_map()
{
  const Reference_element& reference = reference_elements[Kind];
  std::mt19937 random(21);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double amount = Kind == TETRAHEDRON ? 0.2 : Kind == PRISM ? 0.35 : 0.6;
  for(int repeat = 0; repeat < 300; ++repeat) {
    const bool mirror = repeat % 2 == 1;
    Vec3 corners[8];
    for(int i = 0; i < reference.number_of_vertices; ++i)
      for(int k = 0; k < 3; ++k)
        corners[i][k] = (mirror && k == 0 ? -1 : 1)
                        * (reference.coordinates[i][k] + amount * uniform(random));
    const internal::Element_field<Kind> field(corners);
    const internal::Isoparametric_map_3<Kind> map(corners);
    const std::vector<Vec3> samples = sample_points(Kind);
    bool is_valid = true;
    for(const Vec3& r : samples) {
      const auto n = Mixed_element_traits_3<Kind>::shape_functions(r[0], r[1], r[2]);
      Vec3 x{};
      for(int i = 0; i < reference.number_of_vertices; ++i)
        x = x + n[i] * corners[i];
      BOOST_TEST(is_close(field(r), x, 1e-14));
      BOOST_TEST(is_close(map(r), x, 1e-14));
      if(Kind == PYRAMID && r[2] > 0.999)
        continue;
      const auto g = Mixed_element_traits_3<Kind>::shape_gradients(r[0], r[1], r[2]);
      std::array<Vec3, 3> d{};
      for(int i = 0; i < reference.number_of_vertices; ++i)
        for(int k = 0; k < 3; ++k)
          d[k] = d[k] + g[i][k] * corners[i];
      for(int k = 0; k < 3; ++k)
        BOOST_TEST(is_close(field.derivatives(r)[k], d[k], 1e-11));
      is_valid = is_valid && determinant(d[0], d[1], d[2]) * (mirror ? -1 : 1) > 0.02;
    }
    if(!is_valid)
      continue;
    for(const Vec3& r : samples) {
      const auto found = map.inverse(map(r));
      BOOST_TEST(found && is_close(map(*found), map(r), 1e-12));
    }
  }
}

// ---- warping -----------------------------------------------------------------------------------

// A linear function of the world: linear interpolation gives it exactly.
double ramp(const Vec3& x) { return 100 + 0.7 * x[0] - 0.4 * x[1] + 0.9 * x[2]; }

Voxel_image_3 ramp_image(const Affine_map_3& map, const std::array<std::size_t, 3>& size)
{
  Voxel_image_3 image;
  image.grid.size = size;
  image.grid.index_to_world = map;
  image.values.resize(image.grid.number_of_voxels());
  for(std::size_t k = 0; k < size[2]; ++k)
    for(std::size_t j = 0; j < size[1]; ++j)
      for(std::size_t i = 0; i < size[0]; ++i)
        image.values[image.grid.offset(i, j, k)] =
          float(ramp(transform(map, {double(i), double(j), double(k)})));
  return image;
}

template <class F>
void for_each_voxel_center(const Voxel_grid_3& grid, const F& f)
{
  for(std::size_t k = 0; k < grid.size[2]; ++k)
    for(std::size_t j = 0; j < grid.size[1]; ++j)
      for(std::size_t i = 0; i < grid.size[0]; ++i)
        f(grid.offset(i, j, k), transform(grid.index_to_world, {double(i), double(j), double(k)}));
}

struct Scene
{
  Mesh mesh = four_kinds(20, {-15, -8, -18}, 0.1);
  Voxel_image_3 image;

  explicit Scene(bool mirror)
  {
    image = ramp_image(oblique({1.1, 0.9, 1.3}, {0, 0, 0}, mirror), {61, 57, 49});
    // the middle of the image to the origin
    const Vec3 middle = transform(image.grid.index_to_world, {30, 28, 24});
    Affine_map_3 map = image.grid.index_to_world;
    for(int i = 0; i < 3; ++i)
      map[i][3] = -middle[i];
    image = ramp_image(map, image.grid.size);
  }

  std::vector<Vec3> displacements(const std::function<Vec3(const Vec3&)>& u) const
  {
    std::vector<Vec3> result;
    for(const auto& p : mesh.points())
      result.push_back(u({p.x(), p.y(), p.z()}));
    return result;
  }
};

Vec3 bend(const Vec3& x)
{
  return {2 * std::sin(x[1] / 15), 1.5 * std::cos(x[2] / 11) - 1, -3 * std::exp(-x[0] * x[0] / 200)};
}

void test_identity()
{
  const Scene scene(true);
  Voxel_image_3 image = scene.image;
  std::mt19937 random(1);
  for(float& v : image.values)
    v = float(random());
  const Warped_image_3 warped = warp_image(image, scene.mesh, scene.displacements([](const Vec3&) {
    return Vec3{0, 0, 0};
  }));
  BOOST_TEST(warped.image.values == image.values);
  BOOST_TEST(warped.mask.values == std::vector<float>(warped.forward.is_in_mesh.begin(),
                                                      warped.forward.is_in_mesh.end()));
  double inside = 0;
  for(float m : warped.mask.values)
    inside += double(m);
  BOOST_TEST(std::abs(inside * 1.1 * 0.9 * 1.3 / volume(scene.mesh) - 1) < 0.01);
}

// u(X) = A X + b - X: the closed form of both fields, in all four kinds; with resected value none.
void test_affine_displacement(bool mirror)
{
  const Scene scene(mirror);
  const Affine_map_3 motion{{{1.1, 0.05, -0.03, 2}, {-0.04, 0.93, 0.06, -1}, {0.02, -0.07, 1.04, 3}}};
  const auto u = scene.displacements([&](const Vec3& x) { return transform(motion, x) - x; });
  const Warped_image_3 warped = warp_image(scene.image, scene.mesh, u);
  const Element_locator_3<Mesh> before(scene.mesh), after(scene.mesh, u);
  const Affine_map_3 back = inverse(motion);
  std::array<int, 4> count{};
  for_each_voxel_center(scene.image.grid, [&](std::size_t offset, const Vec3& x) {
    const auto l = after.locate(x);
    BOOST_TEST_EQ(bool(warped.backward.is_in_mesh[offset]), l.has_value());
    BOOST_TEST_EQ(bool(warped.forward.is_in_mesh[offset]), before.locate(x).has_value());
    if(l) {
      ++count[scene.mesh.element(l->element).kind()];
      const Vec3 source = transform(back, x);
      BOOST_TEST(is_close(to_doubles(warped.backward.vectors[offset]), source - x, 1e-5));
      BOOST_TEST(std::abs(double(warped.image.values[offset]) - ramp(source)) < 1e-4);
    }
    if(warped.forward.is_in_mesh[offset])
      BOOST_TEST(is_close(to_doubles(warped.forward.vectors[offset]), transform(motion, x) - x, 1e-5));
  });
  for(int n : count)
    BOOST_TEST(n > 100);
}

void test_fields_are_inverse(bool mirror)
{
  const Scene scene(mirror);
  const auto u = scene.displacements(bend);
  const Warped_image_3 warped = warp_image(scene.image, scene.mesh, u);
  const Element_locator_3<Mesh> before(scene.mesh), after(scene.mesh, u);
  const std::vector<Vec3> none(u.size(), Vec3{});
  for_each_voxel_center(scene.image.grid, [&](std::size_t offset, const Vec3& x) {
    const Vec3 from = x + to_doubles(warped.backward.vectors[offset]);
    if(warped.backward.is_in_mesh[offset])
      BOOST_TEST(is_close(position(scene.mesh, u, before.nearest(from)), x, 1e-5));
    const Vec3 to = x + to_doubles(warped.forward.vectors[offset]);
    if(warped.forward.is_in_mesh[offset])
      BOOST_TEST(is_close(position(scene.mesh, none, after.nearest(to)), x, 1e-5));
  });
  // The image deformed and back: that of before, in the mesh, up to interpolation.
  const Voxel_image_3 again = resample_image(warped.image, warped.forward);
  double worst = 0, mean = 0;
  std::size_t n = 0;
  for(std::size_t i = 0; i < again.values.size(); ++i)
    if(warped.forward.is_in_mesh[i]) {
      const double d = std::abs(double(again.values[i]) - double(scene.image.values[i]));
      worst = (std::max)(worst, d);
      mean += d;
      ++n;
    }
  BOOST_TEST_LT(mean / double(n), 0.05); // the ramp has slope 1.2 per millimeter
  BOOST_TEST_LT(worst, 1.5);             // at the surface, where the fields have a kink
}

void test_outside()
{
  const Scene scene(false);
  const auto u = scene.displacements([](const Vec3&) { return Vec3{2, 0, 0}; });
  Warp_options options;
  options.fade_distance = 0;
  const Warped_image_3 still = warp_image(scene.image, scene.mesh, u, options);
  options.fade_distance = 6;
  const Warped_image_3 faded = warp_image(scene.image, scene.mesh, u, options);
  const Element_locator_3<Mesh> after(scene.mesh, u);
  for_each_voxel_center(scene.image.grid, [&](std::size_t offset, const Vec3& x) {
    const double distance = after.nearest(x).distance;
    const double length = norm(to_doubles(faded.backward.vectors[offset]));
    if(distance == 0) {
      BOOST_TEST(std::abs(length - 2) < 1e-6);
      return;
    }
    BOOST_TEST_EQ(norm(to_doubles(still.backward.vectors[offset])), 0.);
    BOOST_TEST_EQ(still.image.values[offset], scene.image.values[offset]);
    // Distances are to the nearest voxel in the mesh: up to a voxel's diagonal longer.
    const auto weight = [](double d) {
      const double t = (std::min)(1., d / 6);
      return 1 - t * t * (3 - 2 * t);
    };
    BOOST_TEST_LE(length, 2 * weight(distance) + 1e-5);
    BOOST_TEST_LE(2 * weight(distance + 2), length + 1e-5);
  });
}

// The nearest voxel against brute force; sizes of voxels differ.
void test_fade()
{
  std::mt19937 random(4);
  for(std::size_t one_in : {3u, 40u, 700u}) {
    Displacement_field_3 field;
    field.grid.size = {13, 11, 9};
    field.grid.index_to_world = oblique({1, 1.5, 0.7}, {0, 0, 0}, true);
    field.vectors.resize(field.grid.number_of_voxels());
    std::vector<Vec3> seeds;
    for_each_voxel_center(field.grid, [&](std::size_t offset, const Vec3& x) {
      field.is_in_mesh.push_back(random() % one_in == 0 || (offset == 5));
      if(field.is_in_mesh[offset]) {
        field.vectors[offset] = {1, 0, 0};
        seeds.push_back(x);
      }
    });
    internal::fade_displacement(5, field);
    for_each_voxel_center(field.grid, [&](std::size_t offset, const Vec3& x) {
      double least = std::numeric_limits<double>::infinity();
      for(const Vec3& s : seeds)
        least = (std::min)(least, norm(s - x));
      const double t = (std::min)(1., least / 5);
      BOOST_TEST(std::abs(double(field.vectors[offset][0]) - (1 - t * t * (3 - 2 * t))) < 1e-5);
    });
  }
}

void test_resection()
{
  const Scene scene(false);
  const auto u = scene.displacements(bend);
  const Warped_image_3 whole = warp_image(scene.image, scene.mesh, u);
  // By a predicate on points before the deformation.
  Warp_options options;
  options.is_resected = [](const Vec3& x) { return norm(x - Vec3{-5, 2, -8}) < 6; };
  options.resected_value = -1;
  const Warped_image_3 by_points = warp_image(scene.image, scene.mesh, u, options);
  std::size_t count = 0;
  for_each_voxel_center(scene.image.grid, [&](std::size_t offset, const Vec3& x) {
    const bool is_resected = whole.mask.values[offset] == 1
                             && options.is_resected(x + to_doubles(whole.backward.vectors[offset]));
    count += is_resected;
    BOOST_TEST_EQ(by_points.mask.values[offset], is_resected ? 2.f : whole.mask.values[offset]);
    BOOST_TEST_EQ(by_points.image.values[offset], is_resected ? -1.f : whole.image.values[offset]);
  });
  BOOST_TEST(count > 300);
  // By elements: without the prism. Nothing moves, so that the mask is where the elements are. What is
  // said of vertices of the prism only does not matter.
  options = Warp_options();
  options.resected_elements = {false, true, false, false};
  auto zero = scene.displacements([](const Vec3&) { return Vec3{}; });
  zero[9] = {1e300, std::numeric_limits<double>::quiet_NaN(), 0};
  const Warped_image_3 by_elements = warp_image(scene.image, scene.mesh, zero, options);
  const Element_locator_3<Mesh> locator(scene.mesh);
  for_each_voxel_center(scene.image.grid, [&](std::size_t offset, const Vec3& x) {
    const auto l = locator.locate(x);
    const bool is_shared = l && l->element == 1
                           && internal::depth(PRISM, l->coordinates) < 1e-6;
    const float expected = !l ? 0.f : l->element == 1 ? 2.f : 1.f;
    if(!is_shared)
      BOOST_TEST_EQ(by_elements.mask.values[offset], expected);
    BOOST_TEST_EQ(by_elements.image.values[offset],
                  by_elements.mask.values[offset] == 2 ? 0.f : scene.image.values[offset]);
  });
}

// ---- files -------------------------------------------------------------------------------------

template <class T>
void write_bytes(const std::string& path, const T& header, const std::string& rest)
{
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&header), sizeof(header));
  out << rest;
}

// The line that says why a file is refused.
std::string defect(const std::string& path)
{
  try {
    IO::read_NIFTI(path);
  } catch(const std::runtime_error& e) {
    const std::string text = e.what();
    BOOST_TEST_EQ(text.find(path + ": "), 0u);
    BOOST_TEST(text.find('\n') == std::string::npos);
    return text.substr(path.size() + 2);
  }
  return "none";
}

struct Type
{
  Voxel_type type;
  const char* name;
  std::vector<float> values;
};

const std::vector<Type> types = {{Voxel_type::UINT8, "uint8", {0, 1, 254, 255}},
                                 {Voxel_type::INT8, "int8", {-128, -1, 0, 127}},
                                 {Voxel_type::UINT16, "uint16", {0, 1, 65534, 65535}},
                                 {Voxel_type::INT16, "int16", {-32768, -1, 0, 32767}},
                                 {Voxel_type::UINT32, "uint32", {0, 1, 16777215, 4294967040.f}},
                                 {Voxel_type::INT32, "int32", {-2147483648.f, -1, 0, 16777215}},
                                 {Voxel_type::UINT64, "uint64", {0, 1, 16777215, 4294967296.f}},
                                 {Voxel_type::INT64, "int64", {-4294967296.f, -1, 0, 16777215}},
                                 {Voxel_type::FLOAT32, "float32", {-1.5f, 3e-30f, 0.1f, 3e38f}},
                                 {Voxel_type::FLOAT64, "float64", {-1.5f, 3e-30f, 0.1f, 3e38f}}};

void write_matrix(std::ostream& out, const Affine_map_3& map)
{
  out << "[";
  for(int i = 0; i < 3; ++i) {
    out << (i == 0 ? "[" : ", [");
    for(int j = 0; j < 4; ++j)
      out << (j == 0 ? "" : ", ") << map[i][j];
    out << "]";
  }
  out << "]";
}

void test_round_trips()
{
  std::ofstream expected(file("image_expected.json"));
  expected.precision(17);
  expected << "{\"images\": [";
  bool is_first = true;
  for(const Type& type : types)
    for(bool mirror : {false, true})
      for(const char* extension : {".nii", ".nii.gz"}) {
        Voxel_image_3 image;
        image.grid.size = {5, 4, 3};
        image.grid.index_to_world = oblique({1.25, 0.5, 2}, {-90.5, 12, 70}, mirror);
        image.grid.world = mirror ? 4 : 1;
        image.type = type.type;
        for(std::size_t i = 0; i < 60; ++i)
          image.values.push_back(type.values[i * i % 7 % 4]);
        const std::string name = std::string("image_") + type.name + (mirror ? "_mirrored" : "") + extension;
        BOOST_TEST(!IO::write_NIFTI(file(name), image));
        const Voxel_image_3 read = IO::read_NIFTI(file(name));
        BOOST_TEST(read.values == image.values);
        BOOST_TEST(read.grid.size == image.grid.size);
        BOOST_TEST_LT(difference(read.grid.index_to_world, image.grid.index_to_world), 1e-5);
        BOOST_TEST_EQ(read.grid.world, image.grid.world);
        BOOST_TEST(read.type == image.type && read.slope == 1 && read.intercept == 0);
        expected << (is_first ? "\n" : ",\n") << "{\"name\": \"" << name << "\", \"type\": \"" << type.name
                 << "\", \"affine\": ";
        write_matrix(expected, image.grid.index_to_world);
        expected << ", \"values\": [";
        for(std::size_t i = 0; i < 60; ++i)
          expected << (i == 0 ? "" : ", ") << double(image.values[i]);
        expected << "]}";
        is_first = false;
      }
  // A field.
  Displacement_field_3 field;
  field.grid.size = {5, 4, 3};
  field.grid.index_to_world = oblique({1.25, 0.5, 2}, {-90.5, 12, 70}, true);
  for(std::size_t i = 0; i < 60; ++i)
    field.vectors.push_back({float(i), float(i) / 7, -float(i)});
  BOOST_TEST(!IO::write_NIFTI(file("image_field.nii.gz"), field));
  expected << "],\n\"field\": [";
  for(std::size_t i = 0; i < 60; ++i)
    expected << (i == 0 ? "[" : ", [") << double(field.vectors[i][0]) << ", "
             << double(field.vectors[i][1]) << ", " << double(field.vectors[i][2]) << "]";
  expected << "]}\n";

  // Slope and intercept: values to the nearest that the type holds, cut off at its ends.
  Voxel_image_3 scaled;
  scaled.grid.size = {5, 1, 1};
  scaled.type = Voxel_type::UINT8;
  scaled.slope = 0.5;
  scaled.intercept = 10;
  scaled.values = {10, 10.5f, 11.2f, -100, 1000};
  BOOST_TEST(!IO::write_NIFTI(file("image_scaled.nii"), scaled));
  const Voxel_image_3 read = IO::read_NIFTI(file("image_scaled.nii"));
  BOOST_TEST(read.values == (std::vector<float>{10, 10.5f, 11, 10, 137.5f}));
  BOOST_TEST(read.slope == 0.5 && read.intercept == 10 && read.type == Voxel_type::UINT8);
  // Axes that are not at right angles: only the sform can say that.
  Voxel_image_3 sheared = scaled;
  sheared.grid.index_to_world[0] = {1, 0.3, 0, 5};
  BOOST_TEST(!IO::write_NIFTI(file("image_sheared.nii"), sheared));
  BOOST_TEST_LT(difference(IO::read_NIFTI(file("image_sheared.nii")).grid.index_to_world,
                           sheared.grid.index_to_world), 1e-6);
}

nifti_1_header small_header()
{
  Voxel_grid_3 grid;
  grid.size = {4, 3, 2};
  nifti_1_header header = IO::internal::make_header(grid);
  header.datatype = NIFTI_TYPE_UINT8;
  header.bitpix = 8;
  return header;
}

const std::string no_extension(4, '\0'), small_voxels(24, '\7');

void test_orientation()
{
  nifti_1_header header = small_header();
  const auto read_map = [&](const nifti_1_header& h) {
    write_bytes(file("image_map.nii"), h, no_extension + small_voxels);
    return IO::read_NIFTI(file("image_map.nii")).grid;
  };
  // qform: 90 degrees about z, mirrored in k; sform: sizes 2, 3, 4
  header.qform_code = 1;
  header.quatern_b = header.quatern_c = 0;
  header.quatern_d = float(std::sqrt(0.5));
  header.pixdim[0] = -1;
  for(int i = 1; i <= 3; ++i)
    header.pixdim[i] = 2;
  header.qoffset_x = 7;
  header.sform_code = 2;
  const float rows[3][4] = {{2, 0, 0, 1}, {0, 3, 0, 2}, {0, 0, 4, 3}};
  std::memcpy(header.srow_x, rows[0], sizeof(rows[0]));
  std::memcpy(header.srow_y, rows[1], sizeof(rows[1]));
  std::memcpy(header.srow_z, rows[2], sizeof(rows[2]));
  const Affine_map_3 sform{{{2, 0, 0, 1}, {0, 3, 0, 2}, {0, 0, 4, 3}}};
  const Affine_map_3 qform{{{0, -2, 0, 7}, {2, 0, 0, 0}, {0, 0, -2, 0}}};
  BOOST_TEST_LT(difference(read_map(header).index_to_world, sform), 1e-12);
  BOOST_TEST_EQ(read_map(header).world, 2);
  header.sform_code = 0;
  BOOST_TEST_LT(difference(read_map(header).index_to_world, qform), 1e-5);
  BOOST_TEST_EQ(read_map(header).world, 1);
  header.qform_code = 0;
  BOOST_TEST_LT(difference(read_map(header).index_to_world,
                           Affine_map_3{{{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}}}), 1e-12);
  BOOST_TEST_EQ(read_map(header).world, 0);
  // units
  header.sform_code = 2;
  for(const auto& unit : {std::pair<int, double>{NIFTI_UNITS_METER, 1000}, {NIFTI_UNITS_MM, 1},
                          {NIFTI_UNITS_MICRON, 1e-3}, {NIFTI_UNITS_UNKNOWN, 1}}) {
    header.xyzt_units = char(unit.first);
    Affine_map_3 scaled = sform;
    for(auto& row : scaled)
      for(double& x : row)
        x *= unit.second;
    BOOST_TEST_LT(difference(read_map(header).index_to_world, scaled), 1e-9);
  }
  // the other byte order
  header.datatype = NIFTI_TYPE_INT16;
  header.bitpix = 16;
  header.xyzt_units = NIFTI_UNITS_MM;
  swap_nifti_header(&header, 1);
  std::vector<std::uint16_t> numbers;
  for(int i = 0; i < 24; ++i)
    numbers.push_back(std::uint16_t(256 + i));
  nifti_swap_2bytes(24, numbers.data());
  const std::string swapped(reinterpret_cast<const char*>(numbers.data()), 48);
  write_bytes(file("image_swapped.nii"), header, no_extension + swapped);
  const Voxel_image_3 image = IO::read_NIFTI(file("image_swapped.nii"));
  BOOST_TEST_LT(difference(image.grid.index_to_world, sform), 1e-12);
  for(int i = 0; i < 24; ++i)
    BOOST_TEST_EQ(image.values[std::size_t(i)], float(256 + i));
  // NIfTI-2
  nifti_2_header second{};
  second.sizeof_hdr = 540;
  std::memcpy(second.magic, "n+2\0\r\n\032\n", 8);
  second.datatype = NIFTI_TYPE_UINT8;
  second.bitpix = 8;
  const std::int64_t dim[] = {3, 4, 3, 2, 1, 1, 1, 1};
  std::copy(dim, dim + 8, second.dim);
  for(double& p : second.pixdim)
    p = 1;
  second.vox_offset = 544;
  second.sform_code = 1;
  std::copy(sform[0].begin(), sform[0].end(), second.srow_x);
  std::copy(sform[1].begin(), sform[1].end(), second.srow_y);
  std::copy(sform[2].begin(), sform[2].end(), second.srow_z);
  second.xyzt_units = NIFTI_UNITS_MM;
  write_bytes(file("image_second.nii"), second, no_extension + small_voxels);
  BOOST_TEST_EQ(difference(IO::read_NIFTI(file("image_second.nii")).grid.index_to_world, sform), 0.);
}

void test_bad_input()
{
  const auto defect_of = [](const std::function<void(nifti_1_header&)>& change, const std::string& voxels) {
    nifti_1_header header = small_header();
    change(header);
    write_bytes(file("image_bad.nii"), header, no_extension + voxels);
    return defect(file("image_bad.nii"));
  };
  const auto nothing = [](nifti_1_header&) {};
  BOOST_TEST_EQ(defect_of(nothing, small_voxels), "none");
  BOOST_TEST_EQ(defect_of(nothing, small_voxels.substr(1)), "is truncated: 4 x 3 x 2 voxels expected");
  BOOST_TEST_EQ(defect_of(nothing, ""), "is truncated: 4 x 3 x 2 voxels expected");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.dim[1] = h.dim[2] = h.dim[3] = 32767; }, small_voxels),
                "is truncated: 32767 x 32767 x 32767 voxels expected");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.dim[0] = 4, h.dim[4] = 10; }, small_voxels),
                "is a 4-D image of 4 x 3 x 2 x 10 values; expected three dimensions");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.dim[0] = 4; }, small_voxels), "none");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.datatype = 128, h.bitpix = 24; }, std::string(72, 'a')),
                "has voxels of type NIFTI_TYPE_RGB24; expected one real number in a voxel");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.datatype = 32, h.bitpix = 64; }, std::string(192, 'a')),
                "has voxels of type NIFTI_TYPE_COMPLEX64; expected one real number in a voxel");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.datatype = 77; }, small_voxels),
                "has voxels of type DT_UNKNOWN; expected one real number in a voxel");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.srow_x[0] = 0; }, small_voxels), "its sform is singular");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.srow_x[3] = std::nanf(""); }, small_voxels),
                "its orientation has entries that are not finite numbers");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { std::memcpy(h.magic, "abc", 4); }, small_voxels),
                "cannot be read: not a NIfTI image");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { std::memcpy(h.magic, "ni1", 4); }, small_voxels),
                "cannot be read: its voxels are in another file");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.dim[2] = -3; }, small_voxels),
                "cannot be read: its dimension 2 is -3");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.dim[0] = 12; }, small_voxels),
                "cannot be read: it says that it has 12 dimensions");
  std::vector<float> numbers(24, 1.f);
  numbers[4 + 2] = std::nanf("");
  const std::string bytes(reinterpret_cast<const char*>(numbers.data()), 96);
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.datatype = 16, h.bitpix = 32; }, bytes),
                "voxel (2, 1, 0) is not a finite number");
  {
    std::ofstream(file("image_bad.nii")) << "no image";
    BOOST_TEST_EQ(defect(file("image_bad.nii")), "cannot be read: not a NIfTI image");
    std::ofstream(file("image_bad.nii"), std::ios::trunc);
    BOOST_TEST_EQ(defect(file("image_bad.nii")), "cannot be read: not a NIfTI image");
  }
  BOOST_TEST_EQ(defect(file("image_missing.nii")), "cannot be opened: No such file or directory");
  BOOST_TEST_EQ(defect(file("image.png")), "unknown format; expected .nii or .nii.gz");
  fs::create_directories(file("image_directory.nii"));
  BOOST_TEST_EQ(defect(file("image_directory.nii")), "is a directory");

  // Compressed: cut off anywhere, and damaged.
  Voxel_image_3 image;
  image.grid.size = {20, 20, 20};
  std::mt19937 random(6);
  for(int i = 0; i < 8000; ++i)
    image.values.push_back(float(random() % 100));
  BOOST_TEST(!IO::write_NIFTI(file("image_good.nii.gz"), image));
  std::ifstream in(file("image_good.nii.gz"), std::ios::binary);
  const std::string good(std::istreambuf_iterator<char>(in), {});
  for(std::size_t length = 0; length + 1 < good.size(); length += good.size() / 40) {
    std::ofstream(file("image_bad.nii.gz"), std::ios::binary) << good.substr(0, length);
    const std::string text = defect(file("image_bad.nii.gz"));
    BOOST_TEST_EQ(text, length < 100 ? "cannot be read: not a NIfTI image"
                                     : "is truncated: 20 x 20 x 20 voxels expected");
  }
  std::string damaged = good;
  damaged[good.size() - 6] = char(damaged[good.size() - 6] ^ 1);
  std::ofstream(file("image_bad.nii.gz"), std::ios::binary) << damaged;
  BOOST_TEST_EQ(defect(file("image_bad.nii.gz")), "is damaged: its compressed data are not valid");

  // Any byte of the header wrong: read, or refused with a line.
  for(std::size_t i = 0; i < 352; ++i)
    for(int value : {0, 1, 127, 128, 255}) {
      const nifti_1_header header = small_header();
      std::string text(reinterpret_cast<const char*>(&header), sizeof(header));
      text += no_extension + small_voxels;
      text[i] = char(value);
      std::ofstream(file("image_bad.nii"), std::ios::binary) << text;
      BOOST_TEST(!defect(file("image_bad.nii")).empty());
    }

  // Writing.
  image.values.pop_back();
  BOOST_TEST_EQ(*IO::write_NIFTI(file("image_out.nii"), image),
                file("image_out.nii") + ": the image does not have the size of its grid");
  image.values.push_back(0);
  BOOST_TEST_EQ(*IO::write_NIFTI(file("image_out.png"), image),
                file("image_out.png") + ": unknown extension, known are .nii .nii.gz");
  BOOST_TEST(IO::write_NIFTI(file("no_such_directory/image.nii"), image).has_value());
  if(fs::exists("/dev/full")) {
    fs::remove(file("image_full.nii.gz"));
    fs::create_symlink("/dev/full", file("image_full.nii.gz"));
    BOOST_TEST_EQ(*IO::write_NIFTI(file("image_full.nii.gz"), image),
                  file("image_full.nii.gz") + ": cannot write: No space left on device");
  }
  BOOST_TEST(!fs::exists(file("image_out.nii")));

  // Meshes that do not fit.
  const Mesh far = four_kinds(20, {1000, 0, 0});
  const auto message = [&](const Mesh& mesh, const std::vector<Vec3>& u) -> std::string {
    try {
      warp_image(image, mesh, u);
    } catch(const std::runtime_error& e) {
      return e.what();
    }
    return "none";
  };
  std::vector<Vec3> u(12, Vec3{});
  BOOST_TEST_EQ(message(far, u), "the image and the mesh do not overlap: the image's center is at "
                                 "(9.5, 9.5, 9.5), the mesh's at (1020, 10, 20) (millimeters)");
  BOOST_TEST_EQ(message(Mesh(), {}).find("the image and the mesh do not overlap"), 0u);
  const Mesh near = four_kinds(5, {0, 0, 0});
  BOOST_TEST_EQ(message(near, u), "none");
  u[3][1] = std::numeric_limits<double>::infinity();
  BOOST_TEST_EQ(message(near, u), "vertex 3 of the mesh does not have a finite position and displacement");
  // An inverted mesh is no reason to crash.
  std::mt19937 wild(2);
  for(Vec3& v : u)
    v = {double(wild() % 20), double(wild() % 20), double(wild() % 20)};
  BOOST_TEST_EQ(message(near, u), "none");
}

void test_warped_files()
{
  const Scene scene(false);
  const Warped_image_3 warped = warp_image(scene.image, scene.mesh, scene.displacements(bend));
  IO::Output_files files;
  BOOST_TEST(!IO::write_warped_image(files, file("image_warped.nii.gz"), warped));
  BOOST_TEST(!files.commit());
  BOOST_TEST(IO::read_NIFTI(file("image_warped.nii.gz")).values == warped.image.values);
  BOOST_TEST(IO::read_NIFTI(file("image_warped_mask.nii.gz")).values == warped.mask.values);
  for(const char* name : {"image_warped_forward.nii.gz", "image_warped_backward.nii.gz"})
    BOOST_TEST_EQ(defect(file(name)),
                  "is a 5-D image of 61 x 57 x 49 x 1 x 3 values; expected three dimensions");
}

} // namespace

int main(int argc, char** argv)
{
  directory = argc > 1 ? argv[1] : ".";
  fs::create_directories(directory);
  test_affine_maps();
  test_inverse_map<TETRAHEDRON>();
  test_inverse_map<PYRAMID>();
  test_inverse_map<PRISM>();
  test_inverse_map<HEXAHEDRON>();
  test_locator();
  test_identity();
  for(bool mirror : {false, true}) {
    test_affine_displacement(mirror);
    test_fields_are_inverse(mirror);
  }
  test_outside();
  test_fade();
  test_resection();
  test_round_trips();
  test_orientation();
  test_bad_input();
  test_warped_files();
  return boost::report_errors();
}
