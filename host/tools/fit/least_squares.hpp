// SPDX-License-Identifier: GPL-3.0-or-later
/// \file least_squares.hpp  Solves the non-linear least squares of a fit by Ceres Solver with exact derivatives, and
/// computes the covariance.
#pragma once

#include <vector>

#include "host/tools/fit/fit_model.hpp"

namespace macadam::fitting {

/// A measured modulus, as the quantities that the misfit (model (24.1)) compares: ln |E*| and φ.
struct Target {
  Place place;
  double log_modulus = 0, phase = 0;                  ///< ln |E*| [|E*| in Pa], φ [rad]
  double modulus_deviation = 1, phase_deviation = 1;  ///< standard deviations of ln |E*| and of φ [rad]
};

/// Bounds of an unknown.
struct Limits {
  double low, high;
};

/// Returns one list of limits, first of the unknowns of the model and then of the unknowns of the shift.
inline std::vector<Limits> joined(std::vector<Limits> first, const std::vector<Limits>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// A result of the least squares.
struct Minimum {
  std::vector<double> theta;
  double misfit = 0;       ///< sum of the squared residuals
  bool determined = true;  ///< whether no unknown lies at its limits
};

/// Relative change of the misfit per step at which a refinement ends: `to_rounding` is at the limit of rounding,
/// `near_enough` ends it early.
inline constexpr double to_rounding = 1e-13, near_enough = 1e-5;

/// Minimises the misfit from a start, whose values are first moved into their limits. The misfit of the result is
/// infinite if the misfit of the start is not finite.
Minimum refine(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
               std::vector<double> theta, double tolerance = to_rounding);

/// Returns the sum of the squared residuals at θ.
double misfit_at(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<double>& theta);

/// ln |E*| and φ at a place, with their derivatives by θ.
struct Prediction {
  Polar<double> value;
  std::vector<double> log_modulus_by, phase_by;
};
/// Returns the predictions of the model with the constants θ.
std::vector<Prediction> predict(const Unknowns& unknowns, const std::vector<Place>& places,
                                const std::vector<double>& theta);

/// The covariance (JᵀJ)⁻¹ of the unknowns θ, row by row; J holds the derivatives of the residuals by θ. Directions in θ
/// that the data do not determine at all are left out of the covariance; `undetermined` marks the unknowns of such a
/// direction.
struct Covariance {
  std::vector<double> matrix;
  std::vector<bool> undetermined;
};
Covariance covariance_at(const Unknowns& unknowns, const std::vector<Target>& targets,
                         const std::vector<double>& theta);

}  // namespace macadam::fitting
