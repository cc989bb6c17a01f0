// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bisection of boundary edges, compared with the triangles of the boundary alone.

#include "test_fitting.h"
#include "test_strata.h"

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/bisect_boundary_edges.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace test_fitting_bisections {

using namespace CGAL::Mixed_meshes_3;
using internal::Boundary_bisector;
using internal::Working_mesh;
using internal::no_vertex;

constexpr double infinity = std::numeric_limits<double>::infinity();

using Edge = std::pair<Vertex_index, Vertex_index>;

double length(const std::vector<Vec3>& points, const Edge& e)
{
  return norm(points[e.first] - points[e.second]);
}

// ---- what is done ------------------------------------------------------------------------------

struct Bisected
{
  Mesh mesh;
  std::vector<Edge> edges;
  std::vector<Edge> underway; // edges whose middles are not where they are to be
};

// Bisects the longest of the edges that `is_allowed(a, b)` tells; `project(p, hint)` is the place of a
// middle.
template <class Is_allowed, class Project>
Bisected bisect(const Mesh& start, std::size_t number, double worst, const Is_allowed& is_allowed,
                const Project& project)
{
  Bisected result{start, {}, {}};
  const std::vector<Face> boundary = boundary_faces(start);
  Working_mesh working = working_mesh(start, boundary);
  const Aspect_ratio_quality_3 quality;
  const auto gain = [&](Vertex_index a, Vertex_index b, const std::array<Vertex_index, 2>& apexes,
                        internal::Stratum) {
    BOOST_TEST(apexes[0] != no_vertex && apexes[1] != no_vertex);
    return is_allowed(a, b) ? norm(working.points[a] - working.points[b]) : 0.;
  };
  const Test_projection projection{project};
  const internal::Interface_faces faces = interface_faces(boundary);
  Boundary_bisector bisector(working, quality, projection, gain, faces, worst);
  for(const auto& [edge, is_underway, target] : bisector(number)) {
    const Vec3 middle = 0.5 * (working.points[edge.first] + working.points[edge.second]);
    const Vec3& p = working.points[start.number_of_vertices() + result.edges.size()];
    BOOST_TEST(target == project(middle, working.points[edge.first]));
    BOOST_TEST(p == (is_underway ? middle : target));
    result.edges.push_back(edge);
    if(is_underway)
      result.underway.push_back(edge);
  }
  working.store(result.mesh);
  return result;
}

bool all(Vertex_index, Vertex_index) { return true; }

Vec3 stay(const Vec3& p, const Vec3&) { return p; }

// ---- the boundary alone ------------------------------------------------------------------------

struct Triangulation
{
  std::vector<Vec3> points;
  std::set<Polygon> triangles; // from the smallest vertex on

  explicit Triangulation(const Mesh& mesh) : triangles(boundary_of(mesh))
  {
    for(const Test_point& p : mesh.points())
      points.push_back({p.x(), p.y(), p.z()});
  }

  std::map<Edge, int> edges() const
  {
    std::map<Edge, int> result;
    for(const Polygon& t : triangles)
      for(std::size_t i = 0; i < t.size(); ++i)
        ++result[std::minmax(t[i], t[(i + 1) % t.size()])];
    return result;
  }

  void bisect(const Edge& e, const Vec3& p)
  {
    const Vertex_index middle = Vertex_index(points.size());
    points.push_back(p);
    for(const Polygon& t : std::set<Polygon>(triangles))
      if(std::count(t.begin(), t.end(), e.first) && std::count(t.begin(), t.end(), e.second)) {
        triangles.erase(t);
        for(Vertex_index end : {e.first, e.second}) {
          Polygon half = t;
          std::replace(half.begin(), half.end(), end, middle);
          std::rotate(half.begin(), std::min_element(half.begin(), half.end()), half.end());
          triangles.insert(half);
        }
      }
  }
};

double volume_in_region(const Mesh& mesh)
{
  double sum = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    sum += mesh.is_in_region(e) ? volume(mesh, e) : 0;
  return sum;
}

std::multiset<Polygon> other_elements(const Mesh& mesh)
{
  std::multiset<Polygon> result;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    if(mesh.element(e).kind() != TETRAHEDRON)
      result.emplace(mesh.element(e).begin(), mesh.element(e).end());
  return result;
}

// Checks conditions that hold for any bisections: valid elements, the same body, and the boundary with
// exactly these edges bisected, each of them the longest of the allowed edges, if none was refused for
// quality.
template <class Is_allowed>
void check(const Mesh& start, const Bisected& result, std::size_t number, double worst,
           const Is_allowed& is_allowed)
{
  const Mesh& mesh = result.mesh;
  BOOST_TEST(find_defects(mesh).none() || !find_defects(start).none());
  BOOST_TEST(is_positive(mesh));
  BOOST_TEST_LE(result.edges.size(), number);
  BOOST_TEST_EQ(mesh.number_of_vertices(), start.number_of_vertices() + result.edges.size());
  BOOST_TEST_LE(std::abs(volume(mesh) - volume(start)), 1e-13 * volume(start));
  BOOST_TEST_LE(std::abs(volume_in_region(mesh) - volume_in_region(start)), 1e-13 * volume(start));
  BOOST_TEST(other_elements(mesh) == other_elements(start));
  const Aspect_ratio_quality_3 quality;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    if(std::any_of(mesh.element(e).begin(), mesh.element(e).end(),
                   [&](Vertex_index v) { return v >= start.number_of_vertices(); }))
      BOOST_TEST_LE(quality(mesh.element(e).kind(), internal::element_points(mesh, mesh.element(e))), worst);

  Triangulation boundary(start);
  for(const Edge& e : result.edges) {
    const std::map<Edge, int> edges = boundary.edges();
    BOOST_TEST(edges.count(e) == 1 && edges.at(e) == 2 && is_allowed(e.first, e.second));
    for(const auto& [other, count] : edges)
      BOOST_TEST(worst < infinity || count != 2 || !is_allowed(other.first, other.second)
                 || length(boundary.points, other) <= length(boundary.points, e));
    boundary.bisect(e, 0.5 * (boundary.points[e.first] + boundary.points[e.second]));
  }
  BOOST_TEST(boundary.triangles == boundary_of(mesh));
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    for(int k = 0; k < 3; ++k)
      BOOST_TEST_EQ(mesh.point(v)[k], boundary.points[v][k]);
}

// ---- meshes of tetrahedra ----------------------------------------------------------------------

// Two subdomains, part of one of them in the region.
Mesh distorted_cube(unsigned seed)
{
  const Mesh plain = grid(3, TETRAHEDRON);
  Mesh mesh;
  mesh.points() = plain.points();
  for(std::size_t e = 0; e < plain.number_of_elements(); ++e) {
    std::array<Vertex_index, 4> v{};
    std::copy(plain.element(e).begin(), plain.element(e).end(), v.begin());
    mesh.add_element(TETRAHEDRON, v, {e % 5 == 0 ? 2 : 1, e % 3 == 0});
  }
  // Boundary vertices move within their faces and edges of the cube, so that lengths differ.
  for(Test_point& p : mesh.points()) {
    const auto bent = [](double x, double y, double z) {
      return x + x * (1 - x) * (0.2 * y + 0.1 * z - 0.07);
    };
    p = {bent(p.x(), p.y(), p.z()), bent(p.y(), p.z(), p.x()), bent(p.z(), 0.3 * p.x(), p.y())};
  }
  distort(mesh, 0.05, seed);
  return mesh;
}

void test_tetrahedra()
{
  for(unsigned seed : {1u, 2u}) {
    const Mesh start = distorted_cube(seed);
    BOOST_TEST(find_defects(start).none());
    const std::vector<Edge> most = bisect(start, 200, infinity, all, stay).edges;
    for(std::size_t number : {0, 1, 2, 17, 60, 200}) {
      const Bisected result = bisect(start, number, infinity, all, stay);
      BOOST_TEST_EQ(result.edges.size(), number); // halves of positive ones are positive
      BOOST_TEST(std::equal(result.edges.begin(), result.edges.end(), most.begin()));
      check(start, result, number, infinity, all);
    }
    // Only some edges are bisected, and only as long as elements are good.
    const auto is_odd = [](Vertex_index a, Vertex_index b) { return (a + b) % 2 == 1; };
    check(start, bisect(start, 50, infinity, is_odd, stay), 50, infinity, is_odd);
    BOOST_TEST(bisect(
                 start, 50, infinity, [](Vertex_index, Vertex_index) { return false; }, stay)
                 .edges.empty());
    std::size_t last = 0;
    bool is_some_refused = false;
    for(double worst : {1., 2.5, 3., 4., 6.}) {
      const Bisected result = bisect(start, 300, worst, all, stay);
      check(start, result, 300, worst, all);
      BOOST_TEST_GE(result.edges.size(), last);
      last = result.edges.size();
      BOOST_TEST(worst > 1 || last == 0);
      is_some_refused = is_some_refused || (last > 0 && last < 300);
    }
    BOOST_TEST(is_some_refused);
  }
}

// Middles go to their projections, if elements stay valid; others stay on their edges, which are not bisected
// again.
void test_projection()
{
  Mesh start = grid(3, TETRAHEDRON);
  const auto sphere = [](const Vec3& p) {
    const Vec3 d = p - Vec3{0.5, 0.5, 0.5};
    return Vec3{0.5, 0.5, 0.5} + (0.9 / norm(d)) * d;
  };
  const auto project = [&](const Vec3& p, const Vec3& hint) {
    BOOST_TEST_LE(norm(hint - p), 0.25); // an end of the edge
    return sphere(p);
  };
  const Bisected result = bisect(start, 20, 5, all, project);
  BOOST_TEST_GT(result.edges.size(), 0u);
  BOOST_TEST(find_defects(result.mesh).none());
  BOOST_TEST_GT(volume(result.mesh), volume(start));
  for(Vertex_index v = 0; v < start.number_of_vertices(); ++v)
    BOOST_TEST(result.mesh.point(v) == start.point(v));
  BOOST_TEST(!result.underway.empty()); // those are refused for the quality
  BOOST_TEST_LT(result.underway.size(), result.edges.size());
  // Elements would be inverted: all middles stay.
  const auto opposite = [](const Vec3& p, const Vec3&) { return Vec3{1, 1, 1} - p; };
  const Bisected underway = bisect(start, 20, infinity, all, opposite);
  BOOST_TEST_EQ(underway.edges.size(), 20u);
  BOOST_TEST(underway.underway == underway.edges);
  check(start, underway, 20, 1e9, [](Vertex_index a, Vertex_index b) {
    return (std::max)(a, b) < grid(3, TETRAHEDRON).number_of_vertices();
  });
}

// ---- where nothing happens ---------------------------------------------------------------------

void test_other_elements()
{
  for(Element_kind kind : {PYRAMID, PRISM, HEXAHEDRON}) {
    const Mesh start = grid(2, kind);
    const Bisected result = bisect(start, 1000, infinity, all, stay);
    BOOST_TEST(result.edges.empty());
    BOOST_TEST(is_same(result.mesh, start));
  }
  // The mesh has one element of each kind: only edges without other kinds are bisected.
  const Mesh start = four_kinds<Mesh>(1, {0, 0, 0});
  const Bisected result = bisect(start, 12, infinity, all, stay);
  check(start, result, 12, 1e9, all);
  BOOST_TEST_EQ(result.edges.size(), 12u);
  for(std::size_t e = 0; e < 3; ++e) // that are no tetrahedra
    for(const auto& [a, b] : result.edges) {
      const auto element = start.element(e);
      BOOST_TEST(!std::count(element.begin(), element.end(), a)
                 || !std::count(element.begin(), element.end(), b));
    }
}

// Two tetrahedra, or four, have only an edge, the longest, in common: four faces of the boundary meet there.
void test_nonmanifold_edge()
{
  for(int n : {2, 4}) {
    Mesh start;
    start.add_vertex({0, 0, -9});
    start.add_vertex({0, 0, 9});
    for(int i = 0; i < n; ++i) {
      const double angle = 2 * CGAL_PI * i / n;
      for(double a : {angle, angle + 0.7})
        start.add_vertex({std::cos(a), std::sin(a), 0});
      start.add_element(TETRAHEDRON, {0, 1, Vertex_index(2 + 2 * i), Vertex_index(3 + 2 * i)});
    }
    BOOST_TEST(is_positive(start));
    BOOST_TEST(!find_defects(start).none());
    const Bisected result = bisect(start, 30, infinity, all, stay);
    BOOST_TEST_EQ(result.edges.size(), 30u);
    BOOST_TEST(std::count(result.edges.begin(), result.edges.end(), Edge(0, 1)) == 0);
    check(start, result, 30, infinity, all);
    BOOST_TEST_EQ(Triangulation(result.mesh).edges().at({0, 1}), 2 * n);
  }
}

int run(int, char*[])
{
  test_tetrahedra();
  test_projection();
  test_other_elements();
  test_nonmanifold_edge();
  return boost::report_errors();
}

} // namespace test_fitting_bisections
