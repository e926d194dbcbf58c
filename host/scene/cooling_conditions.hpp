// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cooling_conditions.hpp  Checks the conditions of kind "cooling" that concern several sections of a scene.
#pragma once

#include <string>

#include "host/scene/table.hpp"
#include "macadam/scene.hpp"

namespace macadam::scene {

/// Returns, for messages, why time steps cannot follow a scene's test of kind "cooling". If the specimen is generated,
/// the text has the number of time steps: the duration of the test, divided by the time in which the fastest wave
/// crosses the smallest mastic sphere.
std::string why_cooling_has_no_steps(const Scene& scene);

/// Checks that the materials expand, that laws which relax have a shift, that [materials] has no temperature, that the
/// sides are free, and that the method is "quasi_static". Does nothing for other tests. `root` is the whole scene.
/// \throws InputError
void require_cooling(const Scene& scene, const Section& root);

}  // namespace macadam::scene
