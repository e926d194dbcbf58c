// SPDX-License-Identifier: GPL-3.0-or-later
/// \file bending_rollers.hpp  Places the rollers of a bending test on the domain of a scene.
#pragma once

#include "host/scene/table.hpp"
#include "macadam/scene.hpp"

namespace macadam::scene {

/// Gives the beam of a scene the rollers of its bending test. Does nothing for another test, or for a domain other than
/// a beam, which is refused later. `root` is the whole scene. \throws InputError if a roller does not fit on the beam,
/// or if rollers overlap.
void set_rollers(Scene& scene, const Section& root);

}  // namespace macadam::scene
