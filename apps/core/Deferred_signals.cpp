// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/Deferred_signals.h"

#include <csignal>
#include <string>

#include <unistd.h>

namespace {

volatile std::sig_atomic_t the_signal = 0;

// The deadline, if there is one. The line is prepared before, because a handler must not allocate.
volatile std::sig_atomic_t the_seconds = 0;
int the_status = 0;
std::string the_line;

extern "C" void note_signal(int signal)
{
  the_signal = signal;
  if(the_seconds > 0)
    alarm(unsigned(the_seconds));
}

extern "C" void end_program(int)
{
  const ssize_t ignored = write(STDERR_FILENO, the_line.data(), the_line.size());
  static_cast<void>(ignored);
  _exit(the_status);
}

} // namespace

Deferred_signals::Deferred_signals(const std::vector<int>& signals, Second second)
{
  the_signal = 0;
  for(int signal : signals) {
    struct sigaction former, action = {};
    sigaction(signal, nullptr, &former);
    if(former.sa_handler == SIG_IGN)
      continue;
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART | (second == Second::ENDS ? int(SA_RESETHAND) : 0);
    sigaction(signal, &action, nullptr);
    m_former.emplace_back(signal, former);
  }
}

Deferred_signals::~Deferred_signals()
{
  for(const auto& [signal, former] : m_former)
    sigaction(signal, &former, nullptr);
  if(the_signal != 0)
    raise(the_signal);
}

bool Deferred_signals::has_come() { return the_signal != 0; }

void Deferred_signals::take() { the_signal = 0; }

Signal_deadline::Signal_deadline(unsigned seconds, const std::string& line, int status)
{
  the_line = (isatty(STDERR_FILENO) ? "\r\033[K" : "") + line + '\n'; // replaces the progress line
  the_status = status;
  struct sigaction action = {};
  action.sa_handler = end_program;
  sigaction(SIGALRM, &action, &m_former);
  the_seconds = int(seconds);
}

Signal_deadline::~Signal_deadline()
{
  the_seconds = 0;
  alarm(0);
  sigaction(SIGALRM, &m_former, nullptr);
}
