// SPDX-License-Identifier: GPL-3.0-or-later
/// \file processor_time.hpp  Measures how much work code is, in a unit that depends neither on how fast the machine is
/// nor on how busy it is: processor time over the processor time of a fixed loop.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>

namespace macadam::test {

/// Returns the processor time of all threads of this process, and of the child processes that it has waited for [s].
inline double processor_seconds() {
  const auto of = [](int who) {
    rusage used{};
    getrusage(who, &used);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
  };
  return of(RUSAGE_SELF) + of(RUSAGE_CHILDREN);
}

/// Returns the processor time of 10⁸ multiplications that follow one another [s], the shortest of three measurements. A
/// processor of 3 GHz takes about 0.1 s.
inline double seconds_of_a_unit() {
  double least = 1e300;
  for (int k = 0; k < 3; ++k) {
    const double start = processor_seconds();
    std::uint64_t x = 1;
    for (int i = 0; i < 100'000'000; ++i) x = x * 6364136223846793005u + 1442695040888963407u;
    [[maybe_unused]] volatile std::uint64_t keep = x;
    least = std::min(least, processor_seconds() - start);
  }
  return least;
}

/// Returns the processor time of f() in units of 10⁸ multiplications that follow one another.
template <class F>
double units_of_work(F&& f) {
  const double start = processor_seconds();
  f();
  return (processor_seconds() - start) / seconds_of_a_unit();
}

}  // namespace macadam::test
