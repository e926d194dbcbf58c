// SPDX-License-Identifier: GPL-3.0-or-later
/// \file particle_contacts.hpp  Stores four complex numbers in one SIMD register, and up to four contacts of a particle
/// as seen from that particle.
#pragma once

#include <algorithm>
#include <cstdint>

#include "host/harmonic/complex_lanes.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::harmonic {

/// Number of complex numbers in a register: one for each of four solutions, or one for each of four contacts.
inline constexpr int at_once = kernels::most_loads;
using FourNumbers = Lanes<at_once>;

/// Returns the real numbers of(f), each in the real and in the imaginary lane of number f. The numbers are written out
/// one by one, because the compiler would turn a loop into one insert per lane.
template <class Of>
FourNumbers real_lanes(Of&& of) {
  static_assert(at_once == 4);
  const double a = of(0), b = of(1), c = of(2), d = of(3);
  return FourNumbers::Register{a, b, c, d, a, b, c, d};
}

/// Packs the four complex numbers `of(0)` … `of(3)`: first the four real parts, then the four imaginary parts.
template <class Of>
FourNumbers complex_lanes(Of&& of) {
  const std::complex<double> a = of(0), b = of(1), c = of(2), d = of(3);
  return FourNumbers::Register{a.real(), b.real(), c.real(), d.real(), a.imag(), b.imag(), c.imag(), d.imag()};
}

/// Returns |Re| + |Im| of each number, in both of its lanes.
inline FourNumbers size_of(FourNumbers x) {
  const FourNumbers positive = x.v < 0 ? -x.v : x.v;
  return positive + positive.swapped();
}

/// N contacts of a particle, with normals that point away from it. If a particle has fewer than N contacts left, only
/// the first `count` entries are valid, and the other entries repeat the first contact.
template <int N>
struct ContactGroup {
  const Contact* contact[N];
  double sign[N];                 ///< 1 at the contact's first end; −1 at its second end, where n and t are reversed
  double over_d[N];               ///< 1/length of the law's material [1/m]
  double own_arm[N], far_arm[N];  ///< lever arms of this particle and of the other end [m]
  std::int32_t far[N];            ///< the other end: a particle, or a wall (negative)
  std::size_t pair[N];
  int count;               ///< number of valid contacts, at most N
  bool alike = true;       ///< whether all contacts are of the same pair type
  bool in_series = false;  ///< whether a contact has rock in series with its law

  /// Reads the contacts at the entries `at`, `at` + 1, … of ContactNetwork::rows, at most N of them, and none at `end`
  /// or beyond.
  ContactGroup(const ContactNetwork& network, std::size_t at, std::size_t end, std::size_t particle)
      : count(static_cast<int>(std::min<std::size_t>(N, end - at))) {
    for (int f = 0; f < N; ++f) {
      const std::size_t own = at + static_cast<std::size_t>(f);
      ask_for(network, own + 16);
      const Contact& c = network.contacts[network.rows[f < count ? own : at]];
      const bool first = static_cast<std::size_t>(c.a) == particle;
      contact[f] = &c;
      sign[f] = first ? 1 : -1;
      over_d[f] = 1 / c.length;
      in_series = in_series || c.series != 0;
      own_arm[f] = first ? c.arm_a : c.arm_b;
      far_arm[f] = first ? c.arm_b : c.arm_a;
      far[f] = first ? c.b : c.a;
      pair[f] = static_cast<std::size_t>(c.pair);
      alike = alike && pair[f] == pair[0];
    }
  }

 private:
  /// Prefetches a contact that will be needed later. Contacts of which the particle is the second end are scattered in
  /// memory; prefetching makes a pass over a million particles more than twice as fast.
  static void ask_for(const ContactNetwork& network, std::size_t at) {
    if (at >= network.rows.size()) return;
    const auto* contact = reinterpret_cast<const char*>(&network.contacts[network.rows[at]]);
    for (std::size_t line = 0; line < sizeof(Contact); line += 64) __builtin_prefetch(contact + line);
  }
};

}  // namespace macadam::harmonic
