// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces that a vertex has to be on: the surface of the domain, or, between several subdomains, one or
// more.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_STRATA_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_STRATA_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The number of a set of interfaces: vertices on the same interfaces have the same number.
using Stratum = std::uint32_t;

/// The strata of vertices that may be anywhere, and of vertices on the boundary of a domain without labels.
inline constexpr Stratum free_stratum = 0, boundary_stratum = 1;

/// The first stratum on sharp edges: the numbers of polylines, then those of corners, follow from here on.
inline constexpr Stratum first_sharp_stratum = Stratum(1) << 31;

/// The sharp edges and corners that the boundary of a mesh follows: a mesh hands them on to the next stage.
struct Sharp_strata
{
  std::vector<Stratum> of_vertices;                               ///< `free_stratum`: on no sharp edge
  std::map<std::pair<Vertex_index, Vertex_index>, Stratum> edges; ///< smaller vertex first

  bool empty() const { return of_vertices.empty(); }
};

/// An interface between a subdomain and a later one, or the outside, 0; or all sheets.
struct Interface
{
  Subdomain_index first, second;

  bool is_sheet() const { return first == 0; }
};

/// The rank of sheets, which are neither inside nor outside.
inline constexpr Subdomain_rank sheet_rank = outside_rank - 1;

/// Faces on interfaces, seen from their first subdomains, and their strata.
struct Interface_faces
{
  std::vector<Face> faces;
  std::vector<Stratum> strata;
};

/*!
The strata of the boundary of a mesh, and, if its domain is labeled, of the interfaces between subdomains.

Where subdomains \f$ a_1, \dots, a_n \f$ meet, in the order of the domain and the outside last, the interface
of any two is on the surface of the first of them: a vertex on the interfaces of \f$ a_i \f$ and \f$ a_{i+1}
\f$ for all i is on all of them.
*/
class Strata
{
  std::vector<Subdomain_index> m_order; // subdomains of a labeled domain, in order
  bool m_has_sheets;
  std::vector<std::vector<Interface>> m_interfaces = {{}, {{1, 0}}};
  std::map<std::vector<Subdomain_rank>, Stratum> m_numbers; // by the ranks of the subdomains that meet
  std::vector<std::vector<Subdomain_rank>> m_ranks = {{}, {0, outside_rank}}; // ranks of each stratum

public:
  explicit Strata(const Any_surface& domain) : m_has_sheets(domain.has_sheets())
  {
    if(domain.is_labeled())
      m_order = domain.subdomain_indices();
  }

  /// The interfaces that the vertices of a stratum have to be on.
  const std::vector<Interface>& interfaces(Stratum s) const { return m_interfaces[s]; }
  /// Whether a face is on the boundary of the domain.
  bool is_on_boundary(Stratum of_face) const
  {
    return !is_on_sheet(of_face) && m_interfaces[of_face].back().second == 0;
  }
  /// Whether a face is on a sheet.
  bool is_on_sheet(Stratum of_face) const { return m_interfaces[of_face].back().is_sheet(); }

  /// The faces on the boundary and on interfaces, among the faces all of whose vertices are candidates; not
  /// in the order of the elements.
  template <class Is_candidate>
  Interface_faces faces(const Element_list& elements, const std::vector<Element_attributes>& attributes,
                        std::size_t number_of_vertices, const Is_candidate& is_candidate)
  {
    Interface_faces result;
    for_each_face(elements, number_of_vertices, is_candidate, [&](const auto& group) {
      if(group.size() == 1) {
        result.faces.push_back(group[0]);
        result.strata.push_back(number({rank(attributes[group.element(0)]), outside_rank}));
      } else if(!m_order.empty()) {
        const Subdomain_rank r[2] = {rank(attributes[group.element(0)]), rank(attributes[group.element(1)])};
        if(r[0] != r[1]) {
          result.faces.push_back(group[r[0] < r[1] ? 0 : 1]);
          result.strata.push_back(number({(std::min)(r[0], r[1]), (std::max)(r[0], r[1])}));
        } else if(const Element_attributes& a = attributes[group.element(0)],
                  &b = attributes[group.element(1)];
                  m_has_sheets && are_beside_sheet(a, b)) {
          result.faces.push_back(group[a.compartment < b.compartment ? 0 : 1]);
          result.strata.push_back(number({sheet_rank}));
        }
      }
    });
    return result;
  }

  /// All faces on the boundary and on interfaces, in the order of the elements.
  template <class Mesh>
  Interface_faces sorted_faces(const Mesh& mesh)
  {
    const Interface_faces unsorted = faces(mesh.elements(), mesh.attributes(), mesh.number_of_vertices(),
                                           [](Vertex_index) { return true; });
    std::vector<std::size_t> order(unsorted.faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return unsorted.faces[i] < unsorted.faces[j]; });
    Interface_faces sorted;
    for(std::size_t i : order) {
      sorted.faces.push_back(unsorted.faces[i]);
      sorted.strata.push_back(unsorted.strata[i]);
    }
    return sorted;
  }

  /// The strata of vertices, from the strata of their faces.
  std::vector<Stratum> of_vertices(std::size_t number_of_vertices, const Interface_faces& faces)
  {
    std::vector<Stratum> result(number_of_vertices, free_stratum);
    for(std::size_t i = 0; i < faces.faces.size(); ++i)
      for(Vertex_index v : faces.faces[i].vertices())
        result[v] = result[v] == free_stratum ? faces.strata[i] : meet(result[v], faces.strata[i]);
    return result;
  }

  /// The stratum of the places where subdomains meet, as `Sharp_edges` lists them; an empty list stands for
  /// the only subdomain and the outside.
  Stratum of_subdomains(const std::vector<Subdomain_index>& subdomains)
  {
    if(subdomains.empty())
      return number({0, outside_rank});
    std::set<Subdomain_rank> ranks;
    for(Subdomain_index i : subdomains)
      ranks.insert(i == Sharp_edges::sheets ? sheet_rank : rank_of(m_order, i));
    return number({ranks.begin(), ranks.end()});
  }

  /// The stratum of the places that two strata have in common.
  Stratum meet(Stratum a, Stratum b)
  {
    if(a == b)
      return a;
    std::set<Subdomain_rank> ranks(m_ranks[a].begin(), m_ranks[a].end());
    ranks.insert(m_ranks[b].begin(), m_ranks[b].end());
    return number({ranks.begin(), ranks.end()});
  }

private:
  // The rank of a subdomain; a subdomain that the domain does not know has the rank of the last one.
  Subdomain_rank rank(const Element_attributes& attributes) const
  {
    if(m_order.empty())
      return 0;
    return (std::min)(rank_of(m_order, attributes.subdomain_index), Subdomain_rank(m_order.size() - 1));
  }

  // The number of the stratum of some ranks. \pre the ranks ascend
  Stratum number(const std::vector<Subdomain_rank>& ranks)
  {
    if(m_order.empty())
      return boundary_stratum;
    const auto [known, is_new] = m_numbers.try_emplace(ranks, Stratum(m_interfaces.size()));
    if(is_new) {
      std::vector<Subdomain_rank> of_subdomains = ranks;
      of_subdomains.erase(std::remove(of_subdomains.begin(), of_subdomains.end(), sheet_rank),
                          of_subdomains.end());
      m_interfaces.emplace_back();
      m_ranks.push_back(ranks);
      for(std::size_t i = 0; i + 1 < of_subdomains.size(); ++i)
        m_interfaces.back().push_back({m_order[of_subdomains[i]], of_subdomains[i + 1] == outside_rank
                                                                    ? 0
                                                                    : m_order[of_subdomains[i + 1]]});
      if(of_subdomains.size() != ranks.size())
        m_interfaces.back().push_back({0, 0});
    }
    return known->second;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_STRATA_H
