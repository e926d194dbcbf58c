// SPDX-License-Identifier: GPL-3.0-or-later
// stability_test.cpp  Runs the cases of bench/stability (checks of the stability of time stepping) with reduced effort.
// Every row must be within its stated bounds.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "bench/stability/stability.hpp"

namespace macadam::stability {
namespace {

class Stability : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cases, Stability, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

TEST_P(Stability, ComesOutAsStated) {
  const std::string& name = GetParam().name;
  if (!test::long_tests && (name == "step_sweep" || name == "strain_amplitudes" || name.rfind("long", 0) == 0)) {
    GTEST_SKIP() << "hundreds of thousands of steps: not in sanitizer and coverage builds";
  }
  const Rows rows = GetParam().run(Effort::test);
  EXPECT_FALSE(rows.empty());
  for (const Row& row : rows) {
    EXPECT_TRUE(row.pass()) << fmt::format("{} | {} | {}: {:.6g}, expected {:.6g} … {:.6g}: {}", row.what, row.setting,
                                           row.quantity, row.measured, row.low, row.high, row.reason);
  }
}

// A row fails if its number is outside of the bounds or is not a number.
TEST(StabilityRow, FailsOutsideAndWithoutANumber) {
  Row row{"", "", "", 0, 1, "", 0.5};
  EXPECT_TRUE(row.pass());
  row.measured = 1.1;
  EXPECT_FALSE(row.pass());
  row.measured = -0.1;
  EXPECT_FALSE(row.pass());
  row.measured = std::nan("");
  EXPECT_FALSE(row.pass());
}

}  // namespace
}  // namespace macadam::stability
