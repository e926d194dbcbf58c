// SPDX-License-Identifier: GPL-3.0-or-later
/// \file precision.hpp  Defines which quantities of the step are double and which are float, for each precision.
#pragma once

#include "macadam/backend.hpp"

namespace macadam::kernels {

/// State: states of chains, and carried frames. Geometry: normals, arms, moments, and velocities that contacts read.
/// Particle: integrated velocities and sums of forces. Displacements are always double, because they add up small
/// steps.
struct DoublePrecision {
  using State = double;
  using Geometry = double;
  using Particle = double;
  static constexpr Precision value = Precision::double_;
};
struct MixedPrecision {
  using State = double;
  using Geometry = float;
  using Particle = double;
  static constexpr Precision value = Precision::mixed;
};
struct SinglePrecision {
  using State = float;
  using Geometry = float;
  using Particle = float;
  static constexpr Precision value = Precision::single;
};

}  // namespace macadam::kernels
