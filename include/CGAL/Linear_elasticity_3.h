// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear elasticity on mixed meshes, for many load cases: section 6.2 of Lobos, Bucki, Hitschfeld, Payan:
// "Mixed-element mesh for an intra-operative modeling of the brain tumor extraction".

#ifndef CGAL_LINEAR_ELASTICITY_3_H
#define CGAL_LINEAR_ELASTICITY_3_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Linear_elasticity_result_3.h>
#include <CGAL/Linear_elasticity_3/buoyant_forces.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_model.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_solver.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_location_3.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {

namespace Mixed_meshes_3 {
namespace internal {

/// The components `[0]`, `[1]`, `[2]` of a range of any type, as vectors.
template <class Range>
std::vector<Vec3> vectors(const Range& range)
{
  std::vector<Vec3> result;
  for(const auto& x : range)
    result.push_back(components(x));
  return result;
}

/// The positions of a mesh's vertices.
template <class Mesh>
std::vector<Vec3> points_of(const Mesh& mesh)
{
  std::vector<Vec3> points;
  points.reserve(mesh.number_of_vertices());
  for(const auto& p : mesh.points())
    points.push_back(to_vec3(p));
  return points;
}

} // namespace internal
} // namespace Mixed_meshes_3

/*!
\ingroup PkgLinearElasticity3Ref

\brief Linear elasticity on a mixed mesh: factored once, solved for many load cases; with small rotations or
finite ones.

Elements are isoparametric; elements of the four kinds fit together. The resistance to a change of volume is
by the mean dilatation of a hexahedron, of two prisms, and of a patch of tetrahedra and pyramids, so that
nearly incompressible materials do not lock. In a patch, as much of the bulk modulus as twice the shear
modulus counts in each element by itself.

Units: millimeters, kilopascals, kilograms, seconds. Therefore forces are in millinewtons (kPa mm^2), and
forces by volume in mN/mm^3.

The order of use:
-# `order()`, if displacements are to be quadratic;
-# *supports*: `prescribe()` and `slide()` vertices, let them `touch()` a wall; the others are free;
-# `factor()`;
-# *loads*: `set_body_force()` or `set_body_forces()`, `set_gravity()`, `set_support_displacement()`,
   `set_control_points()`; in any order, and again as often as wanted;
-# `solve()`, and read `displacements()`.

After a resection, call `remove_elements()`: supports, loads, control points and the factorization stay.

Supports may leave rigid motions free, if the control points hold these: control points alone can hold the
mesh.

The mesh must outlive the object and not change. Models can be moved: a model that was moved from can be
destroyed or assigned to. Models cannot be copied, as factorizations cannot.

\tparam Mesh a `Mixed_mesh_3`
\tparam SolverTraits a model of `SparseLinearAlgebraWithFactorTraits_d`, direct, or as exact as a direct one.
A member `set_near_kernel(Eigen::MatrixXd, int)`, as `Petsc_solver_traits` has, gets before each factorization
the rigid motions of the unknowns, in the directions that are free: six columns, and the number of unknowns of
a vertex, 3
*/
template <class Mesh, class SolverTraits = Mixed_meshes_3::Direct_solver_traits>
class Linear_elasticity_3
{
  using Solver = Mixed_meshes_3::internal::Elasticity_solver_adaptor<SolverTraits>;

  const Mesh* m_mesh;
  Mixed_meshes_3::internal::Elasticity_model m_model;

public:
  /// The number of a vertex.
  using Vertex_index = Mixed_meshes_3::Vertex_index;
  /// The number of an element.
  using Element_index = Mixed_meshes_3::Element_index;
  /// A material of elements.
  using Elastic_material = Mixed_meshes_3::Elastic_material;
  /// A displacement in mm, a force in mN, a point.
  using Vec3 = Mixed_meshes_3::Vec3;
  /// The type of vectors, `Vec3`.
  using Vector = Vec3;
  /// The result of an operation.
  using Result = Linear_elasticity_result_3;
  /// The status in which an operation ended.
  using Status = Linear_elasticity_status;

  /// Constructs a model of one material: by default E = 1 kPa, nu = 0.45, 1e-6 kg/mm^3.
  explicit Linear_elasticity_3(const Mesh& mesh, const Elastic_material& material = Elastic_material())
    : Linear_elasticity_3(mesh, std::vector<Elastic_material>{material})
  {
  }

  /// Constructs a model with a material for each element, as `Mixed_meshes_3::materials_of_elements()`
  /// returns them by subdomain.
  Linear_elasticity_3(const Mesh& mesh, std::vector<Elastic_material> materials)
    : m_mesh(&mesh), m_model(mesh.elements(), Mixed_meshes_3::internal::points_of(mesh), std::move(materials),
                             std::make_unique<Solver>())
  {
  }

  /// \name Order
  /// Functions to be called before `factor()`. Quadratic displacements are many times as accurate as linear
  /// ones on the same mesh, and take more unknowns: seven times as many, if all elements are tetrahedra.
  ///
  /// The displacement in an element of order 2 is the sum over its vertices, as with order 1, plus the sum of
  /// a function for each edge, which is 1 in the middle of the edge and 0 on other edges, times a
  /// coefficient. Edges are straight. Fields are continuous across elements of all kinds and both orders.
  /// Dilatations are not averaged, as elements of order 2 hardly lock with Poisson's ratios up to 0.49.
  ///
  /// With order 2 anywhere, contacts, finite rotations, and solvers with `set_near_kernel()` are refused:
  /// `factor()` and `solve()` return `ORDER_NOT_SUPPORTED`.
  /// @{

  /// Chooses linear or quadratic displacements for all elements. Default: 1.
  /// \pre the order is 1 or 2
  void order(int order)
  {
    CGAL_precondition(order == 1 || order == 2);
    m_model.set_quadratic_elements(order == 1 ? std::vector<bool>()
                                              : std::vector<bool>(mesh().number_of_elements(), true));
  }

  /// The order that a user would choose for a mesh: 2 up to 3,000 vertices, else 1. So a solution takes less
  /// than 0.1 s. Brains in tetrahedra take, with order 2, 0.5 s for the factor, 12 ms for a solution and 80
  /// MiB with 660 vertices; 5.5 s, 90 ms and 620 MiB with 3,000; 10 s, 170 ms and 980 MiB with 5,000.
  static int recommended_order(std::size_t number_of_vertices) { return number_of_vertices <= 3000 ? 2 : 1; }

  /// The largest order of an element.
  int order() const { return m_model.quadratic_edges().empty() ? 1 : 2; }

  /// Chooses quadratic displacements for the elements that are in the region of interest, or have a vertex
  /// within a distance of such elements, in mm; linear ones for the others, but for the edges that they share
  /// with these.
  /// \pre `distance` is not negative
  void order_2_within(double distance)
  {
    CGAL_precondition(distance >= 0);
    std::vector<bool> is_in_region;
    for(Element_index e = 0; e < mesh().number_of_elements(); ++e)
      is_in_region.push_back(mesh().is_in_region(e));
    m_model.set_quadratic_within(distance, is_in_region);
  }

  /// Both ends of each edge that has a coefficient, the smaller one first. With order 2 of all elements,
  /// edges are numbered as their middles are in files of order 2; with order 1, there are none.
  const std::vector<std::array<Vertex_index, 2>>& quadratic_edges() const
  {
    return m_model.quadratic_edges();
  }
  /// @}

  /// \name Supports
  /// Functions to be called before `factor()`.
  ///
  /// With order 2, an edge of a boundary face whose vertices are all supported is held in the directions in
  /// which both of its ends are held: its middle then moves as the mean of its ends. `prescribe_boundary()`
  /// gives it another displacement, and prescribes the middles of edges with a free end, too. Other edges are
  /// free.
  /// @{

  /// Gives a vertex a displacement, in mm. The default fixes it.
  void prescribe(Vertex_index v, const Vector& displacement = Vector{})
  {
    m_model.prescribe(v, displacement);
  }

  /// Gives the boundary a displacement, in mm, where a function has a value: vertices, and with order 2 the
  /// middles of edges, also of those with a free end. The order may be chosen before or afterwards.
  /// \param displacement `std::optional<Vector>(const Vector& point)`, called for the vertices of the
  /// boundary and for the middles of its edges
  template <class Displacement>
  void prescribe_boundary(const Displacement& displacement)
  {
    m_model.prescribe_boundary([&](const Vector& p) -> std::optional<Vector> { return displacement(p); });
  }

  /// Lets a vertex slide without friction, orthogonally to a direction; on an edge or in a corner of several
  /// such planes if called again. A prescribed vertex stays prescribed.
  /// \param v vertex
  /// \param normal vector of any length but zero
  void slide(Vertex_index v, const Vector& normal) { m_model.slide(v, normal); }

  /// Lets boundary vertices slide without friction along the boundary, as on the inside of the skull.
  /// \param is_sliding `bool(Vertex_index)`, called for the vertices of the boundary
  template <class Is_sliding>
  void slide_along_boundary(const Is_sliding& is_sliding)
  {
    m_model.slide_along_boundary([&](Vertex_index v) { return bool(is_sliding(v)); });
  }

  /*!
  Lets a vertex touch a plane wall without friction: the vertex can slide along the wall and leave the wall,
  but not get beyond it. `solve()` finds out which vertices touch; each change of contacts takes a new
  factorization, and three solutions of the system for each control point. A vertex that is prescribed, or
  cannot move in that direction, stays as it is.

  Other supports, or control points, should hold rigid motions while contacts are open; otherwise `solve()`
  may end with `FREE_RIGID_MOTION`.

  \param v vertex; of several calls for a vertex, the last one counts
  \param normal vector to the outside, of any length but zero
  \param gap displacement in mm, in the direction of the normal, at which the vertex touches the wall
  */
  void touch(Vertex_index v, const Vector& normal, double gap = 0)
  {
    CGAL_precondition(norm(normal) > 0 && std::isfinite(gap));
    m_model.touch(v, normal, gap);
  }

  /// Lets boundary vertices touch the boundary as it is, or at a gap in mm: as the brain touches the skull,
  /// from which it sinks away when the fluid is drained.
  /// \param is_touching `bool(Vertex_index)`, called for the vertices of the boundary
  /// \param gap gap in mm between the boundary and the wall
  template <class Is_touching>
  void touch_along_boundary(const Is_touching& is_touching, double gap = 0)
  {
    CGAL_precondition(std::isfinite(gap));
    m_model.touch_along_boundary([&](Vertex_index v) { return bool(is_touching(v)); }, gap);
  }
  /// @}

  /*!
  Assembles and factors the system for the supports.

  \return `NO_ELEMENTS`, `ORDER_NOT_SUPPORTED`, `INVERTED_ELEMENT`, `SOLVER_FAILED` or `SUCCESS`. The status
  is `SUCCESS` even if supports leave rigid motions free: control points may hold them, as `solve()` will
  tell.
  \par Complexity
  Complexity of the sparse factorization: with nested dissection O(n^2) operations and O(n^(4/3)) memory for n
        vertices
  */
  Result factor() { return m_model.factor(); }

  /*!
  Removes elements, after a resection for example (see `Mixed_meshes_3::resect()`). Supports, loads and
  control points stay; vertices without an element have no displacement.

  The factorization stays as well. From here on `solve()` iterates: conjugate gradients for the stiffness K'
  that is left, with the factor of the former stiffness K as the preconditioner. On the vertices that are
  left, K is K' plus the Schur complement of the removed part. Both parts resist the displacement of their
  common interface alike, so that the number of iterations hardly depends on the mesh, and is small. A new
  `factor()`, when there is time, makes `solve()` direct again.

  The system is factored at once if iterations do not suffice: if a part or a rigid motion comes free, if a
  control point was in a removed element (the point is located again then), or if control points have a
  compliance.

  \param is_removed true for each element to be removed; elements removed before stay removed
  \return the result as that of `factor()` and `set_control_points()`
  \pre `factor()` was successful
  \par Complexity
  Linear; the complexity of `factor()` if the system is factored
  */
  Result remove_elements(const std::vector<bool>& is_removed)
  {
    CGAL_precondition(is_factored() && is_removed.size() == removed_elements().size());
    return m_model.remove_elements(is_removed);
  }

  /// Sets the accuracy of `solve()` after `remove_elements()`, and with finite rotations: the error in the
  /// energy norm, relative to that of the solution. Default: 1e-3, well below the error due to the mesh. Each
  /// power of ten takes about five iterations.
  /// \pre `tolerance` is positive
  void set_iteration_tolerance(double tolerance)
  {
    CGAL_precondition(tolerance > 0);
    m_model.set_iteration_tolerance(tolerance);
  }

  /*!
  Chooses between small rotations, which is the default, and finite rotations: corotational elements. The law
  of the material stays linear, in a frame that turns with each element; so rotations may be large, but
  strains should not be. Supports, control points, loads, removals and the factorization are as before.
  Directions in which vertices slide, and forces, do not turn.

  `solve()` with finite rotations is Newton's method, each step by conjugate gradients with the factor of the
  linear system as preconditioner, to the tolerance of `set_iteration_tolerance()`; the method starts from the
  last solution, if there is one, and may end with
  - `INVERTED_ELEMENT`: the displacement inverts an element, by the certificate
  (`Mixed_meshes_3::jacobian_sign()`). The solution is valid all the same, and `displacements()` has it;
  - `NOT_CONVERGED`: no equilibrium was found, neither with all of the loads at once nor in parts.
  */
  void set_corotational(bool is_corotational) { m_model.set_corotational(is_corotational); }

  /// Whether rotations are finite.
  bool is_corotational() const { return m_model.is_corotational(); }

  /// Residuals of the last `solve()` with finite rotations: before each step, and of the result. In the
  /// energy norm, relative to that of the displacements.
  const std::vector<double>& residuals() const { return m_model.residuals(); }

  /// Whether `solve()` iterates, as elements have been removed since `factor()`.
  bool is_iterative() const { return m_model.is_iterative(); }

  /// Whether `factor()` has been called with success, so that `solve()` can be called.
  bool is_factored() const { return m_model.is_factored(); }

  /// \name Loads
  /// @{

  /// Sets a force by volume, in mN/mm^3, the same everywhere.
  void set_body_force(const Vector& force) { m_model.set_body_forces({force}); }

  /// Sets a force by volume for each element, such as the `Mixed_meshes_3::buoyant_forces()` of a fluid.
  /// \pre there are as many forces as elements
  void set_body_forces(std::vector<Vector> forces)
  {
    CGAL_precondition(forces.size() == mesh().number_of_elements());
    if(forces.empty())
      forces.push_back(Vector{});
    m_model.set_body_forces(std::move(forces));
  }

  /// Sets gravity: an acceleration in mm/s^2, times the density of each element; (0, 0, -9810) on the Earth,
  /// upright. Gravity is added to the body forces; in a fluid, set buoyant forces as well.
  void set_gravity(const Vector& acceleration) { m_model.set_gravity(acceleration); }

  /// Sets another displacement of a vertex that was prescribed, in mm, without a new factorization.
  /// Coefficients of edges stay as they are: the middle of an edge with both ends held moves by half as much.
  /// A middle that is prescribed though an end is free stays.
  /// \pre `prescribe()` was called for the vertex
  void set_support_displacement(Vertex_index v, const Vector& displacement)
  {
    m_model.set_support_displacement(v, displacement);
  }

  /*!
  Sets points that will have given displacements: points in space, each in the element that contains it. The
  displacement of a point is interpolated by the element's shape functions.

  \param points points in mm
  \param largest_distance largest distance in mm from the mesh of points outside; such a point stands for the
  nearest point of the boundary
  \param compliance compliance in mm/mN of a spring between each point and its displacement. With 0, the
  displacements are exact; measured displacements that are many to an element, and noisy, contradict each
  other then
  \param radius distance in mm within which the given displacement of a point is the mean displacement, by
  area, of the boundary's vertices; the displacement of the point itself if there are fewer than three
  vertices. The force on a single point makes a dent that is the deeper, the finer the mesh
  \param weights positive weight of each point: the compliance of a point is `compliance` divided by its
  weight, so that weights in proportion to the inverse variances of the measurements are right. Empty: 1
  \return `CONTROL_POINT_OUTSIDE` or `SOLVER_FAILED`: no control point is used; or `SUCCESS`
  \pre `factor()` was successful
  \par Complexity
  Three solutions of the system for each point, and 72 bytes for each vertex and point
  */
  template <class Points>
  Result set_control_points(const Points& points, double largest_distance = 0, double compliance = 0,
                            double radius = 0, std::vector<double> weights = {})
  {
    CGAL_precondition(is_factored() && compliance >= 0);
    CGAL_precondition(weights.empty() || weights.size() == std::size_t(std::size(points)));
    CGAL_precondition(
      std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0 && std::isfinite(w); }));
    return m_model.set_control_points(Mixed_meshes_3::internal::vectors(points),
                                      {largest_distance, compliance, radius, std::move(weights)});
  }
  /// @}

  /*!
  Solves for the loads. With contacts, solves several times, until no contact pulls, and no vertex is beyond
  its wall, starting with the contacts of the last solution.

  \param control_displacements displacement of each control point, in mm
  \return `FREE_RIGID_MOTION`, `CONTRADICTORY_CONTROL_POINTS`, `SOLVER_FAILED`, `NOT_CONVERGED` (contacts), or
  `SUCCESS`; `displacements()` returns the solution if successful, else the former one. With finite rotations,
  see `set_corotational()`
  \par Complexity
  For new displacements of the same control points: linear, in vertices times control points. For new loads or
  displacements of supports, one more solution of the system. After `remove_elements()`, about ten solutions
  of the system.
  \pre `factor()` was successful
  */
  template <class Displacements>
  Result solve(const Displacements& control_displacements)
  {
    CGAL_precondition(is_factored()
                      && std::size_t(std::size(control_displacements)) == number_of_control_points());
    return m_model.solve(Mixed_meshes_3::internal::vectors(control_displacements));
  }

  /// Solves without control points.
  Result solve() { return solve(std::vector<Vector>()); }

  /// The displacement of each vertex, in mm.
  const std::vector<Vector>& displacements() const { return m_model.displacements(); }

  /// The coefficient of each of `quadratic_edges()`, in mm: the displacement of the middle of the edge is the
  /// mean displacement of its ends plus the coefficient.
  const std::vector<Vector>& edge_coefficients() const { return m_model.edge_coefficients(); }

  /// The displacement of the middle of each of `quadratic_edges()`, in mm.
  std::vector<Vector> middle_displacements() const
  {
    std::vector<Vector> middles = edge_coefficients();
    for(std::size_t i = 0; i < middles.size(); ++i) {
      const auto& [v, w] = quadratic_edges()[i];
      middles[i] = middles[i] + 0.5 * (displacements()[v] + displacements()[w]);
    }
    return middles;
  }

  /// The displacement at a point of an element, in mm.
  /// \param location location in the mesh as it was: see `Element_locator_3`
  Vector displacement(const Mixed_meshes_3::Element_location_3& location) const
  {
    return m_model.displacement(location);
  }

  /// The force that each control point needs for its displacement, in mN.
  std::vector<Vector> control_forces() const { return m_model.control_forces(); }

  /// The given displacement minus the resulting one at each control point, in mm: zero without a compliance.
  std::vector<Vector> control_residuals() const { return m_model.control_residuals(); }

  /// The vertices, and their weights, whose displacements have the displacement of each control point as
  /// their weighted mean; weights add up to 1. With order 2, edges follow, whose coefficients are to be added
  /// with their weights: the number of an edge is the number of vertices plus that among
  /// `quadratic_edges()`.
  std::vector<std::vector<std::pair<Vertex_index, double>>> control_weights() const
  {
    return m_model.control_weights();
  }

  /// The directions in which supports hold a vertex, orthogonal to each other and of length 1: none if the
  /// vertex is free, three if it is prescribed. The directions of closed contacts are among them. After
  /// `factor()` with order 2, also those in which an edge is held, numbered as in `control_weights()`.
  std::vector<Vector> held_directions(Vertex_index v) const { return m_model.held_directions(v); }

  /*!
  The given displacement of each control point minus its displacement if the point were not used, in mm: the
  other points predict it. This difference is the error to be expected at targets nearby, without landmarks at
  the target. Infinite for a point without which rigid motions would be free.

  No system is solved again: the result is exact for small rotations and the contacts of the solution. With
  finite rotations, it is an estimate with the stiffness at rest, whose error grows with the rotation of the
  body.

  \pre `solve()` was successful since control points were set, and `is_iterative()` is false
  \par Complexity
  The cube of the number of control points
  */
  std::vector<Vector> leave_one_out_errors() const { return m_model.leave_one_out_errors(); }

  /// The force with which the wall pushes each vertex, in mN; 0 where contacts are open, or without contacts.
  /// See `touch()`.
  const std::vector<double>& contact_forces() const { return m_model.contact_forces(); }

  /// The elastic energy of the last solution, in microjoules (mN mm).
  double energy() const { return m_model.energy(); }

  /// The mesh given to the constructor.
  const Mesh& mesh() const { return *m_mesh; }
  /// True for each element that is removed.
  const std::vector<bool>& removed_elements() const { return m_model.removed_elements(); }
  /// The number of iterations of conjugate gradients in the last `solve()`; 0 if that was direct.
  int number_of_iterations() const { return m_model.number_of_iterations(); }
  /// The number of control points.
  std::size_t number_of_control_points() const { return m_model.number_of_control_points(); }
  /// The solver, to set its parameters before `factor()`.
  SolverTraits& solver() { return static_cast<Solver&>(m_model.solver()).traits(); }
};

} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_H
