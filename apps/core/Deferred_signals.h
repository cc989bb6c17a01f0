// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_APPS_CORE_DEFERRED_SIGNALS_H
#define MIXED_MESH_3_APPS_CORE_DEFERRED_SIGNALS_H

#include <string>
#include <utility>
#include <vector>

#include <signal.h>

/// Signals that shall not end the program as long as the object lives, so that unfinished work can be put
/// into order first. A signal that came, and was not taken, ends the program when the object is destroyed.
/// Ignored signals stay ignored. One object at a time.
class Deferred_signals
{
public:
  enum class Second { DEFERRED, ENDS };

  /// \param signals deferred signals
  /// \param second whether a second signal of a kind ends the program at once
  Deferred_signals(const std::vector<int>& signals, Second second);
  ~Deferred_signals();
  Deferred_signals(const Deferred_signals&) = delete;
  Deferred_signals& operator=(const Deferred_signals&) = delete;

  /// Whether a signal came.
  static bool has_come();
  /// Takes the signal, which does not end the program any more.
  static void take();

private:
  std::vector<std::pair<int, struct sigaction>> m_former;
};

/// A deadline that a deferred signal starts: after that number of seconds the program ends, with a line on
/// stderr, unless the object has been destroyed until then. Work that takes longer than the user waits cannot
/// be put into order. One object at a time.
class Signal_deadline
{
public:
  /// \param line line that is written as it is
  /// \param status status of the program
  Signal_deadline(unsigned seconds, const std::string& line, int status);
  ~Signal_deadline();
  Signal_deadline(const Signal_deadline&) = delete;
  Signal_deadline& operator=(const Signal_deadline&) = delete;

private:
  struct sigaction m_former;
};

#endif // MIXED_MESH_3_APPS_CORE_DEFERRED_SIGNALS_H
