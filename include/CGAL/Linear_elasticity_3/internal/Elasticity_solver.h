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

#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
#include <CGAL/Linear_elasticity_3/internal/Partial_factor.h>
#endif
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>

#include <Eigen/Core>

#include <cstddef>
#include <memory>
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

  /// Selects unknowns for `solve_selected()`, until the matrix changes. \pre the matrix is factored
  virtual void select(const std::vector<int>& unknowns) = 0;
  /// Solves for a right-hand side that is zero but for the selected unknowns, and returns their solution; a
  /// solver may do so in single precision. \pre `select()` was called since the matrix was factored
  virtual bool solve_selected(const Eigen::VectorXd& b, Eigen::VectorXd& x) = 0;
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

/// The supernodal factor, of solvers that have one.
struct Supernodal_factor
{
  template <class Solver>
  auto operator()(Solver& solver) const -> decltype(solver.solver().supernodal_factor())
  {
    return solver.solver().supernodal_factor();
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
  std::vector<int> m_selected;
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
  std::unique_ptr<Partial_factor> m_partial_factor; // of the selected unknowns, if the factor is supernodal
#endif

public:
  SolverTraits& traits() { return m_traits; }

  bool has_matrix() const override { return m_matrix.has_value(); }
  void clear_matrix() override
  {
    clear_selection();
    m_matrix.reset();
  }
  void set_matrix(const std::vector<int>& starts, const std::vector<int>& rows,
                  const std::vector<double>& values) override
  {
    clear_selection();
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
    clear_selection();
    typename SolverTraits::NT denominator = 1;
    return m_traits.factor(*m_matrix, denominator);
  }
  bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) override { return solve_columns(m_traits, b, x); }

  void select(const std::vector<int>& unknowns) override
  {
    if(m_selected == unknowns)
      return;
    clear_selection();
    m_selected = unknowns;
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
    if constexpr(std::is_invocable_v<Supernodal_factor, SolverTraits&>)
      if(const auto& factor = Supernodal_factor()(m_traits); Partial_factor::is_supported(factor))
        m_partial_factor = std::make_unique<Partial_factor>(factor, unknowns);
#endif
  }

  bool solve_selected(const Eigen::VectorXd& b, Eigen::VectorXd& x) override
  {
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
    if(m_partial_factor) {
      x = m_partial_factor->solve(b);
      return x.allFinite();
    }
#endif
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(Eigen::Index(m_matrix->row_dimension()), 1), solution;
    for(std::size_t i = 0; i < m_selected.size(); ++i)
      all(m_selected[i], 0) = b[Eigen::Index(i)];
    if(!solve(all, solution))
      return false;
    x.resize(b.size());
    for(std::size_t i = 0; i < m_selected.size(); ++i)
      x[Eigen::Index(i)] = solution(m_selected[i], 0);
    return x.allFinite();
  }

private:
  void clear_selection()
  {
    m_selected.clear();
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
    m_partial_factor.reset();
#endif
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_SOLVER_H
