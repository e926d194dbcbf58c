// SPDX-License-Identifier: GPL-3.0-or-later
// read_indirect_tensile_strength.cpp  Reads `[loading]` of kind "indirect_tensile_strength".
#include "host/experiments/read_points.hpp"
#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

using experiments::IndirectTensileStrength;

template <>
IndirectTensileStrength ExperimentOf<IndirectTensileStrength>::read(const scene::Section& section) {
  IndirectTensileStrength out;
  scene::Approach approach;
  std::vector<scene::Key> keys =
      approach.keys("rate at which the strips approach each other", "approach of the strips at which the test ends");
  keys.push_back(scene::strip_width_key(out.strip_width));
  section.read(keys);
  out.rate = approach.rate.value_or(out.rate);
  out.times = approach.times(out.rate);
  return out;
}

}  // namespace macadam
