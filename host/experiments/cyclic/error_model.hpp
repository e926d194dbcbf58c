// SPDX-License-Identifier: GPL-3.0-or-later
/// \file error_model.hpp  Estimates of what settings cost in |E*| (relative) and φ [rad]. Those that rest on
/// measurements lie above everything that bench/accuracy measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// Returns the difference of a stiffness from the expected one.
ErrorEstimate difference(const Stiffness& found, const Stiffness& expected);
/// Returns the larger of the errors of |E*| and φ.
double largest(const ErrorEstimate& error);

/// Returns |k*(ω)| of a law [Pa]; for a law without complex stiffness, the largest stiffness that it ever has.
double stiffness_at(const Law& law, double omega);

/// Estimates the relative effect of inertia on |E*| per unit of density scaling. A bar of height H driven at one end
/// has E·kH·cot(kH) ≈ E·(1 − (kH)²/3), with k² = ω²·ρ/E. E is not known beforehand and is taken as a third of the
/// softest contact's |k*(ω)| (mastic alone has 0.6 of it, mixtures more than all of it), ρ as the heaviest material's.
double inertia_estimate(const Scene& scene, const Preparation& prepared, double frequency);

/// Quantities with which the rounding of a run grows.
struct RoundingScale {
  std::int64_t steps = 0;  ///< of the whole run
  double layers = 0;    ///< height over the mean distance of contacts: the ratio of velocities to relative velocities
  double contrast = 1;  ///< stiffest over softest |k*(ω)| of the pair types that occur
  double inertia = 0;   ///< effect of the scaled mass on |E*|, by inertia_estimate()
};
/// Returns these quantities for a run of one frequency.
RoundingScale rounding_scale(const Scene& scene, const Preparation& prepared, double frequency, std::int64_t steps,
                             double density_scaling);

/// Measured differences of a precision from double, and the range of these measurements: maxima of
/// bench/results/precision.csv, of the drift study in accuracy.csv and, for mixed precision, of the full specimen on a
/// device (whole-tests-h200-2026-11-21.csv). precision_test compares them with these files.
struct RoundingMeasured {
  double largest;       ///< difference of |E*| (relative) or φ [rad]
  RoundingScale up_to;  ///< largest values in the measurements
};
inline constexpr RoundingMeasured single_measured{2.3e-4, {4'000'000, 49, 1e7, 0.33}};
inline constexpr RoundingMeasured mixed_measured{5.9e-5, {11'897'000, 49, 1e7, 0.33}};

/// Return estimates that lie above everything that was measured. They are not bounds: other scenes may round
/// differently.
double single_precision_error(const RoundingScale& scale);
double mixed_precision_error(const RoundingScale& scale);

/// Describes which quantities of a run lie beyond the measurements; empty if none does.
std::string beyond(const RoundingScale& scale, const RoundingMeasured& measured);

/// Returns the error from stepping in blocks, which devices do. `blocks`: number of blocks in the shortest time of load
/// and laws.
double block_error(double blocks);
/// Returns the smallest number of such blocks whose error is at most `error`; at most 4,000, as in a run without a
/// tolerance.
double blocks_within(double error);

/// Returns the error from keeping the initial normals and arms at this strain.
double fixed_geometry_error(double strain);

/// Returns the number of cycles from rest after which the last one is within the tolerance of the steady state.
int cycles_from_rest(double tolerance);

}  // namespace macadam
