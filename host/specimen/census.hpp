// SPDX-License-Identifier: GPL-3.0-or-later
/// \file census.hpp  Counts the aggregates, spheres and voids that a specimen will have, without placing any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// Numbers of aggregates, spheres and voids, and warnings.
struct Census {
  std::int64_t aggregates = 0;     ///< number of aggregates
  std::int64_t in_aggregates = 0;  ///< spheres in all aggregates; more than `aggregates` if shapes are filled
  std::int64_t mastic = 0, voids = 0;
  std::int64_t templates = 0;  ///< number of shapes; each aggregate is a copy of one of them
  /// Radii of the smallest spheres of a file [m]; 0 if it has none. Not set for a recipe.
  double smallest_mastic = 0, smallest_in_aggregates = 0;
  std::vector<std::string> warnings;  ///< packing_warnings() of a file; empty for a recipe
  std::int64_t particles() const { return in_aggregates + mastic; }
};

/// Counts the spheres of a specimen. If the specimen is a file, reads the file. If it is a recipe, computes the volumes
/// of the classes; if the recipe has shapes, draws shapes and sizes too. \throws InputError for a file or recipe that a
/// run would refuse too.
Census count_specimen(const SpecimenSpec& spec);

}  // namespace macadam
