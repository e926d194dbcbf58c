// SPDX-License-Identifier: GPL-3.0-or-later
// scaling.cpp  Finds the largest density scaling by bisection. The part of E* that is due to inertia is the derivative
// of E* with respect to the density scaling, so no linear system has to be solved again.
#include "host/experiments/cyclic/scaling.hpp"

#include <cmath>

#include "host/run/error_model.hpp"

namespace macadam {

double largest_scaling(const HarmonicResult& known, double viscous, double wanted) {
  using Complex = std::complex<double>;
  const Complex s(0, 2 * std::numbers::pi * known.frequency_hz);
  // relative change of E* per unit of (s² + s·β)·scaling
  const Complex each = known.parts.inertia / (s * s) / known.parts.modulus();
  const auto change = [&](double scaling) {
    const Complex relative = each * (scaling * (s * s + s * viscous) - s * s);
    return largest({std::abs(1.0 + relative) - 1, std::arg(1.0 + relative)});
  };
  if (!(change(1) < wanted)) return 1;  // even without scaling, damping changes E* by more than `wanted`
  double low = 1, high = 2;
  while (change(high) < wanted && high < 1e15) low = high, high *= 2;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (change(middle) < wanted ? low : high) = middle;
  }
  return low;
}

}  // namespace macadam
