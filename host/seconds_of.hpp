// SPDX-License-Identifier: GPL-3.0-or-later
/// \file seconds_of.hpp  How long something takes.
#pragma once

#include <chrono>

namespace macadam {

/// Seconds that f takes, by the clock on the wall.
template <class F>
double seconds_of(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace macadam
