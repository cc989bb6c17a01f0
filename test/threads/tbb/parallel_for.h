// SPDX-FileCopyrightText: 2026 The Mixed_mesh_3 authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// tbb::parallel_for() in threads of the standard library, for ThreadSanitizer: scripts/check.sh threads. The
// library of TBB is compiled without it, and it does not see, then, that a call ends before the loop
// returns, and reports races that are none (github.com/google/sanitizers/issues/1004). Start and end of a
// std::thread it sees: no report needs to be suppressed. A race is found, too, if the calls do not meet
// in time.

#ifndef MIXED_MESH_3_TEST_THREADS_TBB_PARALLEL_FOR_H
#define MIXED_MESH_3_TEST_THREADS_TBB_PARALLEL_FOR_H

#include_next <tbb/parallel_for.h>

#include <tbb/blocked_range.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace tbb {

// More special than TBB's for any range, and so preferred to it. Neighboring blocks are of different threads.
template <class Index, class Body>
void parallel_for(const blocked_range<Index>& range, const Body& body)
{
  constexpr Index number_of_threads = 4;
  const Index block = Index(range.grainsize());
  std::vector<std::thread> threads;
  for(Index t = 0; t < number_of_threads; ++t)
    threads.emplace_back([&, t] {
      for(Index begin = range.begin() + t * block; begin < range.end(); begin += number_of_threads * block)
        body(blocked_range<Index>(begin, std::min(begin + block, range.end())));
    });
  for(std::thread& thread : threads)
    thread.join();
}

} // namespace tbb

#endif // MIXED_MESH_3_TEST_THREADS_TBB_PARALLEL_FOR_H
