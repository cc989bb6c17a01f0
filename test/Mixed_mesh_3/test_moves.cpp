// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ten thousand random transactions, on random meshes of tetrahedra and of all kinds of elements. After each
// that is accepted, by brute force: Betti numbers of the mesh and of its boundary are those of the start, all
// elements are positive, by rationals, faces conform, and the elements around each vertex are those of the
// list of elements. After each that is not, the mesh is the same to the byte.

#include "test_cells.h"
#include "test_fitting.h"
#include "test_strata.h"
#include "test_topology.h"

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Edge_collapser.h>
#include <CGAL/Mixed_mesh_3/internal/moves/bisect_edge.h>
#include <CGAL/Mixed_mesh_3/internal/moves/flips.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace test_moves {

using namespace CGAL::Mixed_meshes_3;
using brute_force::sorted;
using cells::Cell;
using cells::cells_of_grid;
using internal::Edge_collapser;
using internal::Stratum;
using internal::Transaction;
using internal::Working_mesh;
using Quality = Aspect_ratio_quality_3;
using Is_there = std::function<bool(const Cell&)>;

constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- random meshes of all kinds of elements ----------------------------------------------------

// A grid of hexahedra, pairs of prisms, and cells of pyramids around their center. Faces of pyramids may be
// divided where no other element forbids it, so that two tetrahedra replace the pyramid.
class Mixed_cells
{
  const int m_n;
  const Is_there& m_is_there;
  std::mt19937 m_random;
  std::map<Cell, Element_kind> m_kinds;
  std::map<std::vector<Vertex_index>, bool> m_is_divided; // faces, by their sorted vertices
  std::map<std::array<int, 3>, Vertex_index> m_vertices;
  Mesh m_mesh;

  Vertex_index vertex(const std::array<int, 3>& place)
  {
    const auto [found, is_new] = m_vertices.try_emplace(place, Vertex_index(0));
    if(is_new)
      found->second = m_mesh.add_vertex(
        Test_point(double(place[0]) / m_n, double(place[1]) / m_n, double(place[2]) / m_n));
    return found->second;
  }

  bool is_kind(const Cell& c, Element_kind kind) const
  {
    const auto found = m_kinds.find(c);
    return found != m_kinds.end() && found->second == kind;
  }

  template <class Visit>
  void for_each_cell(const Visit& visit) const
  {
    for(int z = 0; z < m_n; ++z)
      for(int y = 0; y < m_n; ++y)
        for(int x = 0; x < m_n; ++x)
          if(m_is_there({x, y, z}))
            visit(Cell{x, y, z});
  }

  std::array<Vertex_index, 8> vertices(const Cell& c)
  {
    std::array<Vertex_index, 8> v{};
    for(std::size_t i = 0; i < 8; ++i) {
      const auto& p = reference_elements[HEXAHEDRON].coordinates[i];
      v[i] = vertex({c[0] + (p[0] + 1) / 2, c[1] + (p[1] + 1) / 2, c[2] + (p[2] + 1) / 2});
    }
    return v;
  }

  // Prisms have no hexahedra below and above; the faces there are divided, the others are not.
  void choose_faces()
  {
    for_each_cell([&](const Cell& c) {
      if(is_kind(c, PRISM)
         && (is_kind({c[0], c[1], c[2] - 1}, HEXAHEDRON) || is_kind({c[0], c[1], c[2] + 1}, HEXAHEDRON)))
        m_kinds.at(c) = PYRAMID;
    });
    for(Element_kind kind : {PYRAMID, HEXAHEDRON, PRISM}) // the later ones decide
      for_each_cell([&](const Cell& c) {
        if(!is_kind(c, kind))
          return;
        const std::array<Vertex_index, 8> v = vertices(c);
        for(const Element_face& face : reference_elements[HEXAHEDRON].faces) {
          const auto& f = face.vertices;
          const bool is_level = (f[0] < 4) == (f[1] < 4) && (f[1] < 4) == (f[2] < 4);
          m_is_divided[sorted({v[f[0]], v[f[1]], v[f[2]], v[f[3]]})] = kind == PYRAMID
                                                                         ? m_random() % 4 != 0
                                                                         : kind == PRISM && is_level;
        }
      });
  }

  void add_elements(const Cell& c)
  {
    const std::array<Vertex_index, 8> v = vertices(c);
    if(!is_kind(c, PYRAMID)) {
      add_cell(m_mesh, v, m_kinds.at(c), [] { return Test_point(); });
      return;
    }
    const Vertex_index apex = m_mesh.add_vertex(
      Test_point((c[0] + 0.5) / m_n, (c[1] + 0.5) / m_n, (c[2] + 0.5) / m_n));
    for(const Element_face& face : reference_elements[HEXAHEDRON].faces) {
      const auto& f = face.vertices;
      std::array<Vertex_index, 4> q{v[f[3]], v[f[2]], v[f[1]], v[f[0]]}; // seen from inside
      if(!m_is_divided.at(sorted({q.begin(), q.end()}))) {
        m_mesh.add_element(PYRAMID, {q[0], q[1], q[2], q[3], apex});
        continue;
      }
      // The diagonal starts where all coordinates are least, as that of prisms does.
      std::rotate(q.begin(),
                  std::min_element(q.begin(), q.end(),
                                   [&](Vertex_index a, Vertex_index b) {
                                     const Test_point &p = m_mesh.point(a), &r = m_mesh.point(b);
                                     return p.x() + p.y() + p.z() < r.x() + r.y() + r.z();
                                   }),
                  q.end());
      m_mesh.add_element(TETRAHEDRON, {q[0], q[1], q[2], apex});
      m_mesh.add_element(TETRAHEDRON, {q[0], q[2], q[3], apex});
    }
  }

public:
  Mixed_cells(int n, unsigned seed, const Is_there& is_there) : m_n(n), m_is_there(is_there), m_random(seed)
  {
  }

  Mesh operator()()
  {
    constexpr Element_kind kinds[] = {PYRAMID, PYRAMID, PYRAMID, PRISM, HEXAHEDRON};
    for_each_cell([&](const Cell& c) { m_kinds[c] = kinds[m_random() % 5]; });
    choose_faces();
    for_each_cell([&](const Cell& c) { add_elements(c); });
    distort(m_mesh, 0.1 / m_n, m_random());
    return m_mesh;
  }
};

// ---- comparison --------------------------------------------------------------------------------

bool is_same_to_the_byte(const Working_mesh& a, const Working_mesh& b)
{
  using Element = Working_mesh::Element;
  return a.points == b.points && a.incident == b.incident && a.strata == b.strata
         && a.sharp_edges == b.sharp_edges && a.merged == b.merged
         && std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(),
                       [](const Element& x, const Element& y) {
                         return x.kind == y.kind && x.attributes == y.attributes
                                && x.is_removed == y.is_removed && x.vertices == y.vertices;
                       });
}

// Whether each vertex has the elements of the list that have it.
bool has_right_incidences(const Working_mesh& mesh)
{
  std::vector<std::vector<Element_index>> incident(mesh.points.size()), sorted;
  for(Element_index e = 0; e < mesh.elements.size(); ++e)
    if(!mesh.elements[e].is_removed)
      for(Vertex_index v : mesh.elements[e])
        incident[v].push_back(e);
  for(Vertex_index v = 0; v < mesh.incident.size(); ++v) {
    sorted.emplace_back(mesh.incident[v].begin(), mesh.incident[v].end());
    std::sort(sorted.back().begin(), sorted.back().end());
  }
  return sorted == incident && mesh.strata.size() == mesh.points.size();
}

// ---- random moves ------------------------------------------------------------------------------

struct Counts
{
  std::array<std::size_t, 7> accepted{}, refused{}; // of each kind of move
  std::size_t transactions = 0, undone = 0, cuts = 0;
};

class Random_moves
{
  const Mesh& m_start;
  const std::vector<std::array<brute_force::Betti_numbers, 2>> m_topology;
  const Quality m_quality;
  Working_mesh m_mesh;
  std::mt19937 m_random;
  Counts& m_counts;
  // Limit of the costs of new elements, and whether they may be as bad as those that they replace.
  double m_limit = 0;
  bool m_may_be_as_bad = false;

  std::size_t below(std::size_t n) { return m_random() % n; }
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(m_random); }
  Vec3 random_step(double length)
  {
    const double x = uniform(-length, length), y = uniform(-length, length), z = uniform(-length, length);
    return {x, y, z};
  }

  Element_index random_element()
  {
    for(;;)
      if(const Element_index e = Element_index(below(m_mesh.elements.size())); !m_mesh.elements[e].is_removed)
        return e;
  }

  Vertex_index random_vertex_of(Element_index e)
  {
    return m_mesh.elements[e].vertices[below(std::size_t(m_mesh.elements[e].size()))];
  }

  // Two vertices of an element, mostly of a tetrahedron.
  std::pair<Vertex_index, Vertex_index> random_edge()
  {
    for(;;) {
      const Element_index e = random_element();
      const Vertex_index a = random_vertex_of(e), b = random_vertex_of(e);
      if(a != b && (m_mesh.elements[e].kind == TETRAHEDRON || below(8) == 0))
        return {a, b};
    }
  }

  double cost(const Element_view& element) const
  {
    return m_quality(element.kind(), m_mesh.relative_points(element));
  }

  // The worst tetrahedron of some, if there is any among them.
  Element_index bad_tetrahedron(bool is_on_boundary)
  {
    Element_index worst = random_element();
    double largest = 0;
    for(int i = 0; i < 40; ++i) {
      const Element_index e = random_element();
      const Working_mesh::Element& element = m_mesh.elements[e];
      if(element.kind == TETRAHEDRON && cost(element) > largest
         && (!is_on_boundary || std::all_of(element.begin(), element.end(), [&](Vertex_index v) {
              return m_mesh.is_on_boundary(v);
            }))) {
        worst = e;
        largest = cost(element);
      }
    }
    return worst;
  }

  // Without a limit of the cost, which is infinite for inverted elements, positivity alone decides.
  double random_limit(double most) { return below(4) == 0 ? infinity : uniform(2, most); }

  // ---- each kind of move: whether it was accepted

  bool flip(int kind)
  {
    const double bound = below(2) == 0 ? 3 : infinity;
    internal::Flip_context<Quality> context{m_mesh, m_quality, bound, below(2) == 0 ? 4. : 8.};
    m_limit = bound;
    m_may_be_as_bad = true;
    const Element_index e = bad_tetrahedron(kind == 2);
    if(m_mesh.elements[e].kind != TETRAHEDRON)
      return false;
    return kind == 0   ? internal::flip_edges(context, e)
           : kind == 1 ? internal::flip_faces(context, e)
                       : internal::remove_from_boundary(context, e);
  }

  bool bisect()
  {
    const auto [a, b] = random_edge();
    const Vec3 &p = m_mesh.points[a], &q = m_mesh.points[b];
    const Stratum stratum = m_mesh.is_sharp(a, b)                         ? m_mesh.sharp_stratum(a, b)
                            : internal::is_edge_of_boundary(m_mesh, a, b) ? internal::boundary_stratum
                                                                          : internal::free_stratum;
    const Vec3 middle = 0.5 * (p + q) + random_step(stratum == internal::free_stratum ? 0.1 : 0);
    m_limit = random_limit(12);
    return internal::bisect_edge(m_mesh, m_quality, a, b, middle, stratum, m_limit);
  }

  bool collapse()
  {
    const auto [v, w] = random_edge();
    Edge_collapser<Quality> collapser(m_mesh, m_quality);
    if(!collapser.is_in_one_subdomain(v))
      return false;
    const auto faces = collapser.boundary_faces_at(v);
    const auto ends = collapser.ends_of_edges(v, faces);
    m_limit = random_limit(30);
    return (faces.empty() || std::binary_search(ends.begin(), ends.end(), w))
           && collapser.keeps_topology(v, w, faces) && collapser(v, w, m_limit);
  }

  bool move()
  {
    Transaction transaction(m_mesh);
    for(std::size_t i = 0; i <= below(3); ++i) {
      const Vertex_index v = random_vertex_of(random_element());
      transaction.move(v, m_mesh.points[v] + random_step(m_mesh.is_on_boundary(v) ? 0.04 : 0.1));
    }
    m_limit = random_limit(60);
    m_may_be_as_bad = below(2) == 0;
    return transaction.accept(m_quality, m_may_be_as_bad
                                           ? (std::max)(m_limit, transaction.worst_before(m_quality))
                                           : m_limit);
  }

  // Some elements always remain.
  void remove(Transaction& transaction, Element_index e)
  {
    if(std::count_if(m_mesh.elements.begin(), m_mesh.elements.end(),
                     [](const Working_mesh::Element& x) { return !x.is_removed; })
       > 4)
      transaction.remove(e);
  }

  // Changes of any kind, which are never accepted.
  bool change()
  {
    Transaction transaction(m_mesh);
    for(std::size_t i = 0; i <= below(12); ++i) {
      const auto [a, b] = random_edge();
      const Element_index e = random_element();
      switch(below(9)) {
      case 0: // a vertex loses its elements
        for(Element_index other :
            std::vector<Element_index>(m_mesh.incident[a].begin(), m_mesh.incident[a].end()))
          remove(transaction, other);
        break;
      case 1: remove(transaction, e); break;
      case 2: transaction.add(m_mesh.elements[e]); break;
      case 3:
        transaction.add(
          m_mesh.elements[e].with_other_vertex(random_vertex_of(e),
                                               transaction.add_vertex(random_step(1), 1, {0, 1})));
        break;
      case 4: transaction.set_attributes(e, {int(below(4)) + 1, below(2) == 0, int(below(3))}); break;
      case 5: transaction.move(a, random_step(1)); break;
      case 6: transaction.set_stratum(a, Stratum(below(4))); break;
      case 7: transaction.set_sharp_edge(a, b, Stratum(below(2))); break;
      default:
        for(Vertex_index v = 0; v < m_mesh.points.size(); ++v)
          if(m_mesh.incident[v].empty())
            transaction.merge(v);
      }
      if(below(8) == 0)
        transaction.keep(); // becomes a change of the outer transaction
    }
    return false;
  }

  // ---- checks

  // Of the whole mesh, and of two subdomains.
  static std::vector<std::array<brute_force::Betti_numbers, 2>> topology(const Mesh& mesh)
  {
    const Element_index n = Element_index(mesh.number_of_elements());
    bool is_divided = false;
    for(Element_index e = 0; e < n; ++e)
      is_divided = is_divided || mesh.attributes(e).subdomain_index == 2;
    if(!is_divided)
      return {brute_force::topology(mesh)};
    return {brute_force::topology(mesh), brute_force::topology(mesh, 1), brute_force::topology(mesh, 2)};
  }

  void check_costs(const Working_mesh& before) const
  {
    double limit = m_limit;
    const auto is_moved = [&](const Working_mesh::Element& element) {
      return std::any_of(element.begin(), element.end(), [&](Vertex_index v) {
        return v < before.points.size() && before.points[v] != m_mesh.points[v];
      });
    };
    for(Element_index e = 0; m_may_be_as_bad && e < before.elements.size(); ++e)
      if(const auto& old = before.elements[e];
         !old.is_removed && (m_mesh.elements[e].is_removed || is_moved(old)))
        limit = (std::max)(limit, m_quality(old.kind, before.relative_points(old)));
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e)
      if(const auto& element = m_mesh.elements[e];
         !element.is_removed && (e >= before.elements.size() || is_moved(element)))
        BOOST_TEST_LE(m_quality(element.kind, m_mesh.relative_points(element)), limit);
  }

  void check(const Working_mesh& before)
  {
    check_costs(before);
    BOOST_TEST(has_right_incidences(m_mesh));
    for(Vertex_index v : m_mesh.merged)
      BOOST_TEST(m_mesh.incident[v].empty() && !m_mesh.is_on_boundary(v));
    for(const auto& [edge, stratum] : m_mesh.sharp_edges)
      BOOST_TEST(!m_mesh.elements_at_edge(edge.first, edge.second).empty());
    const Mesh mesh = stored();
    BOOST_TEST(brute_force::is_conforming(mesh));
    BOOST_TEST(brute_force::has_positive_corners(mesh));
    BOOST_TEST(topology(mesh) == m_topology);
  }

  Mesh stored() const
  {
    Mesh mesh = m_start;
    m_mesh.store(mesh);
    return mesh;
  }

  // Moves on the boundary may lead to cuts, which are no concern of transactions.
  bool is_boundary_cut() const
  {
    const Mesh mesh = stored();
    return !internal::vertices_of_self_intersections(positions(mesh), boundary_faces(mesh)).empty();
  }

  // One random move. \return whether it may be kept
  bool step()
  {
    const Working_mesh before = m_mesh;
    const std::size_t kind = below(7);
    m_may_be_as_bad = false;
    const bool is_accepted = kind < 3    ? flip(int(kind))
                             : kind == 3 ? bisect()
                             : kind == 4 ? collapse()
                             : kind == 5 ? move()
                                         : change();
    ++m_counts.transactions;
    ++(is_accepted ? m_counts.accepted : m_counts.refused)[kind];
    if(kind == 6)
      return false;
    if(is_accepted)
      check(before);
    else
      BOOST_TEST(is_same_to_the_byte(m_mesh, before));
    const bool is_cut = is_accepted && kind != 3 && is_boundary_cut();
    m_counts.cuts += is_cut;
    return !is_cut;
  }

public:
  Random_moves(const Mesh& start, unsigned seed, Counts& counts)
    : m_start(start), m_topology(topology(start)), m_mesh(working_mesh(start, boundary_faces(start))),
      m_random(seed), m_counts(counts)
  {
    for(Vertex_index v = 0; v < m_mesh.points.size(); ++v)
      if(!Edge_collapser<Quality>(m_mesh, m_quality).is_in_one_subdomain(v))
        m_mesh.strata[v] = internal::boundary_stratum;
    for(const Face& face : boundary_faces(start)) // some edges are sharp
      if(seed % 2 == 0 && below(4) == 0) {
        const Vertex_index a = face.vertices()[0], b = face.vertices()[1];
        m_mesh.sharp_edges[std::minmax(a, b)] = m_mesh.strata[a] = m_mesh.strata[b] =
          internal::first_sharp_stratum + Stratum(below(3));
      }
  }

  // Transactions, some of them within another one.
  void operator()(std::size_t number)
  {
    for(const std::size_t end = m_counts.transactions + number; m_counts.transactions < end;) {
      const Working_mesh before = m_mesh;
      {
        Transaction outer(m_mesh);
        bool is_kept = true;
        for(std::size_t i = 0; is_kept && i < (below(4) == 0 ? 3 : 1); ++i)
          is_kept = step();
        if(is_kept && below(8) != 0) {
          outer.keep();
          continue;
        }
      }
      ++m_counts.undone;
      BOOST_TEST(is_same_to_the_byte(m_mesh, before));
    }
  }
};

// ---- the tests ---------------------------------------------------------------------------------

// Random cells, if the boundary is a manifold: there are bodies, handles and cavities.
Mesh random_mesh(unsigned seed)
{
  for(std::mt19937 random(seed);;) {
    const int n = seed % 4 < 2 ? 3 : 2;
    std::array<Subdomain_index, 27> cells{};
    for(Subdomain_index& c : cells)
      c = random() % 8 == 0 ? 0 : seed % 5 == 0 && random() % 3 == 0 ? 2 : 1;
    if(n == 3 && seed % 8 == 0)
      cells[13] = 0; // the cell in the middle
    if(n == 3 && seed % 8 == 4)
      cells[4] = cells[13] = cells[22] = 0; // a column of cells
    const auto cell = [&](const Cell& c) { return cells[std::size_t(c[0] + n * (c[1] + n * c[2]))]; };
    const Is_there is_there = [&](const Cell& c) { return cell(c) != 0; };
    const Mesh mesh = seed % 2 == 0 ? cells_of_grid(n, seed, cell) : Mixed_cells(n, seed, is_there)();
    if(mesh.number_of_elements() > 0 && find_defects(mesh).none())
      return mesh;
  }
}

// Flips where a mesh overlaps, as while its boundary cuts itself: an edge or a face that is far away in the
// mesh, and has the same vertices, is not made twice.
void test_flips_of_overlapping_mesh()
{
  // Two tetrahedra at a face, with the ends d and e; or three around the edge of these.
  constexpr int a = 0, b = 1, c = 2, d = 3, e = 4, x = 5, y = 6;
  using Tetrahedra = std::vector<std::array<int, 4>>;
  const Tetrahedra two{{a, b, c, d}, {a, c, b, e}}, three{{b, a, d, e}, {c, b, d, e}, {a, c, d, e}};
  const auto flips = [&](double height, Tetrahedra tetrahedra, const Tetrahedra& others, const auto& flip) {
    const std::vector<Mesh::Point_3> points{{1, 0, 0},       {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {0, 0, height},
                                            {0, 0, -height}, {9, 0, 1},      {9, 1, 0}};
    tetrahedra.insert(tetrahedra.end(), others.begin(), others.end());
    Element_list elements;
    for(const auto& t : tetrahedra) {
      std::array<Vertex_index, 4> v;
      std::transform(t.begin(), t.end(), v.begin(), [](int i) { return Vertex_index(std::uint32_t(i)); });
      elements.add(TETRAHEDRON, v.data());
    }
    Mesh mesh;
    mesh.assign(points, elements, std::vector<Element_attributes>(tetrahedra.size()));
    Working_mesh working(mesh, std::vector<Stratum>(points.size(), internal::free_stratum));
    const Quality quality;
    internal::Flip_context<Quality> context{working, quality, infinity};
    const bool is_flipped = flip(context, Element_index(0));
    BOOST_TEST(find_defects(working.changed(mesh)).conforming());
    return is_flipped;
  };
  const auto flip_faces = [](auto& context, Element_index t) { return internal::flip_faces(context, t); };
  const auto flip_edges = [](auto& context, Element_index t) { return internal::flip_edges(context, t); };
  BOOST_TEST(flips(0.3, two, {}, flip_faces));
  BOOST_TEST(!flips(0.3, two, {{e, d, x, y}}, flip_faces));
  BOOST_TEST(flips(0.6, three, {}, flip_edges));
  BOOST_TEST(!flips(0.6, three, {{a, b, c, x}}, flip_edges));
}

int run(int, char*[])
{
  test_flips_of_overlapping_mesh();
  constexpr std::size_t transactions_of_each = 100;
  Counts counts;
  std::set<std::vector<std::array<int, 4>>> topologies;
  std::array<std::size_t, 4> kinds{};
  for(unsigned seed = 1; seed <= 100; ++seed) {
    const Mesh start = random_mesh(seed);
    const auto topology = brute_force::topology(start);
    topologies.insert({topology.begin(), topology.end()});
    for(Element_index e = 0; e < start.number_of_elements(); ++e)
      ++kinds[start.element(e).kind()];
    Random_moves(start, seed, counts)(transactions_of_each);
  }
  const char* const names[] = {"flips of edges", "flips of faces", "removals",         "bisections",
                               "collapses",      "vertex moves",   "arbitrary changes"};
  std::cout << counts.transactions << " transactions on meshes of " << topologies.size() << " topologies, "
            << counts.undone << " undone by an outer one, of these " << counts.cuts
            << " as faces cut others\n";
  for(std::size_t i = 0; i < 7; ++i) {
    std::cout << "  " << names[i] << ": " << counts.accepted[i] << " accepted, " << counts.refused[i]
              << " refused" << std::endl;
    BOOST_TEST_GT(counts.refused[i], 100u);
    BOOST_TEST_EQ(counts.accepted[i] > 10, i != 6);
  }
  BOOST_TEST_GE(counts.transactions, 10000u);
  BOOST_TEST_GT(topologies.size(), 3u);
  BOOST_TEST(std::all_of(kinds.begin(), kinds.end(), [](std::size_t n) { return n > 100; }));
  return boost::report_errors();
}

} // namespace test_moves
