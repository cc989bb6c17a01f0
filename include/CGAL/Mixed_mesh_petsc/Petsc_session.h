// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The processes of mpirun that solve together. This header needs PETSc (real numbers) and MPI; the CMake
// target CGAL::Mixed_mesh_3_petsc has both.

#ifndef CGAL_MIXED_MESH_PETSC_PETSC_SESSION_H
#define CGAL_MIXED_MESH_PETSC_PETSC_SESSION_H

#include <CGAL/Mixed_mesh_petsc/internal/Petsc_system.h>

#include <CGAL/assertions.h>

#include <petscksp.h>

#include <map>
#include <stdexcept>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMesh3Solvers

\brief The processes that solve together with `Petsc_solver_traits`: PETSc and MPI, from construction to
destruction.

The first process runs the program: it has the mesh and the model, reads and writes. The other processes have
only their rows of matrices, and wait for work in `serve()` until the session of the first process ends,
however it ends: by an exception, too. So a program for `mpirun` begins with

\code
CGAL::Mixed_meshes_3::Petsc_session session;
if(!session.is_first()) {
  session.serve();
  return 0;
}
\endcode

and is otherwise the same as without `mpirun`. A single process, with or without `mpirun`, works as well.

Options of PETSc are taken from its environment variable `PETSC_OPTIONS`; one of them,
`-mg_levels_ksp_max_it`, is 3 where PETSc would have 2. Signals are left alone. If PETSc fails in one of
several processes, for want of memory for example, all processes end, with PETSc's message and a status other
than zero, as the others would wait forever. PETSc can be started once in a process.

\pre there is one session at a time, and the session outlives all solvers
*/
class Petsc_session
{
public:
  /// Starts MPI and PETSc. \throw std::runtime_error if they cannot be started
  Petsc_session()
  {
    if(PetscInitializeNoArguments() != 0)
      throw std::runtime_error("PETSc cannot be started");
    PetscPopSignalHandler();
    PetscPushErrorHandler(number_of_processes() == 1 ? PetscReturnErrorHandler : PetscMPIAbortErrorHandler,
                          nullptr);
    // The value is as fast on solids as PETSc's own 2, with fewer iterations, and so fewer sums over all
    // processes.
    const char* const smoothing_steps = "-mg_levels_ksp_max_it";
    PetscBool is_set = PETSC_FALSE;
    PetscOptionsHasName(nullptr, nullptr, smoothing_steps, &is_set);
    if(!is_set)
      PetscOptionsSetValue(nullptr, smoothing_steps, "3");
  }

  /// Deleted: there is one session at a time.
  Petsc_session(const Petsc_session&) = delete;
  /// Deleted: there is one session at a time.
  Petsc_session& operator=(const Petsc_session&) = delete;

  /// Ends the session, and the other processes' `serve()`, too.
  ~Petsc_session()
  {
    if(is_first()) {
      internal::Petsc_message end{internal::Petsc_command::END, 0, 0, 0, 0, 0};
      internal::share(end);
    }
    PetscPopErrorHandler();
    PetscFinalize();
  }

  /// Whether this process is the one that runs the program.
  bool is_first() const { return internal::petsc_rank() == 0; }

  /// The number of processes.
  int number_of_processes() const { return internal::petsc_size(); }

  /// Solves with the first process, until that ends its session. \pre this process is not the first one
  void serve()
  {
    CGAL_precondition(!is_first());
    using internal::Petsc_command;
    std::map<int, internal::Petsc_system> systems;
    while(true) {
      internal::Petsc_message message;
      internal::share(message);
      int iterations = 0;
      switch(message.command) {
      case Petsc_command::FACTOR:
        internal::abort_all_on_exception(
          [&] { systems.try_emplace(message.system, message, nullptr, nullptr); });
        break;
      case Petsc_command::SOLVE:
        internal::abort_all_on_exception(
          [&] { return systems.at(message.system).solve(message.tolerance, nullptr, nullptr, iterations); });
        break;
      case Petsc_command::RELEASE: systems.erase(message.system); break;
      case Petsc_command::END: return;
      }
    }
  }
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_PETSC_PETSC_SESSION_H
