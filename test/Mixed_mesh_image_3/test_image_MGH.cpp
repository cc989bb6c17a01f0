// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of FreeSurfer, written here byte by byte; test_segmentation.py has those of another program.
//
//   test_image_MGH [DIRECTORY]    writes images there (default: the current directory)

#include "test_images.h"

#include <CGAL/Mixed_mesh_image_3/IO/MGH.h>
#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/IO/read_voxel_image.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <boost/core/lightweight_test.hpp>

#include <zlib.h>

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
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Mixed_meshes_3;
namespace IO = CGAL::Mixed_meshes_3::IO;
namespace fs = std::filesystem;

namespace test_image_MGH {

fs::path directory;

std::string file(const std::string& name) { return (directory / name).string(); }

template <class T>
void append(std::string& bytes, T number)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(T)); // tests run where bytes are in little-endian order
  for(std::size_t i = sizeof(T); i-- > 0;)
    bytes += char(bits >> 8 * i & 255);
}

struct Image
{
  std::int32_t version = 1, sizes[3] = {4, 3, 2}, frames = 1, type = 0;
  std::int16_t has_positions = 1;
  float spacing[3] = {1.5, 2, 0.5};
  float axes[3][3] = {{0, -1, 0}, {0, 0, 1}, {-1, 0, 0}};
  float center[3] = {10, 20, 30};
  std::string voxels = "abcdefghijklmnopqrstuvwx";

  std::string bytes() const
  {
    std::string bytes;
    append(bytes, version);
    for(std::int32_t n : sizes)
      append(bytes, n);
    append(bytes, frames);
    append(bytes, type);
    append(bytes, std::int32_t(0));
    append(bytes, has_positions);
    for(float x : spacing)
      append(bytes, x);
    for(const auto& axis : axes)
      for(float x : axis)
        append(bytes, x);
    for(float x : center)
      append(bytes, x);
    BOOST_TEST_EQ(bytes.size(), 90u);
    bytes.resize(284, '\0');
    return bytes + voxels;
  }
};

void write(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

// The line with the reason why a file is refused.
std::string defect(const std::string& path)
{
  Voxel_image_3 image;
  image.values = {5};
  std::string text;
  if(IO::read_MGH(path, image, &text)) {
    BOOST_TEST_EQ(image.values.size(), image.grid.number_of_voxels());
    return "none";
  }
  BOOST_TEST(image.values == std::vector<float>{5});
  BOOST_TEST_EQ(text.find(path + ": "), 0u);
  BOOST_TEST(text.find('\n') == std::string::npos);
  return text.substr((std::min)(path.size() + 2, text.size()));
}

Voxel_image_3 read(const Image& source, const char* name = "image_read.mgh")
{
  write(file(name), source.bytes());
  Voxel_image_3 image;
  BOOST_TEST(IO::read_voxel_image(file(name), image));
  return image;
}

void test_positions()
{
  const Voxel_image_3 image = read(Image());
  BOOST_TEST((image.grid.size == std::array<std::size_t, 3>{4, 3, 2}));
  BOOST_TEST_EQ(image.grid.world, 1);
  const Affine_map_3 expected{{{0, 0, -0.5, 10.5}, {-1.5, 0, 0, 23}, {0, 2, 0, 27}}};
  BOOST_TEST_EQ(difference(image.grid.index_to_world, expected), 0.);
  // Half the sizes in indices are at the center.
  const auto center = transform(image.grid.index_to_world, {2, 1.5, 1});
  BOOST_TEST((center == std::array<double, 3>{10, 20, 30}));
  BOOST_TEST_EQ(image.values[image.grid.offset(1, 0, 0)], float('b'));
  BOOST_TEST_EQ(image.values[image.grid.offset(3, 2, 1)], float('x'));
  BOOST_TEST(read(Image(), "image_read.MGZ").values == image.values); // not compressed, and capital letters
  // Without positions, whatever is in their place: those of the format.
  Image silent;
  silent.has_positions = 0;
  silent.spacing[0] = -1;
  silent.center[1] = std::nanf("");
  const Voxel_image_3 coronal = read(silent);
  const Affine_map_3 usual{{{-1, 0, 0, 2}, {0, 0, 1, -1}, {0, -1, 0, 1.5}}};
  BOOST_TEST_EQ(difference(coronal.grid.index_to_world, usual), 0.);
  BOOST_TEST_EQ(coronal.grid.world, 0);
}

template <class T>
void test_type(std::int32_t type, Voxel_type expected, const std::vector<T>& numbers)
{
  Image source;
  source.type = type;
  source.voxels.clear();
  for(std::size_t i = 0; i < 24; ++i)
    append(source.voxels, numbers[i % numbers.size()]);
  const Voxel_image_3 image = read(source);
  BOOST_TEST(image.type == expected);
  for(std::size_t i = 0; i < 24; ++i)
    BOOST_TEST_EQ(image.values[i], float(numbers[i % numbers.size()]));
  source.voxels.pop_back();
  write(file("image_bad.mgh"), source.bytes());
  BOOST_TEST_EQ(defect(file("image_bad.mgh")), "is truncated: 4 x 3 x 2 voxels expected");
}

void test_types()
{
  test_type<std::uint8_t>(0, Voxel_type::UINT8, {0, 1, 127, 128, 255});
  test_type<std::int32_t>(1, Voxel_type::INT32, {-2147483647 - 1, -1, 0, 1, 258, 16777216});
  test_type<float>(3, Voxel_type::FLOAT32, {-1.5f, 3e-30f, 0.1f, 3e38f});
  test_type<std::int16_t>(4, Voxel_type::INT16, {-32768, -1, 0, 1, 258, 32767});
  test_type<std::uint16_t>(10, Voxel_type::UINT16, {0, 1, 258, 32768, 65535});
}

void test_bad_input()
{
  const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
  const auto defect_of = [](const std::function<void(Image&)>& change) {
    Image image;
    change(image);
    write(file("image_bad.mgh"), image.bytes());
    return defect(file("image_bad.mgh"));
  };
  const auto refused = [](const std::string& field, const std::string& value, const std::string& expected) {
    return "cannot be read: its " + field + " is " + value + "; expected " + expected;
  };
  BOOST_TEST_EQ(defect_of([](Image&) {}), "none");
  BOOST_TEST_EQ(defect_of([](Image& i) { i.voxels += "parameters of the scan"; }), "none");
  for(std::int32_t version : {0, 2, 1 << 24})
    BOOST_TEST_EQ(defect_of([&](Image& i) { i.version = version; }),
                  "cannot be read: not an image of FreeSurfer of version 1");
  BOOST_TEST_EQ(defect_of([](Image& i) { i.frames = 2; }),
                "is a 4-D image of 4 x 3 x 2 x 2 values; expected three dimensions");
  BOOST_TEST_EQ(defect_of([](Image& i) { i.frames = -1; }), refused("nframes", "-1", "1"));
  for(int n : {0, -3, 2147483647})
    BOOST_TEST_EQ(defect_of([&](Image& i) { i.sizes[1] = n; }),
                  refused("height", std::to_string(n), "a number of voxels from 1 to 1000000000"));
  BOOST_TEST_EQ(defect_of([](Image& i) { i.sizes[0] = i.sizes[1] = i.sizes[2] = 1000000000; }),
                "is truncated: 1000000000 x 1000000000 x 1000000000 voxels expected");
  BOOST_TEST_EQ(defect_of([](Image& i) { i.sizes[2] = 3; }), "is truncated: 4 x 3 x 3 voxels expected");
  for(std::int32_t type : {-1, 2, 5, 6, 7, 8, 9, 11})
    BOOST_TEST_EQ(defect_of([&](Image& i) { i.type = type; }),
                  "has voxels of type " + std::to_string(type)
                    + "; expected 0 (uchar), 1 (int), 3 (float), 4 (short) or 10 (ushort)");
  for(const auto& [size, text] :
      {std::pair<float, const char*>{0.f, "0"}, {-1.f, "-1"}, {nan, "nan"}, {infinity, "inf"}})
    BOOST_TEST_EQ(defect_of([value = size](Image& i) { i.spacing[1] = value; }),
                  refused("spacing y", text, "a size greater than 0"));
  BOOST_TEST_EQ(defect_of([&](Image& i) { i.axes[2][1] = nan; }), refused("z_a", "nan", "a finite number"));
  BOOST_TEST_EQ(defect_of([&](Image& i) { i.center[2] = infinity; }),
                refused("c_s", "inf", "a finite number"));
  BOOST_TEST_EQ(defect_of([](Image& i) { i.center[0] = 1e20f; }),
                "its orientation has entries that are too large");
  BOOST_TEST_EQ(defect_of([](Image& i) { i.spacing[0] = i.axes[0][1] = 3e38f; }),
                "its orientation has entries that are too large");
  BOOST_TEST_EQ(defect_of([](Image& i) { i.axes[0][1] = 0; }), "its matrix of x_r to z_s is singular");
  BOOST_TEST_EQ(defect_of([&](Image& i) {
                  i.type = 3;
                  i.voxels.clear();
                  for(int k = 0; k < 24; ++k)
                    append(i.voxels, k == 6 ? nan : 1.f);
                }),
                "voxel (2, 1, 0) is not a finite number");

  // Files are cut off anywhere; any byte of the header is wrong.
  const std::string good = Image().bytes();
  for(std::size_t length = 0; length < good.size(); ++length) {
    write(file("image_bad.mgh"), good.substr(0, length));
    BOOST_TEST_EQ(defect(file("image_bad.mgh")),
                  length < 284 ? "cannot be read: not an image of FreeSurfer, or truncated"
                               : "is truncated: 4 x 3 x 2 voxels expected");
  }
  for(std::size_t i = 0; i < 90; ++i)
    for(int value : {0, 1, 127, 128, 255}) {
      std::string bytes = good;
      bytes[i] = char(value);
      write(file("image_bad.mgh"), bytes);
      BOOST_TEST(!defect(file("image_bad.mgh")).empty());
    }
  BOOST_TEST_EQ(defect(file("image_missing.mgz")), "cannot be opened: No such file or directory");
  BOOST_TEST_EQ(defect(file("image.nii")), "unknown format; expected .mgh or .mgz");
  fs::create_directories(file("image_directory.mgh"));
  BOOST_TEST_EQ(defect(file("image_directory.mgh")), "is a directory");
}

void test_compressed()
{
  Image source;
  std::fill(source.sizes, source.sizes + 3, 20);
  source.voxels.clear();
  std::mt19937 random(6);
  for(int i = 0; i < 8000; ++i)
    source.voxels += char(random() % 100);
  const std::string bytes = source.bytes() + std::string(100000, 'p'); // with parameters of the scan
  const gzFile output = gzopen(file("image_good.mgz").c_str(), "wb");
  BOOST_TEST_EQ(gzwrite(output, bytes.data(), unsigned(bytes.size())), int(bytes.size()));
  BOOST_TEST_EQ(gzclose(output), Z_OK);
  Voxel_image_3 image;
  BOOST_TEST(IO::read_voxel_image(file("image_good.mgz"), image));
  for(std::size_t i = 0; i < 8000; ++i)
    BOOST_TEST_EQ(image.values[i], float(source.voxels[i]));
  fs::copy_file(file("image_good.mgz"), file("image_good.mgh.gz"), fs::copy_options::overwrite_existing);
  BOOST_TEST_EQ(defect(file("image_good.mgh.gz")), "none");

  std::ifstream in(file("image_good.mgz"), std::ios::binary);
  const std::string good(std::istreambuf_iterator<char>(in), {});
  for(std::size_t length = 0; length + 1 < good.size(); length += good.size() / 40) {
    write(file("image_bad.mgz"), good.substr(0, length));
    BOOST_TEST_EQ(defect(file("image_bad.mgz")),
                  length < 100 ? "cannot be read: not an image of FreeSurfer, or truncated"
                               : "is truncated: 20 x 20 x 20 voxels expected");
  }
  std::string damaged = good;
  damaged[good.size() - 6] = char(damaged[good.size() - 6] ^ 1);
  write(file("image_bad.mgz"), damaged);
  BOOST_TEST_EQ(defect(file("image_bad.mgz")), "is damaged: its compressed data are not valid");
}

// The format of an image is told by the ending of its name.
void test_endings()
{
  std::string error;
  Voxel_image_3 image;
  for(const char* name : {"image.png", "image.gz", "image.mgz.gz", "mgh", "image.nii.bz2"}) {
    BOOST_TEST(!IO::read_voxel_image(file(name), image, &error));
    BOOST_TEST_EQ(error, file(name) + ": unknown format; expected .nii, .nii.gz, .mgh or .mgz");
  }
  const Voxel_image_3 source = read(Image());
  BOOST_TEST(IO::write_NIFTI(file("image_endings.nii.gz"), source));
  fs::rename(file("image_endings.nii.gz"), file("image_endings.NII.GZ"));
  BOOST_TEST(IO::read_voxel_image(file("image_endings.NII.GZ"), image));
  BOOST_TEST(image.values == source.values);
  BOOST_TEST_EQ(difference(image.grid.index_to_world, source.grid.index_to_world), 0.);
}

int run(int argc, char* argv[])
{
  directory = argc > 2 ? argv[2] : ".";
  fs::create_directories(directory);
  test_positions();
  test_types();
  test_bad_input();
  test_compressed();
  test_endings();
  return boost::report_errors();
}

} // namespace test_image_MGH
