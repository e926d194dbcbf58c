// SPDX-License-Identifier: GPL-3.0-or-later
/// \file check_command.hpp  `macadam check`: predicts particles, memory, time and files of a run.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `check` to the program.
void add_check_command(CLI::App& app);

}  // namespace macadam
