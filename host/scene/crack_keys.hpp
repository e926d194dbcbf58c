// SPDX-License-Identifier: GPL-3.0-or-later
/// \file crack_keys.hpp  Reads `crack = { … }` of a pair in `[[contacts]]`: docs/cracks.md.
#pragma once

#include <optional>

#include "host/scene/table.hpp"
#include "host/scene/temperature_tables.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"

namespace macadam::scene {

/// Whether a law can have a crack in series.
template <class L>
inline constexpr bool can_have_crack = named_law<L>&& requires {
  L::cracked_name;
};

/// Returns the crack that a section describes. Tables over temperature are evaluated at the temperature in `tables`.
/// \throws InputError for a missing or wrong value, or for values that do not fit together.
laws::Crack read_crack(const Section& section, TemperatureTables& tables);

/// Returns the law with a crack in series; the law must be able to have one.
Law with_crack(Law law, const laws::Crack& crack);

/// Returns the key `crack`, which stores the crack in `target`.
Key crack_key(std::optional<laws::Crack>& target, TemperatureTables& tables);

/// Refuses a crack of a pair with a wall. \throws InputError
void require_particles(const Section& section, PairType pair);

}  // namespace macadam::scene
