// SPDX-License-Identifier: GPL-3.0-or-later
// sparing_save_test.cpp  With thousands of frequencies, the growing summary is not written after each of them.
#include "host/run/sparing_save.hpp"

#include <gtest/gtest.h>

namespace macadam::test {
namespace {

using namespace std::chrono_literals;

/// A clock that only the tests advance, so that a busy machine does not affect them.
struct OwnTime {
  SparingSave::Clock::time_point now{1h};
  int saved = 0;
  /// Returns a SparingSave for which every writing of the file takes the time `cost`.
  SparingSave save(SparingSave::Clock::duration cost) {
    return SparingSave(
        [this, cost](const std::string&) {
          ++saved;
          now += cost;
        },
        [this] { return now; });
  }
};

TEST(SparingSave, TakesATenthOfTheTimeAtMost) {
  OwnTime time;
  SparingSave save = time.save(20ms);
  for (int k = 0; k < 1000; ++k) save("running");
  EXPECT_EQ(time.saved, 1);  // the later calls came sooner than ten times the duration of the first writing
  time.now += 199ms;
  save("running");
  EXPECT_EQ(time.saved, 1);
  time.now += 1ms;
  save("running");
  EXPECT_EQ(time.saved, 2);
}

TEST(SparingSave, CostsNothingWhereFrequenciesTakeLong) {
  OwnTime time;
  SparingSave save = time.save(1ms);
  for (int k = 0; k < 5; ++k) {
    time.now += 10ms;
    save("running");
  }
  EXPECT_EQ(time.saved, 5);
}

TEST(SparingSave, BeginsWithTheSystemsClock) {
  int saved = 0;
  SparingSave save([&](const std::string&) { ++saved; });
  save("running");
  EXPECT_EQ(saved, 1);
}

}  // namespace
}  // namespace macadam::test
