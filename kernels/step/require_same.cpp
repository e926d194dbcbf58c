// SPDX-License-Identifier: GPL-3.0-or-later
// require_same.cpp  Checks that all processes of a run agree on a number. Steppers and the host call it.
#include <string>

#include "macadam/error.hpp"
#include "macadam/ranks.hpp"

namespace macadam {

void Ranks::require_same(const std::string& what, std::int64_t value) {
  const auto least_of = [this](std::int64_t n) { return static_cast<std::int64_t>(least(static_cast<double>(n))); };
  const std::int64_t low = least_of(value), high = -least_of(-value);
  if (low == high) return;
  throw RunError("ranks: " + what + ": found " + std::to_string(low) + " and " + std::to_string(high) +
                 ", expected the same value on all ranks: the ranks no longer run the same scene");
}

}  // namespace macadam
