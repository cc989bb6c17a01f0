// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of Gmsh, formats 2.2 and 4.1, as text and as binary.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MSH_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MSH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Text_input.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <map>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// The positions that bring tags into increasing order; equal ones stay as they are.
inline std::vector<std::size_t> sorting_order(const std::vector<std::int64_t>& tags)
{
  std::vector<std::size_t> order(tags.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&tags](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  return order;
}

class MSH_reader
{
  const std::string& m_path;
  Text_input m_in;
  std::string m_section; // with its $
  bool m_is_version_4 = false, m_is_binary = false, m_has_nodes = false, m_has_elements = false;
  std::map<std::int64_t, Element_attributes> m_parts;   // of physical groups of volumes with names of parts
  std::map<std::int32_t, Element_attributes> m_volumes; // version 4 only
  std::vector<std::int64_t> m_node_tags;                // increasing
  std::vector<std::int64_t> m_element_tags;
  Mesh_input m_mesh;

  [[noreturn]] void refuse(const std::string& defect) const { internal::refuse(m_path, defect); }

  // ---- words and numbers --------------------------------------------------------------------

  std::string_view word()
  {
    const std::string_view result = m_in.word();
    if(result.empty())
      refuse("is truncated in " + m_section);
    return result;
  }

  template <class Number>
  Number text()
  {
    const std::string_view found = word();
    Number number{};
    if(!parse_number(found, number))
      refuse("is damaged: " + in_quotes(found) + " where a number is expected in " + m_section);
    return number;
  }

  // A number as text or binary.
  template <class Number>
  Number get()
  {
    if(!m_is_binary)
      return text<Number>();
    Number number{};
    if(!m_in.binary(number))
      refuse("is truncated in " + m_section);
    return number;
  }

  std::int32_t get_int() { return get<std::int32_t>(); }

  // Sizes and tags of version 4 have 64 bits, those of version 2 have 32; none is negative.
  std::int64_t get_tag()
  {
    const std::int64_t tag = m_is_version_4 ? get<std::int64_t>() : get_int();
    if(tag < 0)
      refuse("is damaged: the number " + std::to_string(tag) + " in " + m_section);
    return tag;
  }

  // A number of things that take so many bytes at least, in text: a digit and a space for each number.
  std::size_t checked(std::int64_t count, std::size_t numbers) const
  {
    if(count < 0 || std::uint64_t(count) > m_in.rest().size() / (2 * numbers) + 1)
      refuse("is damaged or truncated: a count of " + std::to_string(count) + " in " + m_section);
    return std::size_t(count);
  }

  // Binary data begin after the end of a line, and may look like space.
  void end_line()
  {
    if(m_is_binary && !m_in.skip_end_of_line())
      refuse("is damaged or truncated in " + m_section);
  }

  void end_section()
  {
    const std::string_view found = word();
    if(found.substr(0, 4) != "$End" || found.substr(4) != std::string_view(m_section).substr(1))
      refuse("is damaged: " + in_quotes(found) + " where " + in_quotes(m_section) + " should end");
  }

  // ---- sections -----------------------------------------------------------------------------

  void read_format()
  {
    const double version = text<double>();
    m_is_version_4 = version == 4.1;
    if(!m_is_version_4 && !(version >= 2 && version < 3))
      refuse("has an unknown version of Gmsh's format; expected 2.2 or 4.1");
    m_is_binary = text<int>() != 0;
    if(text<int>() != 8)
      refuse("has numbers of a size other than 8 bytes");
    end_line();
    if(m_is_binary && get_int() != 1)
      refuse("is in the byte order of another machine; expected this one's, or text");
  }

  void read_physical_names() // always text
  {
    for(std::size_t n = checked(text<std::int64_t>(), 3); n != 0; --n) {
      const int dimension = text<int>();
      const std::int32_t tag = text<std::int32_t>();
      m_in.skip_space();
      const std::string_view rest = m_in.rest();
      const std::size_t end = rest.substr(0, 1) == "\"" ? rest.find('"', 1) : std::string_view::npos;
      if(end == std::string_view::npos)
        refuse("is damaged or truncated in " + m_section);
      const std::string_view name = rest.substr(1, end - 1);
      if(const auto part = Part::named(name); part && dimension == 3)
        m_parts.emplace(tag, part->attributes);
      else if(dimension == 3 && tag > 0)
        m_mesh.subdomain_names.emplace(tag, name);
      m_in.skip(end + 1);
    }
  }

  // The attributes of the elements of an entity in a physical group, 0 without one: the number of the group
  // is the subdomain, unless the name is that of a part. Tags are negative for what is against the
  // orientation of the group.
  Element_attributes attributes_of(std::int64_t group, std::int32_t entity) const
  {
    group = std::abs(group);
    if(const auto part = m_parts.find(group); part != m_parts.end())
      return part->second;
    Element_attributes attributes;
    if(group != 0 && group <= (std::numeric_limits<Subdomain_index>::max)())
      attributes.subdomain_index = Subdomain_index(group);
    attributes.is_in_region = entity == MSH_entity_tag({attributes.subdomain_index, true});
    return attributes;
  }

  void read_entities()
  {
    end_line();
    std::int64_t counts[4];
    for(std::int64_t& count : counts)
      count = get_tag();
    for(int dimension = 0; dimension < 4; ++dimension)
      for(std::size_t n = checked(counts[dimension], 5); n != 0; --n) {
        const std::int32_t tag = get_int();
        for(int i = 0; i < (dimension == 0 ? 3 : 6); ++i) // a point or a box
          get<double>();
        std::int64_t group = 0; // one with the name of a part, or the first
        for(std::size_t groups = checked(get_tag(), 1); groups != 0; --groups)
          if(const std::int64_t next = get_int(); group == 0 || m_parts.count(std::abs(next)) != 0)
            group = next;
        if(dimension == 3)
          m_volumes[tag] = attributes_of(group, tag);
        if(dimension != 0) // what bounds it
          for(std::size_t entities = checked(get_tag(), 1); entities != 0; --entities)
            get_int();
      }
  }

  void read_point()
  {
    m_mesh.points.emplace_back();
    for(double& x : m_mesh.points.back())
      x = get<double>();
  }

  void read_nodes()
  {
    if(m_has_nodes)
      refuse("has two sections " + m_section);
    m_has_nodes = true;
    if(!m_is_version_4) {
      const std::size_t n = checked(text<std::int64_t>(), 4);
      end_line();
      for(std::size_t v = 0; v < n; ++v) {
        m_node_tags.push_back(get_tag());
        read_point();
      }
    } else {
      end_line();
      std::int64_t blocks = get_tag();
      const std::size_t n = checked(get_tag(), 4);
      get_tag(); // the smallest and the largest tag
      get_tag();
      for(; blocks != 0; --blocks) {
        const std::int32_t dimension = get_int();
        get_int(); // the tag of the entity
        const bool is_parametric = get_int() != 0;
        const std::size_t size = checked(get_tag(), 4);
        if(dimension < 0 || dimension > 3)
          refuse("is damaged: an entity of dimension " + std::to_string(dimension) + " in " + m_section);
        for(std::size_t v = 0; v < size; ++v)
          m_node_tags.push_back(get_tag());
        for(std::size_t v = 0; v < size; ++v) {
          read_point();
          for(int i = 0; is_parametric && i < dimension; ++i)
            get<double>();
        }
      }
      if(n != m_node_tags.size())
        refuse("is damaged: it has " + std::to_string(m_node_tags.size()) + " nodes, and says that it has "
               + std::to_string(n));
    }
    if(m_node_tags.size() > largest_mesh_size)
      refuse("has more than 2^32 nodes");
    sort_nodes();
  }

  void sort_nodes()
  {
    if(!std::is_sorted(m_node_tags.begin(), m_node_tags.end())) {
      std::vector<std::int64_t> tags;
      std::vector<Mixed_meshes_3::Vec3> points;
      for(std::size_t i : sorting_order(m_node_tags)) {
        tags.push_back(m_node_tags[i]);
        points.push_back(m_mesh.points[i]);
      }
      m_node_tags = std::move(tags);
      m_mesh.points = std::move(points);
    }
    const auto same = std::adjacent_find(m_node_tags.begin(), m_node_tags.end());
    if(same != m_node_tags.end())
      refuse("is damaged: two nodes have the number " + std::to_string(*same));
  }

  Vertex_index get_vertex()
  {
    const std::int64_t tag = get_tag();
    // Most files number without gaps.
    if(!m_node_tags.empty() && tag >= m_node_tags.front()) {
      const std::uint64_t guess = std::uint64_t(tag - m_node_tags.front());
      if(guess < m_node_tags.size() && m_node_tags[std::size_t(guess)] == tag)
        return Vertex_index(guess);
      const auto place = std::lower_bound(m_node_tags.begin(), m_node_tags.end(), tag);
      if(place != m_node_tags.end() && *place == tag)
        return Vertex_index(place - m_node_tags.begin());
    }
    refuse("an element has the node " + std::to_string(tag) + ", which does not exist");
  }

  // The number of nodes of an element that can be read or skipped.
  int size_of_type(std::int32_t type) const
  {
    // Types 1 to 7 and 15 are in Gmsh's manual, section MSH file format; the others are MSH_POLYG_,
    // MSH_POLYH_ and MSH_MAX_NUM of its header GmshDefines.h.
    constexpr int sizes[] = {0, 2, 3, 4, 4, 8, 6, 5}; // line, triangle, quadrilateral, and our kinds
    constexpr int point = 15, polygon = 34, polyhedron = 35, last = 140;
    if(type >= 1 && type <= 7)
      return sizes[type];
    if(type == point)
      return 1;
    const bool is_of_higher_order = type > 7 && type <= last && type != polygon && type != polyhedron;
    refuse(std::string("has elements ") + (is_of_higher_order ? "of higher order" : "that cannot be read")
           + " (Gmsh's type " + std::to_string(type)
           + "); expected linear hexahedra, prisms, pyramids and tetrahedra");
  }

  void read_element_nodes(std::int64_t tag, std::int32_t type, const Element_attributes& attributes)
  {
    std::array<Vertex_index, 8> vertices{};
    const int size = size_of_type(type);
    for(int i = 0; i < size; ++i)
      vertices[std::size_t(i)] = get_vertex();
    for(Element_kind kind : element_kinds)
      if(element_names[kind].gmsh_type == type) {
        if(m_element_tags.size() == largest_mesh_size)
          refuse("has more than 2^32 elements");
        m_element_tags.push_back(tag);
        m_mesh.elements.add(kind, vertices.data());
        m_mesh.attributes.push_back(attributes);
      }
  }

  // As text, each element has its type; in a binary file, blocks have one.
  void read_elements_2()
  {
    std::size_t n = checked(text<std::int64_t>(), 4);
    end_line();
    while(n != 0) {
      std::int64_t number = m_is_binary ? 0 : get_tag();
      const std::int32_t type = get_int();
      const std::size_t size = m_is_binary ? checked(get_int(), 2) : 1, tags = checked(get_int(), 1);
      if(size == 0 || size > n)
        refuse("is damaged: a block of " + std::to_string(size) + " elements");
      for(std::size_t i = 0; i < size; ++i) {
        if(m_is_binary)
          number = get_tag();
        std::int32_t of_element[] = {0, 0}; // group and entity; the other tags are of partitions
        for(std::size_t t = 0; t < tags; ++t) {
          const std::int32_t tag = get_int();
          if(t < 2)
            of_element[t] = tag;
        }
        read_element_nodes(number, type, attributes_of(of_element[0], of_element[1]));
      }
      n -= size;
    }
  }

  void read_elements_4()
  {
    end_line();
    std::int64_t blocks = get_tag();
    const std::size_t n = checked(get_tag(), 2);
    std::size_t found = 0;
    get_tag(); // the smallest and the largest tag
    get_tag();
    for(; blocks != 0; --blocks) {
      const std::int32_t dimension = get_int(), entity = get_int(), type = get_int();
      const std::size_t size = checked(get_tag(), 2);
      const auto volume = m_volumes.find(entity);
      const Element_attributes attributes = dimension == 3 && volume != m_volumes.end()
                                              ? volume->second
                                              : Element_attributes();
      size_of_type(type); // is it known?
      for(std::size_t i = 0; i < size; ++i) {
        const std::int64_t tag = get_tag();
        read_element_nodes(tag, type, attributes);
      }
      found += size;
    }
    if(found != n)
      refuse("is damaged: it has " + std::to_string(found) + " elements, and says that it has "
             + std::to_string(n));
  }

  void read_elements()
  {
    if(!m_has_nodes || m_has_elements)
      refuse(m_has_nodes ? "has two sections " + m_section : "has elements before the nodes");
    m_has_elements = true;
    if(m_is_version_4)
      read_elements_4();
    else
      read_elements_2();
    if(std::is_sorted(m_element_tags.begin(), m_element_tags.end()))
      return;
    Mesh_input sorted;
    for(std::size_t e : sorting_order(m_element_tags)) {
      sorted.elements.add(m_mesh.elements[e].kind(), m_mesh.elements[e].begin());
      sorted.attributes.push_back(m_mesh.attributes[e]);
    }
    m_mesh.elements = std::move(sorted.elements);
    m_mesh.attributes = std::move(sorted.attributes);
  }

  void skip_section()
  {
    const std::string end = "$End" + m_section.substr(1);
    const std::size_t position = m_in.rest().find(end);
    if(position == std::string_view::npos)
      refuse("is truncated in " + in_quotes(m_section));
    m_in.skip(position);
  }

public:
  MSH_reader(const std::string& path, const std::string& bytes) : m_path(path), m_in(bytes) {}

  Mesh_input read()
  {
    m_section = std::string(m_in.word().substr(0, 40));
    if(m_section != "$MeshFormat")
      refuse("cannot be read: not a file of Gmsh of version 2.2 or 4.1");
    read_format();
    end_section();
    while(true) {
      const std::string_view name = m_in.word();
      if(name.empty())
        break;
      if(name[0] != '$' || name.size() > 40)
        refuse("is damaged: " + in_quotes(name) + " where a section is expected");
      m_section = std::string(name);
      if(m_section == "$PhysicalNames")
        read_physical_names();
      else if(m_section == "$Entities" && m_is_version_4)
        read_entities();
      else if(m_section == "$Nodes")
        read_nodes();
      else if(m_section == "$Elements")
        read_elements();
      else if(m_section == "$ParametricNodes") // of version 2
        refuse("has $ParametricNodes; expected $Nodes");
      else
        skip_section();
      end_section();
    }
    if(!m_has_nodes || !m_has_elements)
      refuse(std::string("is truncated: it has no ") + (m_has_nodes ? "$Elements" : "$Nodes"));
    return std::move(m_mesh);
  }
};

/// Reads what an `.msh` file holds. Vertices and elements are ordered by their tags, which need not be dense;
/// elements of lower dimension are skipped. A physical volume is a subdomain, with its number and name, or a
/// part with its name; where an entity is in several, a part counts, or the first one.
inline Mesh_input read_MSH(const std::string& path, const std::string& bytes)
{
  return MSH_reader(path, bytes).read();
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MSH_H
