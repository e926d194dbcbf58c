// SPDX-License-Identifier: GPL-3.0-or-later
// chain_energy_test.cpp  Tests the energies that laws report for their springs and dashpots against the work that steps
// do on a chain.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "macadam/laws/all.hpp"

namespace macadam::test {
namespace {

const laws::GeneralisedKelvin chain{1e10, 1e10, {2e10, 1e10, 5e9}, {2e8, 1e9, 5e9}, 0.1};

/// Moves a chain along a sine for 1.3 periods and returns work − stored − dissipated, over the work. The dissipation is
/// computed from `samples` states.
double missing(const laws::GeneralisedKelvin& law, int samples) {
  constexpr int steps = 120'000;
  const double dt = 1.3 / steps;
  const auto step = law.step<double>(dt);
  double f = 0, x[4] = {}, work = 0, dissipated = 0, f_before = 0, x_before[4] = {}, at = 0;
  for (int k = 1; k <= steps; ++k) {
    const double next = 1e-6 * std::sin(2 * std::numbers::pi * k * dt), before = f;
    f = step.advance<-1>(f, next - at, [&](int l) -> double& { return x[l]; });
    work += 0.5 * (f + before) * (next - at);
    at = next;
    if (k % (steps / samples) != 0) continue;
    dissipated += law.dissipated(dt * (steps / samples), f_before, x_before, f, x);
    f_before = f;
    std::copy(x, x + 4, x_before);
  }
  return (work - law.stored(f, x) - dissipated) / work;
}

// With a sample at each step the trapezoidal rule of the chain conserves energy up to its own error. With Δ between
// samples, f is linear within Δ: the energy of the dashpot in series is too small by about (2πΔ)²/6.
TEST(ChainEnergy, StoredAndDissipatedAreTheWork) {
  EXPECT_NEAR(missing(chain, 120'000), 0, 1e-8);
  const double coarse = missing(chain, 100), fine = missing(chain, 200);
  EXPECT_LT(std::abs(coarse), std::pow(2 * std::numbers::pi * 0.013, 2) / 6);
  EXPECT_NEAR(coarse / fine, 4, 0.2) << "second order";
}

// Without the dashpot in series the error is of fourth order, if the samples resolve the fastest unit, of 10 ms.
TEST(ChainEnergy, KelvinUnitsAreOfFourthOrder) {
  laws::GeneralisedKelvin law = chain;
  law.C_m = std::numeric_limits<double>::infinity();
  const double coarse = missing(law, 240), fine = missing(law, 480);
  EXPECT_LT(std::abs(coarse), 1e-6);
  EXPECT_NEAR(coarse / fine, 16, 2);
}

TEST(ChainEnergy, ASpringStoresEverything) {
  const laws::Elastic spring{2e9, 0.3};
  EXPECT_DOUBLE_EQ(spring.stored(4e3, nullptr), 4e-3);  // f²/(2E)
  EXPECT_EQ(spring.dissipated(1, 4e3, nullptr, 5e3, nullptr), 0);
}

// A law with a crack has the energies of its chain.
TEST(ChainEnergy, LawsWithACrackHaveIt) {
  EXPECT_TRUE(has_energy<laws::Cracked<laws::GeneralisedKelvin>>);
  EXPECT_TRUE(has_energy<laws::Cracked<laws::Elastic>>);
  EXPECT_FALSE(has_energy<laws::BrittleBond>);
}

}  // namespace
}  // namespace macadam::test
