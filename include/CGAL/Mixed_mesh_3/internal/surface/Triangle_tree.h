// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closest points of triangles, in doubles: the most frequent query of the optimization and of the measurement
// of distances.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_TRIANGLE_TREE_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_TRIANGLE_TREE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The point of a triangle closest to a given point, by the region of the plane that the point projects to
/// (C. Ericson, *Real-Time Collision Detection*, 5.1.5).
class Closest_point_of_triangle
{
  Vec3 m_corner, m_ab, m_ac;
  double m_ab_ab, m_ab_ac, m_ac_ac;

public:
  explicit Closest_point_of_triangle(const std::array<Vec3, 3>& t)
    : m_corner(t[0]), m_ab(t[1] - t[0]), m_ac(t[2] - t[0]), m_ab_ab(dot(m_ab, m_ab)),
      m_ab_ac(dot(m_ab, m_ac)), m_ac_ac(dot(m_ac, m_ac))
  {
  }

  /// The closest point; for a triangle without area, the closest point of one of its edges.
  Vec3 operator()(const Vec3& p) const
  {
    const Vec3 ap = p - m_corner;
    const double a1 = dot(m_ab, ap), a2 = dot(m_ac, ap); // along both edges, seen from a
    if(a1 <= 0 && a2 <= 0)
      return m_corner;
    const double b1 = a1 - m_ab_ab, b2 = a2 - m_ab_ac; // seen from b
    if(b1 >= 0 && b2 <= b1)
      return at(1, 0);
    const double c1 = a1 - m_ab_ac, c2 = a2 - m_ac_ac; // seen from c
    if(c2 >= 0 && c1 <= c2)
      return at(0, 1);
    const double of_c = a1 * b2 - b1 * a2; // barycentric coordinates, times the squared area
    if(of_c <= 0 && a1 >= 0 && b1 <= 0)
      return at(a1 / m_ab_ab, 0);
    const double of_b = c1 * a2 - a1 * c2;
    if(of_b <= 0 && a2 >= 0 && c2 <= 0)
      return at(0, a2 / m_ac_ac);
    const double of_a = b1 * c2 - c1 * b2, from_b = b2 - b1, from_c = c1 - c2;
    if(of_a <= 0 && from_b >= 0 && from_c >= 0) {
      const double share = from_b / (from_b + from_c);
      return at(1 - share, share);
    }
    const double sum = of_a + of_b + of_c;
    return at(of_b / sum, of_c / sum);
  }

private:
  Vec3 at(double b, double c) const { return m_corner + (b * m_ab + c * m_ac); }
};

/*!
A tree of boxes with four children each, whose distances are computed at once. No decision that rounding could
make wrong depends on the tree, so it need not be exact. The AABB tree of CGAL with `Simple_cartesian<double>`
takes three times as long: it projects points onto planes first, and tests one box at a time.
*/
class Triangle_tree
{
public:
  /// A point of the surface, and the triangle that it is on.
  struct Closest
  {
    Vec3 point;
    std::size_t triangle;
  };

  /// \param triangles triangles, which may be degenerate
  /// \par Complexity
  /// \f$ O(n \log n) \f$
  explicit Triangle_tree(const std::vector<std::array<Vec3, 3>>& triangles)
    : Triangle_tree(triangles.size(), [&triangles](std::size_t i) { return triangles[i]; })
  {
  }

  /// \param number number of triangles
  /// \param corners `std::array<Vec3, 3>(std::size_t)`: corners of a triangle, which may be degenerate
  template <class Corners>
  Triangle_tree(std::size_t number, const Corners& corners)
  {
    Box box;
    if(number > 0)
      box = Box(corners(0));
    for(std::size_t i = 1; i < number; ++i)
      box.add(Box(corners(i)));
    std::vector<Center> centers;
    centers.reserve(number);
    for(std::size_t i = 0; i < number; ++i)
      centers.push_back(center_of(Box(corners(i)), box, i));
    m_nodes.reserve(number / 3);
    if(number > 0)
      add_node(corners, box.high - box.low, centers, 0, number);
    m_nodes.shrink_to_fit();
    // 16 times 2^-53: more than the eleven roundings of the squared distance of a box, two in each of three
    // differences, three squares and two sums.
    constexpr double roundings = 8 * std::numeric_limits<double>::epsilon();
    for(std::size_t k = 0; k < 3; ++k)
      m_rounding = (std::max)(
        {m_rounding, roundings * std::abs(box.low[k]), roundings * std::abs(box.high[k])});
    m_triangles.reserve(centers.size());
    m_numbers.reserve(centers.size());
    m_positions.resize(centers.size());
    for(const Center& c : centers) {
      m_positions[c.number] = std::uint32_t(m_triangles.size());
      m_triangles.emplace_back(corners(c.number));
      m_numbers.push_back(c.number);
    }
  }

  bool is_empty() const { return m_triangles.empty(); }

  /// The closest point. \pre the tree is not empty
  Closest closest(const Vec3& p) const
  {
    Closest found{};
    double least = std::numeric_limits<double>::infinity();
    search(p, found, least);
    return found;
  }

  /// \param hint point of the triangles: it is the result if no point is closer. The nearer, the faster
  Closest closest(const Vec3& p, const Closest& hint) const
  {
    Closest found = hint;
    double least = squared_distance(p, hint.point);
    search(p, found, least);
    return found;
  }

  /// The closest point of one triangle.
  Closest closest(const Vec3& p, std::size_t triangle) const
  {
    return {m_triangles[m_positions[triangle]](p), triangle};
  }

  /// The nearer of two points; the first one if they are as near.
  static const Closest& nearer(const Vec3& p, const Closest& a, const Closest& b)
  {
    return squared_distance(p, b.point) < squared_distance(p, a.point) ? b : a;
  }

private:
  static constexpr int width = 4; // children of a node, which is halved twice, and most triangles of a leaf

  struct Box
  {
    Vec3 low{}, high{};

    Box() = default;
    explicit Box(const std::array<Vec3, 3>& t) : low(t[0]), high(t[0])
    {
      add(t[1], t[1]);
      add(t[2], t[2]);
    }
    void add(const Vec3& l, const Vec3& h)
    {
      for(std::size_t k = 0; k < 3; ++k) {
        low[k] = (std::min)(low[k], l[k]);
        high[k] = (std::max)(high[k], h[k]);
      }
    }
    void add(const Box& box) { add(box.low, box.high); }
  };

  // The center of the box of a triangle, as shares of the box of all: which triangles are neighbors in the
  // tree decides about time only, and small entries are sorted faster.
  struct Center
  {
    std::array<float, 3> at;
    std::uint32_t number;
  };

  struct Node
  {
    double center[3][width], half[3][width];  // boxes of the children; an absent one is infinitely far
    std::uint32_t first[width];               // node of the child, or the first triangle of a leaf
    std::uint32_t number_of_triangles[width]; // 0: the child is no leaf
  };

  std::vector<Node> m_nodes; // the first is the root
  double m_rounding = 0;     // bound of the rounding error of distances from boxes
  std::vector<Closest_point_of_triangle> m_triangles;
  std::vector<std::uint32_t> m_numbers;   // numbers of the triangles in the order given
  std::vector<std::uint32_t> m_positions; // positions of the triangles of that order

  static double squared_distance(const Vec3& p, const Vec3& q)
  {
    const Vec3 d = q - p;
    return dot(d, d);
  }

  static Center center_of(const Box& box, const Box& all, std::size_t number)
  {
    Center center{{}, std::uint32_t(number)};
    for(std::size_t k = 0; k < 3; ++k)
      if(const double side = all.high[k] - all.low[k]; side > 0)
        center.at[k] = float(((box.low[k] - all.low[k]) + (box.high[k] - all.low[k])) / side);
    return center;
  }

  // Halves a range at the median along the longest side of the box of its centers, in shares; equal centers
  // are ordered by their numbers.
  static std::size_t halve(std::vector<Center>& centers, const Vec3& sides, std::size_t first,
                           std::size_t last)
  {
    const std::size_t middle = first + (last - first) / 2;
    if(first == middle)
      return middle;
    std::array<float, 3> low = centers[first].at, high = low;
    for(std::size_t i = first + 1; i < last; ++i)
      for(std::size_t k = 0; k < 3; ++k) {
        low[k] = (std::min)(low[k], centers[i].at[k]);
        high[k] = (std::max)(high[k], centers[i].at[k]);
      }
    std::size_t axis = 0;
    for(std::size_t k = 1; k < 3; ++k)
      if(sides[k] * (high[k] - low[k]) > sides[axis] * (high[axis] - low[axis]))
        axis = k;
    const auto at = [&](std::size_t i) { return centers.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(first), at(middle), at(last), [axis](const Center& a, const Center& b) {
      return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.number < b.number;
    });
    return middle;
  }

  // Adds the nodes of a range, the first of which has the index that the number of nodes was; returns the box
  // of the range.
  template <class Corners>
  Box add_node(const Corners& corners, const Vec3& sides, std::vector<Center>& centers, std::size_t first,
               std::size_t last)
  {
    const std::size_t index = m_nodes.size();
    const std::size_t middle = halve(centers, sides, first, last),
                      quarter = halve(centers, sides, first, middle),
                      three_quarters = halve(centers, sides, middle, last);
    const std::array<std::size_t, width + 1> ends{first, quarter, middle, three_quarters, last};
    m_nodes.emplace_back();
    Box all(corners(centers[first].number));
    for(std::size_t child = 0; child < width; ++child) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      const std::size_t begin = ends[child], end = ends[child + 1];
      Box box(corners(centers[begin < end ? begin : first].number));
      const bool is_leaf = end - begin <= width;
      const std::uint32_t start = std::uint32_t(is_leaf ? begin : m_nodes.size());
      if(!is_leaf)
        box = add_node(corners, sides, centers, begin, end);
      for(std::size_t i = begin; is_leaf && i < end; ++i)
        box.add(Box(corners(centers[i].number)));
      all.add(box);
      Node& node = m_nodes[index];
      for(std::size_t k = 0; k < 3; ++k) {
        const double center = 0.5 * (box.low[k] + box.high[k]);
        node.center[k][child] = center;
        node.half[k][child] = begin < end ? (std::max)(box.high[k] - center, center - box.low[k]) : -infinity;
      }
      node.first[child] = start;
      node.number_of_triangles[child] = is_leaf ? std::uint32_t(end - begin) : 0;
    }
    return all;
  }

  // Squared distances of a point from the boxes of the children. Absolute values instead of comparisons let
  // compilers compute several at once.
  static std::array<double, width> squared_distances(const Node& node, const Vec3& p)
  {
    std::array<double, width> squares{};
    for(std::size_t k = 0; k < 3; ++k)
      for(std::size_t c = 0; c < width; ++c) {
        const double beyond = std::abs(p[k] - node.center[k][c]) - node.half[k][c],
                     outside = 0.5 * (beyond + std::abs(beyond)); // or 0
        squares[c] += outside * outside;
      }
    return squares;
  }

  // The squared distance up to which boxes are entered: rounding must not miss a box with a point that is as
  // near, so that a hint does not decide which of several triangles is named.
  double limit_of(double least) const
  {
    const double distance = std::sqrt(least) + m_rounding;
    return distance * distance;
  }

  // Replaces the point found by a closer one, or by one as close on a triangle with a smaller number.
  void search(const Vec3& p, Closest& found, double& least) const
  {
    CGAL_precondition(!is_empty());
    double limit = limit_of(least);
    // The stack of boxes. Each level halves twice: 16 levels, in each of which at most three children wait.
    struct Waiting
    {
      double distance;
      std::uint32_t node;
    };
    std::array<Waiting, 64> stack;
    std::size_t size = 0;
    stack[size++] = {0, 0};
    while(size > 0) {
      const Waiting next = stack[--size];
      if(next.distance > limit)
        continue;
      const Node& node = m_nodes[next.node];
      const std::array<double, width> squares = squared_distances(node, p);
      const std::size_t bottom = size;
      for(std::size_t c = 0; c < width; ++c) {
        if(squares[c] > limit)
          continue;
        if(node.number_of_triangles[c] == 0) { // the nearest child is on top
          stack[size] = {squares[c], node.first[c]};
          if(size > bottom && stack[size - 1].distance < squares[c])
            std::swap(stack[size - 1], stack[size]);
          ++size;
        }
        for(std::uint32_t i = node.first[c]; i < node.first[c] + node.number_of_triangles[c]; ++i) {
          const Vec3 q = m_triangles[i](p);
          const double d = squared_distance(p, q);
          if(d < least || (d == least && m_numbers[i] < found.triangle)) {
            least = d;
            limit = limit_of(d);
            found = {q, m_numbers[i]};
          }
        }
      }
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_TRIANGLE_TREE_H
