// SPDX-License-Identifier: GPL-3.0-or-later
// law_range.cpp  Reads the ranges of laws, and compares them with the frequencies and temperatures of a test.
#include "host/scene/law_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "host/scene/shift_keys.hpp"
#include "macadam/scene.hpp"

namespace macadam {
namespace {

/// Relative rounding error of a reduced frequency that still counts as within the range.
constexpr double rounding = 1e-9;

std::string span_of(double low, double high, const char* unit) {
  return low == high ? fmt::format("at {:.4g} {}", low, unit)
                     : fmt::format("from {:.4g} to {:.4g} {}", low, high, unit);
}

/// Returns the lowest and the highest temperature of a scene; empty if the scene gives no temperature.
std::optional<std::pair<double, double>> temperatures_used(const Scene& scene) {
  std::vector<double> all = temperatures_of(scene.experiment);
  if (scene.materials.temperature) all.push_back(*scene.materials.temperature);
  const TemperatureHistory history = temperature_history_of(scene.experiment);
  all.insert(all.end(), history.temperatures.begin(), history.temperatures.end());
  if (all.empty()) return {};
  const auto [low, high] = std::minmax_element(all.begin(), all.end());
  return std::pair{*low, *high};
}

}  // namespace

namespace scene {

std::vector<Key> RangeKeys::keys() {
  return {{"valid_frequencies", Need::optional, into(frequencies_, frequency, positive),
           "lowest and highest frequency at the reference temperature between which the law holds; a run outside of "
           "this range warns",
           "the law holds everywhere"},
          {"valid_temperatures", Need::optional, into(temperatures_, temperature, celsius),
           "lowest and highest temperature between which the law holds; a run outside of this range warns",
           "the law holds everywhere"}};
}

laws::LawRange RangeKeys::range(const Section& section) const {
  laws::LawRange out;
  const auto take = [&](const char* key, const std::vector<double>& values, double& low, double& high) {
    if (!section.has(key)) return;
    if (values.size() != 2 || !(values[0] <= values[1]))
      section.refuse(key, fmt::format("[{}]", fmt::join(values, ", ")), "two numbers, the lower one first");
    low = values[0], high = values[1];
  };
  take("valid_frequencies", frequencies_, out.lowest_hz, out.highest_hz);
  take("valid_temperatures", temperatures_, out.lowest_c, out.highest_c);
  return out;
}

std::pair<double, double> frequencies_used(const Experiment& experiment) {
  const auto of_times = [](double shortest, double longest) {
    return std::pair{1 / (2 * std::numbers::pi * longest), 1 / (2 * std::numbers::pi * shortest)};
  };
  return std::visit(
      [&](const auto& spec) -> std::pair<double, double> {
        if constexpr (requires { spec.frequencies; }) {
          const auto [low, high] = std::minmax_element(spec.frequencies.begin(), spec.frequencies.end());
          return {*low, *high};
        } else if constexpr (requires { spec.times; }) {
          const auto first = std::find_if(spec.times.begin(), spec.times.end(), [](double t) { return t > 0; });
          return of_times(first == spec.times.end() ? spec.times.back() : *first, spec.times.back());
        } else {
          const double shortest =
              std::visit([&](const auto& drive) { return drive.shortest_time(spec.duration); }, spec.drive);
          return of_times(std::min(shortest, spec.duration), spec.duration);
        }
      },
      experiment);
}

}  // namespace scene

std::vector<std::string> law_range_warnings(const Scene& scene) {
  const auto [low, high] = scene::frequencies_used(scene.experiment);
  const auto temperatures = temperatures_used(scene);
  std::vector<std::pair<std::string, std::string>> found;  // text about a range, and the pairs to which it applies
  const auto add = [&](const std::string& what, std::size_t pair) {
    const std::string name = to_string(static_cast<PairType>(pair));
    for (auto& [words, pairs] : found) {
      if (words == what) return void(pairs += ", " + name);
    }
    found.emplace_back(what, name);
  };
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const laws::LawRange& range = scene.ranges[pair];
    if (!scene.laws[pair]) continue;
    if (range.limits_frequency()) {
      // a_T falls with temperature, so the warmest specimen has the lowest reduced frequencies. Both ends are tried,
      // because a table of shifts may rise.
      double lowest = low, highest = high;
      if (temperatures) {
        const double a = std::pow(10.0, laws::log10_shift(scene.shifts[pair], temperatures->first)),
                     b = std::pow(10.0, laws::log10_shift(scene.shifts[pair], temperatures->second));
        lowest *= std::min(a, b), highest *= std::max(a, b);
      }
      if (lowest < range.lowest_hz * (1 - rounding) || highest > range.highest_hz * (1 + rounding))
        add(fmt::format(
                "holds {}, and the test uses it {}{}", span_of(range.lowest_hz, range.highest_hz, "Hz"),
                span_of(lowest, highest, "Hz"),
                std::holds_alternative<laws::NoShift>(scene.shifts[pair]) ? "" : " at the reference temperature"),
            pair);
    }
    if (range.limits_temperature() && temperatures &&
        (temperatures->first < range.lowest_c || temperatures->second > range.highest_c))
      add(fmt::format("holds {}, and the test uses it {}", span_of(range.lowest_c, range.highest_c, "degrees C"),
                      span_of(temperatures->first, temperatures->second, "degrees C")),
          pair);
  }
  std::vector<std::string> out;
  for (const auto& [words, pairs] : found)
    out.push_back(fmt::format("the law of {} {}; outside of its range the law is an extrapolation", pairs, words));
  return out;
}

}  // namespace macadam
