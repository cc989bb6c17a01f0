// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elements around each vertex of a mesh that is changed, in one array.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_INCIDENT_ELEMENTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_INCIDENT_ELEMENTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Index.h>

#include <CGAL/assertions.h>

#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
A list of elements for each vertex, in a fixed order. Lists are in one array, each with some room to grow; a
list that outgrows its room moves, and leaves the room to another one. A million vertices take a half of what
a vector for each vertex takes, and no allocations.

A list is valid until elements are added to one.
*/
class Incident_elements
{
  struct Room
  {
    std::size_t first = 0;
    std::uint32_t size = 0, capacity = 0;
  };

  std::vector<Room> m_rooms; // of each vertex
  std::vector<Element_index> m_elements;
  std::map<std::uint32_t, std::vector<std::size_t>> m_free; // places of free rooms, by their capacity

  static constexpr std::uint32_t granularity = 4; // of the capacity: 1.5 places are left over on average
  static constexpr std::uint32_t rounded_up(std::uint32_t n)
  {
    return (n + granularity - 1) / granularity * granularity;
  }

public:
  using List = boost::iterator_range<const Element_index*>;

  /// The number of vertices.
  std::size_t size() const { return m_rooms.size(); }

  /// The elements of a vertex.
  List operator[](Vertex_index v) const
  {
    const Element_index* first = m_elements.data() + m_rooms[v].first;
    return {first, first + m_rooms[v].size};
  }

  /// Makes lists with room for elements that are to be added. \pre there are no lists
  /// \param numbers number of elements of each vertex
  void make_room(const std::vector<std::uint32_t>& numbers)
  {
    CGAL_precondition(m_rooms.empty());
    m_rooms.resize(numbers.size());
    std::size_t end = 0;
    for(std::size_t v = 0; v < numbers.size(); ++v) {
      m_rooms[v] = {end, 0, rounded_up(numbers[v])};
      end += m_rooms[v].capacity;
    }
    m_elements.resize(end);
  }

  void add_vertex() { m_rooms.emplace_back(); }
  void remove_last_vertex()
  {
    CGAL_precondition(m_rooms.back().size == 0);
    leave(m_rooms.back());
    m_rooms.pop_back();
  }

  void push_back(Vertex_index v, Element_index e) { insert(v, m_rooms[v].size, e); }
  void pop_back(Vertex_index v) { --m_rooms[v].size; }

  void insert(Vertex_index v, std::size_t place, Element_index e)
  {
    if(m_rooms[v].size == m_rooms[v].capacity)
      grow(m_rooms[v]);
    Room& room = m_rooms[v];
    Element_index* const first = m_elements.data() + room.first;
    std::copy_backward(first + place, first + room.size, first + room.size + 1);
    first[place] = e;
    ++room.size;
  }

  /// \return the place where the element was
  std::size_t erase(Vertex_index v, Element_index e)
  {
    Room& room = m_rooms[v];
    Element_index* const first = m_elements.data() + room.first;
    Element_index* const last = first + room.size;
    Element_index* const found = std::find(first, last, e);
    CGAL_assertion(found != last);
    std::copy(found + 1, last, found);
    --room.size;
    return std::size_t(found - first);
  }

  friend bool operator==(const Incident_elements& a, const Incident_elements& b)
  {
    if(a.size() != b.size())
      return false;
    for(std::size_t v = 0; v < a.size(); ++v)
      if(a[Vertex_index(v)] != b[Vertex_index(v)])
        return false;
    return true;
  }

private:
  void leave(const Room& room)
  {
    if(room.capacity > 0)
      m_free[room.capacity].push_back(room.first);
  }

  void grow(Room& room)
  {
    const Room old = room;
    room.capacity = rounded_up(old.capacity + old.capacity / 2 + 1);
    if(const auto free = m_free.find(room.capacity); free != m_free.end() && !free->second.empty()) {
      room.first = free->second.back();
      free->second.pop_back();
    } else {
      room.first = m_elements.size();
      m_elements.resize(m_elements.size() + room.capacity);
    }
    std::copy_n(m_elements.data() + old.first, old.size, m_elements.data() + room.first);
    leave(old);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_INCIDENT_ELEMENTS_H
