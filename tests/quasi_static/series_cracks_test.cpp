// SPDX-License-Identifier: GPL-3.0-or-later
// series_cracks_test.cpp  Tests increments of contacts that have rock in series and cracks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "macadam/quasi_static.hpp"
#include "tests/support/cracking_t8.hpp"

namespace macadam::test {
namespace {

constexpr std::size_t top = wall_index(wall_z_hi);
constexpr double compliance = 4e-11;  // of the rock [1/Pa]: 0.4 to 1.4 of the compliances of the springs of mastic

/// Tests that run on the CPU and, if there is one, on a device.
class SeriesCracksOn : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, SeriesCracksOn, testing::ValuesIn(tested_backends()),
                         [](const auto& info) { return std::string(to_string(info.param)); });

bool has_a_mastic_law(PairType pair) { return pair == PairType::mm || pair == PairType::ma; }

/// Puts rock in series with the contacts of mastic.
void add_rock(TestScene& scene) {
  for (Contact& c : scene.network.contacts) {
    if (has_a_mastic_law(c.pair)) c.series = compliance;
  }
}

/// Calls f(law) for the laws of mastic of a scene, which have cracks.
template <class F>
void each_law(TestScene& scene, F&& f) {
  for (const PairType pair : {PairType::mm, PairType::ma})
    f(std::get<laws::Cracked<laws::GeneralisedKelvin>>(*scene.laws[static_cast<std::size_t>(pair)]));
}

QuasiStatic quasi_static_of(const TestScene& scene, Backend backend) {
  QuasiStaticOptions options;
  options.backend = backend;
  return {scene.specimen, scene.network, scene.laws, options};
}

/// Takes an increment of strain, along which the stress must rise or fall without a jump.
void pull_by(QuasiStatic& q, double strain) {
  WallIncrement next;
  next.dt = strain;  // 1 1/s
  next.wall[top].z = strain * t8_height;
  ASSERT_TRUE(q.solve(next).converged) << q.time();
  q.accept();
}

double force(const QuasiStatic& q) { return q.wall_force()[top].z; }

// A spring of compliance r in series with a law is a part of the law's own spring, 1/E_m' = 1/E_m + r, if shear has the
// same stiffness as tension. The increments then differ by rounding, which friction and damage amplify.
TEST_P(SeriesCracksOn, RockIsASpringOfTheLaw) {
  TestScene stiff = cracking_t8(), soft = cracking_t8();
  for (TestScene* scene : {&stiff, &soft}) each_law(*scene, [](auto& law) { law.alpha = 1; });
  each_law(soft, [](auto& law) { law.E_m = 1 / (1 / law.E_m + compliance); });
  add_rock(stiff);
  QuasiStatic with_rock = quasi_static_of(stiff, GetParam()), without = quasi_static_of(soft, GetParam());
  for (int k = 1; k <= 40; ++k) {
    for (QuasiStatic* q : {&with_rock, &without}) ASSERT_NO_FATAL_FAILURE(pull_by(*q, 3e-5));
    EXPECT_NEAR(force(with_rock), force(without), 1e-6 * std::abs(force(without))) << k;
  }
  const auto cracks = without.point_cracks();
  EXPECT_GT(std::ranges::count_if(cracks, [](const auto& c) { return c.damage > 0; }), 100);
  EXPECT_LT(with_rock.energies().imbalance(), 1e-9);
  EXPECT_NEAR(with_rock.energies().elastic_j, without.energies().elastic_j, 1e-6 * without.energies().elastic_j);
}

// Contacts whose strength is never reached have the forces of their law, which has another factor in shear than in
// tension. Their points carry what the whole contact carries otherwise; forces are out of balance by 1e-10.
TEST_P(SeriesCracksOn, IntactContactsHaveTheirLinearLaw) {
  TestScene strong = cracking_t8(), linear = cracking_t8();
  for (TestScene* scene : {&strong, &linear}) {
    add_rock(*scene);
    scene->laws[static_cast<std::size_t>(PairType::aa)] = laws::Elastic{1.151e11, 0.05};
  }
  each_law(strong, [](auto& law) { law.alpha = 0.25, law.crack.tensile_strength = law.crack.shear_strength = 1e12; });
  each_law(linear, [](auto& law) { law.alpha = 0.25; });
  for (const PairType pair : {PairType::mm, PairType::ma}) {
    auto& law = *linear.laws[static_cast<std::size_t>(pair)];
    law = laws::GeneralisedKelvin(std::get<laws::Cracked<laws::GeneralisedKelvin>>(law));
  }
  QuasiStatic with_cracks = quasi_static_of(strong, GetParam()), without = quasi_static_of(linear, GetParam());
  for (int k = 1; k <= 5; ++k) {
    for (QuasiStatic* q : {&with_cracks, &without}) ASSERT_NO_FATAL_FAILURE(pull_by(*q, 3e-5));
    EXPECT_NEAR(force(with_cracks), force(without), 1e-8 * std::abs(force(without))) << k;
  }
  EXPECT_NEAR(with_cracks.energies().elastic_j, without.energies().elastic_j, 1e-8 * without.energies().elastic_j);
  EXPECT_NEAR(with_cracks.energies().viscous_j, without.energies().viscous_j, 1e-8 * without.energies().viscous_j);
  EXPECT_LT(with_cracks.energies().imbalance(), 1e-9);
}

}  // namespace
}  // namespace macadam::test
