// SPDX-License-Identifier: GPL-3.0-or-later
/// \file combination.hpp  Whether method, backend, test and output of a scene go together.
#pragma once

#include "macadam/scene.hpp"

namespace macadam {

/// Of a scene whose keys are each possible; the command line may have changed some since it was read.
/// \throws InputError naming the scene, what does not go with what, and what would.
void require_combination(const Scene& scene);

}  // namespace macadam
