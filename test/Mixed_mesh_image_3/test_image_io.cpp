// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of images.
//
//   test_image_io [DIRECTORY]    writes images there (default: the current directory), and their content to
//                                image_expected.json, for test_image_readers.py

#include "test_images.h"

#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/IO/write_warped_image.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
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

namespace test_image_io {

fs::path directory;

std::string file(const std::string& name) { return (directory / name).string(); }

template <class T>
void write_bytes(const std::string& path, const T& header, const std::string& rest)
{
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&header), sizeof(header));
  out << rest;
}

// The line with the reason why a file is refused.
std::string defect(const std::string& path)
{
  Voxel_image_3 image;
  std::string text;
  if(IO::read_NIFTI(path, image, &text))
    return "none";
  BOOST_TEST_EQ(text.find(path + ": "), 0u);
  BOOST_TEST(text.find('\n') == std::string::npos);
  return text.substr((std::min)(path.size() + 2, text.size()));
}

Voxel_image_3 read_image(const std::string& path)
{
  Voxel_image_3 image;
  BOOST_TEST(IO::read_NIFTI(path, image));
  return image;
}

std::string write_error(const std::string& path, const Voxel_image_3& image)
{
  std::string error;
  BOOST_TEST(!IO::write_NIFTI(path, image, &error));
  return error;
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
        BOOST_TEST(IO::write_NIFTI(file(name), image));
        const Voxel_image_3 read = read_image(file(name));
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
  BOOST_TEST(IO::write_NIFTI(file("image_field.nii.gz"), field));
  expected << "],\n\"field\": [";
  for(std::size_t i = 0; i < 60; ++i)
    expected << (i == 0 ? "[" : ", [") << double(field.vectors[i][0]) << ", " << double(field.vectors[i][1])
             << ", " << double(field.vectors[i][2]) << "]";
  expected << "]}\n";

  // Slope and intercept: values are rounded to the nearest of the type, and cut off at its ends.
  Voxel_image_3 scaled;
  scaled.grid.size = {5, 1, 1};
  scaled.type = Voxel_type::UINT8;
  scaled.slope = 0.5;
  scaled.intercept = 10;
  scaled.values = {10, 10.5f, 11.2f, -100, 1000};
  BOOST_TEST(IO::write_NIFTI(file("image_scaled.nii"), scaled));
  const Voxel_image_3 read = read_image(file("image_scaled.nii"));
  BOOST_TEST(read.values == (std::vector<float>{10, 10.5f, 11, 10, 137.5f}));
  BOOST_TEST(read.slope == 0.5 && read.intercept == 10 && read.type == Voxel_type::UINT8);
  // Axes that are not at right angles: only the sform can represent these.
  Voxel_image_3 sheared = scaled;
  sheared.grid.index_to_world[0] = {1, 0.3, 0, 5};
  BOOST_TEST(IO::write_NIFTI(file("image_sheared.nii"), sheared));
  BOOST_TEST_LT(difference(read_image(file("image_sheared.nii")).grid.index_to_world,
                           sheared.grid.index_to_world),
                1e-6);
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
    return read_image(file("image_map.nii")).grid;
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
                           Affine_map_3{{{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}}}),
                1e-12);
  BOOST_TEST_EQ(read_map(header).world, 0);
  // units
  header.sform_code = 2;
  for(const auto& unit : {std::pair<int, double>{NIFTI_UNITS_METER, 1000},
                          {NIFTI_UNITS_MM, 1},
                          {NIFTI_UNITS_MICRON, 1e-3},
                          {NIFTI_UNITS_UNKNOWN, 1}}) {
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
  const Voxel_image_3 image = read_image(file("image_swapped.nii"));
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
  BOOST_TEST_EQ(difference(read_image(file("image_second.nii")).grid.index_to_world, sform), 0.);
}

// Numbers that nifti_clib replaces by others: voxels would be read from another place, have another meaning,
// or be elsewhere in the world.
void test_numbers_of_headers()
{
  const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
  const auto defect_of = [](const std::function<void(nifti_1_header&)>& change) {
    nifti_1_header header = small_header();
    header.sform_code = 0;
    header.qform_code = 1;
    change(header);
    write_bytes(file("image_bad.nii"), header, no_extension + small_voxels);
    const std::string text = defect(file("image_bad.nii"));
    swap_nifti_header(&header, 1);
    write_bytes(file("image_bad.nii"), header, no_extension + small_voxels);
    BOOST_TEST_EQ(text, defect(file("image_bad.nii")));
    return text;
  };
  const auto refused = [](const std::string& field, const std::string& value, const std::string& expected) {
    return "cannot be read: its " + field + " is " + value + "; expected " + expected;
  };
  BOOST_TEST_EQ(defect_of([](nifti_1_header&) {}), "none");
  for(const auto& [offset, text] : {std::pair<float, const char*>{nan, "nan"},
                                    {-1.f, "-1"},
                                    {1e15f, "1e+15"},
                                    {348.f, "348"},
                                    {0.f, "0"},
                                    {352.5f, "352.5"},
                                    {infinity, "inf"}})
    BOOST_TEST_EQ(defect_of([value = offset](nifti_1_header& h) { h.vox_offset = value; }),
                  refused("vox_offset", text, "an integer from 352 to the size of the file"));
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.vox_offset = 353; }),
                "is truncated: 4 x 3 x 2 voxels expected");
  struct Field
  {
    const char* name;
    std::function<float&(nifti_1_header&)> value;
  };
  for(const Field& field : {Field{"scl_slope", [](nifti_1_header& h) -> float& { return h.scl_slope; }},
                            {"scl_inter", [](nifti_1_header& h) -> float& { return h.scl_inter; }},
                            {"pixdim[0]", [](nifti_1_header& h) -> float& { return h.pixdim[0]; }},
                            {"pixdim[2]", [](nifti_1_header& h) -> float& { return h.pixdim[2]; }},
                            {"quatern_b", [](nifti_1_header& h) -> float& { return h.quatern_b; }},
                            {"quatern_d", [](nifti_1_header& h) -> float& { return h.quatern_d; }},
                            {"qoffset_z", [](nifti_1_header& h) -> float& { return h.qoffset_z; }}}) {
    BOOST_TEST_EQ(defect_of([&](nifti_1_header& h) { field.value(h) = nan; }),
                  refused(field.name, "nan", "a finite number"));
    BOOST_TEST_EQ(defect_of([&](nifti_1_header& h) { field.value(h) = -infinity; }),
                  refused(field.name, "-inf", "a finite number"));
  }
  for(const auto& [size, text] : {std::pair<float, const char*>{0.f, "0"}, {-2.f, "-2"}})
    BOOST_TEST_EQ(defect_of([value = size](nifti_1_header& h) { h.pixdim[3] = value; }),
                  refused("pixdim[3]", text, "a size greater than 0"));
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.quatern_b = 2; }),
                refused("quaternion (quatern_b, quatern_c, quatern_d)", "2", "at most 1, its length"));
  // Fields that do not count may have any value.
  BOOST_TEST_EQ(defect_of([&](nifti_1_header& h) { h.scl_slope = 0, h.scl_inter = nan; }), "none");
  BOOST_TEST_EQ(defect_of([&](nifti_1_header& h) { h.qform_code = 0, h.quatern_b = nan; }), "none");
  BOOST_TEST_EQ(defect_of([&](nifti_1_header& h) { h.pixdim[4] = nan; }), "none");
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
                "cannot be read: its srow_x[3] is nan; expected a finite number");
  BOOST_TEST_EQ(defect_of([](nifti_1_header& h) { h.srow_x[3] = 1e20f; }, small_voxels),
                "its orientation has entries that are too large");
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

  // Compressed files are cut off anywhere, and damaged.
  Voxel_image_3 image;
  image.grid.size = {20, 20, 20};
  std::mt19937 random(6);
  for(int i = 0; i < 8000; ++i)
    image.values.push_back(float(random() % 100));
  BOOST_TEST(IO::write_NIFTI(file("image_good.nii.gz"), image));
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

  // Any byte of the header is wrong: the file is read, or refused with a line.
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
  BOOST_TEST_EQ(write_error(file("image_out.nii"), image),
                file("image_out.nii") + ": the image does not have the size of its grid");
  image.values.push_back(0);
  BOOST_TEST_EQ(write_error(file("image_out.png"), image),
                file("image_out.png") + ": unknown extension, known are .nii .nii.gz");
  BOOST_TEST(!write_error(file("no_such_directory/image.nii"), image).empty());
  if(fs::exists("/dev/full")) {
    fs::remove(file("image_full.nii.gz"));
    fs::create_symlink("/dev/full", file("image_full.nii.gz"));
    BOOST_TEST_EQ(write_error(file("image_full.nii.gz"), image),
                  file("image_full.nii.gz") + ": cannot write: No space left on device");
  }
  BOOST_TEST(!fs::exists(file("image_out.nii")));
}

void test_warped_files()
{
  const Scene scene(false);
  const Warped_image_3 warped = warp_image(scene.image, scene.mesh, scene.displacements(bend));
  IO::Output_files files;
  const std::vector<IO::Field_format> formats{IO::Field_format::NIFTI, IO::Field_format::ITK,
                                              IO::Field_format::NRRD};
  BOOST_TEST(IO::write_warped_image(files, file("image_warped.nii.gz"), warped, formats));
  BOOST_TEST(IO::write_NRRD(files, file("image_raw.nrrd"), warped.backward, false));
  BOOST_TEST(IO::write_NIFTI(files, file("image_unwarped.nii.gz"), scene.image));
  BOOST_TEST(files.commit());
  // Fields are written when requested.
  BOOST_TEST(IO::write_warped_image(files, file("image_only.nii"), warped));
  BOOST_TEST(files.commit());
  BOOST_TEST(fs::exists(file("image_only_mask.nii")) && !fs::exists(file("image_only_backward.nii")));
  std::string error;
  BOOST_TEST(!IO::write_NRRD(files, file("image.nii"), warped.backward, true, &error));
  BOOST_TEST_EQ(error, file("image.nii") + ": unknown extension, known is .nrrd");
  Displacement_field_3 short_field = warped.backward;
  short_field.vectors.pop_back();
  BOOST_TEST(!IO::write_NRRD(files, file("image.nrrd"), short_field, true, &error));
  BOOST_TEST_EQ(error, file("image.nrrd") + ": the field does not have the size of its grid");
  BOOST_TEST(read_image(file("image_warped.nii.gz")).values == warped.image.values);
  BOOST_TEST(read_image(file("image_warped_mask.nii.gz")).values == warped.mask.values);
  for(const char* name : {"image_warped_forward.nii.gz", "image_warped_backward.nii.gz"})
    BOOST_TEST_EQ(defect(file(name)),
                  "is a 5-D image of 61 x 57 x 49 x 1 x 3 values; expected three dimensions");
}

int run(int argc, char* argv[])
{
  directory = argc > 2 ? argv[2] : ".";
  fs::create_directories(directory);
  test_round_trips();
  test_orientation();
  test_numbers_of_headers();
  test_bad_input();
  test_warped_files();
  return boost::report_errors();
}

} // namespace test_image_io
