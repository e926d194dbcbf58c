// SPDX-License-Identifier: GPL-3.0-or-later
/// \file given_particles.hpp  Marks a scene whose particles are given by the caller of the library, not by a file.
#pragma once

namespace macadam::scene {

/// The value of `[specimen] file` in such a scene. Reading the scene does not look for the file. A run that is not
/// given the particles fails, because no file has this name.
inline constexpr const char* given_particles = "particles given in Python";

}  // namespace macadam::scene
