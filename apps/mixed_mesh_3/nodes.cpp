// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/nodes.h"

#include <CGAL/Mixed_mesh_3/internal/elements/Middle_nodes.h>
#include <CGAL/Mixed_mesh_criteria_3.h>

#include <algorithm>
#include <cmath>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

std::size_t at_least_1(double vertices) { return std::size_t((std::max)(1., vertices)); }

} // namespace

std::size_t number_of_nodes(const Mesh& mesh, int order)
{
  const std::size_t n = mesh.number_of_vertices();
  return order == 1 ? n : n + mm3::internal::quadratic_connectivity(mesh.elements(), n).ends.size();
}

std::size_t first_vertex_budget(std::size_t nodes, int order)
{
  constexpr double nodes_per_vertex = 6.2; // brains and parts: 5.5 to 7
  return order == 1 ? nodes : at_least_1(double(nodes) / nodes_per_vertex);
}

bool fills_node_budget(const Node_counts& counts, std::size_t nodes)
{
  return counts.nodes <= nodes
         && double(counts.nodes) >= CGAL::Mixed_mesh_criteria_3::full_share * double(nodes);
}

std::size_t next_vertex_budget(const std::vector<Node_counts>& meshes, std::size_t nodes)
{
  const Node_counts &last = meshes.back(), &before = meshes[meshes.size() > 1 ? meshes.size() - 2 : 0];
  // Nodes aimed at: a mesh may have more nodes a vertex than the last, or fill its budget less.
  const double aim = (last.nodes <= nodes ? 0.995 : 0.985) * double(nodes);
  const auto logarithm = [](std::size_t a, std::size_t b) { return std::log(double(a) / double(b)); };
  double power = 1; // of the number of vertices, which the number of nodes is proportional to
  if(last.vertices != before.vertices && last.nodes != before.nodes)
    power = std::clamp(logarithm(last.nodes, before.nodes) / logarithm(last.vertices, before.vertices), 0.8,
                       1.25);
  return at_least_1(double(last.vertices) * std::pow(aim / double(last.nodes), 1 / power));
}
