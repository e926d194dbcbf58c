// SPDX-License-Identifier: GPL-3.0-or-later
// tolerance_test.cpp  Tests the key `tolerance` in [solver]: the error of a run stays below the tolerance and agrees
// with the predicted error.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/run/error_model.hpp"
#include "tests/support/cluster_specimens.hpp"

namespace macadam::test {
namespace {

class Tolerance : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) /
        fmt::format("macadam_tolerance_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static Scene scene_of(SpecimenSpec specimen, double tolerance) {
    Scene scene;
    scene.specimen = std::move(specimen);
    scene.materials = {2630, 2110};
    scene.laws = am1_laws();
    scene.cyclic().frequencies = {2, 5, 10, 20};
    scene.solver.tolerance = tolerance;
    scene.solver.backend = Backend::cpu;
    scene.solver.threads = 1;
    return scene;
  }
  static SpecimenSpec t8() {
    SpecimenSpec spec;
    spec.file = MACADAM_TEST_DATA "/t8.csv";
    spec.box.size = {0.008, 0.008, 0.011};
    return spec;
  }
  /// Returns a recipe of mastic and a few aggregates in a small box.
  static SpecimenSpec fresh(std::uint64_t seed) {
    SpecimenSpec spec = read_scene(MACADAM_EXAMPLES "/demo/scene.toml").specimen;
    spec.seed = seed;
    spec.box.size = {0.012, 0.012, 0.016};
    spec.aggregate = {{2e-3, 4.75e-3, 0.25, std::nullopt}};
    return spec;
  }
  const std::filesystem::path& folder() const { return folder_; }
  RunResult run_it(const Scene& scene) const { return run(scene, folder_); }
  nlohmann::json summary() const { return nlohmann::json::parse(std::ifstream(folder_ / "summary.json")); }

  void expect_kept(const Scene& scene) const {
    const RunResult result = run_it(scene);
    for (const experiments::SteppedFrequency& f : result.stepped().frequencies) {
      ASSERT_TRUE(f.achieved && f.predicted);
      EXPECT_LE(largest(*f.achieved), *scene.solver.tolerance) << f.frequency_hz << " Hz";
      // Most of the tolerance must be used, because a run becomes faster with the square root of the inertia that is
      // allowed.
      EXPECT_GE(largest(*f.achieved), 0.5 * *scene.solver.tolerance) << f.frequency_hz << " Hz";
      EXPECT_NEAR(f.achieved->e_star, f.predicted->e_star, 0.05 * *scene.solver.tolerance);
      EXPECT_NEAR(f.achieved->phase_rad, f.predicted->phase_rad, 0.05 * *scene.solver.tolerance);
    }
  }

 private:
  std::filesystem::path folder_;
};

// At a tolerance of 0.1 the effect of inertia is not linear any more, so the first estimate of the scaling may be
// wrong.
TEST_F(Tolerance, IsKeptOnT8) {
  for (const double tolerance : long_tests ? std::vector{1e-1, 1e-2, 1e-3, 1e-4} : std::vector{1e-1, 1e-2}) {
    SCOPED_TRACE(tolerance);
    expect_kept(scene_of(t8(), tolerance));
  }
}

TEST_F(Tolerance, IsKeptOnFreshSpecimens) {
  for (unsigned s = test_seed(); s < test_seed() + (long_tests ? 2 : 1); ++s) {
    for (const double tolerance : long_tests ? std::vector{1e-2, 1e-3, 1e-4} : std::vector{1e-2}) {
      SCOPED_TRACE(fmt::format("seed {}, tolerance {}", s, tolerance));
      expect_kept(scene_of(fresh(s), tolerance));
    }
  }
}

// In clusters, stiff contacts are closest to soft ones. The Kelvin units of AM2 relax within a cycle, those of AM1
// within seconds.
TEST_F(Tolerance, IsKeptOnClustersWithBothMixes) {
  for (const Laws& laws : {am1_laws(), am2_laws()}) {
    for (const double tolerance : long_tests ? std::vector{1e-2, 1e-3} : std::vector{1e-2}) {
      SCOPED_TRACE(fmt::format("tolerance {}, E_m of M-M {:.4g}", tolerance,
                               std::get<laws::GeneralisedKelvin>(*laws[int(PairType::mm)]).E_m));
      Scene scene = scene_of(cluster_recipe(test_seed(), {0.012, 0.012, 0.016}), tolerance);
      scene.laws = laws;
      scene.cyclic().frequencies = long_tests ? std::vector{2.0, 20.0} : std::vector{20.0};
      expect_kept(scene);
    }
  }
}

TEST_F(Tolerance, IsKeptOnTheDemo) {
  if (!long_tests) GTEST_SKIP() << "some ten thousand steps of 2,391 particles";
  expect_kept(scene_of(read_scene(MACADAM_EXAMPLES "/demo/scene.toml").specimen, 1e-2));
}

// On CUDA the viscoelastic states are updated once per block of several steps. The blocks are as long as the tolerance
// allows, and the plan states how often the states are updated.
TEST_F(Tolerance, IsKeptInBlocksOfStepsOnCuda) {
  if (report_backends().devices.empty()) GTEST_SKIP() << report_backends().cuda_status;
  Scene scene = scene_of(t8(), 1e-3);
  scene.solver.backend = Backend::cuda;
  scene.solver.precision = Precision::mixed;
  expect_kept(scene);
  const std::string decisions = summary().at("solver").at("decisions").dump();
  EXPECT_NE(decisions.find("viscoelastic states are not updated in every step but 315 times"), std::string::npos)
      << decisions;  // 2π/√(20·0.02·1e-3)
}

TEST_F(Tolerance, GivenSettingsWin) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.solver.density_scaling = std::vector<double>{2e4};
  scene.solver.precision = Precision::double_;
  scene.solver.geometry = Geometry::updated;
  scene.solver.form = ContactForm::points;
  scene.cyclic().cycles = 2;
  const RunResult result = run_it(scene);
  EXPECT_EQ(result.stepped().frequencies[0].density_scaling, 2e4);
  EXPECT_EQ(result.stepped().frequencies[0].cycles, 2);
  EXPECT_EQ(result.stepped().precision, Precision::double_);
  EXPECT_EQ(result.stepped().geometry, Geometry::updated);
  EXPECT_EQ(result.stepped().form, ContactForm::points);
  EXPECT_NEAR(result.stepped().frequencies[0].achieved->e_star, result.stepped().frequencies[0].predicted->e_star,
              1e-5);
  const auto json = summary();
  EXPECT_EQ(json.at("results").at(0).at("start"), "steady");
  EXPECT_EQ(json.at("solver").at("tolerance"), 1e-2);
  EXPECT_FALSE(json.at("solver").at("decisions").empty());
  EXPECT_FALSE(json.at("skips").empty());
}

bool says(const RunResult& result, const std::string& what) {
  return std::any_of(result.decisions.begin(), result.decisions.end(),
                     [&](const std::string& d) { return d.find(what) != std::string::npos; });
}

// Local damping is not linear, so the run starts with a ramp from rest although the scene asks for a steady start. The
// result states the start from rest.
TEST_F(Tolerance, WhatIsNotLinearStartsFromRest) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.cyclic().start = Start::steady;
  scene.solver.damping_kind = Damping::local;
  scene.solver.damping = 0.02;
  const RunResult result = run_it(scene);
  const experiments::SteppedFrequency& f = result.stepped().frequencies[0];
  EXPECT_EQ(f.start, Start::rest);
  EXPECT_GE(f.cycles, 4);
  EXPECT_TRUE(f.kept.value());
  EXPECT_TRUE(says(result, "local damping is not linear"));
  EXPECT_TRUE(says(result, "from rest, although the scene asks for a steady start"));
}

// With one point per facet and fewer contacts, two particles can rotate freely. The harmonic solution does not exist,
// but time stepping reaches a steady state, so the run can only estimate its error.
TEST_F(Tolerance, WithoutAHarmonicSolutionAnEstimateDecides) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.network.quadrature = Quadrature::one_point;
  scene.network.gap_max = -0.14;
  const RunResult result = run_it(scene);
  const experiments::SteppedFrequency& f = result.stepped().frequencies[0];
  EXPECT_EQ(f.start, Start::rest);
  EXPECT_FALSE(f.achieved || f.predicted || f.kept);
  EXPECT_GT(f.density_scaling, 100);
  EXPECT_TRUE(says(result, "no harmonic solution"));
  EXPECT_EQ(result.stepped().form, ContactForm::points);
  ASSERT_EQ(result.warnings.size(), 1u) << testing::PrintToString(result.warnings);
  EXPECT_NE(result.warnings[0].find("could not be verified"), std::string::npos) << result.warnings[0];
}

// A mechanism has no static modulus. Time stepping measures only the response of the mechanism's inertia, whose phase
// is about 150 degrees, so the run must fail.
TEST_F(Tolerance, AMechanismIsAFailedRun) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.network.quadrature = Quadrature::one_point;
  for (auto& law : scene.laws) std::visit([](auto& l) { l.alpha = 0; }, *law);
  try {
    run_it(scene);
    FAIL() << "a mechanism was given a modulus";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("the phase angle is"), std::string::npos) << error.what();
  }
}

// If settings of the scene prevent the run from keeping the tolerance, the result states that the tolerance was missed.
TEST_F(Tolerance, AMissIsSaid) {
  Scene scene = scene_of(t8(), 1e-3);
  scene.cyclic().frequencies = {20};
  scene.solver.density_scaling = std::vector<double>{5e4};
  EXPECT_FALSE(run_it(scene).stepped().frequencies[0].kept.value());
  EXPECT_EQ(summary().at("results").at(0).at("tolerance_kept"), false);
}

TEST_F(Tolerance, AGivenStepHasTheScalingThatItNeeds) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.solver.time_step = 5e-6;
  const experiments::SteppedFrequency f = run_it(scene).stepped().frequencies[0];
  EXPECT_TRUE(f.kept.value());
  EXPECT_LT(f.density_scaling, 1e4);
  EXPECT_NEAR(f.dt_s, 5e-6, 5e-7);
}

// Without a tolerance, steps are as long as stability permits, but must resolve a decay of exp(-t / 20 us), unless the
// scene sets the step.
TEST_F(Tolerance, StepsFollowTheDecayOfViscousDamping) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.cyclic().cycles = 1;
  scene.solver.tolerance = std::nullopt;
  scene.solver.density_scaling = std::vector<double>{1e6};
  EXPECT_GT(run_it(scene).stepped().frequencies[0].dt_s, 2e-5);
  scene.solver.damping_kind = Damping::viscous;
  scene.solver.damping = 5e4;
  EXPECT_NEAR(run_it(scene).stepped().frequencies[0].dt_s, 2e-5, 1e-6);
  scene.solver.density_scaling = std::vector<double>{1e7};
  scene.solver.time_step = 1e-4 / 3;  // three steps per sample
  EXPECT_NEAR(run_it(scene).stepped().frequencies[0].dt_s, 1e-4 / 3, 1e-9);
}

// At large strain the run updates the geometry, and reports that the harmonic solution does not update it.
TEST_F(Tolerance, LargeStrainsAreNotLinear) {
  Scene scene = scene_of(t8(), 1e-3);
  scene.cyclic().frequencies = {20};
  scene.cyclic().strain_amplitude = 0.01;
  const RunResult result = run_it(scene);
  EXPECT_EQ(result.stepped().geometry, Geometry::updated);
  EXPECT_TRUE(says(result, "not linear at this strain"));
  EXPECT_EQ(result.stepped().frequencies[0].start, Start::rest);
  EXPECT_TRUE(says(result, "the load grows over 1 cycle"));
}

// The scene asks for the initial geometry. The run then agrees with the harmonic solution, but it misses the tolerance,
// because the strain is large.
TEST_F(Tolerance, AFixedGeometryAtLargeStrainIsAMiss) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.cyclic().strain_amplitude = 0.1;
  scene.solver.geometry = Geometry::fixed;
  const experiments::SteppedFrequency f = run_it(scene).stepped().frequencies[0];
  EXPECT_LE(largest(*f.achieved), 1e-2);
  EXPECT_FALSE(f.kept.value());
}

// The error that fixed geometry causes is below the stated error, and not far below it.
TEST_F(Tolerance, FixedGeometryCostsWhatIsStated) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.solver.tolerance = std::nullopt;
  scene.solver.density_scaling = std::vector<double>{1e4};
  scene.cyclic().frequencies = {20};
  scene.cyclic().start = Start::steady;
  scene.cyclic().cycles = 4;
  scene.cyclic().strain_amplitude = 3e-3;
  const auto modulus = [&](Geometry geometry) {
    scene.solver.geometry = geometry;
    return run_it(scene).stepped().frequencies[0].stiffness.e_star_pa;
  };
  const double change = std::abs(modulus(Geometry::fixed) / modulus(Geometry::updated) - 1);
  EXPECT_LT(change, fixed_geometry_error(3e-3));
  EXPECT_GT(change, 0.1 * fixed_geometry_error(3e-3));
}

// A start from rest without a ramp is stated in the list of decisions.
TEST_F(Tolerance, AStartWithoutARampIsSaid) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.cyclic().start = Start::rest;
  scene.cyclic().cycles = 1;
  const RunResult result = run_it(scene);
  EXPECT_TRUE(says(result, "without a ramp"));
  EXPECT_TRUE(says(result, "the run starts from rest"));
  EXPECT_FALSE(says(result, "starts in the steady state of the harmonic solution"));
}

// If the ramp leaves no cycle for the fit, the run is longer.
TEST_F(Tolerance, TheFittedCyclesLieAfterTheRamp) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.solver.tolerance = std::nullopt;
  scene.solver.density_scaling = std::vector<double>{5e4};
  scene.cyclic().ramp_cycles = 4;
  EXPECT_EQ(run_it(scene).stepped().frequencies[0].cycles, 6);
}

// If the response is not requested, only the fitted cycles are sampled; the result is the same.
TEST_F(Tolerance, AResponseNobodyAskedForIsNotObserved) {
  Scene scene = scene_of(t8(), 1e-2);
  scene.cyclic().frequencies = {20};
  scene.cyclic().start = Start::rest;
  scene.cyclic().cycles = 5;
  const RunResult with = run_it(scene);
  EXPECT_TRUE(std::filesystem::exists(folder() / "response.csv"));
  scene.output.response = false;
  const RunResult without = run_it(scene);
  EXPECT_FALSE(std::filesystem::exists(folder() / "response.csv"));
  EXPECT_EQ(without.stepped().frequencies[0].stiffness.e_star_pa, with.stepped().frequencies[0].stiffness.e_star_pa);
  EXPECT_EQ(without.stepped().frequencies[0].stiffness.phase_deg, with.stepped().frequencies[0].stiffness.phase_deg);
  EXPECT_EQ(without.stepped().frequencies[0].cyclic.change_e_star, with.stepped().frequencies[0].cyclic.change_e_star);
}

}  // namespace
}  // namespace macadam::test
