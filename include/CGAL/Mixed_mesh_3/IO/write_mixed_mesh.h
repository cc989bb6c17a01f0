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
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Output_file.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>

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

class Output_files;

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
  /// The order of the elements, 1 or 2. With 2, they are quadratic and straight-sided: each edge has one node
  /// more, at its rounded midpoint, numbered after the vertices in the order in which elements have the edges
  /// first; faces have those of their edges. Such elements have the map of the linear ones, up to the
  /// rounding of the middle nodes: what the certificate proves of those holds for them. Values at the
  /// vertices are interpolated linearly. All formats but `Format::MEDIT` have them, `Format::INP` without
  /// pyramids.
  int order = 1;
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

/// Writes a mesh in a format. \return whether all went well
bool write(std::ostream& stream, const Mixed_meshes_3::internal::Core_mesh& mesh, Format format,
           const Write_options& options);

/// Why a format cannot have elements of an order, whatever their kinds; empty if it can.
inline std::string order_defect(Format format, int order)
{
  if(order != 1 && order != 2)
    return "the order of elements is 1 or 2, not " + std::to_string(order);
  return order == 2 && format == Format::MEDIT
           ? "elements of order 2 can be written to .vtu, .msh, .inp and .feb only"
           : "";
}

/// As `write_mixed_mesh()`, compiled once.
bool write_core_mesh(Output_files& files, const std::string& path,
                     const Mixed_meshes_3::internal::Core_mesh& mesh, const Write_options& options,
                     std::string* error);

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

The extension must be known, the directory exist and be writable, and the format have elements of the order.
An existing file is not touched; a temporary one is created beside it and removed.

\param path the file
\param error if not null, receives a line that names the file and says what is wrong, if anything is
\param order of the elements: see `Write_options::order`
*/
[[nodiscard]] inline bool check_output_path(const std::string& path, std::string* error = nullptr,
                                            int order = 1)
{
  if(const std::optional<Format> format = format_of(path))
    return internal::is_success(internal::with_path(path, internal::order_defect(*format, order)), error)
           && check_output_directory(path, error);
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
  return internal::write_core_mesh(files, path, Mixed_meshes_3::internal::as_core_mesh(mesh), options, error);
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

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/IO/internal/write_mixed_mesh_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H
