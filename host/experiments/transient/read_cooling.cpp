// SPDX-License-Identifier: GPL-3.0-or-later
// read_cooling.cpp  Reads `[loading]` of kind "cooling".
#include <fmt/format.h>

#include "host/experiments/read_points.hpp"
#include "host/experiments/transient/transient_experiment.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam {

using experiments::Cooling;

template <>
Cooling ExperimentOf<Cooling>::read(const scene::Section& section) {
  using scene::into, scene::Need;
  // 10 without a unit would be 10 K/s
  constexpr scene::Rule plausible{[](double v) { return v >= 1e-9 && v <= 0.1; },
                                  "1e-9 to 0.1 K/s; a rate in another unit is text with the unit, such as \"10 K/h\""};
  constexpr std::int64_t fewest_points = 10, most_points = 100'000;
  Cooling out;
  std::optional<double> rate;
  int points = 100;
  section.read(
      {scene::kind_key(),
       {"from", Need::optional, into(out.from, scene::temperature, scene::celsius),
        "first temperature, at which the specimen is without stress"},
       {"to", Need::optional, into(out.to, scene::temperature, scene::celsius),
        "last temperature, at which the test ends if the specimen has not broken"},
       {"rate", Need::optional, into(rate, scene::warming_rate, plausible), "rate at which the temperature falls",
        "10 K/h, as in the standard"},
       {"points", Need::optional, into(points, fewest_points, most_points), "rows of the result, evenly spaced"}});
  out.rate = rate.value_or(out.rate);
  if (!(out.to < out.from))
    section.refuse("to", fmt::format("{:g} degrees C, with from = {:g}", out.to, out.from),
                   "a temperature below from, because the specimen cools");
  const double end = (out.from - out.to) / out.rate;
  for (int i = 1; i <= points; ++i) out.times.push_back(end * i / points);
  out.temperature = {{0, end}, {out.from, out.to}};
  return out;
}

}  // namespace macadam
