// SPDX-License-Identifier: GPL-3.0-or-later
/// \file pieces.hpp  Runs loops over contacts, particles or degrees of freedom on all threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include "kernels/base/parallel.hpp"

namespace macadam::quasi_static {

/// Calls f(from, to) for pieces of 0 … n − 1 on all threads. A piece has `size` numbers, the last one may have fewer.
template <class F>
void for_pieces(std::size_t n, std::size_t size, F&& f) {
  for_each_in_parallel((n + size - 1) / size, [&](std::size_t p) { f(p * size, std::min(n, (p + 1) * size)); });
}

/// Calls f(k) for k < n on all threads, in pieces.
template <class F>
void for_each_of(std::size_t n, F&& f) {
  constexpr std::size_t at_once = 512;
  for_pieces(n, at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) f(k);
  });
}

}  // namespace macadam::quasi_static
