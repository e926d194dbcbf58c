// SPDX-License-Identifier: GPL-3.0-or-later
/// \file recipe_summary.hpp  The `recipe` of summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "macadam/recipe.hpp"

namespace macadam {

/// What follows from a mix design, and what a generated specimen (a row a class, then the mastic) reached of it.
nlohmann::ordered_json recipe_json(const MixDesign& design, const std::vector<CompositionRow>& composition);

}  // namespace macadam
