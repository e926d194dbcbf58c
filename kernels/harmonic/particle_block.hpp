// SPDX-License-Identifier: GPL-3.0-or-later
/// \file particle_block.hpp  Computes the 6×6 stiffness of one particle while all others are at rest, and its inverse.
#pragma once

#include "kernels/harmonic/contact_end.hpp"

namespace macadam::kernels {

/// Converts a twist to an array in the order ux uy uz θx θy θz, and back.
template <class T>
MACADAM_HD void to_array(const Twist<T>& t, T (&out)[6]) {
  out[0] = t.linear.x, out[1] = t.linear.y, out[2] = t.linear.z;
  out[3] = t.angular.x, out[4] = t.angular.y, out[5] = t.angular.z;
}
template <class T>
MACADAM_HD Twist<T> to_twist(const T* v) {
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

/// Adds one contact to the block: block[6·c + r] += component r of the load that is needed for a unit motion c of the
/// particle. `k` (real) and `alpha` belong to the contact's pair; `series` is Contact::series.
MACADAM_HD void add_block(const ContactEnd& e, double k, double alpha, double series, double (&block)[36]) {
  const double normal = in_series(k, series), shear = in_series(k, alpha * series);
  for (int c = 0; c < 6; ++c) {
    double unit[6] = {0, 0, 0, 0, 0, 0}, load[6];
    unit[c] = 1;
    to_array(end_load(
                 e, to_twist(unit), Twist<double>{},
                 [=](double u, bool in_shear) { return (in_shear ? shear : normal) * u; }, alpha),
             load);
    for (int r = 0; r < 6; ++r) block[6 * c + r] -= load[r];
  }
}

/// Replaces a symmetric block without negative eigenvalues by its inverse. Returns the number of rows that are, to
/// rounding, linear combinations of the rows before them. In the inverse, which is then a generalised one, these rows
/// and columns are zero.
MACADAM_HD int invert_block(double (&a)[36]) {
  constexpr double rounding = 4 * 2.3e-16;  // relative error of a pivot, from sums of a dozen contacts
  double low[36];                           // a = low·lowᵀ; later low is replaced by its inverse
  int dependent = 0;
  for (int j = 0; j < 6; ++j) {
    double pivot = a[7 * j];
    for (int k = 0; k < j; ++k) pivot -= low[6 * j + k] * low[6 * j + k];
    if (!(pivot > rounding * a[7 * j])) {
      ++dependent;
      for (int i = j; i < 6; ++i) low[6 * i + j] = 0;
      continue;
    }
    const double root = sqrt(pivot);
    low[7 * j] = root;
    for (int i = j + 1; i < 6; ++i) {
      double v = a[6 * i + j];
      for (int k = 0; k < j; ++k) v -= low[6 * i + k] * low[6 * j + k];
      low[6 * i + j] = v / root;
    }
  }
  for (int j = 0; j < 6; ++j) {
    if (low[7 * j] > 0) low[7 * j] = 1 / low[7 * j];
    for (int i = j + 1; i < 6; ++i) {
      double v = 0;
      for (int k = j; k < i; ++k) v -= low[6 * i + k] * low[6 * k + j];
      low[6 * i + j] = low[7 * i] > 0 ? v / low[7 * i] : 0;
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      double v = 0;
      for (int k = i; k < 6; ++k) v += low[6 * k + i] * low[6 * k + j];
      a[6 * i + j] = a[6 * j + i] = v;
    }
  }
  return dependent;
}

}  // namespace macadam::kernels
