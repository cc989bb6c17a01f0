// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/simulate.h"

#include "brain_shift/landmark_model.h"
#include "brain_shift/solve.h"
#include "brain_shift/subdomains.h"
#include "core/messages.h"
#include "core/resources.h"

#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Quadratic_field.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_bubbles.h>
#include <CGAL/Mixed_mesh_3/internal/elements/with_kind.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

void set_supports(Elasticity& elasticity, const Supports& supports)
{
  const auto has = [&supports](mm3::Vertex_index v, Support s) { return supports.of_vertices[v] == s; };
  for(mm3::Vertex_index v = 0; v < supports.of_vertices.size(); ++v)
    if(has(v, Support::FIXED))
      elasticity.prescribe(v);
  elasticity.slide_along_boundary([&](mm3::Vertex_index v) { return has(v, Support::SLIDING); });
  elasticity.touch_along_boundary([&](mm3::Vertex_index v) { return has(v, Support::TOUCHING); });
}

// Chooses the order of displacements. The force on a single point makes a dent that is the deeper, the finer
// the displacement, and inverts elements sooner.
void set_order(Elasticity& elasticity, const Model_options& o, Outcome& outcome)
{
  constexpr double width = 4; // mm around the region; with less, elements behind it are the ones that err
  const Mesh& mesh = elasticity.mesh();
  Order_facts& facts = outcome.order;
  const bool may_be_2 = o.order == Displacement_order::DEFAULT
                        && Elasticity::recommended_order(mesh.number_of_vertices()) == 2;
  if(may_be_2)
    facts.reason = o.option_of_order_1.empty() && o.points.radius == 0
                     ? "control points without --control-radius"
                     : o.option_of_order_1;
  if(o.order == Displacement_order::REGION) {
    facts.order = "region";
    elasticity.order_2_within(width);
    if(elasticity.order() == 1)
      throw std::runtime_error(o.mesh + ": the mesh has no region of interest, for --order region");
  } else if(o.order == Displacement_order::QUADRATIC || (may_be_2 && facts.reason.empty())) {
    facts.order = "2";
    elasticity.order(2);
  }
  facts.edges = elasticity.quadratic_edges();
  facts.nodes = mesh.number_of_vertices() + facts.edges.size();
  facts.unknowns = 3 * facts.nodes;
}

// Whether the map of an element with edges of order 2 is inverted in a vertex or in the middle of an edge.
bool is_inverted(const mm3::Element_view& element, const std::array<Vector, 8>& points,
                 const mm3::internal::Bubbles& bubbles)
{
  return mm3::internal::with_kind(element.kind(), [&](auto kind) {
    const mm3::internal::Quadratic_field<kind> map(points.data(), bubbles);
    const mm3::Reference_element& reference = element.reference();
    const auto corner = [&](int i) {
      const auto& c = reference.coordinates[i];
      return Vector{double(c[0]), double(c[1]), double(c[2])};
    };
    const auto is_inverted_at = [&](const Vector& r) {
      const std::array<Vector, 3> d = map.derivatives(r);
      return !(dot(cross(d[0], d[1]), d[2]) > 0);
    };
    for(int i = 0; i < element.size(); ++i)
      if((kind != mm3::PYRAMID || i < 4) && is_inverted_at(corner(i))) // no derivatives at the apex
        return true;
    for(int i = 0; i < reference.number_of_edges; ++i)
      if(is_inverted_at(0.5 * (corner(reference.edges[i][0]) + corner(reference.edges[i][1]))))
        return true;
    return false;
  });
}

// Elements that the displacement inverts: their Jacobian is zero or negative somewhere; with edges of order
// 2, in a vertex or in the middle of an edge.
std::vector<std::size_t> find_inverted_elements(const Mesh& mesh, const Shift& shift,
                                                const std::vector<std::array<mm3::Vertex_index, 2>>& edges,
                                                const std::vector<bool>& is_removed)
{
  const mm3::internal::Edge_vectors coefficients(mesh.number_of_vertices(), edges, shift.edge_coefficients);
  const auto displaced = [&](mm3::Vertex_index v) {
    return mm3::to_vec3(mesh.point(v)) + shift.displacements[v];
  };
  std::vector<std::size_t> inverted;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    if(is_removed[e])
      continue;
    const auto element = mesh.element(e);
    std::array<Vector, mm3::internal::largest_number_of_edges> of_edges{};
    for(int i = 0; i < element.reference().number_of_edges; ++i)
      of_edges[std::size_t(i)] = coefficients(element[element.reference().edges[i][0]],
                                              element[element.reference().edges[i][1]]);
    const bool is_linear = std::all_of(of_edges.begin(), of_edges.end(),
                                       [](const Vector& a) { return a == Vector{}; });
    std::array<Vector, 8> points{};
    for(int i = 0; i < element.size(); ++i)
      points[std::size_t(i)] = displaced(element[i]);
    if(is_linear ? mm3::jacobian_sign(element, displaced) != mm3::Jacobian_sign::POSITIVE
                 : is_inverted(element, points, mm3::internal::bubbles_of_edges(element.kind(), of_edges)))
      inverted.push_back(e);
  }
  return inverted;
}

// Measures the largest displacement.
void measure(const Mesh& mesh, Shift& shift)
{
  mm3::Vertex_index farthest = 0;
  for(mm3::Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const double length = norm(shift.displacements[v]);
    if(!std::isfinite(length))
      throw std::runtime_error("the displacement is not finite");
    if(length > shift.largest) {
      shift.largest = length;
      farthest = v;
    }
  }
  shift.at = mm3::to_vec3(mesh.point(farthest));
}

// \param is_used whether each control point is used
void measure_controls(const Elasticity& elasticity, const Outcome& outcome, const std::vector<bool>& is_used,
                      bool leave_one_out, Shift& shift)
{
  const std::vector<Vector> forces = elasticity.control_forces();
  const std::vector<Vector> left_out = leave_one_out ? elasticity.leave_one_out_errors()
                                                     : std::vector<Vector>();
  double squares = 0, squares_left_out = 0;
  std::size_t predicted = 0;
  std::size_t used = 0;
  for(std::size_t i = 0; i < outcome.points.size(); ++i) {
    Control control;
    control.is_used = is_used[i];
    if(control.is_used) {
      control.displacement = elasticity.displacement(outcome.locations[i]);
      control.miss = norm(control.displacement - Vector(outcome.points[i].displacement));
      shift.largest_miss = (std::max)(shift.largest_miss, control.miss);
      squares += control.miss * control.miss;
      if(leave_one_out && std::isfinite(left_out[used][0])) {
        control.left_out = left_out[used];
        squares_left_out += dot(left_out[used], left_out[used]);
        ++predicted;
      }
      control.force = forces[used++];
    }
    shift.controls.push_back(control);
  }
  if(used > 0)
    shift.root_mean_square_miss = std::sqrt(squares / double(used));
  if(predicted > 0)
    shift.left_out = std::sqrt(squares_left_out / double(predicted));
}

Shift shift_of(const Elasticity& elasticity, const Model_options& o, const std::vector<bool>& is_used,
               const std::string& when, Outcome& outcome)
{
  const Mesh& mesh = elasticity.mesh();
  Shift shift;
  shift.displacements = elasticity.displacements();
  shift.edge_coefficients = elasticity.edge_coefficients();
  shift.energy = elasticity.energy();
  if(elasticity.is_corotational()) {
    shift.residuals = elasticity.residuals();
    shift.iterations = elasticity.number_of_iterations();
  }
  measure(mesh, shift);
  const std::vector<std::size_t> inverted = find_inverted_elements(mesh, shift, outcome.order.edges,
                                                                   elasticity.removed_elements());
  shift.inverted_elements = inverted.size();
  if(!inverted.empty())
    outcome.warnings.push_back(when + ": " + counted(inverted.size(), "element is", "elements are")
                               + " inverted, the first near "
                               + place(mm3::to_vec3(mesh.point(mesh.element(inverted.front())[0])))
                               + ": too much is asked of the elements there; --control-radius, or "
                                 "--control-compliance, would spread it");
  for(double force : elasticity.contact_forces()) {
    shift.closed_contacts += force > 0;
    shift.contact_force += force;
  }
  measure_controls(elasticity, outcome, is_used, o.leave_one_out && !elasticity.is_iterative(), shift);
  if(o.points.is_exact() && shift.largest_miss > 1e-6 * (1 + shift.largest)) // a defect of the program
    throw std::logic_error(when + ": control points are missed by up to " + rounded(shift.largest_miss)
                           + " mm");
  return shift;
}

void tell_of_solver([[maybe_unused]] Elasticity& elasticity, [[maybe_unused]] Outcome& outcome)
{
#if MIXED_MESH_3_HAS_PETSC
  outcome.petsc = {elasticity.solver().number_of_processes(),
                   elasticity.solver().largest_number_of_iterations()};
#endif
}

// Notes the memory of a factorization before it begins: afterwards there may be no memory for a note. Numbers
// are those of the table in the manual: the factor of CHOLMOD grows with n^(4/3), that of PETSc with n.
void tell_of_factor([[maybe_unused]] const Mesh& mesh, [[maybe_unused]] const Order_facts& order,
                    [[maybe_unused]] const std::string& mesh_file, [[maybe_unused]] Stage_log& log)
{
#if !MIXED_MESH_3_HAS_PETSC
  constexpr double measured = 53799, bytes_by_iteration = 5e3; // unknowns, and bytes for each
  const double bytes = order.edges.empty() ? 12e3 : 9e3;       // edges have fewer neighbors than vertices
  constexpr double sure = 0.6;                                 // share of the estimate that any mesh needs
  const double unknowns = double(order.unknowns);
  const double needed = bytes * unknowns * std::cbrt(unknowns / measured);
  if(needed > double(1 << 30))
    log.note("factoring the matrix of " + std::to_string(mesh.number_of_vertices()) + " vertices "
             + (order.edges.empty() ? "" : "and " + std::to_string(order.edges.size()) + " edges ")
             + "takes about " + gibibytes(needed)
             + " of memory, and its time grows with the square of their number; "
             + "--solver petsc iterates, with about " + gibibytes(bytes_by_iteration * unknowns));
  check_memory(mesh_file + ": without --solver petsc, the factor", sure * needed);
#endif
}

// The constraints of a solution. With a compliance, means are the resulting ones: they give the same
// displacements, without the springs.
Motion_constraints constraints_of(const Elasticity& elasticity, std::vector<Vector> displacements,
                                  bool has_compliance)
{
  Motion_constraints constraints{{},
                                 elasticity.control_weights(),
                                 std::move(displacements),
                                 elasticity.quadratic_edges()};
  const std::size_t nodes = elasticity.mesh().number_of_vertices() + elasticity.quadratic_edges().size();
  for(mm3::Vertex_index v = 0; v < nodes; ++v)
    constraints.held_directions.push_back(elasticity.held_directions(v));
  if(has_compliance) {
    const std::vector<Vector> residuals = elasticity.control_residuals();
    for(std::size_t i = 0; i < residuals.size(); ++i)
      constraints.means[i] = constraints.means[i] - residuals[i];
  }
  return constraints;
}

// Computes errors of predictions by landmarks, except errors known from the shift if landmarks are its
// control points.
void predict_landmarks(Elasticity& elasticity, const Controls& landmarks, bool are_control_points,
                       Outcome& outcome)
{
  measure_by_outermost(elasticity, landmarks, outcome);
  if(are_control_points)
    return;
  set_control_points(elasticity, landmarks);
  solve(elasticity, landmarks);
  measure_left_out(elasticity, outcome);
}

// Measures errors at landmarks that are known from the shift.
void measure_landmarks(const Elasticity& elasticity, bool are_control_points, Outcome& outcome)
{
  if(are_control_points)
    measure_left_out(elasticity, outcome);
  else
    measure_shift(elasticity, outcome);
}

// Solves after the removal of elements.
void remove(Elasticity& elasticity, const std::vector<bool>& is_removed, const Model_options& o,
            Stage_log& log, Outcome& outcome)
{
  // Control points in removed tissue move nothing.
  Controls left{o.mesh, o.points, {}};
  std::vector<bool> is_used;
  for(std::size_t i = 0; i < outcome.points.size(); ++i) {
    is_used.push_back(!is_removed[outcome.locations[i].element]);
    if(is_used.back()) {
      left.points.push_back(outcome.points[i]);
    } else {
      outcome.warnings.push_back(o.points.file + ": " + outcome.points[i].place()
                                 + ": the control point is in tissue removed: it is not used after the "
                                   "resection");
    }
  }
  if(left.points.size() != outcome.points.size())
    log("control points", [&] { set_control_points(elasticity, left); });
  log("remove elements", [&] { check(elasticity.remove_elements(is_removed), left); });
  log("solve after resection", [&] { solve(elasticity, left); });
  if(o.keeps_constraints)
    outcome.constraints = constraints_of(elasticity, left.displacements(), o.points.compliance > 0);
  outcome.after = log("checks",
                      [&] { return shift_of(elasticity, o, is_used, "shift after resection", outcome); });
}

std::vector<bool> simulate_in_order(const Mesh& mesh, const Tumor& tumor, const Boundary_patches& patches,
                                    const Model_options& o, Stage_log& log, Outcome& outcome)
{
  const Controls controls{o.mesh, o.points, outcome.points};
  Elasticity elasticity(mesh, materials_of_elements(mesh, outcome.subdomains));
  outcome.supports = find_supports(mesh, patches, o.supports, outcome.points);
  set_supports(elasticity, outcome.supports);

  set_order(elasticity, o, outcome);
  tell_of_factor(mesh, outcome.order, o.mesh, log);
  // The mesh is factored before surgery; then each measurement takes milliseconds.
  log("factor", [&] { check(elasticity.factor(), controls); });
  elasticity.set_corotational(o.corotational);
  elasticity.set_gravity(o.acceleration);
  if(norm(Vector(o.acceleration)) > 0)
    elasticity.set_body_forces(
      mm3::buoyant_forces(mesh, o.acceleration, o.fluid_density * kg_per_mm3, o.fluid_level));
  if(outcome.landmarks)
    log("landmarks", [&] {
      predict_landmarks(elasticity, {o.mesh, o.landmarks, outcome.landmarks->points},
                        o.landmarks.are_control_points, outcome);
    });
  log("control points", [&] { set_control_points(elasticity, controls); });
  log("solve", [&] { solve(elasticity, controls); });
  if(o.keeps_constraints)
    outcome.constraints = constraints_of(elasticity, controls.displacements(), o.points.compliance > 0);
  outcome.before = log("checks", [&] {
    return shift_of(elasticity, o, std::vector<bool>(outcome.points.size(), true), "shift", outcome);
  });
  if(outcome.landmarks)
    log("errors at landmarks",
        [&] { measure_landmarks(elasticity, o.landmarks.are_control_points, outcome); });
  tell_of_solver(elasticity, outcome);
  if(!tumor.is_given())
    return std::vector<bool>(mesh.number_of_elements(), false);
  const std::vector<bool> is_removed = log("resect", [&] { return resect(mesh, tumor, outcome); });
  remove(elasticity, is_removed, o, log, outcome);
  tell_of_solver(elasticity, outcome);
  return is_removed;
}

} // namespace

std::vector<bool> simulate(const Mesh& mesh, const Tumor& tumor, const Boundary_patches& patches,
                           const Model_options& o, Stage_log& log, Outcome& outcome)
{
  const Outcome without = outcome;
  const std::vector<bool> is_removed = simulate_in_order(mesh, tumor, patches, o, log, outcome);
  const bool is_inverted = outcome.before.inverted_elements > 0 || outcome.last().inverted_elements > 0;
  if(o.order != Displacement_order::DEFAULT || outcome.order.order == "1" || !is_inverted)
    return is_removed;
  Model_options linear = o;
  linear.order = Displacement_order::LINEAR;
  outcome = without;
  outcome.order.reason = "elements that order 2 would invert";
  return simulate_in_order(mesh, tumor, patches, linear, log, outcome);
}
