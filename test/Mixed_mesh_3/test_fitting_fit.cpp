// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// fit_mixed_mesh_to_surface() and its stages: solvers, targets; meshes fitted to surfaces that they were made
// for, and to others; each outcome.
//
//   test_fitting_fit [DATA_DIRECTORY]

#include "test_grids.h"

#include <CGAL/fit_mixed_mesh_to_surface.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/fit.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/relax_to_surface.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#ifndef MIXED_MESH_3_DATA_DIR
#define MIXED_MESH_3_DATA_DIR "data"
#endif

namespace test_fitting_fit {

using namespace CGAL::Mixed_meshes_3;
using namespace CGAL::Mixed_meshes_3::internal;
using CGAL::Everywhere_mixed_mesh_region_3;
using CGAL::Mixed_mesh_criteria_3;
using CGAL::Mixed_mesh_fit_criteria_3;
using CGAL::Mixed_mesh_fit_result_3;
using CGAL::Polyhedral_mixed_mesh_domain_3;
using CGAL::fit_mixed_mesh_to_surface;
using Status = CGAL::Mixed_mesh_fit_status;

// ---- helpers -----------------------------------------------------------------------------------

template <class F>
Test_surface mapped(const Test_surface& surface, const F& f)
{
  Test_surface result = surface;
  for(auto v : result.vertices())
    result.point(v) = f(surface.point(v));
  return result;
}

double diagonal(const Test_surface& s)
{
  CGAL::Bbox_3 b;
  for(auto v : s.vertices())
    b += s.point(v).bbox();
  return norm(Vec3{b.x_span(), b.y_span(), b.z_span()});
}

// The distance from a surface, computed without the tree.
double distance(const Test_point& p, const Test_surface& s)
{
  double d = std::numeric_limits<double>::infinity();
  for(auto f : s.faces()) {
    std::vector<Test_point> t;
    for(auto v : vertices_around_face(s.halfedge(f), s))
      t.push_back(s.point(v));
    d = (std::min)(d, CGAL::squared_distance(p, Test_kernel::Triangle_3(t[0], t[1], t[2])));
  }
  return std::sqrt(d);
}

// Checks conditions that hold for any input.
void check(const Mesh& mesh, const Mesh& before, const Test_surface& surface,
           const Mixed_mesh_fit_result_3& result)
{
  BOOST_TEST(find_defects(mesh).positive());
  BOOST_TEST(mesh.elements().connectivity() == before.elements().connectivity());
  const std::vector<bool> is_boundary = is_on_boundary(mesh);
  std::size_t boundary = 0, arrived = 0;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_boundary[v]) {
      ++boundary;
      arrived += distance(mesh.point(v), surface) <= 1e-9 * diagonal(surface);
    }
  BOOST_TEST_EQ(boundary, result.number_of_boundary_vertices);
  BOOST_TEST_LE(result.number_of_arrived_vertices, arrived);
  BOOST_TEST_EQ(result.is_on_surface(), result.number_of_arrived_vertices == boundary);
  BOOST_TEST_EQ(result.status == Status::CAP_REACHED,
                result.is_on_surface() && result.number_of_unacceptable_elements != 0);
}

// Fits, checks, and prints the result.
Mixed_mesh_fit_result_3 fit(const char* what, Mesh& mesh, const Test_surface& surface,
                            const Mixed_mesh_fit_criteria_3& criteria = Mixed_mesh_fit_criteria_3())
{
  const Mesh before = mesh;
  const Mixed_mesh_fit_result_3 result = fit_mixed_mesh_to_surface(mesh,
                                                                   Polyhedral_mixed_mesh_domain_3(surface),
                                                                   criteria);
  check(mesh, before, surface, result);
  const auto arc = quality_statistics(mesh)[number_of_element_kinds];
  std::cout << what << ": status " << int(result.status) << ", " << result.number_of_arrived_vertices
            << " of " << result.number_of_boundary_vertices << " arrived, " << result.number_of_folded_faces
            << " folded, " << result.number_of_solves << " solves, " << result.number_of_halvings
            << " halvings, ARC mean " << arc.mean << ", at most " << arc.maximum << '\n';
  return result;
}

// ---- solvers -----------------------------------------------------------------------------------

using Eigen_matrix = Eigen::SparseMatrix<double>;
using Cgal_solver = CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Eigen_matrix>>;

template <class Solver>
Mesh fitted_with(Solver solver, const Mesh& source, const Test_surface& surface)
{
  Mesh mesh = source;
  const auto result = fit_mixed_mesh_to_surface(mesh, surface,
                                                CGAL::parameters::sparse_linear_solver(std::ref(solver)));
  check(mesh, source, surface, result);
  return mesh;
}

double difference(const Mesh& a, const Mesh& b)
{
  double d = 0;
  for(Vertex_index v = 0; v < a.number_of_vertices(); ++v)
    d = (std::max)(d, norm(position(a, v) - position(b, v)));
  return d;
}

void test_solvers()
{
  const Mesh mesh = grid(4, HEXAHEDRON, 0.1);
  const Test_surface ball = sphere({0.5, 0.5, 0.5}, 0.6, 12);
  const Mesh expected = fitted_with(Simplicial_solver_traits(), mesh, ball);
  Conjugate_gradient_solver_traits gradients;
  gradients.solver().setTolerance(1e-12);
  BOOST_TEST_LT(difference(fitted_with(gradients, mesh, ball), expected), 1e-9);
  BOOST_TEST_LT(difference(fitted_with(Cgal_solver(), mesh, ball), expected), 1e-9);
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
  BOOST_TEST_LT(difference(fitted_with(Cholmod_solver_traits(), mesh, ball), expected), 1e-9);
#endif
  // The default is less exact, but boundary vertices are at the same places as with all other solvers.
  Mesh by_default = mesh;
  fit_mixed_mesh_to_surface(by_default, ball);
  BOOST_TEST_LT(difference(by_default, expected), 1e-2);
  const std::vector<bool> is_boundary = is_on_boundary(mesh);
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_boundary[v])
      BOOST_TEST(position(by_default, v) == position(expected, v));
}

// ---- targets -----------------------------------------------------------------------------------

// Numbers of faces below a quality if vertices go to the closest points of the surface, or to their targets.
struct Folded_faces
{
  std::size_t before, after;
};

Folded_faces folded_faces(const Mesh& mesh, const Test_surface& surface, double quality)
{
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  const std::vector<Face> boundary = boundary_faces(mesh);
  const internal::Surface_reference any_surface(domain);
  const internal::Strata strata(any_surface);
  const std::vector<internal::Stratum> on_boundary(mesh.number_of_vertices(), internal::boundary_stratum);
  const Surface_targets targets = surface_targets(boundary, positions(mesh),
                                                  internal::Surface_projection(any_surface, strata),
                                                  on_boundary);
  std::vector<Vec3> sources, closest;
  std::vector<Vertex_index> numbers(mesh.number_of_vertices());
  for(std::size_t i = 0; i < targets.vertices.size(); ++i) {
    const Vertex_index v = targets.vertices[i];
    numbers[v] = Vertex_index(i);
    sources.push_back(position(mesh, v));
    closest.push_back(to_vec3(domain.closest_point(mesh.point(v))));
    const Vec3& t = targets.positions[i];
    BOOST_TEST_LT(distance({t[0], t[1], t[2]}, surface), 1e-9 * diagonal(surface));
  }
  std::vector<Face_vertices> polygons;
  for(const Face& face : boundary) {
    polygons.push_back(face.vertices());
    for(int i = 0; i < polygons.back().size(); ++i)
      polygons.back()[i] = numbers[polygons.back()[i]];
  }
  const Boundary_folds folds(polygons, sources);
  std::vector<std::uint8_t> is_folded(sources.size());
  BOOST_TEST_EQ(folds.find(targets.positions, 0, is_folded), targets.number_of_folded_faces);
  const Folded_faces result{folds.find(closest, quality, is_folded),
                            folds.find(targets.positions, quality, is_folded)};
  std::cout << "faces of quality below " << quality << ": " << result.before << ", then " << result.after
            << '\n';
  return result;
}

// ---- meshes and surfaces -----------------------------------------------------------------------

Mesh mesh_of(const Test_surface& surface, std::size_t budget)
{
  Mesh mesh;
  CGAL::make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(surface), Everywhere_mixed_mesh_region_3(),
                          Mixed_mesh_criteria_3(budget).fit_to_surface(false), mesh);
  BOOST_TEST(!mesh.is_empty());
  return mesh;
}

Test_surface bent_ellipsoid()
{
  return mapped(sphere({0, 0, 0}, 1, 16), [](const Test_point& p) {
    return Test_point(1.3 * p.x(), 0.7 * p.y() + 0.35 * p.x() * p.x(), 0.85 * p.z());
  });
}

void test_other_surfaces(const Test_surface& brain)
{
  const Mesh ball = mesh_of(sphere({0, 0, 0}, 1, 16), 700);
  Mesh mesh = ball;
  BOOST_TEST(fit("ball to itself", mesh, sphere({0, 0, 0}, 1, 16)).status == Status::SUCCESS);
  mesh = ball;
  BOOST_TEST(fit("ball to bent ellipsoid", mesh, bent_ellipsoid()).is_on_surface());
  mesh = ball;
  BOOST_TEST(fit("ball to box", mesh, box({-1, -0.8, -0.7}, {0.9, 0.8, 0.8})).is_on_surface());
  // The surface is that of another head: the brain, smoother and larger.
  CGAL::Bbox_3 b;
  for(auto v : brain.vertices())
    b += brain.point(v).bbox();
  const Test_surface scaled_brain = mapped(brain, [&](const Test_point& p) {
    return Test_point(2 * (p.x() - (b.xmin)()) / b.x_span() - 1, 2 * (p.y() - (b.ymin)()) / b.y_span() - 1,
                      2 * (p.z() - (b.zmin)()) / b.z_span() - 1);
  });
  mesh = ball;
  BOOST_TEST(fit("ball to brain", mesh, scaled_brain).is_on_surface());
  // Faces fold at closest points, but not at targets.
  const Mesh finer_ball = mesh_of(sphere({0, 0, 0}, 1, 16), 2000);
  for(const Test_surface& surface : {scaled_brain, box({-1, -0.8, -0.7}, {0.9, 0.8, 0.8})}) {
    const Folded_faces folded = folded_faces(finer_ball, surface, 0);
    BOOST_TEST(folded.before > 0);
    BOOST_TEST_EQ(folded.after, 0u);
  }

  // Quadrilateral boundary faces.
  for(Element_kind kind : element_kinds) {
    mesh = grid(5, kind);
    const std::string what = std::string("grid of ") + reference_elements[kind].plural;
    const Test_surface larger_box = box({-0.1, -0.05, -0.1}, {1.1, 1.05, 1.2});
    BOOST_TEST(fit((what + " to box").c_str(), mesh, larger_box).is_on_surface());
    mesh = grid(5, kind);
    // Two of the three vertices around a corner of a pyramid's base pass the third at the cube's edges.
    BOOST_TEST_EQ(fit((what + " to ball").c_str(), mesh, sphere({0.5, 0.5, 0.5}, 0.7, 32)).is_on_surface(),
                  kind != PYRAMID);
  }
}

// ---- each way to end ---------------------------------------------------------------------------

struct Stop_after : Default_visitor
{
  int questions;
  explicit Stop_after(int n) : questions(n) {}
  bool go_on() { return --questions >= 0; }
};

// Solver that solves a number of systems, then no more.
struct Failing_solver : Simplicial_solver_traits
{
  int solves = 1;
  bool factor(const Matrix& matrix, double& denominator)
  {
    return --solves >= 0 && Simplicial_solver_traits::factor(matrix, denominator);
  }
};

void test_statuses()
{
  const Test_surface ball = sphere({0.5, 0.5, 0.5}, 0.7, 12);
  const Mesh cubes = grid(4, HEXAHEDRON);
  Mesh mesh = cubes;
  BOOST_TEST(fit("success", mesh, ball).status == Status::SUCCESS);

  mesh = cubes;
  const auto strict = Mixed_mesh_fit_criteria_3().acceptable_aspect_ratio(1.05).maximal_stiffness(8);
  const Mixed_mesh_fit_result_3 capped = fit("cap", mesh, ball, strict);
  BOOST_TEST(capped.status == Status::CAP_REACHED);
  BOOST_TEST(capped.number_of_unacceptable_elements > 0);

  // A single tetrahedron over a plane can not arrive; it stays as it is, or at least not flat.
  mesh.clear();
  for(const Test_point& p : {Test_point(0, 0, 1.1), {0.3, 0, 1.1}, {0, 0.3, 1.1}, {0, 0, 1.4}})
    mesh.add_vertex(p);
  mesh.add_element(TETRAHEDRON, {0, 1, 2, 3});
  const Mixed_mesh_fit_result_3 flat = fit("tetrahedron to plane", mesh, box({-9, -9, -9}, {9, 9, 1}));
  BOOST_TEST(flat.status == Status::NOT_ALL_ARRIVED);
  BOOST_TEST(flat.number_of_frozen_vertices > 0);
  BOOST_TEST(flat.number_of_halvings > 0);

  mesh = cubes;
  Stop_after visitor(2);
  auto result = fit_mixed_mesh_to_surface(mesh, ball, CGAL::parameters::visitor(std::ref(visitor)));
  BOOST_TEST(result.status == Status::STOPPED);
  BOOST_TEST_EQ(result.number_of_solves, 2u);
  BOOST_TEST(difference(mesh, cubes) > 0); // half of the way
  check(mesh, cubes, ball, result);

  mesh = cubes;
  Failing_solver solver;
  result = fit_mixed_mesh_to_surface(mesh, ball, CGAL::parameters::sparse_linear_solver(std::ref(solver)));
  BOOST_TEST(result.status == Status::SOLVER_FAILED);
  check(mesh, cubes, ball, result);

  for(double bad : {1., std::numeric_limits<double>::quiet_NaN()}) {
    mesh = cubes;
    mesh.points()[0] = Test_point(bad, bad, bad);
    BOOST_TEST(fit_mixed_mesh_to_surface(mesh, ball).status == Status::INVALID_MESH);
    BOOST_TEST_EQ(difference(mesh, cubes) > 0, bad == 1); // nothing else has changed
  }
  mesh.clear();
  mesh.add_vertex({0, 0, 0});
  BOOST_TEST(fit_mixed_mesh_to_surface(mesh, ball).status == Status::EMPTY);
  mesh.add_element(TETRAHEDRON, {0, 1, 2, 3});
  BOOST_TEST(fit_mixed_mesh_to_surface(mesh, ball).status == Status::INVALID_MESH);
}

// ---- options, repetition -----------------------------------------------------------------------

void test_criteria()
{
  const Test_surface ball = sphere({0.5, 0.5, 0.5}, 0.7, 32);
  const Mesh cubes = grid(8, HEXAHEDRON);
  const auto number_of_moved = [&](const Mesh& mesh) {
    std::size_t n = 0;
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      n += position(mesh, v) != position(cubes, v);
    return n;
  };
  for(int layers : {0, 1, 2, 3}) { // each as a cube of cubes less two on each side
    Mesh mesh = cubes;
    const auto result = fit("layers", mesh, ball, Mixed_mesh_fit_criteria_3().number_of_layers(layers));
    const std::size_t inner = std::size_t(7 - 2 * layers);
    BOOST_TEST_LE(number_of_moved(mesh), 729 - inner * inner * inner);
    BOOST_TEST(layers < 2 || result.is_on_surface());
  }
  for(int steps : {1, 3, 10}) {
    Mesh mesh = cubes;
    const auto result = fit("steps", mesh, ball, Mixed_mesh_fit_criteria_3().number_of_steps(steps));
    BOOST_TEST_LE(std::size_t(steps), result.number_of_solves);
    BOOST_TEST(result.is_on_surface());
  }
  // The result is repeated; far from the origin and in another unit nearly so, if no two points are equally
  // close.
  const Test_surface other_ball = sphere({0.47, 0.52, 0.51}, 0.7, 32);
  Mesh first = cubes, second = cubes, other = cubes;
  fit("first", first, other_ball);
  fit("second", second, other_ball);
  BOOST_TEST_EQ(difference(first, second), 0);
  const auto far = [](const Test_point& p) {
    return Test_point(1e6 + 1000 * p.x(), 1000 * p.y() - 1e6, 1000 * p.z());
  };
  for(Test_point& p : other.points())
    p = far(p);
  fit("far", other, mapped(other_ball, far));
  for(Test_point& p : first.points())
    p = far(p);
  BOOST_TEST_LT(difference(first, other), 1e-3);
}

// ---- the brain ---------------------------------------------------------------------------------

void test_brain(const Mesh& source, const Test_surface& brain)
{
  const Folded_faces folded = folded_faces(source, brain, Boundary_folds::least_quality);
  BOOST_TEST(folded.before > 0);
  BOOST_TEST_EQ(folded.after, 0u);
  Mesh mesh = source;
  const Mixed_mesh_fit_result_3 result = fit("brain", mesh, brain);
  BOOST_TEST(result.is_on_surface()); // some elements are left to the optimization that follows in the mesher
  const auto rows = quality_statistics(mesh);
  BOOST_TEST_LE(rows[number_of_element_kinds].mean, 1.7);
  BOOST_TEST_LE(rows[number_of_element_kinds].maximum, 8);
  BOOST_TEST_LE(rows[TETRAHEDRON].mean, 1.8);
  BOOST_TEST(find_defects(mesh).none());
}

// Layers of elements around a corner of a grid, whose elements are cubes: the largest coordinate. Other
// elements, which are not connected with the corner, are in no layer.
void test_layers()
{
  constexpr int n = 4;
  Mesh mesh = grid(n, CGAL::Mixed_meshes_3::HEXAHEDRON);
  const std::size_t number = mesh.number_of_vertices();
  for(std::size_t v = 0; v < 8; ++v)
    mesh.add_vertex(Test_point(v & 1 ? 3 : 2, v & 2 ? 3 : 2, v & 4 ? 3 : 2));
  std::vector<Vertex_index> other;
  for(std::size_t v : {0, 1, 3, 2, 4, 5, 7, 6})
    other.push_back(Vertex_index(number + v));
  mesh.add_element(CGAL::Mixed_meshes_3::HEXAHEDRON, other);
  const std::vector<int> layers = layers_from({0}, mesh.elements(), mesh.number_of_vertices());
  for(std::size_t v = 0; v < number; ++v) {
    const Vec3 p = to_vec3(mesh.point(Vertex_index(v)));
    BOOST_TEST_EQ(layers[v], int(std::lround(n * (std::max)({p[0], p[1], p[2]}))));
  }
  for(std::size_t v = number; v < layers.size(); ++v)
    BOOST_TEST_EQ(layers[v], int(Mixed_mesh_fit_criteria_3::all_layers));
}

// Algorithm 1 without its interface: a cube that is too small arrives on its surface, and one that the caller
// stops stays valid.
void test_algorithm()
{
  const Test_surface surface = box(Test_point(0, 0, 0), Test_point(1, 1, 1));
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  const Surface_reference<Polyhedral_mixed_mesh_domain_3> any(domain);
  Mesh start = grid(3, CGAL::Mixed_meshes_3::HEXAHEDRON);
  for(auto& p : start.points())
    p = Test_point(0.05 + 0.9 * p.x(), 0.05 + 0.9 * p.y(), 0.05 + 0.9 * p.z());
  const Mixed_mesh_fit_criteria_3 criteria;
  for(bool goes_on : {true, false}) {
    Core_mesh mesh = as_core_mesh(start);
    CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<CGAL::Eigen_sparse_symmetric_matrix<double>::EigenType>>
      solver;
    const Mixed_mesh_fit_result_3 result = fit(mesh, any, Aspect_ratio_bound(7), criteria, solver,
                                               [goes_on] { return goes_on; });
    BOOST_TEST(result.status == (goes_on ? Status::SUCCESS : Status::STOPPED));
    BOOST_TEST_EQ(result.number_of_boundary_vertices, 64u - 8u);
    BOOST_TEST_EQ(result.number_of_arrived_vertices, goes_on ? 56u : 0u);
    BOOST_TEST(find_defects(mesh).none());
    for(Vertex_index v : boundary_vertices(mesh))
      BOOST_TEST_EQ(distance(mesh.point(v), surface) < 1e-9, goes_on);
  }
}

int run(int argc, char* argv[])
{
  const std::string data = argc > 1 ? argv[1] : MIXED_MESH_3_DATA_DIR;
  Test_surface brain, region;
  BOOST_TEST(CGAL::IO::read_polygon_mesh(data + "/brain.off", brain));
  BOOST_TEST(CGAL::IO::read_polygon_mesh(data + "/region.off", region));
  Mesh mesh;
  CGAL::make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(brain), CGAL::Polyhedral_mixed_mesh_region_3(region),
                          Mixed_mesh_criteria_3(660).fit_to_surface(false), mesh);

  test_layers();
  test_algorithm();
  test_solvers();
  test_brain(mesh, brain);
  test_other_surfaces(brain);
  test_statuses();
  test_criteria();
  return boost::report_errors();
}

} // namespace test_fitting_fit
