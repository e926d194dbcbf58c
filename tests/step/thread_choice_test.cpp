// SPDX-License-Identifier: GPL-3.0-or-later
// thread_choice_test.cpp  Tests the choice between stepping with all threads and with one thread, given measured times
// of steps. The faster choice must win, and changes must be noticed.
#include "kernels/cpu/thread_choice.hpp"

#include <gtest/gtest.h>

namespace macadam::kernels {
namespace {

/// Simulates `seconds` of stepping, in which a step takes `all` seconds with all threads and `one` with a single
/// thread. Returns the fraction of time on one thread.
double play(ThreadChoice& choice, double all, double one, double seconds) {
  double on_one = 0, total = 0;
  while (total < seconds) {
    const ThreadChoice::Next next = choice.next();
    const double took = static_cast<double>(next.steps) * (next.threads == 1 ? one : all);
    choice.took(next.steps, took);
    total += took;
    if (next.threads == 1) on_one += took;
  }
  return on_one / total;
}

TEST(ThreadChoice, KeepsAllThreadsOnAQuietMachine) {
  ThreadChoice choice(4, false);
  EXPECT_LT(play(choice, 1e-5, 3e-5, 100), 0.005);
}

TEST(ThreadChoice, TakesOneWhileOthersWantTheCores) {
  ThreadChoice choice(2, false);
  play(choice, 1e-4, 2e-4, 30);
  EXPECT_GT(play(choice, 2e-3, 4e-4, 30), 0.9);    // while another program uses the cores
  EXPECT_LT(play(choice, 1e-4, 2e-4, 120), 0.55);  // the other program has ended, which is noticed within a minute
  EXPECT_LT(play(choice, 1e-4, 2e-4, 30), 0.01);
}

TEST(ThreadChoice, AskedForIsTaken) {
  ThreadChoice fixed(2, true), single(1, false);
  EXPECT_EQ(play(fixed, 1, 1e-3, 1e19), 0);
  EXPECT_EQ(single.next().threads, 1);
  EXPECT_EQ(single.next().steps, INT64_MAX);
}

}  // namespace
}  // namespace macadam::kernels
