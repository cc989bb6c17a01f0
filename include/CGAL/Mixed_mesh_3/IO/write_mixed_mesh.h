// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H
#define CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Write_options.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Output_file.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

class Output_files;

namespace internal {

/// Writes a mesh in a format. \return whether all went well
bool write(std::ostream& stream, const Mixed_meshes_3::internal::Core_mesh& mesh, Format format,
           const Write_options& options);

/// As `write_mixed_mesh()`, compiled once.
bool write_core_mesh(Output_files& files, const std::string& path,
                     const Mixed_meshes_3::internal::Core_mesh& mesh, const Write_options& options,
                     std::string* error);

} // namespace internal

/// \ingroup PkgMixedMesh3IO
/// The format for a file name, from its extension in upper or lower case; empty if unknown.
std::optional<Format> format_of(const std::string& path);

/// \ingroup PkgMixedMesh3IO
/// Whether a face can be in several facet sets of a file; otherwise the sets are disjoint.
bool has_overlapping_facet_sets(Format format);

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
[[nodiscard]] bool check_output_path(const std::string& path, std::string* error = nullptr, int order = 1);

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
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/write_mixed_mesh_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_IO_WRITE_MIXED_MESH_H
