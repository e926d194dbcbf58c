// SPDX-License-Identifier: GPL-3.0-or-later
// read_points.cpp  Reads lists of times or frequencies, and ranges that are evenly divided on a linear or a logarithmic
// scale.
#include "host/experiments/read_points.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/scene/shift_keys.hpp"
#include "macadam/spectrum.hpp"

namespace macadam::scene {

Key poisson_key(double& target) {
  target = 0.35;
  return {"poisson_ratio", Need::optional, into(target, ratio, of_poisson),
          "Poisson's ratio in the tables for finite-element programs; the specimen does not determine it"};
}

Key strip_width_key(std::optional<double>& target) {
  return {"strip_width", Need::optional, into(target, length, positive), "width of the two curved strips",
          "0.127 of the diameter"};
}

Key temperature_key(TemperatureHistory& target) {
  constexpr const char* pairs = "a list of pairs [time, temperature], the first one at time 0";
  const auto read = [&target](const Value& value) {
    for (const Value& entry : value.entries(pairs)) {
      const std::vector<Value> pair = entry.entries("a pair [time, temperature]");
      if (pair.size() != 2) entry.refuse(fmt::format("{} numbers", pair.size()), "a pair [time, temperature]");
      const double time = pair[0].number(duration, non_negative);
      if (target.empty() && time != 0) entry.refuse(fmt::format("{} s as the first time", time), pairs);
      if (!target.empty() && !(time > target.times.back()))
        entry.refuse(fmt::format("{} s after {} s", time, target.times.back()), "times that ascend");
      target.times.push_back(time);
      target.temperatures.push_back(pair[1].number(temperature, celsius));
    }
    if (target.times.size() < 2) value.refuse(fmt::format("{} pairs", target.times.size()), "at least two pairs");
  };
  return {"temperature",
          Need::optional,
          {read, {"list of pairs", nullptr, "times [s] that ascend from 0, temperatures in degrees C"}},
          "method \"quasi_static\": temperature of the specimen at given times, connected by straight lines; the "
          "specimen is without thermal stress at the first temperature",
          "the temperature does not change"};
}

std::vector<Key> Approach::keys(const std::string& of_rate, const std::string& of_displacement,
                                const std::string& usual_rate) {
  constexpr std::int64_t most_points = 100'000;
  return {
      kind_key(),
      {"rate", usual_rate.empty() ? Need::required : Need::optional, into(rate, speed, positive), of_rate, usual_rate},
      {"displacement", Need::required, into(displacement, length, positive), of_displacement},
      {"points", Need::optional, into(points, 10, most_points), "rows of the result, evenly spaced"}};
}

std::vector<double> Approach::times(double at_rate) const {
  std::vector<double> out;
  for (int i = 1; i <= points; ++i) out.push_back(displacement / at_rate * i / points);
  return out;
}

void require_once(const Section& section, const std::string& key, std::vector<double> entries, const char* unit,
                  const char* what) {
  if (entries.empty() && section.has(key)) section.refuse(key, "none", "at least one");
  std::sort(entries.begin(), entries.end());
  if (const auto twin = std::adjacent_find(entries.begin(), entries.end()); twin != entries.end()) {
    section.refuse(key, fmt::format("{} {} twice", *twin, unit), fmt::format("each {} once", what));
  }
}

std::vector<Key> Points::keys(const std::string& key, const Quantity& quantity, Need need) {
  constexpr std::int64_t most = 1000, most_evenly = 1'000'000;
  const std::string ends = key + ": a list, or the two ends of a range if points_per_decade or points is given";
  return {
      {key, need, into(given, quantity, positive), ends, need == Need::required ? "" : "given by strain and points"},
      {"points_per_decade", Need::optional, into(per_decade, 1, most),
       "smallest number of points per decade of a range; the points are evenly spaced in the logarithm and include "
       "both ends",
       "the numbers are a complete list"},
      {"points", Need::optional, into(evenly, 2, most_evenly),
       "number of points of a range; the points are evenly spaced and include both ends",
       need == Need::required ? "the numbers are a complete list"
                              : "the numbers are a complete list; 100 if strain is given"}};
}

std::vector<double> Points::all(const Section& section, const std::string& key, const char* unit,
                                const char* what) const {
  require_once(section, key, given, unit, what);
  std::vector<double> out = given;
  std::sort(out.begin(), out.end());
  if (per_decade && evenly)
    section.refuse("points", "points together with points_per_decade", "only one of the two keys");
  if (!per_decade && !evenly) return out;
  if (out.size() != 2) {
    section.refuse(key, fmt::format("{} entries with {}", out.size(), evenly ? "points" : "points_per_decade"),
                   "the two ends of a range");
  }
  const double first = out.front(), last = out.back();
  if (per_decade) return log_range(first, last, *per_decade);
  out.clear();
  for (int i = 0; i < *evenly; ++i) out.push_back(first + (last - first) * i / (*evenly - 1));
  return out;
}

void read_steady_states(const Section& section, std::vector<double>& frequencies, std::vector<double>& temperatures,
                        const std::vector<Key>& more) {
  Points points;
  std::vector<Key> keys = points.keys("frequencies", frequency);
  keys.push_back(kind_key());
  keys.push_back({"temperatures", Need::optional, into(temperatures, temperature, celsius),
                  "temperatures at which every frequency is tested; they replace temperature in [materials]", "none"});
  keys.insert(keys.end(), more.begin(), more.end());
  section.read(keys);
  frequencies = points.all(section, "frequencies", "Hz", "frequency");
  require_once(section, "temperatures", temperatures, "degrees C", "temperature");
}

}  // namespace macadam::scene
