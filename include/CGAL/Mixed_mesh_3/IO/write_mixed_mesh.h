// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H
#define CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H

#include <CGAL/Mixed_mesh_3/IO/FEB.h>
#include <CGAL/Mixed_mesh_3/IO/INP.h>
#include <CGAL/Mixed_mesh_3/IO/MEDIT.h>
#include <CGAL/Mixed_mesh_3/IO/MSH.h>
#include <CGAL/Mixed_mesh_3/IO/VTU.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>

#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// The formats that can be written.
enum class Format { VTU, MSH_4_1, MSH_2_2, MEDIT, INP, FEB };

/// Says in one line which file could not be written and why; empty if all went well.
using Write_error = std::optional<std::string>;

struct Write_options
{
  /// Whether to write `split_to_tetrahedra(mesh)` instead of the mesh.
  bool tetrahedra = false;
  /// Values to write with the mesh; `Format::VTU` only.
  std::vector<Data_array> vertex_data;
  /// Values to write with the mesh; `Format::VTU` only.
  std::vector<Data_array> element_data;
};

namespace internal {

struct Extension
{
  const char* name;
  Format format;
};

// The first extension of a format is its usual one; Gmsh knows `.msh2`, too.
constexpr Extension extensions[] = {{".vtu", Format::VTU},      {".msh", Format::MSH_4_1},
                                    {".msh2", Format::MSH_2_2}, {".mesh", Format::MEDIT},
                                    {".inp", Format::INP},      {".feb", Format::FEB}};

inline std::string system_message(int error_number)
{
  return error_number != 0 ? std::generic_category().message(error_number) : "unknown error";
}

// Where to write: symbolic links are followed, so that they stay. A device or pipe is written to; a
// file is replaced by a new one when that is complete.
class Output_file
{
  std::filesystem::path m_target, m_temporary;
  std::string m_error;
  bool m_is_direct = false;

public:
  explicit Output_file(const std::string& path) : m_target(path)
  {
    namespace fs = std::filesystem;
    std::error_code ignored;
    fs::path target = fs::weakly_canonical(path, ignored);
    if(!ignored && !target.empty())
      m_target = std::move(target);
    const fs::file_status status = fs::status(m_target, ignored);
    if(fs::is_directory(status)) {
      m_error = "is a directory";
      return;
    }
    m_is_direct = fs::exists(status) && !fs::is_regular_file(status);
    if(m_is_direct)
      return;

    // Mode "x" creates the file or fails, so that nobody else's file is hit.
    for(int i = 0; i < 1000; ++i) {
      fs::path candidate = m_target;
      candidate += ".tmp" + std::to_string(i);
      errno = 0;
      if(std::FILE* const file = std::fopen(candidate.string().c_str(), "wbx")) {
        std::fclose(file);
        m_temporary = std::move(candidate);
        return;
      }
      if(errno != EEXIST)
        break;
    }
    m_error = "cannot create a file in its directory: " + system_message(errno);
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  ~Output_file()
  {
    std::error_code ignored;
    if(!m_temporary.empty())
      std::filesystem::remove(m_temporary, ignored);
  }

  // Why nothing can be written, or empty.
  const std::string& error() const { return m_error; }

  // Calls `write(stream)`; the result is empty if all of it is in the file.
  template <class Write>
  std::string write(const Write& write)
  {
    errno = 0;
    std::ofstream stream(m_is_direct ? m_target : m_temporary, std::ios_base::binary);
    if(!stream)
      return "cannot open: " + system_message(errno);
    const bool is_written = write(static_cast<std::ostream&>(stream));
    const int write_errno = errno;
    stream.close(); // may find that the disk is full
    if(!is_written || !stream)
      return "cannot write: " + system_message(is_written ? errno : write_errno);
    if(!m_is_direct) {
      std::error_code error;
      std::filesystem::rename(m_temporary, m_target, error);
      if(error)
        return "cannot replace: " + error.message();
      m_temporary.clear();
    }
    return std::string();
  }
};

template <class Mesh>
bool write(std::ostream& stream, const Mesh& mesh, Format format, const Write_options& options)
{
  switch(format) {
  case Format::VTU: return write_VTU(stream, mesh, {options.vertex_data, options.element_data});
  case Format::MSH_4_1: return write_MSH(stream, mesh, MSH_version::V4_1);
  case Format::MSH_2_2: return write_MSH(stream, mesh, MSH_version::V2_2);
  case Format::MEDIT: return write_MEDIT(stream, mesh);
  case Format::INP: return write_INP(stream, mesh);
  case Format::FEB: return write_FEB(stream, mesh);
  }
  return false;
}

} // namespace internal

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

/*!
\brief Checks whether a mesh can be written to a path: to be called before meshing.

The extension must be known, the directory exist and be writable. An existing file is not touched; a
temporary one is created beside it and removed.
*/
[[nodiscard]] inline Write_error check_output_path(const std::string& path)
{
  if(!format_of(path)) {
    std::string known;
    for(const internal::Extension& extension : internal::extensions)
      known += std::string(" ") + extension.name;
    return path + ": unknown extension, known are" + known;
  }
  const internal::Output_file file(path);
  if(!file.error().empty())
    return path + ": " + file.error();
  return std::nullopt;
}

/*!
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

\return the error, or `std::nullopt`: `if(const auto error = write_mixed_mesh(path, mesh)) ...`
*/
template <class Mesh>
[[nodiscard]] Write_error write_mixed_mesh(const std::string& path, const Mesh& mesh,
                                           const Write_options& options = Write_options())
{
  const std::optional<Format> format = format_of(path);
  if(!format)
    return check_output_path(path);

  const auto error = [&path](const std::string& reason) { return path + ": " + reason; };
  const std::size_t sizes[] = {mesh.number_of_vertices(), mesh.number_of_elements()};
  const std::vector<Data_array>* const data[] = {&options.vertex_data, &options.element_data};
  for(int i = 0; i < 2; ++i)
    for(const Data_array& array : *data[i]) {
      if(*format != Format::VTU)
        return error("data \"" + array.name + "\" can be written to .vtu only");
      if(!array.has_size(sizes[i]))
        return error("data \"" + array.name + "\" does not have the size of the mesh");
    }
  for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v)
    for(double x : Mixed_meshes_3::internal::to_vec3(mesh.points()[v]))
      if(!std::isfinite(x))
        return error("vertex " + std::to_string(v) + " of the mesh has a coordinate that is not finite");

  if(options.tetrahedra) {
    std::vector<Element_index> origins;
    const Mesh tetrahedra = split_to_tetrahedra(mesh, &origins);
    Write_options new_options = options;
    new_options.tetrahedra = false;
    std::vector<std::vector<double>> values;
    values.reserve(options.element_data.size());
    for(Data_array& array : new_options.element_data) {
      std::vector<double> split_values;
      for(Element_index e : origins)
        for(int i = 0; i < array.number_of_components; ++i)
          split_values.push_back(
            (*array.values)[std::size_t(e) * std::size_t(array.number_of_components) + std::size_t(i)]);
      values.push_back(std::move(split_values));
      array.values = &values.back();
    }
    return write_mixed_mesh(path, tetrahedra, new_options);
  }

  internal::Output_file file(path);
  std::string reason = file.error();
  if(reason.empty())
    reason = file.write([&](std::ostream& stream) {
      return internal::write(stream, mesh, *format, options);
    });
  if(!reason.empty())
    return error(reason);
  return std::nullopt;
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H
