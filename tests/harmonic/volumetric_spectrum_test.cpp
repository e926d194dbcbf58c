// SPDX-License-Identifier: GPL-3.0-or-later
// volumetric_spectrum_test.cpp  Relaxation and creep of specimens with the rule "volumetric": closed forms of specimens
// of one material and of bars of mastic, and comparisons with solutions of the whole network.
#include <gtest/gtest.h>

#include <cmath>

#include "host/spectrum/volumetric_spectrum.hpp"
#include "macadam/error.hpp"
#include "tests/support/volumetric_scene.hpp"

namespace macadam::test {
namespace {

using Complex = std::complex<double>;

/// Returns J(t) of a chain, from its springs and dashpots [1/Pa].
double creep_of(const laws::GeneralisedKelvin& law, double t) {
  double out = 1 / law.E_m + t / law.C_m;
  for (std::size_t l = 0; l < law.E.size(); ++l) out -= std::expm1(-t * law.E[l] / law.C[l]) / law.E[l];
  return out;
}

Spectrum spectrum(const VolumetricScene& scene, double shortest, double longest, double tolerance) {
  SpectrumOptions options;
  options.shortest = shortest, options.longest = longest, options.tolerance = tolerance;
  options.linear = LinearMethod::direct;
  return spectrum_of(scene.specimen, scene.network, scene.laws, options);
}

// A specimen of one material relaxes and creeps as its mastic does, also if it has held sides; its modulus is then
// larger by a constant factor. The relaxation of the law is used as it is, so that the tolerance is the accuracy of the
// relaxation times of the law, 1e-9, and of their conversion to creep.
TEST(VolumetricSpectrum, OfOneMaterialIsTheLawOfTheMastic) {
  const laws::GeneralisedKelvin law = mastic_am1();
  const double nu = 0.35, confined = (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  for (const bool held : {false, true}) {
    const VolumetricScene scene(all_mastic(random_specimen(test_seed(), 3, 3, 3)), law, {0, nu, 0},
                                held ? held_sides() : NetworkSpec{});
    const Spectrum found = spectrum(scene, 1e-3, 100, 1e-6);
    const PronySeries expected = prony_series(law);
    for (const double t : {0.0, 1e-3, 0.1, 1.0, 10.0, 100.0}) {
      const double factor = held ? confined : 1;
      EXPECT_NEAR(found.relaxation.modulus(t) / (factor * expected.modulus(t)), 1, 1e-8) << held << " " << t;
      EXPECT_NEAR(found.creep.compliance(t) * factor / creep_of(law, t), 1, 1e-8) << held << " " << t;
    }
    EXPECT_LE(found.error, 1e-6);
  }
}

TEST(VolumetricSpectrum, WithoutRelaxationItIsTheElasticModulus) {
  const VolumetricScene scene(all_mastic(random_specimen(2, 3, 3, 3)), laws::Elastic{3e9, 1}, {0, 0.3, 0});
  const Spectrum found = spectrum(scene, 1e-3, 1, 1e-6);
  EXPECT_TRUE(found.relaxation.units.empty());
  EXPECT_NEAR(found.relaxation.long_term, 3e9, 1e-9 * 3e9);  // the rounding of the direct solver
  EXPECT_EQ(found.solutions, 1);
}

// The relaxation is compared with solutions that were not used to make it, at complex s between the real axis and the
// frequencies of the fit.
TEST(VolumetricSpectrum, AgreesWithSolutionsWithinTheStatedError) {
  const VolumetricScene scene(random_specimen(test_seed(), 3, 3, 4), mastic_am1(), {60e9, 0.35, 0.28});
  const double tolerance = 1e-4;
  const Spectrum found = spectrum(scene, 1e-2, 1e2, tolerance);
  EXPECT_LE(std::max(found.error, found.checked), tolerance);
  for (const HarmonicLoad& load : {HarmonicLoad{.growth = 0.03},
                                   {.growth = 30},
                                   {.frequency_hz = 0.004},
                                   {.frequency_hz = 0.3, .growth = 1},
                                   {.frequency_hz = 10}}) {
    Harmonic harmonic(scene.specimen, scene.network, scene.laws, make_inertia(scene.specimen, 1, 1),
                      {.linear = LinearMethod::direct, .typical_growth = load.growth}, load.frequency_hz);
    const Complex exact = harmonic.solve(std::vector{load}).front().parts.modulus();
    EXPECT_LT(std::abs(found.relaxation.stiffness(load.s()) / exact - 1.0), std::max(found.error, found.checked))
        << load.s();
  }
}

// With the rule "series" the fit of bars and the reduced model compute the same relaxation in different ways.
TEST(VolumetricSpectrum, OfTheRuleSeriesAgreesWithTheReducedModel) {
  const Specimen specimen = random_specimen(test_seed(), 3, 3, 4);
  ContactNetwork series = build_network(specimen, tessellate(specimen));
  apply_series(series, specimen, RockSurfaces(specimen, {}, {}), 60e9, 0.35);
  const Laws laws = laws_of_phases(mastic_am1(), {60e9, 0.35, 0});
  SpectrumOptions options;
  options.shortest = 1e-3, options.longest = 1e3, options.tolerance = 1e-5, options.linear = LinearMethod::direct;
  const Spectrum reduced = spectrum_of(specimen, series, laws, options),
                 fitted = volumetric_spectrum(specimen, series, laws, options);
  const double stated = reduced.error + fitted.error;
  EXPECT_LE(stated, 2e-5);
  EXPECT_LE(difference(fitted.relaxation, reduced.relaxation, options.shortest, options.longest, 1e-6), stated);
  for (const double t : {1e-3, 1.0, 30.0, 1e3})
    EXPECT_NEAR(fitted.creep.compliance(t) / reduced.creep.compliance(t), 1, stated) << t;
}

// A bar of mastic beside a bar of mastic in series with rock. The springs of a fit have 40 values per decade. Two
// neighbours instead of a spring between them have an error of up to (ln 10/40)²/8 = 4e-4 of the bar's second
// derivative by the logarithm of the spring; weights of further springs make it smaller. 1e-5 is a tenth of the usual
// tolerance.
TEST(BarsOfMastic, AreFound) {
  const laws::GeneralisedKelvin law = mastic_am1();
  std::vector<MasticSample> samples;
  const auto specimen = [](Complex k) { return 0.4 * k + 1.5 / (1.0 / k + 1 / 3.7e10); };
  for (double f = 1e-4; f < 1e4; f *= 2.5) {
    const Complex k = stiffness_of(law, f);
    samples.push_back({k, specimen(k)});
  }
  const BarsOfMastic bars = fit_bars(samples, 1e-6);
  EXPECT_EQ(bars.constant, 0);
  for (const double f : {3e-4, 0.02, 1.0, 50.0, 4e3}) {
    const Complex k = stiffness_of(law, f);
    EXPECT_NEAR(std::abs(bars.modulus(k) / specimen(k) - 1.0), 0, 1e-5) << f;
    EXPECT_NEAR(std::abs(bars.relaxation(law).stiffness({0, 2 * std::numbers::pi * f}) / specimen(k) - 1.0), 0, 1e-5);
  }
}

TEST(BarsOfMastic, OneBarCreepsLikeMasticAndSpring) {
  const laws::GeneralisedKelvin law = mastic_am1();
  const CreepSeries creep = creep_series(BarsOfMastic{0, {{3.7e10, 1}}}.relaxation(law));
  for (const double t : {0.0, 1e-2, 1.0, 100.0})
    EXPECT_NEAR(creep.compliance(t) / (creep_of(law, t) + 1 / 3.7e10), 1, 1e-8) << t;
}

// Rock that connects both walls keeps a part of the load.
TEST(BarsOfMastic, AConstantIsFoundIfThereIsOne) {
  const laws::GeneralisedKelvin law = mastic_am1();
  std::vector<MasticSample> samples;
  for (double f = 1e-4; f < 1e4; f *= 2.5) {
    const Complex k = stiffness_of(law, f);
    samples.push_back({k, 2e9 + 0.4 * k});
  }
  EXPECT_NEAR(fit_bars(samples, 1e-6).constant, 2e9, 1e-6 * 2e9);
}

TEST(VolumetricSpectrum, OtherLawsAreRefused) {
  VolumetricScene scene(random_specimen(1, 3, 3, 3), mastic_am1(), {60e9, 0.35, 0.28});
  const auto law = [&](PairType pair) -> auto& { return *scene.laws[static_cast<std::size_t>(pair)]; };
  const Law mastic = law(PairType::ma);
  law(PairType::ma) = laws::Elastic{1e9, 1};
  EXPECT_THROW(spectrum(scene, 1e-3, 1, 1e-4), InputError);
  law(PairType::ma) = mastic;
  law(PairType::inner) = mastic;
  EXPECT_THROW(spectrum(scene, 1e-3, 1, 1e-4), InputError);
}

}  // namespace
}  // namespace macadam::test
