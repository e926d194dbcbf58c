// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_command.hpp  `macadam specimen`: makes a specimen and its contact network.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command; it runs, and throws, when the command line is parsed.
void add_specimen_command(CLI::App& app);

}  // namespace macadam
