// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H
#define CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/FEB.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/INP.h>
#include <CGAL/Mixed_mesh_3/IO/MEDIT.h>
#include <CGAL/Mixed_mesh_3/IO/MSH.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/VTU.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Output_file.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/facet_sets.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>

#include <cmath>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// The formats that can be written.
enum class Format {
  VTU,     ///< VTK's unstructured grid, in XML
  MSH_4_1, ///< Gmsh, now
  MSH_2_2, ///< Gmsh, the older format
  MEDIT,   ///< Medit
  INP,     ///< Abaqus
  FEB      ///< FEBio
};

/// \ingroup PkgMixedMesh3IO
/// How `write_mixed_mesh()` writes, and what besides the mesh.
struct Write_options
{
  /// Whether to write `split_to_tetrahedra(mesh)` instead of the mesh.
  bool tetrahedra = false;
  /// Whether `.msh` means Gmsh's format 2.2 instead of 4.1.
  bool msh_2_2 = false;
  /// Values to write with the mesh: `Format::VTU`; of one or three components, also Gmsh's formats and
  /// `Format::FEB`.
  std::vector<Data_array> vertex_data;
  /// Values to write with the mesh; `Format::VTU` only.
  std::vector<Data_array> element_data;
  /// Named faces of elements, in all formats. `Format::MSH_2_2` and `Format::MEDIT` take no face in two sets.
  std::vector<Facet_set> facet_sets = {};
  /// In all formats but `Format::MSH_2_2` and `Format::MEDIT`, which have no place for them.
  Subdomain_names subdomain_names = {};
};

namespace internal {

struct Extension
{
  const char* name;
  Format format;
};

// The first extension of a format is its usual one; Gmsh knows `.msh2`, too.
inline constexpr Extension extensions[] = {{".vtu", Format::VTU},      {".msh", Format::MSH_4_1},
                                           {".msh2", Format::MSH_2_2}, {".mesh", Format::MEDIT},
                                           {".inp", Format::INP},      {".feb", Format::FEB}};

/// Whether a file of the format can have values.
inline bool can_hold(Format format, bool is_vertex_data, const Data_array& data)
{
  if(format == Format::VTU)
    return true;
  const bool has_quotes = data.name.find('"') != std::string::npos; // Gmsh has names in quotes
  return is_vertex_data && !has_quotes && (data.number_of_components == 1 || data.number_of_components == 3)
         && (format == Format::MSH_4_1 || format == Format::MSH_2_2 || format == Format::FEB);
}

template <class Mesh>
bool write(std::ostream& stream, const Mesh& mesh, Format format, const Write_options& options)
{
  const std::vector<Facet_set>& sets = options.facet_sets;
  const Subdomain_names& names = options.subdomain_names;
  switch(format) {
  case Format::VTU: return write_VTU(stream, mesh, {options.vertex_data, options.element_data, sets, names});
  case Format::MSH_4_1: return write_MSH(stream, mesh, MSH_version::V4_1, sets, options.vertex_data, names);
  case Format::MSH_2_2: return write_MSH(stream, mesh, MSH_version::V2_2, sets, options.vertex_data);
  case Format::MEDIT: return write_MEDIT(stream, mesh, sets);
  case Format::INP: return write_INP(stream, mesh, sets, names);
  case Format::FEB: return write_FEB(stream, mesh, sets, options.vertex_data, names);
  }
  return false;
}

} // namespace internal

/// \ingroup PkgMixedMesh3IO
/// The format for a file name, from its extension in upper or lower case; empty if unknown.
inline std::optional<Format> format_of(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  for(char& c : extension)
    if(c >= 'A' && c <= 'Z')
      c = char(c - 'A' + 'a');
  for(const internal::Extension& known : internal::extensions)
    if(extension == known.name)
      return known.format;
  return std::nullopt;
}

/// \ingroup PkgMixedMesh3IO
/// Whether any file can be written to a path: its directory must exist and be writable.
/// \param path the file
/// \param error if not null, receives a line that names the file and says what is wrong, if anything is
[[nodiscard]] inline bool check_output_directory(const std::string& path, std::string* error = nullptr)
{
  return internal::is_success(internal::with_path(path, internal::Output_file(path).error()), error);
}

/*!
\ingroup PkgMixedMesh3IO

\brief Files that appear together, when all of them are complete.

Each is written under another, hidden name in its directory; `commit()` renames them, all or none. Files not
committed are removed by the destructor, and what was there before stays. A file that replaces another one has
its mode, and its owner and group as far as the system allows; hard links and access control lists go with
the old one. Symbolic links are followed, also one that leads to no file yet. A device or pipe is written to
at once.
*/
class Output_files
{
  std::deque<std::pair<std::string, internal::Output_file>> m_files;
  std::function<bool()> m_go_on;

  // What went wrong, and what more goes wrong when the first `n` files are as they were.
  std::string undo(std::size_t n, std::string reason)
  {
    while(n-- != 0) {
      const std::string defect = internal::with_path(m_files[n].first, m_files[n].second.undo());
      if(!defect.empty())
        reason += "; " + defect;
    }
    return reason;
  }

public:
  /// No file yet.
  Output_files() = default;

  /// \param go_on asked often while files are written; as soon as it returns `false`, `write()` fails
  explicit Output_files(std::function<bool()> go_on) : m_go_on(std::move(go_on)) {}

  /// Writes a file.
  /// \param path the file, once committed
  /// \param write called as `bool(std::ostream&)`; returns whether all went well
  /// \param error if not null, receives a line that names the file and says what went wrong
  /// \return whether all went well
  template <class Write>
  [[nodiscard]] bool write(const std::string& path, const Write& write, std::string* error = nullptr)
  {
    internal::Output_file& file =
      m_files.emplace_back(std::piecewise_construct, std::make_tuple(path), std::make_tuple(path)).second;
    std::string reason = file.error();
    if(reason.empty())
      reason = file.write(write, m_go_on);
    return internal::is_success(internal::with_path(path, reason), error);
  }

  /// Gives all files written their names; `write()` says what parameter and result are. If one cannot have
  /// its name, those before are removed, and what was there is back.
  [[nodiscard]] bool commit(std::string* error = nullptr)
  {
    for(std::size_t i = 0; i < m_files.size(); ++i) {
      auto& [path, file] = m_files[i];
      const std::string defect = internal::with_path(path, file.commit(i + 1 != m_files.size()));
      if(!defect.empty())
        return internal::is_success(undo(i + 1, defect), error);
    }
    for(auto& [path, file] : m_files)
      file.finish();
    m_files.clear();
    return true;
  }
};

/*!
\ingroup PkgMixedMesh3IO

\brief Checks whether a mesh can be written to a path: to be called before meshing.

The extension must be known, the directory exist and be writable. An existing file is not touched; a
temporary one is created beside it and removed.

\param path the file
\param error if not null, receives a line that names the file and says what is wrong, if anything is
*/
[[nodiscard]] inline bool check_output_path(const std::string& path, std::string* error = nullptr)
{
  if(format_of(path))
    return check_output_directory(path, error);
  std::string known;
  for(const internal::Extension& extension : internal::extensions)
    known += std::string(" ") + extension.name;
  return internal::is_success(path + ": unknown extension, known are" + known, error);
}

/// \ingroup PkgMixedMesh3IO
/// Writes a mesh to one of several files that shall appear together, as the function below does to one.
template <class Mesh>
[[nodiscard]] bool write_mixed_mesh(Output_files& files, const std::string& path, const Mesh& mesh,
                                    const Write_options& options = Write_options(),
                                    std::string* error = nullptr)
{
  const std::optional<Format> format = format_of(path);
  if(!format)
    return check_output_path(path, error);

  const auto refused = [&](const std::string& reason) {
    return internal::is_success(internal::with_path(path, reason), error);
  };
  const std::size_t sizes[] = {mesh.number_of_vertices(), mesh.number_of_elements()};
  const std::vector<Data_array>* const data[] = {&options.vertex_data, &options.element_data};
  for(int i = 0; i < 2; ++i)
    for(const Data_array& array : *data[i]) {
      const bool is_vertex_data = i == 0;
      if(!internal::can_hold(*format, is_vertex_data, array))
        return refused(
          "data \"" + array.name + "\" can be written to "
          + (is_vertex_data ? ".vtu, and of one or three components to .msh and .feb, only" : ".vtu only"));
      if(!array.has_size(sizes[i]))
        return refused("data \"" + array.name + "\" does not have the size of the mesh");
    }
  for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v)
    for(double x : Mixed_meshes_3::to_vec3(mesh.points()[v]))
      if(!std::isfinite(x))
        return refused("the mesh's vertex " + std::to_string(v) + " has no finite position");

  const Format used = options.msh_2_2 && *format == Format::MSH_4_1 ? Format::MSH_2_2 : *format;
  const bool has_one_number = used == Format::MSH_2_2 || used == Format::MEDIT;
  const std::string defect = internal::facet_set_defect(mesh, options.facet_sets, has_one_number);
  if(!defect.empty())
    return refused(defect);
  const std::string defect_of_names = internal::subdomain_name_defect(options.subdomain_names,
                                                                      options.facet_sets);
  if(!defect_of_names.empty())
    return refused(defect_of_names);

  if(options.tetrahedra) {
    std::vector<Element_index> origins;
    const Mesh tetrahedra = split_to_tetrahedra(mesh, &origins);
    Write_options new_options = options;
    new_options.tetrahedra = false;
    new_options.facet_sets = internal::split_facet_sets(tetrahedra, origins, options.facet_sets);
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
    return write_mixed_mesh(files, path, tetrahedra, new_options, error);
  }
  return files.write(
    path, [&](std::ostream& stream) { return internal::write(stream, mesh, used, options); }, error);
}

/*!
\ingroup PkgMixedMesh3IO

\brief Writes a mesh to a file, in the format that the extension tells.

| extension | format |
|-----------|--------|
| `.vtu`    | VTK, binary: `write_VTU()` |
| `.msh`    | Gmsh 4.1: `write_MSH()` |
| `.msh2`   | Gmsh 2.2: `write_MSH()` |
| `.mesh`   | Medit: `write_MEDIT()` |
| `.inp`    | Abaqus: `write_INP()` |
| `.feb`    | FEBio: `write_FEB()` |

The file appears when it is complete: it is written under another name in the same directory, which
is removed when something goes wrong. An existing file stays until it is replaced.

\param path the file
\param mesh the mesh
\param options what else to write
\param error if not null, receives a line that names the file and says what went wrong
\return whether all went well
*/
template <class Mesh>
[[nodiscard]] bool write_mixed_mesh(const std::string& path, const Mesh& mesh,
                                    const Write_options& options = Write_options(),
                                    std::string* error = nullptr)
{
  Output_files files;
  return write_mixed_mesh(files, path, mesh, options, error) && files.commit(error);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H
