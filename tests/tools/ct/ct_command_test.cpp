// SPDX-License-Identifier: GPL-3.0-or-later
// Runs `macadam ct segment` as a user does: regions by coordinates, units, warnings, and the source of the voxel size.
#include <fstream>
#include <sstream>

#include "tests/tools/ct/ct_scans.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using namespace ct_scans;
using CtCommand = Program;

/// Returns a scan of two balls of radius 12 voxels, with centres (20, 20, 20) and (50, 20, 20), in 70 × 40 × 40 voxels
/// of 0.1 mm.
Image<float> two_balls() {
  Image<float> scan = scan_of({70, 40, 40}, {ball(20, 20, 20, 12), ball(50, 20, 20, 12)}, {ball(35, 34, 34, 4)});
  add_noise(scan, 0.05);
  return scan;
}

/// Returns the number of rows of a CSV file without its header.
std::size_t rows(const std::string& file) {
  std::ifstream in(file);
  std::size_t n = 0;
  for (std::string line; std::getline(in, line);) ++n;
  return n - 1;
}

/// Only grains inside the given prism or cylinder are found, and voxels outside of it are marked 255.
TEST_F(CtCommand, ARegionByCoordinatesHoldsWhatLiesInIt) {
  write_image(folder_ / "scan.mha", two_balls(), false);
  const std::string segment = "ct segment " + path("scan.mha") + " --smallest '1.8 mm' --out " + path("out");
  const auto grains = [&](const std::string& region) {
    const Outcome outcome = macadam(segment + " --region '" + region + "'");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return rows((folder_ / "out/grains.csv").string());
  };
  EXPECT_EQ(grains("whole"), 2u);
  EXPECT_EQ(grains("prism:0,0,0,3.5 mm,4 mm,4 mm"), 1u);
  EXPECT_EQ(grains("cylinder:5 mm, 2 mm, 3 mm"), 1u);
  const Image<std::uint8_t> phases = read_image<std::uint8_t>(folder_ / "out/phases.mha");
  const auto inside =
      std::count_if(phases.voxels.begin(), phases.voxels.end(), [](std::uint8_t p) { return p != 255; });
  // the number of pixels with centres in a circle of radius 15 equals its area within a hundredth
  EXPECT_NEAR(static_cast<double>(inside) / 40 / (3.14159 * 15 * 15), 1, 0.01);
  EXPECT_EQ(grains("cylinder:5 mm,2 mm,3 mm,0.5 mm,3.5 mm"), 1u);
  const Image<std::uint8_t> cut = read_image<std::uint8_t>(folder_ / "out/phases.mha");
  EXPECT_EQ(cut.at(50, 20, 4), 255);
  EXPECT_NE(cut.at(50, 20, 5), 255);
  for (const auto& [region, message] :
       std::map<std::string, std::string>{{"cube", "cylinder:x,y,diameter"},
                                          {"cylinder:1 mm,2 mm", "three or five"},
                                          {"cylinder:1 mm,2 mm,3 kg", "3 kg"},
                                          {"cylinder:1 mm,2 mm,0", "a region with a width"},
                                          {"prism:0,0,0,1 mm,1 mm", "six lengths"},
                                          {"prism:1 mm,0,0,0,1 mm,1 mm", "a region with a width"},
                                          {"prism:1,1,1,2,2,2", "voxels within the region"}}) {
    const Outcome outcome = macadam(segment + " --region '" + region + "'");
    EXPECT_EQ(outcome.code, 2) << region;
    EXPECT_TRUE(contains(outcome.err, message)) << region << ": " << outcome.err;
  }
}

TEST_F(CtCommand, FractionsAreNumbersOrPerCent) {
  write_image(folder_ / "scan.mha", two_balls(), false);
  const std::string segment =
      "ct segment " + path("scan.mha") + " --smallest '1.8 mm' --region whole --out " + path("out");
  const Outcome number = macadam(segment + " --aggregate 0.125 --air-voids 0.0025");
  const Outcome per_cent = macadam(segment + " --aggregate '12.5 %' --air-voids '0.25%'");
  EXPECT_EQ(per_cent.code, 0) << per_cent.err;
  EXPECT_EQ(per_cent.out, number.out);
  for (const std::string wrong : {"60 %", "4", "%", "4 mm", "nan", "-1 %"}) {
    const Outcome refused = macadam(segment + " --air-voids='" + wrong + "'");
    EXPECT_EQ(refused.code, 2) << wrong;
    EXPECT_HAS(refused.err, "--air-voids: found \"" + wrong + "\", expected a number from 0 to 0.5, or 0 % to 50 %");
  }
}

/// Aggregate in pieces that are too small to be grains is printed as a fraction and warned of.
TEST_F(CtCommand, AggregateInNoGrainIsPrintedAndWarnedOf) {
  // The scan has a ball with a radius of 12 voxels (2.4 mm in diameter) and eight balls with a radius of 5 voxels (1
  // mm).
  std::vector<Body> balls{ball(20, 20, 20, 12)};
  for (int n = 0; n < 8; ++n) balls.push_back(ball(44 + 14 * (n % 4), 12 + 16 * (n / 4), 20, 5));
  Image<float> scan = scan_of({100, 40, 40}, balls, {ball(70, 34, 34, 4)});
  add_noise(scan, 0.05);
  write_image(folder_ / "scan.mha", scan, false);
  const std::string segment = "ct segment " + path("scan.mha") + " --region whole --out " + path("out");
  // 8·5³ / (12³ + 8·5³) = 36.7 % of the volume is in the small balls
  const Outcome coarse = macadam(segment + " --smallest '2.4 mm'");
  EXPECT_EQ(coarse.code, 0) << coarse.err;
  EXPECT_HAS(coarse.out, "1 grains, 0 of them cut by the boundary of the specimen; 3");
  EXPECT_HAS(coarse.out,
             "% of the aggregate's volume is in no grain: pieces below half of --smallest, 1.2 mm, are left out");
  EXPECT_HAS(coarse.out, "These voxels allow a --smallest of 0.4 mm and more");
  const Outcome fine = macadam(segment + " --smallest '1 mm'");
  EXPECT_EQ(fine.code, 0) << fine.err;
  EXPECT_HAS(fine.out, "9 grains, 0 of them cut by the boundary of the specimen; 0.");
  EXPECT_FALSE(contains(fine.out, "is in no grain:")) << fine.out;
}

TEST_F(CtCommand, WhatAHeaderSaysOfTheScanIsPrinted) {
  Image<float> scan = two_balls();
  write_image(folder_ / "scan.mhd", scan, false);
  std::string header = read(folder_ / "scan.mhd");
  const std::size_t matrix = header.find("TransformMatrix = 1 ");
  ASSERT_NE(matrix, std::string::npos);
  std::ofstream(folder_ / "scan.mhd") << header.replace(matrix, 20, "TransformMatrix = -1 ");
  const Outcome outcome =
      macadam("ct segment " + path("scan.mhd") + " --smallest '1.8 mm' --region whole --out " + path("out"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_HAS(outcome.out, "warning: the file's direction matrix (-1 0 0, 0 1 0, 0 0 1) is not applied");
  EXPECT_HAS(outcome.out, "mirror images");
}

TEST_F(CtCommand, OneSliceIsNoScan) {
  Image<float> scan = two_balls();
  Image<float> slice({70, 40, 1}, scan.spacing);
  std::copy_n(&scan.at(0, 0, 20), slice.count(), slice.voxels.begin());
  write_image(folder_ / "slice.mha", slice, false);
  const Outcome outcome =
      macadam("ct segment " + path("slice.mha") + " --smallest '1.8 mm' --region whole --out " + path("out"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_HAS(outcome.err, "the scan: slices: found 1, expected at least 4, because grains are found in a volume");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CtCommand, MemoryIsAnAmountWithAUnit) {
  write_image(folder_ / "scan.mha", two_balls(), false);
  const std::string segment = "ct segment " + path("scan.mha") + " --smallest '1.8 mm' --out " + path("out");
  for (const std::string memory : {"0 GB", "-1 GB", "3"}) {
    const Outcome outcome = macadam(segment + " --memory='" + memory + "'");
    EXPECT_EQ(outcome.code, 2) << memory;
    EXPECT_HAS(outcome.err, "--memory: found \"" + memory + "\", expected an amount");
  }
}

/// The voxel size comes from the file if it has one, otherwise from the command line.
TEST_F(CtCommand, TheEdgeOfAVoxelIsThatOfTheFileOrOfTheCommandLine) {
  const Image<float> scan = two_balls();
  write_image(folder_ / "scan.mha", scan, false);
  write_image(folder_ / "pages.tif", scan);
  const std::string tail = " --smallest '1.8 mm' --region whole --out " + path("out");
  EXPECT_EQ(macadam("ct segment " + path("scan.mha") + tail).code, 0);
  EXPECT_EQ(macadam("ct segment " + path("scan.mha") + " --voxel '100.5 um'" + tail).code, 0) << "within a hundredth";
  const Outcome near = macadam("ct segment " + path("scan.mha") + " --voxel '100.5 um'" + tail);
  EXPECT_FALSE(contains(near.out, "--voxel")) << near.out;
  const Outcome other = macadam("ct segment " + path("scan.mha") + " --voxel '200 um'" + tail);
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_HAS(other.out,
             "warning: the file says that a voxel is 0.1 x 0.1 x 0.1 mm; --voxel takes precedence: 0.2 x 0.2 x 0.2 mm");
  EXPECT_NEAR(read_image_header(folder_ / "out/labels.mha").spacing.z, 2e-4, 1e-12);
  const Outcome none = macadam("ct segment " + path("pages.tif") + tail);
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(contains(none.err, "none in the file")) << none.err;
  EXPECT_EQ(macadam("ct segment " + path("pages.tif") + " --voxel '0.1 mm'" + tail).code, 0);
}

}  // namespace
}  // namespace macadam::test
