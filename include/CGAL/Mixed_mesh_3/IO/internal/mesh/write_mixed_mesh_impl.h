// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_WRITE_MIXED_MESH_IMPL_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_WRITE_MIXED_MESH_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/facet_sets.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/mesh_formats.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

CGAL_MIXED_MESH_3_INLINE bool write(std::ostream& stream, const Core_mesh& mesh, Format format,
                                    const Write_options& options)
{
  return format_traits(format).write(stream, mesh, options);
}

// What is wrong with the order of the elements; empty if nothing is.
inline std::string order_defect(const Mesh_format& format, int order)
{
  if(order != 1 && order != 2)
    return "the order of elements is 1 or 2, not " + std::to_string(order);
  const auto has_order_2 = [](const Mesh_format& f) { return f.has_order_2; };
  return order == 2 && !format.has_order_2
           ? "elements of order 2 can be written to " + extensions_with(has_order_2, "and") + " only"
           : "";
}

// What is wrong with values to be written; empty if nothing is.
inline std::string data_defect(const Core_mesh& mesh, const Mesh_format& format, const Write_options& options)
{
  const auto is_of_nodes = [&](const Data_array& array) {
    return options.order == 2 && !options.tetrahedra && array.has_size(Mesh_nodes(mesh, 2).size());
  };
  const auto defect = [&](const Data_array& array, bool is_vertex_data, std::size_t size) -> std::string {
    if(!format.can_have(array, is_vertex_data)) {
      const auto has_all = [](const Mesh_format& f) { return f.data == Format_data::ALL; };
      const auto has_some = [](const Mesh_format& f) { return f.data == Format_data::VERTICES; };
      return "data \"" + array.name + "\" can be written to " + extensions_with(has_all, "and")
             + (is_vertex_data
                  ? ", and of one or three components to " + extensions_with(has_some, "and") + ", only"
                  : " only");
    }
    return array.has_size(size) || (is_vertex_data && is_of_nodes(array))
             ? ""
             : "data \"" + array.name + "\" does not have the size of the mesh";
  };
  std::string result;
  for(const Data_array& array : options.vertex_data)
    if(result.empty())
      result = defect(array, true, mesh.number_of_vertices());
  for(const Data_array& array : options.element_data)
    if(result.empty())
      result = defect(array, false, mesh.number_of_elements());
  return result;
}

// What is wrong with the mesh, or with what is to be written with it; empty if nothing is.
inline std::string defect_of_output(const Core_mesh& mesh, const Mesh_format& format,
                                    const Write_options& options)
{
  std::string defect = order_defect(format, options.order);
  if(defect.empty())
    defect = data_defect(mesh, format, options);
  if(defect.empty() && format.format == Format::VTU)
    defect = column_defect(mesh);
  for(std::size_t v = 0; v < mesh.number_of_vertices() && defect.empty(); ++v)
    for(double x : Mixed_meshes_3::to_vec3(mesh.points()[v]))
      if(!std::isfinite(x))
        return "the mesh's vertex " + std::to_string(v) + " has no finite position";
  if(defect.empty())
    defect = facet_set_defect(mesh, options.facet_sets, !format.has_overlapping_facet_sets);
  if(defect.empty())
    defect = subdomain_name_defect(options.subdomain_names, options.facet_sets);
  if(defect.empty() && format.format == Format::INP && !options.tetrahedra
     && !has_all_kinds(mesh, options.order, &Element_names::abaqus_type))
    return "Abaqus has no pyramids of order 2: split the mesh to tetrahedra, or write .feb, .msh or .vtu";
  return defect;
}

// Writes `split_to_tetrahedra(mesh)`, with data and faces.
inline bool write_as_tetrahedra(Output_files& files, const std::string& path, const Core_mesh& mesh,
                                const Write_options& options, std::string* error)
{
  std::vector<Element_index> origins;
  const Core_mesh tetrahedra = split_to_tetrahedra(mesh, &origins);
  Write_options new_options = options;
  new_options.tetrahedra = false;
  new_options.facet_sets = split_facet_sets(tetrahedra, origins, options.facet_sets);
  std::vector<std::vector<double>> values;
  values.reserve(options.element_data.size());
  for(Data_array& array : new_options.element_data) {
    std::vector<double> split_values;
    const std::size_t components = std::size_t(array.number_of_components);
    for(Element_index e : origins)
      for(std::size_t i = 0; i < components; ++i)
        split_values.push_back((*array.values)[e * components + i]);
    values.push_back(std::move(split_values));
    array.values = &values.back();
  }
  return write_core_mesh(files, path, tetrahedra, new_options, error);
}

CGAL_MIXED_MESH_3_INLINE bool write_core_mesh(Output_files& files, const std::string& path,
                                              const Core_mesh& mesh, const Write_options& options,
                                              std::string* error)
{
  const std::optional<Format> format = format_of(path);
  if(!format)
    return check_output_path(path, error);
  const Mesh_format& traits = format_traits(options.msh_2_2 && *format == Format::MSH_4_1 ? Format::MSH_2_2
                                                                                          : *format);
  const std::string defect = defect_of_output(mesh, traits, options);
  if(!defect.empty())
    return is_success(with_path(path, defect), error);
  if(options.tetrahedra)
    return write_as_tetrahedra(files, path, mesh, options, error);
  return files.write(
    path, [&](std::ostream& stream) { return traits.write(stream, mesh, options); }, error);
}

} // namespace internal

CGAL_MIXED_MESH_3_INLINE std::optional<Format> format_of(const std::string& path)
{
  const std::string extension = internal::extension_of(path);
  for(const internal::Mesh_format& f : internal::mesh_formats())
    if(f.write != nullptr && f.extension == extension)
      return f.format;
  return std::nullopt;
}

CGAL_MIXED_MESH_3_INLINE bool has_overlapping_facet_sets(Format format)
{
  return internal::format_traits(format).has_overlapping_facet_sets;
}

CGAL_MIXED_MESH_3_INLINE bool check_output_path(const std::string& path, std::string* error, int order)
{
  using namespace internal;
  if(const std::optional<Format> format = format_of(path))
    return is_success(with_path(path, order_defect(format_traits(*format), order)), error)
           && check_output_directory(path, error);
  const auto is_written = [](const Mesh_format& f) { return f.write != nullptr; };
  return is_success(path + ": unknown extension, known are " + extensions_with(is_written, "and"), error);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_WRITE_MIXED_MESH_IMPL_H
