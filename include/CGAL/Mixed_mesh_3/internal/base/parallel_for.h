// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <system_error>
#include <thread>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Calls `f(i)` for all i below `n`. Calls must be independent: each writes its own result, so that
/// the outcome does not depend on the number of threads. `f` must not throw.
/// \param worth_a_thread how many calls take much longer than a thread takes to start
template <class F>
void parallel_for(std::size_t n, unsigned threads, const F& f, std::size_t worth_a_thread = 512)
{
  constexpr std::size_t blocks_per_thread = 8; // so that none waits long for the last one
  const std::size_t used = (std::max)(std::size_t(1), (std::min)(std::size_t(threads), n / worth_a_thread)),
                    block = used == 1 ? n : n / (used * blocks_per_thread) + 1;
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for(std::size_t first = next.fetch_add(block); first < n; first = next.fetch_add(block))
      for(std::size_t i = first; i < (std::min)(n, first + block); ++i)
        f(i);
  };
  std::vector<std::thread> workers;
  try {
    while(workers.size() + 1 < used)
      workers.emplace_back(run);
  } catch(const std::system_error&) {
    // the system gives no more threads: the others do the rest
  }
  run();
  for(std::thread& worker : workers)
    worker.join();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H
