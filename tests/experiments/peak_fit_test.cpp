// SPDX-License-Identifier: GPL-3.0-or-later
// peak_fit_test.cpp  Tests the strength that is read from a stress with vibrations.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "host/experiments/transient/peak_fit.hpp"

namespace macadam::test {
namespace {

constexpr double strength = 1.3e6, at_strength = 1.4e-3;  ///< [Pa], strain

/// Returns the stress at 2000 strains up to `end`, and the largest of them in the direction of the load.
std::vector<StressSample> samples_of(const std::function<double(double)>& stress, double end, experiments::Peak& peak) {
  std::vector<StressSample> out;
  peak = {};
  for (int k = 1; k <= 2000; ++k) {
    const double strain = end * k / 2000, sign = std::copysign(1.0, end);
    out.push_back({strain, stress(strain)});
    if (sign * out.back().stress_pa > sign * peak.stress_pa) peak = {0, strain, out.back().stress_pa};
  }
  return out;
}
double curve(double strain) {
  const double z = std::abs(strain) / at_strength - 1;
  return std::copysign(strength * (1 - 0.5 * z * z + 0.1 * z * z * z), strain);
}

TEST(PeakFit, IsExactForACubicCurveInBothDirections) {
  for (const double sign : {1.0, -1.0}) {
    experiments::Peak peak;
    const auto samples = samples_of(curve, sign * 2 * at_strength, peak);
    const auto fit = fit_peak(samples, peak);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->stress_pa, sign * strength, 1e-10 * strength);    // rounding of a system of condition 10
    EXPECT_NEAR(fit->strain, sign * at_strength, 1e-7 * at_strength);  // square root of the error of the stress
    EXPECT_LT(fit->deviation_pa, 1e-9 * strength);
  }
}

// A vibration of 1 % with 25 periods in the range moves the largest stress by 1 %, and the fit by less than a tenth of
// this, because the mean of the vibration over the range is below 1/25 of its amplitude.
TEST(PeakFit, DoesNotCountAVibrationAsStrength) {
  experiments::Peak peak;
  const auto stress = [](double strain) {
    return curve(strain) + 0.01 * strength * std::sin(50 * 2 * M_PI * strain / at_strength);
  };
  const auto samples = samples_of(stress, 2 * at_strength, peak);
  EXPECT_GT(peak.stress_pa, 1.009 * strength);
  const auto fit = fit_peak(samples, peak);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->stress_pa, strength, 1e-3 * strength);
  EXPECT_NEAR(fit->deviation_pa, 0.01 / std::sqrt(2) * strength, 1e-3 * strength);
}

TEST(PeakFit, IsEmptyForACornerAndForACurveThatEndsEarly) {
  experiments::Peak peak;
  const auto broken = [](double strain) { return strain < at_strength ? strength * strain / at_strength : 0; };
  auto samples = samples_of(broken, 2 * at_strength, peak);
  EXPECT_FALSE(fit_peak(samples, peak)) << "the stress falls at once";
  samples = samples_of(curve, 1.1 * at_strength, peak);
  EXPECT_FALSE(fit_peak(samples, peak)) << "the curve ends before 1.25 times the strain at the peak";
  EXPECT_FALSE(fit_peak({}, peak));
  EXPECT_FALSE(fit_peak(samples, {}));
}

TEST(PeakOfIncrements, IsTheVertexOfAParabola) {
  // 1 MPa at a strain of 1e-3, 1.25 % below it at the neighbours
  const auto at = [](double strain) { return StressSample{strain, 1e6 - 5e12 * (strain - 1e-3) * (strain - 1e-3)}; };
  const std::vector<StressSample> samples{at(0.93e-3), at(0.98e-3), at(1.03e-3), at(1.08e-3)};
  const auto found = interpolate_peak(samples);
  ASSERT_TRUE(found);
  // rounding of differences of 1e6 by some 1e-10, divided by falls of 1e3
  EXPECT_NEAR(found->stress_pa, 1e6, 1e-5);
  EXPECT_NEAR(found->strain, 1e-3, 1e-13);
}

TEST(PeakOfIncrements, IsNotFittedBeforeASuddenDrop) {
  const std::vector<StressSample> samples{{0.9e-3, 0.99e6}, {1e-3, 1e6}, {1.001e-3, 0.2e6}};
  EXPECT_FALSE(interpolate_peak(samples));
}

}  // namespace
}  // namespace macadam::test
