// SPDX-License-Identifier: GPL-3.0-or-later
/// \file all.hpp  Lists the contact laws. The scene reader, steppers, tests and benchmarks use this list.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "macadam/laws/brittle_bond.hpp"
#include "macadam/laws/cracked.hpp"
#include "macadam/laws/elastic.hpp"
#include "macadam/laws/facts.hpp"
#include "macadam/laws/generalised_kelvin.hpp"

namespace macadam {

/// Any one law. To add a law, add its type here.
using Law = std::variant<laws::Elastic, laws::GeneralisedKelvin, laws::BrittleBond, laws::Cracked<laws::Elastic>,
                         laws::Cracked<laws::GeneralisedKelvin>>;

/// The law of each pair type, indexed by PairType; empty for pair types without a law.
using LawTable = std::array<std::optional<Law>, pair_types>;

}  // namespace macadam
