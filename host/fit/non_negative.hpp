// SPDX-License-Identifier: GPL-3.0-or-later
/// \file non_negative.hpp  Linear least squares with unknowns that may not be negative.
#pragma once

#include <Eigen/Dense>

namespace macadam::fitting {

/// The x ≥ 0 with the least ‖A·x − b‖, by the active sets of Lawson and Hanson (Solving Least Squares Problems, 1974,
/// chapter 23). Columns may differ in size and may depend on each other. Unknowns become positive one by one: where
/// no row is off by more than `enough`, the others stay 0.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double enough = 0);

}  // namespace macadam::fitting
