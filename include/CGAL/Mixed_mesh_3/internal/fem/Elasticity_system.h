// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sparse system of linear elasticity for the free nodes, with prescribed displacements eliminated.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FEM_ELASTICITY_SYSTEM_H
#define CGAL_MIXED_MESH_3_INTERNAL_FEM_ELASTICITY_SYSTEM_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Element_nodes.h>
#include <CGAL/Mixed_mesh_3/internal/fem/element_stiffness.h>
#include <CGAL/Mixed_mesh_3/internal/fem/quadrature.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
The system of linear equations for the displacements of the free nodes.

The matrix is symmetric: its lower triangle is kept in compressed columns, rows ascending. Unknown `3 i + k`
is coordinate `k` of free node `i`. The pattern is computed once; values are filled in as often as needed.
*/
class Elasticity_system
{
  Element_nodes m_nodes;
  std::vector<Element_index> m_active;     // elements with a free node
  std::vector<Vertex_index> m_free;        // the free nodes
  std::vector<Vertex_index> m_unknowns;    // number among the free nodes, or no_vertex
  std::vector<std::size_t> m_block_starts; // of the neighbors of larger number, without the node itself
  std::vector<int> m_neighbors;
  std::vector<int> m_starts, m_rows;
  std::vector<double> m_values, m_right_hand_side;
  Element_stiffness m_element_stiffness; // stiffness of the element being added

public:
  /// The system of linear elements.
  /// \param elements kept by reference: must outlive the system
  /// \param is_free whether the displacement of each vertex is unknown
  Elasticity_system(const Element_list& elements, const std::vector<bool>& is_free)
    : Elasticity_system(Element_nodes(elements, is_free.size()), is_free)
  {
  }

  /// \param nodes numbering; its elements must outlive the system
  /// \param is_free whether the displacement of each node is unknown
  /// \param patches sets of nodes, besides those of the elements, that will be passed to `add_patch()`
  Elasticity_system(Element_nodes nodes, const std::vector<bool>& is_free,
                    const std::vector<std::vector<Vertex_index>>& patches = {})
    : m_nodes(std::move(nodes)), m_unknowns(is_free.size(), no_vertex)
  {
    for(Vertex_index v = 0; v < is_free.size(); ++v)
      if(is_free[v]) {
        m_unknowns[v] = Vertex_index(m_free.size());
        m_free.push_back(v);
      }
    for(Element_index e = 0; e < m_nodes.elements().size(); ++e) {
      const Nodes_of_element element = m_nodes[e];
      if(std::any_of(element.begin(), element.end(), [&](Vertex_index v) { return is_free[v]; }))
        m_active.push_back(e);
    }
    find_neighbors(patches);
    build_pattern();
  }

  int number_of_unknowns() const { return int(3 * m_free.size()); }
  const std::vector<Vertex_index>& free_vertices() const { return m_free; }
  /// The elements that have a free node.
  const std::vector<Element_index>& active_elements() const { return m_active; }

  /// The lower triangle in compressed columns.
  const std::vector<int>& starts() const { return m_starts; }
  const std::vector<int>& rows() const { return m_rows; }
  const std::vector<double>& values() const { return m_values; }
  const std::vector<double>& right_hand_side() const { return m_right_hand_side; }

  void clear()
  {
    std::fill(m_values.begin(), m_values.end(), 0.);
    std::fill(m_right_hand_side.begin(), m_right_hand_side.end(), 0.);
  }

  /// Adds an element. An element added before becomes stiffer, or softer if Young's modulus is negative.
  /// \param points positions of all vertices
  /// \param displacements displacements of all nodes; those of the free nodes are ignored
  /// \pre the element has a free node
  void add(Element_index e, const Elastic_material& material, const std::vector<Vec3>& points,
           const std::vector<Vec3>& displacements, Dilatation dilatation = Dilatation::POINTWISE)
  {
    const Element_view element = m_nodes.elements()[e];
    std::array<Vec3, 8> p{};
    for(int a = 1; a < element.size(); ++a)
      p[a] = points[element[a]] - points[element[0]];
    const Nodes_of_element nodes = m_nodes[e];
    compute_element_stiffness(quadrature_rule(element.kind(), nodes.order()), p, material, dilatation,
                              m_element_stiffness);
    for(int i = 0; i < nodes.number_of_middles(); ++i)
      for(int end : nodes.middle(i).ends)
        subtract_half(nodes.middle(i).edge, end, nodes, m_element_stiffness);
    for(int a = 0; a < nodes.size(); ++a)
      for(int b = 0; b <= a; ++b)
        add(nodes[a], nodes[b], m_element_stiffness[nodes.function(a)][nodes.function(b)], displacements);
  }

  /// Adds resistance to the mean dilatation over several elements.
  /// \param nodes nodes of the elements
  /// \param gradients the integral of the divergence by the displacement of each node
  /// \param factor bulk modulus divided by volume
  void add_patch(const std::vector<Vertex_index>& nodes, const std::vector<Vec3>& gradients, double factor,
                 const std::vector<Vec3>& displacements)
  {
    for(std::size_t a = 0; a < nodes.size(); ++a)
      for(std::size_t b = 0; b <= a; ++b) {
        Matrix_3x3 block;
        for(int i = 0; i < 3; ++i)
          block[i] = (factor * gradients[a][i]) * gradients[b];
        add(nodes[a], nodes[b], block, displacements);
      }
  }

private:
  void find_neighbors(const std::vector<std::vector<Vertex_index>>& patches)
  {
    std::vector<std::size_t>& starts = m_block_starts;
    const auto for_each_pair_of = [&](const auto& nodes, const auto& f) {
      for(Vertex_index v : nodes)
        for(Vertex_index w : nodes)
          if(m_unknowns[v] < m_unknowns[w] && m_unknowns[w] != no_vertex)
            f(m_unknowns[v], int(m_unknowns[w]));
    };
    const auto for_each_pair = [&](const auto& f) {
      for(Element_index e : m_active)
        for_each_pair_of(m_nodes[e], f);
      for(const std::vector<Vertex_index>& patch : patches)
        for_each_pair_of(patch, f);
    };
    std::vector<std::size_t> ends(m_free.size() + 1, 0);
    for_each_pair([&](Vertex_index i, int) { ++ends[i + 1]; });
    for(std::size_t i = 0; i < m_free.size(); ++i)
      ends[i + 1] += ends[i];
    std::vector<int> all(ends.back());
    for_each_pair([&](Vertex_index i, int j) { all[ends[i]++] = j; });
    // Now ends[i] is the end of the neighbors of i; several elements may have found the same neighbors.
    starts.assign(1, 0);
    for(std::size_t i = 0, first = 0; i < m_free.size(); first = ends[i], ++i) {
      std::sort(all.begin() + std::ptrdiff_t(first), all.begin() + std::ptrdiff_t(ends[i]));
      std::unique_copy(all.begin() + std::ptrdiff_t(first), all.begin() + std::ptrdiff_t(ends[i]),
                       std::back_inserter(m_neighbors));
      starts.push_back(m_neighbors.size());
    }
  }

  // Builds the pattern. Column 3 i + k: the rest of the diagonal block from the diagonal on, then three rows
  // for each neighbor.
  void build_pattern()
  {
    m_starts.assign(1, 0);
    for(int i = 0; i < int(m_free.size()); ++i)
      for(int k = 0; k < 3; ++k) {
        for(int row = k; row < 3; ++row)
          m_rows.push_back(3 * i + row);
        for(std::size_t j = m_block_starts[i]; j < m_block_starts[i + 1]; ++j)
          for(int row = 0; row < 3; ++row)
            m_rows.push_back(3 * m_neighbors[j] + row);
        m_starts.push_back(int(m_rows.size()));
      }
    m_values.resize(m_rows.size());
    m_right_hand_side.resize(std::size_t(number_of_unknowns()));
  }

  static Vec3 product(const Matrix_3x3& m, const Vec3& v)
  {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
  }

  static Matrix_3x3 transpose(const Matrix_3x3& m)
  {
    return {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}};
  }

  // Changes a stiffness to the basis in which the function of a vertex has lost half of that of an edge.
  static void subtract_half(int edge, int vertex, const Nodes_of_element& nodes, Element_stiffness& stiffness)
  {
    const auto block = [&](int a, int b) { return a >= b ? stiffness[a][b] : transpose(stiffness[b][a]); };
    const auto add_multiple = [](Matrix_3x3& sum, double factor, const Matrix_3x3& m) {
      for(int i = 0; i < 3; ++i)
        sum[i] = sum[i] + factor * m[i];
    };
    Matrix_3x3& diagonal = stiffness[vertex][vertex];
    add_multiple(diagonal, -0.5, block(vertex, edge));
    add_multiple(diagonal, -0.5, block(edge, vertex));
    add_multiple(diagonal, 0.25, block(edge, edge));
    for(int i = 0; i < nodes.size(); ++i) {
      const int other = nodes.function(i);
      if(other >= vertex && other != vertex)
        add_multiple(stiffness[other][vertex], -0.5, block(other, edge));
      else if(other < vertex)
        add_multiple(stiffness[vertex][other], -0.5, block(edge, other));
    }
  }

  // Adds the block of nodes v and w, and of w and v.
  void add(Vertex_index v, Vertex_index w, const Matrix_3x3& block, const std::vector<Vec3>& displacements)
  {
    const Vertex_index i = m_unknowns[v], j = m_unknowns[w];
    if(i == no_vertex && j == no_vertex)
      return;
    if(i == no_vertex)
      subtract(j, product(transpose(block), displacements[v]));
    else if(j == no_vertex)
      subtract(i, product(block, displacements[w]));
    else if(i >= j)
      add_block(i, j, block);
    else
      add_block(j, i, transpose(block));
  }

  void subtract(Vertex_index i, const Vec3& force)
  {
    for(int k = 0; k < 3; ++k)
      m_right_hand_side[3 * std::size_t(i) + std::size_t(k)] -= force[k];
  }

  // Adds a block of unknowns. \pre i >= j
  void add_block(Vertex_index i, Vertex_index j, const Matrix_3x3& block)
  {
    if(i == j) {
      for(int k = 0; k < 3; ++k)
        for(int row = k; row < 3; ++row)
          m_values[m_starts[3 * j + k] + row - k] += block[row][k];
      return;
    }
    const auto first = m_neighbors.begin() + std::ptrdiff_t(m_block_starts[j]),
               last = m_neighbors.begin() + std::ptrdiff_t(m_block_starts[j + 1]);
    const std::ptrdiff_t position = std::lower_bound(first, last, int(i)) - first;
    for(int k = 0; k < 3; ++k) {
      double* column = m_values.data() + m_starts[3 * j + k] + (3 - k) + 3 * position;
      for(int row = 0; row < 3; ++row)
        column[row] += block[row][k];
    }
  }
};

/// A symmetric matrix of any model of CGAL's concept, from its lower triangle in compressed columns.
template <class Matrix>
Matrix make_matrix(const std::vector<int>& starts, const std::vector<int>& rows,
                   const std::vector<double>& values)
{
  using Arrays = const std::vector<int>&;
  if constexpr(std::is_constructible_v<Matrix, Arrays, Arrays, const std::vector<double>&>) {
    return Matrix(starts, rows, values);
  } else {
    const int n = int(starts.size() - 1);
    Matrix matrix(n);
    for(int j = 0; j < n; ++j)
      for(int k = starts[j]; k < starts[j + 1]; ++k) {
        const int i = rows[k];
        matrix.set_coef(i, j, values[k], true);
        if(i != j) // classes of symmetric matrices ignore these
          matrix.set_coef(j, i, values[k], true);
      }
    return matrix;
  }
}

/// The class of a solver's matrices. For a class without matrices, the first line of the compiler's message
/// is the sentence here.
template <class Solver, class = void>
struct Matrix_of_solver
{
  static_assert(sizeof(Solver) == 0,
                "the solver must be a model of SparseLinearAlgebraWithFactorTraits_d: it has no type Matrix");
  using type = int;
};

template <class Solver>
struct Matrix_of_solver<Solver, std::void_t<typename Solver::Matrix>>
{
  using type = typename Solver::Matrix;
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FEM_ELASTICITY_SYSTEM_H
