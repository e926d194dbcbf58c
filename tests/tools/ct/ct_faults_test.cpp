// SPDX-License-Identifier: GPL-3.0-or-later
// Segments faulty scans. Each segmentation ends with an error that names the fault, or with a warning and grains of low
// confidence.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "host/tools/ct/grains/gradation.hpp"
#include "host/tools/ct/grains/grains.hpp"
#include "host/tools/ct/voxels/scan_checks.hpp"
#include "macadam/error.hpp"
#include "tests/tools/ct/ct_scans.hpp"

namespace macadam {
namespace {

using namespace ct_scans;

/// Result of segmenting a scan: the error, or the warnings and the mean confidence of the grains.
struct Outcome {
  std::string error, warnings;
  double confidence = 0;
  std::size_t grains = 0;
  bool says(const char* text) const { return (error + warnings).find(text) != std::string::npos; }
};

Outcome outcome(Image<float> scan, ScanRegion region = ScanRegion::whole, std::optional<double> air_voids = {}) {
  SegmentOptions options;
  options.region = region;
  options.smallest = 1.4e-3;
  options.air_voids = air_voids;
  Outcome out;
  try {
    const Segmentation found = segment_scan(std::move(scan), options);
    for (const std::string& warning : found.warnings) out.warnings += warning + "\n";
    out.grains = found.grains.size();
    for (const ScannedGrain& grain : found.grains) out.confidence += grain.confidence;
    if (out.grains > 0) out.confidence /= static_cast<double>(out.grains);
  } catch (const InputError& error) { out.error = error.what(); }
  return out;
}

/// Returns a scan of eight balls of radius 9 voxels with voids between them. `change` is applied to every grey value;
/// then noise of a tenth of the contrast is added.
Image<float> balls(const std::function<float(float)>& change = {}) {
  Image<float> scan = many_balls(46);
  if (change) {
    for (float& grey : scan.voxels) grey = change(grey);
  }
  add_noise(scan, 0.1);
  return scan;
}

/// Returns the scan with `around` voxels of air on all sides.
Image<float> in_air(const Image<float>& scan, std::int64_t around = 6) {
  Image<float> out({scan.size[0] + 2 * around, scan.size[1] + 2 * around, scan.size[2] + 2 * around}, scan.spacing, {},
                   air);
  add_noise(out, 0.1, 2);
  for (std::int64_t k = 0; k < scan.size[2]; ++k)
    for (std::int64_t j = 0; j < scan.size[1]; ++j)
      for (std::int64_t i = 0; i < scan.size[0]; ++i) out.at(i + around, j + around, k + around) = scan.at(i, j, k);
  return out;
}

/// Returns the scan as an 8-bit file would store it: `low` becomes 0, `high` becomes 255, and values outside are
/// clipped.
Image<float> in_8_bit(Image<float> scan, float low, float high) {
  for (float& grey : scan.voxels) grey = std::round(255 * std::clamp((grey - low) / (high - low), 0.0f, 1.0f));
  return scan;
}

TEST(CtFaults, AGoodScanHasNone) {
  const Outcome whole = outcome(balls()), around = outcome(in_air(balls()), ScanRegion::found);
  for (const Outcome& o : {whole, around}) {
    EXPECT_EQ(o.error + o.warnings, "");
    EXPECT_EQ(o.grains, 8u);
    EXPECT_GT(o.confidence, 0.9);
  }
}

TEST(CtFaults, ValuesThatAreNoNumbersAreNamed) {
  for (const float wrong : {NAN, INFINITY, -INFINITY}) {
    Image<float> scan = balls();
    scan.voxels[777] = wrong;
    EXPECT_TRUE(outcome(scan).error.find("voxel 777") != std::string::npos);
  }
}

/// If the voxel size along one axis is wrong, all grains are flat or tall in the same direction; this is warned of.
TEST(CtFaults, AVoxelOfAnotherHeightMakesAllGrainsFlatOrTall) {
  for (const double edge : {0.5e-4, 2e-4}) {
    for (const int axis : {0, 2}) {
      Image<float> scan = balls();
      (axis == 0 ? scan.spacing.x : scan.spacing.z) = edge;
      const Outcome o = outcome(scan);
      EXPECT_TRUE(o.says("chords through the aggregate")) << edge << " along "
                                                          << "x z"[axis];
      EXPECT_LE(o.confidence, 0.5);
    }
  }
}

/// The mean chords of a block along the axes equal its sides, also if the scan cuts the block.
TEST(CtFaults, ChordsOfABlockAreItsSidesAlsoWhereTheScanCutsIt) {
  for (const std::int64_t rim : {3, 0}) {
    Image<std::uint8_t> phases({10 + 2 * rim, 20 + 2 * rim, 40 + 2 * rim}, {1e-4, 1e-4, 1e-4}, {},
                               static_cast<std::uint8_t>(VoxelPhase::mastic));
    for (std::int64_t k = rim; k < 40 + rim; ++k)
      for (std::int64_t j = rim; j < 20 + rim; ++j)
        std::fill_n(&phases.at(rim, j, k), 10, static_cast<std::uint8_t>(VoxelPhase::aggregate));
    std::vector<std::string> warnings;
    EXPECT_EQ(ct::trust_in_axes(phases, warnings), ct::doubtful);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("chords through the aggregate differ: they are 1, 2 and 4 mm along"), std::string::npos)
        << warnings[0];
    phases.spacing = {4e-4, 2e-4, 1e-4};  // with these voxel sizes the block is a cube of 4 mm
    EXPECT_EQ(ct::trust_in_axes(phases, warnings), 1);
    EXPECT_EQ(warnings.size(), 1u);
  }
}

/// A wrong size of all voxels is noticed by comparison with the laboratory's gradation.
TEST(CtFaults, AWrongEdgeOfAllVoxelsShowsBesideTheLaboratorysGradation) {
  SegmentOptions options;
  options.region = ScanRegion::whole;
  options.smallest = 0.9e-3;                                      // half the diameter of the balls, which is 1.8 mm
  options.gradation = {{0.5e-3, 0.2}, {1.5e-3, 0.5}, {2e-3, 1}};  // half of the aggregate above 0.45 mm passes 1.6 mm
  for (const auto& [edge, right] : {std::pair{1e-4, true}, {0.5e-4, false}, {2e-4, false}}) {
    Image<float> scan = balls();
    scan.spacing = {edge, edge, edge};
    const Segmentation found = segment_scan(scan, options);
    ASSERT_EQ(found.grains.size(), 8u);
    EXPECT_EQ(found.warnings.empty(), right) << edge;
    for (const ScannedGrain& grain : found.grains) EXPECT_EQ(grain.confidence > 0.5, right);
  }
}

/// Reads a gradation, interpolates in it, and writes it beside the gradation of the scan.
TEST(CtFaults, GradationsAreReadAndStandBesideTheScans) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "ct_gradation.csv";
  const auto read = [&](const std::string& text) -> std::string {
    std::ofstream(file) << text;
    try {
      ct::read_gradation(file);
    } catch (const InputError& error) { return error.what(); }
    return "read";
  };
  EXPECT_TRUE(read("sieve,passing\n").find(":1") != std::string::npos);
  EXPECT_TRUE(read("sieve_mm,passing_percent\n8,100\n4,x\n").find(":3") != std::string::npos);
  EXPECT_TRUE(read("sieve_mm,passing_percent\n8,100\n4\n").find("\"4\", expected two numbers: the size of the sieve") !=
              std::string::npos);
  EXPECT_TRUE(read("sieve_mm,passing_percent\n8,100\n4,50,60\n").find("\"4,50,60\"") != std::string::npos);
  EXPECT_TRUE(read("sieve_mm,passing_percent\n8,100\n4,101\n").find("0 to 100") != std::string::npos);
  EXPECT_TRUE(read("sieve_mm,passing_percent\n8,100\n4,50\n4,40\n").find("a second row for this sieve") !=
              std::string::npos);
  EXPECT_TRUE(read("sieve_mm,passing_percent\n8,100\n4,50\n2,60\n").find("at least the 60 %") != std::string::npos);
  EXPECT_TRUE(read("sieve_mm,passing_percent\n8,90\n4,50\n").find("largest sieve") != std::string::npos);
  EXPECT_TRUE(read("sieve_m,passing\n0.008,1\n").find("at least two") != std::string::npos);
  EXPECT_EQ(read("sieve_mm,passing_percent\n8,100\n2,40\n\n"), "read");
  const std::vector<SievePassing> laboratory = ct::read_gradation(file);
  EXPECT_NEAR(ct::passing_at(laboratory, 4e-3), 0.7, 1e-12);  // 4 mm is half-way from 2 to 8 mm on a logarithmic scale
  EXPECT_NEAR(ct::passing_at(laboratory, 4e-3, 2e-3), 0.5, 1e-12);
  EXPECT_NEAR(ct::passing_at(laboratory, 1e-3), 0.2, 1e-12);
  EXPECT_EQ(ct::passing_at(laboratory, 1e-2, 9e-3), 1) << "nothing of it is that large, and all of nothing passes";
  std::vector<ScannedGrain> grains(2);
  grains[0].measure.volume = 3, grains[0].measure.d_intermediate = 3e-3, grains[0].sieve = 5e-3;
  grains[1].measure.volume = 1, grains[1].measure.d_intermediate = grains[1].sieve = 7e-3;
  const std::string text = ct::gradation_csv(grains, laboratory, 4e-3);
  EXPECT_TRUE(text.find("\n0.004,0.750000,0.000000,0.700000,0.500000\n") != std::string::npos) << text;
  EXPECT_TRUE(text.find("\n0.008,1.000000,1.000000,1.000000,1.000000\n") != std::string::npos) << text;
  EXPECT_TRUE(ct::gradation_csv(grains).find("laboratory") == std::string::npos);
  EXPECT_TRUE(ct::gradation_csv({}).find("\n0.004,0.000000,0.000000\n") != std::string::npos) << "of no grain, none";
  std::vector<std::string> warnings;  // the scan shows grains above 8 mm, but the laboratory's gradation has none
  EXPECT_EQ(ct::trust_in_sizes(grains, laboratory, 2 * laboratory.back().size, warnings), ct::doubtful);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].find("no grain above 8 mm") != std::string::npos) << warnings[0];
  std::filesystem::remove(file);
}

/// If a scan is clipped at its lowest or highest grey value, it is warned of.
TEST(CtFaults, ClippedGreyValuesTellNothing) {
  const Image<float> scan = balls();
  for (const auto& [low, high] : {std::pair{10000.f, 28000.f}, {20000.f, 32000.f}, {22000.f, 30000.f}}) {
    const Outcome o = outcome(in_8_bit(scan, low, high));
    EXPECT_TRUE(o.says("least grey value 0: the scan is clipped")) << low;
    EXPECT_TRUE(o.says("largest grey value 255: the scan is clipped")) << high;
    EXPECT_LT(o.confidence, 0.5);
  }
  // only the grey values of air and mastic are within the range
  const Outcome low = outcome(in_8_bit(scan, 18000, 40000));
  EXPECT_TRUE(low.says("least grey value 0"));
  EXPECT_LE(low.confidence, 0.5);
  EXPECT_EQ(outcome(in_8_bit(scan, 0, 40000)).warnings, "");
}

/// Clipped voxels have confidence 0; all others keep a high confidence.
TEST(CtFaults, ClippedVoxelsAreThoseWithoutConfidence) {
  const Image<float> scan = in_8_bit(balls(), 20000, 32000);
  SegmentOptions options;
  options.region = ScanRegion::whole;
  options.smallest = 1.4e-3;
  const Segmentation found = segment_scan(scan, options);
  double sum = 0, clipped = 0;
  for (std::size_t i = 0; i < scan.count(); ++i) {
    if (scan.voxels[i] == 0 || scan.voxels[i] == 255) {
      ASSERT_EQ(found.confidence.voxels[i], 0) << i;
      ++clipped;
    } else {
      sum += found.confidence.voxels[i];
    }
  }
  EXPECT_GT(clipped, 0.02 * static_cast<double>(scan.count()));
  EXPECT_GT(sum, 0.5 * 255 * (static_cast<double>(scan.count()) - clipped))
      << "of the others the phase is as clear as ever";
}

/// A stack that ends within the specimen is warned of, because the specimen ends in air at one end only.
TEST(CtFaults, HalfAStackEndsWithTheScanAtOneEnd) {
  const Image<float> whole = in_air(balls());
  Image<float> half({whole.size[0], whole.size[1], whole.size[2] / 2}, whole.spacing);
  std::copy_n(whole.voxels.begin(), half.count(), half.voxels.begin());
  const Outcome o = outcome(half, ScanRegion::found);
  EXPECT_TRUE(o.says("along z the specimen ends in air at one end, but at its upper end")) << o.error << o.warnings;
}

/// If the user gives the region, the program does not warn about missing air at its ends.
TEST(CtFaults, ARegionThatSomebodyGaveEndsWhereItWasGiven) {
  SegmentOptions options;
  options.smallest = 1.4e-3;
  options.surfaces = false;
  // The given region extends from the lower end of the scan to a height within the scan.
  options.given = GivenRegion{{0, 0, 0}, {4.5e-3, 4.5e-3, 3.4e-3}};
  const Segmentation found = segment_scan(balls(), options);
  for (const std::string& warning : found.warnings) EXPECT_EQ(warning.find("ends in air"), std::string::npos);
}

TEST(CtFaults, APhaseThatIsMissingIsSaid) {
  const auto no_aggregate = [](float grey) { return std::min(grey, mastic); };
  const auto no_voids = [](float grey) { return std::max(grey, mastic); };
  const auto no_mastic = [](float grey) { return grey < mastic + contrast / 2 ? air : aggregate; };
  EXPECT_TRUE(outcome(balls(no_aggregate)).error.find("phase is missing") != std::string::npos);
  // This specimen has only mastic and two large voids: the aggregate is missing.
  Image<float> spongy = scan_of({46, 46, 46}, {}, {ball(12, 12, 12, 12), ball(34, 34, 34, 12)});
  add_noise(spongy, 0.1);
  const Outcome sponge = outcome(spongy);
  EXPECT_TRUE(!sponge.error.empty() || sponge.confidence <= 0.5) << sponge.warnings;
  EXPECT_TRUE(outcome(in_air(spongy), ScanRegion::found).error.find("of the air around") != std::string::npos);
  EXPECT_TRUE(outcome(in_air(balls(no_mastic)), ScanRegion::found).error.find("of the air around") !=
              std::string::npos);
  Image<float> brighter = in_air(balls(no_mastic));  // the same scan with another grey value of air
  for (float& grey : brighter.voxels) grey += 20000;
  EXPECT_TRUE(outcome(brighter, ScanRegion::found).error.find("of the air around") != std::string::npos);
  EXPECT_EQ(outcome(in_air(balls(no_mastic)), ScanRegion::whole, 0).grains, 8u) << "loose grains, as was said";
  // Without voids the scan has two grey levels. Whether one of them is air is known only from air around the specimen,
  // or from the user.
  const Outcome alone = outcome(balls(no_voids)), around = outcome(in_air(balls(no_voids)), ScanRegion::found),
                said = outcome(balls(no_voids), ScanRegion::whole, 0);
  EXPECT_TRUE(alone.says("two grey levels"));
  EXPECT_LE(alone.confidence, 0.5);
  EXPECT_GT(around.confidence, 0.9);
  EXPECT_GT(said.confidence, 0.9);
  EXPECT_EQ(said.warnings, "");
  const std::string too_few = outcome(balls(no_voids), ScanRegion::whole, 0.04).error;
  EXPECT_NE(too_few.find("given air voids are 4 %"), std::string::npos) << too_few;
  EXPECT_NE(too_few.find("give --air-voids 0, and the voids are taken for mastic"), std::string::npos) << too_few;
}

TEST(CtFaults, OneGrainThatIsMostOfTheSpecimenIsDoubted) {
  // A paste as bright as the aggregate joins most of the specimen into one grain.
  Image<float> scan = scan_of({46, 46, 46}, {block({-9, -9, 8}, {60, 60, 60})}, {ball(20, 20, 24, 6)});
  add_noise(scan, 0.1);
  const Outcome o = outcome(scan);
  EXPECT_TRUE(o.says("of the specimen: the phase called aggregate")) << o.error << o.warnings;
  EXPECT_LE(o.confidence, 0.5);
}

TEST(CtFaults, AScanOfAirAloneHasNoContrast) {
  Image<float> nothing({40, 40, 40}, {1e-4, 1e-4, 1e-4}, {}, air);
  add_noise(nothing, 0.1);
  Image<float> cut = nothing;  // like a reconstruction that sets negative values to zero
  for (float& grey : cut.voxels) grey = std::max(0.0f, grey - air);
  for (const ScanRegion region : {ScanRegion::whole, ScanRegion::found}) {
    EXPECT_TRUE(outcome(nothing, region).error.find("contrast") != std::string::npos);
    EXPECT_TRUE(outcome(cut, region).error.find("contrast") != std::string::npos);
  }
}

/// Limestone in mastic with much limestone filler has almost the same grey value. Such a contrast is refused.
TEST(CtFaults, LimestoneInMasticFullOfItsFillerIsNotToldApart) {
  const Image<float> clean = many_balls(46);
  for (const float share : {0.02f, 0.1f, 0.2f}) {
    const Image<float> faint = balls([share](float grey) { return std::min(grey, mastic + share * (grey - mastic)); });
    EXPECT_NE(outcome(faint).error, "") << share;
    EXPECT_NE(outcome(in_air(faint), ScanRegion::found).error, "") << share;
  }
}

/// Rings as strong as the contrast are refused; they must not become grains.
TEST(CtFaults, RingsThatHideTheSpecimenAreNoGrains) {
  for (const double strength : {0.4, 1.5, 3.0}) {
    Image<float> scan = balls();
    std::mt19937 random(5);
    std::normal_distribution<float> offset(0, static_cast<float>(strength) * contrast);
    std::vector<float> ring(60);
    for (float& r : ring) r = offset(random);
    for (std::int64_t k = 0; k < 46; ++k)
      for (std::int64_t j = 0; j < 46; ++j)
        for (std::int64_t i = 0; i < 46; ++i)
          scan.at(i, j, k) += ring[static_cast<std::size_t>(
              std::lround(std::hypot(static_cast<double>(i) - 22.5, static_cast<double>(j) - 22.5)))];
    const Outcome o = outcome(scan);
    EXPECT_TRUE(o.error.find("rings") != std::string::npos || o.error.find("contrast") != std::string::npos)
        << strength << ": " << o.error << o.warnings;
  }
}

/// The least certain cut at the surface of a grain lowers the confidence of the grain. If a cut contradicts its margin,
/// a person decided it, and it counts as certain.
TEST(CtFaults, ADoubtfulCutLowersTheConfidenceOfItsTwoGrains) {
  ct::Decision decision;
  decision.grain = {0, 1, 2, 3, 3, 4};
  const auto cut = [](std::uint32_t a, std::uint32_t b, double margin, bool made) {
    GrainCut out;
    out.a = a, out.b = b, out.margin = margin, out.cut = made;
    return out;
  };
  // Grain 4 is too small to be kept, so the cut beside it lowers only the confidence of grain 3.
  decision.cuts = {cut(1, 2, 0.2, true), cut(2, 3, 0.9, true), cut(3, 4, -0.6, false), cut(3, 5, 0.01, true)};
  const std::vector<std::uint32_t> number{0, 1, 2, 3, 0};
  EXPECT_EQ(ct::certainty(decision, number), (std::vector<double>{1, 0.6, 0.6, 0.8, 1}));
  decision.cuts[0].cut = false;  // a person overrules this cut, which makes the decision certain
  EXPECT_EQ(ct::certainty(decision, number), (std::vector<double>{1, 1, 0.95, 0.8, 1}));
}

}  // namespace
}  // namespace macadam
