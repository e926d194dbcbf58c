// SPDX-License-Identifier: GPL-3.0-or-later
/// \file preparation_files.hpp  Writes the files of a prepared scene before there are results.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// Writes specimen.csv, aggregates.csv, gradation.csv (for a recipe by mass), contacts.csv (if the scene asks for it),
/// scene_as_run.toml (if the command changed values of the scene) and summary.json without results into an existing
/// folder. Removes the files of an older specimen that are not written again: aggregates, gradation, contacts,
/// sections, exports, the changed scene. A changed scene is neither replaced nor removed if the scene was read from
/// this file. An older result stays complete until all of the new files are on the disk. Then the summary of the older
/// result is removed first, and `remove_results()` removes the other files that the caller will write again. The new
/// summary gets its name last. So a summary in the folder always belongs to the other files there. \throws RunError.
void write_preparation(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out,
                       const std::function<void()>& remove_results);

/// Returns the text of a scene whose values a command has changed, for a file in the folder `out`: it names the scene
/// and the values, and paths start from `out`.
std::string changed_scene_text(const Scene& scene, const std::filesystem::path& out);

}  // namespace macadam
