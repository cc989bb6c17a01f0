// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies that are wanted, without the others.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_DROP_COMPONENTS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_DROP_COMPONENTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Read_surface_options.h>
#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/note_repair.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/orient_components.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/polygon_soup.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// The component of the body that each component belongs to: its own, or for a cavity the one around it.
inline std::vector<std::size_t> bodies_of(const std::vector<Surface_component>& components)
{
  std::vector<std::size_t> bodies(components.size());
  std::iota(bodies.begin(), bodies.end(), std::size_t(0));
  const auto is_smaller = [&components](std::size_t c, std::size_t d) {
    return std::abs(components[c].volume) < std::abs(components[d].volume);
  };
  for(std::size_t c = 0; c < components.size(); ++c)
    if(components[c].is_cavity())
      bodies[c] = *std::min_element(components[c].around.begin(), components[c].around.end(), is_smaller);
  return bodies;
}

// Drops components as the options say: bodies, without their cavities, and cavities of too little volume, and
// the cavities of dropped bodies.
inline Component_counts drop_components(const std::string& name, const Read_surface_options& options,
                                        const Component_counts& counts, Surface& mesh, Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  const auto component_map = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);
  const std::size_t n = PMP::connected_components(mesh, component_map);
  std::vector<Surface_component> components = components_of(mesh, n, component_map);
  nest_components(mesh, {}, components);
  const std::vector<std::size_t> bodies = bodies_of(components);
  std::vector<double> volumes(n, 0); // of bodies; positive, as faces are oriented outwards
  for(std::size_t c = 0; c < n; ++c)
    volumes[bodies[c]] += components[c].volume;
  const std::size_t largest = std::size_t(std::max_element(volumes.begin(), volumes.end()) - volumes.begin());

  std::vector<std::size_t> kept;
  Component_counts kept_counts{0, 0, counts.reversed};
  double largest_dropped = 0;
  for(std::size_t c = 0; c < n; ++c) {
    const std::size_t body = bodies[c];
    const double volume = components[c].is_cavity() ? -components[c].volume : volumes[c];
    if((options.keep_largest && body != largest) || volumes[body] < options.least_volume
       || volume < options.least_volume) {
      largest_dropped = (std::max)(largest_dropped, volume);
      continue;
    }
    kept.push_back(c);
    ++kept_counts.all;
    kept_counts.cavities += components[c].is_cavity();
  }
  if(kept.empty())
    refuse(name, "no component has a volume of " + number_text(options.least_volume)
                   + " or more, the largest has " + number_text(volumes[largest]));
  if(kept.size() == n)
    return counts;
  note_repair("dropped " + std::to_string(n - kept.size()) + " of " + std::to_string(n)
                + " components, the largest of volume " + number_text(largest_dropped),
              input);
  PMP::keep_connected_components(mesh, kept, component_map);
  mesh.collect_garbage();
  return kept_counts;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_DROP_COMPONENTS_H
