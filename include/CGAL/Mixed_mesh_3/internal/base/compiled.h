// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The package is header-only. Functions without a template parameter can be compiled once instead, into the
// library Mixed_mesh_3_compiled: users of the library define CGAL_MIXED_MESH_3_COMPILED, and the headers of
// the definitions, *_impl.h, are included by src/Mixed_mesh_3/*.cpp only.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_COMPILED_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_COMPILED_H

#include <CGAL/license/Mixed_mesh_3.h>

#ifdef CGAL_MIXED_MESH_3_COMPILED
#define CGAL_MIXED_MESH_3_INLINE
#else
#define CGAL_MIXED_MESH_3_INLINE inline
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_COMPILED_H
