// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shapes_command.hpp  `macadam shapes …`: works with surfaces of aggregates.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command `shapes` with its subcommands to the program. They run while the command line is parsed, so their
/// errors are thrown from there.
void add_shapes_command(CLI::App& app);

}  // namespace macadam
