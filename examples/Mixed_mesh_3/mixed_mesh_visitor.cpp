// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A visitor that observes a run, and stops the run after a time limit.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

// Model of MixedMeshVisitor_3. The default visitor has the remaining members.
class Time_limit : public mm3::Default_visitor
{
  using Clock = std::chrono::steady_clock;
  Clock::time_point m_start = Clock::now();
  double m_limit;

  double seconds() const { return std::chrono::duration<double>(Clock::now() - m_start).count(); }

public:
  explicit Time_limit(double seconds) : m_limit(seconds) {}

  // The search for the budget tries several meshes, from the coarsest one on.
  void progress(std::size_t number_of_vertices, std::size_t budget)
  {
    std::cout << "  " << seconds() << " s: tried " << number_of_vertices << " of " << budget << " vertices\n";
  }

  void begin_stage(mm3::Stage stage)
  {
    if(stage == mm3::Stage::ASSEMBLY || stage == mm3::Stage::OPTIMIZATION)
      std::cout << "  " << seconds() << " s: " << mm3::stage_names[int(stage)] << '\n';
  }

  // Called for each mesh that is tried, and in each round of the optimization.
  bool go_on() { return seconds() < m_limit; }
};

int main(int argc, char** argv)
try {
  Surface brain, path;
  std::string error;
  if(!mm3::IO::read_closed_surface(argc > 1 ? argv[1] : CGAL::data_file_path("brain.off"), brain, &error)
     || !mm3::IO::read_closed_surface(argc > 2 ? argv[2] : CGAL::data_file_path("region.off"), path,
                                      &error)) {
    std::cerr << error << '\n';
    return EXIT_FAILURE;
  }

  // The time suffices for a small mesh, not for a large one.
  bool is_as_expected = true;
  for(const auto& [budget, limit] : {std::pair(std::size_t(660), 60.), {2000000, 0.05}}) {
    std::cout << "at most " << budget << " vertices, in " << limit << " s:\n";
    Time_limit visitor(limit);
    Mesh mesh;
    // The visitor is given by reference: a visitor given by value would be copied.
    const auto result = CGAL::make_mixed_mesh_3(brain, path, budget, mesh,
                                                CGAL::parameters::visitor(std::ref(visitor)));
    const bool is_stopped = result.status == CGAL::Mixed_mesh_status::STOPPED;
    std::cout << (is_stopped ? "stopped" : "done") << " with " << mesh.number_of_vertices() << " vertices\n";
    is_as_expected = is_as_expected && is_stopped == (limit < 1) && is_stopped == mesh.is_empty();
  }
  return is_as_expected ? EXIT_SUCCESS : EXIT_FAILURE;
} catch(const std::exception& e) {
  std::cerr << e.what() << '\n';
  return EXIT_FAILURE;
}
