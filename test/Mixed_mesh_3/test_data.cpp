// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data of the user at vertices and elements, which all functions on meshes pass on. The data tell where they
// come from: each vertex has its place, each element its number.

#include "test_meshes.h"
#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3/Data_columns.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/extract_subdomains.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Transaction.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/moves/bisect_edge.h>
#include <CGAL/Mixed_mesh_3/resect.h>
#include <CGAL/Mixed_mesh_3/split_along_faces.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace test_data {

using namespace CGAL::Mixed_meshes_3;
using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;
using Criteria = CGAL::Mixed_mesh_optimization_criteria_3;
using Edge = std::pair<double, double>;

Vec3 vec3(const double* x) { return {x[0], x[1], x[2]}; }

double linear(const Vec3& p) { return 3 + p[0] - 2 * p[1] + 0.5 * p[2]; }

// The rule of `numbers`: -1, and the numbers of both ends, where the first number is that of the vertex.
void note_ends(const Data_column& column, const std::vector<Weighted_row>& origins, double* row)
{
  BOOST_TEST_EQ(origins.size(), 2u);
  double sum = 0;
  for(const Weighted_row& origin : origins)
    sum += origin.weight;
  BOOST_TEST_EQ(sum, 1);
  row[0] = -1;
  row[1] = column[origins[0].row][0];
  row[2] = column[origins[1].row][0];
}

void add_data(Mesh& mesh)
{
  std::vector<double> places, values, numbers, ids, centers;
  for(const Test_point& p : mesh.points()) {
    places.insert(places.end(), {p.x(), p.y(), p.z()});
    values.push_back(linear(to_vec3(p)));
    const double v = double(numbers.size()) / 3;
    numbers.insert(numbers.end(), {v, v, v});
  }
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    ids.push_back(e);
    centers.insert(centers.end(), {e + 0.25, e + 0.5, e + 0.75});
  }
  mesh.vertex_data().add("place", places, 3);
  mesh.vertex_data().add("linear", values);
  mesh.vertex_data().add("numbers", numbers, 3).set_rule(note_ends);
  mesh.element_data().add("id", ids);
  mesh.element_data().add("direction", centers, 3);
}

Vec3 place(const Mesh& mesh, Vertex_index v) { return vec3((*mesh.vertex_data().find("place"))[v]); }

double id(const Mesh& mesh, Element_index e) { return *(*mesh.element_data().find("id"))[e]; }

bool has_data(const Mesh& mesh)
{
  return mesh.vertex_data().size() == 3 && mesh.element_data().size() == 2
         && mesh.vertex_data().has_size(mesh.number_of_vertices())
         && mesh.element_data().has_size(mesh.number_of_elements());
}

// Whether both components of an element are of the same one.
bool are_rows_together(const Mesh& mesh)
{
  const Data_column& directions = *mesh.element_data().find("direction");
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(directions[e][0] != id(mesh, e) + 0.25 || directions[e][2] != id(mesh, e) + 0.75)
      return false;
  return true;
}

bool is_same(const Mesh& a, const Mesh& b)
{
  return a.points() == b.points() && a.elements().kinds() == b.elements().kinds()
         && a.elements().connectivity() == b.elements().connectivity() && a.attributes() == b.attributes();
}

Mesh grid(int n, Element_kind kind)
{
  return grid_of_cells<Mesh>(n, kind, [](double x, double y, double z) { return Test_point(x, y, z); });
}

// ---- columns -----------------------------------------------------------------------------------

void test_columns()
{
  Mesh mesh = grid(1, HEXAHEDRON);
  BOOST_TEST(mesh.vertex_data().empty() && mesh.element_data().empty());
  add_data(mesh);
  BOOST_TEST(has_data(mesh) && mesh.vertex_data().find("none") == nullptr);
  mesh.add_vertex({9, 9, 9});
  mesh.add_element(HEXAHEDRON, mesh.element(0).begin());
  BOOST_TEST(has_data(mesh));
  BOOST_TEST(std::isnan(place(mesh, 8)[2]) && std::isnan(id(mesh, 1)));
  *(*mesh.element_data().find("id"))[1] = 7;
  BOOST_TEST_EQ(id(mesh, 1), 7);
  BOOST_TEST(mesh.vertex_data().remove("place") && !mesh.vertex_data().remove("place"));
  BOOST_TEST_EQ(mesh.vertex_data().size(), 2u);

  // Any number of origins, and rows that come from new rows.
  Data_columns columns;
  columns.add("a", {1, 10, 2, 20, 4, 40}, 2);
  columns.add_row({{0, 0.5}, {1, 0.25}, {2, 0.25}});
  columns.add_row({{3, 0.5}, {2, 0.5}});
  const Data_columns some = columns.selected(std::vector<Vertex_index>{4, 0, 0});
  BOOST_TEST(some.find("a")->values() == (std::vector<double>{3, 30, 1, 10, 1, 10}));

  mesh.assign(mesh.points(), mesh.elements(), mesh.attributes());
  BOOST_TEST(mesh.vertex_data().empty() && mesh.element_data().empty());
  add_data(mesh);
  mesh.clear();
  BOOST_TEST(mesh.vertex_data().empty() && mesh.element_data().empty());
}

// ---- parts and copies --------------------------------------------------------------------------

void test_parts()
{
  for(Element_kind kind : element_kinds) {
    Mesh mesh = grid(3, kind);
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      mesh.set_subdomain_index(e, 1 + int(e % 3));
    add_data(mesh);
    std::vector<bool> is_asked(mesh.number_of_elements(), false);
    is_asked[mesh.number_of_elements() / 2] = true;
    const Resection_3 resection = resect(mesh, is_asked);
    for(bool is_resected : {false, true}) {
      std::vector<Vertex_index> vertex_map;
      std::vector<Element_index> element_map;
      const Mesh part = is_resected ? remaining_mesh(mesh, resection.is_removed, &vertex_map, &element_map)
                                    : extract_subdomains(mesh, {1, 3}, &vertex_map, &element_map);
      BOOST_TEST(has_data(part) && part.number_of_elements() < mesh.number_of_elements());
      if(!has_data(part))
        return;
      for(Vertex_index v = 0; v < part.number_of_vertices(); ++v)
        BOOST_TEST(place(part, v) == to_vec3(part.point(v)) && place(part, v) == place(mesh, vertex_map[v]));
      for(Element_index e = 0; e < part.number_of_elements(); ++e)
        BOOST_TEST(id(part, e) == element_map[e]);
      BOOST_TEST(are_rows_together(part));
    }

    std::vector<Element_index> origins;
    const Mesh tetrahedra = split_to_tetrahedra(mesh, &origins);
    BOOST_TEST(has_data(tetrahedra));
    if(!has_data(tetrahedra))
      return;
    for(Vertex_index v = 0; v < tetrahedra.number_of_vertices(); ++v)
      BOOST_TEST(place(tetrahedra, v) == to_vec3(tetrahedra.point(v)));
    for(Element_index e = 0; e < tetrahedra.number_of_elements(); ++e)
      BOOST_TEST(id(tetrahedra, e) == origins[e]);
    BOOST_TEST(are_rows_together(tetrahedra));
  }
}

void test_slit()
{
  Mesh mesh = grid(2, HEXAHEDRON);
  add_data(mesh);
  const std::size_t n = mesh.number_of_vertices();
  std::vector<Face> faces;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    for(int f = 0; f < 6; ++f) {
      const Face face(mesh.elements(), e, f);
      if(std::all_of(face.vertices().begin(), face.vertices().end(),
                     [&](Vertex_index v) { return mesh.point(v).x() == 1; }))
        faces.push_back(face);
    }
  const Slit slit = split_along_faces(mesh, faces);
  BOOST_TEST_EQ(mesh.number_of_vertices(), n + 9);
  BOOST_TEST(has_data(mesh));
  if(!has_data(mesh))
    return;
  const Data_column& numbers = *mesh.vertex_data().find("numbers");
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    BOOST_TEST(place(mesh, v) == to_vec3(mesh.point(v)));
    BOOST_TEST_EQ(numbers[v][0], v < n ? double(v) : double(slit.origins[v - n])); // copies need no rule
  }
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    BOOST_TEST_EQ(id(mesh, e), e);
}

// ---- optimization ------------------------------------------------------------------------------

struct Tally
{
  std::size_t middles = 0, gone = 0, new_elements = 0;
};

// Each element that is not of the start has the data of the element at its center, as vertices were.
void check_elements(const Mesh& start, const Mesh& mesh, Tally& tally)
{
  const Data_column& numbers = *mesh.vertex_data().find("numbers");
  std::map<std::vector<double>, double> known; // elements by their vertices
  for(Element_index e = 0; e < start.number_of_elements(); ++e)
    known.emplace(std::vector<double>(start.element(e).begin(), start.element(e).end()), e);
  const Element_locator_3<Mesh> locator(start);
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    std::vector<double> vertices;
    Vec3 center{};
    for(Vertex_index v : mesh.element(e)) {
      vertices.push_back(numbers[v][0]);
      center = center + (1. / mesh.element(e).size()) * place(mesh, v);
    }
    const auto found = known.find(vertices);
    if(found != known.end()) {
      BOOST_TEST_EQ(id(mesh, e), found->second);
      continue;
    }
    ++tally.new_elements;
    Mesh origin;
    for(const Test_point& p : start.points())
      origin.add_vertex(p);
    const Element_view element = start.element(Element_index(std::uint32_t(id(mesh, e))));
    origin.add_element(element.kind(), element.begin());
    BOOST_TEST_LE(Element_locator_3<Mesh>(origin).nearest(center).distance,
                  locator.nearest(center).distance + 1e-12);
  }
}

// Vertices that stay have their data; those of others are those of a middle.
void check_vertices(const Mesh& start, const Mesh& mesh, bool has_edges_of_start, Tally& tally)
{
  std::set<Edge> edges;
  for(Element_index e = 0; e < start.number_of_elements(); ++e)
    for(int i = 0; i < start.element(e).reference().number_of_edges; ++i) {
      const auto& edge = start.element(e).reference().edges[i];
      edges.insert(std::minmax(double(start.element(e)[edge[0]]), double(start.element(e)[edge[1]])));
    }
  const Data_column &numbers = *mesh.vertex_data().find("numbers"),
                    &values = *mesh.vertex_data().find("linear");
  double last = -1; // vertices that stay keep their order
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const double number = numbers[v][0];
    const Vec3 p = place(mesh, v);
    if(number >= 0) {
      const Vertex_index old(std::uint32_t(number + 0.5));
      BOOST_TEST(last < number && old < start.number_of_vertices());
      BOOST_TEST(p == to_vec3(start.point(old)) && *values[v] == linear(p));
      last = number;
      continue;
    }
    ++tally.middles;
    BOOST_TEST_LE(std::abs(*values[v] - linear(p)), 1e-12);
    const double a = numbers[v][1], b = numbers[v][2];
    if(a >= 0 && b >= 0) {
      BOOST_TEST(!has_edges_of_start || edges.count(std::minmax(a, b)) == 1);
      BOOST_TEST_LE(
        norm(p - 0.5 * (to_vec3(start.point(std::uint32_t(a))) + to_vec3(start.point(std::uint32_t(b))))),
        1e-12);
    }
  }
  tally.gone += start.number_of_vertices() + tally.middles - mesh.number_of_vertices();
}

void test_optimization()
{
  const Test_surface surface = sphere({0.1, 0.2, 0.3}, 1, 12);
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
  Mesh plain;
  make_mixed_mesh_3(domain, CGAL::Everywhere_mixed_mesh_region_3(),
                    CGAL::Mixed_mesh_criteria_3(300).fit_to_surface(false), plain);
  Mesh start = plain;
  add_data(start);
  std::size_t most_middles = 0, new_elements = 0;
  for(bool flips : {false, true})
    for(std::size_t number : {0, 7, 40}) {
      Mesh mesh = start, without = plain;
      const auto criteria = Criteria().flips(flips).number_of_bisections(number);
      const auto result = optimize_mixed_mesh_3(mesh, domain, criteria);
      optimize_mixed_mesh_3(without, domain, criteria);
      BOOST_TEST(is_same(mesh, without)); // data have no effect
      BOOST_TEST(has_data(mesh));
      if(!has_data(mesh))
        return;
      Tally tally;
      check_vertices(start, mesh, !flips, tally);
      check_elements(start, mesh, tally);
      BOOST_TEST(are_rows_together(mesh));
      BOOST_TEST_EQ(tally.middles, result.number_of_bisections);
      BOOST_TEST(flips || number > 0 || tally.new_elements == 0);
      most_middles = (std::max)(most_middles, tally.middles);
      new_elements += tally.new_elements;
    }
  BOOST_TEST_EQ(most_middles, 40u);
  BOOST_TEST_GT(new_elements, 100u);
}

// Moves of a working mesh: bisections of halves, and a collapse, after which vertices have other numbers.
void test_moves()
{
  Mesh start = grid(2, TETRAHEDRON);
  add_data(start);
  internal::Working_mesh working(start, std::vector<internal::Stratum>(start.number_of_vertices()));
  const Vertex_index n(std::uint32_t(start.number_of_vertices()));
  {
    internal::Transaction transaction(working);
    transaction.add_vertex({0.5, 0, 0}, {}, {0, 1});
    transaction.add_vertex({0.25, 0, 0}, {}, {0, n}); // not accepted
  }
  const Aspect_ratio_quality_3 quality;
  const double infinity = std::numeric_limits<double>::infinity();
  BOOST_TEST(internal::bisect_edge(working, quality, 0, 1, {0.5, 0, 0}, {}, infinity));
  BOOST_TEST(internal::bisect_edge(working, quality, 0, n, {0.25, 0.01, 0}, {}, infinity));
  BOOST_TEST(internal::bisect_edge(working, quality, 2, 1, {1.5, 0, 0}, {}, infinity));
  working.collapse(n, 1);
  working.collapse(Vertex_index(n - 1), 13); // a corner of the grid
  const Mesh mesh = working.changed(start);
  BOOST_TEST_EQ(mesh.number_of_vertices(), n + 1);
  BOOST_TEST(has_data(mesh));
  if(!has_data(mesh))
    return;
  BOOST_TEST(place(mesh, Vertex_index(n - 1)) == (Vec3{0.25, 0, 0}) && place(mesh, n) == (Vec3{1.5, 0, 0}));
  const Data_column& numbers = *mesh.vertex_data().find("numbers");
  BOOST_TEST(numbers[n - 1][1] == 0 && numbers[n - 1][2] == -1 && numbers[n][1] == 2 && numbers[n][2] == 1);
  Tally tally;
  check_vertices(start, mesh, true, tally);
  check_elements(start, mesh, tally);
  BOOST_TEST(tally.middles == 2 && tally.gone == 1 && tally.new_elements > 0);
}

// An element has the data of its subdomain, also where its center was in another one, or outside.
void test_subdomains()
{
  Mesh start = grid(2, HEXAHEDRON);
  for(Element_index e = 0; e < start.number_of_elements(); ++e)
    start.set_subdomain_index(e, start.point(start.element(e)[0]).x() < 1 ? 1 : 2);
  internal::Working_mesh working(start, std::vector<internal::Stratum>(start.number_of_vertices()));
  std::vector<internal::Working_mesh::Element> elements = working.elements;
  elements[1].is_removed = true;
  elements.push_back(elements[3]); // in subdomain 2
  elements.back().attributes.subdomain_index = 1;
  elements[7].attributes.subdomain_index = 1; // handed over
  const std::vector<Element_index> origins = internal::element_origins(start, elements, working.points);
  const std::vector<Element_index> expected = {0, 2, 3, 4, 5, 6, 6, 2};
  BOOST_TEST(origins == expected);
}

// ---- files -------------------------------------------------------------------------------------

bool has_same_bytes(const Data_columns& a, const Data_columns& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Data_column& c, const Data_column& d) {
    return c.name() == d.name() && c.number_of_components() == d.number_of_components()
           && c.values().size() == d.values().size()
           && std::memcmp(c.values().data(), d.values().data(), sizeof(double) * c.values().size()) == 0;
  });
}

void test_files(const std::string& path)
{
  Mesh mesh = four_kinds<Mesh>(1, {0, 0, 0});
  std::string error;
  Mesh back;
  { // elements in the order of files
    BOOST_TEST(IO::write_mixed_mesh(path, mesh, {}, &error) && IO::read_mixed_mesh(path, back, &error));
    BOOST_TEST(back.vertex_data().empty() && back.element_data().empty()); // none of ours are the user's
    mesh = back;
  }
  add_data(mesh);
  std::vector<double> odd(mesh.number_of_elements(), 0.1);
  odd[0] = std::numeric_limits<double>::quiet_NaN();
  odd[1] = -0.;
  odd[2] = std::numeric_limits<double>::denorm_min();
  mesh.element_data().add("a<b & \"c\" &lt;", odd);
  BOOST_TEST(IO::write_mixed_mesh(path, mesh, {}, &error) && IO::read_mixed_mesh(path, back, &error));
  BOOST_TEST(is_same(mesh, back));
  BOOST_TEST(has_same_bytes(mesh.vertex_data(), back.vertex_data()) && back.vertex_data().size() == 3);
  BOOST_TEST(has_same_bytes(mesh.element_data(), back.element_data()) && back.element_data().size() == 3);

  // Values of the options replace columns of their names, here and when the file is written again.
  const std::vector<double> other(mesh.number_of_vertices(), 5);
  IO::Write_options options;
  options.vertex_data = {{"linear", &other}};
  options.tetrahedra = true;
  BOOST_TEST(IO::write_mixed_mesh(path, mesh, options, &error) && IO::read_mixed_mesh(path, back, &error));
  BOOST_TEST(back.vertex_data().size() == 3 && back.vertex_data().find("linear")->values() == other);
  BOOST_TEST_EQ(back.element_data().size(), 3u);
  BOOST_TEST(is_same(back, split_to_tetrahedra(mesh)) && are_rows_together(back));
  options.tetrahedra = false;
  options.order = 2;
  BOOST_TEST(IO::write_mixed_mesh(path, mesh, options, &error));

  // Names of ours, and wrong sizes.
  for(const char* name : {"subdomain", "kind", "facets_wall"}) {
    Mesh wrong = mesh;
    wrong.element_data().add(name, odd);
    BOOST_TEST(!IO::write_mixed_mesh(path, wrong, {}, &error));
    BOOST_TEST(error.find(std::string("data \"") + name + "\"") != std::string::npos);
    BOOST_TEST(IO::write_mixed_mesh(path + ".mesh", wrong, {}, &error)); // a format without them
  }
  Mesh wrong = mesh;
  wrong.vertex_data().add("nodes_wall", other);
  BOOST_TEST(!IO::write_mixed_mesh(path, wrong, {}, &error));
  wrong = mesh;
  wrong.points().pop_back();
  BOOST_TEST(!IO::write_mixed_mesh(path, wrong, {}, &error));
}

// Text in two pieces, with a line between the elements, and arrays that are no columns.
void test_pieces(const std::string& path)
{
  const auto piece = [](const std::string& value, const std::string& more) {
    return "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n<PointData>\n"
           "<DataArray type=\"Int32\" Name=\"t\" NumberOfComponents=\"2\" format=\"ascii\">"
           + value + " 1 2 3 4 5 6 7</DataArray>\n<DataArray type=\"Float64\" Name=\"" + more
           + "\" format=\"ascii\">1 2 3 4</DataArray>\n"
             "<Array type=\"String\" Name=\"s\" format=\"ascii\">97 0 97 0 97 0 97 0</Array></PointData>\n"
             "<CellData><DataArray type=\"Float32\" Name=\"c\" format=\"ascii\">9 "
           + value
           + "</DataArray></CellData>\n"
             "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
             "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>\n"
             "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 0 1 2 "
             "3</DataArray>\n"
             "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">2 6</DataArray>\n"
             "<DataArray type=\"Int32\" Name=\"types\" format=\"ascii\">3 10</DataArray></Cells>\n</Piece>\n";
  };
  std::ofstream(path) << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid>\n"
                      << piece("-8", "one") << piece("44", "other") << "</UnstructuredGrid></VTKFile>\n";
  Mesh mesh;
  std::string error;
  BOOST_TEST(IO::read_mixed_mesh(path, mesh, &error));
  BOOST_TEST_EQ(error, "");
  BOOST_TEST(mesh.vertex_data().size() == 1 && mesh.element_data().size() == 1);
  const Data_column *t = mesh.vertex_data().find("t"), *c = mesh.element_data().find("c");
  BOOST_TEST(t != nullptr && t->number_of_components() == 2
             && t->values() == (std::vector<double>{-8, 1, 2, 3, 4, 5, 6, 7, 44, 1, 2, 3, 4, 5, 6, 7}));
  BOOST_TEST(c != nullptr && c->values() == (std::vector<double>{-8, 44}));
}

int run(int, char* argv[])
{
  const std::string path = std::string(argv[2]) + ".vtu";
  test_columns();
  test_parts();
  test_slit();
  test_optimization();
  test_moves();
  test_subdomains();
  test_files(path);
  test_pieces(path);
  return boost::report_errors();
}

} // namespace test_data
