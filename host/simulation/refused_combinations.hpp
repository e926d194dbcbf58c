// SPDX-License-Identifier: GPL-3.0-or-later
/// \file refused_combinations.hpp  Checks whether method, backend, experiment and output of a scene go together.
#pragma once

#include "macadam/scene.hpp"

namespace macadam {

/// Checks a scene whose keys are each valid. The command line may have changed some of them after the scene was read.
/// \throws InputError naming the scene, the settings that exclude each other, and settings that are possible.
void require_combination(const Scene& scene);

/// Returns the backend that the scene asks for. Backend "auto" is the CPU if the temperature changes during the test,
/// because devices do not compute thermal expansion.
Backend requested_backend(const Scene& scene);

}  // namespace macadam
