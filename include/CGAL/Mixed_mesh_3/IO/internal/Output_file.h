// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that appear when they are complete.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_OUTPUT_FILE_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_OUTPUT_FILE_H

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <system_error>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

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

  // Calls `write(stream)`; the result is empty if all of it is in the temporary file.
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
    return std::string();
  }

  // Gives the temporary file its name; the result is empty if that went well.
  std::string commit()
  {
    if(m_is_direct)
      return std::string();
    std::error_code error;
    std::filesystem::rename(m_temporary, m_target, error);
    if(error)
      return "cannot replace: " + error.message();
    m_temporary.clear();
    return std::string();
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_OUTPUT_FILE_H
