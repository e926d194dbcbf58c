// SPDX-License-Identifier: GPL-3.0-or-later
/// \file preparation_files.hpp  What is written of a prepared scene before there are results.
#pragma once

#include <filesystem>
#include <functional>

#include "macadam/simulation.hpp"

namespace macadam {

/// specimen.csv, aggregates.csv, gradation.csv (of a recipe by mass), contacts.csv (where the scene asks) and
/// summary.json without results, into a folder that is there. Files of another specimen that these do not replace are
/// removed: aggregates, gradation, contacts, sections. An older result stays whole until all of these files are on the
/// disk; then its summary goes first, `remove_results()` removes what else the caller writes anew, and the new summary
/// comes last: whoever finds one finds the files that it is about.
/// \throws RunError.
void write_preparation(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out,
                       const std::function<void()>& remove_results);

}  // namespace macadam
