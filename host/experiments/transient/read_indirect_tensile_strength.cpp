// SPDX-License-Identifier: GPL-3.0-or-later
// read_indirect_tensile_strength.cpp  Reads `[loading]` of kind "indirect_tensile_strength".
#include "host/experiments/read_points.hpp"
#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

using experiments::IndirectTensileStrength;

template <>
IndirectTensileStrength ExperimentOf<IndirectTensileStrength>::read(const scene::Section& section) {
  using namespace scene;
  constexpr std::int64_t most_points = 100'000;
  IndirectTensileStrength out;
  std::optional<double> rate;
  double displacement = 0;
  int points = 200;
  section.read({kind_key(),
                strip_width_key(out.strip_width),
                {"rate", Need::optional, into(rate, speed, positive), "rate at which the strips approach each other",
                 "50 mm/min, as in the standards"},
                {"displacement", Need::required, into(displacement, length, positive),
                 "approach of the strips at which the test ends"},
                {"points", Need::optional, into(points, 10, most_points), "rows of the result, evenly spaced"}});
  out.rate = rate.value_or(out.rate);
  for (int i = 1; i <= points; ++i) out.times.push_back(displacement / out.rate * i / points);
  return out;
}

}  // namespace macadam
