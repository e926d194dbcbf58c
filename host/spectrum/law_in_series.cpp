// SPDX-License-Identifier: GPL-3.0-or-later
// law_in_series.cpp  A spring in series with a law reduces the stiffness of the law's own spring.
#include "host/spectrum/law_in_series.hpp"

#include <type_traits>

namespace macadam {

PronySeries relaxation_in_series(Law law, double series) {
  constexpr double no_modulus = 1e-14;  // smallest modulus of a unit, as a fraction of the instantaneous modulus
  std::visit(
      [&]<class L>(L& l) {
        if constexpr (std::is_base_of_v<laws::GeneralisedKelvin, L>)
          l.E_m /= 1 + series * l.E_m;
        else
          l.E /= 1 + series * l.E;
      },
      law);
  PronySeries out = prony_series(law);
  const double least = no_modulus * out.instantaneous();
  std::erase_if(out.units, [&](const PronySeries::Unit& u) { return !(u.modulus > least); });
  return out;
}

PronySeries times(double factor, PronySeries series) {
  series.long_term *= factor;
  for (PronySeries::Unit& u : series.units) u.modulus *= factor;
  return series;
}

}  // namespace macadam
