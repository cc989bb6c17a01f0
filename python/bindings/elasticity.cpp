// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear elasticity and resection.

#include "arrays.h"
#include "core/One_blas_thread.h"

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Linear_elasticity_3/adapt_mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/resect.h>

#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

struct Elasticity_error : std::runtime_error
{
  using runtime_error::runtime_error;
};

void check(const CGAL::Linear_elasticity_result_3& result)
{
  if(!result.is_success())
    throw Elasticity_error(result.description());
}

// Scope of factorizations and solutions: other threads of Python run meanwhile, but only one thread computes,
// because OpenBLAS without threads gives wrong results in two; and CHOLMOD computes as in brain_shift, so
// that results are the same, byte for byte.
struct Computation
{
  inline static std::mutex mutex;

  const py::gil_scoped_release release;
  const std::lock_guard<std::mutex> lock{mutex};
  const One_blas_thread one_thread;
};

using Material = std::tuple<double, double, double>;

mm3::Elastic_material material_of(const Material& m)
{
  const auto [young_modulus, poisson_ratio, density] = m;
  if(!(young_modulus > 0) || !(poisson_ratio >= 0 && poisson_ratio < 0.5) || !(density >= 0))
    throw std::invalid_argument("material: expected a positive Young's modulus, Poisson's ratio from 0 to "
                                "below 0.5, and a density that is not negative");
  return {young_modulus, poisson_ratio, density};
}

// The material of each element: materials of labels, and that of the other elements.
std::vector<mm3::Elastic_material> materials_of(const Mesh& mesh, const std::map<int, Material>& materials,
                                                const Material& other)
{
  std::map<mm3::Subdomain_index, mm3::Elastic_material> of_labels;
  for(const auto& [label, m] : materials)
    of_labels[mm3::Subdomain_index(label)] = material_of(m);
  return mm3::materials_of_elements(mesh, of_labels, material_of(other));
}

// Keeps the mesh that the solver refers to, and factors the system when the factor is first needed.
class Elasticity
{
  using Solver = CGAL::Linear_elasticity_3<Mesh>;

  std::shared_ptr<const Mesh> m_mesh;
  std::unique_ptr<Solver> m_solver;
  bool m_is_corotational = false;

  void factor()
  {
    if(!m_solver->is_factored())
      check(m_solver->factor());
  }

  void require_supports_open(const char* name) const
  {
    if(m_solver->is_factored())
      throw Elasticity_error(std::string(name)
                             + "(): supports are set before the first control points, and the first "
                               "solution");
  }

public:
  Elasticity(std::shared_ptr<const Mesh> mesh, const std::map<int, Material>& materials,
             const Material& other)
    : m_mesh(std::move(mesh)),
      m_solver(std::make_unique<Solver>(*m_mesh, materials_of(*m_mesh, materials, other)))
  {
  }

  void set_order(int order)
  {
    require_supports_open("set_order");
    if(order != 1 && order != 2)
      throw std::invalid_argument("order: expected 1 or 2");
    m_solver->order(order);
  }

  void set_order_2_within(double distance)
  {
    require_supports_open("set_order_2_within");
    if(!(distance >= 0))
      throw std::invalid_argument("order: expected a distance that is not negative");
    m_solver->order_2_within(distance);
  }

  void fix(const Marks& vertices)
  {
    require_supports_open("fix");
    const std::vector<bool> marks = marks_of(vertices, m_mesh->number_of_vertices(), "fix");
    for(mm3::Vertex_index v = 0; v < marks.size(); ++v)
      if(marks[v])
        m_solver->prescribe(v);
  }

  void slide(const Marks& vertices)
  {
    require_supports_open("slide");
    const std::vector<bool> marks = marks_of(vertices, m_mesh->number_of_vertices(), "slide");
    m_solver->slide_along_boundary([&](mm3::Vertex_index v) { return marks[v]; });
  }

  void touch(const Marks& vertices, double gap)
  {
    require_supports_open("touch");
    if(!std::isfinite(gap))
      throw std::invalid_argument("touch(): the gap is not finite");
    const std::vector<bool> marks = marks_of(vertices, m_mesh->number_of_vertices(), "touch");
    m_solver->touch_along_boundary([&](mm3::Vertex_index v) { return marks[v]; }, gap);
  }

  void set_gravity(const std::array<double, 3>& acceleration) { m_solver->set_gravity(Vector(acceleration)); }

  void set_corotational(bool is_corotational)
  {
    m_is_corotational = is_corotational;
    m_solver->set_corotational(is_corotational);
  }

  void set_control_points(const Doubles& points, double largest_distance, double compliance, double radius,
                          const std::vector<double>& weights)
  {
    const std::vector<Vector> positions = vectors_of(points, "points");
    if(!(largest_distance >= 0 && compliance >= 0 && radius >= 0))
      throw std::invalid_argument("set_control_points(): expected numbers that are not negative");
    if(!weights.empty() && weights.size() != positions.size())
      throw std::invalid_argument("weights: expected one for each of " + std::to_string(positions.size())
                                  + " control points");
    for(double w : weights)
      if(!(w >= 1e-6 && w <= 1e6))
        throw std::invalid_argument("weights: expected positive numbers, from 1e-6 to 1e6");
    const Computation computation;
    factor();
    check(m_solver->set_control_points(positions, largest_distance, compliance, radius, weights));
  }

  py::array_t<double> solve(const Doubles& displacements)
  {
    const std::vector<Vector> given = vectors_of(displacements, "displacements");
    std::vector<Vector> found;
    CGAL::Linear_elasticity_result_3 result;
    {
      const Computation computation;
      factor();
      if(given.size() != m_solver->number_of_control_points())
        throw std::invalid_argument("displacements: expected one for each of "
                                    + std::to_string(m_solver->number_of_control_points())
                                    + " control points");
      result = m_solver->solve(given);
      found = m_solver->displacements();
    }
    if(m_is_corotational && result.status == CGAL::Linear_elasticity_status::INVERTED_ELEMENT) {
      if(PyErr_WarnEx(PyExc_RuntimeWarning, result.description().c_str(), 1) != 0)
        throw py::error_already_set();
    } else {
      check(result);
    }
    return array_of(found);
  }

  void remove(const Marks& elements)
  {
    const std::vector<bool> marks = marks_of(elements, m_mesh->number_of_elements(), "elements");
    const Computation computation;
    factor();
    check(m_solver->remove_elements(marks));
  }

  int order() const { return m_solver->order(); }

  py::array_t<std::uint32_t> edges() const
  {
    const auto& edges = m_solver->quadratic_edges();
    py::array_t<std::uint32_t> result({py::ssize_t(edges.size()), py::ssize_t(2)});
    for(std::size_t i = 0; i < edges.size(); ++i)
      for(int k = 0; k < 2; ++k)
        result.mutable_at(py::ssize_t(i), k) = edges[i][std::size_t(k)];
    return result;
  }

  py::array_t<double> edge_coefficients() const { return array_of(m_solver->edge_coefficients()); }

  double energy() const { return m_solver->energy(); }
  py::array_t<double> control_forces() const { return array_of(m_solver->control_forces()); }
  py::array_t<double> control_residuals() const { return array_of(m_solver->control_residuals()); }

  py::array_t<double> contact_forces() const
  {
    const std::vector<double>& forces = m_solver->contact_forces();
    return py::array_t<double>(py::ssize_t(forces.size()), forces.data());
  }

  py::array_t<double> leave_one_out_errors()
  {
    std::vector<Vector> errors;
    {
      const Computation computation;
      if(m_solver->is_iterative() || m_solver->number_of_control_points() == 0
         || m_solver->control_forces().size() != m_solver->number_of_control_points())
        throw Elasticity_error("leave_one_out_errors(): solve() comes first, and no removal in between");
      errors = m_solver->leave_one_out_errors();
    }
    return array_of(errors);
  }
};

// Moves inner vertices along configurational forces; a load case is the displacements of marked vertices.
py::dict adapt(Mesh& mesh, const std::vector<std::pair<Marks, Doubles>>& cases,
               const std::map<int, Material>& materials, const Material& other, double quality_bound,
               int maximal_number_of_solves)
{
  std::vector<mm3::Prescribed_displacements> prescribed;
  for(const auto& [vertices, displacements] : cases) {
    const std::vector<bool> marks = marks_of(vertices, mesh.number_of_vertices(), "cases: vertices");
    const std::vector<Vector> values = vectors_of(displacements, "cases: displacements");
    if(values.size() != marks.size())
      throw std::invalid_argument("cases: expected a displacement for each of " + std::to_string(marks.size())
                                  + " vertices, of which only those of the "
                                    "marked ones count");
    prescribed.emplace_back();
    for(mm3::Vertex_index v = 0; v < marks.size(); ++v)
      if(marks[v]) {
        if(!std::isfinite(norm(values[v])))
          throw std::invalid_argument("cases: the displacement of vertex " + std::to_string(v)
                                      + " is not finite");
        prescribed.back()[v] = values[v];
      }
  }
  const auto criteria = CGAL::Mixed_mesh_adaptation_criteria_3()
                          .quality_bound(quality_bound)
                          .maximal_number_of_solves(maximal_number_of_solves);
  const std::vector<mm3::Elastic_material> of_elements = materials_of(mesh, materials, other);
  CGAL::Mixed_mesh_adaptation_result_3 result;
  {
    const Computation computation;
    result = CGAL::adapt_mixed_mesh_3(mesh, of_elements, prescribed, criteria);
  }
  using Status = CGAL::Mixed_mesh_adaptation_status;
  if(result.status != Status::CONVERGED && result.status != Status::SOLVES_EXHAUSTED)
    throw Elasticity_error(std::string("adapt(): ") + mm3::description(result.status));
  py::dict report;
  report["status"] = std::string(mm3::description(result.status));
  report["steps"] = result.number_of_steps;
  report["solves"] = result.number_of_solves;
  report["energies before"] = result.energies_before;
  report["energies after"] = result.energies_after;
  report["energy after / before"] = result.functional;
  report["worst ARC before"] = result.worst_aspect_ratio_before;
  report["worst ARC after"] = result.worst_aspect_ratio_after;
  return report;
}

py::array_t<bool> removed_elements(const mm3::Resection_3& r)
{
  if(r.status != mm3::Resection_status::SUCCESS)
    throw Elasticity_error(std::string("resect(): ") + mm3::description(r.status));
  return array_of(r.is_removed);
}

py::array_t<bool> resect(const Mesh& mesh, const Doubles& points, const Integers& triangles)
{
  std::vector<std::string> warnings;
  const Surface tumor = surface_of(points, triangles, "tumor", warnings);
  return removed_elements(mm3::resect(mesh, tumor));
}

py::array_t<bool> resect_elements(const Mesh& mesh, const Marks& elements)
{
  return removed_elements(mm3::resect(mesh, marks_of(elements, mesh.number_of_elements(), "elements")));
}

py::array_t<bool> boundary_vertices(const Mesh& mesh)
{
  std::vector<bool> is_boundary(mesh.number_of_vertices(), false);
  for(mm3::Vertex_index v : mm3::boundary_vertices(mesh))
    is_boundary[v] = true;
  return array_of(is_boundary);
}

} // namespace

void add_elasticity(py::module_& module)
{
  py::register_exception<Elasticity_error>(module, "ElasticityError", PyExc_RuntimeError);
  py::class_<Elasticity>(module, "Elasticity")
    .def(py::init<std::shared_ptr<const Mesh>, const std::map<int, Material>&, const Material&>())
    .def("set_order", &Elasticity::set_order)
    .def("set_order_2_within", &Elasticity::set_order_2_within)
    .def_property_readonly("order", &Elasticity::order)
    .def_property_readonly("edges", &Elasticity::edges)
    .def_property_readonly("edge_coefficients", &Elasticity::edge_coefficients)
    .def("fix", &Elasticity::fix)
    .def("slide", &Elasticity::slide)
    .def("touch", &Elasticity::touch, py::arg("vertices"), py::arg("gap") = 0.)
    .def("set_gravity", &Elasticity::set_gravity)
    .def("set_corotational", &Elasticity::set_corotational)
    .def("set_control_points", &Elasticity::set_control_points)
    .def("solve", &Elasticity::solve)
    .def("remove", &Elasticity::remove)
    .def("control_forces", &Elasticity::control_forces)
    .def("control_residuals", &Elasticity::control_residuals)
    .def("contact_forces", &Elasticity::contact_forces)
    .def("leave_one_out_errors", &Elasticity::leave_one_out_errors)
    .def_property_readonly("energy", &Elasticity::energy);
  module.def("adapt", &adapt);
  module.def("resect", &resect);
  module.def("resect_elements", &resect_elements);
  module.def("boundary_vertices", &boundary_vertices);
}
