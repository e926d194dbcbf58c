// SPDX-License-Identifier: GPL-3.0-or-later
/// \file new_scene.hpp  A scene to begin with: all that a mix needs with values, all else as comments with its default.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace macadam::scene {

/// What the specimen comes from.
enum class NewKind : std::uint8_t {
  recipe,   ///< a mix design by mass
  spheres,  ///< classes by volume, an aggregate is a sphere
  shapes,   ///< the same, an aggregate is a shape filled with spheres
  file      ///< specimen.csv beside the scene
};

/// All tests that it may have.
std::vector<std::string> tests_of_new_scenes();

/// The text of a scene with a test, `kind` in `[loading]`. What it says of each key is the reader's own.
std::string new_scene(NewKind kind, const std::string& test);

}  // namespace macadam::scene
