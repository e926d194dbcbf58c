// SPDX-License-Identifier: GPL-3.0-or-later
// crack_tangent_test.cpp  Compares the consistent tangent of a contact point with differences of its stresses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "macadam/laws/crack_tangent.hpp"

namespace macadam::test {
namespace {

using laws::Crack;
using laws::CrackTangent;
using laws::Softening;
using Solve = laws::CrackSolve<double, laws::passes_of_increment>;

/// One increment of a contact point.
struct PointIncrement {
  Solve crack;
  laws::CrackOpenings<double> old;
  double normal, shear[2];
  double kappa = 6e12, kappa_s = crack.alpha * kappa;

  /// Returns the increment with a displacement of the point along opening (0) or slips (1, 2) added [m].
  CrackTangent moved(int component, double by) const {
    const double shear_by = kappa_s * by;
    const double moved_shear[2] = {shear[0] + (component == 1 ? shear_by : 0),
                                   shear[1] + (component == 2 ? shear_by : 0)};
    return CrackTangent::of(crack, normal + (component == 0 ? kappa * by : 0), moved_shear, kappa, kappa_s, old);
  }
  /// Returns whether the point does the same at all displacements within `by`, so that its stresses are smooth there.
  bool is_smooth(double by) const {
    const auto kind = [this](const CrackTangent& t) {
      return std::array{static_cast<int>(t.branch), int{t.w.opening > 0}, int{t.w.largest > 0},
                        int{t.w.largest > crack.curve.kink}, int{t.w.largest > crack.curve.end}};
    };
    const auto here = kind(moved(0, 0));
    for (int component = 0; component < 3; ++component) {
      for (const double sign : {-1.0, 1.0}) {
        if (kind(moved(component, sign * by)) != here) return false;
      }
    }
    return true;
  }
};

class CrackTangents : public testing::TestWithParam<Softening> {};
INSTANTIATE_TEST_SUITE_P(All, CrackTangents,
                         testing::Values(Softening::linear, Softening::bilinear, Softening::exponential),
                         [](const auto& info) { return std::string(to_string(info.param)); });

// Central differences over 1e-12 m have a relative error of 1e-7 from rounding (1e-16·1e6 Pa over 6 Pa) and much less
// from curvature.
TEST_P(CrackTangents, AreTheDerivativesOfTheStresses) {
  std::mt19937 random(7);
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(random()) / 4294967296.0);
  };
  int seen[3] = {};
  for (int n = 0; n < 20000; ++n) {
    const double energy = uniform(100, 300);
    Crack values{2e6, energy, 4e6, uniform(1, 2) * energy, 0.5, n % 2 == 0 ? 0.5 : 0.3};
    values.softening = GetParam();
    PointIncrement point{
        Solve::of(values, uniform(0.1, 0.5)), {0, {0, 0}, 0}, uniform(-3e6, 4e6), {uniform(-6e6, 6e6), 0}};
    point.shear[1] = uniform(-6e6, 6e6);
    point.kappa_s *= uniform(0.3, 1);  // as with rock in series
    if (n % 4 > 0) {                   // a crack of any direction, which has unloaded or not
      const double y = uniform(0, 0.9 * values.separation()), part = uniform(0, 1);
      const double up = uniform(0, std::numbers::pi / 2), round = uniform(0, 2 * std::numbers::pi);
      const double slip = y * std::cos(up) * part / values.slip_weight();
      point.old = {n % 4 == 1 ? 0 : y * std::sin(up) * part, {slip * std::cos(round), slip * std::sin(round)}, y};
    }
    constexpr double step = 1e-12;
    if (!point.is_smooth(step)) continue;
    const CrackTangent here = point.moved(0, 0);
    ++seen[static_cast<int>(here.branch)];
    for (int l = 0; l < 3; ++l) {
      const CrackTangent above = point.moved(l, step), below = point.moved(l, -step);
      for (int k = 0; k < 3; ++k) {
        const double difference = (above.stress[k] - below.stress[k]) / (2 * step);
        EXPECT_NEAR(here.stiffness[k][l], difference, 1e-6 * point.kappa) << n << " " << k << " " << l;
      }
    }
  }
  for (const int count : seen) EXPECT_GT(count, 500);
}

}  // namespace
}  // namespace macadam::test
