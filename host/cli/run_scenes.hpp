// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_scenes.hpp  Several scenes of one command.
#pragma once

#include <string>
#include <vector>

#include "host/cli/job.hpp"

namespace macadam {

/// Runs the scenes side by side, each into a folder of its own in that of the job: named as the scene's file, or, where
/// that is scene.toml, as the folder that it is in. Says what each came to as it is done. \throws InputError before
/// any begins, where a scene is wrong or two have one name; RunError at the end, where some failed.
void run_scenes(const std::vector<std::string>& scenes, const Job& job, const Overrides& instead, int at_once,
                bool resume);

}  // namespace macadam
