// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The formats of mesh files: a format is a row of a table.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_FORMATS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_FORMATS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/FEB.h>
#include <CGAL/Mixed_mesh_3/IO/INP.h>
#include <CGAL/Mixed_mesh_3/IO/MEDIT.h>
#include <CGAL/Mixed_mesh_3/IO/MSH.h>
#include <CGAL/Mixed_mesh_3/IO/VTU.h>
#include <CGAL/Mixed_mesh_3/IO/Write_options.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Text_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/read_MEDIT.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/read_MSH.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/read_NETGEN.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/read_TETGEN.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/read_VTU.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>

#include <algorithm>
#include <iterator>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

using Core_mesh = Mixed_meshes_3::internal::Core_mesh;

/// What can be written with a mesh.
enum class Format_data {
  NONE,
  VERTICES, ///< scalars and vectors at the vertices, with names without quotes
  ALL
};

/// A format of mesh files. A function that is null says that files are not written, or not read.
struct Mesh_format
{
  std::string_view extension;
  Format format; ///< of files that are written
  bool (*write)(std::ostream& stream, const Core_mesh& mesh, const Write_options& options);
  Mesh_input (*read)(const std::string& path);
  Format_data data;
  bool has_order_2;
  bool has_overlapping_facet_sets;

  bool can_have(const Data_array& array, bool is_vertex_data) const
  {
    return data == Format_data::ALL
           || (data == Format_data::VERTICES && is_vertex_data && array.name.find('"') == std::string::npos
               && (array.number_of_components == 1 || array.number_of_components == 3));
  }
};

template <MSH_version version>
bool write_MSH_format(std::ostream& stream, const Core_mesh& mesh, const Write_options& o)
{
  return write_MSH(stream, mesh, version, o.facet_sets, o.vertex_data, o.subdomain_names, o.order);
}

/// Reads a format of one file.
template <Mesh_input (*read)(const std::string& path, const std::string& bytes)>
Mesh_input read_one_file(const std::string& path)
{
  return read(path, read_bytes(path));
}

/// The formats: to add one that is written, add also a name in `Format`.
inline const std::vector<Mesh_format>& mesh_formats()
{
  constexpr auto write_VTU_format = [](std::ostream& stream, const Core_mesh& mesh, const Write_options& o) {
    return write_VTU(stream, mesh, {o.vertex_data, o.element_data, o.facet_sets, o.subdomain_names, o.order});
  };
  constexpr auto write_MEDIT_format = [](std::ostream& stream, const Core_mesh& mesh,
                                         const Write_options& o) {
    return write_MEDIT(stream, mesh, o.facet_sets);
  };
  constexpr auto write_INP_format = [](std::ostream& stream, const Core_mesh& mesh, const Write_options& o) {
    return write_INP(stream, mesh, o.facet_sets, o.subdomain_names, o.order);
  };
  constexpr auto write_FEB_format = [](std::ostream& stream, const Core_mesh& mesh, const Write_options& o) {
    return write_FEB(stream, mesh, o.facet_sets, o.vertex_data, o.subdomain_names, o.order);
  };
  constexpr auto write_MSH_4_1 = write_MSH_format<MSH_version::V4_1>;
  constexpr auto write_MSH_2_2 = write_MSH_format<MSH_version::V2_2>;
  using Data = Format_data;
  static const std::vector<Mesh_format> formats{
    {".vtu", Format::VTU, write_VTU_format, read_one_file<read_VTU>, Data::ALL, true, true},
    {".msh", Format::MSH_4_1, write_MSH_4_1, read_one_file<read_MSH>, Data::VERTICES, true, true},
    {".msh2", Format::MSH_2_2, write_MSH_2_2, read_one_file<read_MSH>, Data::VERTICES, true, false},
    {".mesh", Format::MEDIT, write_MEDIT_format, read_one_file<read_MEDIT>, Data::NONE, false, false},
    {".inp", Format::INP, write_INP_format, nullptr, Data::NONE, true, true},
    {".feb", Format::FEB, write_FEB_format, nullptr, Data::VERTICES, true, true},
    {".ele", {}, nullptr, read_TETGEN, Data::NONE, false, false},
    {".node", {}, nullptr, read_TETGEN, Data::NONE, false, false},
    {".vol", {}, nullptr, read_one_file<read_NETGEN>, Data::NONE, false, false},
  };
  return formats;
}

inline const Mesh_format& format_traits(Format format)
{
  return *std::find_if(mesh_formats().begin(), mesh_formats().end(),
                       [format](const Mesh_format& f) { return f.write != nullptr && f.format == format; });
}

/// The extensions of the formats that have a property: ".vtu, .msh and .feb".
template <class Has_property>
std::string extensions_with(const Has_property& has_property, const char* conjunction)
{
  std::vector<std::string_view> extensions;
  for(const Mesh_format& f : mesh_formats())
    if(has_property(f))
      extensions.push_back(f.extension);
  return in_one_line(extensions, conjunction);
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_FORMATS_H
