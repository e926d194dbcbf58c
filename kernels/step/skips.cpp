// SPDX-License-Identifier: GPL-3.0-or-later
// skips.cpp  Determines whether the bodies of a contact network cannot rotate, so that a time step may leave out
// rotations.
#include <cmath>

#include "macadam/stepper.hpp"

namespace macadam {

bool nothing_turns(const ContactNetwork& network, const FactsTable& laws) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (network.count[pair] == 0 || !laws[pair]) continue;
    if (laws[pair]->alpha != 0) return false;
  }
  for (const Contact& c : network.contacts) {
    const AreaMoments& m = c.moments;
    if (std::max(std::abs(m.s), std::abs(m.t)) > 1e-12 * m.a * std::sqrt(m.a)) return false;
  }
  return true;
}

}  // namespace macadam
