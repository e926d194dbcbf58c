// SPDX-License-Identifier: GPL-3.0-or-later
/// \file packing_check.hpp  Checks whether the spheres of a specimen fill their box; gives warnings before a run.
#pragma once

#include <string>
#include <vector>

#include "macadam/tessellation.hpp"

namespace macadam {

/// Returns one sentence for each of the following faults; returns none for a packing that fills its box.
/// - The spheres fill less than a tenth of the box (see sparse_box()). In this case the next faults are not checked.
/// - A cell reaches far beyond its sphere: more than 4 radii of the largest sphere among the particle and its
///   neighbours, and more than 2 mean spacings (box volume per sphere)^(1/3). The sentence names the facet.
/// - The spheres fill more than 150 % of the box. A sphere of an aggregate of several spheres counts for at most its
///   cell, because such spheres overlap.
std::vector<std::string> packing_warnings(const Specimen& specimen, const Tessellation& tessellation);

}  // namespace macadam
