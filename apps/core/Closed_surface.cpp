// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/Closed_surface.h"

#include "core/Closed_surface_domain.h"
#include "core/misfit.h"
#include "core/read_surface.h"

Closed_surface::Closed_surface(const std::string& path,
                               const CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& options,
                               Surface_facts& facts, std::vector<std::string>& warnings)
  : m_path(path)
{
  const Surface surface = read_surface(path, options, facts, warnings);
  m_points = coordinates_of(surface.points());
  m_domain = std::make_unique<const Domain>(surface);
}

Closed_surface::~Closed_surface() = default;

bool Closed_surface::contains(const std::array<double, 3>& p) const
{
  return m_domain->bounded_side(Kernel::Point_3(p[0], p[1], p[2])) == CGAL::ON_BOUNDED_SIDE;
}
