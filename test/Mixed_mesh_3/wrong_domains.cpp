// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two domains that are no models of their concepts, and do not compile: HAS_TAG tells which one it is.
// test_compiler_messages.py reads the compiler's message.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Implicit_mixed_mesh_domain_3.h>
#include <CGAL/make_mixed_mesh_3.h>

struct Domain : CGAL::Implicit_mixed_mesh_domain_3
{
  using CGAL::Implicit_mixed_mesh_domain_3::Implicit_mixed_mesh_domain_3;
#ifdef HAS_TAG
  using Has_features = CGAL::Tag_true;
  CGAL::Mixed_meshes_3::Axis_parallel_planes axis_parallel_planes() const { return {}; }
  CGAL::Mixed_meshes_3::Sharp_edges sharp_edge(double) const { return {}; } // misspelt
#else
  CGAL::Mixed_meshes_3::Sharp_edges sharp_edges(double) { return {}; } // no tag, and not const
#endif
};

void make(const Domain& domain, CGAL::Mixed_mesh_3<CGAL::Exact_predicates_inexact_constructions_kernel>& mesh)
{
  CGAL::make_mixed_mesh_3(domain, CGAL::Everywhere_mixed_mesh_region_3(), 1000, mesh);
}
