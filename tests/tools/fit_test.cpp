// SPDX-License-Identifier: GPL-3.0-or-later
// fit_test.cpp  Fits laws to data: the law that made the data must be recovered, and stated errors and confidence
// limits must hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/tools/fit/criterion.hpp"
#include "host/tools/fit/least_squares.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam::test {
namespace {

std::complex<double> s_of(double frequency_hz) { return {0, 2 * std::numbers::pi * frequency_hz}; }

std::vector<double> frequencies(double low, double high, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(low * std::pow(high / low, static_cast<double>(i) / (count - 1)));
  return out;
}

/// Returns the moduli of a law at the given frequencies and, if there are several, temperatures.
template <class Model>
ModulusData measured(const Model& model, const std::vector<double>& at, const laws::Shift& shift = laws::NoShift{},
                     const std::vector<double>& temperatures = {0}) {
  ModulusData out;
  out.source = "made";
  out.temperatures = temperatures.size() > 1;
  for (const double t : temperatures) {
    for (const double f : at) {
      const std::complex<double> e = model.stiffness(s_of(f * std::pow(10.0, laws::log10_shift(shift, t))));
      out.points.push_back({f, std::abs(e), std::arg(e) * 180 / std::numbers::pi, t, 0, 0});
    }
  }
  return out;
}

/// Returns the largest |E*_fit − E*|/|E*| on a grid that is finer than the data.
template <class Model>
double largest_difference(const Fit& fit, const Model& model, double low, double high) {
  double out = 0;
  for (const double f : frequencies(low, high, 211))
    out =
        std::max(out, std::abs(fit.stiffness(s_of(f)) - model.stiffness(s_of(f))) / std::abs(model.stiffness(s_of(f))));
  return out;
}

/// Adds noise with a standard deviation of 3 % in the modulus and 1 degree in the phase. `deviations` says whether the
/// data state these standard deviations.
ModulusData noisy(ModulusData data, std::mt19937_64& random, bool deviations) {
  std::normal_distribution<double> normal;
  data.deviations = deviations;
  for (ModulusPoint& p : data.points) {
    p.e_star_std = 0.03 * p.e_star_pa;
    p.phase_std = 1;
    p.e_star_pa *= std::exp(0.03 * normal(random));
    p.phase_deg += normal(random);
  }
  return data;
}

const AnalogueModel mixture{8e7, 3.5e10, 0.18, 0.56, 2.1, 0.08, 250};

TEST(Fit, CurvesOfThePapersLawsComeBack) {
  // Two of AM2's three Kelvin units have the same retardation time, 0.0927 s, so two units give the same curve.
  for (const auto& [law, units] : {std::pair{mastic_am1(), 3}, {mastic_am2(), 2}}) {
    const Fit fit = fit_modulus(measured(law, frequencies(1e-3, 1e3, 31)));
    EXPECT_EQ(std::get<laws::GeneralisedKelvin>(fit.model).units(), units);
    EXPECT_TRUE(std::isfinite(std::get<laws::GeneralisedKelvin>(fit.model).C_m));
    EXPECT_LT(largest_difference(fit, law, 1e-3, 1e3), 1e-6);
    EXPECT_LT(fit.errors.e_star_largest, 1e-6);
  }
}

TEST(Fit, BicAndNumbersOfUnitsThatAreGiven) {
  FitOptions options;
  options.criterion = Criterion::bic;
  const ModulusData data = measured(mastic_am1(), frequencies(1e-3, 1e3, 31));
  EXPECT_LT(largest_difference(fit_modulus(data, options), mastic_am1(), 1e-3, 1e3), 1e-6);
  options.units = 2;
  options.flow = true;
  const Fit two = fit_modulus(data, options);
  EXPECT_EQ(std::get<laws::GeneralisedKelvin>(two.model).units(), 2);
  EXPECT_GT(two.errors.e_star_largest, 1e-3);
  options.flow = false;
  EXPECT_FALSE(std::isfinite(std::get<laws::GeneralisedKelvin>(fit_modulus(data, options).model).C_m));
}

/// AM1 has three Kelvin units. If at most one is allowed, the criterion chooses one, and the fit warns that the
/// criterion would choose more. If the user requests exactly one, there is no warning.
TEST(Fit, MoreUnitsAreWantedOnlyWhereTheCriterionChoseTheMost) {
  const ModulusData data = measured(mastic_am1(), frequencies(1e-3, 1e3, 31));
  const auto warned = [&](const FitOptions& options) {
    const Fit fit = fit_modulus(data, options);
    return std::any_of(fit.warnings.begin(), fit.warnings.end(), [&](const std::string& warning) {
      return warning.starts_with("the criterion AICc would choose more than 1 Kelvin units");
    });
  };
  FitOptions options;
  options.most_units = 1;
  EXPECT_TRUE(warned(options));
  options.units = 1;
  EXPECT_FALSE(warned(options)) << "as many as were asked for";
}

/// A number of units below 0 or above the largest that a law can have is refused.
TEST(Fit, NumbersOfUnitsBeyondALawsAreRefused) {
  const ModulusData data = measured(mastic_am1(), frequencies(1e-3, 1e3, 31));
  const int most = laws::GeneralisedKelvin::max_units;
  for (const int units : {-1, most + 1}) {
    FitOptions options;
    options.units = units;
    EXPECT_THROW(fit_modulus(data, options), InputError) << units;
    options.units.reset(), options.most_units = units;
    EXPECT_THROW(fit_modulus(data, options), InputError) << units;
  }
}

/// There are n = 20 numbers and p = 3 parameters, so n − p − 1 = 16. If the data state no standard deviations, the size
/// of the errors is one more parameter.
TEST(Fit, CriteriaAreThoseOfTheirFormulae) {
  EXPECT_DOUBLE_EQ(fitting::criterion(Criterion::aicc, 7, 20, 3, true), 7 + 6 + 24.0 / 16);
  EXPECT_DOUBLE_EQ(fitting::criterion(Criterion::bic, 7, 20, 3, true), 7 + 3 * std::log(20.0));
  EXPECT_DOUBLE_EQ(fitting::criterion(Criterion::aicc, 7, 20, 3, false), 20 * std::log(0.35) + 8 + 40.0 / 15);
}

/// In 200 trials with probability 0.95 the number of hits is in [179, 198], except for 3e-4 of the cases on each side.
/// The seeds are fixed, so the test cannot fail at random.
TEST(Fit, ConfidenceBandsHoldTheTruthAsOftenAsTheySay) {
  const laws::GeneralisedKelvin law = mastic_am1();
  const ModulusData exact = measured(law, frequencies(1e-3, 1e2, 24));
  const std::vector<double> at = frequencies(1.5e-3, 70, 5);
  FitOptions options;
  options.units = 3;
  options.flow = true;
  for (const bool deviations : {true, false}) {
    std::vector<int> modulus(at.size(), 0), phase(at.size(), 0);
    for (unsigned trial = 0; trial < 200; ++trial) {
      std::mt19937_64 random(1000 + trial);
      const Fit fit = fit_modulus(noisy(exact, random, deviations), options);
      const std::vector<BandPoint> bands = confidence_bands(fit, at);
      for (std::size_t i = 0; i < at.size(); ++i) {
        const std::complex<double> e = law.stiffness(s_of(at[i]));
        const double degrees = std::arg(e) * 180 / std::numbers::pi;
        modulus[i] += bands[i].e_star_low < std::abs(e) && std::abs(e) < bands[i].e_star_high;
        phase[i] += bands[i].phase_low < degrees && degrees < bands[i].phase_high;
      }
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (const int count : {modulus[i], phase[i]}) {
        EXPECT_GE(count, 179) << at[i] << " Hz, deviations " << deviations;
        EXPECT_LE(count, 198) << at[i] << " Hz, deviations " << deviations;
      }
    }
  }
}

/// Shift laws and free shift factors are recovered from exact data.
TEST(Fit, ShiftFactorsComeBack) {
  const std::vector<double> temperatures{-10, 0, 10, 20, 30, 40};
  const laws::Shift wlf = laws::Wlf{14.5, 128, 10}, arrhenius = laws::Arrhenius{2.1e5, 10};
  for (const laws::Shift& truth : {wlf, arrhenius}) {
    const ModulusData data = measured(mixture, frequencies(0.1, 20, 8), truth, temperatures);
    for (const ShiftKind kind : {ShiftKind::wlf, ShiftKind::arrhenius, ShiftKind::free}) {
      if (kind != ShiftKind::free && (kind == ShiftKind::wlf) != std::holds_alternative<laws::Wlf>(truth)) continue;
      FitOptions options;
      options.model = FitModel::two_s2p1d;
      options.shift = kind;
      options.reference_temperature = 10;
      const Fit fit = fit_modulus(data, options);
      for (const double t : temperatures)
        EXPECT_NEAR(laws::log10_shift(fit.shift, t), laws::log10_shift(truth, t), 1e-5) << to_string(kind) << " " << t;
      EXPECT_LT(fit.errors.e_star_largest, 1e-6);
    }
  }
}

/// If moduli are assigned to the wrong temperatures, a_T rises with temperature; the fit warns of this.
TEST(Fit, TemperaturesInTheWrongRowsAreAskedAbout) {
  const std::vector<double> temperatures{0, 10, 20};
  ModulusData data = measured(mixture, frequencies(0.1, 20, 8), laws::Wlf{14.5, 128, 10}, temperatures);
  FitOptions options;
  options.model = FitModel::two_s2p1d;
  options.shift = ShiftKind::free;
  options.reference_temperature = 10;
  const auto asked = [&] {
    const std::vector<std::string> warnings = fit_modulus(data, options).warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& w) { return w.find("a_T rises from 0 to 10") != std::string::npos; });
  };
  EXPECT_FALSE(asked());
  for (ModulusPoint& p : data.points) p.temperature_c = 20 - p.temperature_c;
  EXPECT_TRUE(asked());
}

TEST(Fit, AChainAndItsShiftAreFoundTogether) {
  const std::vector<double> temperatures{0, 10, 20, 30};
  const laws::Shift truth = laws::Wlf{12, 110, 20};
  for (const ShiftKind kind : {ShiftKind::wlf, ShiftKind::free}) {
    FitOptions options;
    options.shift = kind;
    options.reference_temperature = 20;
    options.most_units = 4;
    const Fit fit = fit_modulus(measured(mastic_am1(), frequencies(0.1, 20, 8), truth, temperatures), options);
    for (const double t : temperatures)
      EXPECT_NEAR(laws::log10_shift(fit.shift, t), laws::log10_shift(truth, t), 1e-6) << to_string(kind) << " " << t;
    EXPECT_LT(fit.errors.e_star_largest, 1e-6);
  }
}

void expect_equal(const AnalogueModel& found, const AnalogueModel& truth) {
  const auto relative = [](double a, double b) { return std::abs(a / b - 1); };
  EXPECT_LT(relative(found.E_0, truth.E_0), 1e-4);
  EXPECT_LT(relative(found.E_00, truth.E_00), 1e-4);
  EXPECT_LT(relative(found.k, truth.k), 1e-4);
  EXPECT_LT(relative(found.h, truth.h), 1e-4);
  EXPECT_LT(relative(found.delta, truth.delta), 1e-4);
  EXPECT_LT(relative(found.tau, truth.tau), 1e-4);
  // both values are infinite, or they are nearly equal
  EXPECT_TRUE(found.beta == truth.beta || relative(found.beta, truth.beta) < 1e-4);
}

TEST(Fit, ParametersOfAnaloguesComeBack) {
  AnalogueModel huet = mixture;
  huet.beta = std::numeric_limits<double>::infinity();
  FitOptions options;
  options.model = FitModel::two_s2p1d;
  expect_equal(std::get<AnalogueModel>(fit_modulus(measured(mixture, frequencies(1e-6, 1e6, 49)), options).model),
               mixture);
  options.model = FitModel::huet_sayegh;
  expect_equal(std::get<AnalogueModel>(fit_modulus(measured(huet, frequencies(1e-6, 1e6, 49)), options).model), huet);
}

/// A chain approximates an analogue model within the stated error over the range of frequencies.
TEST(Fit, AChainStandsForAnAnalogueWithinTheStatedError) {
  AnalogueModel fluid = mixture;
  fluid.E_00 = 0;
  AnalogueModel huet = mixture;
  huet.beta = std::numeric_limits<double>::infinity();
  std::vector<int> units;
  for (const auto& [model, error] : {std::pair{mixture, 0.03}, {mixture, 0.003}, {fluid, 0.01}, {huet, 0.01}}) {
    const KelvinConversion conversion = to_kelvin(model, 1e-3, 1e3, error);
    double largest = 0;  // evaluated at ten times the number of frequencies that the conversion checks
    for (const double f : frequencies(1e-3, 1e3, 6001)) {
      const std::complex<double> exact = model.stiffness(s_of(f));
      largest = std::max(largest, std::abs(conversion.law.stiffness(s_of(f)) - exact) / std::abs(exact));
    }
    // Between the checked frequencies the error is a smooth curve, so it can be a hundredth larger.
    EXPECT_LT(largest, 1.01 * conversion.largest_error);
    EXPECT_LE(conversion.largest_error, error);
    EXPECT_EQ(std::isfinite(conversion.law.C_m), model.E_00 == 0);
    units.push_back(conversion.law.units());
  }
  EXPECT_LT(units[0], units[1]) << "less error takes more units";
  EXPECT_HAS(message_of([&] { to_kelvin(mixture, 1, 10, 0.7); }), "a number from 1e-6 to 0.5");
  EXPECT_HAS(message_of([&] { to_kelvin(mixture, 1e-5, 1e5, 1e-6); }), "units reach");
  EXPECT_HAS(message_of([&] { to_kelvin(mixture, 10, 1, 0.01); }), "10 to 1 Hz");
  EXPECT_HAS(message_of([&] { to_kelvin(mixture, -1, 10, 0.01); }), "-1 to 10 Hz");
}

/// The limits of the parameter are 100 apart. If the parameter is within 1e-6 of this range from a limit, it counts as
/// lying at the limit, and is not determined.
TEST(Fit, AParameterNearItsBoundIsNotDetermined) {
  const fitting::Unknowns spring;
  const auto determined = [&](double log_modulus) {
    fitting::Target target;
    target.place.omega = 1;
    target.log_modulus = log_modulus;
    const fitting::Minimum found = fitting::refine(spring, {target}, {{20, 120}}, {70});
    // there is one linear unknown; the iteration ends when a step is below 1e-12 of it
    EXPECT_NEAR(found.theta.at(0), log_modulus, 1e-9);
    return found.determined;
  };
  EXPECT_FALSE(determined(20 + 5e-5));
  EXPECT_TRUE(determined(20 + 2e-4));
  EXPECT_TRUE(determined(120 - 2e-4));
  EXPECT_FALSE(determined(120 - 5e-5));
}

// A Kelvin unit so stiff that it changes |E*| by only 1e-13 of the spring's contribution is not determined, whatever
// the standard deviations of the residuals are.
TEST(Fit, WhatTheDataDoNotDetermineIsMarked) {
  const fitting::Unknowns chain{FitModel::kelvin, 1, false};
  const auto undetermined = [&](double stiff, double deviation) {
    std::vector<fitting::Target> targets;
    for (const double omega : {0.1, 1.0, 10.0}) targets.push_back({{omega}, 20, 0.3, deviation, deviation});
    return fitting::covariance_at(chain, targets, {std::log(1e9), std::log(stiff), std::log(stiff)}).undetermined;
  };
  for (const double deviation : {1e-6, 1.0, 1e6}) {
    EXPECT_EQ(undetermined(1e22, deviation), (std::vector<bool>{false, true, true})) << deviation;
    EXPECT_EQ(undetermined(1e10, deviation), (std::vector<bool>{false, false, false})) << deviation;
  }
}

TEST(Fit, WhatCannotBeFittedIsRefused) {
  ModulusData data = measured(mastic_am1(), frequencies(0.1, 10, 6));
  FitOptions options;
  options.units = 8;
  EXPECT_HAS(message_of([&] { fit_modulus(data, options); }), "found 6, expected more measurements for 8 Kelvin units");
  options.units = 17;
  EXPECT_HAS(message_of([&] { fit_modulus(data, options); }), "units: found 17, expected 0 to 16");
  options = {};
  options.shift = ShiftKind::wlf;
  EXPECT_HAS(message_of([&] { fit_modulus(data, options); }), "no column temperature_c");
  data.temperatures = true;
  data.points.front().temperature_c = 10;
  EXPECT_HAS(message_of([&] { fit_modulus(data, options); }), "found 2, expected at least 3");
  options.shift = ShiftKind::free;
  options.reference_temperature = 5;
  EXPECT_HAS(message_of([&] { fit_modulus(data, options); }),
             "one of the measured temperatures, because the shift is \"free\": 0, 10");
  options = {};
  EXPECT_HAS(message_of([&] { fit_modulus(data, options); }), "expected one, or a shift law");
  data = measured(mastic_am1(), frequencies(0.1, 10, 6));
  data.points[2].e_star_pa = NAN;
  EXPECT_HAS(message_of([&] { fit_modulus(data); }), "measurement 3");
  EXPECT_HAS(message_of([&] { fit_modulus({}); }), "found none");
}

TEST(Fit, AnElasticSpringIsAChainWithoutUnits) {
  laws::GeneralisedKelvin spring;
  spring.E_m = 1e10;
  const Fit fit = fit_modulus(measured(spring, frequencies(0.1, 10, 6)));
  const auto& law = std::get<laws::GeneralisedKelvin>(fit.model);
  EXPECT_EQ(law.units(), 0);
  EXPECT_FALSE(std::isfinite(law.C_m));
  EXPECT_NEAR(law.E_m, 1e10, 1e2);
}

// The points of the curve are computed from a chain, so the fitted chain differs only by the difference that the
// function allows.
TEST(Fit, AChainStandsForACurve) {
  laws::GeneralisedKelvin law;
  law.E_m = 6e9, law.C_m = 1.3e9, law.E = {2e8, 5e9}, law.C = {5e9, 1e8};
  ModulusData curve;
  curve.source = "curve";
  for (int k = -8; k <= 8; ++k) {
    const double hz = std::pow(10.0, k / 4.0);
    const std::complex<double> modulus = law.stiffness(std::complex<double>(0, 2 * std::numbers::pi * hz));
    curve.points.push_back({hz, std::abs(modulus), std::arg(modulus) * 180 / std::numbers::pi});
  }
  const CurveChain found = chain_of_curve(curve);
  EXPECT_LE(found.largest_difference, 0.02);
  for (const ModulusPoint& p : curve.points) {
    const std::complex<double> s(0, 2 * std::numbers::pi * p.frequency_hz);
    EXPECT_LE(std::abs(found.law.stiffness(s) / law.stiffness(s) - 1.0), found.largest_difference * (1 + 1e-9));
  }
  curve.temperatures = true;
  EXPECT_THROW(chain_of_curve(curve), InputError);
}

}  // namespace
}  // namespace macadam::test
