// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_APPS_CORE_ONE_BLAS_THREAD_H
#define MIXED_MESH_3_APPS_CORE_ONE_BLAS_THREAD_H

/// Guard under which the BLAS that CHOLMOD uses, and OpenMP, take one thread, whatever the environment says:
/// several threads may add up in another order, and results differ in their last digits. At the end of the
/// guard, BLAS and OpenMP take as many threads as before, because others in the process share them: NumPy in
/// Python. Several guards may live at a time, in several threads; each guard ends in the thread in which it
/// began.
class One_blas_thread
{
  int m_openmp_threads; // number of this thread, or 0 without OpenMP

public:
  One_blas_thread();
  ~One_blas_thread();
  One_blas_thread(const One_blas_thread&) = delete;
  One_blas_thread& operator=(const One_blas_thread&) = delete;
};

#endif // MIXED_MESH_3_APPS_CORE_ONE_BLAS_THREAD_H
