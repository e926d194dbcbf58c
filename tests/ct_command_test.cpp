// SPDX-License-Identifier: GPL-3.0-or-later
// `macadam ct segment` as a user meets it: regions by coordinates, where the edge of a voxel comes from.
#include <fstream>
#include <sstream>

#include "ct_scans.hpp"
#include "program.hpp"

namespace macadam::test {
namespace {

using namespace ct_scans;
using CtCommand = Program;

/// Two balls of radius 12 in a scan of 70 × 40 × 40 voxels of 0.1 mm, around (20, 20, 20) and (50, 20, 20) voxels.
Image<float> two_balls() {
  Image<float> scan = scan_of({70, 40, 40}, {ball(20, 20, 20, 12), ball(50, 20, 20, 12)}, {ball(35, 34, 34, 4)});
  add_noise(scan, 0.05);
  return scan;
}

std::size_t rows(const std::string& file) {
  std::ifstream in(file);
  std::size_t n = 0;
  for (std::string line; std::getline(in, line);) ++n;
  return n - 1;
}

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
  // pixels whose centres lie in a circle of 15: its area within a hundredth
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

TEST_F(CtCommand, MemoryIsAnAmountWithAUnit) {
  write_image(folder_ / "scan.mha", two_balls(), false);
  const std::string segment = "ct segment " + path("scan.mha") + " --smallest '1.8 mm' --out " + path("out");
  for (const std::string memory : {"0 GB", "-1 GB", "3"}) {
    const Outcome outcome = macadam(segment + " --memory='" + memory + "'");
    EXPECT_EQ(outcome.code, 2) << memory;
    EXPECT_HAS(outcome.err, "--memory: found \"" + memory + "\", expected an amount");
  }
}

TEST_F(CtCommand, TheEdgeOfAVoxelIsThatOfTheFileOrOfTheCommandLine) {
  const Image<float> scan = two_balls();
  write_image(folder_ / "scan.mha", scan, false);
  write_image(folder_ / "pages.tif", scan);
  const std::string tail = " --smallest '1.8 mm' --region whole --out " + path("out");
  EXPECT_EQ(macadam("ct segment " + path("scan.mha") + tail).code, 0);
  EXPECT_EQ(macadam("ct segment " + path("scan.mha") + " --voxel '100.5 um'" + tail).code, 0) << "within a hundredth";
  const Outcome other = macadam("ct segment " + path("scan.mha") + " --voxel '50 um'" + tail);
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "as --voxel says")) << other.err;
  const Outcome none = macadam("ct segment " + path("pages.tif") + tail);
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(contains(none.err, "none in the file")) << none.err;
  EXPECT_EQ(macadam("ct segment " + path("pages.tif") + " --voxel '0.1 mm'" + tail).code, 0);
}

}  // namespace
}  // namespace macadam::test
