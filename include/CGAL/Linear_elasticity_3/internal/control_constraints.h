// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Given displacements at points of an elastic body, as constraints on a system that is factored without the
// constraints.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_CONSTRAINTS_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_CONSTRAINTS_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Linear_elasticity_result_3.h>
#include <CGAL/Linear_elasticity_3/internal/Control_options.h>
#include <CGAL/Linear_elasticity_3/internal/rigid_modes.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

struct Control_solution
{
  Eigen::VectorXd displacements, forces; // three for each node; three for each control point
};

/*!
The displacements u and the forces s on the control points satisfy, with the stiffness K, the weights B of the
control points, their compliances C (diagonal) and the free rigid motions R (K R = 0),

    K u = f + B^T s,   B u + C s = d,   R^T (f + B^T s) = 0.

K is held by as many springs as there are free motions; springs bear no forces as loads are in equilibrium: so
u = K^-1 f + W s + R c with W = K^-1 B^T, and a dense system for s and c remains, with S = B W and G = B R.
The dense system is solved as by augmented Lagrangians, with S + g G G^T for S, which is positive definite
except for constraints that depend on others. These constraints are left out, and must be satisfied by
themselves.
*/
class Control_constraints
{
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  using Index = Eigen::Index;

  // Relative bounds. A constraint with a pivot below `dependence` depends on others and is left out; it must
  // be satisfied by itself within `miss` of the largest displacement. A factor of 1,000 rows has errors of
  // 1,000 roundings of 2^-53, a thousandth of `dependence`; `miss` is 10 nm of a displacement of 10 mm.
  static constexpr double dependence = 1e-10, miss = 1e-6;
  static constexpr Index columns_at_once = 24; // eight points: bounds the memory

  std::vector<Control_weights> m_weights;
  Vector m_compliances; // three compliances for each control point
  bool m_is_solved = true;
  Matrix m_response, m_motions; // W, R
  Matrix m_g, m_kernel;         // G; combinations of motions that the control points do not hold
  double m_augmentation = 0;    // g
  std::vector<Index> m_independent;
  // Factor of the rows and columns m_independent of the augmented S. Factors that are not computed do not
  // exist, because they could not be moved: their members have no value.
  std::optional<Eigen::LLT<Matrix>> m_factor;
  Matrix m_g_independent, m_eliminated;
  std::optional<Eigen::LDLT<Matrix>> m_schur;

public:
  /// \param compliances compliance of each control point: all zero, or all positive
  /// \param points positions of the vertices, the first nodes: rigid motions do not move the others
  /// \param supports supports of the nodes
  /// \param solve `bool(forces, displacements)`: K^-1, for several columns
  Control_constraints(std::vector<Control_weights> weights, const std::vector<double>& compliances,
                      const std::vector<Free_motion>& motions, const std::vector<Vec3>& points,
                      const std::vector<Support>& supports,
                      const std::function<bool(const Matrix&, Matrix&)>& solve)
    : m_weights(std::move(weights)), m_compliances(3 * Index(m_weights.size()))
  {
    for(std::size_t p = 0; p < m_weights.size(); ++p)
      m_compliances.segment<3>(3 * Index(p)).setConstant(compliances[p]);
    const Index n = 3 * Index(supports.size()), rows = 3 * Index(m_weights.size());
    m_motions = Matrix::Zero(n, Index(motions.size()));
    for(std::size_t m = 0; m < motions.size(); ++m)
      for(Vertex_index v : motions[m].vertices) {
        const Vec3 u = supports[v].free_part(motions[m].mode(points[v]));
        for(int k = 0; k < 3; ++k)
          m_motions(3 * Index(v) + k, Index(m)) = u[k];
      }
    m_response.resize(n, rows);
    for(Index first = 0; first < rows; first += columns_at_once) {
      const Index size = (std::min)(columns_at_once, rows - first);
      Matrix forces = Matrix::Zero(n, size), u;
      for(Index c = 0; c < size; ++c)
        for(const auto& [v, w] : m_weights[std::size_t(first + c) / 3])
          forces(3 * Index(v) + (first + c) % 3, c) = w;
      m_is_solved = solve(forces, u);
      if(!m_is_solved)
        return;
      m_response.middleCols(first, size) = u;
    }
    eliminate();
  }

  bool is_solved() const { return m_is_solved; }
  /// Whether the points give way to forces.
  bool is_compliant() const { return m_compliances.size() > 0 && m_compliances[0] > 0; }
  /// The compliances, three for each control point; all zero, or all positive.
  const Vector& compliances() const { return m_compliances; }

  /// The product B u, for each column.
  Matrix at_points(const Matrix& u) const
  {
    Matrix at = Matrix::Zero(3 * Index(m_weights.size()), u.cols());
    for(std::size_t p = 0; p < m_weights.size(); ++p)
      for(const auto& [v, w] : m_weights[p])
        at.middleRows<3>(3 * Index(p)) += w * u.middleRows<3>(3 * Index(v));
    return at;
  }

  /// \param loaded the solution for the load without control points
  /// \param load the right-hand side f of that solution
  /// \param wanted displacements of the control points
  Linear_elasticity_result_3 solve(const Vector& loaded, const Vector& load, const Vector& wanted,
                                   const std::vector<Free_motion>& motions, Control_solution& solution) const
  {
    Linear_elasticity_result_3 result;
    if(m_kernel.cols() > 0) {
      result.status = Linear_elasticity_status::FREE_RIGID_MOTION;
      result.number_of_free_motions = int(m_kernel.cols());
      result.motion = combination(motions, m_kernel.col(0));
      return result;
    }
    Vector c;
    eliminate(wanted - at_points(loaded), -(m_motions.transpose() * load), solution.forces, c);
    solution.displacements = loaded;
    if(wanted.size() > 0)
      solution.displacements += m_response * solution.forces;
    if(c.size() > 0)
      solution.displacements += m_motions * c;

    const Vector missed = at_points(solution.displacements) + m_compliances.cwiseProduct(solution.forces)
                          - wanted;
    const double bound = tolerance(solution.displacements, wanted);
    for(std::size_t p = 0; p < m_weights.size(); ++p) {
      const double distance = missed.segment<3>(3 * Index(p)).norm();
      if(distance > bound && distance > result.distance) {
        result.status = Linear_elasticity_status::CONTRADICTORY_CONTROL_POINTS;
        result.control_point = p;
        result.distance = distance;
      }
    }
    return result;
  }

  /// The rows of some nodes of W and R.
  struct Rows
  {
    Matrix response, motions;
  };

  Rows rows_of(const std::vector<Vertex_index>& vertices) const
  {
    const Index n = 3 * Index(vertices.size());
    Rows rows{Matrix(n, m_response.cols()), Matrix(n, m_motions.cols())};
    for(std::size_t i = 0; i < vertices.size(); ++i) {
      rows.response.middleRows<3>(3 * Index(i)) = m_response.middleRows<3>(3 * Index(vertices[i]));
      rows.motions.middleRows<3>(3 * Index(i)) = m_motions.middleRows<3>(3 * Index(vertices[i]));
    }
    return rows;
  }

  /// Adds, to the displacements K^-1 f of some nodes, those by which the control points come to rest.
  /// \param f forces on these nodes, none on others
  void hold(const Rows& rows, const Vector& f, Vector& displacements) const
  {
    Vector s, c;
    eliminate(-(rows.response.transpose() * f), -(rows.motions.transpose() * f), s, c);
    displacements += rows.response * s + rows.motions * c;
  }

  /// The nodes, and their weights, whose weighted sum of displacements is that of each control point.
  const std::vector<Control_weights>& weights() const { return m_weights; }

  /// Whether the control points move only nodes of a set.
  bool is_on(const std::vector<bool>& nodes) const
  {
    for(const Control_weights& weights : m_weights)
      for(const auto& weight : weights)
        if(!nodes[weight.first])
          return false;
    return true;
  }

  /// Whether the displacements are the wanted ones, up to rounding. \pre there is no compliance
  bool is_satisfied(const Vector& u, const Vector& wanted) const
  {
    return wanted.size() == 0 || (at_points(u) - wanted).lpNorm<Eigen::Infinity>() <= tolerance(u, wanted);
  }

  /// Adds B^T s.
  void add_forces(const Vector& s, Vector& f) const
  {
    for(std::size_t p = 0; p < m_weights.size(); ++p)
      for(const auto& [v, w] : m_weights[p])
        f.segment<3>(3 * Index(v)) += w * s.segment<3>(3 * Index(p));
  }

  /*!
  The displacement that each control point would miss if it were not among them. Forces are affine in the
  wanted displacements, s = P d + ..., so that the displacement that point p has without a force of its own is
  d_p - P_pp^-1 s_p: as for any linear smoother, no system is solved again (Craven, Wahba 1979).

  \param forces forces of the solution
  \return three components for each point; infinite where the others would not hold the body
  */
  Vector leave_one_out(const Vector& forces) const
  {
    const Index n = forces.size(), motions = m_motions.cols();
    Vector missed(n);
    if(n == 0)
      return missed;
    Matrix s = flexibility();
    const Matrix held = m_g.transpose() * m_g;
    if(motions > 0)
      s += m_augmentation * m_g * m_g.transpose();
    // The addition lets points that depend on others share their forces.
    const double smallest = dependence * s.diagonal().maxCoeff();
    s.diagonal().array() += smallest;
    Matrix p = Eigen::LLT<Matrix>(s).solve(Matrix::Identity(n, n));
    if(motions > 0) {
      const Matrix e = p * m_g;
      p -= e * Eigen::LDLT<Matrix>(m_g.transpose() * e).solve(e.transpose());
    }
    const Vector shared = forces - smallest * (p * forces);
    for(Index i = 0; i < n; i += 3) {
      const auto g = m_g.middleRows<3>(i);
      if(motions > 0 && is_singular(held - g.transpose() * g, held.trace()))
        missed.segment<3>(i).setConstant(std::numeric_limits<double>::infinity());
      else
        missed.segment<3>(i) = p.block<3, 3>(i, i).ldlt().solve(shared.segment<3>(i));
    }
    return missed;
  }

private:
  static bool is_singular(const Matrix& held, double scale)
  {
    return Eigen::SelfAdjointEigenSolver<Matrix>(held, Eigen::EigenvaluesOnly).eigenvalues()[0]
           <= dependence * scale;
  }

  static double tolerance(const Vector& u, const Vector& wanted)
  {
    const auto largest = [](const Vector& x) { return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0; };
    return miss * (std::max)(largest(u), largest(wanted));
  }

  // Forces s and motions c, for displacements of the control points and a sum of forces.
  void eliminate(const Vector& displacements, const Vector& equilibrium, Vector& forces, Vector& c) const
  {
    const Vector right = displacements + m_augmentation * (m_g * equilibrium);
    Vector s = m_factor ? m_factor->solve(pick(right)).eval() : Vector();
    c = Vector::Zero(m_motions.cols());
    if(c.size() > 0) {
      c = m_schur->solve(m_g_independent.transpose() * s - equilibrium);
      s -= m_eliminated * c;
    }
    forces = Vector::Zero(displacements.size());
    for(std::size_t i = 0; i < m_independent.size(); ++i)
      forces[m_independent[i]] = s[Index(i)];
  }

  Vector pick(const Vector& x) const
  {
    Vector y(Index(m_independent.size()));
    for(std::size_t i = 0; i < m_independent.size(); ++i)
      y[Index(i)] = x[m_independent[i]];
    return y;
  }

  // The matrix S + C.
  Matrix flexibility() const
  {
    Matrix s = at_points(m_response);
    s = (0.5 * (s + s.transpose())).eval();
    s.diagonal() += m_compliances;
    return s;
  }

  void eliminate()
  {
    const Index motions = m_motions.cols();
    m_g = at_points(m_motions);
    Matrix s = flexibility();
    if(motions > 0) {
      const Matrix held = m_g.transpose() * m_g;
      const Eigen::SelfAdjointEigenSolver<Matrix> eigen(held);
      Index free = 0;
      while(free < motions && eigen.eigenvalues()[free] <= dependence * held.trace())
        ++free;
      m_kernel = eigen.eigenvectors().leftCols(free);
      if(free > 0)
        return;
      m_augmentation = s.trace() > 0 ? s.trace() / held.trace() : 1;
      s += m_augmentation * m_g * m_g.transpose();
    }
    factor_independent(std::move(s));
    const Index size = Index(m_independent.size());
    m_g_independent.resize(size, motions);
    for(Index i = 0; i < size; ++i)
      m_g_independent.row(i) = m_g.row(m_independent[std::size_t(i)]);
    m_eliminated.resize(size, motions);
    if(motions > 0) {
      if(m_factor)
        m_eliminated = m_factor->solve(m_g_independent);
      m_schur.emplace(m_g_independent.transpose() * m_eliminated);
    }
  }

  // Factors by Cholesky's factorization, which as a rule shows that all constraints are independent; else
  // factors the independent ones. The factorization takes most of the time of many control points: the cube
  // of their number.
  void factor_independent(Matrix s)
  {
    const Index n = s.rows();
    if(n == 0)
      return;
    const double bound = dependence * s.diagonal().maxCoeff();
    m_factor.emplace(s);
    if(m_factor->info() == Eigen::Success
       && m_factor->matrixLLT().diagonal().cwiseAbs2().minCoeff() > bound) {
      for(Index i = 0; i < n; ++i)
        m_independent.push_back(i);
      return;
    }
    m_factor.reset();
    find_independent(s, bound);
    const Index size = Index(m_independent.size());
    Matrix independent(size, size);
    for(Index i = 0; i < size; ++i)
      for(Index j = 0; j < size; ++j)
        independent(i, j) = s(m_independent[std::size_t(i)], m_independent[std::size_t(j)]);
    if(size > 0)
      m_factor.emplace(independent);
  }

  // Finds independent constraints by Cholesky's factorization with pivots, as long as pivots are not
  // negligible.
  void find_independent(Matrix s, double bound)
  {
    const Index n = s.rows();
    for(Index step = 0; step < n; ++step) {
      Index pivot = 0;
      const double largest = s.diagonal().maxCoeff(&pivot);
      if(!(largest > bound))
        break;
      m_independent.push_back(pivot);
      const Vector column = s.col(pivot) / std::sqrt(largest);
      s.noalias() -= column * column.transpose();
      s.row(pivot).setZero();
      s.col(pivot).setZero();
    }
    std::sort(m_independent.begin(), m_independent.end());
  }

  // The motion of the part of the body that moves most.
  static Rigid_motion_3 combination(const std::vector<Free_motion>& motions, const Vector& factors)
  {
    Index most = 0;
    factors.cwiseAbs().maxCoeff(&most);
    const Vec3 center = motions[std::size_t(most)].mode.center;
    Vec3 translation{}, rotation{};
    for(std::size_t m = 0; m < motions.size(); ++m)
      if(motions[m].vertices == motions[std::size_t(most)].vertices) {
        translation = translation + factors[Index(m)] * motions[m].mode.translation;
        rotation = rotation + factors[Index(m)] * motions[m].mode.rotation;
      }
    return {translation, rotation, center};
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_CONSTRAINTS_H
