// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the root of the octree lies, and how large it is, decides how many vertices of a small budget are
// left for the region of interest: by a factor of up to two for a mesh of some hundred vertices.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_PLACE_LATTICE_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_PLACE_LATTICE_H

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// For larger budgets it is not worth the time, which grows with the budget: the region has most vertices
/// anyway.
inline constexpr std::size_t largest_budget_to_place_lattice = 20000;
/// How many vertices the meshes have together that are made to compare the best roots: 7 meshes of 660
/// vertices, one of 4,000 and more. Their fitting is most of the time that a tolerance takes.
inline constexpr std::size_t vertices_to_compare_roots = 4000;

/// Boxes around the domain's, the box itself first: cubes up to 1.25 times as large as the smallest one
/// (beyond, the next base level would serve), shifted as far as they contain the domain.
inline std::vector<Bbox_3> candidate_roots(const Bbox_3& domain)
{
  constexpr double scales[] = {1.05, 1.1, 1.15, 1.2, 1.25};
  constexpr Vec3 shifts[] = {{0, 0, 0}, {1, 0, 0},  {-1, 0, 0},      {0, 1, 0},        {0, -1, 0},
                             {0, 0, 1}, {0, 0, -1}, {0.5, 0.5, 0.5}, {-0.5, -0.5, 0.5}};
  const Vec3 low{domain.xmin(), domain.ymin(), domain.zmin()},
    high{domain.xmax(), domain.ymax(), domain.zmax()};
  const Vec3 extent = high - low, center = 0.5 * (low + high);
  const double side = (std::max)({extent[0], extent[1], extent[2]});
  std::vector<Bbox_3> roots{domain};
  for(double scale : scales)
    for(const Vec3& shift : shifts) {
      const Vec3 c = center + (0.5 * (scale - 1) * side) * shift;
      const double half = 0.5 * scale * side;
      roots.emplace_back(c[0] - half, c[1] - half, c[2] - half, c[0] + half, c[1] + half, c[2] + half);
    }
  return roots;
}

/// The roots with the largest counts, the best one first; of equal ones, those that come first.
/// \param number how many, at most
/// \param count `std::size_t(root)`
template <class Count>
std::vector<Bbox_3> best_roots(const std::vector<Bbox_3>& roots, std::size_t number, const Count& count)
{
  std::vector<std::pair<std::size_t, std::size_t>> order;
  for(std::size_t i = 0; i < roots.size(); ++i)
    order.emplace_back(~count(roots[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<Bbox_3> best;
  for(std::size_t k = 0; k < (std::min)(number, order.size()); ++k)
    best.push_back(roots[order[k].second]);
  return best;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_PLACE_LATTICE_H
