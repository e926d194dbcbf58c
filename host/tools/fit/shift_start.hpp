// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shift_start.hpp  Computes first values of the shift factors from the distances between the measured curves.
#pragma once

#include <vector>

#include "host/tools/fit/least_squares.hpp"

namespace macadam::fitting {

/// Returns first values for the unknowns of the shift. They move the curves of |E*| at neighbouring temperatures by
/// their mean distance along the frequency axis, so that the curves lie on each other. `temperatures` [°C] ascend;
/// Place::isotherm is an index into them.
std::vector<double> start_shift(const Unknowns& unknowns, const std::vector<Target>& targets,
                                const std::vector<double>& temperatures);

/// Converts θ with a shift law (as in `unknowns`) to θ with one factor per temperature and the same reference
/// temperature.
std::vector<double> with_free_shift(const Unknowns& unknowns, const std::vector<double>& theta,
                                    const std::vector<double>& temperatures);

/// Returns the bounds of the unknowns of the shift.
std::vector<Limits> shift_limits(const Unknowns& unknowns, const std::vector<double>& temperatures);

}  // namespace macadam::fitting
