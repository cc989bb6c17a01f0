// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces of patients from files: formats of neuroimaging, spaces, and files of other programs.
//
//   test_anatomical_surface [DATA [DIRECTORY]]
//   test_anatomical_surface --files FILE...   prints the content as lines of JSON, and reads damaged copies

#include "surface_files.h"

#include <CGAL/Mixed_mesh_image_3/IO/read_anatomical_surface.h>

#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>

namespace test_anatomical_surface {

using namespace surface_files;
using Space = IO::Anatomical_space;

fs::path directory = ".";

Result read_file(const std::string& path, const IO::Read_anatomical_surface_options& options = {})
{
  Result r;
  r.is_read = IO::read_anatomical_surface(path, options, r.surface, &r.error, &r.input);
  return r;
}

Result read(const std::string& name, const std::string& contents,
            const IO::Read_anatomical_surface_options& options = {})
{
  return read_contents(read_file, directory / name, contents, options);
}

void refuses(const std::string& name, const std::string& contents, const std::string& words)
{
  is_refused(read(name, contents), words);
}

std::string freesurfer(const std::string& comment = "made by hand\n\n")
{
  std::string result = "\xff\xff\xfe" + comment + bytes_of(std::int32_t(8), true)
                       + bytes_of(std::int32_t(12), true);
  for(int v = 0; v < 8; ++v)
    for(int k = 0; k < 3; ++k)
      result += bytes_of(float(cube_coordinate(v, k)), true);
  for(const auto& t : triangles())
    for(std::int32_t v : t)
      result += bytes_of(v, true);
  return result;
}

void test_freesurfer()
{
  Result r = read("lh.pial", freesurfer());
  is_cube(r);
  BOOST_TEST(has_warning(r, "c_ras"));
  const std::string axes = "xras = -1 0 0\nyras = 0 0 -1\nzras = 0 1 0\ncras = 10 20 30\n";
  const std::string head = bytes_of(std::int32_t(20), true);
  r = read("rh.white", freesurfer() + head + "valid = 1  # volume info valid\n" + axes);
  BOOST_TEST(r.is_read && r.bbox() == CGAL::Bbox_3(10, 20, 30, 11, 21, 31));
  BOOST_TEST(r.input.warnings.empty());
  // The volume was not resampled: columns to the left, rows to the back, slices upwards, all turned by 90
  // degrees.
  r = read("rh.white",
           freesurfer() + head + "valid = 1\nxras = 0 -1 0\nyras = 1 0 0\nzras = 0 0 1\ncras = 0 0 0\n");
  BOOST_TEST(r.is_read && r.bbox() == CGAL::Bbox_3(-1, 0, 0, 0, 1, 1));
  BOOST_TEST_LE(std::abs(r.input.volume - 1), 1e-15);
  r = read("rh.white", freesurfer() + head + "valid = 0  # volume info invalid\n" + axes);
  is_cube(r);
  BOOST_TEST(has_warning(r, "c_ras"));
  refuses("lh.cut", freesurfer().substr(0, 200), "is truncated");
  refuses("lh.comment", "\xff\xff\xfe no end", "does not end");
  refuses("lh.quads", "\xff\xff\xff and more", "mris_convert");
  for(const char* image : {"brain.mgz", "brain.MGH", "brain.nii.gz"})
    refuses(image, "x", "is an image; expected a surface, .off, .obj, .stl, .ply, .vtp, .vtk, .gii or");
  refuses("brain.xyz", "x", "unknown format; expected .off, .obj, .stl, .ply, .vtp, .vtk, .gii or");
}

std::string gifti(const std::string& triangles_attributes = "Dim0=\"12\"",
                  const std::string& coordinates = "")
{
  std::string t;
  std::istringstream lines(triangle_lines());
  for(std::string line; std::getline(lines, line);)
    t += line.substr(2) + "\n";
  const std::string array = "Dimensionality=\"2\" Dim1=\"3\" Encoding=\"ASCII\" ArrayIndexingOrder=";
  return "<?xml version=\"1.0\"?>\n<!DOCTYPE GIFTI SYSTEM \"x.dtd\">\n<GIFTI Version=\"1.0\" "
         "NumberOfDataArrays=\"2\">"
         "<MetaData><MD><Name><![CDATA[a > b]]></Name><Value>x</Value></MD></MetaData>\n"
         "<DataArray Intent=\"NIFTI_INTENT_POINTSET\" DataType=\"NIFTI_TYPE_FLOAT32\" Dim0=\"8\" "
         + array + "\"ColumnMajorOrder\">" + coordinates
         + "<Data>0 1 0 1 0 1 0 1\n0 0 1 1 0 0 1 1\n0 0 0 0 1 1 1 1</Data></DataArray>\n"
           "<DataArray Intent=\"NIFTI_INTENT_TRIANGLE\" DataType=\"NIFTI_TYPE_INT32\" "
         + triangles_attributes + " " + array + "\"RowMajorOrder\"><Data>" + t
         + "</Data></DataArray></GIFTI>\n";
}

void test_gifti()
{
  is_cube(read("cube.gii", gifti()));
  const auto system = [](const std::string& from, const std::string& to) {
    return "<CoordinateSystemTransformMatrix><DataSpace><![CDATA[" + from
           + "]]></DataSpace><TransformedSpace>" + to
           + "</TransformedSpace><MatrixData>1 0 0 5\n0 1 0 6\n0 0 2 7 0 0 0 1</MatrixData>"
             "</CoordinateSystemTransformMatrix>";
  };
  const std::string unknown = "NIFTI_XFORM_UNKNOWN", scanner = "NIFTI_XFORM_SCANNER_ANAT",
                    talairach = "NIFTI_XFORM_TALAIRACH";
  const Result r = read("moved.gii", gifti("Dim0=\"12\"", system(unknown, scanner)));
  BOOST_TEST(r.is_read && r.bbox() == CGAL::Bbox_3(5, 6, 7, 6, 7, 9));
  is_cube(read("cube.gii", gifti("Dim0=\"12\"", system(scanner, talairach))));
  is_cube(read("cube.gii", gifti("Dim0=\"12\"", system(unknown, talairach))));
  refuses("counts.gii", gifti("Dim0=\"900000000\""), "more than fit into the file");
  refuses("short.gii", gifti("Dim0=\"13\""), "is truncated");
  refuses("words.gii", gifti("Dim0=\"twelve\""), "does not have 3 columns");
  refuses("cut.gii", gifti().substr(0, 300), "");
  std::string no_triangles = gifti();
  no_triangles.replace(no_triangles.find("NIFTI_INTENT_TRIANGLE"), 21, "NIFTI_INTENT_SHAPE");
  refuses("points.gii", no_triangles, "is no surface");
  refuses("no_gifti.gii", "<html></html>", "not a GIFTI file");
  refuses("end.gii", "</GIFTI>", "not a GIFTI file");
}

// ---- spaces ------------------------------------------------------------------------------------

void test_space()
{
  const CGAL::Bbox_3 as_given(0, 0, 0, 1, 1, 1), turned(-1, -1, 0, 0, 0, 1);
  std::string ply_file = ply<float, std::uint8_t, std::int32_t>("ascii", "float", "uchar", "int");
  ply_file.replace(ply_file.find("made by hand"), 12, "SPACE=LPS");
  IO::Read_anatomical_surface_options ras, lps;
  ras.space = Space::RAS;
  lps.space = Space::LPS;
  for(const auto& [name, contents] :
      {std::make_pair("slicer.stl", stl(false, "SPACE=LPS")),
       std::make_pair("slicer.stl", stl(true, "x SPACE=LPS")), std::make_pair("slicer.ply", ply_file),
       std::make_pair("slicer.vtk", polydata(false, "3D Slicer output. SPACE=LPS"))}) {
    Result r = read(name, contents);
    BOOST_TEST(r.is_read && r.bbox() == turned);
    BOOST_TEST(has_warning(r, "says that it is in LPS"));
    BOOST_TEST_LE(std::abs(r.input.volume - 1), 1e-15);
    r = read(name, contents, ras);
    BOOST_TEST(r.is_read && r.bbox() == as_given);
    r = read(name, contents, lps);
    BOOST_TEST(r.is_read && r.bbox() == turned);
  }
  BOOST_TEST(read("slicer.stl", stl(true, "SPACE=RAS")).bbox() == as_given);
  BOOST_TEST(read("cube.off", off(), lps).bbox() == turned);
  BOOST_TEST(has_warning(read("cube.off", off(), lps), "is read as LPS"));
  BOOST_TEST(read("cube.gii", gifti(), lps).bbox() == as_given); // defines its space
}

int run(int argc, char* argv[])
{
  const auto damage = [](const fs::path& path) {
    test_damage(path, [](const std::string& file) { return read_file(file); });
  };
  if(argc > 1 && std::string(argv[1]) == "--files") {
    for(int i = 2; i < argc; ++i) {
      print(read_file(argv[i]));
      damage(argv[i]);
    }
    return boost::report_errors();
  }
  directory = argc > 2 ? argv[2] : ".";
  fs::create_directories(directory);
  test_freesurfer();
  test_gifti();
  test_space();
  for(const char* name : {"lh.pial", "cube.gii", "slicer.ply"})
    damage(directory / name);
  return boost::report_errors();
}

} // namespace test_anatomical_surface
