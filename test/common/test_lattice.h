// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Octrees and lattice meshes for the tests of their stages, and checks of them in integers.

#ifndef MIXED_MESH_3_TEST_LATTICE_H
#define MIXED_MESH_3_TEST_LATTICE_H

#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Lattice_point.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_regions_3.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

using CGAL::Everywhere_mixed_mesh_region_3;
using CGAL::Mixed_meshes_3::Axis_aligned_octree_cell_traits_3;
using CGAL::Mixed_meshes_3::Element_face;
using CGAL::Mixed_meshes_3::Element_list;
using CGAL::Mixed_meshes_3::Element_view;
using CGAL::Mixed_meshes_3::Lattice_point;
using CGAL::Mixed_meshes_3::Vertex_index;
using CGAL::Mixed_meshes_3::Face_vertices;
using CGAL::Mixed_meshes_3::internal::Located_octree;
using CGAL::Mixed_meshes_3::internal::Octree;

using Aligned_traits = Axis_aligned_octree_cell_traits_3;

// ---- a domain made of labels -------------------------------------------------------------------

inline Located_octree random_octree(const Analytic_domain& domain, const Aligned_traits& traits,
                                    unsigned seed, int base_level, int rounds, unsigned one_in = 12)
{
  static const Everywhere_mixed_mesh_region_3 region;
  std::mt19937 random(seed);
  Located_octree octree(domain, region, traits);
  for(int level = 0; level < base_level; ++level)
    octree.refine(octree.leaves_to_refine(level, false));
  for(int round = 0; round < rounds; ++round) {
    std::vector<Octree::Node_index> chosen;
    for(int level = 0; level < 7; ++level)
      for(Octree::Node_index n : octree.leaves_to_refine(level, true))
        if(random() % one_in == 0)
          chosen.push_back(n);
    octree.refine(chosen);
  }
  return octree;
}

// ---- integers ----------------------------------------------------------------------------------

using Integer = boost::multiprecision::int128_t;

inline Integer determinant(const Lattice_point& a, const Lattice_point& b, const Lattice_point& c,
                           const Lattice_point& d)
{
  Integer m[3][3];
  const Lattice_point* rows[3] = {&b, &c, &d};
  for(int i = 0; i < 3; ++i)
    for(int k = 0; k < 3; ++k)
      m[i][k] = std::int64_t((*rows[i])[k]) - std::int64_t(a[k]);
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
         + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Six times the volume; quadrilaterals are planar here.
inline Integer six_volume(const std::vector<Lattice_point>& points, const Element_view& element)
{
  Integer sum = 0;
  for(int f = 0; f < element.reference().number_of_faces; ++f) {
    const Element_face& face = element.reference().faces[f];
    for(int i = 2; i < face.size; ++i)
      sum -= determinant(points[element[face.vertices[0]]], points[element[face.vertices[i - 1]]],
                         points[element[face.vertices[i]]], points[element[0]]);
  }
  return sum;
}

inline bool is_positive(const std::vector<Lattice_point>& points, const Element_view& element)
{
  for(int c = 0; c < element.reference().number_of_corners; ++c) {
    const auto& i = element.reference().corners[c];
    if(determinant(points[element[i[0]]], points[element[i[1]]], points[element[i[2]]], points[element[i[3]]])
       <= 0)
      return false;
  }
  return true;
}

struct Faces
{
  std::vector<Face_vertices> boundary; // faces of one element only
  std::size_t nonconforming = 0;       // faces of more than two elements, or of two with the same orientation
};

// Finds faces with a map, as plainly as possible.
inline Faces faces_of(const Element_list& elements)
{
  std::map<std::vector<Vertex_index>, std::vector<std::vector<Vertex_index>>> faces;
  for(std::size_t e = 0; e < elements.size(); ++e)
    for(int f = 0; f < elements[e].reference().number_of_faces; ++f) {
      const Element_face& face = elements[e].reference().faces[f];
      std::vector<Vertex_index> v;
      for(int i = 0; i < face.size; ++i)
        v.push_back(elements[e][face.vertices[i]]);
      std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
      std::vector<Vertex_index> key = v;
      std::sort(key.begin(), key.end());
      faces[key].push_back(v);
    }
  Faces result;
  for(auto& [key, sides] : faces) {
    if(sides.size() == 1) {
      const std::vector<Vertex_index>& v = sides[0];
      result.boundary.push_back(v.size() == 3 ? Face_vertices{v[0], v[1], v[2]}
                                              : Face_vertices{v[0], v[1], v[2], v[3]});
      continue;
    }
    std::reverse(sides[1].begin() + 1, sides[1].end());
    result.nonconforming += sides.size() > 2 || sides[0] != sides[1];
  }
  return result;
}

inline bool touch(const Octree& octree, Octree::Node_index a, Octree::Node_index b)
{
  for(int k = 0; k < 3; ++k)
    if(octree.corner(a)[k] > octree.corner(b)[k] + octree.side(b)
       || octree.corner(b)[k] > octree.corner(a)[k] + octree.side(a))
      return false;
  return true;
}

#endif // MIXED_MESH_3_TEST_LATTICE_H
