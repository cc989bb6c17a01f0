// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H

#include <CGAL/license/Mixed_mesh_3.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Calls `f(i)` for all i below `n`. Calls must be independent: each writes its own result, so that
/// the outcome does not depend on the number of threads. `f` must not throw.
/// \param threads 1: one after the other
/// \param worth_a_thread number of calls that take much longer than a thread takes to start
template <class F>
void parallel_for(std::size_t n, [[maybe_unused]] unsigned threads, const F& f,
                  [[maybe_unused]] std::size_t worth_a_thread = 512)
{
#ifdef CGAL_LINKED_WITH_TBB
  if(threads > 1 && n >= 2 * worth_a_thread) {
    constexpr std::size_t blocks_per_thread = 8; // so a wait for the last block is 1/8 of that work
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, worth_a_thread / blocks_per_thread + 1),
                      [&](const auto& range) {
                        for(std::size_t i = range.begin(); i < range.end(); ++i)
                          f(i);
                      });
    return;
  }
#endif
  for(std::size_t i = 0; i < n; ++i)
    f(i);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H
