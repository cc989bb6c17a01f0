// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_DISJOINT_SETS_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_DISJOINT_SETS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A partition of the numbers from 0 on into sets, which are united. The least number of a set stands for it,
/// so that results do not depend on the order in which sets are united: the sets of Boost are named by any.
class Disjoint_sets
{
  std::vector<std::size_t> m_parents; // of the same set, and not greater than the number

public:
  /// Constructs the partition of n numbers into sets of one number.
  explicit Disjoint_sets(std::size_t n) : m_parents(n)
  {
    std::iota(m_parents.begin(), m_parents.end(), std::size_t(0));
  }

  std::size_t size() const { return m_parents.size(); }

  /// The least number of the set of a number.
  /// \par Complexity
  /// \f$ O(\log n) \f$, amortized
  std::size_t least(std::size_t i)
  {
    while(m_parents[i] != i)
      i = m_parents[i] = m_parents[m_parents[i]];
    return i;
  }

  /// Unites the sets of two numbers.
  void unite(std::size_t i, std::size_t j)
  {
    std::size_t low = least(i), high = least(j);
    if(high < low)
      std::swap(low, high);
    m_parents[high] = low;
  }

  /// The least number of the set of each number.
  const std::vector<std::size_t>& least_of_all()
  {
    for(std::size_t& parent : m_parents)
      parent = m_parents[parent]; // which comes before, and is a least number already
    return m_parents;
  }

  /// The number of the set of each number, by the order of the least numbers; and the number of sets.
  std::pair<std::vector<std::size_t>, std::size_t> numbered()
  {
    std::vector<std::size_t> number(size());
    std::size_t n = 0;
    for(std::size_t i = 0; i < size(); ++i)
      number[i] = m_parents[i] == i ? n++ : number[m_parents[i]];
    return {std::move(number), n};
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_DISJOINT_SETS_H
