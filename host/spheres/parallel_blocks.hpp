// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parallel_blocks.hpp  Many small pieces of work on all threads, where one of them may throw.
#pragma once

#include <algorithm>

#include "kernels/parallel.hpp"

namespace macadam {

/// f(k) for k < n, in blocks on all threads, or in order on this one where `threads` is false. Exceptions as with
/// for_each_in_parallel().
template <class F>
void for_each_in_blocks(std::size_t n, bool threads, F&& f) {
  constexpr std::size_t block = 64;
  const auto run = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) f(k);
  };
  if (!threads) return run(0, n);
  for_each_in_parallel((n + block - 1) / block, [&](std::size_t b) { run(b * block, std::min(n, (b + 1) * block)); });
}

}  // namespace macadam
