// SPDX-License-Identifier: GPL-3.0-or-later
// Tests corrections of a scan. Each correction removes the artefact for which it is made, and leaves real differences
// of composition alone.
#include <gtest/gtest.h>

#include "host/tools/ct/voxels/correction.hpp"
#include "host/tools/ct/voxels/smoothing.hpp"
#include "tests/tools/ct/ct_scans.hpp"

namespace macadam {
namespace {

using namespace ct_scans;

/// Returns the largest and the root mean square difference of two scans, as fractions of the contrast of aggregate and
/// mastic.
std::pair<double, double> difference(const Image<float>& a, const Image<float>& b) {
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < a.count(); ++i) {
    const double d = std::abs(a.voxels[i] - b.voxels[i]) / contrast;
    largest = std::max(largest, d);
    sum += d * d;
  }
  return {largest, std::sqrt(sum / static_cast<double>(a.count()))};
}

/// Returns the scan with every grey value replaced by fault(i, j, k, grey).
template <class Fault>
Image<float> with(const Image<float>& scan, Fault&& fault) {
  Image<float> out = scan;
  for (std::int64_t k = 0; k < out.size[2]; ++k)
    for (std::int64_t j = 0; j < out.size[1]; ++j)
      for (std::int64_t i = 0; i < out.size[0]; ++i)
        out.at(i, j, k) = static_cast<float>(fault(i, j, k, out.at(i, j, k)));
  return out;
}

class CtCorrection : public testing::Test {
 protected:
  Image<float> true_ = many_balls(88);
  Image<std::uint8_t> region_ = Image<std::uint8_t>::like(true_, 1);
  void SetUp() override { add_noise(true_, 0.05); }
};

TEST(CtBlocks, HaveTheMeansTheEdgesAndThePlaceOfTheirVoxels) {
  Image<float> scan({5, 7, 4}, {1e-3, 2e-3, 3e-3}, {0.1, 0.2, 0.3});
  for (std::size_t i = 0; i < scan.voxels.size(); ++i) scan.voxels[i] = static_cast<float>(i);
  Image<std::uint8_t> region = Image<std::uint8_t>::like(scan, 1);
  region.at(3, 5, 1) = 0;
  const auto [means, inside] = ct::means_of_blocks(scan, region, {2, 3, 4});
  EXPECT_EQ(means.size, (std::array<std::int64_t, 3>{2, 2, 1}));  // incomplete blocks at the ends are left out
  constexpr double rounding = 1e-15;                              // rounding of coordinates below 1 m
  EXPECT_LT(norm(means.spacing - Vec3d{2e-3, 6e-3, 12e-3}), rounding);
  EXPECT_LT(norm(means.centre(0, 0, 0) - Vec3d{0.1 + 0.5e-3, 0.2 + 2e-3, 0.3 + 4.5e-3}), rounding);
  EXPECT_EQ(inside.voxels, (std::vector<std::uint8_t>{1, 1, 1, 0}));
  const auto middle = [&](double i, double j, double k) { return static_cast<float>(i + 5 * j + 35 * k); };
  EXPECT_FLOAT_EQ(means.at(1, 0, 0), middle(2.5, 1, 1.5));
  EXPECT_FLOAT_EQ(means.at(0, 1, 0), middle(0.5, 4, 1.5));
}

/// Grey levels that drift from slice to slice are restored; at most a fifth of the drift remains.
TEST_F(CtCorrection, SlicesThatDriftGetTheLevelsOfAll) {
  Image<float> scan = with(true_, [](auto, auto, std::int64_t k, float grey) {
    return grey * (1 + 0.08 * std::sin(0.3 * static_cast<double>(k)));
  });
  const double before = difference(scan, true_).second;
  for (int round = 0; round < 3; ++round) ct::correct_slices(scan, region_);
  // The level of a slice is a mean over 840 blocks. After the correction, the noise of this mean replaces the drift.
  EXPECT_LT(difference(scan, true_).second, 0.2 * before);
}

/// The recorded correction, evaluated half-way between two slices, is the mean of the corrections of both.
TEST_F(CtCorrection, BetweenTwoSlicesHalfOfEachIsTakenOut) {
  Image<float> scan = with(true_, [](auto, auto, std::int64_t k, float grey) {
    return grey * (1 + 0.08 * std::sin(0.3 * static_cast<double>(k)));
  });
  ct::CorrectionSteps steps;
  ct::correct_slices(scan, region_, &steps);
  ASSERT_EQ(steps.size(), 1u);
  for (const double k : {20.0, 31.0, 86.0}) {
    const double low = steps[0].of(mastic, 5, 6, k), high = steps[0].of(mastic, 5, 6, k + 1);
    EXPECT_GT(std::abs(high - low), 0.005 * contrast);
    // The test divides grey values by a factor that is linear between slices. The quotient is not linear, so between
    // two slices the correction deviates from a line by about a hundredth of the difference between the slices.
    EXPECT_NEAR(steps[0].of(mastic, 5, 6, k + 0.5), (low + high) / 2, 0.02 * std::abs(high - low));
  }
}

/// A layer that contains more aggregate must not be corrected away.
TEST_F(CtCorrection, ALayerOfMoreAggregateIsNoFaultOfItsSlices) {
  Image<float> scan = with(true_, [](auto, auto, std::int64_t k, float grey) {
    return k > 40 && k < 60 && grey > air + 9000 ? aggregate - 0.25 * (aggregate - grey) : grey;
  });
  const Image<float> layered = scan;
  ct::correct_slices(scan, region_);
  double sum = 0, slices = 0;
  // A correction by the mean grey value of a slice would shift whole slices by 0.3 of the contrast and more.
  for (std::int64_t k = 0; k < 88; ++k) {
    double shift = 0;
    for (std::size_t i = 0; i < 88 * 88; ++i) {
      const std::size_t at = static_cast<std::size_t>(k) * 88 * 88 + i;
      shift += (scan.voxels[at] - layered.voxels[at]) / contrast / (88 * 88);
    }
    sum += std::abs(shift), ++slices;
  }
  EXPECT_LT(sum / slices, 0.05);
}

/// Ring artefacts are reduced to less than half, and a scan without rings changes by at most 0.03.
TEST_F(CtCorrection, RingsGoAndTheRestStays) {
  const auto ring = [](std::int64_t i, std::int64_t j) {
    return std::hypot(static_cast<double>(i) - 43.5, static_cast<double>(j) - 43.5);
  };
  Image<float> scan = with(true_, [&](std::int64_t i, std::int64_t j, auto, float grey) {
    const auto r = std::lround(ring(i, j));
    return grey + (r % 11 == 5 && r > 8 ? 0.25 * contrast : 0.0);
  });
  const double before = difference(scan, true_).second;
  for (int round = 0; round < 3; ++round) ct::correct_rings(scan, region_);
  // A ring passes through only about a dozen balls, so the mean grey value of a ring varies. Therefore the correction
  // changes even a clean scan by 0.03. Here the correction reduces a difference of 0.07 to this 0.03.
  EXPECT_LT(difference(scan, true_).second, 0.5 * before);
  Image<float> clean = true_;
  ct::correct_rings(clean, region_);
  EXPECT_LT(difference(clean, true_).second, 0.03);
}

/// The reported strength of the rings is the root mean square over all radii. The recorded correction can be evaluated
/// at any position, and there gives the grey value of the corrected scan.
TEST(CtRings, AreAsStrongAsIsSaidAndStepsTakeTheSameOutOfEveryPlace) {
  // The scan has two layers, so that every ring contains the same fractions of both phases. Rings of 0.1 of the
  // contrast are at 4 of the 43 whole radii.
  Image<float> layers({61, 61, 48}, {1e-4, 1e-4, 1e-4}, {}, mastic);
  std::fill(layers.voxels.begin() + 61 * 61 * 30, layers.voxels.end(), aggregate);
  add_noise(layers, 0.05);
  const Image<float> before = with(layers, [](std::int64_t i, std::int64_t j, auto, float grey) {
    const auto r = std::lround(std::hypot(static_cast<double>(i) - 30, static_cast<double>(j) - 30));
    return grey + (r == 11 || r == 19 || r == 27 || r == 35 ? 0.1 * contrast : 0.0);
  });
  Image<float> scan = before;
  ct::CorrectionSteps steps;
  // The level of a ring is a mean of more than a thousand voxels, so it is accurate to a hundredth of 0.1.
  EXPECT_NEAR(ct::correct_rings(scan, Image<std::uint8_t>::like(scan, 1), &steps), 0.1 * std::sqrt(4.0 / 43), 0.002);
  EXPECT_NEAR(scan.at(30, 41, 7) - before.at(30, 41, 7), -0.1 * contrast, 0.01 * contrast);
  ASSERT_EQ(steps.size(), 1u);
  for (std::int64_t n = 0; n < 61; ++n) {  // on lines where the radii are whole numbers
    const auto at = static_cast<double>(n);
    EXPECT_NEAR(steps[0].of(before.at(30, n, 7), 30, at, 7), scan.at(30, n, 7), 0.01) << n;
    EXPECT_NEAR(steps[0].of(before.at(n, 30, 7), at, 30, 7), scan.at(n, 30, 7), 0.01) << n;
  }
}

TEST_F(CtCorrection, CuppingIsTakenAway) {
  Image<float> scan = with(true_, [](std::int64_t i, std::int64_t j, auto, float grey) {
    const double r = std::hypot(static_cast<double>(i) - 43.5, static_cast<double>(j) - 43.5) / 62;
    return grey * (1 - 0.15 * (1 - r * r));
  });
  // Cupping leaves the gain and offset of the whole scan undetermined; here they are taken from the true scan.
  SegmentOptions options;
  options.rings = options.slices = false;
  ct::correct(scan, region_, options);
  const GreyLevels levels = ct::fit_levels(ct::histogram_of(scan, region_)),
                   wanted = ct::fit_levels(ct::histogram_of(true_, region_));
  const double gain = wanted.contrast() / levels.contrast();
  for (float& grey : scan.voxels) grey = static_cast<float>(wanted.mastic + gain * (grey - levels.mastic));
  // before the correction, grey values differ by 0.4 of the contrast between axis and corner
  EXPECT_LT(difference(scan, true_).second, 0.04);
}

/// Diffusion and the median filter reduce noise and keep the position of an edge.
TEST(CtSmoothing, TakesNoiseAndLeavesEdges) {
  const Image<float> clean = scan_of({40, 40, 40}, {block({-9, -9, -9}, {19.5, 60, 60})});
  Image<float> scan = clean;
  add_noise(scan, 0.15);
  Image<float> smooth = scan;
  ct::diffuse(smooth, 0.3 * contrast, 6);
  EXPECT_LT(difference(smooth, clean).second, 0.3 * difference(scan, clean).second);
  Image<float> edge = clean;
  ct::diffuse(edge, 0.3 * contrast, 6);
  // The edge stays half-way between the same two voxels.
  EXPECT_GT(edge.at(19, 20, 20), mastic + 0.5f * contrast);
  EXPECT_LT(edge.at(20, 20, 20), mastic + 0.5f * contrast);
  Image<float> middle = scan;
  ct::median(middle);
  EXPECT_LT(difference(middle, clean).second, 0.5 * difference(scan, clean).second);
}

TEST(CtLevels, AreThoseOfThePhasesWithOrWithoutAir) {
  Image<float> scan = many_balls(80);
  add_noise(scan, 0.15);
  const Image<std::uint8_t> all = Image<std::uint8_t>::like(scan, 1);
  const GreyLevels levels = ct::fit_levels(ct::histogram_of(scan, all));
  ASSERT_TRUE(levels.has_air);
  EXPECT_NEAR(levels.air, air, 0.05 * contrast);
  EXPECT_NEAR(levels.mastic, mastic, 0.02 * contrast);
  EXPECT_NEAR(levels.aggregate, aggregate, 0.02 * contrast);
  EXPECT_NEAR(levels.deviation, 0.15 * contrast, 0.02 * contrast);
}

/// With very little noise, the fitted deviation consists of the noise and of the width of a bin.
TEST(CtLevels, OfHardlyAnyNoiseHaveItsDeviation) {
  ct::Histogram histogram;  // bins of width 1, starting at 0
  histogram.counts.assign(512, 0);
  const auto below = [](double x) { return 0.5 * std::erfc(-x / 1.5 / std::sqrt(2.0)); };
  for (const auto& [level, voxels] : {std::pair{60, 1e5}, {260, 6e5}, {420, 3e5}})
    for (int b = 0; b < 512; ++b)
      histogram.counts[static_cast<std::size_t>(b)] += std::lround(voxels * (below(b + 1 - level) - below(b - level)));
  const GreyLevels levels = ct::fit_levels(histogram);
  ASSERT_TRUE(levels.has_air);
  EXPECT_NEAR(levels.mastic, 260, 0.01);
  EXPECT_NEAR(levels.aggregate, 420, 0.01);
  // the width of a bin adds its own variance of 1/12
  EXPECT_NEAR(levels.deviation, std::sqrt(1.5 * 1.5 + 1 / 12.0), 0.01);
}

}  // namespace
}  // namespace macadam
