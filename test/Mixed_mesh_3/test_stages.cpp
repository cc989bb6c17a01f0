// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages between the octree and the mesh, each against an oracle that shares no code with it:
// exact rationals for the frames of the cells, brute force for the surface queries, integers for
// volumes and orientations. And the checkers, on meshes with one defect each.

#include "test_surfaces.h"

#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Mixed_mesh_3/internal/boundary/Boundary_stage.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/octree/place_lattice.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Mixed_mesh_regions_3.h>

#include <CGAL/Exact_rational.h>

#include <boost/core/lightweight_test.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Bbox_3;
using CGAL::Bounded_side;
using CGAL::Everywhere_mixed_mesh_region_3;
using CGAL::Polyhedral_mixed_mesh_domain_3;
using CGAL::Mixed_meshes_3::internal::Boundary_pieces;
using CGAL::Mixed_meshes_3::internal::Boundary_polygon;
using CGAL::Mixed_meshes_3::internal::Lattice_mesh;
using CGAL::Mixed_meshes_3::internal::Located_octree;
using CGAL::Mixed_meshes_3::internal::Manifold_defects;
using CGAL::Mixed_meshes_3::internal::Octree;
using CGAL::Mixed_meshes_3::internal::apply_transitions;
using CGAL::Mixed_meshes_3::internal::assemble_mesh;
using CGAL::Mixed_meshes_3::internal::manifold_defects;
using CGAL::Mixed_meshes_3::internal::split_boundary;
using CGAL::Mixed_meshes_3::internal::split_element;

using Kernel = Predicates_kernel;
using Point_3 = Kernel::Point_3;
using Triangle_3 = Kernel::Triangle_3;
using Surface = CGAL::Surface_mesh<Point_3>;
using Aligned_traits = Axis_aligned_octree_cell_traits_3;
using Rotated_traits = Rotated_octree_cell_traits_3;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

// ---- cell traits -------------------------------------------------------------------------------

using Exact = CGAL::Exact_rational;
using Exact_vector = std::array<Exact, 3>;

Exact_vector exact(const Point_3& p) { return {Exact(p.x()), Exact(p.y()), Exact(p.z())}; }
Exact_vector operator-(const Exact_vector& a, const Exact_vector& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Exact dot(const Exact_vector& a, const Exact_vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The lattice as an affine frame, in rationals: an origin and the images of the unit vectors.
struct Frame
{
  Exact_vector origin;
  std::array<Exact_vector, 3> units;

  template <class Traits>
  explicit Frame(const Traits& traits) : origin(exact(traits.point({0, 0, 0})))
  {
    units[0] = exact(traits.point({1, 0, 0})) - origin;
    units[1] = exact(traits.point({0, 1, 0})) - origin;
    units[2] = exact(traits.point({0, 0, 1})) - origin;
  }

  // Lattice coordinates of any point; the frame is orthogonal.
  Exact_vector coordinates(const Exact_vector& p) const
  {
    Exact_vector c;
    for(int k = 0; k < 3; ++k)
      c[k] = dot(p - origin, units[k]) / dot(units[k], units[k]);
    return c;
  }
};

// Whether the closed triangle meets the closed cell: clips it, in rationals.
bool exactly_intersect(const Frame& frame, const Lattice_point& corner, std::uint32_t side,
                       const Triangle_3& t)
{
  std::vector<Exact_vector> polygon;
  for(int i = 0; i < 3; ++i)
    polygon.push_back(frame.coordinates(exact(t[i])));
  for(int k = 0; k < 3; ++k)
    for(int sign : {1, -1}) {
      const Exact bound = sign > 0 ? Exact(corner[k]) : Exact(corner[k] + side);
      std::vector<Exact_vector> clipped;
      for(std::size_t i = 0; i < polygon.size(); ++i) {
        const Exact_vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const Exact da = sign * (a[k] - bound), db = sign * (b[k] - bound);
        if(da >= 0)
          clipped.push_back(a);
        if((da > 0 && db < 0) || (da < 0 && db > 0)) {
          const Exact s = da / (da - db);
          clipped.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]),
                             a[2] + s * (b[2] - a[2])});
        }
      }
      polygon = std::move(clipped);
    }
  return !polygon.empty();
}

template <class Traits>
void test_lattice(const Traits& traits)
{
  std::mt19937 random(17);
  const Frame frame(traits);
  // Every lattice point is where it should be, without rounding.
  for(int repeat = 0; repeat < 300; ++repeat) {
    Lattice_point p;
    for(std::uint32_t& c : p)
      c = std::uint32_t(repeat < 8 ? Octree::root_side * (random() % 2)
                                   : random() % (Octree::root_side + 1));
    const Exact_vector q = exact(traits.point(p));
    for(int k = 0; k < 3; ++k)
      BOOST_TEST(q[k] == frame.origin[k] + p[0] * frame.units[0][k] + p[1] * frame.units[1][k]
                           + p[2] * frame.units[2][k]);
  }
  // Orthogonal and right-handed, so that positive elements of the lattice are positive in space.
  for(int k = 0; k < 3; ++k)
    BOOST_TEST(dot(frame.units[k], frame.units[(k + 1) % 3]) == 0);
  const auto& u = frame.units;
  BOOST_TEST(u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1])
               - u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0])
               + u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]) > 0);

  // Cells: center, box, length, and which triangles they meet; those through lattice points touch.
  for(int repeat = 0; repeat < 60; ++repeat) {
    const int level = int(random() % 6);
    const std::uint32_t side = Octree::side_at(level);
    const auto multiple = [&](std::uint32_t step) {
      return step * std::uint32_t(random() % (Octree::root_side / step));
    };
    const Lattice_point corner{multiple(side), multiple(side), multiple(side)};
    const auto cell = traits.cell(corner, side);
    BOOST_TEST(cell.center()
               == traits.point({corner[0] + side / 2, corner[1] + side / 2, corner[2] + side / 2}));
    Bbox_3 box;
    double shortest = std::numeric_limits<double>::infinity();
    const Point_3 first = traits.point(corner);
    for(std::uint32_t i = 0; i < 8; ++i) {
      const Point_3 p = traits.point({corner[0] + (i & 1) * side, corner[1] + (i >> 1 & 1) * side,
                                      corner[2] + (i >> 2) * side});
      box += p.bbox();
      if(i == 1 || i == 2 || i == 4)
        shortest = (std::min)(shortest, std::sqrt(CGAL::squared_distance(p, first)));
    }
    BOOST_TEST(cell.bbox() == box);
    BOOST_TEST_LE(std::abs(traits.length(side) - shortest), 1e-6 * shortest);
    for(int i = 0; i < 10; ++i) {
      const auto near = [&](int k) {
        const std::int64_t x = std::int64_t(corner[k]) + (std::int64_t(random() % 7) - 2) * (side / 2);
        return std::uint32_t((std::min)((std::max)(x, std::int64_t(0)),
                                        std::int64_t(Octree::root_side)));
      };
      const auto vertex = [&] {
        return i % 2 == 0 ? traits.point({near(0), near(1), near(2)})
                          : traits.point({multiple(side / 2), multiple(side / 2), multiple(side / 2)});
      };
      const Triangle_3 t(vertex(), vertex(), vertex());
      if(!t.is_degenerate())
        BOOST_TEST_EQ(cell.do_intersect(t), exactly_intersect(frame, corner, side, t));
    }
  }
}

// The root contains the points.
template <class Traits>
void test_cover(const Traits& traits, const std::vector<Point_3>& points)
{
  const Frame frame(traits);
  for(const Point_3& p : points)
    for(const Exact& c : frame.coordinates(exact(p)))
      BOOST_TEST(c >= 0 && c <= Exact(Octree::root_side));
}

void test_cell_traits()
{
  std::mt19937 random(23);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Bbox_3> boxes = {
    {0, 0, 0, 1, 1, 1}, {0.1, -0.7, 1. / 3, 1.1, 0.9, 0.7}, {-3.9, -44, -65.8, 60.1, 55, 65.79},
    {1e8, -1e8, 1e8, 1e8 + 100, -1e8 + 33, 1e8 + 7},
    {1e8, 1e8, 1e8, 1e8 + 1e-5, 1e8 + 1e-6, 1e8 + 1e-6}};
  for(int i = 0; i < 30; ++i) {
    const double offset = std::array<double, 3>{0, 1, 1e8}[i % 3];
    const double x = offset * uniform(random), y = -offset * uniform(random), z = uniform(random);
    boxes.push_back({x, y, z, x + uniform(random), y + uniform(random), z + 1});
  }
  std::size_t n = 0;
  for(const Bbox_3& b : boxes)
    for(double scale : {1., 1e-6, 1e6}) {
      const std::vector<Point_3> points = {
        {scale * b.xmin(), scale * b.ymin(), scale * b.zmin()},
        {scale * b.xmax(), scale * b.ymax(), scale * b.zmax()},
        {scale * b.xmax(), scale * b.ymin(), scale * b.zmax()},
        {scale * b.xmin(), scale * b.ymax(), scale * b.zmax()}};
      const Bbox_3 box = CGAL::bbox_3(points.begin(), points.end());
      for(Root_cell root : {Root_cell::CUBE, Root_cell::BOX}) {
        const Aligned_traits traits(box, root);
        test_cover(traits, points);
        if(n < 30)
          test_lattice(traits);
        if(root == Root_cell::CUBE) {
          const Frame frame(traits);
          for(int k = 1; k < 3; ++k)
            BOOST_TEST(dot(frame.units[0], frame.units[0]) == dot(frame.units[k], frame.units[k]));
        }
      }
      // far more extent than digits left is needed to turn a box 1e-5 small at 1e8
      const Kernel::Vector_3 axis = n % 7 == 0 ? Kernel::Vector_3(0, 0, -1)
                                               : Kernel::Vector_3(uniform(random) - 0.5,
                                                                  uniform(random) - 0.5,
                                                                  uniform(random) - 0.5);
      const Rotated_traits traits(points, axis);
      test_cover(traits, points);
      if(n < 30)
        test_lattice(traits);
      const Frame frame(traits);
      for(int k = 1; k < 3; ++k)
        BOOST_TEST(dot(frame.units[0], frame.units[0]) == dot(frame.units[k], frame.units[k]));
      const Kernel::Vector_3 third = traits.point({0, 0, Octree::root_side})
                                     - traits.point({0, 0, 0});
      BOOST_TEST_GT(axis * third / std::sqrt(axis.squared_length() * third.squared_length()),
                    std::cos(3 * CGAL_PI / 180));
      ++n;
    }
}

// ---- surfaces ----------------------------------------------------------------------------------

void add_box(Surface& s, const Bbox_3& b)
{
  ::add_box(s, {b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()});
}

Bbox_3 bbox_of(const Surface& s) { return CGAL::bbox_3(s.points().begin(), s.points().end()); }

// ---- domain oracle -----------------------------------------------------------------------------

using Side_function = std::function<Bounded_side(const Point_3&)>;

std::size_t number_on_surface = 0, number_of_boundary_cells = 0;

template <class Traits>
void walk(const Polyhedral_mixed_mesh_domain_3& domain, const Surface& surface, const Traits& traits,
          const Side_function& side_of, int depth, const Lattice_point& corner, std::uint32_t side,
          const Polyhedral_mixed_mesh_domain_3::Surface_part& parent)
{
  const auto cell = traits.cell(corner, side);
  Polyhedral_mixed_mesh_domain_3::Surface_part part;
  const Bounded_side located = domain.locate(cell, parent, part);
  std::vector<std::uint32_t> met;
  for(auto f : faces(surface)) {
    const auto h = surface.halfedge(f);
    const Triangle_3 t(surface.point(surface.source(h)), surface.point(surface.target(h)),
                       surface.point(surface.target(surface.next(h))));
    if(cell.do_intersect(t))
      met.push_back(std::uint32_t(f));
  }
  BOOST_TEST_EQ(located, met.empty() ? side_of(cell.center()) : CGAL::ON_BOUNDARY);
  BOOST_TEST(part.facets == met);

  // all points that the stages ask for: corners, midpoints, centers, and some others
  const std::uint32_t half = side / 2;
  for(std::uint32_t i = 0; i < 27; ++i) {
    const Point_3 p = traits.point({corner[0] + i % 3 * half, corner[1] + i / 3 % 3 * half,
                                    corner[2] + i / 9 * half});
    const Bounded_side expected = side_of(p);
    number_on_surface += expected == CGAL::ON_BOUNDARY;
    BOOST_TEST_EQ(domain.bounded_side(p, part), expected);
    BOOST_TEST_EQ(domain.bounded_side(p), expected);
    if(i % 13 == 0) {
      const Point_3 q = domain.closest_point(p, part);
      double nearest = std::numeric_limits<double>::infinity();
      for(auto f : faces(surface)) {
        const auto h = surface.halfedge(f);
        const Triangle_3 t(surface.point(surface.source(h)), surface.point(surface.target(h)),
                           surface.point(surface.target(surface.next(h))));
        nearest = (std::min)(nearest, std::sqrt(CGAL::squared_distance(p, t)));
      }
      const double tolerance = 1e-12 * nearest + 1e-15 * std::sqrt((p - CGAL::ORIGIN).squared_length());
      BOOST_TEST_LE(std::abs(std::sqrt(CGAL::squared_distance(p, q)) - nearest), tolerance);
      const Point_3 without_hint = domain.closest_point(p, Polyhedral_mixed_mesh_domain_3::Surface_part());
      BOOST_TEST_LE(std::abs(std::sqrt(CGAL::squared_distance(p, without_hint)) - nearest), tolerance);
      // a hint from elsewhere, and none
      for(const Point_3& r : {domain.closest_point(p, surface.point(Surface::Vertex_index(i % 6))),
                              domain.closest_point(p)})
        BOOST_TEST_LE(std::abs(std::sqrt(CGAL::squared_distance(p, r)) - nearest), tolerance);
    }
  }
  if(located != CGAL::ON_BOUNDARY)
    return;
  ++number_of_boundary_cells;
  if(depth > 0)
    for(std::uint32_t i = 0; i < 8; ++i)
      walk(domain, surface, traits, side_of, depth - 1,
           {corner[0] + (i & 1) * half, corner[1] + (i >> 1 & 1) * half, corner[2] + (i >> 2) * half},
           half, part);
}

template <class Traits>
void test_oracle(const Surface& surface, const Traits& traits, const Side_function& side_of, int depth)
{
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  BOOST_TEST_EQ(domain.number_of_facets(), num_faces(surface));
  walk(domain, surface, traits, side_of, depth, {0, 0, 0}, Octree::root_side, domain.surface_part());
}

Bounded_side side_of_box(const Bbox_3& b, const Point_3& p)
{
  if(p.x() < b.xmin() || p.x() > b.xmax() || p.y() < b.ymin() || p.y() > b.ymax()
     || p.z() < b.zmin() || p.z() > b.zmax())
    return CGAL::ON_UNBOUNDED_SIDE;
  return p.x() == b.xmin() || p.x() == b.xmax() || p.y() == b.ymin() || p.y() == b.ymax()
             || p.z() == b.zmin() || p.z() == b.zmax()
           ? CGAL::ON_BOUNDARY
           : CGAL::ON_BOUNDED_SIDE;
}

void test_domain_oracle()
{
  // A box with a cavity, all facets on faces of cells: every query is degenerate. The sides are
  // known without CGAL.
  const Bbox_3 outer(0, 0, 0, 8, 8, 8), cavity(2, 2, 4, 6, 4, 6);
  Surface box;
  add_box(box, outer);
  add_box(box, cavity);
  const Side_function side_of_box_with_cavity = [&](const Point_3& p) {
    const Bounded_side a = side_of_box(outer, p), b = side_of_box(cavity, p);
    return a != CGAL::ON_BOUNDED_SIDE ? a : Bounded_side(-int(b));
  };
  test_oracle(box, Aligned_traits(bbox_of(box), Root_cell::BOX), side_of_box_with_cavity, 2);
  BOOST_TEST_GT(number_on_surface, 1000u);
  test_oracle(box, Aligned_traits(bbox_of(box), Root_cell::CUBE), side_of_box_with_cavity, 2);

  // An octahedron: its edges and vertices and the inside of its facets meet lattice points.
  Surface octahedron;
  add_sphere(octahedron, {1, 2, 3}, 2, 2);
  const std::size_t before = number_on_surface;
  test_oracle(octahedron, Aligned_traits(bbox_of(octahedron), Root_cell::BOX),
              [](const Point_3& p) {
                const double d = std::abs(p.x() - 1) + std::abs(p.y() - 2) + std::abs(p.z() - 3);
                return d < 2 ? CGAL::ON_BOUNDED_SIDE
                             : d > 2 ? CGAL::ON_UNBOUNDED_SIDE : CGAL::ON_BOUNDARY;
              }, 3);
  BOOST_TEST_GT(number_on_surface, before + 1000);

  // A round surface, two components, rotated cells, far away and large: against CGAL.
  for(double offset : {0., 1e8}) {
    Surface spheres;
    add_sphere(spheres, {offset, 0, -offset}, 1000, 6);
    add_sphere(spheres, {offset + 2200, 100, -offset}, 900, 5);
    const CGAL::Side_of_triangle_mesh<Surface, Kernel> side_of(spheres);
    const auto ask = [&](const Point_3& p) { return side_of(p); };
    test_oracle(spheres, Aligned_traits(bbox_of(spheres)), ask, 2);
    test_oracle(spheres, Rotated_traits(spheres.points(), Kernel::Vector_3(1, -2, 0.5)), ask, 2);
  }
  BOOST_TEST_GT(number_of_boundary_cells, 300u);
}

// No point of the surface is far from all samples, and they are on the surface.
void test_surface_samples()
{
  Surface thin; // long triangles
  add_box(thin, Bbox_3(0, 0, 0, 100, 1, 7));
  Surface sphere;
  add_sphere(sphere, {1, 2, 3}, 2, 12);
  std::mt19937 random(41);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t last = 0;
  for(const Surface& surface : {thin, sphere}) {
    const Polyhedral_mixed_mesh_domain_3 domain(surface);
    for(double spacing : {1000., 3., 0.7}) {
      const std::vector<Point_3> samples = domain.surface_samples(spacing);
      for(const Point_3& p : samples)
        BOOST_TEST_LE(CGAL::squared_distance(p, domain.closest_point(p)), 1e-20);
      for(auto v : surface.vertices())
        BOOST_TEST(std::count(samples.begin(), samples.end(), surface.point(v)) == 1);
      double farthest = 0; // of all points, squared
      for(auto f : faces(surface))
        for(int i = 0; i < 40; ++i) {
          const auto h = surface.halfedge(f);
          const Point_3 a = surface.point(surface.source(h)), b = surface.point(surface.target(h)),
                        c = surface.point(surface.target(surface.next(h)));
          const double u = uniform(random), v = uniform(random) * (1 - u);
          const Point_3 p = a + u * (b - a) + v * (c - a);
          double nearest = std::numeric_limits<double>::infinity();
          for(const Point_3& q : samples)
            nearest = (std::min)(nearest, CGAL::squared_distance(p, q));
          farthest = (std::max)(farthest, nearest);
        }
      BOOST_TEST_LE(farthest, spacing * spacing);
      BOOST_TEST(spacing > 100 ? samples.size() == surface.number_of_vertices() : samples.size() >= last);
      BOOST_TEST(spacing > 1 || samples.size() > surface.number_of_vertices());
      last = samples.size();
    }
  }
}

// ---- a domain made of labels -------------------------------------------------------------------

using Analytic_octree =
  Located_octree<Analytic_domain, Everywhere_mixed_mesh_region_3, Aligned_traits>;

Analytic_octree random_octree(const Analytic_domain& domain, const Aligned_traits& traits,
                              unsigned seed, int base_level, int rounds, unsigned one_in = 12)
{
  static const Everywhere_mixed_mesh_region_3 region;
  std::mt19937 random(seed);
  Analytic_octree octree(domain, region, traits);
  for(int level = 0; level < base_level; ++level)
    octree.refine(octree.leaves_to_refine(level, false));
  for(int round = 0; round < rounds; ++round) {
    std::vector<Octree::Node_index> chosen;
    for(int level = 0; level < 7; ++level)
      for(Octree::Node_index n : octree.leaves_to_refine(level, true))
        if(random() % one_in == 0)
          chosen.push_back(n);
    octree.refine(chosen);
  }
  return octree;
}

// ---- integers ----------------------------------------------------------------------------------

using Integer = boost::multiprecision::int128_t;

Integer determinant(const Lattice_point& a, const Lattice_point& b, const Lattice_point& c,
                    const Lattice_point& d)
{
  Integer m[3][3];
  const Lattice_point* rows[3] = {&b, &c, &d};
  for(int i = 0; i < 3; ++i)
    for(int k = 0; k < 3; ++k)
      m[i][k] = std::int64_t((*rows[i])[k]) - std::int64_t(a[k]);
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
         - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
         + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Six times the volume; quadrilaterals are planar here.
Integer six_volume(const std::vector<Lattice_point>& points, const Element_view& element)
{
  Integer sum = 0;
  for(int f = 0; f < element.reference().number_of_faces; ++f) {
    const Element_face& face = element.reference().faces[f];
    for(int i = 2; i < face.size; ++i)
      sum -= determinant(points[element[face.vertices[0]]], points[element[face.vertices[i - 1]]],
                         points[element[face.vertices[i]]], points[element[0]]);
  }
  return sum;
}

bool is_positive(const std::vector<Lattice_point>& points, const Element_view& element)
{
  for(int c = 0; c < element.reference().number_of_corners; ++c) {
    const auto& i = element.reference().corners[c];
    if(determinant(points[element[i[0]]], points[element[i[1]]], points[element[i[2]]],
                   points[element[i[3]]]) <= 0)
      return false;
  }
  return true;
}

struct Faces
{
  std::vector<Boundary_polygon> boundary; // of one element only
  std::size_t nonconforming = 0;          // of more than two, or of two with the same orientation
};

// With a map, as plainly as possible.
Faces faces_of(const Element_list& elements)
{
  std::map<std::vector<Vertex_index>, std::vector<std::vector<Vertex_index>>> faces;
  for(std::size_t e = 0; e < elements.size(); ++e)
    for(int f = 0; f < elements[e].reference().number_of_faces; ++f) {
      const Element_face& face = elements[e].reference().faces[f];
      std::vector<Vertex_index> v;
      for(int i = 0; i < face.size; ++i)
        v.push_back(elements[e][face.vertices[i]]);
      std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
      std::vector<Vertex_index> key = v;
      std::sort(key.begin(), key.end());
      faces[key].push_back(v);
    }
  Faces result;
  for(auto& [key, sides] : faces) {
    if(sides.size() == 1) {
      Boundary_polygon p{{}, int(key.size())};
      std::copy(sides[0].begin(), sides[0].end(), p.vertices.begin());
      result.boundary.push_back(p);
      continue;
    }
    std::reverse(sides[1].begin() + 1, sides[1].end());
    result.nonconforming += sides.size() > 2 || sides[0] != sides[1];
  }
  return result;
}

Element_list kept_elements(const Lattice_mesh& mesh, const Boundary_pieces& boundary)
{
  Element_list kept;
  for(std::size_t e = 0; e < mesh.elements.size(); ++e)
    if(!boundary.is_replaced[e])
      kept.add(mesh.elements[e].kind(), mesh.elements[e].begin());
  for(std::size_t i = 0; i < boundary.pieces.size(); ++i)
    kept.add(boundary.pieces[i].kind(), boundary.pieces[i].begin());
  return kept;
}

// ---- transitions -------------------------------------------------------------------------------

// The leaf that contains the unit cell of the lattice at p.
Octree::Node_index leaf_at(const Octree& octree, const std::array<std::int64_t, 3>& p)
{
  for(std::int64_t c : p)
    if(c < 0 || c >= Octree::root_side)
      return Octree::no_node;
  Octree::Node_index n = Octree::root();
  while(!octree.is_leaf(n)) {
    int child = 0;
    for(int k = 0; k < 3; ++k)
      child |= (p[k] >= std::int64_t(octree.corner(n)[k]) + octree.side(n) / 2) << k;
    n = octree.child(n, child);
  }
  return n;
}

bool touch(const Octree& octree, Octree::Node_index a, Octree::Node_index b)
{
  for(int k = 0; k < 3; ++k)
    if(octree.corner(a)[k] > octree.corner(b)[k] + octree.side(b)
       || octree.corner(b)[k] > octree.corner(a)[k] + octree.side(a))
      return false;
  return true;
}

void test_transitions(const Analytic_octree& located, Transition_templates_choice choice)
{
  const Octree& octree = located.octree();
  BOOST_TEST(is_balanced(octree, Adjacency::EDGE));
  const Lattice_mesh mesh = apply_transitions(located, choice);
  const std::size_t n = mesh.vertices.size();
  BOOST_TEST_EQ(mesh.cells.size(), mesh.elements.size());
  BOOST_TEST_EQ(mesh.sides.size(), n);
  BOOST_TEST_EQ(mesh.leaves.size(), n);
  BOOST_TEST_EQ(mesh.is_on_rim.size(), n);

  // Used: leaves that meet the domain, those that touch one (and some more beside refined cells).
  std::vector<Octree::Node_index> leaves, alive;
  for(Octree::Node_index m = 0; m < octree.size(); ++m)
    if(octree.is_leaf(m)) {
      leaves.push_back(m);
      if(located.is_alive(m))
        alive.push_back(m);
    }
  const std::set<Octree::Node_index> used(mesh.cells.begin(), mesh.cells.end());
  std::set<Lattice_point> corners;
  Integer volume_of_leaves = 0, volume_of_elements = 0;
  for(Octree::Node_index m : leaves) {
    const bool is_used = std::any_of(alive.begin(), alive.end(), [&](Octree::Node_index a) {
      return touch(octree, a, m);
    });
    BOOST_TEST(used.count(m) != 0 || !is_used);
    const Integer side = octree.side(m);
    if(used.count(m) != 0)
      volume_of_leaves += 6 * side * side * side;
    for(std::uint32_t i = 0; i < 8; ++i)
      corners.insert({octree.corner(m)[0] + (i & 1) * octree.side(m),
                      octree.corner(m)[1] + (i >> 1 & 1) * octree.side(m),
                      octree.corner(m)[2] + (i >> 2) * octree.side(m)});
  }

  // Elements are in their leaves, positive, and fill them.
  for(Element_index e = 0; e < mesh.elements.size(); ++e) {
    BOOST_TEST(is_positive(mesh.vertices, mesh.elements[e]));
    volume_of_elements += six_volume(mesh.vertices, mesh.elements[e]);
    const Octree::Node_index m = mesh.cells[e];
    for(Vertex_index v : mesh.elements[e])
      for(int k = 0; k < 3; ++k)
        BOOST_TEST(mesh.vertices[v][k] - octree.corner(m)[k] <= octree.side(m));
  }
  BOOST_TEST_EQ(volume_of_elements, volume_of_leaves);

  // Conforming; what is on the boundary has no used leaf behind it.
  const Faces faces = faces_of(mesh.elements);
  BOOST_TEST_EQ(faces.nonconforming, 0u);
  std::set<Vertex_index> on_boundary;
  for(const Boundary_polygon& p : faces.boundary) {
    std::array<std::int64_t, 3> sum{};
    int axis = -1;
    for(int k = 0; k < 3; ++k) {
      bool is_flat = true;
      for(int i = 0; i < p.size; ++i) {
        sum[k] += mesh.vertices[p.vertices[i]][k];
        is_flat = is_flat && mesh.vertices[p.vertices[i]][k] == mesh.vertices[p.vertices[0]][k];
        on_boundary.insert(p.vertices[i]);
      }
      sum[k] /= p.size;
      if(is_flat)
        axis = k;
    }
    BOOST_TEST(axis >= 0);
    if(axis < 0)
      continue;
    // outward along the axis?
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const auto x = [&](int i, int k) { return std::int64_t(mesh.vertices[p.vertices[i]][k]); };
    const bool is_upper = (x(1, b) - x(0, b)) * (x(2, c) - x(0, c))
                            > (x(1, c) - x(0, c)) * (x(2, b) - x(0, b));
    if(!is_upper)
      --sum[axis];
    const Octree::Node_index behind = leaf_at(octree, sum);
    BOOST_TEST(behind == Octree::no_node || used.count(behind) == 0);
  }

  // Vertices: no two at one place, on the rim iff on the boundary or beside an unused leaf, sides as
  // the domain says.
  std::size_t n_inserted = 0;
  std::set<Lattice_point> places;
  for(Vertex_index v = 0; v < n; ++v) {
    const Lattice_point& p = mesh.vertices[v];
    BOOST_TEST(places.insert(p).second);
    n_inserted += corners.count(p) == 0;
    bool is_on_rim = false;
    for(int i = 0; i < 8; ++i) {
      std::array<std::int64_t, 3> q;
      for(int k = 0; k < 3; ++k)
        q[k] = std::int64_t(p[k]) - 1 + (i >> k & 1);
      const Octree::Node_index m = leaf_at(octree, q);
      is_on_rim = is_on_rim || m == Octree::no_node || used.count(m) == 0;
    }
    BOOST_TEST_EQ(bool(mesh.is_on_rim[v]), is_on_rim);
    if(on_boundary.count(v) != 0)
      BOOST_TEST(is_on_rim);
    BOOST_TEST_EQ(int(mesh.sides[v]), int(located.domain().bounded_side(located.point(p))));
  }
  BOOST_TEST_EQ(n_inserted, mesh.vertices.size() - mesh.first_inserted_vertex);

  const Mesh_defects defects = find_defects(mesh);
  BOOST_TEST(defects.conforming() && defects.positive() && defects.duplicate_vertices == 0);
}

void test_all_transitions()
{
  const Aligned_traits traits({0, 0, 0, 1, 1, 1}), box({0, 0, 0, 1, 1, 0.5}, Root_cell::BOX);
  const std::vector<Analytic_domain> domains = {
    Analytic_domain(ball({0.45, 0.5, 0.55}, 0.3)),
    Analytic_domain(united(ball({0.2, 0.2, 0.2}, 0.15), ball({0.9, 0.9, 0.3}, 0.4))),
    Analytic_domain([](const Point_3&) { return 9.; })};
  unsigned seed = 0;
  for(const Analytic_domain& domain : domains)
    for(const Aligned_traits& t : {traits, box})
      for(int base_level : {1, 2}) {
        const Analytic_octree octree = random_octree(domain, t, ++seed, base_level, 3);
        test_transitions(octree, Transition_templates_choice::FEWEST_VERTICES);
        test_transitions(octree, Transition_templates_choice::CENTERED);
        BOOST_TEST_LT(
          apply_transitions(octree, Transition_templates_choice::FEWEST_VERTICES).vertices.size(),
          apply_transitions(octree, Transition_templates_choice::CENTERED).vertices.size());
      }
}

// The center of a face on the border of the root, inserted since its four edges are split, is on the
// rim like the others.
void test_inserted_on_rim()
{
  static const Everywhere_mixed_mesh_region_3 region;
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  for(double f : {9., 0.}) { // all cells inside, or all at the surface
    const Analytic_domain domain([f](const Point_3&) { return f; });
    Analytic_octree octree(domain, region, traits);
    octree.refine(octree.leaves_to_refine(0, false));
    octree.refine(octree.leaves_to_refine(1, false));
    const std::uint32_t s = Octree::side_at(2);
    std::vector<Octree::Node_index> chosen;
    for(Octree::Node_index n : octree.leaves_to_refine(2, false)) {
      const Lattice_point& c = octree.octree().corner(n);
      if(c[2] == 0 && (c[0] == s) != (c[1] == s) && c[0] <= 2 * s && c[1] <= 2 * s)
        chosen.push_back(n);
    }
    BOOST_TEST_EQ(chosen.size(), 4u);
    octree.refine(chosen);
    test_transitions(octree, Transition_templates_choice::FEWEST_VERTICES);
  }
}

// Against all pairs of leaves, on an octree that is not balanced and after.
void test_is_balanced()
{
  std::mt19937 random(31);
  for(int repeat = 0; repeat < 20; ++repeat) {
    Octree octree;
    for(int i = 0; i < 4 + repeat; ++i) {
      Octree::Node_index n = Octree::root();
      while(!octree.is_leaf(n))
        n = octree.child(n, int(random() % (repeat % 2 == 0 ? 8 : 2)));
      if(octree.level(n) < 8)
        octree.split(n);
    }
    for(int step = 0; step < 4; ++step) {
      for(int rank = 1; rank <= 3; ++rank) {
        bool expected = true;
        for(Octree::Node_index a = 0; a < octree.size(); ++a)
          for(Octree::Node_index b = 0; b < octree.size(); ++b)
            if(octree.is_leaf(a) && octree.is_leaf(b) && octree.level(a) + 1 < octree.level(b)
               && touch(octree, a, b)) {
              int contact = 0;
              for(int k = 0; k < 3; ++k)
                contact += octree.corner(a)[k] + octree.side(a) == octree.corner(b)[k]
                           || octree.corner(b)[k] + octree.side(b) == octree.corner(a)[k];
              expected = expected && contact > rank;
            }
        BOOST_TEST_EQ(is_balanced(octree, Adjacency(rank)), expected);
      }
      if(step < 3) {
        std::vector<Octree::Node_index> refined;
        for(Octree::Node_index n = 0; n < octree.size(); ++n)
          if(!octree.is_leaf(n))
            refined.push_back(n);
        internal::balance(octree, refined, Adjacency(step + 1),
                          [&](Octree::Node_index n) { octree.split(n); });
        BOOST_TEST(is_balanced(octree, Adjacency(step + 1)));
      }
    }
  }
}

// ---- the rim of the region ---------------------------------------------------------------------

// Few leaves at the rim of the region are left out: their centers are outside, but that of one of 26
// neighbors is inside. By all pairs.
void test_rim()
{
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const Analytic_domain domain([](const Point_3&) { return 9.; });
  std::size_t number_left_out = 0, number_kept_outside = 0;
  // the last one is smaller than a cell, and contains no center
  for(const auto& region : {CGAL::Ball_mixed_mesh_region_3({0.4, 0.5, 0.6}, 0.3),
                            CGAL::Ball_mixed_mesh_region_3({0, 0, 0}, 0.5),
                            CGAL::Ball_mixed_mesh_region_3({0.5, 0.5, 0.5}, 0.02)}) {
    Located_octree octree(domain, region, traits);
    for(int level = 0; level < 6; ++level) {
      std::vector<Octree::Node_index> all; // that meet the region
      for(Octree::Node_index n : octree.leaves_to_refine(level, false))
        if(octree.is_in_region(n))
          all.push_back(n);
      const auto corner = [&](Octree::Node_index n, int k) { return std::int64_t(octree.octree().corner(n)[k]); };
      const std::int64_t side = Octree::side_at(level);
      std::vector<std::uint8_t> is_core;
      for(Octree::Node_index n : all)
        is_core.push_back(region.depth(traits.cell(octree.octree().corner(n), Octree::side_at(level)).center()) >= 0);
      std::vector<Octree::Node_index> expected;
      for(std::size_t i = 0; i < all.size(); ++i) {
        bool is_at_rim = false;
        for(std::size_t j = 0; all.size() <= 4000 && !is_core[i] && j < all.size(); ++j)
          if(is_core[j]) {
            bool is_near = true;
            for(int k = 0; k < 3; ++k)
              is_near = is_near && std::abs(corner(all[i], k) - corner(all[j], k)) <= side;
            is_at_rim = is_at_rim || is_near;
          }
        number_left_out += is_at_rim;
        if(!is_at_rim) {
          expected.push_back(all[i]);
          number_kept_outside += !is_core[i];
        }
      }
      BOOST_TEST(octree.leaves_to_refine(level, true) == expected);
      BOOST_TEST_EQ(expected.empty(), all.empty());
      octree.refine(octree.leaves_to_refine(level, false));
    }
  }
  BOOST_TEST_GT(number_left_out, 500u);
  BOOST_TEST_GT(number_kept_outside, 500u); // where there are many
}

// ---- the lattice -------------------------------------------------------------------------------

// All roots contain the domain; the best ones come first.
void test_place_lattice()
{
  using internal::candidate_roots;
  using internal::best_roots;
  for(const Bbox_3& b : {Bbox_3(0, 0, 0, 1, 1, 1), Bbox_3(-3.9, -44, -65.8, 60.1, 55, 65.79),
                         Bbox_3(1e8, -1e8, 1e8, 1e8 + 100, -1e8 + 33, 1e8 + 7)}) {
    const std::vector<Bbox_3> roots = candidate_roots(b);
    BOOST_TEST(roots.front() == b);
    std::set<std::array<double, 4>> places;
    const double side = (std::max)({b.x_span(), b.y_span(), b.z_span()});
    for(const Bbox_3& r : roots) {
      BOOST_TEST(r.xmin() <= b.xmin() && r.ymin() <= b.ymin() && r.zmin() <= b.zmin());
      BOOST_TEST(r.xmax() >= b.xmax() && r.ymax() >= b.ymax() && r.zmax() >= b.zmax());
      BOOST_TEST_LE((std::max)({r.x_span(), r.y_span(), r.z_span()}), 1.26 * side);
      places.insert({r.xmin(), r.ymin(), r.zmin(), r.xmax()});
    }
    BOOST_TEST_EQ(places.size(), roots.size()); // no two are the same
  }

  std::vector<Bbox_3> roots;
  for(int i = 0; i < 5; ++i)
    roots.emplace_back(i, 0, 0, i + 1, 1, 1);
  constexpr std::size_t counts[] = {30, 50, 0, 50, 40};
  const auto choose = [&](std::size_t number) {
    std::vector<double> chosen;
    for(const Bbox_3& r : best_roots(roots, number,
                                     [&](const Bbox_3& b) { return counts[std::size_t(b.xmin())]; }))
      chosen.push_back(r.xmin());
    return chosen;
  };
  using Numbers = std::vector<double>;
  BOOST_TEST(choose(1) == Numbers({1}));
  BOOST_TEST(choose(3) == Numbers({1, 3, 4}));
  BOOST_TEST(choose(9) == Numbers({1, 3, 4, 0, 2}));
}

// ---- boundary stage ----------------------------------------------------------------------------

// One element by itself: all labels, random orders.
void test_split_element()
{
  std::mt19937 random(37);
  for(Element_kind kind : element_kinds) {
    const Reference_element& r = reference_elements[kind];
    std::vector<Lattice_point> points;
    std::vector<Vertex_index> vertices;
    for(int i = 0; i < r.number_of_vertices; ++i) {
      points.push_back({std::uint32_t(r.coordinates[i][0] + 1), std::uint32_t(r.coordinates[i][1] + 1),
                        std::uint32_t(r.coordinates[i][2] + 1)});
      vertices.push_back(Vertex_index(i));
    }
    const Element_view element(kind, vertices.data());
    const Integer volume = six_volume(points, element);
    for(int labels = 0; labels < (1 << r.number_of_vertices) - 1; ++labels)
      for(int repeat = 0; repeat < 4; ++repeat) {
        const auto is_inside = [&](Vertex_index v) { return (labels >> v & 1) != 0; };
        std::vector<int> rank(vertices.size());
        for(std::size_t i = 0; i < rank.size(); ++i)
          rank[i] = int(i);
        std::shuffle(rank.begin(), rank.end(), random);
        for(Vertex_index v : vertices)
          if(is_inside(v))
            rank[v] = 99;
        Element_list pieces;
        split_element(element, [&](Vertex_index v) { return rank[v]; }, is_inside,
                      [&](Element_kind k, std::initializer_list<Vertex_index> v) { pieces.add(k, v); });
        Integer sum = 0;
        for(std::size_t i = 0; i < pieces.size(); ++i) {
          BOOST_TEST(is_positive(points, pieces[i]));
          sum += six_volume(points, pieces[i]);
        }
        BOOST_TEST_EQ(sum, volume);
        const Faces faces = faces_of(pieces);
        BOOST_TEST_EQ(faces.nonconforming, 0u);
        for(const Boundary_polygon& p : faces.boundary)
          if(p.size == 4) // as it was, and all inside
            BOOST_TEST(std::all_of(p.vertices.begin(), p.vertices.end(), is_inside));
        BOOST_TEST(manifold_defects(faces.boundary).empty());
      }
  }
}

std::size_t number_reaching_out = 0, number_with_first_defects = 0, number_of_repaired = 0;

// Runs the stage and checks all it promises. `margin` tells that the rim can not be reached.
void test_boundary(const Analytic_octree& located, Transition_templates_choice choice,
                   Boundary_mode mode, bool has_margin)
{
  Lattice_mesh mesh = apply_transitions(located, choice);
  const Lattice_mesh before = mesh;

  // Before: elements that reach out and are not tetrahedra. With every vertex on the rim nothing can
  // be relabeled: the pinched places of the first round are left.
  std::size_t n_reaching_out = 0;
  for(std::size_t e = 0; e < before.elements.size(); ++e) {
    const Element_view element = before.elements[e];
    const auto n = std::count_if(element.begin(), element.end(),
                                 [&](Vertex_index v) { return before.is_inside(v); });
    n_reaching_out += n > 0 && n < element.size() && element.kind() != TETRAHEDRON;
  }
  number_reaching_out += n_reaching_out;
  Lattice_mesh fixed = before;
  std::fill(fixed.is_on_rim.begin(), fixed.is_on_rim.end(), std::uint8_t(1));
  const Boundary_pieces first = split_boundary(located, fixed, mode);
  BOOST_TEST_EQ(first.number_of_relabeled_vertices, 0u);
  BOOST_TEST(fixed.sides.size() >= before.sides.size()
             && std::equal(before.sides.begin(), before.sides.end(), fixed.sides.begin()));
  const Element_list first_kept = kept_elements(fixed, first);
  BOOST_TEST_EQ(first.defects.empty(), manifold_defects(faces_of(first_kept).boundary).empty());

  const Boundary_pieces boundary = split_boundary(located, mesh, mode);
  const Boundary_pieces again = split_boundary(located, [&]() -> Lattice_mesh& {
    fixed = before;
    return fixed;
  }(), mode, 3);
  BOOST_TEST(again.pieces.connectivity() == boundary.pieces.connectivity());

  // Relabeled: only outside vertices, to inside.
  std::size_t n_relabeled = 0;
  for(std::size_t v = 0; v < before.sides.size(); ++v)
    if(mesh.sides[v] != before.sides[v]) {
      BOOST_TEST(before.sides[v] != 1 && mesh.sides[v] == 1);
      ++n_relabeled;
    }
  BOOST_TEST_EQ(boundary.number_of_relabeled_vertices, n_relabeled);
  BOOST_TEST(n_relabeled == 0 || !first.defects.empty());
  BOOST_TEST(n_relabeled > 0 || first.defects.empty() || !has_margin);
  number_with_first_defects += !first.defects.empty();
  number_of_repaired += !first.defects.empty() && boundary.defects.empty();

  const Element_list kept = kept_elements(mesh, boundary);
  BOOST_TEST_EQ(boundary.number_of_inserted_vertices, mesh.vertices.size() - before.vertices.size());
  if(mode == Boundary_mode::VERTEX_ORDER)
    BOOST_TEST_EQ(boundary.number_of_inserted_vertices, 0u);
  if(has_margin) {
    BOOST_TEST(boundary.defects.empty());
  }
  for(const auto& e : boundary.defects.edges)
    BOOST_TEST(mesh.is_on_rim[e[0]] && mesh.is_on_rim[e[1]]);
  for(Vertex_index v : boundary.defects.vertices)
    BOOST_TEST(mesh.is_on_rim[v]);

  // Kept: what has a vertex inside. In pieces: what has another one, too.
  std::set<Vertex_index> used;
  std::vector<Integer> volume_of_pieces(mesh.elements.size(), 0);
  for(std::size_t i = 0; i < boundary.pieces.size(); ++i)
    volume_of_pieces[boundary.origins[i]] += six_volume(mesh.vertices, boundary.pieces[i]);
  BOOST_TEST(std::is_sorted(boundary.origins.begin(), boundary.origins.end()));
  const auto is_inside = [&](Vertex_index v) { return mesh.is_inside(v); };
  for(std::size_t e = 0; e < kept.size(); ++e) {
    const Element_view element = kept[e];
    BOOST_TEST(std::any_of(element.begin(), element.end(), is_inside));
    BOOST_TEST(is_positive(mesh.vertices, element));
    used.insert(element.begin(), element.end());
  }
  for(std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Element_view element = mesh.elements[e];
    const bool has_inside = std::any_of(element.begin(), element.end(), is_inside);
    const bool all_inside = std::all_of(element.begin(), element.end(), is_inside);
    if(!all_inside)
      BOOST_TEST(boundary.is_replaced[e]);
    if(mode == Boundary_mode::VERTEX_ORDER)
      BOOST_TEST_EQ(bool(boundary.is_replaced[e]), !all_inside);
    const Integer volume = six_volume(mesh.vertices, element);
    BOOST_TEST(has_inside && boundary.is_replaced[e]
                 ? volume_of_pieces[e] > 0 && volume_of_pieces[e] <= volume
                 : volume_of_pieces[e] == 0);
    if(all_inside && boundary.is_replaced[e])
      BOOST_TEST_EQ(volume_of_pieces[e], volume);
  }
  if(mode == Boundary_mode::PAPER)
    for(std::size_t i = 0; i < boundary.pieces.size(); ++i)
      if(located.side(mesh.cells[boundary.origins[i]]) == CGAL::ON_BOUNDARY)
        BOOST_TEST_EQ(boundary.pieces[i].kind(), TETRAHEDRON);
  BOOST_TEST_EQ(boundary.number_of_vertices, used.size());
  for(Vertex_index v = 0; v < mesh.vertices.size(); ++v)
    BOOST_TEST_EQ(bool(boundary.is_used[v]), used.count(v) != 0);

  // Conforming; the boundary outside, triangles, closed and manifold if the stage says so.
  const Faces faces = faces_of(kept);
  BOOST_TEST_EQ(faces.nonconforming, 0u);
  bool is_outside = true;
  for(const Boundary_polygon& p : faces.boundary) {
    BOOST_TEST_EQ(p.size, 3);
    is_outside = is_outside && std::none_of(p.vertices.begin(), p.vertices.begin() + p.size, is_inside);
  }
  BOOST_TEST(is_outside);
  BOOST_TEST_EQ(manifold_defects(faces.boundary).empty(), boundary.defects.empty());

  Mesh result;
  assemble_mesh(located, mesh, boundary, result);
  BOOST_TEST_EQ(result.number_of_vertices(), boundary.number_of_vertices);
  BOOST_TEST_EQ(result.number_of_elements(), kept.size());
  BOOST_TEST_EQ(result.boundary_faces().size(), faces.boundary.size());
  const Mesh_defects defects = find_defects(result);
  BOOST_TEST(defects.conforming() && defects.positive() && defects.unused_vertices == 0
             && defects.duplicate_vertices == 0);
  BOOST_TEST_EQ(defects.none(), boundary.defects.empty());
  const auto all_faces = boundary_faces(result);
  BOOST_TEST_EQ(all_faces.size(), result.boundary_faces().size());
}

void test_boundary_stage()
{
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const double c = 1. / 8;
  struct Case
  {
    Analytic_domain domain;
    int base_level, rounds;
  };
  std::vector<Case> cases = {
    {Analytic_domain(ball({0.5, 0.5, 0.5}, 0.33)), 3, 0},
    {Analytic_domain(ball({0.47, 0.52, 0.5}, 0.3)), 2, 3},
    {Analytic_domain(united(ball({0.3, 0.3, 0.5}, 0.13), ball({0.7, 0.7, 0.4}, 0.21))), 2, 3}};
  // almost touching, in all relative positions on the lattice
  for(double d : {1 * c, 1.25 * c, 1.5 * c, 2 * c})
    for(const Kernel::Vector_3& v : {Kernel::Vector_3(1, 0, 0), Kernel::Vector_3(1, 1, 0),
                                     Kernel::Vector_3(1, 1, 1), Kernel::Vector_3(1, 0.5, 0)})
      cases.push_back({Analytic_domain(united(ball(Point_3(0.5, 0.5, 0.5) - d * v, d),
                                              ball(Point_3(0.5, 0.5, 0.5) + d * v, d))), 3, 0});
  unsigned seed = 100;
  for(const Case& one : cases) {
    const Analytic_octree octree = random_octree(one.domain, traits, ++seed, one.base_level, one.rounds);
    for(Boundary_mode mode : {Boundary_mode::VERTEX_ORDER, Boundary_mode::PAPER})
      test_boundary(octree, Transition_templates_choice::FEWEST_VERTICES, mode, true);
    test_boundary(octree, Transition_templates_choice::CENTERED, Boundary_mode::VERTEX_ORDER, true);
  }
  BOOST_TEST_GT(number_of_repaired, 5u);

  // Noise: with a margin all is repaired, without one the status tells what is not.
  for(double margin : {0.3, 0.01})
    for(int share : {3, 10, 30, 60})
      for(int repeat = 0; repeat < 4; ++repeat) {
        const Analytic_domain domain(noise(++seed, share, margin));
        const Analytic_octree octree =
          repeat == 0   ? random_octree(domain, traits, seed, 3, 0)
          : repeat < 3 ? random_octree(domain, traits, seed, 2, repeat)
                        : random_octree(domain, traits, seed, 2, 1, 2);
        for(Boundary_mode mode : {Boundary_mode::VERTEX_ORDER, Boundary_mode::PAPER})
          test_boundary(octree, Transition_templates_choice::FEWEST_VERTICES, mode, false);
      }
  BOOST_TEST_GT(number_reaching_out, 5000u);
  BOOST_TEST_GT(number_with_first_defects, 40u);
  std::cout << "boundary stage: pinched at first " << number_with_first_defects << ", repaired "
            << number_of_repaired << std::endl;
}

// ---- the checkers ------------------------------------------------------------------------------

void test_manifold_defects()
{
  const auto tetrahedron = [](Vertex_index a, Vertex_index b, Vertex_index c, Vertex_index d) {
    return std::vector<Boundary_polygon>{{{b, c, d}, 3}, {{a, d, c}, 3}, {{a, b, d}, 3}, {{a, c, b}, 3}};
  };
  const auto both = [](std::vector<Boundary_polygon> a, const std::vector<Boundary_polygon>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  using Edges = std::vector<std::array<Vertex_index, 2>>;
  using Vertices = std::vector<Vertex_index>;

  BOOST_TEST(manifold_defects({}).empty());
  BOOST_TEST(manifold_defects(tetrahedron(0, 1, 2, 3)).empty());
  BOOST_TEST(manifold_defects(both(tetrahedron(0, 1, 2, 3), tetrahedron(4, 5, 6, 7))).empty());
  // all quadrilaterals, and both sizes
  std::vector<Boundary_polygon> polygons;
  for(Element_kind kind : element_kinds) {
    const Reference_element& r = reference_elements[kind];
    polygons.clear();
    for(int f = 0; f < r.number_of_faces; ++f) {
      Boundary_polygon p{{}, r.faces[f].size};
      std::copy(r.faces[f].vertices, r.faces[f].vertices + p.size, p.vertices.begin());
      polygons.push_back(p);
    }
    BOOST_TEST(manifold_defects(polygons).empty());
    // open, at each of its faces
    for(std::size_t f = 0; f < polygons.size(); ++f) {
      std::vector<Boundary_polygon> open = polygons;
      open.erase(open.begin() + std::ptrdiff_t(f));
      const Manifold_defects d = manifold_defects(open);
      BOOST_TEST_EQ(int(d.edges.size()), polygons[f].size);
      BOOST_TEST_EQ(int(d.vertices.size()), polygons[f].size);
      // turned over
      std::vector<Boundary_polygon> turned = polygons;
      std::reverse(turned[f].vertices.begin(), turned[f].vertices.begin() + turned[f].size);
      BOOST_TEST_EQ(int(manifold_defects(turned).edges.size()), polygons[f].size);
    }
  }
  // four polygons at an edge: two fans at its ends
  Manifold_defects d = manifold_defects(both(tetrahedron(0, 1, 2, 3), tetrahedron(0, 1, 4, 5)));
  BOOST_TEST(d.edges == (Edges{{0, 1}}));
  BOOST_TEST_LE(d.vertices.size(), 2u);
  // two fans at a vertex, all edges fine
  d = manifold_defects(both(tetrahedron(0, 1, 2, 3), tetrahedron(4, 5, 6, 2)));
  BOOST_TEST(d.edges.empty());
  BOOST_TEST(d.vertices == (Vertices{2}));
  // the same surface twice
  d = manifold_defects(both(tetrahedron(0, 1, 2, 3), tetrahedron(0, 1, 2, 3)));
  BOOST_TEST_EQ(d.edges.size(), 6u);
}

Mesh_defects expect(const Mesh& mesh)
{
  const Mesh_defects d = find_defects(mesh);
  BOOST_TEST(!d.none());
  return d;
}

// The numbers of one kind are zero except those asked for.
enum Defect { NONCONFORMING = 1, EDGES = 2, VERTICES = 4, CORNERS = 8, UNUSED = 16, DUPLICATE = 32,
              NONFINITE = 64, INVALID = 128 };

void check(const Mesh& mesh, int expected)
{
  const Mesh_defects d = find_defects(mesh);
  const int found = (d.nonconforming_faces ? NONCONFORMING : 0)
                    | (d.nonmanifold_boundary_edges ? EDGES : 0)
                    | (d.nonmanifold_boundary_vertices ? VERTICES : 0)
                    | (d.nonpositive_corners ? CORNERS : 0) | (d.unused_vertices ? UNUSED : 0)
                    | (d.duplicate_vertices ? DUPLICATE : 0) | (d.nonfinite_vertices ? NONFINITE : 0)
                    | (d.invalid_elements ? INVALID : 0);
  BOOST_TEST_EQ(found, expected);
  BOOST_TEST_EQ(d.none(), expected == 0);
  BOOST_TEST_EQ(d.conforming(), (expected & (NONCONFORMING | INVALID)) == 0);
  BOOST_TEST_EQ(d.closed_manifold_boundary(), (expected & (EDGES | VERTICES | INVALID)) == 0);
  BOOST_TEST_EQ(d.positive(), (expected & (CORNERS | NONFINITE | INVALID)) == 0);
}

// A unit cube of vertices 0 to 7 in the order of the hexahedron, then others.
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
      v.push_back(mesh.add_vertex(
        Point_3(r.coordinates[i][0], r.coordinates[i][1], r.coordinates[i][2])));
    mesh.add_element(kind, v.data());
    check(mesh, 0);
    mesh.points()[0] = Point_3(9, 9, 9); // inside out somewhere
    BOOST_TEST_GT(find_defects(mesh).nonpositive_corners, 0u);
  }

  // A pyramid on the cube is fine, two tetrahedra against its face are not.
  Mesh mesh = cube({{0.5, 0.5, 2}});
  mesh.add_element(PYRAMID, {4, 5, 6, 7, 8});
  check(mesh, 0);
  mesh = cube({{0.5, 0.5, 2}});
  mesh.add_element(TETRAHEDRON, {4, 5, 6, 8});
  mesh.add_element(TETRAHEDRON, {4, 6, 7, 8});
  check(mesh, NONCONFORMING | EDGES | (find_defects(mesh).nonmanifold_boundary_vertices ? VERTICES : 0));
  BOOST_TEST_EQ(find_defects(mesh).nonconforming_faces, 1u);
  // one of the two only
  mesh = cube({{0.5, 0.5, 2}});
  mesh.add_element(TETRAHEDRON, {4, 5, 6, 8});
  BOOST_TEST_EQ(expect(mesh).nonconforming_faces, 1u);

  // Two cubes side by side that share no vertex; -0 is 0.
  const auto neighbor = [](double zero) {
    Mesh two = cube({{1, zero, zero}, {2, 0, 0}, {2, 1, 0}, {1, 1, zero},
                     {1, zero, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}});
    two.add_element(HEXAHEDRON, {8, 9, 10, 11, 12, 13, 14, 15});
    return two;
  };
  for(double zero : {0., -0.}) {
    check(neighbor(zero), DUPLICATE);
    BOOST_TEST_EQ(find_defects(neighbor(zero)).duplicate_vertices, 4u);
  }
  // three at one place count twice
  mesh = cube({{0, 0, 0}, {0, 0, 0}});
  check(mesh, DUPLICATE | UNUSED);
  BOOST_TEST_EQ(find_defects(mesh).duplicate_vertices, 2u);

  check(cube({{2, 2, 2}}), UNUSED);
  BOOST_TEST_EQ(find_defects(cube({{2, 2, 2}, {3, 3, 3}})).unused_vertices, 2u);

  const Point_3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), below(0.3, 0.3, -1);
  check(tetrahedra({{0, 1, 2, 3}}, {o, x, y, z}), 0);
  check(tetrahedra({{0, 2, 1, 3}}, {o, x, y, z}), CORNERS);                    // inverted
  check(tetrahedra({{0, 1, 2, 3}}, {o, x, y, {1, 1, 0}}), CORNERS);            // flat
  check(tetrahedra({{0, 1, 2, 3}}, {o, x, y, {0, 0, 1e-300}}), 0);             // almost
  // collinear but for the last digit: doubles would round the determinant
  check(tetrahedra({{0, 1, 2, 3}}, {{1e8, 1e8, 1e8}, {1e8 + 1, 1e8, 1e8}, {1e8, 1e8 + 1, 1e8},
                                    {1e8 + 1, 1e8 + 1, std::nextafter(1e8, 2e8)}}), 0);
  check(tetrahedra({{0, 1, 2, 3}}, {{1e8, 1e8, 1e8}, {1e8 + 1, 1e8, 1e8}, {1e8, 1e8 + 1, 1e8},
                                    {1e8 + 1, 1e8 + 1, std::nextafter(1e8, 0)}}), CORNERS);

  // two that share a face
  check(tetrahedra({{0, 1, 2, 3}, {0, 2, 1, 4}}, {o, x, y, z, below}), 0);
  // on the same side of it: both positive, folded
  const Mesh folded = tetrahedra({{0, 1, 2, 3}, {0, 1, 2, 4}}, {o, x, y, z, {0.3, 0.3, 2}});
  check(folded, NONCONFORMING | EDGES
                  | (find_defects(folded).nonmanifold_boundary_vertices ? VERTICES : 0));
  BOOST_TEST_EQ(find_defects(folded).nonconforming_faces, 1u);
  BOOST_TEST_EQ(find_defects(folded).nonmanifold_boundary_edges, 3u);
  // a face with three elements
  const Mesh thrice = tetrahedra({{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 2, 1, 5}},
                                 {o, x, y, z, below, {0.3, 0.3, -2}});
  BOOST_TEST_EQ(expect(thrice).nonconforming_faces, 1u);
  BOOST_TEST(!find_defects(thrice).conforming());

  // quadrilaterals with the same vertices in another cyclic order
  mesh = cube({{0.5, 0.5, 2}});
  mesh.add_element(PYRAMID, {4, 6, 5, 7, 8});
  BOOST_TEST_EQ(expect(mesh).nonconforming_faces, 1u);

  // two that share an edge, or a vertex, only
  const Mesh edge = tetrahedra({{0, 1, 2, 3}, {0, 1, 4, 5}}, {o, x, y, z, {0, -1, 0}, {0, 0, -1}});
  BOOST_TEST_EQ(expect(edge).nonmanifold_boundary_edges, 1u);
  BOOST_TEST(edge.is_empty() || (find_defects(edge).conforming() && find_defects(edge).positive()));
  const Mesh vertex = tetrahedra({{0, 1, 2, 3}, {0, 4, 5, 6}},
                                 {o, x, y, z, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}});
  check(vertex, VERTICES);
  BOOST_TEST_EQ(find_defects(vertex).nonmanifold_boundary_vertices, 1u);

  // indices that do not exist, or twice the same
  check(tetrahedra({{0, 1, 2, 7}}, {o, x, y}), INVALID);
  check(tetrahedra({{0, 1, 2, Vertex_index(-1)}}, {o, x, y}), INVALID);
  check(tetrahedra({{0, 1, 2, 3}, {0, 1, 2, 2}}, {o, x, y, z}), INVALID);
}

// Not a number, or infinite.
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

} // namespace

int main()
{
  test_manifold_defects();
  test_find_defects();
  test_is_balanced();
  test_split_element();
  test_cell_traits();
  test_domain_oracle();
  test_surface_samples();
  test_rim();
  test_place_lattice();
  test_all_transitions();
  test_inserted_on_rim();
  test_boundary_stage();
  test_find_nonfinite();
  return boost::report_errors();
}
