// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_seeds.hpp  Runs one scene with several seeds of its specimen.
#pragma once

#include <CLI/CLI.hpp>

#include "host/cli/terminal/job.hpp"

namespace macadam {

/// Replaces this process by a study of the Python package, `macadam study SCENE --seeds N`. The first seed is the seed
/// of the job or else of the scene. The options of `command` that replace keys of the scene are passed to every run.
/// With values of --set, first writes the changed scene into the folder of the results, and the study computes this
/// scene. `at_once`: number of runs at a time; 0: as many as the threads of each run allow. The scene and the options
/// are checked before.
///
/// \throws InputError if the scene is wrong or its specimen has no seed; RunError if the study cannot be started.
[[noreturn]] void run_seeds(const CLI::App& command, const Job& job, const Overrides& instead, int seeds, int at_once);

}  // namespace macadam
