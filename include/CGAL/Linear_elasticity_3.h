// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear elasticity on mixed meshes, for many load cases: section 6.2 of Lobos, Bucki, Hitschfeld, Payan:
// "Mixed-element mesh for an intra-operative modeling of the brain tumor extraction".

#ifndef CGAL_LINEAR_ELASTICITY_3_H
#define CGAL_LINEAR_ELASTICITY_3_H

#include <CGAL/Linear_elasticity_3/Linear_elasticity_result_3.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Linear_elasticity_3/internal/control_constraints.h>
#include <CGAL/Linear_elasticity_3/internal/dilatation_patches.h>
#include <CGAL/Mixed_mesh_3/internal/fem/elasticity_assembly.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
#include <CGAL/Linear_elasticity_3/internal/rigid_modes.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\brief Small-strain linear elasticity on a mixed mesh: factored once, solved for many load cases.

Elements are isoparametric; those of the four kinds fit together. What resists a change of volume is the mean
dilatation of a hexahedron or pyramid, of two prisms, and of a patch of tetrahedra, so that nearly incompressible
materials do not lock. In a patch, as much of the bulk modulus as twice the shear modulus counts in each element
by itself.

Units: millimeters, kilopascals, kilograms, seconds. So forces are in millinewtons (kPa mm^2), and forces by
volume in mN/mm^3.

The order of use:
-# *supports*: `prescribe()` and `slide()` vertices; the others are free;
-# `factor()`;
-# *loads*: `set_body_force()`, `set_gravity()`, `set_support_displacement()`, `set_control_points()`; in any
   order, and again as often as wanted;
-# `solve()`, and read `displacements()`.

After a resection, `remove_elements()`: supports, loads, control points and the factorization stay.

Supports may leave rigid motions free, as long as the control points hold these: the mesh can be held by control
points alone.

The mesh must outlive the object and not change.

\tparam Mesh a `Mixed_mesh_3`
\tparam SolverTraits a model of `SparseLinearAlgebraWithFactorTraits_d`, direct
*/
template <class Mesh, class SolverTraits = Mixed_meshes_3::Direct_solver_traits>
class Linear_elasticity_3
{
public:
  using Vertex_index = Mixed_meshes_3::Vertex_index;
  using Element_index = Mixed_meshes_3::Element_index;
  using Elastic_material = Mixed_meshes_3::Elastic_material;
  /// A displacement in mm, a force in mN, a point.
  using Vec3 = Mixed_meshes_3::Vec3;
  using Vector = Vec3;
  using Result = Linear_elasticity_result_3;
  using Status = Linear_elasticity_status;

  /// One material: by default E = 1 kPa, nu = 0.45, 1e-6 kg/mm^3.
  explicit Linear_elasticity_3(const Mesh& mesh, const Elastic_material& material = Elastic_material())
    : Linear_elasticity_3(mesh, std::vector<Elastic_material>{material})
  {}

  /// A material for each element.
  Linear_elasticity_3(const Mesh& mesh, std::vector<Elastic_material> materials)
    : m_mesh(mesh), m_materials(std::move(materials)), m_supports(mesh.number_of_vertices()),
      m_is_removed(mesh.number_of_elements(), false)
  {
    CGAL_precondition(m_materials.size() == 1 || m_materials.size() == mesh.number_of_elements());
    for([[maybe_unused]] const Elastic_material& m : m_materials)
      CGAL_precondition(m.young_modulus > 0 && m.poisson_ratio >= 0 && m.poisson_ratio < 0.5 && m.density >= 0);
    m_points.reserve(mesh.number_of_vertices());
    for(const auto& p : mesh.points())
      m_points.push_back(Mixed_meshes_3::to_vec3(p));
  }

  /// \name Supports
  /// To be set before `factor()`.
  /// @{

  /// Gives a vertex a displacement, in mm. The default fixes it.
  void prescribe(Vertex_index v, const Vector& displacement = Vector{})
  {
    m_supports[v].size = 3;
    m_supports[v].directions = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    m_supports[v].displacement = displacement;
  }

  /// Lets a vertex slide without friction, orthogonally to a direction; on an edge or in a corner of such planes
  /// when called again. A vertex that is prescribed stays so.
  /// \param v the vertex
  /// \param normal of any length but zero
  void slide(Vertex_index v, const Vector& normal) { m_supports[v].add(normal); }

  /// Lets boundary vertices slide without friction along the boundary, as on the inside of the skull.
  /// \param is_sliding `bool(Vertex_index)`, asked for the vertices of the boundary
  template <class Is_sliding>
  void slide_along_boundary(const Is_sliding& is_sliding)
  {
    using namespace Mixed_meshes_3::internal;
    // The integral of the normal times the vertex's shape function: then a flow along the boundary keeps the
    // volume.
    std::vector<Vec3> normals(m_mesh.number_of_vertices(), Vec3{});
    for(const auto& face : Mixed_meshes_3::boundary_faces(m_mesh)) {
      const auto v = face_vertices(m_mesh.element(face.element), face.local_face);
      const int n = v[3] == no_vertex ? 3 : 4;
      const auto corner = [&](int i) {
        const Vec3& p = m_points[v[i]];
        return cross(m_points[v[(i + 1) % n]] - p, m_points[v[(i + n - 1) % n]] - p);
      };
      for(int i = 0; i < n; ++i)
        normals[v[i]] = normals[v[i]]
                        + (n == 3 ? (1. / 6) * corner(i) : (1. / 12) * (corner(i) + (corner(1) + corner(3))));
    }
    for(Vertex_index v = 0; v < normals.size(); ++v)
      if(norm(normals[v]) > 0 && is_sliding(v))
        slide(v, normals[v]);
  }
  /// @}

  /*!
  Assembles and factors the system for the supports.

  \return `NO_ELEMENTS`, `INVERTED_ELEMENT`, `SOLVER_FAILED` or `SUCCESS`. It is a success if supports leave rigid
          motions free: control points may hold them, `solve()` will tell.
  \cost that of the sparse factorization: with nested dissection O(n^2) operations and O(n^(4/3)) memory for n
        vertices
  */
  Result factor()
  {
    m_system.reset();
    m_matrix.reset();
    m_locator.reset();
    Result result;
    if(is_all_removed())
      return failed(Status::NO_ELEMENTS);
    result.element = find_inverted_element();
    if(result.element != m_mesh.number_of_elements())
      return failed(Status::INVERTED_ELEMENT, result);

    const auto is_together = [this](Element_index e, Element_index f) {
      const Elastic_material &a = material(e), &b = material(f);
      return !m_is_removed[e] && !m_is_removed[f]
             && std::tie(a.young_modulus, a.poisson_ratio) == std::tie(b.young_modulus, b.poisson_ratio);
    };
    m_patches = Mixed_meshes_3::internal::dilatation_patches(m_mesh.elements(), m_points.size(), is_together);
    std::vector<std::vector<Vertex_index>> patch_vertices;
    m_patch_of.assign(m_mesh.number_of_elements(), no_patch);
    for(std::size_t i = 0; i < m_patches.size(); ++i) {
      patch_vertices.push_back(vertices_of(m_patches[i]));
      for(Element_index e : m_patches[i])
        m_patch_of[e] = i;
    }
    m_system.emplace(m_mesh.elements(), std::vector<bool>(m_points.size(), true), patch_vertices);
    m_system->clear();
    for(Element_index e = 0; e < m_mesh.number_of_elements(); ++e)
      if(!m_is_removed[e])
        add_element(e, 1);
    for(std::size_t i = 0; i < m_patches.size(); ++i)
      add_patch(i, 1);
    find_parts();
    return factor_system();
  }

  /*!
  Removes elements, after a resection for example (see `Mixed_meshes_3::resect()`). Supports, loads and control
  points stay; vertices without an element have no displacement.

  The factorization stays as well. From here on `solve()` iterates: conjugate gradients for the stiffness K' that
  is left, with the factor of the former stiffness K as the preconditioner. On the vertices that are left, K is
  K' plus the Schur complement of what was removed. Both resist the displacement of their common interface alike,
  so that the number of iterations hardly depends on the mesh, and is small. A new `factor()`, when there is
  time, makes `solve()` direct again.

  It is factored at once if that does not do: if a part or a rigid motion comes free, if a control point was in an
  element removed (it is located anew then), or if control points have a compliance.

  \param is_removed for each element; those removed before stay removed
  \return as `factor()` and `set_control_points()`
  \pre `factor()` was successful
  \cost linear; that of `factor()` if it is factored
  */
  Result remove_elements(const std::vector<bool>& is_removed)
  {
    CGAL_precondition(is_factored() && is_removed.size() == m_is_removed.size());
    subtract_elements(is_removed);
    m_locator.reset();
    if(is_all_removed()) {
      m_system.reset();
      return failed(Status::NO_ELEMENTS);
    }
    const auto numbers_of_motions = [this] {
      std::vector<std::size_t> n;
      for(const Part& part : m_parts)
        n.push_back(part.modes.size());
      return n;
    };
    const std::vector<std::size_t> before = numbers_of_motions();
    find_parts();
    m_is_loaded = false;
    m_is_iterative =
      numbers_of_motions() == before && m_compliance == 0
      && (!m_controls || m_controls->is_on(m_is_kept))
      && std::none_of(m_control_elements.begin(), m_control_elements.end(),
                      [this](Element_index e) { return m_is_removed[e]; });
    if(m_is_iterative)
      return Result();
    return factor_system();
  }

  /// How exact `solve()` is after `remove_elements()`: the error in the energy norm, relative to that of the
  /// solution. Default: 1e-3, well below what the mesh makes wrong. Each power of ten takes about five iterations.
  /// \pre positive
  void set_iteration_tolerance(double tolerance)
  {
    CGAL_precondition(tolerance > 0);
    m_iteration_tolerance = tolerance;
  }

  /// Whether `solve()` iterates, as elements have been removed since `factor()`.
  bool is_iterative() const { return m_is_iterative; }

  bool is_factored() const { return m_system.has_value(); }

  /// \name Loads
  /// @{

  /// A force by volume, in mN/mm^3, the same everywhere.
  void set_body_force(const Vector& force)
  {
    m_body_force = force;
    m_is_loaded = false;
  }

  /// Gravity: an acceleration in mm/s^2, times the density of each element; (0, 0, -9810) on the Earth, upright.
  void set_gravity(const Vector& acceleration)
  {
    m_gravity = acceleration;
    m_is_loaded = false;
  }

  /// Another displacement of a vertex that was prescribed, in mm. No new factorization.
  /// \pre `prescribe()` was called for the vertex
  void set_support_displacement(Vertex_index v, const Vector& displacement)
  {
    CGAL_precondition(m_supports[v].size == 3);
    m_supports[v].displacement = displacement;
    m_is_loaded = false;
  }

  /*!
  Points that will have given displacements: points in space, each in the element that contains it. The
  displacement there is interpolated by the element's shape functions.

  \param points in mm
  \param largest_distance points outside the mesh up to so far, in mm, stand for the nearest point of its boundary
  \param compliance in mm/mN: a spring between each point and its displacement gives way so much. With 0, the
         displacements are exact; measured ones that are many to an element, and noisy, contradict each other then
  \param radius in mm: what is given is the mean displacement, by area, of the boundary's vertices within so far
         from each point; of the point itself if there are fewer than three. The force on a single point makes a
         dent that is the deeper, the finer the mesh
  \return `CONTROL_POINT_OUTSIDE`: none of them is used; or `SOLVER_FAILED` or `SUCCESS`
  \pre `factor()` was successful
  \cost three solutions of the system a point, and 72 bytes a vertex and point
  */
  template <class Points>
  Result set_control_points(const Points& points, double largest_distance = 0, double compliance = 0,
                            double radius = 0)
  {
    CGAL_precondition(is_factored() && compliance >= 0);
    m_compliance = compliance;
    m_radius = radius;
    m_control_points.clear();
    m_control_elements.clear();
    m_controls.reset();
    m_largest_distance = largest_distance;
    if(m_is_iterative)
      if(const Result result = factor_system(); !result.is_success())
        return result;
    std::vector<Element_index> elements;
    std::vector<Mixed_meshes_3::internal::Control_weights> weights;
    std::vector<Vector> positions;
    for(const auto& p : points) {
      positions.push_back(Mixed_meshes_3::internal::components(p));
      const Mixed_meshes_3::Element_location_3 location = locator().nearest(positions.back());
      if(location.distance > largest_distance || !std::isfinite(location.distance)) {
        Result result;
        result.control_point = weights.size();
        result.distance = location.distance;
        return failed(Status::CONTROL_POINT_OUTSIDE, result);
      }
      Mixed_meshes_3::internal::Control_weights w;
      const auto element = m_kept_mesh.element(location.element); // the locator's number
      for(int i = 0; i < element.size(); ++i)
        if(location.weights[i] != 0)
          w.emplace_back(element[i], location.weights[i]);
      if(radius > 0)
        spread(positions.back(), radius, w);
      weights.push_back(std::move(w));
      elements.push_back(m_kept_elements[location.element]);
    }
    m_control_points = std::move(positions);
    m_control_elements = std::move(elements);
    return prepare_controls(std::move(weights));
  }
  /// @}

  /*!
  Solves for the loads.

  \param control_displacements in mm, of each control point
  \return `FREE_RIGID_MOTION`, `CONTRADICTORY_CONTROL_POINTS`, `SOLVER_FAILED` or `SUCCESS`; `displacements()` has
          the solution if successful, else it is as before
  \cost for new displacements of the same control points: linear, in vertices times control points. For new
        loads or displacements of supports, one solution of the system besides. After `remove_elements()`, about
        ten solutions of the system.
  \pre `factor()` was successful
  */
  template <class Displacements>
  Result solve(const Displacements& control_displacements)
  {
    CGAL_precondition(is_factored() && std::size_t(std::size(control_displacements)) == m_control_points.size());
    if(!m_is_loaded && !solve_loads())
      return failed(Status::SOLVER_FAILED);
    if(!m_controls) {
      const Result result = prepare_controls({});
      if(!result.is_success())
        return result;
    }
    Eigen::VectorXd wanted(Eigen::Index(3 * m_control_points.size()));
    Eigen::Index row = 0;
    for(const auto& u : control_displacements)
      for(double x : Mixed_meshes_3::internal::components(u))
        wanted[row++] = x;
    Mixed_meshes_3::internal::Control_solution solution;
    Result result = m_controls->solve(m_loaded, m_load, wanted, m_modes, solution);
    if(!result.is_success())
      return result;
    if(m_is_iterative && !iterate(wanted, solution)) {
      result = factor_system();
      return result.is_success() ? solve(control_displacements) : result;
    }
    m_control_forces = solution.forces;
    m_displacements.assign(m_points.size(), Vector{});
    using namespace Mixed_meshes_3::internal;
    for(Vertex_index v = 0; v < m_points.size(); ++v)
      if(m_is_kept[v])
        for(int k = 0; k < 3; ++k)
          m_displacements[v][k] = solution.displacements[3 * Eigen::Index(v) + k];
    return result;
  }

  /// As above, without control points.
  Result solve() { return solve(std::vector<Vector>()); }

  /// The displacement of each vertex, in mm.
  const std::vector<Vector>& displacements() const { return m_displacements; }

  /// The force that each control point needs for its displacement, in mN.
  std::vector<Vector> control_forces() const
  {
    std::vector<Vector> forces(std::size_t(m_control_forces.size() / 3));
    for(std::size_t i = 0; i < forces.size(); ++i)
      for(int k = 0; k < 3; ++k)
        forces[i][k] = m_control_forces[Eigen::Index(3 * i) + k];
    return forces;
  }

  /// The elastic energy of the solution, in microjoules (mN mm).
  double energy() const
  {
    Eigen::VectorXd u(3 * Eigen::Index(m_points.size()));
    for(std::size_t v = 0; v < m_points.size(); ++v)
      for(int k = 0; k < 3; ++k)
        u[Eigen::Index(3 * v) + k] = m_displacements.empty() ? 0 : m_displacements[v][k];
    return u.dot(product(u)) / 2;
  }

  const Mesh& mesh() const { return m_mesh; }
  const std::vector<bool>& removed_elements() const { return m_is_removed; }
  /// Of the last `solve()`; 0 if it was direct.
  int number_of_iterations() const { return m_is_iterative ? m_number_of_iterations : 0; }
  std::size_t number_of_control_points() const { return m_control_points.size(); }
  /// The solver, to set its parameters before `factor()`.
  SolverTraits& solver() { return m_solver; }

private:
  using Matrix = typename SolverTraits::Matrix;
  static constexpr std::size_t no_patch = std::size_t(-1);
  // Of iterations after a removal: when to factor instead.
  static constexpr int largest_number_of_iterations = 100, largest_number_of_rises = 20;

  const Elastic_material& material(Element_index e) const
  {
    return m_materials.size() == 1 ? m_materials.front() : m_materials[e];
  }

  bool is_all_removed() const
  {
    return std::find(m_is_removed.begin(), m_is_removed.end(), false) == m_is_removed.end();
  }

  static Result failed(Status status, Result result = Result())
  {
    result.status = status;
    return result;
  }

  Element_index find_inverted_element() const
  {
    for(Element_index e = 0; e < m_mesh.number_of_elements(); ++e)
      if(!m_is_removed[e]) {
        const auto element = m_mesh.element(e);
        const auto points =
          Mixed_meshes_3::internal::relative_points(element, [this](Vertex_index v) { return m_points[v]; });
        for(int q = 0; q < Mixed_meshes_3::internal::quadrature_rule(element.kind()).number_of_points; ++q)
          if(!(Mixed_meshes_3::internal::strain_operator(element.kind(), points, q).volume > 0))
            return e;
      }
    return Element_index(m_mesh.number_of_elements());
  }

  std::vector<Vertex_index> vertices_of(const std::vector<Element_index>& elements) const
  {
    std::vector<Vertex_index> vertices;
    for(Element_index e : elements)
      vertices.insert(vertices.end(), m_mesh.element(e).begin(), m_mesh.element(e).end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  void remove_removed(std::vector<Element_index>& elements) const
  {
    elements.erase(
      std::remove_if(elements.begin(), elements.end(), [this](Element_index e) { return m_is_removed[e]; }),
      elements.end());
  }

  // From the stiffness; patches that lose some of their elements become those of the others.
  void subtract_elements(const std::vector<bool>& is_removed)
  {
    std::vector<std::size_t> changed_patches;
    std::vector<Element_index> removed;
    for(Element_index e = 0; e < is_removed.size(); ++e)
      if(is_removed[e] && !m_is_removed[e]) {
        removed.push_back(e);
        if(m_patch_of[e] != no_patch)
          changed_patches.push_back(m_patch_of[e]);
      }
    std::sort(changed_patches.begin(), changed_patches.end());
    changed_patches.erase(std::unique(changed_patches.begin(), changed_patches.end()), changed_patches.end());
    for(std::size_t i : changed_patches)
      add_patch(i, -1);
    for(Element_index e : removed) {
      add_element(e, -1);
      m_is_removed[e] = true;
    }
    for(std::size_t i : changed_patches) {
      remove_removed(m_patches[i]);
      add_patch(i, 1);
    }
  }

  void add_element(Element_index e, double factor)
  {
    using Mixed_meshes_3::internal::Dilatation;
    Elastic_material m = material(e);
    m.young_modulus *= factor;
    m_system->add(e, m, m_points, m_points, m_patch_of[e] == no_patch ? Dilatation::MEAN : Dilatation::PATCH);
  }

  void add_patch(std::size_t i, double factor)
  {
    using namespace Mixed_meshes_3::internal;
    const std::vector<Element_index>& patch = m_patches[i];
    if(patch.empty())
      return;
    const std::vector<Vertex_index> vertices = vertices_of(patch);
    std::vector<Vec3> gradients(vertices.size(), Vec3{});
    double volume = 0;
    for(Element_index e : patch) {
      const auto element = m_mesh.element(e);
      const auto points = relative_points(element, [this](Vertex_index v) { return m_points[v]; });
      for(int q = 0; q < quadrature_rule(element.kind()).number_of_points; ++q) {
        const Strain_operator s = strain_operator(element.kind(), points, q);
        volume += s.volume;
        for(int a = 0; a < element.size(); ++a) {
          Vec3& g = gradients[std::size_t(std::lower_bound(vertices.begin(), vertices.end(), element[a])
                                          - vertices.begin())];
          g = g + s.volume * s.gradients[a];
        }
      }
    }
    const Elastic_material& m = material(patch.front());
    const double mean = (1 - pointwise_share(m)) * m.bulk_modulus();
    m_system->add_patch(vertices, gradients, factor * mean / volume, m_points);
  }

  // K u, with the stiffness of all vertices. The columns of a vertex are three, two and one entry on the diagonal,
  // then three rows a neighbor, the same in each.
  Eigen::VectorXd product(const Eigen::VectorXd& u) const
  {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size());
    for(std::size_t v = 0; v < m_points.size(); ++v) {
      const int* start = &m_system->starts()[3 * v];
      const double* const columns[3] = {&m_system->values()[start[0]], &m_system->values()[start[1]] - 1,
                                        &m_system->values()[start[2]] - 2};
      const double* const x = u.data() + 3 * v;
      Vec3 sum{};
      for(int k = 0; k < 3; ++k)
        for(int row = 0; row < 3; ++row)
          sum[row] += columns[(std::min)(row, k)][(std::max)(row, k)] * x[k];
      for(int i = 3; i < start[1] - start[0]; i += 3) {
        const int neighbor = m_system->rows()[start[0] + i];
        const double* const y = u.data() + neighbor;
        double* const g = f.data() + neighbor;
        for(int k = 0; k < 3; ++k) {
          const double* const block = columns[k] + i;
          for(int row = 0; row < 3; ++row) {
            g[row] += block[row] * x[k];
            sum[k] += block[row] * y[row];
          }
        }
      }
      for(int k = 0; k < 3; ++k)
        f[Eigen::Index(3 * v) + k] += sum[k];
    }
    return f;
  }

  struct Part
  {
    std::vector<Vertex_index> vertices;
    std::vector<Mixed_meshes_3::internal::Rigid_mode> modes; // that the supports leave free
  };

  void find_parts()
  {
    using namespace Mixed_meshes_3::internal;
    m_parts.clear();
    m_is_kept.assign(m_points.size(), false);
    for(std::vector<Vertex_index>& vertices : connected_vertices(
          m_mesh.elements(), m_points.size(), [this](Element_index e) { return !m_is_removed[e]; })) {
      for(Vertex_index v : vertices)
        m_is_kept[v] = true;
      std::vector<Rigid_mode> modes = free_rigid_modes(vertices, m_points, m_supports);
      m_parts.push_back({std::move(vertices), std::move(modes)});
    }
  }

  Result factor_system()
  {
    using namespace Mixed_meshes_3::internal;
    m_is_loaded = m_is_iterative = false;
    m_controls.reset();
    m_modes.clear();
    const double largest = *std::max_element(m_system->values().begin(), m_system->values().end());
    std::vector<double> springs(3 * m_points.size(), 0); // to be added to the diagonal
    for(const Part& part : m_parts) {
      for(std::size_t unknown : springs_for(part.vertices, part.modes))
        springs[unknown] = m_system->values()[m_system->starts()[unknown]];
      for(const Rigid_mode& mode : part.modes)
        m_modes.push_back({mode, part.vertices});
    }

    // K on the directions that are free, P K P, with something positive on those that are not. As springs hold
    // just as many unknowns as there are motions free, they bear nothing if the loads are in equilibrium.
    std::vector<Vertex_index> number(m_points.size(), no_vertex);
    if(m_matrix == nullptr) { // else the numbers stay, so that the symbolic factorization does
      m_unknowns.clear();
      for(Vertex_index v = 0; v < m_points.size(); ++v)
        if(m_is_kept[v] && m_supports[v].size < 3)
          m_unknowns.push_back(v);
    }
    for(std::size_t i = 0; i < m_unknowns.size(); ++i)
      number[m_unknowns[i]] = Vertex_index(i);
    std::vector<int> starts{0}, rows;
    std::vector<double> values;
    const std::vector<int>&all_starts = m_system->starts(), &all_rows = m_system->rows();
    const std::vector<double>& all = m_system->values();
    for(Vertex_index v : m_unknowns) {
      const std::size_t first = values.size();
      for(int k = 0; k < 3; ++k) {
        for(int i = all_starts[3 * v + k]; i < all_starts[3 * v + k + 1]; ++i)
          if(const Vertex_index w = number[std::size_t(all_rows[i]) / 3]; w != no_vertex) {
            rows.push_back(int(3 * w) + all_rows[i] % 3);
            values.push_back(all[i]);
          }
        starts.push_back(int(rows.size()));
      }
      values[first] += springs[3 * v];
      values[std::size_t(starts[starts.size() - 3])] += springs[3 * v + 1];
      values[std::size_t(starts[starts.size() - 2])] += springs[3 * v + 2];
    }
    project(starts, rows, values, largest);
    if(!m_unknowns.empty()) // CGAL's matrices are not
      m_matrix = std::make_unique<Matrix>(make_matrix<Matrix>(starts, rows, values));
    typename SolverTraits::NT denominator = 1;
    if(!m_unknowns.empty() && (!m_solver.factor(*m_matrix, denominator) || is_nearly_singular(largest))) {
      m_system.reset();
      m_matrix.reset();
      return failed(Status::SOLVER_FAILED);
    }
    return m_control_points.empty()
             ? Result()
             : set_control_points(std::vector<Vector>(m_control_points), m_largest_distance, m_compliance,
                                  m_radius);
  }

  // Hinges make a matrix that is singular but for rounding, so that it may have been factored. Forces of no
  // pattern move them without bound.
  bool is_nearly_singular(double scale)
  {
    constexpr double largest_condition = 1e13;
    Eigen::MatrixXd b(3 * Eigen::Index(m_unknowns.size()), 1), x;
    for(Eigen::Index i = 0; i < b.rows(); ++i)
      b(i, 0) = std::fmod(0.618033988749895 * double(i), 1) - 0.5;
    return !Mixed_meshes_3::internal::solve_columns(m_solver, b, x)
           || !(scale * x.norm() < largest_condition * b.norm());
  }

  // As many unknowns of a part as motions are free, such that holding these holds the part: rows of the matrix
  // of modes, by elimination with pivots.
  std::vector<std::size_t> springs_for(const std::vector<Vertex_index>& part,
                                       const std::vector<Mixed_meshes_3::internal::Rigid_mode>& modes) const
  {
    using Row = std::array<double, 6>;
    std::vector<std::size_t> chosen;
    if(modes.empty())
      return chosen;
    std::vector<std::pair<std::size_t, Row>> table;
    for(Vertex_index v : part)
      for(int k = 0; k < 3; ++k)
        if(m_supports[v].size < 3) {
          Row row{};
          for(std::size_t m = 0; m < modes.size(); ++m)
            row[m] = m_supports[v].free_part(modes[m](m_points[v]))[k];
          table.emplace_back(3 * v + k, row);
        }
    const auto dot = [](const Row& a, const Row& b) {
      double sum = 0;
      for(int i = 0; i < 6; ++i)
        sum += a[i] * b[i];
      return sum;
    };
    for(std::size_t m = 0; m < modes.size(); ++m) {
      const auto pivot = *std::max_element(table.begin(), table.end(), [&](const auto& a, const auto& b) {
        return dot(a.second, a.second) < dot(b.second, b.second);
      });
      chosen.push_back(pivot.first);
      const double square = dot(pivot.second, pivot.second);
      for(auto& [unknown, row] : table) {
        const double c = dot(row, pivot.second) / square;
        for(int i = 0; i < 6; ++i)
          row[i] -= c * pivot.second[i];
      }
    }
    return chosen;
  }

  // Replaces each block (v, w) by P_v (v, w) P_w, for vertices that slide or have no element any more, and adds
  // `scale` where that leaves nothing.
  void project(const std::vector<int>& starts, const std::vector<int>& rows, std::vector<double>& values,
               double scale) const
  {
    using namespace Mixed_meshes_3::internal;
    const auto is_plain = [&](Vertex_index v) { return m_supports[v].size == 0 && m_is_kept[v]; };
    const auto projector = [&](Vertex_index v) {
      Matrix_3x3 p{};
      if(m_is_kept[v])
        for(int k = 0; k < 3; ++k) {
          Vec3 unit{};
          unit[k] = 1;
          p[k] = m_supports[v].free_part(unit);
        }
      return p;
    };
    for(std::size_t j = 0; j < m_unknowns.size(); ++j) {
      const Vertex_index v = m_unknowns[j];
      const int* column = &starts[3 * j];
      // the columns are three, two and one entry on the diagonal, then three rows a neighbor
      const int neighbors = (column[1] - column[0] - 3) / 3;
      for(int i = -1; i < neighbors; ++i) {
        const Vertex_index w = i < 0 ? v : m_unknowns[std::size_t(rows[column[0] + 3 + 3 * i]) / 3];
        if(is_plain(v) && is_plain(w))
          continue;
        const auto entry = [&](int row, int k) -> double& {
          return i < 0 ? values[column[k] + row - k] : values[column[k] + 3 - k + 3 * i + row];
        };
        Matrix_3x3 block;
        for(int row = 0; row < 3; ++row)
          for(int k = 0; k < 3; ++k)
            block[row][k] = i < 0 && row < k ? entry(k, row) : entry(row, k);
        const Matrix_3x3 pv = projector(v), pw = projector(w);
        for(int k = 0; k < 3; ++k)
          for(int row = i < 0 ? k : 0; row < 3; ++row) {
            double sum = i < 0 ? scale * ((row == k) - pv[row][k]) : 0;
            for(int a = 0; a < 3; ++a)
              for(int b = 0; b < 3; ++b)
                sum += pw[row][a] * block[a][b] * pv[b][k];
            entry(row, k) = sum;
          }
      }
    }
  }

  // Solves for right-hand sides of all vertices; the solutions are in the free directions.
  bool solve_system(const Eigen::MatrixXd& forces, Eigen::MatrixXd& solutions)
  {
    using namespace Mixed_meshes_3::internal;
    const Eigen::Index n = 3 * Eigen::Index(m_unknowns.size());
    Eigen::MatrixXd b(n, forces.cols()), x;
    for(Eigen::Index c = 0; c < forces.cols(); ++c)
      for(std::size_t i = 0; i < m_unknowns.size(); ++i) {
        const Vertex_index v = m_unknowns[i];
        Vec3 f{};
        if(m_is_kept[v])
          f = m_supports[v].free_part({forces(3 * v, c), forces(3 * v + 1, c), forces(3 * v + 2, c)});
        for(int k = 0; k < 3; ++k)
          b(Eigen::Index(3 * i) + k, c) = f[k];
      }
    if(n > 0 && !solve_columns(m_solver, b, x))
      return false;
    solutions = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
    for(Eigen::Index c = 0; c < forces.cols(); ++c)
      for(std::size_t i = 0; i < m_unknowns.size(); ++i)
        for(int k = 0; k < 3; ++k)
          solutions(Eigen::Index(3 * m_unknowns[i]) + k, c) = x(Eigen::Index(3 * i) + k, c);
    return solutions.allFinite();
  }

  // The solution for body forces and supports, without control points.
  bool solve_loads()
  {
    using namespace Mixed_meshes_3::internal;
    const Eigen::Index n = 3 * Eigen::Index(m_points.size());
    Eigen::VectorXd force = Eigen::VectorXd::Zero(n), supported = Eigen::VectorXd::Zero(n);
    bool is_supported = false, is_loaded = false;
    for(Vertex_index v = 0; v < m_points.size(); ++v)
      if(m_is_kept[v])
        for(int k = 0; k < 3; ++k) {
          supported[3 * Eigen::Index(v) + k] = m_supports[v].displacement[k];
          is_supported = is_supported || m_supports[v].displacement[k] != 0;
        }
    if(m_body_force != Vector{} || m_gravity != Vector{}) {
      is_loaded = true;
      for(Element_index e = 0; e < m_mesh.number_of_elements(); ++e)
        if(!m_is_removed[e])
          add_body_force(e, force);
    }
    m_force = force;
    if(is_supported)
      force -= product(supported);
    m_load = force;
    if(is_loaded || is_supported) {
      Eigen::MatrixXd solution;
      if(!solve_system(force, solution))
        return false;
      m_loaded = solution.col(0) + supported;
    } else {
      m_loaded = Eigen::VectorXd::Zero(n);
    }
    m_is_loaded = true;
    return true;
  }

  void add_body_force(Element_index e, Eigen::VectorXd& force) const
  {
    using namespace Mixed_meshes_3::internal;
    const auto element = m_mesh.element(e);
    const auto points = relative_points(element, [this](Vertex_index v) { return m_points[v]; });
    const Vec3 density = m_body_force + material(e).density * m_gravity;
    const Quadrature_rule& rule = quadrature_rule(element.kind());
    for(int q = 0; q < rule.number_of_points; ++q) {
      const double volume = strain_operator(element.kind(), points, q).volume;
      for(int a = 0; a < element.size(); ++a)
        for(int k = 0; k < 3; ++k)
          force[3 * Eigen::Index(element[a]) + k] += volume * rule.values[q][a] * density[k];
    }
  }

  // Conjugate gradients in the space of displacements that are zero at the control points (N. I. M. Gould,
  // M. E. Hribar, J. Nocedal: "On the solution of equality constrained quadratic programming problems arising in
  // optimization", SIAM J. Sci. Comput. 23, 2001). The solution for the former stiffness is where they start.
  bool iterate(const Eigen::VectorXd& wanted, Mixed_meshes_3::internal::Control_solution& solution)
  {
    using Mixed_meshes_3::internal::Control_solution;
    Eigen::VectorXd& u = solution.displacements;
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(Eigen::Index(3 * m_control_points.size()));
    solution.forces = nothing;
    Control_solution step;
    const auto precondition = [&](Eigen::VectorXd& r) {
      Eigen::MatrixXd z;
      if(!solve_system(r, z)
         || !m_controls->solve(z.col(0), r, nothing, m_modes, step).is_success())
        return false;
      m_controls->add_forces(step.forces, r); // so that rounding errors do not grow
      r = free_part(std::move(r));
      solution.forces += step.forces;
      return true;
    };
    Eigen::VectorXd r = free_part(m_force - product(u));
    if(!precondition(r))
      return false;
    Eigen::VectorXd p = step.displacements;
    double rz = r.dot(p);
    const double bound = m_iteration_tolerance * m_iteration_tolerance * u.dot(product(u));
    double least = rz;
    int rises = 0; // since rounding errors may be all that is left
    for(m_number_of_iterations = 0; m_number_of_iterations < largest_number_of_iterations;
        ++m_number_of_iterations) {
      if(!(rz > bound))
        return m_controls->is_satisfied(u, wanted);
      rises = rz < least ? 0 : rises + 1;
      least = (std::min)(least, rz);
      if(rises > largest_number_of_rises)
        return false;
      const Eigen::VectorXd q = free_part(product(p));
      const double alpha = rz / p.dot(q);
      u += alpha * p;
      r -= alpha * q;
      if(!std::isfinite(alpha) || !precondition(r))
        return false;
      const double next = r.dot(step.displacements);
      p = step.displacements + (next / rz) * p;
      rz = next;
    }
    return false;
  }

  // The components in directions that are free, of vertices that are left.
  Eigen::VectorXd free_part(Eigen::VectorXd f) const
  {
    for(Vertex_index v = 0; v < m_points.size(); ++v) {
      const Eigen::Index i = 3 * Eigen::Index(v);
      const Vec3 x = m_is_kept[v] ? m_supports[v].free_part({f[i], f[i + 1], f[i + 2]}) : Vec3{};
      for(int k = 0; k < 3; ++k)
        f[i + k] = x[k];
    }
    return f;
  }

  Result prepare_controls(std::vector<Mixed_meshes_3::internal::Control_weights> weights)
  {
    m_controls.emplace(std::move(weights), m_compliance, m_modes, m_points, m_supports,
                       [this](const Eigen::MatrixXd& f, Eigen::MatrixXd& u) { return solve_system(f, u); });
    if(m_controls->is_solved())
      return Result();
    m_controls.reset();
    return failed(Status::SOLVER_FAILED);
  }

  // The weights of the boundary around a point, unless there are too few vertices.
  void spread(const Vector& p, double radius, Mixed_meshes_3::internal::Control_weights& weights)
  {
    using namespace Mixed_meshes_3::internal;
    if(m_boundary_areas.empty()) {
      m_boundary_areas.assign(m_points.size(), 0);
      for(const auto& face : Mixed_meshes_3::boundary_faces(m_kept_mesh)) {
        const auto v = face_vertices(m_kept_mesh.element(face.element), face.local_face);
        const int n = v[3] == no_vertex ? 3 : 4;
        const auto triangle = [&](int b, int c) {
          return norm(cross(m_points[v[b]] - m_points[v[0]], m_points[v[c]] - m_points[v[0]])) / 2;
        };
        const double area = triangle(1, 2) + (n == 4 ? triangle(2, 3) : 0);
        for(int i = 0; i < n; ++i)
          m_boundary_areas[v[i]] += area / n;
      }
    }
    Control_weights around;
    double sum = 0;
    for(Vertex_index v = 0; v < m_points.size(); ++v)
      if(m_boundary_areas[v] > 0 && norm(m_points[v] - p) <= radius) {
        around.emplace_back(v, m_boundary_areas[v]);
        sum += m_boundary_areas[v];
      }
    if(around.size() < 3)
      return;
    for(auto& [v, w] : around)
      w /= sum;
    weights = std::move(around);
  }

  const Mixed_meshes_3::Element_locator_3<Mesh>& locator()
  {
    if(!m_locator) {
      m_kept_mesh.clear();
      m_kept_elements.clear();
      m_boundary_areas.clear();
      for(const auto& p : m_mesh.points())
        m_kept_mesh.add_vertex(p);
      for(Element_index e = 0; e < m_mesh.number_of_elements(); ++e)
        if(!m_is_removed[e]) {
          m_kept_mesh.add_element(m_mesh.element(e).kind(), m_mesh.element(e).begin());
          m_kept_elements.push_back(e);
        }
      m_locator.emplace(m_kept_mesh);
    }
    return *m_locator;
  }

  const Mesh& m_mesh;
  std::vector<Elastic_material> m_materials; // one for all, or one for each element
  std::vector<Vec3> m_points;
  std::vector<Mixed_meshes_3::internal::Support> m_supports; // of each vertex
  std::vector<bool> m_is_removed;            // of each element
  std::vector<bool> m_is_kept;               // of each vertex, whether an element is left
  Mixed_meshes_3::internal::Patches m_patches;
  std::vector<std::size_t> m_patch_of; // of each element

  std::optional<Mixed_meshes_3::internal::Elasticity_system> m_system; // the stiffness of all vertices
  std::vector<Vertex_index> m_unknowns;                // the vertices of the system that is factored
  std::unique_ptr<Matrix> m_matrix;                    // the solver refers to it
  SolverTraits m_solver;
  std::vector<Part> m_parts;
  std::vector<Mixed_meshes_3::internal::Free_motion> m_modes; // of the parts when the system was factored

  Vector m_body_force{}, m_gravity{};
  bool m_is_loaded = false; // whether m_load and m_loaded are up to date
  Eigen::VectorXd m_force, m_load, m_loaded; // body forces; these and what supports cause; and the solution
  bool m_is_iterative = false;
  double m_iteration_tolerance = 1e-3;
  int m_number_of_iterations = 0;

  Mesh m_kept_mesh;
  std::vector<double> m_boundary_areas;       // of its vertices, when needed
  std::vector<Element_index> m_kept_elements; // the number of each of its elements in m_mesh
  std::optional<Mixed_meshes_3::Element_locator_3<Mesh>> m_locator; // of m_kept_mesh
  std::vector<Vector> m_control_points;
  std::vector<Element_index> m_control_elements; // that contain them
  double m_largest_distance = 0, m_compliance = 0, m_radius = 0;
  std::optional<Mixed_meshes_3::internal::Control_constraints> m_controls;
  Eigen::VectorXd m_control_forces;
  std::vector<Vector> m_displacements;
};

} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_H
