// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of element kinds, the shape functions, volumes and aspect-ratio coefficients.

#include <CGAL/Mixed_mesh_3/IO/internal/mesh/element_names.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/double.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace test_elements_traits {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Mixed_meshes_3::Vec3;
using CGAL::Mixed_meshes_3::cross;
using CGAL::Mixed_meshes_3::determinant;
using CGAL::Mixed_meshes_3::dot;
using CGAL::Mixed_meshes_3::norm;

// Traits without a kernel, which is not needed for elements.
struct Plain_traits
{
  struct Point_3
  {
    double m_x, m_y, m_z;
    double x() const { return m_x; }
    double y() const { return m_y; }
    double z() const { return m_z; }
  };
};
using Mesh = CGAL::Mixed_mesh_3<Plain_traits>;
using Points = std::vector<Vec3>;

const double infinity = std::numeric_limits<double>::infinity();

bool is_close(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

Mesh one_element(Element_kind kind, const Points& points)
{
  Mesh mesh;
  std::vector<Vertex_index> v;
  for(const Vec3& p : points)
    v.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
  mesh.add_element(kind, v.data());
  return mesh;
}

double arc(Element_kind kind, const Points& points)
{
  return aspect_ratio_coefficient(one_element(kind, points), 0);
}

Points reference_points(Element_kind kind)
{
  const Reference_element& r = reference_elements[kind];
  Points points;
  for(int i = 0; i < r.number_of_vertices; ++i)
    points.push_back({double(r.coordinates[i][0]), double(r.coordinates[i][1]), double(r.coordinates[i][2])});
  return points;
}

Points transformed(Points points, const std::function<Vec3(const Vec3&)>& f)
{
  for(Vec3& p : points)
    p = f(p);
  return points;
}

Points perturbed(Points points, double by, std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(-by, by);
  for(Vec3& p : points)
    for(double& x : p)
      x += uniform(random);
  return points;
}

// ---- the table ---------------------------------------------------------------------------------

// Six times the signed volume, in integers.
int determinant_of(const Reference_element& r, int a, int b, int c, int d)
{
  int m[3][3];
  const int row[3] = {b, c, d};
  for(int i = 0; i < 3; ++i)
    for(int k = 0; k < 3; ++k)
      m[i][k] = r.coordinates[row[i]][k] - r.coordinates[a][k];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
         + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

void test_table(Element_kind kind)
{
  const Reference_element& r = reference_elements[kind];
  static constexpr int six_volumes[number_of_element_kinds] = {1, 8, 6, 48};
  int six_volume = 0;
  std::set<std::pair<int, int>> directed_edges;
  for(int f = 0; f < r.number_of_faces; ++f) {
    const Element_face& face = r.faces[f];
    for(int i = 0; i < face.size; ++i)
      BOOST_TEST(directed_edges.emplace(face.vertices[i], face.vertices[(i + 1) % face.size]).second);
    for(int v = 0; v < r.number_of_vertices; ++v) {
      // The element is strictly behind each of its faces, and faces are planar.
      const bool is_on_face = std::count(face.vertices, face.vertices + face.size, v) != 0;
      const int d = determinant_of(r, face.vertices[0], face.vertices[1], face.vertices[2], v);
      BOOST_TEST(is_on_face ? d == 0 : d < 0);
    }
    for(int i = 2; i < face.size; ++i)
      six_volume -= determinant_of(r, face.vertices[0], face.vertices[i - 1], face.vertices[i], 0);
  }
  BOOST_TEST_EQ(six_volume, six_volumes[kind]);

  // The surface is closed: each edge is there once in each direction, and edges are those of the table.
  std::set<std::pair<int, int>> edges;
  for(const auto& [a, b] : directed_edges) {
    BOOST_TEST_EQ(directed_edges.count({b, a}), 1u);
    edges.insert(std::minmax(a, b));
  }
  std::set<std::pair<int, int>> table_edges;
  for(int e = 0; e < r.number_of_edges; ++e) {
    const int a = r.edges[e][0], b = r.edges[e][1];
    table_edges.insert(std::minmax(a, b));
  }
  BOOST_TEST_EQ(int(table_edges.size()), r.number_of_edges);
  BOOST_TEST(edges == table_edges);
  BOOST_TEST_EQ(r.number_of_vertices - r.number_of_edges + r.number_of_faces, 2);

  // Corners are vertices with their three neighbors, one for each vertex of three edges. The first one stands
  // for all corners of a tetrahedron.
  std::set<int> with_corner;
  for(int c = 0; c < r.number_of_corners; ++c) {
    const auto& v = r.corners[c];
    BOOST_TEST_GT(determinant_of(r, v[0], v[1], v[2], v[3]), 0);
    BOOST_TEST(with_corner.insert(v[0]).second);
    for(int i = 1; i < 4; ++i) {
      const int a = v[0], b = v[i];
      BOOST_TEST_EQ(edges.count(std::minmax(a, b)), 1u);
    }
  }
  BOOST_TEST_EQ(r.number_of_corners, kind == TETRAHEDRON ? 1 : kind == PYRAMID ? 4 : r.number_of_vertices);

  // The orders convert to VTK and back; VTK's wedge has its base normal away from the top, other kinds as
  // ours.
  const IO::internal::Element_names& names = IO::internal::element_names[kind];
  std::set<int> images;
  for(int i = 0; i < r.number_of_vertices; ++i) {
    BOOST_TEST_EQ(int(names.vtk_order[names.vtk_order[i]]), i);
    images.insert(names.vtk_order[i]);
  }
  BOOST_TEST_EQ(int(images.size()), r.number_of_vertices);
  const auto& o = names.vtk_order;
  if(kind == PRISM)
    BOOST_TEST_LT(determinant_of(r, o[0], o[1], o[2], o[3]), 0);
  else if(kind == TETRAHEDRON)
    BOOST_TEST_GT(determinant_of(r, o[0], o[1], o[2], o[3]), 0);
  else
    BOOST_TEST_GT(determinant_of(r, o[0], o[1], o[3], o[4]), 0);
}

// ---- shape functions ---------------------------------------------------------------------------

struct Quadrature_point
{
  Vec3 position;
  double weight;
};

// A product rule on the cube, collapsed to the reference element: exact for polynomials of degree 9 minus the
// weight of the collapse, also for the pyramid's rational functions, which become polynomials.
std::vector<Quadrature_point> quadrature(Element_kind kind)
{
  static constexpr double x[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                  0.9061798459386640};
  static constexpr double w[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                  0.4786286704993665, 0.2369268850561891};
  std::vector<Quadrature_point> points;
  for(int i = 0; i < 5; ++i)
    for(int j = 0; j < 5; ++j)
      for(int k = 0; k < 5; ++k) {
        const double weight = w[i] * w[j] * w[k];
        const double u = (1 + x[i]) / 2, v = (1 + x[j]) / 2, t = (1 + x[k]) / 2; // in [0,1]
        if(kind == TETRAHEDRON)
          points.push_back(
            {{u, v * (1 - u), t * (1 - u) * (1 - v)}, weight / 8 * (1 - u) * (1 - u) * (1 - v)});
        else if(kind == PYRAMID)
          points.push_back({{x[i] * (1 - t), x[j] * (1 - t), t}, weight / 2 * (1 - t) * (1 - t)});
        else if(kind == PRISM)
          points.push_back({{u, v * (1 - u), x[k]}, weight / 4 * (1 - u)});
        else
          points.push_back({{x[i], x[j], x[k]}, weight});
      }
  return points;
}

template <Element_kind Kind>
double jacobian(const Points& points, const Vec3& at)
{
  const auto g = Mixed_element_traits_3<Kind>::shape_gradients(at[0], at[1], at[2]);
  Vec3 columns[3] = {};
  for(std::size_t i = 0; i < points.size(); ++i)
    for(int k = 0; k < 3; ++k)
      columns[k] = columns[k] + g[i][k] * points[i];
  return determinant(columns[0], columns[1], columns[2]);
}

template <Element_kind Kind>
void test_shape_functions()
{
  using Traits = Mixed_element_traits_3<Kind>;
  const Reference_element& r = Traits::reference;
  const Points vertices = reference_points(Kind);
  BOOST_TEST_EQ(Traits::number_of_vertices, r.number_of_vertices);
  const auto shape = [](const Vec3& p) { return Traits::shape_functions(p[0], p[1], p[2]); };

  for(int i = 0; i < r.number_of_vertices; ++i) {
    const auto n = shape(vertices[i]);
    for(int j = 0; j < r.number_of_vertices; ++j)
      BOOST_TEST(is_close(n[j], i == j, 1e-15));
  }

  for(const Quadrature_point& q : quadrature(Kind)) {
    const auto n = shape(q.position);
    const auto g = Traits::shape_gradients(q.position[0], q.position[1], q.position[2]);
    double sum = 0;
    Vec3 gradient_sum{}, position{};
    for(int i = 0; i < r.number_of_vertices; ++i) {
      sum += n[i];
      gradient_sum = gradient_sum + g[i];
      position = position + n[i] * vertices[i];
      for(int k = 0; k < 3; ++k) {
        const double h = 1e-5;
        Vec3 a = q.position, b = q.position;
        a[k] -= h;
        b[k] += h;
        BOOST_TEST(is_close((shape(b)[i] - shape(a)[i]) / (2 * h), g[i][k], 1e-7));
      }
    }
    BOOST_TEST(is_close(sum, 1, 1e-14));
    BOOST_TEST(norm(gradient_sum) < 1e-13);
    BOOST_TEST(norm(position - q.position) < 1e-14); // linear fields
    BOOST_TEST(is_close(jacobian<Kind>(vertices, q.position), 1, 1e-13));
  }

  // Shape functions are conforming: only the vertices of a face count on the face, linearly on triangles,
  // bilinearly on quadrilaterals, whatever the element behind the face is.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for(int f = 0; f < r.number_of_faces; ++f)
    for(int repeat = 0; repeat < 10; ++repeat) {
      const Element_face& face = r.faces[f];
      double u = uniform(random), v = uniform(random);
      if(face.size == 3 && u + v > 1)
        u = 1 - u, v = 1 - v;
      std::vector<double> weights = {1 - u - v, u, v};
      if(face.size == 4)
        weights = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
      std::vector<double> expected(std::size_t(r.number_of_vertices), 0);
      Vec3 p{};
      for(int i = 0; i < face.size; ++i) {
        expected[face.vertices[i]] = weights[i];
        p = p + weights[i] * vertices[face.vertices[i]];
      }
      const auto n = shape(p);
      for(int i = 0; i < r.number_of_vertices; ++i)
        BOOST_TEST(is_close(n[i], expected[i], 1e-13));
    }
}

// ---- volume ------------------------------------------------------------------------------------

template <Element_kind Kind>
void test_volume()
{
  std::mt19937 random(11);
  for(int repeat = 0; repeat < 20; ++repeat) {
    const Points points = perturbed(reference_points(Kind), repeat == 0 ? 0 : 0.3, random);
    double integral = 0, smallest = infinity;
    for(const Quadrature_point& q : quadrature(Kind)) {
      const double j = jacobian<Kind>(points, q.position);
      smallest = (std::min)(smallest, j);
      integral += q.weight * j;
    }
    BOOST_TEST(is_close(volume(one_element(Kind, points), 0), integral, 1e-12));
    if(repeat == 0)
      BOOST_TEST(is_close(smallest, 1, 1e-13));
  }
  // Only the rounding of the vertices counts far from the origin.
  const Vec3 far{1e8, -1e8, 1e8};
  const Points points = transformed(reference_points(Kind), [&](const Vec3& p) { return p + far; });
  BOOST_TEST_EQ(volume(one_element(Kind, points), 0), volume(one_element(Kind, reference_points(Kind)), 0));
}

// Two elements that share a warped face: their volumes add up to the volume of the whole.
void test_sum_of_volumes()
{
  // The box 2 x 1 x 1 consists of two hexahedra, with the four shared vertices anywhere.
  std::mt19937 random(5);
  for(int repeat = 0; repeat < 10; ++repeat) {
    const Points middle = perturbed({{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}}, 0.4, random);
    const Points outer = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1},
                          {2, 0, 0}, {2, 1, 0}, {2, 0, 1}, {2, 1, 1}};
    Mesh mesh;
    for(const Points& points : {middle, outer})
      for(const Vec3& p : points)
        mesh.add_vertex({p[0], p[1], p[2]});
    mesh.add_element(HEXAHEDRON, {4, 0, 1, 5, 6, 2, 3, 7});
    mesh.add_element(HEXAHEDRON, {0, 8, 9, 1, 2, 10, 11, 3});
    // The middle vertices move the outer faces too: the sum is compared with the whole as one hexahedron of
    // the same outer faces, that is, with the flux through these.
    double six_fluxes = 0;
    for(std::size_t e = 0; e < 2; ++e) {
      const Element_view element = mesh.element(e);
      for(int f = 0; f < 6; ++f) {
        if(f == (e == 0 ? 1 : 0)) // the shared face: x+ of the first, x- of the second
          continue;
        Vec3 q[4];
        for(int i = 0; i < 4; ++i)
          q[i] = to_vec3(mesh.point(element[element.reference().faces[f].vertices[i]]));
        six_fluxes += (determinant(q[0], q[1], q[2]) + determinant(q[0], q[2], q[3])
                       + determinant(q[0], q[1], q[3]) + determinant(q[1], q[2], q[3]))
                      / 2;
      }
    }
    BOOST_TEST(is_close(volume(mesh), six_fluxes / 6, 1e-12));
    BOOST_TEST(is_close(volume(mesh), volume(mesh, 0) + volume(mesh, 1), 1e-15));
  }
}

// ---- aspect-ratio coefficient ------------------------------------------------------------------

Points box(double a, double b, double c)
{
  return {{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}, {0, 0, c}, {a, 0, c}, {a, b, c}, {0, b, c}};
}

Points square_pyramid(double side, const Vec3& apex)
{
  return {{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}, apex};
}

Points prism(const Vec3& a, const Vec3& b, const Vec3& c, double height)
{
  const Vec3 up{0, 0, height};
  return {a, b, c, a + up, b + up, c + up};
}

const Vec3 left{0, 0, 0}, right{1, 0, 0}, third{0.5, std::sqrt(3.) / 2, 0}; // equilateral

void test_known_aspect_ratios()
{
  // The constant 8.47867 of the paper is that of a regular tetrahedron up to 8e-4.
  const Points regular = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};
  BOOST_TEST(is_close(arc(TETRAHEDRON, regular), 6 * std::sqrt(2.) / 8.47867, 1e-14));
  BOOST_TEST(is_close(arc(TETRAHEDRON, regular), 1, 1e-3));
  // The corner of a cube has squared edges 1 1 1 2 2 2, volume 1/6.
  BOOST_TEST(is_close(arc(TETRAHEDRON, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}),
                      std::pow(1.5, 1.5) * 6 / 8.47867, 1e-14));
  // The tetrahedron of 1/10 of that height has squared edges 1 1 0.01 2 1.01 1.01.
  BOOST_TEST(is_close(arc(TETRAHEDRON, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}}),
                      std::pow(6.03 / 6, 1.5) * 60 / 8.47867, 1e-13));

  BOOST_TEST_EQ(arc(HEXAHEDRON, box(1, 1, 1)), 1.);
  BOOST_TEST_EQ(arc(HEXAHEDRON, box(1, 2, 3)), 3.);
  BOOST_TEST_EQ(arc(HEXAHEDRON, box(5, 1, 2)), 5.);
  // The cube sheared by 45 degrees has two segments 1, one sqrt 2.
  BOOST_TEST(is_close(arc(HEXAHEDRON, transformed(box(1, 1, 1),
                                                  [](const Vec3& p) {
                                                    return Vec3{p[0] + p[2], p[1], p[2]};
                                                  })),
                      std::sqrt(2.), 1e-15));
  // The frustum has a top half as wide: the segments across are 3/4 long, the segment along is 1.
  BOOST_TEST(
    is_close(arc(HEXAHEDRON, transformed(box(1, 1, 1),
                                         [](const Vec3& p) {
                                           const double s = 1 - p[2] / 2;
                                           return Vec3{0.5 + s * (p[0] - 0.5), 0.5 + s * (p[1] - 0.5), p[2]};
                                         })),
             4. / 3, 1e-15));

  BOOST_TEST_EQ(arc(PYRAMID, square_pyramid(1, {0.5, 0.5, 1})), 1.);
  BOOST_TEST_EQ(arc(PYRAMID, square_pyramid(1, {3, -2, 1})), 1.); // the height decides, not the foot
  BOOST_TEST_EQ(arc(PYRAMID, square_pyramid(1, {0.5, 0.5, 0.5})), 2.);
  BOOST_TEST_EQ(arc(PYRAMID, square_pyramid(1, {0.5, 0.5, 3})), 3.);
  // The pyramid has base 2 x 1, height 1.
  BOOST_TEST_EQ(arc(PYRAMID, {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 0.5, 1}}), 2.);
  // The base is warped, mean plane z = 0: the midpoint segments stay 1, the height too.
  BOOST_TEST(
    is_close(arc(PYRAMID, {{0, 0, 0.1}, {1, 0, -0.1}, {1, 1, 0.1}, {0, 1, -0.1}, {0.5, 0.5, 1}}), 1, 1e-15));

  // An equilateral prism's triangle has height sqrt(3)/2: no prism reaches 1.
  BOOST_TEST(is_close(arc(PRISM, prism(left, right, third, 1)), 2 / std::sqrt(3.), 1e-15));
  BOOST_TEST(is_close(arc(PRISM, prism(left, right, third, 0.9)), 2 / std::sqrt(3.), 1e-15));
  BOOST_TEST(is_close(arc(PRISM, prism(left, right, third, 0.5)), 2, 1e-15));
  BOOST_TEST(is_close(arc(PRISM, prism(left, right, third, 3)), 3 * 2 / std::sqrt(3.), 1e-14));
  // Half a cube has at the long face width sqrt 2, height sqrt(1/2).
  BOOST_TEST(is_close(arc(PRISM, prism({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1)), 2, 1e-14));

  // The elements are flat or inside out.
  BOOST_TEST_EQ(arc(TETRAHEDRON, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), infinity);
  BOOST_TEST_EQ(arc(TETRAHEDRON, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}), infinity);
  BOOST_TEST_EQ(arc(PYRAMID, square_pyramid(1, {0.5, 0.5, 0})), infinity);
  BOOST_TEST_EQ(arc(PYRAMID, square_pyramid(1, {0.5, 0.5, -1})), infinity);
  BOOST_TEST_EQ(arc(PYRAMID, square_pyramid(0, {0, 0, 1})), infinity);
  BOOST_TEST_EQ(arc(PRISM, prism(left, right, third, 0)), infinity);
  BOOST_TEST_EQ(arc(PRISM, prism(left, right, {3, 0, 0}, 1)), infinity);
  BOOST_TEST_EQ(arc(HEXAHEDRON, box(1, 1, 0)), infinity);
  for(Element_kind kind : element_kinds)
    BOOST_TEST_EQ(arc(kind, Points(std::size_t(reference_elements[kind].number_of_vertices))), infinity);
}

void test_invariance(Element_kind kind)
{
  std::mt19937 random(13);
  std::normal_distribution<double> normal;
  for(int repeat = 0; repeat < 20; ++repeat) {
    const Points points = perturbed(reference_points(kind), 0.2, random);
    const double expected = arc(kind, points);
    BOOST_TEST(std::isfinite(expected) && expected >= 1);
    // The rotation is about a random axis by a random angle (Rodrigues).
    Vec3 axis{normal(random), normal(random), normal(random)};
    axis = (1 / norm(axis)) * axis;
    const double angle = 6 * normal(random), c = std::cos(angle), s = std::sin(angle);
    BOOST_TEST(is_close(arc(kind, transformed(points,
                                              [&](const Vec3& p) {
                                                return c * p + s * cross(axis, p)
                                                       + (1 - c) * dot(axis, p) * axis;
                                              })),
                        expected, 1e-12 * expected));
    for(double scale : {1e-6, 1e6, std::ldexp(1., 40)})
      BOOST_TEST(is_close(arc(kind, transformed(points, [&](const Vec3& p) { return scale * p; })), expected,
                          1e-12 * expected));
    // Vertices are rounded to 1.5e-8 there.
    const Vec3 far{1e8, -1e8, 1e8};
    BOOST_TEST(is_close(arc(kind, transformed(points, [&](const Vec3& p) { return p + far; })), expected,
                        1e-5 * expected));
  }
}

void test_statistics()
{
  Mesh mesh;
  const auto add = [&](Element_kind kind, const Points& points) {
    std::vector<Vertex_index> v;
    for(const Vec3& p : points)
      v.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
    mesh.add_element(kind, v.data());
  };
  add(HEXAHEDRON, box(1, 1, 1));
  add(HEXAHEDRON, box(1, 1, 2));
  add(HEXAHEDRON, box(1, 1, 9));
  add(PYRAMID, square_pyramid(1, {0.5, 0.5, 7}));
  const auto rows = quality_statistics(mesh);
  BOOST_TEST_EQ(rows[TETRAHEDRON].count, 0u);
  BOOST_TEST_EQ(rows[TETRAHEDRON].mean, 0.);
  BOOST_TEST_EQ(rows[PRISM].count, 0u);
  BOOST_TEST_EQ(rows[PYRAMID].count, 1u);
  BOOST_TEST_EQ(rows[PYRAMID].share, 1.);
  BOOST_TEST_EQ(rows[HEXAHEDRON].count, 3u);
  BOOST_TEST_EQ(rows[HEXAHEDRON].mean, 4.);
  BOOST_TEST_EQ(rows[HEXAHEDRON].maximum, 9.);
  BOOST_TEST_EQ(rows[HEXAHEDRON].share, 2. / 3);
  BOOST_TEST_EQ(rows[number_of_element_kinds].count, 4u);
  BOOST_TEST_EQ(rows[number_of_element_kinds].mean, 19. / 4);
  BOOST_TEST_EQ(rows[number_of_element_kinds].maximum, 9.);
  BOOST_TEST_EQ(rows[number_of_element_kinds].share, 0.75);
  BOOST_TEST(is_close(volume(mesh), 1 + 2 + 9 + 7. / 3, 1e-14));
}

int run(int, char*[])
{
  for(Element_kind kind : element_kinds) {
    test_table(kind);
    test_invariance(kind);
  }
  test_shape_functions<TETRAHEDRON>();
  test_shape_functions<PYRAMID>();
  test_shape_functions<PRISM>();
  test_shape_functions<HEXAHEDRON>();
  test_volume<TETRAHEDRON>();
  test_volume<PYRAMID>();
  test_volume<PRISM>();
  test_volume<HEXAHEDRON>();
  test_sum_of_volumes();
  test_known_aspect_ratios();
  test_statistics();
  return boost::report_errors();
}

} // namespace test_elements_traits
