// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/run.h"

#include "brain_shift/adapt.h"
#include "brain_shift/febio.h"
#include "brain_shift/images.h"
#include "brain_shift/landmarks.h"
#include "brain_shift/locate.h"
#include "brain_shift/outcome.h"
#include "brain_shift/patches.h"
#include "brain_shift/read_control_points.h"
#include "brain_shift/read_mesh.h"
#include "brain_shift/report.h"
#include "brain_shift/resection.h"
#include "brain_shift/simulate.h"
#include "brain_shift/subdomains.h"
#include "core/Deferred_signals.h"
#include "core/Prompt_termination.h"
#include "core/Stage_log.h"
#include "core/messages.h"
#include "core/resources.h"
#include "core/write_files.h"
#include "page/page.h"

#include <CGAL/Mixed_mesh_3/internal/elements/Middle_nodes.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_bubbles.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

struct Inputs
{
  Mesh mesh;
  mm3::IO::Subdomain_names subdomain_names;
  Tumor tumor;
  Boundary_patches patches;
  mm3::Voxel_image_3 image, labels; // empty without a file
};

// Prints a note for many points: a dense system with three equations for each point is factored: with 2,000
// points, as measured, in 3 s.
void tell_of_many_points(std::size_t n)
{
  constexpr double many = 1000, measured = 2000, seconds = 3;
  if(double(n) > many)
    std::cerr << "note: " << n << " control points: preparing them takes "
              << rounded(std::ceil(seconds * std::pow(double(n) / measured, 3)))
              << " s or more, which grows with the cube of their number\n";
}

// The number of points. Landmarks are control points in their turn.
std::size_t number_of_points(const Outcome& outcome)
{
  return (std::max)(outcome.points.size(), outcome.landmarks ? outcome.landmarks->points.size() : 0);
}

Inputs read_inputs(const Options& o, Stage_log& log, Outcome& outcome)
{
  Inputs inputs;
  if(!o.model.landmarks.file.empty())
    outcome.landmarks = read_landmarks(o.model.landmarks);
  outcome.points = o.model.landmarks.are_control_points ? outcome.landmarks->points
                   : o.model.points.file_after.empty()
                     ? read_control_points(o.model.points.file)
                     : read_fiducials(o.model.points.file, o.model.points.file_after);
  if(!o.quiet)
    tell_of_many_points(number_of_points(outcome));
  if(o.model.points.compliance == 0
     && std::any_of(outcome.points.begin(), outcome.points.end(),
                    [](const auto& p) { return p.weight != 1; }))
    outcome.warnings.push_back("the weights of control points are not used: without --control-compliance, "
                               "displacements are exact");
  inputs.mesh = log("read mesh",
                    [&] { return read_mesh(o.model.mesh, inputs.subdomain_names, outcome.warnings); });
  outcome.mesh = facts_of(inputs.mesh);
  outcome.volume = mm3::volume(inputs.mesh);
  outcome.subdomains = find_subdomains(inputs.mesh, o.model.mesh, inputs.subdomain_names, o.material,
                                       o.materials);
  // The response of each vertex and control point to each control point: 3 x 3 numbers.
  const std::size_t n = number_of_points(outcome);
  check_memory((n == outcome.points.size() ? o.model.points.file : o.model.landmarks.file) + ": "
                 + std::to_string(n) + " control points",
               72 * double(n) * double(outcome.mesh.vertices + 2 * n));
  outcome.locations = log("locate control points", [&] {
    return locate(inputs.mesh, {o.model.mesh, o.model.points, outcome.points}, outcome.warnings);
  });
  if(!o.tumor.empty())
    inputs.tumor.surface = log("read tumor", [&] {
      return read_beside_mesh(o.tumor, o.surface_options, inputs.mesh, o.model.mesh, outcome.tumor.emplace(),
                              outcome.warnings);
    });
  if(!o.tumor_label.empty())
    inputs.tumor.subdomain = find_subdomain(outcome.subdomains, o.tumor_label, o.model.mesh).index;
  inputs.tumor.name = o.tumor_label.empty() ? o.tumor : o.model.mesh + ": subdomain " + o.tumor_label;
  inputs.patches = find_patches(inputs.mesh, o.model.mesh, o.patches, o.surface_options, outcome.warnings);
  if(o.adapt) {
    log("adapt mesh", [&] {
      adapt(inputs.mesh, o.model.mesh, inputs.patches, o.model.supports, o.model.points.radius, outcome);
    });
    outcome.volume = mm3::volume(inputs.mesh);
    std::vector<std::string> known_warnings;
    outcome.locations = locate(inputs.mesh, {o.model.mesh, o.model.points, outcome.points}, known_warnings);
  }
  if(outcome.landmarks)
    log("registrations", [&] {
      place_landmarks(inputs.mesh, o.model.mesh, o.model.landmarks, outcome);
      compare_registrations(*outcome.landmarks);
    });
  if(!o.images.file.empty())
    inputs.image = log("read image",
                       [&] { return read_image(o.images.file, inputs.mesh, o.model.mesh, outcome); });
  if(!o.images.labels.empty())
    inputs.labels = log("read labels", [&] { return read_labels(o.images, inputs.image.grid); });
  return inputs;
}

std::vector<double> flat(const std::vector<Vector>& vectors)
{
  std::vector<double> values;
  for(const Vector& u : vectors)
    values.insert(values.end(), u.begin(), u.end());
  return values;
}

// The displacements of the nodes of elements of an order: the vertices, and the middles of edges.
std::vector<double> of_nodes(const Mesh& mesh, int order, const Order_facts& facts, const Shift& shift)
{
  std::vector<Vector> values = shift.displacements;
  if(order == 2) {
    const mm3::internal::Edge_vectors coefficients(mesh.number_of_vertices(), facts.edges,
                                                   shift.edge_coefficients);
    const mm3::internal::Middle_nodes middles = mm3::internal::quadratic_connectivity(
      mesh.elements(), mesh.number_of_vertices());
    for(const auto& [v, w] : middles.ends)
      values.push_back(0.5 * (values[v] + values[w]) + coefficients(v, w));
  }
  return flat(values);
}

// Writes the former mesh, with displacements.
void write_meshes(mm3::IO::Output_files& files, const Inputs& inputs, const std::vector<bool>& is_removed,
                  const std::vector<std::string>& paths, int order, const Outcome& outcome)
{
  const Mesh& mesh = inputs.mesh;
  const std::vector<double> last = of_nodes(mesh, order, outcome.order, outcome.last()),
                            before = of_nodes(mesh, order, outcome.order, outcome.before),
                            resected(is_removed.begin(), is_removed.end());
  mm3::IO::Write_options data;
  data.order = order;
  data.vertex_data.push_back({"displacement", &last, 3});
  if(outcome.resection)
    data.vertex_data.push_back({"displacement_before_resection", &before, 3});
  data.facet_sets = facet_sets(mesh, {}, inputs.patches, outcome.supports);
  data.subdomain_names = inputs.subdomain_names;
  mm3::IO::Write_options data_of_vtu = data; // other formats have no data of elements
  data_of_vtu.element_data.push_back({"resected", &resected});
  for(const std::string& path : paths)
    write_mesh(files, path, mesh, mm3::IO::format_of(path) == mm3::IO::Format::VTU ? data_of_vtu : data);
}

void write_deformed_meshes(mm3::IO::Output_files& files, const Remaining_mesh& remaining,
                           const Inputs& inputs, const std::vector<std::string>& paths,
                           const Outcome& outcome)
{
  Mesh deformed = remaining.mesh;
  for(std::size_t v = 0; v < deformed.number_of_vertices(); ++v) {
    const Vector& u = outcome.last().displacements[remaining.vertices[v]];
    deformed.points()[v] = deformed.points()[v] + Kernel::Vector_3(u[0], u[1], u[2]);
  }
  mm3::IO::Write_options with_sets;
  with_sets.facet_sets = facet_sets(deformed, remaining.vertices, inputs.patches, outcome.supports);
  with_sets.subdomain_names = inputs.subdomain_names;
  for(const std::string& path : paths)
    write_mesh(files, path, deformed, with_sets);
}

// The data of the page. Coordinates are right, anterior and superior in mm, like those of the image and of
// control points.
Page_data page_data(const Inputs& inputs, const std::vector<bool>& is_removed, const Options& o,
                    const Outcome& outcome)
{
  Page_data data{o.command, inputs.subdomain_names, true, {{"shifted", flat(outcome.before.displacements)}}};
  data.files = inputs_of(o);
  data.files.push_back(o.images.output);
  for(const std::string& path : outputs_of(o))
    data.files.push_back(path);
  if(outcome.after)
    data.steps.push_back({"resected", flat(outcome.after->displacements), is_removed});
  return data;
}

void write_files(const Inputs& inputs, const std::vector<bool>& is_removed, const Remaining_mesh& remaining,
                 const Options& o, Stage_log& log, Outcome& outcome)
{
  const Deferred_signals deferred({SIGINT, SIGTERM, SIGHUP}, Deferred_signals::Second::DEFERRED);
  mm3::IO::Output_files files([] { return !Deferred_signals::has_come(); }); // appear together, at the end
  if(!o.images.file.empty())
    write_images(files, inputs.image, inputs.labels, inputs.mesh, inputs.tumor, is_removed, o.images, log,
                 outcome);
  log("write meshes", [&] {
    write_meshes(files, inputs, is_removed, o.outputs, o.output_order, outcome);
    write_deformed_meshes(files, remaining, inputs, o.deformed_outputs, outcome);
    if(!o.febio.empty())
      write_febio(files, o.febio, remaining,
                  facet_sets(remaining.mesh, remaining.vertices, inputs.patches, outcome.supports),
                  inputs.subdomain_names, o.model, outcome);
  });
  if(!o.page.empty())
    log("write page", [&] {
      write_text(files, o.page,
                 page(inputs.mesh, page_data(inputs, is_removed, o, outcome), report(o, outcome, log)));
    });
  outcome.seconds = log.seconds();
  outcome.peak_bytes = log.peak_bytes();
  if(!o.report.empty())
    write_text(files, o.report, text_of(report(o, outcome, log)));
  require([&](std::string* error) { return files.commit(error); });
}

} // namespace

void run(const Options& o)
{
  check_feasible(o);
  if(!o.quiet && outputs_of(o).empty())
    std::cerr << "note: nothing will be written, without --output, --output-deformed, --output-image, "
                 "--febio, --report and --page\n";
  std::optional<Prompt_termination> termination(std::in_place);
  Stage_log log(!o.quiet);
  Outcome outcome;
  const Inputs inputs = read_inputs(o, log, outcome);
  const std::vector<bool> is_removed = simulate(inputs.mesh, inputs.tumor, inputs.patches, o.model, log,
                                                outcome);
  if(outcome.landmarks)
    warn_of_landmarks(o.model.landmarks.file, outcome);
  const Remaining_mesh remaining = remaining_mesh(inputs.mesh, is_removed, outcome);
  termination.reset(); // files are removed first
  write_files(inputs, is_removed, remaining, o, log, outcome);
  log.finish_progress();
  for(const std::string& warning : outcome.warnings)
    std::cerr << "warning: " << printable(warning) << '\n';
  if(!o.quiet)
    print_summary(o, outcome, log);
}
