// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Blocks that formats write: elements of one kind with the same attributes.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_ELEMENT_BLOCKS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_ELEMENT_BLOCKS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/element_names.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Elements with the same attributes, as a named set: "region" and "rest" of subdomain 1,
/// "subdomain_2_region" and "subdomain_2_rest" of the next one, and so on.
struct Part
{
  Element_attributes attributes;

  std::string name() const
  {
    const Subdomain_index s = attributes.subdomain_index;
    return (s == 1 ? "" : "subdomain_" + std::to_string(s) + "_")
           + (attributes.is_in_region ? "region" : "rest");
  }

  /// Returns the part with a name: the inverse of `name()`.
  static std::optional<Part> named(std::string_view name)
  {
    Part part;
    constexpr std::string_view prefix = "subdomain_";
    if(name.substr(0, prefix.size()) == prefix) {
      const char* const end = name.data() + name.size();
      const auto [rest, error] = std::from_chars(name.data() + prefix.size(), end,
                                                 part.attributes.subdomain_index);
      if(error != std::errc() || rest == end || *rest != '_' || part.attributes.subdomain_index < 1)
        return std::nullopt;
      name.remove_prefix(std::size_t(rest + 1 - name.data()));
    }
    if(name != "region" && name != "rest")
      return std::nullopt;
    part.attributes.is_in_region = name == "region";
    return part;
  }

  bool operator<(const Part& p) const { return key() < p.key(); }
  bool operator==(const Part& p) const { return key() == p.key(); }

private:
  std::tuple<Subdomain_index, bool> key() const
  {
    return {attributes.subdomain_index, !attributes.is_in_region};
  }
};

/// The number of the boundary. In formats with numbers for parts, 1 and 2 are region and rest of subdomain 1,
/// and further parts follow as they occur, from 4; in Gmsh's, where numbers are those of subdomains, the
/// boundary has a later number if one has this.
constexpr int boundary_tag = 3;

/// The number of the elementary entity of a part in Gmsh's formats: that of the subdomain for the rest, and
/// for the region one that labels and other programs hardly use.
inline int MSH_entity_tag(const Element_attributes& a)
{
  // Tags are integers of 32 bits with a sign: twice 10^9 is less than 2^31 = 2,147,483,648, and differences
  // from subdomains beyond 10^9 are positive.
  constexpr int of_region = 1000000000;
  return !a.is_in_region                  ? a.subdomain_index
         : a.subdomain_index <= of_region ? of_region + a.subdomain_index
                                          : a.subdomain_index - of_region;
}

/// Elements of one kind in one part.
struct Element_block
{
  std::size_t part; ///< index in `Element_blocks::parts()`
  Element_kind kind;
  std::vector<Element_index>::const_iterator first, last;

  auto begin() const { return first; }
  auto end() const { return last; }
  std::size_t size() const { return std::size_t(last - first); }
};

/// All elements of a mesh in blocks: by part, then by kind, then in the order of the mesh.
/// \par Complexity
/// O(n log n), four bytes for each element
class Element_blocks
{
  std::vector<Part> m_parts;
  std::vector<Element_index> m_order;
  std::vector<Element_block> m_blocks;

public:
  template <class Mesh>
  explicit Element_blocks(const Mesh& mesh)
  {
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
      m_order.push_back(e);
      const Part part{mesh.attributes(e)};
      const auto place = std::lower_bound(m_parts.begin(), m_parts.end(), part);
      if(place == m_parts.end() || !(*place == part))
        m_parts.insert(place, part);
    }
    const auto key = [&mesh](Element_index e) {
      return std::make_tuple(Part{mesh.attributes(e)}, mesh.elements().kinds()[e]);
    };
    std::stable_sort(m_order.begin(), m_order.end(),
                     [&](Element_index e, Element_index f) { return key(e) < key(f); });
    for(auto first = m_order.cbegin(), last = first; first != m_order.cend(); first = last) {
      last = std::find_if(first, m_order.cend(), [&](Element_index e) { return key(*first) < key(e); });
      const Part part{mesh.attributes(*first)};
      m_blocks.push_back(
        {std::size_t(std::lower_bound(m_parts.begin(), m_parts.end(), part) - m_parts.begin()),
         mesh.elements().kinds()[*first], first, last});
    }
  }

  Element_blocks(const Element_blocks&) = delete; // blocks refer to the order
  Element_blocks& operator=(const Element_blocks&) = delete;

  /// The parts that have elements, ascending.
  const std::vector<Part>& parts() const { return m_parts; }
  const std::vector<Element_block>& blocks() const { return m_blocks; }
  auto begin() const { return m_blocks.begin(); }
  auto end() const { return m_blocks.end(); }

  /// The subdomains that have elements, ascending.
  std::vector<Subdomain_index> subdomains() const
  {
    std::vector<Subdomain_index> result;
    for(const Part& part : m_parts)
      if(result.empty() || result.back() != part.attributes.subdomain_index)
        result.push_back(part.attributes.subdomain_index);
    return result;
  }

  /// The name and the parts of each named subdomain with elements.
  std::vector<std::pair<std::string, std::vector<std::size_t>>>
  named_parts(const Subdomain_names& names) const
  {
    std::vector<std::pair<std::string, std::vector<std::size_t>>> result;
    for(const auto& [index, name] : names) {
      std::vector<std::size_t> parts;
      for(std::size_t part = 0; part < m_parts.size(); ++part)
        if(m_parts[part].attributes.subdomain_index == index)
          parts.push_back(part);
      if(!parts.empty())
        result.emplace_back(name, parts);
    }
    return result;
  }

  int tag(std::size_t part) const
  {
    const Element_attributes& a = m_parts[part].attributes;
    if(a.subdomain_index == 1)
      return a.is_in_region ? 1 : 2;
    const std::ptrdiff_t parts_of_first = std::count_if(m_parts.begin(), m_parts.end(), [](const Part& p) {
      return p.attributes.subdomain_index == 1;
    });
    return boundary_tag + 1 + int(std::ptrdiff_t(part) - parts_of_first);
  }

  /// The first number that is neither a part's nor the boundary's: facet sets follow.
  int first_free_tag() const
  {
    int first = boundary_tag + 1;
    for(std::size_t part = 0; part < m_parts.size(); ++part)
      first = (std::max)(first, tag(part) + 1);
    return first;
  }
};

/// Calls `visit(e)` for all elements by kind, then in the order of the mesh: programs that read a block of
/// one kind at a time then read few blocks.
template <class Mesh, class Visitor>
void for_each_element_by_kind(const Mesh& mesh, const Visitor& visit)
{
  for(Element_kind kind : element_kinds)
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      if(mesh.elements().kinds()[e] == kind)
        visit(e);
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_ELEMENT_BLOCKS_H
