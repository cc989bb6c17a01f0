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
#include <cstddef>
#include <system_error>
#include <thread>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Calls `f(i)` for all i below `n`. Calls must be independent: each writes its own result, so that
/// the outcome does not depend on the number of threads. `f` must not throw.
template <class F>
void parallel_for(std::size_t n, unsigned threads, const F& f)
{
  constexpr std::size_t worth_a_thread = 512;
  const std::size_t blocks = (std::max)(std::size_t(1), (std::min)(std::size_t(threads), n / worth_a_thread));
  const auto run = [&](std::size_t block) {
    for(std::size_t i = n * block / blocks; i < n * (block + 1) / blocks; ++i)
      f(i);
  };
  std::vector<std::thread> workers;
  std::size_t block = 1;
  try {
    for(; block < blocks; ++block)
      workers.emplace_back(run, block);
  } catch(const std::system_error&) {
    // the system gives no more threads: the rest is done here
  }
  run(0);
  for(; block < blocks; ++block)
    run(block);
  for(std::thread& worker : workers)
    worker.join();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H
