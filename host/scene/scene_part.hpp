// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_part.hpp  Writes one section of a new scene: its keys with values, and its other keys as comments.
#pragma once

#include <string>
#include <vector>

#include "host/scene/known_keys.hpp"

namespace macadam::scene {

/// A key and its value.
struct Given {
  std::string key, value;
};

/// A section, and the keys in it that have values.
struct Part {
  std::string title;
  std::vector<Given> given;
  std::string remark = {};                  ///< comment above the section
  bool others = true;                       ///< whether the section's keys without values follow as comments
  std::vector<std::string> not_these = {};  ///< keys that are left out of these comments
};

/// Returns the text of a section. `keys`: all keys of scenes.
std::string written(const std::vector<KnownKey>& keys, const Part& part);

}  // namespace macadam::scene
