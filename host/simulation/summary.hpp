// SPDX-License-Identifier: GPL-3.0-or-later
/// \file summary.hpp  summary.json: what was prepared, asked, run and found.
#pragma once

#include <filesystem>
#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// The whole text. `status` is "prepared", "running", "interrupted", "done" or "failed: …".
std::string summary_json(const Scene& scene, const Preparation& preparation, const RunResult& result,
                         const std::string& status);

/// \throws InputError where the folder holds a summary.json of anything but a prepared specimen, or a checkpoint.
void require_no_run(const std::filesystem::path& out);

}  // namespace macadam
