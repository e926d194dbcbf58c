// SPDX-License-Identifier: GPL-3.0-or-later
/// \file given_particles.hpp  The source of a scene whose particles come from the caller of the library.
#pragma once

namespace macadam::scene {

/// The value of `[specimen] file` in such a scene. No file is looked for when the scene is read; a run that is not
/// given the particles finds no file of this name.
inline constexpr const char* given_particles = "particles given in Python";

}  // namespace macadam::scene
