// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A matrix whose rows are spread over the processes of mpirun, with its solver; messages between processes.

#ifndef CGAL_MIXED_MESH_PETSC_INTERNAL_PETSC_SYSTEM_H
#define CGAL_MIXED_MESH_PETSC_INTERNAL_PETSC_SYSTEM_H

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <petscksp.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

static_assert(!PetscDefined(USE_COMPLEX) && sizeof(PetscScalar) == sizeof(double),
              "PETSc must be one of real numbers in double precision");

/// An error of PETSc in a single process; in several processes, a process that cannot go on ends all.
struct Petsc_error : std::runtime_error
{
  Petsc_error() : std::runtime_error("PETSc failed") {}
};

/// Calls `f` in one of several processes, and ends all processes if `f` throws: a process that leaves alone
/// would keep the others waiting.
template <class F>
auto abort_all_on_exception(const F& f)
{
  try {
    return f();
  } catch(...) {
    int size = 1;
    MPI_Comm_size(PETSC_COMM_WORLD, &size);
    if(size > 1)
      MPI_Abort(PETSC_COMM_WORLD, 1);
    throw;
  }
}

inline void check_petsc(PetscErrorCode code)
{
  if(code != 0)
    throw Petsc_error();
}

/// A command of the first process to the others.
enum class Petsc_command { FACTOR, SOLVE, RELEASE, END };

struct Petsc_message
{
  Petsc_command command;
  int system;         // number of the system
  PetscInt size;      // size of the matrix
  int block_size;     // unknowns of a node, which one process has
  int number_of_near; // vectors that the matrix nearly maps to zero
  double tolerance;
};

inline int petsc_rank()
{
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank;
}

inline int petsc_size()
{
  int size = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  return size;
}

/// Sends the message of the first process to all processes. Waiting processes sleep, as the first process may
/// have much to do between messages.
inline void share(Petsc_message& message)
{
  MPI_Request request;
  MPI_Ibcast(&message, int(sizeof(message)), MPI_BYTE, 0, PETSC_COMM_WORLD, &request);
  for(int is_there = 0; true;) {
    MPI_Test(&request, &is_there, MPI_STATUS_IGNORE);
    if(is_there)
      return;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

/// Some rows of a symmetric matrix.
struct Petsc_rows
{
  std::vector<PetscInt> starts, columns;
  std::vector<double> values;

  Petsc_rows() = default;

  /// The rows from `first` to before `last`, of the lower triangle in compressed columns.
  Petsc_rows(const Eigen::SparseMatrix<double>& lower, PetscInt first, PetscInt last)
    : starts(std::size_t(last - first) + 1, 0)
  {
    for_each_entry(lower, first, last, [&](PetscInt i, PetscInt, double) { ++starts[i - first + 1]; });
    for(std::size_t i = 1; i < starts.size(); ++i)
      starts[i] += starts[i - 1];
    columns.resize(std::size_t(starts.back()));
    values.resize(columns.size());
    std::vector<PetscInt> ends(starts.begin(), starts.end() - 1);
    for_each_entry(lower, first, last, [&](PetscInt i, PetscInt j, double value) {
      const std::size_t k = std::size_t(ends[std::size_t(i - first)]++);
      columns[k] = j;
      values[k] = value;
    });
  }

  void send(int to) const
  {
    MPI_Send(starts.data(), int(starts.size()), MPIU_INT, to, 0, PETSC_COMM_WORLD);
    MPI_Send(columns.data(), int(columns.size()), MPIU_INT, to, 0, PETSC_COMM_WORLD);
    MPI_Send(values.data(), int(values.size()), MPI_DOUBLE, to, 0, PETSC_COMM_WORLD);
  }

  void receive(std::size_t number_of_rows)
  {
    starts.resize(number_of_rows + 1);
    MPI_Recv(starts.data(), int(starts.size()), MPIU_INT, 0, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
    columns.resize(std::size_t(starts.back()));
    values.resize(columns.size());
    MPI_Recv(columns.data(), int(columns.size()), MPIU_INT, 0, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
    MPI_Recv(values.data(), int(values.size()), MPI_DOUBLE, 0, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  }

private:
  // Calls `add` for each entry; each row gets its columns in ascending order.
  template <class Add>
  static void for_each_entry(const Eigen::SparseMatrix<double>& lower, PetscInt first, PetscInt last,
                             const Add& add)
  {
    const int *starts = lower.outerIndexPtr(), *rows = lower.innerIndexPtr();
    for(int j = 0; j < last; ++j) {
      const int* row = rows + starts[j];
      const int* const end = rows + starts[j + 1];
      if(j < first)
        row = std::lower_bound(row, end, int(first));
      for(; row != end; ++row) {
        const double value = lower.valuePtr()[row - rows];
        if(*row < last)
          add(PetscInt(*row), PetscInt(j), value);
        if(j >= first && *row != j)
          add(PetscInt(j), PetscInt(*row), value);
      }
    }
  }
};

/// A matrix whose rows are spread over the processes, and the solver for the matrix. All processes call all
/// functions, in the same order.
class Petsc_system
{
  Petsc_message m_message;
  std::vector<int> m_counts, m_starts; // numbers of unknowns of each process, and their starts
  Mat m_matrix = nullptr;
  KSP m_solver = nullptr;
  Vec m_right = nullptr, m_solution = nullptr;

public:
  /// \param lower the lower triangle, and \param near orthonormal vectors that the matrix nearly maps to
  /// zero; both in the first process only
  Petsc_system(const Petsc_message& message, const Eigen::SparseMatrix<double>* lower,
               const Eigen::MatrixXd* near)
    : m_message(message)
  {
    try {
      distribute(lower);
      set_near_kernel(near);
      set_up();
    } catch(...) {
      release();
      throw;
    }
  }

  Petsc_system(const Petsc_system&) = delete;
  Petsc_system& operator=(const Petsc_system&) = delete;
  ~Petsc_system() { release(); }

  /// \param b, x vectors of all unknowns, in the first process only
  /// \return whether the solver converged: the same in all processes
  bool solve(double tolerance, const double* b, double* x, int& number_of_iterations)
  {
    check_petsc(KSPSetTolerances(m_solver, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
    scatter(b, m_right);
    check_petsc(KSPSolve(m_solver, m_right, m_solution));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    check_petsc(KSPGetConvergedReason(m_solver, &reason));
    check_petsc(KSPGetIterationNumber(m_solver, &iterations));
    number_of_iterations = int(iterations);
    gather(m_solution, x);
    return reason > 0;
  }

private:
  // Distributes contiguous rows, the unknowns of a node together.
  void distribute(const Eigen::SparseMatrix<double>* lower)
  {
    const PetscInt nodes = m_message.size / m_message.block_size;
    const int size = petsc_size(), rank = petsc_rank();
    const auto first = [&](int r) { return PetscInt(m_message.block_size * ((long long)(nodes)*r / size)); };
    for(int r = 0; r < size; ++r) {
      m_starts.push_back(int(first(r)));
      m_counts.push_back(int(first(r + 1) - first(r)));
    }
    Petsc_rows rows;
    if(rank == 0) {
      for(int r = size - 1; r > 0; --r)
        Petsc_rows(*lower, first(r), first(r + 1)).send(r);
      rows = Petsc_rows(*lower, 0, first(1));
    } else {
      rows.receive(std::size_t(m_counts[std::size_t(rank)]));
    }
    const PetscInt own = m_counts[std::size_t(rank)];
    check_petsc(MatCreate(PETSC_COMM_WORLD, &m_matrix));
    check_petsc(MatSetSizes(m_matrix, own, own, m_message.size, m_message.size));
    check_petsc(MatSetBlockSize(m_matrix, m_message.block_size));
    check_petsc(MatSetType(m_matrix, MATAIJ));
    // One of the two calls is for the type that the matrix has.
    check_petsc(
      MatSeqAIJSetPreallocationCSR(m_matrix, rows.starts.data(), rows.columns.data(), rows.values.data()));
    check_petsc(
      MatMPIAIJSetPreallocationCSR(m_matrix, rows.starts.data(), rows.columns.data(), rows.values.data()));
    check_petsc(MatSetOption(m_matrix, MAT_SPD, PETSC_TRUE));
    check_petsc(MatCreateVecs(m_matrix, &m_solution, &m_right));
  }

  void set_near_kernel(const Eigen::MatrixXd* near)
  {
    if(m_message.number_of_near == 0)
      return;
    std::vector<Vec> vectors(std::size_t(m_message.number_of_near), nullptr);
    for(std::size_t i = 0; i < vectors.size(); ++i) {
      check_petsc(VecDuplicate(m_right, &vectors[i]));
      scatter(near == nullptr ? nullptr : near->data() + Eigen::Index(i) * near->rows(), vectors[i]);
    }
    MatNullSpace kernel = nullptr;
    check_petsc(
      MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, PetscInt(vectors.size()), vectors.data(), &kernel));
    check_petsc(MatSetNearNullSpace(m_matrix, kernel));
    check_petsc(MatNullSpaceDestroy(&kernel));
    for(Vec& vector : vectors)
      check_petsc(VecDestroy(&vector));
  }

  void set_up()
  {
    constexpr PetscInt largest_number_of_iterations = 1000; // some tens are usual
    check_petsc(KSPCreate(PETSC_COMM_WORLD, &m_solver));
    check_petsc(KSPSetOperators(m_solver, m_matrix, m_matrix));
    check_petsc(KSPSetType(m_solver, KSPCG));
    check_petsc(KSPSetNormType(m_solver, KSP_NORM_NATURAL)); // the norm is the energy of the error
    check_petsc(KSPSetTolerances(m_solver, m_message.tolerance, PETSC_DEFAULT, PETSC_DEFAULT,
                                 largest_number_of_iterations));
    PC preconditioner = nullptr;
    check_petsc(KSPGetPC(m_solver, &preconditioner));
    check_petsc(PCSetType(preconditioner, PCGAMG));
    check_petsc(KSPSetFromOptions(m_solver));
    check_petsc(KSPSetUp(m_solver));
  }

  void scatter(const double* all, Vec vector) const
  {
    double* own = nullptr;
    check_petsc(VecGetArray(vector, &own));
    MPI_Scatterv(all, m_counts.data(), m_starts.data(), MPI_DOUBLE, own, m_counts[std::size_t(petsc_rank())],
                 MPI_DOUBLE, 0, PETSC_COMM_WORLD);
    check_petsc(VecRestoreArray(vector, &own));
  }

  void gather(Vec vector, double* all) const
  {
    const double* own = nullptr;
    check_petsc(VecGetArrayRead(vector, &own));
    MPI_Gatherv(own, m_counts[std::size_t(petsc_rank())], MPI_DOUBLE, all, m_counts.data(), m_starts.data(),
                MPI_DOUBLE, 0, PETSC_COMM_WORLD);
    check_petsc(VecRestoreArrayRead(vector, &own));
  }

  void release()
  {
    KSPDestroy(&m_solver);
    VecDestroy(&m_right);
    VecDestroy(&m_solution);
    MatDestroy(&m_matrix);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_PETSC_INTERNAL_PETSC_SYSTEM_H
