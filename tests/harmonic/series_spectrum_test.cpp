// SPDX-License-Identifier: GPL-3.0-or-later
// series_spectrum_test.cpp  Relaxation of networks whose contacts have rock in series with their laws: a closed form,
// the error of the classes to which the contacts belong, and comparisons with solutions of the whole network.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "host/harmonic/reduced_model.hpp"
#include "macadam/error.hpp"
#include "macadam/spectrum.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using Complex = std::complex<double>;
using harmonic::ReducedModel;

/// Returns a random specimen with the laws of mastic and rock. Contacts of the mastic have random lengths and rock in
/// series, films between aggregates down to 1e-4 of the distance.
TestScene scene_with_rock(unsigned seed) {
  laws::GeneralisedKelvin mastic = mastic_am1(), film = mastic;
  mastic.alpha = 1, film.alpha = 0.2308;
  Laws laws = same_law(laws::Elastic{6e10, 1});
  for (const PairType pair : {PairType::mm, PairType::ma, PairType::mw}) laws[static_cast<std::size_t>(pair)] = mastic;
  laws[static_cast<std::size_t>(PairType::aa)] = film;
  TestScene scene = make_scene(random_specimen(seed), {}, laws);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (Contact& c : scene.network.contacts) {
    const double x = uniform(random), d = c.distance;
    if (c.pair == PairType::inner || c.pair == PairType::aw || (c.pair == PairType::mm && x < 0.5)) continue;
    c.length = c.pair == PairType::aa ? d * std::pow(1e-4, x) : d * (0.05 + 0.95 * x);
    c.series = (d - c.length) / (c.length * 6e10);
  }
  return scene;
}

Complex modulus(const TestScene& scene, const HarmonicLoad& load) {
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.typical_growth = std::abs(load.s())},
                    0);
  return harmonic.solve(std::vector{load}).front().parts.modulus();
}

// A column of two spheres between the walls: the compliances of three chains and three springs add up.
TEST(SeriesSpectrum, OfAColumnIsTheClosedForm) {
  Specimen specimen;
  specimen.box.size = {2e-3, 2e-3, 4e-3};
  for (const double z : {1e-3, 3e-3}) {
    specimen.centre.push_back({1e-3, 1e-3, z});
    specimen.radius.push_back(1e-3);
    specimen.phase.push_back(Phase::mastic);
    specimen.body.push_back(-1);
  }
  const laws::GeneralisedKelvin law = mastic_am1();
  TestScene scene = make_scene(specimen, {}, same_law(law));
  double chains = 0, springs = 0;  // Σ length/area, Σ r·length/area
  for (Contact& c : scene.network.contacts) {
    c.length = 0.4 * c.distance;
    c.series = c.b < 0 ? 3e-11 : 2e-10;
    chains += c.length / c.moments.a, springs += c.series * c.length / c.moments.a;
  }
  const Spectrum found = spectrum_of(scene.specimen, scene.network, scene.laws);
  const double area_over_height = 4e-6 / 4e-3;
  for (const double t : {1e-3, 0.1, 1.0, 100.0, 1e4}) {
    double creep = 1 / law.E_m + t / law.C_m;
    for (std::size_t l = 0; l < law.E.size(); ++l) creep -= std::expm1(-t * law.E[l] / law.C[l]) / law.E[l];
    // The contacts of a class have one compliance, so the classes are exact. The tolerance is the accuracy of the
    // series, whose exponentials have rounded times.
    EXPECT_NEAR(found.creep.compliance(t) / (area_over_height * (creep * chains + springs)), 1, 1e-8) << t;
  }
}

// The classes make the contacts softer, by at most the stated fraction. So at real s > 0, where all stiffnesses are
// positive, E* is too small by at most this fraction. 1e-9 allows for the residuals of the solutions.
TEST(SeriesSpectrum, ErrorOfTheClassesIsAsStated) {
  const TestScene scene = scene_with_rock(3);
  std::vector<HarmonicLoad> loads;
  for (const double growth : {1e-3, 0.1, 10.0, 1e3, 1e8}) loads.push_back({.growth = growth});
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.typical_growth = 1}, 0);
  const std::vector<HarmonicResult> solved = harmonic.solve(loads);
  double before = 1;
  for (const double spacing : {0.4, 0.1, 0.02}) {
    ReducedModel model(scene.specimen, scene.network, {}, {scene.laws, spacing, 1});
    for (const HarmonicResult& r : solved) model.add({r.motion});
    const double stated = model.rock().error();
    EXPECT_NEAR(stated, spacing * spacing / 16, 0.01 * stated);  // tanh² of a small number
    double largest = 0;
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const double exact = solved[i].parts.modulus().real();
      const double error = 1 - model.solve(scene.laws, loads[i]).parts.modulus().real() / exact;
      EXPECT_GE(error, -1e-9) << loads[i].growth;
      EXPECT_LE(error, stated + 1e-9) << loads[i].growth;
      largest = std::max(largest, error);
    }
    EXPECT_LT(largest, before / 4) << "second order in the spacing";
    before = largest;
  }
}

// At the laws of a solution the parts of E* agree as well, with a change of the rock too. The stated error holds for
// real s. A tolerance of four times this error allows for complex stiffnesses and for the rock's parts, which are of
// second degree in the stiffness.
TEST(SeriesSpectrum, PartsOfTheReducedModelAreThoseOfTheSolution) {
  TestScene scene = scene_with_rock(4);
  ReducedModel model(scene.specimen, scene.network, {}, {scene.laws, 0.01, 4});
  for (const double rock : {1.0, 0.5, 2.0}) {
    TestScene changed = scene;
    for (Contact& c : changed.network.contacts) c.series *= rock;
    const HarmonicLoad load{.frequency_hz = 2};
    const HarmonicResult solved = Harmonic(changed.specimen, changed.network, changed.laws, changed.inertia, {}, 2)
                                      .solve(std::vector{load})
                                      .front();
    model.add({solved.motion});
    const ModulusParts found = model.solve(scene.laws, load, rock).parts;
    const double tolerance = 4 * model.rock().error() * std::abs(solved.parts.modulus());
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      EXPECT_LT(std::abs(found.normal[pair] - solved.parts.normal[pair]), tolerance) << pair;
      EXPECT_LT(std::abs(found.shear[pair] - solved.parts.shear[pair]), tolerance) << pair;
      EXPECT_LT(std::abs(found.normal_rock[pair] - solved.parts.normal_rock[pair]), tolerance) << pair;
      EXPECT_LT(std::abs(found.shear_rock[pair] - solved.parts.shear_rock[pair]), tolerance) << pair;
    }
  }
}

TEST(SeriesSpectrum, AgreesWithSolutionsWithinTheStatedError) {
  const TestScene scene = scene_with_rock(test_seed());
  for (const double tolerance : {1e-3, 1e-5}) {
    SpectrumOptions options;
    options.shortest = 1e-2, options.longest = 1e2, options.tolerance = tolerance;
    const Spectrum found = spectrum_of(scene.specimen, scene.network, scene.laws, options);
    const double stated = std::max(found.error, found.checked);
    EXPECT_LE(stated, tolerance);
    EXPECT_GT(found.error, 0.1 * tolerance) << "it contains the error of the classes";
    for (const HarmonicLoad& load : {HarmonicLoad{.growth = 0.01},
                                     {.growth = 1},
                                     {.growth = 100},
                                     {.frequency_hz = 0.003},
                                     {.frequency_hz = 0.2},
                                     {.frequency_hz = 10}}) {
      EXPECT_LT(std::abs(found.relaxation.stiffness(load.s()) / modulus(scene, load) - 1.0), stated) << load.s();
    }
  }
}

TEST(SeriesSpectrum, ToleranceBelowThatOfTheClassesIsRefused) {
  const TestScene scene = scene_with_rock(3);
  SpectrumOptions options;
  options.tolerance = 1e-8;
  EXPECT_THROW(spectrum_of(scene.specimen, scene.network, scene.laws, options), InputError);
}

TEST(SeriesSpectrum, ClassesNeedALaw) {
  const TestScene scene = scene_with_rock(3);
  EXPECT_THROW(ReducedModel(scene.specimen, scene.network, {}), InputError);
}

}  // namespace
}  // namespace macadam::test
