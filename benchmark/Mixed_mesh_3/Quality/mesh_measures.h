// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures of a mesh compared with its surface and with the region of finer elements. The measures are
// independent of the way in which the mesh was made: programs that compare meshers share them.

#ifndef MIXED_MESH_3_BENCHMARK_MESH_MEASURES_H
#define MIXED_MESH_3_BENCHMARK_MESH_MEASURES_H

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include "core/resources.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/boundary_to_face_graph.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace Mesh_measures {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Side_of_surface = CGAL::Side_of_triangle_mesh<Surface, Kernel>;
using Tree = Side_of_surface::AABB_tree; // its traits have another name in each CGAL version
using CGAL::Mixed_meshes_3::Vec3;

template <class P>
Point to_point(const P& p)
{
  const Vec3 q = CGAL::Mixed_meshes_3::to_vec3(p);
  return {q[0], q[1], q[2]};
}

/// A sample of a surface, and its distance from the other surface.
struct Sample
{
  Point point;
  double weight; ///< area
  double distance = 0;
};

inline const Tree& build(Tree& tree, const Surface& surface)
{
  tree.insert(faces(surface).begin(), faces(surface).end(), surface);
  tree.build();
  tree.accelerate_distance_queries();
  return tree;
}

inline std::array<Point, 3> triangle_points(const Surface& surface, Surface::Face_index f)
{
  const auto h = surface.halfedge(f);
  return {surface.point(surface.source(h)), surface.point(surface.target(h)),
          surface.point(surface.target(surface.next(h)))};
}

/// The vertices of a surface and a regular grid on each of its triangles, with `step` between points along
/// the longest edge at most. \pre the surface is triangulated
inline std::vector<Sample> samples(const Surface& surface, double step)
{
  std::vector<Sample> result;
  for(const Surface::Face_index f : faces(surface)) {
    const auto [a, b, c] = triangle_points(surface, f);
    const double longest = std::sqrt(
      (std::max)({CGAL::squared_distance(a, b), CGAL::squared_distance(b, c), CGAL::squared_distance(c, a)}));
    const int n = (std::max)(1, int(std::ceil(longest / step)));
    const double weight = std::sqrt(CGAL::squared_area(a, b, c)) / (0.5 * (n + 1) * (n + 2));
    for(int i = 0; i <= n; ++i)
      for(int j = 0; i + j <= n; ++j)
        result.push_back({a + double(i) / n * (b - a) + double(j) / n * (c - a), weight});
  }
  return result;
}

inline void measure_distances(std::vector<Sample>& samples, const Tree& tree)
{
  Point hint = samples.empty() ? Point(0, 0, 0) : tree.closest_point(samples.front().point);
  for(Sample& s : samples) { // neighbors follow each other: the last answer is a good start
    hint = tree.closest_point(s.point, hint);
    s.distance = std::sqrt(CGAL::squared_distance(s.point, hint));
  }
}

/// The boundary of a mesh as a set of triangles that do not share vertices; a quadrilateral as the four
/// triangles around the center of its bilinear patch.
template <class Mesh>
Surface boundary_triangles(const Mesh& mesh)
{
  namespace mm3 = CGAL::Mixed_meshes_3;
  Surface result;
  const auto add = [&result](const Point& a, const Point& b, const Point& c) {
    result.add_face(result.add_vertex(a), result.add_vertex(b), result.add_vertex(c));
  };
  for(const auto& face : mm3::boundary_faces(mesh)) {
    const auto& v = face.vertices();
    std::array<Point, 4> p;
    const int size = v.size();
    for(int i = 0; i < size; ++i)
      p[i] = to_point(mesh.point(v[i]));
    if(size == 3) {
      add(p[0], p[1], p[2]);
    } else {
      const Point center = CGAL::centroid(p[0], p[1], p[2], p[3]);
      for(int i = 0; i < 4; ++i)
        add(p[i], p[(i + 1) % 4], center);
    }
  }
  return result;
}

template <class Mesh>
std::vector<Sample> boundary_vertices(const Mesh& mesh)
{
  std::vector<Sample> result;
  for(const auto v : CGAL::Mixed_meshes_3::boundary_vertices(mesh))
    result.push_back({to_point(mesh.point(v)), 0});
  return result;
}

/// The number of shells, and the Euler characteristic.
inline std::array<std::ptrdiff_t, 2> shells_and_characteristic(Surface surface)
{
  const auto ids = surface.add_property_map<Surface::Face_index, std::size_t>("f:shell", 0).first;
  return {std::ptrdiff_t(CGAL::Polygon_mesh_processing::connected_components(surface, ids)),
          std::ptrdiff_t(surface.number_of_vertices()) - std::ptrdiff_t(surface.number_of_edges())
            + std::ptrdiff_t(surface.number_of_faces())};
}

/// Whether the boundary has as many shells as the surface, and its Euler characteristic; pairs of its
/// triangles that intersect, a quadrilateral being four. If it is no manifold, nothing is counted.
template <class Mesh>
nlohmann::ordered_json measure_boundary(const Mesh& mesh, const Surface& surface)
{
  Surface boundary;
  if(!CGAL::boundary_to_face_graph(mesh, boundary))
    return {{"same topology", false}, {"self-intersections", nullptr}};
  const bool is_same = shells_and_characteristic(boundary) == shells_and_characteristic(surface);
  const std::vector<Surface::Face_index> faces(boundary.faces().begin(), boundary.faces().end());
  for(const Surface::Face_index f : faces) {
    const auto h = boundary.halfedge(f);
    std::vector<Point> p;
    for(const auto v : boundary.vertices_around_face(h))
      p.push_back(boundary.point(v));
    if(p.size() == 4) {
      const auto center = CGAL::Euler::add_center_vertex(h, boundary);
      boundary.point(boundary.target(center)) = CGAL::centroid(p[0], p[1], p[2], p[3]);
    }
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(boundary, std::back_inserter(pairs));
  return {{"same topology", is_same}, {"self-intersections", pairs.size()}};
}

/// The smallest and the largest dihedral angle of all elements, in degrees. Faces that are not plane have
/// different angles at the two ends of an edge; angles of inverted corners are above 180 degrees.
template <class Mesh>
std::array<double, 2> dihedral_angles(const Mesh& mesh)
{
  using namespace CGAL::Mixed_meshes_3::internal;
  constexpr double degrees = 57.29577951308232;
  std::array<double, 2> range{360, 0};
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const auto element = mesh.element(e);
    const auto& reference = element.reference();
    const auto p = element_points(mesh, element);
    // The outer normal of face f at its vertex v, and in `next` the vertex after v; none if v is not one.
    const auto normal = [&](int f, int v, int& next) {
      const auto& face = reference.faces[f];
      for(int i = 0; i < face.size; ++i)
        if(face.vertices[i] == v) {
          next = face.vertices[(i + 1) % face.size];
          return cross(p[next] - p[v], p[face.vertices[(i + face.size - 1) % face.size]] - p[v]);
        }
      return Vec3{};
    };
    // Face f leaves v along the edge to `next`; the face beyond that edge enters v along it.
    for(int v = 0; v < element.size(); ++v)
      for(int f = 0; f < reference.number_of_faces; ++f) {
        int next = -1;
        const Vec3 n = normal(f, v, next);
        for(int g = 0; next >= 0 && g < reference.number_of_faces; ++g) {
          const auto& face = reference.faces[g];
          for(int i = 0; i < face.size; ++i)
            if(face.vertices[i] == next && face.vertices[(i + 1) % face.size] == v) {
              int ignored = -1;
              const Vec3 m = normal(g, v, ignored), edge = p[next] - p[v];
              const double angle = 180
                                   - degrees * std::atan2(determinant(n, m, edge) / norm(edge), dot(n, m));
              range = {(std::min)(range[0], angle), (std::max)(range[1], angle)};
            }
        }
      }
  }
  return range;
}

/// Elements that are not proved valid, and the work of a solver: the entries of the stiffness matrix, and the
/// time of a factorization, with the lower 30 % of the boundary fixed.
template <class Mesh>
nlohmann::ordered_json measure_for_elasticity(const Mesh& mesh)
{
  namespace mm3 = CGAL::Mixed_meshes_3;
  std::size_t invalid = 0;
  std::vector<std::array<mm3::Vertex_index, 2>> pairs;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    invalid += mm3::jacobian_sign(mesh, mm3::Element_index(e)) != mm3::Jacobian_sign::POSITIVE;
    const auto element = mesh.element(mm3::Element_index(e));
    for(const mm3::Vertex_index a : element)
      for(const mm3::Vertex_index b : element)
        if(a < b)
          pairs.push_back({a, b});
  }
  std::sort(pairs.begin(), pairs.end());
  const auto end = std::unique(pairs.begin(), pairs.end());
  nlohmann::ordered_json line;
  line["elements not proved valid"] = invalid;
  line["nonzeros"] = 9 * (mesh.number_of_vertices() + 2 * std::size_t(end - pairs.begin()));
  // Above this number a factorization takes minutes, and more memory than most machines have.
  constexpr std::size_t most_factored = 60000;
  if(invalid != 0 || mesh.number_of_vertices() > most_factored)
    return line;
  CGAL::Linear_elasticity_3<Mesh> elasticity(mesh);
  CGAL::Bbox_3 box;
  for(const auto& p : mesh.points())
    box += p.bbox();
  for(const mm3::Vertex_index v : mm3::boundary_vertices(mesh))
    if(mesh.point(v).z() < box.zmin() + 0.3 * box.z_span())
      elasticity.prescribe(v);
  const std::clock_t start = std::clock();
  if(elasticity.factor().is_success())
    line["CPU seconds of factorization"] = double(std::clock() - start) / CLOCKS_PER_SEC;
  return line;
}

/// The places farthest away, far from each other: x, y, z, distance.
inline nlohmann::ordered_json farthest_places(std::vector<Sample> samples, std::size_t number, double apart)
{
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.distance > b.distance; });
  std::vector<Sample> places;
  for(auto s = samples.begin(); s != samples.end() && places.size() < number; ++s)
    if(std::none_of(places.begin(), places.end(), [&](const Sample& t) {
         return CGAL::squared_distance(s->point, t.point) < apart * apart;
       }))
      places.push_back(*s);
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for(const Sample& s : places)
    result.push_back({s.point.x(), s.point.y(), s.point.z(), s.distance});
  return result;
}

inline double largest_distance(const std::vector<Sample>& samples)
{
  double largest = 0;
  for(const Sample& s : samples)
    largest = (std::max)(largest, s.distance);
  return largest;
}

/*!
All measures of a mesh, by name.

Distances are between the domain's surface and the boundary of the mesh, from samples at most `step`
apart (see `samples()`) to the other surface, exactly; the sampling misses less than `step`. Vertices on
the region's surface count as inside it.

\param mesh a `CGAL::Mixed_mesh_3`
\param surface, region_surface the domain's and the region's surface. \pre closed and triangulated
\param step step of the samples, in the unit of the surface; 1 is meant for millimeters
*/
template <class Mesh>
nlohmann::ordered_json measure(const Mesh& mesh, const Surface& surface, const Surface& region_surface,
                               double step = 1)
{
  namespace mm3 = CGAL::Mixed_meshes_3;
  nlohmann::ordered_json line;
  line["vertices"] = mesh.number_of_vertices();
  line["elements"] = mesh.number_of_elements();

  // Numbers and places of vertices.
  const Side_of_surface side_of_region(region_surface);
  std::vector<char> is_in_region;
  for(const auto& p : mesh.points())
    is_in_region.push_back(side_of_region(to_point(p)) != CGAL::ON_UNBOUNDED_SIDE);
  line["share of vertices in region"] = double(std::count(is_in_region.begin(), is_in_region.end(), 1))
                                        / double(is_in_region.size());
  std::vector<std::array<mm3::Vertex_index, 2>> edges;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const auto element = mesh.element(e);
    for(int i = 0; i < element.reference().number_of_edges; ++i) {
      const auto& edge = element.reference().edges[i];
      const mm3::Vertex_index a = element[edge[0]], b = element[edge[1]];
      if(is_in_region[a] && is_in_region[b])
        edges.push_back({(std::min)(a, b), (std::max)(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  double sum = 0;
  for(const auto& [a, b] : edges)
    sum += std::sqrt(CGAL::squared_distance(to_point(mesh.point(a)), to_point(mesh.point(b))));
  line["mean edge in region"] = edges.empty() ? 0 : sum / double(edges.size());

  // Shape.
  const Surface boundary = boundary_triangles(mesh);
  Tree surface_tree, boundary_tree;
  build(surface_tree, surface);
  build(boundary_tree, boundary);
  std::vector<Sample> of_surface = samples(surface, step), of_boundary = samples(boundary, step),
                      vertices = boundary_vertices(mesh);
  measure_distances(of_surface, boundary_tree);
  measure_distances(of_boundary, surface_tree);
  measure_distances(vertices, surface_tree);
  const double there = largest_distance(of_surface), back = largest_distance(of_boundary);
  line["Hausdorff"] = (std::max)(there, back);
  line["Hausdorff surface to mesh"] = there;
  line["Hausdorff mesh to surface"] = back;
  line["boundary vertices to surface"] = largest_distance(vertices);
  double area = 0, distances = 0;
  for(const Sample& s : of_surface)
    if(side_of_region(s.point) == CGAL::ON_UNBOUNDED_SIDE) {
      area += s.weight;
      distances += s.weight * s.distance;
    }
  line["mean distance outside region"] = area > 0 ? distances / area : 0;
  const double volume = mm3::volume(mesh);
  line["volume"] = volume;
  line["volume ratio"] = volume / CGAL::to_double(CGAL::Polygon_mesh_processing::volume(surface));

  line.update(measure_boundary(mesh, surface));

  // Elements.
  const auto rows = mm3::quality_statistics(mesh);
  line["ARC mean"] = rows.back().mean;
  line["ARC max"] = rows.back().maximum;
  line["ARC share at most 7"] = rows.back().share;
  for(const mm3::Element_kind kind : mm3::element_kinds) {
    const auto& row = rows[kind];
    if(row.count != 0)
      line["kinds"][mm3::reference_elements[kind].plural] = {{"count", row.count},
                                                             {"ARC mean", row.mean},
                                                             {"ARC max", row.maximum}};
  }
  const auto [smallest, largest] = dihedral_angles(mesh);
  line["smallest dihedral angle"] = smallest;
  line["largest dihedral angle"] = largest;

  line.update(measure_for_elasticity(mesh));
  line["farthest, surface to mesh"] = farthest_places(of_surface, 5, 20 * step);
  line["farthest, mesh to surface"] = farthest_places(of_boundary, 5, 20 * step);
  return line;
}

/// Ends a program: adds the measures to a line if wanted, writes the mesh if a file is given, prints the
/// line.
template <class Mesh>
void finish(nlohmann::ordered_json line, const Mesh& mesh, const Surface& surface, const Surface& region,
            bool only_time, const std::string& output_file, double step = 1)
{
  if(!only_time)
    line.update(measure(mesh, surface, region, step));
  if(!output_file.empty())
    require([&](std::string* error) {
      return CGAL::Mixed_meshes_3::IO::write_mixed_mesh(output_file, mesh, {}, error);
    });
  std::cout << line << '\n';
}

} // namespace Mesh_measures

#endif // MIXED_MESH_3_BENCHMARK_MESH_MEASURES_H
