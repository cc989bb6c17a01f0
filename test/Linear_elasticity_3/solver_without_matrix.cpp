// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A solver that is no model of the concept, and does not compile. test_compiler_messages.py reads the
// compiler's message.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_elasticity_3.h>

struct Solver
{
  using NT = double;
  using Vector = CGAL::Eigen_vector<double>;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
template class CGAL::Linear_elasticity_3<CGAL::Mixed_mesh_3<Kernel>, Solver>;
