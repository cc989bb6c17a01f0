// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sparse solvers of Eigen and, if `CGAL_MIXED_MESH_3_USE_CHOLMOD` is defined, of SuiteSparse. The user
// defines the macro if the program is linked with CHOLMOD; the CMake target defines it if CHOLMOD was found.

#ifndef CGAL_MIXED_MESH_3_SYMMETRIC_SOLVER_TRAITS_H
#define CGAL_MIXED_MESH_3_SYMMETRIC_SOLVER_TRAITS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Eigen_sparse_matrix.h>
#include <CGAL/Eigen_vector.h>

#include <CGAL/assertions.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <algorithm>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMesh3Solvers

\brief Solves symmetric positive definite systems with a solver of Eigen.

The class keeps the symbolic factorization as long as the pattern of the matrix is the same, where
`CGAL::Eigen_solver_traits` starts again at each `factor()`. An iterative solver starts from the given `X`.

Solvers of Eigen cannot be copied. A copy is the same solver, as with `CGAL::Eigen_solver_traits`: the matrix
that was factored last, by any of the copies, is the matrix of all.

\cgalModels{SparseLinearAlgebraWithFactorTraits_d}

\tparam EigenSolver a sparse solver of Eigen that reads the lower triangle of an
        `Eigen::SparseMatrix<double>`
*/
template <class EigenSolver>
class Symmetric_solver_traits
{
public:
  /// The number type.
  using NT = double;
  /// The type of right-hand sides and solutions.
  using Vector = CGAL::Eigen_vector<double>;

  /// The lower triangle of a symmetric matrix; the upper one is ignored.
  struct Matrix : CGAL::Eigen_sparse_symmetric_matrix<double>
  {
    /// The matrix of CGAL, the base of this class, which adds a constructor.
    using Base = CGAL::Eigen_sparse_symmetric_matrix<double>;
    using Base::Base;

    /// Constructs a matrix from the lower triangle in compressed columns, rows ascending.
    Matrix(const std::vector<int>& starts, const std::vector<int>& rows, const std::vector<double>& values)
      : Base(int(starts.size() - 1))
    {
      const int n = int(starts.size() - 1);
      this->eigen_object() = Eigen::Map<const Eigen::SparseMatrix<double>>(n, n, Eigen::Index(rows.size()),
                                                                           starts.data(), rows.data(),
                                                                           values.data());
    }
  };

  /// Eigen's solver, to set its parameters.
  EigenSolver& solver() { return m_state->solver; }

  /// \param matrix matrix, which must live as long as systems are solved with it
  /// \param denominator number that is set to 1
  /// \return whether the matrix is positive definite
  /// \throw std::bad_alloc if there is no memory for the factor, or if it has more entries than the solver's
  /// indices can count
  bool factor(const Matrix& matrix, NT& denominator)
  {
    denominator = 1;
    const Eigen::SparseMatrix<double>& a = matrix.eigen_object();
    const int *starts = a.outerIndexPtr(), *rows = a.innerIndexPtr();
    const bool has_same_pattern = std::equal(starts, starts + a.cols() + 1, m_state->starts.begin(),
                                             m_state->starts.end())
                                  && std::equal(rows, rows + a.nonZeros(), m_state->rows.begin(),
                                                m_state->rows.end());
    if(!has_same_pattern) {
      m_state->starts.clear();
      solver().analyzePattern(a);
      m_state->starts.assign(starts, starts + a.cols() + 1);
      m_state->rows.assign(rows, rows + a.nonZeros());
    }
    solver().factorize(a);
    return solver().info() == Eigen::Success;
  }

  /// Solves with the matrix given to `factor()`.
  /// \param b the right-hand side
  /// \param x the solution; a first guess on entry, if it has the dimension of `b`
  bool linear_solver(const Vector& b, Vector& x)
  {
    CGAL_precondition(!m_state->starts.empty());
    if constexpr(is_iterative)
      x = x.size() == b.size() ? solver().solveWithGuess(b, x.eigen_object()).eval()
                               : solver().solve(b).eval();
    else
      x = solver().solve(b);
    return solver().info() == Eigen::Success;
  }

  /// Solves for several right-hand sides at once, the columns of `b`, which is faster than solving one by
  /// one.
  bool linear_solver(const Eigen::MatrixXd& b, Eigen::MatrixXd& x)
  {
    CGAL_precondition(!m_state->starts.empty());
    x = solver().solve(b);
    return solver().info() == Eigen::Success;
  }

  /// Factors the matrix, then solves for one right-hand side.
  bool linear_solver(const Matrix& a, const Vector& b, Vector& x, NT& denominator)
  {
    return factor(a, denominator) && linear_solver(b, x);
  }

private:
  static constexpr bool is_iterative =
    std::is_base_of_v<Eigen::IterativeSolverBase<EigenSolver>, EigenSolver>;

  struct State
  {
    EigenSolver solver;
    std::vector<int> starts, rows; // the pattern that has been analyzed
  };

  std::shared_ptr<State> m_state = std::make_shared<State>();
};

/// \ingroup PkgMixedMesh3Solvers
/// Conjugate gradients with Jacobi's preconditioner. The fastest solver where few layers of vertices move.
using Conjugate_gradient_solver_traits =
  Symmetric_solver_traits<Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower>>;

/// \ingroup PkgMixedMesh3Solvers
/// Eigen's simplicial factorization.
using Simplicial_solver_traits = Symmetric_solver_traits<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>;

#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
namespace internal {

// CHOLMOD without messages: the status tells whether a matrix is positive definite.
class Quiet_cholmod : public Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>
{
  using Base = Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>;

public:
  Quiet_cholmod() { this->cholmod().print = 0; }

  void analyzePattern(const Eigen::SparseMatrix<double>& a)
  {
    Base::analyzePattern(a);
    check_memory();
  }

  void factorize(const Eigen::SparseMatrix<double>& a)
  {
    Base::factorize(a);
    check_memory();
  }

  const cholmod_factor& supernodal_factor() const { return *this->m_cholmodFactor; }

private:
  // Throws if there is no factor, or if the factor has more entries than its indices can count; Eigen would
  // go on.
  void check_memory()
  {
    if(this->cholmod().status == CHOLMOD_OUT_OF_MEMORY || this->cholmod().status == CHOLMOD_TOO_LARGE)
      throw std::bad_alloc();
  }
};

} // namespace internal

/// \ingroup PkgMixedMesh3Solvers
/// The supernodal factorization of CHOLMOD. The fastest direct solver for large systems, with a good BLAS.
using Cholmod_solver_traits = Symmetric_solver_traits<internal::Quiet_cholmod>;
/// \ingroup PkgMixedMesh3Solvers
/// The fastest direct solver that is available.
using Direct_solver_traits = Cholmod_solver_traits;
#else
using Direct_solver_traits = Simplicial_solver_traits;
#endif

namespace internal {

struct Solve_columns
{
  template <class Solver>
  auto operator()(Solver& solver, const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const
    -> decltype(solver.linear_solver(b, x))
  {
    return solver.linear_solver(b, x);
  }
};

/// Solves for the columns of `b`: at once if the solver is able to, else one by one.
template <class Solver>
bool solve_columns(Solver& solver, const Eigen::MatrixXd& b, Eigen::MatrixXd& x)
{
  if constexpr(std::is_invocable_v<decltype(Solve_columns()), Solver&, const Eigen::MatrixXd&,
                                   Eigen::MatrixXd&>) {
    return Solve_columns()(solver, b, x);
  } else {
    x.resize(b.rows(), b.cols());
    for(Eigen::Index c = 0; c < b.cols(); ++c) {
      typename Solver::Vector right{std::size_t(b.rows())}, solution{std::size_t(b.rows())};
      for(Eigen::Index i = 0; i < b.rows(); ++i)
        right[i] = b(i, c);
      if(!solver.linear_solver(right, solution))
        return false;
      for(Eigen::Index i = 0; i < b.rows(); ++i)
        x(i, c) = solution[i];
    }
    return true;
  }
}

} // namespace internal

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SYMMETRIC_SOLVER_TRAITS_H
