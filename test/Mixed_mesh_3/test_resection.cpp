// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Usage: test_resect [data directory].

#include "test_meshes.h"
#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/extract_subdomains.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/resect.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#ifndef MIXED_MESH_3_DATA_DIR
#define MIXED_MESH_3_DATA_DIR "data"
#endif

namespace test_resection {

using namespace CGAL::Mixed_meshes_3;
using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;
using Set = std::vector<bool>;
using Face_key = std::array<Vertex_index, 4>;

// Statistics of the tests, to make sure that they are hard enough.
struct Tally
{
  std::size_t runs = 0, repaired = 0, restored = 0, removed = 0, floating = 0;
  double asked_volume = 0, changed_volume = 0; // relative to the mesh's; changed: by the repair
} tally;

Mesh grid(int n, Element_kind kind)
{
  Mesh mesh = grid_of_cells<Mesh>(n, kind, [](double x, double y, double z) { return Test_point(x, y, z); });
  return mesh;
}

Set set_of(const Mesh& mesh, const std::vector<Element_index>& elements)
{
  Set set(mesh.number_of_elements(), false);
  for(Element_index e : elements)
    set[e] = true;
  return set;
}

Set united(Set a, const Set& b)
{
  for(std::size_t e = 0; e < b.size(); ++e)
    a[e] = a[e] || b[e];
  return a;
}

std::size_t count(const Set& set) { return std::size_t(std::count(set.begin(), set.end(), true)); }

double volume_of(const Mesh& mesh, const Set& set)
{
  double sum = 0;
  for(std::size_t e = 0; e < set.size(); ++e)
    if(set[e])
      sum += volume(mesh, e);
  return sum;
}

bool is_close(double a, double b, double scale) { return std::abs(a - b) <= 1e-12 * scale; }

Face_key face_key(const Mesh& mesh, std::size_t e, int f)
{
  Face_key key = Face(mesh.elements(), Element_index(e), f).vertices().padded();
  std::sort(key.begin(), key.end());
  return key;
}

// Sets of elements connected across faces, of elements not in `without`: found independently of the tested
// code, by sorting all faces.
std::vector<std::vector<Element_index>> components(const Mesh& mesh, const Set& without)
{
  std::vector<std::pair<Face_key, Element_index>> faces;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    for(int f = 0; !without[e] && f < mesh.element(e).reference().number_of_faces; ++f)
      faces.emplace_back(face_key(mesh, e, f), e);
  std::sort(faces.begin(), faces.end());
  std::vector<Element_index> root(mesh.number_of_elements());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](Element_index e) {
    while(root[e] != e)
      e = root[e] = root[root[e]];
    return e;
  };
  for(std::size_t i = 1; i < faces.size(); ++i)
    if(faces[i].first == faces[i - 1].first) {
      const Element_index a = find(faces[i].second), b = find(faces[i - 1].second);
      root[(std::max)(a, b)] = (std::min)(a, b);
    }
  std::vector<std::vector<Element_index>> result;
  std::vector<std::size_t> number(mesh.number_of_elements());
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(!without[e]) {
      if(find(e) == e) {
        number[e] = result.size();
        result.emplace_back();
      }
      result[number[find(e)]].push_back(e);
    }
  return result;
}

// Checks the remaining mesh, and the surface of the cavity.
void check_remaining_mesh(const Mesh& mesh, const Set& is_removed)
{
  std::vector<Vertex_index> vertex_map;
  std::vector<Element_index> element_map;
  const Mesh remaining = remaining_mesh(mesh, is_removed, &vertex_map, &element_map);
  BOOST_TEST(find_defects(remaining).none());
  BOOST_TEST_EQ(remaining.number_of_elements() + count(is_removed), mesh.number_of_elements());
  BOOST_TEST_EQ(vertex_map.size(), remaining.number_of_vertices());
  BOOST_TEST_EQ(element_map.size(), remaining.number_of_elements());
  BOOST_TEST(std::is_sorted(vertex_map.begin(), vertex_map.end()));
  bool is_same = true;
  for(std::size_t e = 0; e < element_map.size(); ++e) {
    const Element_view element = remaining.element(e), origin = mesh.element(element_map[e]);
    is_same = is_same && !is_removed[element_map[e]] && element.kind() == origin.kind()
              && remaining.attributes(e) == mesh.attributes(element_map[e]);
    for(int i = 0; i < element.size(); ++i)
      is_same = is_same && vertex_map[element[i]] == origin[i]
                && remaining.point(element[i]) == mesh.point(origin[i]);
  }
  BOOST_TEST(is_same);

  // Boundary faces are either old ones or at the cavity.
  const auto handle = [](const Face& f) { return std::make_pair(f.element(), f.local_index()); };
  std::set<std::pair<Element_index, int>> old, cavity, all;
  for(const auto& f : boundary_faces(mesh))
    old.insert(handle(f));
  std::set<Face_key> faces_of_removed;
  for(std::size_t e = 0; e < is_removed.size(); ++e)
    for(int f = 0; is_removed[e] && f < mesh.element(e).reference().number_of_faces; ++f)
      faces_of_removed.insert(face_key(mesh, e, f));
  const auto faces = cavity_faces(mesh, is_removed);
  bool is_sorted = true, is_inner = true;
  for(const auto& f : faces) {
    is_sorted = is_sorted && (cavity.empty() || *cavity.rbegin() < handle(f));
    cavity.insert(handle(f));
    is_inner = is_inner && !is_removed[f.element()] && old.count(handle(f)) == 0
               && faces_of_removed.count(face_key(mesh, f.element(), f.local_index())) == 1;
  }
  BOOST_TEST(is_sorted && is_inner);
  std::size_t number_of_old_faces = 0;
  bool is_covered = true;
  for(const auto& f : boundary_faces(remaining)) {
    const std::pair<Element_index, int> origin(element_map[f.element()], f.local_index());
    const bool is_old = old.count(origin) != 0;
    number_of_old_faces += is_old;
    is_covered = is_covered && is_old != (cavity.count(origin) != 0);
  }
  BOOST_TEST(is_covered);
  BOOST_TEST_EQ(number_of_old_faces + faces.size(), boundary_faces(remaining).size());
}

// Resects, and checks all conditions on any connected mesh.
Resection_3 check(const Mesh& mesh, const Set& asked, const Resection_options& options = Resection_options())
{
  const Resection_3 result = resect(mesh, asked, options);
  const std::size_t n = mesh.number_of_elements();
  const Set before = options.already_removed.empty() ? Set(n, false) : options.already_removed;
  const Set naive = united(before, asked);
  BOOST_TEST_EQ(result.is_removed.size(), n);
  BOOST_TEST(united(result.is_removed, before) == result.is_removed);
  BOOST_TEST_EQ(result.number_of_asked_elements, count(naive) - count(before));
  BOOST_TEST_EQ(count(result.is_removed) + result.number_of_restored_elements,
                count(naive) + result.number_of_floating_elements + result.number_of_pinch_elements);
  const double whole = volume(mesh), old = volume_of(mesh, before);
  const Mesh remaining = remaining_mesh(mesh, result.is_removed);
  BOOST_TEST(is_close(volume(remaining) + result.volume + old, whole, whole));
  BOOST_TEST_EQ(result.has_mesh(), !remaining.is_empty());
  ++tally.runs;
  if(result.status == Resection_status::EVERYTHING_REMOVED) {
    BOOST_TEST(remaining.is_empty() && remaining.number_of_vertices() == 0);
    return result;
  }
  BOOST_TEST_EQ(result.number_of_pinched_vertices, 0u);
  BOOST_TEST(result.status != Resection_status::BOUNDARY_NOT_MANIFOLD);
  BOOST_TEST((result.status == Resection_status::NOTHING_REMOVED) == (result.number_of_asked_elements == 0));
  if(result.status != Resection_status::SUCCESS) {
    BOOST_TEST(result.is_removed == before);
    BOOST_TEST_EQ(result.volume, 0.);
    if(result.status == Resection_status::NOTHING_REMOVED)
      return result;
  }
  check_remaining_mesh(mesh, result.is_removed);

  // Loose pieces are those of the requested elements, then pieces that the repair cut off.
  const auto volume_of_elements = [&](const std::vector<Element_index>& elements) {
    return volume_of(mesh, set_of(mesh, elements));
  };
  const auto pieces = components(mesh, options.keep_floating_pieces ? result.is_removed : naive);
  std::size_t largest = 0, number_of_floating_elements = 0;
  for(std::size_t i = 1; i < pieces.size(); ++i)
    if(volume_of_elements(pieces[i]) > volume_of_elements(pieces[largest]))
      largest = i;
  BOOST_TEST_GE(result.floating.size() + 1, pieces.size());
  Set is_loose(n, false), is_loose_naive(n, false);
  bool is_same = true;
  for(std::size_t i = 0, j = 0; i < pieces.size(); ++i)
    if(i != largest && j < result.floating.size()) {
      is_same = is_same && result.floating[j++].elements == pieces[i];
      is_loose_naive = united(is_loose_naive, set_of(mesh, pieces[i]));
    }
  for(const Floating_piece_3& piece : result.floating) {
    is_same = is_same && !piece.elements.empty()
              && is_close(piece.volume, volume_of_elements(piece.elements), whole);
    const Set set = set_of(mesh, piece.elements);
    is_same = is_same && count(united(is_loose, set)) == count(is_loose) + count(set);
    is_loose = united(is_loose, set);
    number_of_floating_elements += piece.elements.size();
  }
  BOOST_TEST(is_same);
  if(options.keep_floating_pieces) {
    BOOST_TEST_EQ(result.number_of_floating_elements, 0u);
    BOOST_TEST_EQ(result.floating.size() + 1, pieces.size());
  } else {
    BOOST_TEST_EQ(result.number_of_floating_elements, number_of_floating_elements);
    BOOST_TEST(united(result.is_removed, is_loose) == result.is_removed);
    BOOST_TEST_EQ(components(mesh, result.is_removed).size(), 1u);
  }

  // The repair is needed, or changes nothing.
  const bool is_manifold = find_defects(remaining_mesh(mesh, naive)).closed_manifold_boundary();
  tally.repaired += !is_manifold;
  tally.restored += result.number_of_restored_elements;
  tally.removed += result.number_of_pinch_elements;
  tally.floating += result.floating.size();
  const Set expected = options.keep_floating_pieces ? naive : united(naive, is_loose_naive);
  const std::size_t changes = result.number_of_restored_elements + result.number_of_pinch_elements;
  if(count(expected) != n && find_defects(remaining_mesh(mesh, expected)).closed_manifold_boundary()) {
    BOOST_TEST(result.is_removed == expected);
    BOOST_TEST_EQ(changes, 0u);
  } else {
    BOOST_TEST_GT(changes, 0u);
  }
  for(std::size_t e = 0; e < n; ++e)
    if(asked[e] != result.is_removed[e] && !before[e] && !is_loose[e])
      tally.changed_volume += volume(mesh, e) / whole;
  tally.asked_volume += (volume_of(mesh, naive) - old) / whole;
  return result;
}

void test_two_cubes()
{
  // Hexahedra of a grid of 5^3 cells by position.
  const Mesh mesh = grid(5, HEXAHEDRON);
  const auto cell = [](int x, int y, int z) { return Element_index(x + 5 * (y + 5 * z)); };

  // Cubes that touch at a face, or are apart, need no repair. If they touch at an edge or a vertex, one
  // stays.
  BOOST_TEST_EQ(check(mesh, set_of(mesh, {cell(1, 1, 1), cell(2, 1, 1)})).volume, 2.);
  BOOST_TEST_EQ(check(mesh, set_of(mesh, {cell(1, 1, 1), cell(3, 1, 1)})).volume, 2.);
  for(Element_index other : {cell(2, 2, 1), cell(2, 1, 2), cell(1, 2, 2), cell(2, 2, 2)}) {
    BOOST_TEST(
      !find_defects(remaining_mesh(mesh, set_of(mesh, {cell(1, 1, 1), other}))).closed_manifold_boundary());
    const Resection_3 result = check(mesh, set_of(mesh, {cell(1, 1, 1), other}));
    BOOST_TEST(result.status == Resection_status::SUCCESS);
    BOOST_TEST_EQ(result.volume, 1.);
    BOOST_TEST_EQ(result.number_of_asked_elements, 2u);
    BOOST_TEST_EQ(result.number_of_restored_elements, 1u);
    BOOST_TEST_EQ(result.number_of_pinch_elements, 0u);
  }

  // The smaller part stays: of two blocks that touch at an edge, a single cube rather than four.
  const Set block = set_of(mesh, {cell(1, 1, 1), cell(1, 1, 2), cell(1, 2, 1), cell(1, 2, 2)});
  Resection_3 result = check(mesh, united(block, set_of(mesh, {cell(2, 3, 1)})));
  BOOST_TEST_EQ(result.number_of_restored_elements, 1u);
  BOOST_TEST(result.is_removed == block);

  // An element that has been removed before cannot come back.
  Resection_options options;
  options.already_removed = set_of(mesh, {cell(2, 3, 1)});
  result = check(mesh, set_of(mesh, {cell(1, 2, 1)}), options);
  BOOST_TEST(result.status == Resection_status::EVERYTHING_RESTORED);
  // If both have been removed before, by resections of others, a neighbor is removed.
  options.already_removed = set_of(mesh, {cell(2, 3, 1), cell(1, 2, 1)});
  result = check(mesh, set_of(mesh, {cell(3, 0, 3)}), options);
  BOOST_TEST(result.status == Resection_status::SUCCESS);
  BOOST_TEST_EQ(result.number_of_pinch_elements, 1u);

  // A cube connected by an edge or a vertex is a loose piece, and is removed; if pieces stay, it is joined or
  // removed.
  for(int z : {1, 2}) {
    Set shell(mesh.number_of_elements(), true); // all but a block of 2^3 cubes, and one more
    for(int i = 0; i < 125; ++i)
      shell[std::size_t(i)] = i % 5 >= 2 || i / 5 % 5 >= 2 || i / 25 >= 2;
    shell[cell(2, 2, z)] = false;
    BOOST_TEST(!find_defects(remaining_mesh(mesh, shell)).closed_manifold_boundary());
    result = check(mesh, shell);
    BOOST_TEST_EQ(result.number_of_floating_elements, 1u);
    BOOST_TEST_EQ(result.floating.size(), 1u);
    BOOST_TEST_EQ(result.floating[0].volume, 1.);
    BOOST_TEST_EQ(result.number_of_pinch_elements + result.number_of_restored_elements, 0u);
    options = Resection_options();
    options.keep_floating_pieces = true;
    result = check(mesh, shell, options);
    BOOST_TEST_EQ(result.number_of_pinch_elements + result.number_of_restored_elements, 1u);
  }
}

void test_checkerboards()
{
  for(int n : {2, 3, 4, 5, 6})
    for(int parity : {0, 1})
      for(bool keep : {false, true}) {
        const Mesh mesh = grid(n, HEXAHEDRON);
        Set asked;
        for(int i = 0; i < n * n * n; ++i)
          asked.push_back((i % n + i / n % n + i / n / n) % 2 == parity);
        Resection_options options;
        options.keep_floating_pieces = keep;
        const Resection_3 result = check(mesh, asked, options);
        if(!keep) { // every cube is loose
          BOOST_TEST_EQ(result.floating.size(), mesh.number_of_elements() - count(asked) - 1);
          BOOST_TEST_EQ(count(result.is_removed), mesh.number_of_elements() - 1);
        }
        // The columns touch along edges.
        for(std::size_t i = 0; i < asked.size(); ++i)
          asked[i] = int(i % std::size_t(n) + i / std::size_t(n) % std::size_t(n)) % 2 == parity
                     && i / std::size_t(n) / std::size_t(n) != 0;
        check(mesh, asked, options);
      }
}

void test_statuses()
{
  for(Resection_status status :
      {Resection_status::SUCCESS, Resection_status::NOTHING_REMOVED, Resection_status::EVERYTHING_RESTORED,
       Resection_status::EVERYTHING_REMOVED, Resection_status::BOUNDARY_NOT_MANIFOLD})
    BOOST_TEST(!std::string(description(status)).empty());

  const Mesh mesh = grid(3, TETRAHEDRON);
  const std::size_t n = mesh.number_of_elements();
  BOOST_TEST(check(mesh, Set(n, false)).status == Resection_status::NOTHING_REMOVED);
  BOOST_TEST(check(mesh, Set(n, true)).status == Resection_status::EVERYTHING_REMOVED);
  Resection_options options;
  options.already_removed.assign(n, true);
  BOOST_TEST(check(mesh, Set(n, true), options).status == Resection_status::EVERYTHING_REMOVED);
  options.already_removed = check(mesh, set_of(mesh, {0, 1, 2})).is_removed;
  const Resection_3 again = check(mesh, set_of(mesh, {0, 1, 2}), options);
  BOOST_TEST(again.status == Resection_status::NOTHING_REMOVED);
  BOOST_TEST(again.is_removed == options.already_removed);

  // Tetrahedra touch the boundary at vertices only, one by one: without such a tetrahedron, the boundary
  // would be pinched.
  std::vector<int> boundary_faces_of(n, 0);
  std::vector<bool> is_on_boundary(mesh.number_of_vertices(), false);
  for(const auto& f : boundary_faces(mesh)) {
    ++boundary_faces_of[f.element()];
    for(Vertex_index v : f.vertices())
      is_on_boundary[v] = true;
  }
  std::size_t found = 0;
  for(Element_index e = 0; e < n; ++e)
    if(boundary_faces_of[e] == 0
       && std::count_if(mesh.element(e).begin(), mesh.element(e).end(), [&](Vertex_index v) {
            return is_on_boundary[v];
          }) == 1) {
      ++found;
      BOOST_TEST(check(mesh, set_of(mesh, {e})).status == Resection_status::EVERYTHING_RESTORED);
    }
  BOOST_TEST_GT(found, 0u);

  // A mesh that is pinched already, far from the resection: reported, not changed.
  const Mesh cubes = grid(5, HEXAHEDRON);
  const Mesh pinched = remaining_mesh(cubes, set_of(cubes, {31, 37}));
  BOOST_TEST(!find_defects(pinched).closed_manifold_boundary());
  const Element_index last = Element_index(pinched.number_of_elements() - 1);
  const Resection_3 result = resect(pinched, set_of(pinched, {last}));
  BOOST_TEST(result.status == Resection_status::BOUNDARY_NOT_MANIFOLD);
  BOOST_TEST(!result.has_mesh());
  BOOST_TEST_EQ(result.number_of_pinched_vertices, 2u);
  BOOST_TEST_EQ(count(result.is_removed), 1u);

  // A mesh of two parts: neither part came loose, and a part may be removed as a whole.
  Set plane(125, false);
  for(std::size_t i = 0; i < 125; ++i)
    plane[i] = i / 25 == 1;
  const Mesh parts = remaining_mesh(cubes, plane); // 25 and 75 cubes
  Resection_3 part = resect(parts, set_of(parts, {0}));
  BOOST_TEST(part.status == Resection_status::SUCCESS && part.floating.empty());
  BOOST_TEST_EQ(count(part.is_removed), 1u);
  Set lower(100, false);
  std::fill(lower.begin(), lower.begin() + 25, true);
  part = resect(parts, lower);
  BOOST_TEST(part.status == Resection_status::SUCCESS && part.floating.empty());
  BOOST_TEST(part.is_removed == lower);
}

// A domain that answers only with a part of its surface, as the concept has it.
class Box_domain
{
public:
  using Point_3 = Test_point;
  struct Surface_part
  {
    int number = 0;
  };
  Surface_part surface_part() const { return {7}; }
  CGAL::Bounded_side bounded_side(const Point_3& p, const Surface_part& part) const
  {
    BOOST_TEST_EQ(part.number, 7);
    const double d = (std::max)({p.x() - 2, 0 - p.x(), p.y() - 3, 1 - p.y(), p.z() - 2, 1 - p.z()});
    return CGAL::Bounded_side(d < 0 ? 1 : d == 0 ? 0 : -1);
  }
};

void test_domains()
{
  const Mesh mesh = grid(4, HEXAHEDRON);
  const Set expected = set_of(mesh, {20, 21});
  const Test_surface surface = box({0, 1, 1}, {2, 3, 2});
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
  for(const Resection_3& result : {resect(mesh, Box_domain()), resect(mesh, domain), resect(mesh, surface)}) {
    BOOST_TEST(result.status == Resection_status::SUCCESS);
    BOOST_TEST_EQ(result.number_of_asked_elements, 4u);
    BOOST_TEST_EQ(count(result.is_removed), 4u);
    BOOST_TEST(united(expected, result.is_removed) == result.is_removed);
  }
  const Analytic_domain ball_domain(ball({1.5, 1.5, 1.5}, 0.1));
  BOOST_TEST_EQ(resect(mesh, ball_domain).number_of_asked_elements, 1u);

  // Centroids on the surface are not inside.
  BOOST_TEST_EQ(resect(mesh, box({0.5, 0.5, 0.5}, {2.5, 2.5, 2.5})).number_of_asked_elements, 1u);
  BOOST_TEST_EQ(resect(mesh, box({0.5, 0.5, 0.5}, {2.5, 2.5, 2.5001})).number_of_asked_elements, 2u);

  // The mesh has another kernel.
  using Exact = CGAL::Mixed_mesh_3<CGAL::Exact_predicates_exact_constructions_kernel>;
  const Exact exact = grid_of_cells<Exact>(4, HEXAHEDRON, [](double x, double y, double z) {
    return Exact::Point_3(x, y, z);
  });
  BOOST_TEST(resect(exact, surface).is_removed == resect(mesh, surface).is_removed);
}

// Random sets, from single elements to few left, scattered and in clumps.
void test_random_sets(const Mesh& mesh, int repeats, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::size_t n = mesh.number_of_elements();
  std::vector<std::vector<Element_index>> around(mesh.number_of_vertices());
  for(Element_index e = 0; e < n; ++e)
    for(Vertex_index v : mesh.element(e))
      around[v].push_back(e);
  for(int repeat = 0; repeat < repeats; ++repeat)
    for(double share : {0.003, 0.02, 0.1, 0.3, 0.5, 0.8}) {
      Set asked(n, false);
      if(repeat % 2 == 0) {
        for(std::size_t e = 0; e < n; ++e)
          asked[e] = uniform(random) < share;
      } else { // all around some vertices
        for(std::size_t v = 0; v < around.size(); ++v)
          if(uniform(random) < share)
            for(Element_index e : around[v])
              asked[e] = true;
      }
      Resection_options options;
      options.keep_floating_pieces = repeat % 3 == 0;
      const Resection_3 result = check(mesh, asked, options);
      BOOST_TEST(resect(mesh, asked, options).is_removed == result.is_removed);
      // The resection is repeated in the remaining mesh.
      options.already_removed = result.is_removed;
      options.keep_floating_pieces = false;
      for(std::size_t e = 0; e < n; ++e)
        asked[e] = uniform(random) < share;
      if(repeat % 3 != 0) // connected
        check(mesh, asked, options);
    }
}

Test_point random_point(std::mt19937& random, const CGAL::Bbox_3& b)
{
  double x[3];
  for(int k = 0; k < 3; ++k)
    x[k] = std::uniform_real_distribution<double>((b.min)(k), (b.max)(k))(random);
  return {x[0], x[1], x[2]};
}

Set elements_inside(const Mesh& mesh, const Test_surface& surface)
{
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
  Set set;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    double sum[3] = {};
    for(Vertex_index v : mesh.element(e))
      for(int k = 0; k < 3; ++k)
        sum[k] += mesh.point(v)[k];
    const double scale = 1. / mesh.element(e).size();
    set.push_back(domain.bounded_side(Test_point(scale * sum[0], scale * sum[1], scale * sum[2]))
                  == CGAL::ON_BOUNDED_SIDE);
  }
  return set;
}

// Resections as by a surgeon.
void test_tumors(const Mesh& mesh, const Test_surface& brain, int repeats)
{
  std::mt19937 random(5);
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(brain);
  const CGAL::Bbox_3 bbox = domain.bbox();
  const double whole = volume(mesh);
  const Tally before = tally;
  std::vector<Test_point> centers;
  for(const auto& f : boundary_faces(mesh)) // at the boundary
    if(centers.size() < std::size_t(repeats) / 3 && f.element() % 17 == 0)
      centers.push_back(mesh.point(mesh.element(f.element())[0]));
  while(centers.size() < std::size_t(repeats))
    centers.push_back(random_point(random, bbox));

  Resection_options sequence;
  std::size_t number_of_resections = 0;
  for(const Test_point& center : centers) {
    const double radius = 5 * std::pow(10., std::uniform_real_distribution<double>(0, 1)(random));
    const Test_surface tumor = sphere(center, radius, 12);
    const Set asked = elements_inside(mesh, tumor);
    const Resection_3 result = check(mesh, asked);
    BOOST_TEST(resect(mesh, tumor).is_removed == result.is_removed);
    BOOST_TEST_EQ(resect(mesh, tumor).number_of_asked_elements, count(asked));
    // Tumors are removed one after the other, until half is gone.
    const Resection_3 next = check(mesh, asked, sequence);
    BOOST_TEST(resect(mesh, tumor, sequence).is_removed == next.is_removed);
    number_of_resections += next.status == Resection_status::SUCCESS;
    sequence.already_removed = next.is_removed;
    if(volume_of(mesh, next.is_removed) > whole / 2)
      sequence.already_removed.clear();
    // Two tumors are removed at once.
    check(mesh, united(asked, elements_inside(mesh, sphere(random_point(random, bbox), radius, 8))));
  }
  BOOST_TEST_GT(number_of_resections, centers.size() / 4);

  // The repair changes little.
  const double asked = tally.asked_volume - before.asked_volume,
               changed = tally.changed_volume - before.changed_volume;
  BOOST_TEST_GT(asked, 0.);
  BOOST_TEST_LE(changed, 0.05 * asked);

  // Slabs that cut the brain in two, left to right, front to back, and aslant.
  const double far = 1000;
  std::size_t cut = 0;
  for(int axis = 0; axis < 3; ++axis)
    for(double share : {0.2, 0.4, 0.5, 0.7})
      for(bool keep : {false, true}) {
        double lower[3] = {-far, -far, -far}, upper[3] = {far, far, far};
        const double middle = (bbox.min)(axis) + share * ((bbox.max)(axis) - (bbox.min)(axis));
        lower[axis] = middle - 13;
        upper[axis] = middle + 13;
        Test_surface slab = box({lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]});
        if(axis == 2)
          for(auto v : vertices(slab))
            slab.point(v) = slab.point(v) + Test_kernel::Vector_3(0, 0, 0.3 * slab.point(v).x());
        Resection_options options;
        options.keep_floating_pieces = keep;
        const Resection_3 result = check(mesh, elements_inside(mesh, slab), options);
        BOOST_TEST(result.is_removed == resect(mesh, slab, options).is_removed);
        double loose = 0;
        for(const Floating_piece_3& piece : result.floating)
          loose = (std::max)(loose, piece.volume);
        cut += loose > whole / 20;
        const double left = whole - result.volume;
        BOOST_TEST(keep ? left > 2 * loose : left > loose);
      }
  BOOST_TEST_GE(cut, 12u);

  // Everything, and nothing, is removed.
  const Test_point middle((bbox.xmin)() + bbox.x_span() / 2, (bbox.ymin)() + bbox.y_span() / 2,
                          (bbox.zmin)() + bbox.z_span() / 2);
  Resection_3 result = resect(mesh, sphere(middle, 300, 12));
  BOOST_TEST(result.status == Resection_status::EVERYTHING_REMOVED);
  BOOST_TEST(!result.has_mesh() && count(result.is_removed) == mesh.number_of_elements());
  BOOST_TEST(is_close(result.volume, whole, whole));
  for(const Test_surface& tumor : {sphere(mesh.point(0), 1e-3, 4), sphere({1000, 0, 0}, 50, 8)}) {
    result = resect(mesh, tumor);
    BOOST_TEST(result.status == Resection_status::NOTHING_REMOVED);
    BOOST_TEST(result.has_mesh() && count(result.is_removed) == 0 && result.volume == 0);
  }
}

void test_brain(const std::string& data)
{
  Test_surface brain, region;
  BOOST_TEST(CGAL::IO::read_polygon_mesh(data + "/brain.off", brain));
  BOOST_TEST(CGAL::IO::read_polygon_mesh(data + "/region.off", region));
  for(std::size_t budget : {660, 3000}) {
    Mesh mesh;
    BOOST_TEST(CGAL::make_mixed_mesh_3(brain, region, budget, mesh).has_mesh());
    BOOST_TEST(find_defects(mesh).none());
    const Tally before = tally;
    test_tumors(mesh, brain, budget == 660 ? 150 : 60);
    BOOST_TEST_GT(tally.repaired - before.repaired, 50u);
    test_random_sets(mesh, budget == 660 ? 12 : 4, unsigned(budget));
  }
}

// The elements of some subdomains are those of the mesh, in their order, with their attributes; together,
// all subdomains have the volume of the mesh.
void test_extract(Element_kind kind)
{
  const Mesh cells = grid(4, kind);
  Mesh mesh;
  for(const Test_point& p : cells.points())
    mesh.add_vertex(p);
  std::mt19937 random(7);
  for(Element_index e = 0; e < cells.number_of_elements(); ++e)
    mesh.add_element(kind, std::vector<Vertex_index>(cells.element(e).begin(), cells.element(e).end()),
                     {Subdomain_index(1 + 3 * (random() % 3)), random() % 2 == 0, int(random() % 3)});
  const double whole = volume(mesh);
  double sum = 0;
  for(const std::vector<Subdomain_index>& chosen :
      std::vector<std::vector<Subdomain_index>>{{1}, {4}, {7}, {7, 1, 7}, {4, 1, 7}, {}, {2}}) {
    std::vector<Vertex_index> vertices;
    std::vector<Element_index> elements;
    const Mesh part = extract_subdomains(mesh, chosen, &vertices, &elements);
    std::vector<Element_index> expected;
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      if(std::count(chosen.begin(), chosen.end(), mesh.subdomain_index(e)) > 0)
        expected.push_back(e);
    BOOST_TEST(elements == expected);
    BOOST_TEST_EQ(part.number_of_elements(), expected.size());
    BOOST_TEST_EQ(part.number_of_vertices(), vertices.size());
    BOOST_TEST(std::is_sorted(vertices.begin(), vertices.end()));
    bool is_same = true;
    for(Element_index e = 0; e < part.number_of_elements(); ++e) {
      const Element_view a = part.element(e), b = mesh.element(elements[e]);
      is_same = is_same && a.kind() == b.kind() && part.attributes(e) == mesh.attributes(elements[e]);
      for(int i = 0; i < a.size(); ++i)
        is_same = is_same && vertices[a[i]] == b[i] && part.point(a[i]) == mesh.point(b[i]);
    }
    BOOST_TEST(is_same);
    const Mesh_defects defects = find_defects(part);
    BOOST_TEST(defects.conforming() && defects.positive() && defects.unused_vertices == 0);
    if(chosen.size() == 1)
      sum += volume(part);
    if(chosen == std::vector<Subdomain_index>{4, 1, 7})
      BOOST_TEST(part.elements().connectivity() == mesh.elements().connectivity());
  }
  BOOST_TEST(is_close(sum, whole, whole));
}

int run(int argc, char* argv[])
{
  test_two_cubes();
  test_checkerboards();
  test_statuses();
  test_domains();
  for(Element_kind kind : element_kinds) {
    test_extract(kind);
    test_random_sets(grid(4, kind), 20, unsigned(kind));
  }
  test_brain(argc > 1 ? argv[1] : MIXED_MESH_3_DATA_DIR);
  // A removal without repair fails the check of the manifold, the repaired one passes.
  BOOST_TEST_GT(tally.repaired, 500u);
  BOOST_TEST_GT(tally.restored, 0u);
  BOOST_TEST_GT(tally.removed, 0u);
  BOOST_TEST_GT(tally.floating, 0u);
  return boost::report_errors();
}

} // namespace test_resection
