// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_changes.hpp  Sets values of a scene by texts such as `solver.method=harmonic`, before the scene is read.
/// Each value keeps the text that set it as its source, so that errors about the value name this text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/scene/toml.hpp"

namespace macadam::scene {

/// The source of values that a text has set begins with this word in the parser's positions and in messages:
/// `--set solver.method=harmonic`.
inline constexpr std::string_view set_option = "--set ";

/// The tables of a scene with changed values, and a text with the same content. The tables keep the lines of the
/// unchanged values in the original text.
struct ChangedScene {
  toml::table table;
  std::string text;
};

/// Sets one value per text `KEY=VALUE` in a scene. KEY is the path of the key, with dots between its parts. A part may
/// be the pair of an entry of `[[contacts]]` or the number of an entry of a list, counted from 0. Missing sections are
/// made. VALUE is a TOML value; a text of letters, digits, spaces and `._-+%/` needs no quotes. A table replaces the
/// whole section. `table` was parsed from `text`. The new text keeps the comments and the order of the old text, if
/// that is possible.
///
/// \throws InputError that names the KEY=VALUE, if it is not TOML, or if it leads into an entry or a section that does
/// not exist. Whether a scene may have the key and the value is checked by the scene reader.
ChangedScene with_changes(toml::table table, std::string text, const std::vector<std::string>& changes);

}  // namespace macadam::scene
