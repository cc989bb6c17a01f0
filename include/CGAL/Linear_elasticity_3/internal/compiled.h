// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The package is header-only. Its method, which has no template parameter, can be compiled once, into the
// library Linear_elasticity_3_compiled: users of the library define CGAL_LINEAR_ELASTICITY_3_COMPILED, and
// the header of the definitions, Elasticity_model_impl.h, is included by src/Linear_elasticity_3/*.cpp only.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_COMPILED_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_COMPILED_H

#include <CGAL/license/Linear_elasticity_3.h>

#ifdef CGAL_LINEAR_ELASTICITY_3_COMPILED
#define CGAL_LINEAR_ELASTICITY_3_INLINE
#else
#define CGAL_LINEAR_ELASTICITY_3_INLINE inline
#endif

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_COMPILED_H
