// SPDX-License-Identifier: GPL-3.0-or-later
/// \file results.hpp  Evaluates sampled strain and stress of a cyclic test: |E*| and φ.
#pragma once

#include <complex>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// One sample of a cyclic test.
struct ResponseSample {
  double frequency_hz, time_s, strain, stress_pa;  ///< tension positive
  /// Mean strain across the axis, positive outwards; NaN if it was not measured at this sample.
  double lateral_strain = std::numeric_limits<double>::quiet_NaN();
};

/// Stiffness modulus and phase angle.
struct Stiffness {
  double e_star_pa = 0, phase_deg = 0;
};

/// Result of one cyclic test.
struct CyclicResult {
  Stiffness fit;             ///< from a fit of the fundamental with offset and trend over the last `fit_cycles` cycles
  Stiffness peaks;           ///< from the extreme values in the last cycle, by Eq. 24–25
  double fit_rms = 0;        ///< rms difference of the stress from its fit, over the stress amplitude
  double change_e_star = 0;  ///< relative change of |E*| from the last but one cycle to the last (NaN with one cycle)
  double change_phase_deg = 0;  ///< change of φ from the last but one cycle to the last, as a difference
  /// Complex Poisson's ratio: minus the fundamental of the lateral strain over that of the strain. Both are fitted to
  /// those samples of the last `fit_cycles` cycles that have a lateral strain; empty if there are fewer than 5.
  std::optional<std::complex<double>> poisson_ratio = {};
};

/// Fits offset, trend, fundamental and second harmonic to strain and stress over the last `fit_cycles` whole cycles
/// (least squares), and evaluates Eq. 24–25 on the last cycle (parabolic peaks). \throws InputError if the samples
/// cover less than one cycle.
CyclicResult evaluate_cyclic(std::span<const ResponseSample> samples, double frequency, int fit_cycles);

}  // namespace macadam
