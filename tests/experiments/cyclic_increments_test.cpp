// SPDX-License-Identifier: GPL-3.0-or-later
// cyclic_increments_test.cpp  Tests scenes of cyclic tests that are followed by increments without inertia: results
// against the frequency domain, cracks, interruptions, and the contents of summary.json.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "macadam/overrides.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_folder.hpp"

namespace macadam::test {
namespace {

using experiments::SteppedCyclic;

const std::string cyclic = "kind = \"cyclic\"\nfrequencies = [2.0, 20.0]\n";
const std::string increments = "method = \"quasi_static\"\n";

class CyclicIncrements : public TestFolder {
 protected:
  nlohmann::json result(const std::string& name, std::size_t k) const {
    return nlohmann::json::parse(read(out(name) / "summary.json")).at("results").at(k);
  }
  nlohmann::json solver(const std::string& name) const {
    return nlohmann::json::parse(read(out(name) / "summary.json")).at("solver");
  }
  /// Returns a scene of t8 whose mastic can crack.
  Scene cracking(const std::string& loading) const {
    std::string text = read(write_t8(loading, increments + "tolerance = 1e-2\n"));
    const std::string chain = "alpha = 0.10\n";
    for (std::size_t at = text.find(chain); at != std::string::npos; at = text.find(chain, at + 1))
      text.insert(at, "crack = { tensile_strength = \"1 MPa\", fracture_energy = 50 }\n"), at += 70;
    write(folder_ / "cracking.toml", text);
    return read_scene(folder_ / "cracking.toml");
  }
};

// The number of increments follows from the tolerance.
TEST_F(CyclicIncrements, HaveTheModulusOfTheFrequencyDomainToTheTolerance) {
  const RunResult known = run(read_scene(write_t8(cyclic, "method = \"harmonic\"\n")), out("known"));
  const auto& want = std::get<experiments::HarmonicCyclic>(known.found).frequencies;
  for (const double tolerance : {1e-2, 1e-3}) {
    const RunResult found =
        run(read_scene(write_t8(cyclic, increments + fmt::format("tolerance = {}\n", tolerance))), out("found"));
    const auto& frequencies = std::get<SteppedCyclic>(found.found).frequencies;
    ASSERT_EQ(frequencies.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      const Stiffness &a = frequencies[k].stiffness, &b = want[k].stiffness;
      EXPECT_LT(std::abs(a.e_star_pa / b.e_star_pa - 1), tolerance);
      EXPECT_LT(std::abs(a.phase_deg - b.phase_deg) * std::numbers::pi / 180, tolerance);
      EXPECT_EQ(frequencies[k].start, Start::steady);
      EXPECT_TRUE(frequencies[k].kept.value_or(false));
      ASSERT_TRUE(frequencies[k].increments);
      // a period of n increments has the error (2π/n)²/12, of which half the tolerance is used
      const int least = static_cast<int>(2 * std::numbers::pi / std::sqrt(6 * tolerance));
      EXPECT_GE(frequencies[k].increments->increments, least);
      EXPECT_LE(frequencies[k].increments->increments, std::max(40, least + 4));
    }
  }
}

TEST_F(CyclicIncrements, ReportIncrementsAndNoSteps) {
  run(read_scene(write_t8(cyclic, increments)), out("out"));
  const nlohmann::json found = result("out", 0);
  EXPECT_EQ(found.at("method"), "quasi_static");
  for (const char* key :
       {"increments", "linear_systems", "repeated_increments", "largest_residual", "difference_from_harmonic"})
    EXPECT_TRUE(found.contains(key)) << key;
  for (const char* key : {"dt_s", "steps", "density_scaling"}) {
    EXPECT_FALSE(found.contains(key)) << key;
    EXPECT_FALSE(solver("out").contains(key)) << key;
  }
}

TEST_F(CyclicIncrements, ContinueToTheSameResult) {
  const Scene scene = read_scene(write_t8(cyclic + "start = \"rest\"\ncycles = 2\n", increments));
  run(scene, out("one"));
  int interrupted = 0;
  for (const int asked : {30, 100, 1'000'000}) interrupted += run_until(scene, "pieces", asked, interrupted > 0);
  EXPECT_GT(interrupted, 0);
  EXPECT_EQ(read(out("pieces") / "response.csv"), read(out("one") / "response.csv"));
  EXPECT_EQ(result("pieces", 1).at("linear_systems"), result("one", 1).at("linear_systems"));
}

// Cracks grow in the first cycle, so that later cycles are softer.
TEST_F(CyclicIncrements, ReportTheModulusOfEachCycleWithCracks) {
  const Scene scene =
      cracking("kind = \"cyclic\"\nfrequencies = [20.0]\nstrain_amplitude = 3e-4\ncycles = 3\nfit_cycles = 1\n");
  run(scene, out("cracks"));
  run(cracking("kind = \"cyclic\"\nfrequencies = [20.0]\nstrain_amplitude = 1e-6\ncycles = 3\nfit_cycles = 1\n"),
      out("intact"));
  const nlohmann::json cracked = result("cracks", 0).at("by_cycle"), intact = result("intact", 0).at("by_cycle");
  ASSERT_EQ(cracked.size(), 3u);
  ASSERT_EQ(intact.size(), 3u);
  const double last = cracked.back().at("e_star_pa"), fitted = result("cracks", 0).at("e_star_pa");
  EXPECT_NEAR(last, fitted, 1e-12 * fitted);  // the same samples
  EXPECT_LT(last, 0.9 * intact.back().at("e_star_pa").get<double>());
}

// A scene with keys of time steps may be run by increments through the command line.
TEST_F(CyclicIncrements, NameTheKeysOfTimeStepsThatAreNotUsed) {
  for (const std::string& loading : {cyclic, std::string("kind = \"monotonic\"\nrate = 1e-3\nstrain = 1e-5\n")}) {
    Scene scene = read_scene(write_t8(loading, "method = \"explicit\"\ndensity_scaling = 100.0\n"));
    Overrides instead;
    instead.method = SolverMethod::quasi_static;
    apply(instead, scene);
    run(scene, out("out"));
    EXPECT_HAS(solver("out").at("decisions").dump(), "not used: density_scaling");
  }
  for (const char* key : {"dt_s", "steps", "density_scaling", "kinetic_share", "fit_deviation_pa"})
    EXPECT_FALSE(result("out", 0).contains(key)) << key;
}

}  // namespace
}  // namespace macadam::test
