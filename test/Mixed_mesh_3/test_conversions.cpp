// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes in other packages: linear cell complexes, surface meshes of boundaries, streams.

#include "test_meshes.h"

#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/IO/stream.h>
#include <CGAL/Mixed_mesh_3/boundary_to_face_graph.h>
#include <CGAL/Mixed_mesh_3/linear_cell_complex.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>

#include <boost/core/lightweight_test.hpp>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>

namespace test_conversions {

namespace mm3 = CGAL::Mixed_meshes_3;
namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Traits = CGAL::Linear_cell_complex_traits<3, Kernel>;
using Complex =
  CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, Traits, CGAL::Mixed_mesh_linear_cell_complex_items_3>;
using Plain_complex = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, Traits>;
using Point_3 = Kernel::Point_3;

bool is_near(double a, double b) { return std::abs(a - b) <= 1e-12 * (std::abs(a) + std::abs(b)); }

Mesh grid(int n, mm3::Element_kind kind)
{
  Mesh mesh = grid_of_cells<Mesh>(n, kind, [](double x, double y, double z) { return Point_3(x, y, z); });
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    double x = 0; // of the center, times the number of vertices
    for(const mm3::Vertex_index v : mesh.element(e))
      x += mesh.point(v).x();
    mesh.set_subdomain_index(e, x < mesh.element(e).size() ? 1 : 7);
  }
  return mesh;
}

template <class LCC>
void test_round_trip(const Mesh& mesh, bool keeps_labels)
{
  LCC lcc;
  CGAL::mixed_mesh_to_linear_cell_complex(mesh, lcc);
  BOOST_TEST(lcc.is_valid());
  BOOST_TEST_EQ(lcc.template one_dart_per_cell<3>().size(), mesh.number_of_elements());
  BOOST_TEST_EQ(lcc.template one_dart_per_cell<0>().size(), mesh.number_of_vertices());
  std::size_t quadrilaterals_and_triangles = mm3::boundary_faces(mesh).size(), sides = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    sides += std::size_t(mesh.element(e).reference().number_of_faces);
  // Each inner face has two sides, each face of the boundary one.
  BOOST_TEST_EQ(2 * lcc.template one_dart_per_cell<2>().size(), sides + quadrilaterals_and_triangles);

  Mesh back;
  BOOST_TEST(CGAL::linear_cell_complex_to_mixed_mesh(lcc, back));
  BOOST_TEST_EQ(back.number_of_vertices(), mesh.number_of_vertices());
  BOOST_TEST_EQ(back.number_of_elements(), mesh.number_of_elements());
  if(back.number_of_vertices() != mesh.number_of_vertices()
     || back.number_of_elements() != mesh.number_of_elements())
    return;
  BOOST_TEST(back.points() == mesh.points());
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const auto a = mesh.element(e), b = back.element(e);
    BOOST_TEST(a.kind() == b.kind());
    BOOST_TEST(std::equal(a.begin(), a.end(), b.begin(), b.end())); // orientation, too
    BOOST_TEST(!keeps_labels || mesh.attributes(e) == back.attributes(e));
  }
}

void test_round_trips()
{
  for(const mm3::Element_kind kind : mm3::element_kinds)
    test_round_trip<Complex>(grid(3, kind), true);
  test_round_trip<Complex>(four_kinds<Mesh>(1, {0, 0, 0}), true);
  test_round_trip<Plain_complex>(four_kinds<Mesh>(1, {0, 0, 0}), false);
  test_round_trip<Complex>(Mesh(), true);
}

// Volumes made by CGAL, whose orientation is not ours.
void test_volumes_of_cgal()
{
  Plain_complex lcc;
  lcc.make_hexahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0),
                      Point_3(0, 1, 1), Point_3(0, 0, 1), Point_3(1, 0, 1), Point_3(1, 1, 1));
  lcc.make_tetrahedron(Point_3(2, 0, 0), Point_3(3, 0, 0), Point_3(2, 1, 0), Point_3(2, 0, 1));
  Mesh mesh;
  BOOST_TEST(CGAL::linear_cell_complex_to_mixed_mesh(lcc, mesh));
  BOOST_TEST_EQ(mesh.number_of_elements(), 2u);
  BOOST_TEST_EQ(mesh.number_of_vertices(), 12u);
  if(mesh.number_of_elements() == 2) {
    const double hexahedron = mm3::volume(mesh, 0), tetrahedron = mm3::volume(mesh, 1);
    BOOST_TEST(is_near(std::abs(hexahedron), 1) || is_near(std::abs(tetrahedron), 1));
    BOOST_TEST(is_near(std::abs(hexahedron) + std::abs(tetrahedron), 7. / 6));
    BOOST_TEST_GT(hexahedron, 0);
    BOOST_TEST_GT(tetrahedron, 0);
  }

  const auto triangle = lcc.make_triangle(Point_3(5, 0, 0), Point_3(6, 0, 0), Point_3(5, 1, 0));
  BOOST_TEST(!CGAL::linear_cell_complex_to_mixed_mesh(lcc, mesh)); // a triangle encloses nothing
  BOOST_TEST(mesh.is_empty() && mesh.number_of_vertices() == 0);
  lcc.remove_cell<2>(triangle);
  BOOST_TEST(CGAL::linear_cell_complex_to_mixed_mesh(lcc, mesh));
  lcc.insert_barycenter_in_cell<2>(lcc.darts().begin());
  BOOST_TEST(!CGAL::linear_cell_complex_to_mixed_mesh(lcc, mesh)); // nine faces
}

template <class Surface>
double volume_of(Surface surface)
{
  PMP::triangulate_faces(surface);
  return PMP::volume(surface);
}

template <class Surface>
void test_boundaries()
{
  for(const mm3::Element_kind kind : mm3::element_kinds) {
    const Mesh mesh = grid(3, kind);
    Surface all, left, right, none;
    BOOST_TEST(CGAL::boundary_to_face_graph(mesh, all));
    BOOST_TEST(CGAL::is_closed(all));
    BOOST_TEST_EQ(num_faces(all), mm3::boundary_faces(mesh).size());
    BOOST_TEST(is_near(volume_of(all), 27)); // positive: outwards
    CGAL::boundary_to_face_graph(mesh, 1, left);
    CGAL::boundary_to_face_graph(mesh, 7, right);
    BOOST_TEST(CGAL::is_closed(left) && CGAL::is_closed(right));
    BOOST_TEST(is_near(volume_of(left) + volume_of(right), 27));
    BOOST_TEST(volume_of(left) > 0 && volume_of(right) > 0);
    CGAL::boundary_to_face_graph(mesh, 3, none);
    BOOST_TEST_EQ(num_faces(none), 0u);
  }

  // Two cubes have only an edge in common.
  Mesh mesh = grid(2, mm3::HEXAHEDRON), pinched;
  for(const Point_3& p : mesh.points())
    pinched.add_vertex(p);
  for(const std::size_t e : {0, 3})
    pinched.add_element(mm3::HEXAHEDRON,
                        std::vector<mm3::Vertex_index>(mesh.element(e).begin(), mesh.element(e).end()));
  Surface surface;
  BOOST_TEST(!CGAL::boundary_to_face_graph(pinched, surface));
  BOOST_TEST_EQ(num_vertices(surface), 0u);
  // Two cubes have only a vertex in common.
  pinched.clear();
  for(const Point_3& p : mesh.points())
    pinched.add_vertex(p);
  for(const std::size_t e : {0, 7})
    pinched.add_element(mm3::HEXAHEDRON,
                        std::vector<mm3::Vertex_index>(mesh.element(e).begin(), mesh.element(e).end()));
  BOOST_TEST(!CGAL::boundary_to_face_graph(pinched, surface));
  BOOST_TEST_EQ(num_vertices(surface), 0u);
}

// A mesh that is written to a stream can be read as a file.
void test_stream(const std::string& path)
{
  const Mesh mesh = four_kinds<Mesh>(1, {0, 0, 0});
  {
    std::ofstream out(path);
    out << mesh;
  }
  Mesh back;
  std::string error;
  BOOST_TEST(mm3::IO::read_mixed_mesh(path, back, &error));
  BOOST_TEST_EQ(error, "");
  BOOST_TEST_EQ(back.number_of_elements(), mesh.number_of_elements());
  BOOST_TEST(back.points() == mesh.points());
  BOOST_TEST(is_near(mm3::volume(back), mm3::volume(mesh)));
}

int run(int, char*[])
{
  test_round_trips();
  test_volumes_of_cgal();
  test_boundaries<CGAL::Surface_mesh<Point_3>>();
  test_boundaries<CGAL::Polyhedron_3<Kernel>>();
  test_stream("test_conversions.mesh");
  return boost::report_errors();
}

} // namespace test_conversions
