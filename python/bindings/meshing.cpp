// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes from surfaces.

#include "arrays.h"
#include "core/Thread_limit.h"
#include "core/comparison.h"
#include "core/messages.h"

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/sheets.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_image_3/IO/read_anatomical_surface.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/fit_mixed_mesh_to_surface.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <chrono>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace {

using Domain = CGAL::Labeled_polyhedral_mixed_mesh_domain_3;
using Status = CGAL::Mixed_mesh_status;
using Clock = std::chrono::steady_clock;

struct Meshing_error : std::runtime_error
{
  using runtime_error::runtime_error;
};

// Reports progress to Python, and stops the run after an exception of the Python function, or after Ctrl-C.
class Python_visitor : public mm3::Default_visitor
{
  using Progress = std::function<void(const char*, std::size_t, std::size_t)>;

  Progress m_progress;
  const Clock::time_point m_start = Clock::now();
  const double m_time_limit; // in seconds
  const char* m_stage = "";
  Clock::time_point m_last = Clock::now();
  std::exception_ptr m_exception;

  template <class Function>
  void in_python(const Function& function)
  {
    const py::gil_scoped_acquire acquire;
    try {
      function();
    } catch(...) {
      m_exception = std::current_exception();
    }
  }

public:
  explicit Python_visitor(Progress progress, double time_limit = std::numeric_limits<double>::infinity())
    : m_progress(std::move(progress)), m_time_limit(time_limit)
  {
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - m_start).count(); }

  void begin_stage(mm3::Stage stage)
  {
    m_stage = mm3::stage_names[int(stage)];
    progress(0, 0);
  }

  void progress(std::size_t vertices, std::size_t budget)
  {
    if(m_progress && !m_exception)
      in_python([&] { m_progress(m_stage, vertices, budget); });
  }

  bool go_on()
  {
    constexpr std::chrono::milliseconds interval(50);
    if(!m_exception && Clock::now() - m_last > interval) {
      m_last = Clock::now();
      in_python([] {
        if(PyErr_CheckSignals() != 0)
          throw py::error_already_set();
      });
    }
    return !m_exception && seconds() <= m_time_limit;
  }

  void rethrow() const
  {
    if(m_exception)
      std::rethrow_exception(m_exception);
  }
};

using Progress = std::function<void(const char*, std::size_t, std::size_t)>;
using Soup = std::tuple<Doubles, Integers>;
using Weighted_soup = std::tuple<Doubles, Integers, double>;
using Labeled_soup = std::tuple<Doubles, Integers, int>;

// Elements in the order of files: by kind, within a kind in the order of the mesh.
Mesh sorted_by_kind(const Mesh& mesh)
{
  Mesh sorted;
  for(const auto& p : mesh.points())
    sorted.add_vertex(p);
  for(mm3::Element_kind kind : mm3::element_kinds)
    for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
      if(const auto element = mesh.element(e); element.kind() == kind)
        sorted.add_element(kind, std::vector<mm3::Vertex_index>(element.begin(), element.end()),
                           mesh.attributes(e));
  return sorted;
}

// Compares a mesh with its surface, as the program does. \throw Meshing_error if it does not represent it
void compare(const Mesh& mesh, const Surface& surface, double tolerance,
             const CGAL::Mixed_mesh_result_3& result, const Input_names& names, py::dict& report,
             std::vector<std::string>& warnings)
{
  Status status = result.status;
  Topology topology;
  Fidelity fidelity;
  {
    const py::gil_scoped_release release;
    const Boundary boundary = mm3::internal::boundary_triangles(mesh);
    topology = topology_of(boundary, surface, true, status);
    fidelity = fidelity_of(mesh, boundary, surface, topology.surface.volume);
  }
  if(result.status != Status::STOPPED) { // else the reason is known
    const std::string defect = reason_for_no_likeness(fidelity, names);
    if(!defect.empty())
      throw Meshing_error(defect);
    if(result.number_of_lost_cells != 0)
      warnings.push_back(sentence_on_lost_parts(result, names));
    if(fidelity.vertices_off != 0)
      warnings.push_back(sentence_on_vertices_off(fidelity, names));
    if(const std::string cut_off = sentence_on_sharp_edges(result, names); !cut_off.empty())
      warnings.push_back(cut_off);
    if(fidelity.misses(tolerance))
      warnings.push_back(sentence_on_tolerance(fidelity, "tolerance=" + rounded(tolerance), names));
    if(!fidelity.has_right_volume())
      warnings.push_back(sentence_on_volume(fidelity.ratio_of_volumes(), names));
    for(const Difference& difference : topology.differences)
      warnings.push_back(names.surface + ": " + difference.sentence);
  }
  report["status"] = std::string(mm3::description(checked_status(status, fidelity, tolerance)));
  report["volume"] = fidelity.volume_of_mesh;
  report["volume of surface"] = fidelity.volume_of_surface;
  report["same topology"] = topology.is_same;
  report["Hausdorff distance"] = fidelity.distance();
  report["boundary vertices"] = fidelity.vertices;
  report["boundary vertices not on surface"] = fidelity.vertices_off;
}

// The faces of each sheet, (n, 4) vertices, the last one -1 of triangles; a sheet without faces has a
// warning.
py::list sheets_of(const Mesh& mesh, const Domain& domain, std::vector<std::string>& warnings)
{
  py::list sheets;
  for(const mm3::Sheet_in_mesh& sheet : mm3::find_sheets(mesh, domain, on_surface)) {
    const std::string name = "sheet " + std::to_string(sheets.size());
    if(sheet.faces.empty())
      warnings.push_back(name + ": has no faces in the mesh; try more vertices, if it is inside the surface");
    py::dict row;
    row["faces"] = array_of(sheet.faces);
    row["area"] = sheet.area;
    row["vertices"] = sheet.number_of_vertices;
    row["vertices not on surface"] = sheet.number_of_vertices_off;
    row["largest distance"] = sheet.largest_distance;
    sheets.append(row);
  }
  return sheets;
}

std::pair<std::shared_ptr<Mesh>, py::dict>
make_mesh(const Soup& soup, const std::vector<Weighted_soup>& regions,
          const std::vector<Labeled_soup>& subdomains, std::size_t vertices, bool fewest_vertices,
          double tolerance, double grading, bool simplification, std::optional<int> base_level,
          double quality_bound, double sharp_angle, const Progress& progress, const std::vector<Soup>& sheets,
          double time_limit, std::optional<std::size_t> threads)
{
  std::vector<std::string> warnings;
  std::optional<Thread_limit> limit;
  if(threads)
    limit.emplace(*threads);
  Domain domain;
  Surface boundary; // also of cavities
  for(const auto& [points, triangles, label] : subdomains) {
    if(label < 0)
      throw std::invalid_argument("subdomains: expected labels from 2 on, or 0 for a cavity");
    const Surface part = surface_of(points, triangles, "subdomain " + std::to_string(label), warnings);
    domain.add(part, mm3::Subdomain_index(label));
    if(label == 0)
      CGAL::copy_face_graph(part, boundary);
  }
  const Surface surface = surface_of(std::get<0>(soup), std::get<1>(soup), "surface", warnings);
  domain.add(surface, 1);
  CGAL::copy_face_graph(surface, boundary);
  for(std::size_t i = 0; i < sheets.size(); ++i)
    domain.add_sheet(
      sheet_of(std::get<0>(sheets[i]), std::get<1>(sheets[i]), "sheet " + std::to_string(i), warnings));
  CGAL::Polyhedral_mixed_mesh_regions_3 all_regions;
  for(std::size_t i = 0; i < regions.size(); ++i) {
    const auto& [points, triangles, weight] = regions[i];
    const std::string name = regions.size() == 1 ? "region" : "region " + std::to_string(i);
    if(!(weight > 0))
      throw std::invalid_argument(name + ": the weight is not positive");
    all_regions.add(std::make_shared<const CGAL::Polyhedral_mixed_mesh_region_3>(
                      surface_of(points, triangles, name, warnings)),
                    weight);
  }
  auto criteria = CGAL::Mixed_mesh_criteria_3(vertices)
                    .fewest_vertices(fewest_vertices)
                    .grading(grading)
                    .simplification(simplification)
                    .quality_bound(quality_bound)
                    .sharp_angle(sharp_angle)
                    .keep_mesh_if_stopped(true);
  if(base_level)
    criteria.base_level(*base_level);
  if(tolerance > 0)
    criteria.tolerance(tolerance);
  Python_visitor visitor(progress, time_limit);
  auto mesh = std::make_shared<Mesh>();
  CGAL::Mixed_mesh_result_3 result;
  {
    const py::gil_scoped_release release;
    result = CGAL::make_mixed_mesh_3<CGAL::Parallel_if_available_tag>(domain, all_regions, criteria, *mesh,
                                                                      CGAL::parameters::visitor(
                                                                        std::ref(visitor)));
  }
  visitor.rethrow();
  const Input_names names{"surface",
                          "vertices=" + std::to_string(vertices),
                          "base_level",
                          tolerance == 0 ? "tolerance" : "",
                          std::vector<std::string>(regions.size(), "region"),
                          quality_bound == 0 ? "" : "quality_bound"};
  const std::string reason = reason_for_no_mesh(result, names);
  if(!reason.empty())
    throw Meshing_error(reason);
  if(result.status == Status::STOPPED)
    warnings.push_back("stopped by time_limit after " + duration(visitor.seconds())
                       + ": the mesh is what there was then, and its boundary may be off the surface");
  else if(fewest_vertices && result.status > Status::BUDGET_NOT_FILLED)
    throw Meshing_error("vertices: not even " + std::to_string(result.vertex_budget)
                        + " are within the tolerance: " + mm3::description(result.status));
  py::dict report;
  report["vertex budget"] = result.vertex_budget;
  compare(*mesh, boundary, tolerance, result, names, report, warnings);
  *mesh = sorted_by_kind(*mesh);
  if(!sheets.empty())
    report["sheets"] = sheets_of(*mesh, domain, warnings);
  report["warnings"] = warnings;
  return {mesh, report};
}

py::dict optimize(Mesh& mesh, const Soup& soup, double tolerance, double quality_bound,
                  std::size_t bisections, bool flips, const Progress& progress)
{
  std::vector<std::string> warnings;
  const Surface surface = surface_of(std::get<0>(soup), std::get<1>(soup), "surface", warnings);
  const auto criteria = CGAL::Mixed_mesh_optimization_criteria_3()
                          .tolerance(tolerance)
                          .quality_bound(quality_bound)
                          .number_of_bisections(bisections)
                          .flips(flips);
  Python_visitor visitor(progress);
  CGAL::Mixed_mesh_optimization_result_3 result;
  {
    const py::gil_scoped_release release;
    result = CGAL::optimize_mixed_mesh_3<CGAL::Parallel_if_available_tag>(mesh, surface, criteria,
                                                                          CGAL::parameters::visitor(
                                                                            std::ref(visitor)));
  }
  visitor.rethrow();
  if(result.status == CGAL::Mixed_mesh_optimization_status::INVALID_MESH)
    throw std::invalid_argument("mesh: an element is inverted, see certify()");
  py::dict report;
  report["success"] = result.status == CGAL::Mixed_mesh_optimization_status::SUCCESS;
  report["boundary vertices"] = result.number_of_boundary_vertices;
  report["boundary vertices not on surface"] = result.number_of_boundary_vertices
                                               - result.number_of_arrived_vertices;
  report["warnings"] = warnings;
  return report;
}

py::dict fit(Mesh& mesh, const Soup& soup, const Progress& progress)
{
  std::vector<std::string> warnings;
  const Surface surface = surface_of(std::get<0>(soup), std::get<1>(soup), "surface", warnings);
  Python_visitor visitor(progress);
  CGAL::Mixed_mesh_fit_result_3 result;
  {
    const py::gil_scoped_release release;
    result = CGAL::fit_mixed_mesh_to_surface(mesh, surface, CGAL::Mixed_mesh_fit_criteria_3(),
                                             CGAL::parameters::visitor(std::ref(visitor)));
  }
  visitor.rethrow();
  if(result.status == CGAL::Mixed_mesh_fit_status::INVALID_MESH)
    throw std::invalid_argument("mesh: an element is inverted, see certify()");
  py::dict report;
  report["on surface"] = result.is_on_surface();
  report["warnings"] = warnings;
  return report;
}

// A closed surface from a file: points, triangles, and repairs.
py::tuple read_surface_arrays(const std::string& path, bool is_strict, double wrap_diameter,
                              double weld_distance, bool keep_largest, double least_volume)
{
  mm3::IO::Read_anatomical_surface_options options;
  options.is_strict = is_strict;
  options.wrap_diameter = wrap_diameter;
  options.weld_distance = weld_distance;
  options.keep_largest = keep_largest;
  options.least_volume = least_volume;
  Surface surface;
  std::string error;
  mm3::IO::Surface_input input;
  bool is_read;
  {
    const py::gil_scoped_release release;
    is_read = mm3::IO::read_anatomical_surface(path, options, surface, &error, &input);
    surface.collect_garbage();
  }
  if(!is_read)
    throw std::invalid_argument(error);
  const py::tuple arrays = arrays_of(surface);
  return py::make_tuple(arrays[0], arrays[1], input.warnings);
}

} // namespace

void add_meshing(py::module_& module)
{
  py::register_exception<Meshing_error>(module, "MeshingError", PyExc_RuntimeError);
  module.def("mesh", &make_mesh);
  module.def("optimize", &optimize);
  module.def("fit", &fit);
  module.def("read_surface", &read_surface_arrays);
}
