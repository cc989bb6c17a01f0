// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SIGTERM ends a process whatever handler a library has, unless it is ignored.

#include "core/Prompt_termination.h"

#include <boost/core/lightweight_test.hpp>

#include <csignal>

#include <sys/wait.h>
#include <unistd.h>

namespace test_signals {

extern "C" void drop(int) {}

// The status of a process that gets the signal while it works.
template <class Work>
int status_of(const Work& work)
{
  int ready[2];
  if(pipe(ready) != 0)
    return -1;
  const pid_t child = fork();
  if(child == 0) {
    alarm(20); // ends it with another status if the signal is lost
    work([&] { // lets the parent send the signal, and waits for it
      const ssize_t written = write(ready[1], "", 1);
      sleep(written == 1 ? 2 : 0);
    });
    _exit(7);
  }
  char byte;
  const ssize_t n = read(ready[0], &byte, 1);
  BOOST_TEST_EQ(n, 1);
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  close(ready[0]);
  close(ready[1]);
  return status;
}

bool is_ended_by_signal(int status) { return WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM; }
bool is_ended_by_itself(int status) { return WIFEXITED(status) && WEXITSTATUS(status) == 7; }

int run(int, char*[])
{
  // The handler of a library drops the signal; not while the object lives.
  BOOST_TEST(is_ended_by_itself(status_of([](const auto& wait) {
    std::signal(SIGTERM, drop);
    wait();
  })));
  BOOST_TEST(is_ended_by_signal(status_of([](const auto& wait) {
    const Prompt_termination termination;
    std::signal(SIGTERM, drop);
    wait();
  })));
  // What was there before is restored.
  BOOST_TEST(is_ended_by_itself(status_of([](const auto& wait) {
    std::signal(SIGTERM, drop);
    {
      const Prompt_termination termination;
    }
    wait();
  })));
  BOOST_TEST(is_ended_by_itself(status_of([](const auto& wait) {
    std::signal(SIGTERM, SIG_IGN);
    const Prompt_termination termination;
    wait();
  })));
  return boost::report_errors();
}

} // namespace test_signals
