// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Landmarks, in the format that the first byte chooses: tag points of MNI, or a table. fuzz_control_points
// has fiducials.

#include "fuzz_file.h"

#include "brain_shift/read_landmarks.h"

#include <cmath>
#include <stdexcept>
#include <vector>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const Fuzz_file table(".csv"), tags(".tag");
  if(size == 0)
    return 0;
  const Fuzz_file& file = data[0] == 'M' ? tags : table;
  file.write(data, size);
  try {
    const std::vector<Control_point> landmarks = read_landmarks(file.path(), "");
    require(landmarks.size() >= least_number_of_landmarks);
    for(const Control_point& p : landmarks)
      for(int k = 0; k < 3; ++k)
        require(std::isfinite(p.position[k]) && std::isfinite(p.displacement[k]));
  } catch(const std::runtime_error& e) {
    require_line(file.path(), e.what());
  }
  return 0;
}
