// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_group.hpp  Four complex numbers in a register, and some contacts of a particle seen from that
/// particle.
#pragma once

#include <algorithm>
#include <cstdint>

#include "host/harmonic/iterative/lanes.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::harmonic {

/// Complex numbers in a register: one of each of four solutions, or one of each of four contacts.
inline constexpr int at_once = kernels::most_loads;
using FourNumbers = Lanes<at_once>;

/// The real number of(f) for each f, in both of its lanes. Written out: a compiler makes a loop of one lane after the
/// other of it.
template <class Of>
FourNumbers real_lanes(Of&& of) {
  static_assert(at_once == 4);
  const double a = of(0), b = of(1), c = of(2), d = of(3);
  return FourNumbers::Register{a, b, c, d, a, b, c, d};
}

/// The complex number of(f) for each f.
template <class Of>
FourNumbers complex_lanes(Of&& of) {
  const std::complex<double> a = of(0), b = of(1), c = of(2), d = of(3);
  return FourNumbers::Register{a.real(), b.real(), c.real(), d.real(), a.imag(), b.imag(), c.imag(), d.imag()};
}

/// |Re| + |Im| of each number, in both of its lanes.
inline FourNumbers size_of(FourNumbers x) {
  const FourNumbers positive = x.v < 0 ? -x.v : x.v;
  return positive + positive.swapped();
}

/// Contacts of a particle, their normals away from it: N of them, or `count`, and then the first again in place of
/// those that are not there.
template <int N>
struct ContactGroup {
  const Contact* contact[N];
  double sign[N];                 ///< 1, or −1 where the particle is the second end: n and t have the other direction
  double over_d[N];               ///< 1/distance [1/m]
  double own_arm[N], far_arm[N];  ///< [m]
  std::int32_t far[N];            ///< the other end
  std::size_t pair[N];
  int count;
  bool alike = true;  ///< all are of the same pair

  /// Those that entry `at` of the network's rows and the next ones name, before `end`.
  ContactGroup(const ContactNetwork& network, std::size_t at, std::size_t end, std::size_t particle)
      : count(static_cast<int>(std::min<std::size_t>(N, end - at))) {
    for (int f = 0; f < N; ++f) {
      const std::size_t own = at + static_cast<std::size_t>(f);
      ask_for(network, own + 16);
      const Contact& c = network.contacts[network.rows[f < count ? own : at]];
      const bool first = static_cast<std::size_t>(c.a) == particle;
      contact[f] = &c;
      sign[f] = first ? 1 : -1;
      over_d[f] = 1 / c.distance;
      own_arm[f] = first ? c.arm_a : c.arm_b;
      far_arm[f] = first ? c.arm_b : c.arm_a;
      far[f] = first ? c.b : c.a;
      pair[f] = static_cast<std::size_t>(c.pair);
      alike = alike && pair[f] == pair[0];
    }
  }

 private:
  /// Contacts of which a particle is the second end lie anywhere in memory: they are asked for before it is their turn,
  /// which makes a pass over a million particles more than twice as fast.
  static void ask_for(const ContactNetwork& network, std::size_t at) {
    if (at >= network.rows.size()) return;
    const auto* contact = reinterpret_cast<const char*>(&network.contacts[network.rows[at]]);
    for (std::size_t line = 0; line < sizeof(Contact); line += 64) __builtin_prefetch(contact + line);
  }
};

}  // namespace macadam::harmonic
