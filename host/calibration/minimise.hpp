// SPDX-License-Identifier: GPL-3.0-or-later
/// \file minimise.hpp  Least squares of a function that gives its derivatives (Ceres Solver), and their statistics.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace macadam::calibration {

/// Residuals and, row by row, their derivatives by θ. Whether θ has any.
using Residuals = std::function<bool(const std::vector<double>& theta, std::vector<double>& residuals,
                                     std::vector<double>& jacobian)>;

struct Bounds {
  double low, high;
};

/// Levenberg-Marquardt within bounds from θ, which lies between them. Whether it came to an end with finite residuals.
bool minimise(const Residuals& residuals, std::size_t count, const std::vector<Bounds>& bounds,
              std::vector<double>& theta);

/// Principal directions of θ by a Jacobian: unit vectors, the standard deviation of each (∞ where nothing tells).
struct Directions {
  std::vector<std::vector<double>> vector;
  std::vector<double> deviation;
};
Directions directions(const std::vector<double>& jacobian, std::size_t columns);

}  // namespace macadam::calibration
