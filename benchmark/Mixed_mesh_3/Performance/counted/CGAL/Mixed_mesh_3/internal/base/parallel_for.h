// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parallel loop of the same name, for `serial_share.py`: it runs in one thread, and counts CPU seconds
// that several threads would share. Blocks are those of the parallel loop.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// CPU seconds of the loops, and what the loops would take with 2 and with 16 threads: a share of the whole,
/// or the longest block. At the end of the process, a line on stderr.
struct Counted_loops
{
  double seconds = 0, with_2 = 0, with_16 = 0;
  int depth = 0; // a loop in a loop counts with the outer one

  static double now()
  {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  }

  void add(double whole, double longest_block)
  {
    seconds += whole;
    with_2 += (std::max)(whole / 2, longest_block);
    with_16 += (std::max)(whole / 16, longest_block);
  }

  ~Counted_loops()
  {
    std::fprintf(stderr, "counted: %.6f %.6f %.6f %.6f\n", now(), seconds, with_2, with_16);
  }
};

inline Counted_loops counted_loops;

template <class F>
void parallel_for(std::size_t n, unsigned threads, const F& f, std::size_t worth_a_thread = 512)
{
  const bool is_parallel = threads > 1 && n >= 2 * worth_a_thread && counted_loops.depth == 0;
  const std::size_t block = is_parallel ? worth_a_thread / 8 + 1 : n;
  counted_loops.depth += is_parallel;
  const double start = is_parallel ? Counted_loops::now() : 0;
  double last = start, longest = 0;
  for(std::size_t i = 0; i < n;) {
    for(const std::size_t end = (std::min)(i + block, n); i < end; ++i)
      f(i);
    if(is_parallel) {
      const double now = Counted_loops::now();
      longest = (std::max)(longest, now - last);
      last = now;
    }
  }
  counted_loops.depth -= is_parallel;
  if(is_parallel)
    counted_loops.add(last - start, longest);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_PARALLEL_FOR_H
