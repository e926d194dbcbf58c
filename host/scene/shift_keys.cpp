// SPDX-License-Identifier: GPL-3.0-or-later
// shift_keys.cpp  Reads `shift = "wlf"`, `"arrhenius"` or `"table"`, and the keys that each of them has.
#include "host/scene/shift_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace macadam::scene {
namespace {

const std::vector<std::string> kinds{"wlf", "arrhenius", "table"};
const std::vector<std::vector<std::string>> taken{{"C1", "C2", "reference_temperature"},
                                                  {"activation_energy", "reference_temperature"},
                                                  {"temperatures", "log10_a_T"}};

}  // namespace

std::vector<Key> ShiftKeys::keys() {
  return {{"shift",
           Need::optional,
           {[this](const Value& value) { kind_ = value.choice(kinds); }, {"one of", nullptr, "", "", kinds}},
           "function of temperature that gives the factor a_T on every viscosity",
           "none"},
          {"C1", Need::optional, into(wlf_.C1, ratio, positive), "first constant of shift \"wlf\"", "none"},
          {"C2", Need::optional, into(wlf_.C2, temperature_difference, positive), "second constant of shift \"wlf\"",
           "none"},
          {"activation_energy", Need::optional, into(arrhenius_.activation_energy, molar_energy, positive),
           "activation energy of shift \"arrhenius\"", "none"},
          {"reference_temperature", Need::optional, into(reference_, temperature, celsius),
           "temperature at which the values of the law hold", "none"},
          {"temperatures", Need::optional, into(table_.temperatures, temperature, celsius),
           "ascending temperatures of shift \"table\"", "none"},
          {"log10_a_T", Need::optional, into(table_.log10_a_T, ratio, any),
           "log10 of a_T at each temperature of shift \"table\", linear in between", "none"}};
}

laws::Shift ShiftKeys::shift(const Section& section) const {
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (const std::string& key : taken[kind]) {
      const bool wanted = kind_ && std::count(taken[*kind_].begin(), taken[*kind_].end(), key) > 0;
      if (kind_ == kind && !section.has(key)) {
        section.refuse(key, "nothing", fmt::format("this key, because shift is \"{}\"", kinds[kind]));
      }
      if (!wanted && section.has(key)) {
        section.refuse(
            key, "this key",
            kind_ ? fmt::format("only the keys of shift = \"{}\": {}", kinds[*kind_], fmt::join(taken[*kind_], ", "))
                  : "the key shift as well");
      }
    }
  }
  if (!kind_) return laws::NoShift{};
  if (*kind_ == 0) return laws::Wlf{wlf_.C1, wlf_.C2, reference_};
  if (*kind_ == 1) return laws::Arrhenius{arrhenius_.activation_energy, reference_};
  const std::vector<double>& t = table_.temperatures;
  if (t.empty()) section.refuse("temperatures", "none", "at least one");
  if (std::adjacent_find(t.begin(), t.end(), [](double a, double b) { return a >= b; }) != t.end()) {
    section.refuse("temperatures", fmt::format("[{}]", fmt::join(t, ", ")), "ascending temperatures, each once");
  }
  if (table_.log10_a_T.size() != t.size()) {
    section.refuse("log10_a_T", fmt::format("{} numbers for {} temperatures", table_.log10_a_T.size(), t.size()),
                   "one number per temperature");
  }
  return table_;
}

std::string range_of(const laws::Shift& shift) {
  if (const auto* wlf = std::get_if<laws::Wlf>(&shift))
    return fmt::format("a temperature above {:.6g} (reference_temperature - C2), so that a_T is finite",
                       wlf->reference_temperature - wlf->C2);
  if (const auto* table = std::get_if<laws::ShiftTable>(&shift))
    return fmt::format("a temperature from {} to {}, the range of the law's table", table->temperatures.front(),
                       table->temperatures.back());
  return "a temperature at which a_T is finite";
}

}  // namespace macadam::scene
