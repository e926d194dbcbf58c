// SPDX-License-Identifier: GPL-3.0-or-later
/// \file particle_inverse.hpp  Inverts the diagonal block of one particle for the preconditioner of increments.
#pragma once

#include <cmath>

#include "macadam/numeric.hpp"

namespace macadam::kernels {

/// A block whose smallest pivot is below this number, after scaling to a diagonal of one, is replaced by its diagonal.
inline constexpr double least_pivot = 1e-9;

/// Replaces a block [6][6] by the inverse of its symmetric part. If the block is not positive
/// definite, it is replaced by the inverse of its diagonal.
MACADAM_HD void invert_particle_block(double (&a)[36]) {
  double scale[6], low[36] = {};  // a, scaled, is low·lowᵀ
  for (int i = 0; i < 6; ++i) {
    const double size = fabs(a[7 * i]);
    scale[i] = 1 / sqrt(size > 1e-300 ? size : 1e-300);
  }
  bool positive = true;
  for (int j = 0; j < 6; ++j) {
    for (int i = j; i < 6; ++i) {
      double v = 0.5 * (a[6 * i + j] + a[6 * j + i]) * scale[i] * scale[j];
      for (int k = 0; k < j; ++k) v -= low[6 * i + k] * low[6 * j + k];
      if (i == j) {
        positive = positive && v > least_pivot;
        low[7 * j] = sqrt(v > least_pivot ? v : 1.0);
      } else {
        low[6 * i + j] = v / low[7 * j];
      }
    }
  }
  for (int column = 0; column < 6; ++column) {
    double x[6];
    for (int i = 0; i < 6; ++i) {
      double v = i == column ? 1 : 0;
      for (int k = 0; k < i; ++k) v -= low[6 * i + k] * x[k];
      x[i] = v / low[7 * i];
    }
    for (int i = 5; i >= 0; --i) {
      double v = x[i];
      for (int k = i + 1; k < 6; ++k) v -= low[6 * k + i] * x[k];
      x[i] = v / low[7 * i];
    }
    for (int i = 0; i < 6; ++i)
      a[6 * i + column] = scale[i] * scale[column] * (positive ? x[i] : (i == column ? 1.0 : 0.0));
  }
}

}  // namespace macadam::kernels
