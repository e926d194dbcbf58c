// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parallel.hpp  Runs independent pieces of work on all threads.
#pragma once

#include <cstddef>
#include <exception>
#include <vector>

namespace macadam {

/// Calls f(k) for k < n on all threads (on the calling thread if `threads` is false), in any order. An exception must
/// not leave an OpenMP thread. So all calls are made first, and exceptions are stored. Then the exception of the lowest
/// k is thrown again.
template <class F>
void for_each_in_parallel(std::size_t n, F&& f, bool threads = true) {
  std::vector<std::exception_ptr> thrown(n);
#pragma omp parallel for schedule(dynamic, 1) if (threads)
  for (std::size_t k = 0; k < n; ++k) {
    try {
      f(k);
    } catch (...) { thrown[k] = std::current_exception(); }
  }
  for (const std::exception_ptr& e : thrown) {
    if (e) std::rethrow_exception(e);
  }
}

/// Returns Σ f(k) over k < n. Splits the range of k into pieces, sums each piece, and adds the sums of the pieces in
/// order. So the bits do not depend on the number of threads. Treats exceptions like for_each_in_parallel().
template <class T, class F>
T sum_in_parallel(std::size_t n, F&& f) {
  constexpr std::size_t piece = 1 << 14;
  std::vector<T> pieces((n + piece - 1) / piece);
  for_each_in_parallel(pieces.size(), [&](std::size_t p) {
    T own{};
    for (std::size_t k = p * piece; k < n && k < (p + 1) * piece; ++k) own += f(k);
    pieces[p] = own;
  });
  T out{};
  for (const T& p : pieces) out += p;
  return out;
}

}  // namespace macadam
