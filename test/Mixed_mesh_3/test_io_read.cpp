// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Readers of meshes.
//
//   test_io_read DATA_DIRECTORY WORK_DIRECTORY
//   test_io_read --files FILE...    for test_io_read_writers.py: damages copies of the files, prints what is
// in
//                                each, as a line of JSON

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_io_read {

using namespace CGAL::Mixed_meshes_3;
namespace IO = CGAL::Mixed_meshes_3::IO;
namespace fs = std::filesystem;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

std::string contents(const fs::path& path)
{
  std::ifstream in(path, std::ios_base::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void set_contents(const fs::path& path, const std::string& bytes)
{
  fs::remove(path); // some file systems wait for the disk when a file is overwritten
  std::ofstream(path, std::ios_base::binary) << bytes;
}

bool are_same(const Mesh& a, const Mesh& b)
{
  bool same = a.points() == b.points() && a.elements().kinds() == b.elements().kinds()
              && a.elements().connectivity() == b.elements().connectivity();
  for(std::size_t e = 0; same && e < a.number_of_elements(); ++e)
    same = a.attributes(e) == b.attributes(e);
  return same;
}

// The mesh with its elements by kind, in the order of VTU files.
Mesh sorted_by_kind(const Mesh& mesh)
{
  Mesh sorted;
  sorted.points() = mesh.points();
  for(Element_kind kind : element_kinds)
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      if(mesh.element(e).kind() == kind)
        sorted.add_element(kind, mesh.element(e).begin(), mesh.attributes(e));
  return sorted;
}

// The error without the name of the file; empty if there is none.
std::string read_error(const std::string& path, Mesh& mesh)
{
  std::string error;
  if(IO::read_mixed_mesh(path, mesh, &error)) {
    BOOST_TEST(error.empty());
    return std::string();
  }
  const std::string begin = path + ": ";
  BOOST_TEST_EQ(error.substr(0, begin.size()), begin);
  BOOST_TEST(error.find('\n') == std::string::npos);
  BOOST_TEST_GT(error.size(), begin.size());
  return error.substr((std::min)(begin.size(), error.size()));
}

// A hexahedron, a pyramid on top of it, a prism and a tetrahedron beside them.
Mesh one_of_each_kind()
{
  Mesh mesh;
  for(const auto& c : reference_elements[HEXAHEDRON].coordinates)
    mesh.add_vertex({(1 + c[0]) / 2 + 1. / 3, (1 + c[1]) / 2 - 1e-300, (1 + c[2]) / 2 + 1e5});
  mesh.add_vertex({0.8, 0.5, 1.8 + 1e5});
  mesh.add_vertex({2, 0, 1e5});
  mesh.add_vertex({2, 1, 1e5});
  mesh.add_vertex({1.9, 0.5, 1.5 + 1e5});
  mesh.add_element(TETRAHEDRON, {5, 11, 6, 8}, {7, false});
  mesh.add_element(HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7}, {1, true});
  mesh.add_element(PYRAMID, {4, 5, 6, 7, 8}, {2, true});
  mesh.add_element(PRISM, {1, 5, 9, 2, 6, 10});
  return mesh;
}

// Files cut off anywhere, and with wrong bytes: they are refused, or the result is a mesh.
void test_damage(const std::string& path, const std::string& damaged_path)
{
  const std::string bytes = contents(path);
  Mesh original, mesh;
  BOOST_TEST_EQ(read_error(path, original), "");
  const std::size_t trials = 1500;
  std::size_t refused = 0;
  const std::size_t step = bytes.size() / trials + 1;
  for(std::size_t size = 0; size < bytes.size(); size += step) {
    set_contents(damaged_path, bytes.substr(0, size));
    mesh = Mesh();
    const std::string error = read_error(damaged_path, mesh);
    BOOST_TEST(error.empty() ? are_same(mesh, original) : mesh.is_empty());
    refused += !error.empty();
  }
  BOOST_TEST_GT(refused, bytes.size() / step / 2);

  std::mt19937 random(1);
  for(std::size_t trial = 0; trial < trials; ++trial) {
    std::string wrong = bytes;
    for(std::size_t n = 1 + random() % 3; n != 0; --n) {
      // Half of the wrong bytes are where the file describes itself; digits, so that numbers stay numbers;
      // bits.
      const std::size_t range = trial % 2 == 0 ? wrong.size() : (std::min)(wrong.size(), std::size_t(2000));
      char& c = wrong[random() % range];
      c = n % 3 == 0   ? char('0' + random() % 10)
          : n % 3 == 1 ? char(c ^ (1 << random() % 8))
                       : char(random());
    }
    if(trial % 10 == 0) // a part is missing
      wrong.erase(random() % wrong.size(), random() % 30);
    set_contents(damaged_path, wrong);
    mesh = Mesh();
    if(!read_error(damaged_path, mesh).empty())
      continue;
    BOOST_TEST(!mesh.is_empty());
    for(Vertex_index v : mesh.elements().connectivity())
      BOOST_TEST_LT(v, mesh.number_of_vertices());
    for(const auto& p : mesh.points())
      BOOST_TEST(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()));
  }
  fs::remove(damaged_path);
}

void test_round_trip(const fs::path& directory, const std::string& name, const Mesh& mesh)
{
  for(const char* extension : {".vtu", ".msh", ".msh2"}) {
    const std::string path = (directory / (name + extension)).string();
    BOOST_TEST(IO::write_mixed_mesh(path, mesh));
    Mesh read = one_of_each_kind(); // which is replaced
    BOOST_TEST_EQ(read_error(path, read), "");
    BOOST_TEST(are_same(read, std::string(extension) == ".vtu" ? sorted_by_kind(mesh) : mesh));
    const std::string first = contents(path);
    BOOST_TEST(IO::write_mixed_mesh(path, read));
    BOOST_TEST(first == contents(path));
    test_damage(path, (directory / (std::string("damaged") + extension)).string());
  }
}

// References of the file tell the subdomain: in our files, a part in the region has another reference than
// the rest. Names of subdomains that the mesh has are read back; names that files cannot have are refused.
void test_subdomain_names(const fs::path& directory)
{
  Mesh mesh = one_of_each_kind();
  std::vector<Element_attributes> attributes = mesh.attributes();
  for(std::size_t e = 0; e < attributes.size(); ++e)
    attributes[e].subdomain_index = e % 2 == 0 ? 7 : 1;
  mesh.assign(mesh.points(), mesh.elements(), attributes);
  const IO::Subdomain_names both{{1, "brain"}, {7, "Left-Ventricle_1"}};
  IO::Write_options options;
  options.subdomain_names = both;
  options.subdomain_names[9] = "nowhere";
  for(const char* extension : {".vtu", ".msh", ".msh2"}) {
    const std::string path = (directory / ("names" + std::string(extension))).string();
    BOOST_TEST(IO::write_mixed_mesh(path, mesh, options));
    Mesh read;
    IO::Subdomain_names names{{3, "old"}};
    BOOST_TEST(IO::read_mixed_mesh(path, read, names));
    BOOST_TEST(names == both);
  }
  for(const char* name : {"", "two words", "1", "region", "Subdomain_2", "BRAIN", "\"", "a<b"}) {
    options.subdomain_names = {{1, "brain"}, {7, name}};
    std::string error;
    BOOST_TEST(!IO::write_mixed_mesh((directory / "names.vtu").string(), mesh, options, &error));
    BOOST_TEST(error.find("subdomain 7") != std::string::npos);
  }
  options.subdomain_names = both;
  options.facet_sets.push_back({"Brain", {}});
  BOOST_TEST(!IO::write_mixed_mesh((directory / "names.vtu").string(), mesh, options));
}

void test_MEDIT(const fs::path& directory, const Mesh& mesh)
{
  const std::string path = (directory / "round_trip.mesh").string();
  BOOST_TEST(IO::write_mixed_mesh(path, mesh));
  Mesh read = one_of_each_kind();
  BOOST_TEST_EQ(read_error(path, read), "");
  const Mesh sorted = sorted_by_kind(mesh);
  BOOST_TEST(read.points() == sorted.points());
  BOOST_TEST(read.elements().kinds() == sorted.elements().kinds());
  BOOST_TEST(read.elements().connectivity() == sorted.elements().connectivity());
  for(Element_index e = 0; e < read.number_of_elements(); ++e) {
    BOOST_TEST_EQ(read.subdomain_index(e), sorted.is_in_region(e) ? 1 : 2);
    BOOST_TEST(!read.is_in_region(e));
  }
  test_damage(path, (directory / "damaged.mesh").string());
}

void test_round_trips(const fs::path& data, const fs::path& directory)
{
  test_round_trip(directory, "each", one_of_each_kind());

  CGAL::Surface_mesh<Kernel::Point_3> brain, region;
  BOOST_TEST(IO::read_closed_surface((data / "brain.off").string(), brain));
  BOOST_TEST(IO::read_closed_surface((data / "region.off").string(), region));
  Mesh mesh;
  BOOST_TEST(
    CGAL::make_mixed_mesh_3(brain, region, CGAL::Mixed_mesh_criteria_3(660).simplification(false), mesh)
      .has_mesh());
  for(std::size_t n : mesh.elements().counts())
    BOOST_TEST_GT(n, 0u);
  test_round_trip(directory, "brain", mesh);
  test_MEDIT(directory, mesh);

  // A vertex without an element stays.
  mesh = one_of_each_kind();
  mesh.add_vertex({7, 8, 9});
  for(const char* name : {"unused.vtu", "unused.msh2"}) {
    Mesh read;
    BOOST_TEST(IO::write_mixed_mesh((directory / name).string(), mesh));
    BOOST_TEST_EQ(read_error((directory / name).string(), read), "");
    BOOST_TEST(are_same(read, std::string(name) == "unused.vtu" ? sorted_by_kind(mesh) : mesh));
  }
}

// ---- files written by hand -----------------------------------------------------------------------

struct Piece_text
{
  std::string points = "0 0 0 1 0 0 0 1 0 0 0 1", connectivity = "0 1 2 3", offsets = "4", types = "10",
              in_region = "1", number_of_points = "4", number_of_cells = "1", point_type = "Float64",
              index_type = "Int64";

  std::string text() const
  {
    const auto array = [](const std::string& type, const std::string& name, const std::string& values) {
      return "<DataArray type='" + type + "' Name=\"" + name + "\" format=\"ascii\">" + values
             + "</DataArray>\n";
    };
    return "<Piece NumberOfPoints=\"" + number_of_points + "\" NumberOfCells=\"" + number_of_cells
           + "\"><!-- <Points> -->\n<CellData>" + array("Float32", "in_region", in_region)
           + "</CellData>\n<Points><DataArray type=\"" + point_type + "\" NumberOfComponents = \"3\">\n"
           + points + "<InformationKey name=\"x\"><Value> 0 </Value></InformationKey></DataArray></Points>\n"
           + "<Cells>" + array(index_type, "connectivity", connectivity)
           + array(index_type, "offsets", offsets) + array("UInt8", "types", types) + "</Cells></Piece>\n";
  }
};

std::string vtu(const std::string& pieces, const std::string& attributes = "")
{
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" " + attributes
         + ">\n<UnstructuredGrid>\n" + pieces + "</UnstructuredGrid>\n</VTKFile>\n";
}

std::string replaced(std::string text, const std::string& old_part, const std::string& new_part)
{
  const std::size_t position = text.find(old_part);
  BOOST_TEST(position != std::string::npos);
  return position == std::string::npos ? text : text.replace(position, old_part.size(), new_part);
}

// A tetrahedron with `in_region` in base64.
std::string with_region(const std::string& base64)
{
  return replaced(replaced(vtu(Piece_text().text()), "ascii", "binary"), ">1<", ">" + base64 + "<");
}

const std::string names = "$PhysicalNames\r\n3\r\n2 4 \"region\"\r\n3 7 \"a b\"\r\n3 9 \"region\"\r\n"
                          "$EndPhysicalNames\r\n";

const std::string msh2_nodes = "$Nodes\n6\n5 0 0 0\n900 1 0 0\n30 0 1 0\n4 0 0 1\n1000000007 1 1 1\n"
                               "12 5 5 5\n$EndNodes\n";
const std::string msh2 = "$MeshFormat\r\n2.2 0 8\r\n$EndMeshFormat\r\n$Comments\n$Nodes\n$EndComments\n"
                         + names + msh2_nodes
                         + "$Elements\n4\n1 15 2 4 4 5\n2 2 2 4 1 5 900 30\n8 4 3 9 7 1 900 30 4 1000000007\n"
                           "7 4 2 7 9 5 900 30 4\n$EndElements\n$NodeData\n1 2 3\n$EndNodeData\n";

const std::string msh4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names
                         + "$Entities\n1 0 1 2\n1 0 0 0 0\n3 0 0 0 1 1 1 1 4 0\n"
                           "1 0 0 0 1 1 1 2 7 9 1 3\n2 0 0 0 1 1 1 1 7 1 -3\n$EndEntities\n"
                           "$Nodes\n3 6 1 90\n2 3 1 2\n8\n5\n0 0 1 0.5 0.5\n0 0 0 0.5 0.5\n"
                           "3 1 0 4\n6\n7\n90\n11\n1 0 0\n0 1 0\n1 1 1\n5 5 5\n3 2 0 0\n$EndNodes\n"
                           "$Elements\n3 3 1 4\n2 3 2 1\n1 5 6 7\n3 2 4 1\n4 6 7 8 90\n3 1 4 1\n3 5 6 7 8\n"
                           "$EndElements\n";

Mesh read_text(const fs::path& directory, const char* name, const std::string& text)
{
  const std::string path = (directory / name).string();
  set_contents(path, text);
  Mesh mesh;
  BOOST_TEST_EQ(read_error(path, mesh), "");
  return mesh;
}

void test_hand_written(const fs::path& directory)
{
  using Point = Kernel::Point_3;
  // A voxel with a quadrilateral and a wedge, and a tetrahedron in another piece; an unused point.
  Piece_text first;
  first.point_type = "Float32";
  first.index_type = "Int8";
  first.points = "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\n9 9 9 2 0 0.1 +2 0 1.0e0 ";
  first.connectivity = "0 1 3 2  0 1 2 3 4 5 6 7  1 3 9 5 7 10";
  first.offsets = "4 12\t18";
  first.types = "9 11 13";
  first.in_region = "1 0 0.5";
  first.number_of_points = "11";
  first.number_of_cells = "3";
  Piece_text empty;
  empty.number_of_points = empty.number_of_cells = "0";
  empty.points = empty.connectivity = empty.offsets = empty.types = empty.in_region = "";
  const std::string pieces = first.text() + empty.text() + Piece_text().text();
  Mesh mesh = read_text(directory, "hand.vtu", vtu(pieces, "byte_order=\"BigEndian\""));
  BOOST_TEST_EQ(mesh.number_of_vertices(), 15u);
  BOOST_TEST_EQ(mesh.number_of_elements(), 3u);
  if(mesh.number_of_elements() == 3) {
    BOOST_TEST_EQ(mesh.point(9).z(), double(0.1f));
    BOOST_TEST_EQ(mesh.element(0).kind(), HEXAHEDRON);
    BOOST_TEST_EQ(volume(mesh, 0), 1.);
    BOOST_TEST_EQ(mesh.element(1).kind(), PRISM);
    BOOST_TEST_GT(volume(mesh, 1), 0.4);
    BOOST_TEST_EQ(mesh.element(2)[3], 14u);
    BOOST_TEST(!mesh.is_in_region(0) && mesh.is_in_region(1) && mesh.is_in_region(2));
  }

  // Header and values are encoded separately or as one.
  for(const char* base64 : {"BAAAAA==AACAPw==", "\n BAAAAA==\n AACA\r\nPw== ", "BAAAAAAAgD8="}) {
    mesh = read_text(directory, "hand_base64.vtu", with_region(base64));
    BOOST_TEST(mesh.number_of_elements() == 1 && mesh.is_in_region(0));
  }

  // Tags with gaps, elements in another order, several groups, text that looks like a section.
  mesh = read_text(directory, "hand.msh", msh2);
  const std::vector<Point> points = {{0, 0, 1}, {0, 0, 0}, {5, 5, 5}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}};
  BOOST_TEST(mesh.points() == points);
  BOOST_TEST(mesh.elements().connectivity() == (std::vector<Vertex_index>{1, 4, 3, 0, 4, 3, 0, 5}));
  BOOST_TEST_EQ(mesh.number_of_elements(), 2u);
  if(mesh.number_of_elements() == 2)
    BOOST_TEST(!mesh.is_in_region(0) && mesh.is_in_region(1) && mesh.subdomain_index(0) == 7
               && mesh.subdomain_index(1) == 1);
  BOOST_TEST_EQ(boundary_faces(mesh).size(), 6u);

  // Parametric nodes, a volume in two groups.
  mesh = read_text(directory, "hand.msh", msh4);
  const std::vector<Point> points4 = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 5, 5}, {1, 1, 1}};
  BOOST_TEST(mesh.points() == points4);
  BOOST_TEST(mesh.elements().connectivity() == (std::vector<Vertex_index>{0, 1, 2, 3, 1, 2, 3, 5}));
  if(mesh.number_of_elements() == 2)
    BOOST_TEST(mesh.is_in_region(0) && !mesh.is_in_region(1) && mesh.subdomain_index(0) == 1
               && mesh.subdomain_index(1) == 7);

  for(const char* name : {"hand.vtu", "hand.msh"})
    test_damage((directory / name).string(), (directory / (std::string("damaged_") + name)).string());
  set_contents(directory / "hand.msh", msh2);
  test_damage((directory / "hand.msh").string(), (directory / "damaged_hand.msh").string());
}

// The unit cube has a pyramid, a prism and a tetrahedron on it, in the form of other programs.
const char* const node =
  "# a comment\n 9  3  2  1\n0 0 0 0 7.5 1 -1\n1 1 0 0 0 0 0\n2 1 1 0 0 0 0 # and here\n"
  "3 0 1 0 0 0 0\n4 0 0 1 0 0 0\n5 1 0 1 0 0 0\n6 1 1 1 0 0 0\n7 0 1 1 0 0 0\n"
  "8 0.5 0.5 2 0 0 0\n";
const char* const ele = "2 4 1\n10 0 1 3 4 3\n11 4 5 7 8 -2\n# end\n";

const char* const medit = "MeshVersionFormatted 2\nDimension\n3\n# c\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                          "0 0 1 0\n1 1 1 0\nCorners 2\n1 2\nTriangles\n1\n1 2 3 5\nTetrahedra 2\n1 2 3 4 9\n"
                          "2 3 4 5 0\nRequiredVertices\n0\nEnd\nanything";

const char* const vol =
  "mesh3d\ndimension\n3\ngeomtype\n0\n# surfnr\nsurfaceelements\n1\n 3 6 1 0 3 2 3 5\n"
  "volumeelements\n4\n 1 8 1 4 3 2 5 8 7 6\n 2 5 5 8 7 6 9\n 3 6 2 10 11 3 12 13\n"
  " 4 4 6 12 10 9\n\npoints\n13\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
  "0.5 0.5 2\n2 0 0\n2 0 1\n2 1 0\n2 1 1\nmaterials\n1\n1 a\nendmesh\n";

void test_formats_of_others(const fs::path& directory)
{
  set_contents(directory / "tetgen.node", node);
  set_contents(directory / "tetgen.ele", ele);
  Mesh mesh;
  for(const char* name : {"tetgen.node", "tetgen.ele"}) {
    BOOST_TEST_EQ(read_error((directory / name).string(), mesh), "");
    BOOST_TEST_EQ(mesh.number_of_vertices(), 9u);
    BOOST_TEST_EQ(mesh.number_of_elements(), 2u);
    BOOST_TEST_EQ(volume(mesh, 0), 1. / 6);
    BOOST_TEST_EQ(volume(mesh, 1), 1. / 6);
    BOOST_TEST_EQ(mesh.subdomain_index(0), 3);
    BOOST_TEST_EQ(mesh.subdomain_index(1), 1); // what is not positive is no label
  }
  fs::copy_file(directory / "tetgen.node", directory / "damaged_tetgen.node",
                fs::copy_options::overwrite_existing);
  test_damage((directory / "tetgen.ele").string(), (directory / "damaged_tetgen.ele").string());

  mesh = read_text(directory, "hand.mesh", medit);
  BOOST_TEST_EQ(mesh.number_of_vertices(), 5u);
  BOOST_TEST(mesh.elements().connectivity() == (std::vector<Vertex_index>{0, 1, 2, 3, 1, 2, 3, 4}));
  BOOST_TEST_EQ(mesh.subdomain_index(0), 9);
  BOOST_TEST_EQ(mesh.subdomain_index(1), 1);

  // Netgen's elements are mirror images.
  mesh = read_text(directory, "hand.vol", vol);
  BOOST_TEST_EQ(mesh.number_of_elements(), 4u);
  if(mesh.number_of_elements() == 4) {
    const Element_kind kinds[] = {HEXAHEDRON, PYRAMID, PRISM, TETRAHEDRON};
    for(Element_index e = 0; e < 4; ++e) {
      BOOST_TEST_EQ(mesh.element(e).kind(), kinds[e]);
      BOOST_TEST_EQ(mesh.subdomain_index(e), int(e) + 1);
      BOOST_TEST_GT(volume(mesh, e), 0);
    }
    BOOST_TEST_EQ(volume(mesh, 0), 1.);
    BOOST_TEST(std::abs(volume(mesh, 1) - 1. / 3) < 1e-15);
  }
  test_damage((directory / "hand.vol").string(), (directory / "damaged_hand.vol").string());
}

// ---- errors --------------------------------------------------------------------------------------

void test_errors(const fs::path& directory)
{
  const Mesh original = one_of_each_kind();
  const auto check_path = [&](const fs::path& path, const std::string& expected) {
    Mesh mesh = original;
    const std::string error = read_error(path.string(), mesh);
    BOOST_TEST(error.find(expected) != std::string::npos);
    if(error.find(expected) == std::string::npos)
      std::cerr << "\"" << error << "\" without \"" << expected << "\"\n";
    BOOST_TEST(are_same(mesh, original));
  };
  const auto check = [&](const char* extension, const std::string& text, const std::string& expected) {
    const fs::path path = directory / (std::string("error") + extension);
    set_contents(path, text);
    check_path(path, expected);
    fs::remove(path);
  };
  const auto check_piece = [&](auto member, const std::string& text, const std::string& expected) {
    Piece_text piece;
    piece.*member = text;
    check(".vtu", vtu(piece.text()), expected);
  };

  check_path("", "unknown format; expected .vtu, .msh, .msh2, .mesh, .ele, .node or .vol");
  check_path(directory / "mesh.bdf", "unknown format");
  check_path(directory / "missing.vtu", "cannot be opened: No such file");
  fs::create_directories(directory / "directory.MSH");
  check_path(directory / "directory.MSH", "is a directory");
  fs::remove(directory / "directory.MSH");
  if(fs::exists("/dev/zero")) {
    fs::create_symlink("/dev/zero", directory / "endless.vtu");
    check_path(directory / "endless.vtu", "is not a regular file");
    fs::remove(directory / "endless.vtu");
  }

  check(".vtu", "", "is empty");
  check(".vtu", "solid \x01 \n x", "not an XML file of VTK");
  check(".vtu", msh2, "not an XML file of VTK");
  check(".vtu", vtu(""), "has no hexahedra");
  check(".vtu", replaced(vtu(""), "UnstructuredGrid", "PolyData"), "holds VTK data of type \"PolyData\"");
  check(".vtu", vtu("", "compressor=\"vtkLZ4DataCompressor\""), "compressed by \"vtkLZ4DataCompressor\"");
  check(".vtu", vtu("", "header_type=\"Int8\""), "headers of type");
  check(".vtu", vtu("", "header_type=Int8"), "no valid attributes");
  check(".vtu", vtu("</Piece>"), "no valid XML");
  check(".vtu", vtu("<Piece NumberOfPoints=\"\">"), "NumberOfPoints of <Piece> is \"\"");
  check(".vtu", with_region("AQ=="), "its array \"in_region\" is truncated");
  check(".vtu", with_region("AQAAAAAA"), "has 1 bytes; expected 4");
  check(".vtu", with_region("BAAAAAAA"), "its array \"in_region\" is truncated");
  check(".vtu", with_region("BAAAAA==********"), "no valid base64");
  check(".vtu", replaced(with_region(""), "version=\"0.1\"", "byte_order=\"BigEndian\""),
        "byte order of another machine");
  check_piece(&Piece_text::number_of_points, "4294967296", "2^32");
  check_piece(&Piece_text::number_of_points, "18446744073709551615", "2^32");
  check_piece(&Piece_text::number_of_points, "4000000000", "more than fit into the file");
  check_piece(&Piece_text::number_of_points, "5", "does not have the 15 values");
  check_piece(&Piece_text::number_of_points, "3", "does not have the 9 values");
  check_piece(&Piece_text::number_of_cells, "2", "does not have the 2 values");
  check_piece(&Piece_text::points, "0 0 0 1 0 0 0 1 0 0 nan 1", "vertex 3 has a coordinate");
  check_piece(&Piece_text::points, "0 0 0 1 0 0 0 1 0 0 -inf 1", "vertex 3 has a coordinate");
  check_piece(&Piece_text::points, "0 0 0 1 0 0 0 1 0 0 0x 1", "has \"0x\" where a number");
  check_piece(&Piece_text::point_type, "Float16", "unknown type \"Float16\"");
  check_piece(&Piece_text::index_type, "Float32", "expected integers");
  check_piece(&Piece_text::connectivity, "0 1 2 4", "cell 0 has the point 4, which does not exist");
  check_piece(&Piece_text::connectivity, "0 -1 2 3", "cell 0 has the point -1");
  check_piece(&Piece_text::offsets, "9000000000000000000", "more than fit into the file");
  check_piece(&Piece_text::offsets, "-1", "not increasing");
  check_piece(&Piece_text::types, "12", "cell 0 has 4 points; expected 8");
  check_piece(&Piece_text::types, "24", "cell 0 is of higher order (VTK's type 24)");
  check_piece(&Piece_text::types, "42", "cell 0 cannot be read (VTK's type 42)");
  check_piece(&Piece_text::types, "5", "has no hexahedra");
  check_piece(&Piece_text::types, "256", "has \"256\" where a number of type UInt8");
  const std::string whole = vtu(Piece_text().text());
  check(".vtu", whole.substr(0, whole.size() - 3), "is truncated");

  check(".msh", "", "is empty");
  check(".msh", whole, "not a file of Gmsh");
  check(".msh", replaced(msh4, "4.1", "4"), "unknown version");
  check(".msh", replaced(msh4, "0 8", "0 4"), "size other than 8");
  check(".msh", replaced(msh4, "4.1 0 8\n", std::string("4.1 1 8\n\0\0\0\1", 12)),
        "byte order of another machine");
  check(".msh", replaced(msh2, msh2_nodes, ""), "has elements before the nodes");
  check(".msh", replaced(msh2, msh2_nodes, msh2_nodes + msh2_nodes), "two sections $Nodes");
  check(".msh", msh2.substr(0, msh2.find("$Elements")), "it has no $Elements");
  check(".msh", replaced(msh2, "$Nodes\n6", "$ParametricNodes\n6"), "has $ParametricNodes");
  check(".msh", replaced(msh2, "5 0 0 0", "4 0 0 0"), "two nodes have the number 4");
  check(".msh", replaced(msh2, "5 0 0 0", "5 0 0 1e999"), "\"1e999\" where a number");
  check(".msh", replaced(msh2, "5 0 0 0", "5 0 0 inf"), "vertex 1 has a coordinate");
  for(const char* large : {"1.1e30", "-1e200", "1e307"})
    check(".msh", replaced(msh2, "5 0 0 0", std::string("5 0 0 ") + large),
          "vertex 1 has a coordinate beyond 1e30");
  check(".msh", replaced(msh2, "$Nodes\n6", "$Nodes\n2147483647"), "a count of 2147483647 in $Nodes");
  check(".msh", replaced(msh2, "$Nodes\n6", "$Nodes\n-6"), "a count of -6");
  check(".msh", replaced(msh2, "$Nodes\n6", "$Nodes\n7"), "where a number is expected");
  check(".msh", replaced(msh2, "7 4 2", "7 11 2"), "higher order (Gmsh's type 11)");
  check(".msh", replaced(msh2, "7 4 2", "7 35 2"), "cannot be read (Gmsh's type 35)");
  check(".msh", replaced(msh2, "900 30 4\n$", "900 30 3\n$"), "has the node 3, which does not exist");
  check(".msh", replaced(msh4, "$Nodes\n3 6", "$Nodes\n3 7"), "it has 6 nodes");
  check(".msh", replaced(msh4, "$Elements\n3 3", "$Elements\n3 4"), "it has 3 elements");
  check(".msh", replaced(msh4, "4 6 7 8 90", "4 6 7 8 89"), "has the node 89");
  check(".msh", replaced(msh4, "$EndNodes", "$End"), "where \"$Nodes\" should end");
}

void test_errors_of_others(const fs::path& directory)
{
  const auto check = [&](const char* name, const std::string& text, const std::string& expected) {
    const std::string path = (directory / name).string();
    set_contents(path, text);
    Mesh mesh;
    std::string error;
    BOOST_TEST(!IO::read_mixed_mesh(path, mesh, &error));
    BOOST_TEST(mesh.is_empty());
    BOOST_TEST(error.find(expected) != std::string::npos);
    if(error.find(expected) == std::string::npos)
      std::cerr << "\"" << error << "\" without \"" << expected << "\"\n";
    fs::remove(path);
  };
  check("error.mesh", msh2, "not a text file of Medit");
  check("error.mesh", replaced(medit, "Dimension\n3", "Dimension 2"), "not a mesh in space");
  check("error.mesh", replaced(medit, "Vertices 5", "Vertices 6"), "where a number is expected");
  check("error.mesh", replaced(medit, "Vertices 5", "Vertices 500000000"), "a count of 500000000");
  check("error.mesh", replaced(medit, "Vertices 5", "Verticles 5"), "has elements before the vertices");
  check("error.mesh", replaced(medit, "2 3 4 5 0", "2 3 4 6 0"), "has the vertex 6, which does not exist");
  check("error.mesh", replaced(medit, "2 3 4 5 0", "2 3 4 0 0"), "has the vertex 0, which does not exist");
  check("error.mesh", replaced(medit, "Tetrahedra", "Edges"), "has no hexahedra");
  check("error.mesh", replaced(medit, "End", ""), "is truncated");
  check("error.vol", replaced(vol, "endmesh", ""), "is truncated");
  check("error.vol", msh2, "not a mesh of Netgen");
  check("error.vol", replaced(vol, " 4 4 6", " 4 7 6"), "has elements of 7 vertices");
  check("error.vol", replaced(vol, "12 10 9", "12 10 14"), "has the vertex 14, which does not exist");
  check("error.ele", ele, "error.node: cannot be opened");
  set_contents(directory / "error.node", node);
  check("error.ele", replaced(ele, "2 4 1", "2 10 1"), "has tetrahedra of 10 vertices");
  check("error.ele", replaced(ele, "4 5 7 8", "4 5 7 9"), "has the vertex 9, which does not exist");
  check("error.ele", replaced(ele, "2 4 1", "3 4 1"), "is truncated");
  set_contents(directory / "error.ele", ele);
  check("error.node", replaced(node, "\n3 0 1 0", "\n4 0 1 0"), "the vertex 4 is out of order");
  check("error.node", replaced(node, "9  3", "9  2"), "not a mesh in space");
  fs::remove(directory / "error.ele");
}

// Prints the content for test_read_writers.py.
void print(const std::string& path)
{
  Mesh mesh;
  std::string error;
  if(!IO::read_mixed_mesh(path, mesh, &error))
    throw std::runtime_error(error);
  std::cout << std::setprecision(17) << "{\"vertices\": " << mesh.number_of_vertices()
            << ", \"boundary_faces\": " << boundary_faces(mesh).size() << ", \"elements\": [";
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    std::cout << (e == 0 ? "" : ", ") << "[\"" << mesh.element(e).reference().name << "\", "
              << volume(mesh, e) << ", " << mesh.is_in_region(e) << "]";
  std::cout << "]}\n";
}

int run(int argc, char* argv[])
{
  if(argc > 1 && std::string(argv[1]) == "--files") {
    for(int i = 2; i < argc; ++i) {
      const fs::path path = argv[i];
      try {
        print(path.string());
      } catch(const std::runtime_error& e) {
        std::cout << "\"" << e.what() << "\"\n";
        continue;
      }
      test_damage(path.string(), (path.parent_path() / ("damaged_" + path.filename().string())).string());
    }
    return boost::report_errors();
  }
  const fs::path data = argc > 1 ? argv[1] : "data", directory = argc > 2 ? argv[2] : ".";
  fs::create_directories(directory);
  test_errors(directory);
  test_errors_of_others(directory);
  test_hand_written(directory);
  test_formats_of_others(directory);
  test_round_trips(data, directory);
  test_subdomain_names(directory);
  return boost::report_errors();
}

} // namespace test_io_read
