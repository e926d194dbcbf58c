// SPDX-License-Identifier: GPL-3.0-or-later
/// \file general_laws.hpp  Gives every contact the most general law without changing its behaviour. A stepper skips
/// work that a simple law does not need; with these laws it skips nothing. Tests compare the two.
#pragma once

#include <algorithm>
#include <limits>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"

namespace macadam::test {

/// Returns every law as a generalised Kelvin law of at least `units` units. The added units have E = 0 and C = ∞ and
/// never move.
inline LawTable general_laws(LawTable laws, std::size_t units) {
  for (auto& law : laws) {
    if (!law) continue;
    laws::GeneralisedKelvin general;
    if (const auto* elastic = std::get_if<laws::Elastic>(&*law)) {
      general.E_m = elastic->E;
      general.alpha = elastic->alpha;
    } else {
      general = std::get<laws::GeneralisedKelvin>(*law);
    }
    general.E.resize(std::max(units, general.E.size()), 0);
    general.C.resize(general.E.size(), std::numeric_limits<double>::infinity());
    law = general;
  }
  return laws;
}

}  // namespace macadam::test
