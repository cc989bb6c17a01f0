// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/Prompt_termination.h"

#include <csignal>
#include <thread>

#include <unistd.h>

namespace {

constexpr int wake = SIGUSR2; // ends the thread

sigset_t set_of(int signal)
{
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  return set;
}

void end_program_at_signal()
{
  sigset_t awaited = set_of(SIGTERM);
  sigaddset(&awaited, wake);
  int signal = 0;
  if(sigwait(&awaited, &signal) != 0 || signal != SIGTERM)
    return;
  std::signal(SIGTERM, SIG_DFL);
  const sigset_t set = set_of(SIGTERM);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  std::raise(SIGTERM);
  _exit(128 + SIGTERM); // as a shell tells the signal
}

} // namespace

Prompt_termination::Prompt_termination()
{
  struct sigaction former;
  sigaction(SIGTERM, nullptr, &former);
  if(former.sa_handler == SIG_IGN)
    return;
  sigset_t blocked = set_of(SIGTERM);
  sigaddset(&blocked, wake);
  pthread_sigmask(SIG_BLOCK, &blocked, &m_former);
  m_thread = std::thread(end_program_at_signal);
}

Prompt_termination::~Prompt_termination()
{
  if(!m_thread.joinable())
    return;
  pthread_kill(m_thread.native_handle(), wake);
  m_thread.join();
  pthread_sigmask(SIG_SETMASK, &m_former, nullptr);
}
