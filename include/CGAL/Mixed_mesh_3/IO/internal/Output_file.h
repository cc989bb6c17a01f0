// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that appear when they are complete.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_OUTPUT_FILE_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_OUTPUT_FILE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <ios>
#include <ostream>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

inline std::string system_message(int error_number)
{
  return error_number != 0 ? std::generic_category().message(error_number) : "unknown error";
}

// The target of a path: unlike `weakly_canonical()`, also where a link leads to no file yet.
inline std::filesystem::path follow_links(std::filesystem::path path)
{
  namespace fs = std::filesystem;
  std::error_code error;
  for(int i = 0; i < 40 && fs::is_symlink(fs::symlink_status(path, error)); ++i) { // as many as Linux follows
    const fs::path next = fs::read_symlink(path, error);
    if(error)
      break;
    path = path.parent_path() / next; // `next` if that is absolute
  }
  const fs::path target = fs::weakly_canonical(path, error);
  return error || target.empty() ? path : target;
}

// A name beside a file that no other file has: short, so that the file's name may be as long as the system
// allows.
inline std::filesystem::path hidden_name_beside(const std::filesystem::path& path)
{
  std::random_device random; // names are not part of the output
  char name[32];
  std::snprintf(name, sizeof(name), ".%08x%08x.tmp", unsigned(random()), unsigned(random()));
  return path.parent_path() / name;
}

// Gives a new file owner and group of the old one as far as the system allows.
inline void copy_owner(const std::filesystem::path& from, const std::filesystem::path& to)
{
#if defined(__unix__) || defined(__APPLE__)
  struct stat status;
  if(::stat(from.c_str(), &status) == 0 && ::chown(to.c_str(), status.st_uid, status.st_gid) != 0
     && ::chown(to.c_str(), uid_t(-1), status.st_gid) != 0)
    return; // the user may not give the file away
#else
  (void)from, (void)to;
#endif
}

// A file to write to, which fails as soon as `go_on()` is false.
class Stoppable_buffer : public std::filebuf
{
  const std::function<bool()>& m_go_on;
  bool m_is_stopped = false;

  bool go_on()
  {
    m_is_stopped = m_is_stopped || (m_go_on && !m_go_on());
    return !m_is_stopped;
  }

protected:
  std::streamsize xsputn(const char* bytes, std::streamsize n) override
  {
    return go_on() ? std::filebuf::xsputn(bytes, n) : 0;
  }
  int_type overflow(int_type c) override { return go_on() ? std::filebuf::overflow(c) : traits_type::eof(); }

public:
  explicit Stoppable_buffer(const std::function<bool()>& go_on) : m_go_on(go_on) {}
  bool is_stopped() const { return m_is_stopped; }
};

// An output file: symbolic links are followed, so that they stay. A device or pipe is written to; a file is
// replaced by a new one, with its owner and mode, when the new file is complete.
class Output_file
{
  std::filesystem::path m_target, m_temporary, m_backup; // the last one: the former file
  std::filesystem::perms m_permissions = std::filesystem::perms::unknown;
  std::string m_error;
  bool m_is_direct = false, m_is_in_place = false;

  // Creates the temporary file with mode "x", which creates a file or fails, so that no other file is
  // overwritten.
  bool create_temporary()
  {
    for(int i = 0; i < 10; ++i) {
      std::filesystem::path candidate = hidden_name_beside(m_target);
      errno = 0;
      if(std::FILE* const file = std::fopen(candidate.string().c_str(), "wbx")) {
        std::fclose(file);
        m_temporary = std::move(candidate);
        return true;
      }
      if(errno != EEXIST)
        return false;
    }
    return false;
  }

  // Gives the existing file a second name, so that the first name always has a file. Some file systems do not
  // have second names; the file is renamed then.
  std::string back_up()
  {
    namespace fs = std::filesystem;
    std::error_code error;
    if(!fs::exists(fs::status(m_target, error)))
      return std::string();
    const fs::path backup = hidden_name_beside(m_target);
    fs::create_hard_link(m_target, backup, error);
    if(error)
      fs::rename(m_target, backup, error);
    if(error)
      return "cannot replace: " + error.message();
    m_backup = backup;
    return std::string();
  }

public:
  explicit Output_file(const std::string& path) : m_target(follow_links(path))
  {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(m_target, error);
    if(status.type() == fs::file_type::none) // for example a name that is too long, or a circle of links
      m_error = "cannot be written: " + error.message();
    else if(fs::is_directory(status))
      m_error = "is a directory";
    m_is_direct = fs::exists(status) && !fs::is_regular_file(status);
    if(!m_error.empty() || m_is_direct)
      return;
    if(!create_temporary()) {
      m_error = "cannot create a file in its directory: " + system_message(errno);
      return;
    }
    if(!fs::exists(status))
      return;
    // The mode is set at once, so that a file that nobody else may read cannot be read in between.
    m_permissions = status.permissions();
    copy_owner(m_target, m_temporary);
    fs::permissions(m_temporary, m_permissions | fs::perms::owner_write, error);
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  ~Output_file()
  {
    std::error_code ignored;
    if(!m_temporary.empty())
      std::filesystem::remove(m_temporary, ignored);
  }

  // The reason why nothing can be written, or empty.
  const std::string& error() const { return m_error; }

  // Calls `write(stream)`; the result is empty if all of it is in the temporary file.
  template <class Write>
  std::string write(const Write& write, const std::function<bool()>& go_on = {})
  {
    errno = 0;
    Stoppable_buffer buffer(go_on);
    if(buffer.open(m_is_direct ? m_target : m_temporary, std::ios_base::out | std::ios_base::binary)
       == nullptr)
      return "cannot open: " + system_message(errno);
    std::ostream stream(&buffer);
    const bool is_written = write(stream) && stream;
    const int write_errno = errno;
    const bool is_closed = buffer.close() != nullptr; // may find that the disk is full
    if(buffer.is_stopped())
      return "not written: stopped";
    if(!is_written || !is_closed)
      return "cannot write: " + system_message(is_written ? errno : write_errno);
    return std::string();
  }

  // Gives the temporary file its name; the result is empty if successful. With `can_be_undone`, the former
  // file stays beside it until `finish()`.
  std::string commit(bool can_be_undone)
  {
    if(m_is_direct)
      return std::string();
    std::error_code error;
    if(m_permissions != std::filesystem::perms::unknown)
      std::filesystem::permissions(m_temporary, m_permissions, error);
    if(can_be_undone) {
      const std::string defect = back_up();
      if(!defect.empty())
        return defect;
    }
    std::filesystem::rename(m_temporary, m_target, error);
    if(error)
      return "cannot replace: " + error.message();
    m_temporary.clear();
    m_is_in_place = true;
    return std::string();
  }

  // Restores the file that was there before `commit(true)`; the result is empty if successful.
  std::string undo()
  {
    std::error_code error;
    if(!m_backup.empty())
      std::filesystem::rename(m_backup, m_target, error);
    else if(m_is_in_place)
      std::filesystem::remove(m_target, error);
    m_is_in_place = false;
    if(error)
      return "what was there is now in " + m_backup.string() + ": " + error.message();
    // Two names of one file are not renamed to each other; this is the case if the file had not been
    // replaced.
    if(!m_backup.empty())
      std::filesystem::remove(m_backup, error);
    m_backup.clear();
    return std::string();
  }

  // Removes the former file.
  void finish()
  {
    std::error_code ignored;
    if(!m_backup.empty())
      std::filesystem::remove(m_backup, ignored);
    m_backup.clear();
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_OUTPUT_FILE_H
