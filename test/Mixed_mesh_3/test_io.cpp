// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Usage: test_io [directory]. Writes files there (default: the current directory), and their content to
// io_expected.json, for test_io_readers.py: a program that reads its own files cannot find an error of
// convention.

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/FEB_model.h>
#include <CGAL/Mixed_mesh_3/IO/INP.h>
#include <CGAL/Mixed_mesh_3/IO/VTU.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <limits>
#include <locale>
#include <map>
#include <numeric>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#if defined(__unix__)
#include <csignal>
#include <sys/resource.h>
#endif

namespace test_io {

using namespace CGAL::Mixed_meshes_3;
namespace IO = CGAL::Mixed_meshes_3::IO;
namespace fs = std::filesystem;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Point = Kernel::Point_3;

const char* const extensions[] = {".vtu", ".msh", ".msh2", ".mesh", ".inp", ".feb"};

// The faces that occur once, by brute force. Empty if one occurs more than twice, or twice in the same
// direction.
template <class Mesh>
std::vector<Face> find_boundary_faces(const Mesh& mesh)
{
  std::map<std::vector<Vertex_index>, std::vector<Face>> faces;
  std::map<std::array<Vertex_index, 2>, int> boundary_edges;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    for(int f = 0; f < mesh.element(e).reference().number_of_faces; ++f) {
      const Face face(mesh.elements(), e, f);
      std::vector<Vertex_index> key(face.vertices().begin(), face.vertices().end());
      std::sort(key.begin(), key.end());
      faces[key].push_back(face);
    }
  std::vector<Face> result;
  for(const auto& entry : faces) {
    if(entry.second.size() > 2)
      return {};
    if(entry.second.size() == 1)
      result.push_back(entry.second.front());
  }
  for(const Face& face : result) {
    const Face_vertices& v = face.vertices();
    for(int i = 0; i < v.size(); ++i)
      ++boundary_edges[{v[i], v[(i + 1) % v.size()]}];
  }
  for(const auto& edge : boundary_edges) {
    const auto opposite = boundary_edges.find({edge.first[1], edge.first[0]});
    if(opposite == boundary_edges.end() || opposite->second != edge.second)
      return {};
  }
  std::sort(result.begin(), result.end());
  return result;
}

// Whether the boundary faces of a mesh are those found by brute force.
template <class Mesh>
bool has_right_boundary(const Mesh& mesh)
{
  const std::vector<Face> expected = find_boundary_faces(mesh);
  return !expected.empty() && expected == boundary_faces(mesh);
}

// An affine map without symmetry; planar faces stay planar.
Point affine(double x, double y, double z)
{
  return {1.25 * x + 0.25 * y - 0.1 * z - 7, 0.9 * y + 0.3 * z + 1. / 3, 1.1 * z - 0.2 * x + 1e-5};
}
const double affine_determinant = 1.25 * (0.9 * 1.1) - 0.25 * (0.3 * 0.2) - 0.1 * (0.9 * 0.2);

Mesh single_element(Element_kind kind)
{
  const Reference_element& reference = reference_elements[kind];
  Mesh mesh;
  std::vector<Vertex_index> vertices;
  for(int i = 0; i < reference.number_of_vertices; ++i) {
    const auto& c = reference.coordinates[i];
    vertices.push_back(mesh.add_vertex(affine(c[0], c[1], c[2])));
  }
  mesh.add_element(kind, vertices.data(), {1, kind % 2 == 0});
  BOOST_TEST(has_right_boundary(mesh));
  return mesh;
}

// A hexahedron, a pyramid on top of it, a prism and a tetrahedron beside them.
Mesh one_of_each_kind()
{
  Mesh mesh;
  for(const auto& c : reference_elements[HEXAHEDRON].coordinates)
    mesh.add_vertex(affine((1 + c[0]) / 2, (1 + c[1]) / 2, (1 + c[2]) / 2));
  mesh.add_vertex(affine(0.5, 0.5, 1.8)); // 8
  mesh.add_vertex(affine(2, 0, 0));       // 9
  mesh.add_vertex(affine(2, 1, 0));       // 10
  mesh.add_vertex(affine(1.9, 0.5, 1.5)); // 11
  mesh.add_element(HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7}, {1, true});
  mesh.add_element(PYRAMID, {4, 5, 6, 7, 8}, {1, true});
  mesh.add_element(PRISM, {1, 5, 9, 2, 6, 10}, {3, false});
  mesh.add_element(TETRAHEDRON, {5, 11, 6, 8});
  BOOST_TEST(has_right_boundary(mesh));
  return mesh;
}

// A grid of n^3 cells: hexahedra, cells of 6 pyramids, columns of prisms, and a top layer of cells
// with a center, joined to the prisms by tetrahedra. Vertices are numbered at random.
Mesh grid(int n, unsigned int seed, double noise)
{
  std::mt19937 random(seed);
  const auto uniform = [&random] { return double(random()) / 4294967296. - 0.5; };
  const int centers = (n + 1) * (n + 1) * (n + 1);
  std::vector<Vertex_index> number(std::size_t(centers + n * n * n));
  for(std::size_t i = 0; i < number.size(); ++i) {
    number[i] = Vertex_index(i);
    std::swap(number[i], number[random() % (i + 1)]);
  }
  const auto lattice = [n](int x, int y, int z) { return (z * (n + 1) + y) * (n + 1) + x; };

  std::vector<Point> points(number.size());
  std::vector<std::array<int, 9>> elements; // lattice vertices
  std::vector<Element_kind> kinds;
  std::vector<bool> is_used(number.size());
  const auto add = [&](Element_kind kind, std::array<int, 9> vertices) {
    kinds.push_back(kind);
    elements.push_back(vertices);
    for(int i = 0; i < reference_elements[kind].number_of_vertices; ++i)
      is_used[std::size_t(vertices[i])] = true;
  };

  for(int z = 0; z <= n; ++z)
    for(int y = 0; y <= n; ++y)
      for(int x = 0; x <= n; ++x)
        points[number[std::size_t(lattice(x, y, z))]] = affine(x + noise * uniform(), y + noise * uniform(),
                                                               z + noise * uniform());

  for(int z = 0; z < n; ++z)
    for(int y = 0; y < n; ++y)
      for(int x = 0; x < n; ++x) {
        int v[8];
        for(int i = 0; i < 8; ++i) {
          const auto& c = reference_elements[HEXAHEDRON].coordinates[i];
          v[i] = lattice(x + (c[0] > 0), y + (c[1] > 0), z + (c[2] > 0));
        }
        const int center = centers + (z * n + y) * n + x;
        points[number[std::size_t(center)]] = affine(x + 0.5 + noise * uniform(), y + 0.5 + noise * uniform(),
                                                     z + 0.5);
        const bool is_prism_column = (x + 2 * y) % 3 == 0;
        if(z + 1 < n && is_prism_column) {
          add(PRISM, {v[0], v[1], v[2], v[4], v[5], v[6]});
          add(PRISM, {v[0], v[2], v[3], v[4], v[6], v[7]});
        } else if(z + 1 < n && (x + y + z) % 2 == 0) {
          add(HEXAHEDRON, {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]});
        } else {
          for(int f = 0; f < 6; ++f) {
            const auto& w = reference_elements[HEXAHEDRON].faces[f].vertices;
            if(f == 4 && is_prism_column) { // the bottom
              add(TETRAHEDRON, {v[0], v[1], v[2], center});
              add(TETRAHEDRON, {v[0], v[2], v[3], center});
            } else {
              add(PYRAMID, {v[w[3]], v[w[2]], v[w[1]], v[w[0]], center});
            }
          }
        }
      }

  // The mesh has no unused vertices.
  std::vector<Vertex_index> used_number(number.size());
  std::vector<bool> is_number_used(number.size());
  for(std::size_t i = 0; i < number.size(); ++i)
    is_number_used[number[i]] = is_used[i];
  Mesh mesh;
  for(std::size_t i = 0; i < number.size(); ++i)
    if(is_number_used[i])
      used_number[i] = mesh.add_vertex(points[i]);
  for(std::size_t e = 0; e < elements.size(); ++e) {
    std::array<Vertex_index, 9> vertices{};
    for(int i = 0; i < reference_elements[kinds[e]].number_of_vertices; ++i)
      vertices[std::size_t(i)] = used_number[number[std::size_t(elements[e][std::size_t(i)])]];
    mesh.add_element(kinds[e], vertices.data(), {int(e % 3) + 1, e % 5 < 2});
  }
  BOOST_TEST(has_right_boundary(mesh));
  return mesh;
}

std::string contents(const fs::path& path)
{
  std::ifstream in(path, std::ios_base::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::size_t number_of_files(const fs::path& directory)
{
  return std::size_t(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
}

// The error of a function; empty if the function succeeds. `io(&error)` returns whether it did.
template <class Io>
std::string error_of(const Io& io)
{
  std::string error;
  const bool is_fine = io(&error);
  BOOST_TEST_EQ(is_fine, error.empty());
  return error;
}

bool mentions(const std::string& error, const std::string& text)
{
  const bool result = error.find(text) != std::string::npos && error.find('\n') == std::string::npos
                      && !error.empty();
  if(!result)
    std::cerr << "error \"" << error << "\" without \"" << text << "\"\n";
  return result;
}

// The error of `write_mixed_mesh()`; empty if there is none.
std::string write_error(const std::string& path, const Mesh& mesh,
                        const IO::Write_options& options = IO::Write_options())
{
  return error_of([&](std::string* error) { return IO::write_mixed_mesh(path, mesh, options, error); });
}

std::string check_error(const std::string& path)
{
  return error_of([&](std::string* error) { return IO::check_output_path(path, error); });
}

// Elements by kind, in the order of VTU files.
std::vector<Element_index> order_by_kind(const Mesh& mesh)
{
  std::vector<Element_index> order;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    order.push_back(e);
  std::stable_sort(order.begin(), order.end(), [&](Element_index e, Element_index f) {
    return mesh.element(e).kind() < mesh.element(f).kind();
  });
  return order;
}

std::size_t number_of_boundary_faces(const Mesh& mesh, int size)
{
  const std::vector<Face> faces = boundary_faces(mesh);
  return std::size_t(std::count_if(faces.begin(), faces.end(),
                                   [size](const Face& face) { return face.vertices().size() == size; }));
}

// Whether facet sets can share faces in the format.
bool can_share_faces(const std::string& extension) { return extension != ".msh2" && extension != ".mesh"; }

bool can_have_order_2(const std::string& extension, const Mesh& mesh)
{
  return extension != ".mesh" && (extension != ".inp" || mesh.elements().counts()[PYRAMID] == 0);
}

bool can_have_vertex_data(const std::string& extension)
{
  return extension != ".inp" && extension != ".mesh";
}

class Expectations
{
  fs::path m_directory;
  std::ostringstream m_json;

public:
  explicit Expectations(const fs::path& directory) : m_directory(directory)
  {
    m_json << std::setprecision(17) << "[";
  }

  // Writes the mesh in all formats, also of order 2, twice, and the content that readers must find. Vertex
  // data are the positions.
  void write(const std::string& name, const Mesh& mesh,
             const IO::Write_options& vtu_options = IO::Write_options(),
             const std::vector<IO::Facet_set>& facet_sets = {}, bool share_faces = false)
  {
    for(const char* extension : extensions) {
      if(share_faces && !can_share_faces(extension))
        continue;
      IO::Write_options options = std::string(extension) == ".vtu" ? vtu_options : IO::Write_options();
      options.facet_sets = facet_sets;
      if(can_have_vertex_data(extension))
        options.vertex_data = vtu_options.vertex_data;
      for(int order = 1; order <= (can_have_order_2(extension, mesh) ? 2 : 1); ++order) {
        const std::string path = (m_directory / (name + (order == 2 ? "_order_2" : "") + extension)).string();
        options.order = order;
        BOOST_TEST(IO::check_output_path(path, nullptr, order));
        BOOST_TEST(IO::write_mixed_mesh(path, mesh, options));
        const std::string first = contents(path);
        BOOST_TEST(!first.empty());
        BOOST_TEST(IO::write_mixed_mesh(path, mesh, options));
        BOOST_TEST(first == contents(path));
      }
    }
    std::size_t region = 0;
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      region += mesh.is_in_region(e);
    const auto counts = mesh.elements().counts();
    m_json << (m_json.str().size() > 1 ? ",\n" : "\n") << " {\"name\": \"" << name
           << "\", \"share_faces\": " << (share_faces ? "true" : "false") << ", \"vertex_data\": \""
           << (vtu_options.vertex_data.empty() ? "" : vtu_options.vertex_data.front().name)
           << "\", \"vertices\": " << mesh.number_of_vertices() << ", \"kinds\": [" << counts[0] << ", "
           << counts[1] << ", " << counts[2] << ", " << counts[3] << "], \"region\": " << region
           << ", \"triangles\": " << number_of_boundary_faces(mesh, 3)
           << ", \"quadrilaterals\": " << number_of_boundary_faces(mesh, 4)
           << ", \"volume\": " << volume(mesh) << ",\n  \"volumes\": [";
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      m_json << (e == 0 ? "" : ", ") << volume(mesh, e);
    m_json << "],\n  \"by_kind\": [";
    for(Element_index e : order_by_kind(mesh))
      m_json << (m_json.str().back() == '[' ? "" : ", ") << e;
    m_json << "],\n  \"subdomains\": [";
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      m_json << (e == 0 ? "" : ", ") << mesh.subdomain_index(e);
    m_json << "],\n  \"in_region\": [";
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      m_json << (e == 0 ? "" : ", ") << int(mesh.is_in_region(e));
    m_json << "],\n  \"ARC\": [";
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      m_json << (e == 0 ? "" : ", ") << aspect_ratio_coefficient(mesh, e);
    m_json << "],\n  \"points\": [";
    for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v)
      m_json << (v == 0 ? "" : ", ") << "[" << mesh.points()[v].x() << ", " << mesh.points()[v].y() << ", "
             << mesh.points()[v].z() << "]";
    m_json << "]}";
  }

  // Adds facet sets of the last mesh: for each face its element, whether the face is on the boundary, and its
  // vertices.
  void add_facet_sets(const Mesh& mesh, const std::vector<IO::Facet_set>& sets)
  {
    const std::vector<Face> boundary = find_boundary_faces(mesh);
    std::string json = m_json.str();
    json.pop_back(); // the end of the mesh
    m_json.str("");
    m_json << json << ",\n  \"facet_sets\": {";
    for(const IO::Facet_set& set : sets) {
      m_json << (m_json.str().back() == '{' ? "" : ",\n   ") << '"' << set.name << "\": [";
      for(const Face& face : set.faces) {
        m_json << (m_json.str().back() == '[' ? "" : ", ") << "[" << face.element() << ", "
               << int(std::binary_search(boundary.begin(), boundary.end(), face));
        for(Vertex_index v : face.vertices())
          m_json << ", " << v;
        m_json << "]";
      }
      m_json << "]";
    }
    m_json << "}}";
  }

  void finish()
  {
    std::ofstream out(m_directory / "io_expected.json");
    out << m_json.str() << "\n]\n";
    BOOST_TEST(out.good());
  }
};

std::string facet_set_error(const Mesh& mesh, const std::vector<IO::Facet_set>& sets, const std::string& file)
{
  IO::Write_options options;
  options.facet_sets = sets;
  return write_error(file, mesh, options);
}

double area_of(const Mesh& mesh, const std::vector<Face>& faces)
{
  return std::accumulate(faces.begin(), faces.end(), 0.,
                         [&mesh](double sum, const Face& face) { return sum + area(mesh, face); });
}

// The faces of the boundary that face a direction; and the faces of the elements of a subdomain.
std::vector<IO::Facet_set> facet_sets_of(const Mesh& mesh)
{
  std::vector<IO::Facet_set> sets{{"Left-side", {}}, {"right_2", {}}, {"empty", {}}, {"around", {}}};
  for(const Face& face : boundary_faces(mesh)) {
    const double x = vector_area(mesh, face)[0];
    if(std::abs(x) > 0.5 * area(mesh, face))
      sets[x > 0].faces.push_back(face);
  }
  for(std::size_t e = 0; e < mesh.number_of_elements(); e += 41)
    for(int f = 0; f < mesh.element(e).reference().number_of_faces; ++f)
      sets[3].faces.emplace_back(mesh.elements(), Element_index(e), f);
  return sets;
}

// Removes faces that are in an earlier set, so that all formats can have the sets.
void make_disjoint(std::vector<IO::Facet_set>& sets)
{
  std::vector<Face> used;
  for(IO::Facet_set& set : sets) {
    std::vector<Face> left;
    for(const Face& face : set.faces)
      if(std::find(used.begin(), used.end(), face) == used.end())
        left.push_back(face);
    set.faces = left;
    used.insert(used.end(), left.begin(), left.end());
  }
}

void test_facet_sets(Expectations& expectations, const fs::path& directory, const Mesh& mesh)
{
  std::vector<IO::Facet_set> sets = facet_sets_of(mesh);
  // A face in two sets is written in both, or refused.
  for(const char* extension : extensions)
    if(!can_share_faces(extension))
      BOOST_TEST(
        mentions(facet_set_error(mesh, sets, std::string("io_refused") + extension), "share a face"));
  expectations.write("io_shared_facets", mesh, {}, sets, true);
  expectations.add_facet_sets(mesh, sets);
  make_disjoint(sets);
  expectations.write("io_facets", mesh, {}, sets);
  expectations.add_facet_sets(mesh, sets);

  // Sets of the mesh are sets of its tetrahedra: faces are planar here.
  std::vector<Element_index> origins;
  const Mesh tetrahedra = split_to_tetrahedra(mesh, &origins);
  const std::vector<IO::Facet_set> split = IO::internal::split_facet_sets(tetrahedra, origins, sets);
  expectations.write("io_facet_tetrahedra", tetrahedra, {}, split);
  expectations.add_facet_sets(tetrahedra, split);
  for(std::size_t i = 0; i < sets.size(); ++i) {
    BOOST_TEST_EQ(split[i].name, sets[i].name);
    BOOST_TEST_LT(std::abs(area_of(tetrahedra, split[i].faces) - area_of(mesh, sets[i].faces)), 1e-11);
    for(const Face& face : split[i].faces)
      BOOST_TEST(std::any_of(sets[i].faces.begin(), sets[i].faces.end(),
                             [&](const Face& whole) { return whole.element() == origins[face.element()]; }));
  }
  for(const char* extension : extensions) {
    IO::Write_options options;
    options.facet_sets = sets;
    options.tetrahedra = true;
    const std::string path = (directory / (std::string("io_option") + extension)).string();
    BOOST_TEST(IO::write_mixed_mesh(path, mesh, options));
    BOOST_TEST(contents(path) == contents(directory / (std::string("io_facet_tetrahedra") + extension)));
    fs::remove(path);
  }

  // Readers of meshes find the mesh as without sets.
  for(const char* extension : {".vtu", ".msh", ".msh2"}) {
    Mesh with, without;
    const std::string path = (directory / (std::string("io_plain") + extension)).string();
    BOOST_TEST(IO::write_mixed_mesh(path, mesh));
    BOOST_TEST(IO::read_mixed_mesh(path, without));
    BOOST_TEST(IO::read_mixed_mesh((directory / (std::string("io_facets") + extension)).string(), with));
    BOOST_TEST(with.points() == without.points());
    BOOST_TEST(with.elements().connectivity() == without.elements().connectivity());
    BOOST_TEST_EQ(with.number_of_elements(), mesh.number_of_elements());
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      BOOST_TEST(with.attributes(e) == without.attributes(e));
    fs::remove(path);
  }

  const char* const file = "io_refused.vtu";
  for(const char* name :
      {"", "1a", "with space", "a,b", "\"", "Boundary", "ALL", "rest", "region_hex8", "subdomain_2_rest"})
    BOOST_TEST(mentions(facet_set_error(mesh, {{name, {}}}, file), "needs another name"));
  BOOST_TEST(mentions(facet_set_error(mesh, {{"a", {}}, {"A", {}}}, file), "needs another name"));
  const Face face(mesh.elements(), 0, 0);
  BOOST_TEST(mentions(facet_set_error(mesh, {{"a", {face, face}}}, file), "a face twice"));
  BOOST_TEST(mentions(facet_set_error(tetrahedra, {{"a", {face}}}, file), "not a face of the mesh"));
  BOOST_TEST(!fs::exists(file));
}

void test_writers(const fs::path& directory)
{
  Expectations expectations(directory);
  for(Element_kind kind : element_kinds) {
    const Mesh mesh = single_element(kind);
    BOOST_TEST_GT(volume(mesh), 0.);
    expectations.write(std::string("io_") + reference_elements[kind].name, mesh);
  }

  const Mesh each = one_of_each_kind();
  BOOST_TEST_LT(std::abs(volume(each, 0) - affine_determinant), 1e-13);
  for(std::size_t e = 0; e < each.number_of_elements(); ++e)
    BOOST_TEST_GT(volume(each, e), 0.);
  expectations.write("io_each", each);

  const Mesh cells = grid(4, 1, 0);
  BOOST_TEST_LT(std::abs(volume(cells) - 64 * affine_determinant), 1e-11);
  for(std::size_t n : cells.elements().counts())
    BOOST_TEST_GT(n, 0u);
  std::vector<double> positions, element_numbers;
  for(const Point& p : cells.points())
    positions.insert(positions.end(), {p.x(), p.y(), p.z()});
  for(std::size_t e = 0; e < cells.number_of_elements(); ++e)
    element_numbers.push_back(double(e));
  IO::Write_options with_data;
  with_data.vertex_data = {{"position & <copy>", &positions, 3}};
  with_data.element_data = {{"element", &element_numbers}};
  // A vertex without an element keeps its values where it is written.
  Mesh with_loose_vertex = cells;
  with_loose_vertex.add_vertex(Point(7, 8, 9));
  std::vector<double> more_positions = positions;
  more_positions.insert(more_positions.end(), {7, 8, 9});
  for(const char* extension : {".msh", ".msh2", ".feb"}) {
    IO::Write_options loose;
    loose.vertex_data = {{"position", &more_positions, 3}};
    const fs::path path = directory / (std::string("io_loose") + extension);
    BOOST_TEST(IO::write_mixed_mesh(path.string(), with_loose_vertex, loose));
    BOOST_TEST_EQ(contents(path).find("7 8 9\n") != std::string::npos, std::string(extension) == ".msh2");
    Mesh read;
    if(std::string(extension) != ".feb") {
      BOOST_TEST(IO::read_mixed_mesh(path.string(), read));
      BOOST_TEST_EQ(read.number_of_elements(), cells.number_of_elements());
    }
    fs::remove(path);
  }
  expectations.write("io_grid", cells, with_data);
  expectations.write("io_tetrahedra", split_to_tetrahedra(cells));
  test_facet_sets(expectations, directory, cells);

  // The option has the effect of the function; element data follow their elements.
  const std::string path = (directory / "io_option.vtu").string();
  IO::Write_options options = with_data;
  options.tetrahedra = true;
  BOOST_TEST(IO::write_mixed_mesh(path, cells, options));
  std::vector<Element_index> origins;
  const Mesh tetrahedra = split_to_tetrahedra(cells, &origins);
  BOOST_TEST_EQ(origins.size(), tetrahedra.number_of_elements());
  const std::vector<double> numbers(origins.begin(), origins.end());
  std::ostringstream stream;
  BOOST_TEST(
    IO::write_VTU(stream, tetrahedra, {{{"position & <copy>", &positions, 3}}, {{"element", &numbers}}}));
  BOOST_TEST(stream.str() == contents(path));
  fs::remove(path);
  expectations.finish();
}

// Middle nodes: one an edge, in the order in which elements have edges first; means are rounded once.
void test_middle_nodes()
{
  using IO::internal::rounded_mean;
  constexpr double largest = (std::numeric_limits<double>::max)(),
                   smallest = std::numeric_limits<double>::denorm_min();
  BOOST_TEST_EQ(rounded_mean(largest, largest), largest);
  BOOST_TEST_EQ(rounded_mean(-largest, largest), 0.);
  BOOST_TEST_EQ(rounded_mean(3 * smallest, smallest), 2 * smallest);
  BOOST_TEST_EQ(rounded_mean(0.1, 0.3), (0.1 + 0.3) / 2);

  const Mesh mesh = grid(3, 5, 0.1);
  const std::size_t n = mesh.number_of_vertices();
  const IO::internal::Middle_nodes middle = IO::internal::quadratic_connectivity(mesh.elements(), n);
  std::map<std::array<Vertex_index, 2>, std::size_t> numbers;
  std::size_t place = 0;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    BOOST_TEST_EQ(middle.offsets[e], place);
    const Element_view element = mesh.element(e);
    for(int i = 0; i < element.reference().number_of_edges; ++i, ++place) {
      std::array<Vertex_index, 2> edge{element[element.reference().edges[i][0]],
                                       element[element.reference().edges[i][1]]};
      std::sort(edge.begin(), edge.end());
      const std::size_t number = numbers.emplace(edge, numbers.size()).first->second;
      BOOST_TEST_EQ(std::size_t(middle.of_elements[place]), number);
      BOOST_TEST(middle.ends[number] == edge);
    }
  }
  BOOST_TEST_EQ(place, middle.of_elements.size());
  BOOST_TEST_EQ(numbers.size(), middle.ends.size());
}

// What has no elements of order 2 is refused by a line, and our readers refuse files with them.
void test_order_2(const fs::path& directory)
{
  const Mesh mesh = one_of_each_kind();
  IO::Write_options options;
  options.order = 2;
  const auto refused = [&](const std::string& name, const std::string& reason) {
    const std::string path = (directory / name).string();
    const bool result = mentions(write_error(path, mesh, options), path + ": " + reason);
    return result && !fs::exists(path);
  };
  const std::string medit = "elements of order 2 can be written to .vtu, .msh, .msh2, .inp and .feb only";
  BOOST_TEST(refused("io_refused.mesh", medit));
  BOOST_TEST(
    mentions(error_of([](std::string* error) { return IO::check_output_path("io_refused.mesh", error, 2); }),
             "io_refused.mesh: " + medit));
  BOOST_TEST(
    refused("io_refused.inp", "Abaqus has no pyramids of order 2: split the mesh to tetrahedra, or"));
  std::ostringstream stream;
  BOOST_TEST(!IO::write_INP(stream, mesh, {}, {}, 2));
  BOOST_TEST(stream.fail() && stream.str().empty());
  for(int order : {0, 3}) {
    options.order = order;
    BOOST_TEST(refused("io_refused.vtu", "the order of elements is 1 or 2, not " + std::to_string(order)));
  }

  options.order = 2;
  options.tetrahedra = true;
  const std::string inp = (directory / "io_option.inp").string();
  BOOST_TEST(IO::write_mixed_mesh(inp, mesh, options));
  BOOST_TEST(contents(inp).find("TYPE=C3D10,") != std::string::npos);
  fs::remove(inp);

  // Values of all nodes are written as they are, not the means of ends; not with another mesh's nodes.
  const IO::internal::Mesh_nodes<Mesh> nodes(mesh, 2);
  std::vector<double> values(nodes.size(), 0);
  values.back() = 4321.5;
  options.vertex_data.push_back({"of_nodes", &values});
  BOOST_TEST(refused("io_refused.vtu", "data \"of_nodes\" does not have the size of the mesh"));
  options.tetrahedra = false;
  const std::string msh = (directory / "io_of_nodes.msh2").string();
  BOOST_TEST(IO::write_mixed_mesh(msh, mesh, options));
  BOOST_TEST(contents(msh).find(" 4321.5") != std::string::npos);
  fs::remove(msh);
  options.order = 1;
  BOOST_TEST(refused("io_refused.vtu", "data \"of_nodes\" does not have the size of the mesh"));

  for(Element_kind kind : element_kinds)
    for(const char* extension : {".vtu", ".msh", ".msh2"}) {
      Mesh read;
      const std::string path =
        (directory / (std::string("io_") + reference_elements[kind].name + "_order_2" + extension)).string();
      const std::string error = error_of(
        [&](std::string* error) { return IO::read_mixed_mesh(path, read, error); });
      BOOST_TEST(mentions(error, path + ": ") && mentions(error, "of higher order"));
    }
}

// A number type that is not double, a locale with other digits, an empty mesh.
void test_writers_in_odd_conditions()
{
  struct Commas : std::numpunct<char>
  {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\1"; }
  };

  const Mesh mesh = grid(3, 2, 0.1);
  CGAL::Mixed_mesh_3<CGAL::Exact_predicates_exact_constructions_kernel> exact;
  for(const Point& p : mesh.points())
    exact.add_vertex({p.x(), p.y(), p.z()});
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    exact.add_element(mesh.element(e).kind(), mesh.element(e).begin(), mesh.attributes(e));
  BOOST_TEST(has_right_boundary(exact));

  for(const char* extension : extensions) {
    const IO::Format format = IO::format_of(std::string("x") + extension).value();
    std::ostringstream expected, odd, empty;
    BOOST_TEST(IO::internal::write(expected, mesh, format, {}));
    const std::locale old = std::locale::global(std::locale(std::locale(), new Commas));
    odd.imbue(std::locale());
    BOOST_TEST(IO::internal::write(odd, internal::as_core_mesh(exact), format, {}));
    std::locale::global(old);
    BOOST_TEST(expected.str() == odd.str());
    BOOST_TEST(IO::internal::write(empty, Mesh(), format, {}));
  }
}

// A model of FEBio is also read back, and solved, in test_brain_shift_febio.py.
void test_FEB_model()
{
  std::ostringstream empty, stream;
  BOOST_TEST(IO::write_FEB_model(empty, Mesh(), IO::FEB_model()));
  BOOST_TEST(empty.str().find("<Boundary>") == std::string::npos);

  IO::FEB_model model;
  model.materials[1] = {2, 0.25, 3e-6};
  model.fixed_vertices = {Vertex_index(0), Vertex_index(2)};
  model.supports = {{Vertex_index(3), 1, {}, 0}};
  model.controls = {{Vertex_index(5), 2, {}, -0.5}, {Vertex_index(4), 2, {{Vertex_index(6), 0, 0.25}}, 7}};
  model.accelerations[1] = {0, 0, -9810};
  model.subdomain_names[1] = "brain";
  model.displacements_file = "a&b.csv";
  model.comments = {"two words"};
  BOOST_TEST(IO::write_FEB_model(stream, one_of_each_kind(), model));
  for(const char* text :
      {"<!-- two words -->", "name=\"brain\" type=\"isotropic elastic\">", "<density>3e-06</density>",
       "name=\"brain.rest_tet4\"", "<NodeSet name=\"fixed\">1,3</NodeSet>",
       "<NodeSet name=\"sliding_y\">4</NodeSet>", "<NodeSet name=\"controlled_z\">6</NodeSet>",
       "<node lid=\"1\">-0.5</node>", "<y_dof>1</y_dof>\n      <z_dof>0</z_dof>",
       "<offset lc=\"1\">7</offset>", "<child_dof><node>7</node><dof>x</dof><value>0.25</value></child_dof>",
       "<force lc=\"1\">0,0,9810</force>", "file=\"a&amp;b.csv\""})
    if(!BOOST_TEST(stream.str().find(text) != std::string::npos))
      std::cerr << text << '\n';
}

void test_split(const Mesh& mesh, bool is_planar)
{
  std::vector<Element_index> origins;
  Mesh tetrahedra = split_to_tetrahedra(mesh, &origins);
  BOOST_TEST_EQ(tetrahedra.number_of_vertices(), mesh.number_of_vertices());
  const auto counts = mesh.elements().counts();
  BOOST_TEST_EQ(tetrahedra.number_of_elements(),
                counts[TETRAHEDRON] + 2 * counts[PYRAMID] + 3 * counts[PRISM] + 6 * counts[HEXAHEDRON]);

  std::vector<double> volumes(mesh.number_of_elements());
  bool all_positive = true, same_region = true;
  for(std::size_t t = 0; t < tetrahedra.number_of_elements(); ++t) {
    const Element_view v = tetrahedra.element(t);
    all_positive = all_positive
                   && CGAL::orientation(tetrahedra.point(v[0]), tetrahedra.point(v[1]),
                                        tetrahedra.point(v[2]), tetrahedra.point(v[3]))
                        == CGAL::POSITIVE;
    same_region = same_region && tetrahedra.attributes(t) == mesh.attributes(origins[t]);
    volumes[origins[t]] += volume(tetrahedra, t);
  }
  BOOST_TEST(all_positive);
  BOOST_TEST(same_region);
  if(is_planar)
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      BOOST_TEST_LT(std::abs(volumes[e] - volume(mesh, e)), 1e-12);

  // The mesh is conforming, and the boundary faces are those found by brute force.
  BOOST_TEST(has_right_boundary(tetrahedra));
}

void test_split()
{
  for(Element_kind kind : element_kinds)
    test_split(single_element(kind), true);
  test_split(one_of_each_kind(), true);
  for(unsigned int seed = 0; seed < 20; ++seed) {
    test_split(grid(4, seed, 0), true);
    test_split(grid(4, seed, 0.2), false);
  }
}

#if defined(__unix__)
const auto text_writer = [](const std::string& text) {
  return [text](std::ostream& stream) { return bool(stream << text); };
};

// Files appear all or none: here the third file cannot, since a folder took its name in the meantime.
void test_outputs_together(const fs::path& directory)
{
  const fs::path place = directory / "together";
  fs::create_directory(place);
  const auto path = [&](const char* name) { return (place / name).string(); };
  std::ofstream(path("old")) << "old";
  std::string error;
  {
    IO::Output_files files;
    for(const char* name : {"old", "new", "folder"})
      BOOST_TEST(files.write(path(name), text_writer("content")));
    fs::create_directory(place / "folder");
    std::ofstream(path("folder/file")) << "a";
    BOOST_TEST(!files.commit(&error));
  }
  BOOST_TEST(mentions(error, path("folder") + ": cannot replace: "));
  BOOST_TEST_EQ(contents(path("old")), "old");
  BOOST_TEST_EQ(number_of_files(place), 2u); // nothing new, no remains
  fs::remove_all(place / "folder");
  IO::Output_files files;
  for(const char* name : {"old", "new", "third"})
    BOOST_TEST(files.write(path(name), text_writer("content")));
  BOOST_TEST_EQ(contents(path("old")), "old");
  BOOST_TEST(files.commit());
  for(const char* name : {"old", "new", "third"})
    BOOST_TEST_EQ(contents(path(name)), "content");
  BOOST_TEST_EQ(number_of_files(place), 3u);
  fs::remove_all(place);
}

void test_names_and_modes(const fs::path& directory)
{
  const fs::path place = directory / "names";
  fs::create_directory(place);
  const auto write = [&](const fs::path& path) {
    IO::Output_files files;
    std::string error;
    if(files.write(path.string(), text_writer("content"), &error))
      BOOST_TEST(files.commit(&error));
    return error;
  };
  // Names are as long as the system allows, and longer.
  for(std::size_t length : {1u, 251u, 255u}) {
    const fs::path path = place / std::string(length, 'a');
    BOOST_TEST_EQ(write(path), "");
    BOOST_TEST_EQ(contents(path), "content");
  }
  BOOST_TEST(mentions(write(place / std::string(256, 'a')), "File name too long"));
  // The mode of a file is kept; a file that nobody else may read is never readable.
  for(unsigned mode : {0600u, 0640u, 0444u, 0666u}) {
    const fs::path path = place / "mode";
    std::ofstream(path) << "old";
    fs::permissions(path, fs::perms(mode));
    IO::Output_files files;
    const auto permissions = [](const fs::path& p) { return unsigned(fs::status(p).permissions()); };
    BOOST_TEST(files.write(path.string(), [&](std::ostream& stream) {
      for(const fs::directory_entry& entry : fs::directory_iterator(place))
        if(entry.path().extension() == ".tmp")
          BOOST_TEST_EQ(permissions(entry.path()), mode | 0200u);
      return bool(stream << "content");
    }));
    BOOST_TEST(files.commit());
    BOOST_TEST_EQ(contents(path), "content");
    BOOST_TEST_EQ(permissions(path), mode);
    fs::remove(path);
  }
  // Links that lead to no file yet are written through; circles of links are refused.
  fs::create_directory(place / "folder");
  fs::create_symlink("folder/second", place / "first");
  fs::create_symlink("third", place / "folder/second");
  BOOST_TEST_EQ(write(place / "first"), "");
  BOOST_TEST(fs::is_symlink(place / "first") && fs::is_symlink(place / "folder/second"));
  BOOST_TEST_EQ(contents(place / "folder/third"), "content");
  fs::create_symlink("round", place / "round");
  BOOST_TEST(mentions(write(place / "round"), "Too many levels of symbolic links"));
  // A run stopped while the file is written leaves nothing.
  bool go_on = true;
  std::string error;
  {
    IO::Output_files files([&] { return go_on; });
    BOOST_TEST(files.write((place / "stopped").string(), text_writer("content")));
    BOOST_TEST(!files.write((place / "other").string(),
                            [&](std::ostream& stream) {
                              stream << std::string(100000, 'a');
                              go_on = false;
                              return bool(stream << std::string(100000, 'a'));
                            },
                            &error));
  }
  BOOST_TEST(mentions(error, "not written: stopped"));
  BOOST_TEST_EQ(number_of_files(place), 6u);
  fs::remove_all(place);
}
#endif

void test_errors(const fs::path& directory)
{
  const Mesh mesh = one_of_each_kind();
  const fs::path place = directory / "io_errors";
  fs::remove_all(place);
  fs::create_directory(place);
  const auto both = [&mesh](const fs::path& path, const std::string& text) {
    BOOST_TEST(mentions(check_error(path.string()), text));
    BOOST_TEST(mentions(check_error(path.string()), path.string()));
    BOOST_TEST(mentions(write_error(path.string(), mesh), text));
  };

  both(place / "mesh.stl", "known are .vtu, .msh, .msh2, .mesh, .inp and .feb");
  both(place / "mesh", "unknown extension");
  both(place / ".vtu", "unknown extension");
  both("", "unknown extension");
  both(place / "missing" / "mesh.vtu", "No such file or directory");
  std::ofstream(place / "file") << "x";
  both(place / "file" / "mesh.vtu", "Not a directory"); // holds for root, too
  fs::create_directory(place / "directory.vtu");
  both(place / "directory.vtu", "is a directory");
  if(fs::exists("/proc/self"))
    both("/proc/mesh.vtu", "cannot create a file in its directory");
  BOOST_TEST(IO::format_of("A.B/C.MSH2") == IO::Format::MSH_2_2);
  BOOST_TEST_EQ(number_of_files(place), 2u);

  // The check and failures do not touch an existing file, and never other files.
  const fs::path old = place / "old.vtu";
  std::ofstream(old) << "old";
  std::ofstream(place / "old.vtu.tmp0") << "somebody else's";
  BOOST_TEST(IO::check_output_path(old.string()));
  BOOST_TEST_EQ(contents(old), "old");

  Mesh bad = mesh;
  bad.points()[3] = Point(0, std::numeric_limits<double>::quiet_NaN(), 0);
  BOOST_TEST(mentions(write_error(old.string(), bad), "vertex 3"));
  const std::vector<double> values(5);
  IO::Write_options options;
  options.vertex_data = {{"data", &values}};
  BOOST_TEST(mentions(write_error(old.string(), mesh, options), "size of the mesh"));
  BOOST_TEST(mentions(write_error((place / "old.msh").string(), mesh, options), "size of the mesh"));
  for(const char* name : {"old.inp", "old.mesh"})
    BOOST_TEST(
      mentions(write_error((place / name).string(), mesh, options), "to .msh, .msh2 and .feb, only"));
  options.vertex_data = {{"data", &values, 2}};
  BOOST_TEST(
    mentions(write_error((place / "old.feb").string(), mesh, options), "to .msh, .msh2 and .feb, only"));
  options.vertex_data = {{"da\"ta", &values}};
  BOOST_TEST(
    mentions(write_error((place / "old.msh").string(), mesh, options), "to .msh, .msh2 and .feb, only"));
  options.vertex_data.clear();
  options.element_data = {{"data", &values}};
  BOOST_TEST(mentions(write_error((place / "old.msh").string(), mesh, options), ".vtu only"));
  std::ostringstream stream;
  BOOST_TEST(!IO::write_VTU(stream, mesh, {{{"data", &values}}, {}}));
  BOOST_TEST(stream.str().empty());
  BOOST_TEST_EQ(contents(old), "old");
  BOOST_TEST_EQ(number_of_files(place), 4u);

#if defined(__unix__)
  // Files stop growing, as on a full disk.
  const Mesh large = grid(8, 1, 0);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit;
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small = {20000, limit.rlim_max};
  for(const char* extension : extensions) {
    const fs::path path = place / (std::string("old") + extension);
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string error = write_error(path.string(), large);
    setrlimit(RLIMIT_FSIZE, &limit);
    BOOST_TEST(mentions(error, "cannot write: File too large"));
  }
  BOOST_TEST_EQ(contents(old), "old");
  BOOST_TEST_EQ(number_of_files(place), 4u);

  test_outputs_together(place);
  test_names_and_modes(place);

  // A link stays, and its target is replaced or, if a device, written to.
  fs::create_symlink("old.vtu", place / "link.vtu");
  BOOST_TEST(IO::write_mixed_mesh((place / "link.vtu").string(), mesh));
  BOOST_TEST(fs::is_symlink(place / "link.vtu"));
  BOOST_TEST_GT(fs::file_size(old), 1000u);
  if(fs::exists("/dev/full"))
    for(const char* extension : extensions) {
      const fs::path path = place / (std::string("full") + extension);
      fs::create_symlink("/dev/full", path);
      BOOST_TEST(IO::check_output_path(path.string()));
      BOOST_TEST(mentions(write_error(path.string(), mesh), "No space left on device"));
      std::ofstream full("/dev/full");
      BOOST_TEST(!IO::internal::write(full, mesh, *IO::format_of(path.string()), {}));
    }
#endif
  BOOST_TEST_EQ(contents(place / "old.vtu.tmp0"), "somebody else's");
  fs::remove_all(place);
}

// Tests a reader for Surface_mesh and Polyhedron_3.
template <class Surface>
void test_reader(const fs::path& directory)
{
  const std::string path = (directory / "io_reader.off").string();
  const auto read = [&path](const std::string& off, Surface& surface) {
    std::ofstream(path) << off;
    IO::Surface_input input;
    std::string error;
    if(!IO::read_closed_surface(path, surface, &error, &input))
      throw std::runtime_error(error);
    return input;
  };
  const auto has_warning = [](const IO::Surface_input& input, const std::string& text) {
    return std::any_of(input.warnings.begin(), input.warnings.end(),
                       [&text](const std::string& w) { return w.find(text) != std::string::npos; });
  };
  const std::string cube = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n";

  Surface surface;
  IO::Surface_input input = read("OFF\n8 6 0\n" + cube
                                   + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n",
                                 surface);
  BOOST_TEST_EQ(input.number_of_components, 1u);
  BOOST_TEST_LT(std::abs(input.volume - 1), 1e-15);
  BOOST_TEST_EQ(faces(surface).size(), 12u);
  BOOST_TEST(has_warning(input, "triangulated 6 polygons"));

  // A cavity hangs from the middle of the upper face: the components touch, where the cavity is highest. The
  // former content of the mesh is replaced.
  const std::string walls = "4 0 2 3 1\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n"
                            "3 4 5 8\n3 5 7 8\n3 7 6 8\n3 6 4 8\n";
  for(const char* cavity :
      {"3 8 9 10\n3 8 10 11\n3 8 11 9\n3 9 11 10\n", "3 8 10 9\n3 8 11 10\n3 8 9 11\n3 9 10 11\n"}) {
    input = read("OFF\n12 13 0\n" + cube + "0.5 0.5 1\n0.25 0.25 0.5\n0.75 0.25 0.5\n0.25 0.75 0.5\n" + walls
                   + cavity,
                 surface);
    BOOST_TEST_EQ(input.number_of_components, 2u);
    BOOST_TEST_LT(std::abs(input.volume - (1 - 0.125 * 0.5 / 3)), 1e-15);
    BOOST_TEST(has_warning(input, "pinched at 1 point"));
    BOOST_TEST_EQ(vertices(surface).size(), 13u);
    BOOST_TEST_EQ(faces(surface).size(), 18u);
  }

  // Two faces with their vertices on the edge between the first two: removed, without a trace.
  const std::string needles = "OFF\n10 16 0\n" + cube
                              + "0.25 0 0\n0.5 0 0\n"
                                "3 0 3 1\n3 0 2 3\n3 4 5 7\n3 4 7 6\n3 2 6 7\n3 2 7 3\n3 0 4 6\n3 0 6 2\n"
                                "3 1 3 7\n3 1 7 5\n3 0 5 4\n3 0 8 5\n3 8 9 5\n3 9 1 5\n3 0 1 9\n3 0 9 8\n";
  input = read(needles, surface);
  BOOST_TEST(has_warning(input, "removed 2 degenerate faces"));
  BOOST_TEST_LT(std::abs(input.volume - 1), 1e-15);
  BOOST_TEST_EQ(faces(surface).size() + 4, 2 * vertices(surface).size());
  std::size_t n = 0;
  for(auto v : vertices(surface)) {
    BOOST_TEST(halfedge(v, surface) != boost::graph_traits<Surface>::null_halfedge());
    ++n;
  }
  BOOST_TEST_EQ(n, vertices(surface).size());

  // Faces that cut each other are repaired, or refused if requested.
  const std::string crossing =
    "OFF\n8 8 0\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n0.5 0.5 0.5\n3 0.5 0.5\n0.5 3 0.5\n0.5 0.5 3\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 4 6 5\n3 4 5 7\n3 4 7 6\n3 5 6 7\n";
  input = read(crossing, surface);
  BOOST_TEST_EQ(input.repairs.size(), 1u);
  IO::Read_surface_options strict;
  strict.is_strict = true;
  std::string error;
  BOOST_TEST(!IO::read_closed_surface(path, strict, surface, &error));
  BOOST_TEST(error.find(path + ": the surface intersects itself in ") == 0);
  BOOST_TEST(error.find(" pairs of faces, for example near (") != std::string::npos);
  fs::remove(path);
}

#ifdef CGAL_USE_ZLIB
// Blocks hold the bytes that are written in pieces of any size, around the sizes of one and of several
// blocks.
void test_compressed_blocks()
{
  constexpr std::size_t block = 1 << 16;
  std::mt19937 random(17);
  for(const std::size_t size :
      {std::size_t(0), std::size_t(1), block - 1, block, block + 1, 3 * block, 200001ul}) {
    std::string bytes;
    for(std::size_t i = 0; i < size; ++i)
      bytes += char(random() % 5);
    IO::internal::Compressed_blocks blocks;
    std::ostream out(&blocks);
    for(std::size_t begin = 0; begin < size;) {
      const std::size_t n = (std::min)(size - begin, std::size_t(random() % 100000));
      out.write(bytes.data() + begin, std::streamsize(n));
      begin += n;
      if(begin < size)
        out.put(bytes[begin++]);
    }
    const std::string array = blocks.take();
    const auto word = [&](std::size_t i) {
      std::uint64_t w;
      std::memcpy(&w, array.data() + 8 * i, 8);
      return std::size_t(w);
    };
    const std::size_t number = word(0), last = word(2) != 0 ? word(2) : word(1);
    BOOST_TEST_EQ(number, (size + block - 1) / block);
    std::string found;
    std::size_t place = 8 * (3 + number);
    for(std::size_t i = 0; i < number; ++i) {
      std::string text(i + 1 == number ? last : word(1), ' ');
      uLongf length = uLongf(text.size());
      BOOST_TEST_EQ(uncompress(reinterpret_cast<Bytef*>(&text[0]), &length,
                               reinterpret_cast<const Bytef*>(array.data() + place), uLong(word(3 + i))),
                    Z_OK);
      BOOST_TEST_EQ(length, text.size());
      found += text;
      place += word(3 + i);
    }
    BOOST_TEST(found == bytes);
    BOOST_TEST_EQ(place, array.size());
  }
}
#endif

int run(int argc, char* argv[])
{
#ifdef CGAL_USE_ZLIB
  test_compressed_blocks();
#endif
  const fs::path directory = argc > 2 ? argv[2] : ".";
  fs::create_directories(directory);
  test_writers(directory);
  test_order_2(directory);
  test_middle_nodes();
  test_writers_in_odd_conditions();
  test_FEB_model();
  test_split();
  test_errors(directory);
  test_reader<CGAL::Surface_mesh<Point>>(directory);
  test_reader<CGAL::Polyhedron_3<Kernel>>(directory);
  return boost::report_errors();
}

} // namespace test_io
