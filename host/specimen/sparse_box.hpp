// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sparse_box.hpp  A specimen whose spheres are lost in their box: lengths of one of the two are in another unit.
#pragma once

#include <string>

#include "macadam/specimen.hpp"

namespace macadam {

/// A warning, or nothing where spheres fill as much of the box as in any specimen whose spheres touch.
std::string sparse_box(const Specimen& specimen);

}  // namespace macadam
