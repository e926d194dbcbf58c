// SPDX-License-Identifier: GPL-3.0-or-later
/// \file generate.hpp  Declares generate_with_cells(), which does the same as generate_specimen() and also returns the
/// tessellation made by its final check.
#pragma once

#include <functional>
#include <optional>

#include "macadam/specimen.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// A generated specimen and its cells.
struct GeneratedWithCells {
  GeneratedSpecimen made;
  /// The tessellation of the specimen. Empty if there are voids, because the voids were among the particles when the
  /// tessellation was made.
  std::optional<Tessellation> tessellation;
  double seconds_tessellation = 0;  ///< time of the tessellation, if it is present [s]
};

/// Generates a specimen as generate_specimen() does, and returns its cells too.
GeneratedWithCells generate_with_cells(const SpecimenSpec& spec,
                                       const std::function<void(const char* stage, double share)>& progress);

}  // namespace macadam
