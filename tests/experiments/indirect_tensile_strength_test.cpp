// SPDX-License-Identifier: GPL-3.0-or-later
// indirect_tensile_strength_test.cpp  Tests the results of a disc that two strips split: those of a known curve, and
// those of a small disc with cracks.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "host/experiments/transient/disc_strength.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "macadam/macadam.hpp"
#include "tests/scene/scene_file.hpp"
#include "tests/support/test_files.hpp"

namespace macadam {
namespace {

constexpr double diameter = 0.15, thickness = 0.031, largest_load = 16e3, at_peak = 3e-3;

/// Returns the curve of a load that grows evenly until `at_peak` and then falls evenly to `last_part` of its largest
/// value, as if it were to vanish at 3·at_peak.
std::vector<StressSample> triangle(double last_part) {
  std::vector<StressSample> out;
  const double end = at_peak * (3 - 2 * last_part);
  for (int k = 1; k <= 30'000; ++k) {
    const double x = end * k / 30'000, part = x < at_peak ? x / at_peak : (3 - x / at_peak) / 2;
    out.push_back({-x / diameter, -part * largest_load / (diameter * thickness)});
  }
  return out;
}

Domain disc() {
  Domain out;
  out.shape = domains::Disc{};
  out.size = {diameter, thickness, diameter};
  return out;
}

const experiments::FittedPeak peak{-at_peak / diameter, -largest_load / (diameter * thickness), 0};

// The triangle's work until 100 N is its area without a tip of 100 N·(2·at_peak·100 N/load)/2. The last sample is at
// most one interval of 0.3 µm beyond.
TEST(DiscStrength, IsThatOfATriangle) {
  const experiments::DiscStrength found = disc_strength(triangle(0), peak, disc());
  EXPECT_DOUBLE_EQ(found.load_n, largest_load);
  EXPECT_DOUBLE_EQ(found.displacement_m, at_peak);
  EXPECT_NEAR(found.strength_pa, 2 * largest_load / (std::numbers::pi * diameter * thickness), 1e-6);
  const double tip = 0.5 * 100 * (2 * at_peak * 100 / largest_load), work = 1.5 * largest_load * at_peak - tip;
  EXPECT_NEAR(found.work_j, work, 100 * 0.3e-6);
  EXPECT_NEAR(found.fracture_energy_j_m2, work / (diameter * thickness), 0.01);
  const double slope = largest_load / (2 * at_peak), l75 = 1.5 * at_peak;
  ASSERT_TRUE(found.ct_index);
  EXPECT_NEAR(*found.slope_n_m / slope, 1, 1e-9);
  EXPECT_NEAR(*found.l75_m / l75, 1, 1e-9);
  // half as thick as the 62 mm to which the index refers
  EXPECT_NEAR(*found.ct_index / (0.5 * l75 / diameter * found.fracture_energy_j_m2 / slope * 1e6), 1, 1e-9);
}

TEST(DiscStrength, HasNoIndexIfTheLoadHardlyFalls) {
  const experiments::DiscStrength found = disc_strength(triangle(0.7), peak, disc());
  EXPECT_FALSE(found.ct_index);
  EXPECT_FALSE(found.slope_n_m);
  EXPECT_NEAR(found.work_j, largest_load * at_peak * (0.5 + 0.85 * 0.6), 1e-4);
}

struct IndirectTensileStrength : test::SceneFile {
  static std::string text(const std::string& rest = "", const std::string& crack = cracks()) {
    return "[specimen]\ndomain = \"disc\"\ndiameter = 0.016\nthickness = 0.005\n"
           "[specimen.mastic]\nradius = [0.0009, 0.0011]\nporosity = 0.05\n"
           "[materials.aggregate]\ndensity = 2000\n[materials.mastic]\ndensity = 2000\n"
           "[[contacts]]\npair = \"M-M\"\nlaw = \"elastic\"\nE = 5e9\nalpha = 0.3\n" +
           crack +
           "[[contacts]]\npair = \"M-W\"\nlaw = \"elastic\"\nE = 5e9\n"
           "[loading]\nkind = \"indirect_tensile_strength\"\ndisplacement = \"0.104 mm\"\npoints = 26\n" +
           (rest.empty() ? "[solver]\ntolerance = 1e-2\n" : rest);
  }
  static std::string cracks() {
    return "crack = {tensile_strength = 1e6, fracture_energy = 50, shear_strength = 1.5e6, friction = 0.5}\n";
  }
};

// The disc is much smaller than the length E·G_f/f_t² of 0.25 m, so its cracks are spread and it bears more than the
// tensile strength of its contacts. The sum of the energies is the work of the strips, and both strips bear the same
// load.
TEST_F(IndirectTensileStrength, SplitsADisc) {
  const Scene scene = read(text());
  const RunResult result = run(scene, folder_ / "out");
  const auto& found = std::get<experiments::SteppedResponse>(result.found);
  ASSERT_TRUE(found.disc);
  EXPECT_GT(found.disc->strength_pa, 1e6);
  EXPECT_LT(found.disc->strength_pa, 4e6);
  ASSERT_TRUE(found.increments);
  EXPECT_LT(found.increments->imbalance, 1e-7);
  const double largest = found.disc->load_n / (0.016 * 0.005);
  for (const experiments::SteppedPoint& p : found.points)
    EXPECT_NEAR(p.bottom_pa / largest, p.stress_pa / largest, 1e-6);
  EXPECT_LT(std::abs(found.points.back().stress_pa), 0.99 * largest);

  const nlohmann::json row = nlohmann::json::parse(std::ifstream(folder_ / "out" / "summary.json"))["results"][0];
  EXPECT_EQ(row["modulus"], "indirect_tension");
  EXPECT_EQ(row["indirect_tensile_strength_pa"], found.disc->strength_pa);
  EXPECT_FALSE(row.contains("strength_pa"));  // the stress of the table is no strength
  EXPECT_NEAR(found.points.back().energies.work_j / found.disc->work_j, 1, 0.02);
  EXPECT_NEAR(row["last_load_part"].get<double>() * largest / std::abs(found.points.back().stress_pa), 1, 1e-3);
  EXPECT_HAS(results_table(result), "indirect tensile strength");
  const std::string csv = test::read(folder_ / "out" / "indirect_tensile_strength.csv");
  EXPECT_HAS(csv, "time_s,strain,stress_pa,displacement_m,load_n");
}

// The test lasts some 200 times as long as a wave needs through the disc, so inertia changes the largest load little
// (measured: 0.8 %).
TEST_F(IndirectTensileStrength, IsTheSameInTimeSteps) {
  const auto strength = [&](const std::string& solver) {
    const RunResult result = run(read(text("rate = \"0.05 m/s\"\n[solver]\n" + solver)), folder_ / "out");
    return std::get<experiments::SteppedResponse>(result.found).disc.value().strength_pa;
  };
  const double by_increments = strength("tolerance = 1e-2\n");
  const double by_steps = strength("method = \"explicit\"\ngeometry = \"fixed\"\ndensity_scaling = 1\n");
  EXPECT_NEAR(by_steps / by_increments, 1, 0.02);
}

TEST_F(IndirectTensileStrength, RefusesOtherScenes) {
  const auto refusal = [&](const std::string& scene) {
    return test::message_of([&] { require_combination(read(scene)); });
  };
  EXPECT_HAS(refusal(text("", "")), "expected a law with a crack");
  EXPECT_HAS(refusal(text("[solver]\nmethod = \"harmonic\"\n")), "method in [solver]");
  std::string box = text();
  const std::string domain = "domain = \"disc\"\ndiameter = 0.016\nthickness = 0.005\n";
  box.replace(box.find(domain), domain.size(), "box = [0.01, 0.01, 0.01]\n");
  EXPECT_HAS(refusal(box), "expected \"disc\"");
  EXPECT_HAS(refusal(text("rate = \"50 mm\"\n")), "mm/min");
}

}  // namespace
}  // namespace macadam
