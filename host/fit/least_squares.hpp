// SPDX-License-Identifier: GPL-3.0-or-later
/// \file least_squares.hpp  The non-linear least squares of a fit (Ceres Solver, exact derivatives) and its statistics.
#pragma once

#include <vector>

#include "host/fit/fit_model.hpp"

namespace macadam::fitting {

/// A measured modulus in the terms of the misfit.
struct Target {
  Place place;
  double log_modulus = 0, phase = 0;                  ///< ln |E*| [of Pa], φ [rad]
  double modulus_deviation = 1, phase_deviation = 1;  ///< of them
};

/// Bounds of sense for an unknown.
struct Limits {
  double low, high;
};

/// Limits of the model's unknowns and then of the shift's.
inline std::vector<Limits> joined(std::vector<Limits> first, const std::vector<Limits>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

struct Minimum {
  std::vector<double> theta;
  double misfit = 0;       ///< Σ of the squared residuals
  bool determined = true;  ///< no unknown lies at its limits
};

/// Relative change of the misfit in a step at which the way down ends: as far as rounding lets it, or near enough.
inline constexpr double to_rounding = 1e-13, near_enough = 1e-5;

/// Goes down from a start, which is put between the limits first. The misfit is infinite where that has none.
Minimum refine(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
               std::vector<double> theta, double tolerance = to_rounding);

/// The residuals' sum of squares at θ.
double misfit_at(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<double>& theta);

/// ln |E*| and φ at a place with their derivatives by θ.
struct Prediction {
  Polar<double> value;
  std::vector<double> log_modulus_by, phase_by;
};
std::vector<Prediction> predict(const Unknowns& unknowns, const std::vector<Place>& places,
                                const std::vector<double>& theta);

/// (JᵀJ)⁻¹ of the residuals at θ, row by row. What the data do not determine at all is left out of it, and the unknowns
/// that have a part in that are marked in `undetermined`.
struct Covariance {
  std::vector<double> matrix;
  std::vector<bool> undetermined;
};
Covariance covariance_at(const Unknowns& unknowns, const std::vector<Target>& targets,
                         const std::vector<double>& theta);

}  // namespace macadam::fitting
