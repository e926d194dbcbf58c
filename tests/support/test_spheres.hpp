// SPDX-License-Identifier: GPL-3.0-or-later
/// \file test_spheres.hpp  Helpers for specimens that are put together sphere by sphere.
#pragma once

#include "macadam/specimen.hpp"

namespace macadam::test {

/// Appends a sphere. Centre and radius in m.
inline void add(Specimen& s, const Vec3d& p, double radius, Phase phase = Phase::mastic, std::int32_t body = -1) {
  s.centre.push_back(p);
  s.radius.push_back(radius);
  s.phase.push_back(phase);
  s.body.push_back(body);
}

}  // namespace macadam::test
