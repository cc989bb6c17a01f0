// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear elasticity on mixed elements: isoparametric stiffness of the four kinds, and the sparse system of
// the nodes that are free, those with a prescribed displacement eliminated. In the words of finite elements
// a vertex is a node.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FEM_ELASTICITY_ASSEMBLY_H
#define CGAL_MIXED_MESH_3_INTERNAL_FEM_ELASTICITY_ASSEMBLY_H

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The points where a stiffness is integrated: weights, and the shape functions and their gradients there.
struct Quadrature_rule
{
  int number_of_points = 0;
  std::array<double, 8> weights{};
  std::array<std::array<double, 8>, 8> values{};  // of the shape functions, by point and by node
  std::array<std::array<Vec3, 8>, 8> gradients{}; // in reference coordinates, by point and by node
};

template <Element_kind Kind>
Quadrature_rule make_quadrature_rule()
{
  Quadrature_rule rule;
  const auto add = [&rule](double r, double s, double t, double weight) {
    const auto gradients = Mixed_element_traits_3<Kind>::shape_gradients(r, s, t);
    const std::size_t q = std::size_t(rule.number_of_points++);
    rule.weights[q] = weight;
    std::copy(gradients.begin(), gradients.end(), rule.gradients[q].begin());
    const auto values = Mixed_element_traits_3<Kind>::shape_functions(r, s, t);
    std::copy(values.begin(), values.end(), rule.values[q].begin());
  };
  const double gauss = 1 / std::sqrt(3.); // two points on [-1,1], of weight 1
  if constexpr(Kind == TETRAHEDRON) {
    add(0.25, 0.25, 0.25, 1. / 6); // gradients are constant
  } else if constexpr(Kind == PYRAMID) {
    // Conical product: (r, s) shrink towards the apex, and heights are Gauss-Jacobi points for the weight
    // (1 - t)^2 on [0,1].
    const double offset = std::sqrt(10.) / 15, weight_offset = std::sqrt(10.) / 48;
    for(int k : {-1, 1}) {
      const double t = 1. / 3 + k * offset, weight = 1. / 6 - k * weight_offset;
      for(int i : {-1, 1})
        for(int j : {-1, 1})
          add(i * gauss * (1 - t), j * gauss * (1 - t), t, weight);
    }
  } else if constexpr(Kind == PRISM) {
    for(int k : {-1, 1})
      for(int i = 0; i < 3; ++i)
        add(i == 1 ? 2. / 3 : 1. / 6, i == 2 ? 2. / 3 : 1. / 6, k * gauss, 1. / 6);
  } else {
    for(int i : {-1, 1})
      for(int j : {-1, 1})
        for(int k : {-1, 1})
          add(i * gauss, j * gauss, k * gauss, 1);
  }
  return rule;
}

inline const Quadrature_rule& quadrature_rule(Element_kind kind)
{
  static const Quadrature_rule rules[number_of_element_kinds] = {
    make_quadrature_rule<TETRAHEDRON>(), make_quadrature_rule<PYRAMID>(), make_quadrature_rule<PRISM>(),
    make_quadrature_rule<HEXAHEDRON>()};
  return rules[kind];
}

/*!
The strain operator at a point of an element. The B-matrix of node `a` consists of the components of
`gradients[a]`: with the displacements \f$ u_a \f$, the gradient of displacement is
\f$ \sum_a u_a \otimes gradients[a] \f$, and the strain its symmetric part.
*/
struct Strain_operator
{
  std::array<Vec3, 8> gradients; // of the shape functions, in space
  double volume;                 // that the point stands for
};

/// \param points positions of the nodes; they may be relative to any of them
/// \param q a point of the quadrature rule. \pre the Jacobian is not zero there
inline Strain_operator strain_operator(Element_kind kind, const std::array<Vec3, 8>& points, int q)
{
  const Quadrature_rule& rule = quadrature_rule(kind);
  const int n = reference_elements[kind].number_of_vertices;
  const std::array<Vec3, 8>& reference = rule.gradients[std::size_t(q)];
  Vec3 dr{}, ds{}, dt{}; // columns of the Jacobian matrix
  for(int a = 0; a < n; ++a) {
    dr = dr + reference[a][0] * points[a];
    ds = ds + reference[a][1] * points[a];
    dt = dt + reference[a][2] * points[a];
  }
  const Vec3 st = cross(ds, dt), tr = cross(dt, dr), rs = cross(dr, ds);
  const double jacobian = dot(dr, st);
  Strain_operator b;
  for(int a = 0; a < n; ++a)
    b.gradients[a] =
      (1 / jacobian) * (reference[a][0] * st + (reference[a][1] * tr + reference[a][2] * rs));
  b.volume = rule.weights[std::size_t(q)] * jacobian;
  return b;
}

using Matrix_3x3 = std::array<Vec3, 3>; // rows

/// The blocks of pairs of nodes `[a][b]`, `b <= a`; the others are their transposes.
using Element_stiffness = std::array<std::array<Matrix_3x3, 8>, 8>;

/// What resists a change of volume: the dilatation at each point of the quadrature, or its mean over the
/// element (Nagtegaal, Parks, Rice, 1974; Hughes' B-bar), or for an element of a patch some pointwise and the rest
/// by the mean over the patch, which is added apart. Only pointwise, all kinds lock if the material is nearly
/// incompressible.
enum class Dilatation { POINTWISE, MEAN, PATCH };

/// The share of the bulk modulus that is pointwise in a patch: as much as does not lock. Without any, the elements
/// of a patch could change their volumes against each other too easily.
inline double pointwise_share(const Elastic_material& material)
{
  constexpr double largest_multiple_of_mu = 2;
  return (std::min)(1., largest_multiple_of_mu * material.mu() / material.bulk_modulus());
}

/// \cost constant: 8 points and 36 blocks for a hexahedron, 1 point and 10 blocks for a tetrahedron
inline void compute_element_stiffness(Element_kind kind, const std::array<Vec3, 8>& points,
                                      const Elastic_material& material, Dilatation dilatation,
                                      Element_stiffness& stiffness)
{
  const int n = reference_elements[kind].number_of_vertices;
  double volume = 0;
  std::array<Vec3, 8> divergence{}; // its integral, by the displacement of each node
  for(int a = 0; a < n; ++a)
    for(int b = 0; b <= a; ++b)
      stiffness[a][b] = Matrix_3x3{};
  // first the integrals of the dyadic products of gradients, which do not depend on the material
  for(int q = 0; q < quadrature_rule(kind).number_of_points; ++q) {
    const Strain_operator s = strain_operator(kind, points, q);
    volume += s.volume;
    for(int a = 0; a < n; ++a) {
      const Vec3 ga = s.volume * s.gradients[a];
      divergence[a] = divergence[a] + ga;
      for(int b = 0; b <= a; ++b)
        for(int i = 0; i < 3; ++i)
          for(int j = 0; j < 3; ++j)
            stiffness[a][b][i][j] += ga[i] * s.gradients[b][j];
    }
  }
  const double mu = material.mu();
  const double pointwise = dilatation == Dilatation::POINTWISE ? 1
                           : dilatation == Dilatation::PATCH   ? pointwise_share(material)
                                                               : 0;
  const double lambda = pointwise * material.bulk_modulus() - 2 * mu / 3;
  const double mean = dilatation == Dilatation::MEAN ? material.bulk_modulus() / volume : 0;
  for(int a = 0; a < n; ++a)
    for(int b = 0; b <= a; ++b) {
      const Matrix_3x3 d = stiffness[a][b];
      const double shear = mu * (d[0][0] + d[1][1] + d[2][2]);
      for(int i = 0; i < 3; ++i)
        for(int j = 0; j < 3; ++j)
          stiffness[a][b][i][j] = lambda * d[i][j] + mu * d[j][i] + (i == j ? shear : 0)
                                  + mean * divergence[a][i] * divergence[b][j];
    }
}

/*!
The system of linear equations for the displacements of the free nodes.

The matrix is symmetric: its lower triangle is kept in compressed columns, rows ascending. Unknown `3 i + k` is
coordinate `k` of free node `i`. The pattern is computed once; values are filled in as often as needed.
*/
class Elasticity_system
{
  const Element_list& m_elements;
  std::vector<Element_index> m_active;     // elements with a free node
  std::vector<Vertex_index> m_free;        // the free nodes
  std::vector<Vertex_index> m_unknowns;    // number of each node among the free ones, or no_vertex
  std::vector<std::size_t> m_block_starts; // neighbors of larger number, the node itself not included
  std::vector<int> m_neighbors;
  std::vector<int> m_starts, m_rows;
  std::vector<double> m_values, m_right_hand_side;
  Element_stiffness m_element_stiffness; // of the element being added

public:
  /// \param elements kept by reference
  /// \param is_free of each vertex, whether its displacement is unknown
  /// \param patches sets of nodes, besides those of the elements, that `add_patch()` will get
  Elasticity_system(const Element_list& elements, const std::vector<bool>& is_free,
                    const std::vector<std::vector<Vertex_index>>& patches = {})
    : m_elements(elements), m_unknowns(is_free.size(), no_vertex)
  {
    for(Vertex_index v = 0; v < is_free.size(); ++v)
      if(is_free[v]) {
        m_unknowns[v] = Vertex_index(m_free.size());
        m_free.push_back(v);
      }
    for(Element_index e = 0; e < elements.size(); ++e)
      if(std::any_of(elements[e].begin(), elements[e].end(), [&](Vertex_index v) { return is_free[v]; }))
        m_active.push_back(e);
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

  /// Adds an element. An element added before becomes stiffer by that, or softer if Young's modulus is negative.
  /// \param points positions of all nodes
  /// \param displacements of all nodes; those of the free ones are ignored
  /// \pre the element has a free node
  void add(Element_index e, const Elastic_material& material, const std::vector<Vec3>& points,
           const std::vector<Vec3>& displacements, Dilatation dilatation = Dilatation::POINTWISE)
  {
    const Element_view element = m_elements[e];
    std::array<Vec3, 8> p{};
    for(int a = 1; a < element.size(); ++a)
      p[a] = points[element[a]] - points[element[0]];
    compute_element_stiffness(element.kind(), p, material, dilatation, m_element_stiffness);
    for(int a = 0; a < element.size(); ++a)
      for(int b = 0; b <= a; ++b)
        add(element[a], element[b], m_element_stiffness[a][b], displacements);
  }

  /// Adds resistance to the mean dilatation over several elements.
  /// \param nodes of the elements
  /// \param gradients the integral of the divergence by the displacement of each node
  /// \param factor bulk modulus by volume
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
        for_each_pair_of(m_elements[e], f);
      for(const std::vector<Vertex_index>& patch : patches)
        for_each_pair_of(patch, f);
    };
    std::vector<std::size_t> ends(m_free.size() + 1, 0);
    for_each_pair([&](Vertex_index i, int) { ++ends[i + 1]; });
    for(std::size_t i = 0; i < m_free.size(); ++i)
      ends[i + 1] += ends[i];
    std::vector<int> all(ends.back());
    for_each_pair([&](Vertex_index i, int j) { all[ends[i]++] = j; });
    // now ends[i] is where the neighbors of i end; several elements may have found the same ones
    starts.assign(1, 0);
    for(std::size_t i = 0, first = 0; i < m_free.size(); first = ends[i], ++i) {
      std::sort(all.begin() + std::ptrdiff_t(first), all.begin() + std::ptrdiff_t(ends[i]));
      std::unique_copy(all.begin() + std::ptrdiff_t(first), all.begin() + std::ptrdiff_t(ends[i]),
                       std::back_inserter(m_neighbors));
      starts.push_back(m_neighbors.size());
    }
  }

  // Column 3 i + k: the rest of the diagonal block from the diagonal on, then three rows a neighbor.
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

  // The block of nodes v and w, and of w and v.
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

  // \pre i >= j
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

/// A symmetric matrix as any model of CGAL's concept takes it, of its lower triangle in compressed columns.
template <class Matrix>
Matrix make_matrix(const std::vector<int>& starts, const std::vector<int>& rows, const std::vector<double>& values)
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
        if(i != j) // ignored by classes of symmetric matrices
          matrix.set_coef(j, i, values[k], true);
      }
    return matrix;
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FEM_ELASTICITY_ASSEMBLY_H
