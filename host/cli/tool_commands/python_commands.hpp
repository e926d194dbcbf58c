// SPDX-License-Identifier: GPL-3.0-or-later
/// \file python_commands.hpp  macadam report, mixture, mcp and study: commands that are written in Python.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds these commands to the program. The commands replace the process by `python3 -m macadam …` when the command line
/// is parsed.
void add_python_commands(CLI::App& app);

}  // namespace macadam
