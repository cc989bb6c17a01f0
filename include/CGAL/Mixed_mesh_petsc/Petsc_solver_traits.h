// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conjugate gradients with algebraic multigrid of PETSc, in the processes of mpirun. This header needs PETSc
// (real numbers) and MPI; the CMake target CGAL::Mixed_mesh_3_petsc has both.

#ifndef CGAL_MIXED_MESH_PETSC_PETSC_SOLVER_TRAITS_H
#define CGAL_MIXED_MESH_PETSC_PETSC_SOLVER_TRAITS_H

#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_petsc/Petsc_session.h>
#include <CGAL/Mixed_mesh_petsc/internal/Petsc_system.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {

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

#endif // CGAL_MIXED_MESH_PETSC_PETSC_SOLVER_TRAITS_H
