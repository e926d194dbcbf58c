// SPDX-License-Identifier: GPL-3.0-or-later
/// \file unit_vector.hpp  Normalises a vector.
#pragma once

#include "macadam/numeric.hpp"

namespace macadam {

/// Returns the unit vector in the direction of `v`, which must not be zero.
inline Vec3d unit(const Vec3d& v) { return (1 / norm(v)) * v; }

}  // namespace macadam
