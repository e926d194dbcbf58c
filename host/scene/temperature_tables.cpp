// SPDX-License-Identifier: GPL-3.0-or-later
// temperature_tables.cpp  Reads a table of values over temperature and interpolates it at the temperature of the scene.
#include "host/scene/temperature_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/scene/shift_keys.hpp"

namespace macadam::scene {
namespace {

/// Returns the value of the table at the scene's temperature.
double read_table(const Section& section, const Quantity& quantity, const Rule& bare, const TemperatureTables& tables) {
  std::vector<double> at, values;
  section.read({{"temperatures", Need::required, into(at, temperature, celsius), "rising temperatures"},
                {"values",
                 Need::required,
                 {[&](const Value& list) {
                    for (const Value& entry : list.entries("a list of numbers"))
                      values.push_back(entry.number(quantity, entry.is_text() ? positive : bare));
                  },
                  {"list of numbers", &quantity, bare.words}},
                 "value at each temperature, linear in between"}});
  if (at.empty()) section.refuse("temperatures", "none", "at least one");
  if (std::adjacent_find(at.begin(), at.end(), [](double a, double b) { return a >= b; }) != at.end())
    section.refuse("temperatures", fmt::format("[{}]", fmt::join(at, ", ")), "rising temperatures, each once");
  if (values.size() != at.size()) {
    section.refuse("values", fmt::format("{} numbers for {} temperatures", values.size(), at.size()),
                   "one number per temperature");
  }
  if (!tables.temperature) {
    section.refuse("temperatures", "a table in a scene without a temperature",
                   "temperature in [materials], at which the table is evaluated");
  }
  const double t = *tables.temperature;
  if (t < at.front() || t > at.back()) {
    section.refuse(
        "temperatures",
        fmt::format("a table from {} to {} degrees C, but temperature = {} in [materials]", at.front(), at.back(), t),
        fmt::format("a temperature from {} to {}, or a longer table", at.front(), at.back()));
  }
  const auto next = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), t) - at.begin());
  if (next == at.size()) return values.back();
  const double part = (t - at[next - 1]) / (at[next] - at[next - 1]);
  return values[next - 1] + part * (values[next] - values[next - 1]);
}

}  // namespace

Reader at_temperature(std::optional<double>& target, const Quantity& quantity, const Rule& bare,
                      TemperatureTables& tables) {
  return {[&target, &quantity, bare, &tables](const Value& value) {
            if (value.is_table()) {
              target = read_table(value.section(), quantity, bare, tables);
              tables.used = true;
            } else {
              target = value.number(quantity, value.is_text() ? positive : bare);
            }
          },
          {"number or table", &quantity, bare.words}};
}

}  // namespace macadam::scene
