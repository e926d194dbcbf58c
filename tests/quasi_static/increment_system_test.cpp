// SPDX-License-Identifier: GPL-3.0-or-later
// increment_system_test.cpp  Tests, without a device, the arrays from which a device computes quasi-static increments:
// with the functions of one contact they give the forces and the tangent that the CPU computes.
#include <gtest/gtest.h>

#include <cmath>

#include "host/quasi_static/engine.hpp"
#include "host/quasi_static/increment_system.hpp"
#include "host/quasi_static/tangent_matrix.hpp"
#include "tests/support/cracking_t8.hpp"

namespace macadam::test {
namespace {

using namespace quasi_static;

constexpr double dt = 6e-5;

/// Contacts of t8 after some increments, in which mastic and aggregates have cracked, with a trial motion.
struct Example {
  TestScene scene = cracking_t8();
  PairLaws laws = pair_laws(scene.network, scene.laws);
  ContactIncrements contacts{scene.network, scene.laws};
  std::vector<double> motion;  ///< [6·particles]
  std::vector<Six> relative;

  Example() {
    std::mt19937 random(test_seed());
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    for (int k = 0; k < 3; ++k) {
      motion.clear();
      for (std::size_t i = 0; i < 6 * scene.specimen.size(); ++i)
        motion.push_back((i % 6 < 3 ? 1e-7 : 1e-4) * uniform());
      contacts.begin(quasi_static::all_laws(dt));
      relative.clear();
      for (const Contact& c : scene.network.contacts) {
        static constexpr Six at_rest{};
        relative.push_back(
            quasi_static::relative(c, &motion[6 * static_cast<std::size_t>(c.a)],
                                   c.b < 0 ? at_rest.data() : &motion[6 * static_cast<std::size_t>(c.b)]));
      }
      contacts.evaluate(relative);
      if (k < 2) contacts.accept(relative);
    }
  }
};

double growing_area(const Example& e) {
  double out = 0;
  for (std::size_t j = 0; j < e.contacts.grew().size(); ++j)
    out += e.contacts.grew()[j] ? e.scene.network.point_area[j] : 0;
  return out;
}

// The forces and stiffnesses of all contacts, and the opening, from the arrays alone. Both sum in the same order, and
// the values of the contacts are equal to the last bit.
TEST(IncrementSystem, HasTheForcesOfTheContacts) {
  const Example e;
  const kernels::IncrementSystem s = make_increment_system(e.scene.specimen, e.scene.network, e.laws, 3);
  kernels::IncrementLaws laws;
  for (std::size_t pair = 0; pair < pair_types; ++pair) laws[pair] = e.laws[pair].increment(dt);
  kernels::IncrementStates states;
  const StateOrder order(e.scene.network, s, e.contacts.state_begin(), laws);
  order.to_device(e.contacts.states(), states);
  EXPECT_EQ(order.to_network(states), e.contacts.states());

  const double area = growing_area(e);
  ASSERT_GT(area, 0);
  double opening = 0;
  int cracked = 0;
  for (std::size_t i = 0; i < s.contacts.size(); ++i) {
    const kernels::IncrementContact& c = s.contacts[i];
    const kernels::IncrementLaw& law = laws[static_cast<std::size_t>(c.pair)];
    const Six& u = e.relative[s.contact_of[i]];
    kernels::PointSums sums;
    kernels::TangentSums tangent;
    const auto access = [](std::vector<double>& list, std::size_t count, int words, std::size_t at) {
      return [&list, count, words, at](int k, int n) -> double& {
        return list[static_cast<std::size_t>(k * words + n) * count + at];
      };
    };
    if (i < s.linear.size()) {
      double base[6];
      kernels::prepare_linear(law, s.linear[i].series, access(states.linear, s.linear.size(), s.linear_words, i), base);
      kernels::linear_forces(law, s.linear[i], base, u.data(), sums.force);
      kernels::linear_stiffness(law, s.linear[i], tangent.stiffness);
    }
    for (std::size_t j = c.point_begin; j < c.point_end; ++j) {
      const auto state = access(states.points, s.point_of.size(), s.point_words, j);
      kernels::PointStart p{s.point_s[j],
                            s.point_t[j],
                            s.point_area[j],
                            {},
                            {state(0, 1), {state(1, 1), state(2, 1)}, state(0, 2)},
                            e.contacts.grew()[s.point_of[j]] ? s.point_area[j] / area : 0};
      kernels::prepare_point(law, c.length, c.series, state, p.base);
      const auto stiffness = kernels::PointStiffness::of(law, c.length, c.series);
      kernels::PointSums without_tangent;
      const bool grows = kernels::add_point(law, stiffness, p, u.data(), without_tangent);
      EXPECT_EQ(kernels::add_point(law, stiffness, p, u.data(), sums, tangent), grows);
      cracked += state(0, 2) > 0;
    }
    opening += sums.opening;
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(sums.force[k], e.contacts.force(s.contact_of[i])[k]) << i;
    for (std::size_t k = 0; k < 36; ++k) EXPECT_EQ(tangent.stiffness[k], e.contacts.stiffness(s.contact_of[i])[k]) << i;
  }
  EXPECT_GT(cracked, 100);
  // a sum of some thousand numbers in another order
  EXPECT_NEAR(opening, e.contacts.opening(), 1e-12 * std::abs(e.contacts.opening()));
}

// The blocks of the tangent, row after row, from the stiffnesses of the contacts.
TEST(IncrementSystem, HasTheBlocksOfTheTangent) {
  const Example e;
  const kernels::IncrementSystem s = make_increment_system(e.scene.specimen, e.scene.network, e.laws, 3);
  std::vector<double> blocks(36 * s.entry_row.size());
  for (std::size_t body = 0; body < s.bodies(); ++body) {
    for (std::size_t at = s.end_begin[body]; at < s.end_begin[body + 1]; ++at) {
      const kernels::IncrementContact& c = s.contacts[s.ends[at] / 2];
      const int end = static_cast<int>(s.ends[at] % 2);
      EXPECT_EQ(end == 0 ? c.a : c.b, static_cast<std::int32_t>(body));
      const SixBySix& k = e.contacts.stiffness(s.contact_of[s.ends[at] / 2]);
      for (int axis = 0; axis < 6; ++axis) {
        double column[6];
        kernels::tangent_column(c.frame, k.data(), end, end, axis, column);
        for (std::size_t r = 0; r < 6; ++r)
          blocks[36 * s.entry_begin[body] + 6 * static_cast<std::size_t>(axis) + r] += column[r];
        if (c.b < 0) continue;
        kernels::tangent_column(c.frame, k.data(), end, 1 - end, axis, column);
        const auto entry = static_cast<std::size_t>(s.end_entry[at]);
        EXPECT_EQ(s.entry_column[entry], end == 0 ? c.b : c.a);
        for (std::size_t r = 0; r < 6; ++r) blocks[36 * entry + 6 * static_cast<std::size_t>(axis) + r] = column[r];
      }
    }
  }
  const std::size_t particles = e.scene.specimen.size();
  std::vector<std::size_t> body(particles);
  for (std::size_t i = 0; i < particles; ++i) body[static_cast<std::size_t>(s.particle[i])] = i;
  TangentMatrix expected(e.scene.network, particles), found(e.scene.network, particles);
  expected.assemble(e.contacts, false);
  found.set(blocks, false, [&](std::size_t particle) { return std::size_t{s.entry_begin[body[particle]]}; });
  Vector x, right, left;
  for (std::size_t i = 0; i < 6 * particles; ++i) x.push_back((i % 6 < 3 ? 1 : 1e3) * std::sin(static_cast<double>(i)));
  expected.multiply(x, right);
  found.multiply(x, left);
  double largest = 0;
  for (const double v : right) largest = std::max(largest, std::abs(v));
  // products of 6 × 6 numbers in another order
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(left[i], right[i], 1e-12 * largest) << i;
}

// Every entry of the tangent belongs to exactly one pair of boxes, or its transpose does.
TEST(IncrementSystem, ListsAllPairsOfBoxes) {
  const Example e;
  const kernels::IncrementSystem s = make_increment_system(e.scene.specimen, e.scene.network, e.laws, 8);
  ASSERT_EQ(s.boxes(), 8u);
  std::vector<int> times(s.entry_row.size());
  for (std::size_t p = 0; p + 1 < s.pairs.size(); ++p) {
    for (std::size_t i = s.pairs[p].begin; i < s.pairs[p + 1].begin; ++i) {
      const std::size_t entry = s.pair_entry[i];
      ++times[entry];
      EXPECT_EQ(s.box_of[static_cast<std::size_t>(s.entry_row[entry])], s.pairs[p].row);
      EXPECT_EQ(s.box_of[static_cast<std::size_t>(s.entry_column[entry])], s.pairs[p].column);
    }
  }
  for (std::size_t entry = 0; entry < times.size(); ++entry) {
    const bool upper = s.box_of[static_cast<std::size_t>(s.entry_row[entry])] <=
                       s.box_of[static_cast<std::size_t>(s.entry_column[entry])];
    EXPECT_EQ(times[entry], upper ? 1 : 0) << entry;
  }
}

}  // namespace
}  // namespace macadam::test
