// SPDX-License-Identifier: GPL-3.0-or-later
/// \file non_negative_least_squares.hpp  Solves linear least squares with unknowns that must not be negative.
#pragma once

#include <Eigen/Dense>

namespace macadam::fitting {

/// Returns the x ≥ 0 with the smallest ‖A·x − b‖, by the active-set method of Lawson and Hanson (Solving Least Squares
/// Problems, 1974, chapter 23). Columns may differ in size and may be linearly dependent. Unknowns become positive one
/// at a time. Once every component of A·x − b is at most `enough` in magnitude, the remaining unknowns stay 0.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double enough = 0);

}  // namespace macadam::fitting
