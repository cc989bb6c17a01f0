// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_APPS_CORE_PROGRESS_H
#define MIXED_MESH_3_APPS_CORE_PROGRESS_H

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

/// The current activity of the program, on stderr, until the object is destroyed. A thread of its own writes
/// the text, so that the seconds go on where one call takes minutes: on a terminal once a second, in one
/// line; elsewhere, where lines stay, each half minute.
class Progress
{
public:
  using Clock = std::chrono::steady_clock;

  /// \param is_shown whether the text is written
  /// \param start time from which seconds are counted
  Progress(bool is_shown, Clock::time_point start);
  ~Progress();

  /// Shows a text; may be called from any thread.
  void show(const std::string& text);
  /// Writes a line that stays.
  void note(const std::string& line);
  /// Ends the progress; the line on the terminal disappears.
  void finish();

private:
  void write(const std::string& text) const;
  void run();

  const bool m_is_terminal;
  const Clock::time_point m_start;
  std::mutex m_mutex;
  std::condition_variable m_finish;
  bool m_is_finished = false;
  std::string m_text;
  std::thread m_thread; // the last one: it uses the others
};

#endif // MIXED_MESH_3_APPS_CORE_PROGRESS_H
