// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/use_one_thread.h"

#include <initializer_list>

#include <dlfcn.h>

void use_one_thread()
{
  // Which BLAS there is, if any, is known when the program runs: Debian lets the user choose.
  for(const char* name : {"openblas_set_num_threads", "bli_thread_set_num_threads", "MKL_Set_Num_Threads",
                          "omp_set_num_threads"})
    if(void* const function = dlsym(RTLD_DEFAULT, name))
      reinterpret_cast<void (*)(long)>(function)(1); // some take an int, which is passed likewise
}
