// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law_values.hpp  The coefficients of a law by name, to be changed. A new law adds its own here.
#pragma once

#include <string>

#include "macadam/laws/all.hpp"

namespace macadam::scene {

enum class ValueKind : std::uint8_t { modulus, viscosity };  ///< [Pa], [Pa·s]

/// f(name, value, kind) for every modulus and viscosity, under the names of `each_parameter`: E_1 is the first of `E`.
/// @{
template <class F>
void each_value(laws::Elastic& law, F&& f) {
  f("E", law.E, ValueKind::modulus);
}
template <class F>
void each_value(laws::GeneralisedKelvin& law, F&& f) {
  f("E_m", law.E_m, ValueKind::modulus);
  f("C_m", law.C_m, ValueKind::viscosity);
  for (std::size_t l = 0; l < law.E.size(); ++l) f("E_" + std::to_string(l + 1), law.E[l], ValueKind::modulus);
  for (std::size_t l = 0; l < law.C.size(); ++l) f("C_" + std::to_string(l + 1), law.C[l], ValueKind::viscosity);
}
/// @}

}  // namespace macadam::scene
