// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_events.hpp  Writes the events of `macadam run --json` (docs/json.md). Without --json, the functions do
/// nothing. `scene` is the file of the scene as the command line names it.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "macadam/simulation.hpp"

namespace macadam {

/// Writes the event `start`. Each pair has a scene and the folder of its results.
void print_start_event(const std::vector<std::pair<std::string, std::filesystem::path>>& scenes);

/// Writes the event `prepared`: the numbers of particles and contacts, and the times in which they were made.
void print_prepared_event(const std::string& scene, const Preparation& prepared);

/// Writes the event `planned`: the decisions of the program, and the work that the run leaves out.
void print_planned_event(const std::string& scene, const RunResult& planned);

/// Writes the event `result`, with the results and settings of summary.json in the folder `out`. `files`: names of the
/// files in this folder. \throws RunError if summary.json cannot be read.
void print_result_event(const std::string& scene, const std::filesystem::path& out,
                        const std::vector<std::string>& files, const RunResult& result);

/// Returns the names of the files that a run of the scene has left in the folder `out`; `fields/` stands for all field
/// files.
std::vector<std::string> files_left(const Scene& scene, const std::filesystem::path& out);

}  // namespace macadam
