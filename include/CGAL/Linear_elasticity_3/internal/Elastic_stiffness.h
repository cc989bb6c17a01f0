// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stiffness of an elastic body on the elements of a mixed mesh: the stiffness of elements, and of patches
// of elements with a common dilatation; assembled once, then elements are subtracted.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_STIFFNESS_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_STIFFNESS_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/internal/dilatation_patches.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Element_nodes.h>
#include <CGAL/Mixed_mesh_3/internal/fem/element_stiffness.h>
#include <CGAL/Mixed_mesh_3/internal/fem/quadrature.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The difference of two matrices K: former minus present one.
struct Stiffness_change
{
  std::vector<Vertex_index> nodes;    // those whose rows or columns differ
  Eigen::SparseMatrix<double> matrix; // of these nodes: the lower triangle
};

class Elastic_stiffness
{
  static constexpr std::size_t no_patch = std::size_t(-1);

  const Element_list* m_elements;
  std::vector<Vec3> m_points;
  Element_nodes m_nodes;
  std::vector<Elastic_material> m_materials; // one for all, or one for each element
  std::vector<bool> m_is_removed;            // one value for each element
  Patches m_patches;
  std::vector<std::size_t> m_patch_of;       // patch of each element
  std::optional<Elasticity_system> m_system; // system of all nodes
  std::vector<double> m_factored;            // values when factored, if elements have been removed since

public:
  /// \param elements elements, kept by reference: they must outlive the object
  /// \param points positions of all vertices
  /// \param materials one material for all elements, or one for each
  Elastic_stiffness(const Element_list& elements, std::vector<Vec3> points,
                    std::vector<Elastic_material> materials)
    : m_elements(&elements), m_points(std::move(points)), m_nodes(elements, m_points.size()),
      m_materials(std::move(materials)), m_is_removed(elements.size(), false)
  {
    CGAL_precondition(m_materials.size() == 1 || m_materials.size() == elements.size());
    for([[maybe_unused]] const Elastic_material& m : m_materials)
      CGAL_precondition(m.young_modulus > 0 && m.poisson_ratio >= 0 && m.poisson_ratio < 0.5
                        && m.density >= 0);
  }

  const Element_list& elements() const { return *m_elements; }
  const std::vector<Vec3>& points() const { return m_points; }
  std::size_t number_of_vertices() const { return m_points.size(); }

  /// The nodes: vertices, and edges of quadratic elements.
  const Element_nodes& nodes() const { return m_nodes; }
  std::size_t number_of_nodes() const { return m_nodes.number_of_nodes(); }
  /// Sets the nodes. \pre not assembled
  void set_nodes(Element_nodes nodes)
  {
    CGAL_precondition(!is_assembled());
    m_nodes = std::move(nodes);
  }

  /// Sets the edges whose values are the displacements of their middles. \pre not assembled
  void set_middles(std::vector<bool> is_middle)
  {
    CGAL_precondition(!is_assembled());
    m_nodes.set_middles(std::move(is_middle));
  }

  /// The treatment of dilatation for an element with quadratic displacements, which do not lock, for one that
  /// is not in a patch, and for one that is.
  Dilatation dilatation(Element_index e) const
  {
    return m_nodes.has_edges(e)        ? Dilatation::POINTWISE
           : m_patch_of[e] == no_patch ? Dilatation::MEAN
                                       : Dilatation::PATCH;
  }
  /// The remaining elements of each patch. \pre assembled
  const Patches& patches() const { return m_patches; }

  /// The bulk modulus of the mean dilatation of a patch. \pre the patch is not empty
  double mean_bulk_modulus(const std::vector<Element_index>& patch) const
  {
    const Elastic_material& m = material(patch.front());
    return (1 - pointwise_share(m)) * m.bulk_modulus();
  }

  const Elastic_material& material(Element_index e) const
  {
    return m_materials.size() == 1 ? m_materials.front() : m_materials[e];
  }

  /// Positions of an element's vertices, relative to one of them.
  Element_points points_of(const Element_view& element) const
  {
    return relative_points(element, [this](Vertex_index v) { return m_points[v]; });
  }

  const std::vector<bool>& removed_elements() const { return m_is_removed; }
  bool is_removed(Element_index e) const { return m_is_removed[e]; }
  bool is_all_removed() const
  {
    return std::find(m_is_removed.begin(), m_is_removed.end(), false) == m_is_removed.end();
  }

  /// The first element whose Jacobian is not positive at a point of the quadrature, or the number of
  /// elements.
  Element_index find_inverted_element() const
  {
    for(Element_index e = 0; e < m_elements->size(); ++e)
      if(!m_is_removed[e]) {
        const Element_view element = (*m_elements)[e];
        const Element_points points = points_of(element);
        const Quadrature_rule& rule = rule_of(e);
        for(int q = 0; q < rule.number_of_points; ++q)
          if(!(strain_operator(rule, points, q).volume > 0))
            return e;
      }
    return Element_index(m_elements->size());
  }

  bool is_assembled() const { return m_system.has_value(); }
  void clear()
  {
    m_system.reset();
    m_factored.clear();
  }

  /// Assembles the stiffness. \pre no element is inverted
  void assemble()
  {
    const auto is_together = [this](Element_index e, Element_index f) {
      const Elastic_material &a = material(e), &b = material(f);
      return !m_is_removed[e] && !m_is_removed[f] && !m_nodes.has_edges(e) && !m_nodes.has_edges(f)
             && std::tie(a.young_modulus, a.poisson_ratio) == std::tie(b.young_modulus, b.poisson_ratio);
    };
    m_patches = dilatation_patches(*m_elements, m_points.size(), is_together);
    std::vector<std::vector<Vertex_index>> patch_vertices;
    m_patch_of.assign(m_elements->size(), no_patch);
    for(std::size_t i = 0; i < m_patches.size(); ++i) {
      patch_vertices.push_back(vertices_of(m_patches[i]));
      for(Element_index e : m_patches[i])
        m_patch_of[e] = i;
    }
    m_system.emplace(m_nodes, std::vector<bool>(number_of_nodes(), true), patch_vertices);
    m_system->clear();
    m_factored.clear();
    for(Element_index e = 0; e < m_elements->size(); ++e)
      if(!m_is_removed[e])
        add_element(e, 1);
    for(std::size_t i = 0; i < m_patches.size(); ++i)
      add_patch(i, 1);
  }

  /// Removes elements; patches that lose elements become patches of their other elements. \pre assembled
  void subtract(const std::vector<bool>& is_removed)
  {
    if(m_factored.empty())
      m_factored = m_system->values();
    std::vector<std::size_t> changed_patches;
    std::vector<Element_index> removed;
    for(Element_index e = 0; e < is_removed.size(); ++e)
      if(is_removed[e] && !m_is_removed[e]) {
        removed.push_back(e);
        if(m_patch_of[e] != no_patch)
          changed_patches.push_back(m_patch_of[e]);
      }
    std::sort(changed_patches.begin(), changed_patches.end());
    changed_patches.erase(std::unique(changed_patches.begin(), changed_patches.end()), changed_patches.end());
    for(std::size_t i : changed_patches)
      add_patch(i, -1);
    for(Element_index e : removed) {
      add_element(e, -1);
      m_is_removed[e] = true;
    }
    for(std::size_t i : changed_patches) {
      remove_removed(m_patches[i]);
      add_patch(i, 1);
    }
  }

  /// Forgets the stiffness that was factored before elements were removed.
  void forget_factored() { std::vector<double>().swap(m_factored); }

  /// The stiffness that elements removed since the factorization had, and patches have lost.
  /// \pre elements have been removed, and `forget_factored()` has not been called since
  Stiffness_change change() const
  {
    const std::vector<double>& values = m_system->values();
    CGAL_precondition(m_factored.size() == values.size());
    struct Entry
    {
      int row, column;
      double value;
    };
    std::vector<Entry> entries;
    std::vector<int> number(number_of_nodes(), -1);
    for(int column = 0; column < m_system->number_of_unknowns(); ++column)
      for(int i = m_system->starts()[column]; i < m_system->starts()[column + 1]; ++i)
        if(m_factored[i] != values[i]) {
          entries.push_back({m_system->rows()[i], column, m_factored[i] - values[i]});
          number[std::size_t(column) / 3] = number[std::size_t(entries.back().row) / 3] = 0;
        }
    Stiffness_change change;
    for(Vertex_index v = 0; v < number.size(); ++v)
      if(number[v] == 0) {
        number[v] = int(change.nodes.size());
        change.nodes.push_back(v);
      }
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries.size());
    const auto index = [&](int i) { return 3 * number[std::size_t(i) / 3] + i % 3; };
    for(const Entry& e : entries)
      triplets.emplace_back(index(e.row), index(e.column), e.value);
    const int n = 3 * int(change.nodes.size());
    change.matrix.resize(n, n);
    change.matrix.setFromTriplets(triplets.begin(), triplets.end());
    return change;
  }

  /// The matrix K of all nodes: nodes without an element have zeros. \pre assembled
  const Elasticity_system& system() const
  {
    CGAL_precondition(is_assembled());
    return *m_system;
  }

  /// The product K u. The columns of a node are three, two and one entry on the diagonal, then three rows
  /// for each neighbor, which are the same in each column. \pre assembled
  Eigen::VectorXd product(const Eigen::VectorXd& u) const
  {
    CGAL_precondition(is_assembled());
    Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size());
    for(std::size_t v = 0; v < number_of_nodes(); ++v) {
      const int* start = &m_system->starts()[3 * v];
      const double* const columns[3] = {&m_system->values()[start[0]], &m_system->values()[start[1]] - 1,
                                        &m_system->values()[start[2]] - 2};
      const double* const x = u.data() + 3 * v;
      Vec3 sum{};
      for(int k = 0; k < 3; ++k)
        for(int row = 0; row < 3; ++row)
          sum[row] += columns[(std::min)(row, k)][(std::max)(row, k)] * x[k];
      for(int i = 3; i < start[1] - start[0]; i += 3) {
        const int neighbor = m_system->rows()[start[0] + i];
        const double* const y = u.data() + neighbor;
        double* const g = f.data() + neighbor;
        for(int k = 0; k < 3; ++k) {
          const double* const block = columns[k] + i;
          for(int row = 0; row < 3; ++row) {
            g[row] += block[row] * x[k];
            sum[k] += block[row] * y[row];
          }
        }
      }
      for(int k = 0; k < 3; ++k)
        f[Eigen::Index(3 * v) + k] += sum[k];
    }
    return f;
  }

  /// Adds the forces on the nodes that result from forces by volume and an acceleration of the mass.
  /// \param forces_by_volume one force for all elements, or one for each
  void add_body_forces(const std::vector<Vec3>& forces_by_volume, const Vec3& acceleration,
                       Eigen::VectorXd& force) const
  {
    for(Element_index e = 0; e < m_elements->size(); ++e) {
      if(m_is_removed[e])
        continue;
      const Element_view element = (*m_elements)[e];
      const Element_points points = points_of(element);
      const Vec3& by_volume = forces_by_volume.size() == 1 ? forces_by_volume.front() : forces_by_volume[e];
      const Vec3 density = by_volume + material(e).density * acceleration;
      const Nodes_of_element nodes = m_nodes[e];
      const Quadrature_rule& rule = rule_of(e);
      for(int q = 0; q < rule.number_of_points; ++q) {
        const double volume = strain_operator(rule, points, q).volume;
        auto values = rule.values[q];
        for(int i = 0; i < nodes.number_of_middles(); ++i)
          for(int end : nodes.middle(i).ends)
            values[end] -= values[nodes.middle(i).edge] / 2;
        for(int a = 0; a < nodes.size(); ++a)
          for(int k = 0; k < 3; ++k)
            force[3 * Eigen::Index(nodes[a]) + k] += volume * values[nodes.function(a)] * density[k];
      }
    }
  }

private:
  const Quadrature_rule& rule_of(Element_index e) const
  {
    return quadrature_rule((*m_elements)[e].kind(), m_nodes.has_edges(e) ? 2 : 1);
  }

  std::vector<Vertex_index> vertices_of(const std::vector<Element_index>& elements) const
  {
    std::vector<Vertex_index> vertices;
    for(Element_index e : elements)
      vertices.insert(vertices.end(), (*m_elements)[e].begin(), (*m_elements)[e].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  void remove_removed(std::vector<Element_index>& elements) const
  {
    elements.erase(std::remove_if(elements.begin(), elements.end(),
                                  [this](Element_index e) { return m_is_removed[e]; }),
                   elements.end());
  }

  void add_element(Element_index e, double factor)
  {
    Elastic_material m = material(e);
    m.young_modulus *= factor;
    m_system->add(e, m, m_points, m_points, dilatation(e));
  }

  void add_patch(std::size_t i, double factor)
  {
    const std::vector<Element_index>& patch = m_patches[i];
    if(patch.empty())
      return;
    const std::vector<Vertex_index> vertices = vertices_of(patch);
    std::vector<Vec3> gradients(vertices.size(), Vec3{});
    double volume = 0;
    for(Element_index e : patch) {
      const Element_view element = (*m_elements)[e];
      const Element_points points = points_of(element);
      for(int q = 0; q < quadrature_rule(element.kind()).number_of_points; ++q) {
        const Strain_operator s = strain_operator(element.kind(), points, q);
        volume += s.volume;
        for(int a = 0; a < element.size(); ++a) {
          Vec3& g = gradients[std::size_t(std::lower_bound(vertices.begin(), vertices.end(), element[a])
                                          - vertices.begin())];
          g = g + s.volume * s.gradients[a];
        }
      }
    }
    m_system->add_patch(vertices, gradients, factor * mean_bulk_modulus(patch) / volume, m_points);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_STIFFNESS_H
