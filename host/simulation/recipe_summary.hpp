// SPDX-License-Identifier: GPL-3.0-or-later
/// \file recipe_summary.hpp  Makes the entry `recipe` of summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "macadam/recipe.hpp"

namespace macadam {

/// Returns the volumes and densities that follow from a mix design, and the volumes and densities of the generated
/// specimen. `composition`: one row per class, then the mastic.
nlohmann::ordered_json recipe_json(const MixDesign& design, const std::vector<CompositionRow>& composition);

}  // namespace macadam
