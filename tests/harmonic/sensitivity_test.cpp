// SPDX-License-Identifier: GPL-3.0-or-later
// sensitivity_test.cpp  Compares derivatives of |E*| and phase that are computed from one harmonic solution with
// central differences of two solutions.
#include "macadam/sensitivity.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cluster_specimens.hpp"
#include "host/run/error_model.hpp"
#include "host/experiments/cyclic/scaling.hpp"
#include "macadam/harmonic.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

constexpr double frequency = 5;

HarmonicResult solve(const TestScene& scene, const Laws& laws, double density_scaling) {
  return Harmonic(scene.specimen, scene.network, laws, scene.inertia, {}, frequency).solve(frequency, density_scaling);
}

/// Returns the laws with one parameter multiplied by `factor`.
Laws changed(Laws laws, const std::string& parameter, double factor) {
  const std::size_t dot = parameter.find('.');
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair] || to_string(static_cast<PairType>(pair)) != parameter.substr(0, dot)) continue;
    const std::string name = parameter.substr(dot + 1);
    if (auto* e = std::get_if<laws::Elastic>(&*laws[pair])) {
      if (name == "E" || name == "delta") e->E *= factor;
      if (name == "alpha") e->alpha *= factor;
      continue;
    }
    auto& k = std::get<laws::GeneralisedKelvin>(*laws[pair]);
    const bool all = name == "delta";
    if (all || name == "E_m") k.E_m *= factor;
    if (all || name == "C_m") k.C_m *= factor;
    for (std::size_t l = 0; l < k.E.size(); ++l) {
      if (all || name == "E_" + std::to_string(l + 1)) k.E[l] *= factor;
      if (all || name == "C_" + std::to_string(l + 1)) k.C[l] *= factor;
    }
    if (name == "alpha") k.alpha *= factor;
  }
  return laws;
}

/// Compares the derivatives with central differences. With a step of 1e-4 in the logarithm of a parameter, these
/// differences have two errors: (1e-4)²/6 of the third derivative, and the rounding of the solutions, 1e-12, divided by
/// the step. A tolerance of 1e-6 of |E*| and of 1e-6 rad covers both errors.
void expect_derivatives(const TestScene& scene, double density_scaling) {
  constexpr double step = 1e-4, tolerance = 1e-6;
  const HarmonicResult here = solve(scene, scene.laws, density_scaling);
  const auto found = sensitivities(here.parts, scene.laws, std::complex<double>(0, 2 * std::numbers::pi * frequency));
  EXPECT_GT(found.size(), 15u);
  for (const Sensitivity& s : found) {
    HarmonicResult sides[2];
    for (int side = 0; side < 2; ++side) {
      const double factor = std::exp(side == 0 ? -step : step);
      const bool mass = s.parameter == "density_scaling";
      sides[side] = solve(scene, mass ? scene.laws : changed(scene.laws, s.parameter, factor),
                          mass ? factor * density_scaling : density_scaling);
    }
    EXPECT_NEAR(s.d_e_star_pa, (sides[1].top.e_star_pa - sides[0].top.e_star_pa) / (2 * step),
                tolerance * here.top.e_star_pa)
        << s.parameter;
    EXPECT_NEAR(s.d_phase_deg, (sides[1].top.phase_deg - sides[0].top.phase_deg) / (2 * step), 60 * tolerance)
        << s.parameter;
  }
}

TEST(Sensitivity, OfT8AgainstCentralDifferences) {
  const TestScene scene = make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}}));
  for (const double density_scaling : {0.0, 1e5}) expect_derivatives(scene, density_scaling);
}

TEST(Sensitivity, OfClustersAgainstCentralDifferences) {
  const TestScene scene = make_scene(few_clusters(3));
  ASSERT_GT(scene.network.count[static_cast<std::size_t>(PairType::inner)], 0);
  for (const double density_scaling : {0.0, 1e5}) expect_derivatives(scene, density_scaling);
}

// Multiplying all moduli by a number multiplies |E*| and keeps the phase. The fractions of the modulus that the pair
// types carry add up to 1.
TEST(Sensitivity, AllDeltasTogetherScaleTheModulus) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  const HarmonicResult r = solve(scene, scene.laws, 0);
  double e_star = 0, phase = 0, share = 0;
  for (const Sensitivity& s :
       sensitivities(r.parts, scene.laws, std::complex<double>(0, 2 * std::numbers::pi * frequency))) {
    if (!s.parameter.ends_with(".delta")) continue;
    e_star += s.d_e_star_pa;
    phase += s.d_phase_deg;
  }
  for (const double part : shares(r.parts)) share += part;
  EXPECT_NEAR(e_star / r.top.e_star_pa, 1, 1e-13);
  EXPECT_NEAR(phase, 0, 1e-11);
  EXPECT_NEAR(share, 1, 1e-13);
}

using SensitivityCommand = Program;

TEST_F(SensitivityCommand, AreWrittenWhereTheSceneAsks) {
  write_scene("method = \"harmonic\"\n");
  ASSERT_EQ(run_quick("without").code, 0);
  EXPECT_FALSE(summary("without").at("results").at(0).contains("sensitivities"));
  write_scene("method = \"harmonic\"\n", "[output]\nsensitivities = true\n");
  ASSERT_EQ(run_quick("out").code, 0);
  const auto result = summary("out").at("results").at(0);
  double sum = 0;
  for (const auto& [pair, share] : result.at("shares").items()) sum += share.get<double>();
  EXPECT_NEAR(sum, 1, 1e-12);
  std::vector<std::string> names;
  for (const auto& s : result.at("sensitivities")) names.push_back(s.at("parameter"));
  for (const char* name : {"M-M.E_m", "M-A.C_3", "A-A.E", "M-W.delta", "M-A.alpha"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
  EXPECT_EQ(std::count(names.begin(), names.end(), "M-W.alpha"), 0);  // its value is 0
}

// The largest density scaling is predicted from a derivative. It must change the modulus by the wanted amount, with an
// error of the order of the square of the change.
TEST(Scaling, IsAsLargeAsAChangeOfTheModulusAllows) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, frequency);
  const HarmonicResult known = harmonic.solve(frequency, 1);
  for (const double wanted : {1e-6, 1e-4, 1e-2}) {
    for (const double viscous : {0.0, 30.0}) {
      const double scaling = largest_scaling(known, viscous, wanted);
      EXPECT_GT(scaling, 1);
      const HarmonicResult scaled = harmonic.solve(frequency, scaling, viscous);
      const double reached = largest(difference(scaled.top, known.top));
      // A change of the modulus by 1e-6 is itself accurate to 1e-4 only.
      EXPECT_NEAR(reached / wanted, 1, 3 * wanted + 1e-4) << wanted << " " << viscous;
    }
  }
  EXPECT_EQ(largest_scaling(known, 1e9, 1e-6), 1);  // damping alone changes the modulus by more than is allowed
}

}  // namespace
}  // namespace macadam::test
