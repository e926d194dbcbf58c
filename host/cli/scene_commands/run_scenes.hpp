// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_scenes.hpp  Runs several scenes by one command.
#pragma once

#include <string>
#include <vector>

#include "host/cli/terminal/job.hpp"

namespace macadam {

/// Runs the scenes side by side. Each scene has its own results folder within the job's folder. The results folder is
/// named after the scene's file or, for a file scene.toml, after the folder that holds this file. Prints the result of
/// each scene when it is done. \throws InputError before any scene begins, if a scene is wrong or two have the same
/// name; RunError at the end, if some failed.
void run_scenes(const std::vector<std::string>& scenes, const Job& job, const Overrides& instead, int at_once,
                bool resume);

}  // namespace macadam
