// SPDX-License-Identifier: GPL-3.0-or-later
// mean_motion.cpp  Computes means over the particles in a box.
#include "host/experiments/cyclic/mean_motion.hpp"

#include <cmath>

namespace macadam {

std::optional<MeanMotion> mean_motion(const Specimen& specimen, const HarmonicResult& state, const Vec3d& middle,
                                      const Vec3d& half_edges) {
  MeanMotion sum;
  double volume = 0;  // over 4π/3
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vec3d from = specimen.centre[i] - middle;
    if (std::abs(from.x) > half_edges.x || std::abs(from.y) > half_edges.y || std::abs(from.z) > half_edges.z) continue;
    const double v = specimen.radius[i] * specimen.radius[i] * specimen.radius[i];
    sum.position += v * specimen.centre[i];
    sum.along_z += v * state.motion[6 * i + 2];
    volume += v;
  }
  if (!(volume > 0)) return {};
  return MeanMotion{(1 / volume) * sum.position, sum.along_z / volume};
}

}  // namespace macadam
