// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concepts of the manual, from both sides: every model has all members of its concept, and an archetype,
// which has no other members, is sufficient for making a mesh.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/IO/MEDIT.h>
#include <CGAL/Mixed_mesh_3/IO/VTU.h>
#include <CGAL/Mixed_mesh_3/Scaled_jacobian_quality_3.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>
#include <CGAL/simplify_mixed_mesh_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using CGAL::Bounded_side;
using CGAL::Mixed_mesh_status;
using mm3::Lattice_point;
using mm3::Stage;
using Kernel = mm3::Predicates_kernel;
using Point_3 = Kernel::Point_3;
using Triangle_3 = Kernel::Triangle_3;

//-- Requirements of the concepts -------------------------------------------------------------------

// is_...<T>() does not compile if `T` is no model of the concept.
template <class T>
const T& a();
template <class T>
T& a_variable();
template <class From, class To>
constexpr bool converts = std::is_convertible_v<From, To>;

template <class T>
constexpr bool is_surface_part()
{
  return std::is_default_constructible_v<T> && std::is_copy_constructible_v<T>;
}

template <class Cell>
constexpr bool is_cell()
{
  const bool has_box = converts<decltype(a<Cell>().bbox()), CGAL::Bbox_3>;
  const bool has_center = converts<decltype(a<Cell>().center()), Point_3>;
  const bool has_test = converts<decltype(a<Cell>().do_intersect(a<Triangle_3>())), bool>;
  return has_box && has_center && has_test;
}

template <class Traits>
constexpr bool is_cell_traits()
{
  const bool has_point = converts<decltype(a<Traits>().point(a<Lattice_point>())), Point_3>;
  const bool has_cell = is_cell<decltype(a<Traits>().cell(a<Lattice_point>(), std::uint32_t()))>();
  return has_point && has_cell;
}

template <class Domain, class Cell>
constexpr bool is_domain()
{
  using P = typename Domain::Point_3;
  using Part = typename Domain::Surface_part;
  using Sample = decltype(*a<Domain>().surface_samples(1.).begin());
  return is_surface_part<Part>() && converts<Point_3, P> && std::is_constructible_v<P, double, double, double>
         && converts<decltype(CGAL::squared_distance(a<P>(), a<P>())), double>
         && converts<decltype(a<Domain>().bbox()), CGAL::Bbox_3>
         && converts<decltype(a<Domain>().surface_part()), Part>
         && converts<decltype(a<Domain>().locate(a<Cell>(), a<Part>(), a_variable<Part>())),
                     Bounded_side>
         && converts<decltype(a<Domain>().bounded_side(a<P>(), a<Part>())), Bounded_side>
         && converts<decltype(a<Domain>().closest_point(a<P>(), a<Part>())), P>
         && converts<decltype(a<Domain>().closest_point(a<P>(), a<P>())), P>
         && converts<decltype(a<Domain>().closest_point(a<P>())), P> && converts<Sample, P>;
}

template <class Domain>
constexpr bool is_domain_with_features()
{
  const bool has_edges = converts<decltype(a<Domain>().sharp_edges(50.)), mm3::Sharp_edges>;
  const bool has_planes = converts<decltype(a<Domain>().axis_parallel_planes()), mm3::Axis_parallel_planes>;
  return has_edges && has_planes && mm3::internal::has_features<Domain>();
}

template <class Domain>
constexpr bool is_domain_with_shells()
{
  const bool has_counts = converts<decltype(a<Domain>().shells()), std::optional<mm3::Shell_counts>>;
  const bool has_volume = converts<decltype(a<Domain>().volume()), std::optional<double>>;
  return has_counts && has_volume && mm3::internal::has_shells<Domain>();
}

template <class Domain>
constexpr bool is_labeled_domain()
{
  using P = typename Domain::Point_3;
  using Part = typename Domain::Surface_part;
  using Index = mm3::Subdomain_index;
  using Sample = decltype(*a<Domain>().surface_samples(1., Index()).begin());
  return mm3::internal::has_subdomains<Domain>()
         && converts<decltype(*a<Domain>().subdomain_indices().begin()), Index>
         && converts<decltype(a<Domain>().subdomain_index(a<P>(), a<Part>())), Index>
         && converts<decltype(a<Domain>().closest_point(a<P>(), Index(), Index())), P>
         && converts<decltype(a<Domain>().closest_point(a<P>(), a<P>(), Index(), Index())), P>
         && converts<Sample, P> && converts<decltype(a<Domain>().mean_chord_length(Index())), double>;
}

template <class Domain>
constexpr bool is_domain_with_sheets()
{
  using Sheet = std::decay_t<decltype(**a<Domain>().sheets().begin())>;
  return mm3::internal::has_sheets<Domain>() && is_labeled_domain<Domain>()
         && converts<decltype(a<Sheet>().may_intersect(a<CGAL::Bbox_3>())), bool>
         && converts<decltype(a<Sheet>().do_intersect(a<Point_3>(), a<Point_3>())), bool>
         && converts<decltype(a<Sheet>().closest_point(a<Point_3>(), a<Point_3>())), Point_3>;
}

template <class Region, class Cell>
constexpr bool is_region()
{
  using Part = typename Region::Surface_part;
  return is_surface_part<Part>() && converts<decltype(a<Region>().surface_part()), Part>
         && converts<decltype(a<Region>().locate(a<Cell>(), a<Part>(), a_variable<Part>())),
                     Bounded_side>
         && converts<decltype(a<Region>().depth(a<Point_3>())), double>;
}

template <class Region>
constexpr bool is_region_with_weights()
{
  return mm3::internal::has_weights<Region>()
         && converts<decltype(a<Region>().weight(a<Point_3>(), 1.)), double>;
}

template <class Quality>
constexpr bool is_quality()
{
  using Vector = mm3::Vec3;
  using Points = std::array<Vector, 8>;
  return std::is_copy_constructible_v<Quality>
         && converts<decltype(a<Quality>()(mm3::PRISM, a<Points>())), double>
         && converts<decltype(a<Quality>()(mm3::PRISM, a<Points>(), 1, a_variable<Vector>())), double>
         && converts<decltype(a<Quality>().is_acceptable(1.)), bool>;
}

template <class Visitor>
constexpr bool is_visitor()
{
  using Mesh = CGAL::Mixed_mesh_3<Kernel>;
  return std::is_same_v<decltype(a_variable<Visitor>().begin_stage(Stage())), void>
         && std::is_same_v<decltype(a_variable<Visitor>().end_stage(Stage())), void>
         && std::is_same_v<decltype(a_variable<Visitor>().progress(std::size_t(), std::size_t())), void>
         && converts<decltype(a_variable<Visitor>().go_on()), bool>
         && std::is_same_v<decltype(a_variable<Visitor>().before_fitting(a<Mesh>())), void>;
}

template <class Traits>
constexpr bool is_mesh_traits()
{
  using P = typename Traits::Point_3;
  return std::is_constructible_v<P, double, double, double> && std::is_copy_constructible_v<P>
         && std::is_copy_assignable_v<P> && converts<decltype(a<P>() == a<P>()), bool>
         && converts<decltype(CGAL::to_double(a<P>().x())), double>
         && converts<decltype(CGAL::to_double(a<P>().y())), double>
         && converts<decltype(CGAL::to_double(a<P>().z())), double>;
}

template <class Traits>
constexpr bool is_element_traits()
{
  constexpr std::size_t n = Traits::number_of_vertices;
  using Values = typename Traits::Shape_values;
  using Gradients = typename Traits::Shape_gradients;
  const bool has_reference = &Traits::reference == &mm3::reference_elements[Traits::kind]
                             && n == std::size_t(Traits::reference.number_of_vertices);
  const bool has_values = std::is_same_v<Values, std::array<double, n>>;
  const bool has_gradients = std::is_same_v<Gradients, std::array<std::array<double, 3>, n>>;
  const bool has_shapes = std::is_same_v<decltype(Traits::shape_functions(0., 0., 0.)), Values>;
  const bool has_slopes = std::is_same_v<decltype(Traits::shape_gradients(0., 0., 0.)), Gradients>;
  return has_reference && has_values && has_gradients && has_shapes && has_slopes;
}

//-- Archetypes: only the members of the concept ----------------------------------------------------

struct Archetype // neither default constructible, nor copied, nor moved
{
  explicit Archetype(int) {}
  Archetype(const Archetype&) = delete;
  Archetype& operator=(const Archetype&) = delete;
};

// The concepts do not require assignment.
struct Surface_part_archetype
{
  Surface_part_archetype() = default;
  Surface_part_archetype(const Surface_part_archetype&) = default;
  Surface_part_archetype& operator=(const Surface_part_archetype&) = delete;
};

struct Cell_archetype : Archetype
{
  using Archetype::Archetype;
  double x, y, z, side;
  CGAL::Bbox_3 bbox() const { return {x, y, z, x + side, y + side, z + side}; }
  Point_3 center() const { return {x + side / 2, y + side / 2, z + side / 2}; }
  bool do_intersect(const Triangle_3& t) const { return CGAL::do_intersect(t, bbox()); }
};

// Cubes in [-1.5, 1.5]^3: the unit is 1.5 * 2^-20 for the side 2^21 of the root.
struct Cell_traits_archetype : Archetype
{
  using Archetype::Archetype;
  Point_3 point(const Lattice_point& p) const { return {x(p[0]), x(p[1]), x(p[2])}; }

  struct Cell : Cell_archetype
  {
    Cell(double x0, double y0, double z0, double s) : Cell_archetype(0) { x = x0, y = y0, z = z0, side = s; }
  };
  Cell cell(const Lattice_point& p, std::uint32_t side) const
  {
    return Cell(x(p[0]), x(p[1]), x(p[2]), length(side));
  }

private:
  static double length(std::uint32_t side) { return side * std::ldexp(1.5, -20); }
  double x(std::uint32_t i) const { return length(i) - 1.5; }
};

// The unit ball.
struct Domain_archetype : Archetype
{
  using Archetype::Archetype;
  using Point_3 = ::Point_3;
  using Surface_part = Surface_part_archetype;

  CGAL::Bbox_3 bbox() const { return {-1, -1, -1, 1, 1, 1}; }
  Surface_part surface_part() const { return {}; }
  template <class Cell>
  Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    const CGAL::Bbox_3 b = cell.bbox();
    const double radius = std::hypot(b.x_span(), b.y_span(), b.z_span()) / 2;
    const double d = norm(cell.center()) - 1;
    return d > radius ? CGAL::ON_UNBOUNDED_SIDE : d < -radius ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_BOUNDARY;
  }
  Bounded_side bounded_side(const Point_3& p, const Surface_part&) const
  {
    const double d = norm(p) - 1;
    return d > 0 ? CGAL::ON_UNBOUNDED_SIDE : d < 0 ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_BOUNDARY;
  }
  Point_3 closest_point(const Point_3& p, const Surface_part&) const { return closest_point(p); }
  Point_3 closest_point(const Point_3& p, const Point_3&) const { return closest_point(p); }
  Point_3 closest_point(const Point_3& p) const
  {
    const double d = norm(p);
    return {p.x() / d, p.y() / d, p.z() / d};
  }
  std::array<Point_3, 6> surface_samples(double) const
  {
    return {Point_3(1, 0, 0),  Point_3(-1, 0, 0), Point_3(0, 1, 0),
            Point_3(0, -1, 0), Point_3(0, 0, 1),  Point_3(0, 0, -1)};
  }

private:
  static double norm(const Point_3& p) { return std::hypot(p.x(), p.y(), p.z()); }
};

// The unit ball, with what is known of it.
struct Refined_domain_archetype : Domain_archetype
{
  using Domain_archetype::closest_point;
  using Domain_archetype::Domain_archetype;
  using Domain_archetype::surface_samples;

  typedef CGAL::Tag_true Has_features;
  mm3::Sharp_edges sharp_edges(double) const { return {}; }
  mm3::Axis_parallel_planes axis_parallel_planes() const { return {}; }

  typedef CGAL::Tag_true Has_shells;
  std::optional<mm3::Shell_counts> shells() const { return mm3::Shell_counts{1, 2}; }
  std::optional<double> volume() const { return 4 * CGAL_PI / 3; }

  typedef CGAL::Tag_true Has_subdomains;
  std::array<mm3::Subdomain_index, 1> subdomain_indices() const { return {3}; }
  mm3::Subdomain_index subdomain_index(const Point_3& p, const Surface_part& part) const
  {
    return bounded_side(p, part) == CGAL::ON_BOUNDED_SIDE ? 3 : 0;
  }
  Point_3 closest_point(const Point_3& p, mm3::Subdomain_index, mm3::Subdomain_index) const
  {
    return closest_point(p);
  }
  Point_3 closest_point(const Point_3& p, const Point_3&, mm3::Subdomain_index, mm3::Subdomain_index) const
  {
    return closest_point(p);
  }
  std::array<Point_3, 6> surface_samples(double spacing, mm3::Subdomain_index) const
  {
    return surface_samples(spacing);
  }
  double mean_chord_length(mm3::Subdomain_index) const { return 4. / 3; }

  typedef CGAL::Tag_true Has_sheets;
  std::array<const CGAL::Mixed_mesh_sheet_3*, 0> sheets() const { return {}; }
};

// The half space x > 1/4.
struct Region_archetype : Archetype
{
  using Archetype::Archetype;
  using Surface_part = Surface_part_archetype;

  Surface_part surface_part() const { return {}; }
  template <class Cell>
  Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    const CGAL::Bbox_3 b = cell.bbox();
    return (b.xmax)() < 0.25   ? CGAL::ON_UNBOUNDED_SIDE
           : (b.xmin)() > 0.25 ? CGAL::ON_BOUNDED_SIDE
                               : CGAL::ON_BOUNDARY;
  }
  double depth(const Point_3& p) const { return p.x() - 0.25; }
};

struct Region_with_weights_archetype : Region_archetype
{
  using Region_archetype::Region_archetype;
  typedef CGAL::Tag_true Has_weights;
  double weight(const Point_3&, double) const { return 2; }
};

// Members that are not those of a refinement, as its model says.
struct Region_with_another_weight : Region_archetype
{
  typedef CGAL::Tag_false Has_weights;
  int weight() const { return 5; }
};

// A measure of a user: the worst corner, as a tetrahedron; its gradient by differences.
struct Quality_archetype
{
  explicit Quality_archetype(int) {}
  Quality_archetype(const Quality_archetype&) = default;
  Quality_archetype& operator=(const Quality_archetype&) = delete;

  using Vector = mm3::Vec3;
  using Points = std::array<Vector, 8>;

  double operator()(mm3::Element_kind kind, const Points& p) const
  {
    const mm3::Reference_element& reference = mm3::reference_elements[kind];
    double worst = 1;
    for(int c = 0; c < reference.number_of_corners; ++c) {
      const auto& k = reference.corners[c];
      double squares = 0;
      for(int i = 0; i < 4; ++i)
        for(int j = 0; j < i; ++j)
          squares += dot(edge(p, k[i], k[j]), edge(p, k[i], k[j]));
      const Vector u = edge(p, k[0], k[1]), v = edge(p, k[0], k[2]), w = edge(p, k[0], k[3]);
      const Vector n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      if(!(dot(n, w) > 0))
        return std::numeric_limits<double>::infinity();
      worst = (std::max)(worst, std::pow(squares / 6, 1.5) / (std::sqrt(2.) * dot(n, w)));
    }
    return worst;
  }
  double operator()(mm3::Element_kind kind, const Points& p, int v, Vector& gradient) const
  {
    const double step = 1e-6 * std::sqrt(dot(edge(p, 0, 1), edge(p, 0, 1)));
    for(int k = 0; k < 3; ++k) {
      Points q = p, r = p;
      q[std::size_t(v)][std::size_t(k)] += step;
      r[std::size_t(v)][std::size_t(k)] -= step;
      gradient[std::size_t(k)] = ((*this)(kind, q) - (*this)(kind, r)) / (2 * step);
    }
    return (*this)(kind, p);
  }
  bool is_acceptable(double cost) const { return cost < 10; }

private:
  static Vector edge(const Points& p, int a, int b)
  {
    const Vector &x = p[std::size_t(a)], &y = p[std::size_t(b)];
    return {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
  }
  static double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
};

// Notes its calls, and returns false when asked for the n-th time.
struct Visitor_archetype : Archetype
{
  explicit Visitor_archetype(int n) : Archetype(0), m_questions(n) {}

  void begin_stage(Stage s) { m_log.emplace_back(s, true); }
  void end_stage(Stage s) { m_log.emplace_back(s, false); }
  void progress(std::size_t, std::size_t) { ++m_trials; }
  bool go_on() { return --m_questions != 0; }
  void before_fitting(const CGAL::Mixed_mesh_3<Kernel>&) {}

  // Members for the test, not of the concept.
  const std::vector<std::pair<Stage, bool>>& log() const { return m_log; }
  std::size_t trials() const { return m_trials; }
  int questions() const { return -m_questions; } // of a visitor that never returns false

private:
  int m_questions;
  std::size_t m_trials = 0;
  std::vector<std::pair<Stage, bool>> m_log;
};

struct Mesh_traits_archetype
{
  class Point_3
  {
    double m[3];

  public:
    Point_3() = delete;
    Point_3(double x, double y, double z) : m{x, y, z} {}
    double x() const { return m[0]; }
    double y() const { return m[1]; }
    double z() const { return m[2]; }
    friend bool operator==(const Point_3& p, const Point_3& q)
    {
      return p.x() == q.x() && p.y() == q.y() && p.z() == q.z();
    }
  };
  Mesh_traits_archetype() = delete;
};

template <mm3::Element_kind Kind>
struct Element_traits_archetype
{
  static constexpr mm3::Element_kind kind = Kind;
  static constexpr const mm3::Reference_element& reference = mm3::reference_elements[Kind];
  static constexpr int number_of_vertices = reference.number_of_vertices;
  using Shape_values = std::array<double, number_of_vertices>;
  using Shape_gradients = std::array<std::array<double, 3>, number_of_vertices>;
  static Shape_values shape_functions(double, double, double) { return {}; }
  static Shape_gradients shape_gradients(double, double, double) { return {}; }
  Element_traits_archetype() = delete;
};

//-- Models and archetypes satisfy the concepts -----------------------------------------------------

using CGAL::Ball_mixed_mesh_region_3;
using CGAL::Everywhere_mixed_mesh_region_3;
using CGAL::Implicit_mixed_mesh_region_3;
using CGAL::Labeled_polyhedral_mixed_mesh_domain_3;
using CGAL::Polyhedral_mixed_mesh_domain_3;
using CGAL::Polyhedral_mixed_mesh_region_3;
using CGAL::Polyhedral_mixed_mesh_regions_3;
using CGAL::Union_mixed_mesh_region_3;
using CGAL::Weighted_mixed_mesh_region_3;
using mm3::Axis_aligned_octree_cell_traits_3;
using mm3::Rotated_octree_cell_traits_3;

template <class Traits>
constexpr bool is_cell_traits_with_all()
{
  using Cell = decltype(a<Traits>().cell(a<Lattice_point>(), std::uint32_t()));
  using Union = Union_mixed_mesh_region_3<Ball_mixed_mesh_region_3, Polyhedral_mixed_mesh_region_3>;
  return is_cell_traits<Traits>() && is_domain<Polyhedral_mixed_mesh_domain_3, Cell>()
         && is_domain<Labeled_polyhedral_mixed_mesh_domain_3, Cell>() && is_domain<Domain_archetype, Cell>()
         && is_region<Polyhedral_mixed_mesh_region_3, Cell>()
         && is_region<Implicit_mixed_mesh_region_3, Cell>() && is_region<Ball_mixed_mesh_region_3, Cell>()
         && is_region<Everywhere_mixed_mesh_region_3, Cell>() && is_region<Union, Cell>()
         && is_region<Polyhedral_mixed_mesh_regions_3, Cell>()
         && is_region<Weighted_mixed_mesh_region_3<Region_archetype>, Cell>()
         && is_region<Region_archetype, Cell>();
}
static_assert(is_cell_traits_with_all<Axis_aligned_octree_cell_traits_3>());
static_assert(is_cell_traits_with_all<Rotated_octree_cell_traits_3>());
static_assert(is_cell_traits_with_all<Cell_traits_archetype>());

// Refinements, and models that are none.
static_assert(is_domain_with_features<Polyhedral_mixed_mesh_domain_3>());
static_assert(is_domain_with_features<Labeled_polyhedral_mixed_mesh_domain_3>());
static_assert(is_domain_with_features<Refined_domain_archetype>());
static_assert(!mm3::internal::has_features<Domain_archetype>());
static_assert(is_domain_with_shells<Polyhedral_mixed_mesh_domain_3>());
static_assert(is_domain_with_shells<Labeled_polyhedral_mixed_mesh_domain_3>());
static_assert(is_domain_with_shells<Refined_domain_archetype>());
static_assert(!mm3::internal::has_shells<Domain_archetype>());
static_assert(is_domain_with_sheets<Labeled_polyhedral_mixed_mesh_domain_3>());
static_assert(is_domain_with_sheets<Refined_domain_archetype>());
static_assert(!mm3::internal::has_subdomains<Polyhedral_mixed_mesh_domain_3>());
static_assert(!mm3::internal::has_sheets<Polyhedral_mixed_mesh_domain_3>());
static_assert(is_region_with_weights<Polyhedral_mixed_mesh_regions_3>());
static_assert(is_region_with_weights<Weighted_mixed_mesh_region_3<Region_archetype>>());
static_assert(
  is_region_with_weights<Union_mixed_mesh_region_3<Region_with_weights_archetype, Region_archetype>>());
static_assert(is_region_with_weights<Region_with_weights_archetype>());
static_assert(!mm3::internal::has_weights<Polyhedral_mixed_mesh_region_3>());
static_assert(!mm3::internal::has_weights<Union_mixed_mesh_region_3<Region_archetype, Region_archetype>>());
static_assert(!mm3::internal::has_weights<Region_with_another_weight>());

// Members without a tag are found whatever their signature is: overloaded, static, not const, a template.
template <class Model>
constexpr bool is_told_of_shells = mm3::internal::tag_of<Model, mm3::internal::Shell_members>()
                                   != mm3::internal::Tag_of_model::MISSING;
struct Overloaded_volume
{
  double volume() const;
  double volume(int) const;
};
struct Volume_template
{
  template <class T>
  T volume(T);
};
struct Static_volume
{
  static int volume;
};
struct Derived_volume : Overloaded_volume
{
};
struct Tagged_volume : Overloaded_volume
{
  typedef CGAL::Tag_false Has_shells;
};
static_assert(!is_told_of_shells<Overloaded_volume> && !is_told_of_shells<Volume_template>);
static_assert(!is_told_of_shells<Static_volume> && !is_told_of_shells<Derived_volume>);
static_assert(is_told_of_shells<Tagged_volume> && is_told_of_shells<Domain_archetype>);

// A model with points of an exact kernel is refused, with a message; a ball may have a center of any kernel.
struct Exact_surface
{
  using Point_3 = CGAL::Exact_predicates_exact_constructions_kernel::Point_3;
  Point_3 closest_point(const Point_3& p) const { return p; }
};
static_assert(mm3::internal::has_points_of_doubles<Domain_archetype>());
static_assert(!mm3::internal::has_points_of_doubles<Exact_surface>());
static_assert(std::is_constructible_v<Ball_mixed_mesh_region_3, Exact_surface::Point_3, double>);

static_assert(is_visitor<mm3::Default_visitor>() && is_visitor<Visitor_archetype>());

static_assert(is_quality<mm3::Aspect_ratio_quality_3>() && is_quality<mm3::Scaled_jacobian_quality_3>());
static_assert(is_quality<Quality_archetype>());

static_assert(is_mesh_traits<CGAL::Exact_predicates_inexact_constructions_kernel>());
static_assert(is_mesh_traits<CGAL::Exact_predicates_exact_constructions_kernel>());
static_assert(is_mesh_traits<CGAL::Simple_cartesian<double>>());
static_assert(is_mesh_traits<Mesh_traits_archetype>());

template <mm3::Element_kind Kind>
constexpr bool are_element_traits = is_element_traits<mm3::Mixed_element_traits_3<Kind>>()
                                    && is_element_traits<Element_traits_archetype<Kind>>();
static_assert(are_element_traits<mm3::TETRAHEDRON> && are_element_traits<mm3::PYRAMID>);
static_assert(are_element_traits<mm3::PRISM> && are_element_traits<mm3::HEXAHEDRON>);

//-- Meshes made with archetypes --------------------------------------------------------------------

constexpr double volume_of_ball = 4 * 3.14159265358979 / 3;

// The least and the largest distance of the boundary vertices from the center.
template <class Mesh>
std::pair<double, double> radii_of_boundary(const Mesh& mesh)
{
  std::pair<double, double> radii(100, 0);
  for(auto v : mm3::boundary_vertices(mesh)) {
    const auto& p = mesh.point(v);
    const double r = std::hypot(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    radii = {(std::min)(radii.first, r), (std::max)(radii.second, r)};
  }
  return radii;
}

// Tests everything that takes a mesh, and that the mesh is that of a ball, with its boundary on the surface.
template <class Mesh>
void test_mesh(const CGAL::Mixed_mesh_result_3& result, const Mesh& mesh, std::size_t budget)
{
  BOOST_TEST(result.status == Mixed_mesh_status::SUCCESS);
  BOOST_TEST(mesh.number_of_vertices() <= budget);
  BOOST_TEST(mm3::find_defects(mesh).none());
  BOOST_TEST(mm3::volume(mesh) < volume_of_ball);
  BOOST_TEST(mm3::volume(mesh) > 0.9 * volume_of_ball);
  BOOST_TEST(mm3::quality_statistics(mesh)[mm3::number_of_element_kinds].maximum < 3);
  const auto radii = radii_of_boundary(mesh);
  BOOST_TEST(std::abs(radii.first - 1) < 1e-14 && std::abs(radii.second - 1) < 1e-14);
  const Mesh tetrahedra = mm3::split_to_tetrahedra(mesh);
  BOOST_TEST(std::abs(mm3::volume(tetrahedra) - mm3::volume(mesh)) < 1e-2); // faces are not planar
  std::ostringstream vtu, medit;
  BOOST_TEST(mm3::IO::write_VTU(vtu, mesh));
  BOOST_TEST(mm3::IO::write_MEDIT(medit, mesh));
}

void test_archetypes()
{
  const Domain_archetype domain(0);
  const Region_archetype region(0);
  const Cell_traits_archetype cell_traits(0);
  const CGAL::Mixed_mesh_criteria_3 criteria(700);
  Visitor_archetype visitor(0);
  CGAL::Mixed_mesh_3<Mesh_traits_archetype> mesh;
  test_mesh(CGAL::make_mixed_mesh_3(domain, region, criteria, cell_traits, mesh,
                                    CGAL::parameters::visitor(std::ref(visitor))),
            mesh, 700);
  // The paper's mode would make some flat tetrahedra here with all vertices on the ball.
  const auto result = CGAL::make_mixed_mesh_3(
    domain, region, CGAL::Mixed_mesh_criteria_3(700).boundary_mode(mm3::Boundary_mode::PAPER), cell_traits,
    mesh, CGAL::parameters::visitor(std::ref(visitor)));
  BOOST_TEST(result.has_mesh());
  BOOST_TEST(mm3::find_defects(mesh).none());
  // What a domain knows is compared with the mesh; its label is that of the elements.
  const auto refined = CGAL::make_mixed_mesh_3(Refined_domain_archetype(0), Region_with_weights_archetype(0),
                                               CGAL::Mixed_mesh_criteria_3(700), mesh);
  test_mesh(refined, mesh, 700);
  BOOST_TEST(refined.shells_of_domain && refined.shells == refined.shells_of_domain);
  BOOST_TEST_EQ(mesh.subdomain_index(0), 3);
  // There are no cell traits, and no visitor.
  test_mesh(CGAL::make_mixed_mesh_3(domain, region, CGAL::Mixed_mesh_criteria_3(700), mesh), mesh, 700);
}

// The archetypes where the stages are called one by one.
void test_optimization()
{
  const Domain_archetype domain(0);
  CGAL::Mixed_mesh_3<Mesh_traits_archetype> start;
  const auto result = CGAL::make_mixed_mesh_3(domain, Region_archetype(0),
                                              CGAL::Mixed_mesh_criteria_3(700).fit_to_surface(false), start);
  BOOST_TEST(result.status == Mixed_mesh_status::SUCCESS);
  BOOST_TEST(mm3::volume(start) > volume_of_ball);
  const auto radii = radii_of_boundary(start);
  BOOST_TEST(radii.first >= 1 && radii.second > 1.05);

  for(double tolerance : {0., 0.1}) {
    auto mesh = start;
    Visitor_archetype visitor(0);
    const auto optimized = CGAL::optimize_mixed_mesh_3(mesh, domain, Quality_archetype(0),
                                                       CGAL::Mixed_mesh_optimization_criteria_3().tolerance(
                                                         tolerance),
                                                       CGAL::parameters::visitor(std::ref(visitor)));
    BOOST_TEST(optimized.status == CGAL::Mixed_mesh_optimization_status::SUCCESS);
    test_mesh(result, mesh, 700);
    const std::size_t number = mesh.number_of_vertices();
    const auto simplified = CGAL::simplify_mixed_mesh_3(mesh, domain, Quality_archetype(0), 1,
                                                        CGAL::parameters::visitor(std::ref(visitor)));
    BOOST_TEST(simplified.status == CGAL::Mixed_mesh_simplification_status::NUMBER_NOT_REACHED);
    BOOST_TEST(mesh.number_of_vertices() < number);
    BOOST_TEST(mm3::find_defects(mesh).none());
  }
}

// Our models replace one archetype at a time.
void test_models()
{
  const Domain_archetype ball(0);
  const CGAL::Mixed_mesh_criteria_3 criteria(700);
  const Axis_aligned_octree_cell_traits_3 aligned(ball.bbox());
  const std::vector<Point_3> corners = {{-1, -1, -1}, {1, 1, 1},   {-1, 1, 1}, {1, -1, -1},
                                        {1, -1, 1},   {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}};
  const Rotated_octree_cell_traits_3 rotated(corners, Kernel::Vector_3(1, 2, 3));
  const auto np = CGAL::parameters::default_values();

  CGAL::Mixed_mesh_3<Kernel> mesh;
  test_mesh(CGAL::make_mixed_mesh_3(ball, Region_archetype(0), criteria, aligned, mesh, np), mesh, 700);
  test_mesh(CGAL::make_mixed_mesh_3(ball, Region_archetype(0), criteria, rotated, mesh, np), mesh, 700);
  const Union_mixed_mesh_region_3 region(Ball_mixed_mesh_region_3({1, 0, 0}, 0.5),
                                         Implicit_mixed_mesh_region_3(
                                           [](const Point_3& p) { return p.z() - 0.5; }));
  test_mesh(CGAL::make_mixed_mesh_3(ball, region, criteria, mesh), mesh, 700);

  CGAL::Mixed_mesh_3<CGAL::Exact_predicates_exact_constructions_kernel> exact_mesh;
  test_mesh(CGAL::make_mixed_mesh_3(ball, Region_archetype(0), criteria, exact_mesh), exact_mesh, 700);
}

// Stages alternate as the manual says, and a visitor that returns false is obeyed.
void test_visitor()
{
  const Domain_archetype domain(0);
  const Region_archetype region(0);
  const auto criteria = CGAL::Mixed_mesh_criteria_3(700).tolerance(0).simplification(false);
  CGAL::Mixed_mesh_3<Mesh_traits_archetype> mesh;

  Visitor_archetype patient(0);
  auto result = CGAL::make_mixed_mesh_3(domain, region, criteria, mesh,
                                        CGAL::parameters::visitor(std::ref(patient)));
  BOOST_TEST(result.has_mesh());
  BOOST_TEST_EQ(patient.trials(), result.number_of_trials);
  BOOST_TEST(patient.trials() > 1);

  BOOST_TEST(patient.questions() > int(patient.trials()));
  for(int n = 1; n <= patient.questions(); ++n) {
    Visitor_archetype impatient(n);
    result = CGAL::make_mixed_mesh_3(domain, region, criteria, mesh,
                                     CGAL::parameters::visitor(std::ref(impatient)));
    BOOST_TEST(result.status == Mixed_mesh_status::STOPPED);
    BOOST_TEST(mesh.is_empty());
    const bool is_in_search = n <= int(patient.trials());
    BOOST_TEST_EQ(impatient.trials(), is_in_search ? std::size_t(n - 1) : patient.trials());

    // The stages are one at a time, and each of them is ended once.
    const auto& log = impatient.log();
    BOOST_TEST_EQ(log.size() % 2, 0u);
    for(std::size_t i = 0; i + 1 < log.size(); i += 2)
      BOOST_TEST(log[i].second && !log[i + 1].second && log[i].first == log[i + 1].first);
    BOOST_TEST(log.back() == std::make_pair(is_in_search ? Stage::OCTREE : Stage::OPTIMIZATION, false));
  }
  const auto& log = patient.log();
  BOOST_TEST(log.front() == std::make_pair(Stage::OCTREE, true));
  BOOST_TEST(log.back() == std::make_pair(Stage::OPTIMIZATION, false));

  // The tolerance has coarse meshes measured first, and more rounds follow.
  const CGAL::Mixed_mesh_criteria_3 with_tolerance = CGAL::Mixed_mesh_criteria_3(criteria).tolerance(0.05);
  const auto questions_until = [&](int n) {
    Visitor_archetype visitor(n);
    result = CGAL::make_mixed_mesh_3(domain, region, with_tolerance, Cell_traits_archetype(0), mesh,
                                     CGAL::parameters::visitor(std::ref(visitor)));
    BOOST_TEST_EQ(visitor.log().size() % 2, 0u);
    for(std::size_t i = 0; i + 1 < visitor.log().size(); i += 2)
      BOOST_TEST(visitor.log()[i].second && !visitor.log()[i + 1].second
                 && visitor.log()[i].first == visitor.log()[i + 1].first);
    return visitor.questions();
  };
  const int questions = questions_until(0);
  BOOST_TEST(result.has_mesh());
  BOOST_TEST_GT(questions, patient.questions());
  for(int n = 1; n <= questions; ++n) {
    BOOST_TEST_EQ(questions_until(n), 0); // after a false, the visitor is not asked again
    BOOST_TEST(result.status == Mixed_mesh_status::STOPPED);
    BOOST_TEST(mesh.is_empty());
  }
}

int main()
{
  test_archetypes();
  test_optimization();
  test_models();
  test_visitor();
  return boost::report_errors();
}
