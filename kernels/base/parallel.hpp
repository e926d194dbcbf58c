// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parallel.hpp  Runs independent pieces of work on all threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>

namespace macadam {

/// Calls f(k) for k < n on all threads, in any order; on the calling thread if n = 1 or `threads` is false. Exceptions
/// must not leave an OpenMP thread. So all calls are made first, and exceptions are stored. Then the exception of the
/// lowest k is thrown again.
template <class F>
void for_each_in_parallel(std::size_t n, F&& f, bool threads = true) {
  std::vector<std::exception_ptr> thrown(n);
#pragma omp parallel for schedule(dynamic, 1) if (threads && n > 1)
  for (std::size_t k = 0; k < n; ++k) {
    try {
      f(k);
    } catch (...) { thrown[k] = std::current_exception(); }
  }
  for (const std::exception_ptr& e : thrown) {
    if (e) std::rethrow_exception(e);
  }
}

/// Calls f(from, to) for pieces of 0 … n − 1 on all threads. A piece has `size` numbers, the last one may have fewer.
/// Treats exceptions like for_each_in_parallel().
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

/// Returns the sum of f(from, to) over pieces of 0 … n − 1. A piece has `size` numbers, the last one may have fewer.
/// The pieces do not depend on the number of threads and are added in order, so neither do the bits of the sum.
template <class T, class F>
T sum_of_pieces(std::size_t n, std::size_t size, F&& f) {
  std::vector<T> pieces((n + size - 1) / size);
  for_pieces(n, size, [&](std::size_t from, std::size_t to) { pieces[from / size] = f(from, to); });
  T out{};
  for (const T& p : pieces) out += p;
  return out;
}

/// Returns Σ f(k) over k < n, as sum_of_pieces() does. Use a short piece if f takes long.
template <class T, class F>
T sum_in_parallel(std::size_t n, F&& f, std::size_t piece = 1 << 14) {
  return sum_of_pieces<T>(n, piece, [&](std::size_t from, std::size_t to) {
    T sum{};
    for (std::size_t k = from; k < to; ++k) sum += f(k);
    return sum;
  });
}

}  // namespace macadam
