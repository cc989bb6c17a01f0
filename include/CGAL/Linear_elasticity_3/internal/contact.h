// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Selection of the closed contacts of an elastic body with a wall.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTACT_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTACT_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/internal/Elastic_supports.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The force that a closed contact needs: positive if the wall pushes.
/// \param reaction forces of all supports, three components for each vertex: internal forces minus loads
inline double contact_force(const Elastic_supports& supports, Vertex_index v, const Contact& contact,
                            const Eigen::VectorXd& reaction)
{
  const Vec3 d = supports.direction_of_contact(v, contact.normal);
  const Eigen::Index i = 3 * Eigen::Index(v);
  return d == Vec3{} ? 0
                     : -dot(d, Vec3{reaction[i], reaction[i + 1], reaction[i + 2]}) / dot(d, contact.normal);
}

/*!
The next step of the primal-dual active set strategy (Hintermueller, Ito, Kunisch: "The primal-dual active set
strategy as a semismooth Newton method", 2002): contacts that would have to pull open, vertices beyond their
wall close. When nothing changes, the state is the only solution, as the energy is convex.

\param displacements the equilibrium with the current contacts
\param reaction forces of all supports: internal forces minus loads
\param scale scale of forces
\param tolerance relative tolerance of forces and displacements
\param all_at_once whether all contacts may change; else only the worst contact changes, so that cycles end
\return whether a contact has changed
*/
inline bool update_contacts(Elastic_supports& supports, const Eigen::VectorXd& displacements,
                            const Eigen::VectorXd& reaction, double scale, double tolerance, bool all_at_once)
{
  const double size = displacements.lpNorm<Eigen::Infinity>();
  std::vector<std::pair<Vertex_index, double>> wrong; // vertices and their relative errors
  for(const auto& [v, contact] : supports.contacts()) {
    if(!supports.is_kept(v) || supports.direction_of_contact(v, contact.normal) == Vec3{})
      continue;
    const Eigen::Index i = 3 * Eigen::Index(v);
    const Vec3 u{displacements[i], displacements[i + 1], displacements[i + 2]};
    const double excess = contact.is_closed ? -contact_force(supports, v, contact, reaction) / scale
                                            : (dot(u, contact.normal) - contact.gap) / size;
    if(excess > tolerance) // not if the scale is zero
      wrong.emplace_back(v, excess);
  }
  if(!all_at_once && !wrong.empty())
    wrong = {*std::max_element(wrong.begin(), wrong.end(),
                               [](const auto& a, const auto& b) { return a.second < b.second; })};
  for(const auto& w : wrong)
    supports.set_closed(w.first, !supports.contacts().at(w.first).is_closed);
  return !wrong.empty();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTACT_H
