// SPDX-License-Identifier: GPL-3.0-or-later
// read_semicircular_bending.cpp  Reads `[loading]` of kind "semicircular_bending".
#include "host/experiments/read_points.hpp"
#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

using experiments::SemicircularBending;

template <>
SemicircularBending ExperimentOf<SemicircularBending>::read(const scene::Section& section) {
  using scene::into, scene::Need, scene::positive;
  SemicircularBending out;
  scene::Approach approach;
  std::vector<scene::Key> keys = approach.keys("rate at which the upper roller moves down",
                                               "displacement of the upper roller at which the test ends");
  keys.push_back({"span", Need::optional, into(out.span, scene::length, positive), "distance of the two lower rollers",
                  "0.8 of the diameter, as in the standards"});
  keys.push_back({"roller_width", Need::optional, into(out.roller_width, scene::length, positive),
                  "length of each roller along x; particles touch the rollers only there", "0.1 of the radius"});
  section.read(keys);
  out.rate = approach.rate.value_or(out.rate);
  out.times = approach.times(out.rate);
  return out;
}

}  // namespace macadam
