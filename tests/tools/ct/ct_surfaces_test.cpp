// SPDX-License-Identifier: GPL-3.0-or-later
// Tests isosurfaces of scalar fields, and surfaces of grains in a scan.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/tools/ct/grains/grain_surfaces.hpp"
#include "host/tools/ct/grains/isosurface.hpp"
#include "tests/tools/ct/ct_scans.hpp"
#include "tests/support/shape_tests.hpp"

namespace macadam {
namespace {

using namespace ct_scans;
constexpr double pi = std::numbers::pi;

/// Returns half the depth below the surface of a ball of radius 12 voxels, in voxels, limited to ±½.
Image<float> field_of_a_ball(const Vec3d& spacing) {
  Image<float> field({30, 30, 30}, spacing);
  const Body body = ball(14.3, 14.6, 14.1, 12);
  for (std::int64_t k = 0; k < 30; ++k)
    for (std::int64_t j = 0; j < 30; ++j)
      for (std::int64_t i = 0; i < 30; ++i) {
        field.at(i, j, k) = static_cast<float>(
            std::clamp(0.5 * body(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)), -0.5, 0.5));
      }
  return field;
}

TEST(CtIsosurface, OfABallHasItsVolumeAndItsArea) {
  const Surface fine = ct::isosurface(field_of_a_ball({voxel, voxel, voxel}));
  EXPECT_TRUE(check_surface(fine).good()) << check_surface(fine).text();
  const ShapeMeasure m = measure_shape(fine);
  const double r = 12 * voxel;
  // The facets of a ball of radius 12 voxels lie inside of the ball, which reduces the area by the fraction of about
  // (1/12)²/10. A surface along the faces of voxels would be far worse, with an error of 7 %.
  EXPECT_NEAR(m.area / (4 * pi * r * r), 1, 0.01);
  EXPECT_NEAR(m.volume / (4 * pi / 3 * r * r * r), 1, 0.01);
  const ct::Simplified fewer = ct::simplified(fine, 400, 800, 0.5 * voxel);
  EXPECT_LE(fewer.surface.facets.size(), 400u);
  EXPECT_LE(fewer.error, 0.5 * voxel);
  EXPECT_TRUE(check_surface(fewer.surface).good()) << check_surface(fewer.surface).text();
  EXPECT_NEAR(measure_shape(fewer.surface).volume / m.volume, 1, 0.005);
}

/// Non-cubic voxels stretch the surface along the axes accordingly.
TEST(CtIsosurface, HasTheEdgesOfVoxelsThatAreNoCubes) {
  const Surface surface = ct::isosurface(field_of_a_ball({voxel, 1.5 * voxel, 2 * voxel}));
  EXPECT_TRUE(check_surface(surface).good()) << check_surface(surface).text();
  Vec3d low = surface.points.front(), high = low;
  for (const Vec3d& p : surface.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  // The surface is straight between nodes, so at each end of the ball the surface is too deep by at most 1/(8·12) of a
  // voxel. Both ends together make this 0.001 of the diameter, which is 24 voxels.
  const Vec3d edge = (1 / (24 * voxel)) * (high - low);
  EXPECT_NEAR(edge.x, 1, 0.002);
  EXPECT_NEAR(edge.y, 1.5, 0.003);
  EXPECT_NEAR(edge.z, 2, 0.004);
  EXPECT_NEAR(measure_shape(surface).volume / (4 * pi / 3 * std::pow(12 * voxel, 3) * 3), 1, 0.01);
}

TEST(CtIsosurface, OfAFieldThatIsPositiveEverywhereIsClosedAtItsEnds) {
  Image<float> field({5, 6, 7}, {voxel, voxel, voxel}, {}, 0.5f);
  ct::close_ends(field);
  EXPECT_EQ(std::count(field.voxels.begin(), field.voxels.end(), 0.5f), 3 * 4 * 5);  // all except the outermost nodes
  const Surface surface = ct::isosurface(field);
  EXPECT_TRUE(check_surface(surface).good()) << check_surface(surface).text();
}

TEST(CtGrainSurfaces, OfTwoGrainsMeetAtTheCutBetweenThem) {
  // Aggregate extends from x = 4 to 39 and is cut between 19 and 20. Only the labels separate the two grains.
  Segmentation scan;
  scan.phases = Image<std::uint8_t>({44, 24, 24}, {voxel, voxel, voxel}, {}, std::uint8_t(VoxelPhase::mastic));
  scan.confidence = Image<std::uint8_t>::like(scan.phases, 255);
  scan.labels = Image<std::uint32_t>::like(scan.phases);
  scan.grey = Image<float>::like(scan.phases, mastic);
  scan.levels = {air, mastic, aggregate, 0, true};
  for (std::int64_t k = 4; k < 20; ++k)
    for (std::int64_t j = 4; j < 20; ++j)
      for (std::int64_t i = 4; i < 40; ++i) {
        scan.phases.at(i, j, k) = std::uint8_t(VoxelPhase::aggregate);
        scan.labels.at(i, j, k) = i < 20 ? 1 : 2;
        scan.grey.at(i, j, k) = aggregate;
      }
  std::vector<std::string> warnings;
  const auto grains =
      ct::surfaces_of(scan, {0.5 * (air + mastic), mastic + contrast / 2},
                      ct::boxes_of(scan.labels, scan.phases, scan.confidence), options_of(16), warnings);
  ASSERT_EQ(grains.size(), 2u);
  for (const double x : {19.4, 19.6}) {
    const Vec3d beside{x * voxel, 11.4 * voxel, 11.7 * voxel};
    EXPECT_NEAR(test::winding(grains[0].surface, beside), x < 19.5 ? 1 : 0, 1e-6);
    EXPECT_NEAR(test::winding(grains[1].surface, beside), x < 19.5 ? 0 : 1, 1e-6);
  }
}

}  // namespace
}  // namespace macadam
