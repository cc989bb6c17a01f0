// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brain shift on the command line: computes from a mesh and some points with measured displacements the
// displacement of the whole, before and after a resection, and the image as it looks then. Section 6.2 of
// Lobos, Bucki, Hitschfeld, Payan: "Mixed-element mesh for an intra-operative modeling of the brain tumor
// extraction". Exit status: 0 success; 1 bad input, or no solution for the input, or a file that cannot be
// written; 2 wrong use.

#include "brain_shift/options.h"
#include "brain_shift/run.h"
#include "core/One_blas_thread.h"
#include "core/messages.h"

#ifndef MIXED_MESH_3_HAS_PETSC
#define MIXED_MESH_3_HAS_PETSC 0
#endif
#if MIXED_MESH_3_HAS_PETSC
#include <CGAL/Mixed_mesh_petsc/Petsc_solver_traits.h>
#else
#include <filesystem>
#include <string_view>
#include <system_error>

#include <unistd.h>
#endif

#include <exception>
#include <iostream>
#include <new>
#include <string>

namespace {

int fail(const std::string& what)
{
  std::cerr << "brain_shift: error: " << printable(what) << '\n';
  return 1;
}

int run_command_line(int argc, char** argv)
{
  Options options;
  if(const auto status = parse_command_line(argc, argv, MIXED_MESH_3_HAS_PETSC, options))
    return *status;
  try {
    run(options);
    return 0;
  } catch(const std::bad_alloc&) {
    return fail("out of memory: with fewer vertices, or with --solver petsc, it takes less");
  } catch(const std::exception& e) {
    return fail(e.what());
  }
}

} // namespace

// The program with PETSc, brain_shift_petsc, is a separate program beside this one, because PETSc takes a
// tenth of a second to load.
#if MIXED_MESH_3_HAS_PETSC

int main(int argc, char** argv)
{
  const One_blas_thread one_thread;
  try {
    CGAL::Mixed_meshes_3::Petsc_session session;
    if(session.is_first())
      return run_command_line(argc, argv);
    session.serve();
    return 0;
  } catch(const std::exception& e) {
    return fail(e.what());
  }
}

#else

namespace {

bool asks_for_petsc(int argc, char** argv)
{
  for(int i = 1; i < argc; ++i)
    if(const std::string_view word = argv[i];
       word == "--solver=petsc" || (word == "petsc" && std::string_view(argv[i - 1]) == "--solver"))
      return true;
  return false;
}

// Replaces this program by brain_shift_petsc. Returns if there is no such program.
void become_program_with_petsc(char** argv)
{
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if(!error)
    execv((self.parent_path() / "brain_shift_petsc").c_str(), argv);
}

} // namespace

int main(int argc, char** argv)
{
  if(asks_for_petsc(argc, argv))
    become_program_with_petsc(argv);
  const One_blas_thread one_thread;
  return run_command_line(argc, argv);
}

#endif
