// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law_keys.hpp  Makes the keys of a law from the law itself, for `[[contacts]]` and for the phases of
/// `[materials]`.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/scene/table.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/laws/values.hpp"

namespace macadam::scene {

using laws::ValueKind;
using laws::ValueNeed;

/// The keys of each law, and the explanations of their values. A law of all.hpp without such a list is a compile error,
/// so that no law gets the explanations of another law.
/// @{
using KeyText = std::pair<std::string_view, const char*>;
template <class L>
struct TextsOf;
template <>
struct TextsOf<laws::Elastic> {
  static constexpr std::array<KeyText, 1> all{{{"E", "modulus"}}};
};
template <>
struct TextsOf<laws::GeneralisedKelvin> {
  static constexpr std::array<KeyText, 4> all{{{"E_m", "spring of the Maxwell unit"},
                                               {"C_m", "dashpot of the Maxwell unit; inf: no dashpot"},
                                               {"E", "springs of the Kelvin units, up to 16"},
                                               {"C", "dashpots of the Kelvin units, one per spring"}}};
};
template <>
struct TextsOf<laws::BrittleBond> {
  static constexpr std::array<KeyText, 3> all{
      {{"E", "modulus"},
       {"tensile_strength", "tensile stress above which a contact point breaks permanently"},
       {"shear_strength", "shear stress above which a contact point breaks permanently; inf: never"}}};
};
/// A law with a crack has the values of its chain.
template <class Chain>
struct TextsOf<laws::Cracked<Chain>> : TextsOf<Chain> {};
/// @}

/// Returns the explanation of a value of a law; empty if the law's list does not have its key.
template <class L>
std::string text_of_key(std::string_view key) {
  for (const auto& [name, text] : TextsOf<L>::all) {
    if (name == key) return text;
  }
  return "";
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
    out.push_back({key, required ? Need::required : Need::optional, std::move(read), text_of_key<L>(key), usual});
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
