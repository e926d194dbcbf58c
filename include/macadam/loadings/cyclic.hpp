// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cyclic.hpp  Uniaxial tension–compression: u(t) = −A·r(t)·sin(2πft) of the top wall (section 4.4).
#pragma once

#include <cmath>
#include <cstdint>

#include "macadam/numeric.hpp"

namespace macadam::loadings {

/// A whole number of steps makes a period, so the phase of step k is exact however long the run. The smooth start
/// r(t) rises from 0 to 1 over `ramp_steps` as a half cosine; 0 starts at once.
struct Cyclic {
  static constexpr const char* name = "cyclic";
  double amplitude = 0;  ///< A [m]
  double frequency = 0;  ///< f [Hz]
  std::int64_t steps_per_period = 1;
  std::int64_t ramp_steps = 0;

  MACADAM_HD double dt() const { return 1.0 / (frequency * static_cast<double>(steps_per_period)); }

  /// Wall displacement at step k + half/2 [m], half 0 or 1.
  MACADAM_HD double displacement(std::int64_t k, int half = 0) const {
    return -amplitude * ramp(k, half) * std::sin(phase(k, half));
  }

  /// Mean wall velocity between the steps k and k + 1 [m/s]: the difference of the two displacements over Δt,
  /// rearranged so that nothing cancels.
  MACADAM_HD double velocity(std::int64_t k) const {
    const double half_step = 3.14159265358979323846 / static_cast<double>(steps_per_period);
    double v = 2 * ramp(k, 1) * std::sin(half_step) * std::cos(phase(k, 1));
    if (ramping(k)) {  // sin at the middle times the rise of r over the step; exact to second order in Δt
      v += (ramp(k + 1, 0) - ramp(k, 0)) * std::sin(phase(k, 1));
    }
    return -amplitude * v / dt();
  }

 private:
  /// A steady start looks one step back, to k = −1: there is no ramp before the start.
  MACADAM_HD bool ramping(std::int64_t k) const { return k >= 0 && k < ramp_steps; }
  MACADAM_HD double phase(std::int64_t k, int half) const {
    const double in_period = static_cast<double>(k % steps_per_period) + 0.5 * half;
    return 6.28318530717958647693 * (in_period / static_cast<double>(steps_per_period));
  }
  MACADAM_HD double ramp(std::int64_t k, int half) const {
    if (!ramping(k)) return 1.0;
    const double s =
        std::sin(1.57079632679489661923 * ((static_cast<double>(k) + 0.5 * half) / static_cast<double>(ramp_steps)));
    return s * s;
  }
};

}  // namespace macadam::loadings
