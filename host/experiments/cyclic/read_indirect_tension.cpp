// SPDX-License-Identifier: GPL-3.0-or-later
// read_indirect_tension.cpp  Reads `[loading]` of kind "indirect_tension".
#include "host/experiments/experiment.hpp"
#include "host/experiments/read_points.hpp"

namespace macadam {

using experiments::IndirectTension;

template <>
IndirectTension ExperimentOf<IndirectTension>::read(const scene::Section& section) {
  using namespace scene;
  IndirectTension out;
  read_steady_states(section, out.frequencies, out.temperatures,
                     {strip_width_key(out.strip_width),
                      {"poisson_ratio", Need::optional, into(out.poisson_ratio, ratio, of_poisson),
                       "Poisson's ratio with which the modulus follows from the horizontal deformation alone",
                       "both follow from the horizontal and the vertical deformation"}});
  return out;
}

}  // namespace macadam
