// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_WRITE_MIXED_MESH_IMPL_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_WRITE_MIXED_MESH_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/FEB.h>
#include <CGAL/Mixed_mesh_3/IO/INP.h>
#include <CGAL/Mixed_mesh_3/IO/MEDIT.h>
#include <CGAL/Mixed_mesh_3/IO/MSH.h>
#include <CGAL/Mixed_mesh_3/IO/VTU.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/facet_sets.h>
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

using Core_mesh = Mixed_meshes_3::internal::Core_mesh;

/// Whether a file of the format can have values.
inline bool can_hold(Format format, bool is_vertex_data, const Data_array& data)
{
  if(format == Format::VTU)
    return true;
  const bool has_quotes = data.name.find('"') != std::string::npos; // Gmsh has names in quotes
  return is_vertex_data && !has_quotes && (data.number_of_components == 1 || data.number_of_components == 3)
         && (format == Format::MSH_4_1 || format == Format::MSH_2_2 || format == Format::FEB);
}

CGAL_MIXED_MESH_3_INLINE bool write(std::ostream& stream, const Core_mesh& mesh, Format format,
                                    const Write_options& options)
{
  const std::vector<Facet_set>& sets = options.facet_sets;
  const Subdomain_names& names = options.subdomain_names;
  switch(format) {
  case Format::VTU:
    return write_VTU(stream, mesh, {options.vertex_data, options.element_data, sets, names, options.order});
  case Format::MSH_4_1:
    return write_MSH(stream, mesh, MSH_version::V4_1, sets, options.vertex_data, names, options.order);
  case Format::MSH_2_2:
    return write_MSH(stream, mesh, MSH_version::V2_2, sets, options.vertex_data, {}, options.order);
  case Format::MEDIT: return write_MEDIT(stream, mesh, sets);
  case Format::INP: return write_INP(stream, mesh, sets, names, options.order);
  case Format::FEB: return write_FEB(stream, mesh, sets, options.vertex_data, names, options.order);
  }
  return false;
}

/// What is wrong with values to be written; empty if nothing is.
inline std::string data_defect(const Core_mesh& mesh, Format format, const Write_options& options)
{
  const std::size_t sizes[] = {mesh.number_of_vertices(), mesh.number_of_elements()};
  const std::vector<Data_array>* const data[] = {&options.vertex_data, &options.element_data};
  for(int i = 0; i < 2; ++i)
    for(const Data_array& array : *data[i]) {
      const bool is_vertex_data = i == 0;
      if(!can_hold(format, is_vertex_data, array))
        return "data \"" + array.name + "\" can be written to "
               + (is_vertex_data ? ".vtu, and of one or three components to .msh and .feb, only"
                                 : ".vtu only");
      if(!array.has_size(sizes[i]))
        return "data \"" + array.name + "\" does not have the size of the mesh";
    }
  return std::string();
}

CGAL_MIXED_MESH_3_INLINE bool write_core_mesh(Output_files& files, const std::string& path,
                                              const Core_mesh& mesh, const Write_options& options,
                                              std::string* error)
{
  const std::optional<Format> format = format_of(path);
  if(!format)
    return check_output_path(path, error);

  const auto refused = [&](const std::string& reason) { return is_success(with_path(path, reason), error); };
  const std::string defect_of_order = order_defect(*format, options.order);
  if(!defect_of_order.empty())
    return refused(defect_of_order);
  const std::string defect_of_data = data_defect(mesh, *format, options);
  if(!defect_of_data.empty())
    return refused(defect_of_data);
  for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v)
    for(double x : Mixed_meshes_3::to_vec3(mesh.points()[v]))
      if(!std::isfinite(x))
        return refused("the mesh's vertex " + std::to_string(v) + " has no finite position");

  const Format used = options.msh_2_2 && *format == Format::MSH_4_1 ? Format::MSH_2_2 : *format;
  const bool has_one_number = used == Format::MSH_2_2 || used == Format::MEDIT;
  const std::string defect = facet_set_defect(mesh, options.facet_sets, has_one_number);
  if(!defect.empty())
    return refused(defect);
  const std::string defect_of_names = subdomain_name_defect(options.subdomain_names, options.facet_sets);
  if(!defect_of_names.empty())
    return refused(defect_of_names);

  if(*format == Format::INP && !options.tetrahedra
     && !has_all_kinds(mesh, options.order, &Element_names::abaqus_type))
    return refused(
      "Abaqus has no pyramids of order 2: split the mesh to tetrahedra, or write .feb, .msh or .vtu");

  if(options.tetrahedra) {
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
  return files.write(
    path, [&](std::ostream& stream) { return write(stream, mesh, used, options); }, error);
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_WRITE_MIXED_MESH_IMPL_H
