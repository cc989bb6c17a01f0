// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Solutions by a part of a supernodal factor, for forces on a few unknowns whose displacements are wanted.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_PARTIAL_FACTOR_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_PARTIAL_FACTOR_H

#include <CGAL/license/Linear_elasticity_3.h>

#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD

#include <Eigen/Core>

#include <cholmod.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
The supernodes of a factor L L^T of CHOLMOD that some unknowns need: the paths from these unknowns to the root
of the elimination tree. Where the right-hand side is zero elsewhere, the solution at these unknowns depends
on these supernodes only (J. R. Gilbert, T. Peierls: "Sparse partial pivoting in time proportional to
arithmetic operations", SIAM J. Sci. Stat. Comput. 9, 1988).

A solution reads each entry twice, and memory bounds its time; so entries are copied in single precision. The
relative error of a solution in the energy norm is of the order of the condition number times 6e-8.
*/
class Partial_factor
{
  using Matrix_map = Eigen::Map<const Eigen::MatrixXf, 0, Eigen::OuterStride<>>;

  struct Supernode
  {
    int column, columns, rows; // first column; numbers of columns and of rows
    const int* indices;        // rows; the first ones are the columns
    std::size_t start;         // of the entries, in columns of `rows` entries
  };

  std::vector<int> m_selected; // position of each selected unknown in the order of elimination
  std::vector<Supernode> m_supernodes;
  std::unique_ptr<float[]> m_entries; // not initialized where they are above the diagonal
  Eigen::VectorXf m_work, m_below;    // of all unknowns; of the rows below a supernode

public:
  /// \param factor factor, whose indices must outlive the object
  /// \pre `is_supported(factor)`
  Partial_factor(const cholmod_factor& factor, const std::vector<int>& unknowns)
  {
    const auto integers = [](const void* p) { return static_cast<const int*>(p); };
    const int *first = integers(factor.super), *indices = integers(factor.s), *starts = integers(factor.pi),
              *entries = integers(factor.px), *permutation = integers(factor.Perm);
    const std::size_t size = factor.nsuper;
    std::vector<int> position(factor.n), supernode(factor.n);
    for(std::size_t i = 0; i < factor.n; ++i)
      position[std::size_t(permutation[i])] = int(i);
    for(std::size_t k = 0; k < size; ++k)
      for(int j = first[k]; j < first[k + 1]; ++j)
        supernode[std::size_t(j)] = int(k);
    std::vector<bool> is_needed(size, false);
    for(int unknown : unknowns) {
      m_selected.push_back(position[std::size_t(unknown)]);
      is_needed[std::size_t(supernode[std::size_t(m_selected.back())])] = true;
    }
    std::size_t total = 0;
    int most_rows = 0;
    std::vector<std::size_t> needed;
    for(std::size_t k = 0; k < size; ++k) {
      if(!is_needed[k])
        continue;
      const Supernode s{first[k], first[k + 1] - first[k], starts[k + 1] - starts[k], indices + starts[k],
                        total};
      if(s.rows > s.columns) // the parent, which has a larger number
        is_needed[std::size_t(supernode[std::size_t(s.indices[s.columns])])] = true;
      m_supernodes.push_back(s);
      needed.push_back(k);
      total += std::size_t(s.rows) * std::size_t(s.columns);
      most_rows = (std::max)(most_rows, s.rows - s.columns);
    }
    m_entries.reset(new float[total]);
    for(std::size_t i = 0; i < needed.size(); ++i) {
      const Supernode& s = m_supernodes[i];
      const double* from = static_cast<const double*>(factor.x) + entries[needed[i]];
      float* to = m_entries.get() + s.start;
      for(int j = 0; j < s.columns; ++j, from += s.rows, to += s.rows)
        for(int row = j; row < s.rows; ++row)
          to[row] = float(from[row]);
    }
    m_work = Eigen::VectorXf::Zero(Eigen::Index(factor.n));
    m_below.resize(most_rows);
  }

  /// Whether the format of a factor is the one that is read here.
  static bool is_supported(const cholmod_factor& factor)
  {
    return factor.is_super && factor.is_ll && factor.itype == CHOLMOD_INT && factor.xtype == CHOLMOD_REAL
           && factor.minor == factor.n;
  }

  /// Solves for forces on the selected unknowns; returns the displacements of these.
  Eigen::VectorXd solve(const Eigen::VectorXd& forces)
  {
    // Small forces would be zero in single precision.
    const double scale = forces.size() > 0 ? forces.lpNorm<Eigen::Infinity>() : 0;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(forces.size());
    if(!(scale > 0))
      return x;
    for(const Supernode& s : m_supernodes)
      m_work.segment(s.column, s.columns).setZero();
    for(std::size_t i = 0; i < m_selected.size(); ++i)
      m_work[m_selected[i]] = float(forces[Eigen::Index(i)] / scale);
    for(const Supernode& s : m_supernodes) {
      auto own = m_work.segment(s.column, s.columns);
      triangle(s).triangularView<Eigen::Lower>().solveInPlace(own);
      auto below = m_below.head(s.rows - s.columns);
      below.noalias() = rectangle(s) * own;
      for(int i = s.columns; i < s.rows; ++i)
        m_work[s.indices[i]] -= below[i - s.columns];
    }
    for(auto s = m_supernodes.rbegin(); s != m_supernodes.rend(); ++s) {
      auto own = m_work.segment(s->column, s->columns);
      auto below = m_below.head(s->rows - s->columns);
      for(int i = s->columns; i < s->rows; ++i)
        below[i - s->columns] = m_work[s->indices[i]];
      own.noalias() -= rectangle(*s).transpose() * below;
      triangle(*s).transpose().triangularView<Eigen::Upper>().solveInPlace(own);
    }
    for(std::size_t i = 0; i < m_selected.size(); ++i)
      x[Eigen::Index(i)] = scale * double(m_work[m_selected[i]]);
    return x;
  }

private:
  Matrix_map triangle(const Supernode& s) const
  {
    return Matrix_map(m_entries.get() + s.start, s.columns, s.columns, Eigen::OuterStride<>(s.rows));
  }
  Matrix_map rectangle(const Supernode& s) const
  {
    return Matrix_map(m_entries.get() + s.start + s.columns, s.rows - s.columns, s.columns,
                      Eigen::OuterStride<>(s.rows));
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_USE_CHOLMOD

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_PARTIAL_FACTOR_H
