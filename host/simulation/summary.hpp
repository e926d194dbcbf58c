// SPDX-License-Identifier: GPL-3.0-or-later
/// \file summary.hpp  Writes summary.json: specimen, request, settings and results of a run.
#pragma once

#include <filesystem>
#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// Returns the text of summary.json. `status` is "prepared", "running", "interrupted", "done" or "failed: …".
std::string summary_json(const Scene& scene, const Preparation& preparation, const RunResult& result,
                         const std::string& status);

/// Checks that the folder holds no run. \throws InputError if it holds a checkpoint, or a summary.json that does not
/// belong to a prepared specimen.
void require_no_run(const std::filesystem::path& out);

}  // namespace macadam
