// SPDX-License-Identifier: GPL-3.0-or-later
/// \file laws_test.cpp  Compares the contact laws with closed forms and with the laws of the reference implementation.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "host/reference/reference_law.hpp"
#include "host/run/error_model.hpp"
#include "macadam/error.hpp"
#include "macadam/laws/all.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam {
namespace {

using laws::Elastic;
using laws::GeneralisedKelvin;
using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// One displacement component, to which a law of the library is applied.
template <class L>
class Element {
 public:
  Element(const L& law, double dt, double f = 0) : step_(law.template step<double>(dt)), x_(law.units(), 0.0), f_(f) {}
  double advance(double dx) {
    f_ = step_.template advance<-1>(f_, dx, [&](int l) -> double& { return x_[l]; });
    return f_;
  }
  double force() const { return f_; }
  const std::vector<double>& stretch() const { return x_; }
  const auto& step() const { return step_; }

 private:
  typename L::template Step<double> step_;
  std::vector<double> x_;
  double f_;
};

/// Computes the force for one component of a contact's relative displacement, with the chain (springs and dashpots in
/// series) of the reference implementation. The ratio of facet area to distance is 1.
class ReferenceElement {
 public:
  ReferenceElement(const Law& law, double dt, double f = 0) : law_(reference::make_reference_law(law, "M-M")), dt_(dt) {
    state_.force = f;
    state_.stretch.assign(law_.units.size(), 0.0);
  }
  double advance(double dx) {
    reference::advance_chain(law_, 1.0, dt_, dx, state_);
    return state_.force;
  }
  const std::vector<double>& stretch() const { return state_.stretch; }

 private:
  reference::ReferenceLaw law_;
  double dt_;
  reference::ChainState state_;
};

struct Case {
  std::string name;
  GeneralisedKelvin law;
  double settling;  ///< more than 35 times the slowest relaxation time [s]; transients decay below e⁻³⁵ ≈ 6e-16
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// The slowest relaxation time of a chain (springs and dashpots in series) is below (ΣC_l + C_m)/min E_l.
std::vector<Case> cases() {
  GeneralisedKelvin no_flow = test::mastic_am1();
  no_flow.C_m = infinity;
  return {
      {"Maxwell", {2.0e9, 1.0e8, {}, {}}, 2},
      {"Spring", {2.0e9, infinity, {}, {}}, 1},
      {"Burgers", {2.0e9, 1.0e9, {1.0e9}, {3.0e8}}, 80},
      {"TwoUnits", {2.0e9, 1.0e9, {1.0e9, 4.0e9}, {3.0e8, 1.0e7}}, 80},
      {"AM1", test::mastic_am1(), 1200},
      {"AM2", test::mastic_am2(), 60},
      {"AM1WithoutFlow", no_flow, 1000},
      {"FiveUnits", {1.0e10, 2.0e9, {3.0e9, 1.0e9, 5.0e9, 2.0e9, 4.0e9}, {1.0e9, 2.0e7, 5.0e8, 1.0e8, 3.0e7}}, 130}};
}

/// Returns the complex stiffness of an element that is driven by x = sin(2πft), evaluated over the last whole cycle.
template <class E>
std::complex<double> measured_stiffness(E element, double frequency, double settling, int steps_per_cycle) {
  const int n = steps_per_cycle;
  std::vector<double> x(n);
  for (int k = 0; k < n; ++k) x[k] = std::sin(2 * pi * k / n);
  // If Δt is much larger than a relaxation time τ, the trapezoidal rule damps the transient of this time by only 4τ/Δt
  // per step. 200 more cycles are enough for τ > Δt/1000.
  const auto cycles = static_cast<std::int64_t>(std::ceil(settling * frequency)) + 200;
  for (std::int64_t c = 0; c + 1 < cycles; ++c) {
    for (int k = 0; k < n; ++k) element.advance(x[(k + 1) % n] - x[k]);
  }
  // f = Im(k*·e^{iωt}) = (k*·e^{iωt} − c.c.)/2i, and e^{−2iωt} has zero mean over whole cycles.
  const std::complex<double> i(0, 1);
  std::complex<double> mean = 0;
  for (int k = 0; k < n; ++k) {
    mean += element.advance(x[(k + 1) % n] - x[k]) * std::exp(-2 * pi * i * double(k + 1) / double(n));
  }
  return 2.0 * i * mean / double(n);
}

class ComplexStiffness : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Chains, ComplexStiffness, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

// For a harmonic at ω, the trapezoidal rule gives exactly the stiffness of the continuous law at (2/Δt)·tan(ωΔt/2).
// Tolerance: rounding over up to 2e6 steps is a random walk, 1400·1.1e-16, in forces up to E_m, while |k*| may be as
// small as E_m/1000.
TEST_P(ComplexStiffness, IsExactAtTheWarpedFrequency) {
  const auto& [name, law, settling] = GetParam();
  constexpr int n = 64;
  for (double f : {0.02, 2.0, 20.0}) {
    const double dt = 1 / (f * n);
    const auto exact = law.stiffness(std::complex<double>(0, 2 / dt * std::tan(pi / n)));
    EXPECT_LT(std::abs(measured_stiffness(Element(law, dt), f, settling, n) - exact) / std::abs(exact), 1e-9) << f;
    if (f < 1) {  // the reference is slow
      EXPECT_LT(std::abs(measured_stiffness(ReferenceElement(law, dt), f, settling, n) - exact) / std::abs(exact),
                1e-9);
    }
  }
}

// The error is of second order, so half the step gives a quarter of the error. The next term of the error is
// (ωΔt)² = 0.01 times the first.
TEST_P(ComplexStiffness, ConvergesAtSecondOrder) {
  const auto& law = GetParam().law;
  const double settling = GetParam().settling;
  const std::string name = GetParam().name;
  const double f = 0.5;
  const auto exact = law.stiffness(std::complex<double>(0, 2 * pi * f));
  const auto error = [&](int n) {
    return std::abs(measured_stiffness(Element(law, 1 / (f * n)), f, settling, n) - exact) / std::abs(exact);
  };
  const double coarse = error(64), fine = error(128);
  if (name == "Spring") {
    EXPECT_LT(coarse, 1e-12);  // this law needs no integration, so there are only 64 roundings
  } else {
    EXPECT_LT(coarse, 1e-3);  // (ωΔt)²/12 = 8e-4
    EXPECT_NEAR(coarse / fine, 4, 0.05);
  }
}

TEST_P(ComplexStiffness, TendsToTheInstantaneousStiffness) {
  const auto& law = GetParam().law;
  // At ω the dashpots reduce the stiffness by E_m/(ω·C), summed over all dashpots by less than 5e10/(1e12·2e6).
  EXPECT_LT(std::abs(law.stiffness(std::complex<double>(0, 1e12)) - law.instantaneous()) / law.instantaneous(), 1e-6);
}

// The library and the reference implementation follow the same random motion. Over 1e4 steps, rounding errors grow as a
// random walk to 100·1.1e-16 of the largest force, which is E_m times a displacement of 1.
TEST_P(ComplexStiffness, LibraryAndReferenceAgree) {
  const auto& law = GetParam().law;
  for (double dt : {1e-7, 1e-3, 1.0}) {
    Element element(law, dt);
    ReferenceElement reference(law, dt);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> increment(-1e-2, 1e-2);
    for (int k = 0; k < 10'000; ++k) {
      const double dx = increment(random);
      ASSERT_NEAR(element.advance(dx), reference.advance(dx), 1e-12 * law.E_m) << dt << " s, step " << k;
    }
    for (int l = 0; l < law.units(); ++l) EXPECT_NEAR(element.stretch()[l], reference.stretch()[l], 1e-12) << dt;
  }
}

/// Returns the displacement of creep under a unit force, in closed form.
double creep(const GeneralisedKelvin& law, double t) {
  double x = 1 / law.E_m + t / law.C_m;
  for (std::size_t l = 0; l < law.E.size(); ++l) x += -std::expm1(-law.E[l] * t / law.C[l]) / law.E[l];
  return x;
}

/// Returns the displacement after `steps` steps under a unit force. Each step chooses dx so that the force f stays
/// constant; dx follows from Eq. 13 of [1] with f(t+Δt) = f(t).
double computed_creep(const GeneralisedKelvin& law, double dt, int steps) {
  Element element(law, dt, 1.0);
  double x = 1 / law.E_m;
  for (int k = 0; k < steps; ++k) {
    const auto& c = element.step();
    double dx = c.relax / c.inv_c;
    for (int l = 0; l < law.units(); ++l) dx -= c.recover[l] * element.stretch()[l];
    element.advance(dx);
    x += dx;
  }
  EXPECT_NEAR(element.force(), 1, steps * 4e-16);  // one or two roundings per step
  return x;
}

TEST(Creep, FollowsTheClosedForm) {
  for (const Case& c : cases()) {
    if (c.name == "Spring") continue;
    // The time is one relaxation time of the fastest unit, so that all units are still creeping.
    double t = 1;
    for (std::size_t l = 0; l < c.law.E.size(); ++l) t = std::min(t, c.law.C[l] / c.law.E[l]);
    const double exact = creep(c.law, t);
    const double coarse = std::abs(computed_creep(c.law, t / 50, 50) - exact) / exact;
    const double fine = std::abs(computed_creep(c.law, t / 100, 100) - exact) / exact;
    if (c.law.units() == 0) {
      EXPECT_LT(coarse, 1e-13) << c.name;  // a Maxwell unit creeps linearly, so there are only 50 roundings
    } else {
      EXPECT_LT(coarse, 2e-5) << c.name;  // (Δt/τ)²/12·e⁻¹ times the part of one unit in the creep
      EXPECT_NEAR(coarse / fine, 4, 0.02) << c.name;
    }
  }
}

/// Returns the force after `steps` steps at rest that follow a sudden unit displacement.
double computed_relaxation(const GeneralisedKelvin& law, double dt, int steps) {
  Element element(law, dt, law.E_m);
  for (int k = 0; k < steps; ++k) element.advance(0);
  return element.force();
}

void expect_relaxation(const GeneralisedKelvin& law, double t, double exact) {
  const double coarse = std::abs(computed_relaxation(law, t / 100, 100) / exact - 1);
  const double fine = std::abs(computed_relaxation(law, t / 200, 200) / exact - 1);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.05);  // the next term of the error is (Δt/τ)² times the first, below 1e-2
}

TEST(Relaxation, Maxwell) {
  const GeneralisedKelvin law{2.0e9, 1.0e9, {}, {}};
  expect_relaxation(law, 0.7, 2.0e9 * std::exp(-0.7 * 2.0));
}

TEST(Relaxation, Zener) {
  const GeneralisedKelvin law{2.0e9, infinity, {1.0e9}, {3.0e9}};
  const double t = 1.1, k = 2.0e9, k1 = 1.0e9, rate = (k + k1) / 3.0e9;
  expect_relaxation(law, t, k / (k + k1) * (k1 + k * std::exp(-rate * t)));
}

TEST(Relaxation, Burgers) {
  const double k = 2.0e9, eta = 1.5e9, k1 = 1.0e9, eta1 = 0.8e9, t = 0.9;
  // For a step of x, f + p1·f' + p2·f'' = q1·x' + q2·x'' has a solution of two exponentials.
  const double p1 = eta / k + eta / k1 + eta1 / k1, p2 = eta * eta1 / (k * k1);
  const double q1 = eta, q2 = eta * eta1 / k1;
  const double root = std::sqrt(p1 * p1 - 4 * p2), r1 = (p1 - root) / (2 * p2), r2 = (p1 + root) / (2 * p2);
  const double exact = ((q1 - q2 * r1) * std::exp(-r1 * t) - (q1 - q2 * r2) * std::exp(-r2 * t)) / root;
  expect_relaxation({k, eta, {k1}, {eta1}}, t, exact);
}

TEST(ElasticLimit, AChainWithoutDashpotsIsTheElasticLaw) {
  const GeneralisedKelvin chain{2.0e9, infinity, {}, {}};
  const GeneralisedKelvin stiff{2.0e9, 1e30, {1e9, 2e9}, {1e30, 1e30}};
  Element spring(Elastic{2.0e9}, 1e-3);
  Element bare(chain, 1e-3), slow(stiff, 1e-3);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> increment(-1, 1);
  for (int k = 0; k < 1000; ++k) {
    const double dx = increment(random);
    spring.advance(dx), bare.advance(dx), slow.advance(dx);
    // The tolerance covers a thousand roundings of forces below 1e2·E. The dashpots with a viscosity of 1e30 move per
    // second by only 1e-21 of the displacement.
    ASSERT_NEAR(bare.force(), spring.force(), 1e-11 * 2.0e9);
    ASSERT_NEAR(slow.force(), spring.force(), 1e-11 * 2.0e9);
  }
}

TEST(ElasticLimit, NoUnitsAreNoTrouble) {
  const auto step = GeneralisedKelvin{2.0e9, infinity, {}, {}}.step<float>(1e-7);
  EXPECT_EQ(step.n, 0);
  EXPECT_EQ(step.relax, 0);
  EXPECT_FLOAT_EQ(step.inv_c, 2.0e9f);
  const float f = step.advance<0>(1.0f, 0.0f, [](int) -> float& { throw std::logic_error("no unit to ask for"); });
  EXPECT_EQ(f, 1);
}

TEST(Step, TheNumberOfUnitsMayBeKnownToTheCompiler) {
  const auto step = test::mastic_am1().step<double>(1e-4);
  double x[3] = {1e-3, 2e-3, 3e-3}, y[3] = {1e-3, 2e-3, 3e-3};
  const double f = step.advance<3>(1e6, 1e-4, [&](int l) -> double& { return x[l]; });
  const double g = step.advance<-1>(1e6, 1e-4, [&](int l) -> double& { return y[l]; });
  EXPECT_DOUBLE_EQ(f, g);
  for (int l = 0; l < 3; ++l) EXPECT_DOUBLE_EQ(x[l], y[l]);
}

/// Errors of the force f under a sinusoidal displacement if the state of the law is updated once per block of steps,
/// compared with an update at every step.
struct BlockErrors {
  double largest;      ///< largest difference over the largest f
  double fundamental;  ///< error of amplitude and phase in the last cycle, |ratio − 1|
};

/// Returns the errors over `cycles` cycles of a sine, in blocks of `block` steps. `Real` is the type of δf, the change
/// of f within a block, and of the sum of these changes.
template <class Real, class L>
BlockErrors block_errors(const L& law, double frequency, int steps_per_cycle, int block, int cycles) {
  const double dt = 1 / (frequency * steps_per_cycle);
  Element<L> exact(law, dt);
  const auto blocks = law.block(dt, block);
  std::vector<double> x(static_cast<std::size_t>(law.units()), 0.0);
  const auto unit = [&](int l) -> double& { return x[static_cast<std::size_t>(l)]; };
  const Real rate = static_cast<Real>(blocks.rate), relax = static_cast<Real>(blocks.relax);
  const Real follow = static_cast<Real>(blocks.follow);
  Real change = 0, sum = 0, drive = 0;
  double f = 0, error = 0, most = 0;
  std::complex<double> found, wanted;
  for (int k = 0; k < cycles * steps_per_cycle; ++k) {
    if (k % block == 0) {
      const double start = f;
      f += static_cast<double>(change);
      if (k > 0) blocks.template settle<-1>(2.0 * block * start + static_cast<double>(sum), unit);
      drive = static_cast<Real>(blocks.template drift<-1>(f, unit));
      change = sum = 0;
    }
    const double phase = 2 * pi * (k % steps_per_cycle) / steps_per_cycle, next = phase + 2 * pi / steps_per_cycle;
    const double dx = 2 * std::cos((phase + next) / 2) * std::sin(pi / steps_per_cycle);
    const Real before = change;
    change += rate * static_cast<Real>(dx) + (drive + follow * sum - relax * before);
    sum += change + before;
    const double expected = exact.advance(dx);
    error = std::max(error, std::abs(f + static_cast<double>(change) - expected));
    most = std::max(most, std::abs(expected));
    if (k >= (cycles - 1) * steps_per_cycle) {
      found += std::polar(1.0, -next) * (f + static_cast<double>(change));
      wanted += std::polar(1.0, -next) * expected;
    }
  }
  return {error / most, std::abs(found / wanted - 1.0)};
}

TEST(Block, ConvergesAtSecondOrder) {
  for (const auto& law : {test::mastic_am1(), test::mastic_am2()}) {
    for (const double frequency : {2.0, 20.0}) {
      const double coarse = block_errors<double>(law, frequency, 20000, 40, 1).largest;
      const double fine = block_errors<double>(law, frequency, 20000, 20, 1).largest;
      EXPECT_LT(fine, coarse / 3.5) << frequency << " Hz, " << law.units() << " units";
    }
  }
}

/// A block lasts 1/4000 of the period, or of 2π times the shortest time of the law if this is less. The error of f
/// within a block is a saw-tooth of at most (2π/4000)²/8 = 3e-7. In single precision, δf (at most 2π/4000 of f) and the
/// drive are rounded by 2^-24. Over the steps of the 4,000 blocks of a period these errors add up as a random walk,
/// which stays below 3e-7.
TEST(Block, IsExactEnoughAtAFourThousandthOfTheShortestTime) {
  for (const auto& law : {test::mastic_am1(), test::mastic_am2()}) {
    for (const double frequency : {2.0, 20.0}) {
      const double shortest = std::min(1 / frequency, 2 * pi * law.shortest_time());
      const int block = static_cast<int>(shortest * frequency * 400000 / 4000);
      EXPECT_LT(block_errors<double>(law, frequency, 400000, block, 2).largest, 3e-7);
      EXPECT_LT(block_errors<float>(law, frequency, 400000, block, 2).largest, 3e-7);
    }
  }
  EXPECT_LT(block_errors<double>(Elastic{1e10, 0}, 20, 4000, 100, 2).largest, 1e-13);
  EXPECT_EQ((Elastic{1e10, 0}).shortest_time(), infinity);
  EXPECT_DOUBLE_EQ(test::mastic_am1().shortest_time(), 1.114e9 / 4.308e10);
}

/// If a block is as long as a tolerance allows, amplitude and phase have at most the error that the plan assumes. This
/// also holds if δf, the change of f within a block, is in single precision.
TEST(Block, OfTheLengthThatAnErrorAllowsKeepsIt) {
  for (const auto& law : {test::mastic_am1(), test::mastic_am2()}) {
    for (const double frequency : {2.0, 5.0, 20.0}) {
      const double shortest = std::min(1 / frequency, 2 * pi * law.shortest_time());
      for (const double error : {2e-3, 2e-4, 2e-5, 2e-6}) {
        SCOPED_TRACE(error);
        const double blocks = blocks_within(error);
        EXPECT_NEAR(block_error(blocks), error, 1e-12);
        const int block = static_cast<int>(shortest * frequency * 40000 / blocks);
        EXPECT_LT(block_errors<double>(law, frequency, 40000, block, 2).fundamental, error) << frequency << " Hz";
        EXPECT_LT(block_errors<float>(law, frequency, 40000, block, 2).fundamental, error) << frequency << " Hz";
      }
    }
  }
  EXPECT_EQ(blocks_within(1e-9), 4000);
  EXPECT_LT(block_error(4000), 3e-7);
}

// If 1 − b/a were computed in single precision, it would be 0 or 1.2e-7 here. The step computes it in double precision
// and rounds it once, so its relative error is at most 6e-8.
TEST(Step, SinglePrecisionCoefficientsDoNotCancel) {
  const auto step = GeneralisedKelvin{1, 1, {1, 10}, {1, 1}}.step<float>(1e-9);
  EXPECT_NEAR(step.recover[0], 1e-9, 1e-16);
  EXPECT_NEAR(step.recover[1], 1e-8, 1e-15);
  EXPECT_NEAR(step.compliance[0], 0.5e-9, 0.5e-16);
  EXPECT_NEAR(step.relax, 3e-9, 3e-16);  // Δt·k_m·(1/η_m + Σ 1/η_l)
}

TEST(ReferenceLaw, NamesWhatIsWrong) {
  const auto message = [](const Law& law) -> std::string {
    try {
      reference::make_reference_law(law, "M-A");
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  };
  EXPECT_NE(message(Elastic{-1}).find("M-A"), std::string::npos);
  EXPECT_NE(message(Elastic{NAN}).find("nan"), std::string::npos);
  EXPECT_NE(message(GeneralisedKelvin{1, 1, {1, 2}, {1}}).find("2 E and 1 C"), std::string::npos);
  EXPECT_NE(message(GeneralisedKelvin{0, 1, {}, {}}).find("E_m"), std::string::npos);
  EXPECT_NE(message(GeneralisedKelvin{1, 0, {}, {}}).find("C_m"), std::string::npos);
  EXPECT_NE(message(GeneralisedKelvin{1, 1, {1}, {-2}}).find("-2"), std::string::npos);
  EXPECT_NE(message(Elastic{1, -0.1}).find("alpha"), std::string::npos);
  EXPECT_EQ(message(Elastic{1}), "accepted");
}

}  // namespace
}  // namespace macadam
