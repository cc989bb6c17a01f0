// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order in which cells are split, compared with a choice among all leaves, and the number of splits for a
// budget, compared with all numbers.

#include "test_lattice.h"

#include <CGAL/Mixed_mesh_3/internal/octree/Refinement_sequence.h>
#include <CGAL/Mixed_mesh_3/internal/octree/balance.h>
#include <CGAL/Mixed_mesh_3/internal/octree/fill_vertex_budget.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace test_octree_refinement {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Ball_mixed_mesh_region_3;
using CGAL::Bbox_3;
using internal::Refinement_sequence;
using internal::fill_vertex_budget;
using Node_index = Octree::Node_index;
using Region = CGAL::Weighted_mixed_mesh_region_3<Ball_mixed_mesh_region_3>;
using Weight = std::function<double(const Test_point&)>;

Region ball_region(
  const Test_point& center, double radius, const Weight& weight = [](const Test_point&) { return 1; })
{
  return Region(Ball_mixed_mesh_region_3(center, radius), weight);
}

// ---- octrees -----------------------------------------------------------------------------------

bool is_same(const Octree& a, const Octree& b)
{
  if(a.size() != b.size())
    return false;
  for(Node_index n = 0; n < a.size(); ++n)
    if(a.corner(n) != b.corner(n) || a.level(n) != b.level(n) || a.is_leaf(n) != b.is_leaf(n)
       || (!a.is_leaf(n) && a.child(n, 0) != b.child(n, 0)) || (n > 0 && a.parent(n) != b.parent(n)))
      return false;
  return true;
}

template <class Octree_>
bool is_same(const Octree_& a, const Octree_& b)
{
  if(!is_same(a.octree(), b.octree()))
    return false;
  for(Node_index n = 0; n < a.octree().size(); ++n)
    if(a.side(n) != b.side(n) || a.is_in_region(n) != b.is_in_region(n))
      return false;
  return true;
}

template <class Octree_>
Octree_ refined(Octree_ octree, int level)
{
  for(int l = 0; l < level; ++l)
    octree.refine(octree.leaves_to_refine(l, false));
  return octree;
}

// The octree after a truncation is that of the remaining splits alone; and further splits follow as if there
// had been no others.
void test_truncate()
{
  std::mt19937 random(3);
  std::vector<Octree> after(1);
  std::vector<Node_index> split;
  for(int i = 0; i < 60; ++i) {
    Octree octree = after.back();
    Node_index n;
    do
      n = Node_index(random() % octree.size());
    while(!octree.is_leaf(n) || octree.level(n) == Octree::max_level);
    octree.split(n);
    split.push_back(n);
    after.push_back(octree);
  }
  for(const Octree& expected : after) {
    Octree octree = after.back();
    octree.truncate(expected.size());
    BOOST_TEST(is_same(octree, expected));
    for(std::size_t i = (expected.size() - 1) / 8; i < split.size(); ++i)
      octree.split(split[i]);
    BOOST_TEST(is_same(octree, after.back()));
  }
}

// The leaves around each point are as small as in either of two octrees, and no smaller ones are needed: the
// order does not matter.
void test_refine_like()
{
  const Analytic_domain domain(ball({0.4, 0.5, 0.45}, 0.35));
  const Region region = ball_region({0.7, 0.5, 0.4}, 0.15);
  const Aligned_traits traits(Bbox_3(0, 0, 0, 1, 1, 1));
  const auto leaves_of = [](const Located_octree& octree) {
    std::vector<std::pair<std::uint64_t, int>> leaves;
    for(Node_index n = 0; n < octree.octree().size(); ++n)
      if(octree.octree().is_leaf(n))
        leaves.emplace_back(internal::lattice_key(octree.octree().corner(n)), octree.octree().level(n));
    std::sort(leaves.begin(), leaves.end());
    return leaves;
  };
  std::mt19937 random(7);
  for(int run = 0; run < 20; ++run) {
    const Located_octree start = refined(Located_octree(domain, region, traits), run % 3);
    std::array<Located_octree, 2> octrees{start, start};
    for(Located_octree& octree : octrees)
      for(int i = 0; i < 12; ++i) {
        const auto n = Node_index(random() % octree.octree().size());
        if(octree.octree().is_leaf(n) && octree.meets_domain(n))
          octree.refine(std::vector<Node_index>{n});
      }
    Located_octree both = octrees[0], other = octrees[1];
    both.refine_like(octrees[1]);
    other.refine_like(octrees[0]);
    BOOST_TEST(leaves_of(both) == leaves_of(other));
    for(const Located_octree& octree : octrees)
      for(Node_index n = 0; n < octree.octree().size(); ++n)
        if(octree.octree().is_leaf(n))
          BOOST_TEST_GE(both.octree().level(both.leaf_at(
                          traits.cell(octree.octree().corner(n), octree.octree().side(n)).center())),
                        octree.octree().level(n));
    const auto leaves = leaves_of(both);
    both.refine_like(octrees[0]);
    both.refine_like(start);
    BOOST_TEST(leaves_of(both) == leaves);

    int level = Octree::max_level;
    for(Node_index n = 0; n < both.octree().size(); ++n)
      if(both.octree().is_leaf(n) && both.is_in_region(n) && both.side(n) == CGAL::ON_BOUNDARY)
        level = (std::min)(level, int(both.octree().level(n)));
    BOOST_TEST_EQ(both.level_of_surface_in_region(), level);
  }
}

// ---- the sequence ------------------------------------------------------------------------------

// The rule as documented, without the memory of the sequence.
class Rule
{
  const Region& m_region;
  const Aligned_traits& m_traits;
  const double m_radius;

public:
  Rule(const Region& region, const Aligned_traits& traits, double radius)
    : m_region(region), m_traits(traits), m_radius(radius)
  {
  }

  // The depth of a cell, or of the smallest one around it that is not small against the radius.
  double depth(const Located_octree& octree, Node_index n) const
  {
    while(n > 0 && octree.edge_length(n) < m_radius / 2)
      n = octree.octree().parent(n);
    return m_region.depth(center(octree, n));
  }

  Test_point center(const Located_octree& octree, Node_index n) const
  {
    return m_traits.cell(octree.octree().corner(n), octree.octree().side(n)).center();
  }

  double key(const Located_octree& octree, Node_index n) const
  {
    const double h = octree.edge_length(n);
    if(m_radius == 0 && !octree.is_in_region(n))
      return 0;
    double weight = 1;
    if(!octree.is_in_region(n)) {
      const double d = (std::max)(0., -octree.rounded(depth(octree, n)) - h / 2);
      weight = std::pow(1 + d / m_radius, -6);
    }
    weight *= m_region.weight(center(octree, n), m_radius);
    weight *= factor_by_surface(octree, n);
    if(octree.side(n) == CGAL::ON_BOUNDARY)
      weight += Refinement_sequence::weight_of_volume * m_radius / h;
    return weight * std::pow(h, 5);
  }

  double factor_by_surface(const Located_octree& octree, Node_index n) const
  {
    if(m_radius == 0 || octree.is_region_everywhere() || !octree.is_in_region(n))
      return octree.side(n) == CGAL::ON_BOUNDARY ? Refinement_sequence::factor_at_surface : 1;
    for(const double factor : {32., 8., 2.}) {
      if(octree.side(n) == CGAL::ON_BOUNDARY)
        return factor;
      n = n > 0 ? octree.octree().parent(n) : n;
    }
    return 1;
  }

  // The leaf to be split next; `no_node` if there is none.
  Node_index next(const Located_octree& octree) const
  {
    std::tuple<double, double, std::uint64_t> best{};
    Node_index chosen = Octree::no_node;
    for(Node_index n = 0; n < octree.octree().size(); ++n) {
      if(!octree.octree().is_leaf(n) || !octree.meets_domain(n)
         || octree.octree().level(n) == Octree::max_level)
        continue;
      const std::tuple<double, double, std::uint64_t> entry(key(octree, n),
                                                            octree.quantized(depth(octree, n)),
                                                            ~internal::lattice_key(
                                                              octree.octree().corner(n)));
      if(std::get<0>(entry) > 0 && (chosen == Octree::no_node || entry > best)) {
        best = entry;
        chosen = n;
      }
    }
    return chosen;
  }
};

void test_sequence(const Located_octree& start, const Rule& rule, double radius, std::size_t number_of_steps)
{
  Refinement_sequence sequence(start, radius);
  BOOST_TEST_EQ(sequence.number_of_steps(), 0u);
  std::vector<Located_octree> after{start}; // by refinement, step by step
  for(std::size_t i = 0; i < number_of_steps && sequence.extend(); ++i) {
    const Node_index n = sequence.cell(i);
    BOOST_TEST_EQ(n, rule.next(after.back()));
    BOOST_TEST(radius > 0 || after.back().is_in_region(n));
    after.push_back(after.back());
    after.back().refine(std::vector<Node_index>{n});
    BOOST_TEST_EQ(sequence.number_of_steps(), i + 1);
  }
  BOOST_TEST_EQ(sequence.number_of_steps(), number_of_steps);
  for(std::size_t i = 0; i < after.size(); ++i) {
    BOOST_TEST(is_same(sequence.octree(i), after[i]));
    BOOST_TEST_EQ(sequence.number_of_cells(i), after[i].number_of_cells());
    BOOST_TEST_EQ(sequence.number_of_nodes(i), after[i].octree().size());
    BOOST_TEST(is_balanced(after[i].octree(), Adjacency::EDGE));
  }
}

void test_sequences()
{
  const Analytic_domain domain(ball({0.5, 0.5, 0.5}, 0.45));
  for(const Bbox_3& root : {Bbox_3(0, 0, 0, 1, 1, 1), Bbox_3(0, 0, 0, 1, 0.95, 0.7)})
    for(const auto& [center, size] : {std::make_pair(Test_point(0.5, 0.5, 0.5), 0.2), // symmetric
                                      std::make_pair(Test_point(0.31, 0.62, 0.48), 0.13),
                                      std::make_pair(Test_point(0.1, 0.5, 0.4), 0.01)}) {
      const Aligned_traits traits(root, Root_cell::BOX);
      const auto test = [&](const Region& region) {
        const Located_octree octree(domain, region, traits);
        for(double radius : {0., 0.02, 0.1, 1.})
          for(int level : {0, 3})
            test_sequence(refined(octree, level), Rule(region, traits, radius), radius, 120);
      };
      test(ball_region(center, size));
      test(ball_region(center, size, [](const Test_point& p) { return p.y() < 0.3 ? 0 : 1 + 3 * p.x(); }));
    }
}

// A region without cells has nothing to split, and no radius.
void test_ends()
{
  const Analytic_domain domain(ball({0.5, 0.5, 0.5}, 0.3));
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const Region away = ball_region({5, 5, 5}, 0.1);
  const Located_octree octree(domain, away, traits);
  BOOST_TEST_EQ(mean_radius_of_region(octree), 0.);
  Refinement_sequence sequence(octree, 0);
  BOOST_TEST(!sequence.extend() && sequence.number_of_steps() == 0);
  for(double radius : {0.01, 0.1, 0.25}) {
    const Region region = ball_region({0.5, 0.4, 0.5}, radius);
    const double mean = mean_radius_of_region(Located_octree(domain, region, traits));
    BOOST_TEST(0.9 * radius < mean && mean < 1.1 * radius);
  }
  // The sheet contains no center, until cells are as small as it is thick.
  for(double thickness : {1e-3, 1e-7}) {
    const CGAL::Implicit_mixed_mesh_region_3 sheet(
      [&](const Test_point& p) { return thickness / 2 - std::abs(p.z() - 0.5); });
    const double exact = std::cbrt(0.75 * 0.09 * thickness);
    const double mean = mean_radius_of_region(Located_octree(domain, sheet, traits));
    BOOST_TEST(0.9 * exact < mean && mean < 0.3);
  }
}

// ---- the rule of the paper ---------------------------------------------------------------------

// Without grading, a split cell that does not meet the region has a smaller cell beside it that does, or that
// is split for such a cell.
void test_only_for_balance()
{
  const Analytic_domain domain(ball({0.5, 0.5, 0.5}, 0.45));
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const Region region = ball_region({0.4, 0.5, 0.6}, 0.02);
  const Located_octree start = refined(Located_octree(domain, region, traits), 2);
  Refinement_sequence sequence(start, 0);
  while(sequence.number_of_steps() < 300 && sequence.extend()) {
  }
  const Located_octree octree = sequence.octree(sequence.number_of_steps());
  const Octree& nodes = octree.octree();
  std::size_t number_for_balance = 0;
  for(Node_index n = 0; n < nodes.size(); ++n) {
    if(nodes.is_leaf(n) || nodes.level(n) < 2 || octree.is_in_region(n))
      continue;
    ++number_for_balance;
    bool has_reason = false;
    for(Node_index m = 0; m < nodes.size() && !has_reason; ++m)
      has_reason = !nodes.is_leaf(m) && nodes.level(m) == nodes.level(n) + 1 && touch(nodes, n, m);
    BOOST_TEST(has_reason);
  }
  BOOST_TEST_GT(number_for_balance, 10u);
}

// ---- the budget --------------------------------------------------------------------------------

struct Candidate
{
  std::size_t number_of_vertices = 0;
  bool is_stopped = false;
  bool manifold = true;
  std::size_t number_of_nodes = 0; // of the octree that it is of

  bool is_manifold() const { return manifold; }
};

using Count = std::function<std::size_t(std::size_t)>;

// Checks that the candidate belongs to the octree, and is the largest of all that fit.
void check_best(const Located_octree& start, double radius, std::size_t budget, const Count& count,
                const Located_octree& octree, const Candidate& best)
{
  const auto vertices = [&](const Located_octree& o) { return count(o.number_of_cells()); };
  BOOST_TEST_EQ(best.number_of_vertices, vertices(octree));
  BOOST_TEST_EQ(best.number_of_nodes, octree.octree().size());
  BOOST_TEST(is_balanced(octree.octree(), Adjacency::EDGE));
  if(vertices(start) > budget) {
    BOOST_TEST(is_same(octree, start));
    return;
  }
  BOOST_TEST_LE(best.number_of_vertices, budget);
  Refinement_sequence sequence(start, radius);
  std::size_t steps = 0, largest = vertices(start);
  while(sequence.extend() && count(sequence.number_of_cells(sequence.number_of_steps())) <= budget) {
    steps = sequence.number_of_steps();
    largest = count(sequence.number_of_cells(steps));
  }
  BOOST_TEST_GE(double(best.number_of_vertices), (std::min)(double(largest), 0.998 * double(budget)));
  if(double(best.number_of_vertices) > 0.97 * double(budget))
    return;
  // The budget is far from full, but none of the next cells fits in addition.
  while(sequence.number_of_steps() < steps + 10 && sequence.extend()) {
  }
  for(std::size_t i = steps; i < (std::min)(steps + 10, sequence.number_of_steps()); ++i) {
    const Node_index n = sequence.cell(i);
    if(n >= sequence.number_of_nodes(steps) || !octree.octree().is_leaf(n))
      continue;
    Located_octree trial = octree;
    trial.refine(std::vector<Node_index>{n});
    BOOST_TEST_GT(vertices(trial), budget);
  }
}

void test_budgets()
{
  const Analytic_domain domain(ball({0.5, 0.5, 0.5}, 0.45));
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const Region region = ball_region({0.35, 0.55, 0.5}, 0.15);
  const Located_octree start = refined(Located_octree(domain, region, traits), 2);
  const Count counts[] = {[](std::size_t n) { return n; },
                          [](std::size_t n) { return n + n / 4 + 8; },
                          [](std::size_t n) { return 50 * (n / 40); }, // by steps
                          [](std::size_t n) { return std::size_t(std::pow(double(n), 1.3)); },
                          [](std::size_t n) { return n < 200 ? 0 : n; }, // nothing inside
                          [](std::size_t n) { return n < 300 ? n / 3 : 3 * n; }};
  std::size_t number_not_full = 0;
  for(const Count& count : counts)
    for(double radius : {0., 0.1})
      for(std::size_t budget : {1, 60, 150, 301, 450, 777, 1200}) {
        std::size_t number_of_trials = 0;
        const auto try_octree = [&](const Located_octree& o) {
          ++number_of_trials;
          return Candidate{count(o.number_of_cells()), false, true, o.octree().size()};
        };
        Located_octree octree = start, again = start;
        const Candidate best = fill_vertex_budget(octree, budget, radius, try_octree);
        BOOST_TEST_LE(number_of_trials, 60u);
        check_best(start, radius, budget, count, octree, best);
        fill_vertex_budget(again, budget, radius, try_octree);
        BOOST_TEST(is_same(octree, again));
        number_not_full += best.number_of_vertices < budget;
      }
  BOOST_TEST_GT(number_not_full, 10u);
}

// Candidates that are pinched are skipped; a stop is final.
void test_other_candidates()
{
  const Analytic_domain domain(ball({0.5, 0.5, 0.5}, 0.45));
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const Region region = ball_region({0.35, 0.55, 0.5}, 0.15);
  const Located_octree start = refined(Located_octree(domain, region, traits), 2);
  const std::size_t first = start.number_of_cells();
  for(std::size_t one_in : {2, 3, 5})
    for(std::size_t budget : {200, 400, 900}) {
      Located_octree octree = start;
      const auto try_octree = [&](const Located_octree& o) {
        const std::size_t n = o.number_of_cells();
        return Candidate{n, false, n == first || n / 7 % one_in != 0, o.octree().size()};
      };
      const Candidate best = fill_vertex_budget(octree, budget, 0.1, try_octree);
      BOOST_TEST(best.is_manifold());
      BOOST_TEST_EQ(best.number_of_vertices, octree.number_of_cells());
      BOOST_TEST_LE(best.number_of_vertices, budget);
      BOOST_TEST_GT(2 * best.number_of_vertices, budget);
    }
  for(std::size_t stop_at = 1; stop_at < 6; ++stop_at) {
    std::size_t number_of_trials = 0;
    Located_octree octree = start;
    const Candidate best = fill_vertex_budget(octree, 777, 0.1, [&](const Located_octree& o) {
      ++number_of_trials;
      return number_of_trials == stop_at
               ? Candidate{0, true, true, 0}
               : Candidate{o.number_of_cells() / 10, false, true, o.octree().size()};
    });
    BOOST_TEST(best.is_stopped);
    BOOST_TEST_EQ(number_of_trials, stop_at);
  }
}

int run(int, char*[])
{
  test_truncate();
  test_refine_like();
  test_sequences();
  test_ends();
  test_only_for_balance();
  test_budgets();
  test_other_candidates();
  return boost::report_errors();
}

} // namespace test_octree_refinement
