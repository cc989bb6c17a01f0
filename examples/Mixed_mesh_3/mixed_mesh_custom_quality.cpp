// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A user-defined measure of quality: the volume that the edges at each corner span, relative to their
// lengths.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace mm3 = CGAL::Mixed_meshes_3;
using Mesh = CGAL::Mixed_mesh_3<CGAL::Exact_predicates_inexact_constructions_kernel>;

// Model of MixedMeshQuality_3: (sum e^2 / 3)^1.5 / det(e) of the edges e at the worst corner, 1 at best.
struct Corner_quality
{
  using Points = std::array<mm3::Vec3, 8>;
  double operator()(mm3::Element_kind kind, const Points& p, int vertex, mm3::Vec3& gradient) const
  {
    static const double ideal[] = {std::sqrt(2.), std::sqrt(2.), std::sqrt(4. / 3), 1}; // by Element_kind
    double worst = 1;
    gradient = {0, 0, 0};
    for(int c = 0; c < mm3::reference_elements[kind].number_of_corners; ++c) {
      const auto& v = mm3::reference_elements[kind].corners[c]; // a vertex and its three neighbors
      const mm3::Vec3 e[] = {p[v[1]] - p[v[0]], p[v[2]] - p[v[0]], p[v[3]] - p[v[0]]};
      const double squares = dot(e[0], e[0]) + dot(e[1], e[1]) + dot(e[2], e[2]);
      const double det = determinant(e[0], e[1], e[2]);
      const double cost = det > 0 ? std::pow(squares / 3, 1.5) / det / ideal[kind] : HUGE_VAL;
      if(cost <= worst)
        continue;
      worst = cost;
      gradient = {0, 0, 0}; // for each edge, the corner moves opposite to the neighbor
      for(int i = 0; i < 3; ++i)
        if(vertex == v[0] || vertex == v[i + 1])
          gradient = gradient
                     + (vertex == v[0] ? -cost : cost)
                         * (3 / squares * e[i] - 1 / det * cross(e[(i + 1) % 3], e[(i + 2) % 3]));
    }
    return worst;
  }
  double operator()(mm3::Element_kind kind, const Points& p) const
  {
    mm3::Vec3 unused;
    return (*this)(kind, p, 0, unused);
  }
  bool is_acceptable(double cost) const { return cost < 5; } // called by Algorithm 1 only
};

double cost(const Mesh& mesh, std::size_t e)
{
  const mm3::Element_view element = mesh.element(e);
  Corner_quality::Points p{};
  for(int i = 0; i < element.size(); ++i)
    p[i] = mm3::to_vec3(mesh.point(element[i])) - mm3::to_vec3(mesh.point(element[0]));
  return Corner_quality()(element.kind(), p);
}

int main()
{
  CGAL::Surface_mesh<Mesh::Point_3> brain;
  Mesh mesh;
  if(!mm3::IO::read_closed_surface(CGAL::data_file_path("brain.off"), brain)
     || !CGAL::make_mixed_mesh_3(brain, 660, mesh).has_mesh())
    return EXIT_FAILURE;
  const double before = mm3::quality_statistics(mesh, cost).back().maximum;
  CGAL::optimize_mixed_mesh_3(mesh, brain, Corner_quality(), CGAL::Mixed_mesh_optimization_criteria_3());
  const double after = mm3::quality_statistics(mesh, cost).back().maximum;
  std::cout << "largest cost: " << before << ", optimized " << after << '\n';
  return after < before ? EXIT_SUCCESS : EXIT_FAILURE;
}
