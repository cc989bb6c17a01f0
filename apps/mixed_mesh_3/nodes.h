// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A budget in nodes: nodes of order 2 are vertices and edges, whose ratio only a mesh tells.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_NODES_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_NODES_H

#include "core/types.h"

#include <cstddef>
#include <vector>

/// The number of nodes of a file with elements of that order.
std::size_t number_of_nodes(const Mesh& mesh, int order);

/// The counts of a mesh that was made for a budget in nodes.
struct Node_counts
{
  std::size_t vertices, nodes;
};

/// The vertex budget that the first mesh gets for a budget in nodes.
std::size_t first_vertex_budget(std::size_t nodes, int order);

/// Whether a mesh has at most that many nodes, and nearly as many.
bool fills_node_budget(const Node_counts& counts, std::size_t nodes);

/// The vertex budget of the next mesh, after at least one: the number of nodes is taken to be proportional to
/// that of vertices, or, after two meshes, to a power of that.
std::size_t next_vertex_budget(const std::vector<Node_counts>& meshes, std::size_t nodes);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_NODES_H
