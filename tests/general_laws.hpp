// SPDX-License-Identifier: GPL-3.0-or-later
/// \file general_laws.hpp  The same behaviour with every contact given all that any contact needs: what skips are
/// compared with.
#pragma once

#include <algorithm>
#include <limits>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"

namespace macadam::test {

/// Every law as a generalised Kelvin law of at least `units` units; those added have E = 0, C = ∞ and never move.
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
