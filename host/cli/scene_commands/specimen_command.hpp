// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_command.hpp  `macadam specimen`: makes a specimen and its contact network.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command `specimen` to the program. The command runs while the command line is parsed, so its errors are
/// thrown from there.
void add_specimen_command(CLI::App& app);

}  // namespace macadam
