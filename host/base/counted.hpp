// SPDX-License-Identifier: GPL-3.0-or-later
/// \file counted.hpp  Converts counts to narrower integer types.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "macadam/error.hpp"

namespace macadam {

/// Returns the count as a T. \throws RunError, naming what was counted, if the count is larger than T can hold.
template <class T>
T counted(std::size_t found, const char* what) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<T>::max());
  if (found > most) {
    throw RunError("found " + std::to_string(found) + " " + what + ", expected at most " + std::to_string(most) +
                   ", because they are numbered with integers of " + std::to_string(8 * sizeof(T)) + " bits");
  }
  return static_cast<T>(found);
}

}  // namespace macadam
