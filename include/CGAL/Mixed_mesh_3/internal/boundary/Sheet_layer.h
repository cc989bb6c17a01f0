// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets inside the domain, such as the falx: the vertices and the faces of the lattice that shall be on
// sheets.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SHEET_LAYER_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SHEET_LAYER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/sheet_compartments.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Replacement for sheets in a boundary stage without sheets.
struct No_sheets
{
  bool is_none() const { return true; }
  bool is_on(Vertex_index) const { return false; }
  double depth(Vertex_index) const { return 0; }
  bool mend(const Element_list&) { return false; }
  std::vector<Compartment_index> compartments() const { return {}; }
  std::size_t number_of_lost() const { return 0; }
};

/*!
A vertex behind a sheet that an edge connects to a vertex in front of the sheet becomes a *sheet vertex*. All
elements with a sheet vertex are split to tetrahedra by the order of the vertices, so that each edge between
front and behind ends at a sheet vertex: the faces between a tetrahedron with a vertex in front and a
tetrahedron without have sheet vertices only. These faces are the *sheet faces*. A vertex less than some share
of a cell in front counts as behind, so that sheet vertices are not far from the sheet on either side. The
order of the vertices makes diagonals; diagonals from front to behind, which are at the boundary, have sheet
vertices at their ends too.

The sheet faces end where the sheet ends inside the domain: vertices beyond its rim are no sheet vertices.

Where sheet faces touch each other other than along edges, or have a face of the boundary between them, which
would have no area, a vertex counts as in front, and if edges still touch, the vertex is no sheet vertex. A
tetrahedron may have four sheet vertices, where cells of two sizes meet or at the boundary: flips remove the
tetrahedron.

Each of two sheets that meet has faces of its own.
*/
class Sheet_layer
{
  using Edge = Sheet_edge;
  using Triangle = Sheet_triangle;

  struct Place
  {
    double height;      // height above the limit of behind, negative behind
    bool is_snapped;    // counts as behind, but is in front of the sheet, near it
    bool is_at_rim;     // the closest point is on the border of the sheet
    bool is_beyond_rim; // at the rim, and farther from it, along the sheet, than `near_rim`
    bool ends_outside;  // the closest point is not inside the domain, nor is the vertex
    Vec3 closest;
  };

  struct Sheet
  {
    std::size_t number;
    std::vector<Element_index> elements; // elements near the sheet, ascending
    std::map<Vertex_index, Place> places;
    std::set<Vertex_index> raised, dropped; // vertices that count as in front; that can not be on the sheet
    std::set<Vertex_index> at_diagonals;    // sheet vertices because of an edge of pieces
    std::map<Edge, bool> is_crossed;
    std::set<Vertex_index> vertices;
  };

  const Located_octree& m_located;
  const Lattice_mesh& m_mesh;
  std::vector<Sheet> m_sheets;
  std::vector<Compartment_index> m_compartments;
  std::size_t m_number_of_lost = 0;
  int m_round = 0;

  // Limits in cells. Half a cell would be best for a sheet parallel to the axes, 0.29 for the most oblique
  // sheet.
  static constexpr double snapping = 0.35;
  static constexpr double near_rim = 0.5;
  static constexpr int rounds_of_raising = 8;

public:
  Sheet_layer(const Located_octree& located, const Lattice_mesh& mesh) : m_located(located), m_mesh(mesh)
  {
    for(std::size_t i = 0; i < located.domain().sheets().size(); ++i) {
      m_sheets.push_back({i, {}, {}, {}, {}, {}, {}, {}});
      find_elements(m_sheets.back());
      find_vertices(m_sheets.back());
    }
  }

  bool is_none() const { return false; }

  /// Whether a vertex shall be on a sheet.
  bool is_on(Vertex_index v) const
  {
    return std::any_of(m_sheets.begin(), m_sheets.end(),
                       [v](const Sheet& s) { return s.vertices.count(v) > 0; });
  }

  /// Depth behind the sheet: vertices with the least depth come first in the order of the vertices, so that
  /// no tetrahedron has sheet vertices only, where sheet and cells are even.
  double depth(Vertex_index v) const
  {
    double least = std::numeric_limits<double>::infinity();
    for(const Sheet& s : m_sheets)
      if(s.vertices.count(v) > 0)
        least = (std::min)(least, -s.places.at(v).height);
    return least;
  }

  /// Checks the pieces that the elements were split into.
  /// \return whether sheet vertices have changed: then elements have to be split again
  bool mend(const Element_list& pieces)
  {
    bool has_changed = false;
    for(Sheet& s : m_sheets)
      has_changed = add_ends_of_diagonals(s, pieces) || has_changed;
    if(has_changed)
      return true;
    ++m_round;
    std::vector<std::set<Triangle>> faces;
    for(Sheet& s : m_sheets) {
      faces.push_back(sheet_faces(s, pieces));
      has_changed = mend(s, vertices_to_change(s, faces.back(), pieces)) || has_changed;
    }
    if(has_changed)
      return true;
    std::set<Triangle> all;
    m_number_of_lost = 0;
    for(const std::set<Triangle>& of_one : faces) {
      m_number_of_lost += of_one.empty();
      all.insert(of_one.begin(), of_one.end());
    }
    // Elements around inner vertices are included too, so that flips have more freedom.
    for(bool all_around : {true, false}) {
      m_compartments = find_sheet_compartments(m_mesh, pieces, all, all_around);
      const std::set<Triangle> lost = faces_within_compartments(pieces, all, m_compartments);
      if(lost.empty())
        return false;
      if(!all_around)
        for(std::size_t i = 0; i < m_sheets.size(); ++i)
          for(const Triangle& t : lost)
            if(faces[i].count(t) > 0)
              drop(m_sheets[i], lowest(m_sheets[i], {t.begin(), t.end()}));
    }
    return true;
  }

  /// The compartment of each piece; the two at a sheet face differ, and are positive. \pre `mend()` has
  /// returned `false`
  std::vector<Compartment_index> compartments() const { return m_compartments; }
  /// The number of sheets without faces.
  std::size_t number_of_lost() const { return m_number_of_lost; }

private:
  const Any_sheet& oracle(const Sheet& s) const { return *m_located.domain().sheets()[s.number]; }
  auto point(Vertex_index v) const { return m_located.point(m_mesh.vertices[v]); }
  double edge_length(Vertex_index v) const { return m_located.edge_length(m_mesh.leaves[v]); }

  void find_elements(Sheet& s) const
  {
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e) {
      const Element_view element = m_mesh.elements[e];
      if(!has_inside_vertex(element))
        continue;
      Bbox_3 box;
      double margin = 0;
      for(Vertex_index v : element) {
        box += point(v).bbox();
        margin = (std::max)(margin, snapping * edge_length(v));
      }
      if(oracle(s).may_intersect({box.xmin() - margin, box.ymin() - margin, box.zmin() - margin,
                                  box.xmax() + margin, box.ymax() + margin, box.zmax() + margin}))
        s.elements.push_back(e);
    }
  }

  // Adds the elements at raised vertices: vertices behind a raised vertex may be farther from the sheet.
  void add_elements_at_raised(Sheet& s) const
  {
    std::vector<Element_index> all;
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e) {
      const Element_view element = m_mesh.elements[e];
      if(std::any_of(element.begin(), element.end(), [&](Vertex_index v) { return s.raised.count(v) > 0; })
         && has_inside_vertex(element))
        all.push_back(e);
    }
    const std::vector<Element_index> known = std::move(s.elements);
    s.elements.clear();
    std::set_union(known.begin(), known.end(), all.begin(), all.end(), std::back_inserter(s.elements));
  }

  // Whether an element has a vertex inside: only such elements become part of the mesh.
  bool has_inside_vertex(const Element_view& element) const
  {
    return std::any_of(element.begin(), element.end(),
                       [this](Vertex_index v) { return m_mesh.is_inside(v); });
  }

  const Place& place(Sheet& s, Vertex_index v) const
  {
    const auto known = s.places.find(v);
    if(known != s.places.end())
      return known->second;
    const auto l = oracle(s).locate(point(v));
    const double h = snapping * edge_length(v);
    const bool ends_outside = l.is_at_rim && !m_mesh.is_inside(v) && !is_inside_domain(l.closest);
    const double d = norm(to_vec3(point(v)) - l.closest),
                 beyond = std::sqrt((std::max)(0., d * d - l.height * l.height));
    return s.places[v] = {l.height - h, l.height > 0 && l.height <= h,
                          l.is_at_rim,  l.is_at_rim && beyond > near_rim * edge_length(v),
                          ends_outside, l.closest};
  }

  bool is_inside_domain(const Vec3& p) const
  {
    const decltype(point(0)) q(p[0], p[1], p[2]);
    const auto leaf = m_located.leaf_at(q);
    if(m_located.side(leaf) != ON_BOUNDARY)
      return m_located.side(leaf) == ON_BOUNDED_SIDE;
    const auto& part = m_located.surface_part(leaf);
    if(m_located.domain().bounded_side(q, part) != ON_BOUNDED_SIDE)
      return false;
    // The point may be on the surface, up to rounding.
    return norm(to_vec3(m_located.domain().closest_point(q, part)) - p) > 1e-6 * m_located.edge_length(leaf);
  }

  bool is_in_front(Sheet& s, Vertex_index v) const { return s.raised.count(v) > 0 || place(s, v).height > 0; }

  void find_vertices(Sheet& s) const
  {
    s.vertices.clear();
    for(Element_index e : s.elements) {
      const Element_view element = m_mesh.elements[e];
      for(int i = 0; i < element.reference().number_of_edges; ++i) {
        Vertex_index front = element[element.reference().edges[i][0]],
                     behind = element[element.reference().edges[i][1]];
        if(is_in_front(s, front) == is_in_front(s, behind))
          continue;
        if(is_in_front(s, behind))
          std::swap(front, behind);
        if(s.dropped.count(behind) == 0 && is_crossed(s, front, behind))
          s.vertices.insert(behind);
      }
    }
    for(Vertex_index v : s.at_diagonals)
      if(s.dropped.count(v) == 0 && !is_in_front(s, v))
        s.vertices.insert(v);
  }

  // Adds sheet vertices at diagonals: as interface vertices come first in the order, diagonals at interface
  // vertices may lead from front to behind.
  bool add_ends_of_diagonals(Sheet& s, const Element_list& pieces) const
  {
    const std::size_t before = s.at_diagonals.size();
    const auto is_known = [&](Vertex_index v) { return s.places.count(v) > 0; }; // near the sheet
    for(std::size_t i = 0; i < pieces.size(); ++i) {
      const Element_view piece = pieces[i];
      if(!std::any_of(piece.begin(), piece.end(), is_known))
        continue;
      for(int k = 0; k < piece.reference().number_of_edges; ++k) {
        Vertex_index front = piece[piece.reference().edges[k][0]],
                     behind = piece[piece.reference().edges[k][1]];
        if(!is_known(front) || !is_known(behind) || is_in_front(s, front) == is_in_front(s, behind))
          continue;
        if(is_in_front(s, behind))
          std::swap(front, behind);
        if(s.vertices.count(behind) == 0 && s.dropped.count(behind) == 0 && is_crossed(s, front, behind)) {
          s.at_diagonals.insert(behind);
          s.vertices.insert(behind);
        }
      }
    }
    return s.at_diagonals.size() != before;
  }

  bool is_crossed(Sheet& s, Vertex_index front, Vertex_index behind) const
  {
    const Place &f = place(s, front), &b = place(s, behind);
    if(b.is_beyond_rim && !b.ends_outside)
      return false;
    if(s.raised.count(front) > 0 || (b.is_snapped && !b.is_at_rim))
      return true;
    if(b.is_at_rim && !b.is_beyond_rim && !f.is_beyond_rim)
      return true;
    const auto [known, is_new] = s.is_crossed.try_emplace(sheet_edge(front, behind), false);
    if(is_new) {
      const auto p = point(front), q = point(behind);
      const double length = norm(to_vec3(p) - to_vec3(q));
      const auto is_past_rim = [&](const Place& place, const auto& where) {
        return place.ends_outside && norm(to_vec3(where) - place.closest) <= length;
      };
      known->second = oracle(s).do_intersect(p, q) || is_past_rim(f, p) || is_past_rim(b, q);
    }
    return known->second;
  }

  // Faces with all vertices on the sheet, and exactly one of the two opposite vertices in front.
  std::set<Triangle> sheet_faces(Sheet& s, const Element_list& pieces) const
  {
    std::set<Triangle> faces;
    const auto is_candidate = [&](Vertex_index v) { return s.vertices.count(v) > 0; };
    for_each_face(pieces, m_mesh.vertices.size(), is_candidate, [&](const auto& group) {
      if(group.size() != 2)
        return;
      const Triangle t = sheet_triangle(group[0].vertices());
      bool front[2];
      for(std::size_t i = 0; i < 2; ++i)
        front[i] = is_in_front(s, apex(pieces[group.element(i)], t));
      if(front[0] != front[1])
        faces.insert(t);
    });
    return faces;
  }

  static Vertex_index apex(const Element_view& tetrahedron, const Triangle& face)
  {
    return *std::find_if(tetrahedron.begin(), tetrahedron.end(), [&](Vertex_index v) {
      return std::find(face.begin(), face.end(), v) == face.end();
    });
  }

  static Vertex_index highest(Sheet& s, const std::vector<Vertex_index>& vertices)
  {
    return *std::max_element(vertices.begin(), vertices.end(), [&](Vertex_index v, Vertex_index w) {
      return s.places.at(v).height < s.places.at(w).height;
    });
  }

  static Vertex_index lowest(Sheet& s, const std::vector<Vertex_index>& vertices)
  {
    return *std::min_element(vertices.begin(), vertices.end(), [&](Vertex_index v, Vertex_index w) {
      return s.places.at(v).height < s.places.at(w).height;
    });
  }

  // Vertices of boundary faces that would have no area, and vertices where the sheet faces are not manifold.
  std::set<Vertex_index> vertices_to_change(Sheet& s, const std::set<Triangle>& faces,
                                            const Element_list& pieces) const
  {
    std::set<Vertex_index> used, bad;
    std::map<Edge, int> edges;
    std::map<Vertex_index, std::vector<Edge>> links;
    for(const Triangle& t : faces)
      for(std::size_t i = 0; i < 3; ++i) {
        used.insert(t[i]);
        ++edges[sheet_edge(t[i], t[(i + 1) % 3])];
        links[t[i]].push_back(sheet_edge(t[(i + 1) % 3], t[(i + 2) % 3]));
      }
    for(const auto& [e, number] : edges)
      if(number > 2)
        bad.insert(highest(s, {e.first, e.second}));
    for(const auto& [v, link] : links)
      if(!is_connected(link))
        bad.insert(v);
    const auto is_used = [&](Vertex_index v) { return used.count(v) > 0; };
    for_each_face(pieces, m_mesh.vertices.size(), is_used, [&](const auto& group) {
      if(group.size() == 1 && m_round <= rounds_of_raising) { // later, some vertex will not arrive
        const Triangle t = sheet_triangle(group[0].vertices());
        bad.insert(highest(s, {t.begin(), t.end()}));
      }
    });
    return bad;
  }

  static bool is_connected(std::vector<Edge> links)
  {
    std::set<Vertex_index> reached{links[0].first, links[0].second};
    for(bool grows = true; grows;) {
      const auto rest = std::partition(links.begin(), links.end(), [&](const Edge& l) {
        return reached.count(l.first) == 0 && reached.count(l.second) == 0;
      });
      grows = rest != links.end();
      for(auto l = rest; l != links.end(); ++l)
        reached.insert({l->first, l->second});
      links.erase(rest, links.end());
    }
    return links.empty();
  }

  bool mend(Sheet& s, const std::set<Vertex_index>& bad)
  {
    for(Vertex_index v : bad)
      if(m_round <= rounds_of_raising && s.raised.insert(v).second)
        continue;
      else
        s.dropped.insert(v);
    if(bad.empty())
      return false;
    add_elements_at_raised(s);
    find_vertices(s);
    return true;
  }

  void drop(Sheet& s, Vertex_index v)
  {
    s.dropped.insert(v);
    find_vertices(s);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SHEET_LAYER_H
