// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/Deferred_signals.h"

#include <csignal>

namespace {

volatile std::sig_atomic_t the_signal = 0;

extern "C" void note_signal(int signal) { the_signal = signal; }

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
