// SPDX-License-Identifier: GPL-3.0-or-later
/// \file beam_strength.hpp  Computes what laboratories report of a beam that three rollers bend until it fails.
#pragma once

#include <span>

#include "host/experiments/transient/bottom_notch.hpp"
#include "host/experiments/transient/peak_fit.hpp"
#include "macadam/domains/domain.hpp"
#include "macadam/experiments/three_point_bending.hpp"

namespace macadam {

/// Returns the results of a test whose curve has these samples, in the order of time. `peak`: its largest stress.
/// Stress and strain are negative, as in experiments::ThreePointBending. `beam` must have rollers.
experiments::BeamStrength beam_strength(std::span<const StressSample> samples, const experiments::FittedPeak& peak,
                                        const Domain& beam, const BottomNotch& notch);

}  // namespace macadam
