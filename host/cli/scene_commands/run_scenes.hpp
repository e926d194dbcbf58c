// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_scenes.hpp  Runs several scenes by one command.
#pragma once

#include <string>
#include <vector>

#include "host/cli/terminal/job.hpp"

namespace macadam {

/// Runs the scenes side by side, each into its own folder within the job's folder. That folder has the name of the
/// scene's file or, for a file scene.toml, the name of the folder that holds it. Prints the result of each scene when
/// it is done. \throws InputError before any scene begins, if a scene is wrong or two have the same name; RunError at
/// the end, if some failed.
void run_scenes(const std::vector<std::string>& scenes, const Job& job, const Overrides& instead, int at_once,
                bool resume);

}  // namespace macadam
