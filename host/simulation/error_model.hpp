// SPDX-License-Identifier: GPL-3.0-or-later
/// \file error_model.hpp  What settings cost in |E*| (relative) and φ [rad]: an estimate for inertia, and upper
/// envelopes of what bench/accuracy measured.
#pragma once

#include <cstddef>
#include <cstdint>

#include "macadam/simulation.hpp"

namespace macadam {

/// What is found against what is expected.
ErrorEstimate difference(const Stiffness& found, const Stiffness& expected);
/// The larger of |E*|'s and φ's.
double largest(const ErrorEstimate& error);

/// What inertia costs per unit of density scaling, not known exactly: a bar of height H driven at one end has
/// E·kH·cot(kH) ≈ E·(1 − (kH)²/3), with k² = ω²·ρ/E. E is taken as a third of the softest contact's |k*(ω)| (mastic
/// alone has 0.6 of it, mixtures more than all of it), ρ as the heaviest material's.
double inertia_estimate(const Scene& scene, const Preparation& prepared, double frequency);

/// Drift of single-precision chain states over so many steps.
double single_precision_error(std::int64_t steps);

/// Of `mixed`, however many steps (6e-7 was measured): single-precision geometry and gathered velocities.
inline constexpr double mixed_precision_error = 1.2e-6;

/// Where a device takes steps in blocks: what it costs that the shortest time of load and laws holds so many of them.
double block_error(double blocks);
/// As few blocks as cost no more than this; never more than the 4,000 of a run without a tolerance.
double blocks_within(double error);

/// Normals and arms of the start kept under this strain.
double fixed_geometry_error(double strain);

/// Cycles from rest after which the last one is within the tolerance of the steady state.
int cycles_from_rest(double tolerance);

}  // namespace macadam
