// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cracking_t8.hpp  Makes the specimen t8 with cracks.
#pragma once

#include "tests/support/test_scenes.hpp"

namespace macadam::test {

inline constexpr double t8_height = 0.011, t8_area = 64e-6;  ///< [m], [m²]

template <class Chain>
Law cracked(const Chain& chain, double strength, double energy, double ratio, double friction) {
  return laws::Cracked<Chain>{chain, {strength, energy, ratio * strength, energy, friction, friction}};
}

/// Returns the specimen t8 with these laws.
inline TestScene t8_with(const Laws& laws) {
  return make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}}), {}, laws);
}

/// Returns the specimen t8 with cracks in mastic and at aggregates. The shear strengths are 1.5 times the tensile ones.
inline TestScene cracking_t8() {
  Laws laws = am1_laws();
  const auto chain = [&](PairType pair) {
    return std::get<laws::GeneralisedKelvin>(*laws[static_cast<std::size_t>(pair)]);
  };
  laws[static_cast<std::size_t>(PairType::mm)] = cracked(chain(PairType::mm), 1e6, 50, 1.5, 0.5);
  laws[static_cast<std::size_t>(PairType::ma)] = cracked(chain(PairType::ma), 0.8e6, 40, 1.5, 0.5);
  laws[static_cast<std::size_t>(PairType::aa)] = cracked(laws::Elastic{1.151e11, 0.05}, 2e6, 60, 1.5, 0.6);
  return t8_with(laws);
}

/// Returns elastic mastic and aggregates with so little fracture energy that t8 snaps back.
inline TestScene brittle_t8() {
  Laws laws = am1_laws();
  laws[static_cast<std::size_t>(PairType::mm)] = cracked(laws::Elastic{1.115e10, 0.1}, 1e6, 1.5, 1, 0.5);
  laws[static_cast<std::size_t>(PairType::ma)] = cracked(laws::Elastic{3.511e10, 0.1}, 0.8e6, 1, 1, 0.5);
  laws[static_cast<std::size_t>(PairType::aa)] = cracked(laws::Elastic{1.151e11, 0.05}, 2e6, 1.5, 1, 0.5);
  return t8_with(laws);
}

/// Returns a bar of cubes of 2 mm along z with the middle contact as the weakest.
inline TestScene cracking_bar(int facets) {
  HandMade made = cubic_lattice_network(1, 1, facets, 2e-3, 1e-5);
  Laws laws;
  laws.fill(laws::Elastic{1e10, 0});
  laws[static_cast<std::size_t>(PairType::mm)] = cracked(laws::Elastic{1e10, 0.1}, 2e6, 60, 1.5, 0);
  laws[static_cast<std::size_t>(PairType::ma)] = cracked(laws::Elastic{1e10, 0.1}, 1.96e6, 60, 1.5, 0);
  std::size_t weak = made.network.contacts.size() / 2;
  while (made.network.contacts[weak].b < 0) weak = (weak + 1) % made.network.contacts.size();
  made.network.contacts[weak].pair = PairType::ma;
  --made.network.count[static_cast<std::size_t>(PairType::mm)];
  ++made.network.count[static_cast<std::size_t>(PairType::ma)];
  return {made.specimen, made.network, laws, made.inertia};
}

}  // namespace macadam::test
