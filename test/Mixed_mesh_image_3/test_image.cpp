// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images warped by the displacements of a mesh.

#include "test_images.h"

#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Recovered_displacement_3.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_image {

using namespace CGAL::Mixed_meshes_3;

bool is_close(const Vec3& a, const Vec3& b, double tolerance) { return norm(a - b) <= tolerance; }

Vec3 to_doubles(const std::array<float, 3>& v) { return {double(v[0]), double(v[1]), double(v[2])}; }

void test_affine_maps()
{
  for(bool mirror : {false, true}) {
    const Affine_map_3 map = oblique({1, 2, 3}, {10, -20, 30}, mirror);
    BOOST_TEST(std::abs(CGAL::Mixed_meshes_3::determinant(map) - (mirror ? -6 : 6)) < 1e-12);
    const Vec3 p{3, 5, -7};
    BOOST_TEST(is_close(transform(inverse(map), transform(map, p)), p, 1e-13));
  }
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
  BOOST_TEST(warped.mask.values
             == std::vector<float>(warped.forward.is_in_mesh.begin(), warped.forward.is_in_mesh.end()));
  double inside = 0;
  for(float m : warped.mask.values)
    inside += double(m);
  BOOST_TEST(std::abs(inside * 1.1 * 0.9 * 1.3 / volume(scene.mesh) - 1) < 0.01);
}

// The displacement u(X) = A X + b - X has the closed form of both fields, in all four kinds; without resected
// value.
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

// Both fields compared with locators.
void test_fields_are_inverse(bool mirror, Displacement_interpolation interpolation)
{
  const Scene scene(mirror);
  const auto u = scene.displacements(bend);
  Warp_options options;
  options.interpolation = interpolation;
  const Warped_image_3 warped = warp_image(scene.image, scene.mesh, u, options);
  const bool is_recovered = interpolation == Displacement_interpolation::RECOVERED;
  const Recovered_displacement_3<Mesh> recovered(scene.mesh, u);
  const Element_locator_3<Mesh> before(scene.mesh), plain(scene.mesh, u), curved(recovered);
  const Element_locator_3<Mesh>& after = is_recovered ? curved : plain;
  const std::vector<Vec3> none(u.size(), Vec3{});
  const auto deformed = [&](const Element_location_3& l) {
    return is_recovered ? position(scene.mesh, none, l) + recovered(l) : position(scene.mesh, u, l);
  };
  double largest_difference = 0;
  for_each_voxel_center(scene.image.grid, [&](std::size_t offset, const Vec3& x) {
    const Vec3 from = x + to_doubles(warped.backward.vectors[offset]);
    BOOST_TEST_EQ(bool(warped.backward.is_in_mesh[offset]), after.locate(x).has_value());
    if(warped.backward.is_in_mesh[offset])
      BOOST_TEST(is_close(deformed(before.nearest(from)), x, 1e-5));
    BOOST_TEST_EQ(bool(warped.forward.is_in_mesh[offset]), before.locate(x).has_value());
    if(!warped.forward.is_in_mesh[offset])
      return;
    const Vec3 to = x + to_doubles(warped.forward.vectors[offset]);
    BOOST_TEST(is_close(deformed(before.nearest(x)), to, 1e-5));
    if(const auto back = after.locate(to)) // else at the surface, by rounding
      BOOST_TEST(is_close(position(scene.mesh, none, *back), x, 1e-5));
    const Vec3 linear = position(scene.mesh, u, *before.locate(x));
    largest_difference = (std::max)(largest_difference, norm(linear - to));
  });
  BOOST_TEST_EQ(largest_difference > 0.01, is_recovered);
  // The image deformed and back is the former image, in the mesh, up to interpolation.
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

// Labels: the voxel whose center is nearest, by brute force; no values in between appear.
void test_labels()
{
  Scene scene(true);
  std::mt19937 random(3);
  for(float& value : scene.image.values)
    value = float(random() % 5);
  scene.image.type = Voxel_type::INT16;
  const auto u = scene.displacements(bend);
  Warp_options options;
  options.image_interpolation = Image_interpolation::NEAREST;
  const Warped_image_3 warped = warp_image(scene.image, scene.mesh, u, options);
  BOOST_TEST(warped.image.type == Voxel_type::INT16);
  BOOST_TEST(warped.image.values
             == resample_image(scene.image, warped.backward, Image_interpolation::NEAREST).values);
  const auto& map = scene.image.grid.index_to_world;
  const double diagonal = norm(Vec3{map[0][0], map[1][0], map[2][0]})
                          + norm(Vec3{map[0][1], map[1][1], map[2][1]})
                          + norm(Vec3{map[0][2], map[1][2], map[2][2]});
  std::vector<Vec3> centers;
  for_each_voxel_center(scene.image.grid, [&](std::size_t, const Vec3& x) { centers.push_back(x); });
  std::size_t moved = 0;
  for(std::size_t offset = 0; offset < centers.size(); offset += 499) {
    const Vec3 from = centers[offset] + to_doubles(warped.backward.vectors[offset]);
    double least = std::numeric_limits<double>::infinity();
    for(const Vec3& c : centers)
      least = (std::min)(least, norm(c - from));
    if(least > diagonal) // far outside
      continue;
    bool is_nearest = false; // voxels have right angles
    for(std::size_t i = 0; i < centers.size(); ++i)
      if(norm(centers[i] - from) < least + 1e-4)
        is_nearest = is_nearest || scene.image.values[i] == warped.image.values[offset];
    BOOST_TEST(is_nearest);
    moved += least > 1e-3;
  }
  BOOST_TEST_GT(moved, 50u);
  for(float value : warped.image.values)
    BOOST_TEST(value == std::floor(value) && value >= 0 && value < 5);
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

// The nearest voxel compared with brute force; sizes of voxels differ.
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
  // The resection is a predicate on points before the deformation.
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
  // The resection is by elements: without the prism. Nothing moves, so that the mask is where the elements
  // are. Displacements of vertices of the prism only do not matter.
  options = Warp_options();
  options.resected_elements = {false, true, false, false};
  auto zero = scene.displacements([](const Vec3&) { return Vec3{}; });
  zero[9] = {1e300, std::numeric_limits<double>::quiet_NaN(), 0};
  const Warped_image_3 by_elements = warp_image(scene.image, scene.mesh, zero, options);
  const Element_locator_3<Mesh> locator(scene.mesh);
  for_each_voxel_center(scene.image.grid, [&](std::size_t offset, const Vec3& x) {
    const auto l = locator.locate(x);
    const bool is_shared = l && l->element == 1 && internal::depth(PRISM, l->coordinates) < 1e-6;
    const float expected = !l ? 0.f : l->element == 1 ? 2.f : 1.f;
    if(!is_shared)
      BOOST_TEST_EQ(by_elements.mask.values[offset], expected);
    BOOST_TEST_EQ(by_elements.image.values[offset],
                  by_elements.mask.values[offset] == 2 ? 0.f : scene.image.values[offset]);
  });
}
// Meshes that do not fit.
void test_misfit()
{
  Voxel_image_3 image;
  image.grid.size = {20, 20, 20};
  image.values.resize(image.grid.number_of_voxels());
  const Mesh far = four_kinds<Mesh>(20, {1000, 0, 0});
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
  const Mesh near = four_kinds<Mesh>(5, {0, 0, 0});
  BOOST_TEST_EQ(message(near, u), "none");
  u[3][1] = std::numeric_limits<double>::infinity();
  BOOST_TEST_EQ(message(near, u), "vertex 3 of the mesh does not have a finite position and displacement");
  // An inverted mesh must not cause a crash.
  std::mt19937 wild(2);
  for(Vec3& v : u)
    v = {double(wild() % 20), double(wild() % 20), double(wild() % 20)};
  BOOST_TEST_EQ(message(near, u), "none");
}

int run(int, char*[])
{
  test_affine_maps();
  test_identity();
  for(bool mirror : {false, true}) {
    test_affine_displacement(mirror);
    test_fields_are_inverse(mirror, Displacement_interpolation::LINEAR);
    test_fields_are_inverse(mirror, Displacement_interpolation::RECOVERED);
  }
  test_labels();
  test_outside();
  test_fade();
  test_resection();
  test_misfit();
  return boost::report_errors();
}

} // namespace test_image
