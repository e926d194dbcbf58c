// SPDX-License-Identifier: GPL-3.0-or-later
// names.cpp  Defines the names of pair types, quadratures and rules in scenes and results.
#include <array>

#include "macadam/contact_network.hpp"

namespace macadam {

const char* to_string(PairType pair) {
  constexpr std::array<const char*, pair_types> name{"M-M", "M-A", "A-A", "inner", "A-W", "M-W"};
  return name[static_cast<std::size_t>(pair)];
}

const char* to_string(Quadrature quadrature) {
  return quadrature == Quadrature::exact ? "exact" : quadrature == Quadrature::one_point ? "one_point" : "lumped";
}

const char* to_string(ContactRule rule) { return rule == ContactRule::series ? "series" : "centres"; }

}  // namespace macadam
