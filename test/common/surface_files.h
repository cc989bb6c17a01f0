// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surface files as text: the unit cube in all formats, the results of reading them, damaged copies.

#ifndef MIXED_MESH_3_TEST_SURFACE_FILES_H
#define MIXED_MESH_3_TEST_SURFACE_FILES_H

#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace surface_files {

namespace fs = std::filesystem;
namespace IO = CGAL::Mixed_meshes_3::IO;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

struct Result
{
  bool is_read = false;
  std::string error;
  IO::Surface_input input;
  Surface surface;

  CGAL::Bbox_3 bbox() const { return CGAL::bbox_3(surface.points().begin(), surface.points().end()); }
};

inline bool mentions(const std::string& text, const std::string& part)
{
  return text.find(part) != text.npos;
}

inline bool has_warning(const Result& r, const std::string& text)
{
  return std::any_of(r.input.warnings.begin(), r.input.warnings.end(),
                     [&text](const std::string& w) { return mentions(w, text); });
}

inline void set_contents(const fs::path& path, const std::string& contents)
{
  std::ofstream(path, std::ios_base::binary) << contents;
}

// Reads a file that has these contents.
template <class Read_file, class Options>
Result read_contents(const Read_file& read_file, const fs::path& path, const std::string& contents,
                     const Options& options)
{
  set_contents(path, contents);
  return read_file(path.string(), options);
}

// Checks that a result is a refusal in one line, with these words.
inline void is_refused(const Result& r, const std::string& words)
{
  BOOST_TEST(!r.is_read);
  if(!mentions(r.error, words))
    std::cerr << "expected \"" << words << "\", not \"" << r.error << "\"\n";
  BOOST_TEST(mentions(r.error, words));
  BOOST_TEST(std::none_of(r.error.begin(), r.error.end(), [](char c) { return c >= 0 && c < ' '; }));
}

// ---- the unit cube -----------------------------------------------------------------------------

inline const std::string cube_points = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n";
inline const std::array<std::array<int, 4>, 6> quads{
  {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

inline std::vector<std::array<int, 3>> triangles()
{
  std::vector<std::array<int, 3>> result;
  for(const auto& q : quads) {
    result.push_back({q[0], q[1], q[2]});
    result.push_back({q[0], q[2], q[3]});
  }
  return result;
}

// Lines "3 0 2 3", with a first vertex.
inline std::string triangle_lines(int first = 0)
{
  std::string lines;
  for(const auto& t : triangles())
    lines += "3 " + std::to_string(t[0] + first) + " " + std::to_string(t[1] + first) + " "
             + std::to_string(t[2] + first) + "\n";
  return lines;
}

inline std::string off(const std::string& points = cube_points, const std::string& faces = triangle_lines())
{
  return "OFF\n" + std::to_string(std::count(points.begin(), points.end(), '\n')) + " "
         + std::to_string(std::count(faces.begin(), faces.end(), '\n')) + " 0\n" + points + faces;
}

template <class Number>
inline std::string bytes_of(Number x, bool is_big)
{
  std::string bytes(sizeof x, '\0');
  std::memcpy(bytes.data(), &x, sizeof x);
#ifdef CGAL_BIG_ENDIAN
  is_big = !is_big;
#endif
  if(is_big)
    std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

inline double cube_coordinate(int v, int k) { return v >> k & 1; }

inline void is_cube(const Result& r)
{
  if(!r.is_read)
    std::cerr << r.error << '\n';
  BOOST_TEST(r.is_read);
  BOOST_TEST_EQ(r.input.number_of_components, 1u);
  BOOST_TEST_LE(std::abs(r.input.volume - 1), 1e-15);
  BOOST_TEST_EQ(r.surface.number_of_vertices(), 8u);
  BOOST_TEST_EQ(r.surface.number_of_faces(), 12u);
  BOOST_TEST(r.is_read && r.bbox() == CGAL::Bbox_3(0, 0, 0, 1, 1, 1));
}

inline std::string stl(bool is_binary, const std::string& name)
{
  std::string result = is_binary
                         ? name + std::string(80 - name.size(), ' ') + bytes_of(std::uint32_t(12), false)
                         : "solid " + name + "\n";
  for(const auto& t : triangles()) {
    result += is_binary ? std::string(12, '\0') : "facet normal nan nan nan\nouter loop\n";
    for(int v : t)
      for(int k = 0; k < 3; ++k) {
        const double x = cube_coordinate(v, k);
        result += is_binary ? bytes_of(float(x), false)
                            : (k == 0 ? "vertex " : " ") + std::to_string(x) + (k == 2 ? "\n" : "");
      }
    result += is_binary ? std::string(2, '\0') : "endloop\nendfacet\n";
  }
  return result + (is_binary ? "" : "endsolid " + name + "\n");
}

// A PLY file with coordinates and indices of any types.
template <class Coordinate, class Count, class Index>
std::string ply(const std::string& format, const std::string& coordinate, const std::string& count,
                const std::string& index)
{
  const bool is_text = format == "ascii", is_big = format == "binary_big_endian";
  std::string result = "ply\nformat " + format
                       + " 1.0\ncomment made by hand\nelement edge 1\nproperty list uchar "
                       + "short points\nelement vertex 8\nproperty uchar red\n";
  for(const char* name : {"x", "y", "z"})
    result += "property " + coordinate + " " + name + "\n";
  result += "property double quality\nelement face 12\nproperty float area\nproperty list " + count + " "
            + index + " vertex_indices\nend_header\n";
  const auto add = [&](auto x) { result += is_text ? std::to_string(x) + " " : bytes_of(x, is_big); };
  add(std::uint8_t(2)), add(std::int16_t(0)), add(std::int16_t(-1));
  for(int v = 0; v < 8; ++v) {
    add(std::uint8_t(200));
    for(int k = 0; k < 3; ++k)
      add(Coordinate(cube_coordinate(v, k)));
    add(0.25);
  }
  for(const auto& t : triangles()) {
    add(0.5f);
    add(Count(3));
    for(int v : t)
      add(Index(v));
  }
  return result;
}

inline std::string polydata(bool is_binary, const std::string& title = "cube")
{
  std::string result = "# vtk DataFile Version 3.0\n" + title + "\n" + (is_binary ? "BINARY" : "ASCII")
                       + "\nDATASET POLYDATA\nFIELD FieldData 1\ntime 1 2 double\n";
  const auto add = [&](auto x) { result += is_binary ? bytes_of(x, true) : std::to_string(x) + " "; };
  add(1.5), add(2.5);
  result += "\nPOINTS 8 float\n";
  for(int v = 0; v < 8; ++v)
    for(int k = 0; k < 3; ++k)
      add(float(cube_coordinate(v, k)));
  result += "\nMETADATA\nINFORMATION 0\n\nVERTICES 1 2\n";
  add(std::int32_t(1)), add(std::int32_t(0));
  result += "\nPOLYGONS 4 20\n";
  for(int i = 0; i < 4; ++i)
    for(std::int32_t x : {4, quads[i][0], quads[i][1], quads[i][2], quads[i][3]})
      add(x);
  result += "\nTRIANGLE_STRIPS 2 10\n";
  for(int i = 4; i < 6; ++i)
    for(std::int32_t x : {4, quads[i][0], quads[i][1], quads[i][3], quads[i][2]})
      add(x);
  return result + "\nPOINT_DATA 8\nSCALARS anything\n";
}

// ---- files of others ---------------------------------------------------------------------------

inline std::string quoted(const std::string& text)
{
  std::string result = "\"";
  for(char c : text)
    result += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  return result + "\"";
}

inline void print(const Result& r)
{
  std::cout.precision(17);
  if(!r.is_read) {
    std::cout << quoted(r.error) << '\n';
    return;
  }
  const CGAL::Bbox_3 b = r.bbox();
  std::cout << "{\"vertices\": " << r.surface.number_of_vertices()
            << ", \"faces\": " << r.surface.number_of_faces() << ", \"volume\": " << r.input.volume
            << ", \"box\": [" << b.xmin() << ", " << b.ymin() << ", " << b.zmin() << ", " << b.xmax() << ", "
            << b.ymax() << ", " << b.zmax() << "], \"warnings\": [";
  for(std::size_t i = 0; i < r.input.warnings.size(); ++i)
    std::cout << (i == 0 ? "" : ", ") << quoted(r.input.warnings[i]);
  std::cout << "]}\n";
}

// Files cut off anywhere, and with wrong bytes: they are refused in one line, or the result is a surface.
template <class Read_file>
inline void test_damage(const fs::path& path, const Read_file& read_file)
{
  std::ifstream in(path, std::ios_base::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const fs::path damaged = path.parent_path() / ("damaged_" + path.filename().string());
  std::mt19937 random(7);
  for(int trial = 0; trial < 60; ++trial) {
    std::string wrong = bytes;
    if(trial % 3 == 0)
      wrong.resize(random() % wrong.size());
    else if(trial % 3 == 1)
      wrong[random() % wrong.size()] = char(random());
    else // where headers are
      for(int i = 0; i < 3; ++i)
        wrong[random() % (std::min)(wrong.size(), std::size_t(400))] =
          "0123456789-e\" \n\xff<>"[random() % 18];
    set_contents(damaged, wrong);
    const Result r = read_file(damaged.string());
    BOOST_TEST(r.is_read || !r.error.empty());
    BOOST_TEST(std::none_of(r.error.begin(), r.error.end(), [](char c) { return c >= 0 && c < ' '; }));
    if(r.is_read)
      BOOST_TEST(CGAL::is_closed(r.surface) && r.input.volume > 0);
  }
  fs::remove(damaged);
}

} // namespace surface_files

#endif // MIXED_MESH_3_TEST_SURFACE_FILES_H
