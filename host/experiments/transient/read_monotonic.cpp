// SPDX-License-Identifier: GPL-3.0-or-later
// read_monotonic.cpp  Reads `[loading]` of kind "monotonic".
#include <fmt/format.h>

#include "host/experiments/transient/transient_experiment.hpp"
#include "host/experiments/read_points.hpp"

namespace macadam {

using experiments::Monotonic;

template <>
Monotonic ExperimentOf<Monotonic>::read(const scene::Section& section) {
  using namespace scene;
  constexpr Rule rule{[](double v) { return v != 0; }, "a rate that is not 0"};
  // at a strain of -1 nothing is left of the specimen; no test of a mixture or a binder reaches a strain of 10
  constexpr Rule any{[](double v) { return v != 0 && v > -1 && v <= 10; }, "a strain above -1 and at most 10, not 0"};
  constexpr int usual_points = 100;
  Monotonic out;
  Points times;
  std::optional<double> strain;
  std::vector<Key> keys = times.keys("times", duration, Need::optional);
  keys.insert(keys.end(),
              {kind_key(),
               poisson_key(out.poisson_ratio),
               temperature_key(out.temperature),
               {"rate", Need::required, into(out.rate, scene::rate, rule), "rate of the strain; tension is positive"},
               {"strain", Need::optional, into(strain, ratio, any),
                "strain at which the test ends, in place of times; it has the sign of the rate", "the last of times"}});
  section.read(keys);
  if (!strain) {
    if (!section.has("times")) section.refuse("times", "nothing", "times, or the key strain, at which the test ends");
    out.times = times.all(section, "times", "s", "time");
    if (const double last = out.rate * out.times.back(); last != 0 && !any.holds(last))
      section.refuse("times", fmt::format("a strain of {:g} at the last time", last), any.words);
    return out;
  }
  for (const char* key : {"times", "points_per_decade"}) {
    if (section.has(key)) section.refuse(key, std::string(key) + " with strain", "only one of the two keys");
  }
  const double end = *strain / out.rate;
  if (!(end > 0))
    section.refuse("strain", fmt::format("{} at a rate of {} 1/s", *strain, out.rate),
                   "a strain with the sign of the rate");
  const int points = times.evenly.value_or(usual_points);
  for (int i = 1; i <= points; ++i) out.times.push_back(end * i / points);
  return out;
}

}  // namespace macadam
