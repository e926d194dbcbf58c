// SPDX-License-Identifier: GPL-3.0-or-later
/// \file error_model.hpp  Estimates the errors of |E*| (relative) and φ [rad] that the settings of a run cause.
/// Estimates that are based on measurements are larger than every error that bench/accuracy measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "macadam/simulation.hpp"

namespace macadam {

/// Returns the difference of a stiffness from an expected stiffness: of |E*| the relative difference, of φ the
/// difference in radians.
ErrorEstimate difference(const Stiffness& found, const Stiffness& expected);
/// Returns the larger of the errors of |E*| and φ.
double largest(const ErrorEstimate& error);

/// Returns |k*(ω)| of a law [Pa]; for a law without complex stiffness, the largest stiffness that it ever has.
double stiffness_at(const Law& law, double omega);

/// Returns the smallest and the largest stiffness of the contacts at a frequency [Pa]: force per area, divided by the
/// strain along the line of centres. Shear motion is included only if `shear` is true. The normal stiffness without
/// rock in series is |k*(ω)| of the law; the shear stiffness is α times as large. The length of each contact and its
/// rock in series are taken into account.
std::pair<double, double> stiffness_range(const Scene& scene, const ContactNetwork& network, double omega,
                                          bool shear = false);

/// Estimates the relative effect of inertia on |E*| per unit of density scaling. A bar of height H driven at one end
/// has E·kH·cot(kH) ≈ E·(1 − (kH)²/3), with k² = ω²·ρ/E. E is not known beforehand. A third of the softest contact's
/// |k*(ω)| is used in its place. The third is a low estimate of E: relative to the softest contact's |k*(ω)|, |E*| of
/// mastic alone is 0.6, and |E*| of mixtures is above 1. ρ is the density of the heavier material.
double inertia_estimate(const Scene& scene, const Preparation& prepared, double frequency);

/// Quantities with which the rounding error of a run grows.
struct RoundingScale {
  std::int64_t steps = 0;  ///< number of steps of the whole run
  /// Height of the specimen over the mean distance of particles in contact. This ratio is about the ratio of the
  /// velocities of particles to the relative velocities of neighbours.
  double layers = 0;
  double contrast = 1;  ///< largest |k*(ω)| over the smallest, of the pair types that occur
  double inertia = 0;   ///< effect of the scaled mass on |E*|, by inertia_estimate()
};
/// Returns the quantities of RoundingScale for a run of one frequency.
RoundingScale rounding_scale(const Scene& scene, const Preparation& prepared, double frequency, std::int64_t steps,
                             double density_scaling);

/// Largest measured difference of a precision from double precision, and the range of the measurements. The values are
/// the maxima of bench/results/precision.csv, of the drift study in accuracy.csv and, for mixed precision, of the full
/// specimen on a device (whole-tests-h200-2026-11-21.csv). The test precision_test in tests/ compares these values with
/// the files.
struct RoundingMeasured {
  double largest;       ///< difference of |E*| (relative) or φ [rad]
  RoundingScale up_to;  ///< largest values in the measurements
};
inline constexpr RoundingMeasured single_measured{2.3e-4, {4'000'000, 49, 1e7, 0.33}};
inline constexpr RoundingMeasured mixed_measured{5.9e-5, {11'897'000, 49, 1e7, 0.33}};

/// Return estimates of the rounding error in single and in mixed precision. The estimates are larger than every
/// measured error. But they are not bounds, because rounding errors of other scenes may be larger.
double single_precision_error(const RoundingScale& scale);
double mixed_precision_error(const RoundingScale& scale);

/// Returns a text about the first quantity of a run that exceeds the range of the measurements; empty if no quantity
/// does.
std::string beyond(const RoundingScale& scale, const RoundingMeasured& measured);

/// Returns the error caused by updating viscoelastic states only between blocks of steps (mixed and single precision).
/// `blocks`: number of blocks in the shortest characteristic time of the load and the laws.
double block_error(double blocks);
/// Returns the number of blocks in the shortest characteristic time for which block_error() equals `error`, but at most
/// 4,000. A run without a tolerance uses 4,000.
double blocks_within(double error);

/// Returns the error caused by keeping the initial normals and lever arms of the contacts at this strain.
double fixed_geometry_error(double strain);

/// Returns the number of cycles that a run from rest needs until its last cycle is within the tolerance of the steady
/// state.
int cycles_from_rest(double tolerance);

}  // namespace macadam
