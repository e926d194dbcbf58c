// SPDX-License-Identifier: GPL-3.0-or-later
/// \file json_lines.hpp  Writes events for other programs: one JSON object per line on standard output (docs/json.md).
/// Text for people then goes to standard error.
#pragma once

#include <exception>
#include <optional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace macadam {

/// Returns whether a command line asks for JSON lines: `--json` after the command run, check or info. Other commands
/// have an option of this name with another meaning.
bool wants_json_lines(int argc, const char* const* argv);

/// Turns JSON lines on. From now on say() writes to standard error. `stream`: whether the command writes several
/// events, as run does, of which the last one is `end`; otherwise standard output is a single JSON document.
void begin_json_lines(bool stream);

/// Returns whether JSON lines are on.
bool json_lines_are_on();

/// Writes one event, a JSON object, as a line, and flushes standard output. Bytes that are not UTF-8, which a path may
/// have, are replaced. Does nothing if JSON lines are off. Must not be called by two threads at the same time.
void print_json_line(const nlohmann::ordered_json& event);

/// Writes the event `progress` of a scene. Leaves out events that follow the last one of the same scene and stage
/// within a second. `fraction`: part of the stage that is done, 0…1. Does nothing if JSON lines are off.
void print_json_progress(const std::string& scene, const std::string& stage, double fraction);

/// Writes the event `warning`, if JSON lines are on.
void print_json_warning(const std::string& scene, const std::string& message);

/// Writes the event `error`, if JSON lines are on. `scene`: the scene that failed, if several run.
void print_json_error(const std::exception& error, const std::optional<std::string>& scene = {});
/// Writes the event `error` about a command line that is wrong, if JSON lines are on.
void print_json_usage_error(const std::string& message);
/// Writes the event `error` about a lack of memory without allocating memory, if JSON lines are on.
void print_json_out_of_memory();

/// Writes the event `end`, the last one of a stream, if JSON lines are on. `code`: the exit code of the program.
void print_json_end(int code);

}  // namespace macadam
