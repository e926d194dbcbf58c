// SPDX-License-Identifier: GPL-3.0-or-later
/// \file composition.hpp  From the scene's recipe to the list of spheres that must find a place.
#pragma once

#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// The spheres of one aggregate class, or of the mastic.
struct Population {
  CompositionRow row;
  std::vector<double> radius;  ///< largest first [m]
};

/// Sizes of everything in the specimen; no positions yet.
struct Composition {
  std::vector<Population> aggregate;  ///< in the recipe's order
  std::vector<Population> mastic;     ///< one entry, or none
};

/// Draws every sphere of a recipe. Volume fractions are of the solid volume: (1 − porosity)·box, or what follows from
/// the count of mastic spheres; without mastic the solid volume is unknown and fractions are of the box.
/// Each class reaches its volume to rounding where its sieves allow, else to 0.2 % of the box.
/// \throws InputError for a recipe that nobody could follow.
Composition compose(const SpecimenSpec& spec);

}  // namespace macadam
