// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Times and memory of stages, and progress on a terminal: the visitor of the programs.

#ifndef MIXED_MESH_3_APPS_CORE_STAGE_LOG_H
#define MIXED_MESH_3_APPS_CORE_STAGE_LOG_H

#include "core/Progress.h"
#include "core/messages.h"

#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/resource.h>
#include <unistd.h>

/// The cost of one stage, over all its runs.
struct Stage_cost
{
  std::string name;
  double seconds = 0;         // wall clock
  double cpu_seconds = 0;     // time of all threads
  std::size_t peak_bytes = 0; // largest resident memory of the process during the stage
};

/// The expected course of a run, for the share of the run that is over.
struct Work_plan
{
  double search = 0, fit = 0; // shares of the seconds at their ends
  std::size_t trials = 1, rounds = 1;
};

/// Model of `MixedMeshVisitor_3`; also times the stages outside the library.
class Stage_log : public CGAL::Mixed_meshes_3::Default_visitor
{
  using Clock = std::chrono::steady_clock;

public:
  /// \param show_progress whether to show on stderr, while stages run, how far they are
  explicit Stage_log(bool show_progress) : m_show_progress(show_progress), m_progress(show_progress, m_start)
  {
  }

  void begin_stage(CGAL::Mixed_meshes_3::Stage stage)
  {
    m_number_of_meshes += stage == CGAL::Mixed_meshes_3::Stage::ASSEMBLY;
    m_is_fitting = m_is_fitting || stage == CGAL::Mixed_meshes_3::Stage::OPTIMIZATION;
    if(stage == CGAL::Mixed_meshes_3::Stage::OPTIMIZATION)
      give_memory_back();
    begin(CGAL::Mixed_meshes_3::stage_names[int(stage)]);
  }
  void end_stage(CGAL::Mixed_meshes_3::Stage stage)
  {
    m_is_fitted = m_is_fitted || stage == CGAL::Mixed_meshes_3::Stage::OPTIMIZATION;
    end();
  }

  void progress(std::size_t number_of_vertices, std::size_t budget)
  {
    ++m_number_of_trials;
    show("trial of " + std::to_string(number_of_vertices) + " of " + std::to_string(budget) + " vertices");
  }

  /// Whether the run goes on. Asked before each round of fitting, too.
  bool go_on()
  {
    if(m_is_running)
      show(m_current + ", round " + std::to_string(++m_round));
    return !m_is_over || !m_is_over();
  }

  /// Sets the condition that makes `go_on()` false.
  void stop_when(std::function<bool()> is_over) { m_is_over = std::move(is_over); }

  /// Sets the expected work, for progress to be shown as a share of the work, and as the time that is left.
  void expect(const Work_plan& plan) { m_plan = plan; }

  /// Runs `f` as a stage of the given name, the one that fits the boundary; returns its result.
  template <class F>
  auto fit(const std::string& name, const F& f)
  {
    m_is_fitting = true;
    struct Fitted
    {
      Stage_log& log;
      ~Fitted() { log.m_is_fitted = true; }
    };
    const Fitted fitted{*this};
    return (*this)(name, f);
  }

  /// Runs `f` as any other stage of the given name; returns its result.
  template <class F>
  auto operator()(const std::string& name, const F& f)
  {
    struct Ended // also if f throws
    {
      Stage_log& log;
      ~Ended() { log.end(); }
    };
    give_memory_back();
    begin(name);
    const Ended ended{*this};
    return f();
  }

  /// A stage that depends on no other one beside it.
  struct Stage
  {
    std::string name;
    std::function<void()> run;
  };

  /// Runs independent stages, at the same time if there are several threads. The wall clock of a stage then
  /// also runs while the stage waits for a thread or shares a processor.
  void together(unsigned threads, const std::vector<Stage>& stages)
  {
    if(threads == 1) {
      for(const Stage& stage : stages)
        (*this)(stage.name, stage.run);
      return;
    }
    std::vector<Stage_cost> costs(stages.size());
    m_peak = peak_bytes();
    reset_high_water_mark();
    m_current = stages.front().name;
    show(m_current);
    CGAL::Mixed_meshes_3::internal::parallel_for(
      stages.size(), threads,
      [&](std::size_t i) {
        const Clock::time_point start = Clock::now();
        const double cpu = thread_cpu_seconds();
        stages[i].run();
        costs[i] = {stages[i].name, seconds_since(start), thread_cpu_seconds() - cpu, 0};
      },
      1);
    for(Stage_cost& cost : costs) {
      cost.peak_bytes = high_water_mark();
      add(cost);
    }
  }

  const std::vector<Stage_cost>& costs() const { return m_costs; }
  double seconds() const { return seconds_since(m_start); }

  /// Shows the activity of the current stage; may be called in several threads.
  void tell(const std::string& what) { m_progress.show(m_current + ", " + what); }

  /// Writes a line that stays.
  void note(const std::string& line)
  {
    if(m_show_progress)
      m_progress.note("note: " + line);
  }

  /// Replaces the progress line by the costs of the stages.
  void finish_progress()
  {
    m_progress.finish();
    if(!m_show_progress || !isatty(STDERR_FILENO))
      return;
    for(const Stage_cost& cost : m_costs)
      std::fprintf(stderr, "%9.3f s %6zu MiB  %s\n", cost.seconds, cost.peak_bytes >> 20,
                   printable(cost.name).c_str());
  }

  /// Largest resident memory of the process since the log was made, in all stages and between them.
  std::size_t peak_bytes() const { return (std::max)(m_peak, high_water_mark()); }

private:
  // Shows a text. With a tolerance, many meshes are made, each with another place or size of the octree.
  void show(const std::string& what)
  {
    const double seconds = seconds_since(m_start), share = share_of_work();
    std::string text;
    if(share > 0.05)
      text = "about " + std::to_string(std::lround(100 * share)) + " %, "
             + std::to_string(std::lround(std::ceil(seconds * (1 - share) / share))) + " s left: ";
    if(m_number_of_meshes > 1)
      text += "octree " + std::to_string(m_number_of_meshes) + " to compare: ";
    m_progress.show(text + what);
  }

  // The share of the work that is done. Two steps are always left for a search or a fit that takes longer
  // than expected.
  double share_of_work() const
  {
    const auto done = [](std::size_t n, std::size_t expected) {
      return double(n) / double((std::max)(expected, n + 2));
    };
    if(m_is_fitted)
      return m_plan.fit;
    return m_is_fitting ? m_plan.search + (m_plan.fit - m_plan.search) * done(m_round, m_plan.rounds)
                        : m_plan.search * done(m_number_of_trials, m_plan.trials);
  }

  void begin(const std::string& name)
  {
    m_current = name;
    m_is_running = true;
    m_round = 0;
    m_peak = peak_bytes();
    reset_high_water_mark();
    m_stage_start = Clock::now();
    m_stage_cpu = std::clock();
    show(name);
  }

  void end()
  {
    m_is_running = false;
    add({m_current, seconds_since(m_stage_start), double(std::clock() - m_stage_cpu) / CLOCKS_PER_SEC,
         high_water_mark()});
  }

  // Adds the cost of a run of a stage to those of its other runs.
  void add(const Stage_cost& run)
  {
    auto cost = m_costs.begin();
    while(cost != m_costs.end() && cost->name != run.name)
      ++cost;
    if(cost == m_costs.end())
      cost = m_costs.insert(m_costs.end(), Stage_cost{run.name});
    cost->seconds += run.seconds;
    cost->cpu_seconds += run.cpu_seconds;
    cost->peak_bytes = (std::max)(cost->peak_bytes, run.peak_bytes);
  }

  static double thread_cpu_seconds()
  {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  }

  // glibc: the system gets pages back that earlier stages have freed between others; of a million vertices,
  // 200 MB before the optimization, and 400 after it. Not before the stages of an octree, which are many.
  static void give_memory_back()
  {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
  }

  // Linux: the high-water mark starts anew.
  static void reset_high_water_mark() { std::ofstream("/proc/self/clear_refs") << "5"; }

  static double seconds_since(Clock::time_point start)
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  static std::size_t high_water_mark()
  {
    std::ifstream status("/proc/self/status");
    std::string word;
    std::size_t kilobytes;
    while(status >> word)
      if(word == "VmHWM:" && status >> kilobytes)
        return kilobytes * 1024;
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
  }

  bool m_show_progress;
  Clock::time_point m_start = Clock::now(), m_stage_start;
  std::clock_t m_stage_cpu = 0;
  std::size_t m_peak = 0;
  std::string m_current;
  bool m_is_running = false;
  bool m_is_fitting = false, m_is_fitted = false;
  std::size_t m_round = 0, m_number_of_meshes = 0, m_number_of_trials = 0;
  Work_plan m_plan;
  std::function<bool()> m_is_over;
  std::vector<Stage_cost> m_costs;
  Progress m_progress;
};

#endif // MIXED_MESH_3_APPS_CORE_STAGE_LOG_H
