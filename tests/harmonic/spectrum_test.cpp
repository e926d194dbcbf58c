// SPDX-License-Identifier: GPL-3.0-or-later
// spectrum_test.cpp  Compares relaxation and creep spectra with closed forms and with Laplace inversions of solutions
// of the whole network, and tests conversions between the two kinds of spectrum.
#include "macadam/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "macadam/harmonic.hpp"
#include "tests/support/talbot.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using Complex = std::complex<double>;

laws::GeneralisedKelvin am1(PairType pair) {
  return std::get<laws::GeneralisedKelvin>(*am1_laws()[static_cast<std::size_t>(pair)]);
}

TEST(Series, OfALawIsTheLaw) {
  laws::GeneralisedKelvin solid = am1(PairType::mm), maxwell = solid, twins = solid;
  solid.C_m = std::numeric_limits<double>::infinity();
  maxwell.E.clear(), maxwell.C.clear();
  twins.E.push_back(twins.E[1]), twins.C.push_back(twins.C[1]);  // two units with the same retardation time
  for (const auto& law : {am1(PairType::mm), solid, maxwell, twins}) {
    const PronySeries series = prony_series(law);
    for (const Complex s : {Complex(1e-6, 0), Complex(0, 1e-3), Complex(3, 40), Complex(0, 1e5), Complex(-1e-3, 1)}) {
      // The series has few units, but they are computed as roots of a polynomial, whose last digits are rounded.
      EXPECT_LT(std::abs(series.stiffness(s) / law.stiffness(s) - 1.0), 1e-12) << s;
    }
    EXPECT_EQ(series.long_term == 0, std::isfinite(law.C_m));
  }
  EXPECT_EQ(prony_series(laws::Elastic{3e9, 0.1}).modulus(5), 3e9);
}

// The creep series is computed as the inverse of E*. For a chain (springs and dashpots in series) it must equal the
// closed form, which follows from the chain's constants.
TEST(Series, CreepOfALawIsItsChain) {
  const laws::GeneralisedKelvin law = am1(PairType::mm);
  const CreepSeries creep = creep_series(prony_series(law));
  for (const double t : {0.0, 1e-4, 0.01, 1.0, 1e3}) {
    double expected = 1 / law.E_m + t / law.C_m;
    for (std::size_t l = 0; l < law.E.size(); ++l) expected -= std::expm1(-t * law.E[l] / law.C[l]) / law.E[l];
    EXPECT_NEAR(creep.compliance(t) / expected, 1, 1e-11) << t;
  }
}

/// A law that is not in Macadam's list: a spring beside Maxwell units.
struct MaxwellUnits {
  static constexpr const char* name = "maxwell_units";
  PronySeries series;
  double alpha = 0;
  PronySeries prony() const { return series; }
  template <class R>
  struct Step {};
};
/// A linear law without a function prony(), and a law that is not linear.
struct Silent {
  static constexpr const char* name = "silent";
  double alpha = 0;
};
struct Nonlinear : Silent {
  static constexpr const char* name = "hardening";
  static constexpr bool linear = false;
};
using UsersLaw = std::variant<MaxwellUnits, Silent, Nonlinear, laws::Elastic>;
using UsersLaws = std::array<std::optional<UsersLaw>, pair_types>;

UsersLaws users_laws(const UsersLaw& law) {
  UsersLaws out;
  out.fill(law);
  return out;
}

// The equivalent law is computed from the series by two searches for zeros, each with a relative error near 1e-15; the
// moduli are quotients of sums of a few terms.
TEST(Series, AUsersLawHasAnEquivalentLaw) {
  const PronySeries solid{1e9, {{3e9, 1e-3}, {2e9, 5}}}, fluid{0, {{3e9, 1e-3}, {2e9, 5}}};
  // out of order, one time twice, and a unit without stiffness
  const PronySeries shuffled{1e9, {{2e9, 5}, {1e9, 1e-3}, {0, 0.1}, {2e9, 1e-3}}};
  for (const PronySeries& series : {solid, fluid, shuffled}) {
    const Law law = *equivalent_laws(users_laws(MaxwellUnits{series, 0.3}))[0];
    const auto& chain = std::get<laws::GeneralisedKelvin>(law);
    EXPECT_EQ(chain.alpha, 0.3);
    EXPECT_EQ(chain.units(), series.long_term > 0 ? 2 : 1);
    EXPECT_EQ(std::isfinite(chain.C_m), series.long_term == 0);
    for (const Complex s : {Complex(1e-6, 0), Complex(0, 0.1), Complex(3, 40), Complex(0, 1e5)}) {
      EXPECT_LT(std::abs(chain.stiffness(s) / series.stiffness(s) - 1.0), 1e-12) << s;
    }
  }
  const Law spring = *equivalent_laws(users_laws(MaxwellUnits{{2e9, {}}, 0.1}))[0];
  EXPECT_EQ(std::get<laws::Elastic>(spring).E, 2e9);
  EXPECT_EQ(std::get<laws::Elastic>(spring).alpha, 0.1);
  EXPECT_EQ(std::get<laws::Elastic>(*equivalent_laws(users_laws(laws::Elastic{4e9, 0.2}))[0]).E, 4e9);
}

TEST(Series, LawsWithoutASeriesAreRefusedByName) {
  const auto message = [](const UsersLaw& law) { return message_of([&] { equivalent_laws(users_laws(law)); }); };
  EXPECT_HAS(message(Silent{}), "law: found silent, which has no function prony(), expected a law with the function");
  EXPECT_HAS(message(Nonlinear{}), "law: found hardening, which is not linear, expected a linear law; or method = ");
  EXPECT_HAS(message(MaxwellUnits{{-1e9, {{3e9, 1}}}}),
             "prony() of law maxwell_units: found a long-term modulus of -1e+09 Pa");
  EXPECT_HAS(message(MaxwellUnits{{1e9, {{3e9, 0}}}}),
             "law maxwell_units: found a unit of 3e+09 Pa with a time of 0 s");
  EXPECT_HAS(message(MaxwellUnits{{1e9, {{-3e9, 1}}}}), "found a unit of -3e+09 Pa with a time of 1 s");
  EXPECT_HAS(message(MaxwellUnits{{0, {}}}), "found no unit and no long-term modulus");
  PronySeries long_series{1e9, {}};
  for (int l = 0; l < 17; ++l) long_series.units.push_back({1e8, std::pow(10.0, l)});
  EXPECT_HAS(message(MaxwellUnits{long_series}),
             "law maxwell_units: chain: found 17 Kelvin units, expected at most 16");
  EXPECT_HAS(message_of([] { prony_series(laws::BrittleBond{}); }), "found brittle_bond, which is not linear");
}

/// A column of cubes of a user's law relaxes, creeps and stretches at a constant rate as one contact does. The
/// tolerance of the spectrum is 1e-6.
TEST(Spectrum, OfAUsersLawIsTheClosedForm) {
  const double E_inf = 1e9, E_1 = 3e9, time = 1e-2, at = 5e-3;
  Specimen specimen;
  specimen.box.size = {2e-3, 2e-3, 4e-3};
  for (const double z : {1e-3, 3e-3}) {
    specimen.centre.push_back({1e-3, 1e-3, z});
    specimen.radius.push_back(1e-3);
    specimen.phase.push_back(Phase::mastic);
    specimen.body.push_back(-1);
  }
  const LawTable table = equivalent_laws(users_laws(MaxwellUnits{{E_inf, {{E_1, time}}}, 0.2}));
  const TestScene scene = make_scene(specimen, {}, table);
  SpectrumOptions options;
  options.shortest = 1e-4, options.longest = 10;
  const Spectrum found = spectrum_of(scene.specimen, scene.network, scene.laws, options);
  EXPECT_NEAR(found.relaxation.modulus(at) / (E_inf + E_1 * std::exp(-at / time)), 1, 1e-6);
  EXPECT_NEAR(found.relaxation.after_ramp(at, at) / (E_inf - E_1 * time / at * std::expm1(-at / time)), 1, 1e-6);
  const double first = 1 / (E_inf + E_1), last = 1 / E_inf, slow = time * last / first;
  EXPECT_NEAR(found.creep.compliance(at) / (last - (last - first) * std::exp(-at / slow)), 1, 1e-6);
}

/// Two spheres between the walls, joined by one contact with a chain.
TEST(Spectrum, OfOneContactIsTheClosedForm) {
  Specimen specimen;
  specimen.box.size = {2e-3, 2e-3, 4e-3};
  for (const double z : {1e-3, 3e-3}) {
    specimen.centre.push_back({1e-3, 1e-3, z});
    specimen.radius.push_back(1e-3);
    specimen.phase.push_back(Phase::mastic);
    specimen.body.push_back(-1);
  }
  Laws laws = am1_laws();
  // a shear stiffness at the walls, so that nothing can slide freely
  std::get<macadam::laws::Elastic>(*laws[static_cast<std::size_t>(PairType::mw)]).alpha = 0.1;
  const TestScene scene = make_scene(specimen, {}, laws);
  const Spectrum found = spectrum_of(scene.specimen, scene.network, scene.laws);
  // Three contacts are in series, each with the ratio a/d of area and distance. Contacts at the walls have half the
  // distance.
  double compliance_at_walls = 0, between = 0;
  for (const Contact& c : scene.network.contacts) (c.b < 0 ? compliance_at_walls : between) += c.distance / c.moments.a;
  const auto& wall = *scene.laws[static_cast<std::size_t>(PairType::mw)];
  const laws::GeneralisedKelvin law = am1(PairType::mm);
  const double area_over_height = 4e-6 / 4e-3;
  for (const double t : {1e-3, 0.1, 1.0, 100.0, 1e4}) {
    double creep = 1 / law.E_m + t / law.C_m;
    for (std::size_t l = 0; l < law.E.size(); ++l) creep -= std::expm1(-t * law.E[l] / law.C[l]) / law.E[l];
    const double expected =
        area_over_height * (creep * between + compliance_at_walls / std::get<laws::Elastic>(wall).E);
    EXPECT_NEAR(found.creep.compliance(t) / expected, 1, 1e-8) << t;
    const double relaxed = talbot(
        [&](Complex s) {
          return 1.0 / s /
                 (area_over_height *
                  (between / law.stiffness(s) + compliance_at_walls / std::get<laws::Elastic>(wall).E));
        },
        t, 24);
    // The sum of Talbot's method is only accurate to 1e-11 of E(0), which limits the comparison beyond 100 s.
    EXPECT_NEAR(found.relaxation.modulus(t), relaxed, 1e-8 * relaxed + 1e-11 * found.relaxation.instantaneous()) << t;
  }
}

TEST(Series, ARampIsTheMeanOfSteps) {
  const PronySeries series{1e8, {{2e9, 0.01}, {5e8, 3}}};
  const CreepSeries creep = creep_series(series);
  for (const double duration : {1e-6, 0.02, 5.0}) {
    for (const double t : {0.3 * duration, duration, 1.7 * duration}) {
      // The integral is computed by the midpoint rule with a step h of 1/2,000 of the ramp. For the ramp of 5 s, h is a
      // quarter of the shorter relaxation time τ, and the relative error of this unit is (h/τ)²/24 = 0.0026. The unit
      // adds at most 3 % to the mean, so the error of the mean is below 1e-4.
      constexpr int steps = 2000;
      double stress = 0, strain = 0;
      for (int i = 0; i < steps; ++i) {
        const double since = t - (i + 0.5) * duration / steps;
        stress += series.modulus(since) / steps, strain += creep.compliance(since) / steps;
      }
      EXPECT_NEAR(series.after_ramp(t, duration) / stress, 1, 1e-3) << t << " of " << duration;
      EXPECT_NEAR(creep.after_ramp(t, duration) / strain, 1, 1e-3) << t << " of " << duration;
    }
  }
  EXPECT_EQ(series.after_ramp(2, 0), series.modulus(2));
  EXPECT_EQ(series.after_ramp(-1, 0), 0);
  EXPECT_EQ(creep.after_ramp(-1, 3), 0);
}

// A sufficiently slow Kelvin unit acts as a dashpot, up to a fraction t/τ of its strain.
TEST(Series, ASlowUnitFlowsAfterARamp) {
  const CreepSeries dashpot{0, 1e-9, {}};
  const double duration = 0.02;
  for (const double time : {1e3, 1e6, 1e10, 1e14, 1e20}) {
    const CreepSeries unit{0, 0, {{1e-9 * time, time}}};
    for (const double t : {1e-3, 0.02, 0.021, 0.25, 0.3}) {
      const double flowed = dashpot.after_ramp(t, duration);
      EXPECT_NEAR(unit.after_ramp(t, duration) / flowed, 1, t / time + 1e-14) << t << " s, unit of " << time << " s";
    }
  }
}

TEST(Series, FewUnitsAreAsGoodAsAsked) {
  PronySeries many{2e7, {}};
  for (const double t : log_range(1e-4, 1e3, 30)) many.units.push_back({1e8 * (1 + std::sin(3 * std::log(t))), t});
  std::size_t more = 1;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const PronySeries few = few_units(many, 1e-3, 1e3, tolerance);
    // the error is also checked between the times of the fit
    EXPECT_LE(difference(few, many, 1e-3, 1e3), 1.01 * tolerance);
    EXPECT_GT(few.units.size(), more);
    EXPECT_LT(few.units.size(), many.units.size() / 4);
    more = few.units.size();
    for (const auto& u : few.units) EXPECT_GT(u.modulus, 0);
  }
}

TEST(Series, RangesAreEvenInTheLogarithm) {
  const std::vector<double> range = log_range(1e-3, 10, 3);
  ASSERT_EQ(range.size(), 13u);
  EXPECT_EQ(range.front(), 1e-3);
  EXPECT_EQ(range.back(), 10);
  EXPECT_NEAR(range[3], 1e-2, 1e-16);
  EXPECT_EQ(log_range(1, 2, 1).size(), 2u);
  const std::vector<double> widest = log_range(1e-300, 1e300, 1);  // the ratio of the ends is not finite
  ASSERT_EQ(widest.size(), 601u);
  for (std::size_t k = 0; k < widest.size(); ++k)
    EXPECT_NEAR(std::log10(widest[k]), static_cast<double>(k) - 300, 1e-9);
}

/// Compares the spectrum of a network with numerical Laplace inversions of solutions of the whole network. The two
/// computations share only the solver.
TEST(Spectrum, OfANetworkIsTheInversionOfItsSolutions) {
  for (const TestScene& scene : {make_scene(random_specimen(3)), make_scene(random_specimen(4), {}, am2_laws())}) {
    SpectrumOptions options;
    options.shortest = 1e-2, options.longest = 1e2, options.tolerance = 1e-7;
    const Spectrum found = spectrum_of(scene.specimen, scene.network, scene.laws, options);
    EXPECT_LT(found.error, 1e-7);
    EXPECT_LT(found.checked, 1e-7);
    const auto modulus = [&](Complex s) {
      Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, std::abs(s) / 6);
      return harmonic.solve({{s.imag() / (2 * std::numbers::pi), 0, 0, s.real()}}).front().parts.modulus();
    };
    for (const double t : {1e-2, 1.0, 1e2}) {
      const double relaxed = talbot([&](Complex s) { return modulus(s) / s; }, t, 18);
      EXPECT_NEAR(found.relaxation.modulus(t) / relaxed, 1, 1e-6) << t;
      const double creep = talbot([&](Complex s) { return 1.0 / (s * modulus(s)); }, t, 18);
      EXPECT_NEAR(found.creep.compliance(t) / creep, 1, 1e-6) << t;
    }
    // Creep and relaxation are inverse to each other: ∫ E(t − t')·J(t') dt' = t.
    const double t = 3;
    const auto product = talbot(
        [&](Complex s) {
          Complex j = found.creep.instantaneous + found.creep.fluidity / s;
          for (const auto& u : found.creep.units) j += u.compliance / (1.0 + s * u.time);
          return found.relaxation.stiffness(s) * j / (s * s);
        },
        t, 18);
    EXPECT_NEAR(product / t, 1, 1e-8);
  }
}

TEST(Spectrum, TheErrorThatIsStatedHolds) {
  const TestScene scene = make_scene(random_specimen(3));
  const auto known_to = [&](double tolerance) {
    SpectrumOptions options;
    options.tolerance = tolerance;
    return spectrum_of(scene.specimen, scene.network, scene.laws, options);
  };
  const Spectrum truth = known_to(1e-10);
  int solutions = 0;
  for (const double tolerance : {0.1, 1e-3, 1e-5, 1e-7}) {
    const Spectrum found = known_to(tolerance);
    EXPECT_LE(found.error, tolerance);
    EXPECT_LE(difference(found.relaxation, truth.relaxation, 1e-3, 1e4), found.error + truth.error) << tolerance;
    EXPECT_GE(found.solutions, solutions);
    solutions = found.solutions;
  }
  EXPECT_GE(truth.solutions, solutions);
}

TEST(Spectrum, ElasticNetworksDoNotRelax) {
  TestScene scene = make_scene(random_specimen(3));
  for (auto& law : scene.laws)
    if (law) law = laws::Elastic{std::visit([](const auto& l) { return l.instantaneous(); }, *law), 0.1};
  const Spectrum found = spectrum_of(scene.specimen, scene.network, scene.laws);
  EXPECT_TRUE(found.relaxation.units.empty());
  EXPECT_NEAR(found.relaxation.long_term * found.creep.compliance(7), 1, 1e-12);
}

TEST(Spectrum, WhatMakesNoSenseIsRefused) {
  const TestScene scene = make_scene(random_specimen(3));
  const auto with = [&](auto&& change) {
    SpectrumOptions options;
    change(options);
    spectrum_of(scene.specimen, scene.network, scene.laws, options);
  };
  EXPECT_THROW(with([](auto& o) { o.shortest = 0; }), InputError);
  EXPECT_THROW(with([](auto& o) { o.longest = o.shortest; }), InputError);
  EXPECT_THROW(with([](auto& o) { o.tolerance = 0; }), InputError);
  EXPECT_THROW(with([](auto& o) { o.stop = [] { return true; }; }), InterruptedError);
  EXPECT_THROW(creep_series({}), InputError);
}

}  // namespace
}  // namespace macadam::test
