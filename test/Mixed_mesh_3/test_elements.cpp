// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checkers, on meshes with one defect each.

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_elements {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Mixed_meshes_3::internal::Manifold_defects;
using CGAL::Mixed_meshes_3::internal::manifold_defects;

using Kernel = Predicates_kernel;
using Point_3 = Kernel::Point_3;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

void test_manifold_defects()
{
  const auto tetrahedron = [](Vertex_index a, Vertex_index b, Vertex_index c, Vertex_index d) {
    return std::vector<Face_vertices>{{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}};
  };
  const auto both = [](std::vector<Face_vertices> a, const std::vector<Face_vertices>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  using Edges = std::vector<std::array<Vertex_index, 2>>;
  using Vertices = std::vector<Vertex_index>;

  BOOST_TEST(manifold_defects({}).empty());
  BOOST_TEST(manifold_defects(tetrahedron(0, 1, 2, 3)).empty());
  BOOST_TEST(manifold_defects(both(tetrahedron(0, 1, 2, 3), tetrahedron(4, 5, 6, 7))).empty());
  // The polygons are all quadrilaterals, or of both sizes.
  std::vector<Face_vertices> polygons;
  for(Element_kind kind : element_kinds) {
    const Reference_element& r = reference_elements[kind];
    polygons.clear();
    for(int f = 0; f < r.number_of_faces; ++f) {
      const auto& v = r.faces[f].vertices;
      polygons.push_back(r.faces[f].size == 3 ? Face_vertices{v[0], v[1], v[2]}
                                              : Face_vertices{v[0], v[1], v[2], v[3]});
    }
    BOOST_TEST(manifold_defects(polygons).empty());
    // The surface is open at each of its faces in turn.
    for(std::size_t f = 0; f < polygons.size(); ++f) {
      std::vector<Face_vertices> open = polygons;
      open.erase(open.begin() + std::ptrdiff_t(f));
      const Manifold_defects d = manifold_defects(open);
      BOOST_TEST_EQ(int(d.edges.size()), polygons[f].size());
      BOOST_TEST_EQ(int(d.vertices.size()), polygons[f].size());
      // One polygon is reversed.
      std::vector<Face_vertices> turned = polygons;
      std::swap(turned[f][0], turned[f][2]);
      BOOST_TEST_EQ(int(manifold_defects(turned).edges.size()), polygons[f].size());
    }
  }
  // Four polygons are at an edge: two fans at its ends.
  Manifold_defects d = manifold_defects(both(tetrahedron(0, 1, 2, 3), tetrahedron(0, 1, 4, 5)));
  BOOST_TEST(d.edges == (Edges{{0, 1}}));
  BOOST_TEST_LE(d.vertices.size(), 2u);
  // Two fans are at a vertex, all edges are right.
  d = manifold_defects(both(tetrahedron(0, 1, 2, 3), tetrahedron(4, 5, 6, 2)));
  BOOST_TEST(d.edges.empty());
  BOOST_TEST(d.vertices == (Vertices{2}));
  // The same surface is there twice.
  d = manifold_defects(both(tetrahedron(0, 1, 2, 3), tetrahedron(0, 1, 2, 3)));
  BOOST_TEST_EQ(d.edges.size(), 6u);
}

Mesh_defects expect(const Mesh& mesh)
{
  const Mesh_defects d = find_defects(mesh);
  BOOST_TEST(!d.none());
  return d;
}

// The numbers of one kind are zero except the expected ones.
enum Defect {
  NONCONFORMING = 1,
  EDGES = 2,
  VERTICES = 4,
  CORNERS = 8,
  UNUSED = 16,
  DUPLICATE = 32,
  NONFINITE = 64,
  INVALID = 128
};

void check(const Mesh& mesh, int expected)
{
  const Mesh_defects d = find_defects(mesh);
  const int found = (d.nonconforming_faces ? NONCONFORMING : 0) | (d.nonmanifold_boundary_edges ? EDGES : 0)
                    | (d.nonmanifold_boundary_vertices ? VERTICES : 0) | (d.nonpositive_corners ? CORNERS : 0)
                    | (d.unused_vertices ? UNUSED : 0) | (d.duplicate_vertices ? DUPLICATE : 0)
                    | (d.nonfinite_vertices ? NONFINITE : 0) | (d.invalid_elements ? INVALID : 0);
  BOOST_TEST_EQ(found, expected);
  BOOST_TEST_EQ(d.none(), expected == 0);
  BOOST_TEST_EQ(d.conforming(), (expected & (NONCONFORMING | INVALID)) == 0);
  BOOST_TEST_EQ(d.closed_manifold_boundary(), (expected & (EDGES | VERTICES | INVALID)) == 0);
  BOOST_TEST_EQ(d.positive(), (expected & (CORNERS | NONFINITE | INVALID)) == 0);
}

// A unit cube of vertices 0 to 7 in the order of the hexahedron, then other vertices.
Mesh cube_vertices(std::initializer_list<Point_3> others = {})
{
  Mesh mesh;
  for(const auto& c : {Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0),
                       Point_3(0, 0, 1), Point_3(1, 0, 1), Point_3(1, 1, 1), Point_3(0, 1, 1)})
    mesh.add_vertex(c);
  for(const Point_3& p : others)
    mesh.add_vertex(p);
  return mesh;
}

Mesh cube(std::initializer_list<Point_3> others = {})
{
  Mesh mesh = cube_vertices(others);
  mesh.add_element(HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7});
  return mesh;
}

Mesh tetrahedra(std::initializer_list<std::array<Vertex_index, 4>> elements,
                std::initializer_list<Point_3> points)
{
  Mesh mesh;
  for(const Point_3& p : points)
    mesh.add_vertex(p);
  for(const auto& e : elements)
    mesh.add_element(TETRAHEDRON, e.data());
  return mesh;
}

void test_find_defects()
{
  check(Mesh(), 0);
  check(cube(), 0);
  for(Element_kind kind : element_kinds) {
    const Reference_element& r = reference_elements[kind];
    Mesh mesh;
    std::vector<Vertex_index> v;
    for(int i = 0; i < r.number_of_vertices; ++i)
      v.push_back(mesh.add_vertex(Point_3(r.coordinates[i][0], r.coordinates[i][1], r.coordinates[i][2])));
    mesh.add_element(kind, v.data());
    check(mesh, 0);
    mesh.points()[0] = Point_3(9, 9, 9); // inside out somewhere
    BOOST_TEST_GT(find_defects(mesh).nonpositive_corners, 0u);
  }

  // A pyramid on the cube is conforming, two tetrahedra against its face are not.
  Mesh mesh = cube({{0.5, 0.5, 2}});
  mesh.add_element(PYRAMID, {4, 5, 6, 7, 8});
  check(mesh, 0);
  mesh = cube({{0.5, 0.5, 2}});
  mesh.add_element(TETRAHEDRON, {4, 5, 6, 8});
  mesh.add_element(TETRAHEDRON, {4, 6, 7, 8});
  check(mesh, NONCONFORMING | EDGES | (find_defects(mesh).nonmanifold_boundary_vertices ? VERTICES : 0));
  BOOST_TEST_EQ(find_defects(mesh).nonconforming_faces, 1u);
  // One of the two tetrahedra only is there.
  mesh = cube({{0.5, 0.5, 2}});
  mesh.add_element(TETRAHEDRON, {4, 5, 6, 8});
  BOOST_TEST_EQ(expect(mesh).nonconforming_faces, 1u);

  // Two cubes side by side that share no vertex; -0 is 0.
  const auto neighbor = [](double zero) {
    Mesh two = cube(
      {{1, zero, zero}, {2, 0, 0}, {2, 1, 0}, {1, 1, zero}, {1, zero, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}});
    two.add_element(HEXAHEDRON, {8, 9, 10, 11, 12, 13, 14, 15});
    return two;
  };
  for(double zero : {0., -0.}) {
    check(neighbor(zero), DUPLICATE);
    BOOST_TEST_EQ(find_defects(neighbor(zero)).duplicate_vertices, 4u);
  }
  // Three vertices at one place count twice.
  mesh = cube({{0, 0, 0}, {0, 0, 0}});
  check(mesh, DUPLICATE | UNUSED);
  BOOST_TEST_EQ(find_defects(mesh).duplicate_vertices, 2u);

  check(cube({{2, 2, 2}}), UNUSED);
  BOOST_TEST_EQ(find_defects(cube({{2, 2, 2}, {3, 3, 3}})).unused_vertices, 2u);

  const Point_3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), below(0.3, 0.3, -1);
  check(tetrahedra({{0, 1, 2, 3}}, {o, x, y, z}), 0);
  check(tetrahedra({{0, 2, 1, 3}}, {o, x, y, z}), CORNERS);         // inverted
  check(tetrahedra({{0, 1, 2, 3}}, {o, x, y, {1, 1, 0}}), CORNERS); // flat
  check(tetrahedra({{0, 1, 2, 3}}, {o, x, y, {0, 0, 1e-300}}), 0);  // almost
  // The points are collinear but for the last digit: doubles would round the determinant.
  check(tetrahedra({{0, 1, 2, 3}}, {{1e8, 1e8, 1e8},
                                    {1e8 + 1, 1e8, 1e8},
                                    {1e8, 1e8 + 1, 1e8},
                                    {1e8 + 1, 1e8 + 1, std::nextafter(1e8, 2e8)}}),
        0);
  check(tetrahedra({{0, 1, 2, 3}}, {{1e8, 1e8, 1e8},
                                    {1e8 + 1, 1e8, 1e8},
                                    {1e8, 1e8 + 1, 1e8},
                                    {1e8 + 1, 1e8 + 1, std::nextafter(1e8, 0)}}),
        CORNERS);

  // Two tetrahedra share a face.
  check(tetrahedra({{0, 1, 2, 3}, {0, 2, 1, 4}}, {o, x, y, z, below}), 0);
  // Both are on the same side of the face: positive, but folded.
  const Mesh folded = tetrahedra({{0, 1, 2, 3}, {0, 1, 2, 4}}, {o, x, y, z, {0.3, 0.3, 2}});
  check(folded, NONCONFORMING | EDGES | (find_defects(folded).nonmanifold_boundary_vertices ? VERTICES : 0));
  BOOST_TEST_EQ(find_defects(folded).nonconforming_faces, 1u);
  BOOST_TEST_EQ(find_defects(folded).nonmanifold_boundary_edges, 3u);
  // A face has three elements.
  const Mesh thrice = tetrahedra({{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 2, 1, 5}},
                                 {o, x, y, z, below, {0.3, 0.3, -2}});
  BOOST_TEST_EQ(expect(thrice).nonconforming_faces, 1u);
  BOOST_TEST(!find_defects(thrice).conforming());

  // Quadrilaterals have the same vertices in another cyclic order.
  mesh = cube({{0.5, 0.5, 2}});
  mesh.add_element(PYRAMID, {4, 6, 5, 7, 8});
  BOOST_TEST_EQ(expect(mesh).nonconforming_faces, 1u);

  // Two tetrahedra share only an edge, or a vertex.
  const Mesh edge = tetrahedra({{0, 1, 2, 3}, {0, 1, 4, 5}}, {o, x, y, z, {0, -1, 0}, {0, 0, -1}});
  BOOST_TEST_EQ(expect(edge).nonmanifold_boundary_edges, 1u);
  BOOST_TEST(edge.is_empty() || (find_defects(edge).conforming() && find_defects(edge).positive()));
  const Mesh vertex = tetrahedra({{0, 1, 2, 3}, {0, 4, 5, 6}},
                                 {o, x, y, z, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}});
  check(vertex, VERTICES);
  BOOST_TEST_EQ(find_defects(vertex).nonmanifold_boundary_vertices, 1u);

  // Indices do not exist, or are repeated.
  check(tetrahedra({{0, 1, 2, 7}}, {o, x, y}), INVALID);
  check(tetrahedra({{0, 1, 2, Vertex_index(-1)}}, {o, x, y}), INVALID);
  check(tetrahedra({{0, 1, 2, 3}, {0, 1, 2, 2}}, {o, x, y, z}), INVALID);
}

// Coordinates are not a number, or infinite.
void test_find_nonfinite()
{
  const Point_3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  for(double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()}) {
    const Mesh mesh = tetrahedra({{0, 1, 2, 3}}, {o, x, y, {0, bad, 1}});
    BOOST_TEST_EQ(expect(mesh).nonfinite_vertices, 1u);
    BOOST_TEST(!find_defects(mesh).positive());
  }
}

// ---- moved meshes ------------------------------------------------------------------------------

static_assert(std::is_nothrow_move_constructible_v<Mesh> && std::is_nothrow_move_assignable_v<Mesh>);
static_assert(std::is_copy_constructible_v<Mesh> && std::is_copy_assignable_v<Mesh>);

void test_moved()
{
  Mesh first = cube({{0.5, 0.5, 2}});
  first.add_element(PYRAMID, {4, 5, 6, 7, 8}, {2, true});
  const auto expect_it = [](const Mesh& mesh) {
    check(mesh, 0);
    BOOST_TEST_EQ(mesh.number_of_vertices(), 9u);
    BOOST_TEST_EQ(mesh.number_of_elements(), 2u);
    BOOST_TEST(!mesh.is_in_region(0) && mesh.is_in_region(1));
    BOOST_TEST(mesh.subdomain_index(0) == 1 && mesh.subdomain_index(1) == 2);
    BOOST_TEST_EQ(boundary_faces(mesh).size(), 9u);
    BOOST_TEST_EQ(mesh.element(1)[4], 8u);
    BOOST_TEST(mesh.point(8) == Point_3(0.5, 0.5, 2));
  };
  std::vector<Mesh> meshes;
  meshes.push_back(std::move(first));
  first = cube(); // an object that has been moved from can be used again
  check(first, 0);
  for(int i = 0; i < 5; ++i) // the vector moves what it has
    meshes.push_back(meshes.front());
  for(const Mesh& mesh : meshes)
    expect_it(mesh);
  first = std::move(meshes.back());
  meshes.clear();
  expect_it(first);
}

int run(int, char*[])
{
  test_manifold_defects();
  test_find_defects();
  test_find_nonfinite();
  test_moved();
  return boost::report_errors();
}

} // namespace test_elements
