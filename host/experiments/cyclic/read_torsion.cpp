// SPDX-License-Identifier: GPL-3.0-or-later
// read_torsion.cpp  Reads `[loading]` of kind "torsion".
#include "host/experiments/experiment.hpp"
#include "host/experiments/read_points.hpp"

namespace macadam {

template <>
experiments::Torsion ExperimentOf<experiments::Torsion>::read(const scene::Section& section) {
  experiments::Torsion out;
  scene::read_steady_states(section, out.frequencies, out.temperatures);
  return out;
}

}  // namespace macadam
