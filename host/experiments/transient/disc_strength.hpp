// SPDX-License-Identifier: GPL-3.0-or-later
/// \file disc_strength.hpp  Computes what standards report of a disc that two strips split.
#pragma once

#include <span>

#include "host/experiments/transient/peak_fit.hpp"
#include "macadam/domains/domain.hpp"
#include "macadam/experiments/indirect_tensile_strength.hpp"

namespace macadam {

/// Returns the results of a test whose curve has these samples, in the order of time. `peak`: its largest stress.
/// Stress and strain are negative, as in experiments::IndirectTensileStrength.
experiments::DiscStrength disc_strength(std::span<const StressSample> samples, const experiments::FittedPeak& peak,
                                        const Domain& disc);

}  // namespace macadam
