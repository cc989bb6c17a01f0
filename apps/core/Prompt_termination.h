// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_APPS_CORE_PROMPT_TERMINATION_H
#define MIXED_MESH_3_APPS_CORE_PROMPT_TERMINATION_H

#include <thread>

#include <signal.h>

/// SIGTERM, which `timeout` and Slurm send, ends the program at once as long as the object lives, whatever
/// handler there is. METIS, which orders matrices for CHOLMOD, has a handler of its own meanwhile, and drops
/// the signal. So the signal is blocked, and a thread waits for it. Threads that are started later inherit
/// this; the object is made before there are others. An ignored signal stays ignored. One object at a time.
class Prompt_termination
{
public:
  Prompt_termination();
  ~Prompt_termination();
  Prompt_termination(const Prompt_termination&) = delete;
  Prompt_termination& operator=(const Prompt_termination&) = delete;

private:
  sigset_t m_former;
  std::thread m_thread;
};

#endif // MIXED_MESH_3_APPS_CORE_PROMPT_TERMINATION_H
