// SPDX-License-Identifier: GPL-3.0-or-later
/// \file talbot.hpp  From a Laplace transform to a time: a second way, which shares nothing with the first.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

namespace macadam::test {

/// Fixed Talbot inversion (Abate and Valkó 2004) of F(s) at t.
template <class F>
double talbot(F&& f, double t, int nodes) {
  using Complex = std::complex<double>;
  const double r = 2.0 * nodes / (5 * t);
  double sum = 0.5 * (std::exp(r * t) * f(Complex(r))).real();
  for (int k = 1; k < nodes; ++k) {
    const double angle = k * std::numbers::pi / nodes, cot = 1 / std::tan(angle);
    const Complex s = r * angle * Complex(cot, 1);
    const double sigma = angle + (angle * cot - 1) * cot;
    sum += (std::exp(t * s) * f(s) * Complex(1, sigma)).real();
  }
  return r / nodes * sum;
}

}  // namespace macadam::test
