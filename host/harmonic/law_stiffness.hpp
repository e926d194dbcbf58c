// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law_stiffness.hpp  Gives access to the complex stiffness of a law, and throws for laws that have none. All
/// code of the frequency domain obtains stiffnesses through this file.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "macadam/contact_network.hpp"
#include "macadam/error.hpp"
#include "macadam/laws/all.hpp"

namespace macadam {

/// Returns f(law), for the law of a pair that has a complex stiffness: f may call its stiffness(), unit_compliance()
/// and each_parameter(). \throws InputError naming pair, law and remedy if the law has none.
template <class Out, class... L, class F>
Out with_stiffness(PairType pair, const std::variant<L...>& law, F&& f) {
  return std::visit(
      [&]<class Own>(const Own& own) -> Out {
        if constexpr (has_stiffness<Own>) {
          return f(own);
        } else {
          throw InputError(std::string("contacts of ") + to_string(pair), 0, "law",
                           std::string(Own::name) + ", which has no complex stiffness" +
                               (linear_law<Own> ? "" : " because it is not linear"),
                           "a law with a complex stiffness, because solutions in the frequency domain need one; or "
                           "method = \"explicit\" with kind = \"cyclic\", which steps any law");
        }
      },
      law);
}

/// Checks that all laws have a complex stiffness. \throws InputError naming the first pair whose law has none, as
/// with_stiffness().
inline void require_stiffness(const LawTable& laws) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (laws[pair]) with_stiffness<void>(static_cast<PairType>(pair), *laws[pair], [](const auto&) {});
  }
}

/// The first pair type whose law has no complex stiffness, and the name of this law.
struct WithoutStiffness {
  PairType pair;
  const char* law;
};
inline std::optional<WithoutStiffness> first_without_stiffness(const LawTable& laws) {
  const FactsTable facts = facts_of(laws);
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (facts[pair] && !facts[pair]->stiffness) return WithoutStiffness{static_cast<PairType>(pair), facts[pair]->name};
  }
  return {};
}

}  // namespace macadam
