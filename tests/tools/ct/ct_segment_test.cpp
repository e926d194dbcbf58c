// SPDX-License-Identifier: GPL-3.0-or-later
// Finds grains and phases of small scans whose contents are known exactly, and refuses images that are not scans.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/tools/ct/grains/fragments.hpp"
#include "host/tools/ct/grains/grains.hpp"
#include "host/tools/ct/grains/labels.hpp"
#include "host/tools/ct/grains/paper_recipe.hpp"
#include "host/tools/ct/voxels/region.hpp"
#include "host/tools/ct/segment/segment_files.hpp"
#include "macadam/error.hpp"
#include "tests/tools/ct/ct_scans.hpp"

namespace macadam {
namespace {

using namespace ct_scans;
constexpr double pi = std::numbers::pi;

bool by_volume(const ScannedGrain& a, const ScannedGrain& b) { return a.measure.volume < b.measure.volume; }

std::string fault(const Image<float>& scan, const SegmentOptions& options) {
  try {
    segment_scan(scan, options);
  } catch (const InputError& error) { return error.what(); }
  return "segmented";
}

/// Two maxima of the distance to the surface are one fragment if the saddle between them is less than half a voxel
/// lower.
TEST(CtFragments, BasinsLessThanHalfAVoxelDeepAreOne) {
  const auto fragments = [](double saddle) {  // two maxima 3 voxels from the surface, with a saddle between them
    Image<float> distance({3, 1, 1}, {voxel, voxel, voxel}, {}, static_cast<float>(3 * voxel));
    distance.voxels[1] = static_cast<float>(saddle * voxel);
    return ct::flood(distance, Image<float>::like(distance, 1), 1).radius.size() - 1;
  };
  EXPECT_EQ(fragments(2.6), 1u);
  EXPECT_EQ(fragments(2.4), 2u);
}

TEST(CtFragments, ABasinHasItsHighestDistance) {
  Image<float> distance({3, 1, 1}, {voxel, voxel, voxel});
  const double depth[] = {4.97, 5, 4.98};  // in voxels; the differences are less than the step of 3/64
  for (std::size_t n = 0; n < 3; ++n) distance.voxels[n] = static_cast<float>(depth[n] * voxel);
  const Image<float> grey = Image<float>::like(distance, 1);
  const ct::Fragments found = ct::flood(distance, grey, 1);
  ASSERT_EQ(found.radius.size(), 2u);
  EXPECT_EQ(found.radius[1], static_cast<double>(distance.voxels[1]));
  EXPECT_EQ(ct::flood(Image<float>::like(distance), grey, 1).radius.size(), 1u) << "nothing lies inside";
}

// The two voxels are neighbours in memory but lie at opposite ends of the scan, so a label must not spread from one to
// the other.
TEST(CtLabels, DoNotSpreadFromOneEndOfTheScanToTheOther) {
  using Place = std::array<std::int64_t, 3>;
  const auto spread = [](const Place& from, const Place& to) {
    Image<std::uint8_t> phases({3, 3, 3}, {voxel, voxel, voxel}, {}, std::uint8_t(VoxelPhase::mastic));
    Image<std::uint32_t> coarse = Image<std::uint32_t>::like(phases);
    for (const Place& p : {from, to}) phases.at(p[0], p[1], p[2]) = std::uint8_t(VoxelPhase::aggregate);
    coarse.at(from[0], from[1], from[2]) = 5;
    return ct::spread(phases, coarse, 1).at(to[0], to[1], to[2]);
  };
  EXPECT_EQ(spread({1, 1, 1}, {1, 2, 1}), 5u);
  for (const auto& [a, b] : {std::pair<Place, Place>{{2, 0, 0}, {0, 1, 0}}, {{1, 2, 0}, {1, 0, 1}}}) {
    EXPECT_EQ(spread(a, b), 0u);
    EXPECT_EQ(spread(b, a), 0u);
  }
}

TEST(CtSegment, ABallAndABlockAreMeasured) {
  Image<float> scan = scan_of({90, 60, 60}, {ball(20, 25, 24, 12), block({45, 10, 12}, {75, 34, 40})},
                              {ball(15, 50, 50, 6), ball(80, 50, 50, 6)});
  add_noise(scan, 0.05);
  Segmentation out = segment_scan(scan, options_of(20));
  std::sort(out.grains.begin(), out.grains.end(), by_volume);
  ASSERT_EQ(out.grains.size(), 2u);
  const double r = 12 * voxel;
  // The tolerance allows for the resolution of a ball with a radius of 12 voxels.
  EXPECT_NEAR(out.grains[0].measure.area / (4 * pi * r * r), 1, 0.02);
  EXPECT_NEAR(out.grains[0].measure.volume / (4 * pi / 3 * r * r * r), 1, 0.02);
  const ShapeMeasure& block = out.grains[1].measure;
  // Blur rounds the edges and corners of the block by about a voxel; its sides are 24 to 30 voxels.
  EXPECT_NEAR(block.volume / (30 * 24 * 28 * std::pow(voxel, 3)), 1, 0.03);
  EXPECT_NEAR(block.area / (2 * (30 * 24 + 24 * 28 + 28 * 30) * voxel * voxel), 1, 0.05);
  EXPECT_FALSE(out.grains[0].border);
  EXPECT_GT(out.grains[0].confidence, 0.9);
  EXPECT_LE(out.grains[1].surface.facets.size(), 800u);
}

/// Two balls that touch are separated, and a long grain is not cut. The user can remove the cut by editing the table of
/// cuts, but every row of the table must match the scan.
TEST(CtSegment, TouchingBallsArePartedAndALongGrainIsNot) {
  const Body stone = [](double x, double y, double z) {  // an ellipsoid of half axes 24, 10, 9
    return 9 * (1 - std::sqrt((x - 40) * (x - 40) / 576 + (y - 55) * (y - 55) / 100 + (z - 25) * (z - 25) / 81));
  };
  Image<float> scan = scan_of({80, 75, 50}, {ball(20, 20, 25, 12), ball(43, 20, 25, 12), stone}, {ball(70, 10, 10, 5)});
  add_noise(scan, 0.1);
  Segmentation out = segment_scan(scan, options_of(18));
  std::sort(out.grains.begin(), out.grains.end(), by_volume);
  ASSERT_EQ(out.grains.size(), 3u);
  const double ball_volume = 4 * pi / 3 * std::pow(12 * voxel, 3);
  EXPECT_NEAR(out.grains[0].measure.volume / ball_volume, 1, 0.03);
  EXPECT_NEAR(out.grains[1].measure.volume / ball_volume, 1, 0.03);
  EXPECT_NEAR(out.grains[2].measure.volume / (4 * pi / 3 * 24 * 10 * 9 * std::pow(voxel, 3)), 1, 0.05);
  const auto cuts = std::count_if(out.cuts.begin(), out.cuts.end(), [](const GrainCut& c) { return c.cut; });
  EXPECT_EQ(cuts, 1);

  // A user joins the two balls by setting `cut` to false in all cuts; nothing else changes.
  SegmentOptions by_hand = options_of(18);
  by_hand.cuts = out.cuts;
  for (GrainCut& cut : *by_hand.cuts) cut.cut = false;
  const Segmentation joined = segment_scan(scan, by_hand);
  EXPECT_EQ(joined.grains.size(), 2u);
  by_hand.cuts->push_back({});
  EXPECT_NE(fault(scan, by_hand).find("rows"), std::string::npos);
  by_hand.cuts = out.cuts;
  by_hand.cuts->front().place.x += 10 * voxel;
  EXPECT_NE(fault(scan, by_hand).find("another scan"), std::string::npos);
}

TEST(CtSegment, AnEdgeAlongTheSideOfAnotherGrainStaysWithItsOwn) {
  // A stone with a thin plate lies on a block. The plate is nearer to the middle of the block than to the middle of the
  // stone to which it belongs.
  const Body stone = ball(20, 32, 46, 15), plate = block({20, 22, 40.6}, {66, 42, 47}),
             below = block({26, 8, 10}, {74, 56, 40});
  const auto together = [&](double x, double y, double z) { return std::max(stone(x, y, z), plate(x, y, z)); };
  Image<float> scan = scan_of({84, 64, 70}, {together, below}, {ball(74, 10, 60, 6)});
  add_noise(scan, 0.05);
  SegmentOptions options = options_of(24);
  options.surfaces = false;
  const Segmentation out = segment_scan(scan, options);
  const std::uint32_t upper = out.labels.at(20, 32, 50), lower = out.labels.at(50, 32, 25);
  EXPECT_NE(upper, 0u);
  EXPECT_NE(lower, 0u);
  EXPECT_NE(upper, lower);
  std::int64_t voxels = 0, right = 0;
  for (std::int64_t k = 42; k < 46; ++k)
    for (std::int64_t j = 24; j < 40; ++j)
      for (std::int64_t i = 36; i < 64; ++i) ++voxels, right += out.labels.at(i, j, k) == upper;
  EXPECT_GT(static_cast<double>(right) / static_cast<double>(voxels), 0.9);
}

// At certain values of neck, solidity and valley, cutting and not cutting are equally likely, and the margin is 0. If
// the neck is narrower by 0.1, the margin is positive.
TEST(CtSegment, AMarginIsTheSurenessOfACut) {
  EXPECT_NEAR(ct::margin_of(0.8, 0.93, 0.85), 0, 1e-12);
  EXPECT_NEAR(ct::margin_of(0.7, 0.93, 0.85), std::tanh(0.5 * 0.4), 1e-12);
}

TEST(CtSegment, ThreadsDoNotChangeTheAnswer) {
  Image<float> scan = many_balls(60);
  add_noise(scan, 0.15);
  const SegmentOptions options = options_of(14);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Segmentation one = segment_scan(scan, options);
  omp_set_num_threads(3);
  const Segmentation three = segment_scan(scan, options);
  omp_set_num_threads(threads);
  EXPECT_EQ(one.labels.voxels, three.labels.voxels);
  EXPECT_EQ(one.phases.voxels, three.phases.voxels);
  EXPECT_EQ(ct::grains_csv(one.grains), ct::grains_csv(three.grains));
}

/// The fractions of the phases are found within 0.3 percentage points. If the laboratory's fractions are given, the
/// thresholds are set so that the scan has these fractions.
TEST(CtSegment, SharesOfThePhasesAreRightAndThoseOfTheLaboratoryAreKept) {
  const Image<float> clean = many_balls(66);
  double true_air = 0;
  for (const float grey : clean.voxels) true_air += std::clamp((mastic - grey) / (mastic - air), 0.0f, 1.0f);
  true_air /= static_cast<double>(clean.count());
  Image<float> scan = clean;
  add_noise(scan, 0.2);
  SegmentOptions options = options_of(14);
  options.surfaces = false;
  const Segmentation free = segment_scan(scan, options);
  EXPECT_NEAR(free.air_voids, true_air, 0.003);  // tolerance of 0.3 percentage points
  double confidence = 0;
  for (const std::uint8_t c : free.confidence.voxels) confidence += c / 255.0;
  // every voxel of the scan belongs to the specimen, so the mean is over all voxels
  EXPECT_NEAR(free.confidence_mean, confidence / static_cast<double>(clean.count()), 1e-12);
  options.aggregate = free.aggregate + 0.01;
  EXPECT_NEAR(segment_scan(scan, options).aggregate, free.aggregate + 0.01, 0.003);
  options.aggregate = 0.9;  // a fraction that contradicts the scan
  EXPECT_FALSE(segment_scan(scan, options).warnings.empty());
}

TEST(CtSegment, ASpecimenInAirIsFound) {
  Image<float> scan = many_balls(66);
  for (std::int64_t k = 0; k < 66; ++k)
    for (std::int64_t j = 0; j < 66; ++j)
      for (std::int64_t i = 0; i < 66; ++i) {
        const bool around =
            std::hypot(static_cast<double>(i) - 33, static_cast<double>(j) - 33) > 30 || k < 4 || k > 60;
        if (around) scan.at(i, j, k) = air;
      }
  add_noise(scan, 0.05);
  SegmentOptions options = options_of(14);
  options.region = ScanRegion::found;
  options.surfaces = false;
  const Segmentation out = segment_scan(scan, options);
  const auto inside = static_cast<double>(
      std::count_if(out.phases.voxels.begin(), out.phases.voxels.end(), [](std::uint8_t p) { return p != 255; }));
  // An error of half a voxel in the radius would change the volume by 3 %. The region must be more accurate than that.
  EXPECT_NEAR(inside / (pi * 30 * 30 * 57), 1, 0.02);
}

/// A prism at the side of the scan is found. The region must end where the prism ends, not where the scan ends.
TEST(CtRegion, OfAPrismAtTheSideOfTheScanEndsWhereThePrismDoes) {
  Image<float> scan({30, 28, 10}, {voxel, voxel, voxel}, {}, air);
  for (std::int64_t k = 0; k < 10; ++k)
    for (std::int64_t j = 5; j < 25; ++j)
      for (std::int64_t i = 0; i < 20; ++i) scan.at(i, j, k) = mastic;
  for (const ScanRegion kind : {ScanRegion::prism, ScanRegion::found}) {
    const Image<std::uint8_t> region = ct::find_region(scan, kind);
    for (std::size_t n = 0; n < scan.count(); ++n) ASSERT_EQ(region.voxels[n], scan.voxels[n] == mastic) << n;
  }
}

TEST(CtRegion, OfASpecimenThatIsNeitherPrismNorCylinderIsItsOutline) {
  Image<float> scan({30, 28, 10}, {voxel, voxel, voxel}, {}, air);
  for (std::int64_t k = 0; k < 10; ++k)
    for (std::int64_t j = 3; j < 25; ++j)
      for (std::int64_t i = 4; i < (j < 11 ? 26 : 12); ++i) scan.at(i, j, k) = mastic;  // an L
  const Image<std::uint8_t> region = ct::find_region(scan, ScanRegion::found);
  for (std::size_t n = 0; n < scan.count(); ++n) ASSERT_EQ(region.voxels[n], scan.voxels[n] == mastic) << n;
}

TEST(CtSegment, WhatIsNoScanIsRefused) {
  const SegmentOptions options = options_of(14);
  EXPECT_NE(fault(Image<float>({40, 40, 40}, {voxel, voxel, voxel}, {}, 7), options).find("everywhere"),
            std::string::npos);
  Image<float> noise({48, 48, 48}, {voxel, voxel, voxel}, {}, 20000);
  add_noise(noise, 0.3);
  EXPECT_NE(fault(noise, options).find("contrast"), std::string::npos);
  Image<float> faint = many_balls(60);  // the little contrast of limestone in mastic with limestone filler
  for (float& grey : faint.voxels) grey = std::min(grey, mastic + 0.02f * (grey - mastic));
  add_noise(faint, 0.1);
  EXPECT_NE(fault(faint, options).find("phase is missing"), std::string::npos);
  Image<float> coarse = many_balls(60);
  coarse.spacing = {1e-3, 1e-3, 1e-3};  // voxel sizes ten times too large
  EXPECT_NE(fault(coarse, options).find("edge of a voxel"), std::string::npos);
  EXPECT_NE(fault(Image<float>({0, 0, 0}, {voxel, voxel, voxel}), options).find("voxels"), std::string::npos);
}

TEST(CtSegment, ADoubtfulScanIsSegmentedWithAWarning) {
  Image<float> clipped = many_balls(60);
  for (float& grey : clipped.voxels) grey = std::min(grey, 30000.0f);
  SegmentOptions options = options_of(14);
  options.surfaces = false;
  const Segmentation out = segment_scan(clipped, options);
  ASSERT_FALSE(out.warnings.empty());
  EXPECT_NE(out.warnings.front().find("clipped"), std::string::npos);
  const Image<float> dense = scan_of({60, 60, 60}, {ball(30, 30, 30, 14)});  // a scan without voids
  const Segmentation no_air = segment_scan(dense, options);
  EXPECT_FALSE(no_air.levels.has_air);
  EXPECT_EQ(no_air.air_voids, 0);
}

TEST(CtSegment, ThePapersStepsPartBallsToo) {
  Image<float> scan = many_balls(66);
  add_noise(scan, 0.05);
  SegmentOptions options = options_of(14);
  options.recipe = SegmentRecipe::paper;
  const Segmentation out = segment_scan(scan, options);
  EXPECT_GE(out.grains.size(), 27u);
  for (const ScannedGrain& grain : out.grains) EXPECT_TRUE(check_surface(grain.surface).good());
  options.cuts = std::vector<GrainCut>{};
  EXPECT_NE(fault(scan, options).find("recipe"), std::string::npos);
}

TEST(CtSegment, ThePapersStepsShiftSlicesToTheMeanOfTheScan) {
  Image<float> scan({5, 5, 2}, {voxel, voxel, voxel}, {}, 10);
  std::fill(scan.voxels.begin() + 25, scan.voxels.end(), 30.0f);
  Image<std::uint8_t> region = Image<std::uint8_t>::like(scan, 1);
  region.at(0, 0, 1) = 0, scan.at(0, 0, 1) = 5;  // outside of the region: is not counted and stays unchanged
  ct::equalise(scan, region);
  for (std::size_t n = 0; n < 50; ++n) EXPECT_NEAR(scan.voxels[n], n == 25 ? 5 : (25 * 10 + 24 * 30) / 49.0, 1e-5) << n;
}

TEST(CtSegment, ThePapersStepsFillHolesInGrainsAndNoOthers) {
  SegmentOptions options = options_of(14);
  options.recipe = SegmentRecipe::paper;
  options.surfaces = false;
  const Segmentation out =
      segment_scan(scan_of({44, 44, 44}, {ball(24, 24, 24, 15)}, {ball(24, 24, 24, 6), ball(6, 6, 6, 5)}), options);
  EXPECT_EQ(out.phases.at(24, 24, 24), std::uint8_t(VoxelPhase::aggregate));
  EXPECT_EQ(out.phases.at(6, 6, 6), std::uint8_t(VoxelPhase::air_void));
}

TEST(CtSieve, OfABlockAndABall) {
  const Surface ball = subdivided_icosahedron(0.005);
  EXPECT_LT(square_sieve(ball), 0.01);
  EXPECT_GT(square_sieve(ball), 0.0094);  // diameter of the sphere inscribed in its 80 facets
  Surface block{"block", {}, {}};
  for (int c = 0; c < 8; ++c) block.points.push_back({0.010 * (c & 1), 0.006 * (c >> 1 & 1), 0.004 * (c >> 2 & 1)});
  block.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  EXPECT_NEAR(square_sieve(block), 0.006, 6e-5);  // it passes the sieve with its long axis through the opening
}

}  // namespace
}  // namespace macadam
