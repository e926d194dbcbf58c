// SPDX-License-Identifier: GPL-3.0-or-later
/// \file problem.hpp  Measurements and options, checked and put into the terms of the misfit.
#pragma once

#include <numbers>
#include <vector>

#include "host/fit/least_squares.hpp"

namespace macadam::fitting {

inline constexpr double degree = std::numbers::pi / 180;

/// The measurements as the least squares want them. The unknowns are those at the isotherm in the middle, so that the
/// result does not depend on the reference temperature that is asked for.
struct Problem {
  std::vector<double> temperatures;  ///< of the isotherms, rising [°C]
  std::vector<Target> targets;
  Unknowns unknowns;
  double wanted_reference = 0;  ///< reference temperature that is asked for [°C]
  std::size_t wanted_isotherm = 0;
};

/// \throws InputError for what cannot be fitted.
Problem make_problem(const ModulusData& data, const FitOptions& options);

/// The shift laws that a free shift contains and that the temperatures determine; none for another shift.
std::vector<ShiftKind> laws_in(const Problem& problem);

}  // namespace macadam::fitting
