// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bytes as a file, for readers that take a path.

#ifndef MIXED_MESH_3_TEST_FUZZ_FUZZ_FILE_H
#define MIXED_MESH_3_TEST_FUZZ_FUZZ_FILE_H

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

/// The function that libFuzzer calls with each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// A file of this process, removed in the end.
class Fuzz_file
{
  std::filesystem::path m_path;

public:
  explicit Fuzz_file(const std::string& extension)
    : m_path(std::filesystem::temp_directory_path() / ("fuzz_" + std::to_string(getpid()) + extension))
  {
  }
  ~Fuzz_file()
  {
    std::error_code ignored;
    std::filesystem::remove(m_path, ignored);
  }
  Fuzz_file(const Fuzz_file&) = delete;
  Fuzz_file& operator=(const Fuzz_file&) = delete;

  std::string path() const { return m_path.string(); }

  void write(const std::uint8_t* data, std::size_t size) const
  {
    std::ofstream(m_path, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
  }
};

/// Aborts, so that libFuzzer keeps the input.
inline void require(bool holds)
{
  if(!holds)
    std::abort();
}

/// Requires that a reader that refuses a file says why in one line, with the file's name in front.
inline void require_line(const std::string& path, const std::string& error)
{
  require(error.compare(0, path.size() + 2, path + ": ") == 0 && error.size() > path.size() + 2
          && error.find('\n') == std::string::npos);
}

#endif // MIXED_MESH_3_TEST_FUZZ_FUZZ_FILE_H
