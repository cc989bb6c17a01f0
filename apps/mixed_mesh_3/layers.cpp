// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/layers.h"

#include "core/messages.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace {

// Edges of a layer, in its thickness, with which all checks hold: spherical layers around a ball of 90 mm
// take 8,000 vertices if they are 2 mm thick, 2,000 if 4, 700 if 6, 250 if 12 mm.
constexpr double longest_edge = 2.7;

// The vertices at a surface of some thinness, which are the corners of equilateral triangles.
double vertices_for(double thinness)
{
  const double area = std::sqrt(3.) / 2; // for each vertex, in squared edges
  return thinness / (area * longest_edge * longest_edge);
}

} // namespace

std::vector<Layer> layers_of(const std::vector<Subdomain>& subdomains)
{
  std::vector<Layer> layers;
  for(const Subdomain& s : subdomains) {
    if(s.index == 0 || !s.visible_volume || !(*s.visible_volume > 0))
      continue;
    const double thickness = 2 * *s.visible_volume / s.visible_area;
    layers.push_back({s.name, thickness, vertices_for(s.visible_area / (thickness * thickness))});
  }
  return layers;
}

std::vector<Layer> layers_of(const Label_image& image, const std::vector<Voxel_selection>& labels,
                             const std::vector<std::string>& names)
{
  std::vector<Layer> layers;
  const std::vector<CGAL::Mixed_meshes_3::Label_thickness_3> thickness = image.thickness_of(labels);
  for(std::size_t l = 0; l < thickness.size(); ++l)
    if(l == 0 || thickness[l].volume > 0)
      layers.push_back({l == 0 ? "what is between them" : names[l - 1], l == 0 ? 0 : thickness[l].thickness(),
                        vertices_for(thickness[l].thinness)});
  return layers;
}

void check_layers(const std::vector<Layer>& layers, const Meshing_options& o,
                  std::vector<std::string>& warnings)
{
  // Share of the vertices: with half of them, volumes of three spherical layers are 8 % off, with a quarter a
  // quarter, or nothing is left; a cortex cannot have less than half of them without another topology.
  constexpr double least_share = 0.4, most_told = 1e12;
  if(layers.size() < 2 || o.nodes > 0 || o.fewest_vertices || o.no_simplification
     || o.fit() != Fit::OPTIMIZATION)
    return;
  double needed = 0;
  const Layer* thinnest = nullptr;
  for(const Layer& layer : layers) {
    needed += layer.vertices;
    if(layer.thickness > 0 && (thinnest == nullptr || layer.vertices > thinnest->vertices))
      thinnest = &layer;
  }
  if(double(o.vertices) >= needed || thinnest == nullptr)
    return;
  const std::string text = o.budget() + ": few for the layers of " + o.surface + ", which take about "
                           + std::to_string(100 * std::size_t(std::ceil((std::min)(needed, most_told) / 100)))
                           + " vertices: " + thinnest->name + " is " + rounded(thinnest->thickness)
                           + (o.is_in_patient_space() ? " mm" : "") + " thick on average";
  if(double(o.vertices) < least_share * needed && !o.best_effort)
    throw std::runtime_error(
      text + ", and would be lost; --best-effort goes on"
      + (o.label_choice != Label_choice::NONE ? ", --merge joins it to another one" : ""));
  warnings.push_back(text);
}
