// SPDX-License-Identifier: GPL-3.0-or-later
/// \file old_results.hpp  Removes files of older runs from a results folder.
#pragma once

#include <filesystem>

#include "macadam/simulation.hpp"

namespace macadam {

/// Removes the result files of an older run. Its checkpoint may stay, because it is not a result. \throws RunError if a
/// file cannot be removed.
void remove_results(const std::filesystem::path& out);

/// Removes the checkpoint of this run or of an earlier run of the same scene, because it is not needed any more once
/// the results exist. A checkpoint that cannot be removed costs only disk space. `own`: the checkpoint in the folder
/// is known to be of this run.
void remove_own_checkpoint(const std::filesystem::path& out, const Scene& scene, Backend backend, bool own);

}  // namespace macadam
