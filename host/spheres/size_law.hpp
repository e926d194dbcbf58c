// SPDX-License-Identifier: GPL-3.0-or-later
/// \file size_law.hpp  Defines laws for the distribution of sphere diameters between two sieves.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "host/spheres/random_stream.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Returns the volume of a sphere [m³].
double sphere_volume(double diameter);

/// A size law between two diameters [m], with 0 < min ≤ max (model, section 19).
struct SizeRange {
  SizeLaw law;
  double min, max;

  /// Returns the diameter [m] below which the fraction `u` (0…1) of the spheres lies. `volume_uniform` gives equal
  /// volumes in equal ranges of diameter, so its number density is proportional to d⁻³.
  double quantile(double u) const;

  /// Returns the expected volume of one sphere [m³].
  double mean_volume() const;
};

/// Returns `count` diameters, largest first, whose volumes sum to `volume` up to rounding. If `volume` is outside
/// count·V(min)…count·V(max), the sum comes as close as possible. One sample is drawn from each of `count` equal strata
/// of the law, so that the sample is close to the law. The remaining error of the sum is removed by replacing the
/// probability u of every sample by u^t, with t near 1. With this replacement all diameters stay within the range.
std::vector<double> draw_diameters(const SizeRange& range, std::int64_t count, double volume, RandomStream& random);

/// Draws sizes as draw_diameters() does, but for particles of any form. `volume_of(i, d)` [m³] is the volume of entry i
/// of the result with size d; it must not decrease with d. If this volume is discontinuous at some d, the sum may
/// differ from `volume` by the size of this jump.
std::vector<double> draw_sizes(const SizeRange& range, std::int64_t count, double volume, RandomStream& random,
                               const std::function<double(std::size_t i, double d)>& volume_of);

}  // namespace macadam
