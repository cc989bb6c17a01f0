// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/One_blas_thread.h"

#include <array>
#include <cstddef>
#include <mutex>

#include <dlfcn.h>

namespace {

// Functions of a library that get and set its number of threads. The library is known only when the program
// runs, as Debian lets the user choose the BLAS.
struct Library
{
  const char* get;
  const char* set;

  int threads() const
  {
    void* const function = dlsym(RTLD_DEFAULT, get);
    return function ? reinterpret_cast<int (*)()>(function)() : 0;
  }

  void use(int threads) const
  {
    if(void* const function = dlsym(RTLD_DEFAULT, set); function && threads != 0)
      reinterpret_cast<void (*)(long)>(function)(threads); // some take an int, which is passed likewise
  }
};

constexpr std::array<Library, 3> blas = {{{"openblas_get_num_threads", "openblas_set_num_threads"},
                                          {"bli_thread_get_num_threads", "bli_thread_set_num_threads"},
                                          {"MKL_Get_Max_Threads", "MKL_Set_Num_Threads"}}};
constexpr Library openmp = {"omp_get_max_threads", "omp_set_num_threads"};

// The number of threads of a BLAS is one for the process: the first object keeps it, and the last restores
// it. OpenMP has a number for each thread.
std::mutex mutex;
std::size_t number_of_objects = 0;
std::array<int, blas.size()> threads_before;

} // namespace

One_blas_thread::One_blas_thread() : m_openmp_threads(openmp.threads())
{
  const std::lock_guard<std::mutex> lock(mutex);
  if(number_of_objects++ == 0)
    for(std::size_t i = 0; i < blas.size(); ++i)
      threads_before[i] = blas[i].threads();
  for(const Library& library : blas)
    library.use(1);
  openmp.use(1);
}

One_blas_thread::~One_blas_thread()
{
  const std::lock_guard<std::mutex> lock(mutex);
  if(--number_of_objects == 0)
    for(std::size_t i = 0; i < blas.size(); ++i)
      blas[i].use(threads_before[i]);
  openmp.use(m_openmp_threads); // last, because OpenBLAS may change it
}
