// SPDX-License-Identifier: GPL-3.0-or-later
// parallel_blocks_test.cpp  Tests ranges that threads process in parallel: every number occurs once, in ascending
// order, and the first exception is thrown.
#include "host/spheres/parallel_blocks.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace macadam {
namespace {

class Ranges : public testing::TestWithParam<int> {
 protected:
  Ranges() { omp_set_num_threads(GetParam()); }
  ~Ranges() override { omp_set_num_threads(before_); }

 private:
  const int before_ = omp_get_max_threads();
};
INSTANTIATE_TEST_SUITE_P(Threads, Ranges, testing::Values(1, 2, 3, 7));

TEST_P(Ranges, HaveEveryNumberOnceAndAreAscending) {
  for (const std::size_t n : {0u, 1u, 2u, 6u, 7u, 8u, 1000u}) {
    for (const bool threads : {false, true}) {
      std::vector<std::size_t> begin(number_of_ranges(threads), n), end(begin);
      std::vector<int> met(n, 0);
      for_each_range(n, threads, [&](std::size_t range, std::size_t from, std::size_t to) {
        begin.at(range) = from, end.at(range) = to;
        for (std::size_t k = from; k < to; ++k) ++met[k];
      });
      EXPECT_EQ(met, std::vector<int>(n, 1));
      EXPECT_EQ(begin.front(), 0u);
      EXPECT_EQ(end.back(), n);
      for (std::size_t r = 1; r < begin.size(); ++r) EXPECT_EQ(begin[r], end[r - 1]) << n << ' ' << r;
    }
  }
}

TEST_P(Ranges, ThrowTheFirstOfTheirExceptionsWhenAllIsDone) {
  std::vector<int> met(number_of_ranges(true), 0);
  std::string said;
  try {
    for_each_range(100, true, [&](std::size_t range, std::size_t from, std::size_t) {
      ++met[range];
      if (range != 1 || met.size() == 1) throw std::runtime_error(std::to_string(from));
    });
  } catch (const std::runtime_error& error) { said = error.what(); }
  EXPECT_EQ(said, "0");
  EXPECT_EQ(met, std::vector<int>(met.size(), 1));
}

}  // namespace
}  // namespace macadam
