// SPDX-License-Identifier: GPL-3.0-or-later
// skips.cpp  What a network cannot do, so that the step need not.
#include <cmath>

#include "macadam/stepper.hpp"

namespace macadam {

bool nothing_turns(const ContactNetwork& network, const std::array<std::optional<Law>, pair_types>& laws) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (network.count[pair] == 0 || !laws[pair]) continue;
    if (std::visit([](const auto& law) { return law.alpha != 0; }, *laws[pair])) return false;
  }
  for (const Contact& c : network.contacts) {
    const AreaMoments& m = c.moments;
    if (std::max(std::abs(m.s), std::abs(m.t)) > 1e-12 * m.a * std::sqrt(m.a)) return false;
  }
  return true;
}

}  // namespace macadam
