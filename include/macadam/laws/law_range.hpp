// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law_range.hpp  Defines the range of frequencies and temperatures in which a law holds.
#pragma once

#include <limits>

namespace macadam::laws {

/// The range in which a law holds, for example the range of the measurements to which it was fitted. Without limits the
/// law holds everywhere.
struct LawRange {
  /// Reduced frequencies f·a_T [Hz].
  double lowest_hz = 0, highest_hz = std::numeric_limits<double>::infinity();
  /// Temperatures [°C].
  double lowest_c = -std::numeric_limits<double>::infinity(), highest_c = std::numeric_limits<double>::infinity();

  bool operator==(const LawRange&) const = default;
  /// Whether frequencies, or temperatures, have limits.
  bool limits_frequency() const { return lowest_hz > 0 || highest_hz < std::numeric_limits<double>::infinity(); }
  bool limits_temperature() const {
    return lowest_c > -std::numeric_limits<double>::infinity() || highest_c < std::numeric_limits<double>::infinity();
  }
};

}  // namespace macadam::laws
