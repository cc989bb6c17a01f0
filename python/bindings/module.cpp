// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The module under mixed_mesh_3/__init__.py, which has the names, the defaults and the documentation.

#include "arrays.h"

PYBIND11_MODULE(_core, module)
{
  add_mesh(module);
  add_meshing(module);
  add_elasticity(module);
  add_images(module);
  add_patches(module);
}
