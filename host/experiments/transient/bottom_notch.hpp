// SPDX-License-Identifier: GPL-3.0-or-later
/// \file bottom_notch.hpp  Defines the notch of a half disc or a beam that is bent until it fails.
#pragma once

#include <optional>
#include <span>

#include "macadam/domains/domain.hpp"
#include "macadam/notch.hpp"

namespace macadam {

/// A notch from the bottom of a half disc or a beam.
struct BottomNotch {
  double length = 0;       ///< from the bottom upwards [m]; 0: no notch
  bool in_middle = false;  ///< whether the notch is at the middle of the length
  double ligament = 0;     ///< height of the specimen above the notch [m]
};

/// Returns the notch of a half disc or a beam; its length is 0 without a notch. Empty if the notches are not one cut
/// that is perpendicular to x, begins at the bottom, ends within the specimen and passes through the whole thickness
/// along y.
std::optional<BottomNotch> bottom_notch(const Domain& domain, std::span<const Notch> notches);

}  // namespace macadam
