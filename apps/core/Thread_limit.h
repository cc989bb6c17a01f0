// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_APPS_CORE_THREAD_LIMIT_H
#define MIXED_MESH_3_APPS_CORE_THREAD_LIMIT_H

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <cstddef>

/// Limit of threads: `CGAL::Parallel_if_available_tag` stands for that number as long as the object lives, or
/// for one thread without TBB.
class Thread_limit
{
#ifdef CGAL_LINKED_WITH_TBB
  const tbb::global_control m_control;

public:
  static constexpr bool has_threads = true;
  explicit Thread_limit(std::size_t threads)
    : m_control(tbb::global_control::max_allowed_parallelism, threads)
  {
  }
#else
public:
  static constexpr bool has_threads = false;
  explicit Thread_limit(std::size_t) {}
#endif
};

#endif // MIXED_MESH_3_APPS_CORE_THREAD_LIMIT_H
