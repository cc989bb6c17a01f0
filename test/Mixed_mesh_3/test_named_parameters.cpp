// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `vertex_point_map` is obeyed wherever a function takes a surface: with a map that puts a surface elsewhere,
// the result is that of a surface which is there.

#include "test_surfaces.h"

#include <CGAL/fit_mixed_mesh_to_surface.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>
#include <CGAL/simplify_mixed_mesh_3.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/core/lightweight_test.hpp>

#include <cstddef>

namespace test_named_parameters {

using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;
using CGAL::parameters::vertex_point_map;

// A point scaled by two, and elsewhere; the same in doubles as in the map.
Test_point moved(const Test_point& p) { return {2 * p.x() + 5, 2 * p.y(), 2 * p.z() - 3}; }

// A surface at a wrong place, with the map to the right place; and another surface at the right place.
struct Moved_surface
{
  Test_surface surface, expected;
  Test_surface::Property_map<Test_surface::Vertex_index, Test_point> map;

  explicit Moved_surface(const Test_surface& s) : surface(s), expected(s)
  {
    map = surface.add_property_map<Test_surface::Vertex_index, Test_point>("moved").first;
    for(auto v : surface.vertices()) {
      map[v] = moved(surface.point(v));
      expected.point(v) = map[v];
    }
  }
};

bool is_same(const Mesh& a, const Mesh& b)
{
  bool result = !a.is_empty() && a.points() == b.points() && a.elements().kinds() == b.elements().kinds()
                && a.elements().connectivity() == b.elements().connectivity();
  for(std::size_t e = 0; result && e < a.number_of_elements(); ++e)
    result = a.is_in_region(e) == b.is_in_region(e);
  return result;
}

const Moved_surface domain(sphere({0, 0, 0}, 1, 12)), region(sphere({0.4, 0.3, 0.2}, 0.3, 8));
constexpr std::size_t budget = 300;

// Tests maps of both surfaces, of one of them, of none.
void test_make()
{
  Mesh expected, mesh;
  CGAL::make_mixed_mesh_3(domain.expected, region.expected, budget, expected);
  BOOST_TEST(!expected.is_empty());

  CGAL::make_mixed_mesh_3(domain.surface, region.surface, budget, mesh, vertex_point_map(domain.map),
                          vertex_point_map(region.map));
  BOOST_TEST(is_same(mesh, expected));
  CGAL::make_mixed_mesh_3(domain.surface, region.expected, budget, mesh, vertex_point_map(domain.map));
  BOOST_TEST(is_same(mesh, expected));
  CGAL::make_mixed_mesh_3(domain.expected, region.surface, budget, mesh, CGAL::parameters::default_values(),
                          vertex_point_map(region.map));
  BOOST_TEST(is_same(mesh, expected));

  CGAL::make_mixed_mesh_3(domain.surface, region.surface, budget, mesh);
  BOOST_TEST(!mesh.is_empty() && !is_same(mesh, expected));
}

// Tests the mesh as the octree makes it, fitted to the surface.
template <class Carry>
void test_carried(const Carry& carry)
{
  Mesh start;
  CGAL::make_mixed_mesh_3(CGAL::Polyhedral_mixed_mesh_domain_3(domain.expected),
                          CGAL::Everywhere_mixed_mesh_region_3(),
                          CGAL::Mixed_mesh_criteria_3(budget).fit_to_surface(false), start);
  Mesh expected = start, mesh = start;
  carry(expected, domain.expected, CGAL::parameters::default_values());
  BOOST_TEST(!is_same(expected, start));
  carry(mesh, domain.surface, vertex_point_map(domain.map));
  BOOST_TEST(is_same(mesh, expected));
}

int run(int, char*[])
{
  test_make();
  test_carried([](Mesh& mesh, const Test_surface& surface, const auto& np) {
    BOOST_TEST(CGAL::optimize_mixed_mesh_3(mesh, surface, np).status
               == CGAL::Mixed_mesh_optimization_status::SUCCESS);
  });
  test_carried([](Mesh& mesh, const Test_surface& surface, const auto& np) {
    BOOST_TEST(CGAL::simplify_mixed_mesh_3(mesh, surface, 0, np).status
               == CGAL::Mixed_mesh_simplification_status::SUCCESS);
  });
  test_carried([](Mesh& mesh, const Test_surface& surface, const auto& np) {
    BOOST_TEST(CGAL::fit_mixed_mesh_to_surface(mesh, surface, np).is_on_surface());
  });
  return boost::report_errors();
}

} // namespace test_named_parameters
