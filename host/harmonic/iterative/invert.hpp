// SPDX-License-Identifier: GPL-3.0-or-later
/// \file invert.hpp  Inverts a dense matrix with all threads.
#pragma once

#include <Eigen/Core>

namespace macadam::harmonic {

/// Replaces a symmetric positive definite matrix by its inverse; only the lower triangle is read. The result does not
/// depend on the number of threads. Returns false if the matrix is not positive definite; its contents are then lost.
bool invert_in_parallel(Eigen::MatrixXd& matrix);

}  // namespace macadam::harmonic
