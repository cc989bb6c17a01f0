// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mixed mesh while vertices move and tetrahedra are flipped, with the elements around each vertex, and
// elements that can be removed.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_WORKING_MESH_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_WORKING_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Data_columns.h>
#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Incident_elements.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/moves/element_origins.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The power of a cost; the exponents are 4 and 8, mostly.
inline double power(double q, double exponent)
{
  const double q2 = q * q, q4 = q2 * q2;
  return exponent == 4 ? q4 : exponent == 8 ? q4 * q4 : std::pow(q, exponent);
}

class Transaction;

/// A mesh that is changed: by transactions, or by collapses that are not undone.
struct Working_mesh
{
  struct Element
  {
    Element_kind kind;
    bool is_removed; // beside the kind, where it takes no memory
    Element_attributes attributes;
    std::array<Vertex_index, 8> vertices;

    const Reference_element& reference() const { return reference_elements[kind]; }
    const Vertex_index* begin() const { return vertices.data(); }
    const Vertex_index* end() const { return vertices.data() + size(); }
    int size() const { return reference().number_of_vertices; }
    operator Element_view() const { return {kind, begin()}; }
    // Loops in place take less time than a call of `std::find()` for so few vertices.
    int position(Vertex_index v) const
    {
      const int n = size();
      int i = 0;
      while(i < n && vertices[std::size_t(i)] != v)
        ++i;
      return i;
    }
    bool has(Vertex_index v) const { return position(v) < size(); }
    /// The element with another vertex in the place of v.
    Element with_other_vertex(Vertex_index v, Vertex_index other) const
    {
      Element element = *this;
      element.is_removed = false;
      element.vertices[std::size_t(position(v))] = other;
      return element;
    }
  };

  std::vector<Vec3> points;
  std::vector<Element> elements;
  Incident_elements incident;                         ///< elements of each vertex, in any fixed order
  std::vector<Stratum> strata;                        ///< strata of the vertices
  using Edge = std::pair<Vertex_index, Vertex_index>; ///< smaller vertex first
  std::map<Edge, Stratum> sharp_edges;                ///< edges of the boundary along sharp edges
  std::vector<Edge> bisected;                         ///< edges of which the added vertices are the middles
  std::vector<Vertex_index> merged;                   ///< vertices that no element has any more
  Transaction* transaction = nullptr;                 ///< the innermost one that is open

  /// \param strata_of_vertices strata that the vertices have to be on
  /// \param more number of vertices that are to be added, for which there will be room. Room that is not used
  /// takes addresses, but no memory; arrays that outgrow their room are copied, and exist twice for a while
  template <class Mesh>
  Working_mesh(const Mesh& mesh, std::vector<Stratum> strata_of_vertices, std::size_t more = 0)
    : strata(std::move(strata_of_vertices))
  {
    constexpr std::size_t elements_of_vertex = 12; // twice the six tetrahedra that vertices of meshes add
    points.reserve(mesh.number_of_vertices() + more);
    for(const auto& p : mesh.points())
      points.push_back(to_vec3(p));
    std::vector<std::uint32_t> numbers(mesh.number_of_vertices(), 0);
    for(Vertex_index v : mesh.elements().connectivity())
      ++numbers[v];
    incident.make_room(numbers);
    elements.reserve(mesh.number_of_elements() + elements_of_vertex * more);
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
      const Element_view element = mesh.element(Element_index(e));
      Element mine{element.kind(), false, mesh.attributes(Element_index(e)), {}};
      std::copy(element.begin(), element.end(), mine.vertices.begin());
      add(mine);
    }
  }

  /// Whether a vertex is on the boundary, or on an interface.
  bool is_on_boundary(Vertex_index v) const { return strata[v] != free_stratum; }

  /// The faces of the boundary and of interfaces, for use after boundary elements have been removed: not in
  /// the order of the elements, and with numbers of elements that mean nothing here.
  Interface_faces interface_faces(Strata& all) const
  {
    const auto is_candidate = [this](Vertex_index v) { return is_on_boundary(v); };
    const auto may_have_face = [&](const Element& element) {
      return !element.is_removed && std::count_if(element.begin(), element.end(), is_candidate) >= 3;
    };
    return all.faces(element_list(may_have_face), attributes(may_have_face), points.size(), is_candidate);
  }

  bool is_sharp(Vertex_index a, Vertex_index b) const { return sharp_stratum(a, b) != free_stratum; }

  /// The stratum of a sharp edge; `free_stratum` of other edges.
  Stratum sharp_stratum(Vertex_index a, Vertex_index b) const
  {
    const auto found = sharp_edges.find(std::minmax(a, b));
    return found == sharp_edges.end() ? free_stratum : found->second;
  }

  /// Whether two vertices are on the same polyline of sharp edges: an edge between them would lead past the
  /// vertices between them.
  bool are_on_one_sharp_line(Vertex_index a, Vertex_index b) const
  {
    return strata[a] == strata[b] && strata[a] >= first_sharp_stratum;
  }

  /// The other ends of the sharp edges of a vertex.
  std::vector<Vertex_index> sharp_neighbors(Vertex_index v) const
  {
    std::vector<Vertex_index> ends;
    if(strata[v] < first_sharp_stratum)
      return ends;
    for(Element_index e : incident[v])
      for(Vertex_index u : elements[e])
        if(u != v && is_sharp(u, v) && std::find(ends.begin(), ends.end(), u) == ends.end())
          ends.push_back(u);
    return ends;
  }

  /// Whether sharp edges stay as they are, but for a vertex, if a vertex of the boundary goes into another
  /// one: a corner stays, and a vertex between two edges of a polyline goes along these, unless they would
  /// close it. A vertex whose polyline does not go through it is like others.
  bool keeps_sharp_edges(Vertex_index v, Vertex_index into) const
  {
    const std::vector<Vertex_index> ends = sharp_neighbors(v);
    if(ends.empty())
      return true;
    return ends.size() == 2 && sharp_stratum(v, ends[0]) == strata[v]
           && sharp_stratum(v, ends[1]) == strata[v]
           && std::find(ends.begin(), ends.end(), into) != ends.end() && !is_sharp(ends[0], ends[1]);
  }

  /// The other vertices of the elements of a vertex, ascending.
  std::vector<Vertex_index> neighbors(Vertex_index v) const
  {
    std::vector<Vertex_index> all;
    for(Element_index e : incident[v])
      for(Vertex_index u : elements[e])
        if(u != v)
          all.push_back(u);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// The elements that have both vertices.
  std::vector<Element_index> elements_at_edge(Vertex_index a, Vertex_index b) const
  {
    std::vector<Element_index> around;
    std::copy_if(incident[a].begin(), incident[a].end(), std::back_inserter(around),
                 [&](Element_index e) { return elements[e].has(b); });
    return around;
  }

  /// Whether an element has these vertices, each different from the others.
  template <class... Vertices>
  bool has_element_with(Vertex_index a, Vertices... others) const
  {
    return std::any_of(incident[a].begin(), incident[a].end(),
                       [&](Element_index e) { return (elements[e].has(others) && ...); });
  }

  /// Whether an element with that edge is in the region of interest.
  bool is_edge_in_region(Vertex_index a, Vertex_index b) const
  {
    return std::any_of(incident[a].begin(), incident[a].end(), [&](Element_index e) {
      return elements[e].attributes.is_in_region && elements[e].has(b);
    });
  }

  /// Function object that returns the position of a vertex.
  auto position() const
  {
    return [this](Vertex_index v) -> const Vec3& { return points[v]; };
  }

  /// Positions relative to the first vertex.
  Element_points relative_points(const Element_view& element) const
  {
    return internal::relative_points(element, position());
  }

  /// Whether the Jacobian is proved to be positive on the whole element.
  bool is_positive(const Element_view& element) const
  {
    return jacobian_sign(element, position()) == Jacobian_sign::POSITIVE;
  }

  /// Lets another vertex take the place of a vertex in all of its elements, and along its sharp edges;
  /// elements of both are removed. This is not undone: the caller has proved the new elements valid.
  /// \pre no transaction is open, and `keeps_sharp_edges(v, into)`
  void collapse(Vertex_index v, Vertex_index into)
  {
    CGAL_precondition(transaction == nullptr);
    for(Vertex_index u : sharp_neighbors(v)) {
      const Stratum stratum = sharp_stratum(u, v);
      sharp_edges.erase(std::minmax(u, v));
      if(u != into)
        sharp_edges.emplace(std::minmax(u, into), stratum);
    }
    strata[v] = free_stratum;
    while(!incident[v].empty()) {
      const Element_index e = incident[v].back();
      Element& element = elements[e];
      if(element.has(into)) {
        remove(e);
        continue;
      }
      element.vertices[std::size_t(element.position(v))] = into;
      incident.pop_back(v);
      incident.push_back(into, e);
    }
    merged.push_back(v);
  }

  /// Takes over the sharp edges of the mesh that this one was made of.
  void set_sharp_strata(const Sharp_strata& sharp)
  {
    for(Vertex_index v = 0; v < sharp.of_vertices.size(); ++v)
      if(sharp.of_vertices[v] != free_stratum)
        strata[v] = sharp.of_vertices[v];
    sharp_edges = sharp.edges;
  }

  /// The sharp edges, by the numbers that vertices have in the changed mesh.
  Sharp_strata sharp_strata() const
  {
    const std::vector<Vertex_index> numbers = numbers_without_merged();
    Sharp_strata sharp;
    for(Vertex_index v = 0; v < points.size(); ++v)
      if(numbers[v] != no_vertex)
        sharp.of_vertices.push_back(strata[v] >= first_sharp_stratum ? strata[v] : free_stratum);
    for(const auto& [edge, stratum] : sharp_edges)
      sharp.edges.emplace(Edge(numbers[edge.first], numbers[edge.second]), stratum);
    return sharp;
  }

  /// Writes changes back to the mesh that this one was made of.
  template <class Mesh>
  void store(Mesh& mesh) const
  {
    if(has_elements_of_start())
      mesh.points() = changed_points(mesh);
    else
      mesh = with_changed_elements(mesh);
  }

  /// The changed mesh.
  /// \param start the mesh that this one was made of
  template <class Mesh>
  Mesh changed(const Mesh& start) const
  {
    if(!has_elements_of_start())
      return with_changed_elements(start);
    Mesh mesh;
    mesh.assign(changed_points(start), start.elements(), start.attributes(), start.vertex_data(),
                start.element_data());
    return mesh;
  }

private:
  static bool is_present(const Element& element) { return !element.is_removed; }

  // An empty list, with room for the elements chosen.
  template <class Is_chosen>
  Element_list list_with_room(const Is_chosen& is_chosen) const
  {
    std::size_t number = 0, number_of_vertices = 0;
    for(const Element& element : elements)
      if(is_chosen(element)) {
        ++number;
        number_of_vertices += std::size_t(element.size());
      }
    Element_list list;
    list.reserve(number, number_of_vertices);
    return list;
  }

  template <class Is_chosen>
  Element_list element_list(const Is_chosen& is_chosen) const
  {
    Element_list list = list_with_room(is_chosen);
    for(const Element& element : elements)
      if(is_chosen(element))
        list.add(element.kind, element.vertices.data());
    return list;
  }

  template <class Is_chosen>
  std::vector<Element_attributes> attributes(const Is_chosen& is_chosen) const
  {
    std::vector<Element_attributes> list;
    list.reserve(std::size_t(std::count_if(elements.begin(), elements.end(), is_chosen)));
    for(const Element& element : elements)
      if(is_chosen(element))
        list.push_back(element.attributes);
    return list;
  }

  friend class Transaction;

  // Changes, each with the one that undoes it.

  void add_vertex(const Vec3& p, Stratum stratum, const Edge& edge)
  {
    points.push_back(p);
    bisected.push_back(edge);
    incident.add_vertex();
    strata.push_back(stratum);
  }

  void remove_last_vertex()
  {
    points.pop_back();
    bisected.pop_back();
    incident.remove_last_vertex();
    strata.pop_back();
  }

  Element_index add(const Element& element)
  {
    CGAL_assertion(!element.is_removed && std::all_of(element.begin(), element.end(), [&](Vertex_index v) {
      return v < points.size() && std::count(element.begin(), element.end(), v) == 1;
    }));
    const Element_index e = Element_index(elements.size());
    elements.push_back(element);
    for(Vertex_index v : elements.back()) // `element` may have been in the list
      incident.push_back(v, e);
    return e;
  }

  void remove_last()
  {
    for(Vertex_index v : elements.back())
      incident.pop_back(v);
    elements.pop_back();
  }

  using Places = std::array<std::size_t, 8>; // of an element among those of its vertices

  Places remove(Element_index e)
  {
    CGAL_assertion(!elements[e].is_removed);
    elements[e].is_removed = true;
    Places places{};
    auto place = places.begin();
    for(Vertex_index v : elements[e])
      *place++ = incident.erase(v, e);
    return places;
  }

  void put_back(Element_index e, const Places& places)
  {
    elements[e].is_removed = false;
    auto place = places.begin();
    for(Vertex_index v : elements[e])
      incident.insert(v, *place++, e);
  }

  bool has_elements_of_start() const { return std::all_of(elements.begin(), elements.end(), is_present); }

  // Positions that have not changed keep their points.
  template <class Mesh>
  std::vector<typename Mesh::Point_3> changed_points(const Mesh& start) const
  {
    using Point_3 = typename Mesh::Point_3;
    std::vector<Point_3> changed;
    changed.reserve(points.size());
    for(std::size_t v = 0; v < points.size(); ++v)
      changed.push_back(v < start.number_of_vertices() && to_vec3(start.points()[v]) == points[v]
                          ? start.points()[v]
                          : Point_3(points[v][0], points[v][1], points[v][2]));
    return changed;
  }

  template <class Mesh>
  Mesh with_changed_elements(const Mesh& start) const
  {
    Mesh mesh;
    if(merged.empty())
      mesh.assign(changed_points(start), element_list(is_present), attributes(is_present));
    else
      assign_without_merged(changed_points(start), mesh);
    mesh.vertex_data() = vertex_data(start.vertex_data());
    mesh.element_data() = element_data(start);
    return mesh;
  }

  // Data of the vertices of the changed mesh: those of the start, and of the middles, one after the other, as
  // the ends of an edge may be middles themselves.
  Data_columns vertex_data(Data_columns data) const
  {
    if(data.empty())
      return data;
    for(const Edge& edge : bisected)
      data.add_row({{edge.first, 0.5}, {edge.second, 0.5}});
    const std::vector<Vertex_index> numbers = numbers_without_merged();
    std::vector<Vertex_index> left;
    for(Vertex_index v = 0; v < points.size(); ++v)
      if(numbers[v] != no_vertex)
        left.push_back(v);
    return data.selected(left);
  }

  // Data of the elements of the changed mesh. Elements of the start keep their numbers while the mesh is
  // changed.
  template <class Mesh>
  Data_columns element_data(const Mesh& start) const
  {
    if(start.element_data().empty())
      return {};
    std::vector<Vec3> old_points;
    old_points.reserve(points.size());
    for(const auto& p : start.points())
      old_points.push_back(to_vec3(p));
    for(const Edge& edge : bisected)
      old_points.push_back(0.5 * (old_points[edge.first] + old_points[edge.second]));
    return start.element_data().selected(element_origins(start, elements, old_points));
  }

  // The numbers of vertices once those are gone that were merged; these have none.
  std::vector<Vertex_index> numbers_without_merged() const
  {
    std::vector<Vertex_index> numbers(points.size(), 0);
    for(Vertex_index v : merged)
      numbers[v] = no_vertex;
    Vertex_index next = 0;
    for(Vertex_index& n : numbers)
      if(n != no_vertex)
        n = next++;
    return numbers;
  }

  template <class Point_3, class Mesh>
  void assign_without_merged(const std::vector<Point_3>& all_points, Mesh& mesh) const
  {
    const std::vector<Vertex_index> numbers = numbers_without_merged();
    std::vector<Point_3> new_points;
    for(std::size_t v = 0; v < points.size(); ++v)
      if(numbers[v] != no_vertex)
        new_points.push_back(all_points[v]);
    Element_list list = list_with_room(is_present);
    for(Element element : elements)
      if(!element.is_removed) {
        for(int i = 0; i < element.size(); ++i)
          element.vertices[std::size_t(i)] = numbers[element.vertices[std::size_t(i)]];
        list.add(element.kind, element.vertices.data());
      }
    mesh.assign(std::move(new_points), std::move(list), attributes(is_present));
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_WORKING_MESH_H
