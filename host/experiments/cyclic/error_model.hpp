// SPDX-License-Identifier: GPL-3.0-or-later
/// \file error_model.hpp  What settings cost in |E*| (relative) and φ [rad]: estimates, and figures above
/// all that bench/accuracy measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// What is found against what is expected.
ErrorEstimate difference(const Stiffness& found, const Stiffness& expected);
/// The larger of |E*|'s and φ's.
double largest(const ErrorEstimate& error);

/// |k*(ω)| of a law [Pa]; of one that has no complex stiffness, the largest that it ever has.
double stiffness_at(const Law& law, double omega);

/// What inertia costs per unit of density scaling, not known exactly: a bar of height H driven at one end has
/// E·kH·cot(kH) ≈ E·(1 − (kH)²/3), with k² = ω²·ρ/E. E is taken as a third of the softest contact's |k*(ω)| (mastic
/// alone has 0.6 of it, mixtures more than all of it), ρ as the heaviest material's.
double inertia_estimate(const Scene& scene, const Preparation& prepared, double frequency);

/// What the rounding of a run grows with.
struct RoundingScale {
  std::int64_t steps = 0;  ///< of the whole run
  double layers = 0;       ///< height over the mean distance of contacts: what velocities are over relative velocities
  double contrast = 1;     ///< stiffest over softest |k*(ω)| of the pair types that are there
  double inertia = 0;      ///< what the scaled mass costs of |E*|, by inertia_estimate()
};
RoundingScale rounding_scale(const Scene& scene, const Preparation& prepared, double frequency, std::int64_t steps,
                             double density_scaling);

/// Where a precision was compared with double, and what was found: maxima of bench/results/precision.csv, of the
/// drift study of accuracy.csv and, of mixed, of the full specimen on a device (whole-tests-h200-2026-11-21.csv).
/// precision_test holds them against these files.
struct RoundingMeasured {
  double largest;  ///< difference of |E*| (relative) or φ [rad]
  RoundingScale up_to;
};
inline constexpr RoundingMeasured single_measured{2.3e-4, {4'000'000, 49, 1e7, 0.33}};
inline constexpr RoundingMeasured mixed_measured{5.9e-5, {11'897'000, 49, 1e7, 0.33}};

/// Estimates that lie above all that was measured. No bounds: other scenes may round otherwise.
double single_precision_error(const RoundingScale& scale);
double mixed_precision_error(const RoundingScale& scale);

/// What of a run lies beyond the measurements, in words; empty where nothing does.
std::string beyond(const RoundingScale& scale, const RoundingMeasured& measured);

/// Where a device takes steps in blocks: what it costs that the shortest time of load and laws holds so many of them.
double block_error(double blocks);
/// As few blocks as cost no more than this; never more than the 4,000 of a run without a tolerance.
double blocks_within(double error);

/// Normals and arms of the start kept under this strain.
double fixed_geometry_error(double strain);

/// Cycles from rest after which the last one is within the tolerance of the steady state.
int cycles_from_rest(double tolerance);

}  // namespace macadam
