// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Supports and contacts of the vertices of an elastic body; the connected parts of the body, and the free
// motions of the parts.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_SUPPORTS_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_SUPPORTS_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/internal/Elastic_stiffness.h>
#include <CGAL/Linear_elasticity_3/internal/boundary_measures.h>
#include <CGAL/Linear_elasticity_3/internal/rigid_modes.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_bubbles.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Element_nodes.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A connected part of a body, and a basis of the rigid motions that its supports leave free.
struct Elastic_part
{
  std::vector<Vertex_index> vertices;
  std::vector<Rigid_mode> modes;
};

/// A vertex that a wall stops, without friction, when its displacement in the direction of the normal is the
/// gap. The wall then holds the vertex, as long as the wall pushes.
struct Contact
{
  Vec3 normal; // length 1, to the outside
  double gap;  // mm
  bool is_closed;
};

class Elastic_supports
{
  std::vector<Support> m_permanent; // support of each node, without contacts
  std::vector<Support> m_supports;  // supports with closed contacts
  std::map<Vertex_index, Contact> m_contacts;
  std::map<Edge_ends, std::optional<Vec3>> m_given_edges;
  std::map<Edge_ends, Vec3> m_given_middles;
  std::vector<bool> m_is_kept; // whether an element is left at each node
  std::vector<Elastic_part> m_parts;

public:
  explicit Elastic_supports(std::size_t number_of_vertices)
    : m_permanent(number_of_vertices), m_supports(number_of_vertices)
  {
  }

  void prescribe(Vertex_index v, const Vec3& displacement)
  {
    m_permanent[v].size = 3;
    m_permanent[v].directions = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    m_permanent[v].displacement = displacement;
    m_supports[v] = m_permanent[v];
  }

  void slide(Vertex_index v, const Vec3& normal)
  {
    m_permanent[v].add(normal);
    m_supports[v] = m_permanent[v];
  }

  void touch(Vertex_index v, const Vec3& normal, double gap)
  {
    m_contacts[v] = {(1 / norm(normal)) * normal, gap, gap <= 0};
  }

  /// Holds an edge whose ends are prescribed, or leaves the edge free; else supports follow from those of
  /// faces.
  /// \param coefficient coefficient of the edge: the displacement of its middle minus the mean of its ends
  void prescribe_edge(const Edge_ends& ends, const std::optional<Vec3>& coefficient)
  {
    m_given_edges[ends] = coefficient;
    m_given_middles.erase(ends);
  }

  /// Prescribes the displacement of the middle of an edge, also if the ends are free.
  void prescribe_middle(const Edge_ends& ends, const Vec3& displacement)
  {
    m_given_middles[ends] = displacement;
    m_given_edges.erase(ends);
  }

  /// Whether the value of each edge that is a node is the displacement of its middle, as this is prescribed.
  std::vector<bool> given_middles(const Element_nodes& nodes) const
  {
    std::vector<bool> is_given;
    if(!m_given_middles.empty())
      for(const Edge_ends& ends : nodes.ends())
        is_given.push_back(m_given_middles.count(ends) != 0);
    return is_given;
  }

  /*!
  Supports the edges that are nodes, as the supports of vertices imply: an edge of a face of the boundary
  whose vertices are all supported is held in the directions in which both ends are held, with the coefficient
  0. So the face moves as if it were linear, and an edge through the inside is free, as is an edge with a free
  end. To be called before `find_parts()`.
  */
  void support_edges(const Elastic_stiffness& stiffness)
  {
    const Element_nodes& nodes = stiffness.nodes();
    m_permanent.resize(nodes.number_of_vertices());
    std::vector<Edge_ends> of_faces;
    if(nodes.has_edges())
      for(const Face& face :
          boundary_faces(Elements_of_vertices(nodes.elements(), nodes.number_of_vertices()),
                         [this](Vertex_index v) { return m_permanent[v].size > 0; })) {
        const Face_vertices& v = face.vertices();
        for(int i = 0; i < v.size(); ++i) {
          const auto [a, b] = std::minmax({v[i], v[(i + 1) % v.size()]});
          of_faces.push_back({a, b});
        }
      }
    std::sort(of_faces.begin(), of_faces.end());
    for(const Edge_ends& ends : nodes.ends()) {
      const Support a = m_permanent[ends[0]], b = m_permanent[ends[1]];
      Support support;
      if(const auto given = m_given_edges.find(ends); given != m_given_edges.end()) {
        if(given->second && a.size == 3 && b.size == 3) {
          support = a;
          support.displacement = *given->second;
        }
      } else if(const auto middle = m_given_middles.find(ends); middle != m_given_middles.end()) {
        support.size = 3;
        support.directions = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        support.displacement = middle->second;
      } else if(std::binary_search(of_faces.begin(), of_faces.end(), ends)) {
        support = common_support(a, b);
      }
      m_permanent.push_back(support);
    }
    m_supports = m_permanent;
  }

  /// Sets the displacement of a vertex. \pre the vertex is prescribed
  void set_displacement(Vertex_index v, const Vec3& displacement)
  {
    CGAL_precondition(m_permanent[v].size == 3);
    m_permanent[v].displacement = m_supports[v].displacement = displacement;
  }

  /// The supports of nodes, including closed contacts.
  const std::vector<Support>& of_vertices() const { return m_supports; }

  const std::map<Vertex_index, Contact>& contacts() const { return m_contacts; }

  /// The direction in which a wall with that normal holds a vertex: orthogonal to the directions of other
  /// supports; zero if these hold the vertex anyway.
  Vec3 direction_of_contact(Vertex_index v, const Vec3& normal) const
  {
    Support support = m_permanent[v];
    const int size = support.size;
    support.add(normal);
    return support.size > size ? support.directions[std::size_t(size)] : Vec3{};
  }

  /// Whether other contacts are closed than initially.
  bool are_contacts_changed() const
  {
    return std::any_of(m_contacts.begin(), m_contacts.end(),
                       [](const auto& c) { return c.second.is_closed != (c.second.gap <= 0); });
  }
  /// Resets the contacts. `find_parts()` has to be called afterwards.
  void reset_contacts()
  {
    for(auto& [v, contact] : m_contacts)
      contact.is_closed = contact.gap <= 0;
  }

  /// Closes or opens a contact. `find_parts()` has to be called afterwards.
  void set_closed(Vertex_index v, bool is_closed) { m_contacts.at(v).is_closed = is_closed; }

  /// Finds the parts. To be called when elements have been removed, or supports or contacts changed.
  void find_parts(const Elastic_stiffness& stiffness)
  {
    apply_contacts();
    m_parts.clear();
    m_is_kept.assign(m_supports.size(), false);
    for(Element_index e = 0; e < stiffness.elements().size(); ++e)
      if(!stiffness.is_removed(e))
        for(Vertex_index node : stiffness.nodes()[e])
          m_is_kept[node] = true;
    for(std::vector<Vertex_index>& vertices :
        connected_vertices(stiffness.elements(), stiffness.number_of_vertices(),
                           [&](Element_index e) { return !stiffness.is_removed(e); })) {
      std::vector<Rigid_mode> modes = stiffness.nodes().has_middles()
                                        ? free_modes_with_middles(vertices, stiffness)
                                        : free_rigid_modes(vertices, stiffness.points(), m_supports);
      m_parts.push_back({std::move(vertices), std::move(modes)});
    }
  }

  const std::vector<Elastic_part>& parts() const { return m_parts; }

  /// The number of free motions of each part.
  std::vector<std::size_t> numbers_of_free_motions() const
  {
    std::vector<std::size_t> n;
    for(const Elastic_part& part : m_parts)
      n.push_back(part.modes.size());
    return n;
  }

  const std::vector<bool>& kept_nodes() const { return m_is_kept; }
  bool is_kept(Vertex_index v) const { return m_is_kept[v]; }
  /// Whether a node may move in some direction when its contacts are open.
  bool may_be_free(Vertex_index v) const { return m_is_kept[v] && m_permanent[v].size < 3; }
  /// Whether a node may move in some direction.
  bool is_free(Vertex_index v) const { return m_is_kept[v] && m_supports[v].size < 3; }
  /// Whether a node may move in all directions.
  bool is_unsupported(Vertex_index v) const { return m_supports[v].size == 0 && m_is_kept[v]; }

  /// The component of a vector in free directions; zero if no element is left.
  Vec3 free_part(Vertex_index v, const Vec3& u) const
  {
    return m_is_kept[v] ? m_supports[v].free_part(u) : Vec3{};
  }

  /// The components in free directions of a vector of three components for each node.
  Eigen::VectorXd free_part(Eigen::VectorXd f) const
  {
    for(Vertex_index v = 0; v < m_supports.size(); ++v) {
      const Eigen::Index i = 3 * Eigen::Index(v);
      const Vec3 x = free_part(v, {f[i], f[i + 1], f[i + 2]});
      for(int k = 0; k < 3; ++k)
        f[i + k] = x[k];
    }
    return f;
  }

private:
  // The free modes of a part, which middles of edges hold as vertices do.
  std::vector<Rigid_mode> free_modes_with_middles(std::vector<Vertex_index> vertices,
                                                  const Elastic_stiffness& stiffness) const
  {
    const Element_nodes& nodes = stiffness.nodes();
    std::vector<Vec3> points = stiffness.points();
    std::vector<bool> is_in_part(points.size(), false);
    for(Vertex_index v : vertices)
      is_in_part[v] = true;
    for(const auto& [v, w] : nodes.ends()) {
      const Vertex_index node = Vertex_index(points.size());
      points.push_back(0.5 * (stiffness.points()[v] + stiffness.points()[w]));
      if(is_in_part[v] && m_is_kept[node] && nodes.is_middle(node))
        vertices.push_back(node);
    }
    return free_rigid_modes(vertices, points, m_supports);
  }

  void apply_contacts()
  {
    for(const auto& [v, contact] : m_contacts) {
      Support& support = m_supports[v] = m_permanent[v];
      const Vec3 d = direction_of_contact(v, contact.normal);
      if(!contact.is_closed || d == Vec3{})
        continue;
      support.add(contact.normal);
      const double missing = contact.gap - dot(contact.normal, support.displacement);
      support.displacement = support.displacement + (missing / dot(contact.normal, d)) * d;
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_SUPPORTS_H
