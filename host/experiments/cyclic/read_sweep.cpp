// SPDX-License-Identifier: GPL-3.0-or-later
// read_sweep.cpp  Reads `[loading]` of kind "sweep".
#include "host/experiments/experiment.hpp"
#include "host/experiments/read_points.hpp"

namespace macadam {

using experiments::Sweep;

template <>
Sweep ExperimentOf<Sweep>::read(const scene::Section& section) {
  Sweep out;
  scene::read_steady_states(section, out.frequencies, out.temperatures);
  return out;
}

}  // namespace macadam
