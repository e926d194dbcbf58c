// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shift_start.hpp  Computes first values of the shift factors from the distances between the measured curves.
#pragma once

#include <vector>

#include "host/tools/fit/least_squares.hpp"

namespace macadam::fitting {

/// Returns first values for the unknowns of the shift. With these values the curves of |E*| at neighbouring
/// temperatures are moved along the frequency axis by their mean distance, so that the curves lie on each other.
/// `temperatures` [°C] ascend; Place::isotherm is an index into them.
std::vector<double> start_shift(const Unknowns& unknowns, const std::vector<Target>& targets,
                                const std::vector<double>& temperatures);

/// Converts θ, which belongs to `unknowns`, to the shift law `larger`, keeping the curve and the reference temperature.
/// The shift law of `unknowns` must be a special case of `larger`. Arrhenius is a special case of WLF, and every law is
/// a special case of a free shift.
std::vector<double> convert_shift(const Unknowns& unknowns, const std::vector<double>& theta, ShiftKind larger,
                                  const std::vector<double>& temperatures);

/// Returns the bounds of the unknowns of the shift.
std::vector<Limits> shift_limits(const Unknowns& unknowns, const std::vector<double>& temperatures);

}  // namespace macadam::fitting
