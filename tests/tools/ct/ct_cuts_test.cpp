// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the file that lists the cuts between fragments of grains, and cuts that do not fit the scan.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "host/tools/ct/grains/fragments.hpp"
#include "host/tools/ct/grains/grains.hpp"
#include "host/tools/ct/segment/segment_files.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr double voxel = 1e-4;  // edge of a voxel [m]

TEST(CtCuts, AreReadAsTheyWereWritten) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("ct_cuts_" + std::to_string(getpid()) + ".csv");
  const auto fault_of = [&](const std::string& text) -> std::string {
    std::ofstream(file) << text;
    try {
      ct::read_cuts(file);
    } catch (const InputError& error) { return error.what(); }
    return "read";
  };
  const std::vector<GrainCut> cuts{{1, 2, {0.001, 0.002, 0.003}, 0.5, 0.9, 0.8, 0.25, true},
                                   {2, 7, {}, 0.9, 1, 1, -0.5, false}};
  std::ofstream(file) << ct::cuts_csv(cuts);
  const std::vector<GrainCut> read = ct::read_cuts(file);
  EXPECT_EQ(ct::cuts_csv(read), ct::cuts_csv(cuts));
  const std::string header = "a,b,x,y,z,neck,solidity,valley,margin,cut\n";
  EXPECT_NE(fault_of("a,b\n").find(":1"), std::string::npos);
  EXPECT_NE(fault_of(header + "1,2,0,0,0,1,1,1,0.5,2\n").find("0 or 1"), std::string::npos);
  EXPECT_NE(fault_of(header + "1,2,0,0,0,1,1,1,0.5\n").find(":2"), std::string::npos);
  EXPECT_NE(fault_of(header + "1,2,0,x,0,1,1,1,0.5,1\n").find("\"x\""), std::string::npos);
  EXPECT_NE(fault_of(header + "-1,2,0,0,0,1,1,1,0.5,1\n").find("fragment"), std::string::npos);
  std::filesystem::remove(file);
}

// Uses three fragments, each of which touches the other two. Cuts are refused if they do not match the faces between
// fragments of the scan, or if they contradict one another.
TEST(CtCuts, OfAnotherScanOrAgainstOneAnotherAreRefused) {
  ct::Fragments fragments;
  fragments.labels = Image<std::uint32_t>({1, 1, 1}, {voxel, voxel, voxel});
  fragments.radius = {0, 1e-3, 1e-3, 1e-3};
  std::vector<GrainCut> good;
  for (const auto& [a, b] : {std::pair{1u, 2u}, std::pair{1u, 3u}, std::pair{2u, 3u}}) {
    const Vec3d middle{a * 1e-3, b * 1e-3, 0};
    fragments.faces.push_back({a, b, 1e-3, 0, 4, 4.0 * middle});
    good.push_back({a, b, middle, 1, 1, 1, -1, a == 1 && b == 2});
  }
  good[1].cut = true;  // fragments 2 and 3 are one grain, 1 is another
  EXPECT_EQ(ct::decide(fragments, good).grain, (std::vector<std::uint32_t>{0, 1, 2, 2}));
  const auto fault_of = [&](const std::vector<GrainCut>& cuts) -> std::string {
    try {
      ct::decide(fragments, cuts);
    } catch (const InputError& error) { return error.what(); }
    return "none";
  };
  std::vector<GrainCut> cuts = good;
  cuts[1].cut = false;  // a contradiction: fragments 1 and 2 would be cut apart, although each is joined to fragment 3
  EXPECT_NE(fault_of(cuts).find("fragments 1 and 2"), std::string::npos) << fault_of(cuts);
  EXPECT_NE(fault_of(cuts).find("join these two fragments"), std::string::npos) << fault_of(cuts);
  cuts = good;
  cuts[2].place.x += 1.9 * voxel;  // the place is within the tolerance of two voxels from the face
  EXPECT_EQ(fault_of(cuts), "none");
  cuts[2].place.x += 0.2 * voxel;
  EXPECT_NE(fault_of(cuts).find("row 3"), std::string::npos) << fault_of(cuts);
  cuts = good, std::swap(cuts[0], cuts[1]);
  EXPECT_NE(fault_of(cuts).find("another scan"), std::string::npos) << fault_of(cuts);
  cuts = good, cuts.pop_back();
  EXPECT_NE(fault_of(cuts).find("found 2, expected 3"), std::string::npos) << fault_of(cuts);
}

}  // namespace
}  // namespace macadam
