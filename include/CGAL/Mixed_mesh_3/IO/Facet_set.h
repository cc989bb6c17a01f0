// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_FACET_SET_H
#define CGAL_MIXED_MESH_3_IO_FACET_SET_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Face.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMesh3IO

\brief Named faces of elements, to be written with a mesh: where a boundary condition holds, or an interface
between tissues.

The name has letters, digits, `_` and `-`, a letter first, and at most 60 characters. It is not the name of
another set, in upper or lower case, nor of anything else in the files: not `all`, `boundary`, `region`,
`rest`, and does not begin with `region_`, `rest_` or `subdomain_`. Each face is in the set once. A face
between two elements is given as a face of one of them, and has the orientation from there outwards. A set
without faces is not written.
*/
struct Facet_set
{
  /// The name in files.
  std::string name;
  /// Faces of elements of the mesh.
  std::vector<Face> faces;
};

namespace internal {

inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// A name in upper case, because not all programs distinguish upper and lower case.
inline std::string in_upper_case(std::string name)
{
  for(char& c : name)
    c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
  return name;
}

} // namespace internal

/// \ingroup PkgMixedMesh3IO
/// Whether all formats can have a name beside the names that writers give: see `Facet_set`.
inline bool is_facet_set_name(const std::string& name)
{
  using internal::is_letter;
  const auto is_allowed = [](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  const std::string upper = internal::in_upper_case(name);
  bool is_free = true;
  for(const char* used : {"ALL", "BOUNDARY", "REGION", "REST"})
    is_free = is_free && upper != used;
  for(const char* begin : {"SUBDOMAIN_", "REGION_", "REST_"})
    is_free = is_free && upper.rfind(begin, 0) != 0;
  constexpr std::size_t longest = 60;
  return is_free && !name.empty() && name.size() <= longest && is_letter(name.front())
         && std::all_of(name.begin(), name.end(), is_allowed);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_FACET_SET_H
