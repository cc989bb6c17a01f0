// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_VTU_H
#define CGAL_MIXED_MESH_3_IO_VTU_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Compressed_blocks.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/VTU_names.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <CGAL/config.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// What `write_VTU()` writes besides the mesh.
struct VTU_options
{
  /// Values at the vertices.
  std::vector<Data_array> vertex_data;
  /// Values of the elements.
  std::vector<Data_array> element_data;
  /// Named faces of elements.
  std::vector<Facet_set> facet_sets = {};
  /// Names of subdomains; those without elements are not written.
  Subdomain_names subdomain_names = {};
  /// Of the elements, 1 or 2: see `Write_options::order`.
  int order = 1;
};

namespace internal {

// An array of the file: what its declaration says, and what writes its bytes.
struct VTU_array
{
  std::string name;
  const char* type;
  int number_of_components;
  std::uint64_t number_of_bytes;
  std::function<void(Buffered_output&)> write;
};

using VTU_arrays = std::vector<VTU_array>;

template <class Value>
constexpr const char* vtk_type_name()
{
  return std::is_floating_point<Value>::value ? "Float64"
         : sizeof(Value) == 1                 ? "UInt8"
         : sizeof(Value) == 4                 ? "Int32"
                                              : "Int64";
}

// An array of one value for each element.
template <class Value, class Mesh, class Function>
VTU_array element_array(std::string name, const Mesh& mesh, Function value)
{
  return {std::move(name), vtk_type_name<Value>(), 1, mesh.number_of_elements() * sizeof(Value),
          [&mesh, value](Buffered_output& out) {
            for_each_element_by_kind(mesh, [&](Element_index e) { out.write_binary(Value(value(e))); });
          }};
}

inline VTU_array vertex_data_array(const Data_array& data)
{
  const std::vector<double>* values = data.values;
  return {data.name, vtk_type_name<double>(), data.number_of_components, values->size() * sizeof(double),
          [=](Buffered_output& out) {
            out.write_bytes(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(double));
          }};
}

template <class Mesh>
VTU_array element_data_array(const Mesh& mesh, const Data_array& data)
{
  const std::size_t n = std::size_t(data.number_of_components);
  return {data.name, vtk_type_name<double>(), data.number_of_components, data.values->size() * sizeof(double),
          [&mesh, n, values = data.values](Buffered_output& out) {
            for_each_element_by_kind(mesh, [&](Element_index e) {
              out.write_bytes(reinterpret_cast<const char*>(values->data() + e * n), n * sizeof(double));
            });
          }};
}

// What is wrong with columns of the mesh; empty if nothing is.
inline std::string column_defect(const Data_columns& columns, bool is_vertex_data, std::size_t size)
{
  for(const Data_column& column : columns) {
    if(is_own_VTU_name(column.name(), is_vertex_data))
      return "data \"" + column.name() + "\" of the mesh have a name that VTK files have for something else";
    if(column.number_of_rows() != size)
      return "data \"" + column.name() + "\" do not have the size of the mesh";
  }
  return "";
}

template <class Mesh>
std::string column_defect(const Mesh& mesh)
{
  const std::string defect = column_defect(mesh.vertex_data(), true, mesh.number_of_vertices());
  return defect.empty() ? column_defect(mesh.element_data(), false, mesh.number_of_elements()) : defect;
}

// The columns of the mesh, but for those that have the name of an array given, and the arrays given.
inline std::vector<Data_array> with_columns(const Data_columns& columns, const std::vector<Data_array>& given)
{
  std::vector<Data_array> all;
  for(const Data_column& column : columns)
    if(std::none_of(given.begin(), given.end(),
                    [&](const Data_array& array) { return array.name == column.name(); }))
      all.push_back({column.name(), &column.values(), column.number_of_components()});
  all.insert(all.end(), given.begin(), given.end());
  return all;
}

// What is known of the elements of each mesh.
template <class Mesh>
VTU_arrays own_element_arrays(const Mesh& mesh)
{
  VTU_arrays arrays = {
    element_array<std::uint8_t>("kind", mesh, [&mesh](Element_index e) { return mesh.element(e).kind(); }),
    element_array<double>("ARC", mesh,
                          [&mesh](Element_index e) { return aspect_ratio_coefficient(mesh, e); }),
    element_array<std::uint8_t>("in_region", mesh, [&mesh](Element_index e) { return mesh.is_in_region(e); }),
    element_array<std::int32_t>("subdomain", mesh,
                                [&mesh](Element_index e) { return mesh.subdomain_index(e); })};
  if(std::any_of(mesh.attributes().begin(), mesh.attributes().end(),
                 [](const Element_attributes& a) { return a.compartment != 0; }))
    arrays.push_back(element_array<std::int32_t>("compartment", mesh, [&mesh](Element_index e) {
      return mesh.attributes(e).compartment;
    }));
  return arrays;
}

// For each set that is not empty, how many faces of each element are in it.
inline std::vector<std::vector<std::uint8_t>> numbers_of_facets_in(const std::vector<Facet_set>& sets,
                                                                   std::size_t number_of_elements)
{
  std::vector<std::vector<std::uint8_t>> numbers;
  for(const Facet_set& set : sets) {
    numbers.emplace_back(set.faces.empty() ? 0 : number_of_elements);
    for(const Face& face : set.faces)
      ++numbers.back()[face.element()];
  }
  return numbers;
}

// For each set that is not empty, which nodes its faces have.
template <class Mesh>
void add_node_set_arrays(VTU_arrays& arrays, const Mesh_nodes<Mesh>& nodes,
                         const std::vector<Facet_set>& sets)
{
  for(const Facet_set& set : sets)
    if(!set.faces.empty())
      arrays.push_back({std::string(VTU_prefix_of_nodes) + set.name, vtk_type_name<std::uint8_t>(), 1,
                        nodes.size(), [&nodes, &set](Buffered_output& out) {
                          std::vector<std::uint8_t> is_in_set(nodes.size(), 0);
                          for(Vertex_index node : nodes.of(set.faces))
                            is_in_set[node] = 1;
                          for(std::uint8_t is_in : is_in_set)
                            out.write_binary(is_in);
                        }});
}

template <class Mesh>
void add_facet_arrays(VTU_arrays& arrays, const Mesh& mesh, const std::vector<Facet_set>& sets,
                      const std::vector<std::vector<std::uint8_t>>& numbers_of_facets)
{
  for(std::size_t i = 0; i < sets.size(); ++i)
    if(!sets[i].faces.empty())
      arrays.push_back(element_array<std::uint8_t>(std::string(VTU_prefix_of_facets) + sets[i].name, mesh,
                                                   [&numbers = numbers_of_facets[i]](Element_index e) {
                                                     return numbers[e];
                                                   }));
}

// Names of those subdomains that have elements.
template <class Mesh>
Subdomain_names used_names(const Mesh& mesh, const Subdomain_names& subdomain_names)
{
  Subdomain_names names;
  for(const Element_attributes& a : mesh.attributes())
    if(const auto named = subdomain_names.find(a.subdomain_index);
       named != subdomain_names.end() && names.count(named->first) == 0)
      names.insert(*named);
  return names;
}

template <class Index, class Mesh>
VTU_arrays cell_arrays(const Mesh& mesh, const Mesh_nodes<Mesh>& nodes)
{
  return {{"connectivity", vtk_type_name<Index>(), 1, nodes.number_of_incidences() * sizeof(Index),
           [&](Buffered_output& out) {
             for_each_element_by_kind(mesh, [&](Element_index e) {
               const Element_view element = mesh.element(e);
               const Node_list list = nodes.of(e, &Element_names::vtk_edges);
               for(int i = 0; i < element.size(); ++i)
                 out.write_binary(Index(element[nodes.names(element.kind()).vtk_order[i]]));
               for(const Vertex_index* node = list.begin() + element.size(); node != list.end(); ++node)
                 out.write_binary(Index(*node));
             });
           }},
          {"offsets", vtk_type_name<Index>(), 1, mesh.number_of_elements() * sizeof(Index),
           [&](Buffered_output& out) {
             Index end = 0;
             for_each_element_by_kind(mesh, [&](Element_index e) {
               end += Index(nodes.number_of_nodes(e));
               out.write_binary(end);
             });
           }},
          element_array<std::uint8_t>("types", mesh, [&](Element_index e) {
            return nodes.names(mesh.element(e).kind()).vtk_type;
          })};
}

// Names as numbers of bytes, a 0 after each: strings of VTK would be what they are, but meshio refuses a file
// that has an array without numbers. As text, between what is binary, anyone can read them in the file.
inline void write_VTU_subdomain_names(Buffered_output& out, const Subdomain_names& names)
{
  std::size_t number_of_bytes = 0;
  for(const auto& [index, name] : names)
    number_of_bytes += name.size() + 1;
  out << "    <FieldData>\n      <DataArray type=\"Int32\" Name=\"subdomain_indices\" NumberOfTuples=\""
      << names.size() << "\" format=\"ascii\">\n       ";
  for(const auto& [index, name] : names)
    out << ' ' << index;
  out << "\n      </DataArray>\n      <DataArray type=\"UInt8\" Name=\"subdomain_names\" NumberOfTuples=\""
      << number_of_bytes << "\" format=\"ascii\">\n";
  for(const auto& [index, name] : names) {
    out << "       ";
    for(char c : name)
      out << ' ' << int(static_cast<unsigned char>(c));
    out << " 0\n";
  }
  out << "      </DataArray>\n    </FieldData>\n";
}

struct VTU_section
{
  const char* name;
  VTU_arrays arrays;
};

// The bytes of an array with their header. Nothing if they are to be written as they are: without zlib.
inline std::string compressed_bytes([[maybe_unused]] const VTU_array& array)
{
#ifdef CGAL_USE_ZLIB
  Compressed_blocks blocks;
  std::ostream stream(&blocks);
  Buffered_output out(stream);
  array.write(out);
  out.finish();
  return blocks.take();
#else
  return {};
#endif
}

// All of the file but the first lines.
inline void write_VTU_piece(Buffered_output& out, const std::vector<VTU_section>& sections, std::size_t n,
                            std::size_t m)
{
  std::vector<std::string> compressed;
  for(const VTU_section& section : sections)
    for(const VTU_array& array : section.arrays)
      compressed.push_back(compressed_bytes(array));
  auto bytes = compressed.begin();
  out << "    <Piece NumberOfPoints=\"" << n << "\" NumberOfCells=\"" << m << "\">\n";
  std::uint64_t offset = 0;
  for(const VTU_section& section : sections) {
    out << "      <" << section.name << ">\n";
    for(const VTU_array& array : section.arrays) {
      out << "        <DataArray type=\"" << array.type << "\" Name=\"" << escaped_for_XML(array.name)
          << "\" NumberOfComponents=\"" << array.number_of_components << "\" format=\"appended\" offset=\""
          << offset << "\"/>\n";
      offset += bytes->empty() ? sizeof(std::uint64_t) + array.number_of_bytes : bytes->size();
      ++bytes;
    }
    out << "      </" << section.name << ">\n";
  }
  out << "    </Piece>\n"
      << "  </UnstructuredGrid>\n"
      << "  <AppendedData encoding=\"raw\">\n_";
  bytes = compressed.begin();
  for(const VTU_section& section : sections)
    for(const VTU_array& array : section.arrays) {
      if(bytes->empty()) {
        out.write_binary(array.number_of_bytes);
        array.write(out);
      } else {
        out << *bytes;
      }
      ++bytes;
    }
  out << "\n  </AppendedData>\n</VTKFile>\n";
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3IO

\brief Writes a mesh as VTK unstructured grid: XML, version 1.0, with raw binary data appended, compressed by
zlib if `CGAL_USE_ZLIB` is defined and zlib is linked.

Elements are sorted by kind, within a kind in the order of the mesh: programs that read blocks of one kind
find four. Element data: `kind` (the number of the `Element_kind`), `ARC` (the aspect-ratio coefficient),
`in_region` (1 or 0), `subdomain` (the subdomain index), `compartment`
(if there are sheets, see `find_sheet_faces()`), the columns of `Mixed_mesh_3::element_data()`, what the
options add, and for each facet set
`facets_` with its name: the number of the element's faces in the set, since a file of elements has no faces
of their own; a threshold above 0 selects the elements. Point data: the columns of
`Mixed_mesh_3::vertex_data()`, at middle nodes the means of both ends; what the options add; and for each
facet set: `nodes_` with its name, 1 for the nodes of its faces and 0 for others. Field data, if subdomains
have names: `subdomain_indices`, and `subdomain_names` as bytes with a zero behind each name. Nothing of the
size of the mesh is allocated but for facet sets, for middle nodes, and for what is compressed.

VTK disagrees with itself on wedges. Written in the documented order, as here, their faces look
outwards and `vtkCellSizeFilter` finds a positive volume, but the Jacobian of the shape functions of
`vtkWedge` is negative (VTK 9.1).

Quadratic elements, of order 2, have the types 24 to 27, with 10, 13, 15 and 20 nodes: the only ones that each
version of VTK has for all four kinds. VTK documents the order of its quadratic wedge as that of the linear
one, and disagrees with itself in the same way. meshio mirrors linear wedges only: other programs get
quadratic prisms by `.msh` or `.inp`.

A value that the options give replaces the column of the mesh that has its name.

\return whether the stream took everything. If the size of an added array or of a column does not fit the
        mesh, or if a column has one of the names above, or begins with `facets_` at elements or `nodes_` at
        vertices, then nothing is written, and the stream's `failbit` is set.
*/
template <class Mesh>
bool write_VTU(std::ostream& stream, const Mesh& mesh, const VTU_options& options = VTU_options())
{
  using namespace internal;
  const std::size_t m = mesh.number_of_elements();

  VTU_arrays vertex_data, element_data = own_element_arrays(mesh);
  const Mesh_nodes<Mesh> nodes(mesh, options.order);
  const std::vector<Data_array> data_of_vertices = with_columns(mesh.vertex_data(), options.vertex_data),
                                data_of_elements = with_columns(mesh.element_data(), options.element_data);
  bool fits = column_defect(mesh).empty();
  for(const Data_array& data : data_of_vertices)
    fits = fits && (data.has_size(mesh.number_of_vertices()) || data.has_size(nodes.size()));
  for(const Data_array& data : data_of_elements)
    if((fits = fits && data.has_size(m)))
      element_data.push_back(element_data_array(mesh, data));
  if(!fits) {
    stream.setstate(std::ios_base::failbit);
    return false;
  }
  const Node_data node_data(nodes, data_of_vertices);
  for(const Data_array& data : node_data.arrays())
    vertex_data.push_back(vertex_data_array(data));
  add_node_set_arrays(vertex_data, nodes, options.facet_sets);
  const std::vector<std::vector<std::uint8_t>> numbers_of_facets = numbers_of_facets_in(options.facet_sets,
                                                                                        m);
  add_facet_arrays(element_data, mesh, options.facet_sets, numbers_of_facets);

  // The name "Points" is the one VTK gives.
  const std::size_t n = nodes.size();
  const VTU_array points = {"Points", vtk_type_name<double>(), 3, n * 3 * sizeof(double),
                            [&nodes](Buffered_output& out) {
                              for(std::size_t node = 0; node < nodes.size(); ++node)
                                out.write_binary(nodes.point(node));
                            }};

  // Both are VTK's own types of indices; the small one halves the file.
  const bool is_small = (std::max)(n, nodes.number_of_incidences())
                        <= std::size_t((std::numeric_limits<std::int32_t>::max)());

  const std::vector<VTU_section> sections = {{"PointData", std::move(vertex_data)},
                                             {"CellData", std::move(element_data)},
                                             {"Points", {points}},
                                             {"Cells", is_small ? cell_arrays<std::int32_t>(mesh, nodes)
                                                                : cell_arrays<std::int64_t>(mesh, nodes)}};

#ifdef CGAL_BIG_ENDIAN
  const char* const byte_order = "BigEndian";
#else
  const char* const byte_order = "LittleEndian";
#endif

  const Subdomain_names names = used_names(mesh, options.subdomain_names);
  Buffered_output out(stream);
  out << "<?xml version=\"1.0\"?>\n"
      << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" << byte_order
      << "\" header_type=\"UInt64\""
#ifdef CGAL_USE_ZLIB
      << " compressor=\"vtkZLibDataCompressor\""
#endif
      << ">\n  <UnstructuredGrid>\n";
  if(!names.empty())
    write_VTU_subdomain_names(out, names);
  write_VTU_piece(out, sections, n, m);
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_VTU_H
