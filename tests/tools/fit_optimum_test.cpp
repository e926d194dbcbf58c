// SPDX-License-Identifier: GPL-3.0-or-later
// fit_optimum_test.cpp  Fits reach the same optimum for any reference temperature and any starting point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/test_files.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam::test {
namespace {

const AnalogueModel binder{0, 2.4e9, 0.24, 0.62, 3.4, 2e-4, 90};

/// Returns moduli over two decades of frequency at each temperature, with noise. The standard deviations of the noise
/// are `noise` times 3 % of the modulus and `noise` times 1 degree of the phase.
ModulusData measured(const std::vector<double>& temperatures, double noise, unsigned seed, int frequencies = 7,
                     const laws::Shift& shift = laws::Wlf{13.5, 140, 20}) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  ModulusData out;
  out.source = "made";
  out.temperatures = true;
  for (const double t : temperatures) {
    for (int i = 0; i < frequencies; ++i) {
      const double f = 0.1 * std::pow(100, static_cast<double>(i) / (frequencies - 1));
      const std::complex<double> s(0, 2 * std::numbers::pi * f * std::pow(10.0, laws::log10_shift(shift, t)));
      const std::complex<double> e = binder.stiffness(s);
      out.points.push_back({f, std::abs(e) * std::exp(0.03 * noise * normal(random)),
                            std::arg(e) * 180 / std::numbers::pi + noise * normal(random), t});
    }
  }
  return out;
}

bool has_warning(const Fit& fit, const std::string& part) {
  for (const std::string& warning : fit.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

/// Expects that the misfit of the larger chain of elements is not above the misfit of the smaller chain. If the larger
/// chain does not need an element, the parameter of this element lies at its bound. A spring at the bound still changes
/// |E*| by the fraction e^-12 = 6e-6. This is 2e-4 of the standard deviation (3 %) of a residual.
void expect_not_above(double larger, double smaller, std::size_t residuals, const std::string& what) {
  EXPECT_LE(std::sqrt(larger), std::sqrt(smaller) + 2e-4 * std::sqrt(static_cast<double>(residuals))) << what;
}

/// A chain with more Kelvin units, or with flow, never fits worse than a chain of which it is an extension.
TEST(FitOptimum, AChainNeverFitsWorseThanOneThatItContains) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const ModulusData data = measured({-20, -5, 10, 25, 40, 55, 70}, seed % 2 ? 0.2 : 1, seed);
    FitOptions options;
    options.shift = ShiftKind::wlf;
    const Fit fit = fit_modulus(data, options);
    for (const FitCandidate& larger : fit.candidates) {
      for (const FitCandidate& smaller : fit.candidates) {
        if (smaller.units > larger.units || smaller.flow > larger.flow) continue;
        expect_not_above(larger.misfit, smaller.misfit, 2 * data.points.size(),
                         fmt::format("seed {}: {} units {} in {} units {}", seed, smaller.units, smaller.flow,
                                     larger.units, larger.flow));
      }
    }
  }
}

TEST(FitOptimum, AFreeShiftFitsNoWorseThanALawAnd2S2P1DNoWorseThanHuetSayegh) {
  const ModulusData data = measured({0, 15, 30, 45}, 1, 7);
  const auto misfit = [&](FitModel model, ShiftKind shift) {
    FitOptions options;
    options.model = model, options.shift = shift;
    if (model == FitModel::kelvin) options.units = 4, options.flow = true;
    return fit_modulus(data, options).misfit;
  };
  for (const FitModel model : {FitModel::kelvin, FitModel::two_s2p1d, FitModel::huet_sayegh}) {
    const double free = misfit(model, ShiftKind::free);
    for (const ShiftKind law : {ShiftKind::wlf, ShiftKind::arrhenius})
      expect_not_above(free, misfit(model, law), 2 * data.points.size(), to_string(model));
  }
  for (const ShiftKind shift : {ShiftKind::wlf, ShiftKind::arrhenius, ShiftKind::free})
    expect_not_above(misfit(FitModel::two_s2p1d, shift), misfit(FitModel::huet_sayegh, shift), 2 * data.points.size(),
                     to_string(shift));
}

/// Arrhenius is WLF with C2 = T_r in kelvins, so WLF must not fit worse. If WLF did not also start from the Arrhenius
/// fit, it would have misfits of 206.9 and 138.2 with the first two seeds, above the 199.6 and 136.2 of Arrhenius.
TEST(FitOptimum, WlfFitsNoWorseThanArrhenius) {
  for (const unsigned seed : {17u, 6u, 27u}) {
    const ModulusData data = measured({5, 60, 75}, 2, seed, 4, laws::Arrhenius{180e3, 20});
    for (const FitModel model : {FitModel::huet_sayegh, FitModel::two_s2p1d, FitModel::kelvin}) {
      std::vector<double> misfits;
      for (const ShiftKind shift : {ShiftKind::arrhenius, ShiftKind::wlf, ShiftKind::free}) {
        FitOptions options;
        options.model = model, options.shift = shift;
        if (model == FitModel::kelvin) options.units = 3, options.flow = true;
        misfits.push_back(fit_modulus(data, options).misfit);
      }
      // converting one shift law to the next is exact except for rounding
      EXPECT_LE(misfits[1], misfits[0] * (1 + 1e-9)) << fmt::format("seed {} {}", seed, to_string(model));
      EXPECT_LE(misfits[2], misfits[1] * (1 + 1e-9)) << fmt::format("seed {} {}", seed, to_string(model));
    }
  }
}

/// Expects that the laws fitted at two reference temperatures differ only in their times: the times of `found` are `a`
/// times the times of `first`.
void expect_rescaled(const laws::GeneralisedKelvin& found, const laws::GeneralisedKelvin& first, double a,
                     const std::string& what) {
  ASSERT_EQ(found.units(), first.units()) << what;
  EXPECT_DOUBLE_EQ(found.E_m, first.E_m) << what;
  EXPECT_EQ(std::isfinite(found.C_m), std::isfinite(first.C_m)) << what;
  // The fit adds the logarithms of a viscosity (about 20) and of a_T. Their sum is below 50, so its rounding error is
  // about 1e-15·50 = 5e-14.
  if (std::isfinite(first.C_m)) { EXPECT_NEAR(found.C_m / (a * first.C_m), 1, 1e-12) << what; }
  for (std::size_t l = 0; l < first.E.size(); ++l) {
    EXPECT_DOUBLE_EQ(found.E[l], first.E[l]) << what;
    EXPECT_NEAR(found.C[l] / (a * first.C[l]), 1, 1e-12) << what;
  }
}

TEST(FitOptimum, AnotherReferenceTemperatureRescalesTimeAndNothingElse) {
  const std::vector<double> temperatures{-10, 5, 20, 35, 50};
  const ModulusData data = measured(temperatures, 1, 3);
  for (const FitModel model : {FitModel::kelvin, FitModel::two_s2p1d}) {
    for (const ShiftKind shift : {ShiftKind::wlf, ShiftKind::arrhenius, ShiftKind::free}) {
      std::optional<Fit> first;
      std::optional<KelvinConversion> first_chain;
      for (const double reference : {5.0, -10.0, 50.0, 24.3}) {
        // this temperature was not measured, so a free shift cannot use it as reference
        if (shift == ShiftKind::free && reference == 24.3) continue;
        FitOptions options;
        options.model = model, options.shift = shift, options.reference_temperature = reference, options.most_units = 4;
        const Fit fit = fit_modulus(data, options);
        const std::string what = fmt::format("{} {} at {}", to_string(model), to_string(shift), reference);
        EXPECT_EQ(fit.options.reference_temperature, reference);
        if (!first) first = fit;
        const double moved = laws::log10_shift(first->shift, reference), a = std::pow(10.0, moved);
        EXPECT_EQ(fit.misfit, first->misfit) << what;
        EXPECT_EQ(fit.chosen, first->chosen) << what;
        // a_T spans at most eleven decades; each factor is rounded to 1e-16 of its logarithm
        for (const double t : temperatures)
          EXPECT_NEAR(laws::log10_shift(fit.shift, t), laws::log10_shift(first->shift, t) - moved, 1e-11) << what;
        if (model == FitModel::kelvin) {
          expect_rescaled(std::get<laws::GeneralisedKelvin>(fit.model), std::get<laws::GeneralisedKelvin>(first->model),
                          a, what);
          continue;
        }
        const auto& analogue = std::get<AnalogueModel>(fit.model);
        const auto& other = std::get<AnalogueModel>(first->model);
        EXPECT_EQ(analogue.E_0, other.E_0) << what;
        EXPECT_EQ(analogue.k, other.k) << what;
        EXPECT_NEAR(analogue.tau / (a * other.tau), 1, 1e-12) << what;
        const auto [low, high] = fit.reduced_range();
        const KelvinConversion chain = to_kelvin(analogue, low, high, 0.02);
        if (!first_chain) first_chain = chain;
        expect_rescaled(chain.law, first_chain->law, a, what + ", chain");
      }
    }
  }
}

/// Temperatures that differ by tenths of a degree are treated as one isotherm.
TEST(FitOptimum, ReadingsThatDifferByTenthsAreOneIsotherm) {
  const std::vector<double> nominal{0, 15, 30};
  ModulusData data = measured(nominal, 0, 1, 9);
  for (std::size_t i = 0; i < data.points.size(); ++i)
    // small differences, as an instrument records them
    data.points[i].temperature_c += 0.1 * static_cast<double>(i % 5) - 0.2;
  FitOptions options;
  options.shift = ShiftKind::free;
  options.units = 4;
  options.reference_temperature = 15;
  const Fit fit = fit_modulus(data, options);
  const auto& table = std::get<laws::ShiftTable>(fit.shift);
  ASSERT_EQ(table.temperatures.size(), nominal.size());
  for (std::size_t i = 0; i < nominal.size(); ++i) EXPECT_NEAR(table.temperatures[i], nominal[i], 0.2);
  EXPECT_EQ(table.log10_a_T[1], 0);
  // At the first and the last nominal temperature log10 a_T is 1.4 and −1.2 (the WLF law below). The tolerance is wide,
  // because a chain of four Kelvin units fits the data only to a few per cent.
  const laws::Shift truth = laws::Wlf{13.5, 140, 20};
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}})
    EXPECT_NEAR(table.log10_a_T[i], laws::log10_shift(truth, nominal[i]) - laws::log10_shift(truth, 15), 0.1);
  // The isotherm whose readings differ from 15.3 degrees by tenths of a degree gets this temperature.
  options.reference_temperature = 15.3;
  const Fit named = fit_modulus(data, options);
  EXPECT_EQ(named.options.reference_temperature, 15.3);
  EXPECT_EQ(std::get<laws::ShiftTable>(named.shift).temperatures[1], 15.3);
  EXPECT_EQ(std::get<laws::ShiftTable>(named.shift).log10_a_T, table.log10_a_T);
  EXPECT_EQ(named.misfit, fit.misfit);
  options.reference_temperature = 18;
  EXPECT_HAS(message_of([&] { fit_modulus(data, options); }),
             "one of the measured temperatures, because the shift is \"free\"");
  options.shift = ShiftKind::none, options.reference_temperature.reset();
  data.points.resize(9);
  EXPECT_NO_THROW(fit_modulus(data, options)) << "one isotherm needs no shift";
}

/// A temperature that rises steadily gives no isotherms. So a free shift is refused, and a shift law can be fitted.
TEST(FitOptimum, ARampOfTemperatureTakesAShiftLaw) {
  std::vector<double> ramp;
  for (int i = 0; i <= 100; ++i) ramp.push_back(0.4 * i);
  ModulusData data = measured(ramp, 0, 1, 2);
  FitOptions options;
  options.units = 4;
  options.shift = ShiftKind::free;
  EXPECT_HAS(message_of([&] { fit_modulus(data, options); }), "readings without a gap from 0 to");
  options.shift = ShiftKind::wlf;
  EXPECT_LT(fit_modulus(data, options).errors.e_star_rms, 0.05);
}

TEST(FitOptimum, OneMeasurementFarOffTheFitIsNamed) {
  ModulusData data = measured({0, 10, 20, 30}, 1, 5);
  FitOptions options;
  options.shift = ShiftKind::wlf;
  EXPECT_FALSE(has_warning(fit_modulus(data, options), "off the fit"));
  data.points[9].phase_deg = 85;  // 40 degrees above the phases of all other points
  data.points[9].line = 12;
  EXPECT_TRUE(has_warning(fit_modulus(data, options),
                          "1 of 28 measurements lie more than 5 standard deviations off the fit: line 12: phase 85"));
}

TEST(FitOptimum, AReferenceTemperatureBelowTheLawsPoleIsRefused) {
  FitOptions options;
  options.shift = ShiftKind::wlf;
  options.units = 3;
  options.reference_temperature = -270;
  EXPECT_HAS(message_of([&] {
               fit_modulus(measured({0, 10, 20, 30}, 0, 1), options);
             }),
             "reference temperature: found -270, expected a temperature above");
}

}  // namespace
}  // namespace macadam::test
