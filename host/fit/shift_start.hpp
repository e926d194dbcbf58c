// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shift_start.hpp  Shift factors to begin with, read off the curves.
#pragma once

#include <vector>

#include "host/fit/least_squares.hpp"

namespace macadam::fitting {

/// The unknowns of the shift such that curves of |E*| at neighbouring temperatures lie on each other as well as they do
/// by the mean distance along the frequency axis. `temperatures` [°C] rise; Place::isotherm counts them.
std::vector<double> start_shift(const Unknowns& unknowns, const std::vector<Target>& targets,
                                const std::vector<double>& temperatures);

/// θ with the shift of a law, `unknowns`, as θ with a factor for each temperature and the same reference temperature.
std::vector<double> with_free_shift(const Unknowns& unknowns, const std::vector<double>& theta,
                                    const std::vector<double>& temperatures);

/// Limits of sense for these unknowns.
std::vector<Limits> shift_limits(const Unknowns& unknowns, const std::vector<double>& temperatures);

}  // namespace macadam::fitting
