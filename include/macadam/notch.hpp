// SPDX-License-Identifier: GPL-3.0-or-later
/// \file notch.hpp  Defines notches: thin cuts that no contact crosses.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "macadam/numeric.hpp"

namespace macadam {

/// A rectangle perpendicular to an axis. Particles with their centres on opposite sides of its plane have no contact
/// through it: the part of their facet whose projection along the axis lies in the rectangle carries no load.
struct Notch {
  int axis = 0;         ///< 0 to 2: the normal of the rectangle
  double position = 0;  ///< coordinate of the plane along the axis [m]
  /// Limits along x, y and z [m]; the limits along the axis of the notch are not used. Without limits the notch is as
  /// wide as the specimen.
  std::array<double, 3> low = unlimited(-1), high = unlimited(1);
  std::string source = "specimen";  ///< the scene's file, for messages
  int line = 0;                     ///< line in that file; 0: none

 private:
  static constexpr std::array<double, 3> unlimited(double sign) {
    const double far = sign * std::numeric_limits<double>::infinity();
    return {far, far, far};
  }
};

/// The effect of a notch on the contacts. Areas are projections along the axis of the notch.
struct NotchCut {
  Notch notch;
  std::int64_t removed =
      0;  ///< number of facets of which this notch removed the last part, so that they are not contacts
  std::int64_t shortened = 0;  ///< number of contacts that lost a part of their facet
  double cut_area = 0;         ///< area of the facets that this notch removed; overlaps belong to the first notch [m²]
  double ligament = 0;         ///< area of the contacts that still join the two sides of the plane [m²]
};

}  // namespace macadam
