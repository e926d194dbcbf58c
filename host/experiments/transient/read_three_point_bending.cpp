// SPDX-License-Identifier: GPL-3.0-or-later
// read_three_point_bending.cpp  Reads `[loading]` of kind "three_point_bending".
#include "host/experiments/read_points.hpp"
#include "host/experiments/transient/transient_experiment.hpp"

namespace macadam {

using experiments::ThreePointBending;

template <>
ThreePointBending ExperimentOf<ThreePointBending>::read(const scene::Section& section) {
  using scene::into, scene::Need, scene::positive;
  ThreePointBending out;
  scene::Approach approach;
  std::vector<scene::Key> keys = approach.keys("rate at which the upper roller moves down",
                                               "displacement of the upper roller at which the test ends", "");
  keys.push_back({"span", Need::optional, into(out.span, scene::length, positive), "distance of the two lower rollers",
                  "4 times the height of the beam"});
  keys.push_back({"roller_width", Need::optional, into(out.roller_width, scene::length, positive),
                  "length of each roller along the beam; particles touch the rollers only there", "0.04 of the span"});
  section.read(keys);
  out.rate = approach.rate.value();
  out.times = approach.times(out.rate);
  return out;
}

}  // namespace macadam
