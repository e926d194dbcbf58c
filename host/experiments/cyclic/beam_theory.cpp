// SPDX-License-Identifier: GPL-3.0-or-later
// beam_theory.cpp  Computes the deflection line of a beam in closed form, as equations (B.3) and (B.4) of
// docs/bending.md.
#include "host/experiments/cyclic/beam_theory.hpp"

namespace macadam {

UnitDeflection::UnitDeflection(double left, double right, double loaded, double width, double height,
                               double poisson_ratio)
    : left_(left),
      right_(right),
      loaded_(loaded),
      second_moment_(width * height * height * height / 12),
      // E/(k·G·A) = 2·(1 + ν)/(k·A), with (1 + ν)/k = (12 + 11·ν)/10
      shear_((12 + 11 * poisson_ratio) / (5 * width * height)) {}

UnitDeflection::Part UnitDeflection::part_at(double x, double& from_support) const {
  const double a = loaded_ - left_, b = right_ - loaded_;
  if (x <= loaded_) {
    from_support = x - left_;
    return {a, b};
  }
  from_support = right_ - x;
  return {b, a};
}

double UnitDeflection::bending(const Part& part, double x) const {
  const double span = part.to_force + part.other, b = part.other;
  if (x <= 0) return bending_slope(part, x) * x;
  return b * x * (span * span - b * b - x * x) / (6 * span * second_moment_);
}

double UnitDeflection::bending_slope(const Part& part, double x) const {
  const double span = part.to_force + part.other, b = part.other, bent = x > 0 ? 3 * x * x : 0;
  return b * (span * span - b * b - bent) / (6 * span * second_moment_);
}

double UnitDeflection::shear(const Part& part, double x) const {
  return x > 0 ? shear_ * x * part.other / (part.to_force + part.other) : 0;
}

double UnitDeflection::deflection(double x) const {
  double from_support = 0;
  const Part part = part_at(x, from_support);
  return bending(part, from_support) + shear(part, from_support);
}

double UnitDeflection::slope(double x) const {
  double from_support = 0;
  const Part part = part_at(x, from_support);
  // seen from the right support, x grows towards the left
  return (x <= loaded_ ? 1 : -1) * bending_slope(part, from_support);
}

}  // namespace macadam
