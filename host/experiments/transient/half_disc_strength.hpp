// SPDX-License-Identifier: GPL-3.0-or-later
/// \file half_disc_strength.hpp  Computes what standards report of a half disc that is bent until it fails.
#pragma once

#include <optional>
#include <span>

#include "host/experiments/transient/peak_fit.hpp"
#include "macadam/domains/domain.hpp"
#include "macadam/experiments/semicircular_bending.hpp"
#include "macadam/notch.hpp"

namespace macadam {

/// The notch of a half disc.
struct HalfDiscNotch {
  double length = 0;       ///< from the flat side towards the arc [m]; 0: no notch
  bool in_middle = false;  ///< whether the notch lies in the plane between the two lower rollers
  double ligament = 0;     ///< height of the half disc above the notch [m]
};

/// Returns the notch of a half disc; its length is 0 without a notch. Empty if the notches are not one cut that is
/// perpendicular to x, begins at the flat side and passes through the whole thickness.
std::optional<HalfDiscNotch> half_disc_notch(const Domain& half_disc, std::span<const Notch> notches);

/// Returns the results of a test whose curve has these samples, in the order of time. `peak`: its largest stress.
/// Stress and strain are negative, as in experiments::SemicircularBending. `half_disc` must have rollers.
experiments::HalfDiscStrength half_disc_strength(std::span<const StressSample> samples,
                                                 const experiments::FittedPeak& peak, const Domain& half_disc,
                                                 const HalfDiscNotch& notch);

}  // namespace macadam
