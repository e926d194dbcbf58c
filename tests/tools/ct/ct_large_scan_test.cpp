// SPDX-License-Identifier: GPL-3.0-or-later
// Segments scans that are larger than the given memory. The program segments the means of blocks of voxels, and then
// refines the surfaces with voxels from the file. It must find the same grains as in memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "host/tools/ct/voxels/correction.hpp"
#include "host/tools/ct/grains/grain_surfaces.hpp"
#include "host/tools/ct/segment/refine.hpp"
#include "macadam/error.hpp"
#include "tests/tools/ct/ct_folder.hpp"
#include "tests/tools/ct/ct_scans.hpp"
#include "tests/support/shape_tests.hpp"

namespace macadam {
namespace {

using namespace ct_scans;
namespace fs = std::filesystem;
constexpr double pi = std::numbers::pi;

class CtLargeScan : public CtFolder {
 protected:
  /// Returns an amount of memory [bytes] that is too small for the whole scan: 100 MB for the program and a little more
  /// than 12 bytes per voxel.
  static double little(const Image<float>& scan) { return 1e8 + 12.1 * static_cast<double>(scan.count()); }
  std::string fault(const fs::path& file, const SegmentOptions& options, double memory) {
    try {
      segment_file({file, {}, {}}, options, memory);
    } catch (const InputError& error) { return error.what(); }
    return "segmented";
  }

  /// Labels the scan coarsely, with one grain number per block of `block`³ voxels, then refines the surfaces of the
  /// grains with the single voxels, and returns the grains. `number` gives the grain number of a block, 0 for none.
  std::vector<ScannedGrain> refined(const Image<float>& scan, std::int64_t block,
                                    const std::function<std::uint32_t(const std::array<std::int64_t, 3>&)>& number,
                                    double noise, Denoising denoising) {
    write_image(folder_ / "scan.mha", scan, false);
    const std::unique_ptr<ct::ImageSlices> file = ct::open_image(folder_ / "scan.mha", {});
    const ct::FineScan fine{*file, scan.spacing, block};
    Segmentation out;
    out.labels = Image<std::uint32_t>({scan.size[0] / block, scan.size[1] / block, scan.size[2] / block},
                                      static_cast<double>(block) * scan.spacing);
    out.phases = Image<std::uint8_t>::like(out.labels, static_cast<std::uint8_t>(VoxelPhase::mastic));
    out.levels = {air, mastic, aggregate, 0, true};
    for (std::int64_t k = 0; k < out.labels.size[2]; ++k) {
      for (std::int64_t j = 0; j < out.labels.size[1]; ++j) {
        for (std::int64_t i = 0; i < out.labels.size[0]; ++i) {
          out.labels.at(i, j, k) = number({i, j, k});
          if (out.labels.at(i, j, k) > 0) out.phases.at(i, j, k) = static_cast<std::uint8_t>(VoxelPhase::aggregate);
        }
      }
    }
    const auto boxes = ct::boxes_of(out.labels, out.phases, Image<std::uint8_t>::like(out.labels, 255));
    out.grains.resize(boxes.size() - 1);
    for (std::size_t g = 0; g < out.grains.size(); ++g) out.grains[g].id = static_cast<std::uint32_t>(g + 1);
    SegmentOptions options;
    options.denoising = denoising;
    EXPECT_EQ(ct::refine_surfaces(fine, out, {0.5 * (air + mastic), mastic + contrast / 2}, boxes, {}, noise, options),
              out.grains.size());
    return out.grains;
  }
};

/// Returns a scan of 220 × 120 × 122 voxels with two balls that touch, an ellipsoid, a block that the end of the scan
/// cuts, and voids.
Image<float> stones() {
  const Body ellipsoid = [](double x, double y, double z) {  // half axes 30, 50, 26
    return 26 * (1 - std::sqrt((x - 178) * (x - 178) / 900 + (y - 60) * (y - 60) / 2500 + (z - 80) * (z - 80) / 676));
  };
  return scan_of({220, 120, 122},
                 {ball(46, 60, 62, 40), ball(110, 60, 62, 24), ellipsoid, block({150, 30, -9}, {205, 90, 40})},
                 {ball(95, 18, 20, 14), ball(95, 102, 102, 14), ball(130, 102, 20, 13)});
}

/// Sorts the grains by volume, so that grains of two segmentations correspond.
void by_place(Segmentation& scan) {
  std::sort(scan.grains.begin(), scan.grains.end(),
            [](const ScannedGrain& a, const ScannedGrain& b) { return a.measure.volume < b.measure.volume; });
}

/// A block has the mean grey value of its voxels and the grey value of its central voxel. Incomplete blocks at the ends
/// are left out.
TEST_F(CtLargeScan, ABlockHasItsMeanAndTheVoxelInItsMiddle) {
  constexpr std::int64_t n = 3;
  Image<float> scan({3 * n + 1, 2 * n, 2 * n + 2}, {voxel, voxel, voxel});
  const auto value = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<float>(i + 10 * j * j + 100 * k);
  };
  for (std::int64_t k = 0; k < scan.size[2]; ++k)
    for (std::int64_t j = 0; j < scan.size[1]; ++j)
      for (std::int64_t i = 0; i < scan.size[0]; ++i) scan.at(i, j, k) = value(i, j, k);
  write_image(folder_ / "scan.mha", scan, false);
  const std::unique_ptr<ct::ImageSlices> file = ct::open_image(folder_ / "scan.mha", {});
  const ct::CoarseScan coarse = ct::read_coarse({*file, scan.spacing, n}, {});
  ASSERT_EQ(coarse.means.size, (std::array<std::int64_t, 3>{3, 2, 2}));
  for (std::int64_t k = 0; k < 2; ++k) {
    for (std::int64_t j = 0; j < 2; ++j) {
      for (std::int64_t i = 0; i < 3; ++i) {
        double sum = 0;
        for (std::int64_t a = 0; a < n * n * n; ++a) sum += value(n * i + a % n, n * j + a / n % n, n * k + a / n / n);
        // the tolerance is the rounding of sums of 27 floats of up to 1000
        EXPECT_NEAR(coarse.means.at(i, j, k), sum / (n * n * n), 27 * 1000 * 6e-8);
        EXPECT_EQ(coarse.middles.at(i, j, k), value(n * i + 1, n * j + 1, n * k + 1));
      }
    }
  }
}

/// Segmentation on two levels finds the same grains as segmentation in memory, and their measures agree within the
/// resolution of the surfaces.
TEST_F(CtLargeScan, TwoLevelsFindTheSameGrainsAsMemoryDoes) {
  Image<float> scan = stones();
  add_noise(scan, 0.1);
  write_image(folder_ / "scan.mha", scan, false);
  const ScanFile file{folder_ / "scan.mha", {}, {}};
  const SegmentOptions options = options_of(80);  // gives blocks of 4 voxels
  Segmentation whole = segment_file(file, options, 1e12), parts = segment_file(file, options, little(scan));
  EXPECT_EQ(whole.block, 1);
  EXPECT_EQ(whole.refined, 0u);
  ASSERT_EQ(parts.block, 4);
  EXPECT_EQ(parts.labels.size, (std::array<std::int64_t, 3>{55, 30, 30}));
  EXPECT_EQ(parts.grains.size(), 4u);
  EXPECT_EQ(parts.refined, parts.grains.size()) << "20 blocks and less are fewer than a surface's 32 nodes";
  ASSERT_EQ(whole.grains.size(), parts.grains.size());
  by_place(whole), by_place(parts);
  for (std::size_t g = 0; g < whole.grains.size(); ++g) {
    const ScannedGrain &a = whole.grains[g], &b = parts.grains[g];
    // Surface nodes are 1 to 2 voxels apart, and grains have diameters of 48 to 100 voxels. If the whole surface were
    // off by a tenth of a voxel, the volume would change by about one per cent.
    EXPECT_NEAR(b.measure.volume / a.measure.volume, 1, 0.01) << g;
    EXPECT_NEAR(b.measure.area / a.measure.area, 1, 0.02) << g;
    EXPECT_NEAR(b.measure.d_intermediate / a.measure.d_intermediate, 1, 0.015) << g;
    EXPECT_LT(norm(b.measure.centroid - a.measure.centroid), 0.3 * voxel) << g;
    EXPECT_EQ(a.border, b.border) << g;
    EXPECT_TRUE(check_surface(b.surface).good()) << g;
    for (const ScannedGrain* grain : {&a, &b})
      EXPECT_EQ(grain->surface.name, "grain_000" + std::to_string(grain->id)) << "its file's name";
  }
  EXPECT_NEAR(parts.grains[0].measure.volume / (4 * pi / 3 * std::pow(24 * voxel, 3)), 1, 0.02);
  EXPECT_NEAR(parts.grains[3].measure.volume / (4 * pi / 3 * std::pow(40 * voxel, 3)), 1, 0.01);
  // A block of voxels on a surface belongs wholly to one phase, which makes errors of both signs; their sum is small.
  EXPECT_NEAR(parts.aggregate, whole.aggregate, 0.005);
  EXPECT_NEAR(parts.air_voids, whole.air_voids, 0.002);
}

/// Corrections that are determined on the means of blocks are also applied to the voxels from which surfaces are
/// refined.
TEST_F(CtLargeScan, WhatWasTakenOutOfTheBlocksIsTakenOutOfTheirVoxels) {
  Image<float> scan = many_balls(132, 20);
  for (std::int64_t k = 0; k < 132; ++k) {
    for (std::int64_t j = 0; j < 132; ++j) {
      for (std::int64_t i = 0; i < 132; ++i) {
        const double r = std::hypot(static_cast<double>(i) - 65.5, static_cast<double>(j) - 65.5) / 93;
        const double brightness = (1 - 0.2 * (1 - r * r)) * (1 + 0.06 * std::sin(0.1 * static_cast<double>(k)));
        scan.at(i, j, k) *= static_cast<float>(brightness);
      }
    }
  }
  add_noise(scan, 0.1);
  write_image(folder_ / "scan.mha", scan, false);
  const Segmentation parts = segment_file({folder_ / "scan.mha", {}, {}}, options_of(40), little(scan));
  ASSERT_EQ(parts.block, 2);
  ASSERT_EQ(parts.grains.size(), 27u);
  EXPECT_EQ(parts.refined, 27u);
  const double truth = 4 * pi / 3 * std::pow(20 * voxel, 3);
  for (const ScannedGrain& grain : parts.grains)  // without corrections the volumes differ by a quarter
    EXPECT_NEAR(grain.measure.volume / truth, 1, 0.05) << grain.id;
}

/// A recorded correction, evaluated at a voxel, gives the corrected grey value.
TEST_F(CtLargeScan, StepsOfACorrectionAreFunctionsOfThePlace) {
  Image<float> scan = many_balls(60), before;
  for (std::int64_t k = 0; k < 60; ++k)
    for (std::int64_t n = 0; n < 3600; ++n)
      scan.at(n % 60, n / 60, k) *= static_cast<float>(1 + 0.002 * static_cast<double>(k));
  before = scan;
  const Image<std::uint8_t> region = Image<std::uint8_t>::like(scan, 1);
  ct::CorrectionSteps steps;
  ct::correct(scan, region, {}, &steps);
  ASSERT_FALSE(steps.empty());
  double largest = 0;
  for (std::int64_t k = 0; k < 60; k += 7) {
    for (std::int64_t i = 0; i < 60; i += 5) {
      double grey = before.at(i, 30, k);
      for (const ct::CorrectionStep& step : steps)
        grey = step.of(grey, static_cast<double>(i), 30, static_cast<double>(k));
      largest = std::max(largest, std::abs(grey - scan.at(i, 30, k)));
    }
  }
  // Between two radii the correction is interpolated, so the tolerance is the difference between the corrections of
  // neighbouring rings.
  EXPECT_LT(largest, 0.01 * contrast);
}

/// Slices in a folder are read in parts. A compressed file must be read whole, so too little memory is refused.
TEST_F(CtLargeScan, SlicesInAFolderAndWhatCannotBeReadInParts) {
  Image<float> scan = many_balls(96, 20);
  fs::create_directories(folder_ / "slices");
  for (std::int64_t k = 0; k < 96; ++k) {
    Image<float> slice({96, 96, 1}, scan.spacing);
    std::copy_n(&scan.at(0, 0, k), 96 * 96, slice.voxels.begin());
    write_image(folder_ / "slices" / ("s" + std::to_string(k) + ".tif"), slice);
  }
  const SegmentOptions options = options_of(40);
  const Segmentation parts = segment_file({folder_ / "slices", {}, {voxel, voxel, voxel}}, options, little(scan));
  EXPECT_EQ(parts.block, 2);
  EXPECT_EQ(parts.grains.size(), 8u);
  Image<std::uint16_t> whole(scan.size, scan.spacing);
  std::copy(scan.voxels.begin(), scan.voxels.end(), whole.voxels.begin());
  write_image(folder_ / "packed.mha", whole, true);
  EXPECT_EQ(segment_file({folder_ / "packed.mha", {}, {}}, options, little(scan)).grains.size(), 8u);
  EXPECT_NE(fault(folder_ / "packed.mha", options, 1.01e8).find("cannot be read in parts"), std::string::npos);
  // Each of the 96³ voxels needs 2 bytes as stored, 2 bytes as read and 4 bytes as a number, together 7 MB. The program
  // itself needs 100 MB.
  EXPECT_NE(fault(folder_ / "packed.mha", options, 1.05e8).find("cannot be read in parts"), std::string::npos);
  EXPECT_NE(fault(folder_ / "packed.mha", options, 1e6).find("GB, with means over blocks"), std::string::npos);
  SegmentOptions paper = options;
  paper.recipe = SegmentRecipe::paper;
  EXPECT_NE(fault(folder_ / "packed.mha", paper, little(scan)).find("with the recipe \"paper\""), std::string::npos);
  write_image(folder_ / "pages.tif", scan);
  EXPECT_NE(fault(folder_ / "pages.tif", options, 1e12).find("edge of a voxel"), std::string::npos);
}

/// The two ends of the scan along each axis cut grains in the same way, so mirroring the scan does not change the
/// volumes.
TEST_F(CtLargeScan, GrainsAreCutAlikeByBothEndsOfEachAxis) {
  Image<float> scan = scan_of({96, 96, 96}, {ball(95.5, 30, 34, 20), ball(34, 95.5, 30, 22), ball(30, 34, 95.5, 24)},
                              {ball(76, 76, 76, 10)});
  add_noise(scan, 0.02);
  std::vector<double> volumes[2];
  for (std::vector<double>& found : volumes) {
    write_image(folder_ / "scan.mha", scan, false);
    Segmentation parts = segment_file({folder_ / "scan.mha", {}, {}}, options_of(40), little(scan));
    EXPECT_EQ(parts.refined, 3u);
    by_place(parts);
    for (const ScannedGrain& grain : parts.grains) found.push_back(grain.measure.volume);
    std::reverse(scan.voxels.begin(), scan.voxels.end());  // mirrors the scan along x, y and z
  }
  ASSERT_EQ(volumes[0].size(), 3u);
  ASSERT_EQ(volumes[1].size(), 3u);
  // The surfaces of the scan and of its mirror image have different facets, but equally many. If a cut were off by half
  // a voxel, the ratio of the volumes would be off by 0.04.
  for (std::size_t g = 0; g < 3; ++g) EXPECT_NEAR(volumes[1][g] / volumes[0][g], 1, 0.005) << g;
  std::sort(volumes[0].begin(), volumes[0].end());
  // flat facets with edges of about two voxels cut off 3/1000 of the volume of a ball
  for (std::size_t g = 0; g < 3; ++g) {
    const double radius = (20 + 2 * static_cast<double>(g)) * voxel;
    EXPECT_NEAR(volumes[0][g] / (2 * pi / 3 * std::pow(radius, 3)), 1, 0.01) << g;
  }
}

/// Scans of a block of aggregate that is cut between voxels 19 and 20 along one axis. Grey values do not change at the
/// cut; only the labels separate the two grains.
class CutGrains : public CtLargeScan {
 protected:
  using Place = std::array<std::int64_t, 3>;
  std::vector<ScannedGrain> cut(const Place& size, const Place& begin, const Place& end, std::size_t along) {
    Image<float> scan(size, {voxel, voxel, voxel}, {}, mastic);
    for (std::int64_t k = begin[2]; k < end[2]; ++k)
      for (std::int64_t j = begin[1]; j < end[1]; ++j)
        for (std::int64_t i = begin[0]; i < end[0]; ++i) scan.at(i, j, k) = aggregate;
    const auto number = [&](const Place& at) -> std::uint32_t {
      for (std::size_t a = 0; a < 3; ++a)
        if (at[a] < begin[a] / 2 || at[a] >= end[a] / 2) return 0;
      return at[along] < 10 ? 1 : 2;
    };
    return refined(scan, 2, number, 0, Denoising::none);
  }
  /// Expects that the first grain contains the point at `before` along an axis and the second grain contains the point
  /// at `behind`, and that neither grain contains the point of the other grain. `there` is the coordinate of the two
  /// points along the axis `other`.
  void expect_parted(const std::vector<ScannedGrain>& grains, std::size_t along, double before, double behind,
                     std::size_t other, double there) {
    for (const double at : {before, behind}) {
      double place[3] = {11.4, 11.7, 11.2};
      place[other] = there, place[along] = at;
      const Vec3d point{place[0] * voxel, place[1] * voxel, place[2] * voxel};
      for (const std::size_t g : {0u, 1u}) {
        EXPECT_NEAR(test::winding(grains[g].surface, point), g == (at == behind), 1e-6)
            << "grain " << g << " at " << place[0] << ", " << place[1] << ", " << place[2];
      }
    }
  }
};

TEST_F(CutGrains, MeetAtTheCutAlongEachAxis) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Place size{24, 24, 24}, end{20, 20, 20};
    size[axis] = 40, end[axis] = 36;
    const std::vector<ScannedGrain> grains = cut(size, {4, 4, 4}, end, axis);
    ASSERT_EQ(grains.size(), 2u);
    EXPECT_NEAR(grains[1].measure.volume / grains[0].measure.volume, 1, 0.005) << axis;  // the grains are mirror images
    expect_parted(grains, axis, 19.3, 19.7, (axis + 1) % 3, 11.4);
  }
}

/// Both grains remain separated up to the first and last voxels of the scan.
TEST_F(CutGrains, ArePartedUpToTheFirstAndTheLastVoxelsOfTheScan) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t along = (axis + 1) % 3;
    Place size{24, 24, 24}, begin{4, 4, 4}, end{20, 20, 20};
    size[along] = 40, end[along] = 36, begin[axis] = 0, end[axis] = size[axis];
    const std::vector<ScannedGrain> grains = cut(size, begin, end, along);
    ASSERT_EQ(grains.size(), 2u);
    for (const double face : {0.2, 22.8}) expect_parted(grains, along, 18.75, 20.25, axis, face);
  }
}

TEST_F(CtLargeScan, NoiseThatMeansOfVoxelsAreRidOfTakesNoRoundOfDiffusion) {
  Image<float> scan = scan_of({76, 76, 76}, {ball(37.5, 37.5, 37.5, 33)});
  add_noise(scan, 0.03);
  // the ball is 17 blocks of 4 voxels wide, 34 surface nodes 2 voxels apart
  const auto volume = [&](double noise, Denoising denoising) {
    const auto number = [](const std::array<std::int64_t, 3>& at) {
      const auto from_middle = [](std::int64_t n) { return 4 * static_cast<double>(n) + 1.5 - 37.5; };
      return norm(Vec3d{from_middle(at[0]), from_middle(at[1]), from_middle(at[2])}) < 33 ? 1u : 0u;
    };
    return refined(scan, 4, number, noise, denoising).at(0).measure.volume;
  };
  const double as_it_is = volume(0.03, Denoising::none);
  EXPECT_NEAR(as_it_is / (4 * pi / 3 * std::pow(33 * voxel, 3)), 1, 0.01);
  // averaging 8 voxels reduces this noise to 0.01, so diffusion is not applied
  EXPECT_EQ(volume(0.03, Denoising::diffusion), as_it_is);
  EXPECT_NE(volume(0.1, Denoising::diffusion), as_it_is);
}

TEST_F(CtLargeScan, ANeedleThinnerThanABlockLeavesItsGrainsSurfaceClosed) {
  // The needle is too thin to be seen in the blocks. It is longer than the region that is read again to refine the
  // ball. At the end of this region the surface of the needle must be closed.
  Image<float> scan =
      scan_of({96, 96, 96}, {ball(44, 44, 44, 20), block({60, 44.5, 44.5}, {92, 46.5, 46.5})}, {ball(80, 80, 80, 10)});
  add_noise(scan, 0.02);
  write_image(folder_ / "scan.mha", scan, false);
  SegmentOptions options = options_of(40);
  options.denoising = Denoising::none;
  const Segmentation parts = segment_file({folder_ / "scan.mha", {}, {}}, options, little(scan));
  ASSERT_EQ(parts.block, 2);
  ASSERT_EQ(parts.grains.size(), 1u);
  EXPECT_EQ(parts.refined, 1u);
  EXPECT_TRUE(check_surface(parts.grains[0].surface).good()) << check_surface(parts.grains[0].surface).text();
  EXPECT_LE(parts.grains[0].surface.facets.size(), 800u) << "more would be of a surface that had to be mended";
}

/// The outermost voxels of the specimen are mixed with air. A grain that begins one voxel behind this rim counts as
/// cut; one two voxels behind it does not.
TEST_F(CtLargeScan, AGrainBehindARimOfMixedVoxelsIsCutByTheSpecimensEnd) {
  Image<std::uint8_t> phases({9, 9, 9}, {1, 1, 1}, {}, 255);
  Image<std::uint32_t> labels = Image<std::uint32_t>::like(phases);
  const auto fill = [](auto& image, std::int64_t low, std::int64_t high, auto value) {
    for (std::int64_t k = low; k <= high; ++k)
      for (std::int64_t j = low; j <= high; ++j)
        for (std::int64_t i = low; i <= high; ++i) image.at(i, j, k) = value;
  };
  const Image<std::uint8_t> confidence = Image<std::uint8_t>::like(phases, 255);
  fill(phases, 1, 7, static_cast<std::uint8_t>(VoxelPhase::mastic));
  fill(labels, 2, 6, 1u);
  EXPECT_TRUE(ct::boxes_of(labels, phases, confidence).at(1).border);
  fill(labels, 2, 6, 0u);
  fill(labels, 3, 5, 1u);
  EXPECT_FALSE(ct::boxes_of(labels, phases, confidence).at(1).border);
}

TEST_F(CtLargeScan, AGrainNearOneEndOfTheScanIsNotCutByAirAtTheOther) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Image<std::uint8_t> phases({9, 9, 9}, {1, 1, 1}, {}, static_cast<std::uint8_t>(VoxelPhase::mastic));
    Image<std::uint32_t> labels = Image<std::uint32_t>::like(phases);
    for (std::int64_t k = 0; k < 9; ++k) {
      for (std::int64_t j = 0; j < 9; ++j) {
        for (std::int64_t i = 0; i < 9; ++i) {
          std::array<std::int64_t, 3> at{i, j, k};
          if (at[axis] < 2) phases.at(i, j, k) = 255;
          at[axis] -= 2;  // the grain is in the middle, and along this axis one voxel from the end of the scan
          labels.at(i, j, k) = std::all_of(at.begin(), at.end(), [](auto n) { return n >= 3 && n <= 5; });
        }
      }
    }
    EXPECT_FALSE(ct::boxes_of(labels, phases, Image<std::uint8_t>::like(phases, 255)).at(1).border) << axis;
  }
}

}  // namespace
}  // namespace macadam
