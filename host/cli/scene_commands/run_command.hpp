// SPDX-License-Identifier: GPL-3.0-or-later
/// \file run_command.hpp  `macadam run`: runs scenes and writes their results.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command `run` to the program. The command runs while the command line is parsed, so its errors are thrown
/// from there.
void add_run_command(CLI::App& app);

}  // namespace macadam
