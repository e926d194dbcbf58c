// SPDX-License-Identifier: GPL-3.0-or-later
/// \file divergence.hpp  Checks whether a stepped run has diverged.
#pragma once

#include <string>

#include "macadam/stepper.hpp"

namespace macadam {

/// `of`: name of the stepped object, for the message; may be empty. \throws DivergenceError naming the first particle
/// whose motion is out of range, or the top wall.
void require_convergence(const Sample& sample, const std::string& of);

}  // namespace macadam
