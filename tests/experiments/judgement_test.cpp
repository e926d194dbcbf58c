// SPDX-License-Identifier: GPL-3.0-or-later
// judgement_test.cpp  Results that cannot be right are reported as warnings or errors.
#include "host/experiments/cyclic/judgement.hpp"

#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

constexpr double stiffest = 1.5e11;  // modulus of the stiffest contact [Pa]

experiments::SteppedFrequency good_result() {
  experiments::SteppedFrequency f;
  f.frequency_hz = 20;
  f.stiffness = {1.2e10, 7};
  f.cyclic.fit_rms = 1e-4;
  f.cyclic.change_e_star = 1e-5;
  f.cyclic.change_phase_deg = 1e-3;
  f.kept = true;
  return f;
}

std::vector<std::string> warnings_of(experiments::SteppedFrequency f, std::optional<double> tolerance = 1e-3) {
  std::vector<std::string> out;
  judge(f, stiffest, tolerance, out);
  return out;
}

TEST(Judgement, AGoodResultHasNoWarning) {
  EXPECT_TRUE(warnings_of(good_result()).empty());
  EXPECT_TRUE(warnings_of(good_result(), {}).empty());
  experiments::SteppedFrequency viscous = good_result();
  viscous.stiffness.phase_deg = 90;
  EXPECT_TRUE(warnings_of(viscous, {}).empty());
}

/// A passive specimen has a phase angle of 0 to 90 degrees and is not stiffer than its stiffest contact. Other results
/// give a warning.
TEST(Judgement, WhatNoPassiveSpecimenHasIsSaid) {
  for (const double phase : {-115.0, -2.0, 92.0, 180.0}) {
    experiments::SteppedFrequency f = good_result();
    f.stiffness.phase_deg = phase;
    ASSERT_EQ(warnings_of(f, {}).size(), 1u) << phase;
    EXPECT_HAS(warnings_of(f, {})[0], "20 Hz: the phase angle is");
  }
  experiments::SteppedFrequency f = good_result();
  f.stiffness.e_star_pa = 1.1 * stiffest;
  EXPECT_HAS(warnings_of(f, {}).at(0), "but even the modulus of the stiffest contact is only 1.5e+11");
  f = good_result();
  f.cyclic.fit_rms = 20;
  EXPECT_HAS(warnings_of(f, {})[0], "the residual of the fit is 20 of the amplitude");
}

TEST(Judgement, WhatIsNoPositiveFiniteModulusIsAnError) {
  for (const double e : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    experiments::SteppedFrequency f = good_result();
    f.stiffness.e_star_pa = e;
    EXPECT_THROW(warnings_of(f), RunError) << e;
  }
}

/// If no calculation has verified that the tolerance is kept, the result does not say that it is.
TEST(Judgement, AToleranceThatNothingVerifiesIsNotCalledKept) {
  experiments::SteppedFrequency f = good_result();
  f.kept.reset();
  std::vector<std::string> warnings;
  judge(f, stiffest, 1e-3, warnings);
  EXPECT_FALSE(f.kept.has_value());
  EXPECT_HAS(warnings.at(0), "could not be verified");

  f.cyclic.change_e_star = 2e-3;  // the response is not steady yet
  judge(f, stiffest, 1e-3, warnings);
  EXPECT_EQ(f.kept, false);
  EXPECT_HAS(warnings.back(), "was certainly not met");

  f = good_result();
  f.kept = false;
  judge(f, stiffest, 1e-3, warnings);
  EXPECT_HAS(warnings.back(), "was not met");
}

// Phases are compared in radians: 0.05 degrees are 0.9e-3 rad, which is within the tolerance of 1e-3; 0.1 degrees are
// 1.7e-3.
TEST(Judgement, PhasesOfTheLastCyclesAreComparedInRadians) {
  experiments::SteppedFrequency f = good_result();
  f.kept.reset();
  std::vector<std::string> warnings;
  f.cyclic.change_phase_deg = -0.05;
  judge(f, stiffest, 1e-3, warnings);
  EXPECT_FALSE(f.kept.has_value());
  f.cyclic.change_phase_deg = -0.1;
  judge(f, stiffest, 1e-3, warnings);
  EXPECT_EQ(f.kept, false);
}

TEST(Judgement, WallsThatDisagreeWithoutInertiaAreSaid) {
  experiments::HarmonicFrequency f;
  f.frequency_hz = 20;
  f.stiffness = {1.2e10, 7};
  f.density_scaling = 0;
  f.bottom = {f.stiffness.e_star_pa * (1 + 9.8e-4), f.stiffness.phase_deg};
  std::vector<std::string> warnings;
  judge(f, stiffest, warnings);
  EXPECT_HAS(warnings.at(0), "the reactions of bottom and top wall differ by 9.8e-04");
  f.density_scaling = 1;  // with inertia the forces on the two walls may differ
  judge(f, stiffest, warnings);
  EXPECT_EQ(warnings.size(), 1u);
}

using WithoutReference = Program;

TEST_F(WithoutReference, TheStiffestContactIsThatOfThePairsThatArePresent) {
  Scene scene = read_scene(write_scene());
  const Preparation prepared = prepare(scene);
  EXPECT_DOUBLE_EQ(stiffest_contact(scene, prepared.network, 20), 1.151e11);         // A-A, elastic
  scene.laws[static_cast<std::size_t>(PairType::inner)] = laws::Elastic{1e13, 0.5};  // the specimen has no such contact
  EXPECT_DOUBLE_EQ(stiffest_contact(scene, prepared.network, 20), 1.151e11);
}

// With rule "series" a specimen may be stiffer than its mastic, whose law all contacts of this specimen have.
TEST_F(WithoutReference, WithRuleSeriesTheRockIsTheStiffest) {
  Scene scene = read_scene(write_scene());
  Preparation prepared = prepare(scene);
  for (auto& law : scene.laws) law = laws::Elastic{1e6, 1};
  prepared.network.rule = ContactRule::series;
  prepared.network.rock_modulus = 60e9;
  EXPECT_DOUBLE_EQ(stiffest_contact(scene, prepared.network, 20), 60e9);
}

// A spring and a dashpot in series that are equally stiff at 20 Hz have 1/√2 of the spring's stiffness.
TEST_F(WithoutReference, TheStiffestContactIsThatOfTheFrequency) {
  Scene scene = read_scene(write_scene());
  const Preparation prepared = prepare(scene);
  for (auto& law : scene.laws) law = laws::Elastic{1e6, 0};
  const double spring = 1e10, omega = 2 * std::numbers::pi * 20;
  scene.laws[static_cast<std::size_t>(PairType::mm)] = laws::GeneralisedKelvin{spring, spring / omega, {}, {}, 0};
  EXPECT_NEAR(stiffest_contact(scene, prepared.network, 20) / (spring / std::numbers::sqrt2), 1, 1e-12);
}

// With rock of compliance r in series, a contact with the law's stiffness k has the stiffness 1/(r + 1/k), times
// distance over length.
TEST_F(WithoutReference, TheStiffestContactHasRockInSeries) {
  Scene scene = read_scene(write_scene());
  Preparation prepared = prepare(scene);
  for (auto& law : scene.laws) law = laws::Elastic{1e9, 0.5};
  prepared.network.rule = ContactRule::series;
  for (Contact& c : prepared.network.contacts) c.length = 0.25 * c.distance, c.series = 3e-9;
  const double normal = 4 / (1e-9 + 3e-9), slip = 4 / (2e-9 + 3e-9);
  EXPECT_NEAR(stiffest_contact(scene, prepared.network, 20), std::max(normal, slip), 1e-12 * normal);
}

// If a particle has no contacts, a run cannot be checked against a harmonic solution. The specimens here are so heavy
// that they are driven far above their resonance, so their results cannot be right.
TEST_F(WithoutReference, ARunWithAToleranceFailsWhereItsResultCannotBeRight) {
  const std::string loose = "[network]\ngap_max = -0.2\n";
  for (const char* scaling : {"1e6", "1e7", "1e9"}) {
    write_scene(fmt::format("tolerance = 1e-2\ndensity_scaling = {}\n", scaling), loose);
    EXPECT_EQ(run_quick("heavy").code, 1) << scaling;
  }
  const Outcome heavy = run_quick("heavy");
  EXPECT_EQ(heavy.code, 1);
  EXPECT_HAS(heavy.err, "the result cannot meet the tolerance of 0.01");
  const auto failed = summary("heavy");
  EXPECT_EQ(failed.at("status").get<std::string>().rfind("failed: 20 Hz", 0), 0u);
  EXPECT_EQ(failed.at("results").at(0).at("tolerance_kept"), false);
  EXPECT_GE(failed.at("warnings").size(), 2u);

  write_scene("tolerance = 1e-2\n", loose);
  const Outcome outcome = run_quick("out");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_HAS(outcome.out,
             "warning: 20 Hz: there is no harmonic solution to compare with, so the tolerance could not be verified");
  EXPECT_TRUE(summary("out").at("results").at(0).at("tolerance_kept").is_null());
}

}  // namespace
}  // namespace macadam::test
