// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// VTK unstructured grids in XML.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_VTU_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_VTU_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Data_columns.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/VTK_XML_reader.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/VTU_names.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/element_names.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

class VTU_reader : VTK_XML_reader
{
  // ---- cells --------------------------------------------------------------------------------

  // How VTK numbers a cell: `order` as `Element_names::vtk_order`.
  struct Cell_type
  {
    Element_kind kind;
    const std::uint8_t* order;
  };

  // Nothing for cells that are on the boundary or on edges.
  std::optional<Cell_type> cell_type(std::int64_t type, std::size_t cell) const
  {
    static constexpr std::uint8_t voxel_order[8] = {0, 1, 3, 2, 4, 5, 7, 6};
    // Types of vtkCellType.h: 0 to 9, VTK_QUAD, are empty cells, points, lines and faces; 11 is VTK_VOXEL.
    constexpr int voxel = 11, last_of_low_dimension = 9;
    for(Element_kind kind : element_kinds)
      if(element_names[kind].vtk_type == type)
        return Cell_type{kind, element_names[kind].vtk_order};
    if(type == voxel)
      return Cell_type{HEXAHEDRON, voxel_order};
    if(type < 0 || type > last_of_low_dimension) {
      const bool is_of_higher_order = (type >= 21 && type <= 37) || (type >= 60 && type <= 81);
      refuse("cell " + std::to_string(cell) + (is_of_higher_order ? " is of higher order" : " cannot be read")
             + " (VTK's type " + std::to_string(type)
             + "); expected linear hexahedra, wedges, pyramids and tetrahedra");
    }
    return std::nullopt;
  }

  // The labels of the cells of a piece; an array that the file does not have is empty.
  struct Labels
  {
    std::vector<double> in_region, subdomain, compartment;
  };

  Labels labels(const Piece& piece, std::uint64_t number_of_cells)
  {
    const auto cell_data = [&](const char* name) {
      return piece.array("CellData", name) != nullptr
               ? values<double>(piece, "CellData", name, number_of_cells)
               : std::vector<double>();
    };
    return {cell_data("in_region"), cell_data("subdomain"), cell_data("compartment")};
  }

  // An integer label of a cell, in a range from `least`.
  template <class Label>
  Label label(const std::vector<double>& data, std::size_t cell, const char* name, Label least) const
  {
    const double x = data[cell];
    if(!(x >= double(least) && x <= double((std::numeric_limits<Label>::max)()) && x == std::floor(x)))
      refuse("cell " + std::to_string(cell) + " has a \"" + name + "\" that is not "
             + (least == 0 ? "an integer of at least 0" : "a positive integer"));
    return Label(x);
  }

  Element_attributes attributes(const Labels& labels, std::size_t cell) const
  {
    Element_attributes result;
    result.is_in_region = !labels.in_region.empty() && labels.in_region[cell] != 0;
    if(!labels.subdomain.empty())
      result.subdomain_index = label<Subdomain_index>(labels.subdomain, cell, "subdomain", 1);
    if(!labels.compartment.empty())
      result.compartment = label<Compartment_index>(labels.compartment, cell, "compartment", 0);
    return result;
  }

  // ---- data of the user ---------------------------------------------------------------------

  // The values of one array, from all pieces.
  struct Column
  {
    std::string_view name_in_file;
    std::string name;
    std::uint64_t number_of_components;
    std::vector<double> values;
  };
  std::vector<Column> m_vertex_columns, m_element_columns;

  // The array of a piece for a column; null if there is none, or one of another number of components.
  const Array* array_of(const Column& column, const Piece& piece, std::string_view section) const
  {
    const Array* const array = piece.array(section, column.name_in_file);
    return array != nullptr && has_numbers(*array)
               && number_of_components(*array) == column.number_of_components
             ? array
             : nullptr;
  }

  // The arrays of the user that all pieces have, as columns without values.
  std::vector<Column> columns(std::string_view section, bool is_vertex_data) const
  {
    constexpr std::uint64_t most_components = (std::numeric_limits<int>::max)();
    std::vector<Column> result;
    if(pieces().empty())
      return result;
    for(const Array& array : pieces().front().arrays) {
      const std::string name = unescaped_from_XML(array.name);
      if(array.section != section || name.empty() || is_own_VTU_name(name, is_vertex_data)
         || !has_numbers(array))
        continue;
      Column column{array.name, name, number_of_components(array), {}};
      const auto is_same = [&](const Column& other) { return other.name == column.name; };
      const auto has_column = [&](const Piece& piece) { return array_of(column, piece, section) != nullptr; };
      if(column.number_of_components > 0 && column.number_of_components <= most_components
         && std::none_of(result.begin(), result.end(), is_same)
         && std::all_of(pieces().begin(), pieces().end(), has_column))
        result.push_back(std::move(column));
    }
    return result;
  }

  // Reads the rows of a piece that are chosen.
  template <class Is_chosen>
  void read_rows(std::vector<Column>& columns, const Piece& piece, std::string_view section,
                 std::uint64_t number, const Is_chosen& is_chosen)
  {
    if(number == 0)
      return;
    for(Column& column : columns) {
      const std::size_t n = std::size_t(column.number_of_components);
      const std::vector<double> all = values<double>(*array_of(column, piece, section), number * n);
      for(std::size_t row = 0; row < number; ++row)
        if(is_chosen(row))
          column.values.insert(column.values.end(), all.begin() + std::ptrdiff_t(row * n),
                               all.begin() + std::ptrdiff_t((row + 1) * n));
    }
  }

  static Data_columns data(std::vector<Column>& columns)
  {
    Data_columns result;
    for(Column& column : columns)
      result.add(std::move(column.name), std::move(column.values), int(column.number_of_components));
    return result;
  }

  // ---- the file -----------------------------------------------------------------------------

  void read_piece(const Piece& piece, Mesh_input& mesh)
  {
    const std::uint64_t n = number(piece.tag, "NumberOfPoints"), m = number(piece.tag, "NumberOfCells"),
                        first = mesh.points.size(); // points of the pieces before
    if(n > largest_mesh_size - first || m > largest_mesh_size - mesh.elements.size())
      refuse("has more than 2^32 points or cells");
    const std::vector<double> coordinates = values<double>(piece, "Points", "Points", 3 * n);
    const std::vector<std::int64_t> offsets = values<std::int64_t>(piece, "Cells", "offsets", m),
                                    types = values<std::int64_t>(piece, "Cells", "types", m);
    const std::int64_t size = offsets.empty() ? 0 : offsets.back();
    if(size < 0)
      refuse("its array \"offsets\" is not increasing");
    const std::vector<std::int64_t> connectivity = values<std::int64_t>(piece, "Cells", "connectivity",
                                                                        std::uint64_t(size));
    const Labels labels_of_cells = labels(piece, m);

    for(std::size_t v = 0; v < n; ++v)
      mesh.points.push_back({coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]});
    std::vector<bool> is_element(std::size_t(m), false);
    std::int64_t begin = 0;
    for(std::size_t e = 0; e < m; ++e) {
      const std::int64_t end = offsets[e];
      if(end < begin || end > size)
        refuse("its array \"offsets\" is not increasing");
      for(std::int64_t i = begin; i < end; ++i) {
        const std::int64_t v = connectivity[std::size_t(i)];
        if(v < 0 || std::uint64_t(v) >= n)
          refuse("cell " + std::to_string(e) + " has the point " + std::to_string(v)
                 + ", which does not exist");
      }
      if(const std::optional<Cell_type> type = cell_type(types[e], e)) {
        const std::int64_t expected = reference_elements[type->kind].number_of_vertices;
        if(end - begin != expected)
          refuse("cell " + std::to_string(e) + " has " + std::to_string(end - begin) + " points; expected "
                 + std::to_string(expected));
        std::array<Vertex_index, 8> vertices{};
        for(std::int64_t i = 0; i < expected; ++i)
          vertices[type->order[i]] = Vertex_index(first
                                                  + std::uint64_t(connectivity[std::size_t(begin + i)]));
        mesh.elements.add(type->kind, vertices.data());
        mesh.attributes.push_back(attributes(labels_of_cells, e));
        is_element[e] = true;
      }
      begin = end;
    }
    read_rows(m_vertex_columns, piece, "PointData", n, [](std::size_t) { return true; });
    read_rows(m_element_columns, piece, "CellData", m, [&](std::size_t e) { return is_element[e]; });
  }

  void read_subdomain_names(Mesh_input& mesh)
  {
    const Array* const array = file().array("FieldData", "subdomain_names");
    if(array == nullptr)
      return;
    std::vector<std::string> names(1);
    // as numbers, or as strings of VTK: these count names, not bytes
    const std::uint64_t size = has_strings(*array) ? size_of_text(*array)
                                                   : number(array->tag, "NumberOfTuples");
    for(std::int64_t c : values<std::int64_t>(file(), "FieldData", "subdomain_names", size))
      if(c != 0)
        names.back() += char(c);
      else
        names.emplace_back();
    names.pop_back();
    const auto indices = values<std::int64_t>(file(), "FieldData", "subdomain_indices", names.size());
    for(std::size_t i = 0; i < names.size(); ++i) {
      if(indices[i] < 1 || indices[i] > (std::numeric_limits<Subdomain_index>::max)())
        refuse("its array \"subdomain_indices\" has a number that is no positive integer");
      mesh.subdomain_names.emplace(Subdomain_index(indices[i]), names[i]);
    }
  }

public:
  VTU_reader(const std::string& path, const std::string& bytes)
    : VTK_XML_reader(path, bytes, "UnstructuredGrid")
  {
  }

  Mesh_input read()
  {
    Mesh_input mesh;
    m_vertex_columns = columns("PointData", true);
    m_element_columns = columns("CellData", false);
    for(const Piece& piece : pieces())
      read_piece(piece, mesh);
    mesh.vertex_data = data(m_vertex_columns);
    mesh.element_data = data(m_element_columns);
    read_subdomain_names(mesh);
    return mesh;
  }
};

/// Reads what a `.vtu` file holds. Points and cells keep their order, cells of lower dimension are skipped.
inline Mesh_input read_VTU(const std::string& path, const std::string& bytes)
{
  return VTU_reader(path, bytes).read();
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_VTU_H
