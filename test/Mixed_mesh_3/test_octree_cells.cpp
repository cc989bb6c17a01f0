// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of the octree: the cells of the lattice, compared with exact rationals; balance, by all pairs; the
// locations of cells of a located octree, by their boxes.

#include "test_lattice.h"

#include <CGAL/Mixed_mesh_3/internal/octree/Boxes_between_planes.h>
#include <CGAL/Mixed_mesh_3/internal/octree/balance.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/Exact_rational.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace test_octree_cells {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Bbox_3;

using Kernel = Predicates_kernel;
using Point_3 = Kernel::Point_3;
using Triangle_3 = Kernel::Triangle_3;
using Rotated_traits = Rotated_octree_cell_traits_3;

// ---- cell traits -------------------------------------------------------------------------------

using Exact = CGAL::Exact_rational;
using Exact_vector = std::array<Exact, 3>;

Exact_vector exact(const Point_3& p) { return {Exact(p.x()), Exact(p.y()), Exact(p.z())}; }
Exact_vector operator-(const Exact_vector& a, const Exact_vector& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Exact dot(const Exact_vector& a, const Exact_vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

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
          clipped.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])});
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
  // Every lattice point is at its right place, without rounding.
  for(int repeat = 0; repeat < 300; ++repeat) {
    Lattice_point p;
    for(std::uint32_t& c : p)
      c = std::uint32_t(repeat < 8 ? Octree::root_side * (random() % 2) : random() % (Octree::root_side + 1));
    const Exact_vector q = exact(traits.point(p));
    for(int k = 0; k < 3; ++k)
      BOOST_TEST(q[k]
                 == frame.origin[k] + p[0] * frame.units[0][k] + p[1] * frame.units[1][k]
                      + p[2] * frame.units[2][k]);
  }
  // Orthogonal and right-handed, so that positive elements of the lattice are positive in space.
  for(int k = 0; k < 3; ++k)
    BOOST_TEST(dot(frame.units[k], frame.units[(k + 1) % 3]) == 0);
  const auto& u = frame.units;
  BOOST_TEST(u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1])
               - u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0])
               + u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0])
             > 0);

  // Cells have the right center, box, length, and triangles that they meet; triangles through lattice points
  // touch.
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
      const Point_3 p = traits.point(
        {corner[0] + (i & 1) * side, corner[1] + (i >> 1 & 1) * side, corner[2] + (i >> 2) * side});
      box += p.bbox();
      if(i == 1 || i == 2 || i == 4)
        shortest = (std::min)(shortest, std::sqrt(CGAL::squared_distance(p, first)));
    }
    BOOST_TEST(cell.bbox() == box);
    BOOST_TEST_LE(std::abs(traits.length(side) - shortest), 1e-6 * shortest);
    for(int i = 0; i < 10; ++i) {
      const auto near = [&](int k) {
        const std::int64_t x = std::int64_t(corner[k]) + (std::int64_t(random() % 7) - 2) * (side / 2);
        return std::uint32_t((std::min)((std::max)(x, std::int64_t(0)), std::int64_t(Octree::root_side)));
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
  std::vector<Bbox_3> boxes = {{0, 0, 0, 1, 1, 1},
                               {0.1, -0.7, 1. / 3, 1.1, 0.9, 0.7},
                               {-3.9, -44, -65.8, 60.1, 55, 65.79},
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
      const std::vector<Point_3> points = {{scale * b.xmin(), scale * b.ymin(), scale * b.zmin()},
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
      // The extent needed for a box 1e-5 small at 1e8 is far more than the digits left.
      const Kernel::Vector_3 axis = n % 7 == 0
                                      ? Kernel::Vector_3(0, 0, -1)
                                      : Kernel::Vector_3(uniform(random) - 0.5, uniform(random) - 0.5,
                                                         uniform(random) - 0.5);
      const Rotated_traits traits(points, axis);
      test_cover(traits, points);
      if(n < 30)
        test_lattice(traits);
      const Frame frame(traits);
      for(int k = 1; k < 3; ++k)
        BOOST_TEST(dot(frame.units[0], frame.units[0]) == dot(frame.units[k], frame.units[k]));
      const Kernel::Vector_3 third = traits.point({0, 0, Octree::root_side}) - traits.point({0, 0, 0});
      BOOST_TEST_GT(axis * third / std::sqrt(axis.squared_length() * third.squared_length()),
                    std::cos(3 * CGAL_PI / 180));
      ++n;
    }
}

// ---- balance -----------------------------------------------------------------------------------

// Balance compared with all pairs of leaves, on an octree that is not balanced and after.
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

// ---- located cells -----------------------------------------------------------------------------

// A box as region, so that comparisons decide whether a cell meets it.
struct Box_region
{
  struct Surface_part
  {
  };
  Bbox_3 box;

  Surface_part surface_part() const { return {}; }
  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    const Bbox_3 c = cell.bbox();
    bool meets = true, is_inside = true;
    for(int k = 0; k < 3; ++k) {
      meets = meets && c.min(k) <= box.max(k) && box.min(k) <= c.max(k);
      is_inside = is_inside && box.min(k) < c.min(k) && c.max(k) < box.max(k);
    }
    return is_inside ? CGAL::ON_BOUNDED_SIDE : meets ? CGAL::ON_BOUNDARY : CGAL::ON_UNBOUNDED_SIDE;
  }
  double depth(const Point_3& p) const
  {
    double least = std::numeric_limits<double>::infinity();
    for(int k = 0; k < 3; ++k)
      least = (std::min)({least, p[k] - box.min(k), box.max(k) - p[k]});
    return least;
  }
};

// Choice for refinement, and locations of cells, by the boxes of all nodes.
void test_located_cells()
{
  const Analytic_domain domain(ball({0.5, 0.5, 0.5}, 0.3));
  const double volume_of_ball = 4 * CGAL_PI / 3 * 0.027;
  for(const Bbox_3& root : {Bbox_3(0, 0, 0, 1, 1, 1), Bbox_3(0, 0.2, 0.1, 1, 0.8, 0.9)}) {
    const Aligned_traits traits(root, Root_cell::BOX);
    for(const Bbox_3& b :
        {Bbox_3(0.4, 0.3, 0.2, 0.7, 0.6, 0.55), Bbox_3(0.51, 0.51, 0.51, 0.52, 0.52, 0.52)}) {
      const Box_region region{b};
      Located_octree octree(domain, region, traits);
      const double whole = octree.cell_volume(0);
      BOOST_TEST_LE(std::abs(whole - root.x_span() * root.y_span() * root.z_span()), 1e-5 * whole);
      const double volume = volume_of_domain(octree);
      BOOST_TEST(volume > 0.85 * volume_of_ball && volume < 1.25 * volume_of_ball);
      std::size_t number_in_region = 0, number_beside = 0;
      for(int level = 0; level < 5; ++level) {
        std::vector<Octree::Node_index> all, in_region;
        std::size_t inside = 0, in_domain = 0;
        for(Octree::Node_index n = 0; n < octree.octree().size(); ++n) {
          const auto cell = traits.cell(octree.octree().corner(n), octree.octree().side(n));
          Box_region::Surface_part part;
          BOOST_TEST_EQ(octree.is_in_region(n), region.locate(cell, part, part) != CGAL::ON_UNBOUNDED_SIDE);
          BOOST_TEST_EQ(octree.depth_in_region(n), region.depth(cell.center()));
          BOOST_TEST_LE(std::abs(octree.rounded(octree.depth_in_region(n)) - octree.depth_in_region(n)),
                        1e-6);
          Analytic_domain::Surface_part none;
          const CGAL::Bounded_side side = domain.locate(cell, none, none);
          if(!octree.octree().is_leaf(n))
            continue;
          BOOST_TEST_EQ(octree.leaf_at(cell.center()), n);
          inside += octree.side(n) == CGAL::ON_BOUNDED_SIDE;
          in_domain += octree.meets_domain(n);
          BOOST_TEST(octree.side(n) == side || side == CGAL::ON_BOUNDARY); // children inherit a side
          if(octree.octree().level(n) == level && octree.meets_domain(n)) {
            all.push_back(n);
            if(octree.is_in_region(n))
              in_region.push_back(n);
          }
        }
        BOOST_TEST_EQ(octree.number_of_cells(), in_domain);
        BOOST_TEST_EQ(octree.number_of_cells_inside(), inside);
        BOOST_TEST(octree.leaves_to_refine(level, false) == all);
        BOOST_TEST(octree.leaves_to_refine(level, true) == in_region);
        number_in_region += in_region.size();
        number_beside += all.size() - in_region.size();
        octree.refine(all);
      }
      BOOST_TEST(number_in_region >= 5 && number_beside > 100);
    }
  }
}

// ---- boxes between planes ----------------------------------------------------------------------

// Boxes between random planes, random ones of which are inside.
struct Boxes_domain
{
  std::array<std::vector<double>, 3> planes;
  std::vector<char> is_inside;

  struct Surface_part
  {
  };

  std::size_t number_of_slabs(std::size_t k) const { return planes[k].size() - 1; }

  bool is_inside_at(const std::array<std::ptrdiff_t, 3>& b) const
  {
    std::size_t i = 0;
    for(std::size_t k = 3; k-- > 0;) {
      if(b[k] < 0 || b[k] >= std::ptrdiff_t(number_of_slabs(k)))
        return false;
      i = i * number_of_slabs(k) + std::size_t(b[k]);
    }
    return is_inside[i];
  }

  template <class F>
  void for_each_box(const F& f) const
  {
    std::array<std::ptrdiff_t, 3> b;
    for(b[2] = 0; b[2] < std::ptrdiff_t(number_of_slabs(2)); ++b[2])
      for(b[1] = 0; b[1] < std::ptrdiff_t(number_of_slabs(1)); ++b[1])
        for(b[0] = 0; b[0] < std::ptrdiff_t(number_of_slabs(0)); ++b[0])
          f(b);
  }

  Surface_part surface_part() const { return {}; }

  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    bool meets_inside = false, meets_outside = false;
    for_each_box([&](const std::array<std::ptrdiff_t, 3>& b) {
      for(int k = 0; k < 3; ++k) {
        const std::vector<double>& p = planes[std::size_t(k)];
        const std::size_t i = std::size_t(b[std::size_t(k)]);
        if((cell.bbox().max)(k) < p[i] || (cell.bbox().min)(k) > p[i + 1])
          return;
      }
      (is_inside_at(b) ? meets_inside : meets_outside) = true;
    });
    return !meets_inside   ? CGAL::ON_UNBOUNDED_SIDE
           : meets_outside ? CGAL::ON_BOUNDARY
                           : CGAL::ON_BOUNDED_SIDE;
  }

  CGAL::Bounded_side bounded_side(const Point_3& p, const Surface_part&) const
  {
    std::array<std::ptrdiff_t, 3> b;
    for(int k = 0; k < 3; ++k) {
      const std::vector<double>& planes_k = planes[std::size_t(k)];
      b[std::size_t(k)] = std::upper_bound(planes_k.begin(), planes_k.end(), p[k]) - planes_k.begin() - 1;
    }
    return is_inside_at(b) ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_UNBOUNDED_SIDE;
  }
};

// The number of vertices and the ratio of edges against all cells one by one; the manifold property against
// faces that share an edge or a vertex.
void test_boxes_between_planes()
{
  using Index = std::array<std::ptrdiff_t, 3>;
  std::mt19937 random(7);
  int number_manifold = 0;
  for(int repeat = 0; repeat < 400; ++repeat) {
    Boxes_domain domain;
    Axis_parallel_planes planes;
    std::size_t number = 1;
    internal::Boxes_between_planes::Layers layers;
    for(std::size_t k = 0; k < 3; ++k) {
      double x = double(random() % 100) - 50;
      const std::size_t n = 1 + random() % 3;
      number *= n;
      for(std::size_t i = 0; i <= n; ++i) {
        domain.planes[k].push_back(x);
        planes[k][x] = 1;
        x += 0.1 + double(random() % 100) / 7;
        if(i < n)
          layers[k].push_back(1 + std::uint32_t(random() % 4));
      }
    }
    for(std::size_t i = 0; i < number; ++i)
      domain.is_inside.push_back(random() % 3 != 0);
    const internal::Boxes_between_planes boxes(planes, domain);

    double volume = 0, ratio = 1;
    std::set<Index> vertices; // in layers from the first plane
    domain.for_each_box([&](const Index& b) {
      if(!domain.is_inside_at(b))
        return;
      Index first{}, numbers{};
      std::array<double, 3> widths{}, edges{};
      for(std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = std::size_t(b[k]);
        first[k] = std::accumulate(layers[k].begin(), layers[k].begin() + b[k], std::ptrdiff_t(0));
        numbers[k] = layers[k][i];
        widths[k] = domain.planes[k][i + 1] - domain.planes[k][i];
        edges[k] = widths[k] / double(numbers[k]);
      }
      volume += widths[0] * widths[1] * widths[2];
      for(double e : edges)
        for(double f : edges)
          ratio = (std::max)(ratio, e / f);
      for(std::ptrdiff_t z = 0; z <= numbers[2]; ++z)
        for(std::ptrdiff_t y = 0; y <= numbers[1]; ++y)
          for(std::ptrdiff_t x = 0; x <= numbers[0]; ++x)
            vertices.insert({first[0] + x, first[1] + y, first[2] + z});
    });
    BOOST_TEST_EQ(boxes.number_of_vertices(layers), double(vertices.size()));
    BOOST_TEST_LE(std::abs(boxes.volume() - volume), 1e-12 * volume);
    BOOST_TEST_LE(std::abs(boxes.largest_ratio(layers) - ratio), 1e-12 * ratio);

    // The faces between inside and outside, by axis and the vertex with the smallest coordinates: manifold if
    // each edge is in two faces, and the faces at a vertex are connected by the edges at it.
    std::map<std::pair<std::size_t, Index>, std::vector<std::size_t>> faces_of_edge;
    std::map<Index, std::vector<std::size_t>> faces_of_vertex;
    std::size_t number_of_faces = 0;
    for(std::size_t a = 0; a < 3; ++a) {
      Index size{};
      for(std::size_t k = 0; k < 3; ++k)
        size[k] = std::ptrdiff_t(domain.number_of_slabs(k)) + (k == a);
      Index f{};
      for(f[2] = 0; f[2] < size[2]; ++f[2])
        for(f[1] = 0; f[1] < size[1]; ++f[1])
          for(f[0] = 0; f[0] < size[0]; ++f[0]) {
            Index behind = f;
            --behind[a];
            if(domain.is_inside_at(f) == domain.is_inside_at(behind))
              continue;
            const std::size_t u = (a + 1) % 3, w = (a + 2) % 3;
            for(std::ptrdiff_t i : {0, 1}) {
              Index at_u = f, at_w = f;
              at_w[w] += i;
              faces_of_edge[{u, at_w}].push_back(number_of_faces);
              at_u[u] += i;
              faces_of_edge[{w, at_u}].push_back(number_of_faces);
              for(std::ptrdiff_t j : {0, 1}) {
                Index vertex = at_u;
                vertex[w] += j;
                faces_of_vertex[vertex].push_back(number_of_faces);
              }
            }
            ++number_of_faces;
          }
    }
    bool is_manifold = std::all_of(faces_of_edge.begin(), faces_of_edge.end(),
                                   [](const auto& edge) { return edge.second.size() == 2; });
    for(const auto& [vertex, faces] : faces_of_vertex) {
      std::set<std::size_t> reached{faces[0]};
      for(std::size_t round = 0; round < faces.size(); ++round)
        for(std::size_t k = 0; k < 3; ++k)
          for(std::ptrdiff_t back : {0, 1}) {
            Index edge = vertex;
            edge[k] -= back;
            const auto i = faces_of_edge.find({k, edge});
            if(i == faces_of_edge.end())
              continue;
            if(std::any_of(i->second.begin(), i->second.end(),
                           [&](std::size_t f) { return reached.count(f); }))
              reached.insert(i->second.begin(), i->second.end());
          }
      const auto is_reached = [&](std::size_t f) { return reached.count(f) > 0; };
      is_manifold = is_manifold && std::all_of(faces.begin(), faces.end(), is_reached);
    }
    BOOST_TEST_EQ(boxes.is_manifold(), is_manifold);
    number_manifold += is_manifold;
  }
  BOOST_TEST(number_manifold > 50 && number_manifold < 350);
}

int run(int, char*[])
{
  test_cell_traits();
  test_boxes_between_planes();
  test_is_balanced();
  test_located_cells();
  return boost::report_errors();
}

} // namespace test_octree_cells
