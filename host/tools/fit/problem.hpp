// SPDX-License-Identifier: GPL-3.0-or-later
/// \file problem.hpp  Checks measurements and options, and turns them into the least-squares problem.
#pragma once

#include <numbers>
#include <vector>

#include "host/tools/fit/least_squares.hpp"

namespace macadam::fitting {

/// One degree [rad].
inline constexpr double degree = std::numbers::pi / 180;

/// The measurements as the least squares need them. The unknowns refer to the middle isotherm, so that the result does
/// not depend on the reference temperature that the user asks for.
struct Problem {
  std::vector<double> temperatures;  ///< temperatures of the isotherms, ascending [°C]
  std::vector<Target> targets;
  Unknowns unknowns;
  double wanted_reference = 0;      ///< reference temperature that the user asks for [°C]
  std::size_t wanted_isotherm = 0;  ///< the isotherm nearest to wanted_reference
};

/// Returns the problem. \throws InputError when measurements or options are invalid or do not determine the shift.
Problem make_problem(const ModulusData& data, const FitOptions& options);

/// Returns the special cases of the problem's shift law, as far as the temperatures determine them. Each law follows
/// the laws that it contains. WLF contains Arrhenius, and a free shift contains both.
std::vector<ShiftKind> contained_shift_laws(const Problem& problem);

}  // namespace macadam::fitting
