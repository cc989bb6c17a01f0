// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces of solids that touch or cross each other.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_CONTACTS_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_CONTACTS_H

#include "core/read_surface.h"
#include "mixed_mesh_3/subdomains.h"

#include <CGAL/Mixed_mesh_3/IO/Read_surface_options.h>

#include <string>
#include <vector>

/// Cuts the surfaces of subdomains where they meet others, so that surfaces that touch in a face, or in a
/// part of a face, have equal facets there: the domain knows those as their interface. Points of different
/// surfaces that are one point, up to rounding, become equal before; edges are split at vertices of others
/// that are on them up to rounding, and a plane face in which surfaces touch up to rounding is triangulated
/// once for all of them. Faces that touch and are not plane, and have other triangles, are not joined. If a
/// surface would not bound a solid any more, all stay as they are, with a warning.
/// \param options how far points may be apart that are one, as where a surface is not closed
void join_contacts(std::vector<Subdomain>& subdomains,
                   const CGAL::Mixed_meshes_3::IO::Read_surface_options& options,
                   std::vector<std::string>& warnings);

/// Takes from each surface what earlier ones have inside, where the surfaces meet: then no two overlap, and
/// their interfaces are equal facets. A subdomain of which nothing is left stays as it is, with a warning.
/// \pre contacts are joined
void take_overlaps(std::vector<Subdomain>& subdomains, std::vector<std::string>& warnings);

/// The surface of the union of all subdomains that are no cavities.
Surface union_of(const std::vector<Subdomain>& subdomains);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_CONTACTS_H
