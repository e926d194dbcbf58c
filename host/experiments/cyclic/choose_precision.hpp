// SPDX-License-Identifier: GPL-3.0-or-later
/// \file choose_precision.hpp  Chooses the precision of a planned cyclic test.
#pragma once

#include "host/experiments/cyclic/plan.hpp"

namespace macadam {

/// Sets the precision of the plan to the one that the scene asks for. If the scene asks for none and has a tolerance,
/// chooses the lowest precision whose estimated rounding error is a small part of the tolerance, and reports it among
/// the decisions. Without a tolerance, chooses double precision. The frequencies of the plan must be set.
void choose_precision(const Scene& scene, const Preparation& prepared, Plan& plan);

}  // namespace macadam
