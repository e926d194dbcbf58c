// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mean_motion.hpp  Computes the mean motion of the particles at a place in a specimen, as a transducer there
/// would measure it.
#pragma once

#include <complex>
#include <optional>

#include "macadam/harmonic.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Means over some particles, weighted by their volumes.
struct MeanMotion {
  Vec3d position{};                  ///< of the centres [m]
  std::complex<double> along_z = 0;  ///< displacement along z per unit displacement of the top wall
};

/// Returns the means over the particles whose centres lie in a box with this middle and these half edges [m]; nothing
/// if there are none.
std::optional<MeanMotion> mean_motion(const Specimen& specimen, const HarmonicResult& state, const Vec3d& middle,
                                      const Vec3d& half_edges);

}  // namespace macadam
