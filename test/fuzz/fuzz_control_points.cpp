// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Control points, in the format that the first byte chooses: a table, or fiducials of 3D Slicer.

#include "fuzz_file.h"

#include "brain_shift/read_control_points.h"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

// Checks that the message has no control characters if the file has some.
template <class Read>
void check(const std::string& path, const Read& read)
{
  try {
    const std::vector<Control_point> points = read();
    require(!points.empty());
    for(const Control_point& p : points)
      for(int k = 0; k < 3; ++k)
        require(std::isfinite(p.position[k]) && std::isfinite(p.displacement[k]));
  } catch(const std::runtime_error& e) {
    require_line(path, e.what());
  }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const Fuzz_file table(".csv"), list(".fcsv"), markups(".mrk.json");
  if(size == 0)
    return 0;
  const Fuzz_file& file = data[0] == '#' ? list : data[0] == '{' ? markups : table;
  file.write(data, size);
  check(file.path(), [&] {
    return &file == &table ? read_control_points(file.path()) : read_fiducials(file.path(), file.path());
  });
  return 0;
}
