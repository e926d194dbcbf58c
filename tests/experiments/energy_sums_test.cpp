// SPDX-License-Identifier: GPL-3.0-or-later
// energy_sums_test.cpp  Tests the sums over contact points that a stepped test with cracks takes at each row: their
// values, and that their bits do not depend on the number of threads.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "host/run/cracks.hpp"
#include "host/run/energy_ledger.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam::test {
namespace {

/// More contacts and particles than two pieces of a parallel sum have, and no multiple of the length of a piece.
constexpr std::int32_t particles = 2501;

/// Returns a number from 0 to 1 that depends on k without an obvious pattern.
double number(std::size_t k) {
  const double x = 0.5 + 0.6180339887498949 * static_cast<double>(k % 104729);
  return x - std::floor(x);
}

/// A row of particles whose contacts have three laws in turn: two with a crack, and an elastic one.
struct Row {
  HandMade made;
  Laws laws;
  ParticleState motion;

  Row() {
    laws[static_cast<std::size_t>(PairType::mm)] =
        laws::Cracked<laws::GeneralisedKelvin>{mastic_am1(), {1e6, 50, 1.5e6, 50, 0.5, 0.5}};
    laws[static_cast<std::size_t>(PairType::ma)] =
        laws::Cracked<laws::Elastic>{{1e11, 0.05}, {2e6, 60, 3e6, 60, 0.6, 0.6}};
    laws[static_cast<std::size_t>(PairType::aw)] = laws::Elastic{2e10, 0.3};
    constexpr PairType pairs[] = {PairType::mm, PairType::ma, PairType::aw};
    for (std::int32_t i = 0; i < particles; ++i) {
      const auto k = static_cast<std::size_t>(i);
      add_particle(made, {0, 0, 2e-3 * i}, 1e-3, 1e-5 * (1 + number(k)), Phase::mastic);
      const auto vector = [k](std::size_t seed) {
        return Vec3d{number(3 * k + seed) - 0.5, number(5 * k + seed), number(7 * k + seed) - 0.3};
      };
      motion.velocity.push_back(vector(1)), motion.spin.push_back(vector(2));
      motion.force.push_back(vector(3)), motion.moment.push_back(vector(4));
      if (i > 0)
        add_square_contact(made.network, i - 1, i, pairs[i % 3], {0, 0, 1}, 1e-3, 1e-3, 1e-3 * (1 + number(k)));
    }
    made.network.row_begin.assign(static_cast<std::size_t>(particles) + 1, 0);  // only their number is read
  }

  const Law& law_of(const Contact& c) const { return *laws[static_cast<std::size_t>(c.pair)]; }

  /// Returns a state in which all numbers of the chains differ.
  ContactState state(std::size_t seed) const {
    ContactState out;
    out.chain_begin.push_back(0);
    for (const Contact& c : made.network.contacts) {
      const auto words = static_cast<std::size_t>(std::visit([](const auto& l) { return 1 + l.units(); }, law_of(c)));
      out.chain_begin.push_back(out.chain_begin.back() + 3 * (c.point_end - c.point_begin) * words);
    }
    for (std::size_t k = 0; k < out.chain_begin.back(); ++k) out.chain.push_back(number(11 * k + seed) - 0.4);
    for (std::size_t p = 0; p < made.network.point_area.size(); ++p) {
      const double damage = std::max(0.0, number(13 * p + seed) - 0.5);
      out.point_cracks.push_back({damage * 1e-5, damage * 2e-5, damage, 40 * damage, 3 * damage});
      out.point_breaks.push_back(damage > 0.45 ? number(p) > 0.5 ? Break::tension : Break::shear : Break::none);
    }
    return out;
  }
};

/// Calls f(threads) with one, two and three threads.
template <class F>
void with_threads(F&& f) {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    f(threads);
  }
  omp_set_num_threads(before);
}

/// Energies of springs and dashpots, summed contact after contact.
struct PlainSums {
  double elastic = 0, viscous = 0;
};
PlainSums plain_sums(const Row& row, const ContactState& before, const ContactState& now, double dt) {
  PlainSums out;
  for (std::size_t c = 0; c < row.made.network.contacts.size(); ++c) {
    const Contact& contact = row.made.network.contacts[c];
    std::visit(
        [&]<class L>(const L& law) {
          if constexpr (has_energy<L>) {
            std::size_t skipped = 1;
            if constexpr (cracking_law<L>) skipped += static_cast<std::size_t>(L::crack_numbers);
            std::size_t at = now.chain_begin[c];
            for (std::uint32_t p = contact.point_begin; p < contact.point_end; ++p) {
              for (int k = 0; k < 3; ++k, at += static_cast<std::size_t>(1 + law.units())) {
                const double weight = (k > 0 ? law.alpha : 1) * row.made.network.point_area[p] / contact.length;
                const double *x = &now.chain[at], *old = &before.chain[at];
                out.elastic += weight * law.stored(*x, x + skipped);
                out.viscous += weight * law.dissipated(dt, *old, old + skipped, *x, x + skipped);
              }
            }
          } else {
            FAIL() << "the laws of the row have energies";
          }
        },
        row.law_of(contact));
  }
  return out;
}

// The first interval begins at rest, the second one with the chains of the first row, which the ledger keeps.
TEST(EnergyLedger, HasTheSameBitsWithAnyNumberOfThreads) {
  const Row row;
  const double dt = 1e-3;
  const ContactState first = row.state(1), second = row.state(2);
  ContactState rest = first;
  std::fill(rest.chain.begin(), rest.chain.end(), 0.0);
  const PlainSums to_first = plain_sums(row, rest, first, dt), to_second = plain_sums(row, first, second, dt);
  double kinetic = 0;
  for (std::size_t i = 0; i < row.motion.velocity.size(); ++i) {
    const Vec3d &v = row.motion.velocity[i], &w = row.motion.spin[i];
    kinetic += 50 * (row.made.inertia.mass[i] * dot(v, v) + row.made.inertia.inertia[i] * dot(w, w)) +
               0.5e-6 * (dot(row.motion.force[i], v) + dot(row.motion.moment[i], w));
  }
  std::vector<experiments::Energies> found;
  with_threads([&](int threads) {
    SCOPED_TRACE(threads);
    EnergyLedger ledger(row.made.network, row.laws, row.made.inertia, 100, 1e-6, false);
    ContactState contacts = first;
    Observation now;
    now.time = dt;
    ledger.sample(now, contacts, row.motion, {});
    EXPECT_EQ(ledger.state().chain, first.chain);
    contacts = second;
    now.time = 2 * dt;
    found.push_back(ledger.sample(now, contacts, row.motion, {}));
    EXPECT_EQ(ledger.state().chain, second.chain);
    EXPECT_EQ(contacts.chain, first.chain);
    EXPECT_EQ(found.back().elastic_j, found.front().elastic_j);
    EXPECT_EQ(found.back().viscous_j, found.front().viscous_j);
    EXPECT_EQ(found.back().kinetic_j, found.front().kinetic_j);
  });
  // Sums of 37,500 positive numbers in another order differ by less than their number of roundings
  const double rounding = 15.0 * particles * 0x1p-53;
  EXPECT_NEAR(found.front().elastic_j, to_second.elastic, rounding * to_second.elastic);
  const double viscous = to_first.viscous + to_second.viscous;
  EXPECT_NEAR(found.front().viscous_j, viscous, rounding * viscous);
  // The terms of the second kind have both signs; they are smaller than those of the first kind
  EXPECT_NEAR(found.front().kinetic_j, kinetic, 2 * rounding * kinetic);
}

// Events come in the order of the contacts, each point once, and the sums have the same bits.
TEST(CrackWatch, FindsTheSameWithAnyNumberOfThreads) {
  const Row row;
  Scene scene;
  scene.laws = row.laws;
  Preparation prepared;
  prepared.network = row.made.network;
  const ContactState first = row.state(1), second = row.state(2);
  std::vector<experiments::Cracks> found;
  with_threads([&](int threads) {
    SCOPED_TRACE(threads);
    CrackWatch watch(scene, prepared);
    ASSERT_TRUE(watch.active() && watch.sums());
    const std::size_t at_first = watch.look(first, 1).size(), at_second = watch.look(second, 2).size();
    EXPECT_GT(at_first, 0u);
    EXPECT_GT(at_second, 0u);
    found.push_back(watch.found());
    const experiments::Cracks &one = found.front(), &now = found.back();
    ASSERT_EQ(now.events.size(), at_first + at_second);
    ASSERT_EQ(now.events.size(), one.events.size());
    for (std::size_t k = 0; k < now.events.size(); ++k) {
      EXPECT_EQ(now.events[k].point, one.events[k].point);
      EXPECT_EQ(now.events[k].opening_m, (k < at_first ? first : second).point_cracks[now.events[k].point].opening);
      if (k > 0 && k != at_first) { EXPECT_GT(now.events[k].point, now.events[k - 1].point); }
    }
    EXPECT_EQ(now.sums->crack_energy_j, one.sums->crack_energy_j);
    EXPECT_EQ(now.sums->friction_energy_j, one.sums->friction_energy_j);
    EXPECT_EQ(now.sums->cracked_area_m2, one.sums->cracked_area_m2);
  });
  double crack = 0, area = 0;
  std::int64_t cracked = 0;
  for (std::size_t p = 0; p < second.point_cracks.size(); ++p) {
    const double of_point = row.made.network.point_area[p];
    crack += second.point_cracks[p].energy * of_point;
    if (second.point_cracks[p].damage > 0) ++cracked, area += of_point;
  }
  const double rounding = 5.0 * particles * 0x1p-53;  // 12,500 positive numbers in another order
  EXPECT_EQ(found.front().sums->cracked, cracked);
  EXPECT_NEAR(found.front().sums->crack_energy_j, crack, rounding * crack);
  double areas = 0;
  for (const double of_pair : found.front().sums->cracked_area_m2) areas += of_pair;
  EXPECT_NEAR(areas, area, rounding * area);
}

}  // namespace
}  // namespace macadam::test
