// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Basic parts: vectors, keys of lattice points, the parallel loop.

#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/Lattice_point.h>
#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <boost/core/lightweight_test.hpp>

#include <cmath>
#include <cstddef>
#include <random>
#include <thread>
#include <type_traits>
#include <vector>

namespace test_base {

using CGAL::Mixed_meshes_3::Element_index;
using CGAL::Mixed_meshes_3::Vertex_index;
using CGAL::Mixed_meshes_3::Lattice_point;
using CGAL::Mixed_meshes_3::Vec3;
using CGAL::Mixed_meshes_3::internal::Octree;
using CGAL::Mixed_meshes_3::internal::lattice_key;
using CGAL::Mixed_meshes_3::internal::parallel_for;

// Vectors of small integers, so that all results are exact. Operators are found without a using-declaration.
void test_vectors()
{
  std::mt19937 random(3);
  const auto any = [&] {
    Vec3 v;
    for(double& x : v)
      x = double(random() % 41) - 20;
    return v;
  };
  BOOST_TEST(Vec3{} == Vec3(0, 0, 0));
  for(int repeat = 0; repeat < 100; ++repeat) {
    const Vec3 a = any(), b = any(), c = any();
    BOOST_TEST(a + b - b == a && a - a == Vec3{});
    BOOST_TEST(2. * a == a + a);
    BOOST_TEST_EQ(dot(a, b + c), dot(a, b) + dot(a, c));
    BOOST_TEST_EQ(dot(cross(a, b), a), 0.);
    BOOST_TEST(cross(a, b) + cross(b, a) == Vec3{});
    BOOST_TEST_EQ(dot(cross(a, b), cross(a, b)), dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b)); // Lagrange
    BOOST_TEST_EQ(determinant(a, b, c), determinant(b, c, a));
    BOOST_TEST_EQ(determinant(a, b, c), dot(a, cross(b, c)));
  }
  BOOST_TEST_EQ(norm(Vec3(2, -3, 6)), 7.);
  BOOST_TEST(cross(Vec3(1, 0, 0), Vec3(0, 1, 0)) == Vec3(0, 0, 1));
}

// A lazy number is rounded to the nearest double, independently of earlier uses of the number.
void test_rounding()
{
  using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  const auto third = [] { return Exact_kernel::FT(1) / 3; };
  const Exact_kernel::FT fresh = third(), asked = third();
  CGAL::to_double(asked);
  CGAL::exact(asked);
  BOOST_TEST_EQ(CGAL::Mixed_meshes_3::rounded(fresh), CGAL::Mixed_meshes_3::rounded(asked));
  BOOST_TEST(CGAL::Mixed_meshes_3::to_vec3(Exact_kernel::Point_3(1, 2, 3)) == Vec3(1, 2, 3));
}

void test_lattice_key()
{
  std::mt19937 random(3);
  std::vector<Lattice_point> points;
  for(int i = 0; i < 300; ++i) {
    Lattice_point p;
    for(std::uint32_t& c : p)
      c = random() % 4 == 0 ? Octree::root_side * (random() % 2) : random() % (Octree::root_side + 1);
    points.push_back(p);
  }
  for(const Lattice_point& p : points)
    for(const Lattice_point& q : points)
      BOOST_TEST_EQ(lattice_key(p) < lattice_key(q), p < q);
}

// Each number once, whatever the number of threads.
void test_parallel_for()
{
  for(std::size_t n : {0, 1, 511, 512, 1024, 5000})
    for(unsigned threads : {1, 2, 3, 7, 100}) {
      std::vector<int> calls(n, 0);
      parallel_for(n, threads, [&](std::size_t i) { ++calls[i]; });
      BOOST_TEST(calls == std::vector<int>(n, 1));
    }
  // Few calls are not worth a thread.
  std::vector<std::thread::id> ids(600);
  parallel_for(ids.size(), 8, [&](std::size_t i) { ids[i] = std::this_thread::get_id(); });
  BOOST_TEST(ids == std::vector<std::thread::id>(600, std::this_thread::get_id()));
}

void test_concurrency_tags()
{
  using CGAL::Mixed_meshes_3::internal::number_of_threads;
  BOOST_TEST_EQ(number_of_threads<CGAL::Sequential_tag>(), 1u);
#ifdef CGAL_LINKED_WITH_TBB
  for(std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    BOOST_TEST_EQ(number_of_threads<CGAL::Parallel_tag>(), threads);
  }
#else
  BOOST_TEST_EQ(number_of_threads<CGAL::Parallel_if_available_tag>(), 1u);
#endif
}

// An index converts to and from integers, but not to an index of another kind.
static_assert(
  std::is_convertible_v<std::size_t, Vertex_index> && std::is_convertible_v<Vertex_index, std::size_t>);
static_assert(!std::is_convertible_v<Element_index, Vertex_index>);
static_assert(!std::is_constructible_v<Vertex_index, Element_index>);
static_assert(!std::is_assignable_v<Vertex_index&, Element_index>);
static_assert(sizeof(Vertex_index) == 4 && std::is_trivially_copyable_v<Vertex_index>);

void test_index()
{
  Vertex_index v = 3;
  BOOST_TEST_EQ(v++, 3u);
  BOOST_TEST_EQ(++v, 5u);
  BOOST_TEST_EQ(--v, 4u);
  BOOST_TEST_EQ(Vertex_index{}, 0u);
}

int run(int, char*[])
{
  test_vectors();
  test_rounding();
  test_lattice_key();
  test_parallel_for();
  test_concurrency_tags();
  test_index();
  return boost::report_errors();
}

} // namespace test_base
