// SPDX-License-Identifier: GPL-3.0-or-later
/// \file invert.hpp  The inverse of a dense matrix by all threads.
#pragma once

#include <Eigen/Core>

namespace macadam::harmonic {

/// Replaces a symmetric positive definite matrix, of which the lower triangle counts, by its inverse; the same bits for
/// any number of threads. False, with the matrix lost, where it is not positive definite.
bool invert_in_parallel(Eigen::MatrixXd& matrix);

}  // namespace macadam::harmonic
