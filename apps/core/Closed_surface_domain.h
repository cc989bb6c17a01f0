// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_APPS_CORE_CLOSED_SURFACE_DOMAIN_H
#define MIXED_MESH_3_APPS_CORE_CLOSED_SURFACE_DOMAIN_H

#include "core/Closed_surface.h"

#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

struct Closed_surface::Domain : CGAL::Polyhedral_mixed_mesh_domain_3
{
  using Polyhedral_mixed_mesh_domain_3::Polyhedral_mixed_mesh_domain_3;
};

#endif // MIXED_MESH_3_APPS_CORE_CLOSED_SURFACE_DOMAIN_H
