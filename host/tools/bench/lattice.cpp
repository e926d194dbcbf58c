// SPDX-License-Identifier: GPL-3.0-or-later
// lattice.cpp  Makes networks of any size quickly: a jittered face-centred cubic lattice with twelve contacts per
// particle.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "host/tools/bench/cases.hpp"

namespace macadam::bench {
namespace {

/// The laws of [1] with binder AM1.
LawTable am1() {
  using laws::Elastic, laws::GeneralisedKelvin;
  LawTable out;
  const auto of = [&](PairType pair) -> std::optional<Law>& { return out[static_cast<std::size_t>(pair)]; };
  of(PairType::mm) =
      GeneralisedKelvin{1.115e10, 2.515e9, {3.799e8, 1.600e9, 4.308e10}, {8.950e9, 5.695e9, 1.114e9}, 0.10};
  of(PairType::ma) =
      GeneralisedKelvin{3.511e10, 7.921e9, {1.197e9, 5.039e9, 1.357e11}, {2.819e10, 1.794e10, 3.510e9}, 0.10};
  of(PairType::aa) = Elastic{1.151e11, 0.05};
  of(PairType::mw) = Elastic{3.511e10, 0.0};
  return out;
}

}  // namespace

BenchCase lattice(std::size_t particles, bool walls) {
  BenchCase out;
  out.name = fmt::format("lattice:{}", particles);
  const auto n = static_cast<std::int32_t>(std::llround(std::cbrt(static_cast<double>(particles) / 4)));
  const double cell = 1e-3 * std::sqrt(2.0);
  const std::int32_t side = 2 * n;  // in half cells; lattice sites have indices x, y, z with an even sum
  std::mt19937 random(1);
  const auto jitter = [&] { return 0.05 * cell * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
  std::vector<std::int32_t> number(static_cast<std::size_t>(side) * side * side, -1);
  const auto at = [&](int x, int y, int z) -> std::int32_t& {
    return number[(static_cast<std::size_t>(z) * side + y) * side + x];
  };
  Specimen& s = out.specimen;
  s.box.size = {n * cell, n * cell, n * cell};
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = (y + z) % 2; x < side; x += 2) {
        at(x, y, z) = static_cast<std::int32_t>(s.size());
        s.centre.push_back(
            {(x + 0.5) * cell / 2 + jitter(), (y + 0.5) * cell / 2 + jitter(), (z + 0.5) * cell / 2 + jitter()});
        s.radius.push_back(0.5e-3);
        s.phase.push_back(Phase::mastic);
        s.body.push_back(-1);
      }
    }
  }
  ContactNetwork& network = out.network;
  network.contacts.reserve(6 * s.size());
  network.row_begin.assign(s.size() + 1, 0);
  static constexpr int neighbour[6][3] = {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}};
  const auto touch_wall = [&](std::int32_t particle, bool top) {
    Contact c;
    c.a = particle, c.b = top ? wall_z_hi : wall_z_lo;
    c.pair = PairType::mw;
    const double z = s.centre[static_cast<std::size_t>(particle)].z;
    c.length = c.distance = c.arm_a = top ? s.box.size.z - z : z;
    c.n = {0, 0, top ? 1.0 : -1.0};
    canonical_frame(c.n, c.s, c.t);
    c.area = 1e-6;
    c.moments = {c.area, 0, 0, 0.08e-6 * c.area, 0, 0.08e-6 * c.area};
    ++network.count[static_cast<std::size_t>(c.pair)];
    ++network.row_begin[static_cast<std::size_t>(particle) + 1];
    network.contacts.push_back(c);
  };
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = (y + z) % 2; x < side; x += 2) {
        if (walls && (z == 0 || z == side - 1)) touch_wall(at(x, y, z), z > 0);
        for (const auto& d : neighbour) {
          const int bx = x + d[0], by = y + d[1], bz = z + d[2];
          if (bx < 0 || by < 0 || bx >= side || by >= side || bz >= side) continue;
          Contact c;
          c.a = at(x, y, z), c.b = at(bx, by, bz);
          const std::uint32_t draw = static_cast<std::uint32_t>(random()) % 100;
          c.pair = draw < 73 ? PairType::mm : draw < 99 ? PairType::ma : PairType::aa;
          const Vec3d branch = s.centre[static_cast<std::size_t>(c.b)] - s.centre[static_cast<std::size_t>(c.a)];
          c.length = c.distance = norm(branch);
          c.n = (1 / c.distance) * branch;
          canonical_frame(c.n, c.s, c.t);
          c.arm_a = c.arm_b = 0.5 * c.distance;
          c.area = 0.7e-6;
          c.moments = {c.area,           0.02e-3 * c.area, -0.03e-3 * c.area,
                       0.06e-6 * c.area, 0.01e-6 * c.area, 0.06e-6 * c.area};
          ++network.count[static_cast<std::size_t>(c.pair)];
          ++network.row_begin[static_cast<std::size_t>(c.a) + 1];
          ++network.row_begin[static_cast<std::size_t>(c.b) + 1];
          network.contacts.push_back(c);
        }
      }
    }
  }
  for (std::size_t i = 0; i < s.size(); ++i) network.row_begin[i + 1] += network.row_begin[i];
  network.rows.resize(network.row_begin.back());
  std::vector<std::uint32_t> next(network.row_begin.begin(), network.row_begin.end() - 1);
  for (std::uint32_t c = 0; c < network.contacts.size(); ++c) {
    network.rows[next[static_cast<std::size_t>(network.contacts[c].a)]++] = c;
    const std::int32_t b = network.contacts[c].b;
    if (b >= 0) network.rows[next[static_cast<std::size_t>(b)]++] = c;
  }
  out.laws = am1();
  out.inertia = make_inertia(s, 2630, 2110);
  return out;
}

}  // namespace macadam::bench
