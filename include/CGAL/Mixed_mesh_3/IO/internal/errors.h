// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Errors of readers and writers: internally, an exception or a line of text; for the caller, `false` and the
// line if it was asked for.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_ERRORS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_ERRORS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// A file's name on one line, whatever characters it has.
inline std::string printable(std::string path)
{
  for(char& c : path)
    if((static_cast<unsigned char>(c) < ' ') || c == 127)
      c = '?';
  return path;
}

/// Ends the reading of a file.
[[noreturn]] inline void refuse(const std::string& path, const std::string& defect)
{
  throw std::runtime_error(printable(path) + ": " + defect);
}

/// A defect with the name of its file; nothing if there is none.
inline std::string with_path(const std::string& path, const std::string& defect)
{
  return defect.empty() ? defect : printable(path) + ": " + defect;
}

/// Whether there is no defect; passes a defect on otherwise.
inline bool is_success(const std::string& defect, std::string* error)
{
  if(!defect.empty() && error != nullptr)
    *error = defect;
  return defect.empty();
}

/// Whether `read()` ends without an exception; passes its message on otherwise.
template <class Read>
bool is_read(const std::string& path, std::string* error, const Read& read)
{
  const std::string too_large = printable(path) + ": does not fit into the memory";
  try {
    read();
    return true;
  } catch(const std::bad_alloc&) {
    return is_success(too_large, error);
  } catch(const std::length_error&) {
    return is_success(too_large, error);
  } catch(const std::filesystem::filesystem_error& e) { // names that are too long, circles of links
    return is_success(path + ": cannot be opened: " + e.code().message(), error);
  } catch(const std::runtime_error& e) { // our own
    return is_success(e.what(), error);
  } catch(const std::exception& e) { // an assertion of CGAL
    return is_success(printable(path + ": " + e.what()), error);
  }
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_ERRORS_H
