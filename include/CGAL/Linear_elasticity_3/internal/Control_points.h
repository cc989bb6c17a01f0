// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The control points of an elastic body: the elements that contain them, the vertices whose mean displacement
// is that of a point, and the resulting constraints.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_POINTS_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_POINTS_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Linear_elasticity_result_3.h>
#include <CGAL/Linear_elasticity_3/internal/Control_options.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_body.h>
#include <CGAL/Linear_elasticity_3/internal/boundary_measures.h>
#include <CGAL/Linear_elasticity_3/internal/control_constraints.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_functions.h>
#include <CGAL/Mixed_mesh_3/internal/elements/with_kind.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Element_nodes.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The values of the shape functions of an element's nodes at a point, but zeros.
inline Control_weights node_weights(const Element_view& element, const Nodes_of_element& nodes,
                                    const Element_location_3& location)
{
  Control_weights weights;
  for(int i = 0; i < element.size(); ++i)
    if(location.weights[i] != 0)
      weights.emplace_back(element[i], location.weights[i]);
  if(nodes.order() == 1)
    return weights;
  const auto of_edges = with_kind(element.kind(),
                                  [&](auto kind) { return edge_functions<kind>(location.coordinates); });
  for(int i = element.size(); i < nodes.size(); ++i)
    if(const double w = of_edges[std::size_t(nodes.function(i) - element.size())].value; w != 0)
      weights.emplace_back(nodes[i], w);
  return weights;
}

/// Weights of nodes, with the weights of edges whose middle is prescribed, times a factor, added to their
/// ends: with -1/2, coefficients become displacements of middles; with 1/2, the other way around.
inline Control_weights add_to_ends(const Element_nodes& nodes, double factor, Control_weights weights)
{
  std::map<Vertex_index, double> of_ends;
  for(const auto& [node, weight] : weights)
    if(nodes.is_middle(node))
      for(Vertex_index v : nodes.ends()[node - nodes.number_of_vertices()])
        of_ends[v] += factor * weight;
  if(of_ends.empty())
    return weights;
  for(auto& [node, weight] : weights)
    if(const auto end = of_ends.find(node); end != of_ends.end()) {
      weight += end->second;
      of_ends.erase(end);
    }
  weights.insert(weights.end(), of_ends.begin(), of_ends.end());
  return weights;
}

/// The elements that are left, and the location of points in them.
class Located_elements
{
  using Kernel = CGAL::Simple_cartesian<double>; // points are in doubles
  using Mesh = Mixed_mesh_3<Kernel>;

  std::vector<Element_index> m_elements;        // numbers of the elements in the whole mesh
  Mesh m_mesh;                                  // mesh of the elements, with all vertices
  Element_locator_3<Mesh> m_locator;            // refers to m_mesh
  std::optional<Boundary_integrals> m_boundary; // when needed, as the nodes of edges
  Nodes_of_edges m_nodes_of_edges;

public:
  Located_elements(const Element_list& elements, const std::vector<Vec3>& points,
                   const std::vector<bool>& is_removed)
    : m_mesh(remaining(elements, points, is_removed, m_elements)), m_locator(m_mesh)
  {
  }

  // The class is not copyable: the locator would refer to the mesh of the other object.
  Located_elements(const Located_elements&) = delete;
  Located_elements& operator=(const Located_elements&) = delete;

  /// The nearest point of the remaining mesh. Its element has a number other than in the whole mesh.
  Element_location_3 nearest(const Vec3& p) const { return m_locator.nearest(p); }

  /// The number of an element in the whole mesh.
  Element_index element(const Element_location_3& location) const { return m_elements[location.element]; }

  /// The values of the shape functions of an element's nodes.
  Control_weights weights(const Element_location_3& location, const Element_nodes& all) const
  {
    return node_weights(m_mesh.element(location.element), all[element(location)], location);
  }

  /// Spreads weights over the boundary around a point, by area; unchanged if there are too few vertices. The
  /// weighted sum is a mean of the field, also between vertices.
  void spread(const std::vector<Vec3>& points, const Element_nodes& nodes, const Vec3& p, double radius,
              Control_weights& weights)
  {
    if(!m_boundary) {
      m_boundary.emplace(m_mesh);
      for(std::size_t i = 0; i < nodes.ends().size(); ++i)
        m_nodes_of_edges.emplace(nodes.ends()[i], Vertex_index(nodes.number_of_vertices() + i));
    }
    const auto integrals = (*m_boundary)([&](Vertex_index v) { return norm(points[v] - p) <= radius; },
                                         m_nodes_of_edges);
    int number_of_vertices = 0;
    double area = 0;
    for(const auto& [node, integral] : integrals)
      if(node < nodes.number_of_vertices()) {
        ++number_of_vertices;
        area += integral;
      }
    if(number_of_vertices < 3)
      return;
    weights.clear();
    for(const auto& [node, integral] : integrals)
      weights.emplace_back(node, integral / area);
  }

private:
  static Mesh remaining(const Element_list& elements, const std::vector<Vec3>& points,
                        const std::vector<bool>& is_removed, std::vector<Element_index>& numbers)
  {
    Mesh rest;
    for(const Vec3& p : points)
      rest.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
    for(Element_index e = 0; e < elements.size(); ++e)
      if(!is_removed[e]) {
        rest.add_element(elements[e].kind(), elements[e].begin());
        numbers.push_back(e);
      }
    return rest;
  }
};

class Control_points
{
  using Result = Linear_elasticity_result_3;
  using Status = Linear_elasticity_status;

  // A pointer, as the object cannot be moved.
  std::unique_ptr<Located_elements> m_located; // null until needed
  Control_options m_options;
  std::vector<Vec3> m_positions;
  std::vector<Element_index> m_elements; // elements that contain the points
  std::optional<Control_constraints> m_constraints;

public:
  const std::vector<Vec3>& positions() const { return m_positions; }
  const Control_options& options() const { return m_options; }

  /// Forgets the located elements. To be called when elements have been removed.
  void forget_elements() { m_located.reset(); }
  /// Forgets the constraints. To be called before the body is factored.
  void forget_constraints() { m_constraints.reset(); }

  void clear(const Control_options& options)
  {
    m_options = options;
    m_positions.clear();
    m_elements.clear();
    m_constraints.reset();
  }

  /// Whether the points act on the remaining body only.
  bool are_on(const Elastic_body& body) const
  {
    return (!m_constraints || m_constraints->is_on(body.supports().kept_nodes()))
           && std::none_of(m_elements.begin(), m_elements.end(),
                           [&](Element_index e) { return body.stiffness().is_removed(e); });
  }

  /// Places control points where there are none. There are no control points either if placing fails.
  /// \pre the body is factored
  Result place(Elastic_body& body, std::vector<Vec3> positions)
  {
    CGAL_precondition(m_positions.empty());
    if(!m_located && !positions.empty())
      m_located = std::make_unique<Located_elements>(body.stiffness().elements(), body.stiffness().points(),
                                                     body.stiffness().removed_elements());
    std::vector<Element_index> elements;
    std::vector<Control_weights> weights;
    for(const Vec3& p : positions) {
      const Element_location_3 location = m_located->nearest(p);
      if(location.distance > m_options.largest_distance || !std::isfinite(location.distance)) {
        Result result = failed(Status::CONTROL_POINT_OUTSIDE);
        result.control_point = weights.size();
        result.distance = location.distance;
        return result;
      }
      elements.push_back(m_located->element(location));
      weights.push_back(m_located->weights(location, body.stiffness().nodes()));
      if(m_options.radius > 0)
        m_located->spread(body.stiffness().points(), body.stiffness().nodes(), p, m_options.radius,
                          weights.back());
      weights.back() = add_to_ends(body.stiffness().nodes(), -0.5, std::move(weights.back()));
    }
    const Result result = constrain(body, std::move(weights));
    if(result.is_success()) {
      m_positions = std::move(positions);
      m_elements = std::move(elements);
    }
    return result;
  }

  /// Prepares the constraints, also if there is no control point. \pre the body is factored
  Result prepare(Elastic_body& body) { return m_constraints ? Result() : constrain(body, {}); }

  /// The constraints. \pre `place()` or `prepare()` was successful
  const Control_constraints& constraints() const { return *m_constraints; }
  bool has_constraints() const { return m_constraints.has_value(); }

private:
  static Result failed(Status status)
  {
    Result result;
    result.status = status;
    return result;
  }

  Result constrain(Elastic_body& body, std::vector<Control_weights> weights)
  {
    std::vector<double> compliances(weights.size(), m_options.compliance);
    if(!m_options.weights.empty())
      for(std::size_t p = 0; p < weights.size(); ++p)
        compliances[p] /= m_options.weights[p];
    m_constraints.emplace(std::move(weights), compliances, body.system().free_motions(),
                          body.stiffness().points(), body.supports().of_vertices(),
                          [&](const Eigen::MatrixXd& f, Eigen::MatrixXd& u) { return body.solve(f, u); });
    if(m_constraints->is_solved())
      return Result();
    m_constraints.reset();
    return failed(Status::SOLVER_FAILED);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_POINTS_H
