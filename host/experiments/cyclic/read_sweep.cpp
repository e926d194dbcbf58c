// SPDX-License-Identifier: GPL-3.0-or-later
// read_sweep.cpp  Reads `[loading]` of kind "sweep".
#include "host/experiments/experiment.hpp"
#include "host/experiments/read_points.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam {

using experiments::Sweep;

template <>
Sweep ExperimentOf<Sweep>::read(const scene::Section& section) {
  using namespace scene;
  Sweep out;
  Points frequencies;
  std::vector<Key> keys = frequencies.keys("frequencies", frequency);
  keys.push_back(kind_key());
  keys.push_back({"temperatures", Need::optional, into(out.temperatures, temperature, celsius),
                  "temperatures at which every frequency is tested; they replace temperature in [materials]", "none"});
  section.read(keys);
  out.frequencies = frequencies.all(section, "frequencies", "Hz", "frequency");
  require_once(section, "temperatures", out.temperatures, "degrees C", "temperature");
  return out;
}

}  // namespace macadam
