// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_CONCURRENCY_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_CONCURRENCY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <type_traits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Number of threads that `CGAL::Sequential_tag` or `CGAL::Parallel_tag` stands for: those that TBB may use.
template <class ConcurrencyTag>
unsigned number_of_threads()
{
#ifdef CGAL_LINKED_WITH_TBB
  if constexpr(std::is_convertible<ConcurrencyTag, Parallel_tag>::value)
    return unsigned(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
#else
  static_assert(!std::is_convertible<ConcurrencyTag, Parallel_tag>::value,
                "Parallel_tag is enabled but TBB is unavailable.");
#endif
  return 1;
}

/// Criteria with the number of threads that a function with a tag stands for.
template <class Criteria>
struct With_threads : Criteria
{
  unsigned number_of_threads;

  With_threads(const Criteria& criteria, unsigned threads) : Criteria(criteria), number_of_threads(threads) {}
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_CONCURRENCY_H
