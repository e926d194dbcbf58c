// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shapes_command.hpp  `macadam shapes …`: works with surfaces of aggregates.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `shapes` with its own commands; they run, and throw, while the command line is parsed.
void add_shapes_command(CLI::App& app);

}  // namespace macadam
