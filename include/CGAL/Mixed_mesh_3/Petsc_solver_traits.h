// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conjugate gradients with algebraic multigrid of PETSc, in the processes of mpirun. No other header includes
// this header, which needs PETSc (real numbers) and MPI; the CMake target CGAL::Mixed_mesh_3_petsc has both.

#ifndef CGAL_MIXED_MESH_3_PETSC_SOLVER_TRAITS_H
#define CGAL_MIXED_MESH_3_PETSC_SOLVER_TRAITS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>
#include <petscksp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
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

/*!
\ingroup PkgMixedMesh3Solvers

\brief Solves symmetric positive definite systems with conjugate gradients of PETSc, preconditioned by its
algebraic multigrid GAMG (smoothed aggregation), in all processes of a `Petsc_session`.

The solver is for systems that no direct solver can factor: memory and time are linear in the number of
unknowns, where the factor of a million vertices of a solid has thousands of entries for each vertex. Direct
solvers are faster for small systems, and for many right-hand sides.

`factor()` gives each process a contiguous part of the rows, and sets up the preconditioner; it does not find
out whether the matrix is positive definite, unless the diagonal tells. `linear_solver()` iterates until the
energy norm of the error, as the preconditioner estimates it, is `tolerance()` times the initial one.
Solutions differ by as much with the number of processes; with the same number, solutions are the same.

A copy is the same solver, as with `Symmetric_solver_traits`. PETSc's options apply (`-pc_type`,
`-pc_gamg_threshold`, `-ksp_monitor`), by the environment variable `PETSC_OPTIONS`.

\cgalModels{SparseLinearAlgebraWithFactorTraits_d}

\pre there is a `Petsc_session`, and this is its first process

\par Complexity
Linear, for each iteration and for the preconditioner. The number of iterations grows slowly, if at all, with
the number of unknowns; it grows with Poisson's ratio. Memory: see the manual of Linear_elasticity_3.
*/
class Petsc_solver_traits
{
public:
  /// The number type.
  using NT = double;
  /// The type of right-hand sides and solutions.
  using Vector = CGAL::Eigen_vector<double>;
  /// The lower triangle of a symmetric matrix; the upper one is ignored.
  using Matrix = Simplicial_solver_traits::Matrix;

  /// The accuracy of solutions: energy norm of the error, relative. Default: 1e-10.
  double tolerance() const { return m_state->tolerance; }
  /// Sets the tolerance for the next solutions. \pre `tolerance` is positive
  void set_tolerance(double tolerance)
  {
    CGAL_precondition(tolerance > 0);
    m_state->tolerance = tolerance;
  }

  /// Sets the vectors that the coarse unknowns of multigrid have to represent, for the next `factor()`,
  /// because the preconditioner needs them for elasticity. The function is an optional member of solvers:
  /// `Linear_elasticity_3` calls it, if there is one, with the rigid motions.
  /// \param vectors columns that the matrix nearly maps to zero; they need not be independent
  /// \param block_size number of consecutive unknowns that belong to one vertex
  void set_near_kernel(Eigen::MatrixXd vectors, int block_size)
  {
    m_state->near_kernel = orthonormal(std::move(vectors));
    m_state->block_size = block_size;
  }

  /// Sets up the preconditioner.
  /// \param matrix matrix, which is not needed any more when the function returns
  /// \param denominator set to 1
  /// \return false if the diagonal is not positive, a number not finite, or PETSc fails
  bool factor(const Matrix& matrix, NT& denominator)
  {
    denominator = 1;
    return m_state->factor(matrix.eigen_object());
  }

  /// Solves with the matrix given to `factor()`.
  /// \param b the right-hand side
  /// \param x the solution; its value on entry does not matter
  /// \return whether the solver converged, within 1,000 iterations
  bool linear_solver(const Vector& b, Vector& x) { return m_state->solve(b, x); }

  /// Sets up the preconditioner, then solves for one right-hand side.
  bool linear_solver(const Matrix& a, const Vector& b, Vector& x, NT& denominator)
  {
    return factor(a, denominator) && linear_solver(b, x);
  }

  /// The number of iterations of the last solution.
  int number_of_iterations() const { return m_state->iterations; }
  /// The largest number of iterations of a solution since `factor()`.
  int largest_number_of_iterations() const { return m_state->most_iterations; }

  /// The number of processes of the `Petsc_session`.
  int number_of_processes() const { return internal::petsc_size(); }

private:
  static Eigen::MatrixXd orthonormal(Eigen::MatrixXd vectors)
  {
    constexpr double dependent = 1e-8; // relative length of the rest of a dependent vector
    Eigen::Index n = 0;
    for(Eigen::Index c = 0; c < vectors.cols(); ++c) {
      Eigen::VectorXd v = vectors.col(c);
      const double length = v.norm();
      for(int pass = 0; pass < 2; ++pass) // a second pass, as rounding errors are left
        for(Eigen::Index i = 0; i < n; ++i)
          v -= vectors.col(i).dot(v) * vectors.col(i);
      if(v.norm() > dependent * length)
        vectors.col(n++) = v.normalized();
    }
    vectors.conservativeResize(Eigen::NoChange, n);
    return vectors;
  }

  struct State
  {
    double tolerance = 1e-10;
    Eigen::MatrixXd near_kernel;
    int block_size = 1, iterations = 0, most_iterations = 0, number = 0;
    std::unique_ptr<internal::Petsc_system> system;

    ~State() { release(); }

    bool factor(const Eigen::SparseMatrix<double>& lower)
    {
      release();
      most_iterations = 0;
      const PetscInt n = PetscInt(lower.cols());
      // Invalid input is detected here, because it would end several processes.
      for(PetscInt j = 0; j < n; ++j)
        if(!(lower.coeff(j, j) > 0))
          return false;
      for(Eigen::Index k = 0; k < lower.nonZeros(); ++k)
        if(!std::isfinite(lower.valuePtr()[k]))
          return false;
      const bool has_kernel = near_kernel.rows() == n && n % block_size == 0;
      static int last_number = 0; // number by which processes identify systems
      number = ++last_number;
      internal::Petsc_message message{
        internal::Petsc_command::FACTOR,          number,   n, has_kernel ? block_size : 1,
        has_kernel ? int(near_kernel.cols()) : 0, tolerance};
      internal::share(message);
      try {
        internal::abort_all_on_exception(
          [&] { system = std::make_unique<internal::Petsc_system>(message, &lower, &near_kernel); });
      } catch(const internal::Petsc_error&) { // error of the only process
        return false;
      }
      return true;
    }

    bool solve(const Vector& b, Vector& x)
    {
      CGAL_precondition(system != nullptr);
      internal::Petsc_message message{internal::Petsc_command::SOLVE, number, 0, 0, 0, tolerance};
      x.eigen_object().resize(b.size()); // so that a failure from here on keeps no process waiting
      internal::share(message);
      try {
        const bool is_solved = internal::abort_all_on_exception(
          [&] { return system->solve(tolerance, b.data(), x.eigen_object().data(), iterations); });
        most_iterations = (std::max)(most_iterations, iterations);
        return is_solved;
      } catch(const internal::Petsc_error&) {
        return false;
      }
    }

    void release()
    {
      if(!system)
        return;
      internal::Petsc_message message{internal::Petsc_command::RELEASE, number, 0, 0, 0, 0};
      internal::share(message);
      system.reset();
    }
  };

  std::shared_ptr<State> m_state = std::make_shared<State>();
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_PETSC_SOLVER_TRAITS_H
