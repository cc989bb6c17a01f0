// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification with sharp edges and with several subdomains: the topology of the mesh and of its boundary
// stays, by brute force, no element is inverted, by rationals, and the boundary does not cut itself; sharp
// edges stay simple paths between the same corners, subdomains and interfaces keep their topology; meshes of
// fewer vertices come from those of more.

#include "test_cells.h"
#include "test_fitting.h"
#include "test_strata.h"
#include "test_surfaces.h"
#include "test_topology.h"

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Interface_curves.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Mesh_simplifier.h>
#include <CGAL/Mixed_mesh_3/internal/base/Plane_quadric.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/simplify.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace test_fitting_simplification {

using namespace CGAL::Mixed_meshes_3;
using brute_force::topology;
using cells::Cell;
using cells::cells_of_grid;
using internal::Core_mesh;
using internal::Followed_features;
using internal::Stratum;
using internal::Vertex_defect;
using internal::Working_mesh;
using internal::no_vertex;

// The volume between a point and planes: the sum over triangles is that of the definition.
void test_quadric()
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return Vec3{x, y, z};
  };
  internal::Plane_quadric sum, other;
  double area = 0, squares = 0;
  const Vec3 p = point();
  for(int i = 0; i < 20; ++i) {
    const Vec3 a = point(), b = point(), c = point(), n = cross(b - a, c - a);
    (i % 2 == 0 ? sum : other).add(a, b, c);
    area += norm(n) / 6;
    squares += norm(n) / 6 * std::pow(dot(p - a, n) / norm(n), 2);
  }
  sum += other;
  BOOST_TEST_LE(std::abs(sum.volume(p) - std::sqrt(area * squares)), 1e-12);
  internal::Plane_quadric of_flat;
  of_flat.add({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
  of_flat.add({0, 0, 1}, {0, 1, 1}, {0, 0, 1}); // has no area
  BOOST_TEST_EQ(of_flat.volume({5, 7, 1}), 0.);
}

struct Paths
{
  std::vector<std::vector<Vertex_index>> paths; // the ends are corners
  std::vector<Vertex_index> corners;
};

// Random paths along edges of the boundary, which have no vertex in common but their ends.
Paths random_paths(const Mesh& mesh, std::size_t number, std::mt19937& random)
{
  std::map<Vertex_index, std::set<Vertex_index>> neighbors;
  for(const Face& face : boundary_faces(mesh))
    for(Vertex_index a : face.vertices())
      for(Vertex_index b : face.vertices())
        if(a != b)
          neighbors[a].insert(b);
  std::vector<Vertex_index> vertices;
  for(const auto& [v, around] : neighbors)
    vertices.push_back(v);
  Paths result;
  std::set<Vertex_index> is_used;
  for(std::size_t trial = 0; trial < 10 * number && result.paths.size() < number; ++trial) {
    const auto corner = [&] {
      return !result.corners.empty() && random() % 2 == 0 ? result.corners[random() % result.corners.size()]
                                                          : vertices[random() % vertices.size()];
    };
    const Vertex_index first = corner(), last = corner();
    const auto is_corner = [&](Vertex_index v) {
      return std::count(result.corners.begin(), result.corners.end(), v) > 0;
    };
    if(first == last || (is_used.count(first) > 0 && !is_corner(first))
       || (is_used.count(last) > 0 && !is_corner(last)))
      continue;
    std::map<Vertex_index, Vertex_index> from{{first, first}};
    std::vector<Vertex_index> queue{first};
    for(std::size_t i = 0; i < queue.size() && from.count(last) == 0; ++i)
      for(Vertex_index u : neighbors.at(queue[i]))
        if((u == last && (queue[i] != first || from.size() > 1)) || is_used.count(u) == 0)
          if(from.emplace(u, queue[i]).second)
            queue.push_back(u);
    if(from.count(last) == 0 || from.at(last) == first)
      continue;
    std::vector<Vertex_index> path{last};
    while(path.back() != first)
      path.push_back(from.at(path.back()));
    for(Vertex_index v : {first, last})
      if(!is_corner(v))
        result.corners.push_back(v);
    is_used.insert(path.begin(), path.end());
    result.paths.push_back(std::move(path));
  }
  return result;
}

// The ends of the simple path that the edges of a stratum are, in order; else nothing.
std::vector<Vertex_index> ends_of_path(const Working_mesh& mesh, Stratum stratum)
{
  std::map<Vertex_index, std::vector<Vertex_index>> at;
  std::size_t number = 0;
  for(const auto& [edge, s] : mesh.sharp_edges)
    if(s == stratum) {
      at[edge.first].push_back(edge.second);
      at[edge.second].push_back(edge.first);
      ++number;
    }
  std::vector<Vertex_index> ends;
  for(const auto& [v, around] : at) {
    if(around.size() == 1)
      ends.push_back(v);
    else if(around.size() != 2 || mesh.strata[v] != stratum)
      return {};
  }
  if(ends.size() != 2)
    return {};
  std::size_t steps = 0; // along the path: all edges are on it
  for(Vertex_index before = no_vertex, v = ends[0]; v != ends[1]; ++steps) {
    const auto& around = at.at(v);
    const Vertex_index next = around[0] == before ? around[1] : around[0];
    before = std::exchange(v, next);
  }
  return steps == number ? ends : std::vector<Vertex_index>();
}

// Features with at least that number of polylines, wherever they are: all between the same corners.
internal::Sharp_features features_with(std::size_t number)
{
  Sharp_edges edges;
  edges.points = {{0, 0, 0}, {2, 0, 0}};
  for(std::size_t i = 0; i < (std::max)(number, std::size_t(3)); ++i) {
    edges.edges.push_back({0, edges.points.size()});
    edges.edges.push_back({edges.points.size(), 1});
    edges.points.push_back({1, 0.1 * double(i), 0});
  }
  const internal::Sharp_features features(edges, 0.1);
  BOOST_TEST_GE(features.polylines().size(), number);
  return features;
}

struct Counts
{
  std::size_t removed = 0, on_paths = 0;
};

// Removes vertices one by one, as long as there is one that may go.
void simplify_at_random(const Mesh& start, unsigned seed, Counts& counts)
{
  std::mt19937 random(seed);
  const auto before = topology(start);
  const std::vector<Face> boundary = boundary_faces(start);
  const Paths paths = random_paths(start, 3, random);
  const internal::Sharp_features features = features_with(paths.paths.size());
  Working_mesh working = working_mesh(start, boundary);
  const Stratum first_corner = Stratum(internal::first_sharp_stratum + features.polylines().size());
  for(std::size_t i = 0; i < paths.paths.size(); ++i)
    for(std::size_t k = 0; k < paths.paths[i].size(); ++k) {
      working.strata[paths.paths[i][k]] = Stratum(internal::first_sharp_stratum + i);
      if(k > 0)
        working.sharp_edges[std::minmax(paths.paths[i][k - 1], paths.paths[i][k])] = Stratum(
          internal::first_sharp_stratum + i);
    }
  for(std::size_t c = 0; c < paths.corners.size(); ++c)
    working.strata[paths.corners[c]] = Stratum(first_corner + c);
  const std::vector<internal::Stratum> strata = working.strata;
  const std::size_t edges = working.sharp_edges.size();
  const std::vector<Vec3> targets = working.points;
  const std::vector<Vertex_defect> defects(targets.size(), Vertex_defect::NONE);
  const std::vector<std::uint8_t> is_on_boundary(boundary.size(), 1);
  const std::vector<double> weights(boundary.size(), 1);
  const Aspect_ratio_quality_3 quality;
  internal::Mesh_simplifier<Aspect_ratio_quality_3> simplifier(working, quality,
                                                               internal::vertices_of_faces(boundary),
                                                               is_on_boundary, weights, targets, defects,
                                                               features, boundary.size() / 2);
  while(simplifier(1e6, 1e6, false, 1, [] { return true; }) == 1) {
    ++counts.removed;
    Mesh mesh = start;
    working.store(mesh);
    BOOST_TEST(topology(mesh) == before);
    BOOST_TEST(find_defects(mesh).none());
    BOOST_TEST(brute_force::has_positive_corners(mesh));
    std::vector<Vec3> points;
    for(const auto& p : mesh.points())
      points.push_back(to_vec3(p));
    BOOST_TEST(internal::vertices_of_self_intersections(points, boundary_faces(mesh)).empty());
    for(std::size_t i = 0; i < paths.paths.size(); ++i) {
      std::vector<Vertex_index> ends{paths.paths[i].front(), paths.paths[i].back()};
      std::sort(ends.begin(), ends.end());
      BOOST_TEST(ends_of_path(working, Stratum(internal::first_sharp_stratum + i)) == ends);
    }
    for(Vertex_index v = 0; v < strata.size(); ++v)
      BOOST_TEST(working.incident[v].empty() || working.strata[v] == strata[v]);
    const internal::Sharp_strata sharp = working.sharp_strata();
    BOOST_TEST_EQ(sharp.of_vertices.size(), mesh.number_of_vertices());
    BOOST_TEST_EQ(sharp.edges.size(), working.sharp_edges.size());
  }
  counts.on_paths += edges - working.sharp_edges.size();
}

void test_sharp_edges_stay()
{
  Counts counts;
  std::mt19937 random(1);
  for(unsigned seed = 1; seed <= 12; ++seed) {
    const Mesh start = cells::random_cells(seed, random);
    if(find_defects(start).none())
      simplify_at_random(start, seed, counts);
  }
  // The meshes have a hole.
  for(unsigned seed = 1; seed <= 3; ++seed)
    simplify_at_random(cells_of_grid(4, seed, [](const Cell& c) { return c[0] == 1 && c[1] == 1 ? 0 : 1; }),
                       seed, counts);
  std::cout << counts.removed << " vertices removed, " << counts.on_paths << " of them from sharp edges"
            << std::endl;
  BOOST_TEST_GT(counts.removed, 300u);
  BOOST_TEST_GT(counts.on_paths, 20u);
}

// Betti numbers of each subdomain and its boundary, of each interface, and of the edges where interfaces
// meet.
std::vector<brute_force::Betti_numbers> topology_of_subdomains(const Mesh& mesh, Subdomain_index number)
{
  std::vector<brute_force::Betti_numbers> all;
  for(Subdomain_index i = 1; i <= number; ++i)
    for(const auto& betti : topology(mesh, i))
      all.push_back(betti);
  std::map<std::pair<Vertex_index, Vertex_index>, int> faces_at;
  for(const Subdomain_interface& one : find_interfaces(mesh)) {
    brute_force::Complex interface;
    for(const Face& face : one.faces) {
      const Face_vertices& v = face.vertices();
      interface.add_face({v.begin(), v.end()});
      for(int i = 0; i < 3; ++i)
        ++faces_at[std::minmax(v[i], v[(i + 1) % 3])];
    }
    all.push_back(interface.betti_numbers());
  }
  brute_force::Complex curves;
  for(const auto& [edge, n] : faces_at)
    if(n != 2)
      curves.add_edge(edge.first, edge.second);
  all.push_back(curves.betti_numbers());
  return all;
}

// Subdomains, their interfaces, and the curves where these meet keep their topology, whatever is where.
void test_interfaces_stay()
{
  constexpr Subdomain_index number = 3;
  std::size_t removed = 0, on_curves = 0, corners = 0;
  std::mt19937 random(5);
  for(unsigned seed = 1; seed <= 12; ++seed) {
    std::map<Cell, Subdomain_index> labels; // random ones, or layers
    const Mesh start = cells_of_grid(4, seed, [&](const Cell& c) {
      const auto any = [&] { return Subdomain_index(1 + random() % number); };
      return seed % 3 == 0 ? labels.try_emplace(c, any()).first->second
                           : Subdomain_index(1 + (c[0] > 0) + (c[0] > 1 && (seed % 3 == 1 || c[1] > 1)));
    });
    std::vector<Face> faces;
    std::vector<std::uint8_t> is_on_boundary;
    for(const Subdomain_interface& one : find_interfaces(start))
      for(const Face& face : one.faces) {
        faces.push_back(face);
        is_on_boundary.push_back(one.second == 0);
      }
    Working_mesh working = working_mesh(start, faces);
    const internal::Interface_curves curves(faces, start.number_of_vertices());
    const std::vector<Vec3> targets = working.points;
    const std::vector<Vertex_defect> defects(targets.size(), Vertex_defect::NONE);
    const std::vector<double> weights(faces.size(), 1);
    const internal::Sharp_features none;
    const Aspect_ratio_quality_3 quality;
    internal::Mesh_simplifier<Aspect_ratio_quality_3> simplifier(working, quality,
                                                                 internal::vertices_of_faces(faces),
                                                                 is_on_boundary, weights, targets, defects,
                                                                 none, faces.size() / 2);
    const auto before = topology_of_subdomains(start, number);
    while(simplifier(1e6, 1e6, false, 1, [] { return true; }) == 1) {
      ++removed;
      Mesh mesh = start;
      working.store(mesh);
      BOOST_TEST(topology_of_subdomains(mesh, number) == before);
      BOOST_TEST(brute_force::is_conforming(mesh));
      BOOST_TEST(brute_force::has_positive_corners(mesh));
    }
    for(Vertex_index v = 0; v < targets.size(); ++v) {
      on_curves += working.incident[v].empty() && curves.is_on_curve(v);
      corners += curves.is_corner(v);
      BOOST_TEST(!curves.is_corner(v) || !working.incident[v].empty());
    }
  }
  std::cout << removed << " vertices removed beside interfaces, " << on_curves << " of them from curves, "
            << corners << " corners stayed" << std::endl;
  BOOST_TEST_GT(removed, 300u);
  BOOST_TEST_GT(on_curves, 20u);
  BOOST_TEST_GT(corners, 20u);
}

// The features of a cube, and the vertices of its grid that are on them.
Followed_features features_of_cube(const CGAL::Polyhedral_mixed_mesh_domain_3& domain, const Mesh& grid)
{
  const internal::Surface_reference<CGAL::Polyhedral_mixed_mesh_domain_3> surface(domain);
  Followed_features followed;
  followed.features = internal::Sharp_features(surface.sharp_edges(50), 0.1);
  followed.strata.of_vertices.assign(grid.number_of_vertices(), internal::free_stratum);
  const auto& polylines = followed.features.polylines();
  BOOST_TEST_EQ(polylines.size(), 12u);
  for(std::size_t i = 0; i < polylines.size(); ++i) {
    std::map<double, Vertex_index> along;
    for(Vertex_index v = 0; v < grid.number_of_vertices(); ++v) {
      const Vec3 p = to_vec3(grid.point(v));
      const auto closest = polylines[i].closest(p);
      if(norm(closest.point - p) < 1e-12) {
        along[closest.length] = v;
        followed.strata.of_vertices[v] = Stratum(internal::first_sharp_stratum + i);
      }
    }
    for(auto next = along.begin(), last = next++; next != along.end(); last = next++)
      followed.strata.edges[std::minmax(last->second, next->second)] = Stratum(internal::first_sharp_stratum
                                                                               + i);
  }
  for(std::size_t c = 0; c < followed.features.corners().size(); ++c)
    for(Vertex_index v = 0; v < grid.number_of_vertices(); ++v)
      if(norm(to_vec3(grid.point(v)) - followed.features.corners()[c]) < 1e-12)
        followed.strata.of_vertices[v] = Stratum(internal::first_sharp_stratum + polylines.size() + c);
  return followed;
}

bool simplify(Core_mesh& mesh, Followed_features& followed, const internal::Any_surface& surface,
              std::size_t number, double& bound)
{
  return internal::simplify(mesh, followed, surface, Aspect_ratio_quality_3(), number, 0, 0.1, bound,
                            {true, true, 0.1, 3.2, true}, [] { return true; });
}

// A cube keeps all of its sharp edges, and its volume: its faces are flat. Meshes of fewer vertices have no
// vertex that those of more do not have.
void test_cube()
{
  const Test_surface cube = box(Test_point(0, 0, 0), Test_point(1, 1, 1));
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(cube);
  const internal::Surface_reference<CGAL::Polyhedral_mixed_mesh_domain_3> surface(domain);
  Mesh start = grid(10, TETRAHEDRON);
  distort(start, 0.01, 1);
  std::set<std::array<double, 3>> last;
  double bound = 3.2;
  for(std::size_t n : {900, 600, 300, 250}) {
    Core_mesh mesh = internal::as_core_mesh(start), again = mesh;
    Followed_features followed = features_of_cube(domain, start), followed_again = followed;
    BOOST_TEST(simplify(mesh, followed, surface, n, bound));
    BOOST_TEST_EQ(mesh.number_of_vertices(), n);
    BOOST_TEST(find_defects(mesh).none());
    BOOST_TEST_LE(std::abs(volume(mesh) - 1), 1e-12);
    double length = 0;
    for(const auto& [edge, stratum] : followed.strata.edges)
      length += norm(to_vec3(mesh.point(edge.first)) - to_vec3(mesh.point(edge.second)));
    BOOST_TEST_LE(std::abs(length - 12), 1e-12);
    std::set<std::array<double, 3>> points;
    for(const auto& p : mesh.points())
      points.insert({p.x(), p.y(), p.z()});
    BOOST_TEST(last.empty() || std::includes(last.begin(), last.end(), points.begin(), points.end()));
    last = points;
    BOOST_TEST(simplify(again, followed_again, surface, n, bound));
    BOOST_TEST(again.points() == mesh.points());
    BOOST_TEST(followed_again.strata.edges == followed.strata.edges);
  }
  Core_mesh mesh = internal::as_core_mesh(start);
  Followed_features followed = features_of_cube(domain, start);
  BOOST_TEST(!simplify(mesh, followed, surface, 3, bound));
  BOOST_TEST(find_defects(mesh).none());
}

int run(int, char*[])
{
  test_quadric();
  test_sharp_edges_stay();
  test_interfaces_stay();
  test_cube();
  return boost::report_errors();
}

} // namespace test_fitting_simplification
