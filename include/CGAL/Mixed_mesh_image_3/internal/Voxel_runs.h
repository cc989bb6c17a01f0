// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_RUNS_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_RUNS_H

#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_image_3/internal/Voxel_box.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Voxels that are connected: those with a common face; those whose centers are the ends of an edge of
/// Kuhn's tetrahedra, as in surfaces of marching tetrahedra; those with a common face, edge or corner.
enum class Voxel_connectivity { FACES, TETRAHEDRA, CORNERS };

/// Voxels with a value in a box, as runs along the first axis: there are some hundred times fewer runs than
/// voxels, so that several questions cost no more than the one pass that finds the runs.
class Voxel_runs
{
public:
  struct Run
  {
    std::size_t begin, end; // indices along the first axis
  };

  /// The connected component of each run.
  struct Components
  {
    std::vector<std::uint32_t> of_run;
    std::uint32_t number = 0;
  };

private:
  std::array<std::size_t, 3> m_size;
  std::vector<Run> m_runs;
  std::vector<std::size_t> m_first_of_row{0}; // and the number of all runs

public:
  /// \param mask values of all voxels; the first index runs fastest
  Voxel_runs(const std::array<std::size_t, 3>& size, const std::vector<std::uint8_t>& mask,
             std::uint8_t value)
    : m_size(size)
  {
    for(auto row = mask.begin(); row != mask.end(); row += std::ptrdiff_t(size[0])) {
      const auto row_end = row + std::ptrdiff_t(size[0]);
      for(auto end = row, begin = std::find(row, row_end, value); begin != row_end;
          begin = std::find(end, row_end, value)) {
        end = std::find_if(begin, row_end, [value](std::uint8_t v) { return v != value; });
        m_runs.push_back({std::size_t(begin - row), std::size_t(end - row)});
      }
      m_first_of_row.push_back(m_runs.size());
    }
  }

  const std::vector<Run>& runs() const { return m_runs; }

  /// Calls `f(offset, run)` for each voxel, with its offset in the box.
  template <class F>
  void for_each_voxel(const F& f) const
  {
    for(std::size_t row = 0; row + 1 < m_first_of_row.size(); ++row)
      for(std::size_t r = m_first_of_row[row]; r < m_first_of_row[row + 1]; ++r)
        for(std::size_t i = m_runs[r].begin; i < m_runs[r].end; ++i)
          f(row * m_size[0] + i, r);
  }

  /// Finds the connected components, numbered in the order of their first runs.
  Components components(Voxel_connectivity connectivity) const
  {
    using Connectivity = Voxel_connectivity;
    Disjoint_sets sets(m_runs.size());
    const auto unite = [&sets](std::size_t r, std::size_t s) { sets.unite(r, s); };
    // Neighbors have indices larger by 0 or 1 along the first axis, or by -1 as well.
    const std::size_t ahead = connectivity == Connectivity::FACES ? 0 : 1,
                      behind = connectivity == Connectivity::CORNERS ? 1 : 0;
    for(std::size_t k = 0; k < m_size[2]; ++k)
      for(std::size_t j = 0; j < m_size[1]; ++j) {
        const std::size_t row = j + m_size[1] * k;
        const auto unite_with = [&](std::size_t other) {
          for_each_overlap(*this, row, *this, other, ahead, behind, unite);
        };
        if(j + 1 < m_size[1])
          unite_with(row + 1);
        if(k + 1 == m_size[2])
          continue;
        unite_with(row + m_size[1]);
        if(connectivity != Connectivity::FACES && j + 1 < m_size[1])
          unite_with(row + m_size[1] + 1);
        if(connectivity == Connectivity::CORNERS && j > 0)
          unite_with(row + m_size[1] - 1);
      }
    const auto [numbers, number] = sets.numbered();
    return {{numbers.begin(), numbers.end()}, std::uint32_t(number)};
  }

  /// Calls `f(r, s)` for runs of both that have a voxel in common. \pre the boxes are the same
  template <class F>
  static void for_each_common(const Voxel_runs& first, const Voxel_runs& second, const F& f)
  {
    for(std::size_t row = 0; row + 1 < first.m_first_of_row.size(); ++row)
      for_each_overlap(first, row, second, row, 0, 0, f);
  }

private:
  // Calls `f(r, s)` for each run r of a row and s of another one that has a voxel with an index that is at
  // most `ahead` larger, or `behind` less.
  template <class F>
  static void for_each_overlap(const Voxel_runs& first, std::size_t first_row, const Voxel_runs& second,
                               std::size_t second_row, std::size_t ahead, std::size_t behind, const F& f)
  {
    std::size_t r = first.m_first_of_row[first_row], s = second.m_first_of_row[second_row];
    const std::size_t r_end = first.m_first_of_row[first_row + 1],
                      s_end = second.m_first_of_row[second_row + 1];
    while(r < r_end && s < s_end) {
      const Run &a = first.m_runs[r], &b = second.m_runs[s];
      if(a.begin < b.end + behind && b.begin < a.end + ahead)
        f(r, s);
      // The run that ends first meets no more: with the reach ahead and behind, up to the next one's start.
      a.end + ahead < b.end + behind ? ++r : ++s;
    }
  }
};

/// The number of times that each pattern of eight voxels occurs in a mask of 0 and 1. Bit d of a pattern is
/// the voxel in direction d, whose bit i says whether index i is larger by 1. One pass gives the Euler
/// characteristics of all connectivities.
inline std::array<std::size_t, 256> pattern_counts(const std::array<std::size_t, 3>& size,
                                                   const std::vector<std::uint8_t>& mask)
{
  std::array<std::size_t, 256> counts{};
  for(std::size_t k = 0; k + 1 < size[2]; ++k)
    for(std::size_t j = 0; j + 1 < size[1]; ++j) {
      const std::uint8_t* const row = mask.data() + size[0] * (j + size[1] * k);
      const std::uint8_t *const next = row + size[0], *const above = row + size[0] * size[1],
                                *const last = above + size[0];
      const auto column = [&](std::size_t i) { // voxels of even numbers
        return unsigned(row[i]) | unsigned(next[i]) << 2 | unsigned(above[i]) << 4 | unsigned(last[i]) << 6;
      };
      unsigned first = column(0);
      for(std::size_t i = 0; i + 1 < size[0]; ++i) {
        const unsigned second = column(i + 1);
        ++counts[first | second << 1];
        first = second;
      }
    }
  return counts;
}

/// The Euler characteristic of voxels. Voxels are the vertices of a complex, whose cells have all their
/// corners in it: the cells are cubes, or Kuhn's tetrahedra. With corners, the complex is the union of closed
/// voxels.
/// \param counts from `pattern_counts()`. \pre no voxel at the border of the box is 1
inline std::ptrdiff_t euler_characteristic(const std::array<std::size_t, 256>& counts,
                                           Voxel_connectivity connectivity)
{
  constexpr unsigned axes[3] = {1, 2, 4};
  const auto all = [](unsigned pattern, unsigned cell) { return int((pattern & cell) == cell); };
  const auto any = [](unsigned pattern, unsigned cell) { return int((pattern & cell) != 0); };
  const auto bit = [](unsigned direction) { return 1u << direction; };
  // The cells of a pattern are those whose first corner is voxel 0.
  const auto of_cubes = [&](unsigned pattern, const auto& has) {
    int sum = has(pattern, 1) - has(pattern, 255);
    for(const unsigned a : axes) {
      sum -= has(pattern, 1 | bit(a));
      for(const unsigned b : axes)
        if(a < b)
          sum += has(pattern, 1 | bit(a) | bit(b) | bit(a | b));
    }
    return sum;
  };
  const auto of_tetrahedra =
    [&](unsigned pattern) { // chains of directions, each of which extends the last one
      int sum = all(pattern, 1);
      for(unsigned a = 1; a < 8; ++a) {
        sum -= all(pattern, 1 | bit(a));
        for(unsigned b = a + 1; b < 8; ++b)
          if((a & b) == a) {
            sum += all(pattern, 1 | bit(a) | bit(b));
            for(unsigned c = b + 1; c < 8; ++c)
              sum -= (b & c) == b ? all(pattern, 1 | bit(a) | bit(b) | bit(c)) : 0;
          }
      }
      return sum;
    };
  std::ptrdiff_t sum = 0;
  for(unsigned pattern = 1; pattern < 256; ++pattern)
    if(counts[pattern] > 0)
      sum += std::ptrdiff_t(counts[pattern])
             * (connectivity == Voxel_connectivity::FACES     ? of_cubes(pattern, all)
                : connectivity == Voxel_connectivity::CORNERS ? -of_cubes(pattern, any)
                                                              : of_tetrahedra(pattern));
  return sum;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_RUNS_H
