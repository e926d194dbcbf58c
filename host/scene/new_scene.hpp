// SPDX-License-Identifier: GPL-3.0-or-later
/// \file new_scene.hpp  Makes a scene to start from: the keys that a mix needs have values, all others are comments
/// with their defaults.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "macadam/contact_network.hpp"

namespace macadam::scene {

/// Kind of specimen in the new scene.
enum class NewKind : std::uint8_t {
  recipe,   ///< a mix design by mass
  spheres,  ///< classes by volume; an aggregate is a sphere
  shapes,   ///< classes by volume; an aggregate is a shape filled with spheres
  file,     ///< specimen.csv beside the scene
  packing   ///< specimen.csv of one material, the mastic
};

/// Returns the experiments that a new scene may have.
std::vector<std::string> tests_of_new_scenes();

/// Returns the text of a scene. `test` is the experiment, the `kind` in `[loading]`. Explanations of keys come from the
/// scene reader. With the rules "series" and "volumetric" the laws are those of mastic and rock, in `[materials]`.
/// `cracks`: contacts between particles have cracks, and the test is stepped; the tests "indirect_tensile_strength",
/// "semicircular_bending", "three_point_bending" and "cooling" always have cracks. \throws InputError for cracks with
/// one of these rules or with a test that measures no strength, and for the tests "indirect_tension" and "bending" with
/// the rule "volumetric".
std::string new_scene(NewKind kind, const std::string& test, ContactRule rule = ContactRule::centres,
                      bool cracks = false);

}  // namespace macadam::scene
