// SPDX-License-Identifier: GPL-3.0-or-later
/// \file commands.hpp  The whole command line: all commands with their options, examples and what they do.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Makes an empty one into that of the program.
void make_command_line(CLI::App& app);

}  // namespace macadam
