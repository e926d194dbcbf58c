// SPDX-License-Identifier: GPL-3.0-or-later
/// \file commands.hpp  Defines the whole command line: all commands with their options, examples and actions.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds all commands of the program to an empty command line.
void make_command_line(CLI::App& app);

}  // namespace macadam
