// SPDX-License-Identifier: GPL-3.0-or-later
/// \file finished_frequency.hpp  Computes the result of a stepped frequency from its samples.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/experiments/cyclic/plan.hpp"

namespace macadam {

/// Returns the samples of one frequency. In `samples` they follow one another from index `first` on.
std::span<const ResponseSample> samples_of(const std::vector<ResponseSample>& samples, std::size_t first,
                                           double frequency);

/// Returns |E*| and φ of each whole cycle of samples, from the first one on.
std::vector<Stiffness> stiffness_of_cycles(std::span<const ResponseSample> samples, double frequency);

/// Returns the result of frequency `number` of a plan. `samples`: the samples of this frequency. `seconds`: wall time
/// [s]. `rupture`: if the steps of this frequency ended early, the reason; the numbers of the result are then NaN.
experiments::SteppedFrequency finished_frequency(const Scene& scene, const Plan& whole, std::size_t number,
                                                 std::span<const ResponseSample> samples, double seconds,
                                                 const std::optional<experiments::Rupture>& rupture);

}  // namespace macadam
