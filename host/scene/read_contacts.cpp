// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_contacts.cpp  Reads `[[contacts]]`: one law for each pair type.
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "host/scene/sections.hpp"
#include "host/scene/shift_keys.hpp"
#include "macadam/laws/values.hpp"

namespace macadam::scene {
namespace {

using laws::ValueKind;
using laws::ValueNeed;

/// Returns the explanation of a value of a law; empty if it is not listed here.
std::string text_of(const std::string& law, const std::string& key) {
  static const std::map<std::string, std::string> kelvin{{"E_m", "spring of the Maxwell unit"},
                                                         {"C_m", "dashpot of the Maxwell unit; inf: no dashpot"},
                                                         {"E", "springs of the Kelvin units, up to 16"},
                                                         {"C", "dashpots of the Kelvin units, one per spring"}};
  static const std::map<std::string, std::string> others{
      {"E", "modulus"},
      {"tensile_strength", "tensile stress above which a contact point breaks permanently"},
      {"shear_strength", "shear stress above which a contact point breaks permanently; inf: never"}};
  const auto& texts = law == "generalised_kelvin" ? kelvin : others;
  const auto found = texts.find(key);
  return found == texts.end() ? "" : found->second;
}

/// A modulus without a unit is in Pa. No solid is softer than 1000 Pa, so a smaller number was probably meant in GPa or
/// MPa. The springs of Kelvin units may be softer, so this rule is not applied to these springs.
constexpr Rule in_pascals{[](double v) { return v >= 1000; },
                          "1000 Pa or more; a modulus in another unit is text with the unit"};

/// Returns the keys of one law, except for `pair`, `law`, `alpha` and `delta`, which all laws have.
template <class L>
std::vector<Key> keys_of(L& law) {
  std::vector<Key> out;
  law.each_key([&](const char* key, auto& member, ValueKind kind, ValueNeed need) {
    constexpr bool one = std::is_same_v<std::decay_t<decltype(member)>, double>;
    const Quantity& unit = kind == ValueKind::viscosity ? viscosity : modulus;
    Reader read = into(member, unit, positive);
    if constexpr (one) {
      if (kind == ValueKind::modulus) read = positive_into(member, unit, in_pascals);
      if (need == ValueNeed::may_be_infinite) {  // written `inf`
        read.words.rule = "a positive number, or inf";
        read.words.usual = "inf";
        read.read = [&member, &unit](const Value& value) {
          member = value.is_infinite() ? std::numeric_limits<double>::infinity() : value.number(unit, positive);
        };
      }
    }
    const bool required = need == ValueNeed::required;
    const std::string usual = required || !read.words.usual.empty() ? "" : "none";
    out.push_back({key, required ? Need::required : Need::optional, std::move(read), text_of(L::name, key), usual});
  });
  return out;
}

/// Checks that the values of a law, each of which is valid by itself, fit together. \throws InputError if they do not.
template <class L>
void check(const L& law, const Section& section) {
  if constexpr (requires { law.fault(); }) {
    if (const auto fault = law.fault()) section.refuse(fault->key, fault->found, fault->expected);
  }
}

/// Appends the name and an empty value of every kind of law.
template <std::size_t I = 0>
void list_laws(std::vector<std::string>& names, std::vector<Law>& laws) {
  if constexpr (I < std::variant_size_v<Law>) {
    using Alternative = std::variant_alternative_t<I, Law>;
    names.emplace_back(Alternative::name);
    laws.emplace_back(Alternative{});
    list_laws<I + 1>(names, laws);
  }
}

/// Returns an empty law of the kind that the section names.
Law law_named_in(const Section& section) {
  std::vector<std::string> names;
  std::vector<Law> laws;
  list_laws(names, laws);
  const auto name = section.find("law");
  if (!name) section.refuse("law", "nothing", fmt::format("law = \"{}\"", fmt::join(names, "\" or \"")));
  return laws[name->choice(names)];
}

}  // namespace

/// Returns the keys that decide which facets between two particles become contacts.
std::vector<Key> keys_of(FacetLimits& limits) {
  // For a distance d of the centres, the gap d − R_a − R_b in units of the mean radius is d/mean − 2.
  constexpr Rule gap{[](double v) { return v > -2; }, "a gap above -2 mean radii (at -2 the centres coincide)"};
  return {
      {"gap_max", Need::optional, into(limits.gap_max, ratio, gap),
       "largest gap between two particles in contact, in units of their mean radius", "every facet is a contact"},
      {"area_min", Need::optional, into(limits.area_min, ratio, non_negative),
       "smallest area of a facet that is a contact, as a fraction of the mean facet area", "every facet is a contact"}};
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
          std::vector<Key> keys{
              {"pair",
               Need::required,
               {[&](const Value& v) { pair = v.choice(pairs); }, {"one of", nullptr, "", "", pairs}},
               "the two materials: M mastic, A aggregate, W wall; inner: spheres of one aggregate"},
              {"law",
               Need::required,
               {[](const Value&) {}, {"one of"}},
               "the contact law; it determines the other keys"},
              {"alpha", Need::optional, into(law.alpha, ratio, non_negative), "ratio of shear to normal stiffness"},
              {"delta", Need::optional, into(delta, ratio, positive),
               "factor on all moduli and viscosities of the pair, not on strengths"}};
          for (Key& key : keys_of(law)) keys.push_back(std::move(key));
          for (Key& key : keys_of(limits)) keys.push_back(std::move(key));
          const bool flows = laws::flows(law);
          if (flows)
            for (Key& key : shift.keys()) keys.push_back(std::move(key));
          section.read(keys);
          if (flows) shifts[pair] = shift.shift(section);
          check(law, section);
          laws::each_value(law, [delta](const std::string&, double& value, ValueKind kind, ValueNeed) {
            if (kind != ValueKind::strength) value *= delta;
          });
          if (!laws::usable(law)) {
            section.refuse("delta",
                           fmt::format("{}, whose product with a coefficient of the law is 0 or infinite", delta),
                           "a factor whose products are within the range of a double");
          }
        },
        read_law);
    if (table[pair]) section.refuse("pair", fmt::format("\"{}\" again", pairs[pair]), "each pair once");
    table[pair] = std::move(read_law);
    deltas[pair] = delta;
    if (pair < network.of_pair.size()) {
      network.of_pair[pair] = limits;
    } else if (limits.gap_max || limits.area_min) {
      section.refuse(limits.gap_max ? "gap_max" : "area_min", "this key for a pair with a wall",
                     "this key only for pairs of two particles, because every facet on a wall is a contact");
    }
  }
  return table;
}

}  // namespace macadam::scene
