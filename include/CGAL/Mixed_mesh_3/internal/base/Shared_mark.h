// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_SHARED_MARK_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_SHARED_MARK_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <atomic>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A mark that several threads may set at the same time, but that only one thread reads later.
class Shared_mark
{
  std::atomic<bool> m_is_set;

public:
  Shared_mark(bool is_set = false) : m_is_set(is_set) {}
  Shared_mark(const Shared_mark& other) : m_is_set(bool(other)) {}
  Shared_mark& operator=(const Shared_mark& other) { return *this = bool(other); }
  Shared_mark& operator=(bool is_set)
  {
    m_is_set.store(is_set, std::memory_order_relaxed);
    return *this;
  }
  operator bool() const { return m_is_set.load(std::memory_order_relaxed); }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_SHARED_MARK_H
