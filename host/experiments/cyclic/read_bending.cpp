// SPDX-License-Identifier: GPL-3.0-or-later
// read_bending.cpp  Reads `[loading]` of kind "bending".
#include "host/experiments/experiment.hpp"
#include "host/experiments/read_points.hpp"

namespace macadam {

template <>
experiments::Bending ExperimentOf<experiments::Bending>::read(const scene::Section& section) {
  using scene::into, scene::Need, scene::positive;
  experiments::Bending out;
  scene::read_steady_states(
      section, out.frequencies, out.temperatures,
      {{"rollers", Need::optional, into(out.rollers, 3, 4),
        "number of rollers: two below the beam, and one (3) or two (4) above it"},
       {"span", Need::optional, into(out.span, scene::length, positive), "distance of the two lower rollers",
        "0.9 of the length of the beam"},
       {"inner_span", Need::optional, into(out.inner_span, scene::length, positive),
        "with 4 rollers: distance of the two upper ones", "a third of the span"},
       {"roller_width", Need::optional, into(out.roller_width, scene::length, positive),
        "length of each roller along the beam; particles touch the rollers only there", "0.04 of the span"},
       {"poisson_ratio", Need::optional, into(out.poisson_ratio, scene::ratio, scene::of_poisson),
        "Poisson's ratio of the mixture, from which the deflection by shear follows"}});
  return out;
}

}  // namespace macadam
