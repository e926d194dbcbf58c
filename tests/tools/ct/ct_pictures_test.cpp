// SPDX-License-Identifier: GPL-3.0-or-later
// Tests pictures of a segmented scan: they are valid PNG files, and their pixels show the scan.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "host/tools/ct/segment/overlay.hpp"
#include "tests/tools/ct/ct_scans.hpp"
#include "tests/support/png_picture.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam {
namespace {

using namespace ct_scans;
class CtPictures : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      ("ct_" + std::to_string(getpid()) + "_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".png");
};

TEST_F(CtPictures, AreWritten) {
  const Segmentation found = segment_scan(many_balls(48), options_of(14));
  for (const auto write : {ct::write_view, ct::write_overlay}) {
    write(file_, found);
    std::ifstream in(file_, std::ios::binary);
    std::string begin(8, '\0');
    in.read(begin.data(), 8);
    EXPECT_EQ(begin, "\x89PNG\r\n\x1a\n");
    std::filesystem::remove(file_);
  }
}

TEST_F(CtPictures, ThreePlanesLieSideBySideWithNothingBetweenThem) {
  Segmentation scan;
  scan.phases = Image<std::uint8_t>({6, 5, 4}, {voxel, voxel, voxel}, {}, std::uint8_t(VoxelPhase::mastic));
  scan.labels = Image<std::uint32_t>::like(scan.phases);
  scan.grey = Image<float>::like(scan.phases, mastic);
  scan.levels = {air, mastic, aggregate, 0, true};
  scan.labels.at(1, 2, 2) = 1;  // lies in the planes z = 2 and y = 2, not in x = 3
  ct::write_overlay(file_, scan);
  const test::PngPicture picture = test::read_png(file_);
  constexpr std::size_t edge = 8, gap = 16;  // pixels per voxel in a small scan, and pixels between planes
  constexpr std::size_t second = 6 * edge + gap, third = 2 * second;
  ASSERT_EQ(picture.width, third + 5 * edge);
  ASSERT_EQ(picture.height, 5 * edge + 2 * gap + 14);
  for (std::size_t y = 0; y < 5 * edge; ++y) {
    for (std::size_t x = 0; x < picture.width; ++x) {
      const auto& [red, green, blue] = picture.at(x, y);
      const bool plane = x < 6 * edge || (y < 4 * edge && ((x >= second && x < second + 6 * edge) || x >= third));
      // In a picture of a plane section the vertical axis (y or z) points upwards, which decides where the grain
      // appears.
      const bool grain = (x / edge == 1 && y / edge == 2) || (x >= second && (x - second) / edge == 1 && y / edge == 1);
      EXPECT_EQ(red == green && green == blue, !grain) << x << ' ' << y;
      EXPECT_EQ(red == 255 && green == 255 && blue == 255, !plane) << x << ' ' << y;
    }
  }
}

TEST_F(CtPictures, VoxelsHaveTheirEdgesAndTheScaleItsLength) {
  Segmentation scan;  // a scan of 20 × 10 × 15 mm
  scan.phases = Image<std::uint8_t>({80, 40, 30}, {0.25e-3, 0.25e-3, 0.5e-3}, {}, std::uint8_t(VoxelPhase::mastic));
  scan.labels = Image<std::uint32_t>::like(scan.phases);
  scan.grey = Image<float>::like(scan.phases, mastic);
  scan.levels = {air, mastic, aggregate, 0, true};
  ct::write_overlay(file_, scan);
  const test::PngPicture picture = test::read_png(file_);
  // 50 mm in voxels of 0.25 mm are 200 pixels; six pixels per voxel make 1200.
  constexpr std::size_t gap = 16, mm = 24;
  ASSERT_EQ(picture.width, 50 * mm + 2 * gap);
  ASSERT_EQ(picture.height, 15 * mm + 2 * gap + 14);
  const auto is_black = [&](std::size_t x, std::size_t y) { return picture.at(x, y)[0] == 0; };
  EXPECT_EQ(picture.at(20 * mm + gap, 15 * mm - 1)[0] == 255, false) << "30 voxels of twice the height";
  std::size_t longest = 0;  // longest row of black pixels below the planes, which is the scale bar
  for (std::size_t y = 15 * mm; y < picture.height; ++y) {
    for (std::size_t x = 0, row = 0; x < picture.width; ++x) {
      row = is_black(x, y) ? row + 1 : 0;
      longest = std::max(longest, row);
    }
  }
  EXPECT_EQ(longest, 5 * mm) << "5 mm is the round length below 0.4 of 20 mm";
}

/// In the three-dimensional view a grain in front hides the grains behind it.
TEST_F(CtPictures, TheNearerGrainHidesWhatIsBehindIt) {
  Segmentation scan;
  scan.labels = Image<std::uint32_t>({40, 40, 40}, {voxel, voxel, voxel});
  // The view is from the front left, 30° above the horizontal. From there, balls 1 and 2 lie behind the middle of the
  // scan, and ball 3 appears above the middle.
  const Vec3d eye{-std::sqrt(3.0) / 4, -0.75, 0.5};
  const auto add_ball = [&](std::uint32_t id, double sieve, const Vec3d& place, double radius) {
    ScannedGrain grain;
    grain.id = id;
    grain.sieve = sieve;
    grain.surface = test::mapped(test::icosphere(3), [&](const Vec3d& p) {
      return voxel * (Vec3d{19.5, 19.5, 19.5} + place + radius * p);
    });
    scan.grains.push_back(std::move(grain));
  };
  add_ball(1, 40e-3, -14.0 * eye, 3), add_ball(2, 2.4e-3, -20.0 * eye, 5), add_ball(3, 3e-3, {0, 0, 12}, 3);
  ct::write_view(file_, scan);
  const test::PngPicture picture = test::read_png(file_);
  ASSERT_EQ(picture.width, picture.height);
  const double middle = static_cast<double>(picture.width) / 2;
  // The colours of the size classes of balls 1, 2 and 3 are bluish, greenish and reddish. In full shade they cannot be
  // distinguished.
  enum { red, green, blue, white, dark };
  struct Pixel {
    double from_middle;
    int colour;
  };
  std::vector<Pixel> pixels;
  double farthest[5] = {}, reds = 0, red_x = 0, red_y = 0;
  for (std::size_t y = 0; y < picture.height; ++y) {
    for (std::size_t x = 0; x < picture.width; ++x) {
      const auto& rgb = picture.at(x, y);
      const auto most = std::max_element(rgb.begin(), rgb.end());
      const bool same = rgb[0] == rgb[1] && rgb[1] == rgb[2];
      const int colour = !same ? static_cast<int>(most - rgb.begin()) : rgb[0] == 255 ? white : dark;
      const double right = static_cast<double>(x) - middle, down = static_cast<double>(y) - middle;
      if (colour == red) ++reds, red_x += right, red_y += down;
      pixels.push_back({std::hypot(right, down), colour});
      farthest[colour] = std::max(farthest[colour], pixels.back().from_middle);
    }
  }
  EXPECT_NEAR(farthest[blue] / farthest[green], 3.0 / 5, 0.03);  // whole pixels, of about 37 and 62
  // number of pixels in a ring around the middle that have neither this colour nor full shade
  const auto other = [&](int colour, double from, double to) {
    return std::count_if(pixels.begin(), pixels.end(), [&](const Pixel& p) {
      return p.from_middle > from && p.from_middle < to && p.colour != colour && p.colour != dark;
    });
  };
  EXPECT_EQ(other(blue, -1, farthest[blue] - 2), 0);
  EXPECT_EQ(other(green, farthest[blue] + 2, farthest[green] - 2), 0);
  ASSERT_GT(reds, 0);
  EXPECT_NEAR(red_x / reds, 0, 2);
  EXPECT_LT(red_y / reds, -farthest[green]);
}

}  // namespace
}  // namespace macadam
