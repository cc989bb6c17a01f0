// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes from files of Medit: read and checked, or refused.

#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const Fuzz_file file(".mesh");
  return read_and_check(file, data, size);
}
