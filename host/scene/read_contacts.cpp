// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_contacts.cpp  `[[contacts]]`: one law for each pair type. A new law adds its keys here.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/scene/law_values.hpp"
#include "host/scene/sections.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam::scene {
namespace {

/// The keys of one law, besides `pair`, `law`, `alpha` and `delta`, which all have.
std::vector<Key> keys_of(laws::Elastic& law) { return {{"E", Need::required, into(law.E, modulus, positive)}}; }

std::vector<Key> keys_of(laws::GeneralisedKelvin& law) {
  const auto dashpot = [&law](const Value& value) {  // written `inf`, the law has no dashpot in series
    law.C_m = value.is_infinite() ? std::numeric_limits<double>::infinity() : value.number(viscosity, positive);
  };
  return {{"E_m", Need::required, into(law.E_m, modulus, positive)},
          {"C_m", Need::optional, dashpot},
          {"E", Need::optional, into(law.E, modulus, positive)},
          {"C", Need::optional, into(law.C, viscosity, positive)}};
}

/// What the values of a law, each good by itself, must satisfy together.
void check(const laws::Elastic&, const Section&) {}

void check(const laws::GeneralisedKelvin& law, const Section& section) {
  constexpr std::size_t limit = laws::GeneralisedKelvin::max_units;
  if (law.E.size() != law.C.size()) {
    section.refuse("C", fmt::format("{} viscosities for the {} moduli in E", law.C.size(), law.E.size()),
                   "as many, one of each for a Kelvin unit");
  }
  if (law.E.size() > limit) {
    section.refuse("E", fmt::format("{} Kelvin units", law.E.size()), fmt::format("at most {}", limit));
  }
}

/// Whether δ has left every coefficient a positive number; only C_m may be infinite.
bool usable(const laws::Elastic& law) { return law.E > 0 && std::isfinite(law.E); }

bool usable(const laws::GeneralisedKelvin& law) {
  const auto good = [](double v) { return v > 0 && std::isfinite(v); };
  bool all = good(law.E_m) && law.C_m > 0;
  for (std::size_t l = 0; l < law.E.size(); ++l) all = all && good(law.E[l]) && good(law.C[l]);
  return all;
}

template <std::size_t I = 0>
void list_laws(std::vector<std::string>& names, std::vector<Law>& laws) {
  if constexpr (I < std::variant_size_v<Law>) {
    using Alternative = std::variant_alternative_t<I, Law>;
    names.emplace_back(Alternative::name);
    laws.emplace_back(Alternative{});
    list_laws<I + 1>(names, laws);
  }
}

/// An empty law of the kind that the section names.
Law law_named_in(const Section& section) {
  std::vector<std::string> names;
  std::vector<Law> laws;
  list_laws(names, laws);
  const auto name = section.find("law");
  if (!name) section.refuse("law", "nothing", fmt::format("this key, which is required: {}", fmt::join(names, " or ")));
  return laws[name->choice(names)];
}

}  // namespace

std::vector<Key> keys_of(FacetLimits& limits) {
  // d − R_a − R_b over the mean radius is d/mean − 2.
  constexpr Rule gap{[](double v) { return v > -2; }, "a gap above -2 mean radii, where centres coincide"};
  return {{"gap_max", Need::optional, into(limits.gap_max, ratio, gap)},
          {"area_min", Need::optional, into(limits.area_min, ratio, non_negative)}};
}

LawTable read_contacts(const std::vector<Section>& sections, ShiftLaws& shifts, Deltas& deltas, NetworkSpec& network) {
  std::vector<std::string> pairs;
  for (int i = 0; i < pair_types; ++i) pairs.emplace_back(to_string(static_cast<PairType>(i)));

  LawTable table;
  for (const Section& section : sections) {
    std::size_t pair = 0;
    double delta = 1;
    ShiftKeys shift;
    FacetLimits limits;
    Law read_law = law_named_in(section);
    std::visit(
        [&](auto& law) {
          std::vector<Key> keys{{"pair", Need::required, [&](const Value& v) { pair = v.choice(pairs); }},
                                {"law", Need::required, [](const Value&) {}},
                                {"alpha", Need::optional, into(law.alpha, ratio, non_negative)},
                                {"delta", Need::optional, into(delta, ratio, positive)}};
          for (Key& key : keys_of(law)) keys.push_back(std::move(key));
          for (Key& key : keys_of(limits)) keys.push_back(std::move(key));
          constexpr bool flows = !std::is_same_v<std::decay_t<decltype(law)>, laws::Elastic>;
          if constexpr (flows)
            for (Key& key : shift.keys()) keys.push_back(std::move(key));
          section.read(keys);
          if constexpr (flows) shifts[pair] = shift.shift(section);
          check(law, section);
          each_value(law, [delta](const std::string&, double& value, ValueKind) { value *= delta; });
          if (!usable(law)) {
            section.refuse("delta", fmt::format("a product of {} and a coefficient that is 0 or infinite", delta),
                           "products within the range of a double");
          }
        },
        read_law);
    if (table[pair]) section.refuse("pair", fmt::format("\"{}\" again", pairs[pair]), "each pair once");
    table[pair] = std::move(read_law);
    deltas[pair] = delta;
    if (pair < network.of_pair.size()) {
      network.of_pair[pair] = limits;
    } else if (limits.gap_max || limits.area_min) {
      section.refuse(limits.gap_max ? "gap_max" : "area_min", "this key of a pair with a wall",
                     "a pair of two particles: every facet on a wall is a contact");
    }
  }
  return table;
}

}  // namespace macadam::scene
