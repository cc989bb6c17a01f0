// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solver of sparse systems as the method of elasticity calls it, whatever its class is. The cost of a
// virtual call is nothing beside a factorization or a solution, and the method can be compiled once.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_SOLVER_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_SOLVER_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>

#include <Eigen/Core>

#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A solver with its matrix, which is symmetric and positive definite.
class Elasticity_solver
{
public:
  Elasticity_solver() = default;
  // The class is not copyable: solvers of the concept need not be movable, and refer to their matrix.
  Elasticity_solver(const Elasticity_solver&) = delete;
  Elasticity_solver& operator=(const Elasticity_solver&) = delete;
  virtual ~Elasticity_solver() = default;

  virtual bool has_matrix() const = 0;
  virtual void clear_matrix() = 0;
  /// Sets the lower triangle in compressed columns, rows ascending.
  virtual void set_matrix(const std::vector<int>& starts, const std::vector<int>& rows,
                          const std::vector<double>& values) = 0;

  /// Whether the solver takes the vectors that the matrix nearly maps to zero, as iterative solvers do.
  virtual bool wants_near_kernel() const = 0;
  /// Sets columns that the matrix nearly maps to zero, three unknowns for each vertex. \pre
  /// `wants_near_kernel()`
  virtual void set_near_kernel(Eigen::MatrixXd vectors) = 0;

  /// Factors the matrix. \return whether the matrix is positive definite. \pre `has_matrix()`
  virtual bool factor() = 0;
  /// Solves for the columns of `b`. \pre the matrix is factored
  virtual bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) = 0;
};

/// The call of `set_near_kernel()`, for solvers that have such a function: iterative ones.
struct Set_near_kernel
{
  template <class Solver>
  auto operator()(Solver& solver, Eigen::MatrixXd vectors) const
    -> decltype(solver.set_near_kernel(std::move(vectors), 3))
  {
    return solver.set_near_kernel(std::move(vectors), 3);
  }
};

/// \tparam SolverTraits a model of `SparseLinearAlgebraWithFactorTraits_d`, which need not be movable
template <class SolverTraits>
class Elasticity_solver_adaptor final : public Elasticity_solver
{
  static constexpr bool has_near_kernel =
    std::is_invocable_v<Set_near_kernel, SolverTraits&, Eigen::MatrixXd>;

  using Matrix = typename Matrix_of_solver<SolverTraits>::type;

  std::optional<Matrix> m_matrix; // must outlive the factorization
  SolverTraits m_traits;

public:
  SolverTraits& traits() { return m_traits; }

  bool has_matrix() const override { return m_matrix.has_value(); }
  void clear_matrix() override { m_matrix.reset(); }
  void set_matrix(const std::vector<int>& starts, const std::vector<int>& rows,
                  const std::vector<double>& values) override
  {
    m_matrix.emplace(make_matrix<Matrix>(starts, rows, values));
  }

  bool wants_near_kernel() const override { return has_near_kernel; }
  void set_near_kernel([[maybe_unused]] Eigen::MatrixXd vectors) override
  {
    if constexpr(has_near_kernel)
      Set_near_kernel()(m_traits, std::move(vectors));
  }

  bool factor() override
  {
    typename SolverTraits::NT denominator = 1;
    return m_traits.factor(*m_matrix, denominator);
  }
  bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) override { return solve_columns(m_traits, b, x); }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_SOLVER_H
