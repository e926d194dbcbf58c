// SPDX-License-Identifier: GPL-3.0-or-later
/// \file generate.hpp  generate_specimen(), with the cells that it looked at in the end.
#pragma once

#include <functional>
#include <optional>

#include "macadam/specimen.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

struct GeneratedWithCells {
  GeneratedSpecimen made;
  /// Of the specimen as it is. None where it has voids: these stood among the spheres when the cells were looked at.
  std::optional<Tessellation> tessellation;
  double seconds_tessellation = 0;  ///< what it took, where it is there
};

/// As generate_specimen().
GeneratedWithCells generate_with_cells(const SpecimenSpec& spec,
                                       const std::function<void(const char* stage, double share)>& progress);

}  // namespace macadam
