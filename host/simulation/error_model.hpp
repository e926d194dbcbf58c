// SPDX-License-Identifier: GPL-3.0-or-later
/// \file error_model.hpp  What settings cost in |E*| (relative) and φ [rad]: bounds, and figures measured by
/// bench/accuracy.
#pragma once

#include <cstddef>
#include <cstdint>

#include "macadam/simulation.hpp"

namespace macadam {

/// Particles whose stiffness is factored unasked: memory grows as about n^(4/3), 2 GB for 35,760.
inline constexpr std::size_t largest_harmonic = 100'000;

/// What the inertia of the first stiffness costs against the second.
ErrorEstimate inertia_error(const Stiffness& found, const Stiffness& expected);
/// The larger of |E*|'s and φ's.
double largest(const ErrorEstimate& error);

/// Bound of what true mass costs: a bar of height H driven at one end has E·kH·cot(kH) ≈ E·(1 − (kH)²/3), with
/// k² = ω²·ρ/E; E is not below the softest contact's |k*(ω)|, ρ not above the heaviest material's.
double inertia_bound(const Scene& scene, const Preparation& prepared, double frequency);

/// Drift of single-precision chain states over so many steps.
double single_precision_error(std::int64_t steps);

/// Normals and arms of the start kept under this strain.
double fixed_geometry_error(double strain);

/// Cycles from rest after which the last one is within the tolerance of the steady state.
int cycles_from_rest(double tolerance);

}  // namespace macadam
