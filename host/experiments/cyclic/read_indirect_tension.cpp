// SPDX-License-Identifier: GPL-3.0-or-later
// read_indirect_tension.cpp  Reads `[loading]` of kind "indirect_tension".
#include "host/experiments/experiment.hpp"
#include "host/experiments/read_points.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam {

using experiments::IndirectTension;

template <>
IndirectTension ExperimentOf<IndirectTension>::read(const scene::Section& section) {
  using namespace scene;
  constexpr Rule of_poisson{[](double v) { return v > -1 && v < 0.5; }, "a ratio above -1 and below 0.5"};
  IndirectTension out;
  Points frequencies;
  std::vector<Key> keys = frequencies.keys("frequencies", frequency);
  keys.insert(keys.end(),
              {kind_key(),
               {"temperatures", Need::optional, into(out.temperatures, temperature, celsius),
                "temperatures at which every frequency is tested; they replace temperature in [materials]", "none"},
               strip_width_key(out.strip_width),
               {"poisson_ratio", Need::optional, into(out.poisson_ratio, ratio, of_poisson),
                "Poisson's ratio with which the modulus follows from the horizontal deformation alone",
                "both follow from the horizontal and the vertical deformation"}});
  section.read(keys);
  out.frequencies = frequencies.all(section, "frequencies", "Hz", "frequency");
  require_once(section, "temperatures", out.temperatures, "degrees C", "temperature");
  return out;
}

}  // namespace macadam
