// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/simulate.h"

#include "brain_shift/subdomains.h"
#include "brain_shift/supports.h"
#include "common/messages.h"
#include "common/misfit.h"
#include "common/resources.h"

#include <CGAL/Linear_elasticity_3.h>
#if MIXED_MESH_3_HAS_PETSC
#include <CGAL/Mixed_mesh_3/Petsc_solver_traits.h>
#endif
#include <CGAL/Mixed_mesh_3/certificate.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;
#if MIXED_MESH_3_HAS_PETSC
using Elasticity = CGAL::Linear_elasticity_3<Mesh, mm3::Petsc_solver_traits>;
#else
using Elasticity = CGAL::Linear_elasticity_3<Mesh>;
#endif
using Elasticity_status = CGAL::Linear_elasticity_status;

namespace {

[[noreturn]] void refuse(const CGAL::Linear_elasticity_result_3& result, const Options& o,
                         const std::vector<Control_point>& points)
{
  const auto at_line = [&] { return o.control_points + ": " + points[result.control_point].place() + ": "; };
  switch(result.status) {
  case Elasticity_status::CONTROL_POINT_OUTSIDE:
    throw std::runtime_error(at_line() + "the control point is " + rounded(result.distance) + " mm outside "
                             + o.mesh + "; --max-distance is " + rounded(o.max_distance) + " mm");
  case Elasticity_status::CONTRADICTORY_CONTROL_POINTS:
    throw std::runtime_error(at_line()
                             + "the displacement contradicts those of other control points, or "
                               "supports, in the same element: it is missed by "
                             + rounded(result.distance) + " mm; see --control-compliance, --fixed-below");
  case Elasticity_status::FREE_RIGID_MOTION:
    throw std::runtime_error(o.mesh + ": " + result.description()
                             + ", and the control points do not hold it; see --fixed-below");
  case Elasticity_status::NOT_CONVERGED:
    throw std::runtime_error(o.mesh + ": " + result.description()
                             + "; --control-radius, or --control-compliance, would spread it");
  default: throw std::runtime_error(o.mesh + ": " + result.description());
  }
}

void check(const CGAL::Linear_elasticity_result_3& result, const Options& o,
           const std::vector<Control_point>& points)
{
  if(!result.is_success())
    refuse(result, o, points);
}

void solve(Elasticity& elasticity, const std::vector<Vector>& displacements, const Options& o,
           const std::vector<Control_point>& points)
{
  const CGAL::Linear_elasticity_result_3 result = elasticity.solve(displacements);
  const bool is_solution = elasticity.is_corotational()
                           && result.status == Elasticity_status::INVERTED_ELEMENT; // those are counted
  if(!is_solution)
    check(result, o, points);
}

void set_supports(Elasticity& elasticity, const Supports& supports)
{
  const auto has = [&supports](mm3::Vertex_index v, Support s) { return supports.of_vertices[v] == s; };
  for(mm3::Vertex_index v = 0; v < supports.of_vertices.size(); ++v)
    if(has(v, Support::FIXED))
      elasticity.prescribe(v);
  elasticity.slide_along_boundary([&](mm3::Vertex_index v) { return has(v, Support::SLIDING); });
  elasticity.touch_along_boundary([&](mm3::Vertex_index v) { return has(v, Support::TOUCHING); });
}

// Elements that the displacement inverts; their Jacobian is zero or negative somewhere.
std::vector<std::size_t> find_inverted_elements(const Mesh& mesh, const std::vector<Vector>& displacements,
                                                const std::vector<bool>& is_removed)
{
  std::vector<std::size_t> inverted;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(!is_removed[e] && mm3::jacobian_sign(mesh.element(e), [&](mm3::Vertex_index v) {
                           return mm3::to_vec3(mesh.point(v)) + displacements[v];
                         }) != mm3::Jacobian_sign::POSITIVE)
      inverted.push_back(e);
  return inverted;
}

// The largest displacement.
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

// \param is_used of each control point
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
      const auto& location = outcome.locations[i];
      const auto element = elasticity.mesh().element(location.element);
      for(int k = 0; k < element.size(); ++k)
        control.displacement = control.displacement + location.weights[k] * shift.displacements[element[k]];
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

Shift shift_of(const Elasticity& elasticity, const Options& o, const std::vector<bool>& is_used,
               const std::string& when, Outcome& outcome)
{
  const Mesh& mesh = elasticity.mesh();
  Shift shift;
  shift.displacements = elasticity.displacements();
  shift.energy = elasticity.energy();
  if(elasticity.is_corotational()) {
    shift.residuals = elasticity.residuals();
    shift.iterations = elasticity.number_of_iterations();
  }
  measure(mesh, shift);
  const std::vector<std::size_t> inverted = find_inverted_elements(mesh, shift.displacements,
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
  if(o.is_exact() && shift.largest_miss > 1e-6 * (1 + shift.largest)) // our fault
    throw std::logic_error(when + ": control points are missed by up to " + rounded(shift.largest_miss)
                           + " mm");
  return shift;
}

std::vector<Vector> displacements_of(const std::vector<Control_point>& points)
{
  std::vector<Vector> displacements;
  for(const Control_point& point : points)
    displacements.push_back(point.displacement);
  return displacements;
}

void set_control_points(Elasticity& elasticity, const Options& o, const std::vector<Control_point>& points)
{
  std::vector<Vector> positions;
  std::vector<double> weights;
  for(const Control_point& point : points) {
    positions.push_back(point.position);
    weights.push_back(point.weight);
  }
  check(elasticity.set_control_points(positions, o.max_distance, o.compliance, o.control_radius, weights), o,
        points);
}

void tell_of_solver([[maybe_unused]] Elasticity& elasticity, [[maybe_unused]] Outcome& outcome)
{
#if MIXED_MESH_3_HAS_PETSC
  outcome.petsc = {elasticity.solver().number_of_processes(),
                   elasticity.solver().largest_number_of_iterations()};
#endif
}

// Tells what a factorization takes before it begins: afterwards there may be no memory to tell it. Numbers
// are those of the table in the manual: the factor of CHOLMOD grows with n^(4/3), that of PETSc with n.
void tell_of_factor([[maybe_unused]] const Mesh& mesh, [[maybe_unused]] const Options& o,
                    [[maybe_unused]] Stage_log& log)
{
#if !MIXED_MESH_3_HAS_PETSC
  constexpr double measured = 53799, bytes = 12e3, bytes_by_iteration = 5e3; // unknowns, and for each
  constexpr double sure = 0.6; // of the estimate: so much is needed whatever the mesh is like
  const double unknowns = 3 * double(mesh.number_of_vertices());
  const double needed = bytes * unknowns * std::cbrt(unknowns / measured);
  if(!o.quiet && needed > double(1 << 30))
    log.note("factoring the matrix of " + std::to_string(mesh.number_of_vertices()) + " vertices takes about "
             + gibibytes(needed) + " of memory, and its time grows with the square of their number; "
             + "--solver petsc iterates, with about " + gibibytes(bytes_by_iteration * unknowns));
  check_memory(o.mesh + ": without --solver petsc, the factor", sure * needed);
#endif
}

// With a compliance, means are those that come out: they give the same displacements, without the springs.
Motion_constraints constraints_of(const Elasticity& elasticity, std::vector<Vector> displacements,
                                  const Options& o)
{
  Motion_constraints constraints{{}, elasticity.control_weights(), std::move(displacements)};
  for(mm3::Vertex_index v = 0; v < elasticity.mesh().number_of_vertices(); ++v)
    constraints.held_directions.push_back(elasticity.held_directions(v));
  if(o.compliance > 0) {
    const std::vector<Vector> residuals = elasticity.control_residuals();
    for(std::size_t i = 0; i < residuals.size(); ++i)
      constraints.means[i] = constraints.means[i] - residuals[i];
  }
  return constraints;
}

// How the rest moves when elements are removed.
void remove(Elasticity& elasticity, const std::vector<bool>& is_removed, const Options& o, Stage_log& log,
            Outcome& outcome)
{
  // Points in tissue that is removed move nothing.
  std::vector<Control_point> left;
  std::vector<bool> is_used;
  for(std::size_t i = 0; i < outcome.points.size(); ++i) {
    is_used.push_back(!is_removed[outcome.locations[i].element]);
    if(is_used.back()) {
      left.push_back(outcome.points[i]);
    } else {
      outcome.warnings.push_back(o.control_points + ": " + outcome.points[i].place()
                                 + ": the control point is in tissue removed: it is not used after the "
                                   "resection");
    }
  }
  if(left.size() != outcome.points.size())
    log("control points", [&] { set_control_points(elasticity, o, left); });
  log("remove elements", [&] { check(elasticity.remove_elements(is_removed), o, left); });
  log("solve after resection", [&] { solve(elasticity, displacements_of(left), o, left); });
  if(!o.febio.empty())
    outcome.constraints = constraints_of(elasticity, displacements_of(left), o);
  outcome.after = log("checks",
                      [&] { return shift_of(elasticity, o, is_used, "shift after resection", outcome); });
}

} // namespace

Locations locate(const Mesh& mesh, const Options& o, const std::vector<Control_point>& points,
                 std::vector<std::string>& warnings)
{
  const mm3::Element_locator_3<Mesh> locator(mesh);
  std::vector<std::array<double, 3>> positions;
  for(const Control_point& point : points)
    positions.push_back(point.position);
  const std::string defect = misfit(positions, box_of(coordinates_of(mesh.points())),
                                    [&](const std::array<double, 3>& p) {
                                      return locator.nearest(Vector(p)).distance <= o.max_distance;
                                    });
  const std::string hint = defect.empty() ? "" : "beside " + o.mesh + ", the list of points " + defect;
  if(!hint.empty())
    warnings.push_back(o.control_points + ": " + hint);
  Locations locations;
  for(const Control_point& point : points) {
    locations.push_back(locator.nearest(point.position));
    if(!(locations.back().distance <= o.max_distance)) {
      CGAL::Linear_elasticity_result_3 result;
      result.status = Elasticity_status::CONTROL_POINT_OUTSIDE;
      result.control_point = locations.size() - 1;
      result.distance = locations.back().distance;
      if(!hint.empty())
        throw std::runtime_error(o.control_points + ": " + hint);
      refuse(result, o, points);
    }
  }
  return locations;
}

std::vector<bool> simulate(const Mesh& mesh, const Tumor& tumor, const Boundary_patches& patches,
                           const Options& o, Stage_log& log, Outcome& outcome)
{
  const std::vector<Control_point>& points = outcome.points;
  Elasticity elasticity(mesh, materials_of_elements(mesh, outcome.subdomains));
  outcome.supports = find_supports(mesh, patches, o, points);
  set_supports(elasticity, outcome.supports);

  tell_of_factor(mesh, o, log);
  // Before surgery the mesh is factored; then each measurement is a matter of milliseconds.
  log("factor", [&] { check(elasticity.factor(), o, points); });
  elasticity.set_corotational(o.corotational);
  elasticity.set_gravity(o.acceleration);
  if(norm(Vector(o.acceleration)) > 0)
    elasticity.set_body_forces(
      mm3::buoyant_forces(mesh, o.acceleration, o.fluid_density * kg_per_mm3, o.fluid_level));
  log("control points", [&] { set_control_points(elasticity, o, points); });
  log("solve", [&] { solve(elasticity, displacements_of(points), o, points); });
  if(!o.febio.empty())
    outcome.constraints = constraints_of(elasticity, displacements_of(points), o);
  outcome.before = log("checks", [&] {
    return shift_of(elasticity, o, std::vector<bool>(points.size(), true), "shift", outcome);
  });
  tell_of_solver(elasticity, outcome);
  if(!tumor.is_given())
    return std::vector<bool>(mesh.number_of_elements(), false);
  const std::vector<bool> is_removed = log("resect", [&] { return resect(mesh, tumor, o, outcome); });
  remove(elasticity, is_removed, o, log, outcome);
  tell_of_solver(elasticity, outcome);
  return is_removed;
}
