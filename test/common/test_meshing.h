// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Common parts of the tests of make_mixed_mesh_3(): conditions that hold for any input, and a recording
// visitor.

#ifndef MIXED_MESH_3_TEST_MESHING_H
#define MIXED_MESH_3_TEST_MESHING_H

#include "test_surfaces.h"

#include <CGAL/make_mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

using namespace CGAL::Mixed_meshes_3;
using CGAL::Mixed_mesh_criteria_3;
using CGAL::Mixed_mesh_result_3;
using CGAL::Polyhedral_mixed_mesh_domain_3;
using CGAL::make_mixed_mesh_3;
using Status = CGAL::Mixed_mesh_status;

using Kernel = Test_kernel;
using Point_3 = Test_point;
using Surface = Test_surface;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

// The content of a mesh, in doubles.
struct Content
{
  std::vector<std::array<double, 3>> points;
  std::vector<Element_kind> kinds;
  std::vector<Vertex_index> connectivity;
  std::vector<bool> in_region;
  std::vector<std::pair<Element_index, int>> boundary;

  bool has_same_topology(const Content& c) const
  {
    return kinds == c.kinds && connectivity == c.connectivity && in_region == c.in_region
           && boundary == c.boundary;
  }
  bool operator==(const Content& c) const { return points == c.points && has_same_topology(c); }
};

template <class AnyMesh>
Content content(const AnyMesh& mesh)
{
  Content c;
  for(const auto& p : mesh.points())
    c.points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  c.kinds = mesh.elements().kinds();
  c.connectivity = mesh.elements().connectivity();
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    c.in_region.push_back(mesh.is_in_region(e));
  for(const Face& f : boundary_faces(mesh))
    c.boundary.emplace_back(f.element(), f.local_index());
  return c;
}

// Criteria for the mesh as the octree makes it, its boundary outside the domain.
inline Mixed_mesh_criteria_3 unfitted(std::size_t n)
{
  return Mixed_mesh_criteria_3(n).fit_to_surface(false);
}

// Checks conditions that hold for any input: a valid mesh within the budget, or no mesh.
template <class AnyMesh>
void check(const AnyMesh& mesh, const Mixed_mesh_result_3& result, std::size_t budget)
{
  if(!result.has_mesh()) {
    BOOST_TEST(mesh.is_empty());
    BOOST_TEST_EQ(mesh.number_of_vertices(), 0u);
    return;
  }
  BOOST_TEST(!mesh.is_empty());
  BOOST_TEST_LE(mesh.number_of_vertices(), budget);
  const Mesh_defects d = find_defects(mesh);
  BOOST_TEST(d.conforming() && d.positive() && d.unused_vertices == 0 && d.duplicate_vertices == 0);
  BOOST_TEST_EQ(d.closed_manifold_boundary(), result.status != Status::BOUNDARY_NOT_MANIFOLD);
  BOOST_TEST_GT(volume(mesh), 0);
  if(result.status == Status::SUCCESS && !result.is_lattice_on_surface)
    BOOST_TEST_GE(double(mesh.number_of_vertices()), 0.97 * double(budget));
  BOOST_TEST(result.status != Status::BUDGET_NOT_FILLED || mesh.number_of_vertices() < 0.97 * double(budget));
}

// Limit of the threads of CGAL::Parallel_if_available_tag, as long as the object lives.
class Thread_limit
{
#ifdef CGAL_LINKED_WITH_TBB
  tbb::global_control m_control;

public:
  explicit Thread_limit(std::size_t n) : m_control(tbb::global_control::max_allowed_parallelism, n) {}
#else
public:
  explicit Thread_limit(std::size_t) {}
#endif
};

template <class ConcurrencyTag = CGAL::Sequential_tag, class Domain, class Region>
Mixed_mesh_result_3 run(const Domain& domain, const Region& region, const Mixed_mesh_criteria_3& criteria,
                        Mesh& mesh)
{
  const Mixed_mesh_result_3 result = make_mixed_mesh_3<ConcurrencyTag>(domain, region, criteria, mesh);
  check(mesh, result, criteria.maximal_number_of_vertices());
  return result;
}

// Checks a mesh that is not fitted: every boundary vertex is outside or on the surface, every other vertex
// inside, except by the repair of pinched places.
inline void check_sides(const Mesh& mesh, const Mixed_mesh_result_3& result,
                        const Polyhedral_mixed_mesh_domain_3& domain)
{
  std::vector<bool> is_boundary(mesh.number_of_vertices());
  for(Vertex_index v : boundary_vertices(mesh))
    is_boundary[v] = true;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const bool is_inside = domain.bounded_side(mesh.point(v)) == CGAL::ON_BOUNDED_SIDE;
    BOOST_TEST(!is_inside || !is_boundary[v]);
    BOOST_TEST(is_inside || is_boundary[v] || result.number_of_relabeled_vertices > 0);
  }
}

inline Surface transformed(Surface s, const std::function<Point_3(const Point_3&)>& f)
{
  for(auto v : s.vertices())
    s.point(v) = f(s.point(v));
  return s;
}

// Visitor that notes its calls, and stops when asked for the n-th time.
struct Recording_visitor
{
  std::size_t stop_at = std::numeric_limits<std::size_t>::max();
  std::size_t number_of_questions = 0, number_of_trials = 0, number_of_errors = 0;
  std::vector<std::size_t> sizes; // of the meshes tried
  std::array<std::size_t, number_of_stages> begun{}, ended{};
  int open = -1; // the stage under way

  void begin_stage(Stage s)
  {
    number_of_errors += open != -1;
    open = int(s);
    ++begun[int(s)];
  }
  void end_stage(Stage s)
  {
    number_of_errors += open != int(s);
    open = -1;
    ++ended[int(s)];
  }
  void progress(std::size_t number_of_vertices, std::size_t)
  {
    ++number_of_trials;
    sizes.push_back(number_of_vertices);
  }
  bool go_on() { return number_of_questions++ < stop_at; }
  template <class Mesh>
  void before_fitting(const Mesh&)
  {
  }
};

#endif // MIXED_MESH_3_TEST_MESHING_H
