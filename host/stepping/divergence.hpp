// SPDX-License-Identifier: GPL-3.0-or-later
/// \file divergence.hpp  Checks whether a stepped run has diverged.
#pragma once

#include <string>

#include "macadam/stepper.hpp"

namespace macadam {

/// Checks that a sample has not diverged. `of` is the name of the run in the message; it may be empty. \throws
/// DivergenceError naming the first particle whose motion is out of range, or the top wall if its force or motion is
/// not finite.
void require_convergence(const Sample& sample, const std::string& of);

}  // namespace macadam
