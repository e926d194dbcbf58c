// SPDX-License-Identifier: GPL-3.0-or-later
/// \file half_disc_strength.hpp  Computes what standards report of a half disc that is bent until it fails.
#pragma once

#include <span>

#include "host/experiments/transient/bottom_notch.hpp"
#include "host/experiments/transient/peak_fit.hpp"
#include "macadam/domains/domain.hpp"
#include "macadam/experiments/semicircular_bending.hpp"

namespace macadam {

/// Returns the results of a test whose curve has these samples, in the order of time. `peak`: its largest stress.
/// Stress and strain are negative, as in experiments::SemicircularBending. `half_disc` must have rollers.
experiments::HalfDiscStrength half_disc_strength(std::span<const StressSample> samples,
                                                 const experiments::FittedPeak& peak, const Domain& half_disc,
                                                 const BottomNotch& notch);

}  // namespace macadam
