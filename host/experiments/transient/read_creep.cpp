// SPDX-License-Identifier: GPL-3.0-or-later
// read_creep.cpp  Reads `[loading]` of kind "creep".
#include <fmt/format.h>

#include "host/experiments/transient/transient_experiment.hpp"
#include "host/experiments/read_points.hpp"

namespace macadam {

using experiments::Creep;

template <>
Creep ExperimentOf<Creep>::read(const scene::Section& section) {
  using namespace scene;
  Creep out;
  Points times;
  std::vector<Key> keys = times.keys("times", duration);
  keys.insert(keys.end(),
              {kind_key(),
               poisson_key(out.poisson_ratio),
               temperature_key(out.temperature),
               {"stress", Need::required, into(out.stress, modulus, any),
                "stress that is applied and held; tension is positive; 0 only if the temperature changes"},
               {"ramp", Need::optional, into(out.ramp, duration, non_negative),
                "time over which the load grows evenly; 0: at once"},
               {"release", Need::optional, into(out.release, duration, positive),
                "time at which the stress begins to be removed, over the same time in which it was applied", "never"},
               {"platen_mass", Need::optional, into(out.platen_mass, mass, positive),
                "mass of the loaded top wall, for method \"explicit\"",
                "the smallest mass that does not shorten the time step"}});
  section.read(keys);
  out.times = times.all(section, "times", "s", "time");
  if (out.stress == 0 && out.temperature.empty()) section.refuse("stress", "0", "a stress that is not 0");
  if (out.release && *out.release < out.ramp) {
    section.refuse("release", fmt::format("{} s", *out.release),
                   fmt::format("the end of the ramp, {} s, or later", out.ramp));
  }
  if (out.release && *out.release >= out.times.back()) {
    section.refuse("release", fmt::format("{} s", *out.release),
                   fmt::format("less than the last of the times, {} s", out.times.back()));
  }
  return out;
}

}  // namespace macadam
