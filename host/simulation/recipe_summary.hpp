// SPDX-License-Identifier: GPL-3.0-or-later
/// \file recipe_summary.hpp  The entry `recipe` of summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "macadam/recipe.hpp"

namespace macadam {

/// Returns what follows from a mix design, and what a generated specimen reached of it. `composition`: one row per
/// class, then the mastic.
nlohmann::ordered_json recipe_json(const MixDesign& design, const std::vector<CompositionRow>& composition);

}  // namespace macadam
