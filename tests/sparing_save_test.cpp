// SPDX-License-Identifier: GPL-3.0-or-later
// sparing_save_test.cpp  Thousands of frequencies do not write thousands of growing summaries.
#include "host/simulation/sparing_save.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace macadam::test {
namespace {

using namespace std::chrono_literals;

TEST(SparingSave, TakesATenthOfTheTimeAtMost) {
  int saved = 0;
  SparingSave save([&](const std::string&) {
    ++saved;
    std::this_thread::sleep_for(20ms);
  });
  for (int k = 0; k < 1000; ++k) save("running");
  EXPECT_EQ(saved, 1);  // the others came within ten times what the first took
  std::this_thread::sleep_for(250ms);
  save("running");
  EXPECT_EQ(saved, 2);
}

TEST(SparingSave, CostsNothingWhereFrequenciesTakeLong) {
  int saved = 0;
  SparingSave save([&](const std::string&) { ++saved; });
  for (int k = 0; k < 5; ++k) {
    std::this_thread::sleep_for(2ms);
    save("running");
  }
  EXPECT_EQ(saved, 5);
}

}  // namespace
}  // namespace macadam::test
