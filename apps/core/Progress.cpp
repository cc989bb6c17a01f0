// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/Progress.h"

#include "core/messages.h"

#include <cstdio>

#include <unistd.h>

Progress::Progress(bool is_shown, Clock::time_point start)
  : m_is_terminal(isatty(STDERR_FILENO) != 0), m_start(start)
{
  if(is_shown)
    m_thread = std::thread([this] { run(); });
}

Progress::~Progress() { finish(); }

void Progress::show(const std::string& text)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_text = text;
}

void Progress::note(const std::string& line)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  std::fprintf(stderr, "%s%s\n", m_is_terminal ? "\r\033[K" : "", printable(line).c_str());
}

void Progress::finish()
{
  if(!m_thread.joinable())
    return;
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_is_finished = true;
  }
  m_finish.notify_one();
  m_thread.join();
  if(m_is_terminal)
    std::fputs("\r\033[K", stderr);
}

void Progress::write(const std::string& text) const
{
  const double seconds = std::chrono::duration<double>(Clock::now() - m_start).count();
  const char* const format = m_is_terminal ? "\r\033[K%5.0f s  %s" : "%5.0f s  %s\n";
  std::fprintf(stderr, format, seconds, printable(text).c_str());
}

void Progress::run()
{
  const std::chrono::seconds period(m_is_terminal ? 1 : 30);
  std::unique_lock<std::mutex> lock(m_mutex);
  while(!m_finish.wait_for(lock, period, [this] { return m_is_finished; }))
    write(m_text);
}
