// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces from files: the unit cube in all formats, and files with wrong content.
//
//   test_io_surface [DATA [DIRECTORY]]

#include "surface_files.h"

#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace test_io_surface {

using namespace surface_files;

fs::path directory = ".";

Result read_file(const std::string& path, const IO::Read_surface_options& options = {})
{
  Result r;
  r.is_read = IO::read_closed_surface(path, options, r.surface, &r.error, &r.input);
  return r;
}

Result read(const std::string& name, const std::string& contents,
            const IO::Read_surface_options& options = {})
{
  return read_contents(read_file, directory / name, contents, options);
}

void refuses(const std::string& name, const std::string& contents, const std::string& words)
{
  is_refused(read(name, contents), words);
}

// Checks that a file is read as another surface of that volume, with a line that names the defect; or
// refused, if requested.
void is_repaired(const std::string& name, const std::string& contents, const std::string& words,
                 double volume)
{
  const Result r = read(name, contents);
  BOOST_TEST(r.is_read);
  if(!r.is_read)
    std::cerr << r.error << '\n';
  BOOST_TEST(!r.input.repairs.empty() && has_warning(r, r.input.repairs.front()));
  BOOST_TEST(CGAL::is_closed(r.surface));
  for(const auto v : r.surface.vertices())
    BOOST_TEST(!r.surface.is_isolated(v));
  BOOST_TEST_LE(std::abs(r.input.volume - volume), 1e-13 * (std::max)(volume, 1.));
  IO::Read_surface_options strict;
  strict.is_strict = true;
  const Result refused = read(name, contents, strict);
  BOOST_TEST(!refused.is_read);
  BOOST_TEST(mentions(refused.error, words));
}

// ---- formats -----------------------------------------------------------------------------------

void test_off()
{
  is_cube(read("cube.off", off()));
  // The file has normals, colors, texture coordinates; comments; numbers in any style.
  std::string points, faces = triangle_lines();
  for(int v = 0; v < 8; ++v)
    points += std::to_string(v & 1) + ".0 +" + std::to_string(v >> 1 & 1) + "e0 " + std::to_string(v >> 2)
              + " 0 0 1 255 0 0 0.5 0.5 # vertex\n";
  std::replace(faces.begin(), faces.end(), '\n', ';');
  std::string colored;
  for(char c : faces)
    colored += c == ';' ? std::string(" 255 0 0\n") : std::string(1, c);
  for(const char* header : {"STOFF", "COFF", "NOFF", "STCNOFF", "OFF"})
    is_cube(
      read("cube_data.off", std::string(header) + " # comment\n\n8 12 18\n# comment\n" + points + colored));
  std::string homogeneous;
  for(int v = 0; v < 8; ++v)
    homogeneous += std::to_string(2 * (v & 1)) + " " + std::to_string(2 * (v >> 1 & 1)) + " "
                   + std::to_string(2 * (v >> 2)) + " 2\n";
  is_cube(read("cube_4.off", "4OFF\n8 12 0\n" + homogeneous + triangle_lines()));

  std::string binary = "OFF BINARY\n";
  for(std::int32_t n : {8, 12, 0})
    binary += bytes_of(n, true);
  for(int v = 0; v < 8; ++v)
    for(int k = 0; k < 3; ++k)
      binary += bytes_of(float(cube_coordinate(v, k)), true);
  for(const auto& t : triangles())
    for(std::int32_t n : {3, t[0], t[1], t[2], 0})
      binary += bytes_of(n, true);
  is_cube(read("cube_binary.off", binary));
  refuses("cut_binary.off", binary.substr(0, binary.size() - 5), "is truncated");

  refuses("empty.off", "", "is empty");
  refuses("counts.off", "OFF\n400000000 400000000 0\n0 0 0\n", "line 2: the number of vertices");
  refuses("large_face.off", off(cube_points, "2000000000 0 1 2\n"), "too short for so many");
  refuses("no_number.off", off("0 0 \x01\x1b[0m\n" + cube_points),
          "line 3: expected a number, not \"??[0m\"");
  const std::string not_finite = " has a coordinate that is not a finite number";
  refuses("nan.off", off("0 nan 0\n" + cube_points), "line 3: vertex 0" + not_finite);
  refuses("last_nan.off", off(cube_points + "0 0 -inf # comment\n"), "line 11: vertex 8" + not_finite);
  refuses("short_nan.off", off("0 nan\n" + cube_points), "line 3: vertex 0" + not_finite);
  refuses("overflow.off", off("0 1e999 0\n" + cube_points), "line 3: the number \"1e999\" is too large");
  refuses("negative.off", off(cube_points, "3 0 1 -1\n"), "face 0 has a vertex that does not exist");
  refuses("no_off.off", "PLY\n", "does not start with OFF");
}

void test_obj()
{
  std::string points, faces, relative;
  std::istringstream lines(cube_points);
  for(std::string line; std::getline(lines, line);)
    points += "v " + line + " 0.5 0.5 0.5\r\n";
  for(const auto& t : triangles()) {
    faces += "f";
    relative += "f";
    for(int v : t) {
      faces += " " + std::to_string(v + 1) + (v % 2 == 0 ? "/7/9" : "//3");
      relative += " \\\n" + std::to_string(v - 8);
    }
    faces += "\n";
    relative += " # comment\n";
  }
  is_cube(read("cube.obj", "# comment\nmtllib x.mtl\nvn 0 0 1\n" + points + "usemtl a\ns 1\n" + faces));
  is_cube(read("cube_relative.obj", points + relative));
  refuses("large_index.obj", points + "f 1e45 2 6\n" + faces, "line 9: expected an integer, not \"1e45\"");
  refuses("nan.obj", "# comment\n\n" + points + "v 0 nan 0\n" + faces,
          "line 11: vertex 8 has a coordinate that is not a finite number");
  refuses("zero_index.obj", points + "f 0 1 2\n", "face 0 has a vertex that does not exist");
  refuses("empty.obj", "", "is empty");
  refuses("nothing.obj", "hello\n", "has no faces");
}

void test_stl()
{
  for(bool is_binary : {false, true}) {
    const Result r = read("cube.stl", stl(is_binary, "solid facet vertex"));
    is_cube(r);
    BOOST_TEST(r.input.warnings.empty());
    for(std::size_t part : {60u, 500u}) {
      const std::string all = stl(is_binary, "solid");
      refuses("cut.stl", all.substr(0, all.size() - part), "is truncated");
    }
  }
  std::string not_finite = stl(false, "cube");
  not_finite.replace(not_finite.find("\nvertex ") + 8, 8, "inf");
  refuses("nan.stl", not_finite, "line 4: vertex 0 has a coordinate that is not a finite number");
  refuses("short.stl", "STL", "not a complete STL file");
}

template <class Coordinate>
void test_ply_type(const std::string& name)
{
  for(const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    is_cube(read("cube.ply", ply<Coordinate, std::uint8_t, std::int32_t>(format, name, "uchar", "int")));
    is_cube(read("cube.ply", ply<Coordinate, std::int8_t, std::uint8_t>(format, name, "char", "uint8")));
    is_cube(read("cube.ply", ply<Coordinate, std::uint16_t, std::int16_t>(format, name, "ushort", "int16")));
    is_cube(read("cube.ply", ply<Coordinate, std::int32_t, std::uint32_t>(format, name, "int32", "uint")));
  }
}

void test_ply()
{
  test_ply_type<double>("double");
  test_ply_type<float>("float32");
  test_ply_type<std::int8_t>("char");
  test_ply_type<std::uint8_t>("uchar");
  test_ply_type<std::int16_t>("short");
  test_ply_type<std::uint16_t>("ushort");
  test_ply_type<std::int32_t>("int");
  test_ply_type<std::uint32_t>("uint");
  const std::string head = "ply\nformat binary_little_endian 1.0\n", end = "end_header\n";
  refuses("property_first.ply", head + "property int x\n" + end, "a property is of no element");
  refuses("no_type.ply", head + "element vertex 1\nproperty \x02int x\n" + end, "unknown type \"?int\"");
  refuses("counts.ply", head + "element vertex 4000000000\n" + end, "too short for so many");
  refuses("list.ply",
          head + "element face 1\nproperty list uint int vertex_indices\n" + end + "\xff\xff\xff\x7f",
          "does not fit into the file");
  refuses("no_z.ply", head + "element vertex 1\nproperty uchar x\nproperty uchar y\n" + end + "ab",
          "no properties x, y and z");
  refuses("no_header_end.ply", head, "end_header is missing");
  refuses("format.ply", "ply\nformat morse 1.0\nend_header\n", "unknown format \"morse\"");
  const std::string all = ply<double, std::uint8_t, std::int32_t>("ascii", "double", "uchar", "int");
  refuses("cut.ply", all.substr(0, all.size() - 30), "is truncated");
  const std::string four = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float nx\nproperty float x\n"
                           "property float y\nproperty float z\nend_header\nnan 0 0 0\n";
  refuses("nan.ply", four + "nan 0 nan 0\n",
          "line 10: vertex 1 has a coordinate that is not a finite number");
}

void test_vtk()
{
  for(bool is_binary : {false, true})
    is_cube(read("cube.vtk", polydata(is_binary)));
  const std::string text = polydata(false);
  refuses("grid.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n",
          "expected POLYDATA");
  refuses("counts.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 900000000 float\n",
          "too short for so many");
  refuses("cut.vtk", text.substr(0, text.find("POLYGONS") + 20), "too short for so many");
  refuses("no_vtk.vtk", "OFF\n", "does not start with # vtk DataFile");
  std::string not_finite = text;
  not_finite.replace(not_finite.find("POINTS 8 float\n") + 15, 8, "0 nan\n0 ");
  refuses("nan.vtk", not_finite, "line 9: vertex 0 has a coordinate that is not a finite number");
  // Sizes do not fit.
  std::string wrong = text;
  wrong.replace(wrong.find("POLYGONS 4 20\n4"), 15, "POLYGONS 4 20\n9");
  refuses("sizes.vtk", wrong, "do not have the size");
}

// ---- shapes ------------------------------------------------------------------------------------

std::string moved_points(double x, double y, double z)
{
  std::ostringstream points;
  for(int v = 0; v < 8; ++v)
    points << cube_coordinate(v, 0) + x << ' ' << cube_coordinate(v, 1) + y << ' '
           << cube_coordinate(v, 2) + z << '\n';
  return points.str();
}

// A surface as in STL: points at the same place are the same point.
std::string without_indices(const std::vector<std::array<double, 3>>& shifts)
{
  std::string all = "solid\n";
  for(const auto& shift : shifts)
    for(const auto& t : triangles()) {
      all += "facet\n";
      for(int v : t) {
        all += "vertex";
        for(int k = 0; k < 3; ++k)
          all += " " + std::to_string(cube_coordinate(v, k) + shift[k]);
        all += "\n";
      }
      all += "endfacet\n";
    }
  return all + "endsolid\n";
}

void test_touching_bodies()
{
  // The cubes touch in a corner, along an edge, or beside each other; as closed bodies, and as triangles
  // without indices.
  for(const std::array<double, 3>& shift :
      {std::array<double, 3>{1, 1, 1}, std::array<double, 3>{1, 1, 0}, std::array<double, 3>{3, 0, 0}})
    for(const Result& r : {read("two.off", off(cube_points + moved_points(shift[0], shift[1], shift[2]),
                                               triangle_lines() + triangle_lines(8))),
                           read("two.stl", without_indices({{0, 0, 0}, shift}))}) {
      if(!r.is_read)
        std::cerr << r.error << '\n';
      BOOST_TEST(r.is_read);
      BOOST_TEST_EQ(r.input.number_of_components, 2u);
      BOOST_TEST_LE(std::abs(r.input.volume - 2), 1e-15);
      BOOST_TEST_EQ(r.surface.number_of_vertices(), 16u);
      BOOST_TEST(has_warning(r, "has 2 components"));
      BOOST_TEST(!has_warning(r, "cavit"));
      BOOST_TEST(!has_warning(r, "merged"));
    }
  BOOST_TEST(has_warning(read("two.stl", without_indices({{0, 0, 0}, {1, 1, 0}})), "touch along 1 edge"));
  // Four cubes are around an edge.
  const Result four = read("four.stl", without_indices({{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}));
  BOOST_TEST(four.is_read);
  BOOST_TEST_LE(std::abs(four.input.volume - 4), 1e-15);

  // Cubes have a face in common, and three faces are at an edge.
  is_repaired("stacked.off", off(cube_points + moved_points(0, 0, 1), triangle_lines() + triangle_lines(8)),
              "intersects itself", 2);
  is_repaired("fin.off", off(cube_points + "1.5 1.5 1.5\n", triangle_lines() + "3 0 1 8\n"), "not closed", 1);
  is_repaired("three.off",
              off(cube_points + moved_points(5, 0, 0) + "0.5 -3 0\n",
                  triangle_lines() + triangle_lines(8) + "3 0 1 16\n3 0 16 1\n"),
              "not closed", 2);

  // Pairs of cones are over the same square: one beside the other, and one through the other along the
  // square.
  for(double lowest : {1.5, 0.5}) {
    std::ostringstream points, faces;
    int first = 0;
    for(const auto& apexes : {std::make_pair(-1., 1.), std::make_pair(lowest, 2.)}) {
      points << "1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n0 0 " << apexes.first << "\n0 0 " << apexes.second << "\n";
      for(int i = 0; i < 4; ++i)
        faces << "3 " << first + i << ' ' << first + (i + 1) % 4 << ' ' << first + 5 << "\n3 " << first + i
              << ' ' << first + 4 << ' ' << first + (i + 1) % 4 << '\n';
      first += 6;
    }
    if(lowest == 1.5) {
      const Result r = read("cones.off", off(points.str(), faces.str()));
      BOOST_TEST(r.is_read && r.input.repairs.empty());
      BOOST_TEST_LE(std::abs(r.input.volume - 2. / 3 * (2 + 0.5)), 1e-14);
    } else {
      is_repaired("cones.off", off(points.str(), faces.str()), "crosses itself along an edge near (", 2);
    }
  }

  // Half of the points occur twice: the surface is closed only when points are merged.
  const Result halves = read("halves.off", off(cube_points + cube_points, [] {
                               std::string faces;
                               std::size_t i = 0;
                               for(const auto& t : triangles()) {
                                 const int first = i++ < 6 ? 0 : 8;
                                 faces += "3 " + std::to_string(t[0] + first) + " "
                                          + std::to_string(t[1] + first) + " " + std::to_string(t[2] + first)
                                          + "\n";
                               }
                               return faces;
                             }()));
  is_cube(halves);
  BOOST_TEST(has_warning(halves, "merged"));

  // A cavity is recognized, and a surface beside it is another body.
  std::string small;
  for(int v = 0; v < 8; ++v)
    small += std::to_string(0.25 + cube_coordinate(v, 0) / 2) + " "
             + std::to_string(0.25 + cube_coordinate(v, 1) / 2) + " "
             + std::to_string(0.25 + cube_coordinate(v, 2) / 2) + "\n";
  const Result three = read("cavity.off", off(cube_points + small + moved_points(2, 0, 0),
                                              triangle_lines() + triangle_lines(8) + triangle_lines(16)));
  BOOST_TEST(has_warning(three, "has 3 components, 1 of them inside another: a cavity"));
  BOOST_TEST_LE(std::abs(three.input.volume - (2 - 0.125)), 1e-15);
}

void test_holes_and_wraps()
{
  const std::string lines = triangle_lines();
  const auto without = [&lines](int faces) { // each line "3 a b c", of eight characters
    return off(cube_points, lines.substr(std::size_t(8 * faces)));
  };
  is_repaired("hole.off", without(1), "not closed: 3 border edges", 1);
  is_repaired("hole.off", without(2), "not closed: 4 border edges", 1);
  const Result filled = read("hole.off", without(2));
  BOOST_TEST(has_warning(filled, "filled 1 hole, the largest of length 4 near ("));
  // The hole is too large; a wrap of the given width is a solid, and contains half of the cube.
  const Result large = read("large_hole.off", without(6));
  BOOST_TEST(!large.is_read && mentions(large.error, "too large to be filled"));
  BOOST_TEST_GT(large.input.wrap_diameter, 1);
  IO::Read_surface_options options;
  options.wrap_diameter = large.input.wrap_diameter;
  const Result wrapped = read("large_hole.off", without(6), options);
  BOOST_TEST(wrapped.is_read && has_warning(wrapped, "wrapped it"));
  BOOST_TEST_GT(wrapped.input.volume, 0.2);
  BOOST_TEST_EQ(wrapped.input.repairs.size(), 1u);
  // A closed surface is wrapped, too.
  options.wrap_diameter = 0.5;
  const Result cube = read("cube.off", off(), options);
  BOOST_TEST(cube.is_read && has_warning(cube, "wrapped it, closing what is narrower than 0.5"));
  BOOST_TEST(cube.input.volume > 1 && cube.input.volume < 1.2);

  // The results are the same after scaling and shifting: no length is absolute.
  for(double scale : {1e-6, 1e6, 1e12})
    for(double shift : {0., 1e3, 1e6}) {
      std::ostringstream points;
      points.precision(17);
      for(double d : {0., 0.5})
        for(int v = 0; v < 8; ++v)
          for(int k = 0; k < 3; ++k)
            points << scale * (cube_coordinate(v, k) + d + shift) << (k == 2 ? '\n' : ' ');
      const Result r = read("scaled.off", off(points.str(), lines.substr(8) + triangle_lines(8)));
      BOOST_TEST(r.is_read);
      BOOST_TEST_EQ(r.input.repairs.size(), 2u);
      BOOST_TEST_LE(std::abs(r.input.volume / std::pow(scale, 3) - 1.875), 1e-15 * (1 + shift) * 20);
    }
}

// A box of triangles with points of their own, whose coordinates are off by up to that much, in steps.
std::string box_with_cracks(double width)
{
  const double size[] = {100, 50, 20};
  unsigned step = 0;
  std::ostringstream points;
  points.precision(17);
  std::string faces;
  for(const auto& t : triangles()) {
    for(const int v : t)
      for(int k = 0; k < 3; ++k) {
        step = step * 1664525 + 1013904223;
        points << size[k] * cube_coordinate(v, k) + width * (step >> 30) / 3 << (k == 2 ? '\n' : ' ');
      }
    const std::size_t first = faces.empty() ? 0
                                            : 3 * std::size_t(std::count(faces.begin(), faces.end(), '\n'));
    faces += "3 " + std::to_string(first) + " " + std::to_string(first + 1) + " " + std::to_string(first + 2)
             + "\n";
  }
  return off(points.str(), faces);
}

void test_welding()
{
  // The last digits of points differ: the box is closed, and its planes are planes again.
  for(double width : {1e-9, 1e-6, 5e-5}) {
    is_repaired("cracks.off", box_with_cracks(width), "not closed", 1e5);
    const Result box = read("cracks.off", box_with_cracks(width));
    BOOST_TEST_EQ(box.surface.number_of_vertices(), 8u);
    BOOST_TEST_EQ(box.surface.number_of_faces(), 12u);
    BOOST_TEST(box.is_read && box.bbox() == CGAL::Bbox_3(0, 0, 0, 100, 50, 20));
    BOOST_TEST_EQ(box.input.repairs.size(), 1u);
    BOOST_TEST(has_warning(box, "points to others, up to "));
  }
  // Cracks of a given width, even where repairs are not wanted.
  IO::Read_surface_options options;
  options.is_strict = true;
  options.weld_distance = 0.1;
  const Result box = read("cracks.off", box_with_cracks(0.05), options);
  BOOST_TEST(box.is_read && box.surface.number_of_vertices() == 8);
  options.weld_distance = 1e-3;
  const Result refused = read("cracks.off", box_with_cracks(0.05), options);
  is_refused(refused, "not closed: 36 border edges");
  // The distance that is proposed closes the surface, and the next smaller one of 1, 2, 5, ... does not.
  BOOST_TEST_EQ(refused.input.weld_distance, 0.1);
  options.weld_distance = 0.05;
  BOOST_TEST(!read("cracks.off", box_with_cracks(0.05), options).is_read);
  // No distance is proposed for a hole, large or small, or for cracks wider than a hundredth of the diagonal.
  BOOST_TEST_EQ(read("hole.off", off(cube_points, triangle_lines().substr(8 * 6))).input.weld_distance, 0);
  options.weld_distance = 0;
  BOOST_TEST_EQ(read("hole.off", off(cube_points, triangle_lines().substr(8)), options).input.weld_distance,
                0);
  BOOST_TEST_EQ(read("cracks.off", box_with_cracks(5), options).input.weld_distance, 0);
  // What is closed stays as it is, however near points are to each other.
  options.weld_distance = 1;
  const Result near = read("near.off",
                           off(cube_points + moved_points(1.001, 0, 0), triangle_lines() + triangle_lines(8)),
                           options);
  BOOST_TEST(near.is_read && near.input.repairs.empty());
  BOOST_TEST_EQ(near.surface.number_of_vertices(), 16u);
  is_cube(read("cube.off", off(), options));
}

void test_dropped_components()
{
  // A cube with a cavity, and a whole one, which is the larger body.
  std::string small;
  for(int v = 0; v < 8; ++v)
    for(int k = 0; k < 3; ++k)
      small += std::to_string(0.25 + cube_coordinate(v, k) / 2) + (k == 2 ? "\n" : " ");
  const std::string contents = off(cube_points + small + moved_points(2, 0, 0),
                                   triangle_lines() + triangle_lines(8) + triangle_lines(16));
  const auto read_with = [&contents](bool keep_largest, double least_volume) {
    IO::Read_surface_options options;
    options.keep_largest = keep_largest;
    options.least_volume = least_volume;
    return read("bodies.off", contents, options);
  };
  const auto is_left = [](const Result& r, std::size_t components, double volume, const std::string& words) {
    BOOST_TEST(r.is_read);
    BOOST_TEST_EQ(r.input.number_of_components, components);
    BOOST_TEST_LE(std::abs(r.input.volume - volume), 1e-15);
    BOOST_TEST(CGAL::is_closed(r.surface));
    BOOST_TEST_EQ(r.surface.number_of_vertices(), 8 * components);
    BOOST_TEST(words.empty() ? r.input.repairs.empty() : has_warning(r, words));
  };
  is_left(read_with(true, 0), 1, 1, "dropped 2 of 3 components, the largest of volume 0.875");
  is_left(read_with(false, 0.1), 3, 1.875, "");
  is_left(read_with(false, 0.5), 2, 2, "dropped 1 of 3 components, the largest of volume 0.125");
  is_left(read_with(false, 0.9), 1, 1, "dropped 2 of 3 components, the largest of volume 0.875");
  is_refused(read_with(false, 2), "no component has a volume of 2 or more, the largest has 1");
}

void test_flat_and_tiny()
{
  std::string flat, turned;
  for(int v = 0; v < 8; ++v) {
    std::ostringstream out;
    out.precision(17);
    const double x = cube_coordinate(v, 0) + 0.1 * cube_coordinate(v, 2), y = cube_coordinate(v, 1);
    out << 0.6 * x << ' ' << y << ' ' << 0.8 * x << '\n';
    turned += out.str();
    flat += std::to_string(x) + " " + std::to_string(y) + " 0\n";
  }
  refuses("flat.off", off(flat), "is flat");
  refuses("flat_turned.off", off(turned), "is flat");
  refuses("flat_open.off", off("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n"), "is flat");
  refuses("line.off", off("0 0 0\n1 1 1\n2 2 2\n", "3 0 1 2\n"), "is flat");

  // A point is 1e-170 away from the corner: next to 1, this is no number for any arithmetic.
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1e-170 0 0\n";
  const Result r = read("tiny.off", off(points, "3 0 4 2\n3 4 1 2\n3 0 3 4\n3 4 3 1\n3 0 2 3\n3 1 3 2\n"));
  // The point becomes the corner, after triangles without area are removed.
  BOOST_TEST(!r.is_read || std::abs(r.input.volume - 1. / 6) < 1e-15);
  for(const auto& p : r.surface.points())
    for(int k = 0; k < 3; ++k)
      BOOST_TEST(p[k] == 0 || p[k] == 1);
  refuses("small.off",
          off("0 0 0\n1e-200 0 0\n0 1e-200 0\n0 0 1e-200\n", "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"),
          "underflows");
  refuses("large.off",
          off("0 0 0\n1e200 0 0\n0 1e200 0\n0 0 1e200\n", "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"),
          "coordinates up to 1e+200 overflow");
}

void test_names()
{
  const std::string name = "two\nlines\x1b.off";
  set_contents(directory / name, "OFF\n");
  const Result r = read_file((directory / name).string());
  BOOST_TEST(mentions(r.error, "two?lines?.off: is truncated"));
  BOOST_TEST(mentions(read_file((directory / "none").string()).error, "No such file"));
}

int run(int argc, char* argv[])
{
  directory = argc > 2 ? argv[2] : ".";
  fs::create_directories(directory);
  test_off();
  test_obj();
  test_stl();
  test_ply();
  test_vtk();
  test_touching_bodies();
  test_holes_and_wraps();
  test_welding();
  test_dropped_components();
  test_flat_and_tiny();
  test_names();
  for(const char* name : {"cube.off", "cube_binary.off", "cube.obj", "cube.stl", "cube.ply", "cube.vtk"})
    test_damage(directory / name, [](const std::string& file) { return read_file(file); });
  return boost::report_errors();
}

} // namespace test_io_surface
