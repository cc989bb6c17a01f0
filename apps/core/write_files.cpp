// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/write_files.h"

#include "core/resources.h"

#include <ostream>

namespace IO = CGAL::Mixed_meshes_3::IO;

void write_mesh(IO::Output_files& files, const std::string& path, const Mesh& mesh,
                const IO::Write_options& options)
{
  require([&](std::string* error) { return IO::write_mixed_mesh(files, path, mesh, options, error); });
}

void write_text(IO::Output_files& files, const std::string& path, const std::string& text)
{
  const auto write = [&](std::ostream& stream) { return bool(stream << text); };
  require([&](std::string* error) { return files.write(path, write, error); });
}
