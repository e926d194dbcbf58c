// SPDX-License-Identifier: GPL-3.0-or-later
/// \file choose_precision.hpp  The precision of a planned cyclic test.
#pragma once

#include "host/experiments/cyclic/plan.hpp"

namespace macadam {

/// As asked for; with a tolerance the least whose rounding is estimated to be a small share of it, said among the
/// decisions; else double. The frequencies of the plan must be there.
void choose_precision(const Scene& scene, const Preparation& prepared, Plan& plan);

}  // namespace macadam
