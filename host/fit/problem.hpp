// SPDX-License-Identifier: GPL-3.0-or-later
/// \file problem.hpp  Measurements and options, checked and put into the terms of the misfit.
#pragma once

#include <numbers>
#include <vector>

#include "host/fit/least_squares.hpp"

namespace macadam::fitting {

inline constexpr double degree = std::numbers::pi / 180;

/// The measurements as the least squares want them.
struct Problem {
  std::vector<double> temperatures;  ///< each once, rising
  std::vector<Target> targets;
  Unknowns unknowns;
};

/// \throws InputError for what cannot be fitted.
Problem make_problem(const ModulusData& data, const FitOptions& options);

}  // namespace macadam::fitting
