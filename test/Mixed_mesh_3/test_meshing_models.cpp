// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Domains of users, through the public concepts: their optional descriptions of the surface are used, and are
// not required.

#include "test_meshing.h"

#include <CGAL/Implicit_mixed_mesh_domain_3.h>
#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_regions_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <optional>
#include <vector>

namespace test_meshing_models {

const CGAL::Everywhere_mixed_mesh_region_3 everywhere;

// Two balls of radius 1, by a signed distance; smoothly joined where they are near to each other if `blend`
// is positive.
class Two_balls : public CGAL::Implicit_mixed_mesh_domain_3
{
public:
  Two_balls(double distance, double blend)
    : Implicit_mixed_mesh_domain_3(
      [=](const Point_3& p) {
        const double a = 1 - std::hypot(p.x() + distance / 2, p.y(), p.z()),
                     b = 1 - std::hypot(p.x() - distance / 2, p.y(), p.z());
        const double larger = (std::max)(a, b), h = (std::max)(0., 1 - std::abs(a - b) / (blend + 1e-300));
        return larger + h * h * blend / 4; // polynomial smooth maximum: of Lipschitz constant 1
      },
      CGAL::Bbox_3(-distance / 2 - 1.1, -1.1, -1.1, distance / 2 + 1.1, 1.1, 1.1))
  {
  }
};

// The same domain, which describes its surface.
class Two_balls_with_shells : public Two_balls
{
  Shell_counts m_shells;

public:
  using Has_shells = CGAL::Tag_true;
  Two_balls_with_shells(double distance, double blend, const Shell_counts& shells)
    : Two_balls(distance, blend), m_shells(shells)
  {
  }
  std::optional<Shell_counts> shells() const { return m_shells; }
  std::optional<double> volume() const { return std::nullopt; }
};

// A box in a rotated frame, given by its planes.
class Box_domain
{
public:
  using Point_3 = ::Point_3;
  struct Surface_part
  {
  };

  Box_domain(const Vec3& extents, double angle)
    : m_half(0.5 * extents), m_cosine(std::cos(angle)), m_sine(std::sin(angle))
  {
  }

  CGAL::Bbox_3 bbox() const
  {
    CGAL::Bbox_3 box;
    for(int i = 0; i < 8; ++i)
      box += corner(i).bbox();
    return box;
  }
  Surface_part surface_part() const { return {}; }

  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    const CGAL::Bbox_3 b = cell.bbox();
    const double radius = std::hypot(b.x_span(), b.y_span(), b.z_span()) / 2;
    const double d = depth(to_frame(cell.center()));
    return d > radius ? CGAL::ON_BOUNDED_SIDE : d < -radius ? CGAL::ON_UNBOUNDED_SIDE : CGAL::ON_BOUNDARY;
  }
  CGAL::Bounded_side bounded_side(const Point_3& p, const Surface_part&) const
  {
    const double d = depth(to_frame(p));
    return d > 0 ? CGAL::ON_BOUNDED_SIDE : d < 0 ? CGAL::ON_UNBOUNDED_SIDE : CGAL::ON_BOUNDARY;
  }

  Point_3 closest_point(const Point_3& p) const
  {
    Vec3 q = to_frame(p);
    if(depth(q) > 0) {
      std::size_t nearest = 0;
      for(std::size_t k = 1; k < 3; ++k)
        if(m_half[k] - std::abs(q[k]) < m_half[nearest] - std::abs(q[nearest]))
          nearest = k;
      q[nearest] = q[nearest] < 0 ? -m_half[nearest] : m_half[nearest];
    }
    for(std::size_t k = 0; k < 3; ++k)
      q[k] = (std::min)((std::max)(q[k], -m_half[k]), m_half[k]);
    return from_frame(q);
  }
  Point_3 closest_point(const Point_3& p, const Surface_part&) const { return closest_point(p); }
  Point_3 closest_point(const Point_3& p, const Point_3&) const { return closest_point(p); }

  std::vector<Point_3> surface_samples(double spacing) const
  {
    std::vector<Point_3> samples;
    for(std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const int m = int(std::ceil(2 * m_half[i] / spacing)), n = int(std::ceil(2 * m_half[j] / spacing));
      for(const double side : {-1., 1.})
        for(int a = 0; a <= m; ++a)
          for(int b = 0; b <= n; ++b) {
            Vec3 q;
            q[k] = side * m_half[k];
            q[i] = (2. * a / m - 1) * m_half[i];
            q[j] = (2. * b / n - 1) * m_half[j];
            samples.push_back(from_frame(q));
          }
    }
    return samples;
  }

protected:
  const Vec3 m_half;
  const double m_cosine, m_sine;

  Point_3 corner(int i) const
  {
    return from_frame(
      {(i & 1 ? 1 : -1) * m_half[0], (i & 2 ? 1 : -1) * m_half[1], (i & 4 ? 1 : -1) * m_half[2]});
  }

private:
  double depth(const Vec3& q) const
  {
    return (std::min)({m_half[0] - std::abs(q[0]), m_half[1] - std::abs(q[1]), m_half[2] - std::abs(q[2])});
  }
  Vec3 to_frame(const Point_3& p) const
  {
    return {m_cosine * p.x() + m_sine * p.y(), -m_sine * p.x() + m_cosine * p.y(), p.z()};
  }
  Point_3 from_frame(const Vec3& q) const
  {
    return {m_cosine * q[0] - m_sine * q[1], m_sine * q[0] + m_cosine * q[1], q[2]};
  }
};

struct Box_with_edges : Box_domain
{
  using Box_domain::Box_domain;
  using Has_features = CGAL::Tag_true;

  Axis_parallel_planes axis_parallel_planes() const { return {}; }
  Sharp_edges sharp_edges(double angle) const
  {
    Sharp_edges edges;
    for(int i = 0; i < 8; ++i)
      edges.points.push_back(to_vec3(corner(i)));
    for(std::size_t i = 0; i < 8 && angle <= 90; ++i)
      for(std::size_t bit : {1, 2, 4})
        if((i & bit) == 0)
          edges.edges.push_back({i, i | bit});
    return edges;
  }
};

struct Box_with_planes : Box_domain
{
  using Has_features = CGAL::Tag_true;
  explicit Box_with_planes(const Vec3& extents) : Box_domain(extents, 0) {}

  Sharp_edges sharp_edges(double) const { return {}; }
  Axis_parallel_planes axis_parallel_planes() const
  {
    Axis_parallel_planes planes;
    for(std::size_t k = 0; k < 3; ++k)
      for(const double side : {-1., 1.})
        planes[k][side * m_half[k]] = 8 * m_half[0] * m_half[1] * m_half[2] / (2 * m_half[k]);
    return planes;
  }
};

// A narrow gap, which is bridged if no description tells of the gap; and a blend, which needs no description.
void test_thin_parts()
{
  const struct
  {
    double distance, blend;
    Shell_counts shells;
    std::size_t budget;
  } cases[] = {{2.06, 0, {2, 4}, 3000}, {2.05, 0.12, {1, 2}, 700}};
  for(const auto& one : cases) {
    Mesh plain, informed;
    const Mixed_mesh_result_3 without = run(Two_balls(one.distance, one.blend), everywhere,
                                            Mixed_mesh_criteria_3(one.budget), plain),
                              with = run(Two_balls_with_shells(one.distance, one.blend, one.shells),
                                         everywhere, Mixed_mesh_criteria_3(one.budget), informed);
    BOOST_TEST(!without.shells_of_domain && !without.shells);
    const bool is_gap = one.shells.number_of_shells == 2;
    BOOST_TEST_EQ(internal::shells_of_boundary(plain) != one.shells, is_gap);
    BOOST_TEST(with.shells_of_domain == one.shells);
    BOOST_TEST(with.shells == one.shells);
    BOOST_TEST(with.status < Status::VOLUME_DIFFERS);
    std::cout << "distance " << one.distance << ": status " << int(without.status) << ", " << int(with.status)
              << std::endl;
  }
}

// The mesh does not match the domain's description, and the status says so.
void test_topology_that_differs()
{
  Mesh mesh;
  const Shell_counts torus{1, 0}, sphere{1, 2};
  const Mixed_mesh_result_3 result = run(Two_balls_with_shells(1, 0.2, torus), everywhere,
                                         Mixed_mesh_criteria_3(500), mesh);
  BOOST_TEST(result.status == Status::TOPOLOGY_DIFFERS);
  BOOST_TEST(result.has_mesh() && result.shells_of_domain == torus && result.shells == sphere);
}

struct Box_of_volume : Box_domain
{
  using Has_shells = CGAL::Tag_true;
  double told;
  Box_of_volume(const Vec3& extents, double told_volume) : Box_domain(extents, 0.3), told(told_volume) {}
  double volume() const { return told; }
  std::optional<Shell_counts> shells() const { return Shell_counts{1, 2}; }
};

void test_volume_that_differs()
{
  Mesh mesh;
  BOOST_TEST(run(Box_of_volume({1, 1, 1}, 1.), everywhere, Mixed_mesh_criteria_3(1000), mesh).status
             < Status::VOLUME_DIFFERS);
  BOOST_TEST(run(Box_of_volume({1, 1, 1}, 1.5), everywhere, Mixed_mesh_criteria_3(1000), mesh).status
             == Status::VOLUME_DIFFERS);
}

void test_sharp_edges()
{
  const Vec3 extents{1, 0.8, 0.6};
  const double length = 4 * (extents[0] + extents[1] + extents[2]), volume_of_box = 0.48;
  Mesh with, without;
  const auto criteria = Mixed_mesh_criteria_3(1500);
  const Mixed_mesh_result_3 sharp = run(Box_with_edges(extents, 0.3), everywhere, criteria, with),
                            blunt = run(Box_domain(extents, 0.3), everywhere, criteria, without);
  BOOST_TEST_LT(std::abs(sharp.optimization.length_of_sharp_edges - length), 1e-9);
  BOOST_TEST_GT(sharp.optimization.length_of_sharp_edges_kept, 0.98 * length);
  BOOST_TEST_EQ(blunt.optimization.length_of_sharp_edges, 0.);
  BOOST_TEST_LT(std::abs(volume(with) / volume_of_box - 1), 0.005);
  BOOST_TEST_LT(std::abs(volume(with) - volume_of_box), 0.5 * std::abs(volume(without) - volume_of_box));
}

void test_planes()
{
  Mesh mesh;
  const Mixed_mesh_result_3 result = run(Box_with_planes({1, 0.75, 0.5}), everywhere,
                                         Mixed_mesh_criteria_3(700), mesh);
  BOOST_TEST(result.is_lattice_on_surface);
  BOOST_TEST(std::all_of(mesh.elements().kinds().begin(), mesh.elements().kinds().end(),
                         [](Element_kind kind) { return kind == HEXAHEDRON; }));
  BOOST_TEST_LT(std::abs(volume(mesh) - 0.375), 1e-12);
}

// A surface given directly is meshed like a surface with a label.
void test_labels()
{
  const Surface surface = sphere(Point_3(0, 0, 0), 1, 16);
  CGAL::Labeled_polyhedral_mixed_mesh_domain_3 labeled;
  labeled.add(surface, 1);
  Mesh a, b;
  run(Polyhedral_mixed_mesh_domain_3(surface), everywhere, Mixed_mesh_criteria_3(800), a);
  run(labeled, everywhere, Mixed_mesh_criteria_3(800), b);
  BOOST_TEST(content(a) == content(b));
}

int run(int, char*[])
{
  test_thin_parts();
  test_topology_that_differs();
  test_volume_that_differs();
  test_sharp_edges();
  test_planes();
  test_labels();
  return boost::report_errors();
}

} // namespace test_meshing_models
