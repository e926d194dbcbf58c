// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parallel_blocks.hpp  Runs parallel loops over many small pieces of work that may throw.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>

#include "kernels/base/parallel.hpp"

namespace macadam {

/// Calls f(k) for all k < n, in blocks on all threads, or in order on the calling thread if `threads` is false. Handles
/// exceptions as for_each_in_parallel() does.
template <class F>
void for_each_in_blocks(std::size_t n, bool threads, F&& f) {
  constexpr std::size_t block = 64;
  const auto run = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) f(k);
  };
  if (!threads) return run(0, n);
  for_each_in_parallel((n + block - 1) / block, [&](std::size_t b) { run(b * block, std::min(n, (b + 1) * block)); });
}

/// Returns the number of ranges that for_each_range() makes.
inline std::size_t number_of_ranges(bool threads) {
  return threads ? static_cast<std::size_t>(omp_get_max_threads()) : 1;
}

/// Calls f(number, from, to) for consecutive ranges that cover 0 … n − 1, one range per thread. A thread gets the same
/// range each time, so that its cache may still hold the data. If several ranges throw, the exception of the lowest
/// range is rethrown.
template <class F>
void for_each_range(std::size_t n, bool threads, F&& f) {
  const std::size_t parts = number_of_ranges(threads);
  if (parts == 1) return f(std::size_t{0}, std::size_t{0}, n);
  std::vector<std::exception_ptr> thrown(parts);
#pragma omp parallel for schedule(static, 1)
  for (std::size_t p = 0; p < parts; ++p) {
    try {
      f(p, n * p / parts, n * (p + 1) / parts);
    } catch (...) { thrown[p] = std::current_exception(); }
  }
  for (const std::exception_ptr& e : thrown) {
    if (e) std::rethrow_exception(e);
  }
}

}  // namespace macadam
