// SPDX-License-Identifier: GPL-3.0-or-later
// draws_ahead_test.cpp  Tests that threads which make attempts in parallel take the same numbers from a random stream
// as one thread that makes one attempt after another.
#include "host/spheres/draws_ahead.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "macadam/error.hpp"

namespace macadam {
namespace {

/// The random numbers of the successful attempts of a search, followed by the next number of the stream.
using Found = std::vector<double>;

/// An attempt uses two random numbers; it succeeds if their product exceeds a limit.
bool good(double a, double b, double limit) { return a * b > limit; }

/// Returns the result of searches that make one attempt after another.
Found one_by_one(std::uint64_t seed, double limit, std::int64_t most, int searches) {
  RandomStream random(seed, 0);
  Found found;
  for (int s = 0; s < searches; ++s)
    for (std::int64_t k = 0; k < most; ++k) {
      const double a = random.uniform(), b = random.uniform();
      if (!good(a, b, limit)) continue;
      found.push_back(a), found.push_back(b);
      break;
    }
  found.push_back(random.uniform());
  return found;
}

/// Appends the next number of the stream.
Found next_of(DrawsAhead& random, Found found) {
  found.push_back(random.first_good(1, 1, 1, [](Draws) { return true; })->uniform());
  return found;
}

class SearchesOf : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { omp_set_num_threads(GetParam()); }
  void TearDown() override { omp_set_num_threads(threads_); }
  int threads_ = omp_get_max_threads();
};
INSTANTIATE_TEST_SUITE_P(Threads, SearchesOf, testing::Values(1, 2, 3, 16));

/// For any number of threads, first_good() finds the same successful attempt as a loop over single attempts.
TEST_P(SearchesOf, TheFirstGoodTry) {
  for (const double limit : {0.0, 0.5, 0.9, 0.999, 1.0})
    for (const std::int64_t most : {1, 7, 1000}) {
      DrawsAhead random(RandomStream(5, 0));
      Found found;
      for (int s = 0; s < 20; ++s) {
        const auto attempt = [&](Draws d) {
          const double a = d.uniform();
          return good(a, d.uniform(), limit);
        };
        if (auto draws = random.first_good(most, 2, 4, attempt)) {
          found.push_back(draws->uniform());
          found.push_back(draws->uniform());
        }
      }
      EXPECT_EQ(one_by_one(5, limit, most, 20), next_of(random, found)) << limit << ", " << most << " tries";
    }
}

/// For any number of threads, each_good() finds the same successful attempts as a loop over single attempts.
TEST_P(SearchesOf, ManyGoodTries) {
  for (const int wanted : {1, 3, 500})
    for (const double limit : {0.0, 0.5, 0.9}) {
      DrawsAhead random(RandomStream(6, 0));
      Found found;
      const auto attempt = [&](Draws d) {
        const double a = d.uniform();
        return good(a, d.uniform(), limit);
      };
      const auto take = [&](Draws d) {
        found.push_back(d.uniform());
        found.push_back(d.uniform());
        return found.size() < 2 * static_cast<std::size_t>(wanted);
      };
      EXPECT_TRUE(random.each_good(100'000, 2, 4, attempt, take));
      EXPECT_EQ(one_by_one(6, limit, 100'000, wanted), next_of(random, found)) << wanted << " above " << limit;
    }
}

/// A search ends after 300 failures in a row.
TEST_P(SearchesOf, GiveUpAfterSoManyTriesInARow) {
  int taken = 0;
  const auto rare = [](Draws d) { return d.uniform() > 0.99; };
  const auto take = [&](Draws) { return ++taken > 0; };
  DrawsAhead random(RandomStream(7, 0));
  EXPECT_FALSE(random.each_good(300, 1, 4, rare, take));
  // The expected value is the number of successes before the first 300 failures in a row.
  RandomStream same(7, 0);
  int expected = 0;
  for (int failed = 0; failed < 300;) same.uniform() > 0.99 ? (failed = 0, ++expected) : ++failed;
  EXPECT_EQ(taken, expected);
  EXPECT_EQ(next_of(random, {}), Found{same.uniform()});
}

TEST_P(SearchesOf, WhatATryThrowsIsThrown) {
  DrawsAhead random(RandomStream(8, 0));
  const auto attempt = [](Draws d) -> bool {
    if (d.uniform() > 0.9) throw RunError("a try");
    return false;
  };
  EXPECT_THROW(random.first_good(10'000, 1, 4, attempt), RunError);
}

}  // namespace
}  // namespace macadam
