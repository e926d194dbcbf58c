// SPDX-License-Identifier: GPL-3.0-or-later
// read_relaxation.cpp  Reads `[loading]` of kind "relaxation".
#include <cmath>

#include "host/experiments/transient/transient_experiment.hpp"
#include "host/experiments/read_points.hpp"

namespace macadam {

using experiments::Relaxation;

template <>
Relaxation ExperimentOf<Relaxation>::read(const scene::Section& section) {
  using namespace scene;
  constexpr Rule strain{[](double v) { return v != 0 && std::abs(v) < 1; }, "a strain between -1 and 1 that is not 0"};
  Relaxation out;
  Points times;
  std::vector<Key> keys = times.keys("times", duration);
  keys.insert(keys.end(),
              {kind_key(),
               poisson_key(out.poisson_ratio),
               temperature_key(out.temperature),
               {"strain", Need::optional, into(out.strain, ratio, strain), "imposed strain; tension is positive"},
               {"ramp", Need::optional, into(out.ramp, duration, non_negative),
                "time over which the load grows evenly; 0: at once"}});
  section.read(keys);
  out.times = times.all(section, "times", "s", "time");
  return out;
}

}  // namespace macadam
