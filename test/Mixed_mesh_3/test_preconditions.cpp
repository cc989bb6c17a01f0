// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inputs that the manual forbids are detected where CGAL's checks are on; and its limits are allowed.

#undef NDEBUG // on in Release, too
#undef CGAL_NDEBUG

#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/resect.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_fit_criteria_3.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Polyhedral_mixed_mesh_region_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/assertions_behaviour.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/exceptions.h>

#include <boost/core/lightweight_test.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#ifdef CGAL_NO_PRECONDITIONS
#error "this test is of the preconditions"
#endif

namespace {

using namespace CGAL::Mixed_meshes_3;
using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Counts violations that are not detected, or wrong detections, with the line.
#define FORBIDDEN(...) BOOST_TEST_THROWS(__VA_ARGS__, CGAL::Precondition_exception)
#define ALLOWED(...) BOOST_TEST_NO_THROW(__VA_ARGS__)

Mesh tetrahedron()
{
  Mesh mesh;
  for(const Test_point& p : {Test_point(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    mesh.add_vertex(p);
  mesh.add_element(TETRAHEDRON, {0, 1, 2, 3});
  return mesh;
}

void test_criteria()
{
  using Criteria = CGAL::Mixed_mesh_criteria_3;
  FORBIDDEN(Criteria(0));
  FORBIDDEN(Criteria(std::size_t(-1)));
  FORBIDDEN(Criteria(0xFFFFFFFFu));
  ALLOWED(Criteria(1));
  ALLOWED(Criteria(0xFFFFFFFEu));
  Criteria criteria(100);
  for(int level : {-2, 11})
    FORBIDDEN(criteria.base_level(level));
  for(int level : {int(Criteria::automatic), 0, 10})
    ALLOWED(criteria.base_level(level));
  for(double distance : {-1e-9, nan})
    FORBIDDEN(criteria.tolerance(distance));
  for(double distance : {double(Criteria::automatic), 0., 2.})
    ALLOWED(criteria.tolerance(distance));
  for(double share : {-1e-9, nan})
    FORBIDDEN(criteria.grading(share));
  for(double share : {0., 3.})
    ALLOWED(criteria.grading(share));
  for(double share : {-1e-9, 0.51, nan})
    FORBIDDEN(criteria.share_of_bisections(share));
  for(double share : {double(Criteria::automatic), 0., 0.5})
    ALLOWED(criteria.share_of_bisections(share));

  CGAL::Mixed_mesh_optimization_criteria_3 optimization;
  for(double distance : {-1., nan})
    FORBIDDEN(optimization.tolerance(distance));
  for(int rounds : {0, -1})
    FORBIDDEN(optimization.number_of_rounds(rounds));
  for(double cost : {0.99, nan})
    FORBIDDEN(optimization.sliding_threshold(cost));
  ALLOWED(optimization.tolerance(0).number_of_rounds(1).sliding_threshold(1));
  for(double bound : {-1., 0.5, nan})
    FORBIDDEN(optimization.quality_bound(bound));
  ALLOWED(optimization.quality_bound(1).quality_bound(0));

  using Fit_criteria = CGAL::Mixed_mesh_fit_criteria_3;
  Fit_criteria fit;
  FORBIDDEN(fit.number_of_steps(0));
  for(double ratio : {-0.1, 0.5, nan})
    FORBIDDEN(fit.poisson_ratio(ratio));
  for(double factor : {1., nan})
    FORBIDDEN(fit.stiffness_factor(factor));
  for(double stiffness : {0.5, nan})
    FORBIDDEN(fit.maximal_stiffness(stiffness));
  for(double coefficient : {0.5, nan})
    FORBIDDEN(fit.acceptable_aspect_ratio(coefficient));
  FORBIDDEN(fit.number_of_layers(-2));
  ALLOWED(fit.number_of_steps(1).poisson_ratio(0).stiffness_factor(1.01).maximal_stiffness(1));
  ALLOWED(fit.acceptable_aspect_ratio(1).number_of_layers(0).number_of_layers(Fit_criteria::automatic));
}

void test_octree()
{
  using Aligned = Axis_aligned_octree_cell_traits_3;
  FORBIDDEN(Aligned(CGAL::Bbox_3()));
  FORBIDDEN(Aligned(CGAL::Bbox_3(0, 0, 0, 1, 1, 0)));
  FORBIDDEN(Aligned(CGAL::Bbox_3(0, 0, 0, 1, 1, infinity)));
  ALLOWED(Aligned(CGAL::Bbox_3(0, 0, 0, 1, 1, 1e-3)));

  using Rotated = Rotated_octree_cell_traits_3;
  const std::vector<Test_point> none, one{{1, 2, 3}}, points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  using Vector = Test_kernel::Vector_3;
  FORBIDDEN(Rotated(none, Vector(0, 0, 1)));
  FORBIDDEN(Rotated(one, Vector(0, 0, 1)));
  FORBIDDEN(Rotated(points, Vector(0, 0, 0)));
  FORBIDDEN(Rotated(points, Vector(0, infinity, 0)));
  ALLOWED(Rotated(points, Vector(0, 0, -1)));

  internal::Octree octree;
  ALLOWED(octree.split(0));
  FORBIDDEN(octree.split(0)); // no leaf
  internal::Octree::Node_index n = 1;
  while(octree.level(n) < internal::Octree::max_level)
    n = octree.split(n);
  FORBIDDEN(octree.split(n)); // has no center on the lattice
}

template <class Oracle>
void test_surface()
{
  const Test_surface cube = box({0, 0, 0}, {1, 1, 1});
  ALLOWED(Oracle{cube});
  Test_surface open = cube;
  CGAL::Euler::remove_face(halfedge(*faces(open).first, open), open);
  FORBIDDEN(Oracle{open});
  Test_surface quads;
  Test_surface::Vertex_index v[8];
  for(int i = 0; i < 8; ++i)
    v[i] = quads.add_vertex(Test_point(i & 1, i >> 1 & 1, i >> 2));
  for(const auto& q :
      {std::array<int, 4>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
    quads.add_face(v[q[0]], v[q[1]], v[q[2]], v[q[3]]);
  FORBIDDEN(Oracle{quads});
}

void test_regions()
{
  using Ball = CGAL::Ball_mixed_mesh_region_3;
  for(double radius : {0., -1., nan})
    FORBIDDEN(Ball({0, 0, 0}, radius));
  ALLOWED(Ball({0, 0, 0}, 1e-9));
}

void test_mesh()
{
  Mesh mesh = tetrahedron();
  Element_list elements = mesh.elements();
  FORBIDDEN(mesh.assign(mesh.points(), elements, {}));
  FORBIDDEN(mesh.assign(mesh.points(), elements, std::vector<Element_attributes>(2)));
  BOOST_TEST_EQ(mesh.number_of_elements(), 1u); // unchanged
  ALLOWED(mesh.assign(mesh.points(), elements, std::vector<Element_attributes>(1)));
  FORBIDDEN(elements.add(TETRAHEDRON, {0, 1, 2}));
  FORBIDDEN(elements.add(PYRAMID, std::vector<Vertex_index>(6)));
  FORBIDDEN(mesh.add_element(HEXAHEDRON, {0, 1, 2, 3}));
  BOOST_TEST_EQ(elements.size(), 1u);
}

void test_queries()
{
  const Mesh mesh = tetrahedron(), empty;
  using Locator = Element_locator_3<Mesh>;
  const std::vector<Vec3> too_few(3, Vec3{}), enough(4, Vec3{});
  FORBIDDEN(Locator(mesh, too_few));
  ALLOWED(Locator(mesh, enough));
  FORBIDDEN(Locator(empty).nearest(Vec3{}));
  ALLOWED(Locator(empty).locate(Vec3{}));

  FORBIDDEN(histogram(mesh, aspect_ratio_coefficient, {2, 1}));
  ALLOWED(histogram(mesh, aspect_ratio_coefficient, {1, 1, 2}));

  const Test_surface cube = box({0, 0, 0}, {1, 1, 1}), nothing;
  for(double error : {0., -1., nan})
    FORBIDDEN(hausdorff_distance(mesh, cube, error));
  FORBIDDEN(hausdorff_distance(mesh, nothing));
  FORBIDDEN(hausdorff_distance(empty, cube));
  FORBIDDEN(number_of_vertices_off_surface(mesh, nothing));
  ALLOWED(hausdorff_distance(mesh, cube));

  const std::vector<bool> all(1, true), two(2, true);
  FORBIDDEN(resect(mesh, two));
  FORBIDDEN(remaining_mesh(mesh, two));
  FORBIDDEN(cavity_faces(mesh, two));
  Resection_options options;
  options.already_removed = two;
  FORBIDDEN(resect(mesh, all, options));
  FORBIDDEN(resect(mesh, cube, options));
  ALLOWED(resect(mesh, all));
}

} // namespace

int main()
{
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  const auto silent = [](const char*, const char*, const char*, int, const char*) {};
  CGAL::set_error_handler(silent); // what is expected is not printed
  test_criteria();
  test_octree();
  test_surface<CGAL::Polyhedral_mixed_mesh_domain_3>();
  test_surface<CGAL::Polyhedral_mixed_mesh_region_3>();
  test_regions();
  test_mesh();
  test_queries();
  return boost::report_errors();
}
