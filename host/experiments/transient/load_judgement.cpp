// SPDX-License-Identifier: GPL-3.0-or-later
// load_judgement.cpp  Computes sums over the points of a stepped test of a load, and words its warnings.
#include "host/experiments/transient/load_judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace macadam {

using experiments::SteppedPoint;

double kinetic_share(const std::vector<SteppedPoint>& points, double volume) {
  double kinetic = 0, strain = 0, stress = 0;
  for (const SteppedPoint& p : points) {
    kinetic = std::max(kinetic, p.kinetic_j);
    strain = std::max(strain, std::abs(p.strain));
    stress = std::max(stress, std::abs(p.stress_pa));
  }
  const double work = 0.5 * strain * stress * volume;
  return work > 0 ? kinetic / work : 0;
}

std::string fewer_steps() {
  return "a larger density_scaling reduces their number, and method = \"harmonic\" needs none if all laws are linear";
}

}  // namespace macadam
