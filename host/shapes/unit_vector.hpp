// SPDX-License-Identifier: GPL-3.0-or-later
/// \file unit_vector.hpp  A vector's direction.
#pragma once

#include "macadam/numeric.hpp"

namespace macadam {

/// Of length 1; `v` is not 0.
inline Vec3d unit(const Vec3d& v) { return (1 / norm(v)) * v; }

}  // namespace macadam
