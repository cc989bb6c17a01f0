// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a mesh that is fine enough to be faithful to one with fewer vertices, of the same topology.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_MESH_SIMPLIFIER_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_MESH_SIMPLIFIER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/elements/Interface_curves.h>
#include <CGAL/Mixed_mesh_3/internal/base/Plane_quadric.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Boundary_triangles.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Edge_collapser.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>

#include <CGAL/Simple_cartesian.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Why a vertex goes before others.
enum class Vertex_defect : std::uint8_t {
  NONE,
  ELEMENT, ///< one of its elements costs more than the bound
  PLACE    ///< it is not where it should be: faces may turn far
};

/*!
Removes vertices by edge collapses, those first whose loss is least.

The loss of a collapse of v into w is the cube of the longest new edge, the volume in which the solution gets
coarser, times the larger one of their weights, plus, on the boundary, a multiple of the volume between w and
the planes of the boundary of the start that v and w stand for.

A vertex goes into a vertex of its own stratum or of one in its closure: a corner stays, a vertex of a sharp
edge goes along it, as does one of a curve where interfaces of subdomains meet, one of the boundary or of an
interface along that, one inside anywhere. A collapse keeps the topology of the mesh, of its boundary, of
interfaces and of their curves, and of sharp edges; the boundary does not cut itself, and its faces do not
turn far. Vertices in a region, and near it, stay unless an element is above the bound. Vertices off their
places go first, those of bad elements sooner, and others go into neither. The meshes of fewer and fewer
vertices are a sequence: those of one are among those of the one before.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Mesh_simplifier
{
  using Triangle = Boundary_triangles::Triangle;
  using Kernel = CGAL::Simple_cartesian<double>;
  template <class T>
  using Short_vector = boost::container::small_vector<T, 32>;

  struct Candidate
  {
    double loss;
    Vertex_index end;

    bool operator<(const Candidate& c) const { return loss != c.loss ? loss < c.loss : end < c.end; }
  };

  struct Entry
  {
    std::int64_t key; // of the loss: the same on every machine, nearly always
    Vertex_index vertex;

    bool operator<(const Entry& e) const // the first one is the largest
    {
      return key != e.key ? key > e.key : vertex > e.vertex;
    }
  };

  struct Choice
  {
    Vertex_index end = no_vertex;
    std::size_t time = 0; // number of collapses before it was made
  };

  Working_mesh& m_mesh;
  Edge_collapser<Quality> m_collapser;
  Boundary_triangles m_boundary;
  const Sharp_features& m_features;
  const Stratum m_first_corner;
  const Vec3 m_origin; // of the quadrics
  std::vector<Plane_quadric> m_quadrics;
  const std::vector<Vec3>& m_targets;
  std::vector<std::vector<Vec3>> m_places; // of what was removed, at the vertices it went into
  const std::vector<Vertex_defect>& m_defects;
  Interface_curves m_curves;
  std::vector<std::uint8_t> m_is_outer;           // whether a vertex is on the boundary of the domain
  std::vector<std::uint8_t> m_is_queued, m_stays; // vertices of elements other than tetrahedra stay
  std::vector<double> m_weights;                  // of vertices; empty: all are equal
  std::vector<std::size_t> m_changed;             // number of collapses when elements of the vertex changed
  std::vector<Choice> m_choices;
  std::vector<std::uint64_t> m_marks; // time at which each vertex was marked as a neighbor
  std::uint64_t m_time = 0;
  std::priority_queue<Entry> m_queue;
  std::size_t m_removed = 0;
  double m_bound = 0, m_distance = 0;
  bool m_follows_curves = true, m_keeps_region = true, m_keeps_all_near = false;

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  // Shares of the loss: vertices off their places go before all others, those of bad elements before others
  // of a similar loss. If these went before all others, too, small subdomains would be left with few
  // vertices, as the cuts that make their interfaces leave slivers: one of 0.8 % of the volume would lack 6.6
  // % of its own.
  static constexpr double share_of_place = 1e-30, share_of_element = 0.1;
  // Weight of the volume at the boundary, beside the cubes of edges. With 100, brains of 2,000 vertices are a
  // tenth farther from their surface in the mean, and the mean aspect-ratio coefficient is 1.32 instead of
  // 1.36.
  static constexpr double weight_of_surface = 400;
  // Weight of 0.2 radii of the region. If only vertices in it stay, errors of a bump of 10,000 vertices are
  // larger by a twentieth; if these may go, too, by a factor of 2.
  static constexpr double weight_that_stays = 0.5;
  static constexpr double least_cosine = 0.2; // between a face and the one that takes its place

public:
  /// \param boundary triangles of the boundary and of interfaces, all of them
  /// \param is_on_boundary for each of them, whether it is on the boundary of the domain
  /// \param weights of the volume at each of them
  /// \param targets where the vertices should be, to be kept by the caller
  /// \param defects whether a vertex goes first, to be kept by the caller
  /// \param features sharp edges that the mesh follows, to be kept by the caller
  /// \param number_of_triangles in the end, about
  Mesh_simplifier(Working_mesh& mesh, const Quality& quality, const std::vector<Face_vertices>& boundary,
                  const std::vector<std::uint8_t>& is_on_boundary, const std::vector<double>& weights,
                  const std::vector<Vec3>& targets, const std::vector<Vertex_defect>& defects,
                  const Sharp_features& features, std::size_t number_of_triangles)
    : m_mesh(mesh), m_collapser(mesh, quality), m_boundary(mesh.points, boundary, number_of_triangles),
      m_features(features), m_first_corner(Stratum(first_sharp_stratum + features.polylines().size())),
      m_origin(targets.front()), m_quadrics(targets.size()), m_targets(targets), m_places(targets.size()),
      m_defects(defects), m_curves(boundary, targets.size()), m_is_outer(targets.size(), 0),
      m_is_queued(targets.size(), 0), m_stays(targets.size(), 0), m_changed(targets.size(), 0),
      m_choices(targets.size()), m_marks(targets.size(), 0)
  {
    for(const Working_mesh::Element& element : mesh.elements)
      if(element.kind != TETRAHEDRON)
        for(Vertex_index v : element)
          m_stays[v] = 1;
    for(std::size_t f = 0; f < boundary.size(); ++f) {
      const Face_vertices& v = boundary[f];
      for(int i = 0; i < 3; ++i) {
        m_quadrics[v[i]].add(targets[v[0]] - m_origin, targets[v[1]] - m_origin, targets[v[2]] - m_origin,
                             weights[f]);
        m_is_outer[v[i]] = m_is_outer[v[i]] || is_on_boundary[f];
      }
    }
    for(Vertex_index v = 0; v < m_stays.size(); ++v)
      m_stays[v] = m_stays[v] || m_curves.is_corner(v);
  }

  /// \param weights of the volume around vertices, with a region; those in it have the weight 1
  void set_weights(std::vector<double> weights) { m_weights = std::move(weights); }
  /// Holds a vertex where it is: others may go into it.
  void hold(Vertex_index v) { m_stays[v] = 1; }
  /// Lets the distance hold for all places around a collapse, and not only for those that the vertex which
  /// goes stands for. A place belongs to one vertex, and has to be near to a face of this one.
  void keep_all_places_near() { m_keeps_all_near = true; }
  /// Lets vertices in the region, and near it, go as others do.
  void give_up_region() { m_keeps_region = false; }

  /// \param bound no new element costs more
  /// \param distance no place that a boundary vertex has left is farther from the boundary
  /// \param follows_curves whether edges stay as near to sharp edges as `Feature_polyline::is_near()` tells
  /// \param most vertices that are removed
  /// \return how many were
  std::size_t operator()(double bound, double distance, bool follows_curves, std::size_t most,
                         const std::function<bool()>& go_on)
  {
    m_bound = bound;
    m_distance = distance;
    m_follows_curves = follows_curves;
    m_queue = {};
    std::fill(m_is_queued.begin(), m_is_queued.end(), 0);
    std::fill(m_choices.begin(), m_choices.end(), Choice());
    for(Vertex_index v = 0; v < m_mesh.points.size(); ++v)
      push(v);
    const std::size_t before = m_removed;
    while(m_removed - before < most && !m_queue.empty()) {
      const auto [key, v] = m_queue.top();
      m_queue.pop();
      m_is_queued[v] = 0;
      if(m_mesh.incident[v].empty())
        continue;
      if(!is_still_true(v)) {
        const Candidate best = best_candidate(v);
        m_choices[v] = {best.end, m_removed};
        if(best.end == no_vertex)
          continue; // until something changes beside it
        if(key_of(best.loss) > key) {
          push(v, best.loss);
          continue;
        }
      }
      collapse(v, m_choices[v].end);
      if(m_removed % 256 == 0 && !go_on())
        break;
    }
    return m_removed - before;
  }

private:
  static std::int64_t key_of(double loss)
  {
    return std::int64_t(std::llround(65536 * std::log2((std::max)(loss, 1e-300))));
  }

  // Whether nothing has changed since the end of the edge was chosen.
  bool is_still_true(Vertex_index v) const
  {
    const Choice& c = m_choices[v];
    return c.end != no_vertex && m_changed[c.end] <= c.time && m_changed[v] <= c.time && !crosses(v, c.end);
  }

  void push(Vertex_index v, double loss)
  {
    m_queue.push({key_of(loss), v});
    m_is_queued[v] = 1;
  }

  // With the least loss of all candidates, which may turn out to be impossible when its turn comes.
  void push(Vertex_index v)
  {
    if(m_mesh.incident[v].empty() || m_is_queued[v] || m_mesh.strata[v] >= m_first_corner || m_stays[v]
       || (m_keeps_region && !m_weights.empty() && m_weights[v] > weight_that_stays && !has_defect(v)))
      return;
    const Short_vector<Candidate> all = candidates(v);
    if(!all.empty())
      push(v, std::min_element(all.begin(), all.end())->loss);
  }

  // By elements, each once, in any order: marks find the neighbors in less time than sorting.
  Short_vector<Vertex_index> neighbors(Vertex_index v)
  {
    Short_vector<Vertex_index> all;
    m_marks[v] = ++m_time;
    for(Element_index e : m_mesh.incident[v])
      for(Vertex_index u : m_mesh.elements[e])
        if(m_marks[u] != m_time) {
          m_marks[u] = m_time;
          all.push_back(u);
        }
    return all;
  }

  // Ascending.
  Short_vector<Vertex_index> neighbors_on_boundary(Vertex_index v) const
  {
    Short_vector<Vertex_index> all;
    m_boundary.for_each_at(v, [&](const Triangle& t) {
      for(Vertex_index u : t)
        if(u != v)
          all.push_back(u);
    });
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  // The vertices that a vertex may go into, as far as strata tell.
  Short_vector<Vertex_index> ends(Vertex_index v)
  {
    const bool is_on_boundary = m_mesh.is_on_boundary(v);
    Short_vector<Vertex_index> all;
    if(m_curves.is_on_curve(v))
      all.assign(m_curves.neighbors(v).begin(), m_curves.neighbors(v).end());
    else
      all = is_on_boundary ? neighbors_on_boundary(v) : neighbors(v);
    if(m_mesh.strata[v] >= first_sharp_stratum)
      all.erase(std::remove_if(all.begin(), all.end(),
                               [&](Vertex_index w) { return !m_mesh.keeps_sharp_edges(v, w); }),
                all.end());
    return all;
  }

  Short_vector<Candidate> candidates(Vertex_index v)
  {
    Short_vector<Candidate> all;
    const Short_vector<Vertex_index> around = neighbors(v);
    for(Vertex_index w : ends(v)) {
      if(has_defect(w) && !has_defect(v))
        continue;
      double longest = 0; // squared
      for(Vertex_index u : around) {
        const Vec3 edge = m_mesh.points[u] - m_mesh.points[w];
        longest = (std::max)(longest, dot(edge, edge));
      }
      double loss = longest * std::sqrt(longest);
      if(!m_weights.empty())
        loss *= (std::max)(m_weights[v], m_weights[w]);
      if(m_mesh.is_on_boundary(v)) {
        Plane_quadric quadric = m_quadrics[v];
        quadric += m_quadrics[w];
        loss += weight_of_surface * quadric.volume(m_mesh.points[w] - m_origin);
      }
      all.push_back({share(v) * loss, w});
    }
    return all;
  }

  Candidate best_candidate(Vertex_index v)
  {
    Candidate best{infinity, no_vertex};
    const bool may_be_bad = m_defects[v] == Vertex_defect::PLACE; // the least bad of all ends is chosen
    // New elements of a vertex that has to go may be as bad as those before.
    double least = has_defect(v) ? (std::max)(m_bound, m_collapser.worst_at(v)) : m_bound;
    Short_vector<Candidate> all = candidates(v);
    std::sort(all.begin(), all.end());
    for(const Candidate& c : all) {
      const double worst = m_collapser.worst_after(v, c.end, least);
      if(!(worst < least || (worst == least && best.end == no_vertex)) || !is_possible(v, c.end))
        continue;
      if(worst <= m_bound && !may_be_bad)
        return c;
      least = worst;
      best = c;
    }
    return best;
  }

  // Whether an edge can be collapsed, but for the cost of elements.
  bool is_possible(Vertex_index v, Vertex_index w)
  {
    return !(m_follows_curves && m_mesh.is_sharp(v, w) && !follows_curve(v, w))
           && !(m_mesh.is_on_boundary(v) && (!is_link_of_boundary_edge(v, w) || !stays_near(v, w)))
           && m_collapser.is_link_of_edge(v, w) && !crosses(v, w);
  }

  // Whether the edge that takes the place of two edges of a polyline is near to the polyline.
  bool follows_curve(Vertex_index v, Vertex_index w) const
  {
    const Stratum s = m_mesh.sharp_stratum(v, w);
    const Feature_polyline& polyline = m_features.polylines()[s - first_sharp_stratum];
    const auto length_at = [&](Vertex_index u) {
      return m_features.arc_length(m_mesh.points[u], m_mesh.strata[u] - first_sharp_stratum, polyline);
    };
    for(Vertex_index u : m_mesh.sharp_neighbors(v))
      if(u != w && !polyline.is_near(m_mesh.points[u], length_at(u), m_mesh.points[w], length_at(w)))
        return false;
    return true;
  }

  bool has_defect(Vertex_index v) const { return m_defects[v] != Vertex_defect::NONE; }

  double share(Vertex_index v) const
  {
    return m_defects[v] == Vertex_defect::PLACE     ? share_of_place
           : m_defects[v] == Vertex_defect::ELEMENT ? share_of_element
                                                    : 1;
  }

  // Interfaces inside cut nothing as long as all elements are positive and the boundary does not cut itself.
  bool crosses(Vertex_index v, Vertex_index w) const { return m_is_outer[v] && m_boundary.would_cross(v, w); }

  // The link condition on the boundary and on interfaces: the triangles at the edge, and nothing else in
  // common; and on the curves where interfaces meet.
  bool is_link_of_boundary_edge(Vertex_index v, Vertex_index w) const
  {
    const Short_vector<Vertex_index> at_v = neighbors_on_boundary(v), at_w = neighbors_on_boundary(w);
    Short_vector<Vertex_index> common;
    std::set_intersection(at_v.begin(), at_v.end(), at_w.begin(), at_w.end(), std::back_inserter(common));
    std::size_t number_at_edge = 0;
    bool is_sphere = false; // of four triangles
    m_boundary.for_each_at(v, [&](const Triangle& t) {
      const bool has_edge = std::find(t.begin(), t.end(), w) != t.end();
      number_at_edge += has_edge;
      is_sphere = is_sphere || (!has_edge && std::all_of(t.begin(), t.end(), [&](Vertex_index u) {
                    return u == v || std::binary_search(common.begin(), common.end(), u);
                  }));
    });
    return number_at_edge >= 2 && common.size() == number_at_edge && !is_sphere && m_curves.is_link(v, w);
  }

  // Whether the new faces are near to all places that vertices have left, and do not turn far, unless the
  // vertex is not where it should be.
  bool stays_near(Vertex_index v, Vertex_index w) const
  {
    const std::vector<Vec3>& p = m_mesh.points;
    const auto point = [](const Vec3& q) { return Kernel::Point_3(q[0], q[1], q[2]); };
    Short_vector<Kernel::Triangle_3> fan;
    bool turns = false;
    m_boundary.for_each_at(v, [&](const Triangle& old) {
      if(std::find(old.begin(), old.end(), w) != old.end())
        return;
      Triangle t = old;
      std::replace(t.begin(), t.end(), v, w);
      const Vec3 before = cross(p[old[1]] - p[old[0]], p[old[2]] - p[old[0]]),
                 after = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
      turns = turns || !(dot(before, after) > least_cosine * norm(before) * norm(after));
      fan.emplace_back(point(p[t[0]]), point(p[t[1]]), point(p[t[2]]));
    });
    const auto is_near = [&](const Vec3& place) {
      return std::any_of(fan.begin(), fan.end(), [&](const Kernel::Triangle_3& t) {
        return CGAL::squared_distance(point(place), t) <= m_distance * m_distance;
      });
    };
    return (m_defects[v] == Vertex_defect::PLACE || !turns) && is_near(m_targets[v])
           && std::all_of(m_places[v].begin(), m_places[v].end(), is_near)
           && (!m_keeps_all_near || keep_near(v, w));
  }

  // Whether the places of vertices whose faces change, other than v, stay near to a face of their vertex.
  bool keep_near(Vertex_index v, Vertex_index w) const
  {
    const auto point = [this](Vertex_index u) {
      const Vec3& q = m_mesh.points[u];
      return Kernel::Point_3(q[0], q[1], q[2]);
    };
    Short_vector<Kernel::Triangle_3> faces;
    for(Vertex_index u : neighbors_on_boundary(v)) {
      if(m_places[u].empty())
        continue;
      faces.clear();
      const auto add = [&](const Triangle& t) { faces.emplace_back(point(t[0]), point(t[1]), point(t[2])); };
      const auto has = [](const Triangle& t, Vertex_index a) {
        return std::find(t.begin(), t.end(), a) != t.end();
      };
      m_boundary.for_each_at(u, [&](const Triangle& t) {
        if(!has(t, v))
          add(t);
      });
      m_boundary.for_each_at(v, [&](Triangle t) {
        if(has(t, w) || !(u == w || has(t, u)))
          return;
        std::replace(t.begin(), t.end(), v, w);
        add(t);
      });
      const bool are_near = std::all_of(m_places[u].begin(), m_places[u].end(), [&](const Vec3& place) {
        return std::any_of(faces.begin(), faces.end(), [&](const Kernel::Triangle_3& t) {
          return CGAL::squared_distance(Kernel::Point_3(place[0], place[1], place[2]), t)
                 <= m_distance * m_distance;
        });
      });
      if(!are_near)
        return false;
    }
    return true;
  }

  // \pre `is_possible(v, w)`
  void collapse(Vertex_index v, Vertex_index w)
  {
    const Short_vector<Vertex_index> around = neighbors(v);
    const bool is_on_boundary = m_mesh.is_on_boundary(v);
    m_mesh.collapse(v, w);
    if(is_on_boundary) {
      m_boundary.collapse(v, w);
      m_curves.collapse(v, w);
      m_quadrics[w] += m_quadrics[v];
      m_places[w].push_back(m_targets[v]);
      m_places[w].insert(m_places[w].end(), m_places[v].begin(), m_places[v].end());
      m_places[v] = {};
    }
    ++m_removed;
    for(Vertex_index u : around)
      m_changed[u] = m_removed;
    for(Vertex_index u : around)
      push(u);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_MESH_SIMPLIFIER_H
