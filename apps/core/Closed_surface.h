// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed surfaces from files, as sets of points.

#ifndef MIXED_MESH_3_APPS_CORE_CLOSED_SURFACE_H
#define MIXED_MESH_3_APPS_CORE_CLOSED_SURFACE_H

#include "core/facts.h"

#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

/// The inside of a closed surface.
class Closed_surface
{
public:
  struct Domain; // heavy to compile, in Closed_surface_domain.h

  /// \throw std::runtime_error a line naming the file and the defect
  Closed_surface(const std::string& path,
                 const CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& options,
                 Surface_facts& facts, std::vector<std::string>& warnings);
  ~Closed_surface();

  bool contains(const std::array<double, 3>& p) const;

  const std::string& path() const { return m_path; }
  const std::vector<std::array<double, 3>>& points() const { return m_points; }
  const Domain& domain() const { return *m_domain; }

private:
  std::string m_path;
  std::vector<std::array<double, 3>> m_points;
  std::unique_ptr<const Domain> m_domain;
};

#endif // MIXED_MESH_3_APPS_CORE_CLOSED_SURFACE_H
