// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law_keys.hpp  Makes the keys of a law from the law itself, for `[[contacts]]` and for the phases of
/// `[materials]`.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "host/scene/table.hpp"
#include "macadam/laws/values.hpp"

namespace macadam::scene {

using laws::ValueKind;
using laws::ValueNeed;

/// Returns the explanation of a value of a law; empty if it is not listed here.
inline std::string text_of(const std::string& law, const std::string& key) {
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
inline constexpr Rule in_pascals{[](double v) { return v >= 1000; },
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

}  // namespace macadam::scene
