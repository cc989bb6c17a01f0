// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_LABELED_DOMAIN_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_LABELED_DOMAIN_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The position of a subdomain in the order of a domain: where there is a choice, the earlier one counts.
using Subdomain_rank = std::uint16_t;

/// The rank of the outside, which comes last.
inline constexpr Subdomain_rank outside_rank = Subdomain_rank(-1);

/// The rank of a subdomain; the rank of the outside for an index that is no subdomain's.
inline Subdomain_rank rank_of(const std::vector<Subdomain_index>& indices, Subdomain_index index)
{
  const auto found = std::find(indices.begin(), indices.end(), index);
  return found == indices.end() ? outside_rank : Subdomain_rank(found - indices.begin());
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_LABELED_DOMAIN_H
