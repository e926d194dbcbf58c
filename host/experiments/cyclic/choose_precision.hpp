// SPDX-License-Identifier: GPL-3.0-or-later
/// \file choose_precision.hpp  Chooses the precision of a planned cyclic test.
#pragma once

#include "host/experiments/cyclic/plan.hpp"

namespace macadam {

/// Takes the precision that the scene asks for. Otherwise, with a tolerance, takes the lowest precision whose estimated
/// rounding is a small part of the tolerance, and reports it among the decisions; without a tolerance, takes double.
/// The frequencies of the plan must be set.
void choose_precision(const Scene& scene, const Preparation& prepared, Plan& plan);

}  // namespace macadam
