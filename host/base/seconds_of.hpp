// SPDX-License-Identifier: GPL-3.0-or-later
/// \file seconds_of.hpp  Measures how long a function takes.
#pragma once

#include <chrono>

namespace macadam {

/// Calls f and returns the wall-clock time that it took [s].
template <class F>
double seconds_of(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace macadam
