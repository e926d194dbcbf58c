// SPDX-License-Identifier: GPL-3.0-or-later
/// \file loaded_rollers.hpp  Checks that every roller below and above a specimen touches it.
#pragma once

#include "macadam/tessellation.hpp"

namespace macadam {

/// Checks that the centroid of a particle's facet lies within each roller of the specimen's domain. Otherwise the
/// roller has no contact. Does nothing for a domain without rollers. \throws RunError naming the wall and the position
/// of the roller.
void require_loaded_rollers(const Specimen& specimen, const Tessellation& cells);

}  // namespace macadam
