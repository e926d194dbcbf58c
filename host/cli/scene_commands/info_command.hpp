// SPDX-License-Identifier: GPL-3.0-or-later
/// \file info_command.hpp  `macadam info`: prints the version, backends and devices, or every key of a scene.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command `info` to the program. The command runs while the command line is parsed, so its errors are thrown
/// from there.
void add_info_command(CLI::App& app);

}  // namespace macadam
