// SPDX-License-Identifier: GPL-3.0-or-later
/// \file minimise.hpp  Minimises a sum of squares with known derivatives (Ceres Solver), and computes the statistics of
/// the result.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace macadam::calibration {

/// Computes residuals and, row by row, their derivatives by θ. Returns false if they cannot be computed at θ.
using Residuals = std::function<bool(const std::vector<double>& theta, std::vector<double>& residuals,
                                     std::vector<double>& jacobian)>;

/// Bounds of the logarithm of a parameter.
struct ParameterBounds {
  double low, high;
};

/// Minimises the sum of the squared residuals by Levenberg–Marquardt within bounds. The search starts from θ, which
/// must lie within the bounds, and stores the result in θ. `count`: number of residuals. Returns whether the final
/// residuals are finite.
bool minimise(const Residuals& residuals, std::size_t count, const std::vector<ParameterBounds>& bounds,
              std::vector<double>& theta);

/// Principal directions of θ for a Jacobian: unit vectors, and the standard deviation of θ along each (∞ if the
/// residuals do not depend on it).
struct Directions {
  std::vector<std::vector<double>> vector;
  std::vector<double> deviation;
};
Directions directions(const std::vector<double>& jacobian, std::size_t columns);

}  // namespace macadam::calibration
