// SPDX-License-Identifier: GPL-3.0-or-later
// calibrated_scene.cpp  Writes the scene's file with the calibrated values, and checks that the file gives these
// values.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/tools/calibration/parameters.hpp"
#include "host/scene/scene_text.hpp"
#include "macadam/error.hpp"

namespace macadam {

std::string calibrated_scene(const Scene& scene, const Calibration& calibration, const std::filesystem::path& folder) {
  if (scene.text.empty()) throw InputError("calibrated scene: the scene was not read from a file");
  scene::SceneText text(scene.text);
  text.move(scene.file.parent_path(), folder);
  if (!scene.specimen.file) text.set_seed(scene.specimen.seed);
  const std::vector<calibration::Parameter> known = calibration::parameters_of(scene);
  for (const CalibratedParameter& p : calibration.parameters) {
    const auto at = std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.name == p.name; });
    if (at->phase)
      text.set_material(*at->phase, at->key, p.value);
    else
      text.set_contact(at->pair, at->key, p.value);
  }
  return text.text();
}

void require_calibrated(const Scene& scene, const Calibration& calibration) {
  const std::vector<calibration::Parameter> known = calibration::parameters_of(scene);
  for (const CalibratedParameter& p : calibration.parameters) {
    const auto at = std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.name == p.name; });
    // the value is a product of a few factors, each of them rounded
    if (at == known.end() || !(std::abs(at->value / p.value - 1) < 1e-14)) {
      throw RunError(fmt::format("{}: {} is {}, but the calibrated value is {}", scene.file.string(), p.name,
                                 at == known.end() ? "missing" : fmt::format("{}", at->value), p.value));
    }
  }
}

}  // namespace macadam
