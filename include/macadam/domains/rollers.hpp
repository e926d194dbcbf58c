// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rollers.hpp  Defines the rollers between which a specimen is bent.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace macadam::domains {

/// Rollers below and above a specimen. A roller is a strip of the wall −z or +z: it is `width` long along x and reaches
/// across the whole specimen along y. The specimen touches these two walls only within the strips.
struct Rollers {
  std::vector<double> bottom, top;  ///< middles of the rollers on the walls −z and +z, along x [m]
  double width = 0;                 ///< length of each roller along x [m]; 0: no rollers
  /// Whether the rollers turn with the specimen. Otherwise a roller holds the section above or below it.
  bool turn = false;

  /// Returns the middles of the rollers on the wall −z (index 4) or +z (index 5).
  const std::vector<double>& on(int wall) const { return wall == 4 ? bottom : top; }

  /// Returns whether x [m] lies within the roller that has this middle [m].
  bool covers(double middle, double x) const { return std::abs(x - middle) <= 0.5 * width; }

  /// Returns whether a wall touches the specimen at the coordinate x [m]. Without rollers every wall does so
  /// everywhere.
  bool touches(int wall, double x) const {
    if (width == 0 || wall < 4) return true;
    const std::vector<double>& middles = on(wall);
    return std::any_of(middles.begin(), middles.end(), [&](double middle) { return covers(middle, x); });
  }
};

}  // namespace macadam::domains
