// SPDX-License-Identifier: GPL-3.0-or-later
/// \file talbot.hpp  Numerical inversion of a Laplace transform, independent of the method that the library uses.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

namespace macadam::test {

/// Returns the inverse at time t of the Laplace transform F(s), by the fixed Talbot method (Abate and Valkó 2004).
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
