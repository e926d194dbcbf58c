// SPDX-License-Identifier: GPL-3.0-or-later
/// \file new_command.hpp  macadam new: writes a scene to start from.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `new` to the program.
void add_new_command(CLI::App& app);

}  // namespace macadam
