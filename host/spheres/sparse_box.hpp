// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sparse_box.hpp  Detects a specimen whose spheres fill only a small part of its box. The lengths of the spheres
/// or of the box are then probably in a wrong unit.
#pragma once

#include <string>

#include "macadam/specimen.hpp"

namespace macadam {

/// Returns a warning if the spheres fill less than a tenth of the box, otherwise an empty string.
std::string sparse_box(const Specimen& specimen);

}  // namespace macadam
