// SPDX-License-Identifier: GPL-3.0-or-later
/// \file bending_rollers.hpp  Places the rollers of the bending tests on the domain of a scene.
#pragma once

#include "host/scene/table.hpp"
#include "macadam/scene.hpp"

namespace macadam::scene {

/// Gives the beam or the half disc of a scene the rollers of its bending test, and a test to failure the height of the
/// specimen. Does nothing for other tests. A test with the wrong domain gets no rollers; it is refused
/// later. `root` is the whole scene. \throws InputError if a roller does not fit on the domain, or if rollers overlap.
void set_rollers(Scene& scene, const Section& root);

}  // namespace macadam::scene
