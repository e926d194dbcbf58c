// SPDX-License-Identifier: GPL-3.0-or-later
/// \file census.hpp  How many bodies and spheres a specimen will have, without a place for any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

struct Census {
  std::int64_t aggregates = 0;     ///< bodies
  std::int64_t in_aggregates = 0;  ///< spheres of them: as many, or more where shapes are filled
  std::int64_t mastic = 0, voids = 0;
  std::int64_t templates = 0;  ///< shapes that they are copies of
  /// Radii of the smallest spheres of a file [m]; 0: there is none, or no file.
  double smallest_mastic = 0, smallest_in_aggregates = 0;
  std::vector<std::string> warnings;  ///< packing_warnings() of a file
  std::int64_t particles() const { return in_aggregates + mastic; }
};

/// Of a file, which is read, or of a recipe, whose classes are solved and of shapes drawn.
/// \throws InputError for a file or recipe that a run would refuse too.
Census count_specimen(const SpecimenSpec& spec);

}  // namespace macadam
