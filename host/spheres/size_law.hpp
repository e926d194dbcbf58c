// SPDX-License-Identifier: GPL-3.0-or-later
/// \file size_law.hpp  Sphere diameters between two sieves.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "host/spheres/random_stream.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Volume of a sphere [m³].
double sphere_volume(double diameter);

/// A size law between two diameters [m], 0 < min ≤ max.
struct SizeRange {
  SizeLaw law;
  double min, max;

  /// Diameter below which the share `u` (0…1) of the spheres lies [m]. `volume_uniform` spreads the class's volume
  /// evenly over the diameters, so the number density falls as d⁻³.
  double quantile(double u) const;

  /// Expected volume of one sphere [m³].
  double mean_volume() const;
};

/// `count` diameters, largest first, whose volumes sum to `volume` to rounding, where count·V(min)…count·V(max)
/// allows; else as near as it allows. One draw from each of `count` equal shares of the law keeps the sample close to
/// the law; what is left of the sum is removed by bending the shares, u → u^t with t near 1, which keeps the range.
std::vector<double> draw_diameters(const SizeRange& range, std::int64_t count, double volume, RandomStream& random);

/// The same for bodies of any form: `volume_of(i, d)` [m³] is that of entry i of the result with the size d, and grows
/// with d; where it jumps, the sum may miss `volume` by one jump.
std::vector<double> draw_sizes(const SizeRange& range, std::int64_t count, double volume, RandomStream& random,
                               const std::function<double(std::size_t i, double d)>& volume_of);

}  // namespace macadam
