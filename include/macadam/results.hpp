// SPDX-License-Identifier: GPL-3.0-or-later
/// \file results.hpp  From sampled strain and stress to |E*| and φ, and to files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// One sample of a cyclic test.
struct ResponseSample {
  double frequency_hz, time_s, strain, stress_pa;  ///< tension positive
};

/// Stiffness modulus and phase angle.
struct Stiffness {
  double e_star_pa = 0, phase_deg = 0;
};

/// What one cyclic test says.
struct CyclicResult {
  Stiffness fit;                ///< fundamental with offset and trend over the last `fit_cycles` cycles
  Stiffness peaks;              ///< Eq. 24–25 on the last cycle
  double fit_rms = 0;           ///< rms of stress not in the fit / stress amplitude
  double change_e_star = 0;     ///< |E*| of the last cycle / that of the cycle before − 1 (NaN with one cycle)
  double change_phase_deg = 0;  ///< φ likewise, difference
};

/// Fits offset + trend + fundamental + second harmonic to strain and stress over the last `fit_cycles` whole cycles
/// (least squares) and reads Eq. 24–25 off the last cycle (parabolic peaks). \throws InputError when the samples hold
/// less than one cycle.
CyclicResult evaluate_cyclic(std::span<const ResponseSample> samples, double frequency, int fit_cycles);

}  // namespace macadam
