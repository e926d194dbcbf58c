// SPDX-License-Identifier: GPL-3.0-or-later
/// \file peak_fit.hpp  Finds the strength of a specimen in a stress that vibrates.
#pragma once

#include <optional>
#include <span>

#include "macadam/experiments/response.hpp"

namespace macadam {

/// Strain and stress [Pa] at one time of a strength test.
struct StressSample {
  double strain = 0, stress_pa = 0;
};

/// Fits a cubic polynomial to the stress within ±25 % of the strain at `peak` and returns its largest value in the
/// direction of the load. Repeats the fit once around the strain of this value. Empty if the curve ends before the end
/// of this range, if the range has fewer than 20 samples, if the polynomial has no maximum within it, or if the samples
/// differ from the polynomial by more than 2 % of the peak (root mean square): then the curve has a corner.
std::optional<experiments::FittedPeak> fit_peak(std::span<const StressSample> samples, const experiments::Peak& peak);

/// Returns the vertex of the parabola through the sample with the largest stress in the direction of the load and its
/// two neighbours, for a stress without vibrations. Empty if the sample with the largest stress has no neighbour on one
/// of its sides.
std::optional<experiments::FittedPeak> interpolate_peak(std::span<const StressSample> samples);

/// Returns strain and stress of the peak of a test: of the polynomial that was fitted around it, if there is one.
/// `found.peak` must have a value.
experiments::FittedPeak peak_of(const experiments::SteppedResponse& found);

/// Returns whether the largest stress of a test, `peak_pa`, counts as the strength of the specimen: the specimen broke,
/// or contact points broke or cracked and the stress then fell by more than 1 % below the peak. `found` must have its
/// points, its rupture, its cracks and its increments.
bool passed_peak(const experiments::SteppedResponse& found, double peak_pa);

}  // namespace macadam
